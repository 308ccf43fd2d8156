// The picture of a grid of one row. Time runs downwards: there is a row for each snapshot of a different step.
import type { Snapshot } from "./connection";

/// The number of rows of the picture: the number of cells, but at least 16 and at most 512.
export const rows_of_time = ({ columns }: Snapshot) => Math.min(Math.max(columns, 16), 512);

/// Whether this snapshot is of a grid of one row.
export const is_row = ({ rows, slice, cells }: Snapshot) => rows === 1 && !slice && !cells;

export class TimeRows {
    private seen: Snapshot[] = [];

    clear() { this.seen = []; }

    /// Adds a snapshot and returns the picture of all rows. Going back removes later rows.
    with(snapshot: Snapshot): Snapshot {
        const { columns, stage, steps, planes, repeats } = snapshot, rows = rows_of_time(snapshot);
        this.seen = this.seen.filter((old) => old.columns === columns && old.planes.length === planes.length
            && (old.stage < stage || (old.stage === stage && old.steps < steps))).slice(1 - rows);
        this.seen.push(snapshot);
        return {
            ...snapshot, rows, repeats: [repeats[0], false],
            low: Math.min(...this.seen.map(({ low }) => low)), high: Math.max(...this.seen.map(({ high }) => high)),
            planes: planes.map((_, k) => {
                const plane = new Float32Array(columns * rows).fill(NaN);
                this.seen.forEach((old, row) => plane.set(old.planes[k], columns * row));
                return plane;
            }),
        };
    }
}
