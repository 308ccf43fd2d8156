// Models and surfaces on the page of `cascade view spots.cascade`: the page draws them like `cascade run`, and pointers
// and keys turn, enlarge and paint them. Arguments: the browser and the program. Screenshots are left in the current
// folder.
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { Browser, ending, expect, serve } from "./browser.mjs";

const [command, program] = process.argv.slice(2);
const { cascade, address } = await serve(program, "model.cascade");
const browser = await Browser.start(command, join(process.cwd(), "profile_of_solids"));
const end = ending(browser, cascade);

const click = (id) => browser.click(`#${id}`);
const canvas = `document.getElementById("solid")`;

/// The mean difference of levels between a canvas and a picture, and the fraction of levels that
/// differ by more than 24.
const difference = (id, name) => browser.evaluate(`(async () => {
    const wanted = new Image();
    await new Promise((resolve) => { wanted.onload = resolve; wanted.src = "data:image/png;base64,${readFileSync(`${name}.png`).toString("base64")}"; });
    const levels = (image) => {
        const copy = document.createElement("canvas"), pen = copy.getContext("2d");
        [copy.width, copy.height] = [wanted.width, wanted.height];
        pen.fillStyle = "white";
        pen.fillRect(0, 0, copy.width, copy.height);
        pen.drawImage(image, 0, 0);
        return pen.getImageData(0, 0, copy.width, copy.height).data;
    };
    const a = levels(document.getElementById("${id}")), b = levels(wanted);
    let sum = 0, far = 0;
    a.forEach((level, k) => { sum += Math.abs(level - b[k]); far += Math.abs(level - b[k]) > 24; });
    return [sum / a.length, far / a.length];
})()`);

/// Waits until the canvas is like a picture, since the light is refined during several drawings.
async function until_like(name, how, most = [2.5, 0.01]) {
    let last;
    const is_like = async () => (last = await difference("solid", name)).every((part, k) => part <= most[k]);
    await browser.eventually(is_like, () => `${how}: levels differ by ${last[0]}, and ${last[1]} of them by more than 24`);
}

async function type_script(name) {
    await browser.type_script(readFileSync(name, "utf8"));
    await browser.evaluate("document.activeElement.blur()");
}

const point = (x, y) => browser.call("Input.dispatchMouseEvent", { type: "mouseMoved", x, y });
const pointed = `document.getElementById("pointed").textContent`;
/// The cell under a pointer, and its value.
async function cell_at(x, y) {
    await point(x, y);
    const [, cell, value] = (await browser.evaluate(pointed)).match(/cell ([\d, ]+): ([-\d.e]+)/) ?? [];
    return { cell, value: Number(value) };
}

/// Opens the page with a canvas as large as pictures of `cascade run`, and without the colours of the page.
async function open(question) {
    await browser.open(address.replace("/#", `/${question}#`));
    await browser.until(`document.querySelectorAll("#stages li").length === 1`);
    await browser.evaluate(`{ const choice = document.getElementById("palette"); choice.value = "zebra"; choice.dispatchEvent(new Event("change")); }`);
    await browser.evaluate(`Object.assign(${canvas}.style, { position: "fixed", left: 0, top: 0, width: "800px", height: "600px" })`);
}

async function steer() {
    await browser.call("Emulation.setDeviceMetricsOverride", { width: 1280, height: 800, deviceScaleFactor: 1, mobile: false });
    await open("");
    await browser.until(`!${canvas}.hidden && ${canvas}.width === 800 && document.getElementById("step").disabled`);
    expect(await browser.evaluate(`document.getElementById("pattern").hidden`), "a model is shown as a plane");
    await until_like("model", "the model");
    // The strip of stages shows the model, not the rows of cells, and a press chooses the cell to measure.
    const picture = await browser.evaluate(`(({ width, height, hidden }) => [width, height, hidden])(document.querySelector("#stages canvas"))`);
    expect(Math.min(...picture.slice(0, 2)) > 10 && !picture[2], `the picture of the stage is ${picture}`);
    await browser.evaluate(`document.getElementById("measure").open = true, document.getElementById("pick").click()`);
    await browser.drag(400, 300, 400, 300);
    const probed = `document.querySelector("#probe figcaption").textContent`;
    await browser.until(`/^cell \\d+: \\w/.test(${probed}) && !document.querySelector(".mark.probe").hidden`);
    const measured = await cell_at(400, 300);
    expect((await browser.evaluate(probed)).startsWith(`cell ${measured.cell}: `), `the cell ${measured.cell} is measured as ${await browser.evaluate(probed)}`);
    await browser.until(`${probed}.includes("${measured.value}")`);
    await browser.evaluate(`document.getElementById("measure").open = false`);
    for (let k = 0; k < 5; ++k) await browser.press("ArrowRight");
    await browser.press("ArrowUp");
    await until_like("turned", "the turned model");
    await browser.press("0");
    await until_like("model", "the model from the front");

    // Beside the model, the pointer turns it. Zooming keeps the cell under the pointer.
    await browser.drag(60, 60, 160, 40);
    await until_like("dragged", "the model after dragging");
    const there = [430, 330], before = await cell_at(...there);
    expect(before.cell !== undefined, "no cell is under the pointer");
    await browser.wheel(...there, -1000);
    await browser.until(`document.getElementById("frame").hasAttribute("data-moved")`);
    await browser.evaluate("new Promise((resolve) => setTimeout(resolve, 300))");
    await point(there[0] + 1, there[1]);
    const after = await cell_at(...there);
    expect(after.cell === before.cell, `cell ${after.cell} instead of ${before.cell} is under the pointer`);
    await browser.drag(...there, there[0] + 50, there[1] + 30, "middle");
    expect((await cell_at(there[0] + 50, there[1] + 30)).cell === before.cell, "the middle button does not move what is seen");
    expect((await cell_at(...there)).cell !== before.cell, "nothing has moved");
    await browser.press("0");

    // A stroke changes only the cells under it, and one undo restores them. After a reload the pattern does not
    // continue.
    await until_like("model", "the model from the front again");
    await open("");
    await until_like("model", "the model after a reload");
    const far = [445, 530], old_far = await cell_at(...far), old = await cell_at(...there);
    await browser.evaluate(`document.getElementById("amount").value = "7"`);
    await browser.drag(there[0] - 40, there[1], there[0], there[1]);
    const until_value = (wanted) => browser.eventually(async () => (await cell_at(...there)).value === wanted,
        async () => `the cell is ${JSON.stringify(await cell_at(...there))} instead of ${wanted}`);
    await until_value(7);
    expect((await cell_at(there[0] - 40, there[1])).value === 7, "the stroke has no beginning");
    expect((await cell_at(...far)).value === old_far.value, "a cell far from the stroke has changed");
    writeFileSync("model_page.png", await browser.screenshot());
    await click("undo");
    await until_value(old.value);

    // A model with creases, a surface given by formulas with a hole, and this surface as a plane.
    await type_script("box.cascade");
    await until_like("box", "the box");
    await type_script("hole.cascade");
    await browser.until(`!document.getElementById("flat").hidden`);
    // Parts visible through the hole get light from a few directions only.
    await until_like("hole", "the surface with a hole", [4, 0.03]);
    const [column, row] = (await cell_at(520, 330)).cell.split(", ").map(Number);
    expect(Math.abs(column - 115) < 16 && row > 14, `through the hole cell ${column}, ${row} is seen`);
    await click("flat");
    await browser.until(`${canvas}.hidden && !document.getElementById("pattern").hidden`);
    let flat;
    await browser.eventually(async () => (flat = await difference("pattern", "flat"))[0] <= 0.5 && flat[1] === 0, () => `the plane differs by ${flat}`);
    await click("flat");

    // Cells that crawl on a model and on a plane. The light between them is less exact than in
    // pictures of `cascade run`.
    await type_script("crawling.cascade");
    await browser.until(`document.getElementById("place").textContent === "step 0 · 60 cells"`);
    const count = `Number(document.getElementById("place").textContent.match(/(\\d+) cells/)[1])`;
    // The brushes of a script may arrive after its first picture.
    await browser.until(`{ const brush = document.getElementById("brush"); brush.value = "remove"; brush.value === "remove" }`);
    // At first the cell under the pointer may be that of the previous grid, "115, 20", or none.
    await browser.eventually(async () => /^\d+$/.test((await cell_at(430, 300)).cell), () => "no cell is under the pointer");
    await browser.drag(270, 300, 430, 310);
    await browser.until(`${count} < 60`);
    expect(await browser.evaluate(count) > 50, `of 60 cells a stroke leaves ${await browser.evaluate(count)}`);
    await click("undo");
    await browser.until(`${count} === 60`);
    await browser.grow();
    await browser.until(`document.getElementById("step").disabled`);
    await until_like("crawling", "the cells on a sphere", [7, 0.05]);
    writeFileSync("crawling_page.png", await browser.screenshot());
    await type_script("crowd.cascade");
    await browser.until(`document.getElementById("step").disabled && document.getElementById("place").textContent.endsWith(" 3 cells")`);
    await until_like("crowd", "the cells on a plane", [7, 0.05]);

    // Without WebGL2 the page says so.
    await type_script("model.cascade");
    await open("?2d");
    await browser.until(`document.getElementById("notice").textContent.includes("WebGL2")`);

    const complaints = browser.heard.filter((words) => !words.startsWith("Applying inline style"));
    expect(complaints.length === 0, `the page complains: ${complaints.join("\n")}`);
}

await steer().then(() => end(), end);
