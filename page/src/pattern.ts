// The pattern on a canvas of one pixel a cell: by WebGL2, or by the processor where that is missing.
import { colours } from "./colours";
import type { Palette, Snapshot } from "./connection";
import type { Look } from "./look";
import type { SolidView } from "./solid_view";
import { TimeRows, is_row } from "./time_rows";

const vertex = `#version 300 es
void main() { gl_Position = vec4(gl_VertexID == 1 ? 3 : -1, gl_VertexID == 2 ? 3 : -1, 0, 1); }`;

/// Light is that of render/tracer.cpp without shadows.
const fragment = `#version 300 es
precision highp float;
precision highp sampler2D;
uniform sampler2D red, green, blue;
uniform float low, high, rows, scale, relief;
out vec4 colour;
${colours}
/// Between the middles of cells.
float value_at(vec2 place) {
  ivec2 end = textureSize(red, 0) - 1;
  vec2 from = clamp(place - 0.5, vec2(0), vec2(end)), part = fract(from);
  ivec2 one = ivec2(from), other = min(one + 1, end);
  return mix(mix(texelFetch(red, one, 0).r, texelFetch(red, ivec2(other.x, one.y), 0).r, part.x),
    mix(texelFetch(red, ivec2(one.x, other.y), 0).r, texelFetch(red, other, 0).r, part.x), part.y);
}
float height_at(vec2 place) { return 12.0 * relief * position_of(value_at(place)); }
vec3 lit(vec3 seen, vec2 place) {
  vec3 normal = normalize(vec3(height_at(place - vec2(1, 0)) - height_at(place + vec2(1, 0)),
    height_at(place + vec2(0, 1)) - height_at(place - vec2(0, 1)), 2));
  if (isnan(normal.x)) return seen;
  vec3 sun = normalize(vec3(-0.7, 0.9, 1));
  // As much light as before where it is flat.
  float light = (0.72 * max(0.0, dot(normal, sun)) + 0.42) / (0.72 * sun.z + 0.42);
  float gleam = 0.06 * pow(max(0.0, dot(normal, normalize(sun + vec3(0, 0, 1)))), 40.0);
  return pow(pow(seen, vec3(2.2)) * light + gleam, vec3(1.0 / 2.2));
}
void main() {
  vec2 place = vec2(gl_FragCoord.x, rows * scale - gl_FragCoord.y) / scale;
  ivec2 cell = ivec2(place);
  vec3 value = vec3(texelFetch(red, cell, 0).r, texelFetch(green, cell, 0).r, texelFetch(blue, cell, 0).r);
  float smooth_value = value_at(place), change = fwidth(smooth_value);
  if (isnan(value.r)) { colour = vec4(0); return; }
  if (is_colour) { colour = vec4(clamp(value, 0.0, 1.0), 1); return; }
  vec3 seen = colour_of(value.r);
  if (relief > 0.0) seen = lit(seen, place);
  colour = vec4(mix(seen, vec3(line_level(smooth_value)), line_part(smooth_value, change)), 1);
}`;

/// Where a pointer is: coordinates as scripts have them, z in a volume, and the index of the cell in the planes of
/// snapshots.
export interface Place { x: number; y: number; z?: number; cell: number }

interface Drawer {
    /// Lines and relief want more pixels than one for each cell.
    readonly has_lines: boolean;
    draw(snapshot: Snapshot, palette: Palette, look: Look, scale: number): void;
}

class ShaderDrawer implements Drawer {
    readonly has_lines = true;
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

    draw(snapshot: Snapshot, palette: Palette, look: Look, scale: number) {
        const gl = this.gl, { columns, rows, planes } = snapshot;
        gl.viewport(0, 0, columns * scale, rows * scale);
        this.textures.forEach((_, unit) => {
            gl.activeTexture(gl.TEXTURE0 + unit);
            if (unit > 0 && planes.length === 1) return;
            gl.texImage2D(gl.TEXTURE_2D, 0, gl.R32F, columns, rows, 0, gl.RED, gl.FLOAT, planes[unit]);
        });
        gl.uniform3fv(this.at("stops"), palette.stops.flat());
        gl.uniform1i(this.at("last"), palette.stops.length - 1);
        const numbers = { low: snapshot.low, high: snapshot.high, rows, scale, every: look.every ?? 0, at: look.at ?? 0, relief: look.relief };
        for (const [name, value] of Object.entries(numbers)) gl.uniform1f(this.at(name), value);
        gl.uniform1i(this.at("has_line"), look.at === undefined ? 0 : 1);
        gl.uniform1i(this.at("is_colour"), planes.length === 3 ? 1 : 0);
        gl.drawArrays(gl.TRIANGLES, 0, 3);
    }
}

class ProcessorDrawer implements Drawer {
    readonly has_lines = false;
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
    look: Look = { relief: 0 };
    columns = 1;  ///< Of what is drawn.
    rows = 1;
    is_laid_flat = false;  ///< Is a surface of parameters shown as their plane?
    /// Is told what is drawn, with the range of its values.
    drawn: (shown: Snapshot) => void = () => {};

    constructor(readonly canvas: HTMLCanvasElement, readonly solid: SolidView, use_shader = true) {
        // Kept for whoever reads the picture after it was drawn.
        const gl = use_shader ? canvas.getContext("webgl2", { preserveDrawingBuffer: true, premultipliedAlpha: true }) : null;
        this.drawer = gl ? new ShaderDrawer(gl) : new ProcessorDrawer(canvas.getContext("2d")!);
    }

    /// Is it drawn in space?
    get is_solid() {
        const { snapshot, solid } = this, { surface } = solid;
        return !!snapshot && !!surface && solid.is_possible && surface.number === snapshot.surface
            && (surface.number > 0 || !!snapshot.cells) && !(this.is_laid_flat && surface.places);
    }

    /// The canvas that is seen.
    get seen() { return this.is_solid ? this.solid.canvas : this.canvas; }

    draw() {
        const { canvas, snapshot, palette, look, solid } = this;
        if (!snapshot || !palette) return;
        if (snapshot.cells?.extent) solid.lay_floor(snapshot.cells);
        solid.canvas.hidden = !this.is_solid;
        canvas.hidden = this.is_solid || snapshot.is_model || !!snapshot.cells;
        const values = is_row(snapshot) ? this.time.with(snapshot) : snapshot, { columns, rows } = values;
        this.drawn(values);
        const shown = { ...values, ...this.range_of(values) };
        if (this.is_solid || snapshot.cells) return solid.draw(shown, palette, look);
        const scale = this.pixels_of_cell(columns, rows);
        canvas.style.imageRendering = scale > 1 ? "auto" : "";
        if (canvas.width !== columns * scale || canvas.height !== rows * scale) {
            canvas.width = columns * scale;
            canvas.height = rows * scale;
            // As large as its frame, in the shape of the grid.
            const ratio = columns / rows;
            canvas.style.width = `min(100cqw, ${100 * ratio}cqh)`;
            canvas.style.height = `min(100cqh, ${100 / ratio}cqw)`;
        }
        this.columns = columns;
        this.rows = rows;
        this.drawer.draw(shown, palette, look, scale);
    }

    /// Along a side of a cell: 1, or for lines and relief about as many as the screen has.
    private pixels_of_cell(columns: number, rows: number) {
        const { relief, every, at } = this.look, is_smooth = relief > 0 || every !== undefined || at !== undefined;
        if (!is_smooth || !this.drawer.has_lines) return 1;
        const seen = this.canvas.getBoundingClientRect().width * devicePixelRatio / columns;
        return Math.max(1, Math.min(Math.ceil(seen), 16, Math.floor(4096 / Math.max(columns, rows))));
    }

    /// Again if what is seen has more pixels now.
    redraw() { if (this.pixels_of_cell(this.columns, this.rows) !== this.canvas.width / this.columns) this.draw(); }

    /// The values of the palette's ends: held, or those of a snapshot.
    range_of({ low, high }: Snapshot) { return { low: this.look.low ?? low, high: this.look.high ?? high }; }

    /// The number of cells along the longest side of the grid.
    get longest() {
        const { snapshot } = this;
        return snapshot ? Math.max(...(snapshot.slice?.sides ?? [snapshot.columns, snapshot.rows])) : 1;
    }

    /// Where a pointer is on the pattern; nothing beside it.
    place(event: { clientX: number; clientY: number }): Place | undefined {
        const { canvas, snapshot, longest, columns: width, rows: height } = this, box = canvas.getBoundingClientRect();
        if (!snapshot || snapshot.is_model || snapshot.cells || this.is_solid) return this.is_solid ? this.solid.place(event) : undefined;
        const { slice, columns } = snapshot;
        const right = (event.clientX - box.left) / box.width * width, down = (event.clientY - box.top) / box.height * height;
        if (!(right >= 0 && right < width && down >= 0 && down < height)) return undefined;
        if (is_row(snapshot)) return { x: right / longest, y: 0.5 / longest, cell: Math.floor(right) };
        const cell = Math.floor(down) * columns + Math.floor(right), across = slice ? slice.number + 0.5 : 0;
        const [x, y, z] = !slice || slice.axis === "z" ? [right, down, across]
            : slice.axis === "y" ? [right, across, down] : [across, down, right];
        return { x: x / longest, y: y / longest, ...(slice && { z: z / longest }), cell };
    }

    /// The number of a cell in the grid: column + width · (row + height · slice). On planes and models it is the
    /// index in the planes of snapshots; of a volume these hold a slice only.
    cell_in_grid(cell: number) {
        const { columns, slice } = this.snapshot!, column = cell % columns, row = Math.floor(cell / columns);
        if (!slice) return cell;
        const { axis, number, sides: [width, height] } = slice;
        const [i, j, k] = axis === "z" ? [column, row, number] : axis === "y" ? [column, number, row] : [number, row, column];
        return i + width * (j + height * k);
    }

    /// Where a cell of the grid is on the page; nothing if it is not seen.
    box_of_cell(cell: number): DOMRect | undefined {
        const { canvas, snapshot, columns } = this;
        if (!snapshot || snapshot.is_model || snapshot.cells || this.is_solid) return this.is_solid ? this.solid.box_of_cell(cell) : undefined;
        const { slice } = snapshot, [i, j, k] = this.place_of(cell);
        if (slice && [i, j, k]["xyz".indexOf(slice.axis)] !== slice.number) return undefined;
        const [column, row] = !slice || slice.axis === "z" ? [i, j] : slice.axis === "y" ? [i, k] : [k, j];
        if (column >= columns || row >= this.rows) return undefined;
        const box = canvas.getBoundingClientRect(), side = box.width / columns;
        return new DOMRect(box.x + column * side, box.y + row * side, side, side);
    }

    /// Column, row and slice of a cell of the grid.
    private place_of(cell: number) {
        const [width, height] = this.snapshot!.slice?.sides ?? [this.snapshot!.columns, this.snapshot!.rows];
        const line = Math.floor(cell / width);
        return [cell % width, line % height, Math.floor(line / height)];
    }

    /// A cell of the grid in words.
    name_of(cell: number) {
        const { slice, rows, is_model, cells } = this.snapshot!;
        return is_model || cells ? `cell ${cell}` : `cell ${this.place_of(cell).slice(0, slice ? 3 : rows === 1 ? 1 : 2).join(", ")}`;
    }
}
