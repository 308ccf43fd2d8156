// The page can be used without sight and with a keyboard alone: axe-core finds no serious problem
// in any state of the page, with `cascade view` and in an exported page, on a wide and on a narrow
// screen. Arguments: the browser, the program, and the text of axe-core. spots.cascade, and
// spots.html if there is an engine, are in the current folder.
import { existsSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { Browser, ending, serve } from "./browser.mjs";

const [command, program, axe_file] = process.argv.slice(2);
const axe = readFileSync(axe_file, "utf8");
const { cascade, address } = await serve(program, "spots.cascade");
const browser = await Browser.start(command, join(process.cwd(), "profile_of_access"));
const end = ending(browser, cascade);

const set = (code) => browser.evaluate(`{ ${code} }`);

const controls = ["button", "checkbox", "combobox", "DisclosureTriangle", "link", "searchbox", "slider", "spinbutton", "textbox"];

/// Checks the present page with axe-core, and that every control has a name in the browser's accessibility tree.
async function expect_access(state) {
    const { nodes } = await browser.call("Accessibility.getFullAXTree");
    const nameless = nodes.filter(({ ignored, role, name }) => !ignored && controls.includes(role.value) && !name?.value);
    if (nameless.length > 0) throw new Error(`${state}: ${nameless.length} controls have no name, such as a ${nameless[0].role.value}`);
    const found = await browser.evaluate(`axe.run(document, { resultTypes: ["violations"] }).then(({ violations }) => violations
        .filter(({ impact }) => impact === "serious" || impact === "critical")
        .map(({ id, nodes }) => id + ": " + nodes.slice(0, 3).map(({ target, failureSummary }) => target + " " + failureSummary.replace(/\\s+/g, " ")).join("; ")))`);
    if (found.length > 0) throw new Error(`${state}: ${found.join("\n")}`);
}

/// States of the page, each with functions that open and close it.
const states = {
    "first steps": [`document.getElementById("help_button").click(); document.querySelector("#help form button").click()`, `document.getElementById("tour_end").click()`],
    "keys": [`document.getElementById("help_button").click()`, `document.getElementById("help").close()`],
    "lines": [`document.getElementById("look").open = true`, `document.getElementById("look").open = false`],
    "save": [`document.getElementById("save").open = true`, `document.getElementById("save").open = false`],
    "measures": [`document.getElementById("measure").open = true`, `document.getElementById("measure").open = false`],
    "link": [`document.getElementById("link").click()`, `document.getElementById("link_dialog").close()`],
    "library": [`document.getElementById("systems").click()`, `document.getElementById("library").close()`],
};

async function look_at(engine, url, names) {
    await browser.open(url);
    await browser.until(`document.querySelectorAll("#stages li").length === 2 && document.querySelector("#controls [type=range]") !== null`);
    await set(`localStorage.was_taught = "yes"; document.getElementById("tour").hidden = true`);
    // A text with errors shows its messages.
    await browser.evaluate(`document.getElementById("editor").shadowRoot.querySelector(".cm-content").focus()`);
    await browser.call("Input.insertText", { text: "}" });
    await browser.until(`document.getElementById("messages").textContent !== ""`);
    await browser.evaluate(axe);
    for (const [width, scheme] of [[1280, "light"], [390, "dark"]]) {
        await browser.call("Emulation.setDeviceMetricsOverride", { width, height: 800, deviceScaleFactor: 1, mobile: width < 500 });
        await browser.call("Emulation.setEmulatedMedia", { features: [{ name: "prefers-color-scheme", value: scheme }] });
        await expect_access(`${engine}, ${width} pixels`);
        for (const name of names) {
            const [open, close] = states[name];
            await set(open);
            await expect_access(`${engine}, ${width} pixels, ${name}`);
            await set(close);
        }
    }
}

async function look() {
    await look_at("native", address, ["first steps", "keys", "lines", "save", "measures"]);
    if (existsSync("spots.html")) await look_at("exported", pathToFileURL("spots.html").href, ["save", "link", "library"]);
}

await look().then(() => end(), end);
