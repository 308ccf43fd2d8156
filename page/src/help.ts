// The list of keys, and the introduction in four steps at the first visit.
import { keys } from "./keys";

const steps: [string, string][] = [
    ["text", "The script of the pattern. A change takes effect as soon as it is correct. Ctrl+Space completes a name, the pointer on a name explains it, and Escape leaves the text."],
    ["controls", "Sliders change numbers while the pattern grows."],
    ["frame", "Paint on the pattern. The wheel zooms, the middle button moves it."],
    ["stages", "A click on a stage goes to its start. Space runs and pauses, Ctrl+Z undoes anything, and ? shows all keys."],
];

export class Help {
    private readonly dialog = document.getElementById("help") as HTMLDialogElement;
    private readonly card = document.getElementById("tour")!;
    private step = steps.length;

    constructor() {
        this.dialog.querySelector("dl")!.append(...keys.flatMap(({ key, does }) =>
            [["dt", key], ["dd", does]].map(([tag, textContent]) => Object.assign(document.createElement(tag), { textContent }))));
        this.dialog.querySelector("button")!.addEventListener("click", () => {
            this.dialog.close();
            this.go_to(0);
        });
        this.card.querySelector("#tour_next")!.addEventListener("click", () => this.go_to(this.step + 1));
        this.card.querySelector("#tour_end")!.addEventListener("click", () => this.go_to(steps.length));
    }

    open() { this.dialog.showModal(); }

    /// Shows the introduction once in each browser.
    greet() {
        if (localStorage.getItem("was_taught") === null && this.step === steps.length) this.go_to(0);
    }

    private go_to(step: number) {
        this.step = step;
        for (const element of document.querySelectorAll("[data-taught]")) element.removeAttribute("data-taught");
        this.card.hidden = step >= steps.length;
        if (this.card.hidden) return localStorage.setItem("was_taught", "yes");
        const [id, words] = steps[step];
        const taught = document.getElementById(id)!;
        taught.setAttribute("data-taught", "");
        this.card.scrollIntoView({ block: "nearest" });
        // On a narrow screen the pattern stays visible, and steps about elements below it are only described.
        const is_seen = taught.getBoundingClientRect().top < innerHeight;
        this.card.querySelector("p")!.textContent = is_seen ? words : `Below the pattern: ${words[0].toLowerCase()}${words.slice(1)}`;
        this.card.querySelector("small")!.textContent = `${step + 1} of ${steps.length}`;
        this.card.querySelector("#tour_next")!.textContent = step + 1 === steps.length ? "done" : "next";
    }
}
