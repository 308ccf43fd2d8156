// Runs engine.wasm: provides its imports, calls its exports (tab/engine.cpp) and takes its turns.

import type { Gpu } from "./gpu";

/// The script with its options and files in an exported page.
export interface Carried {
    name: string;
    text: string;
    overrides: string;
    is_exact: boolean;  ///< Whether results have the program's bits even if numbers are denormal, which is slow.
    files: [name: string, bytes: Uint8Array][];
}

interface Exports {
    memory: WebAssembly.Memory;
    __indirect_function_table: WebAssembly.Table;
    _initialize(): void;
    allocate(size: number): number;
    carry(name: number, name_size: number, bytes: number, size: number): void;
    begin(...texts_and_flag: number[]): number;
    receive(message: number, size: number): void;
    turn(): number;
    [name: string]: unknown;
}

export interface Host {
    send_text(text: string): void;
    send_frame(bytes: ArrayBuffer): void;
}

type Functions = Record<string, (...numbers: number[]) => number>;

/// The functions that an engine imports from a module. Functions that are not known return `otherwise`.
function imports_of(engine: WebAssembly.Module, module: string, known: Functions, otherwise: number): WebAssembly.ModuleImports {
    const names = WebAssembly.Module.imports(engine).filter((each) => each.module === module);
    return Object.fromEntries(names.map(({ name }) => [name, known[name] ?? (() => otherwise)]));
}

/// The calls begin(), receive() and turn() return promises if the engine may wait for `gpu`. Then only one call may be made
/// at a time.
export class Engine {
    private exports!: Exports;
    private words = "";  ///< The beginning of a line that the engine is printing.

    constructor(module: WebAssembly.Module, private readonly host: Host, gpu?: Gpu) {
        const copy = (at: number, size: number) => this.bytes.slice(at, at + size);
        const text = (at: number, size: number) => new TextDecoder().decode(copy(at, size));
        const page = {
            send_text: (at: number, size: number) => this.host.send_text(text(at, size)),
            send_frame: (at: number, size: number) => this.host.send_frame(copy(at, size).buffer),
            add_kernel: (at: number, size: number) => this.add_kernel(copy(at, size)),
            drop_kernel: (place: number) => this.exports.__indirect_function_table.set(place, null),
        };
        const of_gpu = gpu?.imports(() => this.exports.memory) ?? imports_of(module, "gpu", {}, 0);
        const exports = new WebAssembly.Instance(module, { page, gpu: of_gpu, wasi_snapshot_preview1: this.system(module) }).exports as unknown as Exports;
        this.exports = gpu?.waiting(exports, ["begin", "receive", "turn"]) ?? exports;
        this.exports._initialize();
    }

    carry([name, bytes]: [string, Uint8Array]) { this.exports.carry(...this.put(name), ...this.put(bytes)); }

    /// Starts a run. If this fails, which 0 says, the page gets the reason, and the previous run continues.
    begin({ name, text, overrides, is_exact }: Carried) {
        return this.exports.begin(...this.put(name), ...this.put(text), ...this.put(overrides), Number(is_exact));
    }

    receive(message: string) { return this.exports.receive(...this.put(message)); }

    /// Takes a turn. The answer is not 0 if there is more to do before the next message.
    turn() { return this.exports.turn(); }

    // When the memory grows, earlier views of it become invalid.
    private get bytes() { return new Uint8Array(this.exports.memory.buffer); }

    private put(what: string | Uint8Array): [number, number] {
        const bytes = typeof what === "string" ? new TextEncoder().encode(what) : what;
        const at = this.exports.allocate(bytes.length) >>> 0;
        this.bytes.set(bytes, at);
        return [at, bytes.length];
    }

    private add_kernel(bytes: Uint8Array<ArrayBuffer>): number {
        const { memory, __indirect_function_table: table } = this.exports;
        try {
            const { run } = new WebAssembly.Instance(new WebAssembly.Module(bytes), { env: { memory } }).exports;
            const place = table.grow(1);
            table.set(place, run);
            return place;
        } catch {
            return 0;
        }
    }

    /// The system calls of the C library: time, and output of error messages.
    private system(module: WebAssembly.Module): WebAssembly.ModuleImports {
        const view = () => new DataView(this.exports.memory.buffer);
        const known: Functions = {
            clock_time_get: (_clock, _precision, at) => {
                view().setBigUint64(at, BigInt(Math.round(performance.now() * 1e6)), true);
                return 0;
            },
            fd_write: (_file, pieces, count, written) => {
                let size = 0;
                for (let k = 0; k < count; ++k) {
                    const at = view().getUint32(pieces + 8 * k, true), length = view().getUint32(pieces + 8 * k + 4, true);
                    this.words += new TextDecoder().decode(this.bytes.slice(at, at + length));
                    size += length;
                }
                view().setUint32(written, size, true);
                const lines = this.words.split("\n");
                this.words = lines.pop()!;
                for (const line of lines) console.error(line);
                return 0;
            },
            proc_exit: () => { throw new Error("it has left"); },
        };
        const unsupported = 52;  // ENOSYS of WASI.
        return imports_of(module, "wasi_snapshot_preview1", known, unsupported);
    }
}
