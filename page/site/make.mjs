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

/// The page of the site that is made of each Markdown file.
const in_folder = (from, to) => list(from, ".md").map((name) => [`${from}/${name}`, `${to}/${name.replace("README.md", "index.md").replace(/md$/, "html")}`]);
const pages = new Map([
    ...["tutorial", "tutorial_text", "tutorial_python", "python", "clusters", "importing", "devices", "ranks", "one_step", "beside_others", "glossary", "site"]
        .map((name) => [`docs/${name}.md`, `${name}.html`]),
    ["examples/models/README.md", "systems.html"], ["examples/museum/README.md", "museum.html"], ["examples/lessons/README.md", "lessons.html"],
    ...in_folder("docs/how_to", "how_to"), ...in_folder("docs/explanation", "explanation"), ...in_folder("spec", "spec"),
]);
/// The pages to which the header of each page links, in the order of learning.
const main_pages = [
    ["index.html", "Cascade"], ["tutorial.html", "Tutorial"], ["how_to/index.html", "How to"], ["explanation/index.html", "Why"],
    ["systems.html", "Systems"], ["museum.html", "Museum"], ["spec/index.html", "Reference"], ["live.html", "Open the page"],
];

function run(words, options = {}) {
    const { status, stdout, stderr, error } = spawnSync(words[0], words.slice(1), { encoding: "utf8", ...options });
    if (error) throw error;
    return { status, stdout, stderr };
}

const empty = mkdtempSync(join(tmpdir(), "cascade-site-"));
/// Whether the engine of live.html can run the script. The page has no files, cannot make bodies,
/// and has the cells of few models.
function is_live(script) {
    if (/\bmesh:|\bbody:|\bsurface: *(creature|leopard|giraffe|zebra|fish|frog|implicit)/.test(script)) return false;
    writeFileSync(join(empty, "script.cascade"), script);
    return run([program, "check", "script.cascade"], { cwd: empty }).status === 0;
}
const address_of = (script) => `live.html#script=${deflateSync(script, { level: 9 }).toString("base64url")}`;

/// The relative address of a place in the site, as seen from a page.
const path_to = (page, to) => posix.relative(posix.dirname(page), to);
const grow_link = (page, script) => `<a class="grow" href="${path_to(page, "")}${posix.dirname(page) === "." ? "" : "/"}${address_of(script)}">grow</a>`;

function copied(path) {
    mkdirSync(join(folder, dirname(path)), { recursive: true });
    copyFileSync(join(root, path), join(folder, path));
    return path;
}

/// The parts of all pages that searches can find: [page, id of the heading, title of the page,
/// heading, text].
const found_parts = [];
const text_of = (html) => unescape(html.replace(/<a class="grow".*?<\/a>/gs, " ").replace(/<[^>]*>/g, " ")).replace(/\s+/g, " ").trim();
function note_parts(page, title, body) {
    for (const part of body.split(/(?=<h[1-6] id=)/)) {
        const heading = /^<h[1-6] id="([^"]*)">(.*?)<\/h[1-6]>/s.exec(part);
        if (heading) found_parts.push([page, heading[1], title, text_of(heading[2]), text_of(part.slice(heading[0].length))]);
    }
}

function write_page(page, title, body, is_wide = false) {
    note_parts(page, title.replace(" · Cascade", ""), body);
    const header = main_pages.map(([to, name]) => `<a href="${path_to(page, to)}"${to === page ? ' aria-current="page"' : ""}>${name}</a>`).join("\n");
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
<a class="skip" href="#main">Skip to the text</a>
<header>
<nav aria-label="Main pages">${header}</nav>
${page === "search.html" ? "" : `<form action="${path_to(page, "search.html")}" role="search"><input name="q" type="search" aria-label="Search" placeholder="Search"></form>`}
</header>
<main id="main"${is_wide ? ' class="wide"' : ""}>
${body}
</main>
</body>
</html>
`);
}

/// Adds ids to headings, as GitHub does.
function with_ids(html) {
    const seen = new Map();
    return html.replace(/<h([1-6])>(.*?)<\/h\1>/gs, (_, level, text) => {
        const id = unescape(text.replace(/<[^>]*>/g, "")).toLowerCase().replace(/[^\p{L}\p{N} _-]/gu, "").replaceAll(" ", "-");
        const count = seen.get(id) ?? 0;
        seen.set(id, count + 1);
        return `<h${level} id="${count ? `${id}-${count}` : id}">${text}</h${level}>`;
    });
}

/// Adapts links between pages to the site. Links to places outside of the site become plain text.
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

/// Adds a link below the picture of each system, with which its script grows.
function with_systems(html, page) {
    return html.replace(/<p><img [^>]*alt="(\w+)"[^>]*><\/p>/g, (picture, name) => {
        const { status, stdout } = run([program, "new", name]);
        return status === 0 && is_live(stdout) ? `${picture}\n<p>${grow_link(page, stdout)}</p>` : picture;
    });
}

/// Adds a link below the name of each exhibit of the museum, with which its script grows.
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
    // Code and tables that are wider than the screen can be scrolled with keys.
    html = with_pictures(html, source, page).replaceAll("<pre>", '<pre tabindex="0">').replaceAll("<table>", '<div class="table" tabindex="0"><table>').replaceAll("</table>", "</table></div>");
    write_page(page, `${unescape(html.match(/<h1[^>]*>(.*?)<\/h1>/s)[1].replace(/<[^>]*>/g, ""))} · Cascade`, html);
}

/// The pictures of examples. A click on a picture grows the example, if the engine can run it.
const gallery_of = (folder) => list(folder, ".cascade").filter((name) => existsSync(join(root, folder, name.replace(/cascade$/, "png")))).map((name) => {
    const script = read(`${folder}/${name}`), title = name.replace(".cascade", "").replaceAll("_", " ");
    const picture = `<img loading="lazy" src="${copied(`${folder}/${name.replace(/cascade$/, "png")}`)}" alt="">${title}`;
    return `<li>${is_live(script) ? `<a href="${address_of(script)}">${picture}</a>` : picture}</li>`;
}).join("\n");
/// The exercises, by their titles.
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
<p><a class="grow" href="live.html">open the page</a> <a class="grow" href="systems.html">all systems</a> <a class="grow" href="museum.html">100 states</a></p>
<h2 id="learn">Learn</h2>
<ul>
<li><b>Begin:</b> fifteen minutes with <a href="tutorial.html">the page</a>, with <a href="tutorial_text.html">text</a>, with <a href="tutorial_python.html">Python</a></li>
<li><b>Solve a problem:</b> <a href="how_to/index.html">how to …</a></li>
<li><b>Understand:</b> <a href="explanation/index.html">why …</a></li>
<li><b>Look up:</b> <a href="spec/index.html">the reference</a>, <a href="systems.html">the library of systems</a>, <a href="glossary.html">the glossary</a></li>
<li><b>Compare:</b> <a href="beside_others.html">Cascade beside other programs</a>, <a href="one_step.html">one step in C++, Halide, OpenCL, Python and Cascade</a></li>
</ul>
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
found_parts.sort((a, b) => (a[0] < b[0] ? -1 : a[0] > b[0] ? 1 : 0));
write_page("search.html", "Search · Cascade", `<h1>Search</h1>
<form role="search"><input id="query" name="q" type="search" aria-label="Words" autofocus></form>
<p id="count" role="status"></p>
<ol id="found"></ol>
<noscript><p>The search needs JavaScript.</p></noscript>
<script src="search_index.js"></script>
<script src="search.js"></script>`);
writeFileSync(join(folder, "search_index.js"), `const parts = ${JSON.stringify(found_parts)};\n`);
for (const file of ["site.css", "search.js"]) copyFileSync(join(root, "page/site", file), join(folder, file));
rmSync(empty, { recursive: true });
console.log(`${pages.size + 2} pages; ${live} of ${blocks} scripts on them can be grown`);
