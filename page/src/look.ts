// The settings for showing values: the range of the palette, contour lines and relief.
import type { Palette, Snapshot } from "./connection";
import { digits } from "./words";

export interface Look {
    low?: number;  ///< The fixed lower end of the range. If undefined, the smallest visible value is used.
    high?: number;
    every?: number;  ///< The difference between the values of adjacent contour lines.
    at?: number;  ///< The value of a single contour line.
    relief: number;  ///< The strength of the relief, 0 … 1.
    squares: boolean;  ///< Whether cells of planes are squares at every zoom.
}

export const is_held = ({ low, high }: Look) => low !== undefined || high !== undefined;

export class LookControls {
    readonly look: Look = { relief: 0, squares: localStorage.getItem("squares") === "1" };
    private readonly box = document.getElementById("legend")!;
    private readonly hold = this.input<HTMLButtonElement>("hold");
    private range: [number, number] = [0, 0];  ///< The range of the values that are shown.

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
        const squares = this.input("squares");
        squares.checked = this.look.squares;
        squares.addEventListener("change", () => {
            this.look.squares = squares.checked;
            localStorage.setItem("squares", squares.checked ? "1" : "0");
            this.update();
        });
    }

    private input<T extends HTMLElement = HTMLInputElement>(id: string) { return document.getElementById(id) as T; }

    /// Fixes the present range, or makes it follow the values again.
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

    /// Shows the range of a snapshot, before a fixed range is applied.
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
