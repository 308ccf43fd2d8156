// The visible part of a plane. The canvas itself is moved and scaled, so positions on it still correspond to cells.
import type { View } from "./gestures";

const largest_cell = 64;  ///< The largest side of a cell in pixels of the page.

export class PlaneView implements View {
    readonly held_by_two = "plane";
    zoom = 1;
    moved: () => void = () => {};  ///< Called when another part becomes visible.
    private left = 0;  ///< The shift of the canvas from its position without zoom.
    private top = 0;

    /// `columns` returns the number of columns of cells.
    constructor(private readonly canvas: HTMLCanvasElement, private readonly columns: () => number) {
        new ResizeObserver(() => this.shift(0, 0)).observe(canvas);
    }

    held_at() { return "brush" as const; }
    turn() {}

    fit() {
        this.zoom = 1;
        this.shift(0, 0);
    }

    /// Scales about a point of the window, or about the middle of the visible part.
    scale(factor: number, x?: number, y?: number) {
        const frame = this.canvas.parentElement!.getBoundingClientRect(), box = this.canvas.getBoundingClientRect();
        const most = Math.max(1, largest_cell * this.columns() / this.canvas.offsetWidth);
        const zoom = Math.min(Math.max(this.zoom * factor, 1), most), change = zoom / this.zoom;
        this.zoom = zoom;
        this.shift(((x ?? frame.x + frame.width / 2) - box.x) * (1 - change), ((y ?? frame.y + frame.height / 2) - box.y) * (1 - change));
    }

    /// Moves by pixels of the page, but leaves no empty space in the frame that the pattern could fill.
    shift(right: number, down: number) {
        const { canvas, zoom } = this, frame = canvas.parentElement!;
        const inside = (place: number, start: number, size: number, room: number) => {
            const spare = room - size * zoom;
            return (spare >= 0 ? spare / 2 : Math.min(Math.max(start + place, spare), 0)) - start;
        };
        this.left = inside(this.left + right, canvas.offsetLeft, canvas.offsetWidth, frame.clientWidth);
        this.top = inside(this.top + down, canvas.offsetTop, canvas.offsetHeight, frame.clientHeight);
        canvas.style.transform = zoom === 1 ? "" : `translate(${this.left}px, ${this.top}px) scale(${zoom})`;
        frame.toggleAttribute("data-zoomed", zoom > 1);
        this.moved();
    }
}
