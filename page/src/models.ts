// Models from the user's files: they are sent to the engine in parts, and named in the domain of the text.
import { in_base64 } from "./base64";
import type { Answer } from "./connection";

const part = 1 << 19;  ///< The size of a part in bytes.
const usual_cells = 20000;

type Ask = <Reply>(what: string, fields: Record<string, unknown>) => Promise<Answer & Reply>;

/// Sends a model. Returns the name by which scripts read it, or undefined if it was refused. `tell` is called with the
/// fraction sent so far.
export async function send_model(file: File, ask: Ask, tell: (sent: number) => void): Promise<string | undefined> {
    for (let at = 0; at === 0 || at < file.size; at += part) {
        tell(at / Math.max(file.size, 1));
        const bytes = await in_base64(file.slice(at, at + part));
        const { is_done, name } = await ask<{ name?: string }>("load", { name: file.name, at, size: file.size, bytes });
        if (!is_done) return undefined;
        if (name) return name;
    }
}

/// A change of a text: the part from `from` to `to` is replaced by `text`.
export interface TextChange { from: number; to: number; text: string }

/// Replaces the domain of a script (a grid, a surface or another model) by this model.
export function with_model(script: string, name: string): TextChange {
    // Removes comments and strings, because brackets and names in them do not count.
    const plain = script.replace(/#.*|"[^"\n]*"/g, (part) => part.replace(/[^"]/g, " "));
    const model = `mesh: "${name}"`, block = /^[ \t]*domain\s*\{/m.exec(plain);
    if (!block) return { from: 0, to: 0, text: `domain { ${model}; cells: ${usual_cells} }\n` };
    const start = block.index + block[0].length, end = end_of(plain, start);
    const inside = plain.slice(start, end), cells = /(?:^|[;\s])cells\s*:/.test(inside) ? "" : `; cells: ${usual_cells}`;
    const old = /(?:^|[;\s])(mesh|surface|grid)\s*:/.exec(inside);
    if (!old) return { from: start, to: start, text: ` ${model}${cells}${inside === "" ? " " : inside.trim() === "" ? "" : ";"}` };
    const from = start + old.index + old[0].search(/[a-z]/);
    return { from, to: from + plain.slice(from, end_of(plain, from, /[;\n}]/)).trimEnd().length, text: model + cells };
}

/// The end of a statement or block: the first `sign` outside of brackets that are opened after `start`.
function end_of(text: string, start: number, sign = /\}/) {
    let depth = 0;
    for (let at = start; at < text.length; ++at) {
        if (depth === 0 && sign.test(text[at])) return at;
        if ("([{".includes(text[at])) ++depth;
        if (")]}".includes(text[at])) --depth;
    }
    return text.length;
}

/// Calls `take` for files that are dropped anywhere on the page. Scripts are dropped into the editor, which reads them
/// itself.
export function take_drops(take: (file: File) => void) {
    const has_files = ({ dataTransfer }: DragEvent) => dataTransfer?.types.includes("Files") === true;
    addEventListener("dragover", (event) => has_files(event) && event.preventDefault());
    addEventListener("drop", (event) => {
        const [file] = event.dataTransfer?.files ?? [];
        if (!file || file.name.endsWith(".cascade")) return;
        event.preventDefault();
        event.stopPropagation();
        take(file);
    }, { capture: true });
}
