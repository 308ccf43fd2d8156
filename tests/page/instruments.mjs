// The instruments of the page of `cascade view spots.cascade`: what helps to write, to look closely and to measure.
// Arguments: the browser and the program. Screenshots are left in the current folder.
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { Browser, serve } from "./browser.mjs";

const [command, program] = process.argv.slice(2);
const { cascade, address } = await serve(program, "spots.cascade");
const browser = await Browser.start(command, join(process.cwd(), "profile_of_instruments"));
const limit = setTimeout(() => end(new Error("it took more than 4 minutes")), 240000);
const text = readFileSync("spots.cascade", "utf8");

async function end(error) {
    clearTimeout(limit);
    if (error) {
        console.log(error.stack);
        writeFileSync("failed.png", await browser.screenshot().catch(() => ""));
        if (browser.heard.length > 0) console.log(browser.heard.join("\n"));
    }
    browser.end();
    cascade.kill("SIGKILL");
    process.exit(error ? 1 : 0);
}

function expect(condition, message) { if (!condition) throw new Error(message); }
const click = (id) => browser.evaluate(`document.getElementById("${id}").click()`);
const until_steps = (count) => browser.until(`document.getElementById("place").textContent.startsWith("step ${count}")`);
const choose = (id, value, what = "change") => browser.evaluate(
    `{ const input = document.getElementById("${id}"); input.value = ${JSON.stringify(value)}; input.dispatchEvent(new Event("${what}", { bubbles: true })); }`);
const size = (width, height = 800) => browser.call("Emulation.setDeviceMetricsOverride", { width, height, deviceScaleFactor: 1, mobile: width < 500 });

/// What is in the shadow tree of the editor.
const in_editor = (selector) => `document.getElementById("editor").shadowRoot.querySelector("${selector}")`;

/// Replaces the script as if it were typed.
async function type_script(script) {
    await browser.evaluate(`${in_editor(".cm-content")}.focus()`);
    await browser.call("Input.dispatchKeyEvent", { type: "keyDown", key: "a", modifiers: 2, windowsVirtualKeyCode: 65, commands: ["selectAll"] });
    await browser.call("Input.insertText", { text: script });
}
const until_text_is_read = () => browser.until(`document.getElementById("text").ariaBusy === "false"`);

async function help_with_the_text() {
    const options = `[...document.getElementById("editor").shadowRoot.querySelectorAll(".cm-tooltip-autocomplete li")].map((option) => option.textContent)`;
    await type_script(`${text}picture { co`);
    await browser.until(`(${options})[0]?.startsWith("color")`);
    await browser.call("Input.insertText", { text: `lor: palette(v, 0, 1, "` });
    await browser.call("Input.insertText", { text: "leo" });
    // Without a letter before it nothing comes by itself.
    await browser.press(" ", 2);
    await browser.until(`(${options})[0]?.startsWith("leopard")`);
    writeFileSync("completion.png", await browser.screenshot());
    await browser.press("Enter");
    await browser.until(`${in_editor(".cm-content")}.textContent.includes("leopard")`);
    await browser.press("Escape");
    await type_script(text);
    await until_text_is_read();

    // The rate, with its value now and its equation, where the pointer rests on a name.
    const line = await browser.evaluate(`(({ x, y, height }) => [x, y + height / 2])([...document.getElementById("editor").shadowRoot.querySelectorAll(".cm-line")].find((line) => line.textContent.includes("v' =")).getBoundingClientRect())`);
    await browser.call("Input.dispatchMouseEvent", { type: "mouseMoved", x: line[0] + 27, y: line[1] });
    await browser.until(`${in_editor(".explanation math")} !== null`);
    const told = await browser.evaluate(`${in_editor(".explanation")}.textContent`);
    expect(told.startsWith("v species") && told.includes("now from 0") && told.includes("feed"), `v is explained as ${told}`);
    writeFileSync("explanation.png", await browser.screenshot());
    await browser.call("Input.dispatchMouseEvent", { type: "mouseMoved", x: 5, y: 5 });
}

async function use() {
    await size(1400, 900);
    await browser.call("Page.navigate", { url: address });
    await browser.until(`document.querySelectorAll("#stages li").length === 2`);
    await help_with_the_text();

    const complaints = browser.heard.filter((words) => !words.startsWith("Applying inline style"));
    expect(complaints.length === 0, `the page complains: ${complaints.join("\n")}`);
}

await use().then(() => end(), end);
