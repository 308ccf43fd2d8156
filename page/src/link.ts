// A link to a script, as text and as a QR code.
import { encode } from "uqr";
import { EngineLine } from "./carried_engine";
import { pack } from "./linked_script";

const largest_code = 25;         ///< The largest version of QR codes: larger ones are too fine for phones.
const pixels_of_module = 3;

function draw_code(link: string, canvas: HTMLCanvasElement) {
    const { size, data } = encode(link, { ecc: "L", border: 4, maxVersion: largest_code });
    canvas.width = canvas.height = pixels_of_module * size;
    const context = canvas.getContext("2d")!;
    context.fillStyle = "white";
    context.fillRect(0, 0, canvas.width, canvas.height);
    context.fillStyle = "black";
    data.forEach((row, y) => row.forEach((is_dark, x) => is_dark && context.fillRect(pixels_of_module * x, pixels_of_module * y, pixels_of_module, pixels_of_module)));
}

/// The dialog that shows and copies the link to a script. `token` is the token of the session, which its links need.
export class LinkDialog {
    private readonly dialog = document.getElementById("link_dialog") as HTMLDialogElement;
    private readonly field = this.dialog.querySelector("input")!;
    private readonly code = this.dialog.querySelector("canvas")!;

    constructor(private readonly token: () => string) {
        this.dialog.querySelector("button")!.addEventListener("click", () => void this.copy());
    }

    async open(script: string) {
        const of_token = EngineLine.is_carried ? "" : `token=${this.token()}&`;
        this.field.value = `${location.href.split("#")[0]}#${of_token}script=${await pack(script)}`;
        this.dialog.querySelector("small")!.textContent = this.show_code();
        if (!this.dialog.open) this.dialog.showModal();
        await this.copy();
    }

    /// Shows the QR code, or says why there is none.
    private show_code() {
        this.code.hidden = true;
        if (!EngineLine.is_carried) return "The link opens on this machine while Cascade runs. A page that 'cascade export' writes gives links for everybody.";
        if (!/^https?:$/.test(location.protocol)) return "The link opens where this file is. On a server, the page gives links for everybody.";
        try {
            draw_code(this.field.value, this.code);
        } catch {
            return "The script is too long for a code that a phone could scan.";
        }
        this.code.hidden = false;
        return "";
    }

    private async copy() {
        this.field.select();
        // Without https there is no clipboard object, only the old command.
        const is_done = await navigator.clipboard?.writeText(this.field.value).then(() => true, () => false) || document.execCommand("copy");
        this.dialog.querySelector("p")!.textContent = is_done ? "The link to this script is copied." : "Copy the link to this script:";
    }
}
