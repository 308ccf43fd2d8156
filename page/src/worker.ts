// The worker of a page that carries its engine. The first message is the compiled engine and what it begins
// with; all further ones are those of spec/page.md, in both directions.
import { type Carried, Engine } from "./engine";

/// A linked script takes the place of the one that the page carries, if it is right.
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
        // The page has been told why there is none.
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
