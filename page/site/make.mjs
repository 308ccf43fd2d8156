// Makes the pages of the static site (page/site.sh) out of the project's Markdown, examples and library. Arguments: the
// project, the folder of the site and the program.
import { spawnSync } from "node:child_process";
import { copyFileSync, existsSync, mkdirSync, mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join, posix } from "node:path";
import { deflateSync } from "node:zlib";

const [root, folder, program] = process.argv.slice(2);
const read = (path) => readFileSync(join(root, path), "utf8");
const list = (path, ending) => readdirSync(join(root, path)).filter((name) => name.endsWith(ending)).sort();
const escape = (text) => text.replaceAll("&", "&amp;").replaceAll("<", "&lt;").replaceAll('"', "&quot;");
const unescape = (text) => text.replaceAll("&lt;", "<").replaceAll("&gt;", ">").replaceAll("&quot;", '"').replaceAll("&amp;", "&");

/// Where each Markdown file is found on the site.
const pages = new Map([
    ["docs/tutorial.md", "tutorial.html"], ["docs/site.md", "site.html"], ["examples/models/README.md", "systems.html"],
    ["examples/museum/README.md", "museum.html"],
    ...list("spec", ".md").map((name) => [`spec/${name}`, `spec/${name.replace("README.md", "index.md").replace(/md$/, "html")}`]),
]);

function run(words, options = {}) {
    const { status, stdout, stderr, error } = spawnSync(words[0], words.slice(1), { encoding: "utf8", ...options });
    if (error) throw error;
    return { status, stdout, stderr };
}

const empty = mkdtempSync(join(tmpdir(), "cascade-site-"));
/// Whether the engine of live.html can run the script. It has no files and no bodies, and few models have cells there.
function is_live(script) {
    if (/\bmesh:|\bbody:|\bsurface: *(creature|leopard|giraffe|zebra|fish|frog|implicit)/.test(script)) return false;
    writeFileSync(join(empty, "script.cascade"), script);
    return run([program, "check", "script.cascade"], { cwd: empty }).status === 0;
}
const address_of = (script) => `live.html#script=${deflateSync(script, { level: 9 }).toString("base64url")}`;

/// From one page of the site to another place in it.
const path_to = (page, to) => posix.relative(posix.dirname(page), to);
const grow_link = (page, script) => `<a class="grow" href="${path_to(page, "")}${posix.dirname(page) === "." ? "" : "/"}${address_of(script)}">grow</a>`;

function copied(path) {
    mkdirSync(join(folder, dirname(path)), { recursive: true });
    copyFileSync(join(root, path), join(folder, path));
    return path;
}

function write_page(page, title, body, is_wide = false) {
    const links = [["index.html", "Cascade"], ["tutorial.html", "Tutorial"], ["systems.html", "Systems"], ["museum.html", "Museum"], ["spec/index.html", "Language"], ["live.html", "Open the page"]];
    const header = links.map(([to, name]) => `<a href="${path_to(page, to)}"${to === page ? ' aria-current="page"' : ""}>${name}</a>`).join("\n");
    mkdirSync(join(folder, dirname(page)), { recursive: true });
    writeFileSync(join(folder, page), `<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>${escape(title)}</title>
<link rel="icon" href="data:,">
<link rel="stylesheet" href="${path_to(page, "site.css")}">
</head>
<body>
<header>${header}</header>
<main${is_wide ? ' class="wide"' : ""}>
${body}
</main>
</body>
</html>
`);
}

/// The ids of headings, as GitHub makes them.
function with_ids(html) {
    const seen = new Map();
    return html.replace(/<h([1-6])>(.*?)<\/h\1>/gs, (_, level, text) => {
        const id = unescape(text.replace(/<[^>]*>/g, "")).toLowerCase().replace(/[^\p{L}\p{N} _-]/gu, "").replaceAll(" ", "-");
        const count = seen.get(id) ?? 0;
        seen.set(id, count + 1);
        return `<h${level} id="${count ? `${id}-${count}` : id}">${text}</h${level}>`;
    });
}

/// Links between pages; what is not on the site becomes plain text.
function with_links(html, source, page) {
    return html.replace(/<a href="([^"]*)">(.*?)<\/a>/gs, (link, address, text) => {
        if (/^(https?:|#)/.test(address)) return link;
        const [path, fragment] = address.split("#"), to = pages.get(posix.normalize(posix.join(posix.dirname(source), path)));
        return to === undefined ? text : `<a href="${path_to(page, to)}${fragment ? `#${fragment}` : ""}">${text}</a>`;
    });
}

function with_pictures(html, source, page) {
    return html.replace(/<img src="([^"]*)"/g, (_, address) => `<img loading="lazy" src="${path_to(page, copied(posix.join(posix.dirname(source), address)))}"`);
}

let live = 0, blocks = 0;
function with_scripts(html, page) {
    return html.replace(/<pre><code class="language-cascade(?:-warning)?">(.*?)<\/code><\/pre>/gs, (block, text) => {
        const script = unescape(text);
        ++blocks;
        if (!is_live(script)) return block;
        ++live;
        return `<div class="live">${block}${grow_link(page, script)}</div>`;
    });
}

/// Below the picture of each system: its script, to be grown.
function with_systems(html, page) {
    return html.replace(/<p><img [^>]*alt="(\w+)"[^>]*><\/p>/g, (picture, name) => {
        const { status, stdout } = run([program, "new", name]);
        return status === 0 && is_live(stdout) ? `${picture}\n<p>${grow_link(page, stdout)}</p>` : picture;
    });
}

/// Below the name of each exhibit of the museum: its script, to be grown.
function with_exhibits(html, page) {
    return html.replace(/<td><code>(\w+)<\/code>/g, (name_cell, name) => {
        const script = read(`examples/museum/${name}.cascade`);
        return is_live(script) ? `${name_cell}<br>${grow_link(page, script)}` : name_cell;
    });
}

for (const [source, page] of pages) {
    const { status, stdout, stderr } = run(["cmark-gfm", "-e", "table", "--unsafe"], { input: read(source) });
    if (status !== 0) throw new Error(`${source}: ${stderr}`);
    let html = with_scripts(with_links(with_ids(stdout), source, page), page);
    if (page === "systems.html") html = with_systems(html, page);
    if (page === "museum.html") html = with_exhibits(html, page);
    html = with_pictures(html, source, page).replaceAll("<table>", '<div class="table"><table>').replaceAll("</table>", "</table></div>");
    write_page(page, `${unescape(html.match(/<h1[^>]*>(.*?)<\/h1>/s)[1].replace(/<[^>]*>/g, ""))} · Cascade`, html);
}

/// The pictures of examples, each of which grows if the engine can grow it.
const gallery_of = (folder) => list(folder, ".cascade").filter((name) => existsSync(join(root, folder, name.replace(/cascade$/, "png")))).map((name) => {
    const script = read(`${folder}/${name}`), title = name.replace(".cascade", "").replaceAll("_", " ");
    const picture = `<img loading="lazy" src="${copied(`${folder}/${name.replace(/cascade$/, "png")}`)}" alt="">${title}`;
    return `<li>${is_live(script) ? `<a href="${address_of(script)}">${picture}</a>` : picture}</li>`;
}).join("\n");
/// Exercises by their titles.
const lessons = list("examples/lessons", ".cascade").map((name) => {
    const script = read(`examples/lessons/${name}`), [, title] = /^# exercise: (.*)$/m.exec(script);
    return `<a class="grow" href="${address_of(script)}">${escape(title)}</a>`;
}).join("\n");
const animals = list("examples/on_models", ".png").map((name) => {
    const picture = `<img loading="lazy" src="${copied(`examples/on_models/${name}`)}" alt="">${name.replace(".png", "").replaceAll("_", " ")}`;
    return `<li>${name === "leopard.png" ? `<a href="animal.html">${picture}</a>` : picture}</li>`;
});
write_page("index.html", "Cascade", `<h1>Patterns that grow</h1>
<p class="lead">Cascade is a language, a compiler and solvers for patterns of reaction and diffusion. Here all of it runs in your browser: a click on a picture
grows it; then type, move sliders, paint, and go back and forth between stages.</p>
<p><a href="live.html"><img class="film" src="${copied("page/film.webp")}" alt="A pattern grows, a slider changes it, a stroke is painted, the next stage begins"></a></p>
<p><a class="grow" href="live.html">open the page</a> <a class="grow" href="tutorial.html">15 minutes</a> <a class="grow" href="systems.html">all systems</a> <a class="grow" href="museum.html">100 states</a></p>
<h2 id="lessons">Exercises</h2>
<p>${lessons}</p>
<h2>Gallery</h2>
<ul class="gallery">
${gallery_of("examples")}
</ul>
<h2 id="cells">Cells that crawl and divide</h2>
<ul class="gallery">
${gallery_of("examples/cells")}
</ul>
<h2>On surfaces</h2>
<ul class="gallery">
${animals.join("\n")}
</ul>`, true);
copyFileSync(join(root, "page/site/site.css"), join(folder, "site.css"));
rmSync(empty, { recursive: true });
console.log(`${pages.size + 1} pages; ${live} of ${blocks} scripts on them can be grown`);
