// The start page of a session without a script: the systems that are built in and the examples, to choose one from.
import type { LibrarySystem } from "./connection";
import beside from "./library.json";

interface Entry { title: string; about: string; name?: string; words: string; script: string; picture?: string }

function card({ title, about, name, picture }: Entry) {
    const card = document.createElement("button"), image = new Image(), text = document.createElement("span");
    image.alt = "";
    if (picture) image.src = `data:image/webp;base64,${picture}`;
    text.append(...Object.entries({ b: title, small: about, code: name })
        .filter(([, textContent]) => textContent)
        .map(([tag, textContent]) => Object.assign(document.createElement(tag), { textContent })));
    card.append(image, text);
    return card;
}

export class Library {
    private readonly dialog = document.getElementById("library") as HTMLDialogElement;
    private readonly search = this.dialog.querySelector("input")!;
    private readonly list = this.dialog.querySelector("ul")!;

    /// `choose` gets the script that shows the chosen system.
    constructor(private readonly choose: (script: string) => void) {
        this.search.addEventListener("input", () => this.find());
        this.search.addEventListener("keydown", (event) => {
            if (event.key === "Enter") this.list.querySelector<HTMLElement>("li:not([hidden]) button")?.click();
        });
    }

    fill(systems: LibrarySystem[]) {
        const pictures: Record<string, string> = beside.systems;
        const entries = systems.map(({ name, about: note, words, script }): Entry => {
            const [title, ...about] = note.split(": ");
            return { title, about: about.join(": "), name, words: `${name.replaceAll("_", " ")} ${words}`, script, picture: pictures[name] };
        });
        const examples = beside.examples.map(({ name, ...entry }): Entry =>
            ({ ...entry, words: `${name} ${entry.title} ${entry.script}`.toLowerCase().replaceAll("_", " ") }));
        this.list.replaceChildren(...[...entries, ...examples].map((entry) => {
            const item = document.createElement("li"), choice = card(entry);
            choice.addEventListener("click", () => {
                this.dialog.close();
                this.choose(entry.script);
            });
            item.dataset.words = entry.words;
            item.append(choice);
            return item;
        }));
    }

    get is_filled() { return this.list.childElementCount > 0; }

    get is_open() { return this.dialog.open; }

    open() {
        this.search.value = "";
        this.find();
        this.dialog.showModal();
    }

    /// Shows what mentions all words.
    private find() {
        const words = this.search.value.toLowerCase().split(/\s+/);
        for (const item of this.list.children as HTMLCollectionOf<HTMLElement>) {
            item.hidden = !words.every((word) => item.dataset.words!.includes(word));
        }
    }
}
