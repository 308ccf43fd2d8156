// Uses the page of `cascade view spots.cascade` as a user does. Arguments: the browser and the program. spots.cascade,
// colours.cascade and their pictures by `cascade run` are in the current folder. Screenshots are left there.
import { spawnSync } from "node:child_process";
import { readFileSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { Browser, ending, expect, is_growing, serve } from "./browser.mjs";

const [command, program] = process.argv.slice(2);
const { cascade, address } = await serve(program, "spots.cascade");
const start_page = await serve(program);
const browser = await Browser.start(command, join(process.cwd(), "profile"));
const end = ending(browser, cascade, start_page.cascade);

const click = (id) => browser.click(`#${id}`);
const steps = () => browser.evaluate(`Number(document.getElementById("place").textContent.match(/[\\d,]+/)[0].replaceAll(",", ""))`);
const until_steps = (count) => browser.until(`document.getElementById("place").textContent.startsWith("step ${count}")`);
const is_over = `document.querySelectorAll("#stages progress").length === 2 && document.getElementById("step").disabled`;

/// Grows the pattern from the start of the first stage.
async function grow() {
    await browser.restart();
    await browser.grow();
}

/// The pixels of a canvas or an image, which is given by an expression in the page.
const pixels = (image) => browser.evaluate(`(async () => {
    const image = await (${image}), copy = document.createElement("canvas");
    [copy.width, copy.height] = [image.width, image.height];
    copy.getContext("2d").drawImage(image, 0, 0);
    return [image.width, image.height, ...copy.getContext("2d").getImageData(0, 0, image.width, image.height).data];
})()`);
const canvas = () => pixels(`document.getElementById("pattern")`);
const picture = (name) => pixels(`new Promise((resolve) => {
    const image = new Image();
    image.onload = () => resolve(image);
    image.src = "data:image/png;base64,${readFileSync(`${name}.png`).toString("base64")}";
})`);

async function expect_the_picture(how, name = "spots") {
    const seen = await canvas(), wanted = await picture(name);
    expect(seen[0] === wanted[0] && seen[1] === wanted[1], `${how}: ${seen.slice(0, 2)} pixels`);
    const worst = Math.max(...seen.map((level, k) => Math.abs(level - wanted[k])));
    expect(worst <= 1, `${how}: a level differs by ${worst} from the picture of cascade run`);
}

/// Waits until the canvas has the pixels of a picture.
async function until_picture(how, name = "spots") {
    let why;
    await browser.eventually(() => expect_the_picture(how, name).then(() => true, (error) => void (why = error.message)), () => why);
}

async function choose_leopard() {
    await browser.evaluate(`{ const choice = document.getElementById("palette"); choice.value = "leopard"; choice.dispatchEvent(new Event("change")); }`);
}

const type_script = (text) => browser.type_script(text);

async function steer() {
    await browser.call("Emulation.setDeviceMetricsOverride", { width: 1280, height: 800, deviceScaleFactor: 1, mobile: false });
    await browser.open(address);
    await browser.until(`document.querySelectorAll("#stages li").length === 2`);
    expect(!(await browser.evaluate("location.href")).includes("token"), "the token stays in the address");
    await browser.until(`document.getElementById("name").textContent === "spots.cascade"`);
    await choose_leopard();

    // Growth starts when the page opens, but not after a reload.
    await browser.until(is_over);
    await until_picture("the canvas that nobody has touched");
    await browser.restart();
    await browser.reload();
    await until_steps("0");
    await browser.until(`document.getElementById("paused").textContent === "paused"`);
    expect(await steps() === 0, "the reload has started what was not growing");
    await choose_leopard();

    await click("step");
    await until_steps("1");
    await browser.press(".");
    await until_steps("2");
    await click("undo").then(() => click("restart"));
    await until_steps("0");
    await browser.press(" ");
    await browser.until(is_over);
    expect(await browser.evaluate(`document.getElementById("paused").textContent`) === "", "what has ended is called paused");
    await until_picture("the canvas");
    writeFileSync("page.png", await browser.screenshot());

    const show = (expression) => browser.evaluate(
        `{ const input = document.getElementById("show"); input.value = "${expression}"; input.dispatchEvent(new Event("change")); }`);
    await show("v + w");
    await browser.until(`document.getElementById("show").classList.contains("wrong") && document.getElementById("notice").textContent.includes("'w'")`);
    await show("3 * v");
    await browser.until(`!document.getElementById("show").classList.contains("wrong")`);
    await until_picture("the canvas of an expression", "expression");
    await show("");

    // A slider: one undo restores its value.
    await browser.evaluate(`document.querySelector("#controls [type=range]").focus()`);
    for (let k = 0; k < 3; ++k) await browser.press("ArrowRight");
    const value = `document.querySelector("#controls .slider input").value`;
    await browser.until(`${value} === "0.04" && !document.getElementById("undo").disabled`);
    const sliders = await browser.evaluate(`document.querySelectorAll("#controls [type=range]").length`);
    expect(sliders === 2, `${sliders} sliders instead of 2`);
    // After its end, a changed pattern continues for as many steps as all stages have. It does this
    // once, or twice if it ended between two presses.
    await browser.eventually(async () => [2500, 4500, 6500].includes(await steps()) && browser.evaluate(is_over), async () => `it ends at step ${await steps()}`);

    // Moves are undone one by one, however quickly they follow each other.
    await browser.until(`!("isBusy" in document.querySelector("#controls [type=range]").dataset)`);
    await browser.evaluate(`{
        const input = document.querySelector("#controls [type=range]"), send = (kind) => input.dispatchEvent(new Event(kind));
        for (const value of ["0.05", "0.06"]) input.value = value, send("input"), send("input"), send("change");
    }`);
    await browser.until(`!("isBusy" in document.querySelector("#controls [type=range]").dataset)`);
    for (const before of ["0.06", "0.05", "0.04"]) {
        await browser.until(`${value} === "${before}"`);
        if (before !== "0.04") await click("undo");
    }

    // A typed value may be a formula or beyond the slider. Other text is refused. Each value is undone separately.
    const type_value = (typed) => browser.evaluate(`{
        const [field] = document.querySelectorAll("#controls .slider input"), send = (kind) => field.dispatchEvent(new Event(kind));
        field.value = "${typed}", send("input"), send("change");
    }`);
    for (const [typed, shown, at] of [["0.0455", "0.0455", "0.045"], ["1/16", "0.0625", "0.063"], ["0.2", "0.2", "0.08"]]) {
        await type_value(typed);
        await browser.until(`${value} === "${shown}" && Math.abs(document.querySelector("#controls [type=range]").value - ${at}) < 1.1e-3`);
    }
    for (const typed of ["a word", "", "1/0"]) {
        await type_value(typed);
        await browser.until(`document.querySelector("#controls .slider input").classList.contains("wrong") && document.getElementById("notice").textContent !== ""`);
    }
    for (const before of ["0.0625", "0.0455", "0.04"]) {
        await click("undo");
        await browser.until(`${value} === "${before}" && !document.querySelector("#controls .wrong")`);
    }

    // A text with an error: its position and message are shown, and the run does not change.
    const text = readFileSync("spots.cascade", "utf8"), reached_before = await steps();
    await type_script(text.replace("- u * v^2 +", "- u * w^2 +"));
    await browser.until(`document.getElementById("messages").textContent.includes("line 8:")`);
    expect(await steps() === reached_before, "a wrong text has changed the run");

    // The button beside a message applies the hint, if this removes the error.
    await type_script(`# µ²🙂\n${text.replace("u * v^2 -", "u (v) -")}`);
    await browser.until(`document.querySelectorAll("#messages p").length > 0`);
    await browser.evaluate("new Promise((resolve) => setTimeout(resolve, 300))");
    expect(await browser.evaluate(`document.querySelector("#messages button") === null`), "a button mends what it cannot mend");
    await type_script(`# µ²🙂\n${text.replace("lap(v)", "lapp(v)").replace("u * v^2 -", "2 * u ** v -")}`);
    await browser.until(`document.querySelectorAll("#messages button").length === 2`);
    writeFileSync("fixes.png", await browser.screenshot());
    for (const [left, written] of [[1, "lap"], [0, "^"]]) {
        await browser.evaluate(`[...document.querySelectorAll("#messages button")].find((button) => button.textContent === "write ${written}").click()`);
        await browser.until(`document.getElementById("text").ariaBusy === "false" && document.querySelectorAll("#messages p").length === ${left}`);
        if (left > 0) await browser.until(`document.querySelector("#messages button")`);
    }
    expect((await browser.evaluate(`document.getElementById("editor").shadowRoot.querySelector(".cm-content").innerText`)).includes("lap(v) + 2 * u ^ v -"), "the buttons have not written what they said");
    await type_script(text.replace("iterations: 500", "iterations: 600"));
    await browser.until(`document.getElementById("messages").textContent === ""`);

    // Fine steps of a slider are not rounded, neither on the page nor in requests.
    await type_script(text.replace("kill: 0.06", "kill: 0.060001 in 0 .. 1 step 0.000001").replace("iterations: 500", "iterations: 600"));
    const fine = `document.querySelectorAll("#controls .slider")[1]?.querySelector("input")?.value`;
    await browser.until(`${fine} === "0.060001"`);
    await browser.evaluate(`{
        const input = document.querySelectorAll("#controls [type=range]")[1];
        input.value = "0.060002", input.dispatchEvent(new Event("input")), input.dispatchEvent(new Event("change"));
    }`);
    await browser.until(`!("isBusy" in document.querySelectorAll("#controls [type=range]")[1].dataset) && ${fine} === "0.060002"`);
    await click("undo");
    await browser.until(`${fine} === "0.060001"`);
    await click("undo");
    await browser.until(`document.querySelectorAll("#controls [type=range]").length === 2`);

    // Without sliders the pattern keeps its position.
    await type_script(text.replace("in 0.01 .. 0.08 step 0.001", "").replace("iterations: 500", "iterations: 600"));
    await browser.until(`document.querySelectorAll("#controls [type=range]").length === 0`);
    const wide = await browser.evaluate(`document.getElementById("pattern").getBoundingClientRect().width`);
    expect(wide > 500, `without sliders the pattern is only ${wide} pixels wide`);
    await click("undo");
    await browser.until(`document.querySelectorAll("#controls [type=range]").length === 2`);

    // A stroke appears where the pointer was.
    const box_of_pattern = () => browser.evaluate(
        `(({ x, y, width, height }) => [x, y, width, height])(document.getElementById("pattern").getBoundingClientRect())`);
    const [x, y, width, height] = await box_of_pattern();
    let before = await canvas();
    /// Columns and rows of the cells that have changed.
    const changed_cells = async () => {
        const after = await canvas(), cells = [];
        for (let k = 2; k < after.length; k += 4) {
            const cell = (k - 2) / 4;
            if ([0, 1, 2].some((c) => Math.abs(before[k + c] - after[k + c]) > 8)) cells.push([cell % after[0], Math.floor(cell / after[0])].join());
        }
        return cells;
    };
    const until_changed = async (wanted, how) => {
        await browser.eventually(async () => wanted(await changed_cells()), async () => `${how}: the cells ${(await changed_cells()).slice(0, 9).join(" ")} have changed`);
    };
    // A fast pointer that sends only three events leaves no gaps between the discs.
    await browser.evaluate(`document.getElementById("amount").value = "5"`);
    await browser.drag(x + 0.1 * width, y + 0.2 * height, x + 0.9 * width, y + 0.8 * height);
    const unpainted = async () => {
        const image = await canvas(), colour = (k) => image.slice(2 + 4 * k, 5 + 4 * k).join();
        const cells = Array.from({ length: 38 }, (_, k) => (k + 5) + 48 * Math.floor(32 * (0.2 + 0.6 * (k + 0.5) / 38.4)));
        return cells.filter((cell) => colour(cell) !== "247,228,187");
    };
    await browser.eventually(async () => (await unpainted()).length === 0, async () => `a fast stroke misses the cells ${await unpainted()}`);
    await click("undo");
    await until_changed((cells) => cells.length === 0, "undo of a stroke");
    await browser.evaluate(`document.getElementById("amount").value = ""`);
    await browser.drag(x + 0.2 * width, y + 0.5 * height, x + 0.3 * width, y + 0.5 * height);
    await until_changed((cells) => cells.includes("10,16") || cells.includes("12,16"), "a stroke");

    // The wheel zooms about the pointer, the middle button moves the picture, and a stroke reaches a single cell.
    const there = [Math.round(x + 30.5 / 48 * width), Math.round(y + 20.5 / 32 * height)];
    await browser.wheel(...there, -10000);
    await browser.until(`document.getElementById("pattern").getBoundingClientRect().width > ${4 * width}`);
    const [left, top, large, high] = await box_of_pattern();
    expect(Math.abs(large - 64 * 48) < 2, `a cell is ${large / 48} pixels wide after zooming`);
    const is_there = (place, start, size) => Math.abs(start[0] + place * size[0] / size[1] - start[1]) < 2;
    expect(is_there(there[0] - x, [left, there[0]], [large, width]) && is_there(there[1] - y, [top, there[1]], [high, height]), "zooming moves what is under the pointer");
    await browser.drag(...there, there[0] + 64, there[1] - 64, "middle");
    const moved = await box_of_pattern();
    expect(Math.abs(moved[0] - left - 64) < 2 && Math.abs(moved[1] - top + 64) < 2, "the middle button does not move the pattern");
    await browser.evaluate(`document.getElementById("amount").value = "0.5"`);
    await browser.evaluate("new Promise((resolve) => setTimeout(resolve, 300))");
    before = await canvas();
    await browser.drag(...there, ...there);
    await until_changed((cells) => cells.join() === "29,21", "a stroke on a cell");
    writeFileSync("zoomed.png", await browser.screenshot());
    await click("undo");
    await browser.evaluate(`document.activeElement.blur(), document.getElementById("amount").value = ""`);
    await browser.press("0");
    expect((await box_of_pattern())[2] === width, "the key does not fit the pattern again");

    // After Escape closes a small box, the element that opened the box has the focus again.
    await browser.evaluate(`document.getElementById("look").open = true, document.getElementById("every").focus()`);
    await browser.press("Escape");
    expect(await browser.evaluate(`!document.getElementById("look").open && document.activeElement.matches("#look > summary")`), "Escape loses the focus");
    await browser.evaluate("document.activeElement.blur()");

    // Two fingers zoom without painting.
    await until_changed((cells) => cells.length === 0, "undo");
    const middle = [x + width / 2, y + height / 2];
    const fingers = (apart) => [[middle[0] - apart, middle[1]], [middle[0] + apart, middle[1]]];
    await browser.touch(fingers(40).slice(0, 1), fingers(40), fingers(60), fingers(80), fingers(120));
    const [pinched_x, , pinched] = await box_of_pattern();
    expect(Math.abs(pinched / width - 3) < 0.1, `two fingers zoom by ${pinched / width} instead of 3`);
    expect(Math.abs(pinched_x + pinched / 2 - middle[0]) < 4, "the middle of two fingers moves");
    expect((await changed_cells()).length === 0, "two fingers paint");
    await click("fit");

    // Going to a stage starts this stage again, from the final values of the previous stage.
    await browser.evaluate(`document.querySelectorAll("#stages button")[1].click()`);
    await until_steps("0");
    await browser.evaluate(`document.querySelectorAll("#stages button")[0].click()`);
    await browser.until(`document.querySelectorAll("#stages progress")[1].value === 0`);

    // Non-finite values stop the run with a message. The run continues when the text is corrected.
    await type_script(text.replace("0.16 * lap(u)", "16 * lap(u)"));
    await grow();
    await browser.until(`document.getElementById("failure").textContent.includes("finite")`);

    // Colours, in a domain of another shape and size.
    await type_script(readFileSync("colours.cascade", "utf8"));
    await browser.until(`document.querySelectorAll("#stages li").length === 1`);
    await grow();
    await until_steps("800");
    await until_picture("the canvas of colours", "colours");
    await type_script(text);
    await browser.until(`document.querySelectorAll("#stages li").length === 2`);

    // The button pauses the run. The next stage starts at the reached step, which the log contains.
    await type_script(text.replace("iterations: 1500", "iterations: 100000000"));
    await grow();
    await browser.until(`${is_growing} && !document.getElementById("place").textContent.startsWith("step 0")`);
    await click("run");
    await browser.until(`!(${is_growing})`);
    const reached = await steps();
    await browser.press("Escape");
    await browser.press("n");
    await browser.until(`document.querySelectorAll("#stages button")[1].ariaCurrent === "step" && document.getElementById("next").disabled`);
    rmSync("spots.session", { force: true });
    await browser.call("Browser.setDownloadBehavior", { behavior: "allow", downloadPath: process.cwd() });
    await click("log");
    expect(String(await browser.file("spots.session")).includes(`at 1 ${reached}\nnext\n`), "the log does not name the next stage");
    const { status, stderr } = spawnSync(program, ["repl", "spots.session"], { input: "", encoding: "utf8" });
    expect(status === 0 && stderr === "", `the log cannot be played: ${stderr}`);
    await type_script(text);

    // For a grid of one row, time runs downwards, as in the picture of `--space-time`.
    await type_script(readFileSync("line.cascade", "utf8"));
    await grow();
    await until_picture("the canvas of a row", "line");
    writeFileSync("line_page.png", await browser.screenshot());
    await type_script(text);
    await browser.until(`document.querySelectorAll("#stages li").length === 2`);

    // A volume: all slices, and a ball painted in one of them.
    await type_script(readFileSync("volume.cascade", "utf8"));
    await grow();
    await until_steps("10");
    await until_picture("the middle slice", "z");
    const choose_slice = (axis, number) => browser.evaluate(`{
        const [choice, place] = document.querySelectorAll("#slice select, #slice input");
        if (choice.value !== "${axis}") { choice.value = "${axis}"; choice.dispatchEvent(new Event("change")); }
        place.value = "${number}";
        place.dispatchEvent(new Event("input"));
    }`);
    await choose_slice("x", 0);
    await until_picture("a slice across x", "x");
    await choose_slice("y", 8);
    await until_picture("a slice across y", "y");
    const place = `document.querySelector("#slice input").value`;
    await browser.evaluate("document.activeElement.blur()");
    await browser.press("PageDown");
    await browser.until(`${place} === "9"`);
    await browser.press("PageUp");
    await browser.until(`${place} === "8"`);
    await until_picture("the slice before the next one", "y");
    writeFileSync("volume_page.png", await browser.screenshot());
    await browser.restart();
    before = await canvas();
    const [slice_x, slice_y, slice_wide, slice_high] = await box_of_pattern();
    const in_slice = [slice_x + 15.5 / 20 * slice_wide, slice_y + 9.5 / 12 * slice_high];
    await browser.drag(...in_slice, ...in_slice);
    const level = (image, column, row) => image.slice(2 + 4 * (row * image[0] + column), 5 + 4 * (row * image[0] + column)).join();
    const highest = "247,228,187";  // The last colour of the palette.
    await until_changed((cells) => cells.includes("15,9"), "a ball");
    expect(!(await changed_cells()).includes("12,9"), "the ball is too large");
    await choose_slice("z", 9);
    await browser.eventually(async () => level(await canvas(), 15, 8) === highest, async () => `the middle of the ball is ${level(await canvas(), 15, 8)}`);
    await click("undo");
    await type_script(text);
    await browser.until(`document.querySelectorAll("#stages li").length === 2`);
    expect(await browser.evaluate(`document.getElementById("slice").hidden`), "a plane has slices");

    // The page works without WebGL, too. It is reloaded with the token that the tab has stored.
    await browser.open(address.replace("/#", "/?2d#"));
    await browser.until(`document.querySelectorAll("#stages li").length === 2`);
    await choose_leopard();
    await browser.until(`document.querySelector("#controls [type=range]") !== null`);
    await browser.evaluate(`{ const input = document.querySelector("#controls [type=range]"); input.value = "0.037"; input.dispatchEvent(new Event("input")); }`);
    await browser.until(`${value} === "0.037"`);
    await grow();
    await browser.until(is_over);
    await until_picture("the canvas without WebGL");

    for (const [name, wide, scheme] of [["dark", 1280, "dark"], ["phone", 390, "light"]]) {
        await browser.call("Emulation.setDeviceMetricsOverride", { width: wide, height: 800, deviceScaleFactor: 1, mobile: wide < 500 });
        await browser.call("Emulation.setEmulatedMedia", { features: [{ name: "prefers-color-scheme", value: scheme }] });
        const overflow = await browser.evaluate("document.documentElement.scrollWidth - innerWidth");
        expect(overflow <= 0, `${name}: the page is ${overflow} pixels too wide`);
        writeFileSync(`${name}.png`, await browser.screenshot());
    }
    // Without a script, the start page shows pictures of the library and the examples. A click opens one, and its
    // pattern grows.
    await browser.call("Emulation.setDeviceMetricsOverride", { width: 1280, height: 800, deviceScaleFactor: 1, mobile: false });
    await browser.open(start_page.address);
    await browser.until(`document.getElementById("library")?.open && document.querySelectorAll("#library li").length > 50`);
    writeFileSync("start.png", await browser.screenshot());
    await browser.evaluate(`Promise.all([...document.querySelectorAll("#library img")].map((image) => image.decode()))`);
    const bare = await browser.evaluate(`[...document.querySelectorAll("#library li")].filter((item) => !item.querySelector("img")?.naturalWidth).map((item) => item.textContent)`);
    expect(bare.length === 0, `without a picture: ${bare}`);
    await browser.call("Emulation.setDeviceMetricsOverride", { width: 390, height: 800, deviceScaleFactor: 1, mobile: true });
    expect(await browser.evaluate(`(({ scrollWidth, clientWidth }) => scrollWidth <= clientWidth)(document.querySelector("#library > div"))`), "the library is too wide for a phone");
    await browser.call("Emulation.setDeviceMetricsOverride", { width: 1280, height: 800, deviceScaleFactor: 1, mobile: false });
    expect(await steps() === 0, "a pattern grows under the start page");
    const offered = () => browser.evaluate(`[...document.querySelectorAll("#library li:not([hidden]) code")].map((name) => name.textContent)`);
    for (const [words, wanted] of [["aliev panf", "aliev_panfilov"], ["prigogine", "brusselator"]]) {
        await browser.evaluate(`{ const input = document.querySelector("#library input"); input.value = "${words}"; input.dispatchEvent(new Event("input")); }`);
        const found = await offered();
        expect(found.length < 9 && found.includes(wanted), `a search for ${words} finds ${found}`);
    }
    await browser.evaluate(`[...document.querySelectorAll("#library .card")].find((choice) => choice.querySelector("code").textContent === "gray_scott").click()`);
    await browser.until(`!document.getElementById("place").textContent.startsWith("step 0")`);
    const typed = `document.getElementById("editor").shadowRoot.querySelector(".cm-content").textContent`;
    expect((await browser.evaluate(typed)).includes("Gray-Scott"), "the script of the chosen system is missing");
    await click("systems");
    await browser.evaluate(`[...document.querySelectorAll("#library .card")].find((choice) => choice.querySelector("b").textContent === "Fish").click()`);
    await browser.until(`${typed}.includes("fn fins(a, b)") && !document.getElementById("place").textContent.startsWith("step 0")`);
    // A newly chosen system takes no values from species of the same names in the old script.
    await click("systems");
    await browser.evaluate(`[...document.querySelectorAll("#library .card")].find((choice) => choice.querySelector("code").textContent === "kdv").click()`);
    await browser.until(`document.getElementById("stages").textContent === "overtaking" && !document.getElementById("place").textContent.startsWith("step 0")`);

    // The chosen slow speed, continuing after the end, and full speed again.
    const set_speed = (power) => browser.evaluate(`{ const input = document.getElementById("speed"); input.value = "${power}"; input.dispatchEvent(new Event("input")); }`);
    await set_speed(-1);
    await type_script("domain { grid: 64, 64 }\nstage slow: turing_spots { iterations: 4000 }\n");
    await grow();
    await browser.until(`document.getElementById("place").textContent.endsWith("· 100 steps/s")`);
    expect(await steps() < 2000, "it does not grow slowly");
    await click("run");
    await browser.until(`document.getElementById("paused").textContent === "paused"`);
    const paused_at = await steps();
    await browser.evaluate("new Promise((resolve) => setTimeout(resolve, 200))");
    expect(await steps() === paused_at, "it grows while it is paused");
    await click("run");
    await set_speed(5);
    await until_steps("4,000");
    await browser.until(`!(${is_growing})`);
    await click("run");
    await until_steps("8,000");
    // A stage that is typed after the end of the run is run, too.
    await type_script("domain { grid: 64, 64 }\nstage slow: turing_spots { iterations: 4000 }\nstage after: turing_spots { a: a; b: b; iterations: 300 }\n");
    await browser.until(`document.querySelectorAll("#stages button")[1]?.hasAttribute("aria-current")`);
    await until_steps("300");

    // Chromium's editing tries to style text that replaces a selection, which the policy forbids.
    const complaints = browser.heard.filter((words) => !words.startsWith("Applying inline style"));
    expect(complaints.length === 0, `the page complains: ${complaints.join("\n")}`);

    // The page says that Cascade has ended.
    start_page.cascade.kill("SIGINT");
    await browser.until(`document.getElementById("notice").textContent !== ""`);
}

await steer().then(() => end(), end);
