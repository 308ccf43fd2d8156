// Starts `cascade view` and makes its page fit for a frame beside the text.
//
// The server of `cascade view` lets no other page show it in a frame. So a second server on this machine passes its
// answers on without that rule. Whoever opens it without the token in the address reaches no session.
const { spawn } = require("node:child_process");
const http = require("node:http");
const net = require("node:net");

const longestStart = 60_000;

/** The address that the program prints. Fails with what it says if it ends. */
function addressOf(child) {
    return new Promise((done, fail) => {
        let printed = "", said = "";
        const late = setTimeout(() => fail(new Error("cascade view does not start")), longestStart);
        child.stdout.on("data", (data) => {
            printed += data;
            const found = printed.match(/http:\S+(?=\n)/);
            if (found) clearTimeout(late), done(new URL(found[0]));
        });
        child.stderr.on("data", (data) => { said += data; });
        child.on("error", (error) => fail(new Error(`${child.spawnfile}: ${error.message}`)));
        child.on("close", () => fail(new Error(said || "cascade view has ended")));
    });
}

/** A server that passes all requests to the one at `inner`. */
function frameServer(inner) {
    const origin = inner.origin, own = new Set();
    const headers = (request) => ({ ...request.headers, host: inner.host, ...(request.headers.origin && { origin }) });
    const server = http.createServer((request, response) => {
        const asked = http.request(origin + request.url, { method: request.method, headers: headers(request) }, (answer) => {
            const passed = { ...answer.headers };
            delete passed["x-frame-options"];
            delete passed["cross-origin-opener-policy"];
            passed["content-security-policy"] = passed["content-security-policy"]?.replace("frame-ancestors 'none';", "")
                .replaceAll(`:${inner.port}`, `:${server.address().port}`);
            response.writeHead(answer.statusCode, passed);
            answer.pipe(response);
        });
        asked.on("error", () => response.destroy());
        request.pipe(asked);
    });
    server.on("upgrade", (request, socket, head) => {
        const there = net.connect(inner.port, inner.hostname, () => {
            const lines = Object.entries(headers(request)).map(([name, value]) => `${name}: ${value}\r\n`).join("");
            there.write(`GET ${request.url} HTTP/1.1\r\n${lines}\r\n`);
            there.write(head);
            there.pipe(socket).pipe(there);
        });
        for (const each of [there, socket]) {
            own.add(each);
            each.on("error", () => { there.destroy(); socket.destroy(); });
            each.on("close", () => own.delete(each));
        }
    });
    server.stop = () => { server.close(); for (const each of own) each.destroy(); };
    return new Promise((done) => server.listen(0, "127.0.0.1", () => done(server)));
}

/** The script's live page: its address, a function that sends another text to it, and one that ends it. */
async function startView(program, script) {
    const child = spawn(program, ["view", script, "--no-browser"], { stdio: ["ignore", "pipe", "pipe"] });
    const inner = await addressOf(child);
    const server = await frameServer(inner);
    let socket;
    const setText = (text) => {
        if (typeof WebSocket === "undefined") return;  // Node before 22: the page shows the text as it was.
        const message = JSON.stringify({ do: "text", id: Date.now(), text });
        if (socket?.readyState === WebSocket.OPEN) return void socket.send(message);
        const token = new URLSearchParams(inner.hash.slice(1)).get("token");
        socket = new WebSocket(`ws://${inner.host}/session?token=${token}`, { headers: { origin: inner.origin } });
        socket.onopen = () => socket.send(message);
        socket.onerror = () => {};
    };
    const stop = () => { socket?.close(); server.stop(); child.kill("SIGTERM"); };
    return { address: `http://127.0.0.1:${server.address().port}/${inner.hash}`, setText, stop };
}

module.exports = { startView };
