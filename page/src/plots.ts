// Draws the plots of measured values.
import uPlot from "uplot";

const compact = new Intl.NumberFormat("en", { notation: "compact", maximumSignificantDigits: 3 });
/// A short form of a number, for narrow axes.
function short(value: number | null) {
    if (value === null || value === undefined) return "";
    return value !== 0 && Math.abs(value) < 1e-3 ? value.toExponential(0) : compact.format(value);
}
/// A colour for curve k, from the style sheet.
export const colour_of_curve = (k: number) => `var(--curve-${k % 6})`;
const swatch = document.createElement("span");
/// A colour of the style sheet in a form that canvases accept.
function css(colour: string) {
    if (!swatch.isConnected) document.body.append(Object.assign(swatch, { hidden: true }));
    swatch.style.color = colour;
    return getComputedStyle(swatch).color;
}

const plot_height = 120;

export interface Curve { name: string; is_dashed?: boolean }

/// Curves over one axis, inside an element.
export class Plot {
    private plot?: uPlot;
    private shape = "";

    constructor(private readonly figure: HTMLElement, private readonly is_histogram = false) {
        new ResizeObserver(() => this.plot?.setSize(this.size)).observe(figure);
        matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.plot?.redraw());
    }

    private get size() { return { width: Math.max(this.figure.clientWidth, 60), height: plot_height }; }

    show(curves: Curve[], data: (number | null)[][], marked?: number) {
        this.marked = marked;
        const shape = JSON.stringify(curves);
        if (this.shape !== shape) {
            this.plot?.destroy();
            this.shape = shape;
            this.plot = this.make(curves);
        }
        this.plot!.setData(data as uPlot.AlignedData);
    }
    private marked?: number;

    private make(curves: Curve[]) {
        const axis = { stroke: () => css("var(--faint)"), grid: { stroke: () => css("var(--line)"), width: 1 }, ticks: { show: false }, font: "11px system-ui", values: (_: uPlot, marks: number[]) => marks.map(short) };
        const series = curves.map(({ name }, k) => ({
            label: name, stroke: () => css(colour_of_curve(k)), width: 1.5, points: { show: false }, value: (_: uPlot, value: number) => short(value),
            ...(this.is_histogram && { paths: uPlot.paths.bars!({ size: [1, 100] }), fill: () => css(`color-mix(in srgb, ${colour_of_curve(k)} 50%, transparent)`) }),
        }));
        return new uPlot({
            ...this.size, legend: { show: false }, cursor: { show: true, y: false, points: { show: false } },
            scales: { x: { time: false } }, series: [{ value: (_, value) => short(value) }, ...series],
            axes: [{ ...axis, size: 24, space: 60 }, { ...axis, size: 46, space: 26 }],
            hooks: { draw: [(plot) => this.draw_mark(plot)] },
        }, [[0]], this.figure);
    }

    /// A line across the plot, at a value of its axis.
    private draw_mark(plot: uPlot) {
        if (this.marked === undefined) return;
        const x = plot.valToPos(this.marked, "x", true), { ctx, bbox } = plot;
        ctx.save();
        ctx.strokeStyle = css("var(--accent)");
        ctx.lineWidth = devicePixelRatio;
        ctx.beginPath();
        ctx.moveTo(x, bbox.top);
        ctx.lineTo(x, bbox.top + bbox.height);
        ctx.stroke();
        ctx.restore();
    }
}

/// Draws how often two values occur together: darker for more cells.
export function draw_density(canvas: HTMLCanvasElement, counts: number[]) {
    const side = Math.round(Math.sqrt(counts.length)), most = Math.log(1 + Math.max(...counts));
    canvas.width = canvas.height = side;
    const context = canvas.getContext("2d")!, image = context.createImageData(side, side);
    counts.forEach((count, k) => {
        const row = side - 1 - Math.floor(k / side), at = 4 * (row * side + k % side);
        image.data.set([31, 138, 102, count === 0 ? 0 : 60 + 195 * Math.log(1 + count) / most], at);
    });
    context.putImageData(image, 0, 0);
}
