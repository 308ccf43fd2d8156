// Opens GLB files as a browser does. Arguments: the browser and the folder of the models. three.js
// and the validator are found in node_modules of the current folder.
//
// The Khronos validator must find no fault in a file. Then three.js draws the file in the browser, without a window and
// without a graphics card, and the pixels must have the expected colours. The pictures are kept in the current folder.
import { spawn } from "node:child_process";
import { createServer } from "node:http";
import { createRequire } from "node:module";
import { readFileSync, readdirSync, writeFileSync } from "node:fs";
import { extname, join, normalize } from "node:path";
import { fileURLToPath } from "node:url";

const [browser, models] = process.argv.slice(2);
const here = process.cwd();
const page = join(fileURLToPath(new URL(".", import.meta.url)), "page.html");
const faults = [];
const expect = (condition, message) => condition || faults.push(message);

async function validate() {
    const validator = createRequire(join(here, "package.json"))("gltf-validator");
    const files = readdirSync(models).filter((name) => name.endsWith(".glb"));
    expect(files.length >= 7, `only ${files.length} models were written`);
    for (const file of files) {
        const report = await validator.validateBytes(
            new Uint8Array(readFileSync(join(models, file))),
            // The validator does not support the extension for instances, and takes objects that only instances use for
            // unused.
            { maxIssues: 20, ignoredIssues: ["UNSUPPORTED_EXTENSION", "UNUSED_OBJECT"] });
        const { numErrors, numWarnings, messages } = report.issues;
        const is_valid = numErrors + numWarnings === 0;
        expect(is_valid, `${file}: ${JSON.stringify(messages, null, 1)}`);
        console.log(`${file}: ${report.info.totalVertexCount} vertices, ` +
                    `${report.info.totalTriangleCount} triangles, ${is_valid ? "" : "in"}valid`);
    }
}

// Views along z, with x to the right and y up. `frame` is the middle of the visible square and half of its side.
const views = [
    { name: "points", model: "points.glb", ambient: 1, frame: [0, 0, 1.2] },
    { name: "maps", model: "maps.glb", ambient: 1, frame: [0, 0, 1.2] },
    { name: "relief", model: "maps.glb", sun: [0, 5, 5], frame: [0, 0, 1.2] },
    ...["hill", "mirrored_hill"].flatMap((name) => [
        { name: `${name}_left`, model: `${name}.glb`, sun: [-5, 0, 5], frame: [0.5, 0.5, 0.5] },
        { name: `${name}_top`, model: `${name}.glb`, sun: [0, 5, 5], frame: [0.5, 0.5, 0.5] },
    ]),
    { name: "tile", model: "tile.glb", ambient: 1, frame: [0, 0, 0.5] },
    ...["copies", "merged_copies"].map((name) => (
        { name, model: `${name}.glb`, ambient: 1, frame: [0.5, 0.5, 0.5] })),
];

/// The mean colour of 5 × 5 pixels of a view around a place. x and y go from −1 to 1, to the right and up.
function colour(view, x, y) {
    const sum = [0, 0, 0];
    const column = Math.round(64 + 64 * x), row = Math.round(64 - 64 * y);
    for (let j = row - 2; j <= row + 2; ++j) {
        for (let i = column - 2; i <= column + 2; ++i) {
            for (let c = 0; c < 3; ++c) sum[c] += view[4 * (128 * j + i) + c] / 25;
        }
    }
    return sum;
}

function expect_colour(seen, name, x, y, wanted) {
    const found = colour(seen[name], x, y);
    expect(found.every((level, c) => Math.abs(level - wanted[c]) <= 4),
           `${name} at ${x}, ${y}: ${found.map(Math.round)} and not ${wanted}`);
}

function look_at(seen, instances) {
    expect(instances.copies === 65, `three.js found ${instances.copies} copies and not 65`);
    expect(instances.merged_copies === 0, "merged copies are no instances");
    for (const name of ["copies", "merged_copies"]) {
        expect_colour(seen, name, 0, 0, [51, 51, 51]);
        // Colours are rounded, as there are fewer materials than colours.
        for (const part of [0.1, 0.3, 0.5, 0.7, 0.9]) {
            expect_colour(seen, name, 2 * part - 1, -0.5,
                          [204 - 178 * part, 51, 26 + 204 * part].map(Math.round));
        }
        for (const x of [-0.7, 0, 0.7]) expect_colour(seen, name, x, 0.5, [26, 204, 51]);
        expect_colour(seen, name, 0.9, 0.5, [51, 51, 51]);
    }
    for (const name of ["points", "maps"]) {
        expect_colour(seen, name, 0.97, 0.97, [0, 0, 0]);
        for (const y of [-0.5, 0, 0.5]) {
            expect_colour(seen, name, -0.4, y, [204, 51, 26]);
            expect_colour(seen, name, 0.4, y, [26, 51, 230]);
        }
    }
    // Holes show the background, and metals are black without a sun or surroundings.
    for (const [y, right] of [[0.75, [0, 0, 0]], [0.25, [149, 35, 16]], [-0.25, [204, 51, 26]],
                              [-0.75, [0, 0, 0]]]) {
        expect_colour(seen, "tile", 0.5, y, right);
        expect_colour(seen, "tile", -0.5, y, y > 0.5 ? [0, 0, 0] : [51, 153, 102]);
    }
    // The relief has ridges. Without them the light would change little along this line.
    const along = Array.from({ length: 40 }, (_, k) => colour(seen.relief, 0.3, 0.4 - k / 80)[2]);
    expect(Math.max(...along) - Math.min(...along) > 20, `no relief: ${along.map(Math.round)}`);
    for (const name of ["hill", "mirrored_hill"]) {
        const bright = (sun, x, y) => colour(seen[`${name}_${sun}`], x, y)[1];
        const level = bright("left", 0.8, 0.8);
        expect(bright("left", -0.2, 0) > level + 10 && bright("left", 0.2, 0) < level - 10,
               `${name} is not lit from the left: ${bright("left", -0.2, 0)}, ${level}, ` +
               `${bright("left", 0.2, 0)}`);
        expect(bright("top", 0, 0.2) > level + 10 && bright("top", 0, -0.2) < level - 10,
               `${name} is not lit from above: ${bright("top", 0, 0.2)}, ${level}, ` +
               `${bright("top", 0, -0.2)}`);
    }
}

/// Draws all views. Returns their pixels and their numbers of instances, by the name of the view.
function draw() {
    const seen = {}, instances = {};
    const types = { ".html": "text/html", ".js": "text/javascript", ".json": "application/json" };
    return new Promise((resolve, reject) => {
        let shell;
        const server = createServer((request, response) => {
            const path = normalize(decodeURIComponent(new URL(request.url, "http://x").pathname));
            let body = "";
            request.on("data", (part) => (body += part));
            request.on("end", () => {
                if (path.startsWith("/view/")) {
                    const name = path.slice(6), { png, pixels, copies } = JSON.parse(body);
                    seen[name] = pixels;
                    instances[name] = copies;
                    writeFileSync(join(here, `${name}.png`), Buffer.from(png.split(",")[1], "base64"));
                }
                if (path === "/done") finish(() => resolve([seen, instances]));
                if (path === "/failed") finish(() => reject(new Error(`in the browser: ${body}`)));
                if (request.method === "POST") return response.end();
                if (path === "/views.json") return response.end(JSON.stringify(views));
                const file = path === "/" ? page
                    : path.startsWith("/models/") ? join(models, path.slice(8)) : join(here, path);
                try {
                    response.setHeader("Content-Type", types[extname(file)] || "application/octet-stream");
                    response.end(readFileSync(file));
                } catch {
                    response.writeHead(404).end();
                }
            });
        });
        const finish = (action) => {
            clearTimeout(limit);
            server.close();
            server.closeAllConnections();
            shell.removeAllListeners("exit");
            shell.once("exit", action);
            // Kills the whole process group, since the command may be a script.
            process.kill(-shell.pid, "SIGKILL");
        };
        const limit = setTimeout(
            () => finish(() => reject(new Error("the browser drew nothing in 4 minutes"))), 240000);
        server.listen(0, "127.0.0.1", () => {
            // The sandbox is off, because it does not work for root, the usual user in containers.
            shell = spawn(browser, [
                "--headless", "--no-sandbox", "--disable-dev-shm-usage", "--use-angle=swiftshader",
                "--enable-unsafe-swiftshader", "--no-first-run", "--disable-background-networking",
                `--user-data-dir=${join(here, "profile")}`, `http://127.0.0.1:${server.address().port}/`,
            ], { stdio: ["ignore", "ignore", "pipe"], detached: true });
            let said = "";
            shell.stderr.on("data", (part) => (said = (said + part).slice(-4000)));
            shell.once("error", (error) => reject(error));
            shell.once("exit", (code) => {
                clearTimeout(limit);
                server.close();
                reject(new Error(`the browser ended with ${code}: ${said}`));
            });
        });
    });
}

function stop_at_faults() {
    for (const fault of faults) console.log(fault);
    if (faults.length > 0) process.exit(1);
}

await validate();
stop_at_faults();
look_at(...await draw());
stop_at_faults();
// Exits at once, as closed connections might still keep the process waiting.
process.exit(0);
