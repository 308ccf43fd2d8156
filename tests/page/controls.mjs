// Every control and every key of the page does what it says, on the page of `cascade view` and on a
// page that carries its engine. A control that no step below operates is an error. Arguments: the
// browser, the program and, to test an exported page, that page. The run is paused, so that the
// picture changes only by the tested actions.
import { rmSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { Browser, ending, expect, is_growing, serve } from "./browser.mjs";

const [command, program, exported] = process.argv.slice(2);
const { cascade, address } = exported ? { address: pathToFileURL(exported).href } : await serve(program);
const folder = join(process.cwd(), "saved_controls");
rmSync(folder, { recursive: true, force: true });
const browser = await Browser.start(command, join(process.cwd(), `profile_of_controls${exported ? "_2" : ""}`));
const end = ending(browser, ...(cascade ? [cascade] : []));

const spots = `domain { grid: 24, 16 }
system spots {
  u: x
  v: y
  feed: 0.03 in 0 .. 0.1
  u' = 0.1 * lap(u) + feed / 100
  v' = 0.1 * lap(v)
}
stage one: spots { iterations: 100000000 }
stage two: spots { u: u; v: v; iterations: 40; show: u }
`;
const volume = `domain { grid: 12, 10, 8 }\nsystem still { u: x * y + z; u' = 0 }\nstage one: still { iterations: 1 }\n`;
const tube = `domain { grid: 48, 16; surface: cos(2*pi*sx), sin(2*pi*sx), 2 * sy }\nsystem still { u: sx; u' = 0 }\nstage one: still { iterations: 1 }\n`;

/// Selectors of the controls that were operated, and the keys that were pressed, as the help names them.
const operated = ["#lesson summary", "#point"], pressed = ["k"];  // Operated by lesson.mjs and points.mjs.

const found = (selector) => `document.querySelector(${JSON.stringify(selector)})`;
async function click(selector) {
    operated.push(selector);
    await browser.click(selector);
}
/// Gives an input or a menu a value, as a user would.
async function choose(selector, value) {
    operated.push(selector);
    await browser.evaluate(`{
        const input = ${found(selector)};
        if (input.type === "checkbox") input.checked = ${JSON.stringify(value)}; else input.value = ${JSON.stringify(value)};
        for (const type of ["input", "change"]) input.dispatchEvent(new Event(type, { bubbles: true }));
    }`);
}
const codes = { "+": 187, "-": 189, "0": 48, F2: 113, F12: 123, PageUp: 33, PageDown: 34, h: 72, m: 77, n: 78, p: 80, "?": 191 };
/// Presses a key. Unless `in_text`, the text first loses the focus. `name` is the key's name in the
/// help.
async function press(key, name = key, modifiers = 0, in_text = false) {
    pressed.push(name);
    if (!in_text) await browser.evaluate("document.activeElement.blur()");
    const text = key.length === 1 && modifiers < 2 ? key : undefined;
    const code = codes[key];
    if (code === undefined) return browser.press(key, modifiers);
    for (const type of ["keyDown", "keyUp"]) await browser.call("Input.dispatchKeyEvent", { type, key, text, modifiers, windowsVirtualKeyCode: code });
}

/// A hash of the picture of the plane.
const seen = () => browser.evaluate(`(() => {
    const canvas = document.getElementById("pattern"), copy = document.createElement("canvas");
    [copy.width, copy.height] = [canvas.width, canvas.height];
    copy.getContext("2d").drawImage(canvas, 0, 0);
    return copy.getContext("2d").getImageData(0, 0, copy.width, copy.height).data.reduce((sum, level) => (31 * sum + level) % 1000000007, copy.width);
})()`);
/// Does something that must change the picture.
async function changes(what, act) {
    const before = await seen();
    await act();
    await browser.eventually(async () => await seen() !== before, () => `${what} changes no picture`, 60);
}

const place = `document.getElementById("place").textContent`;
const current = `${found("#stages [aria-current=step]")}?.textContent`;
const in_editor = (selector) => `document.getElementById("editor").shadowRoot.querySelector("${selector}")`;
const is_pressed = (id) => `document.getElementById("${id}").ariaPressed === "true"`;
const type = async (text, stages) => {
    await browser.type_script(text);
    await browser.until(`document.getElementById("messages").textContent === "" && document.querySelectorAll("#stages li").length === ${stages}`);
};

async function run() {
    await type(spots, 2);
    await browser.restart();
    await click("#step");
    await browser.until(`${place} === "step 1"`);
    await press(".");
    await browser.until(`${place} === "step 2"`);
    for (const act of [() => click("#run"), () => press(" ", "Space")]) {
        await act();
        await browser.until(is_growing);
        await act();
        await browser.until(`!(${is_growing})`);
    }
    for (const [on, back] of [[() => click("#next"), () => click("#restart")], [() => press("n"), () => press("Home")], [() => press("n"), () => click("#stages button")]]) {
        await on();
        await browser.until(`${current} === "two"`);
        await back();
        await browser.until(`${current} === "one" && ${place} === "step 0"`);
    }
    await choose("#speed", "1.5");
    expect(await browser.evaluate(`localStorage.getItem("speed")`) === "1.5", "the speed is forgotten");
    await choose("#speed", "5");
}

async function change_numbers() {
    const [typed, slider] = ["#controls .slider input:not([type=range])", "#controls .slider input[type=range]"];
    const until = (value) => browser.until(`${found(slider)}.value === "${value}" && ${found(typed)}.value === "${value}" && !("isBusy" in ${found(slider)}.dataset)`);
    await choose(typed, "0.05");
    await until("0.05");
    await choose(slider, "0.06");
    await until("0.06");
    // A change can be undone only after the engine has shown it.
    await browser.until(`!document.getElementById("undo").disabled`);
    for (const [back, again] of [[() => click("#undo"), () => click("#redo")], [() => press("z", "Ctrl+Z", 2), () => press("Z", "Ctrl+Shift+Z", 10)]]) {
        await back();
        await until("0.05");
        await browser.until(`!document.getElementById("redo").disabled`);
        await again();
        await until("0.06");
        await browser.until(`document.getElementById("redo").disabled && !document.getElementById("undo").disabled`);
    }
}

async function look() {
    await choose("#brush", await browser.evaluate(`document.getElementById("brush").options[0].value`));
    await choose("#amount", "3");
    operated.push("#pattern");
    const [x, y] = await browser.evaluate(`(({ x, y, width, height }) => [x + width / 2, y + height / 2])(document.getElementById("pattern").getBoundingClientRect())`);
    await changes("a stroke", () => browser.drag(x, y, x + 20, y));
    await changes("undo", () => click("#undo"));

    for (const [selector, value, back] of [["#palette", "leopard", "grey"], ["#low", "-1", ""], ["#high", "2", ""], ["#every", "0.1", ""],
        ["#at", "0.5", ""], ["#relief", "1", "0"], ["#squares", false, true], ["#show", "u * u", ""]]) {
        await changes(selector, () => choose(selector, value));
        await changes(`${selector} back`, () => choose(selector, back));
    }
    for (const act of [() => click("#hold"), () => press("h")]) {
        await act();
        await browser.until(is_pressed("hold"));
        await act();
        await browser.until(`!(${is_pressed("hold")})`);
    }
    for (const id of ["look", "save"]) {
        await click(`#${id} > summary`);
        await browser.until(`document.getElementById("${id}").open`);
        await press("Escape");
        await browser.until(`!document.getElementById("${id}").open`);
    }
    const is_moved = `document.getElementById("frame").hasAttribute("data-zoomed")`;
    for (const [on, back] of [[() => press("+"), () => press("0")], [() => press("+"), () => click("#fit")], [() => press("+"), () => press("-")]]) {
        await on();
        await browser.until(is_moved);
        await back();
        await browser.until(`!${is_moved}`);
    }
}

async function measure() {
    const panel = `document.getElementById("measure").open`, caption = (id) => `document.querySelector("#${id} figcaption").textContent`;
    await click("#measure > summary");
    await browser.until(panel);
    await press("m");
    await browser.until(`!${panel}`);
    await press("m");
    await browser.until(`${panel} && ${caption("histogram")} === "cells by u"`);
    await choose("#of_x", "v");
    await choose("#of_y", "u");
    await browser.until(`${caption("histogram")} === "cells by v" && ${caption("phase")} === "u over v"`);
    await press("p");
    await browser.until(is_pressed("pick"));
    await click("#pick");
    await browser.until(`!(${is_pressed("pick")})`);
    await click("#pick");
    const [x, y] = await browser.evaluate(`(({ x, y, width, height }) => [x + width / 4, y + height / 2])(document.getElementById("pattern").getBoundingClientRect())`);
    await browser.drag(x, y, x, y);
    await browser.until(`${caption("probe")}.startsWith("cell ") && !(${is_pressed("pick")})`);
    await press("m");
}

async function save() {
    await browser.call("Browser.setDownloadBehavior", { behavior: "allow", downloadPath: folder });
    const name = await browser.evaluate(`document.getElementById("name").textContent.replace(/\\.cascade$/, "")`);
    for (const [id, end] of [["picture", ".png"], ["script", ".cascade"], ["log", ".session"]]) {
        await click(`#${id}`);
        await browser.file(join(folder, name + end));
    }
    for (const [id, end] of [["model", ".glb"], ["maps", "_maps.zip"]]) {
        await click(`#${id}`);
        if (exported) await browser.until(`document.getElementById("notice").textContent.startsWith("a page that runs without the program cannot write models")`);
        else await browser.file(join(folder, name + end));
        await browser.evaluate(`document.getElementById("notice").textContent = ""`);
    }
    for (const [id, end] of [["frames", "_frames.zip"], ["movie", ".webm"]]) {
        await click(`#${id}`);
        await browser.until(is_pressed(id));
        const before = await browser.evaluate(place);
        await click("#step");
        await browser.until(`${place} !== "${before}"`);
        await click(`#${id}`);
        await browser.file(join(folder, name + end));
        await browser.until(`!(${is_pressed(id)})`);
    }
    await click("#link");
    await browser.until(`document.getElementById("link_dialog").open`);
    operated.push("#link_dialog input");
    expect((await browser.evaluate(`${found("#link_dialog input")}.value`)).includes("script="), "the link has no script");
    await browser.evaluate(`document.querySelector("#link_dialog p").textContent = ""`);
    await click("#link_dialog button[type=button]");
    await browser.until(`document.querySelector("#link_dialog p").textContent !== ""`);
    await click("#link_dialog button[autofocus]");
    await browser.until(`!document.getElementById("link_dialog").open`);
    operated.push("#load", "#model_file");  // models.mjs loads files.
    expect(await browser.evaluate(`document.getElementById("load").hidden`) === Boolean(exported), "the button for models is on the wrong page");
    if (!exported) expect(await browser.evaluate(`{ let is_asked; document.getElementById("model_file").click = () => (is_asked = true); document.getElementById("load").click(); is_asked; }`), "no file is asked for");
}

async function help() {
    const is_open = `document.getElementById("help").open`, tour = `document.getElementById("tour")`;
    await press("?");
    await browser.until(is_open);
    await click("#help button[autofocus]");
    await browser.until(`!${is_open}`);
    await click("#help_button");
    await browser.until(is_open);
    await click("#help button[type=button]");
    await browser.until(`!${is_open} && ${tour}.textContent.includes("1 of 4")`);
    await click("#tour_next");
    await browser.until(`${tour}.textContent.includes("2 of 4")`);
    await click("#tour_end");
    await browser.until(`${tour}.hidden`);
    await choose("#language", "de");
    await browser.until(`document.getElementById("fit").textContent === "einpassen"`);
    await choose("#language", "en");
    await browser.until(`document.getElementById("fit").textContent === "fit"`);
}

/// Keys in the text, the correction of a message, and the button after a failure.
async function write() {
    await browser.evaluate(`${in_editor(".cm-content")}.focus()`);
    // The caret is at the end. It goes three characters back, onto a name.
    await type(spots, 2);
    for (let k = 0; k < 3; ++k) await browser.press("ArrowLeft");
    await browser.until(`${in_editor(".cm-used")} !== null`);
    await press("F2", "F2", 0, true);
    await browser.until(`${in_editor(".cm-new-name")} !== null`);
    await press("Escape", "Escape", 0, true);
    await browser.until(`${in_editor(".cm-new-name")} === null`);
    const line = `document.getElementById("editor").shadowRoot.getSelection().anchorNode.parentElement.closest(".cm-line").textContent`;
    await press("F12", "F12", 0, true);
    await browser.until(`${line}.trim() === "u: x"`);
    await press("Escape", "Escape", 0, true);
    await browser.until(`document.activeElement.id !== "editor"`);

    await browser.type_script(spots.replace("lap(u)", "lapp(u)"));
    await click("#messages button");
    await browser.until(`document.getElementById("messages").textContent === "" && ${in_editor(".cm-content")}.textContent.includes("0.1 * lap(u)")`);
    await type(spots.replace("0.1 * lap(u)", "1000 * u^3"), 2);
    await browser.grow();
    await browser.until(`!document.getElementById("failure").hidden`);
    await click("#failure button");
    await browser.until(`document.getElementById("failure").hidden`);
}

async function look_into_space() {
    await type(volume, 1);
    const slice = "#slice input";
    await browser.until(`!document.getElementById("slice").hidden`);
    await changes("the axis", () => choose("#slice select", "y"));
    await browser.until(`${found(slice)}.value === "5" && ${found(slice)}.title === "slice 6 of 10"`);
    await changes("the slice", () => choose(slice, "3"));
    await browser.until(`${found(slice)}.title === "slice 4 of 10"`);
    for (const [key, name, number] of [["PageDown", "Page Down", 5], ["PageUp", "Page Up", 4]]) {
        await press(key, name);
        await browser.until(`${found(slice)}.title === "slice ${number} of 10"`);
    }
    await type(tube, 1);
    const is_solid = `!document.getElementById("solid").hidden && document.getElementById("pattern").hidden`;
    await browser.until(`${is_solid} && !document.getElementById("flat").hidden`);
    for (const is_flat of [true, false]) {
        await click("#flat");
        await browser.until(is_flat ? `!(${is_solid})` : is_solid);
    }
    operated.push("#solid");
    await press("ArrowRight", "Arrows");
    await browser.until(`document.getElementById("frame").hasAttribute("data-moved")`);
}

async function choose_a_system() {
    const shown = `[...document.querySelectorAll("#library li")].filter((item) => item.offsetParent).length`;
    await click("#systems");
    await browser.until(`document.getElementById("library").open && ${shown} > 50`);
    for (const pressed of [true, false]) {
        await click("#library .like");
        await browser.until(`${found("#library .like")}.ariaPressed === "${pressed}" || ${pressed ? "false" : `document.querySelector("#library .like[aria-pressed=true]") === null`}`);
    }
    await click("#library .more");
    await browser.until(`${shown} === 12`);
    await click("#library p button");
    await browser.until(`${shown} > 50`);
    await choose("#library [type=search]", "burgers");
    await browser.until(`${shown} < 5`);
    await click("#library li:not([hidden]) .card");
    operated.push("#library .card");
    await browser.until(`!document.getElementById("library").open && ${in_editor(".cm-content")}.textContent.includes("burgers")`);
}

/// On a phone, the head of the page is one line above the stages, and nothing is too wide.
async function hold_a_phone() {
    await browser.call("Emulation.setDeviceMetricsOverride", { width: 375, height: 812, deviceScaleFactor: 1, mobile: true });
    const of = (id) => `document.getElementById("${id}").getBoundingClientRect()`;
    await browser.until(`innerWidth === 375 && ${of("help_button")}.top < ${of("systems")}.bottom`);
    const width = await browser.evaluate("document.documentElement.scrollWidth");
    expect(width <= 375, `on a phone the page is ${width} pixels wide`);
}

/// Fails if nothing above has operated a control or pressed a key that the help names.
async function expect_all() {
    const left = await browser.evaluate(`[...document.querySelectorAll("button, select, input, summary, canvas[tabindex]")]
        .filter((control) => !${JSON.stringify(operated)}.some((selector) => control.matches(selector)))
        .map((control) => control.id || \`\${control.closest("[id]").id}: \${control.outerHTML.slice(0, 80)}\`).join("\\n")`);
    expect(left === "", `these controls are not tried: ${left}`);
    const keys = await browser.evaluate(`[...document.querySelectorAll("#help dt")].map(({ textContent }) => textContent)`);
    const others = keys.filter((key) => !pressed.includes(key));
    expect(keys.length > 12 && others.length === 0, `these keys are not tried: ${others}`);
}

try {
    await browser.call("Emulation.setDeviceMetricsOverride", { width: 1280, height: 800, deviceScaleFactor: 1, mobile: false });
    await browser.open(address);
    await browser.until(exported ? `${place} !== ""` : `document.getElementById("library")?.open && document.querySelectorAll("#library li").length > 50`);
    if (!exported) await browser.press("Escape");
    for (const part of [run, change_numbers, look, measure, save, help, write, look_into_space, choose_a_system, hold_a_phone, expect_all]) await part();
    const complaints = browser.heard.filter((words) => !words.startsWith("Applying inline style"));
    expect(complaints.length === 0, `the page complains: ${complaints.join("\n")}`);
    await end();
} catch (error) {
    await end(error);
}
