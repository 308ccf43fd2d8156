// Records the visible pattern as a movie, or as a picture for each moment that is drawn.
import { download } from "./download";
import { type ZippedFile, zip } from "./zip";

/// The approximate longest side in pixels. It is not exact, because cells are enlarged by integers.
const side_of_movie = 960;
const most_frames = 3000;

/// Draws a canvas enlarged, so that cells are squares of several pixels.
function enlarged(from: HTMLCanvasElement, into: HTMLCanvasElement) {
    const context = into.getContext("2d")!;
    context.imageSmoothingEnabled = false;
    context.clearRect(0, 0, into.width, into.height);
    context.drawImage(from, 0, 0, into.width, into.height);
}

export class Recording {
    private movie?: { canvas: HTMLCanvasElement; recorder: MediaRecorder };
    private frames?: Promise<ZippedFile | undefined>[];
    private last = 0;  ///< The number of the last snapshot that became a frame.

    /// `changed` is called with two values: whether a movie is being recorded, and whether frames
    /// are being recorded.
    constructor(private readonly seen: () => HTMLCanvasElement, private readonly name: () => string, private readonly changed: (is_movie: boolean, are_frames: boolean) => void) {}

    private get canvas() { return this.seen(); }

    toggle_movie() {
        if (this.movie) this.movie.recorder.stop();
        else this.start_movie();
        this.tell();
    }

    private start_movie() {
        const scale = Math.max(1, Math.floor(side_of_movie / Math.max(this.canvas.width, this.canvas.height)));
        const canvas = Object.assign(document.createElement("canvas"), { width: scale * this.canvas.width, height: scale * this.canvas.height });
        enlarged(this.canvas, canvas);
        const mimeType = ["video/webm;codecs=vp9", "video/webm;codecs=vp8", "video/webm", "video/mp4"].find((type) => MediaRecorder.isTypeSupported(type));
        const recorder = new MediaRecorder(canvas.captureStream(60), { mimeType, videoBitsPerSecond: 12e6 }), parts: Blob[] = [];
        recorder.ondataavailable = ({ data }) => parts.push(data);
        recorder.onstop = () => {
            this.movie = undefined;
            this.tell();
            download(`${this.name()}.${mimeType === "video/mp4" ? "mp4" : "webm"}`, new Blob(parts, { type: mimeType }));
        };
        recorder.start();
        this.movie = { canvas, recorder };
    }

    /// Starts recording frames (the caller must draw the first at once), or ends it and downloads the frames.
    async toggle_frames() {
        const { frames } = this;
        this.frames = frames ? undefined : [];
        this.last = 0;
        this.tell();
        if (!frames) return;
        const files = (await Promise.all(frames)).filter((file) => file !== undefined);
        download(`${this.name()}_frames.zip`, zip(files));
    }

    private tell() { this.changed(this.movie !== undefined, this.frames !== undefined); }

    /// Called after each drawing of a snapshot. If a snapshot is drawn several times, the first drawing becomes a
    /// frame.
    take(number: number) {
        if (this.movie) enlarged(this.canvas, this.movie.canvas);
        if (!this.frames || number === this.last) return;
        this.last = number;
        const name = `${String(this.frames.length).padStart(5, "0")}.png`;
        this.frames.push(new Promise((resolve) => this.canvas.toBlob(async (blob) =>
            resolve(blob ? { name, bytes: new Uint8Array(await blob.arrayBuffer()) } : undefined))));
        if (this.frames.length >= most_frames) void this.toggle_frames();
    }
}
