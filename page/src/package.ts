// The npm package (page/npm): patterns for programs in JavaScript, which the engine of exported pages computes. Calls
// return when their work is done, because the engine runs in the caller's thread.
import type { Answer, Control, Message, Script, Snapshot } from "./connection";
import { Engine } from "./engine";

export type { Control, Message };

/// What an engine sent as the result of a request.
type Reply = Answer | { kind: string; id: number; [member: string]: unknown };

export class CascadeError extends Error {
    constructor(readonly messages: Message[]) {
        super(messages.map(({ message, hint }) => (hint ? `${message} (${hint})` : message)).join("\n"));
        this.name = "CascadeError";
    }
}

export interface Options {
    name?: string;
    set?: Record<string, number | string>;
    seed?: number;
    files?: Record<string, Uint8Array>;
    exact?: boolean;
}

/// Options in the notation of pictures (run/script/embedded_script.h).
const overrides_of = ({ set, seed }: Options) =>
    JSON.stringify({ set: Object.entries(set ?? {}).map(([name, value]) => `${name}=${value}`), ...(seed === undefined ? {} : { seed }) });

export interface Values { data: Float32Array; width: number; height: number; depth: number }
export interface PictureOptions { show?: string; palette?: string; scale?: number; range?: [number, number] }

/// Reads the fields of a snapshot (spec/page.md).
function snapshot_of(bytes: ArrayBuffer): Snapshot {
    const size = new DataView(bytes).getUint32(0, true);
    const header = JSON.parse(new TextDecoder().decode(new Uint8Array(bytes, 4, size)));
    const cells = header.columns * header.rows;
    const planes = Array.from({ length: header.fields }, (_, k) => new Float32Array(bytes, 4 + size + 4 * cells * k, cells));
    return { ...header, planes };
}

const is_browser = typeof window !== "undefined" || typeof (globalThis as { importScripts?: unknown }).importScripts === "function";

/// The engine beside this file.
async function own_engine(): Promise<WebAssembly.Module> {
    const place = new URL("engine.wasm", import.meta.url);
    if (is_browser) return WebAssembly.compileStreaming(fetch(place));
    const { readFile } = await import("node:fs/promises");
    return WebAssembly.compile(await readFile(place));
}

export class Cascade {
    private constructor(private readonly engine: WebAssembly.Module) {}

    static async load(engine?: BufferSource | WebAssembly.Module): Promise<Cascade> {
        if (engine === undefined) return new Cascade(await own_engine());
        return new Cascade(engine instanceof WebAssembly.Module ? engine : await WebAssembly.compile(engine));
    }

    pattern(script: string, options: Options = {}): Pattern { return new Pattern(this.engine, script, options); }

    check(script: string, options: Options = {}): Message[] {
        try {
            return new Pattern(this.engine, script, options).messages;
        } catch (error) {
            if (error instanceof CascadeError) return error.messages;
            throw error;
        }
    }
}

export class Pattern {
    private readonly engine: Engine;
    private replies: Reply[] = [];
    private frames: Snapshot[] = [];
    private script?: Script;
    private now!: Snapshot;
    private id = 0;

    constructor(module: WebAssembly.Module, text: string, options: Options) {
        this.engine = new Engine(module, {
            send_text: (sent) => this.take(JSON.parse(sent)),
            send_frame: (bytes) => this.frames.push(snapshot_of(bytes)),
        });
        for (const file of Object.entries(options.files ?? {})) this.engine.carry(file);
        const carried = { name: options.name ?? "<script>", text, overrides: overrides_of(options), is_exact: options.exact ?? false, files: [] };
        if (!this.engine.begin(carried)) throw new CascadeError(this.refusal());
        this.look();
    }

    get messages(): Message[] { return this.script!.messages; }
    get parameters(): Control[] { return this.script!.controls; }
    get species(): string[] { return this.script!.species; }
    get stages(): string[] { return this.now.stages.map(({ name }) => name); }
    get stage(): string { return this.now.stages[this.now.stage - 1].name; }
    get steps(): number { return this.now.steps; }
    get remarks(): string[] { return this.now.remarks; }
    get finished(): boolean { return this.now.stages.every(({ has_ended }) => has_ended); }

    step(count = 1): number {
        if (!Number.isSafeInteger(count) || count < 0) throw new RangeError("the number of steps is a whole number, at least 0");
        const total = () => this.now.stages.reduce((sum, { steps }) => sum + steps, 0);
        const before = total();
        if (count > 0 && !this.finished) this.ask({ do: "step", count });
        while (this.engine.turn());
        this.look();
        if (this.now.failure) throw new CascadeError([{ is_error: true, message: this.now.failure, hint: "" }]);
        return total() - before;
    }

    run(): this {
        while (!this.finished && this.step(1e9) > 0);
        return this;
    }

    values(expression: string): Values {
        this.ask({ do: "show", expression });
        try {
            const { columns, rows, planes, slice } = this.look();
            if (planes.length !== 1) throw new CascadeError([{ is_error: true, message: `'${expression}' is a colour`, hint: "" }]);
            if (!slice) return { data: planes[0], width: columns, height: rows, depth: 1 };
            return this.volume(slice.sides);
        } finally {
            this.ask({ do: "show", expression: "" });
        }
    }

    picture({ show = "", palette = "grey", scale = 1, range }: PictureOptions = {}): Uint8Array {
        const { png } = this.ask({ do: "picture", show, palette, scale, ...(range ? { low: range[0], high: range[1] } : {}) });
        return Uint8Array.from(atob(png as string), (letter) => letter.charCodeAt(0));
    }

    features(show = ""): Record<string, number> {
        return this.ask({ do: "features", show }).features as Record<string, number>;
    }

    set(name: string, value: number | string): void { this.change({ do: "set", name, expression: String(value) }); }
    paint(item: string, expression: string): void { this.change({ do: "paint", item, expression }); }
    set_script(text: string): void { this.change({ do: "text", text }); }
    begin_next_stage(): void { this.change({ do: "next_stage" }); }
    undo(): void { this.change({ do: "undo" }); }
    redo(): void { this.change({ do: "redo" }); }
    session(): string { return this.ask({ do: "log" }).text as string; }

    /// The values of a volume, from snapshots of all its slices along z.
    private volume([width, height, depth]: [number, number, number]): Values {
        const data = new Float32Array(width * height * depth);
        for (let k = 0; k < depth; ++k) {
            this.ask({ do: "slice", axis: "z", place: (k + 0.5) / depth });
            data.set(this.look().planes[0], k * width * height);
        }
        return { data, width, height, depth };
    }

    private change(request: object) {
        this.ask(request);
        this.look();
    }

    private take(message: { kind: string }) {
        if (message.kind === "script") this.script = message as Script;
        else if ("id" in message) this.replies.push(message as Reply);
    }

    /// The reply to a request. Throws if the request is refused.
    private ask(request: object): Record<string, unknown> {
        this.replies = [];
        this.engine.receive(JSON.stringify({ ...request, id: ++this.id }));
        const reply = this.replies.find(({ id }) => id === this.id || id === 0);
        if (!reply) throw new Error("the engine has not answered");
        if (reply.kind === "answer" && !(reply as Answer).is_done) throw new CascadeError(this.refusal());
        return reply as Record<string, unknown>;
    }

    private refusal(): Message[] {
        return this.replies.flatMap((reply) => (reply.kind === "answer" ? (reply as Answer).messages : []));
    }

    /// A snapshot of the present moment.
    private look(): Snapshot {
        this.engine.receive(JSON.stringify({ do: "next_snapshot" }));
        this.engine.turn();
        const newest = this.frames.pop();
        this.frames = [];
        return (this.now = newest ?? this.now);
    }
}

export const load = Cascade.load;
