// node page/library.mjs [--check]: writes page/src/library.json, which the library of the page
// shows beside the systems that the engine names: small pictures of these systems, and the examples
// with their pictures. Run it after a change of a picture or of an example. Needs cwebp (Debian:
// webp). With --check it fails if the file has other examples or lacks a picture.
import { execFileSync } from "node:child_process";
import { readdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";

const project = join(import.meta.dirname, ".."), file = join(import.meta.dirname, "src/library.json");
const side = 72, quality = 10;  // The longer side in pixels. All pictures together take 140 kB.

const names = (folder) => readdirSync(join(project, folder)).filter((name) => name.endsWith(".cascade"))
    .map((name) => name.replace(".cascade", "")).sort();

function shrink(name) {
    const path = join(project, "examples", `${name}.png`), png = readFileSync(path);
    const is_wide = png.readUInt32BE(16) > png.readUInt32BE(20);
    return execFileSync("cwebp", ["-quiet", "-m", "6", "-q", String(quality), "-resize", ...(is_wide ? [side, 0] : [0, side]).map(String), path, "-o", "-"]).toString("base64");
}

/// The title of an example and a line about it: the first two parts of its opening comment. If this
/// comment begins with "A cascade", the title is the example's name.
function describe(name, script) {
    const comment = script.match(/^(#.*\n)+/)[0].replace(/^# ?/gm, "").replaceAll("\n", " ").trim();
    const end_of_sentence = /(?<=[^A-Z])\.(?: |$)/;  // The full stop of an initial ends no sentence.
    const [title] = comment.split(/: | - /)[0].split(end_of_sentence);
    const [about] = comment.slice(title.length).replace(/^(: | - |\. ?)/, "").split(end_of_sentence);
    const capital = (text) => text.charAt(0).toUpperCase() + text.slice(1);
    return { title: title.startsWith("A cascade") ? capital(name.split("/").pop().replaceAll("_", " ")) : title, about: capital(about) };
}

function collect(picture_of) {
    const examples = ["", "witkin_kass/", "surfaces/", "on_models/", "materials/", "cells/"].flatMap((folder) => names(`examples/${folder}`).map((name) => folder + name));
    return {
        systems: Object.fromEntries(names("lang/systems").map((name) => [name, picture_of(`models/${name}`, ({ systems }) => systems[name])])),
        examples: examples.map((name) => {
            const script = readFileSync(join(project, "examples", `${name}.cascade`), "utf8");
            return { name, ...describe(name, script), script, picture: picture_of(name, ({ examples }) => examples.find((example) => example.name === name)?.picture) };
        }),
    };
}

const print = (library) => `${JSON.stringify(library, null, 1)}\n`;
if (process.argv[2] === "--check") {
    const text = readFileSync(file, "utf8"), old = JSON.parse(text);
    if (text !== print(collect((_, find) => find(old) || "missing"))) {
        console.error("page/src/library.json is out of date: run node page/library.mjs and page/build.sh");
        process.exit(1);
    }
} else {
    writeFileSync(file, print(collect(shrink)));
}
