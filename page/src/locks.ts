// The locked parts of an exercise. They are marked in the text, and a change by the user that touches one of them is
// refused.
import { EditorState, type Extension, type Range, StateField } from "@codemirror/state";
import { Decoration, type DecorationSet, EditorView, WidgetType } from "@codemirror/view";
import { locked_parts, touches } from "./exercise";

/// An ellipsis in place of the data of a picture.
class Ellipsis extends WidgetType {
    toDOM() { return Object.assign(document.createElement("span"), { textContent: "…" }); }
}

const longest_shown = 40;  ///< The longest data that are shown in a line.

function marks_of(state: EditorState): DecorationSet {
    const text = state.doc.toString(), marks: Range<Decoration>[] = [];
    for (const [from, to] of locked_parts(text)) {
        for (let at = from; at <= to;) {
            const line = state.doc.lineAt(at), data = /data:[^\s]+/.exec(line.text);
            marks.push(Decoration.line({ class: "cm-locked" }).range(line.from));
            if (data && data[0].length > longest_shown) {
                marks.push(Decoration.replace({ widget: new Ellipsis() }).range(line.from + data.index + longest_shown, line.from + data.index + data[0].length));
            }
            at = line.to + 1;
        }
    }
    return Decoration.set(marks);
}

/// `refuse` is called when a change is refused.
export function locks(refuse: () => void): Extension {
    return [
        EditorState.transactionFilter.of((transaction) => {
            if (!transaction.docChanged) return transaction;
            const parts = locked_parts(transaction.startState.doc.toString());
            let is_free = true;
            transaction.changes.iterChanges((from, to) => (is_free &&= !touches(parts, from, to)));
            if (is_free) return transaction;
            refuse();
            return [];
        }),
        StateField.define<DecorationSet>({
            create: marks_of,
            update: (marks, { docChanged, state }) => docChanged ? marks_of(state) : marks,
            provide: (field) => EditorView.decorations.from(field),
        }),
        EditorView.theme({ ".cm-locked": { background: "color-mix(in srgb, var(--faint) 14%, transparent)" } }),
    ];
}
