// replay.mjs CASCADE: sends thirty requests to the language server with the client library of
// Visual Studio Code, `vscode-languageserver-protocol` from node_modules of the current folder.
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import fs from "node:fs";
import { createRequire } from "node:module";
import path from "node:path";
import { pathToFileURL } from "node:url";

const require = createRequire(path.join(process.cwd(), "package.json"));
const lsp = require("vscode-languageserver-protocol/node");

const text = `# Waves that fade 🐆
# in two stages.
fn half(a) = a / 2   ## the half
use "more.cascade"
system waves {
  u: 1 + 0.1 * x   # 🐆 μ
  feed: 0.5 in 0 .. 1   ## supply of u
  d = half(feed) * u
  u' = lap(u) - d + grown(u)
}
domain { grid: 16, 16 }
stage one: waves { iterations: 5 }
stage two: brusselator {
  feed: 4.5
}
picture { color: rgb(1, 0.5, 51/255) }
`;
fs.writeFileSync("more.cascade", "fn grown(v) = 0.1 * v   ## by a tenth\n");
fs.writeFileSync("replay.cascade", text);
const uri = pathToFileURL(path.resolve("replay.cascade")).href, textDocument = { uri };

const child = spawn(process.argv[2], ["lsp"], { stdio: ["pipe", "pipe", "inherit"] });
const ended = new Promise((done) => child.on("close", done));
const client = lsp.createProtocolConnection(new lsp.StreamMessageReader(child.stdout), new lsp.StreamMessageWriter(child.stdin));
client.onError(([error]) => { throw error; });
const published = [];
let wake = () => {};
client.onNotification(lsp.PublishDiagnosticsNotification.type, (params) => { published.push(params); wake(); });
/** The diagnostics of a version of the text. */
async function diagnostics(version) {
    for (;;) {
        const found = published.find((params) => params.version === version);
        if (found) return found.diagnostics;
        await new Promise((done) => { wake = done; });
    }
}
client.listen();

let count = 0;
const ask = (type, params) => { ++count; return client.sendRequest(type, params); };
/** The position of the n-th character of a part of a line. The library counts in UTF-16, as strings do. */
function at(part, n = 0) {
    const lines = current.split("\n"), line = lines.findIndex((each) => each.includes(part));
    return { line, character: lines[line].indexOf(part) + n };
}
let current = text, version = 1;
function change(part, replacement) {
    const start = at(part), end = { line: start.line, character: start.character + part.length };
    current = current.replace(part, replacement);
    client.sendNotification(lsp.DidChangeTextDocumentNotification.type,
        { textDocument: { uri, version: ++version }, contentChanges: [{ range: { start, end }, text: replacement }] });
}
const hover = async (part, n) => (await ask(lsp.HoverRequest.type, { textDocument, position: at(part, n) }))?.contents.value ?? "";
const names = async (part, n) =>
    (await ask(lsp.CompletionRequest.type, { textDocument, position: at(part, n) })).items.map((item) => item.label);
const textIn = (range) => current.split("\n")[range.start.line].slice(range.start.character, range.end.character);

const started = await ask(lsp.InitializeRequest.type, { processId: process.pid, rootUri: null, capabilities: {} });  // 1
assert.equal(started.capabilities.positionEncoding, "utf-16");
client.sendNotification(lsp.InitializedNotification.type, {});
client.sendNotification(lsp.DidOpenTextDocumentNotification.type,
    { textDocument: { uri, languageId: "cascade", version, text } });
assert.deepEqual((await diagnostics(1)).filter(({ severity }) => severity === 1), []);

assert.match(await hover("feed: 0.5", 1), /supply of u[^]*From 0 to 1[^]*one\.feed: 0\.5/);  // 2
assert.match(await hover("u' =", 0), /∂u\/∂t = ∇²u − d/);  // 3
assert.match(await hover("d = half", 0), /definition[^]*d = /);  // 4
assert.match(await hover("half(feed)", 2), /the half[^]*fn half\(a\) = a \/ 2/);  // 5
assert.match(await hover("grown(u)", 2), /by a tenth/);  // 6
assert.match(await hover("stage two", 7), /Waves of [\d.]+ cells grow fastest/);  // 7
assert.match(await hover("lap(u)", 1), /the Laplacian/);  // 8
assert.equal(await hover("# in two", 4), "");  // 9
const inValue = await names("lap(u)", 4);  // 10
for (const name of ["u", "feed", "half", "grown", "sin"]) assert.ok(inValue.includes(name), name);
assert.ok((await names("waves { iter", 3)).includes("waves"));  // 11
assert.ok((await names("iterations", 3)).includes("interval"));  // 12
assert.deepEqual(await names("# Waves", 5), []);  // 13
const declared = await ask(lsp.DefinitionRequest.type, { textDocument, position: at("half(feed)", 6) });  // 14
assert.deepEqual([declared.uri, textIn(declared.range)], [uri, "feed"]);
const elsewhere = await ask(lsp.DefinitionRequest.type, { textDocument, position: at("grown(u)", 1) });  // 15
assert.equal(elsewhere.uri, pathToFileURL(path.resolve("more.cascade")).href);
const library = await ask(lsp.DefinitionRequest.type, { textDocument, position: at("brusselator", 1) });  // 16
assert.match(fs.readFileSync(new URL(library.uri), "utf8").split("\n")[library.range.start.line], /system brusselator/);
const uses = await ask(lsp.ReferencesRequest.type,
    { textDocument, position: at("u: 1", 0), context: { includeDeclaration: true } });  // 17
assert.equal(uses.length, 5);
assert.ok(uses.every(({ range }) => textIn(range) === "u"));
assert.equal((await ask(lsp.DocumentHighlightRequest.type, { textDocument, position: at("u: 1", 0) })).length, 5);  // 18
const prepared = await ask(lsp.PrepareRenameRequest.type, { textDocument, position: at("feed: 0.5", 0) });  // 19
assert.equal(prepared.placeholder, "feed");
const renamed = await ask(lsp.RenameRequest.type, { textDocument, position: at("feed: 0.5", 0), newName: "supply" });  // 20
assert.deepEqual(renamed.changes[uri].map(({ range, newText }) => [textIn(range), newText]),
    [["feed", "supply"], ["feed", "supply"]]);
await assert.rejects(ask(lsp.RenameRequest.type, { textDocument, position: at("feed: 0.5", 0), newName: "u" }),
    /cannot be called 'u'/);  // 21
assert.deepEqual(await ask(lsp.DocumentFormattingRequest.type,
    { textDocument, options: { tabSize: 2, insertSpaces: true } }), []);  // 22
const symbols = await ask(lsp.DocumentSymbolRequest.type, { textDocument });  // 23
assert.deepEqual(symbols.map(({ name }) => name), ["half", "waves", "domain", "one", "two", "picture"]);
assert.equal((await ask(lsp.FoldingRangeRequest.type, { textDocument })).length, 3);  // 24
const tokens = await ask(lsp.SemanticTokensRequest.type, { textDocument });  // 25
assert.equal(tokens.data.length % 5, 0);
const [colour] = await ask(lsp.DocumentColorRequest.type, { textDocument });  // 26
assert.deepEqual([textIn(colour.range), colour.color.blue], ["rgb(1, 0.5, 51/255)", 0.2]);
const [label] = await ask(lsp.ColorPresentationRequest.type,
    { textDocument, range: colour.range, color: { red: 0, green: 0.5, blue: 1, alpha: 1 } });  // 27
assert.equal(label.label, "rgb(0, 0.5, 1)");
const [link] = await ask(lsp.DocumentLinkRequest.type, { textDocument });  // 28
assert.equal(link.target, elsewhere.uri);

change("half(feed)", "half(fed)");
const [wrong] = await diagnostics(2);
assert.deepEqual([textIn(wrong.range), wrong.severity, /did you mean 'feed'/.test(wrong.message)], ["fed", 1, true]);
const [action] = await ask(lsp.CodeActionRequest.type,
    { textDocument, range: wrong.range, context: { diagnostics: [wrong] } });  // 29
assert.equal(action.edit.changes[uri][0].newText, "feed");
change("half(fed)", "half(feed)");
assert.deepEqual((await diagnostics(3)).filter(({ severity }) => severity === 1), []);
await assert.rejects(client.sendRequest("textDocument/moniker", {}), /no method/);

await ask(lsp.ShutdownRequest.type);  // 30
client.sendNotification(lsp.ExitNotification.type);
assert.equal(await ended, 0);
assert.equal(count, 30);
console.log("thirty requests are answered as they should be");
