// `cascade view`, and a headless Chromium that is driven through a pipe by the DevTools protocol, without packages.
import { spawn } from "node:child_process";
import { writeFileSync } from "node:fs";

export function expect(condition, message) { if (!condition) throw new Error(message); }

/// Gives a test so many minutes. The function that it returns ends the browser, the programs and this process: after an
/// error with status 1, the error, a screenshot failed.png, and what the page said.
export function ending(browser, minutes, ...programs) {
    const limit = setTimeout(() => end(new Error(`it took more than ${minutes} minutes`)), 60000 * minutes);
    async function end(error) {
        clearTimeout(limit);
        if (error) {
            console.log(error.stack);
            // A page that hangs draws no picture.
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
    static async start(command, profile) {
        const browser = new Browser();
        // No sandbox: it does not work for root, who runs tests in containers.
        browser.shell = spawn(command, [
            "--headless", "--no-sandbox", "--disable-dev-shm-usage", "--use-angle=swiftshader",
            "--enable-unsafe-swiftshader", "--no-first-run", "--disable-background-networking",
            "--remote-debugging-pipe", `--user-data-dir=${profile}`, "about:blank",
        ], { stdio: ["ignore", "ignore", "ignore", "pipe", "pipe"], detached: true });
        browser.waiting = new Map();
        browser.heard = [];  // What the page wrote to its console, and what its policy forbade.
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
        // As fast as it can, unless its user moves the slider.
        await browser.call("Page.addScriptToEvaluateOnNewDocument", { source: `try { localStorage.speed ??= "5"; } catch { /* Not on the page. */ }` });
        return browser;
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

    call(method, params = {}) {
        const id = (this.last = (this.last ?? 0) + 1);
        this.shell.stdio[3].write(JSON.stringify({ id, method, params, sessionId: this.session }) + "\0");
        return new Promise((resolve, reject) => this.waiting.set(id, { resolve, reject }));
    }

    /// The value of an expression in the page.
    async evaluate(expression) {
        const { result, exceptionDetails } = await this.call("Runtime.evaluate",
            { expression, awaitPromise: true, returnByValue: true });
        if (exceptionDetails) throw new Error(`${expression}: ${exceptionDetails.exception?.description}`);
        return result.value;
    }

    /// Waits until an expression in the page is true.
    async until(expression, seconds = 120) {
        for (const end = Date.now() + 1000 * seconds; Date.now() < end;) {
            // A page that is just being left cannot answer; the next one can.
            const is_true = await this.evaluate(expression).catch((error) => { if (!/navigated|context was destroyed/.test(error.message)) throw error; });
            if (is_true) return;
            await new Promise((resolve) => setTimeout(resolve, 50));
        }
        throw new Error(`never true: ${expression}`);
    }

    async screenshot() { return Buffer.from((await this.call("Page.captureScreenshot")).data, "base64"); }

    /// Replaces the script as if it were typed, and waits until the page has read it, unless it is not to.
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

    async drag(x, y, to_x, to_y, button = "left") {
        const send = (type, x, y) => this.call("Input.dispatchMouseEvent", { type, x, y, button, buttons: button === "left" ? 1 : 4, clickCount: 1 });
        await send("mousePressed", x, y);
        await send("mouseMoved", (x + to_x) / 2, (y + to_y) / 2);
        await send("mouseMoved", to_x, to_y);
        await send("mouseReleased", to_x, to_y);
    }

    async wheel(x, y, deltaY) { await this.call("Input.dispatchMouseEvent", { type: "mouseWheel", x, y, deltaX: 0, deltaY }); }

    /// Fingers that move together from the first places to the last ones, each a list of [x, y].
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
