// The editor of the script, which shows messages at their positions.
import { defaultKeymap, history, historyKeymap, indentWithTab } from "@codemirror/commands";
import { HighlightStyle, StreamLanguage, bracketMatching, syntaxHighlighting } from "@codemirror/language";
import { lintGutter, setDiagnostics } from "@codemirror/lint";
import { EditorState } from "@codemirror/state";
import { EditorView, drawSelection, highlightActiveLine, keymap, lineNumbers } from "@codemirror/view";
import { tags } from "@lezer/highlight";
import type { Message } from "./connection";
import { type EngineHelp, editor_help } from "./editor_help";
import { type NameService, editor_names } from "./editor_names";
import { locks } from "./locks";
import { in_words } from "./words";

// Names may contain Greek letters and subscript digits. ∂u is the beginning of a rate.
const name = "∂?[A-Za-z_α-ωΓ-ΩµϵϕϑϰϱϖΩ][\\wα-ωΓ-ΩµϵϕϑϰϱϖΩ₀-₉]*";
const called = new RegExp(`^${name}(?=\\s*\\()`), defined = new RegExp(`^${name}(?=\\s*('|′|/∂t|\\+?=|:))`), named = new RegExp(`^${name}`);

const language = StreamLanguage.define({
    token(stream) {
        if (stream.eatSpace()) return null;
        if (stream.match(/^#.*/)) return "comment";
        if (stream.match(/^"[^"]*"?/)) return "string";
        if (stream.match(/^[0-9]*\.?[0-9]+([eE][-+]?[0-9]+)?/)) return "number";
        if (stream.match(/^(system|cells|shape|stage|domain|picture|use|fn|let|in|step|and|or|not)\b(?!\s*:)/)) return "keyword";
        if (stream.match(/^(∇²|∇⁴|∇·|∇|Δ|√)/)) return "function";
        if (stream.match(called)) return "function";
        if (stream.match(defined)) return "definition";
        if (!stream.match(named)) stream.next();
        return null;
    },
    tokenTable: { function: tags.function(tags.variableName), definition: tags.definition(tags.variableName) },
    languageData: { commentTokens: { line: "#" } },
});

const colours = HighlightStyle.define([
    { tag: tags.comment, color: "var(--faint)", fontStyle: "italic" },
    { tag: tags.keyword, color: "var(--accent)", fontWeight: "600" },
    { tag: tags.number, color: "light-dark(#8a4b08, #e0b070)" },
    { tag: tags.string, color: "light-dark(#8a4b08, #e0b070)" },
    { tag: tags.function(tags.variableName), color: "light-dark(#5b3fa0, #b9a3f0)" },
    { tag: tags.definition(tags.variableName), fontWeight: "600" },
]);

const theme = EditorView.theme({
    "&": { height: "100%", fontSize: "13.5px" },
    "&.cm-focused": { outline: "none" },
    ".cm-scroller": { fontFamily: "ui-monospace, monospace", lineHeight: "1.6", padding: "0.8rem 0" },
    ".cm-gutters": { background: "none", border: "none", color: "var(--faint)" },
    ".cm-content": { caretColor: "var(--ink)" },
    ".cm-cursor": { borderLeftColor: "var(--ink)" },
    ".cm-activeLine": { background: "color-mix(in srgb, var(--accent) 7%, transparent)" },
    "&.cm-focused .cm-selectionBackground, .cm-selectionBackground": { background: "color-mix(in srgb, var(--accent) 25%, transparent) !important" },
    ".cm-tooltip": { background: "var(--raised)", border: "1px solid var(--line)", color: "var(--ink)" },
});

type Place = [line: number, column: number];

export class Editor {
    readonly view: EditorView;

    /// `typed` is called after every key, `changed` some time after the last key, and `refuse` when the user tries to
    /// change a locked part.
    constructor(parent: HTMLElement, engine: EngineHelp & NameService, typed: () => void, changed: (text: string) => void, refuse: () => void) {
        // In a shadow tree the editor's styles are style sheets, which the page's Content-Security-Policy allows.
        const root = parent.attachShadow({ mode: "open" });
        const listen = EditorView.updateListener.of((update) => {
            if (!update.docChanged || this.is_silent) return;
            typed();
            clearTimeout(this.timer);
            this.timer = window.setTimeout(() => {
                this.timer = 0;
                changed(this.text);
            }, 350);
        });
        this.view = new EditorView({
            root, parent: root as unknown as Element,
            state: EditorState.create({ extensions: [
                lineNumbers(), lintGutter(), history(), drawSelection(), highlightActiveLine(), bracketMatching(),
                language, syntaxHighlighting(colours), theme, listen, EditorView.lineWrapping,
                EditorView.contentAttributes.of({ "aria-label": "Script; Tab indents, Escape leaves the text" }),
                editor_help(engine), editor_names(engine), locks(refuse), EditorView.domEventHandlers({ focus: () => void (this.has_caret = true) }),
                keymap.of([{ key: "Escape", run: (view) => (view.contentDOM.blur(), true) }, indentWithTab, ...defaultKeymap, ...historyKeymap]),
            ] }),
        });
    }

    private has_caret = false;
    private is_silent = false;
    private timer = 0;

    /// Whether text has been typed for which `changed` has not been called yet.
    get is_changing() { return this.timer !== 0; }

    get text() { return this.view.state.doc.toString(); }
    set text(text: string) {
        if (text === this.text) return;
        this.is_silent = true;
        this.view.dispatch({ changes: { from: 0, to: this.view.state.doc.length, insert: text }, filter: false });
        this.is_silent = false;
    }

    /// Replaces a part of the text as if `text` were typed.
    replace(from: Place | number, to: Place | number, text: string) {
        const offset = (place: Place | number) => typeof place === "number" ? place : this.offset(place);
        this.view.dispatch({ changes: { from: offset(from), to: offset(to), insert: text }, scrollIntoView: true });
        this.view.focus();
    }

    /// Whether the caret has been placed in the text.
    get was_entered() { return this.has_caret; }

    /// Writes at the caret the text that `compose` makes from the text before and after the caret, and selects a part
    /// of the written text.
    write(compose: (before: string, after: string) => { text: string; from: number; to: number }) {
        const { text, view } = this, at = view.state.selection.main.to;
        const { text: insert, from, to } = compose(text.slice(0, at), text.slice(at));
        view.dispatch({ changes: { from: at, insert }, selection: { anchor: at + from, head: at + to }, scrollIntoView: true });
        view.focus();
    }

    private offset([line, column]: Place) {
        const { doc } = this.view.state, found = doc.line(Math.min(Math.max(line, 1), doc.lines));
        return Math.min(found.from + column, found.to);
    }

    show(messages: Message[]) {
        this.view.dispatch(setDiagnostics(this.view.state, messages.filter((m) => m.from && m.to).map((m) => ({
            from: this.offset(m.from!), to: this.offset(m.to!), severity: m.is_error ? "error" as const : "warning" as const,
            message: in_words({ ...m, from: undefined }),
        }))));
    }
}
