// Draws a surface by WebGL2 in the light of render/tracer.cpp: a sun with soft shadows from the viewer's upper left, a
// sky whose light is weaker in hollows, and an invisible ground on which shadows fall.
import { Camera, Vector, add, cross, dot, unit } from "./camera";
import type { Palette, Snapshot, Surface } from "./connection";
import type { Look } from "./look";
import { CellDrawer } from "./cell_drawer";
import { hidden, shade, shadow, surface } from "./light_shaders";
import { Program, attributes } from "./program";

/// The number of directions in which the visibility of the sky is tested: usually, if drawing is
/// slow, and during one picture.
const sky_directions = 160, few_sky_directions = 64, many_at_once = 8;
const long = 100;  ///< In milliseconds. Pictures that take longer are slow.
const shadow_side = 1024;
const ground_side = 64;     ///< Quadrilaterals along a side of the ground.
const ground_reach = 1.2;   ///< Half the side of the ground in diagonals of the surface.

/// Computes the light for vertices, since the light varies slowly along a surface, and there are
/// fewer vertices than pixels. The sun is tested only for the side that faces it.
const vertex = `${shadow}
in vec3 position, normal, value;
in vec4 sky;
uniform mat4 view;
out vec3 place, toward, seen;
out vec2 sky_parts;
out float sun_light;
void main() {
  place = position; toward = normal; seen = value;
  sky_parts = vec2(sky.y > 0.0 ? sky.x / sky.y : 1.0, sky.w > 0.0 ? sky.z / sky.w : 1.0);
  sun_light = sun_part(position, dot(normal, sun) < 0.0 ? -normal : normal, 0.0);
  gl_Position = view * vec4(position, 1);
}`;

const ground = `${shade}
void main() {
  float full = 0.72 * max(0.0, dot(toward, sun)), edge = 1.0 - smoothstep(0.2, 0.8, length(place - middle) / size / ${ground_reach});
  if (edge == 0.0) discard;
  float turn = 6.2832 * fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
  float lost = 0.55 * (full * (1.0 - sun_part(place, toward, turn)) + 0.42 * (1.0 - sky_parts.x)) / (full + 0.42);
  colour = vec4(0, 0, 0, edge * (1.0 - stored_of(vec3(1.0 - lost)).r));
}`;

/// Adds a direction's light of the sky to each vertex, for both sides: the light that arrives, and the light without
/// obstacles.
const sky = `#version 300 es
precision highp float;
precision highp sampler2D;
in vec3 position, normal;
in vec4 before;
uniform sampler2D depth;
uniform mat4 to_sun;
uniform vec3 sun;
uniform float size;
out vec4 after;
void main() {
  float cosine = dot(normal, sun), side = cosine < 0.0 ? -1.0 : 1.0;
  vec3 here = 0.5 + 0.5 * (to_sun * vec4(position + 0.008 * size * side * normal, 1)).xyz;
  float there = textureLod(depth, here.xy, 0.0).r;
  bool is_seen = there == 1.0 || there > here.z - 0.003;
  vec2 more = abs(cosine) * vec2(is_seen ? 1 : 0, 1);
  after = before + (side > 0.0 ? vec4(more, 0, 0) : vec4(0, 0, more));
}`;

const plain = `#version 300 es
in vec3 position, value;
uniform mat4 view;
out vec3 seen;
void main() { seen = value; gl_Position = view * vec4(position, 1); }`;

const nothing = `#version 300 es
precision lowp float;
out vec4 colour;
void main() { colour = vec4(0); }`;

/// A light from a direction, with the matrix of its depth map.
interface Light { to_sun: Float32Array; sun: Vector }

export class SolidDrawer {
    private readonly programs: { surface: Program; ground: Program; depth: Program; sky: Program };
    private readonly buffers: Record<string, WebGLBuffer> = {};
    private readonly frame: WebGLFramebuffer;
    private readonly feedback: WebGLTransformFeedback;
    private readonly points: WebGLVertexArrayObject;  ///< The vertices for which the light from the sky is computed.
    private shown?: Surface;
    private vertices = 0;  ///< The number of vertices of the surface. The vertices of the ground follow.
    private middle: Vector = [0, 0, 0];
    private size = 1;      ///< The diagonal of the surface's box.
    private began = 0;     ///< The time of the first tested direction.
    private is_slow = false;
    private holes = 0;     ///< The number of vertices without a value.
    private directions = 0;  ///< The number of tested directions of the sky.
    private readonly cells: CellDrawer;

    constructor(private readonly gl: WebGL2RenderingContext) {
        this.cells = new CellDrawer(gl);
        this.programs = {
            surface: new Program(gl, [vertex, surface]), ground: new Program(gl, [vertex, ground]),
            depth: new Program(gl, [plain, hidden]), sky: new Program(gl, [sky, nothing], ["after"]),
        };
        for (const name of ["position", "normal", "value", "sky", "before", "triangles", "squares"]) this.buffers[name] = gl.createBuffer()!;
        gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
        gl.texStorage2D(gl.TEXTURE_2D, 1, gl.DEPTH_COMPONENT32F, shadow_side, shadow_side);
        for (const side of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(gl.TEXTURE_2D, side, gl.CLAMP_TO_EDGE);
        for (const size of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, size, gl.NEAREST);
        this.frame = gl.createFramebuffer()!;
        gl.bindFramebuffer(gl.FRAMEBUFFER, this.frame);
        gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.TEXTURE_2D, gl.getParameter(gl.TEXTURE_BINDING_2D), 0);
        this.feedback = gl.createTransformFeedback()!;
        this.points = gl.createVertexArray()!;
        gl.enable(gl.DEPTH_TEST);
        gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    }

    /// Whether the light of the sky is still being computed. Then another picture will be better than the last.
    get is_getting_better() { return this.directions < (this.is_slow ? few_sky_directions : sky_directions); }

    take(shown: Surface) {
        const gl = this.gl, low: Vector = [Infinity, Infinity, Infinity], high: Vector = [-Infinity, -Infinity, -Infinity];
        shown.positions.forEach((part, k) => {
            low[k % 3] = Math.min(low[k % 3], part);
            high[k % 3] = Math.max(high[k % 3], part);
        });
        this.shown = shown;
        this.vertices = shown.positions.length / 3;
        this.middle = add(add([0, 0, 0], low, 0.5), high, 0.5);
        this.size = Math.hypot(...add(high, low, -1));
        const places: number[] = [], normals: number[] = [], squares: number[] = [];
        const [across, up] = shown.up === "y" ? [2, 1] : [1, 2], sign = shown.up === "y" ? 1 : -1;
        for (let k = 0; k < (ground_side + 1) ** 2; ++k) {
            const i = k % (ground_side + 1), j = Math.floor(k / (ground_side + 1)), place = [...this.middle], normal = [0, 0, 0];
            place[0] += (2 * i / ground_side - 1) * ground_reach * this.size;
            place[across] += sign * (2 * j / ground_side - 1) * ground_reach * this.size;
            place[up] = low[up];
            normal[up] = 1;
            places.push(...place);
            normals.push(...normal);
            const at = this.vertices + k;
            if (i < ground_side && j < ground_side) squares.push(at, at + 1, at + ground_side + 2, at, at + ground_side + 2, at + ground_side + 1);
        }
        const fill = (name: string, parts: ArrayBufferView[], target: number = gl.ARRAY_BUFFER) => {
            gl.bindBuffer(target, this.buffers[name]);
            gl.bufferData(target, parts.reduce((sum, { byteLength }) => sum + byteLength, 0), gl.STATIC_DRAW);
            parts.reduce((start, part) => (gl.bufferSubData(target, start, part), start + part.byteLength), 0);
        };
        fill("position", [shown.positions, new Float32Array(places)]);
        fill("normal", [shown.normals, new Float32Array(normals)]);
        fill("triangles", [shown.triangles], gl.ELEMENT_ARRAY_BUFFER);
        fill("squares", [new Uint32Array(squares)], gl.ELEMENT_ARRAY_BUFFER);
        this.holes = 0;
        this.forget_sky();
    }

    private forget_sky() {
        const gl = this.gl;
        this.directions = 0;
        this.began = performance.now();
        for (const name of ["sky", "before"]) {
            gl.bindBuffer(gl.ARRAY_BUFFER, this.buffers[name]);
            gl.bufferData(gl.ARRAY_BUFFER, 16 * (this.vertices + (ground_side + 1) ** 2), gl.STATIC_DRAW);
        }
    }

    /// The values of the vertices: one number or three for each.
    set values(values: Float32Array) {
        const gl = this.gl, channels = values.length / this.vertices;
        const holes = values.reduce((sum, value) => sum + (value === value ? 0 : 1), 0) / channels;
        if (holes !== this.holes) this.forget_sky();
        this.holes = holes;
        gl.bindBuffer(gl.ARRAY_BUFFER, this.buffers.value);
        gl.bufferData(gl.ARRAY_BUFFER, values.byteLength + 4 * channels * (ground_side + 1) ** 2, gl.STREAM_DRAW);
        gl.bufferSubData(gl.ARRAY_BUFFER, 0, values);
        this.bind("value", channels);
    }

    private bind(name: string, channels: number, buffer = name) {
        const gl = this.gl, at = attributes.indexOf(name);
        gl.bindBuffer(gl.ARRAY_BUFFER, this.buffers[buffer]);
        gl.enableVertexAttribArray(at);
        gl.vertexAttribPointer(at, channels, gl.FLOAT, false, 0, 0);
    }

    private light_from(sun: Vector): Light {
        const tangent = unit(cross(Math.abs(sun[0]) < 0.7 ? [1, 0, 0] : [0, 1, 0], sun)), radius = 0.52 * this.size;
        const rows = [tangent, cross(sun, tangent), add([0, 0, 0], sun, -1)].map((axis) => {
            const row = add([0, 0, 0], axis, 1 / radius);
            return [...row, -dot(row, this.middle)];
        });
        rows.push([0, 0, 0, 1]);
        return { sun, to_sun: new Float32Array([0, 1, 2, 3].flatMap((column) => rows.map((row) => row[column]))) };
    }

    private draw_triangles(buffer: "triangles" | "squares") {
        const gl = this.gl;
        gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, this.buffers[buffer]);
        gl.drawElements(gl.TRIANGLES, gl.getBufferParameter(gl.ELEMENT_ARRAY_BUFFER, gl.BUFFER_SIZE) / 4, gl.UNSIGNED_INT, 0);
    }

    private draw_depth(light: Light, has_cells = false) {
        const gl = this.gl;
        gl.bindFramebuffer(gl.FRAMEBUFFER, this.frame);
        gl.viewport(0, 0, shadow_side, shadow_side);
        gl.clear(gl.DEPTH_BUFFER_BIT);
        this.programs.depth.use({ view: light.to_sun });
        this.draw_triangles("triangles");
        if (has_cells) {
            this.cells.depth.use({ view: light.to_sun });
            this.cells.draw();
        }
        gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    }

    private look_along_sky() {
        const gl = this.gl, k = this.directions++;
        // Directions on a spiral over the sphere, in an order that soon covers it uniformly.
        const height = 1 - 2 * ((k * 0.6180339887 + 0.5) % 1), angle = 2.39996 * k, flat = Math.sqrt(1 - height * height);
        const light = this.light_from([flat * Math.cos(angle), height, flat * Math.sin(angle)]);
        this.draw_depth(light);
        this.programs.sky.use({ ...light, size: this.size });
        gl.bindVertexArray(this.points);
        this.bind("position", 3);
        this.bind("normal", 3);
        this.bind("before", 4);
        gl.bindBuffer(gl.ARRAY_BUFFER, null);
        gl.bindTransformFeedback(gl.TRANSFORM_FEEDBACK, this.feedback);
        gl.bindBufferBase(gl.TRANSFORM_FEEDBACK_BUFFER, 0, this.buffers.sky);
        gl.enable(gl.RASTERIZER_DISCARD);
        gl.beginTransformFeedback(gl.POINTS);
        gl.drawArrays(gl.POINTS, 0, this.vertices + (ground_side + 1) ** 2);
        gl.endTransformFeedback();
        gl.disable(gl.RASTERIZER_DISCARD);
        gl.bindBufferBase(gl.TRANSFORM_FEEDBACK_BUFFER, 0, null);
        gl.bindTransformFeedback(gl.TRANSFORM_FEEDBACK, null);
        gl.bindVertexArray(null);
        [this.buffers.sky, this.buffers.before] = [this.buffers.before, this.buffers.sky];
    }

    draw(camera: Camera, snapshot: Snapshot, palette: Palette, look: Look) {
        const gl = this.gl, { width, height } = gl.canvas;
        if (!this.shown) return;
        this.bind("position", 3);
        this.bind("normal", 3);
        gl.disable(gl.BLEND);
        this.is_slow = this.directions >= 4 * many_at_once && (performance.now() - this.began) * many_at_once > long * this.directions;
        for (let k = 0; k < many_at_once && this.is_getting_better; ++k) this.look_along_sky();
        const light = this.light_from(unit(add(add(camera.backward, camera.up, 0.9), camera.right, -0.7)));
        this.cells.take(snapshot);
        this.draw_depth(light, true);
        gl.viewport(0, 0, width, height);
        gl.clearColor(0, 0, 0, 0);
        gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
        this.bind("sky", 4, "before");
        const scene = { ...light, view: camera.matrix(), eye: camera.eye, size: this.size, middle: this.middle };
        const { surface, ground } = this.programs, has_cells = snapshot.cells !== undefined;
        const use = (program: Program, is_colour: boolean, has_lines: boolean) => {
            program.use({ ...scene, low: snapshot.low, high: snapshot.high, every: has_lines ? look.every ?? 0 : 0, at: look.at ?? 0 });
            program.whole("has_line", has_lines && look.at !== undefined ? 1 : 0);
            gl.uniform3fv(gl.getUniformLocation(program.handle, "stops"), palette.stops.flat());
            program.whole("last", palette.stops.length - 1);
            program.whole("is_colour", is_colour ? 1 : 0);
        };
        // A surface below cells that crawl has one colour and no lines.
        use(surface, has_cells || snapshot.planes.length === 3, !has_cells);
        this.draw_triangles("triangles");
        use(this.cells.lit, snapshot.planes.length === 3, false);
        this.cells.draw();
        gl.enable(gl.BLEND);
        ground.use(scene);
        this.draw_triangles("squares");
    }
}
