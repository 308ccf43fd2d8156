// The engine of a page that carries it: a worker that is spoken to as a WebSocket is.
import type { Carried } from "./engine";
import type { Beginning } from "./worker";

/// What Connection uses of a WebSocket.
export type Line = Pick<WebSocket, "readyState" | "send" | "close" | "binaryType" | "onopen" | "onmessage" | "onclose">;

const largest_link = 1 << 20;  ///< The most bytes of its script.

const element = (id: string) => document.getElementById(id);

/// Browsers decode addresses of data, decompress and compile at the same time.
async function stream_of(base64: string, type: string): Promise<Response> {
    const packed = await fetch(`data:application/octet-stream;base64,${base64}`);
    return new Response(packed.body!.pipeThrough(new DecompressionStream("deflate")), { headers: { "Content-Type": type } });
}

async function unpacked(base64: string, largest = Infinity): Promise<Uint8Array<ArrayBuffer>> {
    const reader = (await stream_of(base64, "application/octet-stream")).body!.getReader(), parts: Uint8Array<ArrayBuffer>[] = [];
    for (let size = 0, part = await reader.read(); !part.done; part = await reader.read()) {
        size += part.value.length;
        if (size > largest) throw new Error(`there are more than ${largest} bytes`);
        parts.push(part.value);
    }
    return new Uint8Array(await new Blob(parts).arrayBuffer());
}

/// A script in the fragment of the address: its text, compressed, in base64 of addresses.
async function linked(): Promise<Carried | undefined> {
    const packed = new URLSearchParams(location.hash.slice(1)).get("script");
    if (!packed) return undefined;
    const text = new TextDecoder().decode(await unpacked(packed.replaceAll("-", "+").replaceAll("_", "/"), largest_link));
    return { name: "linked.cascade", text, overrides: "", is_exact: false, files: [] };
}

async function carried(): Promise<Carried> {
    const { files, ...rest } = JSON.parse(element("carried")!.textContent!);
    const unpack = async ([name, packed]: [string, string]): Promise<[string, Uint8Array]> => [name, await unpacked(packed)];
    return { ...rest, files: await Promise.all(files.map(unpack)) };
}

export class EngineLine implements Line {
    static get is_carried() { return element("engine") !== null; }

    readyState: number = WebSocket.CONNECTING;
    binaryType: BinaryType = "arraybuffer";
    onopen: WebSocket["onopen"] = null;
    onmessage: WebSocket["onmessage"] = null;
    onclose: WebSocket["onclose"] = null;
    private worker?: Worker;

    constructor() {
        this.begin().catch((reason) => this.end(String(reason)));
        // Another link in the same tab.
        addEventListener("hashchange", () => location.reload());
    }

    send(text: string) { this.worker!.postMessage(text); }
    close() { this.end(""); }

    private async begin() {
        const engine = WebAssembly.compileStreaming(stream_of(element("engine")!.textContent!, "application/wasm"));
        const source = new Blob([element("worker")!.textContent!], { type: "text/javascript" });
        const worker = new Worker(URL.createObjectURL(source));
        worker.onmessage = ({ data }) => this.take(data);
        worker.onerror = ({ message }) => this.end(message);
        const beginning: Beginning = { engine: await engine, carried: await carried(), linked: await linked().catch(() => this.refuse_link()) };
        worker.postMessage(beginning);
        this.worker = worker;
        this.readyState = WebSocket.OPEN;
        this.onopen?.call(this as unknown as WebSocket, new Event("open"));
    }

    private take(data: unknown) { this.onmessage?.call(this as unknown as WebSocket, new MessageEvent("message", { data })); }

    private refuse_link(): undefined {
        const why = { is_error: true, message: "the script in the address cannot be read", hint: "the link was cut off or changed, or its script has more than 1 MiB" };
        this.take(JSON.stringify({ kind: "answer", id: 0, is_done: false, messages: [why] }));
    }

    /// For good: what the engine knew is lost with it.
    private end(reason: string) {
        this.worker?.terminate();
        this.readyState = WebSocket.CLOSED;
        this.onclose?.call(this as unknown as WebSocket, new CloseEvent("close", { code: 1011, reason }));
    }
}
