// Follows docs/tutorial.md on the page of `cascade view` as its readers do, with the script in it. Arguments: the
// browser, the program and the tutorial. The pictures of the tutorial, which page/tutorial_pictures.sh uses, and the
// files saved by the page are left in the current folder.
import { readFileSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { Browser, ending, is_growing, serve } from "./browser.mjs";

const [command, program, tutorial] = process.argv.slice(2);
const { cascade, address } = await serve(program);
const browser = await Browser.start(command, join(process.cwd(), "profile_of_tutorial"));
const end = ending(browser, cascade);
const script = readFileSync(tutorial, "utf8").match(/^```cascade\n(.*?)^```/ms)[1];

const sleep = (seconds) => new Promise((resolve) => setTimeout(resolve, 1000 * seconds));
const click = (id) => browser.click(`#${id}`);
const reached = `Number(document.getElementById("place").textContent.match(/[\\d,]+/)[0].replaceAll(",", ""))`;
const steps = () => browser.evaluate(reached);
const until_steps = (count) => browser.until(`${reached} >= ${count}`);
const move = (slider, value) => browser.evaluate(`{ const input = document.querySelector("${slider}"); input.value = "${value}"; input.dispatchEvent(new Event("input")); input.dispatchEvent(new Event("change")); }`);
const in_editor = (selector) => `document.getElementById("editor").shadowRoot.querySelector("${selector}")`;
const is_over = `[...document.querySelectorAll("#stages progress")].every(({ value }) => value === 1)`;
const at_stage = (number) => `document.querySelectorAll("#stages button")[${number - 1}]?.hasAttribute("aria-current")`;
const save_picture = async (name) => writeFileSync(`${name}.webp`,
    Buffer.from((await browser.call("Page.captureScreenshot", { format: "webp", quality: 80 })).data, "base64"));
const key = async (name) => { await browser.evaluate("document.activeElement.blur()"); await browser.press(name); };

/// Searches for words, and chooses the system of this name.
async function choose(words, name) {
    await browser.until(`document.getElementById("library").open`);
    await browser.call("Input.insertText", { text: words });
    await browser.evaluate(`[...document.querySelectorAll("#library li:not([hidden])")].find((item) => item.querySelector("b").textContent === "${name}").querySelector("button").click()`);
    await browser.until(`!document.getElementById("library").open`);
}

async function type_script(text) {
    await browser.type_script(text);
    await browser.until(`document.getElementById("messages").textContent === ""`);
    await browser.evaluate("document.activeElement.blur()");
}

async function saved(id, name) {
    rmSync(name, { force: true });
    await click(id);
    await browser.file(name);
}

async function follow() {
    await browser.call("Emulation.setDeviceMetricsOverride", { width: 1200, height: 760, deviceScaleFactor: 1, mobile: false });
    await browser.open(address);
    await browser.until(`document.querySelectorAll("#library li").length > 50`);
    await choose("gray", "Gray-Scott");
    await browser.until(`document.getElementById("stages").textContent === "maze"`);
    await click("tour_end");
    await until_steps(4000);

    // As the tutorial says, parameters can be changed while the pattern grows or after its end.
    await browser.until(is_over);
    await move("#speed", 2);
    await move("#controls .slider:nth-of-type(2) [type=range]", 0.063);
    await until_steps(17000);
    await browser.evaluate(`${is_growing} && document.getElementById("run").click()`);
    await browser.until(`!(${is_growing})`);
    if (await steps() < 17000) throw new Error("it has not gone on after its end");
    const [x, y, side] = await browser.evaluate(`(({ x, y, width }) => [x, y, width])(document.getElementById("pattern").getBoundingClientRect())`);
    for (const [kind, along] of [["mousePressed", 0], ...Array.from({ length: 24 }, (_, k) => ["mouseMoved", k / 24]), ["mouseReleased", 1]]) {
        await browser.call("Input.dispatchMouseEvent", { type: kind, button: "left", buttons: 1, clickCount: 1,
            x: x + (0.25 + 0.5 * along) * side, y: y + (0.7 - 0.2 * Math.sin(3 * along)) * side });
    }
    await sleep(1);
    await save_picture("change");
    await browser.press("z", 2);
    await browser.press("z", 2);
    await browser.until(`document.querySelector("#controls .slider:nth-of-type(2) input").value === "0.06"`);
    await browser.until(`document.getElementById("place").textContent === "step 12,000"`);
    await browser.press("Z", 10);
    await browser.until(`document.querySelector("#controls .slider:nth-of-type(2) input").value === "0.063"`);

    // Read.
    const [left, middle] = await browser.evaluate(`(({ x, y }) => [x, y + 10])([...document.getElementById("editor").shadowRoot.querySelectorAll(".cm-line")].find((line) => line.textContent.includes("v' =")).getBoundingClientRect())`);
    await browser.call("Input.dispatchMouseEvent", { type: "mouseMoved", x: left + 26, y: middle });
    await browser.until(`${in_editor(".explanation math")} !== null`);
    await save_picture("read");
    await browser.call("Input.dispatchMouseEvent", { type: "mouseMoved", x: 5, y: 5 });

    // Changes the feed rate, as in the tutorial.
    const lines = await browser.evaluate(`[...${in_editor(".cm-content")}.querySelectorAll(".cm-line")].map((line) => line.textContent).join("\\n")`);
    await type_script(lines.replace("feed * (1 - u)", "feed * (1 - u) * (0.5 + x)"));
    const start = await steps();
    await browser.press(" ");
    await until_steps(start + 500);
    if (!(await browser.evaluate(`document.getElementById("failure").hidden`))) throw new Error("the rate of the tutorial blows up");

    // A cascade: the second stage is typed after the first has ended, and grows without a click.
    await move("#speed", 5);
    await click("systems");
    await choose("turing", "Turing's spots");
    await browser.until(`document.getElementById("stages").textContent === "spots"`);
    await browser.until(is_over);
    const spots_alone = await steps();
    await move("#speed", 3);
    await type_script(script);
    await browser.until(`document.querySelectorAll("#stages li").length === 2 && ${is_over}`);
    if (spots_alone !== 12000 || await steps() !== 4000) throw new Error("the stages have other lengths");
    await save_picture("cascade");

    // Back to the first stage, which is ended early.
    await browser.evaluate(`document.querySelector("#stages button").click()`);
    await browser.until(at_stage(1));
    await key(" ");
    await until_steps(500);
    await key("n");
    await browser.until(at_stage(2));
    await browser.evaluate(`document.querySelector("#stages button").click()`);
    await browser.until(at_stage(1));
    await move("#speed", 5);
    await browser.grow();
    await browser.until(is_over);

    await browser.call("Browser.setDownloadBehavior", { behavior: "allow", downloadPath: process.cwd() });
    for (const [id, name] of [["picture", "new.png"], ["script", "new.cascade"], ["log", "new.session"]]) await saved(id, name);
    if (readFileSync("new.cascade", "utf8") !== script) throw new Error("the script that was saved is another one");

    // The pattern on an animal.
    await type_script(script.replace(/^domain .*$/m, "domain { surface: creature; cells: 8000 }"));
    await browser.until(`!document.getElementById("solid").hidden && ${at_stage(2)} && ${is_over}`);
    await sleep(4);
    await save_picture("animal");
}

await follow().then(() => end(), end);
