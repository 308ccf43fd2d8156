// Draws cells that crawl: copies of a few meshes. Each copy has a position, axes, measures and a colour. All copies of
// a mesh are drawn by one call.
import type { Cells, Snapshot } from "./connection";
import { hidden, shadow, surface } from "./light_shaders";
import { Program, attributes } from "./program";

/// Moves a point of a mesh to its position in a copy. Quaternions (`turn`) have the length 1.
const copy = `
in vec3 position, normal, spot, stretch;
in vec4 turn;
uniform mat4 view;
vec3 turned(vec3 along) {
  vec3 twice = 2.0 * cross(turn.xyz, along);
  return along + turn.w * twice + cross(turn.xyz, twice);
}
vec3 copied() { return spot + turned(stretch * position); }`;

/// The foot of a shape gets less light of the sky than its tip.
const lit = `${shadow}${copy}
in vec3 value;
in float shade;
out vec3 place, toward, seen;
out vec2 sky_parts;
out float sun_light;
void main() {
  place = copied();
  toward = normalize(turned(normal / stretch));
  seen = value;
  sky_parts = shade * vec2(mix(0.5, 1.0, clamp(position.y, 0.0, 1.0)), 0.4);
  sun_light = shade * sun_part(place, dot(toward, sun) < 0.0 ? -toward : toward, 0.0);
  gl_Position = view * vec4(place, 1);
}`;

const plain = `#version 300 es
precision highp float;${copy}
in vec3 value;
out vec3 seen;
void main() { seen = value; gl_Position = view * vec4(copied(), 1); }`;

const numbers_of_placement = 10, bytes = 4;

export class CellDrawer {
    readonly lit: Program;
    readonly depth: Program;
    private readonly arrays: WebGLVertexArrayObject;
    private readonly buffers: Record<string, WebGLBuffer> = {};
    private shown?: Cells;
    private channels = 1;

    constructor(private readonly gl: WebGL2RenderingContext) {
        this.lit = new Program(gl, [lit, surface]);
        this.depth = new Program(gl, [plain, hidden]);
        this.arrays = gl.createVertexArray()!;
        for (const name of ["position", "normal", "shade", "value", "placements", "triangles"]) this.buffers[name] = gl.createBuffer()!;
        gl.bindVertexArray(this.arrays);
        for (const [name, size] of [["position", 3], ["normal", 3], ["shade", 1]] as const) this.point(name, size, name, 0, 0);
        for (const name of ["spot", "turn", "stretch", "value"]) {
            gl.enableVertexAttribArray(attributes.indexOf(name));
            gl.vertexAttribDivisor(attributes.indexOf(name), 1);
        }
        gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, this.buffers.triangles);
        gl.bindVertexArray(null);
    }

    /// Takes the cells of a snapshot, or none if it has no cells that crawl.
    take({ cells, planes }: Snapshot) {
        if (cells === this.shown) return;
        this.shown = cells;
        if (!cells) return;
        const gl = this.gl, channels = planes.length, values = new Float32Array(channels * cells.cells.length);
        cells.cells.forEach((cell, k) => planes.forEach((plane, c) => (values[channels * k + c] = plane[cell])));
        this.channels = channels;
        const { positions: position, normals: normal, shades: shade, placements } = cells;
        for (const [name, numbers] of Object.entries({ position, normal, shade, placements, value: values })) {
            gl.bindBuffer(gl.ARRAY_BUFFER, this.buffers[name]);
            gl.bufferData(gl.ARRAY_BUFFER, numbers, gl.STREAM_DRAW);
        }
        gl.bindVertexArray(this.arrays);
        gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, cells.triangles, gl.STREAM_DRAW);
        gl.bindVertexArray(null);
    }

    private point(name: string, size: number, buffer: string, stride: number, start: number) {
        const gl = this.gl, at = attributes.indexOf(name);
        gl.bindBuffer(gl.ARRAY_BUFFER, this.buffers[buffer]);
        gl.enableVertexAttribArray(at);
        gl.vertexAttribPointer(at, size, gl.FLOAT, false, stride, start);
    }

    /// Draws all copies with the program in use.
    draw() {
        const gl = this.gl, { shown, channels } = this;
        if (!shown) return;
        gl.bindVertexArray(this.arrays);
        shown.ends.forEach((end, k) => {
            const first = k === 0 ? 0 : shown.ends[k - 1], triangle = k === 0 ? 0 : shown.triangle_ends[k - 1];
            if (end === first) return;
            const stride = bytes * numbers_of_placement, start = stride * first;
            this.point("spot", 3, "placements", stride, start);
            this.point("turn", 4, "placements", stride, start + 3 * bytes);
            this.point("stretch", 3, "placements", stride, start + 7 * bytes);
            this.point("value", channels, "value", 0, bytes * channels * first);
            gl.drawElementsInstanced(gl.TRIANGLES, 3 * (shown.triangle_ends[k] - triangle), gl.UNSIGNED_INT, 3 * bytes * triangle, end - first);
        });
        gl.bindVertexArray(null);
    }
}
