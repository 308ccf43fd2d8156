// Smooth planes, on the page of `cascade view` and on exported ones: as `cascade run --size` draws them, and squares when
// one zooms to single cells. Arguments: the browser and the program; *.cascade, and the exported pages *.html, are in the
// current folder. Screenshots are left there.
import { spawnSync } from "node:child_process";
import { existsSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { Browser, ending, expect, serve } from "./browser.mjs";

const [command, program] = process.argv.slice(2);
const scripts = ["spots", "colours"];
const servers = [];
for (const name of scripts) servers.push(await serve(program, `${name}.cascade`));
const browser = await Browser.start(command, join(process.cwd(), "profile_of_smooth"));
const end = ending(browser, ...servers.map(({ cascade }) => cascade));

const click = (id) => browser.click(`#${id}`);
const box = () => browser.evaluate(`(({ x, y, width, height }) => [x, y, width, height])(document.getElementById("pattern").getBoundingClientRect())`);
const sides = () => browser.evaluate(`(({ width, height }) => [width, height])(document.getElementById("pattern"))`);
const choose = (id, value, kind = "change") => browser.evaluate(`{ const field = document.getElementById("${id}"); field.value = "${value}"; field.dispatchEvent(new Event("${kind}")); }`);

/// The mean and the largest difference between the levels of the canvas and of a picture, both on
/// white.
const difference = (name) => browser.evaluate(`(async () => {
    const wanted = new Image();
    await new Promise((resolve) => { wanted.onload = resolve; wanted.src = "data:image/png;base64,${readFileSync(name).toString("base64")}"; });
    const levels = (image) => {
        const copy = document.createElement("canvas"), pen = copy.getContext("2d");
        [copy.width, copy.height] = [wanted.width, wanted.height];
        pen.fillStyle = "white";
        pen.fillRect(0, 0, copy.width, copy.height);
        pen.drawImage(image, 0, 0);
        return pen.getImageData(0, 0, copy.width, copy.height).data;
    };
    const a = levels(document.getElementById("pattern")), b = levels(wanted), away = a.map((level, k) => Math.abs(level - b[k]));
    return [away.reduce((sum, level) => sum + level, 0) / away.length, away.reduce((most, level) => Math.max(most, level), 0)];
})()`);

/// A pixel of a picture is the mean of four points in linear light. A pixel of the page is one
/// point, so edges differ a bit.
async function until_smooth(name, how, is_wanted = (mean) => mean < 1) {
    let drawn, found;
    await browser.eventually(async () => {
        const size = await sides();
        if (size[0] <= 300) return false;
        if (drawn !== size.join("x")) {
            drawn = size.join("x");
            const run = spawnSync(program, ["run", `${name}.cascade`, "--palette", "leopard", "--size", drawn, "-o", "smooth_wanted.png", "--quiet"], { encoding: "utf8" });
            expect(run.status === 0, run.stderr);
        }
        found = await difference("smooth_wanted.png");
        return is_wanted(found[0]);
    }, async () => `${how}: a canvas of ${await sides()} pixels differs by ${found?.[0]}, at most by ${found?.[1]} levels`);
    return found[0];
}

const until_squares = (columns, how) => browser.eventually(async () => (await sides())[0] === columns, async () => `${how} have ${await sides()} pixels`);

async function open(address, stages) {
    await browser.open(address);
    await browser.until(`document.querySelectorAll("#stages li").length === ${stages} && document.getElementById("step").disabled`);
    await choose("palette", "leopard");
}

async function look(name, address, stages, how) {
    await open(address, stages);
    const columns = name === "spots" ? 48 : 40, squares = `document.getElementById("squares")`;
    expect(await browser.evaluate(`!${squares}.checked`), `${how}: planes are not smooth from the start`);
    const mean = await until_smooth(name, how);
    writeFileSync(`smooth_${how}.png`, await browser.screenshot());

    // With the option `squares`, the page shows the picture of cells, in which each cell is a
    // square.
    await click("squares");
    await until_squares(columns, `${how}: squares`);
    await click("squares");

    // If the view is zoomed to single cells, cells are squares, too. After zooming out, planes are
    // smooth again.
    const [x, y, width, height] = await box();
    await browser.wheel(x + width / 2, y + height / 2, -10000);
    await browser.until(`document.getElementById("pattern").getBoundingClientRect().width > ${4 * width}`);
    await until_squares(columns, `${how}: single cells`);
    writeFileSync(`smooth_near_${how}.png`, await browser.screenshot());
    await click("fit");
    await until_smooth(name, `${how}, zoomed out again`, (again) => Math.abs(again - mean) < 1e-9);

    // Lines and relief lie over the smooth colours.
    if (name !== "spots") return;
    const [plain] = await difference("smooth_wanted.png");
    await choose("relief", "0.5", "input");
    let lit;
    await browser.eventually(async () => ([lit] = await difference("smooth_wanted.png"))[0] > plain + 0.3 && lit < 40, () => `${how}: relief differs by ${lit} from ${plain}`);
    writeFileSync(`smooth_lit_${how}.png`, await browser.screenshot());
    await choose("relief", "0", "input");
}

async function steer() {
    await browser.call("Emulation.setDeviceMetricsOverride", { width: 1280, height: 800, deviceScaleFactor: 1, mobile: false });
    await browser.begin_with({ squares: "0" });
    for (const [k, name] of scripts.entries()) {
        const stages = 2 - k;
        await look(name, servers[k].address, stages, name);
        if (existsSync(`${name}.html`)) await look(name, pathToFileURL(`${name}.html`).href, stages, `exported_${name}`);
    }
    const complaints = browser.heard.filter((words) => !words.startsWith("Applying inline style"));
    expect(complaints.length === 0, `the page complains: ${complaints.join("\n")}`);
}

await steer().then(() => end(), end);
