// The worker of a page that carries its engine. The first message is the compiled engine and what it begins
// with; all further ones are those of spec/page.md, in both directions.
import { type Carried, Engine } from "./engine";

/// A linked script comes before the one that the page carries, which is right.
export interface Beginning { engine: WebAssembly.Module; carried: Carried; linked?: Carried }

const page = self as unknown as { postMessage(message: unknown, transfer?: Transferable[]): void; onmessage: unknown };
// Turns are tasks of their own, so that messages come between them.
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
        engine!.receive(data);
        return go_on();
    }
    engine = new Engine(data.engine, {
        send_text: (text) => page.postMessage(text),
        send_frame: (bytes) => page.postMessage(bytes, [bytes]),
    });
    data.carried.files.forEach((file) => engine!.carry(file));
    if (!data.linked || !engine.begin(data.linked)) engine.begin(data.carried);
};
