// A slider, and a field for a typed value, for each parameter with a range.
import type { Answer, Control } from "./connection";

/// A value with 7 digits: enough for steps of sliders, without the rounding error of binary32.
const exact = (value: number) => String(Number(value.toPrecision(7)));

type Ask = (what: string, fields: Record<string, unknown>) => Promise<Answer>;

/// Shows the sliders. While the parameters are the same, elements are reused, so that a slider being moved is not lost.
export function show_sliders(controls: Control[], ask: Ask) {
    const box = document.getElementById("controls")!, shape = JSON.stringify(controls.map(({ value, ...rest }) => rest));
    if (box.dataset.shape !== shape) {
        box.dataset.shape = shape;
        box.replaceChildren(...controls.flatMap((control, k) => {
            const slider = make_slider(control, ask);
            if (controls[k - 1]?.stage === control.stage) return [slider];
            const title = Object.assign(document.createElement("h2"), { translate: false });
            title.textContent = control.name.slice(0, -control.label.length - 1);
            return [title, slider];
        }));
    }
    box.querySelectorAll<HTMLElement>(".slider").forEach((slider, k) => {
        const [typed, input] = slider.querySelectorAll("input");
        // The received value is older than the one that the user is choosing.
        if (input.matches(":active") || "isBusy" in input.dataset || "isTyped" in typed.dataset) return;
        input.value = String(controls[k].value);
        typed.value = exact(controls[k].value);
        typed.classList.remove("wrong");
    });
}

function make_slider(control: Control, ask: Ask): HTMLElement {
    const slider = document.createElement("div"), name = document.createElement("label");
    const typed = Object.assign(document.createElement("input"), {
        inputMode: "decimal", ariaLabel: `Value of ${control.name}`, title: `A number or a formula; the slider goes from ${exact(control.low)} to ${exact(control.high)}`,
    });
    const input = Object.assign(document.createElement("input"), {
        type: "range", min: String(control.low), max: String(control.high), id: `slider ${control.name}`,
        step: String(control.step ?? (control.high - control.low) / 1000), ariaLabel: control.name,
    });
    slider.className = "slider";
    slider.title = control.doc;
    name.textContent = control.label;
    name.htmlFor = input.id;
    name.translate = false;
    slider.append(name, typed, input);
    if (control.doc) slider.append(Object.assign(document.createElement("small"), { textContent: control.doc, translate: false }));
    // All values of one move are undone together. When a move ends, its values may still be waiting to be sent.
    let move = 0, taken = -1, is_sending = false, wanted = { text: "", move };
    const send = async () => {
        if (is_sending) return;
        is_sending = true;
        input.dataset.isBusy = "";
        for (let sent = { text: "", move: -1 }; sent !== wanted;) {
            sent = wanted;
            const answer = await ask("set", { name: control.name, expression: sent.text, joins_last: taken === sent.move });
            if (answer.is_done) taken = sent.move;
            typed.classList.toggle("wrong", !answer.is_done);
        }
        is_sending = false;
        delete input.dataset.isBusy;
    };
    input.addEventListener("input", () => {
        wanted = { text: exact(input.valueAsNumber), move };
        typed.value = wanted.text;
        void send();
    });
    input.addEventListener("change", () => ++move);
    typed.addEventListener("input", () => (typed.dataset.isTyped = ""));
    typed.addEventListener("change", () => {
        delete typed.dataset.isTyped;
        wanted = { text: typed.value, move: ++move };
        ++move;
        void send();
    });
    return slider;
}
