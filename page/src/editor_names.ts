// Names in the text. All uses of the name at the cursor are marked, Ctrl with a click or F12 goes to its declaration, and
// F2 renames it. The engine finds the names.
import { type EditorState, StateEffect, StateField, type Text } from "@codemirror/state";
import { Decoration, type DecorationSet, EditorView, type Tooltip, ViewPlugin, type ViewUpdate, keymap, showTooltip } from "@codemirror/view";
import type { Answer, Message } from "./connection";

type Place = [line: number, column: number];
interface Part { from: Place; to: Place }
export interface NameUses { name?: string; declaration?: Part | { source: string } | null; uses?: Part[] }

export interface NameService {
    uses(text: string, byte: number): Promise<NameUses>;
    rename(text: string, byte: number, name: string): Promise<Answer & { text?: string }>;
    tell(why: string | Message): void;
}

const milliseconds_of_rest = 250;
/// In UTF-16 units. Uses are not marked in longer texts, because checking these takes long.
const longest = 1 << 16;

const offset = (doc: Text, [line, column]: Place) => doc.line(line).from + column;
const asked_at = (state: EditorState, at: number): [string, number] => [state.sliceDoc(), new TextEncoder().encode(state.sliceDoc(0, at)).length];

const mark_uses = StateEffect.define<Part[]>();
const used = Decoration.mark({ class: "cm-used" });
const marks = StateField.define<DecorationSet>({
    create: () => Decoration.none,
    update(shown, { docChanged, effects, state }) {
        const found = effects.find((effect) => effect.is(mark_uses));
        if (found) return Decoration.set(found.value.map(({ from, to }) => used.range(offset(state.doc, from), offset(state.doc, to))), true);
        return docChanged ? Decoration.none : shown;
    },
    provide: (field) => EditorView.decorations.from(field),
});

const ask_name = StateEffect.define<Tooltip | null>();
const question = StateField.define<Tooltip | null>({
    create: () => null,
    update(shown, { docChanged, effects }) {
        for (const effect of effects) if (effect.is(ask_name)) return effect.value;
        return docChanged ? null : shown;
    },
    provide: (field) => showTooltip.from(field),
});

/// The change that turns one text into the other.
function difference(before: string, after: string) {
    let from = 0, end = 0;
    const shorter = Math.min(before.length, after.length);
    while (from < shorter && before[from] === after[from]) ++from;
    while (end < shorter - from && before[before.length - 1 - end] === after[after.length - 1 - end]) ++end;
    return { from, to: before.length - end, insert: after.slice(from, after.length - end) };
}

export function editor_names(engine: NameService) {
    const look = ViewPlugin.fromClass(class {
        private timer = 0;
        constructor(private readonly view: EditorView) {}
        update({ selectionSet, docChanged, focusChanged }: ViewUpdate) {
            if (!selectionSet && !docChanged && !focusChanged) return;
            clearTimeout(this.timer);
            this.timer = window.setTimeout(() => void this.mark(), milliseconds_of_rest);
        }
        destroy() { clearTimeout(this.timer); }

        private async mark() {
            const { view } = this, { state } = view;
            if (state.doc.length > longest || !view.hasFocus) return;
            const { uses = [] } = await engine.uses(...asked_at(state, state.selection.main.head));
            if (view.state.doc.eq(state.doc)) view.dispatch({ effects: mark_uses.of(uses) });
        }
    });

    async function go_to_declaration(view: EditorView, at: number) {
        const { state } = view, { name, declaration } = await engine.uses(...asked_at(state, at));
        if (!declaration || !view.state.doc.eq(state.doc)) return;
        if ("source" in declaration) return engine.tell(`'${name}' is declared in ${declaration.source}`);
        const from = offset(state.doc, declaration.from), to = offset(state.doc, declaration.to);
        view.dispatch({ selection: { anchor: from, head: to }, effects: EditorView.scrollIntoView(from, { y: "center" }) });
        view.focus();
    }

    async function ask_for_name(view: EditorView) {
        const { state } = view, at = state.selection.main.head, { name, uses = [] } = await engine.uses(...asked_at(state, at));
        if (!name || !view.state.doc.eq(state.doc)) return;
        const input = Object.assign(document.createElement("input"), { value: name, className: "cm-new-name", ariaLabel: `New name of ${name}`, spellcheck: false });
        const close = () => {
            view.dispatch({ effects: ask_name.of(null) });
            view.focus();
        };
        input.addEventListener("keydown", async (event) => {
            event.stopPropagation();
            if (event.key === "Escape") close();
            if (event.key !== "Enter") return;
            const { is_done, messages, text } = await engine.rename(...asked_at(state, at), input.value);
            if (!is_done) engine.tell(messages[0]);
            if (text === undefined || !view.state.doc.eq(state.doc)) return;
            close();
            view.dispatch({ changes: difference(state.sliceDoc(), text) });
        });
        const mount = () => {
            input.focus();
            input.select();
        };
        const create = () => ({ dom: input, mount });
        view.dispatch({ effects: [ask_name.of({ pos: uses.map(({ from }) => offset(state.doc, from)).findLast((from) => from <= at) ?? at, create }), mark_uses.of(uses)] });
    }

    return [
        marks, question, look,
        keymap.of([
            { key: "F12", run: (view) => (void go_to_declaration(view, view.state.selection.main.head), true) },
            { key: "F2", run: (view) => (void ask_for_name(view), true) },
        ]),
        EditorView.domEventHandlers({
            mousedown(event, view) {
                const at = event.button === 0 && (event.ctrlKey || event.metaKey) ? view.posAtCoords({ x: event.clientX, y: event.clientY }) : null;
                if (at === null) return false;
                event.preventDefault();
                void go_to_declaration(view, at);
                return true;
            },
        }),
        EditorView.theme({
            ".cm-used": { background: "color-mix(in srgb, var(--accent) 18%, transparent)", borderRadius: "2px" },
            ".cm-new-name": { font: "inherit", color: "inherit", background: "var(--raised)", border: "1px solid var(--accent)", padding: "0.2rem 0.4rem", width: "14rem" },
        }),
    ];
}
