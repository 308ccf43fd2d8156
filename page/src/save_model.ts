// Saves the pattern as a model or as maps. The engine writes the files.
import type { Answer, SavedFile } from "./connection";
import { download } from "./download";
import { picture_fields } from "./picture_fields";
import type { Pattern } from "./pattern";

type Ask = <Reply>(what: string, fields: Record<string, unknown>) => Promise<Answer & Reply>;

export class ModelSaver {
    /// Whether a file has been requested. Only one is requested at a time.
    private is_busy = false;

    constructor(private readonly pattern: Pattern, private readonly ask: Ask, private readonly tell: (words: string) => void) {}

    /// `looks` contains the shown expression and the palette.
    async save(what: "model" | "maps", name: string, looks: { show: string; palette: string }) {
        if (this.is_busy) return;
        this.is_busy = true;
        this.tell(`writing the ${what} …`);
        const { is_done, ending, bytes, notes } = await this.ask<SavedFile>(what, { ...looks, ...picture_fields(this.pattern) });
        this.is_busy = false;
        if (!is_done || !bytes) return;
        download(`${name}${ending}`, new Blob([bytes], { type: ending === ".glb" ? "model/gltf-binary" : "application/zip" }));
        this.tell(notes?.[0] ?? "");
    }
}
