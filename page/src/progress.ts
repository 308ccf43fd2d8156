// The text beside the buttons of the run: the step, the speed, or "paused".
import type { Snapshot } from "./connection";
import type { Pace } from "./pace";
import { in_numbers } from "./stages";

const compact = new Intl.NumberFormat("en", { notation: "compact", maximumSignificantDigits: 2 });
const milliseconds_of_rest = 500;  ///< If no step is taken for this time, the run counts as paused.

export class Progress {
    private readonly place = document.getElementById("place")!;
    private readonly paused = document.getElementById("paused")!;
    private timer = 0;
    private seen = "";

    constructor(private readonly pace: Pace) {}

    show({ stage, steps, stages, failure }: Snapshot) {
        const { is_going_on, steps_per_second } = this.pace, { cells } = stages[stage - 1];
        const crawling = cells ? ` · ${cells.count.toLocaleString("en")} cells` : "";
        const rate = is_going_on && steps_per_second > 0 ? ` · ${compact.format(steps_per_second)} steps/s` : "";
        this.place.textContent = `step ${steps.toLocaleString("en")}${crawling}${rate}`;
        this.place.title = cells ? in_numbers(cells) : "";
        const is_at_rest = !is_going_on && !failure && !stages.every((each) => each.has_ended), moment = `${is_at_rest} ${stage} ${steps}`;
        if (moment === this.seen) return;
        this.seen = moment;
        clearTimeout(this.timer);
        this.paused.textContent = "";
        if (is_at_rest) this.timer = window.setTimeout(() => (this.paused.textContent = "paused"), milliseconds_of_rest);
    }
}
