// Shows why and where a run has failed, and offers to go back.
import type { Snapshot } from "./connection";
import { Mark } from "./mark";
import type { Pattern } from "./pattern";

/// The cell of the grid where the run failed, from the message. Undefined on models, because messages and planes number
/// the cells of models in different orders.
function cell_of({ failure, columns, slice }: Snapshot): number | undefined {
    const place = failure.match(/ column (\d+), row (\d+)/);
    return place ? Number(place[1]) + (slice?.sides[0] ?? columns) * Number(place[2]) : undefined;
}

export class Failure {
    private readonly box = document.getElementById("failure")!;
    private readonly back = this.box.querySelector("button")!;
    private readonly mark: Mark;
    private snapshot?: Snapshot;

    /// `ask` sends the request to undo the last change, or to go to the start of a stage.
    constructor(pattern: Pattern, ask: (what: string, fields?: Record<string, unknown>) => void) {
        this.mark = new Mark(pattern, "failed");
        this.back.addEventListener("click", () => {
            if (this.snapshot?.can_undo) ask("undo");
            else ask("go_to_stage", { stage: this.snapshot?.stage ?? 1 });
        });
    }

    show(snapshot: Snapshot) {
        this.snapshot = snapshot;
        this.box.hidden = !snapshot.failure;
        this.mark.cell = cell_of(snapshot);
        this.box.querySelector("span")!.textContent = snapshot.failure;
        this.back.textContent = snapshot.can_undo ? "undo the last change" : "start again";
        this.mark.show();
    }

    show_mark() { this.mark.show(); }
}
