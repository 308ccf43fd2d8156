// How fast the pattern grows: slowly enough to be watched, or as fast as the machine can. What is over goes on when
// it is touched.
import type { Answer, Snapshot, Stage } from "./connection";
import { is_row, rows_of_time } from "./time_rows";

const usual_seconds = 20;    ///< Of all stages, with the slider in its middle.
const longest_pause = 0.1;   ///< In seconds: steps that were due before are left out.
const very_fast = 1e12;      ///< In steps a second.

type Ask = (what: string, fields?: Record<string, unknown>) => Promise<Answer>;

const is_over = ({ stages }: Snapshot) => stages.every((stage) => stage.has_ended);

/// The steps that a stage takes, as far as is known.
const steps_of = ({ steps, iterations, t, duration }: Stage) => duration > 0 && t > 0 ? steps * duration / t : iterations;

export class Pace {
    private readonly slider = document.getElementById("speed") as HTMLInputElement;
    private seen?: Snapshot;
    private stages = "";
    private usual = 60;      ///< Steps a second, with the slider in its middle.
    private is_asking = false;  ///< The page asks for the steps of each frame itself.
    private is_wanted = false;  ///< Nobody has paused what grows, though it may have ended.
    private is_lengthened = false;   ///< The last stage will not be at its end any more.
    private goes_on_after?: number;  ///< This script, if the next one is not at its end.
    private asked = "";      ///< The moment from which steps were asked for last.
    private due = 0;         ///< Steps that are due now.
    private then = 0;

    constructor(private readonly ask: Ask) {
        this.slider.value = localStorage.getItem("speed") ?? "0";
        this.slider.addEventListener("input", () => {
            localStorage.setItem("speed", this.slider.value);
            if (!this.is_going_on) return;
            if (this.is_asking && this.is_unbounded) void this.start();
            else if (!this.is_asking) void this.ask("pause").then(() => this.begin_asking());
        });
    }

    get is_going_on() { return this.is_asking || this.seen?.is_going_on === true; }

    /// Is it a moment that is no row of time?
    get is_between_rows() { return this.is_asking && this.seen!.is_going_on && is_row(this.seen!); }

    /// Can more steps be taken, be it beyond the end?
    get is_possible() {
        const last = this.seen?.stages.at(-1);
        return last !== undefined && (!is_over(this.seen!) || last.duration > 0 || last.steps >= last.iterations);
    }

    /// 0 while it is unknown.
    get steps_per_second() { return Math.min(this.seen?.steps_per_second ?? 0, this.is_asking ? this.rate : very_fast); }

    see(snapshot: Snapshot) {
        const stages = snapshot.stages.map(({ name }) => name).join(), is_start = snapshot.stage === 1 && snapshot.steps === 0;
        if (stages !== this.stages || is_start) {
            this.stages = stages;
            this.usual = Math.max(1, snapshot.stages.reduce((sum, stage) => sum + steps_of(stage), 0) / usual_seconds);
        }
        this.seen = snapshot;
        if (is_over(snapshot) || snapshot.failure) this.is_asking = false;
        const is_new = this.goes_on_after !== undefined && this.goes_on_after !== snapshot.script;
        if (is_new) this.goes_on_after = undefined;
        if (is_over(snapshot) || !is_new && !this.is_lengthened) return;
        this.is_lengthened = false;
        void this.start();
    }

    /// Beyond the end of the last stage it goes on for as long again.
    async start() {
        if (!this.seen) return;
        this.is_wanted = true;
        if (is_over(this.seen)) {
            await this.lengthen(false);
        } else if (this.is_unbounded) {
            this.is_asking = false;
            await this.ask("run");
        } else {
            this.begin_asking();
        }
    }

    async stop() {
        this.forget();
        await this.ask("pause");
    }

    /// Nothing is wanted any more, such as after an undo, which pauses by itself.
    forget() {
        this.is_asking = this.is_wanted = this.is_lengthened = false;
        this.goes_on_after = undefined;
    }

    /// A number or the pattern was changed: what has ended by itself goes on.
    touch() { if (this.has_ended_by_itself) void this.lengthen(true); }

    /// Another text is sent: what has ended by itself goes on with the stages that it adds.
    async send(text: Promise<Answer>) {
        if (this.has_ended_by_itself) this.goes_on_after = this.seen!.script;
        if (!(await text).is_done) this.goes_on_after = undefined;
    }

    private get has_ended_by_itself() { return this.is_wanted && this.seen !== undefined && is_over(this.seen); }

    private async lengthen(joins_last: boolean) {
        this.is_lengthened = true;
        const { name, steps, t, duration } = this.seen!.stages.at(-1)!;
        const more = Math.ceil(this.usual * usual_seconds);
        const { is_done } = await this.ask("set", { joins_last, ...duration > 0
            ? { name: `${name}.duration`, expression: String(t + duration * Math.min(1, more / Math.max(steps, 1))) }
            : { name: `${name}.iterations`, expression: String(steps + more) } });
        if (!is_done) this.is_lengthened = false;
    }

    private get rate() { return this.slider.value === this.slider.max ? very_fast : this.usual * 2 ** this.slider.valueAsNumber; }

    /// Rows of time are the same number of steps apart, so the page always asks for them itself.
    private get is_unbounded() { return this.rate === very_fast && !is_row(this.seen!); }

    private begin_asking() {
        this.asked = "";
        this.due = 0;
        this.then = performance.now();
        if (this.is_asking) return;
        this.is_asking = true;
        this.tick();
    }

    private tick() {
        if (!this.is_asking) return;
        requestAnimationFrame(() => this.tick());
        const now = performance.now(), { stage, steps, stages, is_going_on } = this.seen!;
        this.due += Math.min((now - this.then) / 1000, longest_pause) * this.rate;
        this.then = now;
        const moment = `${stage} ${steps}`;
        // Rows of time are so far apart that a stage fills the picture.
        const least = is_row(this.seen!) ? Math.max(1, Math.ceil(stages[stage - 1].iterations / (rows_of_time(this.seen!) - 1))) : 1;
        if (is_going_on || moment === this.asked || this.due < least) return;
        const count = is_row(this.seen!) ? least : Math.floor(Math.min(this.due, longest_pause * this.rate + 1));
        this.due = Math.min(this.due - count, least);
        this.asked = moment;
        void this.ask("step", { count });
    }
}
