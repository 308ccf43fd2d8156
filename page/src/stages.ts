// The row of stages: the name, the progress and a small picture of each stage. The picture shows
// the last moment of the stage that the page has shown.
import type { Snapshot, Stage } from "./connection";

const milliseconds_between_pictures = 400;
const side = 40;  ///< The longest side of a small picture, in pixels of the page.

/// The numbers of cells, births and deaths of a stage, as text.
export function in_numbers({ count, births, deaths }: NonNullable<Stage["cells"]>) {
    return [[count, "cells"], [births, "births"], [deaths, "deaths"]].map(([number, what]) => `${number.toLocaleString("en")} ${what}`).join(", ");
}

export class Stages {
    private readonly list = document.getElementById("stages")!;
    private drawn_at = 0;
    private drawn = 0;  ///< The stage whose picture was drawn last.

    /// `go_to` is called with the number of a stage, from 1.
    constructor(private readonly go_to: (stage: number) => void) {}

    show({ stages, stage: current }: Snapshot) {
        const names = stages.map(({ name }) => name).join();
        if (this.list.dataset.names !== names) {
            this.list.dataset.names = names;
            this.list.replaceChildren(...stages.map((_, k) => this.make(k + 1)));
        }
        stages.forEach((stage, k) => {
            const go = this.list.children[k].firstElementChild as HTMLButtonElement;
            go.querySelector("span")!.textContent = stage.name;
            go.ariaCurrent = k + 1 === current ? "step" : null;
            go.title = stage.has_ended ? "ended" : `step ${stage.steps.toLocaleString("en")} of ${stage.iterations.toLocaleString("en")}`;
            if (stage.cells) go.title += `: ${in_numbers(stage.cells)}`;
            go.querySelector("progress")!.value = stage.has_ended ? 1
                : stage.duration > 0 ? stage.t / stage.duration : stage.steps / Math.max(stage.iterations, 1);
        });
    }

    private make(stage: number) {
        const item = document.createElement("li"), go = document.createElement("button"), picture = document.createElement("canvas");
        // Hidden from screen readers, so that the progress is not part of the button's name. The button's title
        // contains it.
        const progress = Object.assign(document.createElement("progress"), { ariaHidden: "true" });
        picture.hidden = true;
        go.append(picture, Object.assign(document.createElement("span"), { translate: false }), progress);
        go.addEventListener("click", () => this.go_to(stage));
        item.append(go);
        return item;
    }

    /// Stores a small picture of the present pattern, a few times a second and when the run stops.
    keep_picture({ stage, is_going_on }: Snapshot, pattern: HTMLCanvasElement) {
        const now = performance.now();
        const is_due = stage !== this.drawn || !is_going_on || now - this.drawn_at > milliseconds_between_pictures;
        const picture = this.list.children[stage - 1]?.querySelector("canvas");
        if (!picture || !is_due) return;
        this.drawn = stage;
        this.drawn_at = now;
        const scale = side * devicePixelRatio / Math.max(pattern.width, pattern.height);
        picture.width = Math.max(1, Math.round(pattern.width * scale));
        picture.height = Math.max(1, Math.round(pattern.height * scale));
        picture.getContext("2d")!.drawImage(pattern, 0, 0, picture.width, picture.height);
        picture.hidden = false;
    }
}
