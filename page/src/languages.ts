// Shows the page in the language of its user: every text of the page that the table of labels contains is translated as
// soon as it appears. Elements with translate="no" contain words of scripts and of the engine.
import { type Language, labels, languages } from "./labels";

const attributes = ["title", "aria-label", "placeholder", "alt"];
const codes = Object.keys(languages) as Language[];
const escaped = (text: string) => text.replace(/[.*+?^${}()|[\]\\]/g, "\\$&");
const kept: Record<string, string> = { "#": "([-\\d.,]+)", "$": "(\\S+)", "%": "(.+?)" };
/// Rows with a variable part, the longest first, because shorter rows may be parts of longer ones.
const rows = Object.keys(labels).filter((english) => /[#$%]/.test(english)).sort((a, b) => b.length - a.length)
    .map((english) => ({ english, pattern: new RegExp(`^${english.split(/([#$%])/).map((part) => kept[part] ?? escaped(part)).join("")}$`) }));

const row_of = (english: string) => Object.hasOwn(labels, english) ? labels[english] : undefined;

let now: Language = "en";

/// A text of the page in the present language. If no row contains it, the text is returned unchanged.
export function translated(english: string, language = now): string {
    const column = codes.indexOf(language) - 1;
    if (column < 0) return english;
    if (row_of(english)) return row_of(english)![column];
    for (const row of rows) {
        const found = row.pattern.exec(english);
        if (!found) continue;
        let k = 0;
        return labels[row.english][column].replace(/[#$%]/g, () => {
            const part = found[++k];
            return row_of(part)?.[column] ?? part;
        });
    }
    return english;
}

/// The original text of each node, or of each attribute of an element.
const said = new WeakMap<Node, string>();
const said_of = new WeakMap<Element, Map<string, string>>();

const is_kept = (element: Element | null) => !element || element.closest('option, [translate="no"]') !== null;

function show_text(node: Text, is_new: boolean) {
    if (is_kept(node.parentElement)) return;
    if (is_new || !said.has(node)) said.set(node, node.data);
    const english = said.get(node)!, words = english.trim(), other = words && english.replace(words, () => translated(words));
    if (other && other !== node.data) node.data = other;
}

function show_attribute(element: Element, name: string, is_new: boolean) {
    const value = element.getAttribute(name);
    if (value === null || is_kept(element)) return;
    if (!said_of.has(element)) said_of.set(element, new Map());
    const known = said_of.get(element)!;
    if (is_new || !known.has(name)) known.set(name, value);
    const other = translated(known.get(name)!);
    if (other !== value) element.setAttribute(name, other);
}

function show_all(root: Node, is_new: boolean) {
    if (root instanceof Text) return show_text(root, is_new);
    if (!(root instanceof Element)) return;
    const walker = document.createTreeWalker(root, NodeFilter.SHOW_ELEMENT | NodeFilter.SHOW_TEXT);
    for (let node: Node | null = root; node; node = walker.nextNode()) {
        if (node instanceof Text) show_text(node, is_new);
        else for (const name of attributes) show_attribute(node as Element, name, is_new);
    }
}

const watched = { subtree: true, childList: true, characterData: true, attributes: true, attributeFilter: attributes };

/// Chooses the language that the user chose before, or else the language of the browser, and offers all languages.
export function speak(choice: HTMLSelectElement) {
    const observer = new MutationObserver((changes) => {
        for (const { type, target, addedNodes, attributeName } of changes) {
            if (type === "attributes") show_attribute(target as Element, attributeName!, true);
            else if (type === "characterData") show_text(target as Text, true);
            else for (const node of addedNodes) show_all(node, true);
        }
        observer.takeRecords();  // Discards the changes made by this translation.
    });
    const use = (language: Language) => {
        const was_english = now === "en";
        observer.disconnect();
        now = language;
        document.documentElement.lang = language === "zh" ? "zh-Hans" : language;
        // The HTML of the page is in English.
        show_all(document.body, was_english);
        if (language !== "en") observer.observe(document.body, watched);
        choice.value = language;
    };
    choice.append(...codes.map((code) => new Option(languages[code], code)));
    choice.addEventListener("change", () => {
        localStorage.setItem("language", choice.value);
        use(choice.value as Language);
    });
    const wanted = [localStorage.getItem("language") ?? "", ...navigator.languages].map((tag) => tag.split("-")[0]);
    use((wanted.find((tag) => codes.includes(tag as Language)) ?? "en") as Language);
}
