// The start page of a session without a script. The user chooses one of the built-in systems or an example.
import type { LibrarySystem } from "./connection";
import beside from "./library.json";
import { favourites, group_names, group_of, likeness } from "./library_groups";

interface Entry { title: string; about: string; name?: string; words: string; script: string; picture?: string; group: string }

const most_alike = 11;

const node = <Tag extends keyof HTMLElementTagNameMap>(tag: Tag, fields: Partial<HTMLElementTagNameMap[Tag]> = {}) =>
    Object.assign(document.createElement(tag), fields);

function card({ title, about, name, picture }: Entry) {
    const card = node("button", { className: "card" }), image = new Image(), text = document.createElement("span");
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
    private readonly told = this.dialog.querySelector("p")!;
    private readonly sections = group_names.map((name) => {
        const section = node("section", { ariaLabel: name });
        section.append(node("h3", { textContent: name }), node("ul"));
        return section;
    });
    private entries: Entry[] = [];
    private items: HTMLLIElement[] = [];  ///< The list items of the entries.
    private liked = new Set((localStorage.getItem("favourites") ?? "").split("\n").filter(Boolean));  ///< The titles of favourites.

    /// `choose` is called with a script that shows the chosen system.
    constructor(private readonly choose: (script: string) => void) {
        this.search.addEventListener("input", () => this.find());
        this.search.addEventListener("keydown", (event) => {
            if (event.key === "Enter") this.dialog.querySelector<HTMLElement>("section:not([hidden]) li:not([hidden]) .card")?.click();
        });
        this.dialog.querySelector("div")!.append(...this.sections);
    }

    fill(systems: LibrarySystem[]) {
        const pictures: Record<string, string> = beside.systems;
        const entries = systems.map(({ name, about: note, words, script }): Entry => {
            const [title, ...about] = note.split(": "), plain = name.replaceAll("_", " ");
            return { title, about: about.join(": "), name, words: `${plain} ${words}`, script, picture: pictures[name], group: group_of(`${title} ${plain}`, about.join(" "), false) };
        });
        const examples = beside.examples.map(({ name, ...entry }): Entry =>
            ({ ...entry, words: `${name} ${entry.title} ${entry.script}`.toLowerCase().replaceAll("_", " "), group: group_of("", "", true) }));
        this.entries = [...entries, ...examples];
        this.items = this.entries.map((entry, k) => this.make(entry, k));
        this.sort();
    }

    private make(entry: Entry, k: number) {
        const item = node("li"), choice = card(entry), like = node("button", { className: "like", title: "A favourite" });
        const more = node("button", { className: "more", textContent: "more like this" });
        more.ariaLabel = `more like this: ${entry.title}`;
        like.ariaLabel = `Favourite: ${entry.title}`;
        choice.addEventListener("click", () => {
            this.dialog.close();
            this.choose(entry.script);
        });
        like.addEventListener("click", () => {
            if (!this.liked.delete(entry.title)) this.liked.add(entry.title);
            localStorage.setItem("favourites", [...this.liked].join("\n"));
            this.sort();
            like.focus();
        });
        more.addEventListener("click", () => this.show_alike(k));
        item.append(choice, like, more);
        return item;
    }

    /// Moves all items into their sections, favourites into the first section.
    private sort() {
        const lists = this.sections.map((section) => section.querySelector("ul")!);
        for (const list of lists) list.replaceChildren();
        this.entries.forEach(({ title, group }, k) => {
            const is_liked = this.liked.has(title);
            Object.assign(this.items[k].querySelector(".like")!, { ariaPressed: String(is_liked), textContent: is_liked ? "★" : "☆" });
            lists[group_names.indexOf(is_liked ? favourites : group)].append(this.items[k]);
        });
        this.find();
    }

    get is_filled() { return this.entries.length > 0; }

    get is_open() { return this.dialog.open; }

    open() {
        this.search.value = "";
        this.find();
        this.dialog.showModal();
    }

    /// Shows the items that contain all words.
    private find() {
        const words = this.search.value.toLowerCase().split(/\s+/);
        this.show((k) => words.every((word) => this.entries[k].words.includes(word)));
        this.told.textContent = "";
    }

    /// Shows a system and the systems that are most similar to it.
    private show_alike(to: number) {
        const alike = likeness(this.entries.map(({ title, about, name = "" }) => `${title} ${about} ${name.replaceAll("_", " ")}`), to);
        const nearest = alike.map((_, k) => k).filter((k) => k !== to).sort((one, other) => alike[other] - alike[one]).slice(0, most_alike);
        this.show((k) => k === to || nearest.includes(k));
        this.told.replaceChildren(`like ${this.entries[to].title} `, node("button", { textContent: "show all" }));
        this.told.querySelector("button")!.addEventListener("click", () => {
            this.find();
            this.search.focus();
        });
        this.dialog.querySelector("div")!.scrollTop = 0;
        this.told.querySelector("button")!.focus();
    }

    private show(is_shown: (entry: number) => boolean) {
        this.items.forEach((item, k) => (item.hidden = !is_shown(k)));
        for (const section of this.sections) section.hidden = !section.querySelector("li:not([hidden])");
    }
}
