// Follows the links of the static site in the folder `site`, from the disk and without a network: no link is broken,
// scripts grow, words are found, and axe-core finds no serious problem. Arguments: the browser, and the text of axe-core
// if it is installed. Screenshots are left in the current folder.
import { existsSync, readFileSync, readdirSync, statSync, writeFileSync } from "node:fs";
import { dirname, join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { Browser, ending, expect } from "./browser.mjs";

const pages = readdirSync("site", { recursive: true }).filter((name) => name.endsWith(".html") && !/live|animal/.test(name));
let links = 0;
for (const page of pages) {
    const text = readFileSync(join("site", page), "utf8");
    for (const [, address] of text.matchAll(/(?:href|src)="([^"]*)"/g)) {
        if (/^(https?|data):/.test(address)) continue;
        const [path, fragment] = address.split("#"), target = path === "" ? join("site", page) : resolve("site", dirname(page), path);
        expect(existsSync(target), `${page}: ${address.slice(0, 60)} is not there`);
        expect(!fragment || fragment.startsWith("script=") || readFileSync(target, "utf8").includes(`id="${fragment}"`), `${page}: ${address} has no such heading`);
        ++links;
    }
    expect(page === "search.html" || !/<script/i.test(text), `${page} has a script`);
}
const bytes = readdirSync("site", { recursive: true }).reduce((sum, name) => sum + statSync(join("site", name)).size, 0);
expect(bytes < 30e6, `the site has ${bytes} bytes`);
expect(pages.length > 55 && links > 1000, `there are only ${pages.length} pages with ${links} links`);

const browser = await Browser.start(process.argv[2], join(process.cwd(), "profile"));
const end = ending(browser);

const open = (page) => browser.open(pathToFileURL("site/").href + page);
/// Waits until the exported page has the script of the link and its pattern grows.
async function expect_growth(words) {
    await browser.until(`document.querySelectorAll("#stages li").length > 0`);
    await browser.until(`[...document.querySelectorAll("#stages progress")].some(({ value }) => value > 0)`);
    const text = await browser.evaluate(`document.getElementById("editor").shadowRoot.querySelector(".cm-content").textContent`);
    expect(text.includes(words), `the script is ${text}`);
}

/// Fails if axe-core finds a serious problem.
async function expect_access(name) {
    if (!process.argv[3]) return;
    await browser.evaluate(readFileSync(process.argv[3], "utf8"));
    const found = await browser.evaluate(`axe.run(document, { resultTypes: ["violations"] }).then(({ violations }) => violations
        .filter(({ impact }) => impact === "serious" || impact === "critical")
        .map(({ id, nodes }) => id + ": " + nodes.slice(0, 3).map(({ target }) => target).join("; ")))`);
    expect(found.length === 0, `${name}: ${found.join("\n")}`);
}

try {
    await browser.call("Network.enable");
    await browser.call("Network.emulateNetworkConditions", { offline: true, latency: 0, downloadThroughput: 0, uploadThroughput: 0 });
    for (const [name, width, scheme] of [["wide", 1280, "light"], ["dark", 1280, "dark"], ["phone", 375, "light"]]) {
        await browser.call("Emulation.setDeviceMetricsOverride", { width, height: 844, deviceScaleFactor: 1, mobile: width < 500 });
        await browser.call("Emulation.setEmulatedMedia", { features: [{ name: "prefers-color-scheme", value: scheme }] });
        for (const page of ["index.html", "tutorial.html", "systems.html", "museum.html", "spec/stages.html", "one_step.html", "search.html?q=turing"]) {
            await open(page);
            const overflow = await browser.evaluate("document.documentElement.scrollWidth - innerWidth");
            expect(overflow <= 0, `${name}: ${page} is ${overflow} pixels too wide`);
            if (name !== "wide") await expect_access(`${name}, ${page}`);
            writeFileSync(`${name}_${page.replace("/", "_").replace(/html.*/, "png")}`, await browser.screenshot());
        }
    }
    await open("search.html?q=frozen%20spots");
    await browser.until(`document.querySelectorAll("#found a").length > 2`);
    const without = await browser.evaluate(`[...document.querySelectorAll("#found a")].filter(({ href }) => !/\\.html#/.test(href)).length`);
    expect(without === 0, `${without} results of the search lead nowhere`);
    await open("search.html?q=nosuchword");
    await browser.until(`document.getElementById("count").textContent === "0 places"`);
    await open("index.html");
    await browser.until(`document.querySelectorAll(".gallery img").length > 30`);
    await browser.click(`.gallery a[href*="script="]`);
    await expect_growth("Appendix C");
    for (const [page, words] of [["tutorial.html", "the spots stay as they are"], ["spec/stages.html", "stage"]]) {
        await open(page);
        await browser.click(".live .grow");
        await expect_growth(words);
    }
    writeFileSync("grown.png", await browser.screenshot());
    await open("index.html");
    await browser.until(`document.querySelectorAll("#cells + .gallery img").length > 4`);
    await browser.click(`#cells + .gallery a[href*="script="]`);
    await expect_growth("Fleischer et al. 1995");
    await browser.until(`/^step [\\d,]+ · [\\d,]+ cells/.test(document.getElementById("place").textContent)`);
    writeFileSync("cells.png", await browser.screenshot());
    await open("index.html");
    await browser.click(`#lessons + p a[href*="script="]`);
    await expect_growth("# exercise: Spots that stay");
    await browser.until(`!document.getElementById("lesson").hidden && document.querySelector("#lesson small").textContent.startsWith("now ")`);
    writeFileSync("exercise.png", await browser.screenshot());
    await open("animal.html");
    await expect_growth("surface: leopard");
    await end();
} catch (error) {
    await end(error);
}
