// Names in the text on the page of `cascade view spots.cascade`: their uses, their declaration, and
// renaming. A text, a number and a stroke may also arrive just as a run ends. Arguments: the
// browser and the program; spots.cascade is in the current folder. Screenshots are left there.
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { Browser, ending, expect, is_growing, serve } from "./browser.mjs";

const [command, program] = process.argv.slice(2);
const { cascade, address } = await serve(program, "spots.cascade");
const browser = await Browser.start(command, join(process.cwd(), "profile_of_names"));
const end = ending(browser, cascade);

const own = readFileSync("spots.cascade", "utf8");
const in_editor = (selector) => `document.getElementById("editor").shadowRoot.querySelector("${selector}")`;
const text = () => browser.evaluate(`${in_editor(".cm-content")}.innerText.replace(/\\n\\n/g, "\\n")`);
const lines_of_uses = `[...document.getElementById("editor").shadowRoot.querySelectorAll(".cm-used")].map((word) => \`\${word.textContent} \${[...document.getElementById("editor").shadowRoot.querySelectorAll(".cm-line")].indexOf(word.closest(".cm-line")) + 1}\`).join()`;
const selected = `document.getElementById("editor").shadowRoot.getSelection?.().toString() ?? getSelection().toString()`;
const key = async (key, code) => {
    for (const type of ["keyDown", "keyUp"]) await browser.call("Input.dispatchKeyEvent", { type, key, code: key, windowsVirtualKeyCode: code });
};

/// Where a word of a line is in the window.
const place_of = (line, word) => browser.evaluate(`{
    const found = document.getElementById("editor").shadowRoot.querySelectorAll(".cm-line")[${line - 1}];
    const walker = document.createTreeWalker(found, NodeFilter.SHOW_TEXT), range = document.createRange();
    let place;
    for (let node = walker.nextNode(); node && !place; node = walker.nextNode()) {
        const at = node.data.indexOf("${word}");
        if (at < 0) continue;
        range.setStart(node, at), range.setEnd(node, at + ${word.length});
        const { x, y, width, height } = range.getBoundingClientRect();
        place = [x + width / 4, y + height / 2];
    }
    place;
}`);
async function press_at(line, word, modifiers = 0) {
    const [x, y] = await place_of(line, word);
    for (const type of ["mousePressed", "mouseReleased"]) await browser.call("Input.dispatchMouseEvent", { type, x, y, button: "left", clickCount: 1, modifiers });
}

async function names() {
    // If the cursor is on a name, all places where the name means the same are marked, here in the
    // system and in a stage.
    await press_at(8, "feed");
    await browser.until(`${lines_of_uses} === "feed 6,feed 8,feed 9,feed 12"`);
    writeFileSync("uses.png", await browser.screenshot());

    // Ctrl with a click goes to the declaration, and so does F12.
    await press_at(9, "kill", 2);
    await browser.until(`${lines_of_uses} === "kill 7,kill 9"`);
    await press_at(12, "spots");
    await key("F12", 123);
    await browser.until(`${lines_of_uses}.startsWith("spots 3")`);

    // F2 renames the name at the cursor, and one undo restores it. A new name that already means
    // something else is refused.
    const rename = async (name) => {
        await key("F2", 113);
        await browser.until(`${in_editor(".cm-new-name")} !== null && document.getElementById("editor").shadowRoot.activeElement?.matches(".cm-new-name")`);
        await browser.evaluate(`${in_editor(".cm-new-name")}.value = "${name}"`);
        await browser.press("Enter");
    };
    await press_at(8, "feed");
    await browser.until(`${lines_of_uses}.startsWith("feed 6")`);
    await rename("v");
    await browser.until(`document.getElementById("notice").textContent.includes("'v'")`);
    expect((await text()).trim() === own.trim(), "a refused name has changed the text");
    writeFileSync("rename.png", await browser.screenshot());
    await browser.press("Escape");
    await browser.until(`${in_editor(".cm-new-name")} === null`);
    await rename("supply");
    await browser.until(`${in_editor(".cm-content")}.innerText.includes("supply: 0.037 in") && document.getElementById("text").ariaBusy === "false"`);
    expect((await text()).trim() === own.replaceAll("feed", "supply").trim(), `it is renamed to ${await text()}`);
    await browser.until(`document.querySelector("#controls .slider")?.textContent.includes("supply")`);
    await press_at(8, "supply");
    await browser.press("z", 2);
    await browser.until(`document.getElementById("text").ariaBusy === "false" && ${in_editor(".cm-content")}.innerText.includes("feed: 0.037 in")`);

    // For a name that the library declares, the page says where it is declared.
    await browser.type_script("stage one: gray_scott { feed: 0.03; iterations: 20 }\n");
    await press_at(1, "feed", 2);
    await browser.until(`document.getElementById("notice").textContent.includes("'feed' is declared in")`);
}

/// Asks the engine for its present moment, whether or not the page has seen this moment.
const moment = () => browser.evaluate(`new Promise((resolve) => {
    const id = window.asked = (window.asked ?? 1e9) + 1;
    window.socket.addEventListener("message", function look({ data }) {
        if (typeof data !== "string" || JSON.parse(data).id !== id) return;
        window.socket.removeEventListener("message", look);
        resolve([JSON.parse(data).stage, JSON.parse(data).steps].join());
    });
    window.socket.send(JSON.stringify({ do: "values", id, cell: -1 }));
})`);

/// The first stage does not end by itself.
const long = own.replace("iterations: 1500", "iterations: 100000000");

/// Calls `change` after the run has ended but before the page sees the end, and then lets the page
/// see it.
async function at_the_end(change) {
    await browser.type_script(long);
    await browser.restart();
    await browser.grow();
    await browser.until(`${is_growing} && !document.getElementById("place").textContent.startsWith("step 0")`);
    // From now on the page receives nothing. Meanwhile the first stage is ended by a command, and
    // the second stage runs to its end.
    await browser.evaluate("window.is_held = true, window.release = undefined");
    await browser.until("window.release !== undefined");
    await browser.click("#next");
    let now;
    await browser.eventually(async () => (now = await moment()) === "2,500", () => `the run is at ${now}`);
    expect(await browser.evaluate(is_growing), "the page has seen the end");
    await change();
    await browser.evaluate("window.is_held = false, window.release()");
}

async function late() {
    const place = `document.getElementById("place").textContent`;
    await at_the_end(async () => {
        await browser.evaluate("window.is_text_read = false");
        await browser.type_script(long.replace("iterations: 500", "iterations: 1200"), false);
        await browser.until("window.is_text_read");
    });
    await browser.until(`${place} === "step 1,200"`);
    await at_the_end(async () => {
        await browser.evaluate(`{ const input = document.querySelector("#controls [type=range]"); input.value = "0.03"; input.dispatchEvent(new Event("input")); input.dispatchEvent(new Event("change")); }`);
        await browser.until(`!("isBusy" in document.querySelector("#controls [type=range]").dataset)`);
    });
    // The second stage is lengthened by the steps of all stages.
    await browser.until(`document.querySelectorAll("#stages button")[1].ariaCurrent === "step" && !/^step 500\\b/.test(${place}) && ${is_growing}`);
}

async function steer() {
    await browser.call("Page.addScriptToEvaluateOnNewDocument", { source: `{
        const send = WebSocket.prototype.send;
        WebSocket.prototype.send = function (text) {
            window.socket = this;
            if (window.is_held && text.includes("next_snapshot")) return void (window.release = () => send.call(this, text));
            const { do: what, id } = JSON.parse(text);
            if (what === "text") this.addEventListener("message", ({ data }) => typeof data === "string" && JSON.parse(data).id === id && (window.is_text_read = true));
            send.call(this, text);
        };
    }` });
    await browser.call("Emulation.setDeviceMetricsOverride", { width: 1280, height: 800, deviceScaleFactor: 1, mobile: false });
    await browser.open(address);
    await browser.until(`document.querySelectorAll("#stages li").length === 2 && document.getElementById("step").disabled`);
    await names();
    await late();
    const complaints = browser.heard.filter((words) => !words.startsWith("Applying inline style"));
    expect(complaints.length === 0, `the page complains: ${complaints.join("\n")}`);
}

await steer().then(() => end(), end);
