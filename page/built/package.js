// src/engine.ts
function imports_of(engine, module, known, otherwise) {
  const names = WebAssembly.Module.imports(engine).filter((each) => each.module === module);
  return Object.fromEntries(names.map(({ name }) => [name, known[name] ?? (() => otherwise)]));
}
var Engine = class {
  ///< The beginning of a line that the engine is printing.
  constructor(module, host, gpu) {
    this.host = host;
    const copy = (at, size) => this.bytes.slice(at, at + size);
    const text = (at, size) => new TextDecoder().decode(copy(at, size));
    const page = {
      send_text: (at, size) => this.host.send_text(text(at, size)),
      send_frame: (at, size) => this.host.send_frame(copy(at, size).buffer),
      add_kernel: (at, size) => this.add_kernel(copy(at, size)),
      drop_kernel: (place) => this.exports.__indirect_function_table.set(place, null)
    };
    const of_gpu = gpu?.imports(() => this.exports.memory) ?? imports_of(module, "gpu", {}, 0);
    const exports = new WebAssembly.Instance(module, { page, gpu: of_gpu, wasi_snapshot_preview1: this.system(module) }).exports;
    this.exports = gpu?.waiting(exports, ["begin", "receive", "turn"]) ?? exports;
    this.exports._initialize();
  }
  host;
  exports;
  words = "";
  carry([name, bytes]) {
    this.exports.carry(...this.put(name), ...this.put(bytes));
  }
  /// Starts a run. If this fails, which 0 says, the page gets the reason, and the previous run continues.
  begin({ name, text, overrides, is_exact }) {
    return this.exports.begin(...this.put(name), ...this.put(text), ...this.put(overrides), Number(is_exact));
  }
  receive(message) {
    return this.exports.receive(...this.put(message));
  }
  /// Takes a turn. The answer is not 0 if there is more to do before the next message.
  turn() {
    return this.exports.turn();
  }
  // When the memory grows, earlier views of it become invalid.
  get bytes() {
    return new Uint8Array(this.exports.memory.buffer);
  }
  put(what) {
    const bytes = typeof what === "string" ? new TextEncoder().encode(what) : what;
    const at = this.exports.allocate(bytes.length) >>> 0;
    this.bytes.set(bytes, at);
    return [at, bytes.length];
  }
  add_kernel(bytes) {
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
  system(module) {
    const view = () => new DataView(this.exports.memory.buffer);
    const known = {
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
        this.words = lines.pop();
        for (const line of lines) console.error(line);
        return 0;
      },
      proc_exit: () => {
        throw new Error("it has left");
      }
    };
    const unsupported = 52;
    return imports_of(module, "wasi_snapshot_preview1", known, unsupported);
  }
};

// src/package.ts
var CascadeError = class extends Error {
  constructor(messages) {
    super(messages.map(({ message, hint }) => hint ? `${message} (${hint})` : message).join("\n"));
    this.messages = messages;
    this.name = "CascadeError";
  }
  messages;
};
var overrides_of = ({ set, seed }) => JSON.stringify({ set: Object.entries(set ?? {}).map(([name, value]) => `${name}=${value}`), ...seed === void 0 ? {} : { seed } });
function snapshot_of(bytes) {
  const size = new DataView(bytes).getUint32(0, true);
  const header = JSON.parse(new TextDecoder().decode(new Uint8Array(bytes, 4, size)));
  const cells = header.columns * header.rows;
  const planes = Array.from({ length: header.fields }, (_, k) => new Float32Array(bytes, 4 + size + 4 * cells * k, cells));
  return { ...header, planes };
}
var is_browser = typeof window !== "undefined" || typeof globalThis.importScripts === "function";
async function own_engine() {
  const place = new URL("engine.wasm", import.meta.url);
  if (is_browser) return WebAssembly.compileStreaming(fetch(place));
  const { readFile } = await import("node:fs/promises");
  return WebAssembly.compile(await readFile(place));
}
var Cascade = class _Cascade {
  constructor(engine) {
    this.engine = engine;
  }
  engine;
  static async load(engine) {
    if (engine === void 0) return new _Cascade(await own_engine());
    return new _Cascade(engine instanceof WebAssembly.Module ? engine : await WebAssembly.compile(engine));
  }
  pattern(script, options = {}) {
    return new Pattern(this.engine, script, options);
  }
  check(script, options = {}) {
    try {
      return new Pattern(this.engine, script, options).messages;
    } catch (error) {
      if (error instanceof CascadeError) return error.messages;
      throw error;
    }
  }
};
var Pattern = class {
  engine;
  replies = [];
  frames = [];
  script;
  now;
  id = 0;
  constructor(module, text, options) {
    this.engine = new Engine(module, {
      send_text: (sent) => this.take(JSON.parse(sent)),
      send_frame: (bytes) => this.frames.push(snapshot_of(bytes))
    });
    for (const file of Object.entries(options.files ?? {})) this.engine.carry(file);
    const carried = { name: options.name ?? "<script>", text, overrides: overrides_of(options), is_exact: options.exact ?? false, files: [] };
    if (!this.engine.begin(carried)) throw new CascadeError(this.refusal());
    this.look();
  }
  get messages() {
    return this.script.messages;
  }
  get parameters() {
    return this.script.controls;
  }
  get species() {
    return this.script.species;
  }
  get stages() {
    return this.now.stages.map(({ name }) => name);
  }
  get stage() {
    return this.now.stages[this.now.stage - 1].name;
  }
  get steps() {
    return this.now.steps;
  }
  get remarks() {
    return this.now.remarks;
  }
  get finished() {
    return this.now.stages.every(({ has_ended }) => has_ended);
  }
  step(count = 1) {
    if (!Number.isSafeInteger(count) || count < 0) throw new RangeError("the number of steps is a whole number, at least 0");
    const total = () => this.now.stages.reduce((sum, { steps }) => sum + steps, 0);
    const before = total();
    if (count > 0 && !this.finished) this.ask({ do: "step", count });
    while (this.engine.turn()) ;
    this.look();
    if (this.now.failure) throw new CascadeError([{ is_error: true, message: this.now.failure, hint: "" }]);
    return total() - before;
  }
  run() {
    while (!this.finished && this.step(1e9) > 0) ;
    return this;
  }
  values(expression) {
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
  picture({ show = "", palette = "grey", scale = 1, range } = {}) {
    const { png } = this.ask({ do: "picture", show, palette, scale, ...range ? { low: range[0], high: range[1] } : {} });
    return Uint8Array.from(atob(png), (letter) => letter.charCodeAt(0));
  }
  features(show = "") {
    return this.ask({ do: "features", show }).features;
  }
  set(name, value) {
    this.change({ do: "set", name, expression: String(value) });
  }
  paint(item, expression) {
    this.change({ do: "paint", item, expression });
  }
  set_script(text) {
    this.change({ do: "text", text });
  }
  begin_next_stage() {
    this.change({ do: "next_stage" });
  }
  undo() {
    this.change({ do: "undo" });
  }
  redo() {
    this.change({ do: "redo" });
  }
  session() {
    return this.ask({ do: "log" }).text;
  }
  /// The values of a volume, from snapshots of all its slices along z.
  volume([width, height, depth]) {
    const data = new Float32Array(width * height * depth);
    for (let k = 0; k < depth; ++k) {
      this.ask({ do: "slice", axis: "z", place: (k + 0.5) / depth });
      data.set(this.look().planes[0], k * width * height);
    }
    return { data, width, height, depth };
  }
  change(request) {
    this.ask(request);
    this.look();
  }
  take(message) {
    if (message.kind === "script") this.script = message;
    else if ("id" in message) this.replies.push(message);
  }
  /// The reply to a request. Throws if the request is refused.
  ask(request) {
    this.replies = [];
    this.engine.receive(JSON.stringify({ ...request, id: ++this.id }));
    const reply = this.replies.find(({ id }) => id === this.id || id === 0);
    if (!reply) throw new Error("the engine has not answered");
    if (reply.kind === "answer" && !reply.is_done) throw new CascadeError(this.refusal());
    return reply;
  }
  refusal() {
    return this.replies.flatMap((reply) => reply.kind === "answer" ? reply.messages : []);
  }
  /// A snapshot of the present moment.
  look() {
    this.engine.receive(JSON.stringify({ do: "next_snapshot" }));
    this.engine.turn();
    const newest = this.frames.pop();
    this.frames = [];
    return this.now = newest ?? this.now;
  }
};
var load = Cascade.load;
export {
  Cascade,
  CascadeError,
  Pattern,
  load
};
