// The instruments of the page of `cascade view spots.cascade`: help for writing, the view of values, and plots.
// Arguments: the browser and the program. Screenshots are left in the current folder.
import { spawnSync } from "node:child_process";
import { readFileSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { Browser, ending, expect, serve } from "./browser.mjs";

const [command, program] = process.argv.slice(2);
const { cascade, address } = await serve(program, "spots.cascade");
const browser = await Browser.start(command, join(process.cwd(), "profile_of_instruments"));
const end = ending(browser, cascade);
const text = readFileSync("spots.cascade", "utf8");

const click = (id) => browser.click(`#${id}`);
const until_steps = (count) => browser.until(`document.getElementById("place").textContent.startsWith("step ${count}")`);
const choose = (id, value, what = "change") => browser.evaluate(
    `{ const input = document.getElementById("${id}"); input.value = ${JSON.stringify(value)}; input.dispatchEvent(new Event("${what}", { bubbles: true })); }`);
const size = (width, height = 800) => browser.call("Emulation.setDeviceMetricsOverride", { width, height, deviceScaleFactor: 1, mobile: width < 500 });

/// An expression for an element in the shadow tree of the editor.
const in_editor = (selector) => `document.getElementById("editor").shadowRoot.querySelector("${selector}")`;

const type_script = (script) => browser.type_script(script, false);
const until_text_is_read = () => browser.until(`document.getElementById("text").ariaBusy === "false"`);

async function help_with_the_text() {
    const options = `[...document.getElementById("editor").shadowRoot.querySelectorAll(".cm-tooltip-autocomplete li")].map((option) => option.textContent)`;
    await type_script(`${text}picture { co`);
    await browser.until(`(${options})[0]?.startsWith("color")`);
    await browser.call("Input.insertText", { text: `lor: palette(v, 0, 1, "` });
    await browser.call("Input.insertText", { text: "leo" });
    // Names are not offered without a letter before the cursor.
    await browser.press(" ", 2);
    await browser.until(`(${options})[0]?.startsWith("leopard")`);
    writeFileSync("completion.png", await browser.screenshot());
    await browser.press("Enter");
    await browser.until(`${in_editor(".cm-content")}.textContent.includes("leopard")`);
    await browser.press("Escape");
    // Names that are being declared are not in the run yet, but are offered.
    await type_script(text.replace("kill: 0.06", "kill: 0.06; freshness: 7").replace("u * v^2 + feed", "u * fresh"));
    for (let k = 0; k < text.length - text.indexOf("+ feed") - "+ feed".length; ++k) await browser.press("ArrowLeft");
    await browser.press(" ", 2);
    await browser.until(`(${options})[0]?.startsWith("freshness")`);
    await browser.press("Escape");
    await type_script(text);
    await until_text_is_read();

    // If the pointer rests on a name, the rate with its present value and equation is shown.
    const line = await browser.evaluate(`(({ x, y, height }) => [x, y + height / 2])([...document.getElementById("editor").shadowRoot.querySelectorAll(".cm-line")].find((line) => line.textContent.includes("v' =")).getBoundingClientRect())`);
    await browser.call("Input.dispatchMouseEvent", { type: "mouseMoved", x: line[0] + 27, y: line[1] });
    await browser.until(`${in_editor(".explanation math")} !== null`);
    const told = await browser.evaluate(`${in_editor(".explanation")}.textContent`);
    expect(told.startsWith("v species") && told.includes("now from 0") && told.includes("feed"), `v is explained as ${told}`);
    writeFileSync("explanation.png", await browser.screenshot());
    await browser.call("Input.dispatchMouseEvent", { type: "mouseMoved", x: 5, y: 5 });
}

/// The colour of the pixel in the middle of a cell, and the number of pixels along the canvas.
const pixel = (column, row) => browser.evaluate(`(() => {
    const canvas = document.getElementById("pattern"), copy = document.createElement("canvas"), scale = canvas.width / 48;
    [copy.width, copy.height] = [canvas.width, canvas.height];
    copy.getContext("2d").drawImage(canvas, 0, 0);
    return [...copy.getContext("2d").getImageData((${column} + 0.5) * scale, (${row} + 0.5) * scale, 1, 1).data.slice(0, 3), canvas.width];
})()`);
const near = (one, other) => one.every((level, k) => Math.abs(level - other[k]) <= 1);

async function look_closely() {
    // A linear ramp, so that every value is known.
    await type_script("domain { grid: 48, 32; boundary: noflux }\nsystem still { u: 10 * x; u' = 0 }\nstage one: still { iterations: 10 }\n");
    await browser.until(`document.querySelectorAll("#stages li").length === 1`);
    await browser.restart();
    await choose("palette", "grey");
    const value = (column) => 10 * (column + 0.5) / 48, level = (low, high, column) => 255 * (value(column) - low) / (high - low);
    const until_level = async (how, column, wanted) => {
        await browser.eventually(async () => near((await pixel(column, 16)).slice(0, 3), [wanted, wanted, wanted]), async () => `${how}: ${await pixel(column, 16)} instead of ${wanted}`);
    };
    await until_level("the automatic range", 24, level(value(0), value(47), 24));

    // A fixed range does not follow the values.
    await browser.press("Escape");
    await browser.press("h");
    await browser.until(`document.getElementById("hold").ariaPressed === "true" && document.getElementById("low").value === "0.1042"`);
    await choose("show", "u / 2");
    await until_level("the held range", 24, level(value(0), value(47), 24) / 2 - 127.5 * value(0) / (value(47) - value(0)));
    await choose("show", "");
    await choose("low", "-10");
    await choose("high", "10");
    await until_level("the typed range", 24, level(-10, 10, 24));
    await choose("high", "a word");
    expect(await browser.evaluate(`document.getElementById("high").classList.contains("wrong")`), "a word is taken for a number");
    await click("hold");
    await until_level("the automatic range again", 24, level(value(0), value(47), 24));
    expect(await browser.evaluate(`document.getElementById("high").value`) === "", "the end of the range is still there");

    // The cell under the pointer and its value are shown.
    const box = await browser.evaluate(`(({ x, y, width, height }) => [x, y, width, height])(document.getElementById("pattern").getBoundingClientRect())`);
    const point = (column, row) => browser.call("Input.dispatchMouseEvent", { type: "mouseMoved", x: box[0] + (column + 0.5) / 48 * box[2], y: box[1] + (row + 0.5) / 32 * box[3] });
    await point(12, 5);
    await browser.until(`document.getElementById("pointed").textContent === "cell 12, 5: 2.604"`);

    // Lines are thinner than cells: only the cell with values from 5 to 5.21 has a line, at 5.104, in its middle.
    const before = [await pixel(23, 16), await pixel(24, 16), await pixel(25, 16)];
    await browser.evaluate(`document.getElementById("look").open = true`);
    await browser.press("Escape");
    expect(!(await browser.evaluate(`document.getElementById("look").open`)), "Escape does not close what is open");
    await browser.evaluate(`document.getElementById("look").open = true`);
    await choose("at", String(value(24)));
    let seen;
    await browser.eventually(async () => {
        seen = [await pixel(23, 16), await pixel(24, 16), await pixel(25, 16)];
        const is_kept = seen.map((level, k) => near(level.slice(0, 3), before[k]));
        return seen[1][3] > 48 * 8 && is_kept.join() === "true,false,true";
    }, () => `a line is at ${seen.join("; ")}`);
    await choose("at", "");
    await choose("every", String(value(24) / 2));
    await browser.eventually(async () => !near((await pixel(24, 16)).slice(0, 3), before[1]) && near((await pixel(30, 16)).slice(0, 3), await pixel(30, 12)), () => "evenly spaced lines are missing");
    await choose("every", "");
    await browser.eventually(async () => (await pixel(24, 16))[3] === 48, () => "the canvas stays large without lines");

    // A slope that rises to the right faces the sun at the left. A slope that falls does not.
    await choose("relief", "1", "input");
    let grey;
    await browser.eventually(async () => ([grey] = await pixel(24, 16))[0] > before[1][0] + 5, () => `relief makes ${before[1][0]} ${grey} where it faces the sun`);
    await choose("show", "10 - u");
    await browser.until(`document.getElementById("pointed").textContent.includes("7.396")`);
    await browser.eventually(async () => ([grey] = await pixel(23, 16))[0] < before[1][0] - 5, () => `relief makes ${before[1][0]} ${grey} in the shade`);
    await choose("show", "");
    await choose("relief", "0", "input");
    await type_script(text);
    await until_text_is_read();
    await browser.restart();
    await browser.grow();
    await browser.until(`document.getElementById("step").disabled`);
    await choose("palette", "viridis");
    await choose("every", "0.05");
    await choose("relief", "0.6", "input");
    writeFileSync("lines.png", await browser.screenshot());
    await choose("every", "");
    await choose("relief", "0", "input");
    await browser.evaluate(`document.getElementById("look").open = false`);
}

/// The requests of this kind that the page has sent since it was opened.
const asked = (what) => browser.evaluate(`(window.asked ?? []).filter((text) => text.includes('"do":"${what}"')).length`);

async function measure() {
    await browser.evaluate(`{
        const send = WebSocket.prototype.send;
        window.asked = [];
        WebSocket.prototype.send = function (text) { window.asked.push(text); send.call(this, text); };
    }`);
    await type_script(text);
    await until_text_is_read();
    await browser.restart();
    await click("step");
    await until_steps("1");
    expect(await asked("measure") + await asked("values") === 0, "a closed panel measures");

    const caption = (id) => `document.querySelector("#${id} figcaption").textContent`;
    await browser.evaluate(`document.activeElement.blur()`);
    await browser.press("Escape");
    await browser.press("m");
    await browser.until(`document.getElementById("measure").open && ${caption("whole")}.startsWith("u: ")`);
    expect(await browser.evaluate(`document.getElementById("probe").hidden`), "there is a probe before a cell was chosen");

    // Choosing a cell shows all its species and paints nothing.
    await browser.press("p");
    const box_of_pattern = () => browser.evaluate(`(({ x, y, width, height }) => [x, y, width, height])(document.getElementById("pattern").getBoundingClientRect())`);
    let box = await box_of_pattern();
    const at = (column, row) => [box[0] + (column + 0.5) / 48 * box[2], box[1] + (row + 0.5) / 32 * box[3]];
    // The pattern moves while the panel grows, so a press may hit another cell.
    const chosen = `!document.getElementById("probe").hidden && ${caption("probe")}.startsWith("cell 24, 14:")`;
    await browser.eventually(async () => {
        box = await box_of_pattern();
        await browser.drag(...at(24, 14), ...at(26, 14));
        await new Promise((resolve) => setTimeout(resolve, 500));
        return browser.evaluate(chosen);
    }, () => `never true: ${chosen}`);
    expect(await asked("paint") === 0, "choosing a cell paints");
    box = await box_of_pattern();  // The panel has grown.
    const ring = await browser.evaluate(`(({ x, y, width, height }) => [x + width / 2, y + height / 2])(document.querySelector(".mark.probe").getBoundingClientRect())`);
    expect(Math.hypot(ring[0] - at(24, 14)[0], ring[1] - at(24, 14)[1]) < 2, `the probe is at ${ring} instead of ${at(24, 14)}`);
    await browser.call("Input.dispatchMouseEvent", { type: "mouseMoved", x: at(24, 14)[0], y: at(24, 14)[1] });
    await browser.until(`document.getElementById("pointed").textContent.startsWith("cell 24, 14")`);
    await browser.until(`${caption("probe")}.includes(" u " + document.getElementById("pointed").textContent.split(": ")[1])`);

    // The curves follow the run forwards and backwards.
    const moments = `Number(document.getElementById("whole").dataset.moments)`;
    const first = await browser.evaluate(moments);
    await click("run");
    await browser.until(`document.getElementById("step").disabled && ${moments} > ${first}`);
    await browser.until(`${caption("spectrum")}.includes("wavelength")`);
    await browser.until(`document.querySelectorAll("#measure .uplot canvas").length === 4`);
    await browser.until(`document.querySelector("#phase canvas").width === 48`);
    writeFileSync("measures.png", await browser.screenshot());
    await click("restart");
    await browser.until(`${moments} === 1`);

    await choose("of_x", "v");
    await browser.until(`${caption("histogram")} === "cells by v" && ${caption("phase")} === "v over v"`);
    await browser.evaluate(`document.getElementById("measure").open = false`);
    const before = await asked("values");
    await click("step");
    await until_steps("1");
    expect(await asked("values") <= before + 1, "a closed panel goes on measuring");
}

async function see_the_stages() {
    await type_script(text.replaceAll("grow", "first").replaceAll("more", "second"));
    await until_text_is_read();
    await browser.restart();
    const pictures = `[...document.querySelectorAll("#stages canvas")].map(({ hidden }) => hidden).join()`;
    await browser.until(`${pictures} === "false,true"`);
    await browser.grow();
    await browser.until(`document.getElementById("step").disabled && ${pictures} === "false,false"`);
    // The picture has the width of the grid and several colours.
    const seen = await browser.evaluate(`(({ width, height, colours }) => [width, height, colours])((() => {
        const canvas = document.querySelectorAll("#stages canvas")[1], { width, height } = canvas;
        return { width, height, colours: new Set(canvas.getContext("2d").getImageData(0, 0, width, height).data).size };
    })())`);
    expect(seen[0] === 40 && seen[1] === 27 && seen[2] > 9, `the picture of a stage is ${seen}`);
    await type_script(text);
    await browser.until(`document.getElementById("stages").textContent === "growmore"`);
}

async function recover_from_a_blow_up() {
    await type_script(text);
    await until_text_is_read();
    await browser.restart();
    await click("step");
    await until_steps("1");
    expect(await browser.evaluate(`document.getElementById("failure").hidden`), "there is a failure before anything went wrong");
    await type_script(text.replace("0.16 * lap(u)", "16 * lap(u)"));
    await until_text_is_read();
    await click("run");
    await browser.until(`document.getElementById("failure").textContent.includes("u is not finite any more at column")`);
    // The marked cell is the one that the message names.
    const [column, row] = (await browser.evaluate(`document.getElementById("failure").textContent`)).match(/column (\d+), row (\d+)/).slice(1).map(Number);
    const away = await browser.evaluate(`(() => {
        const middle = ({ x, y, width, height }) => [x + width / 2, y + height / 2, width, height];
        const [x, y] = middle(document.querySelector(".mark.failed").getBoundingClientRect()), box = document.getElementById("pattern").getBoundingClientRect();
        return Math.hypot(x - box.x - (${column} + 0.5) / 48 * box.width, y - box.y - (${row} + 0.5) / 32 * box.height);
    })()`);
    expect(away < 2, `the mark is ${away} pixels away from column ${column}, row ${row}`);
    writeFileSync("blow_up.png", await browser.screenshot());
    await browser.evaluate(`document.querySelector("#failure button").click()`);
    await browser.until(`document.getElementById("failure").hidden && document.querySelector(".mark.failed").hidden`);
    await until_steps("1");
    await browser.until(`!${in_editor(".cm-content")}.textContent.includes("16 * lap(u) - u * v^2") || ${in_editor(".cm-content")}.textContent.includes("0.16 * lap(u)")`);
}

/// The log of the session, by a request over another connection.
const log_of_session = () => browser.evaluate(`new Promise((resolve) => {
    const socket = window.sockets.at(-1), id = 1e9;
    socket.addEventListener("message", ({ data }) => typeof data === "string" && JSON.parse(data).id === id && resolve(JSON.parse(data).text));
    socket.send(JSON.stringify({ do: "log", id }));
})`);
const count = (text, words) => text.split(words).length - 1;

async function lose_the_connection() {
    await browser.call("Page.addScriptToEvaluateOnNewDocument", { source: `
        window.sockets = [];
        window.strokes = new Set();
        window.WebSocket = class extends WebSocket {
            constructor(address) {
                super(window.is_cut ? address.replace("/session", "/nowhere") : address);
                window.sockets.push(this);
            }
            send(text) {
                if (text.includes('"do":"paint"')) window.strokes.add(JSON.parse(text).id);
                super.send(text);
            }
        };` });
    await browser.reload();
    await browser.until(`window.sockets?.at(-1)?.readyState === 1 && document.querySelectorAll("#stages li").length === 2 && document.querySelector("#controls [type=range]")`);
    await browser.restart();
    const box = await browser.evaluate(`(({ x, y, width, height }) => [x, y, width, height])(document.getElementById("pattern").getBoundingClientRect())`);
    const press = (column, row) => browser.drag(box[0] + (column + 0.5) / 48 * box[2], box[1] + (row + 0.5) / 32 * box[3], box[0] + (column + 0.5) / 48 * box[2], box[1] + (row + 0.5) / 32 * box[3]);
    const slide = (value) => browser.evaluate(`{ const input = document.querySelector("#controls [type=range]"); input.value = "${value}"; input.dispatchEvent(new Event("input")); input.dispatchEvent(new Event("change")); }`);

    // Requests whose answers were lost are sent again, but do not take effect twice.
    await browser.evaluate(`window.sockets.at(-1).onmessage = () => {}, window.is_cut = true`);
    await slide("0.03");
    await press(10, 10);
    await new Promise((resolve) => setTimeout(resolve, 300));
    await browser.evaluate(`window.sockets.at(-1).close()`);
    await browser.until(`document.getElementById("notice").textContent.includes("trying again")`);
    // Changes without a connection are sent over the next one.
    await slide("0.05");
    await press(20, 20);
    await type_script(text.replace("kill: 0.06", "kill: 0.061"));
    const tries = await browser.evaluate(`window.sockets.length`);
    await browser.until(`window.sockets.length > ${tries}`);  // Another attempt fails.
    expect(await browser.evaluate(`document.getElementById("text").ariaBusy`) === "true", "the text was read without a connection");
    await browser.evaluate(`window.is_cut = false`);
    await browser.until(`window.sockets.at(-1).readyState === 1`);
    await until_text_is_read();
    await browser.until(`document.querySelector("#controls .slider input").value === "0.05" && document.getElementById("notice").textContent === ""`);
    expect((await browser.evaluate(`${in_editor(".cm-content")}.textContent`)).includes("0.061"), "the text that was typed is lost");
    // Several strokes can be waiting, and each is answered after the one before it.
    let log;
    const are_logged = async () => count(log = await log_of_session(), "\npaint ") === await browser.evaluate(`window.strokes.size`);
    await browser.eventually(are_logged, async () => `not all of ${await browser.evaluate(`window.strokes.size`)} strokes are in ${log}`);
    const seen = ["\npaint ", "set grow.feed=0.03\n", "set grow.feed=0.05\n", "kill: 0.061"].map((words) => count(log, words));
    const strokes = await browser.evaluate(`window.strokes.size`);
    expect(strokes >= 2 && seen.join() === `${strokes},1,1,1`, `${seen} strokes, numbers and texts in ${log}`);
    await browser.grow();
    await browser.until(`document.getElementById("step").disabled`);

    // The page and the run survive any typed text.
    for (const wrong of ["\ud800 stage", "stage", "}{", '"', "\u0000", "a".repeat(1 << 20), "system s { u: u' = ", "domain { grid: 99999999, 99999999 }", "((((".repeat(9999)]) {
        await browser.evaluate(`${in_editor(".cm-content")}.focus(), document.execCommand("selectAll"), document.execCommand("insertText", false, ${wrong.length > 1e6 ? `"a".repeat(${wrong.length})` : JSON.stringify(wrong)})`);
        await browser.until(`document.getElementById("text").ariaBusy === "false" && document.getElementById("messages").textContent !== ""`);
    }
    await type_script(text);
    await browser.until(`document.getElementById("messages").textContent === ""`);
    await browser.restart();

    // After a failure while drawing, the page continues to draw.
    await browser.evaluate(`{
        const draw = WebGL2RenderingContext.prototype.drawArrays;
        window.mend = () => (WebGL2RenderingContext.prototype.drawArrays = draw);
        WebGL2RenderingContext.prototype.drawArrays = () => { throw new Error("planned"); };
    }`);
    await click("step");
    await new Promise((resolve) => setTimeout(resolve, 300));
    await browser.evaluate(`window.mend()`);
    await click("step");
    await until_steps("2");
}

async function first_visit() {
    // The introduction in four steps appears once.
    const card = `document.getElementById("tour")`;
    await browser.until(`!${card}.hidden && ${card}.textContent.includes("1 of 4")`);
    for (const [k, id] of ["text", "controls", "frame", "stages"].entries()) {
        expect(await browser.evaluate(`document.querySelector("[data-taught]").id`) === id, `step ${k + 1} is not about ${id}`);
        // The steps cover no control, and on a phone the pattern stays visible.
        for (const width of [1400, 390]) {
            await size(width, 900);
            const [end, start, frame] = await browser.evaluate(`[${card}.getBoundingClientRect().bottom, document.querySelector("main").getBoundingClientRect().top, document.getElementById("frame").getBoundingClientRect().bottom]`);
            expect(end <= start && start < frame && frame < 900, `step ${k + 1} on ${width} pixels ends at ${end}, above the page at ${start} and the pattern up to ${frame}`);
            if (k === 1) writeFileSync(`first_visit_${width}.png`, await browser.screenshot());
        }
        expect(k !== 1 || (await browser.evaluate(`${card}.textContent`)).startsWith("Below the pattern: sliders"), "a phone is not told where the sliders are");
        await click("tour_next");
    }
    await size(1400, 900);
    expect(await browser.evaluate(`${card}.hidden && document.querySelector("[data-taught]") === null`), "the steps do not end");
    await browser.reload();
    await browser.until(`document.querySelectorAll("#stages li").length === 2 && document.getElementById("place").textContent !== ""`);
    expect(await browser.evaluate(`${card}.hidden`), "the steps come again");
    await browser.press("?");
    await browser.until(`document.getElementById("help").open`);
    const listed = await browser.evaluate(`document.querySelectorAll("#help dt").length`);
    expect(listed > 12, `only ${listed} keys are listed`);
    writeFileSync("help.png", await browser.screenshot());
    await browser.press("Escape");
    await browser.until(`!document.getElementById("help").open`);

    // Tab reaches every control once, in the visible order.
    const reached = [];
    await browser.evaluate(`document.activeElement.blur(), window.getSelection().removeAllRanges()`);
    for (let k = 0; k < 60; ++k) {
        await browser.press("Tab");
        const id = await browser.evaluate(`document.activeElement.id || document.activeElement.parentElement.id || document.activeElement.parentElement.textContent`);
        if (id === "editor") {
            const label = await browser.evaluate(`document.activeElement.shadowRoot.activeElement.ariaLabel`);
            expect(label.includes("Escape leaves"), `the text is called ${label}`);
            await browser.press("Escape");
        }
        if (reached.includes(id) && !id.includes("feed") && id !== "editor" && id !== "stages") break;
        reached.push(id);
    }
    const order = ["help_button", "editor", "pattern", "palette", "low", "high", "hold", "look", "restart", "save", "brush", "show", "measure"];
    const places = order.map((id) => reached.indexOf(id));
    expect(places.every((place, k) => place >= 0 && (k === 0 || place > places[k - 1])), `Tab reaches ${reached}`);
}

async function save_files() {
    const folder = join(process.cwd(), "saved");
    rmSync(folder, { recursive: true, force: true });
    await browser.call("Browser.setDownloadBehavior", { behavior: "allow", downloadPath: folder });
    const file = async (name, id) => {
        await click(id);
        return browser.file(join(folder, name));
    };
    await type_script(text);
    await until_text_is_read();
    await browser.restart();
    expect(String(await file("spots.cascade", "script")) === text, "the script is another one");

    // `cascade` grows a saved picture again, byte for byte, from the session inside the picture.
    await choose("palette", "leopard");
    await click("step");
    await until_steps("1");
    await browser.evaluate(`{ const input = document.querySelector("#controls [type=range]"); input.value = "0.03"; input.dispatchEvent(new Event("input")); input.dispatchEvent(new Event("change")); }`);
    await browser.until(`document.querySelector("#controls .slider input").value === "0.03" && !document.getElementById("undo").disabled`);
    const picture = await file("spots.png", "picture");
    expect(picture.readUInt32BE(16) === 960 && picture.readUInt32BE(20) === 640, `the picture has ${picture.readUInt32BE(16)} pixels`);
    const { status, stderr } = spawnSync(program, ["run", join(folder, "spots.png"), "-o", join(folder, "again.png"), "--quiet"], { encoding: "utf8" });
    expect(status === 0 && picture.equals(readFileSync(join(folder, "again.png"))), `the picture does not grow again: ${stderr}`);

    // The movie shows the drawn pattern, with cells of 20 × 20 pixels. A busy machine needs time to encode the
    // first picture, without which a movie is empty.
    let movie, seconds = 0;
    const record = async () => {
        rmSync(join(folder, "spots.webm"), { force: true });
        await browser.restart();
        await click("movie");
        await browser.until(`document.getElementById("movie").ariaPressed === "true"`);
        for (let k = 1; k < 8; ++k) {
            await click("step");
            await until_steps(k);
            await new Promise((resolve) => setTimeout(resolve, 60));
        }
        await browser.grow();
        await browser.until(`document.getElementById("step").disabled`);
        await new Promise((resolve) => setTimeout(resolve, 1000 * seconds++));
        movie = await file("spots.webm", "movie");
        return movie.length > 2000;
    };
    await browser.eventually(record, () => `a movie has only ${movie.length} bytes`);
    expect(movie.readUInt32BE() === 0x1a45dfa3, "a movie is no WebM");
    const track = movie.indexOf(Buffer.from([0xb0, 0x82])), [width, height] = [movie.readUInt16BE(track + 2), movie.indexOf(Buffer.from([0xba, 0x82, 640 >> 8, 640 & 255]))];
    expect(width === 960 && height > 0, `the movie is ${width} pixels wide`);
    expect(await browser.evaluate(`document.getElementById("movie").ariaPressed`) === "false", "the movie does not end");

    await browser.restart();
    await click("frames");
    for (const step of ["1", "2"]) {
        await click("step");
        await until_steps(step);
    }
    const frames = await file("spots_frames.zip", "frames"), end = frames.length - 22;
    expect(frames.readUInt32LE(end) === 0x06054b50 && frames.readUInt16LE(end + 10) >= 3, `${frames.readUInt16LE(end + 10)} frames are too few`);
    expect(frames.toString("latin1", 30, 39) === "00000.png" && frames.toString("latin1", 40, 43) === "PNG", "the first frame is no PNG");
}

async function use() {
    await size(1400, 900);
    await browser.open(address);
    await browser.until(`document.querySelectorAll("#stages li").length === 2`);
    await first_visit();
    await help_with_the_text();
    await look_closely();
    await measure();
    await see_the_stages();
    await recover_from_a_blow_up();
    await lose_the_connection();
    await save_files();

    const complaints = browser.heard.filter((words) => !/^Applying inline style|^Error: planned|\/nowhere\?token=/.test(words));
    expect(complaints.length === 0, `the page complains: ${complaints.join("\n")}`);
}

await use().then(() => end(), end);
