// The text that is shown as long as the pattern is not ready: the engine's task, or that the model is being prepared.

export class Preparing {
    private readonly words = document.getElementById("preparing")!;
    private doing = "";
    private is_blank = false;  ///< Whether the model has not been drawn yet.

    /// Sets the engine's long task and the fraction that is done. `doing` is empty after the task.
    tell(doing: string, part?: number) {
        this.doing = doing && `${doing} …${part === undefined ? "" : ` ${Math.floor(100 * part)} %`}`;
        this.show();
    }

    /// Sets whether there is no pattern yet, because its surface is being made or drawn for the first time.
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
