// A view of a surface in space: pointers and keys turn and enlarge it, and vertices show filtered values of cells.
import { Camera, Vector, add, unit } from "./camera";
import { corners_of, floor_of, nearest_cell, place_of_cell } from "./cells_in_space";
import type { Cells, Palette, Snapshot, Surface } from "./connection";
import type { View } from "./gestures";
import type { Look } from "./look";
import type { Place } from "./pattern";
import { SolidDrawer } from "./solid_drawer";

const most_zoom = 64;
const degrees = 0.4;  ///< The rotation for a movement by one pixel.
const key_pixels = 20;  ///< The movement for a key.

export class SolidView implements View {
    readonly held_by_two = "angle";
    readonly camera = new Camera();
    surface?: Surface;
    moved: () => void = () => {};  ///< Called when the view changes.
    drawn: () => void = () => {};  ///< Called after each drawing, which happens in the page's next frame.
    private drawer?: SolidDrawer;
    private shown?: { snapshot: Snapshot; palette: Palette; look: Look };
    private values: Float32Array = new Float32Array();  ///< The values of the vertices.
    private is_waiting = false;
    private has_moved = true;
    private corners: Float32Array[] = [];  ///< The corners of cells that crawl.
    private projected?: Float32Array;  ///< The vertices projected by the camera.

    constructor(readonly canvas: HTMLCanvasElement, use_shader = true) {
        if (use_shader) this.begin();
        canvas.addEventListener("webglcontextlost", (event) => event.preventDefault());
        canvas.addEventListener("webglcontextrestored", () => {
            this.begin();
            const { surface, shown } = this;
            if (!surface || !shown) return;
            this.take(surface);
            this.draw(shown.snapshot, shown.palette, shown.look);
        });
        new ResizeObserver(() => this.look()).observe(canvas);
        document.addEventListener("keydown", (event) => {
            const arrow = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
            const at = event.target as HTMLElement;
            if (!arrow || canvas.hidden || at.id === "editor" || at.closest("dialog, input, select")) return;
            event.preventDefault();
            // An arrow key moves the camera in its direction, so the picture moves in the opposite direction.
            if (event.shiftKey) this.shift(-key_pixels * arrow[0], -key_pixels * arrow[1]);
            else this.turn(-key_pixels * arrow[0], -key_pixels * arrow[1]);
        });
        // The shape of the pointer shows the effect of a press.
        canvas.addEventListener("pointermove", (event) => {
            if (event.buttons === 0) canvas.style.cursor = this.place(event) ? "" : "grab";
        });
    }

    private begin() {
        const gl = this.canvas.getContext("webgl2", { preserveDrawingBuffer: true, premultipliedAlpha: true, antialias: true });
        this.drawer = gl ? new SolidDrawer(gl) : undefined;
    }

    /// Whether this browser can draw surfaces in space.
    get is_possible() { return this.drawer !== undefined; }
    /// The direction of view in whole degrees, as in requests for pictures.
    get view() {
        const { azimuth, elevation } = this.camera;
        return { around: Math.round(azimuth - 360 * Math.round(azimuth / 360)), above: Math.round(elevation) };
    }
    get zoom() { return this.camera.zoom; }

    take(surface: Surface) {
        this.surface = surface;
        this.corners = [];
        this.projected = undefined;
        this.has_moved = true;
        this.shown = undefined;
        this.drawer?.take(surface);
    }

    /// Puts a floor below cells that crawl without a model.
    lay_floor({ extent }: Cells) {
        const floor = floor_of(extent!);
        if (this.surface?.number === 0 && this.surface.positions.every((part, k) => part === floor.positions[k])) return;
        this.take(floor);
    }

    draw(snapshot: Snapshot, palette: Palette, look: Look) {
        const { cells } = snapshot;
        if (cells !== this.shown?.snapshot.cells) {
            this.corners = cells ? [corners_of(cells)] : [];
            this.has_moved = true;
        }
        this.shown = { snapshot, palette, look };
        if (!this.surface || !this.drawer) return;
        const vertices = this.surface.positions.length / 3;
        this.drawer.values = this.values = cells ? Float32Array.from({ length: 3 * vertices }, (_, k) => cells.skin[k % 3])
            : values_of_vertices(this.surface, snapshot);
        this.redraw();
    }

    fit() {
        Object.assign(this.camera, { azimuth: 30, elevation: 25, zoom: 1, right_by: 0, up_by: 0 });
        this.look();
    }

    held_at(event: PointerEvent) { return this.place(event) ? "brush" as const : "angle" as const; }

    shift(right: number, down: number) {
        const { clientWidth, clientHeight } = this.canvas;
        this.camera.shift(2 * right / clientWidth, -2 * down / clientHeight);
        this.look();
    }

    /// Scales about a point of the window, or about the middle.
    scale(factor: number, x?: number, y?: number) {
        const { camera } = this, [right, up] = this.seen_at(x, y), zoom = Math.min(Math.max(camera.zoom * factor, 1), most_zoom);
        const change = zoom / camera.zoom;
        camera.zoom = zoom;
        camera.shift((right - camera.right_by) * (1 - change), (up - camera.up_by) * (1 - change));
        this.look();
    }

    /// Turns the surface about the middle of the picture.
    turn(right: number, down: number) {
        const { camera } = this, held = camera.zoom > 1 ? this.hit(0, 0)?.place : undefined;
        camera.azimuth -= degrees * right / Math.sqrt(camera.zoom);
        camera.elevation = Math.min(Math.max(camera.elevation + degrees * down / Math.sqrt(camera.zoom), -89), 89);
        this.frame();
        if (held) {
            const [by_right, by_up] = camera.project(held);
            camera.shift(-by_right, -by_up);
        }
        this.look();
    }

    /// The position of a pointer on the surface, or undefined beside the surface.
    place(event: { clientX: number; clientY: number }): Place | undefined {
        const hit = this.hit(...this.seen_at(event.clientX, event.clientY)), { surface } = this;
        if (!hit || !surface) return undefined;
        const [x, y, z] = hit.place, { corners, parts } = hit, mixed = (numbers: Float32Array, size: number, k: number) =>
            corners.reduce((sum, corner, c) => sum + parts[c] * numbers[size * corner + k], 0);
        const cells = this.shown?.snapshot.cells;
        if (cells) return { ...(cells.extent ? { x, y: z } : cells.is_flat ? { x, y: z, z: y } : { x, y, z }), cell: nearest_cell(cells, hit.place) };
        const where = surface.places ? { x: mixed(surface.places, 2, 0), y: mixed(surface.places, 2, 1) } : { x, y, z };
        // The cell with the largest weight at this point is taken as the nearest.
        const weights = new Map<number, number>();
        corners.forEach((corner, c) => {
            for (let k = corner === 0 ? 0 : surface.ends[corner - 1]; k < surface.ends[corner]; ++k) {
                weights.set(surface.cells[2 * k], (weights.get(surface.cells[2 * k]) ?? 0) + parts[c] * surface.weights[2 * k + 1]);
            }
        });
        const [cell] = [...weights].reduce((best, each) => each[1] > best[1] ? each : best);
        return { ...where, cell };
    }

    /// The normal of the surface at a pointer, outwards, of length 1.
    normal(event: { clientX: number; clientY: number }): Vector | undefined {
        const hit = this.hit(...this.seen_at(event.clientX, event.clientY)), { surface } = this;
        if (!hit || !surface) return undefined;
        const { normals } = surface;
        return unit(hit.corners.reduce((sum, corner, c) => add(sum, [normals[3 * corner], normals[3 * corner + 1], normals[3 * corner + 2]], hit.parts[c]), [0, 0, 0] as Vector));
    }

    /// The position of a cell in the window, or undefined if it is on the far side.
    box_of_cell(cell: number): DOMRect | undefined {
        const { surface } = this;
        if (!surface) return undefined;
        const crawling = this.shown?.snapshot.cells;
        if (crawling) return this.box_of_place(place_of_cell(crawling, cell));
        const { ends, cells, weights, positions } = surface;
        let best = -1, most = 0;
        for (let v = 0, k = 0; v < ends.length; ++v) {
            for (; k < ends[v]; ++k) {
                if (cells[2 * k] !== cell || weights[2 * k + 1] <= most) continue;
                most = weights[2 * k + 1];
                best = v;
            }
        }
        return this.box_of_place(best < 0 ? undefined : [positions[3 * best], positions[3 * best + 1], positions[3 * best + 2]]);
    }

    /// The position of a point in the window, or undefined if it is on the far side.
    private box_of_place(place?: Vector): DOMRect | undefined {
        const { camera, canvas } = this;
        if (!place) return undefined;
        const [x, y, away] = camera.project(place);
        const hit = this.hit(x, y), box = canvas.getBoundingClientRect();
        if (hit && camera.project(hit.place)[2] < 0.99 * away) return undefined;
        return new DOMRect(box.x + (x + 1) / 2 * box.width, box.y + (1 - y) / 2 * box.height, 0, 0);
    }

    /// Converts a point of the window to coordinates of the picture, −1 … 1.
    private seen_at(x?: number, y?: number): [number, number] {
        const box = this.canvas.getBoundingClientRect();
        return x === undefined || y === undefined ? [0, 0] : [2 * (x - box.x) / box.width - 1, 1 - 2 * (y - box.y) / box.height];
    }

    /// The nearest triangle at a point of the picture: the position in space, its corners, and their barycentric
    /// weights.
    private hit(x: number, y: number): { place: Vector; corners: number[]; parts: number[] } | undefined {
        const { surface } = this;
        if (!surface) return undefined;
        const { positions, triangles } = surface, seen = (this.projected ??= this.project(positions));
        const channels = this.values.length / (positions.length / 3), is_hole = (vertex: number) => Number.isNaN(this.values[channels * vertex]);
        let nearest = Infinity, found = -1;
        let found_parts: number[] = [];
        for (let t = 0; t < triangles.length; t += 3) {
            const a = 3 * triangles[t], b = 3 * triangles[t + 1], c = 3 * triangles[t + 2];
            const ax = seen[a] - x, bx = seen[b] - x, cx = seen[c] - x;
            if ((ax > 0 && bx > 0 && cx > 0) || (ax < 0 && bx < 0 && cx < 0)) continue;
            const ay = seen[a + 1] - y, by = seen[b + 1] - y, cy = seen[c + 1] - y;
            const of_a = bx * cy - cx * by, of_b = cx * ay - ax * cy, of_c = ax * by - bx * ay, whole = of_a + of_b + of_c;
            if (!(of_a / whole >= 0 && of_b / whole >= 0 && of_c / whole >= 0)) continue;
            // A value that is linear in space, divided by the distance, is linear in the picture.
            const parts = [of_a / seen[a + 2], of_b / seen[b + 2], of_c / seen[c + 2]], sum = parts[0] + parts[1] + parts[2];
            if (whole / sum >= nearest || is_hole(triangles[t]) || is_hole(triangles[t + 1]) || is_hole(triangles[t + 2])) continue;
            nearest = whole / sum;
            found = t;
            found_parts = parts.map((part) => part / sum);
        }
        if (found < 0) return undefined;
        const corners = [...triangles.subarray(found, found + 3)];
        const place = [0, 1, 2].map((k) => corners.reduce((sum, corner, c) => sum + found_parts[c] * positions[3 * corner + k], 0));
        return { place: place as Vector, corners, parts: found_parts };
    }

    private project(positions: Float32Array): Float32Array {
        const seen = new Float32Array(positions.length);
        for (let k = 0; k < positions.length; k += 3) seen.set(this.camera.project([positions[k], positions[k + 1], positions[k + 2]]), k);
        return seen;
    }

    private frame() {
        const { canvas, surface, camera } = this;
        this.projected = undefined;
        if (surface) camera.frame([surface.positions, ...this.corners], surface.up, canvas.clientWidth, canvas.clientHeight);
    }

    private look() {
        this.has_moved = true;
        this.redraw();
    }

    private redraw() {
        this.canvas.parentElement!.toggleAttribute("data-moved", this.camera.zoom > 1 || this.camera.azimuth !== 30 || this.camera.elevation !== 25);
        if (this.is_waiting) return;
        this.is_waiting = true;
        requestAnimationFrame(() => {
            this.is_waiting = false;
            const { canvas, camera, drawer, shown, surface } = this;
            if (!drawer || !shown || !surface || canvas.hidden || canvas.clientWidth * canvas.clientHeight === 0) return;
            const [width, height] = [canvas.clientWidth, canvas.clientHeight].map((side) => Math.round(side * devicePixelRatio));
            if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
            if (this.has_moved) this.frame();
            if (this.has_moved) this.moved();
            this.has_moved = false;
            drawer.draw(camera, shown.snapshot, shown.palette, shown.look);
            this.drawn();
            if (drawer.is_getting_better) this.redraw();
        });
    }
}

/// The filtered value of each vertex. Cells without a value are left out.
function values_of_vertices({ positions, ends, cells, weights }: Surface, { planes }: Snapshot): Float32Array {
    const channels = planes.length, values = new Float32Array(positions.length / 3 * channels);
    for (let c = 0; c < channels; ++c) {
        const plane = planes[c];
        for (let v = 0, k = 0; v < ends.length; ++v) {
            let sum = 0, whole = 0;
            for (; k < ends[v]; ++k) {
                const value = plane[cells[2 * k]], weight = weights[2 * k + 1];
                if (Number.isNaN(value)) continue;
                sum += weight * value;
                whole += weight;
            }
            values[channels * v + c] = sum / whole;
        }
    }
    return values;
}
