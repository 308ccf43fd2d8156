// Opens the exported pages spots.html and ball.html from the disk, without a network. Argument: the browser. spots.png
// is the picture of the script by `cascade run`. Screenshots are left in the current folder.
import { deflateSync } from "node:zlib";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { Browser, ending, expect } from "./browser.mjs";

const browser = await Browser.start(process.argv[2], join(process.cwd(), "profile"));
const end = ending(browser);

const click = (id) => browser.click(`#${id}`);
const is_over = `document.querySelectorAll("#stages li").length > 0 && document.getElementById("step").disabled`;
const text = () => browser.evaluate(`document.getElementById("editor").shadowRoot.querySelector(".cm-content").innerText`);

const open = (page, fragment = "") => browser.open(pathToFileURL(page).href + fragment);

const pixels = (image) => browser.evaluate(`(async () => {
    const image = await (${image}), copy = document.createElement("canvas");
    [copy.width, copy.height] = [image.width, image.height];
    copy.getContext("2d").drawImage(image, 0, 0);
    return [image.width, image.height, ...copy.getContext("2d").getImageData(0, 0, image.width, image.height).data];
})()`);

/// Waits until the canvas is like a picture of `cascade run`. The page refines its light during
/// some pictures, and the light of `cascade run` is more exact.
async function expect_likeness(name, most = 2.5) {
    let mean;
    const is_like = async () => {
        mean = await browser.evaluate(`(async () => {
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
            const a = levels(document.getElementById("solid")), b = levels(wanted);
            return a.reduce((sum, level, k) => sum + Math.abs(level - b[k]), 0) / a.length;
        })()`);
        return mean < most;
    };
    await browser.eventually(is_like, () => `what is seen differs from ${name}.png by ${mean} levels`);
}

/// Makes the canvas as large as pictures of `cascade run`.
async function enlarge() {
    await browser.evaluate(`Object.assign(document.getElementById("solid").style, { position: "fixed", left: 0, top: 0, width: "800px", height: "600px" })`);
    await browser.until(`document.getElementById("solid").width === 800`);
}

async function expect_the_picture(how, name = "spots") {
    await browser.evaluate(`{ const choice = document.getElementById("palette"); choice.value = "leopard"; choice.dispatchEvent(new Event("change")); }`);
    const wanted = await pixels(`new Promise((resolve) => {
        const image = new Image();
        image.onload = () => resolve(image);
        image.src = "data:image/png;base64,${readFileSync(`${name}.png`).toString("base64")}";
    })`);
    let found, differs;
    const is_like = async () => {
        found = await pixels(`document.getElementById("pattern")`);
        differs = found.findIndex((level, k) => Math.abs(level - wanted[k]) > (k < 2 ? 0 : 1));
        return found.length === wanted.length && differs < 0;
    };
    await browser.eventually(is_like, () => `${how}: the canvas differs from ${name}.png at ${differs}: ${found[differs]} and not ${wanted[differs]}`);
}

try {
    await browser.call("Network.enable");
    await browser.call("Network.emulateNetworkConditions", { offline: true, latency: 0, downloadThroughput: 0, uploadThroughput: 0 });
    await open("spots.html");
    await browser.until(is_over);
    await expect_the_picture("grown by itself");
    expect(await browser.evaluate(`document.getElementById("load").hidden`), "a page without the program offers to load models");
    writeFileSync("exported.png", await browser.screenshot());

    // A slider, a stroke and undo, as in `cascade view`.
    await browser.evaluate(`{ const slider = document.querySelector("#controls [type=range]"); slider.value = 0.06; slider.dispatchEvent(new Event("input")); slider.dispatchEvent(new Event("change")); }`);
    await browser.until(`!document.getElementById("undo").disabled`);
    await click("undo");
    await browser.until(`document.getElementById("undo").disabled`);
    await browser.restart();
    await browser.grow();
    await browser.until(is_over);
    await expect_the_picture("after undo");
    await click("systems");
    await browser.until(`document.querySelectorAll("#systems_list li, dialog[open] li").length > 50`);
    await browser.press("Escape");

    // A script in the link, with and without errors.
    const packed = (script) => `#script=${deflateSync(script).toString("base64").replaceAll("+", "-").replaceAll("/", "_")}`;
    const linked = `domain { grid: 32, 32 }\nsystem linked { u: x; u' = lap(u) / 8 }\nstage only: linked { iterations: 20 }\n`;
    await open("spots.html", packed(linked));
    await browser.until(is_over);
    expect((await text()).includes("system linked"), "the linked script is not there");
    const wrong = [[packed("system wrong {"), "line 1: "], ["#script=AAAA", "the link was cut off"], [packed("#".repeat(2 ** 21)), "1 MiB"]];
    for (const [link, why] of wrong) {
        await open("spots.html", link);
        await browser.until(`document.querySelectorAll("#stages li").length === 2 && document.getElementById("notice").textContent.includes("${why}")`);
        expect((await text()).includes("system spots"), "the page's own script is not there after a wrong link");
    }
    // Another link in the same tab: the page is loaded again, so this request gets no answer.
    await browser.evaluate(`location.hash = "${packed(linked)}"; new Promise(() => {})`).catch(() => {});
    await browser.until(`document.querySelectorAll("#stages li").length === 1 && ${is_over}`);

    await open("volume.html");
    await browser.until(is_over);
    await expect_the_picture("a slice of a volume", "volume");

    // The page contains the cells of a model and draws the model like `cascade run`.
    await browser.call("Emulation.setDeviceMetricsOverride", { width: 1280, height: 800, deviceScaleFactor: 1, mobile: false });
    await open("ball.html");
    await browser.until(is_over);
    await browser.evaluate(`{ const choice = document.getElementById("palette"); choice.value = "zebra"; choice.dispatchEvent(new Event("change")); }`);
    await enlarge();
    await expect_likeness("ball");
    writeFileSync("exported_ball.png", await browser.screenshot());
    const shown = await browser.evaluate(`!document.getElementById("solid").hidden && document.getElementById("place").textContent`);
    expect(shown.startsWith?.("step 80"), `the model shows ${shown}`);
    // A linked script can use these cells if it has the same model. No other model can be used.
    const shown_at_end = async (script) => {
        await open("ball.html", packed(script));
        await browser.until(`${is_over} || document.getElementById("notice")?.textContent`);
        return browser.evaluate(`document.getElementById("notice").textContent || document.getElementById("editor").shadowRoot.querySelector(".cm-content").innerText`);
    };
    const of_model = (model) => `domain { mesh: ${model}; cells: 2000 }\nsystem new { u: z; u' = 0.1 * lap(u) }\nstage only: new { iterations: 5 }\n`;
    const same = await shown_at_end(of_model('"ball.off"'));
    expect(same.includes("system new"), `with the same model it shows ${same}`);
    const other = await shown_at_end(of_model('"other.off"'));
    expect(other.includes("other.off"), `with another model it shows ${other}`);

    // Cells that crawl. The light between them is less exact than in pictures of `cascade run`.
    await open("crawling.html");
    await browser.until(is_over);
    await enlarge();
    await expect_likeness("crawling", 7);
    writeFileSync("exported_crawling.png", await browser.screenshot());
    expect(browser.heard.length === 0, `the pages said: ${browser.heard.join("\n")}`);
} catch (error) {
    await end(error);
}
await end();
