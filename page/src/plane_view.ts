// Which part of the pattern is seen: wheel, drag, fingers and keys move it, and the pointer paints.
// The canvas itself is moved and scaled, so places on it stay those of cells.

const largest_cell = 64;     ///< In pixels of the page.
const finger_tremble = 8;    ///< A finger that moves less may be the first of two.

function distance(one: PointerEvent, other: PointerEvent) {
    return Math.hypot(one.clientX - other.clientX, one.clientY - other.clientY);
}

export class PlaneView {
    zoom = 1;
    moved: () => void = () => {};  ///< Is called when another part is seen.
    private left = 0;  ///< Of the canvas, from where it lies without zoom.
    private top = 0;
    private readonly pressed = new Map<number, PointerEvent>();  ///< Where each pointer was last.
    private waiting?: PointerEvent;  ///< A finger's press that may become a stroke.
    private holds: "nothing" | "brush" | "plane" = "nothing";

    /// `columns` tells how many cells lie side by side. `paint` is called for each place of a stroke, `is_first` with its first one.
    constructor(private readonly canvas: HTMLCanvasElement, private readonly columns: () => number, private readonly paint: (event: PointerEvent, is_first: boolean) => void) {
        canvas.addEventListener("pointerdown", (event) => this.press(event));
        canvas.addEventListener("pointermove", (event) => this.move(event));
        for (const end of ["pointerup", "pointercancel"] as const) canvas.addEventListener(end, (event) => this.release(event));
        // Else the middle button scrolls.
        canvas.addEventListener("mousedown", (event) => event.button === 1 && event.preventDefault());
        canvas.parentElement!.addEventListener("wheel", (event) => {
            event.preventDefault();
            const lines = event.deltaMode === WheelEvent.DOM_DELTA_PIXEL ? 1 : 30;
            // Two fingers on a touchpad come as a wheel with Ctrl, in small steps.
            this.scale(Math.exp(-event.deltaY * lines * (event.ctrlKey ? 0.01 : 0.002)), event.clientX, event.clientY);
        }, { passive: false });
        new ResizeObserver(() => this.shift(0, 0)).observe(canvas);
    }

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

    /// By pixels of the page, but never so far that the frame shows less of the pattern than it could.
    private shift(right: number, down: number) {
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

    private press(event: PointerEvent) {
        this.canvas.setPointerCapture(event.pointerId);
        this.pressed.set(event.pointerId, event);
        this.waiting = undefined;
        if (this.pressed.size > 1 || event.button === 1 || event.ctrlKey || event.metaKey) this.holds = "plane";
        else if (event.button === 0) this.holds = "brush";
        if (this.holds !== "brush") return;
        if (event.pointerType === "touch") this.waiting = event;
        else this.paint(event, true);
    }

    private move(event: PointerEvent) {
        const before = this.pressed.get(event.pointerId);
        if (!before) return;
        this.pressed.set(event.pointerId, event);
        if (this.holds === "plane") this.drag(before, event);
        if (this.holds !== "brush") return;
        if (this.waiting && distance(this.waiting, event) < finger_tremble) return;
        this.start_waiting();
        this.paint(event, false);
    }

    /// With two fingers the plane follows both.
    private drag(before: PointerEvent, event: PointerEvent) {
        const right = event.clientX - before.clientX, down = event.clientY - before.clientY;
        const other = [...this.pressed.values()].find(({ pointerId }) => pointerId !== event.pointerId);
        if (!other) return this.shift(right, down);
        this.scale(distance(event, other) / Math.max(distance(before, other), 1),
            (before.clientX + other.clientX) / 2, (before.clientY + other.clientY) / 2);
        this.shift(right / 2, down / 2);
    }

    private release(event: PointerEvent) {
        if (this.holds === "brush" && event.type === "pointerup") this.start_waiting();
        this.pressed.delete(event.pointerId);
        this.waiting = undefined;
        // The finger that stays of two paints nothing.
        if (this.pressed.size === 0) this.holds = "nothing";
    }

    private start_waiting() {
        if (this.waiting) this.paint(this.waiting, true);
        this.waiting = undefined;
    }
}
