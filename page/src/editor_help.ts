// Help from the engine for the text: the names that can follow, and the meaning of a name.
import { type CompletionContext, autocompletion, completionKeymap } from "@codemirror/autocomplete";
import { EditorView, hoverTooltip, keymap } from "@codemirror/view";
import type { Explanation, KnownName } from "./connection";
import { digits } from "./words";

export interface EngineHelp {
    names(text: string): Promise<KnownName[]>;
    explain(text: string): Promise<Explanation>;
}

/// The box with an explanation. Undefined if the box would contain nothing but the word itself.
export function explanation_box(told: Explanation): HTMLElement | undefined {
    if (!told.name) return undefined;
    const box = document.createElement("div"), head = document.createElement("div");
    box.className = "explanation";
    head.append(Object.assign(document.createElement("b"), { textContent: told.name }), ` ${told.what}`);
    box.append(head);
    if (told.note) box.append(Object.assign(document.createElement("p"), { textContent: told.note }));
    const range = told.range ? `, in ${told.range.map(digits).join(" … ")}` : "";
    const values = told.value !== undefined ? `${digits(told.value)}${range}`
        : told.smallest !== undefined && told.largest !== undefined ? `from ${digits(told.smallest)} to ${digits(told.largest)}` : "";
    if (values) box.append(Object.assign(document.createElement("p"), { textContent: `now ${values}` }));
    if (told.equation) {
        // MathML from the engine, which escapes text of the script.
        const equation = document.createElement("p");
        equation.innerHTML = told.equation;
        box.append(equation);
    }
    return box;
}

export function editor_help(engine: EngineHelp) {
    const complete = async (context: CompletionContext) => {
        const word = context.matchBefore(/[\wα-ωΓ-Ω₀-₉]*/)!, before = context.state.sliceDoc(0, context.pos);
        const is_asked = context.explicit || /[A-Za-z_α-ωΓ-Ω][\wα-ωΓ-Ω₀-₉]*$/.test(before) || /[A-Za-z_]\w*\.$/.test(before);
        if (!is_asked) return null;
        const names = await engine.names(before);
        if (context.aborted) return null;
        // The engine may not know names that are declared in the text while the text is still incorrect.
        if (names.some(({ what }) => what === "function")) {
            for (const [, name] of context.state.sliceDoc().matchAll(/(?:^|[;{])\s*∂?([A-Za-z_α-ωΓ-Ω][\wα-ωΓ-Ω₀-₉]*)\s*(?:['′=:]|\/∂t)/gm)) {
                if (!names.some((known) => known.name === name)) names.push({ name, what: "parameter", note: "" });
            }
        }
        return {
            from: word.from, validFor: /^[\wα-ωΓ-Ω₀-₉]*$/,
            options: names.map(({ name, what, note }) => ({
                label: name, detail: note || what,
                // Names that the script declares come first.
                boost: ["species", "parameter", "definition", "stage"].includes(what) ? 1 : 0,
            })),
        };
    };
    const explain = async (view: EditorView, at: number) => {
        const word = view.state.wordAt(at);
        if (!word) return null;
        const box = explanation_box(await engine.explain(view.state.sliceDoc(0, word.to)));
        return box ? { pos: word.from, end: word.to, above: true, create: () => ({ dom: box }) } : null;
    };
    return [
        autocompletion({ override: [complete], defaultKeymap: false, icons: false, maxRenderedOptions: 60 }),
        keymap.of(completionKeymap),
        hoverTooltip(explain, { hoverTime: 400 }),
        EditorView.theme({
            ".cm-tooltip-autocomplete": { maxWidth: "min(34rem, 90vw)" },
            ".cm-tooltip-autocomplete > ul": { fontFamily: "inherit" },
            ".cm-tooltip-autocomplete > ul > li[aria-selected]": { background: "color-mix(in srgb, var(--accent) 22%, transparent)", color: "var(--ink)" },
            ".cm-completionDetail": { color: "var(--faint)", fontStyle: "normal" },
            ".cm-completionMatchedText": { textDecoration: "none", fontWeight: "600" },
            ".explanation": { padding: "0.5rem 0.8rem", maxWidth: "min(38rem, 90vw)", overflowX: "auto", fontFamily: "system-ui, sans-serif", lineHeight: "1.4" },
            ".explanation p": { margin: "0.25rem 0 0" },
            ".explanation mtd:first-child": { textAlign: "right" },
            ".explanation mtd": { textAlign: "left", padding: "0.1em 0.15em" },
        }),
    ];
}
