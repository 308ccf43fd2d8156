// Models and surfaces on the page of `cascade view spots.cascade`: what is seen of them is what `cascade run` draws, and
// pointers and keys turn, enlarge and paint them. Arguments: the browser and the program. Screenshots are left in the
// current folder.
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { Browser, ending, expect, serve } from "./browser.mjs";

const [command, program] = process.argv.slice(2);
const { cascade, address } = await serve(program, "model.cascade");
const browser = await Browser.start(command, join(process.cwd(), "profile_of_solids"));
const end = ending(browser, 4, cascade);

const click = (id) => browser.evaluate(`document.getElementById("${id}").click()`);
const canvas = `document.getElementById("solid")`;

/// The mean difference of levels between a canvas and a picture, and the part of them that differ by more than 24.
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

/// Light gets better for some pictures.
async function until_like(name, how, most = [2.5, 0.01]) {
    let last;
    for (let k = 0; k < 60; ++k) {
        last = await difference("solid", name);
        if (last[0] <= most[0] && last[1] <= most[1]) return;
        await new Promise((resolve) => setTimeout(resolve, 200));
    }
    throw new Error(`${how}: levels differ by ${last[0]}, and ${last[1]} of them by more than 24`);
}

async function type_script(name) {
    await browser.type_script(readFileSync(name, "utf8"));
    await browser.evaluate("document.activeElement.blur()");
}

const point = (x, y) => browser.call("Input.dispatchMouseEvent", { type: "mouseMoved", x, y });
const pointed = `document.getElementById("pointed").textContent`;
/// The cell under a pointer and its value.
async function cell_at(x, y) {
    await point(x, y);
    const [, cell, value] = (await browser.evaluate(pointed)).match(/cell ([\d, ]+): ([-\d.e]+)/) ?? [];
    return { cell, value: Number(value) };
}

/// As large as pictures of `cascade run`, and without the colours of the page.
async function open(question) {
    await browser.call("Page.navigate", { url: "about:blank" });  // Another fragment alone would not leave the page at once.
    await browser.call("Page.navigate", { url: address.replace("/#", `/${question}#`) });
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
    // The strip shows what is seen, not the rows of cells, and a cell is measured where it is pressed.
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

    // Beside it the pointer turns it, and enlarging keeps the cell under the pointer.
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

    // A stroke changes the cells under it and no others, and one undo takes it back. After a reload it does not grow on.
    await until_like("model", "the model from the front again");
    await open("");
    await until_like("model", "the model after a reload");
    const far = [445, 530], old_far = await cell_at(...far), old = await cell_at(...there);
    await browser.evaluate(`document.getElementById("amount").value = "7"`);
    await browser.drag(there[0] - 40, there[1], there[0], there[1]);
    for (let k = 0; k < 100 && (await cell_at(...there)).value !== 7; ++k);
    expect((await cell_at(...there)).value === 7, `the painted cell is ${JSON.stringify(await cell_at(...there))}`);
    expect((await cell_at(there[0] - 40, there[1])).value === 7, "the stroke has no beginning");
    expect((await cell_at(...far)).value === old_far.value, "a cell far from the stroke has changed");
    writeFileSync("model_page.png", await browser.screenshot());
    await click("undo");
    for (let k = 0; k < 100 && (await cell_at(...there)).value !== old.value; ++k);
    expect((await cell_at(...there)).value === old.value, "the stroke is not undone");

    // Creases, a surface of parameters with a hole, and its plane.
    await type_script("box.cascade");
    await until_like("box", "the box");
    await type_script("hole.cascade");
    await browser.until(`!document.getElementById("flat").hidden`);
    // What is seen through the hole gets its light from a few directions only.
    await until_like("hole", "the surface with a hole", [4, 0.03]);
    const [column, row] = (await cell_at(520, 330)).cell.split(", ").map(Number);
    expect(Math.abs(column - 115) < 16 && row > 14, `through the hole cell ${column}, ${row} is seen`);
    await click("flat");
    await browser.until(`${canvas}.hidden && !document.getElementById("pattern").hidden`);
    for (let k = 0; k < 50 && (await difference("pattern", "flat"))[0] > 0.5; ++k);
    const flat = await difference("pattern", "flat");
    expect(flat[0] <= 0.5 && flat[1] === 0, `the plane differs by ${flat}`);
    await click("flat");

    // Cells that crawl, on a model and on a plane. Of the light between them the page knows less than pictures.
    await type_script("crawling.cascade");
    await browser.until(`document.getElementById("place").textContent === "step 0 · 60 cells"`);
    const count = `Number(document.getElementById("place").textContent.match(/(\\d+) cells/)[1])`;
    // The brushes of a script may come after its first picture.
    await browser.until(`{ const brush = document.getElementById("brush"); brush.value = "remove"; brush.value === "remove" }`);
    // What is pointed at may still be a cell of the grid before, "115, 20", or nothing.
    for (const end = Date.now() + 120000; Date.now() < end && !/^\d+$/.test((await cell_at(430, 300)).cell);) {
        await new Promise((resolve) => setTimeout(resolve, 50));
    }
    await browser.drag(270, 300, 430, 310);
    await browser.until(`${count} < 60`);
    expect(await browser.evaluate(count) > 50, `of 60 cells a stroke leaves ${await browser.evaluate(count)}`);
    await click("undo");
    await browser.until(`${count} === 60`);
    await click("run");
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
