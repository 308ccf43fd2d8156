// Links with a script: of an exported page on a server, of an exported page on a disk, and of `cascade view`. jsQR
// reads the QR code. Arguments: the browser, the program and the folder of jsQR; spots.cascade, and spots.html if there
// is an engine, are in the current folder. Screenshots are left there.
import { existsSync, readFileSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { Browser, ending, expect, serve } from "./browser.mjs";

const [command, program, modules] = process.argv.slice(2);
const read_code = createRequire(import.meta.url)(join(process.cwd(), modules, "jsqr"));
const { cascade, address } = await serve(program, "spots.cascade");
const browser = await Browser.start(command, join(process.cwd(), "profile_of_link"));
const end = ending(browser, cascade);

const own = readFileSync("spots.cascade", "utf8");
const text = `document.getElementById("editor").shadowRoot.querySelector(".cm-content").innerText`;
const has_stages = (count) => browser.until(`document.querySelectorAll("#stages li").length === ${count} && document.getElementById("place").textContent !== ""`);
const another = `# µ: 🙂 "x" + y / z?\ndomain { grid: 16, 16 }\nsystem still { u: x; u' = 0 }\nstage only: still { iterations: 3 }\n`;

const open = (url) => browser.open(url);
const type_script = (text) => browser.type_script(text);

/// The link, the text beside it, and the content of the QR code if there is one.
async function link(screenshot) {
    await browser.evaluate(`document.querySelector("#link_dialog p").textContent = "", document.getElementById("link").click()`);
    await browser.until(`document.getElementById("link_dialog").open && document.querySelector("#link_dialog p").textContent !== ""`);
    if (screenshot) {
        writeFileSync(screenshot, await browser.screenshot());
        expect(await browser.evaluate(`document.querySelector("#link_dialog canvas").getBoundingClientRect().right <= innerWidth`), "the code is too wide");
    }
    return browser.evaluate(`{
        const canvas = document.querySelector("#link_dialog canvas"), { width, height, hidden } = canvas;
        document.getElementById("link_dialog").close();
        ({
            link: document.querySelector("#link_dialog input").value, said: document.querySelector("#link_dialog small").textContent,
            code: hidden ? undefined : { width, height, data: [...canvas.getContext("2d").getImageData(0, 0, width, height).data] },
        });
    }`);
}

async function of_the_program() {
    await open(address);
    await has_stages(2);
    await type_script(another);
    await has_stages(1);
    const copied = await link();
    expect(!copied.code && copied.said.includes("cascade export"), `it says: ${copied.said}`);
    await type_script(own);
    await has_stages(2);
    await open(copied.link);
    await has_stages(1);
    expect((await browser.evaluate(text)).trim() === another.trim(), "the linked script is not there");
    expect(await browser.evaluate("location.hash") === "", "the token stays in the address");
    // Without the token a link changes nothing.
    await type_script(own);
    await has_stages(2);
    await open(copied.link.replace(/token=[^&]*&/, ""));
    await has_stages(2);
    await new Promise((resolve) => setTimeout(resolve, 300));
    expect(!(await browser.evaluate(text)).includes("still"), "a link without the token changes the session");
    await open(copied.link.slice(0, -30));
    await browser.until(`document.getElementById("notice")?.textContent.includes("cannot be read")`);
}

async function of_an_exported_page() {
    // For a page on a disk there is no QR code, since other devices cannot open it.
    await open(pathToFileURL("spots.html").href);
    await has_stages(2);
    const on_disk = await link();
    expect(!on_disk.code && on_disk.said.includes("where this file is"), `on a disk it says: ${on_disk.said}`);
    await open(on_disk.link);
    await has_stages(2);

    // On a server.
    await browser.call("Fetch.enable", { patterns: [{ urlPattern: "http://patterns.test/*" }] });
    const body = readFileSync("spots.html").toString("base64");
    const take = browser.take.bind(browser);
    browser.take = (message) => {
        if (message.method !== "Fetch.requestPaused") return take(message);
        browser.call("Fetch.fulfillRequest", { requestId: message.params.requestId, responseCode: 200, responseHeaders: [{ name: "Content-Type", value: "text/html" }], body });
    };
    await open("http://patterns.test/spots.html");
    await has_stages(2);
    await type_script(another);
    await has_stages(1);
    for (const [width, name] of [[1280, "link.png"], [390, "link_phone.png"]]) {
        await browser.call("Emulation.setDeviceMetricsOverride", { width, height: 800, deviceScaleFactor: 1, mobile: width < 500 });
        const { link: copied, code } = await link(name);
        expect(copied.startsWith("http://patterns.test/spots.html#script="), `the link is ${copied}`);
        const read = code && read_code(Uint8ClampedArray.from(code.data), code.width, code.height)?.data;
        expect(read === copied, `the code says ${read}`);
    }
    const { link: copied } = await link();
    await open(copied);
    await has_stages(1);
    expect((await browser.evaluate(text)).trim() === another.trim(), "the linked script is not there");
    let seed = 1;
    const noise = Array.from({ length: 3000 }, () => String.fromCharCode(33 + (seed = seed * 48271 % 2147483647) % 90)).join("");
    await type_script(`${another}# ${noise}\n`);
    const long = await link();
    expect(!long.code && long.said.includes("too long"), `of a long script it says: ${long.said}`);
}

await of_the_program().then(() => existsSync("spots.html") && of_an_exported_page()).then(() => end(), end);
