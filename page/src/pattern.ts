// The pattern on a canvas of one pixel a cell: by WebGL2, or by the processor where that is missing.
import type { Palette, Snapshot } from "./connection";
import { TimeRows, is_row } from "./time_rows";

const vertex = `#version 300 es
void main() { gl_Position = vec4(gl_VertexID == 1 ? 3 : -1, gl_VertexID == 2 ? 3 : -1, 0, 1); }`;

/// The arithmetic is that of core/palette.cpp and picture/paint.cpp.
const fragment = `#version 300 es
precision highp float;
precision highp sampler2D;
uniform sampler2D red, green, blue;
uniform vec3 stops[64];
uniform int last;
uniform float low, high, rows;
uniform bool is_colour;
out vec4 colour;
void main() {
  ivec2 cell = ivec2(gl_FragCoord.x, rows - gl_FragCoord.y);
  vec3 value = vec3(texelFetch(red, cell, 0).r, texelFetch(green, cell, 0).r, texelFetch(blue, cell, 0).r);
  if (isnan(value.r)) { colour = vec4(0); return; }
  if (is_colour) { colour = vec4(clamp(value, 0.0, 1.0), 1); return; }
  float place = (high == low ? 0.5 : clamp((value.r - low) / (high - low), 0.0, 1.0)) * float(last);
  int left = min(int(place), last - 1);
  colour = vec4(mix(stops[left], stops[left + 1], place - float(left)), 1);
}`;

/// Where a pointer is: coordinates as scripts have them, z in a volume, and the index of the cell in the planes of
/// snapshots.
export interface Place { x: number; y: number; z?: number; cell: number }

interface Drawer { draw(snapshot: Snapshot, palette: Palette): void }

class ShaderDrawer implements Drawer {
    private readonly program: WebGLProgram;
    private readonly textures: WebGLTexture[];

    constructor(private readonly gl: WebGL2RenderingContext) {
        this.program = gl.createProgram()!;
        for (const [type, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]] as const) {
            const shader = gl.createShader(type)!;
            gl.shaderSource(shader, text);
            gl.compileShader(shader);
            gl.attachShader(this.program, shader);
        }
        gl.linkProgram(this.program);
        if (!gl.getProgramParameter(this.program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(this.program) ?? "");
        gl.useProgram(this.program);
        this.textures = ["red", "green", "blue"].map((name, unit) => {
            gl.uniform1i(this.at(name), unit);
            const texture = gl.createTexture()!;
            gl.activeTexture(gl.TEXTURE0 + unit);
            gl.bindTexture(gl.TEXTURE_2D, texture);
            gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
            gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
            return texture;
        });
    }

    private at(name: string) { return this.gl.getUniformLocation(this.program, name); }

    draw(snapshot: Snapshot, palette: Palette) {
        const gl = this.gl, { columns, rows, planes } = snapshot;
        gl.viewport(0, 0, columns, rows);
        this.textures.forEach((_, unit) => {
            gl.activeTexture(gl.TEXTURE0 + unit);
            if (unit > 0 && planes.length === 1) return;
            gl.texImage2D(gl.TEXTURE_2D, 0, gl.R32F, columns, rows, 0, gl.RED, gl.FLOAT, planes[unit]);
        });
        gl.uniform3fv(this.at("stops"), palette.stops.flat());
        gl.uniform1i(this.at("last"), palette.stops.length - 1);
        gl.uniform1f(this.at("low"), snapshot.low);
        gl.uniform1f(this.at("high"), snapshot.high);
        gl.uniform1f(this.at("rows"), rows);
        gl.uniform1i(this.at("is_colour"), planes.length === 3 ? 1 : 0);
        gl.drawArrays(gl.TRIANGLES, 0, 3);
    }
}

class ProcessorDrawer implements Drawer {
    constructor(private readonly context: CanvasRenderingContext2D) {}

    draw({ columns, rows, planes, low, high }: Snapshot, { stops }: Palette) {
        const image = this.context.createImageData(columns, rows), last = stops.length - 1;
        for (let k = 0; k < columns * rows; ++k) {
            if (Number.isNaN(planes[0][k])) continue;
            const part = high === low ? 0.5 : Math.min(Math.max((planes[0][k] - low) / (high - low), 0), 1);
            const left = Math.min(Math.floor(part * last), last - 1), rest = part * last - left;
            for (let c = 0; c < 3; ++c) {
                const level = planes.length === 3 ? planes[c][k] : stops[left][c] + (stops[left + 1][c] - stops[left][c]) * rest;
                image.data[4 * k + c] = Math.round(255 * level);
            }
            image.data[4 * k + 3] = 255;
        }
        this.context.putImageData(image, 0, 0);
    }
}

export class Pattern {
    private readonly drawer: Drawer;
    readonly time = new TimeRows();
    snapshot?: Snapshot;
    palette?: Palette;

    constructor(readonly canvas: HTMLCanvasElement, use_shader = true) {
        // Kept for whoever reads the picture after it was drawn.
        const gl = use_shader ? canvas.getContext("webgl2", { preserveDrawingBuffer: true, premultipliedAlpha: true }) : null;
        this.drawer = gl ? new ShaderDrawer(gl) : new ProcessorDrawer(canvas.getContext("2d")!);
    }

    draw() {
        const { canvas, snapshot, palette } = this;
        if (!snapshot || !palette) return;
        const shown = is_row(snapshot) ? this.time.with(snapshot) : snapshot;
        if (canvas.width !== shown.columns || canvas.height !== shown.rows) {
            canvas.width = shown.columns;
            canvas.height = shown.rows;
            // As large as its frame, in the shape of the grid.
            const ratio = shown.columns / shown.rows;
            canvas.style.width = `min(100cqw, ${100 * ratio}cqh)`;
            canvas.style.height = `min(100cqh, ${100 / ratio}cqw)`;
        }
        this.drawer.draw(shown, palette);
    }

    /// The number of cells along the longest side of the grid.
    get longest() {
        const { snapshot } = this;
        return snapshot ? Math.max(...(snapshot.slice?.sides ?? [snapshot.columns, snapshot.rows])) : 1;
    }

    /// Where a pointer is on the pattern; nothing beside it.
    place(event: { clientX: number; clientY: number }): Place | undefined {
        const { canvas, snapshot, longest } = this, box = canvas.getBoundingClientRect();
        if (!snapshot) return undefined;
        const { slice, columns } = snapshot;
        const right = (event.clientX - box.left) / box.width * canvas.width, down = (event.clientY - box.top) / box.height * canvas.height;
        if (!(right >= 0 && right < canvas.width && down >= 0 && down < canvas.height)) return undefined;
        if (is_row(snapshot)) return { x: right / longest, y: 0.5 / longest, cell: Math.floor(right) };
        const cell = Math.floor(down) * columns + Math.floor(right), across = slice ? slice.number + 0.5 : 0;
        const [x, y, z] = !slice || slice.axis === "z" ? [right, down, across]
            : slice.axis === "y" ? [right, across, down] : [across, down, right];
        return { x: x / longest, y: y / longest, ...(slice && { z: z / longest }), cell };
    }
}
