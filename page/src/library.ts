// The start page of a session without a script: the systems that are built in, to choose one from.
import type { LibrarySystem } from "./connection";

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
        this.list.replaceChildren(...systems.map(({ name, about, words, script }) => {
            const item = document.createElement("li"), choice = document.createElement("button");
            const [title, ...rest] = about.split(": ");
            choice.append(...Object.entries({ b: title, small: rest.join(": "), code: name })
                .map(([tag, textContent]) => Object.assign(document.createElement(tag), { textContent })));
            choice.addEventListener("click", () => {
                this.dialog.close();
                this.choose(script);
            });
            item.dataset.words = `${name.replaceAll("_", " ")} ${words}`;
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

    /// Shows the systems that mention all words.
    private find() {
        const words = this.search.value.toLowerCase().split(/\s+/);
        for (const item of this.list.children as HTMLCollectionOf<HTMLElement>) {
            item.hidden = !words.every((word) => item.dataset.words!.includes(word));
        }
    }
}
