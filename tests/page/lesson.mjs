// Exercises and languages, on the page of `cascade view` and on a page that carries its engine:
// locked lines stay, the hint opens, goals are measured, goals that are met are reported, and
// labels are in the language of the browser or in a chosen language. Arguments: the browser, the
// program, a script and, to test an exported page, that page.
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { Browser, ending, expect, serve } from "./browser.mjs";

const [command, program, script, exported] = process.argv.slice(2);
const { cascade, address } = exported ? { address: pathToFileURL(exported).href } : await serve(program, script);
const browser = await Browser.start(command, join(process.cwd(), `profile_of_lesson${exported ? "_2" : ""}`));
const end = ending(browser, ...(cascade ? [cascade] : []));

const text = `document.getElementById("editor").shadowRoot.querySelector(".cm-content").innerText.replaceAll("\\u00a0", " ")`;
const of_lesson = (selector) => `document.querySelector("#lesson ${selector}").textContent`;
const goals = `[...document.querySelectorAll("#lesson li")].map((item) => [...item.children].map(({ textContent }) => textContent))`;
const is_over = `document.querySelectorAll("#stages li").length > 0 && document.getElementById("step").disabled`;
const notice = `document.getElementById("notice").textContent`;
const locked_words = "u' = 0.16";

/// Puts the caret before some words of the text.
async function put_caret(words) {
    const at = await browser.evaluate(`(() => {
        const view = document.getElementById("editor").shadowRoot.querySelector(".cm-content");
        const line = [...view.querySelectorAll(".cm-line")].find(({ textContent }) => textContent.includes(${JSON.stringify(words)}));
        line.scrollIntoView({ block: "center" });
        const walker = document.createTreeWalker(line, NodeFilter.SHOW_TEXT), range = document.createRange();
        let rest = line.textContent.indexOf(${JSON.stringify(words)}), node = walker.nextNode();
        while (rest >= node.data.length && node.data.length > 0) { rest -= node.data.length; node = walker.nextNode(); }
        range.setStart(node, rest);
        range.setEnd(node, rest + 1);
        const { left, top, height } = range.getBoundingClientRect();
        return [left + 1, top + height / 2];
    })()`);
    await browser.drag(...at, ...at);
}

async function open(language) {
    if (language) await browser.call("Emulation.setUserAgentOverride", { userAgent: "Chromium", acceptLanguage: language });
    await browser.open(address);
    await browser.until(`document.querySelectorAll("#stages li").length > 0 && !document.getElementById("lesson").hidden`);
    await browser.evaluate(`localStorage.was_taught = "yes"; document.getElementById("tour").hidden = true`);
}

async function solve() {
    await open();
    await browser.until(is_over);
    await browser.until(`${goals}.every(([sign]) => sign !== "") && ${goals}[0][2].startsWith("now ")`);
    expect(await browser.evaluate(of_lesson("h2")) === "Many small spots", "the title is missing");
    await browser.until(`document.querySelector("#lesson img").naturalWidth > 20`);
    const first = await browser.evaluate(goals);
    expect(first.length === 2 && first[0][1] === "deviation above 0.05" && first[0][0] === "○", `the goals are ${first}`);
    expect(await browser.evaluate(of_lesson("[role=status]")) === "", "they are met before anything was done");

    // The hint.
    expect(!(await browser.evaluate(`document.querySelector("#lesson details").open`)), "the hint is open");
    await browser.evaluate(`document.querySelector("#lesson summary").click()`);
    expect((await browser.evaluate(of_lesson("details p"))).startsWith("Without the kill"), "the hint is missing");

    // Locked lines stay, whatever is typed, deleted or pasted over them.
    const before = await browser.evaluate(text);
    await put_caret(locked_words);
    await browser.call("Input.insertText", { text: "9" });
    await browser.until(`${notice}.startsWith("This part of the exercise is locked")`);
    await browser.press("Backspace");
    await browser.evaluate(`document.getElementById("editor").shadowRoot.querySelector(".cm-content").focus()`);
    await browser.call("Input.dispatchKeyEvent", { type: "keyDown", key: "a", modifiers: 2, windowsVirtualKeyCode: 65, commands: ["selectAll"] });
    await browser.call("Input.insertText", { text: "nothing" });
    expect(await browser.evaluate(text) === before, `the locked text became ${await browser.evaluate(text)}`);

    // Open lines can be edited. The pattern is then measured again, and the goals are met at the
    // end.
    await put_caret("0.3 ");
    for (let k = 0; k < 3; ++k) await browser.call("Input.dispatchKeyEvent", { type: "keyDown", key: "Delete", windowsVirtualKeyCode: 46 });
    await browser.call("Input.insertText", { text: "0.06" });
    await browser.until(`document.getElementById("text").ariaBusy === "false" && document.getElementById("messages").textContent === ""`);
    expect((await browser.evaluate(text)).includes("kill: 0.06 "), `the open text is ${await browser.evaluate(text)}`);
    await browser.restart();
    await browser.grow();
    await browser.until(`${of_lesson("[role=status]")} === "All goals are met. Well done!" && ${is_over}`);
    expect((await browser.evaluate(goals)).every(([sign]) => sign === "✓"), "a goal is not met");
    expect(await browser.evaluate(`document.getElementById("lesson").hasAttribute("data-met")`), "the exercise does not show that it is solved");
    writeFileSync(`lesson${exported ? "_exported" : ""}.png`, await browser.screenshot());
}

/// All texts and names of controls that a user reads.
const said = `(() => {
    const found = [], is_kept = (element) => element.closest('option, [translate="no"], script, style, #messages, #notice, #place, #stages, #tour');
    const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_ELEMENT | NodeFilter.SHOW_TEXT);
    for (let node = walker.nextNode(); node; node = walker.nextNode()) {
        const element = node.nodeType === 3 ? node.parentElement : node;
        if (is_kept(element)) continue;
        const texts = node.nodeType === 3 ? [node.data.trim()] : ["title", "aria-label", "placeholder", "alt"].map((name) => node.getAttribute(name));
        found.push(...texts.filter((text) => text && /\\p{L}{2}/u.test(text)));
    }
    return found;
})()`;

/// Words that are the same in several languages.
const same = /^(Cascade|Ctrl|Escape|Home|Page Up|Page Down|Pause|Link|script|session|Script|Relief|relief|film|Film|Pattern|Parameter|Ctrl\+Shift\+Z|Ctrl\+Z|angle|images|now|.*:.*|of_.*|\d.*|x|y|z|[a-z]+ \d+)$/;

async function translate() {
    const english = await browser.evaluate(said);
    expect(english.includes("choose a cell") && english.includes("Run or pause (space)"), `it says ${english}`);
    for (const [tag, of_run, of_hint, of_title] of [["de-CH", "Starten oder anhalten (Leertaste)", "Tipp", "Viele kleine Flecken"], ["fr", "Lancer ou suspendre (espace)", "indice", "Many small spots"],
        ["es-MX", "Ejecutar o pausar (espacio)", "pista", "Many small spots"], ["zh-CN", "运行或暂停（空格）", "提示", "Many small spots"]]) {
        await open(tag);
        await browser.until(`document.getElementById("run").title === ${JSON.stringify(of_run)}`);
        expect(await browser.evaluate("document.documentElement.lang") === { de: "de", fr: "fr", es: "es", zh: "zh-Hans" }[tag.slice(0, 2)], `${tag}: the page says it is in another language`);
        expect(await browser.evaluate(of_lesson("summary")) === of_hint, `${tag}: the hint is called ${await browser.evaluate(of_lesson("summary"))}`);
        expect(await browser.evaluate(of_lesson("h2")) === of_title, `${tag}: the title is ${await browser.evaluate(of_lesson("h2"))}`);
        const left = (await browser.evaluate(said)).filter((words) => english.includes(words) && !same.test(words));
        expect(left.length === 0, `${tag}: it says in English: ${left.join(" | ")}`);
        // Texts that appear later are translated, too.
        await browser.until(is_over);
        await browser.until(`!/^(step|now) /.test(document.getElementById("place").textContent)`);
        await browser.evaluate(`document.getElementById("help_button").click(); document.querySelector("#help form button").click()`);
        const next = await browser.evaluate(`document.getElementById("tour_next").textContent`);
        expect(next === { de: "weiter", fr: "suivant", es: "siguiente", zh: "下一步" }[tag.slice(0, 2)], `${tag}: the tour says ${next}`);
        await browser.evaluate(`document.getElementById("tour_end").click()`);
        await browser.call("Emulation.setDeviceMetricsOverride", { width: 390, height: 844, deviceScaleFactor: 1, mobile: true });
        expect(await browser.evaluate("document.documentElement.scrollWidth - innerWidth") <= 0, `${tag}: a narrow page is too wide`);
        writeFileSync(`${tag.slice(0, 2)}${exported ? "_exported" : ""}_phone.png`, await browser.screenshot());
        await browser.call("Emulation.setDeviceMetricsOverride", { width: 1280, height: 800, deviceScaleFactor: 1, mobile: false });
        writeFileSync(`${tag.slice(0, 2)}${exported ? "_exported" : ""}.png`, await browser.screenshot());
    }
    // A chosen language has precedence over the language of the browser, and is remembered.
    const choose = (language) => browser.evaluate(`{ const choice = document.getElementById("language"); choice.value = "${language}"; choice.dispatchEvent(new Event("change")); }`);
    await choose("de");
    expect(await browser.evaluate(`document.getElementById("fit").textContent`) === "einpassen", "the chosen language is not used");
    await open("fr");
    await browser.until(`document.getElementById("fit").textContent === "einpassen"`);
    await choose("en");
    await browser.until(`document.getElementById("place").textContent.startsWith("step ")`);
    const again = await browser.evaluate(said), lost = english.filter((words) => !again.includes(words) && !/[\d✓○]|^(met|not met|All goals.*|undo the last change|start again)$/.test(words));
    expect(lost.length === 0, `back in English these are missing: ${lost.join(" | ")}`);
}

try {
    await browser.call("Emulation.setDeviceMetricsOverride", { width: 1280, height: 800, deviceScaleFactor: 1, mobile: false });
    await solve();
    await translate();
    const complaints = browser.heard.filter((words) => !words.startsWith("Applying inline style"));
    expect(complaints.length === 0, `the page complains: ${complaints.join("\n")}`);
    await end();
} catch (error) {
    await end(error);
}
