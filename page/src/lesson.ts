// The exercise of the script: its task, its goals and whether the pattern meets them.
import type { Answer, Snapshot } from "./connection";
import { type Exercise, type Goal, exercise_of, text_in } from "./exercise";
import beside from "./library.json";
import { digits } from "./words";

type Ask = <Reply>(what: string, fields: Record<string, unknown>) => Promise<Answer & Reply>;
interface Features { features?: Record<string, number>; seconds: number }

const milliseconds_between_looks = 500;
const share_of_run = 0.1;  ///< The largest fraction of the run's time that is spent on measuring.

function in_words({ feature, low, high }: Goal) {
    return low === -Infinity ? `${feature} below ${digits(high)}` : high === Infinity ? `${feature} above ${digits(low)}` : `${feature} from ${digits(low)} to ${digits(high)}`;
}

/// The picture with this name: a picture of the library or of an example, or one that the script contains.
function picture_of(target: string): string {
    if (/^data:image\/(png|webp|jpeg);base64,[\w+/=]+$/.test(target)) return target;
    const systems: Record<string, string> = beside.systems;
    const found = Object.hasOwn(systems, target) ? systems[target] : beside.examples.find(({ name }) => name === target)?.picture;
    return found ? `data:image/webp;base64,${found}` : "";
}

export class Lesson {
    private readonly box = document.getElementById("lesson")!;
    private readonly goals = this.box.querySelector("ul")!;
    private readonly hint = this.box.querySelector("details")!;
    private readonly verdict = this.box.querySelector("[role=status]")!;
    private exercise?: Exercise;
    private read = "";
    private next_look = 0;
    private looked_at = "";
    private is_asking = false;
    private timer = 0;
    private last?: Snapshot;

    /// `shown` is the expression that the user has chosen to see, instead of the script's.
    constructor(private readonly ask: Ask, private readonly shown: () => string) {
        new MutationObserver(() => this.write()).observe(document.documentElement, { attributeFilter: ["lang"] });
    }

    /// Sets the script that is run now.
    set script(text: string) {
        if (text === this.read) return;
        this.read = text;
        this.looked_at = "";
        const before = JSON.stringify(this.exercise);
        this.exercise = exercise_of(text);
        if (JSON.stringify(this.exercise) === before) return;
        this.hint.open = false;
        this.write();
    }

    private write() {
        const { exercise, box } = this;
        box.hidden = !exercise;
        if (!exercise) return;
        const language = document.documentElement.lang, [title, task] = box.querySelectorAll<HTMLElement>("h2, h2 + p");
        title.textContent = text_in(exercise.title, language);
        task.textContent = text_in(exercise.task, language);
        const hint = text_in(exercise.hint, language);
        this.hint.hidden = hint === "";
        this.hint.querySelector("p")!.textContent = hint;
        const picture = box.querySelector("img")!, source = picture_of(exercise.target);
        picture.hidden = source === "";
        if (source) picture.src = source;
        this.goals.replaceChildren(...exercise.goals.map((goal) => {
            const item = document.createElement("li");
            item.append(...["i", "span", "small"].map((tag) => document.createElement(tag)));
            item.children[1].textContent = in_words(goal);
            return item;
        }), ...exercise.wrong.map((text) => Object.assign(document.createElement("li"), { className: "wrong", textContent: `goal: ${text}` })));
        this.verdict.textContent = "";
        this.looked_at = "";
        if (this.last) this.look_at(this.last);
    }

    /// Measures the visible pattern, but not so often that the run becomes slow.
    look_at(snapshot: Snapshot) {
        this.last = snapshot;
        if (!this.exercise || this.exercise.goals.length === 0 || this.is_asking) return;
        const moment = `${snapshot.number} ${this.shown()}`, wait = this.next_look - performance.now();
        if (moment === this.looked_at) return;
        clearTimeout(this.timer);
        // The last moment is measured, too, even if no other moment follows it.
        if (wait > 0) return void (this.timer = window.setTimeout(() => this.look_at(snapshot), wait));
        this.looked_at = moment;
        void this.measure(snapshot);
    }

    private async measure(snapshot: Snapshot) {
        this.is_asking = true;
        await this.judge(snapshot);
        this.is_asking = false;
        // A newer moment may have arrived meanwhile.
        if (this.last) this.look_at(this.last);
    }

    private async judge({ stages }: Snapshot) {
        const { exercise } = this, { features = {}, seconds } = await this.ask<Features>("features", { show: this.shown() });
        this.next_look = performance.now() + Math.max(milliseconds_between_looks, 1000 * (seconds ?? 0) / share_of_run);
        if (exercise !== this.exercise || !exercise) return;
        const are_met = exercise.goals.map(({ feature, low, high }, k) => {
            const value = features[feature], is_met = value >= low && value <= high, [sign, , now] = this.goals.children[k].children as HTMLCollectionOf<HTMLElement>;
            sign.textContent = is_met ? "✓" : "○";
            sign.title = is_met ? "met" : "not met";
            this.goals.children[k].toggleAttribute("data-met", is_met);
            now.textContent = value === undefined ? "" : `now ${digits(value)}`;
            return is_met;
        });
        const all = are_met.length > 0 && exercise.wrong.length === 0 && are_met.every(Boolean), is_over = stages.every((stage) => stage.has_ended);
        this.box.toggleAttribute("data-met", all && is_over);
        this.verdict.textContent = !all ? "" : is_over ? "All goals are met. Well done!" : "The goals hold now; they count at the end of the last stage.";
    }
}
