// The controls for the slice of a volume: an axis, and a position along it.
import type { Snapshot } from "./connection";

const axes = ["x", "y", "z"];

export class Slices {
    private readonly box = document.getElementById("slice")!;
    private readonly axis = this.box.querySelector("select")!;
    private readonly number = this.box.querySelector("input")!;
    private sides: number[] = [];
    private wanted = "";  ///< The last requested slice.
    private is_asking = false;

    /// `ask` requests an axis and a position, 0 … 1. Its promise is fulfilled when snapshots show this slice.
    constructor(private readonly ask: (fields: { axis: string; place: number }) => Promise<unknown>) {
        this.axis.addEventListener("change", () => {
            this.number.max = String(this.count - 1);
            this.number.valueAsNumber = Math.floor(this.count / 2);
            void this.choose();
        });
        this.number.addEventListener("input", () => void this.choose());
    }

    /// Sets the controls to the slice that is shown, except controls in use.
    show({ slice }: Snapshot) {
        this.box.hidden = !slice;
        if (!slice) return;
        this.sides = slice.sides;
        if (this.is_asking) return;
        this.axis.value = slice.axis;
        this.number.max = String(this.count - 1);
        this.number.value = String(slice.number);
        this.number.title = `slice ${slice.number + 1} of ${this.count}`;
    }

    /// Moves the slice by this number of slices.
    move(count: number) {
        if (this.box.hidden) return;
        this.number.valueAsNumber += count;
        void this.choose();
    }

    private get count() { return this.sides[axes.indexOf(this.axis.value)]; }

    /// Requests one slice after the other. If several are chosen quickly, only the last is requested.
    private async choose() {
        const fields = () => ({ axis: this.axis.value, place: (this.number.valueAsNumber + 0.5) / this.count });
        this.wanted = JSON.stringify(fields());
        if (this.is_asking) return;
        this.is_asking = true;
        for (let asked = ""; asked !== this.wanted;) {
            asked = this.wanted;
            await this.ask(JSON.parse(asked));
        }
        this.is_asking = false;
    }
}
