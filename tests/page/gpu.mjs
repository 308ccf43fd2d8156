// The engine of exported pages on a GPU. Argument: the browser. spots.html, its picture spots.png by `cascade run`, and
// dot.html are in the current folder. A screenshot is left there.
import { deflateSync } from "node:zlib";
import { readFileSync, writeFileSync } from "node:fs";
import { createServer } from "node:http";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { Browser, ending, expect } from "./browser.mjs";

const file = (page, fragment = "") => pathToFileURL(page).href + fragment;
const start = (name, options) => Browser.start(process.argv[2], join(process.cwd(), `profile_${name}`), options);
const with_gpu = await start("with_gpu", ["--enable-unsafe-webgpu", "--use-webgpu-adapter=swiftshader", "--host-resolver-rules=MAP insecure.test 127.0.0.1"]);
const without_gpu = await start("without_gpu");
const server = createServer((_, answer) => answer.end(readFileSync("spots.html"))).listen(0, "127.0.0.1");
const end_both = ending(with_gpu), end = (error) => {
    without_gpu.end();
    return end_both(error);
};

/// SwiftShader says that it is no GPU. From now on workers of the page take it for one.
const take_for_gpu = (browser) => browser.call("Page.addScriptToEvaluateOnNewDocument", { source: `{
    const claim = 'if (navigator.gpu) Object.defineProperty(GPUAdapterInfo.prototype, "isFallbackAdapter", { value: false });';
    globalThis.Blob = class extends Blob {
        constructor(parts, options) { super(/javascript/.test(options?.type) ? [claim, ...parts] : parts, options); }
    };
}` });

const packed = (script) => `#script=${deflateSync(script).toString("base64").replaceAll("+", "-").replaceAll("/", "_")}`;
const is_over = `document.querySelectorAll("#stages li").length > 0 && document.getElementById("step").disabled`;
const line = `document.getElementById("engine_in_use").textContent`;

/// Opens a page and expects that it says this about its engine.
async function expect_line(browser, url, words) {
    await browser.open(url);
    await browser.until(`${is_over} && ${line}`);
    const said = await browser.evaluate(line);
    expect(said.includes(words), `the page says '${said}' and not '${words}'`);
}

const pixels_of = (browser, image) => browser.evaluate(`(async () => {
    const image = await (${image}), copy = document.createElement("canvas");
    [copy.width, copy.height] = [image.width, image.height];
    copy.getContext("2d").drawImage(image, 0, 0);
    return [image.width, image.height, ...copy.getContext("2d").getImageData(0, 0, image.width, image.height).data];
})()`);

/// Expects the picture of the program on the canvas, up to the rounding of colours. Returns the pixels of the canvas.
async function expect_the_picture(browser) {
    await browser.evaluate(`{ const choice = document.getElementById("palette"); choice.value = "leopard"; choice.dispatchEvent(new Event("change")); }`);
    const wanted = await pixels_of(browser, `new Promise((resolve) => {
        const image = new Image();
        image.onload = () => resolve(image);
        image.src = "data:image/png;base64,${readFileSync("spots.png").toString("base64")}";
    })`);
    let found, differs;
    const is_like = async () => {
        found = await pixels_of(browser, `document.getElementById("pattern")`);
        differs = found.findIndex((level, k) => Math.abs(level - wanted[k]) > (k < 2 ? 0 : 1));
        return found.length === wanted.length && differs < 0;
    };
    await browser.eventually(is_like, () => `the canvas differs from spots.png at ${differs}: ${found[differs]} and not ${wanted[differs]}`, 20);
    return found;
}

/// In a page: runs the worker of the page with another script and some requests, one after the other. `prefix` is code
/// that the worker runs first. The results are what was said about the engine, and a hash of the bits of u and v.
async function run_worker(text, requests, prefix) {
    const content = (id) => document.getElementById(id).textContent;
    const stored = await fetch(`data:application/octet-stream;base64,${content("engine")}`);
    const body = stored.body.pipeThrough(new DecompressionStream("deflate"));
    const engine = await WebAssembly.compileStreaming(new Response(body, { headers: { "Content-Type": "application/wasm" } }));
    const worker = new Worker(URL.createObjectURL(new Blob([prefix, content("worker")], { type: "text/javascript" })));
    const said = [], waiting = [];
    let hash = 0x811c9dc5, planes, failed;
    const tell = () => waiting.splice(0).forEach((resolve) => resolve());
    worker.onerror = ({ message }) => { failed = message; tell(); };
    worker.onmessage = ({ data }) => {
        if (typeof data === "string") {
            const message = JSON.parse(data);
            if (message.kind === "engine") said.push(`${message.name}: ${message.about}`);
            if (message.kind === "answer" && !message.is_done) failed = data;
        } else {
            const size = new DataView(data).getUint32(0, true);
            const header = JSON.parse(new TextDecoder().decode(new Uint8Array(data, 4, size)));
            planes = { header, words: new Uint32Array(data, 4 + size, header.columns * header.rows) };
            if (header.failure) failed = header.failure;
        }
        tell();
    };
    let id = 0;
    /// Sends a request, and waits for a snapshot after it in which no steps are left to take.
    const ask = async (request) => {
        planes = undefined;
        worker.postMessage(JSON.stringify({ ...request, id: ++id }));
        worker.postMessage(JSON.stringify({ do: "next_snapshot" }));
        while (!failed && (!planes || planes.header.is_going_on)) {
            if (planes) worker.postMessage(JSON.stringify({ do: "next_snapshot" }));
            planes = undefined;
            await new Promise((resolve) => waiting.push(resolve));
        }
    };
    worker.postMessage({ engine, carried: { name: "test.cascade", text, overrides: "", is_exact: false, files: [] } });
    for (const request of requests) await ask(request);
    for (const expression of ["u", "v"]) {
        await ask({ do: "show", expression });
        for (const word of planes?.words ?? []) hash = Math.imul(hash ^ word, 0x01000193);
    }
    worker.terminate();
    return { said, hash: hash >>> 0, steps: planes?.header.steps, failed };
}

const run = async (browser, text, requests, prefix = "") => {
    const result = await browser.evaluate(`(${run_worker})(${[text, requests, prefix].map((each) => JSON.stringify(each)).join(", ")})`);
    expect(!result.failed, `the engine said: ${result.failed}`);
    return result;
};

const script = readFileSync("spots.cascade", "utf8");
const requests = [
    { do: "step", count: 25 }, { do: "paint", item: "v", expression: "v + 0.4 * disc(0.2, 0.3, 0.1)" }, { do: "step", count: 10 },
    { do: "set", name: "grow.feed", expression: "0.06" }, { do: "step", count: 10 }, { do: "undo" }, { do: "step", count: 12 },
];
/// Loses the GPU after some submissions.
const losing = `const { requestDevice } = GPUAdapter.prototype, { submit } = GPUQueue.prototype;
let device, submissions = 0;
GPUAdapter.prototype.requestDevice = async function (wanted) { return (device = await requestDevice.call(this, wanted)); };
GPUQueue.prototype.submit = function (all) { submit.call(this, all); if (++submissions === 20) device.destroy(); };`;
/// Makes sums wrong.
const wrong = `const { createShaderModule } = GPUDevice.prototype;
GPUDevice.prototype.createShaderModule = function ({ code }) { return createShaderModule.call(this, { code: code.replace(/fn c_add\\(([^)]*)\\) -> u32 \\{ return /, "$&1u ^ ") }); };`;

const other = (rate, more = "") => `domain { grid: 256, 256 }\nsystem s { u: x; w: 0; u' = 0.1 * lap(u) + ${rate}; w' = 0; ${more} }\nstage a: s { iterations: 2 }\n`;
const reasons = [
    [other("mean(u over domain)"), "because sums over all cells"],
    [other("p", "0 = lap(p) - p + u"), "because it has a constraint"],
    [other("convolve(exp(-distance), u, 3)"), "because it has a convolution"],
    [other("0").replace("256, 256", "64, 64"), "because the GPU takes only stages of at least 65536 cells"],
];

try {
    await expect_line(with_gpu, file("spots.html"), "computes with WebAssembly, because the browser computes WebGPU on the processor");
    await take_for_gpu(with_gpu);
    await expect_line(with_gpu, file("spots.html"), "computes with WebGPU on google swiftshader");
    const seen = await expect_the_picture(with_gpu);
    writeFileSync("gpu_page.png", await with_gpu.screenshot());
    for (const [text, reason] of reasons) await expect_line(with_gpu, file("dot.html", packed(text)), reason);

    await expect_line(without_gpu, file("spots.html"), "computes with WebAssembly, because the browser has found no GPU");
    const seen_without = await expect_the_picture(without_gpu);
    expect(seen.every((level, k) => level === seen_without[k]), "the canvas has other colours with a GPU");
    await expect_line(with_gpu, `http://insecure.test:${server.address().port}/`, "computes with WebAssembly, because browsers lend a GPU only to pages with a secure address");

    await with_gpu.open(file("dot.html"));
    await without_gpu.open(file("dot.html"));
    const wanted = await run(without_gpu, script, requests), found = await run(with_gpu, script, requests);
    expect(wanted.said.join() === "WebAssembly: the browser has found no GPU", `without a GPU: ${wanted.said}`);
    expect(found.said.join() === "WebGPU: google swiftshader", `with a GPU: ${found.said}`);
    expect(found.hash === wanted.hash && found.steps === wanted.steps, `other bits with a GPU: ${JSON.stringify([found, wanted])}`);
    const less = await run(with_gpu, script, requests.slice(0, -1));
    expect(less.hash !== found.hash, "the comparison finds no difference");

    const lost = await run(with_gpu, script, requests, losing);
    expect(/^WebGPU: .*,WebAssembly: the GPU was lost/.test(lost.said.join()), `after a loss: ${lost.said}`);
    expect(lost.hash === wanted.hash && lost.steps === wanted.steps, `other bits after a loss: ${JSON.stringify([lost, wanted])}`);
    const inexact = await run(with_gpu, script, requests.slice(0, 1), wrong);
    expect(/^WebAssembly: the GPU is not bit-exact: /.test(inexact.said.join()), `with wrong sums: ${inexact.said}`);
    for (const { heard } of [with_gpu, without_gpu]) expect(heard.every((each) => /No available adapters/.test(each)), `the pages said: ${heard.join("\n")}`);
} catch (error) {
    await end(error);
}
await end();
