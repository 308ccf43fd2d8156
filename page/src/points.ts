// Writes positions and directions into the text. A click on the pattern writes a position at the caret. A drag writes a
// position and a direction. Their form is the one that the call around the caret expects.
import { add, dot } from "./camera";
import type { Editor } from "./editor";
import type { Pattern } from "./pattern";

const shortest_drag = 6;  ///< In pixels of the page. A shorter drag is a click.
const least_slope = 0.2;  ///< The least slope of a surface that is seen almost from its side.

const decimals = (numbers: number[]) => numbers.map((number) => String(Number(number.toFixed(3)))).join(", ");

/// The calls that contain the end of a text, from the innermost outwards, and the word before the statement's ':'.
export function calls_around(text: string): { calls: string[]; statement: string } {
    const calls: string[] = [];
    let statement = "", word = "";
    for (const [sign] of text.replace(/#.*|"[^"\n]*"?/g, "").matchAll(/\w+|\S|\n/g)) {
        if (sign === "(" || sign === "[") calls.unshift(word);
        else if (sign === ")" || sign === "]") calls.shift();
        else if (sign === "{" || sign === "}") calls.length = 0;
        if (calls.length === 0 && sign === ":") statement = word;
        else if (calls.length === 0 && "{};\n".includes(sign)) statement = "";
        if (sign !== "\n") word = /\w/.test(sign) ? sign : "";
    }
    return { calls, statement };
}

/// The text that is written at the caret, and the part of it that the next key replaces.
export function text_of_point(before: string, after: string, place: number[], direction: number[] | undefined, is_model: boolean) {
    const { calls, statement } = calls_around(before), [call, outer] = calls;
    const upwards = place.length === 3 ? [0, 1, 0] : [0, -1];
    const at = decimals(place), along = decimals(direction ?? upwards);
    let written = at, is_value = false;
    if (call === "vector" || call === "axis") written = along;
    else if (call === "keys" && outer === "along") written = `${at}, ${along}`;
    else if (call === "keys" && statement !== "founders") {
        written = `${at}, 1`;
        is_value = true;
    } else if (!call && is_model) written = direction ? `along(keys(${at}, ${along}))` : `distance(${at})`;
    const last = before.trimEnd().at(-1), next = after.trimStart()[0];
    const comma = call && last && !"(,[".includes(last) ? ", " : call && last === "," && !/\s$/.test(before) ? " " : "";
    const text = comma + written + (call && next && !"),]".includes(next) ? ", " : "");
    const end = comma.length + written.length;
    return { text, from: is_value ? end - 1 : end, to: end };
}

export class Points {
    private readonly button = document.getElementById("point") as HTMLButtonElement;
    private readonly line = document.getElementById("drag")!.querySelector("line")!;
    private start?: PointerEvent;

    /// `tell` is called with the reason if nothing is written.
    constructor(private readonly pattern: Pattern, private readonly editor: Editor, private readonly tell: (why: string) => void) {
        // The canvases receive the event before this object. If a finger is lifted at once, the
        // canvases report its press only then.
        addEventListener("pointerup", (event) => this.end(event));
        addEventListener("pointercancel", () => this.stop());
        addEventListener("pointermove", (event) => this.start && this.show(event));
        addEventListener("keydown", ({ key }) => key === "Escape" && this.is_waiting && this.toggle());
    }

    private get is_waiting() { return this.button.ariaPressed === "true"; }

    toggle() {
        this.stop();
        this.button.ariaPressed = String(!this.is_waiting);
        document.getElementById("frame")!.toggleAttribute("data-points", this.is_waiting);
    }

    /// Takes presses on the pattern while positions are to be written.
    takes(event: PointerEvent, is_first: boolean): boolean {
        if (!this.is_waiting) return false;
        if (is_first) this.start = event;
        return true;
    }

    private stop() {
        this.start = undefined;
        this.line.parentElement!.toggleAttribute("data-drawn", false);
    }

    private show({ clientX, clientY }: PointerEvent) {
        const frame = this.line.parentElement!.parentElement!.getBoundingClientRect(), { start } = this;
        const ends = { x1: start!.clientX - frame.x, y1: start!.clientY - frame.y, x2: clientX - frame.x, y2: clientY - frame.y };
        for (const [name, value] of Object.entries(ends)) this.line.setAttribute(name, String(value));
        this.line.parentElement!.toggleAttribute("data-drawn", true);
    }

    private end(event: PointerEvent) {
        const { start, pattern, editor } = this;
        if (!start || event.pointerId !== start.pointerId) return;
        this.stop();
        const place = pattern.place(start);
        if (!place) return;
        if (!editor.was_entered) return this.tell("Put the caret into the text, where the position belongs.");
        const at = [place.x, place.y, ...(place.z === undefined ? [] : [place.z])];
        const is_drag = Math.hypot(event.clientX - start.clientX, event.clientY - start.clientY) >= shortest_drag;
        const direction = is_drag ? this.direction(start, event, at) : undefined;
        editor.write((before, after) => text_of_point(before, after, at, direction, pattern.snapshot!.is_model));
    }

    /// The direction of a drag, of length 1, in coordinates of scripts. If there is a surface, it is along the surface.
    private direction(start: PointerEvent, end: PointerEvent, at: number[]): number[] | undefined {
        const { pattern } = this, right = end.clientX - start.clientX, down = end.clientY - start.clientY;
        const normal = at.length === 3 && pattern.is_solid ? pattern.solid.normal(start) : undefined;
        let found: number[];
        if (normal) {
            const { camera } = pattern.solid, seen = add(add([0, 0, 0], camera.right, right), camera.up, -down);
            const slope = dot(normal, camera.backward), along = add(seen, camera.backward, -dot(normal, seen) / Math.max(Math.abs(slope), least_slope) * Math.sign(slope || 1));
            found = pattern.snapshot!.cells?.is_flat ? [along[0], along[2], along[1]] : along;
        } else {
            const to = pattern.place(end);
            if (!to) return undefined;
            found = [to.x - at[0], to.y - at[1], ...(at.length === 3 ? [to.z! - at[2]] : [])];
        }
        const length = Math.hypot(...found);
        return length > 0 ? found.map((part) => part / length) : undefined;
    }
}
