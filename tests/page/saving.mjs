// Models and maps that the page of `cascade view box.cascade` saves. Arguments: the browser and the program; *.cascade, and
// spots.html if there is an engine, are in the current folder.
import { spawnSync } from "node:child_process";
import { existsSync, mkdirSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { Browser, ending, expect, serve } from "./browser.mjs";

const [command, program] = process.argv.slice(2);
const folder = join(process.cwd(), "saved_models");
process.env.TMPDIR = join(process.cwd(), "temporary_of_saving");
for (const made of [folder, process.env.TMPDIR]) {
    rmSync(made, { recursive: true, force: true });
    mkdirSync(made);
}
const { cascade, address } = await serve(program, "box.cascade");
const browser = await Browser.start(command, join(process.cwd(), "profile_of_saving"));
const end = ending(browser, cascade);

const notice = `document.getElementById("notice").textContent`;
const click = (id) => browser.click(`#${id}`);
async function saved(button, name) {
    const path = join(folder, name);
    rmSync(path, { force: true });
    await click(button);
    return browser.file(path);
}
async function show(name, stages = 1) {
    await browser.type_script(readFileSync(`${name}.cascade`, "utf8"));
    await browser.until(`document.querySelectorAll("#stages li").length === ${stages} && document.getElementById("messages").textContent === ""`);
    await browser.until(`document.getElementById("step").disabled`);
}
/// The document in a GLB file.
const document_of = (glb) => JSON.parse(glb.toString("utf8", 20, 20 + glb.readUInt32LE(12)));
/// The files in a ZIP that is not compressed.
function unzipped(zip) {
    const files = {};
    for (let at = 0; zip.readUInt32LE(at) === 0x04034b50;) {
        const size = zip.readUInt32LE(at + 18), name = zip.readUInt16LE(at + 26), extra = zip.readUInt16LE(at + 28), start = at + 30 + name + extra;
        files[zip.toString("utf8", at + 30, at + 30 + name)] = zip.subarray(start, start + size);
        at = start + size;
    }
    return files;
}

async function save() {
    await browser.call("Browser.setDownloadBehavior", { behavior: "allow", downloadPath: folder });
    await browser.open(address);
    await browser.until(`document.querySelectorAll("#stages li").length === 1 && document.getElementById("step").disabled`);
    await browser.evaluate(`{ const choice = document.getElementById("palette"); choice.value = "zebra"; choice.dispatchEvent(new Event("change")); }`);

    // The saved model and the model that `cascade run` writes have the same bytes.
    const model = await saved("model", "box.glb");
    const run = spawnSync(program, ["run", "box.cascade", "--palette", "zebra", "-o", "box.glb", "--quiet"], { encoding: "utf8" });
    expect(run.status === 0 && model.equals(readFileSync("box.glb")), `the model is not that of cascade run: ${run.stderr}`);

    // The ZIP of maps holds the model with texture coordinates and images, and the same images as
    // files.
    const maps = unzipped(await saved("maps", "box_maps.zip")), names = Object.keys(maps);
    expect(names.includes("box.glb") && names.some((name) => name.endsWith(".png")) && names.length >= 2, `the maps are ${names}`);
    const mapped = document_of(maps["box.glb"]);
    expect(mapped.images.length > 0 && "TEXCOORD_0" in mapped.meshes[0].primitives[0].attributes, "the model of the maps has none");

    // A plane is saved as a rectangle with maps that are transparent outside of the mask.
    await show("colours");
    const plane = document_of(await saved("model", "box.glb"));
    expect(plane.images.length > 0 && plane.materials[0].alphaMode !== undefined, `a plane is ${JSON.stringify(plane.materials)}`);
    expect("box.glb" in unzipped(await saved("maps", "box_maps.zip")), "the maps of a plane have no model");

    // Crawling cells are saved as instances of their shapes.
    await show("crawling");
    const cells = document_of(await saved("model", "box.glb"));
    expect(cells.extensionsUsed?.includes("EXT_mesh_gpu_instancing"), `cells are saved as ${cells.extensionsUsed}`);

    // If something cannot be saved as a model or maps, one message says so.
    await show("hole");
    await click("model");
    await browser.until(`${notice}.startsWith("a surface given by formulas cannot be written as a model")`);
    await show("crowd");
    await click("maps");
    await browser.until(`${notice}.startsWith("maps can be written only for a model or a plane")`);
    const [session] = readdirSync(process.env.TMPDIR).filter((name) => name.startsWith("cascade-") && !name.endsWith(".html"));
    expect(readdirSync(join(process.env.TMPDIR, session)).length === 0, "files are left in the folder of the session");

    if (existsSync("spots.html")) {
        await browser.open(pathToFileURL("spots.html").href);
        await browser.until(`document.querySelectorAll("#stages li").length === 2`);
        for (const button of ["model", "maps"]) {
            await browser.evaluate(`document.getElementById("notice").textContent = ""`);
            await click(button);
            await browser.until(`${notice}.startsWith("a page that runs without the program cannot write models and maps")`);
        }
        writeFileSync("saving_exported.png", await browser.screenshot());
    }
    const complaints = browser.heard.filter((words) => !words.startsWith("Applying inline style"));
    expect(complaints.length === 0, `the page complains: ${complaints.join("\n")}`);
}

await save().then(() => end(), end);
