// The plots: values in a cell and in the whole domain over time, and the distribution, spectrum and pairs of present
// values. The engine measures while the panel is open. The page stores the curves.
import type { Answer, Snapshot } from "./connection";
import { Mark } from "./mark";
import type { Pattern, Place } from "./pattern";
import { Plot, colour_of_curve, draw_density } from "./plots";
import { digits } from "./words";

interface Cost { seconds: number }  ///< The time that the engine spent on an answer.
interface Values extends Cost { t: number | null; stage: number; steps: number; species?: { name: string; mean: number; smallest: number; largest: number; value?: number | null }[] }
interface Measures extends Cost { histogram?: number[]; density?: number[]; x?: [number, number]; y?: [number, number]; spectrum?: number[]; ring_width?: number; wavelength?: number | null }
type Ask = <Reply>(what: string, fields: Record<string, unknown>) => Promise<Answer & Reply>;

/// One point of the curves. `at` is stage and step.
interface Moment { t: number; at: [number, number]; species: Values["species"] }

const most_moments = 4000;
const milliseconds_between_measures = 250;

export class Measure {
    private readonly panel = document.getElementById("measure") as HTMLDetailsElement;
    private readonly pick = document.getElementById("pick") as HTMLButtonElement;
    private readonly x = document.getElementById("of_x") as HTMLSelectElement;
    private readonly y = document.getElementById("of_y") as HTMLSelectElement;
    private readonly plots = { probe: this.plot("probe"), domain: this.plot("whole"), histogram: this.plot("histogram", true), spectrum: this.plot("spectrum") };
    private readonly probe: Mark;
    private moments: Moment[] = [];
    private is_asking = false;
    private next_values = 0;
    private next_measures = 0;
    private is_stale = false;
    private is_picking = false;  ///< Whether the button that chose a cell is still pressed.

    constructor(private readonly pattern: Pattern, private readonly ask: Ask) {
        this.probe = new Mark(pattern, "probe");
        this.panel.addEventListener("toggle", () => {
            this.show_mark();
            this.refresh();
        });
        for (const choice of [this.x, this.y]) choice.addEventListener("change", () => this.refresh());
    }

    private figure(id: string) { return document.getElementById(id)!; }
    private plot(id: string, is_histogram = false) { return new Plot(this.figure(id).querySelector("div")!, is_histogram); }
    /// Sets a caption. Names of curves have the colours of the curves.
    private title(id: string, text: string, curves: string[] = []) {
        this.figure(id).querySelector("figcaption")!.replaceChildren(text, ...curves.map((name, k) => {
            const part = Object.assign(document.createElement("span"), { textContent: ` ${name}` });
            part.style.color = colour_of_curve(k);
            return part;
        }));
    }

    toggle() { this.panel.open = !this.panel.open; }

    /// Lets the next click on the pattern choose a cell.
    wait_for_pick(is_waiting = this.pick.ariaPressed !== "true") {
        if (is_waiting) this.panel.open = true;
        this.pick.ariaPressed = String(is_waiting);
    }

    /// Returns whether a press on the pattern chooses a cell: a press with Alt, or the first press after a click on the
    /// button.
    takes({ altKey }: PointerEvent, place: Place | undefined, is_first: boolean): boolean {
        if (is_first) this.is_picking = altKey || this.pick.ariaPressed === "true";
        if (!this.is_picking || !place || !is_first) return this.is_picking;
        this.wait_for_pick(false);
        this.panel.open = true;
        const cell = this.pattern.cell_in_grid(place.cell);
        if (cell !== this.probe.cell) this.moments = [];
        this.probe.cell = cell;
        this.probe.show();
        this.refresh();
        return true;
    }

    set species(names: string[]) {
        for (const [choice, k] of [[this.x, 0], [this.y, 1]] as const) {
            if ([...choice.options].map(({ value }) => value).join() === names.join()) continue;
            choice.replaceChildren(...names.map((name) => new Option(name)));
            choice.selectedIndex = Math.min(k, names.length - 1);
            this.moments = [];
        }
    }

    show_mark() { this.probe.show(this.panel.open); }

    private refresh() {
        this.next_values = this.next_measures = 0;
        // A request that is under way may be about another cell.
        this.is_stale = this.is_asking;
        if (this.pattern.snapshot) void this.look_at(this.pattern.snapshot);
    }

    /// Called for every snapshot that is drawn. Therefore a page that draws slowly has fewer points
    /// in the curves.
    async look_at(snapshot: Snapshot) {
        if (!this.panel.open || this.is_asking || !this.x.value) return;
        this.is_asking = true;
        // At most a tenth of the run's time is spent on measuring.
        const after = ({ seconds }: Cost) => performance.now() + 9000 * seconds;
        const is_due = (moment: number) => !snapshot.is_going_on || performance.now() >= moment;
        if (is_due(this.next_values)) {
            const values = await this.ask<Values>("values", { cell: this.probe.cell ?? -1 });
            if (values.species) this.add(values);
            this.next_values = after(values);
        }
        if (is_due(this.next_measures)) {
            const measures = await this.ask<Measures>("measure", { x: this.x.value, y: this.y.value });
            if (measures.histogram) this.show(measures);
            this.next_measures = Math.max(after(measures), performance.now() + milliseconds_between_measures);
        }
        this.is_asking = false;
        if (this.is_stale) return this.refresh();
        // If the run has stopped meanwhile, the newest snapshot is measured, too.
        const now = this.pattern.snapshot;
        if (now && now !== snapshot && !now.is_going_on) void this.look_at(now);
    }

    private add({ t, stage, steps, species }: Values) {
        const at: [number, number] = [stage, steps];
        // Going back removes later points.
        this.moments = this.moments.filter((old) => old.at[0] < stage || (old.at[0] === stage && old.at[1] < steps));
        const last = this.moments.at(-1);
        this.moments.push({ t: t ?? (last ? last.t + 1 : 0), at, species });
        // Removes every second point of the older half.
        if (this.moments.length > most_moments) this.moments = this.moments.filter((_, k) => k % 2 === 0 || k > most_moments / 2);
        const ts = this.moments.map(({ t }) => t), names = species!.map(({ name }) => name);
        const of = (name: string, part: "mean" | "smallest" | "largest" | "value") =>
            this.moments.map(({ species }) => species!.find((each) => each.name === name)?.[part] ?? null);
        const is_probed = this.probe.cell !== undefined;
        this.figure("probe").hidden = !is_probed;
        if (is_probed) {
            const now = species!.map(({ name, value }) => `${name} ${typeof value === "number" ? digits(value) : "–"}`);
            this.title("probe", `${this.pattern.name_of(this.probe.cell!)}:`, now);
            this.plots.probe.show(names.map((name) => ({ name })), [ts, ...names.map((name) => of(name, "value"))]);
        }
        const x = this.x.value, now = species!.find(({ name }) => name === x);
        const parts = ["smallest", "mean", "largest"] as const;
        this.title("whole", `${x}:`, parts.map((part) => `${part === "mean" ? "mean " : ""}${now ? digits(now[part]) : "–"}`));
        this.plots.domain.show(parts.map((name) => ({ name })), [ts, ...parts.map((part) => of(x, part))]);
        this.figure("whole").dataset.moments = String(ts.length);
    }

    private show({ histogram, density, x, y, spectrum, ring_width, wavelength }: Measures) {
        const width = (x![1] - x![0]) / histogram!.length;
        this.title("histogram", `cells by ${this.x.value}`);
        this.plots.histogram.show([{ name: "cells" }], [histogram!.map((_, k) => x![0] + (k + 0.5) * width), histogram!]);
        this.figure("spectrum").hidden = !spectrum;
        if (spectrum) {
            // Rings after the last one that has at least a thousandth of the largest power are not
            // shown.
            const least = Math.max(...spectrum.slice(1)) / 1000, last = spectrum.findLastIndex((power, k) => k > 0 && power >= least);
            const powers = spectrum.slice(1, Math.max(last + 2, 9)), rings = powers.map((_, k) => (k + 1) * ring_width!);
            const is_wave = typeof wavelength === "number";
            this.title("spectrum", is_wave ? `${this.x.value}: wavelength ${digits(wavelength)}` : `spectrum of ${this.x.value}`);
            this.plots.spectrum.show([{ name: "power" }], [rings, powers], is_wave ? 1 / wavelength : undefined);
        }
        this.title("phase", `${this.y.value} over ${this.x.value}`);
        draw_density(this.figure("phase").querySelector("canvas")!, density!);
        this.figure("phase").title = `${this.x.value} from ${digits(x![0])} to ${digits(x![1])}, ${this.y.value} from ${digits(y![0])} to ${digits(y![1])}`;
    }
}
