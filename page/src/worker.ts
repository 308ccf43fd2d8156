// The worker of an exported page. Its first message contains the compiled engine and the script of the page. All
// further messages, in both directions, are described in spec/page.md.
import { type Carried, Engine } from "./engine";
import { Gpu } from "./gpu";

/// A linked script replaces the script of the page if it has no errors.
export interface Beginning { engine: WebAssembly.Module; carried: Carried; linked?: Carried }

const page = self as unknown as { postMessage(message: unknown, transfer?: Transferable[]): void; onmessage: unknown };
// Each turn is a separate task, so that messages are received between turns.
const turns = new MessageChannel();
let engine: Engine | undefined;
let is_turning = false;

function go_on() {
    if (is_turning) return;
    is_turning = true;
    turns.port2.postMessage(null);
}

/// The engine takes one call at a time. A call may wait for the GPU.
let calls: Promise<unknown> = Promise.resolve();
function call(work: () => Promise<unknown>) {
    calls = calls.then(work).catch((error) => queueMicrotask(() => { throw error; }));
}

turns.port1.onmessage = () => call(async () => {
    is_turning = false;
    if (await engine!.turn()) go_on();
});

page.onmessage = ({ data }: MessageEvent<Beginning | string>) => call(async () => {
    if (typeof data === "string") {
        // The engine could not start, and the page already knows why.
        if (!engine) return;
        await engine.receive(data);
        return go_on();
    }
    const begun = new Engine(data.engine, {
        send_text: (text) => page.postMessage(text),
        send_frame: (bytes) => page.postMessage(bytes, [bytes]),
    }, new Gpu());
    data.carried.files.forEach((file) => begun.carry(file));
    if (!await begun.begin(data.carried)) return;
    if (data.linked) await begun.begin(data.linked);
    engine = begun;
});
