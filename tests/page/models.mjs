// Models from files on the page of `cascade view spots.cascade`: by the button, by dropping a file, and from hostile
// files. Arguments: the browser, the program and the folder of the sources. Screenshots are left in the current folder.
import { existsSync, mkdirSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { Browser, ending, expect, serve } from "./browser.mjs";

const [command, program, source] = process.argv.slice(2);
process.env.TMPDIR = join(process.cwd(), "temporary");
rmSync(process.env.TMPDIR, { recursive: true, force: true });
mkdirSync(process.env.TMPDIR);
const { cascade, address } = await serve(program, "spots.cascade");
const browser = await Browser.start(command, join(process.cwd(), "profile_of_models"));
const end = ending(browser, cascade);

const text = `document.getElementById("editor").shadowRoot.querySelector(".cm-content").innerText`;
const notice = `document.getElementById("notice").textContent`;
const is_read = `document.getElementById("text").ariaBusy === "false"`;
const is_solid = `!document.getElementById("solid").hidden`;

const type_script = (text) => browser.type_script(text);

/// Drops a file of these bytes on the canvas.
const drop = (name, bytes) => browser.evaluate(`{
    const dataTransfer = new DataTransfer();
    dataTransfer.items.add(new File([Uint8Array.from(atob("${Buffer.from(bytes).toString("base64")}"), (sign) => sign.charCodeAt(0))], ${JSON.stringify(name)}));
    for (const kind of ["dragover", "drop"]) document.getElementById("frame").dispatchEvent(new DragEvent(kind, { dataTransfer, bubbles: true, cancelable: true }));
}`);

/// A ball of triangles with so many comments that it is sent in several parts.
const octahedron = readFileSync(join(source, "tests/support/octahedron.off"), "utf8");
const large = octahedron + "# a comment\n".repeat(100000);

async function load() {
    await browser.call("Emulation.setDeviceMetricsOverride", { width: 1000, height: 640, deviceScaleFactor: 1, mobile: false });
    await browser.open(address);
    await browser.until(`document.querySelectorAll("#stages li").length === 2 && document.getElementById("step").disabled`);

    // Until the model is ready the page says what is being done, and afterwards nothing.
    await browser.evaluate(`{
        window.said = [];
        new MutationObserver(() => window.said.push(document.getElementById("preparing").textContent)).observe(document.getElementById("preparing"), { childList: true });
    }`);

    // By the button: the file becomes the domain in place of the grid, and the pattern grows on it. Another file with
    // this name is beside the script.
    writeFileSync("ball.off", "not this one");
    mkdirSync("elsewhere", { recursive: true });
    writeFileSync("elsewhere/ball.off", large);
    const { root } = await browser.call("DOM.getDocument");
    const { nodeId } = await browser.call("DOM.querySelector", { nodeId: root.nodeId, selector: "#model_file" });
    await browser.call("DOM.setFileInputFiles", { nodeId, files: [join(process.cwd(), "elsewhere/ball.off")] });
    await browser.until(`${text}.includes('domain { mesh: "ball-2.off"; cells: 20000 }') && ${is_read} && ${is_solid}`);
    await browser.until(`document.getElementById("step").disabled`);
    const said = await browser.evaluate(`window.said`);
    const parts = said.map((words) => Number(words.match(/^spreading 20,000 cells … (\d+) %$/)?.[1])).filter((part) => part >= 0);
    expect(parts.length > 2 && parts.every((part, k) => k === 0 || part >= parts[k - 1]) && said.at(-1) === "", `while it prepares the model, it says ${said}`);
    writeFileSync("loaded.png", await browser.screenshot());

    // A dropped file replaces the domain, whatever the comments of the script contain.
    const of = (domain) => readFileSync("spots.cascade", "utf8").replace("domain { grid: 48, 32 }", domain);
    const cases = [
        ['domain { surface: sphere; cells: 500 }', 'domain { mesh: "b_c.off"; cells: 500 }'],
        ['# domain { grid: 4 }\ndomain {\n  seed: 3 # grid: 7\n  surface: implicit(1 - x^2\n    - y^2 - z^2)   # a ball\n  cells: 400\n}', '  seed: 3 # grid: 7\n  mesh: "b_c.off"'],
        ['domain { cells: 300; seed: 2 }', 'domain { mesh: "b_c.off"; cells: 300; seed: 2 }'],
        ['domain {}', 'domain { mesh: "b_c.off"; cells: 20000 }'],
        ['# no domain', 'domain { mesh: "b_c.off"; cells: 20000 }\n# Spots in two stages.\n# no domain'],
    ];
    for (const [before, after] of cases) {
        await type_script(of(before));
        await drop("b c.off", octahedron);
        await browser.until(`${text}.replace(/\\n\\n/g, "\\n").includes(${JSON.stringify(after)}) && ${is_read}`);
        expect(await browser.evaluate(`document.getElementById("messages").textContent`) === "", `${before} becomes wrong`);
    }
    await browser.until(is_solid);

    // The model is also shown if no step follows.
    await browser.restart();
    await type_script(of("domain { surface: box(1, 1, 2); cells: 300 }"));
    await browser.until(`${is_solid} && document.getElementById("preparing").textContent === ""`);

    // A file that cannot be read gets one message, and the text does not change.
    const kept = await browser.evaluate(text);
    for (const [name, bytes, why] of [["notes.pdf", "%PDF", "is not a model"], ["broken.ply", "ply\nformat ascii 1.0\nelement vertex 4000000000\n", "'broken.ply'"],
        ["cut.glb", Buffer.from("676c5446020000000c000000", "hex"), "'cut.glb'"], ["empty.stl", "", "'empty.stl'"]]) {
        await drop(name, bytes);
        await browser.until(`${notice}.includes(${JSON.stringify(why)})`);
        expect(await browser.evaluate(text) === kept, `${name} has changed the text`);
    }
    const folders = readdirSync(process.env.TMPDIR).filter((name) => name.startsWith("cascade-") && !name.endsWith(".html"));
    expect(folders.length === 1 && readdirSync(join(process.env.TMPDIR, folders[0])).sort().join() === "b_c.off,ball-2.off", "other files are kept");

    const complaints = browser.heard.filter((words) => !words.startsWith("Applying inline style"));
    expect(complaints.length === 0, `the page complains: ${complaints.join("\n")}`);

    // The folder is removed when the program ends.
    cascade.kill("SIGINT");
    await browser.until(`${notice} === "Cascade has ended."`);
    await browser.eventually(() => !existsSync(join(process.env.TMPDIR, folders[0])), () => "the models of an ended session are left");
}

await load().then(() => end(), end);
