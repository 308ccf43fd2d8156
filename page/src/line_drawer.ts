// Draws contour lines and relief over the colours of a plane, by WebGL2, on a hidden canvas.
import type { Values } from "./between_cells";
import { colours } from "./colours";
import type { Palette } from "./connection";
import type { Look } from "./look";
import { Program } from "./program";

const vertex = `#version 300 es
void main() { gl_Position = vec4(gl_VertexID == 1 ? 3 : -1, gl_VertexID == 2 ? 3 : -1, 0, 1); }`;

/// The same light as in render/tracer.cpp, but without shadows.
const fragment = `#version 300 es
precision highp float;
precision highp sampler2D;
uniform sampler2D values, seen;
uniform float low, high, scale, relief;
out vec4 colour;
${colours}
float value_at(ivec2 pixel) { return texelFetch(values, clamp(pixel, ivec2(0), textureSize(values, 0) - 1), 0).r; }
float height_at(ivec2 pixel) { return 12.0 * relief * position_of(value_at(pixel)); }
vec3 lit(vec3 colour, ivec2 pixel) {
  ivec2 right = ivec2(scale, 0), down = right.yx;
  vec3 normal = normalize(vec3(height_at(pixel - right) - height_at(pixel + right),
    height_at(pixel + down) - height_at(pixel - down), 2));
  vec3 sun = normalize(vec3(-0.7, 0.9, 1));
  // A flat surface keeps its brightness.
  float light = (0.72 * max(0.0, dot(normal, sun)) + 0.42) / (0.72 * sun.z + 0.42);
  float gleam = 0.06 * pow(max(0.0, dot(normal, normalize(sun + vec3(0, 0, 1)))), 40.0);
  return pow(pow(colour, vec3(2.2)) * light + gleam, vec3(1.0 / 2.2));
}
void main() {
  ivec2 size = textureSize(values, 0), pixel = ivec2(gl_FragCoord.x, float(size.y) - gl_FragCoord.y);
  float value = value_at(pixel), change = fwidth(value);
  vec4 plain = texelFetch(seen, pixel * textureSize(seen, 0) / size, 0);
  vec3 shown = relief > 0.0 ? lit(plain.rgb, pixel) : plain.rgb;
  colour = vec4(mix(shown, vec3(line_level(value)), line_part(value, change)), 1) * plain.a;
}`;

export const has_lines = ({ relief, every, at }: Look) => relief > 0 || every !== undefined || at !== undefined;

export class LineDrawer {
    readonly canvas = document.createElement("canvas");
    private readonly program?: Program;
    private readonly gl: WebGL2RenderingContext | null;

    constructor(use_shader: boolean) {
        this.gl = use_shader ? this.canvas.getContext("webgl2", { preserveDrawingBuffer: true, premultipliedAlpha: true }) : null;
        if (!this.gl) return;
        this.program = new Program(this.gl, [vertex, fragment]);
        this.gl.useProgram(this.program.handle);
        ["values", "seen"].forEach((name, unit) => {
            this.program!.whole(name, unit);
            this.bind(unit, this.gl!.createTexture()!);
            for (const filter of [this.gl!.TEXTURE_MIN_FILTER, this.gl!.TEXTURE_MAG_FILTER]) this.gl!.texParameteri(this.gl!.TEXTURE_2D, filter, this.gl!.NEAREST);
        });
    }

    /// Whether this browser supports WebGL2.
    get is_possible() { return this.program !== undefined; }

    private bind(unit: number, texture?: WebGLTexture) {
        this.gl!.activeTexture(this.gl!.TEXTURE0 + unit);
        if (texture) this.gl!.bindTexture(this.gl!.TEXTURE_2D, texture);
    }

    /// Returns the canvas with the picture. `values` has a number for each pixel, `seen` a colour for each pixel or for
    /// each cell. Cells are `scale` pixels wide.
    draw(values: Values, seen: ImageData, scale: number, { low, high }: { low: number; high: number }, palette: Palette, look: Look): HTMLCanvasElement {
        const gl = this.gl!, program = this.program!, { columns, rows } = values;
        if (this.canvas.width !== columns || this.canvas.height !== rows) Object.assign(this.canvas, { width: columns, height: rows });
        gl.viewport(0, 0, columns, rows);
        this.bind(0);
        gl.texImage2D(gl.TEXTURE_2D, 0, gl.R32F, columns, rows, 0, gl.RED, gl.FLOAT, values.numbers);
        this.bind(1);
        gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, gl.RGBA, gl.UNSIGNED_BYTE, seen);
        program.use({ low, high, scale, every: look.every ?? 0, at: look.at ?? 0, relief: look.relief });
        gl.uniform3fv(gl.getUniformLocation(program.handle, "stops"), palette.stops.flat());
        program.whole("last", palette.stops.length - 1);
        program.whole("has_line", look.at === undefined ? 0 : 1);
        gl.drawArrays(gl.TRIANGLES, 0, 3);
        return this.canvas;
    }
}
