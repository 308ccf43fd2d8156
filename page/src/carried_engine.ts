// The engine inside an exported page: a worker with the interface of a WebSocket.
import { all_of } from "./base64";
import type { Carried } from "./engine";
import { script_of_address, wrong_link } from "./linked_script";
import type { Beginning } from "./worker";

/// The members of WebSocket that Connection uses.
export type Line = Pick<WebSocket, "readyState" | "send" | "close" | "binaryType" | "onopen" | "onmessage" | "onclose">;

const element = (id: string) => document.getElementById(id);

/// Decompresses base64 as a stream, so that the browser can decode, decompress and compile at the same time.
async function stream_of(base64: string, type: string): Promise<Response> {
    const packed = await fetch(`data:application/octet-stream;base64,${base64}`);
    return new Response(packed.body!.pipeThrough(new DecompressionStream("deflate")), { headers: { "Content-Type": type } });
}

const unpacked = async (base64: string) => all_of((await stream_of(base64, "application/octet-stream")).body!);

async function linked(): Promise<Carried | undefined> {
    const text = await script_of_address();
    return text === undefined ? undefined : { name: "linked.cascade", text, overrides: "", is_exact: false, files: [] };
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

    constructor() { this.begin().catch((reason) => this.end(String(reason))); }

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
        this.take(JSON.stringify({ kind: "answer", id: 0, is_done: false, messages: [wrong_link] }));
    }

    /// Ends the engine. Its session is lost.
    private end(reason: string) {
        this.worker?.terminate();
        this.readyState = WebSocket.CLOSED;
        this.onclose?.call(this as unknown as WebSocket, new CloseEvent("close", { code: 1011, reason }));
    }
}
