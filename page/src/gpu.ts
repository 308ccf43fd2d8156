// The GPU of the browser for engine.wasm (tab/host.h), by WebGPU. The engine waits for the GPU by JavaScript Promise
// Integration: while it waits, its stack is suspended, and calls of its exports have returned promises.

type Task = (...numbers: number[]) => number | Promise<number>;
const { Suspending, promising } = WebAssembly as unknown as {
    Suspending?: new (task: Task) => WebAssembly.ImportValue;
    promising?: (call: (...numbers: number[]) => number) => (...numbers: number[]) => Promise<number>;
};

function reason_against(): string {
    if (globalThis.isSecureContext === false) return "browsers lend a GPU only to pages with a secure address (https, localhost or a file)";
    if (!globalThis.navigator?.gpu) return "this browser has no WebGPU";
    return Suspending && promising ? "" : "this browser has no JavaScript Promise Integration, by which the engine waits for the GPU";
}

/// The buffers and kernels of one executor.
interface Steps {
    kernels: GPUComputePipeline[];
    buffers: GPUBuffer[];  ///< By binding (device/wgsl_prelude.h).
    group: GPUBindGroup;
    read?: GPUBuffer;
    words: number;   ///< The words of a call.
    stride: number;  ///< The bytes from call to call in the uniform buffer.
    calls_at_once: number;
}

const planes = 1, sides = 5;
const most_programs = 32;
const milliseconds_at_once = 30;  ///< Drivers reset devices that do not answer for seconds.
const most_calls = 1024;  ///< The most calls whose words are in the uniform buffer.
const alignment = 256;    ///< In bytes, of the words of a call.

export class Gpu {
    private about = reason_against();  ///< The name of the GPU, or the reason why there is none.
    private readonly is_possible = this.about === "";
    private device?: GPUDevice;
    private layout!: GPUBindGroupLayout;
    private readonly programs = new Map<string, Promise<GPUComputePipeline[]>>();
    private readonly all = new Map<number, Steps>();
    private last = 0;

    /// The imports of the engine. `memory` is its memory, which may grow.
    imports(memory: () => WebAssembly.Memory): WebAssembly.ModuleImports {
        const bytes = (at: number, size: number) => new Uint8Array(memory().buffer, at >>> 0, size >>> 0);
        const words = (at: number, count: number) => new Uint32Array(memory().buffer, at >>> 0, count >>> 0);
        const text = (at: number, size: number) => new TextDecoder().decode(bytes(at, size).slice());
        const waiting: Record<string, Task> = {
            open: () => this.open(),
            make: (program, size, halo, halo_size, sizes) => this.make([text(program, size), text(halo, halo_size)], [...words(sizes, 5)]),
            run: (steps, calls, count, of_sides, sides_count) => this.run(steps, words(calls, count).slice(), words(of_sides, sides_count).slice()),
            read: (steps, place, count, to, fields) => this.read(steps, place, count, [...words(to, fields)], bytes),
        };
        const waits = ([name, task]: [string, Task]) => [name, this.is_possible ? new Suspending!(task) : task];
        return {
            ...Object.fromEntries(Object.entries(waiting).map(waits)),
            describe: (at: number, most: number) => new TextEncoder().encodeInto(this.about, bytes(at, most)).written,
            write: (steps: number, binding: number, place: number, at: number, count: number) =>
                this.device?.queue.writeBuffer(this.all.get(steps)!.buffers[binding], 4 * (place >>> 0), words(at, count)),
            largest: () => Math.min(this.device?.limits.maxStorageBufferBindingSize ?? 0, 2 ** 32 - 4) / 4,
            drop: (steps: number) => this.drop(steps),
        };
    }

    /// Exports of the engine that may wait for the GPU.
    waiting<Calls extends Record<string, unknown>>(exports: Calls, names: (keyof Calls)[]): Calls {
        if (!this.is_possible) return exports;
        return { ...exports, ...Object.fromEntries(names.map((name) => [name, promising!(exports[name] as (...numbers: number[]) => number)])) };
    }

    private async open(): Promise<number> {
        if (this.device || this.about) return Number(this.device !== undefined);
        try {
            const adapter = await navigator.gpu.requestAdapter({ powerPreference: "high-performance" });
            if (!adapter) return this.refuse("the browser has found no GPU");
            const { vendor, architecture, description, isFallbackAdapter } = adapter.info;
            if (isFallbackAdapter) return this.refuse("the browser computes WebGPU on the processor, which is slower");
            const { maxStorageBufferBindingSize, maxBufferSize } = adapter.limits;
            this.device = await adapter.requestDevice({ requiredLimits: { maxStorageBufferBindingSize, maxBufferSize } });
            this.about = description || `${vendor} ${architecture}`.trim() || "a GPU without a name";
        } catch (error) {
            return this.refuse(`the browser lends no GPU: ${(error as Error).message}`);
        }
        const { device } = this;
        void device.lost.then(({ message }) => this.device === device && this.refuse(`the GPU was lost: ${message}`));
        const visibility = GPUShaderStage.COMPUTE;
        this.layout = this.device.createBindGroupLayout({ entries: [
            { binding: 0, visibility, buffer: { type: "uniform", hasDynamicOffset: true } },
            { binding: planes, visibility, buffer: { type: "storage" } },
            ...[2, 3, 4, sides].map((binding) => ({ binding, visibility, buffer: { type: "read-only-storage" } as const })),
        ] });
        return 1;
    }

    private refuse(why: string): 0 {
        const { device } = this;
        this.about = why;
        this.device = undefined;
        device?.destroy();
        return 0;
    }

    /// The result of some work. If the device reports an error meanwhile, it is not used any more, and the result is 0.
    private async guarded(work: (device: GPUDevice) => Promise<number>): Promise<number> {
        const { device } = this;
        if (!device) return 0;
        const kinds = ["validation", "out-of-memory", "internal"] as const;
        kinds.forEach((kind) => device.pushErrorScope(kind));
        try {
            const result = await work(device);
            const fault = (await Promise.all(kinds.map(() => device.popErrorScope()))).find((found) => found !== null);
            if (fault) return this.refuse(`the GPU has failed: ${fault.message.split("\n")[0]}`);
            return this.device ? result : 0;
        } catch (error) {
            return this.device ? this.refuse(`the GPU has failed: ${(error as Error).message.split("\n")[0]}`) : 0;
        }
    }

    private make(texts: string[], [words, ...sizes]: number[]): Promise<number> {
        return this.guarded(async (device) => {
            const kernels = (await Promise.all(texts.map((text) => this.kernels_of(device, text)))).flat();
            const { STORAGE, COPY_SRC, COPY_DST, UNIFORM } = GPUBufferUsage;
            const storage = [...sizes, 4].map((count) => device.createBuffer({ size: Math.max(16, 4 * count), usage: STORAGE | COPY_SRC | COPY_DST }));
            const stride = Math.ceil(4 * words / alignment) * alignment;
            const buffers = [device.createBuffer({ size: stride * most_calls, usage: UNIFORM | COPY_DST }), ...storage];
            this.all.set(++this.last, { kernels, buffers, group: this.group_of(device, buffers, stride), words, stride, calls_at_once: 16 });
            return this.last;
        });
    }

    private group_of(device: GPUDevice, buffers: GPUBuffer[], stride: number): GPUBindGroup {
        const entries = buffers.map((buffer, binding) => ({ binding, resource: binding === 0 ? { buffer, size: stride } : { buffer } }));
        return device.createBindGroup({ layout: this.layout, entries });
    }

    /// The kernels of a program, in the order of its text.
    private kernels_of(device: GPUDevice, code: string): Promise<GPUComputePipeline[]> {
        const known = this.programs.get(code);
        if (known) return known;
        if (this.programs.size === most_programs) this.programs.delete(this.programs.keys().next().value!);
        const module = device.createShaderModule({ code });
        const layout = device.createPipelineLayout({ bindGroupLayouts: [this.layout] });
        const names = [...code.matchAll(/@compute\s+@workgroup_size\([^)]*\)\s+fn (\w+)/g)].map(([, name]) => name);
        const made = Promise.all(names.map((entryPoint) => device.createComputePipelineAsync({ layout, compute: { module, entryPoint } })));
        this.programs.set(code, made);
        return made;
    }

    /// Makes calls in order. Each consists of the number of the kernel, the numbers of work-groups, and its words.
    private run(number: number, calls: Uint32Array, of_sides: Uint32Array): Promise<number> {
        return this.guarded(async (device) => {
            const steps = this.all.get(number)!, length = 3 + steps.words, count = calls.length / length;
            this.write_sides(device, steps, of_sides);
            for (let first = 0; first < count;) {
                const end = Math.min(count, first + steps.calls_at_once), begun = performance.now();
                this.submit(device, steps, calls.subarray(length * first, length * end));
                await device.queue.onSubmittedWorkDone();
                const fitting = (end - first) * milliseconds_at_once / Math.max(performance.now() - begun, 0.1);
                if (end - first === steps.calls_at_once || fitting < steps.calls_at_once) {
                    steps.calls_at_once = Math.max(1, Math.min(most_calls, Math.floor(fitting), 4 * steps.calls_at_once));
                }
                first = end;
            }
            return 1;
        });
    }

    private submit(device: GPUDevice, { kernels, buffers, group, words, stride }: Steps, calls: Uint32Array) {
        const length = 3 + words, count = calls.length / length, uniforms = new Uint32Array(stride / 4 * count);
        const encoder = device.createCommandEncoder(), pass = encoder.beginComputePass();
        for (let k = 0; k < count; ++k) {
            const [kernel, across, down] = calls.subarray(length * k);
            uniforms.set(calls.subarray(length * k + 3, length * (k + 1)), stride / 4 * k);
            pass.setPipeline(kernels[kernel]);
            pass.setBindGroup(0, group, [stride * k]);
            pass.dispatchWorkgroups(across, down);
        }
        pass.end();
        device.queue.writeBuffer(buffers[0], 0, uniforms);
        device.queue.submit([encoder.finish()]);
    }

    private write_sides(device: GPUDevice, steps: Steps, words: Uint32Array) {
        const { buffers } = steps;
        if (buffers[sides].size < words.byteLength) {
            buffers[sides].destroy();
            buffers[sides] = device.createBuffer({ size: 2 * words.byteLength, usage: GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_DST });
            steps.group = this.group_of(device, buffers, steps.stride);
        }
        device.queue.writeBuffer(buffers[sides], 0, words);
    }

    /// Copies fields, each of `count` words, which follow each other in the planes from a place on.
    private read(number: number, place: number, count: number, to: number[], bytes: (at: number, size: number) => Uint8Array): Promise<number> {
        return this.guarded(async (device) => {
            const steps = this.all.get(number)!, field = 4 * (count >>> 0), size = field * to.length;
            if (!steps.read || steps.read.size < size) {
                steps.read?.destroy();
                steps.read = device.createBuffer({ size, usage: GPUBufferUsage.MAP_READ | GPUBufferUsage.COPY_DST });
            }
            const encoder = device.createCommandEncoder();
            encoder.copyBufferToBuffer(steps.buffers[planes], 4 * (place >>> 0), steps.read, 0, size);
            device.queue.submit([encoder.finish()]);
            await steps.read.mapAsync(GPUMapMode.READ, 0, size);
            const found = new Uint8Array(steps.read.getMappedRange(0, size));
            to.forEach((at, k) => bytes(at, field).set(found.subarray(field * k, field * (k + 1))));
            steps.read.unmap();
            return 1;
        });
    }

    private drop(number: number) {
        const steps = this.all.get(number);
        this.all.delete(number);
        steps?.buffers.forEach((buffer) => buffer.destroy());
        steps?.read?.destroy();
    }
}
