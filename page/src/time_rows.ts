// A grid of one row is shown with time running downwards: a row for each snapshot at another step.
import type { Snapshot } from "./connection";

/// The rows of such a picture: as many as a row has cells, within bounds.
export const rows_of_time = ({ columns }: Snapshot) => Math.min(Math.max(columns, 16), 512);

/// Is it of a grid of one row?
export const is_row = ({ rows, slice, cells }: Snapshot) => rows === 1 && !slice && !cells;

export class TimeRows {
    private seen: Snapshot[] = [];

    clear() { this.seen = []; }

    /// What to draw once this snapshot has come. Going back takes away what was later.
    with(snapshot: Snapshot): Snapshot {
        const { columns, stage, steps, planes } = snapshot, rows = rows_of_time(snapshot);
        this.seen = this.seen.filter((old) => old.columns === columns && old.planes.length === planes.length
            && (old.stage < stage || (old.stage === stage && old.steps < steps))).slice(1 - rows);
        this.seen.push(snapshot);
        return {
            ...snapshot, rows,
            low: Math.min(...this.seen.map(({ low }) => low)), high: Math.max(...this.seen.map(({ high }) => high)),
            planes: planes.map((_, k) => {
                const plane = new Float32Array(columns * rows).fill(NaN);
                this.seen.forEach((old, row) => plane.set(old.planes[k], columns * row));
                return plane;
            }),
        };
    }
}
