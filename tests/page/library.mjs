// The library on the page of `cascade view`: groups, favourites, and systems that are alike. Arguments: the browser and
// the program. Screenshots are left in the current folder.
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { Browser, ending, expect, serve } from "./browser.mjs";

const [command, program] = process.argv.slice(2);
const { cascade, address } = await serve(program);
const browser = await Browser.start(command, join(process.cwd(), "profile_of_library"));
const end = ending(browser, cascade);

const groups = () => browser.evaluate(`Object.fromEntries([...document.querySelectorAll("#library section:not([hidden])")].map((section) =>
    [section.querySelector("h3").textContent, [...section.querySelectorAll("li:not([hidden]) b")].map((title) => title.textContent)]))`);
const of_card = (title, button) => `[...document.querySelectorAll("#library li")].find((item) => item.querySelector("b").textContent === "${title}").querySelector(".${button}")`;
const search = (words) => browser.evaluate(`{ const input = document.querySelector("#library input"); input.value = "${words}"; input.dispatchEvent(new Event("input")); }`);
const open = async (width) => {
    await browser.call("Emulation.setDeviceMetricsOverride", { width, height: 800, deviceScaleFactor: 1, mobile: width < 500 });
    await browser.open(address);
    await browser.until(`document.getElementById("library")?.open && document.querySelectorAll("#library li").length > 50`);
};

async function steer() {
    await open(1280);
    const found = await groups(), names = Object.keys(found);
    expect(names.length >= 6 && !("Favourites" in found), `the groups are ${names}`);
    for (const [title, group] of [["Gray-Scott", "Spots and stripes"], ["FitzHugh-Nagumo", "Waves and spirals"], ["Cahn-Hilliard", "Growth and phases"], ["Burgers", "Physics"], ["Klausmeier tiger bush", "Life"], ["Fish", "Examples"]]) {
        expect(found[group].includes(title), `${title} is not in ${group}`);
    }
    expect((found.Others?.length ?? 0) < 5, `without a group: ${found.Others}`);
    writeFileSync("groups.png", await browser.screenshot());

    // Favourites come first, also when the page is opened again, and a second click removes them.
    await browser.evaluate(`${of_card("Burgers", "like")}.click(), ${of_card("Fish", "like")}.click()`);
    expect((await groups()).Favourites?.join() === "Burgers,Fish", `the favourites are ${(await groups()).Favourites}`);
    expect(await browser.evaluate(`document.activeElement === ${of_card("Fish", "like")}`), "the focus is lost");
    await open(390);
    expect(Object.keys(await groups())[0] === "Favourites", "the favourites are not the first group");
    writeFileSync("favourites_phone.png", await browser.screenshot());
    await browser.evaluate(`${of_card("Burgers", "like")}.click()`);
    expect((await groups()).Favourites.join() === "Fish" && (await groups()).Physics.includes("Burgers"), "a favourite stays one");
    await browser.evaluate(`${of_card("Fish", "like")}.click()`);
    expect(!("Favourites" in await groups()), "an empty group is shown");

    // Systems that use the same words are alike.
    await search("brusselator");
    await browser.evaluate(`${of_card("Brusselator", "more")}.click()`);
    const alike = Object.values(await groups()).flat();
    expect(alike.length === 12 && ["Brusselator", "Coupled Brusselators", "Hyperbolic Brusselator"].every((title) => alike.includes(title)), `like the Brusselator are ${alike}`);
    writeFileSync("alike_phone.png", await browser.screenshot());
    expect(await browser.evaluate(`document.documentElement.scrollWidth <= innerWidth && (({ scrollWidth, clientWidth }) => scrollWidth <= clientWidth)(document.querySelector("#library > div"))`), "the library is too wide for a phone");
    await search("");
    expect(Object.values(await groups()).flat().length > 50, "a search does not show all again");

    // Enter opens the first visible system.
    await search("burgers");
    await browser.evaluate(`document.querySelector("#library input").focus()`);
    await browser.press("Enter");
    await browser.until(`!document.getElementById("library").open && document.getElementById("editor").shadowRoot.querySelector(".cm-content").innerText.includes("burgers")`);
    expect(browser.heard.length === 0, `the page complains: ${browser.heard.join("\n")}`);
}

await steer().then(() => end(), end);
