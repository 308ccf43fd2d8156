// Positions and directions that a pointer writes into the text, on the page of `cascade view` and on a page that
// carries its engine. Arguments: the browser, the program, a script and, for the second, the exported page.
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { Browser, ending, expect, serve } from "./browser.mjs";

const [command, program, script, exported] = process.argv.slice(2);
const { cascade, address } = exported ? { address: pathToFileURL(exported).href } : await serve(program, script);
const browser = await Browser.start(command, join(process.cwd(), `profile_of_points${exported ? "_2" : ""}`));
const end = ending(browser, ...(cascade ? [cascade] : []));

const view = `document.getElementById("editor").shadowRoot.querySelector(".cm-content")`;
const text = `[...${view}.querySelectorAll(".cm-line")].map((line) => line.textContent).join("\\n")`;
const click = (id) => browser.click(`#${id}`);

/// Drags the pointer over a canvas. Both ends are given in pixels from the middle of the canvas.
/// Waits until the page finds the pattern under the first end, because the canvas may still move,
/// and its surface may not be there yet.
async function drag_on(id, [right, down], [to_right, to_down] = [right, down]) {
    const find_middle = `(({ x, y, width, height }) => [x + width / 2, y + height / 2])(document.getElementById("${id}").getBoundingClientRect())`;
    const [x, y] = await browser.eventually(async () => {
        const [x, y] = await browser.evaluate(find_middle);
        await browser.hover(x + right, y + down);
        return await browser.evaluate(`document.getElementById("pointed").textContent !== ""`) && [x, y];
    }, () => `there is no pattern ${right}, ${down} from the middle of ${id}`);
    await browser.drag(x + right, y + down, x + to_right, y + to_down);
}

/// Types a script, puts the caret where the '|' was, and waits until the page has read the script.
async function type(with_caret) {
    const [before, after] = with_caret.split("|");
    await browser.type_script(before + after);
    for (let k = 0; k < after.length; ++k) await browser.press("ArrowLeft");
}
/// The text that the page has inserted at the "|" of `with_caret`.
async function written(with_caret) {
    const [before, after] = with_caret.split("|"), now = await browser.evaluate(text);
    expect(now.startsWith(before) && now.endsWith(after), `of ${with_caret} became ${now}`);
    return now.slice(before.length, now.length - after.length);
}
const numbers = (words) => words.match(/-?\d+(\.\d+)?/g).map(Number);
const on_the_ball = ([x, y, z]) => Math.abs(Math.hypot(x - 0.5, y - 0.5, z - 0.5) - 0.5) < 0.02;

const ball = "domain { surface: sphere; cells: 500 }\n";
const still = (extra) => `${ball}system still { u: 0; k: 0; u' = k }\nstage one: still { iterations: 1; ${extra} }\n`;

async function write_on_a_model() {
    await browser.until(`!document.getElementById("solid").hidden && document.getElementById("step").disabled`);
    await click("point");
    expect(await browser.evaluate(`document.getElementById("point").ariaPressed`) === "true", "the button does not stay pressed");

    // Without a caret, the page does not know where to write a position.
    await drag_on("solid", [0, 0]);
    await browser.until(`document.getElementById("notice").textContent.startsWith("Put the caret")`);

    let at = still("k: distance(|)");
    await type(at);
    await drag_on("solid", [0, 0]);
    const front = numbers(await written(at));
    expect(front.length === 3 && on_the_ball(front), `a click in the middle is ${front}`);
    // By default, the camera is 30 degrees around the model and 25 degrees above it.
    const seen_from = [Math.sin(Math.PI / 6) * Math.cos(25 * Math.PI / 180), Math.sin(25 * Math.PI / 180), Math.cos(Math.PI / 6) * Math.cos(25 * Math.PI / 180)];
    expect(front.every((part, k) => Math.abs(part - 0.5 - 0.5 * seen_from[k]) < 0.03), `the middle is ${front}`);
    // A second position is written after a comma.
    await drag_on("solid", [40, 0]);
    const two = numbers(await written(at));
    expect(two.length === 6 && on_the_ball(two.slice(3)) && two[3] !== two[0], `two clicks are ${two}`);
    await browser.until(`document.getElementById("text").ariaBusy === "false" && document.getElementById("messages").textContent === ""`);

    // The value of a new key is selected, so that typing replaces it.
    at = still("k: keys(|, 0.1)");
    await type(at);
    await drag_on("solid", [0, 0]);
    await browser.call("Input.insertText", { text: "7" });
    expect((await written(at)).endsWith(", 7"), `a key is ${await written(at)}`);
    await drag_on("solid", [0, 40]);
    expect(numbers(await written(at)).length === 8, `two keys are ${await written(at)}`);
    await browser.until(`document.getElementById("text").ariaBusy === "false" && document.getElementById("messages").textContent === ""`);

    // Dragging writes the direction along the surface in which the pointer moves on the screen.
    at = still("k: along(keys(|))");
    await type(at);
    await drag_on("solid", [0, 0], [60, 0]);
    const key = numbers(await written(at)), direction = key.slice(3), normal = key.slice(0, 3).map((part) => 2 * (part - 0.5));
    const product = (a, b) => a.reduce((sum, part, k) => sum + part * b[k], 0);
    expect(key.length === 6 && Math.abs(product(direction, direction) - 1) < 0.01, `a drag is ${key}`);
    expect(Math.abs(product(direction, normal)) < 0.1, `a direction of ${direction} leaves the surface`);
    expect(product(direction, [Math.cos(Math.PI / 6), 0, -Math.sin(Math.PI / 6)]) > 0.95, `to the right is ${direction}`);
    await browser.until(`document.getElementById("text").ariaBusy === "false" && document.getElementById("messages").textContent === ""`);
    at = still("k: along(axis(|))");
    await type(at);
    await drag_on("solid", [0, 0], [0, -60]);
    const upward = numbers(await written(at));
    expect(upward.length === 3 && upward[1] > 0.85, `upwards is ${upward}`);

    // Outside of brackets, a whole expression is written.
    for (const [far, wanted] of [[0, /^distance\([\d., ]+\)$/], [50, /^along\(keys\([-\d., ]+\)\)$/]]) {
        at = still("k: |");
        await type(at);
        await drag_on("solid", [0, 0], [far, 0]);
        expect(wanted.test(await written(at)), `outside of brackets it is ${await written(at)}`);
        await browser.until(`document.getElementById("text").ariaBusy === "false" && document.getElementById("messages").textContent === ""`);
    }

    // Beside the model the pointer turns it as before, and neither paints nor writes.
    const before = await browser.evaluate(text);
    const { left, top } = await browser.evaluate(`(({ left, top }) => ({ left, top }))(document.getElementById("solid").getBoundingClientRect())`);
    await browser.drag(left + 5, top + 5, left + 60, top + 5);
    await browser.until(`document.getElementById("frame").hasAttribute("data-moved")`);
    expect(await browser.evaluate(text) === before, "beside the model something was written");
    writeFileSync(`points${exported ? "_exported" : ""}.png`, await browser.screenshot());
    await browser.press("Escape");
    await browser.press("Escape");
    await browser.until(`document.getElementById("point").ariaPressed === "false"`);
}

async function write_on_a_plane() {
    await browser.evaluate("document.activeElement.blur()");
    const plane = (extra) => still(extra).replace(ball, "domain { grid: 40, 20 }\n");
    await type(plane("u: 0|"));
    await browser.until(`!document.getElementById("pattern").hidden`);
    const at = plane("u: disc(|, 0.1)");
    await type(at);
    await browser.evaluate("document.activeElement.blur()");
    await browser.press("k");
    await drag_on("pattern", [0, 0]);
    const middle_of_plane = numbers(await written(at));
    expect(middle_of_plane.length === 2 && Math.abs(middle_of_plane[0] - 0.5) < 0.02 && Math.abs(middle_of_plane[1] - 0.25) < 0.02, `the middle of the plane is ${middle_of_plane}`);
    await browser.until(`document.getElementById("text").ariaBusy === "false" && document.getElementById("messages").textContent === ""`);
    await browser.until(`!document.getElementById("undo").disabled`);
    await click("point");
}

try {
    await browser.call("Emulation.setDeviceMetricsOverride", { width: 1280, height: 800, deviceScaleFactor: 1, mobile: false });
    await browser.open(address);
    await browser.until(`document.querySelectorAll("#stages li").length > 0`);
    await write_on_a_model();
    await write_on_a_plane();
    const complaints = browser.heard.filter((words) => !words.startsWith("Applying inline style"));
    expect(complaints.length === 0, `the page complains: ${complaints.join("\n")}`);
    await end();
} catch (error) {
    await end(error);
}
