// The worker of an exported page. Its first message contains the compiled engine and the script of the page. All
// further messages, in both directions, are described in spec/page.md.
import { type Carried, Engine } from "./engine";

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

turns.port1.onmessage = () => {
    is_turning = false;
    if (engine!.turn()) go_on();
};

page.onmessage = ({ data }: MessageEvent<Beginning | string>) => {
    if (typeof data === "string") {
        // The engine could not start, and the page already knows why.
        if (!engine) return;
        engine.receive(data);
        return go_on();
    }
    const begun = new Engine(data.engine, {
        send_text: (text) => page.postMessage(text),
        send_frame: (bytes) => page.postMessage(bytes, [bytes]),
    });
    data.carried.files.forEach((file) => begun.carry(file));
    if (!begun.begin(data.carried)) return;
    if (data.linked) begun.begin(data.linked);
    engine = begun;
};
