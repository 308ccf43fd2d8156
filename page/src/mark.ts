// A ring around a cell of the pattern.
import type { Pattern } from "./pattern";

export class Mark {
    private readonly ring = document.createElement("span");
    cell?: number;  ///< The marked cell of the grid.

    constructor(private readonly pattern: Pattern, name: string) {
        this.ring.className = `mark ${name}`;
        pattern.canvas.parentElement!.append(this.ring);
        this.show();
    }

    /// Must be called again whenever the visible part changes.
    show(is_wanted = true) {
        const box = this.cell === undefined || !is_wanted ? undefined : this.pattern.box_of_cell(this.cell);
        this.ring.hidden = !box;
        if (!box) return;
        const frame = this.pattern.canvas.parentElement!.getBoundingClientRect();
        const size = Math.max(box.width, 14);
        Object.assign(this.ring.style, {
            width: `${size}px`, height: `${size}px`,
            left: `${box.x + box.width / 2 - frame.x - size / 2}px`, top: `${box.y + box.height / 2 - frame.y - size / 2}px`,
        });
    }
}
