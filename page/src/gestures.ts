// Pointers, fingers and the wheel on a view: they paint, or move the picture.

const finger_tremble = 8;    ///< In pixels. A finger that has moved less may be the first of two.

export type Held = "brush" | "plane" | "angle";

/// A movable picture on a canvas. Movements are in pixels of the page.
export interface View {
    /// What is moved with the left button or a finger: the brush, the picture or the angle of view.
    held_at(event: PointerEvent): Held;
    /// What is moved with the right button or two fingers.
    readonly held_by_two: Held;
    shift(right: number, down: number): void;
    turn(right: number, down: number): void;
    scale(factor: number, x: number, y: number): void;
}

function distance(one: PointerEvent, other: PointerEvent) {
    return Math.hypot(one.clientX - other.clientX, one.clientY - other.clientY);
}

export class Gestures {
    private readonly pressed = new Map<number, PointerEvent>();  ///< The last event of each pointer.
    private waiting?: PointerEvent;  ///< A finger's press that may become a stroke.
    private holds: Held | "nothing" = "nothing";

    /// `paint` is called for each position of a stroke. `is_first` is true for the first position.
    constructor(private readonly canvas: HTMLCanvasElement, private readonly view: View,
        private readonly paint: (event: PointerEvent, is_first: boolean) => void) {
        canvas.addEventListener("pointerdown", (event) => this.press(event));
        canvas.addEventListener("pointermove", (event) => this.move(event));
        for (const end of ["pointerup", "pointercancel"] as const) canvas.addEventListener(end, (event) => this.release(event));
        // Without this, the middle button would scroll.
        canvas.addEventListener("mousedown", (event) => event.button === 1 && event.preventDefault());
        canvas.addEventListener("contextmenu", (event) => view.held_by_two === "angle" && event.preventDefault());
        canvas.parentElement!.addEventListener("wheel", (event) => {
            if (canvas.hidden) return;
            event.preventDefault();
            const lines = event.deltaMode === WheelEvent.DOM_DELTA_PIXEL ? 1 : 30;
            // Browsers report a pinch on a touchpad as a wheel with Ctrl, in small steps.
            view.scale(Math.exp(-event.deltaY * lines * (event.ctrlKey ? 0.01 : 0.002)), event.clientX, event.clientY);
        }, { passive: false });
    }

    private press(event: PointerEvent) {
        this.canvas.setPointerCapture(event.pointerId);
        this.pressed.set(event.pointerId, event);
        this.waiting = undefined;
        if (this.pressed.size > 1) this.holds = this.view.held_by_two;
        else if (event.button === 1 || event.ctrlKey || event.metaKey) this.holds = "plane";
        else if (event.button === 2) this.holds = this.view.held_by_two === "angle" ? "angle" : "nothing";
        else if (event.button === 0) this.holds = this.view.held_at(event);
        if (this.holds !== "brush") return;
        if (event.pointerType === "touch") this.waiting = event;
        else this.paint(event, true);
    }

    private move(event: PointerEvent) {
        const before = this.pressed.get(event.pointerId);
        if (!before) return;
        this.pressed.set(event.pointerId, event);
        if (this.holds === "plane" || this.holds === "angle") this.drag(before, event);
        if (this.holds !== "brush") return;
        if (this.waiting && distance(this.waiting, event) < finger_tremble) return;
        this.start_waiting();
        this.paint(event, false);
    }

    /// Moves the view. If there are two fingers, the view follows both.
    private drag(before: PointerEvent, event: PointerEvent) {
        const right = event.clientX - before.clientX, down = event.clientY - before.clientY;
        const other = [...this.pressed.values()].find(({ pointerId }) => pointerId !== event.pointerId);
        const follow = (part: number) => this.holds === "angle" ? this.view.turn(part * right, part * down) : this.view.shift(part * right, part * down);
        if (!other) return follow(1);
        this.view.scale(distance(event, other) / Math.max(distance(before, other), 1),
            (before.clientX + other.clientX) / 2, (before.clientY + other.clientY) / 2);
        follow(0.5);
    }

    private release(event: PointerEvent) {
        if (this.holds === "brush" && event.type === "pointerup") this.start_waiting();
        this.pressed.delete(event.pointerId);
        this.waiting = undefined;
        // When one of two fingers is lifted, the other does not paint.
        if (this.pressed.size === 0) this.holds = "nothing";
    }

    private start_waiting() {
        if (this.waiting) this.paint(this.waiting, true);
        this.waiting = undefined;
    }
}
