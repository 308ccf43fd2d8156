// The pattern on a canvas: a plane, smooth or with a pixel for each cell, or a surface in space, which has a separate
// canvas.
import { divided, filled } from "./between_cells";
import type { Palette, Snapshot } from "./connection";
import { LineDrawer, has_lines } from "./line_drawer";
import type { Look } from "./look";
import { PlanePainter } from "./plane_painter";
import type { SolidView } from "./solid_view";
import { TimeRows, is_row } from "./time_rows";

const sharp_from = 24;  ///< The width of cells, in pixels of the page, above which an enlarged plane shows squares.
const most_pixels = 1 << 20;  ///< The largest number of pixels of a smooth plane. The browser enlarges them.

/// A position on the pattern: coordinates of scripts, z only in a volume, and the index of the cell in the planes of
/// snapshots.
export interface Place { x: number; y: number; z?: number; cell: number }

/// How a plane is drawn: the pixels along a side of a cell, and whether values between cells are shown.
interface Form { scale: number; is_smooth: boolean }

export class Pattern {
    private readonly painter = new PlanePainter();
    private readonly lines: LineDrawer;
    private ratio = 0;      ///< The width of the canvas divided by its height.
    private drawn_as = "";  ///< The form of the plane on the canvas.
    readonly time = new TimeRows();
    snapshot?: Snapshot;
    palette?: Palette;
    look: Look = { relief: 0, squares: false };
    columns = 1;  ///< The columns of cells on the canvas.
    rows = 1;
    is_laid_flat = false;  ///< Whether a surface given by formulas is shown as a plane.
    /// Called with the snapshot that is drawn and the range of its values.
    drawn: (shown: Snapshot) => void = () => {};

    constructor(readonly canvas: HTMLCanvasElement, readonly solid: SolidView, use_shader = true) {
        this.lines = new LineDrawer(use_shader);
    }

    /// Whether the pattern is drawn in space.
    get is_solid() {
        const { snapshot, solid } = this, { surface } = solid;
        return !!snapshot && !!surface && solid.is_possible && surface.number === snapshot.surface
            && (surface.number > 0 || !!snapshot.cells) && !(this.is_laid_flat && surface.places);
    }

    /// The visible canvas.
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
        const form = this.form_of(columns, rows), { scale, is_smooth } = form;
        canvas.style.imageRendering = scale > 1 || is_smooth ? "auto" : "";
        // The canvas fills its frame, with the proportions of the domain.
        const [across, down] = is_row(snapshot) ? [1, 1] : snapshot.cell ?? [1, 1], ratio = columns * across / (rows * down);
        if (canvas.width !== columns * scale || canvas.height !== rows * scale || this.ratio !== ratio) {
            canvas.width = columns * scale;
            canvas.height = rows * scale;
            this.ratio = ratio;
            canvas.style.width = `min(100cqw, ${100 * ratio}cqh)`;
            canvas.style.height = `min(100cqh, ${100 / ratio}cqw)`;
        }
        this.columns = columns;
        this.rows = rows;
        this.drawn_as = JSON.stringify(form);
        this.draw_plane(shown, palette, form);
    }

    private draw_plane(shown: Snapshot, palette: Palette, { scale, is_smooth }: Form) {
        const { columns, rows, repeats } = shown, pen = this.canvas.getContext("2d")!;
        const cells = shown.planes.map((numbers) => ({ columns, rows, numbers }));
        const is_lined = this.has_lines(shown), whole = cells.map((plane) => filled(plane, repeats)), [{ there }] = whole;
        if (scale === 1 && !is_lined) return pen.putImageData(this.painter.paint(cells, shown, palette, there), 0, 0);
        const values = whole.map((plane) => divided(plane.values, scale, repeats));
        const image = is_smooth ? this.painter.paint(values, shown, palette, there && divided(there, scale, repeats)) : this.painter.paint(cells, shown, palette, there);
        if (!is_lined) return pen.putImageData(image, 0, 0);
        pen.clearRect(0, 0, this.canvas.width, this.canvas.height);
        pen.drawImage(this.lines.draw(values[0], image, scale, shown, palette, this.look), 0, 0);
    }

    private has_lines({ planes }: Snapshot) { return this.lines.is_possible && has_lines(this.look) && planes.length === 1; }

    /// A smooth plane has about as many pixels as the screen. If cells are squares, each has one pixel, or several
    /// pixels below lines and relief.
    private form_of(columns: number, rows: number): Form {
        const { canvas, snapshot } = this, wide = canvas.getBoundingClientRect().width, seen = wide * devicePixelRatio / columns;
        const is_near = wide > canvas.offsetWidth * 1.01 && wide >= sharp_from * columns;
        const is_smooth = !this.look.squares && !is_near && !is_row(snapshot!);
        if (this.has_lines(snapshot!)) return { is_smooth, scale: Math.max(1, Math.min(Math.ceil(seen), 16, Math.floor(4096 / Math.max(columns, rows)))) };
        return { is_smooth, scale: is_smooth ? Math.max(1, Math.min(Math.round(seen), Math.floor(Math.sqrt(most_pixels / (columns * rows))))) : 1 };
    }

    /// Draws again if the form of the plane has changed.
    redraw() { if (this.snapshot && JSON.stringify(this.form_of(this.columns, this.rows)) !== this.drawn_as) this.draw(); }

    /// The values at the palette's ends: fixed values, or those of the snapshot.
    range_of({ low, high }: Snapshot) { return { low: this.look.low ?? low, high: this.look.high ?? high }; }

    /// The number of cells along the longest side of the grid.
    get longest() {
        const { snapshot } = this;
        return snapshot ? Math.max(...(snapshot.slice?.sides ?? [snapshot.columns, snapshot.rows])) : 1;
    }

    /// The position of a pointer on the pattern, or undefined beside the pattern.
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

    /// The number of a cell in the grid: column + width · (row + height · slice). On planes and
    /// models it is the index in the planes of snapshots. For a volume, snapshots contain the
    /// planes of one slice only.
    cell_in_grid(cell: number) {
        const { columns, slice } = this.snapshot!, column = cell % columns, row = Math.floor(cell / columns);
        if (!slice) return cell;
        const { axis, number, sides: [width, height] } = slice;
        const [i, j, k] = axis === "z" ? [column, row, number] : axis === "y" ? [column, number, row] : [number, row, column];
        return i + width * (j + height * k);
    }

    /// The rectangle of a cell on the page, or undefined if the cell is not visible.
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

    /// The name of a cell: its column, row and slice, or its number.
    name_of(cell: number) {
        const { slice, rows, is_model, cells } = this.snapshot!;
        return is_model || cells ? `cell ${cell}` : `cell ${this.place_of(cell).slice(0, slice ? 3 : rows === 1 ? 1 : 2).join(", ")}`;
    }
}
