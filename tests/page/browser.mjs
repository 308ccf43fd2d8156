// Starts `cascade view` and a headless Chromium, which it controls through a pipe by the DevTools protocol, without
// packages.
import { spawn } from "node:child_process";
import { existsSync, readFileSync, writeFileSync } from "node:fs";

export function expect(condition, message) { if (!condition) throw new Error(message); }

/// A JavaScript expression that is true in the page while the pattern grows.
export const is_growing = `document.getElementById("run").ariaLabel === "Pause"`;

const most_minutes = 12;

/// The longest random delay before each command of a test, in milliseconds. If it is not 0, the
/// page is also up to 6 times as slow. Whoever changes these tests sets DELAY, for example to 1500,
/// to find steps that depend on how fast things happen.
const longest_delay = Number(process.env.DELAY ?? 0);

/// Limits a test to twelve minutes, many times as long as it takes on an idle machine. The returned function ends the
/// browser, the programs and this process. After an error the status is 1, and the error, a screenshot failed.png and
/// messages of the page are left.
export function ending(browser, ...programs) {
    const limit = longest_delay === 0 && setTimeout(() => end(new Error(`it took more than ${most_minutes} minutes`)), 60000 * most_minutes);
    async function end(error) {
        clearTimeout(limit);
        if (error) {
            console.log(error.stack);
            // A page that hangs gives no screenshot.
            const later = new Promise((resolve) => setTimeout(() => resolve(""), 10000));
            writeFileSync("failed.png", await Promise.race([browser.screenshot().catch(() => ""), later]));
            if (browser.heard.length > 0) console.log(browser.heard.join("\n"));
        }
        browser.end();
        for (const program of programs) program.kill("SIGKILL");
        process.exit(error ? 1 : 0);
    }
    return end;
}

/// Starts `cascade view` with these arguments, and waits for its address.
export async function serve(program, ...words) {
    const cascade = spawn(program, ["view", ...words, "--no-browser"], { stdio: ["ignore", "pipe", "pipe"] });
    let said = "";
    cascade.stderr.on("data", (part) => (said += part));
    const address = await new Promise((resolve, reject) => {
        cascade.stdout.once("data", (text) => resolve(String(text).trim()));
        cascade.once("exit", () => reject(new Error(`cascade view has ended: ${said}`)));
    });
    return { cascade, address };
}

export class Browser {
    static async start(command, profile, options = []) {
        const browser = new Browser();
        // No sandbox, because it does not work for root, as whom tests run in containers.
        browser.shell = spawn(command, [
            "--headless", "--no-sandbox", "--disable-dev-shm-usage", "--use-angle=swiftshader",
            "--enable-unsafe-swiftshader", "--no-first-run", "--disable-background-networking",
            "--remote-debugging-pipe", `--user-data-dir=${profile}`, ...options, "about:blank",
        ], { stdio: ["ignore", "ignore", "ignore", "pipe", "pipe"], detached: true });
        browser.waiting = new Map();
        browser.heard = [];  // Messages in the page's console, and violations of its content security policy.
        let rest = "";
        browser.shell.stdio[4].setEncoding("utf8").on("data", (part) => {
            const parts = (rest + part).split("\0");
            rest = parts.pop();
            for (const text of parts) browser.take(JSON.parse(text));
        });
        const { targetInfos } = await browser.call("Target.getTargets");
        const { targetId } = targetInfos.find(({ type }) => type === "page");
        const { sessionId } = await browser.call("Target.attachToTarget", { targetId, flatten: true });
        browser.session = sessionId;
        for (const domain of ["Page", "Runtime", "Log"]) await browser.call(`${domain}.enable`);
        // Full speed and a pixel for each cell, unless a test says otherwise.
        await browser.begin_with({ speed: "5", squares: "1" });
        if (longest_delay > 0) await browser.call("Emulation.setCPUThrottlingRate", { rate: 1 + 5 * Math.random() });
        return browser;
    }

    /// Sets what pages find in localStorage for keys that were not stored. Nothing is stored here,
    /// because Chromium may give a document that has just begun an empty localStorage, as if it
    /// were still the previous document.
    async begin_with(values) {
        const { identifier } = this.beginning ?? {};
        if (identifier) await this.call("Page.removeScriptToEvaluateOnNewDocument", { identifier });
        const all = { ...this.beginning?.values, ...values };
        const made = await this.call("Page.addScriptToEvaluateOnNewDocument", { source: `{
            const { getItem } = Storage.prototype, values = ${JSON.stringify(all)};
            Storage.prototype.getItem = function (key) { return getItem.call(this, key) ?? values[key] ?? null; };
        }` });
        this.beginning = { values: all, identifier: made.identifier };
    }

    take({ id, result, error, method, params }) {
        if (method === "Runtime.exceptionThrown") this.heard.push(params.exceptionDetails.exception?.description ?? params.exceptionDetails.text);
        if (method === "Log.entryAdded") this.heard.push(params.entry.text);
        if (method === "Runtime.consoleAPICalled") this.heard.push(params.args.map(({ value }) => value).join(" "));
        const caller = this.waiting.get(id);
        if (!caller) return;
        this.waiting.delete(id);
        error ? caller.reject(new Error(error.message)) : caller.resolve(result);
    }

    async call(method, params = {}) {
        if (longest_delay > 0 && this.session && Math.random() < 0.5) {
            await new Promise((resolve) => setTimeout(resolve, Math.random() * longest_delay));
        }
        return this.send(method, params);
    }

    send(method, params = {}) {
        const id = (this.last = (this.last ?? 0) + 1);
        this.shell.stdio[3].write(JSON.stringify({ id, method, params, sessionId: this.session }) + "\0");
        return new Promise((resolve, reject) => this.waiting.set(id, { resolve, reject }));
    }

    /// Evaluates an expression in the page.
    async evaluate(expression) {
        const { result, exceptionDetails } = await this.call("Runtime.evaluate",
            { expression, awaitPromise: true, returnByValue: true });
        if (exceptionDetails) throw new Error(`${expression}: ${exceptionDetails.exception?.description}`);
        return result.value;
    }

    /// Waits until a function returns something true, and returns it. `otherwise` makes the message
    /// if this never happens.
    async eventually(happens, otherwise, seconds = 240) {
        for (const end = Date.now() + 1000 * seconds; Date.now() < end;) {
            const found = await happens();
            if (found) return found;
            await new Promise((resolve) => setTimeout(resolve, 50));
        }
        throw new Error(await otherwise());
    }

    /// Waits until an expression in the page is true. It is evaluated every 50 ms, so it should stay true.
    async until(expression, seconds = 240) {
        // During navigation the old page cannot answer, but the next page can.
        const look = () => this.evaluate(expression).catch((error) => { if (!/navigated|context was destroyed/.test(error.message)) throw error; });
        await this.eventually(look, () => `never true: ${expression}`, seconds);
    }

    /// Opens a page anew, even if only the fragment of the address differs, and waits until it is loaded.
    async open(url) {
        await this.call("Page.navigate", { url: "about:blank" });
        await this.until(`location.href === "about:blank"`);
        await this.call("Page.navigate", { url });
        await this.until(`location.protocol !== "about:" && document.readyState === "complete"`);
    }

    async reload() {
        await this.evaluate("window.is_old = true");
        await this.call("Page.reload");
        await this.until(`!window.is_old && document.readyState === "complete"`);
    }

    /// Clicks the element that a selector finds, as soon as the element is there and enabled.
    async click(selector) {
        await this.until(`((found) => found && !found.disabled && (found.click(), true))(document.querySelector(${JSON.stringify(selector)}))`);
    }

    /// Goes to the start of the first stage and stays there.
    async restart() {
        await this.evaluate(`${is_growing} && document.getElementById("run").click()`);
        await this.until(`!(${is_growing})`);
        // A new start has a new script number, while "step 0" may be what was shown before.
        const script = `document.getElementById("view").dataset.script`;
        const before = await this.evaluate(`document.getElementById("restart").click(), ${script}`);
        await this.until(`${script} !== "${before}" && document.getElementById("place").textContent.startsWith("step 0")`);
    }

    /// Lets the pattern grow, unless it grows already.
    async grow() { await this.evaluate(`${is_growing} || document.getElementById("run").click()`); }

    /// Waits until a file is saved, and returns its bytes.
    async file(path) {
        await this.eventually(() => existsSync(path), async () => `${path} is not saved: ${await this.evaluate(`document.getElementById("notice").textContent`)}`);
        return readFileSync(path);
    }

    async screenshot() { return Buffer.from((await this.call("Page.captureScreenshot")).data, "base64"); }

    /// Replaces the script as if it were typed, and waits until the page has read it, if `waits`.
    async type_script(text, waits = true) {
        await this.evaluate(`document.getElementById("editor").shadowRoot.querySelector(".cm-content").focus()`);
        await this.call("Input.dispatchKeyEvent", { type: "keyDown", key: "a", modifiers: 2, windowsVirtualKeyCode: 65, commands: ["selectAll"] });
        await this.call("Input.insertText", { text });
        if (waits) await this.until(`document.getElementById("text").ariaBusy === "false"`);
    }

    /// Presses a key such as "a", " ", "Home".
    async press(key, modifiers = 0) {
        const codes = { Tab: 9, Enter: 13, " ": 32, Home: 36, ArrowLeft: 37, ArrowRight: 39, Escape: 27, z: 90, Z: 90, ".": 190 };
        const text = key.length === 1 && modifiers < 2 ? key : undefined;
        for (const type of ["keyDown", "keyUp"]) {
            await this.call("Input.dispatchKeyEvent", { type, key, text, modifiers, windowsVirtualKeyCode: codes[key] });
        }
    }

    async hover(x, y) { await this.call("Input.dispatchMouseEvent", { type: "mouseMoved", x, y }); }

    async drag(x, y, to_x, to_y, button = "left") {
        const send = (type, x, y) => this.call("Input.dispatchMouseEvent", { type, x, y, button, buttons: button === "left" ? 1 : 4, clickCount: 1 });
        await send("mousePressed", x, y);
        await send("mouseMoved", (x + to_x) / 2, (y + to_y) / 2);
        await send("mouseMoved", to_x, to_y);
        await send("mouseReleased", to_x, to_y);
    }

    async wheel(x, y, deltaY) { await this.call("Input.dispatchMouseEvent", { type: "mouseWheel", x, y, deltaX: 0, deltaY }); }

    /// Moves fingers together through `moments`. Each moment is a list of the fingers' positions
    /// [x, y].
    async touch(...moments) {
        for (const [k, places] of moments.entries()) {
            const touchPoints = places.map(([x, y], id) => ({ x, y, id }));
            await this.call("Input.dispatchTouchEvent", { type: k === 0 ? "touchStart" : "touchMove", touchPoints });
        }
        await this.call("Input.dispatchTouchEvent", { type: "touchEnd", touchPoints: [] });
    }

    end() {
        try { process.kill(-this.shell.pid, "SIGKILL"); } catch { /* It has ended. */ }
    }
}
