// The connection to the engine (a WebSocket to the program, or a worker): requests with answers, and the newest
// snapshot.
import { EngineLine, type Line } from "./carried_engine";

export interface Message { is_error: boolean; message: string; hint: string; from?: [number, number]; to?: [number, number]; notes?: string[] }
export interface Answer { kind: "answer"; id: number; is_done: boolean; messages: Message[] }
export interface KnownName { name: string; what: string; note: string }
/// The meaning of a word. `name` is missing if the word has no meaning.
export interface Explanation { name?: string; what?: string; note?: string; value?: number; range?: [number, number]; smallest?: number; largest?: number; equation?: string }
export interface Control { name: string; label: string; stage: number; doc: string; low: number; high: number; step?: number; value: number }
export interface Script { kind: "script"; name: string; text: string; messages: Message[]; controls: Control[]; species: string[]; brushes: string[] }
export interface Palette { name: string; description: string; stops: [number, number, number][] }
export interface LibrarySystem { name: string; about: string; words: string; script: string }
export interface Stage { name: string; steps: number; iterations: number; t: number; duration: number; has_begun: boolean; has_ended: boolean; cells?: { count: number; births: number; deaths: number } }
export interface Snapshot {
    number: number; script: number; is_going_on: boolean; stage: number; steps: number; stages: Stage[];
    steps_per_second: number; can_undo: boolean; can_redo: boolean; failure: string; remarks: string[];
    columns: number; rows: number; low: number; high: number; planes: Float32Array[];
    repeats: [boolean, boolean];  ///< Whether the planes repeat along x, and along y.
    /// The number of the surface on which the cells lie, or 0 if there is none.
    surface: number;
    cell?: [number, number];  ///< The lengths of a cell along columns and rows, if they differ.
    is_model: boolean;  ///< Whether the cells are those of a model, without columns and rows.
    cells?: Cells;  ///< Cells that crawl. Planes then have one row with a value for each cell.
    /// The visible slice of a volume.
    slice?: { axis: "x" | "y" | "z"; number: number; sides: [number, number, number] };
}

/// Cells that crawl: a few meshes, and the placements of their copies.
export interface Cells {
    count: number; skin: [number, number, number];
    /// Whether z of scripts points upwards, and y towards the viewer.
    is_flat: boolean;
    /// The size of the plane or box of the cells. Undefined on a surface.
    extent?: [number, number, number];
    /// The vertices and triangles of all meshes.
    positions: Float32Array; normals: Float32Array; shades: Float32Array; triangles: Uint32Array;
    /// Mesh k has the triangles from triangle_ends[k − 1] up to, but not including,
    /// triangle_ends[k], and the copies from ends[k − 1] up to, but not including, ends[k].
    triangle_ends: Uint32Array; ends: Uint32Array;
    cells: Uint32Array;        ///< For each copy, the index of its cell in the planes.
    placements: Float32Array;  ///< Ten numbers for each copy: position, quaternion x, y, z, w, factors along the axes.
}

/// A triangle mesh, and the cells that each vertex shows with their weights.
export interface Surface {
    number: number; up: "y" | "z"; spacing: number;
    positions: Float32Array; normals: Float32Array;  ///< Three numbers for each vertex.
    places?: Float32Array;  ///< x and y of each vertex when the surface is shown as a plane.
    triangles: Uint32Array;
    ends: Uint32Array;      ///< Vertex v has the shares from ends[v − 1] to ends[v] − 1.
    /// Share k has the cell cells[2 k] and the weight weights[2 k + 1].
    cells: Uint32Array; weights: Float32Array;
}

export interface Listener {
    palettes(palettes: Palette[]): void;
    systems(systems: LibrarySystem[]): void;
    script(script: Script): void;
    snapshot(snapshot: Snapshot): void;
    surface(surface: Surface): void;
    /// Tells which engine takes the steps of a page without the program.
    engine(name: string, about: string): void;
    /// Tells the engine's long task, or "" after the task.
    progress(doing: string, part?: number): void;
    lost(reason: string): void;
    refused(why: Message): void;  ///< An error without a request, or about one that could not be read.
}

/// The token of the session. It is removed from the address and stored in the tab for reloads.
function take_token(): string {
    const given = new URLSearchParams(location.hash.slice(1)).get("token");
    if (given) {
        sessionStorage.setItem("token", given);
        history.replaceState(null, "", location.pathname);
    }
    return sessionStorage.getItem("token") ?? "";
}

/// A file that the page has requested.
export interface SavedFile { ending?: string; bytes?: Uint8Array<ArrayBuffer>; notes?: string[] }

/// Reads a binary frame, whose layout spec/page.md describes.
function read_frame(bytes: ArrayBuffer): Snapshot | Surface | Required<SavedFile> & { id: number } {
    const size = new DataView(bytes).getUint32(0, true);
    const { kind, ...header } = JSON.parse(new TextDecoder().decode(new Uint8Array(bytes, 4, size)));
    let start = 4 + size;
    const take = <Numbers>(Type: new (bytes: ArrayBuffer, start: number, length: number) => Numbers, length: number) => {
        start += 4 * length;
        return new Type(bytes, start - 4 * length, length);
    };
    if (kind === "file") return { ...header, bytes: new Uint8Array(bytes, start, header.size) };
    if (kind === "snapshot") {
        const planes = Array.from({ length: header.fields }, () => take(Float32Array, header.columns * header.rows));
        if (!header.cells) return { ...header, planes };
        const { shapes, vertices, triangles, placements, ...cells } = header.cells;
        return { ...header, planes, cells: {
            ...cells, positions: take(Float32Array, 3 * vertices), normals: take(Float32Array, 3 * vertices),
            shades: take(Float32Array, vertices), triangles: take(Uint32Array, 3 * triangles), triangle_ends: take(Uint32Array, shapes),
            ends: take(Uint32Array, shapes), cells: take(Uint32Array, placements), placements: take(Float32Array, 10 * placements),
        } };
    }
    const { number, up, spacing, vertices, places, triangles, shares } = header;
    return {
        number, up, spacing, positions: take(Float32Array, 3 * vertices), normals: take(Float32Array, 3 * vertices),
        places: places > 0 ? take(Float32Array, 2 * places) : undefined, triangles: take(Uint32Array, 3 * triangles),
        ends: take(Uint32Array, vertices), cells: new Uint32Array(bytes, start, 2 * shares), weights: take(Float32Array, 2 * shares),
    };
}

const largest_message = 1 << 20;  ///< In bytes. The engine refuses larger messages.

export class Connection {
    readonly token = EngineLine.is_carried ? "" : take_token();
    /// Identifies this page to the engine after a lost connection.
    private readonly name = [...crypto.getRandomValues(new Uint32Array(4))].map((part) => part.toString(36)).join("");
    private socket?: Line;
    private last_id = 0;
    /// Requests without an answer, in the order of their ids. They are sent again over a new connection.
    private readonly waiting = new Map<number, { text: string; resolve: (answer: Answer) => void }>();

    constructor(private readonly listener: Listener) { this.open(); }

    /// Sends a request. The answer comes when the request has taken effect or was refused.
    /// spec/page.md lists the fields of answers.
    ask<Reply = object>(what: string, fields: Record<string, unknown> = {}): Promise<Answer & Reply> {
        const id = ++this.last_id;
        // Lone surrogates, which a string may contain, are not allowed in JSON.
        const text = JSON.stringify({ do: what, id, ...fields }, (_, value) => typeof value === "string" ? value.replace(/\p{Surrogate}/gu, "\ufffd") : value);
        if (new TextEncoder().encode(text).length > largest_message) {
            const message = { is_error: true, message: "the text is too long", hint: "" };
            return Promise.resolve({ kind: "answer", id, is_done: false, messages: [message] } as unknown as Answer & Reply);
        }
        if (this.is_open) this.socket!.send(text);
        return new Promise((resolve) => this.waiting.set(id, { text, resolve: resolve as (answer: Answer) => void }));
    }

    ask_surface() { if (this.is_open) this.socket!.send('{"do":"surface"}'); }

    next_snapshot() { if (this.is_open) this.socket!.send('{"do":"next_snapshot"}'); }

    private get is_open() { return this.socket?.readyState === WebSocket.OPEN; }

    private open() {
        if (!EngineLine.is_carried && !this.token) return this.listener.lost("Open the address that Cascade printed.");
        const socket: Line = EngineLine.is_carried ? new EngineLine() : new WebSocket(`ws://${location.host}/session?token=${this.token}`);
        socket.binaryType = "arraybuffer";
        socket.onopen = () => {
            socket.send(JSON.stringify({ do: "page", name: this.name }));
            for (const { text } of this.waiting.values()) socket.send(text);
            this.next_snapshot();
        };
        socket.onmessage = ({ data }) => this.take(data);
        socket.onclose = ({ code, reason }) => {
            if (EngineLine.is_carried) return this.listener.lost(`The engine has ended: ${reason}. Reload the page to begin anew.`);
            this.listener.lost(code === 1001 ? "Cascade has ended." : "The connection is lost; trying again. Changes that you make now are kept.");
            setTimeout(() => this.open(), 1000);
        };
        this.socket = socket;
    }

    private take(data: string | ArrayBuffer) {
        if (typeof data !== "string") {
            const frame = read_frame(data);
            if ("bytes" in frame) return this.answer(frame);
            return "planes" in frame ? this.listener.snapshot(frame) : this.listener.surface(frame);
        }
        const message = JSON.parse(data);
        if (message.kind === "palettes") this.listener.palettes(message.palettes);
        else if (message.kind === "systems") this.listener.systems(message.systems);
        else if (message.kind === "engine") this.listener.engine(message.name, message.about);
        else if (message.kind === "progress") this.listener.progress(message.doing, message.part);
        else if (message.kind === "script") this.listener.script(message);
        else if (message.id === 0) this.listener.refused(message.messages.find(({ is_error }: Message) => is_error));
        else this.answer(message);
    }

    private answer(message: { id: number }) {
        this.waiting.get(message.id)?.resolve({ kind: "answer", is_done: true, messages: [], ...message });
        this.waiting.delete(message.id);
    }
}
