// Turns strokes into expressions for the engine. Positions that are added while the engine is busy are painted
// together.
import type { Answer } from "./connection";
import type { Place } from "./pattern";

const most_places = 50;  ///< The largest number of positions in one expression.

/// A painted disc. On a model its radius is measured along the surface.
export interface Dab { item: string; value: string; place: Place; radius: number; is_model: boolean }

export class Stroke {
    private waiting: { dab: Dab; is_first: boolean }[] = [];
    private is_painting = false;

    constructor(private readonly ask: (fields: Record<string, unknown>) => Promise<Answer>) {}

    /// Adds a disc. If `is_first`, it begins a new stroke, which is undone separately.
    go_on(dab: Dab, is_first: boolean) {
        this.waiting.push({ dab, is_first });
        if (!this.is_painting) void this.paint();
    }

    private async paint() {
        this.is_painting = true;
        while (this.waiting.length > 0) {
            const [{ dab: { item, value, is_model, radius }, is_first }] = this.waiting;
            const end = this.waiting.findIndex(({ dab, is_first }, k) => k > 0 && (is_first || dab.value !== value || dab.radius !== radius));
            const places = this.waiting.splice(0, Math.min(end < 0 ? Infinity : end, most_places)).map(({ dab: { place: { x, y, z } } }) =>
                [x, y, ...(z === undefined ? [] : [z])].map((part) => part.toFixed(6)).join(", "));
            const size = radius.toFixed(6);
            const is_near = is_model ? `distance(${places.join(", ")}) < ${size}` : `${places.map((at) => `disc(${at}, ${size})`).join(" + ")} > 0`;
            const expression = item === "remove" ? is_near : `if(${is_near}, ${value}, ${item})`;
            await this.ask({ item, expression, joins_last: !is_first });
        }
        this.is_painting = false;
    }
}

interface Spot { clientX: number; clientY: number }

/// Adds positions between two events of a pointer, so close to each other that discs leave no gaps.
export class Trail {
    private last?: Spot;

    /// `frame` returns the element that the pattern fills.
    constructor(private readonly frame: () => HTMLElement) {}

    to(event: PointerEvent, is_first: boolean): Spot[] {
        const from = is_first || !this.last ? event : this.last, right = event.clientX - from.clientX, down = event.clientY - from.clientY;
        const { clientWidth, clientHeight } = this.frame(), gap = Math.max(1, 0.015 * Math.min(clientWidth, clientHeight));
        const count = Math.ceil(Math.hypot(right, down) / gap);
        this.last = { clientX: event.clientX, clientY: event.clientY };
        const between = Array.from({ length: Math.max(count - 1, 0) }, (_, k) =>
            ({ clientX: from.clientX + right * (k + 1) / count, clientY: from.clientY + down * (k + 1) / count }));
        return [...between, event];
    }
}
