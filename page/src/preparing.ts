// Words in the place of a pattern that is not there yet: what the engine is doing, or that the model is being prepared.

export class Preparing {
    private readonly words = document.getElementById("preparing")!;
    private doing = "";
    private is_blank = false;  ///< The model has not been drawn yet.

    /// What the engine is doing that takes long, and how much of it is done; nothing after it.
    tell(doing: string, part?: number) {
        this.doing = doing && `${doing} …${part === undefined ? "" : ` ${Math.floor(100 * part)} %`}`;
        this.show();
    }

    /// Is the place of the pattern blank, since its surface is still made or drawn for the first time?
    set blank(is_blank: boolean) {
        this.is_blank = is_blank;
        this.show();
    }

    private show() {
        const words = this.doing || (this.is_blank ? "preparing the model …" : "");
        if (words === this.words.textContent) return;
        this.words.textContent = words;
    }
}
