// What a press on the pattern does: it writes a position, chooses a cell to measure, or paints.
import { half_width } from "./cells_in_space";
import type { Answer } from "./connection";
import type { Measure } from "./measure";
import type { Pattern } from "./pattern";
import type { Points } from "./points";
import { Stroke, Trail } from "./stroke";

interface Spot { clientX: number; clientY: number }

export class Brush {
    private readonly choice = document.getElementById("brush") as HTMLSelectElement;
    private readonly amount = document.getElementById("amount") as HTMLInputElement;
    private readonly trail = new Trail(() => this.pattern.seen.parentElement!);
    private readonly stroke: Stroke;

    /// `zoom` is the zoom of the visible view.
    constructor(private readonly pattern: Pattern, private readonly points: Points, private readonly measure: Measure,
        change: (what: string, fields: Record<string, unknown>) => Promise<Answer>, private readonly zoom: () => number) {
        this.stroke = new Stroke((fields) => change("paint", fields));
    }

    /// Sets the items that can be painted. Returns whether they have changed.
    offer(items: string[]): boolean {
        const { choice } = this;
        if ([...choice.options].map(({ value }) => value).join() === items.join()) return false;
        // The first item is chosen by default. If another one was chosen, it stays chosen.
        const chosen = choice.selectedIndex > 0 ? choice.value : "";
        choice.replaceChildren(...items.map((name) => new Option(name)));
        if (items.includes(chosen)) choice.value = chosen;
        return true;
    }

    press(event: PointerEvent, is_first: boolean) {
        if (this.points.takes(event, is_first)) return;
        for (const at of this.trail.to(event, is_first)) this.dab(event, at, is_first && at === event);
    }

    private dab(event: PointerEvent, at: Spot, is_first: boolean) {
        const { pattern, choice } = this, place = pattern.place(at);
        if (this.measure.takes(event, place, is_first) || !choice.value || !place || !pattern.snapshot) return;
        const item = choice.value, value = this.amount.value || `${event.shiftKey ? "min" : "max"}(${item} over domain)`;
        // The brush has the same size on the screen at every zoom, but it is never so small that it misses all cells.
        const { cells } = pattern.snapshot, is_model = pattern.snapshot.is_model && !cells, reach = 0.03 / this.zoom();
        const spacing = is_model ? pattern.solid.surface!.spacing : 1 / pattern.longest;
        const least = cells ? half_width(cells, place.cell) : (place.z === undefined || is_model ? 0.71 : 0.87) * spacing;
        this.stroke.go_on({ item, value, place, is_model, radius: Math.max(reach, least) }, is_first);
    }
}
