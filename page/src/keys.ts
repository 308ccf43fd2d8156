// The keys of the page and their effects. In the text, in menus and in inputs, keys have other effects.
export interface Key { key: string; also?: string[]; act: string; does: string }

export const keys: Key[] = [
    { key: "Space", also: [" "], act: "run", does: "run, pause" },
    { key: ".", act: "step", does: "one step" },
    { key: "n", act: "next", does: "next stage" },
    { key: "Home", act: "restart", does: "from the start" },
    { key: "Ctrl+Z", also: ["Ctrl+z"], act: "undo", does: "undo" },
    { key: "Ctrl+Shift+Z", also: ["Ctrl+Shift+z", "Ctrl+y"], act: "redo", does: "redo" },
    { key: "+", also: ["="], act: "nearer", does: "nearer" },
    { key: "-", act: "farther", does: "farther" },
    { key: "0", act: "fit", does: "the whole pattern" },
    { key: "Page Up", also: ["PageUp"], act: "slice_before", does: "slice before" },
    { key: "Page Down", also: ["PageDown"], act: "slice_after", does: "slice after" },
    { key: "Arrows", act: "", does: "turn a model, or with Shift move it" },
    { key: "h", act: "hold", does: "hold the range" },
    { key: "m", act: "measure", does: "measure" },
    { key: "p", act: "pick", does: "choose a cell to measure" },
    { key: "F12", act: "", does: "in the text: to the declaration of a name, like Ctrl with a click" },
    { key: "F2", act: "", does: "in the text: rename a name" },
    { key: "k", act: "point", does: "write positions that are clicked into the text" },
    { key: "Escape", act: "", does: "leave the text" },
    { key: "?", also: ["Shift+?"], act: "help", does: "this help" },
];

/// Keys that have another effect in some elements.
const of_others: Record<string, string> = {
    " ": "button, summary, input[type=checkbox]", "Home": "input", "PageUp": "input[type=range]", "PageDown": "input[type=range]",
};

export function obey_keys(actions: Record<string, () => void>) {
    document.addEventListener("keydown", (event) => {
        const at = event.target as HTMLElement;
        if (at.closest("dialog") || at.id === "editor" || at.matches("select, input:not([type=range])")) return;
        if (event.altKey || of_others[event.key] && at.matches(of_others[event.key])) return;
        const ctrl = event.ctrlKey || event.metaKey;
        const name = ctrl ? `Ctrl+${event.shiftKey ? "Shift+" : ""}${event.key}` : event.key;
        const found = keys.find(({ key, also }) => key === name || also?.includes(name));
        if (!found?.act) return;
        event.preventDefault();
        actions[found.act]();
    });
}
