// How fast the pattern grows: slowly enough to watch, or as fast as the machine can compute. A pattern that has ended
// continues after a change.
import type { Answer, Snapshot, Stage } from "./connection";
import { is_row, rows_of_time } from "./time_rows";

const usual_seconds = 20;  ///< The duration of all stages if the slider is in the middle.
/// In seconds. After a longer pause, steps that were due are left out.
const longest_pause = 0.1;
const very_fast = 1e12;      ///< In steps a second. It stands for as fast as possible.

type Ask = (what: string, fields?: Record<string, unknown>) => Promise<Answer>;

const is_over = ({ stages }: Snapshot) => stages.every((stage) => stage.has_ended);

/// The number of steps of a stage. It is estimated if the stage ends by its duration.
const steps_of = ({ steps, iterations, t, duration }: Stage) => duration > 0 && t > 0 ? steps * duration / t : iterations;

export class Pace {
    private readonly slider = document.getElementById("speed") as HTMLInputElement;
    private seen?: Snapshot;
    private stages = "";
    private usual = 60;  ///< Steps a second if the slider is in the middle.
    private is_asking = false;  ///< Whether the page requests the steps for each frame.
    private is_starting = false;  ///< Whether the run has been started, but no snapshot shows this yet.
    private is_wanted = false;  ///< Whether the pattern was not paused. It may have ended.
    /// Whether a number or the pattern was changed after the last snapshot.
    private is_changed = false;
    private is_lengthened = false;   ///< Whether the last stage is being lengthened.
    /// If set, the run continues when a script with another number has stages left.
    private goes_on_after?: number;
    private asked = "";      ///< The stage and step of the last request for steps.
    private due = 0;         ///< The number of steps that are due.
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

    get is_going_on() { return this.is_asking || this.is_starting || this.seen?.is_going_on === true; }

    /// Whether the present moment is between two rows of the picture of a one-row grid.
    get is_between_rows() { return this.is_asking && this.seen!.is_going_on && is_row(this.seen!); }

    /// Whether more steps can be taken, possibly after lengthening the last stage.
    get is_possible() {
        const last = this.seen?.stages.at(-1);
        return last !== undefined && (!is_over(this.seen!) || last.duration > 0 || last.steps >= last.iterations);
    }

    /// The steps taken in a second, or 0 if unknown.
    get steps_per_second() { return Math.min(this.seen?.steps_per_second ?? 0, this.is_asking ? this.rate : very_fast); }

    see(snapshot: Snapshot) {
        const stages = snapshot.stages.map(({ name }) => name).join(), is_start = snapshot.stage === 1 && snapshot.steps === 0;
        if (stages !== this.stages || is_start) {
            this.stages = stages;
            this.usual = Math.max(1, snapshot.stages.reduce((sum, stage) => sum + steps_of(stage), 0) / usual_seconds);
        }
        this.seen = snapshot;
        if (is_over(snapshot) || snapshot.failure) this.is_asking = false;
        if (is_over(snapshot) || snapshot.failure || snapshot.is_going_on) this.is_starting = false;
        const is_new = this.goes_on_after !== undefined && this.goes_on_after !== snapshot.script;
        if (is_new) this.goes_on_after = undefined;
        const was_changed = this.is_changed;
        this.is_changed = false;
        if (was_changed && this.has_ended_by_itself) return void this.lengthen(true);
        if (is_over(snapshot) || !(is_new && !this.is_going_on) && !this.is_lengthened) return;
        this.is_lengthened = false;
        void this.start();
    }

    /// Continues the run. After the end of the last stage, this stage is lengthened.
    async start() {
        if (!this.seen) return;
        this.is_wanted = true;
        if (is_over(this.seen)) {
            await this.lengthen(false);
        } else if (this.is_unbounded) {
            this.is_asking = false;
            this.is_starting = true;
            await this.ask("run");
        } else {
            this.begin_asking();
        }
    }

    async stop() {
        this.forget();
        await this.ask("pause");
    }

    /// Forgets that the pattern should grow, for example after an undo, which pauses the session.
    forget() {
        this.is_asking = this.is_starting = this.is_wanted = this.is_lengthened = this.is_changed = false;
        this.goes_on_after = undefined;
    }

    /// Called after a change of a number or the pattern. A pattern that has ended by itself
    /// continues. The next snapshot may be the first to show the end.
    touch() {
        this.is_changed = this.is_wanted && this.is_going_on;
        if (this.has_ended_by_itself) void this.lengthen(true);
    }

    /// Called with a new text. A pattern that has ended by itself continues with the stages that
    /// the text adds. The run may have ended before the page has seen it.
    async send(text: Promise<Answer>) {
        if (this.has_ended_by_itself || this.is_wanted && this.is_going_on) this.goes_on_after = this.seen!.script;
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

    /// For a one-row grid the page always requests steps itself, since rows of the picture are equally many steps
    /// apart.
    private get is_unbounded() { return this.rate === very_fast && !is_row(this.seen!); }

    private begin_asking() {
        this.asked = "";
        this.due = 0;
        this.then = performance.now();
        this.is_starting = false;
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
        // The number of steps between rows of the picture of a one-row grid. It is chosen so that a stage fills the
        // picture.
        const least = is_row(this.seen!) ? Math.max(1, Math.ceil(stages[stage - 1].iterations / (rows_of_time(this.seen!) - 1))) : 1;
        if (is_going_on || moment === this.asked || this.due < least) return;
        const count = is_row(this.seen!) ? least : Math.floor(Math.min(this.due, longest_pause * this.rate + 1));
        this.due = Math.min(this.due - count, least);
        this.asked = moment;
        void this.ask("step", { count });
    }
}
