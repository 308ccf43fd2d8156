// Colours planes on the processor, which is faster than shaders without a graphics card.
import type { Values } from "./between_cells";
import type { Palette } from "./connection";

const places = 1 << 14;  ///< The entries of the table of colours: no level has an error above 1.

const byte_of = (part: number) => Math.round(255 * Math.min(Math.max(part, 0), 1));
const opaque = 0xff000000;
const colour_of = (red: number, green: number, blue: number) => (opaque | byte_of(blue) << 16 | byte_of(green) << 8 | byte_of(red)) >>> 0;

export class PlanePainter {
    private image = new ImageData(1, 1);
    private colours = new Uint32Array(places);
    private palette?: Palette;

    /// Paints one plane in the colours of a palette, or three planes as red, green and blue. `there` is the opacity.
    paint(planes: Values[], range: { low: number; high: number }, palette: Palette, there?: Values): ImageData {
        const { columns, rows } = planes[0];
        if (this.image.width !== columns || this.image.height !== rows) this.image = new ImageData(columns, rows);
        const pixels = new Uint32Array(this.image.data.buffer);
        if (planes.length === 1) this.paint_values(planes[0].numbers, range, palette, pixels);
        else this.paint_colours(planes.map(({ numbers }) => numbers), pixels);
        if (there) there.numbers.forEach((part, k) => (this.image.data[4 * k + 3] = byte_of(part)));
        return this.image;
    }

    private paint_values(numbers: Float32Array, { low, high }: { low: number; high: number }, palette: Palette, pixels: Uint32Array) {
        if (palette !== this.palette) this.take(palette);
        const { colours } = this, last = places - 1, factor = high === low ? 0 : last / (high - low), start = high === low ? last / 2 : 0.5 - low * factor;
        for (let k = 0; k < numbers.length; ++k) {
            const place = numbers[k] * factor + start;
            pixels[k] = colours[place > 0 ? place < last ? place | 0 : last : 0];
        }
    }

    private paint_colours([red, green, blue]: Float32Array[], pixels: Uint32Array) {
        for (let k = 0; k < red.length; ++k) pixels[k] = colour_of(red[k], green[k], blue[k]);
    }

    /// Fills the table of colours. The arithmetic is the same as in core/palette.cpp.
    private take(palette: Palette) {
        const { stops } = palette, last = stops.length - 1;
        for (let k = 0; k < places; ++k) {
            const along = k / (places - 1) * last, left = Math.min(Math.floor(along), last - 1), part = along - left;
            const [red, green, blue] = stops[left].map((level, c) => level + (stops[left + 1][c] - level) * part);
            this.colours[k] = colour_of(red, green, blue);
        }
        this.palette = palette;
    }
}
