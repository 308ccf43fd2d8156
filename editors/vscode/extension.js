// The extension: starts `cascade lsp`, and runs and shows scripts.
const { execFile } = require("node:child_process");
const fs = require("node:fs/promises");
const os = require("node:os");
const path = require("node:path");
const vscode = require("vscode");
const { LanguageClient } = require("vscode-languageclient/node");
const { startView } = require("./live_view.js");

const program = () => vscode.workspace.getConfiguration("cascade").get("path");
let client, pictures;
const views = new Map();  // The live views by script.

/** Saves the script in the active editor, or else a script that is visible beside a picture or a page, and returns its
 * path. Empty if there is none. */
async function activeScript() {
    const { activeTextEditor, visibleTextEditors } = vscode.window;
    const document = [activeTextEditor, ...visibleTextEditors].map((editor) => editor?.document)
        .find((document) => document?.languageId === "cascade" && document.uri.scheme === "file");
    if (!(await document?.save())) {
        vscode.window.showInformationMessage("Save the script in a file first.");
        return undefined;
    }
    return document.fileName;
}

/** Draws the picture of the script, with a progress message that can be cancelled, and shows it beside the text. */
async function run() {
    const script = await activeScript();
    if (!script) return;
    pictures ??= await fs.mkdtemp(path.join(os.tmpdir(), "cascade-"));
    const picture = path.join(pictures, `${path.basename(script, ".cascade")}.png`);
    const location = vscode.ProgressLocation.Notification, title = `cascade run ${path.basename(script)}`;
    const failure = await vscode.window.withProgress({ location, title, cancellable: true }, (progress, stop) =>
        new Promise((done) => {
            const options = { cwd: path.dirname(script) };
            const child = execFile(program(), ["run", script, "-q", "-o", picture], options, (error, out, said) =>
                done(error ? said || error.message : undefined));
            stop.onCancellationRequested(() => child.kill("SIGINT"));
        }));
    if (failure) vscode.window.showErrorMessage(failure.slice(0, 1000));
    else await vscode.commands.executeCommand("vscode.open", vscode.Uri.file(picture),
        { viewColumn: vscode.ViewColumn.Beside, preserveFocus: true });
}

/** Shows the page of `cascade view` beside the text. The page takes part in changes of the text when it is saved. */
async function view() {
    const script = await activeScript();
    if (!script) return;
    try {
        views.get(script)?.stop();
        const shown = await startView(program(), script);
        views.set(script, shown);
        await vscode.commands.executeCommand("simpleBrowser.api.open", vscode.Uri.parse(shown.address, true),
            { viewColumn: vscode.ViewColumn.Beside, preserveFocus: true });
    } catch (error) {
        vscode.window.showErrorMessage(`${error.message}`.slice(0, 1000));
    }
}

async function activate(context) {
    client = new LanguageClient("cascade", "Cascade", { command: program(), args: ["lsp"] },
        { documentSelector: [{ language: "cascade" }] });
    context.subscriptions.push(vscode.commands.registerCommand("cascade.run", run),
        vscode.commands.registerCommand("cascade.view", view),
        vscode.workspace.onDidSaveTextDocument((document) => views.get(document.fileName)?.setText(document.getText())));
    await client.start();
}

async function deactivate() {
    for (const each of views.values()) each.stop();
    if (pictures) await fs.rm(pictures, { recursive: true, force: true });
    await client?.stop();
}

module.exports = { activate, deactivate };
