// Closes small boxes over the page when the user presses Escape, which returns the focus, or clicks beside the box.
export function close_popups(ids: string[]) {
    const close = (is_kept: (box: HTMLDetailsElement) => boolean) => {
        for (const id of ids) {
            const box = document.getElementById(id) as HTMLDetailsElement;
            if (!box.open || is_kept(box)) continue;
            if (box.contains(document.activeElement)) box.querySelector("summary")!.focus();
            box.open = false;
        }
    };
    document.addEventListener("pointerdown", ({ target }) => close((box) => box.contains(target as Node)));
    document.addEventListener("keydown", ({ key }) => key === "Escape" && close(() => false));
}
