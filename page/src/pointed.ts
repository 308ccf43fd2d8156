// The cell under the pointer and its value, in words.
import type { Pattern } from "./pattern";
import { digits } from "./words";

export class Pointed {
    private readonly output = document.getElementById("pointed")!;
    private last?: PointerEvent;

    constructor(private readonly pattern: Pattern) {
        for (const canvas of [pattern.canvas, pattern.solid.canvas]) {
            canvas.addEventListener("pointermove", (event) => this.point(event));
            canvas.addEventListener("pointerleave", () => this.point());
        }
    }

    private point(event?: PointerEvent) {
        this.last = event;
        this.show();
    }

    /// Must be called again whenever values or the visible part change.
    show() {
        const { snapshot } = this.pattern, place = this.last && this.pattern.place(this.last);
        if (!place || !snapshot) {
            this.output.textContent = "";
            return;
        }
        const values = snapshot.planes.map((plane) => Number.isNaN(plane[place.cell]) ? "–" : digits(plane[place.cell]));
        this.output.textContent = `${this.pattern.name_of(this.pattern.cell_in_grid(place.cell))}: ${values.join(", ")}`;
    }
}
