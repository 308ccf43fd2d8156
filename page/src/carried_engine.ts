// The engine of a page that carries it: a worker that is spoken to as a WebSocket is.
import type { Carried } from "./engine";
import type { Beginning } from "./worker";

/// What Connection uses of a WebSocket.
export type Line = Pick<WebSocket, "readyState" | "send" | "close" | "binaryType" | "onopen" | "onmessage" | "onclose">;

const element = (id: string) => document.getElementById(id);

/// Browsers decode addresses of data, decompress and compile at the same time.
async function stream_of(base64: string, type: string): Promise<Response> {
    const packed = await fetch(`data:application/octet-stream;base64,${base64}`);
    return new Response(packed.body!.pipeThrough(new DecompressionStream("deflate")), { headers: { "Content-Type": type } });
}

const unpacked = async (base64: string) => new Uint8Array(await (await stream_of(base64, "application/octet-stream")).arrayBuffer());

/// A script in the fragment of the address: its text, compressed, in base64 of addresses.
async function linked(): Promise<Carried | undefined> {
    const packed = new URLSearchParams(location.hash.slice(1)).get("script");
    if (!packed) return undefined;
    const text = new TextDecoder().decode(await unpacked(packed.replaceAll("-", "+").replaceAll("_", "/")));
    return { name: "linked.cascade", text, overrides: "", files: [] };
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
    }

    send(text: string) { this.worker!.postMessage(text); }
    close() { this.end(""); }

    private async begin() {
        const engine = WebAssembly.compileStreaming(stream_of(element("engine")!.textContent!, "application/wasm"));
        const source = new Blob([element("worker")!.textContent!], { type: "text/javascript" });
        const worker = new Worker(URL.createObjectURL(source));
        worker.onmessage = ({ data }) => this.onmessage?.call(this as unknown as WebSocket, new MessageEvent("message", { data }));
        worker.onerror = ({ message }) => this.end(message);
        const beginning: Beginning = { engine: await engine, carried: await carried(), linked: await linked().catch(() => undefined) };
        worker.postMessage(beginning);
        this.worker = worker;
        this.readyState = WebSocket.OPEN;
        this.onopen?.call(this as unknown as WebSocket, new Event("open"));
    }

    /// For good: what the engine knew is lost with it.
    private end(reason: string) {
        this.worker?.terminate();
        this.readyState = WebSocket.CLOSED;
        this.onclose?.call(this as unknown as WebSocket, new CloseEvent("close", { code: 1011, reason }));
    }
}
