// How values are shown: the range of the palette, contour lines and relief.
import type { Palette, Snapshot } from "./connection";
import { digits } from "./words";

export interface Look {
    low?: number;    ///< Held; else the smallest value that is shown.
    high?: number;
    every?: number;  ///< Contour lines at multiples of it.
    at?: number;     ///< A contour line at this value.
    relief: number;  ///< 0 … 1.
}

export const is_held = ({ low, high }: Look) => low !== undefined || high !== undefined;

export class LookControls {
    readonly look: Look = { relief: 0 };
    private readonly box = document.getElementById("legend")!;
    private readonly hold = this.input<HTMLButtonElement>("hold");
    private range: [number, number] = [0, 0];  ///< Of the values that are shown.

    constructor(private readonly changed: () => void) {
        for (const part of ["low", "high", "every", "at"] as const) {
            const input = this.input(part);
            input.addEventListener("change", () => {
                const value = input.value.trim() === "" ? NaN : Number(input.value);
                this.look[part] = Number.isFinite(value) && (part !== "every" || value > 0) ? value : undefined;
                input.classList.toggle("wrong", input.value.trim() !== "" && this.look[part] === undefined);
                this.update();
            });
        }
        const relief = this.input("relief");
        relief.addEventListener("input", () => {
            this.look.relief = relief.valueAsNumber;
            this.update();
        });
    }

    private input<T extends HTMLElement = HTMLInputElement>(id: string) { return document.getElementById(id) as T; }

    /// Holds the range as it is, or lets it follow the values again.
    toggle_hold() {
        const was_held = is_held(this.look);
        [this.look.low, this.look.high] = was_held ? [undefined, undefined] : this.range;
        this.input("low").value = was_held ? "" : digits(this.range[0]);
        this.input("high").value = was_held ? "" : digits(this.range[1]);
        this.update();
    }

    private update() {
        this.hold.ariaPressed = String(is_held(this.look));
        this.changed();
    }

    /// With what is drawn now, before this look is applied.
    show({ low, high, planes }: Snapshot) {
        this.box.toggleAttribute("data-is-colour", planes.length !== 1);
        this.range = [low, high];
        this.input("low").placeholder = digits(low);
        this.input("high").placeholder = digits(high);
    }

    show_palette({ stops }: Palette) {
        const colours = stops.map((stop) => `rgb(${stop.map((part) => Math.round(255 * part)).join(" ")})`);
        this.input("scale").style.background = `linear-gradient(to right, ${colours.join(", ")})`;
    }
}
