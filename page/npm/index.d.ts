/** Patterns that grow by reaction and diffusion, from a page of text. */

/** An error or a warning about a script. */
export interface Message {
    is_error: boolean;
    message: string;
    /** What to write instead. May be empty. */
    hint: string;
    /**
     * The start and end in the script: a line, from 1, and a column, from 0. Missing if the message
     * has no place.
     */
    from?: [number, number];
    to?: [number, number];
}

/** A script, an expression or a change is wrong, or a run has failed. */
export class CascadeError extends Error {
    readonly messages: Message[];
    constructor(messages: Message[]);
}

/** A parameter for which the script gives a range. */
export interface Control {
    /** The stage and the name, such as "spots.ka". */
    name: string;
    label: string;
    /** The number of the stage, from 1. */
    stage: number;
    /** The comment in the script that describes the parameter. May be empty. */
    doc: string;
    low: number;
    high: number;
    step?: number;
    value: number;
}

export interface Options {
    /** The name of the script in messages. */
    name?: string;
    /** Values of parameters and settings, as `cascade run --set` takes them: numbers or expressions. */
    set?: Record<string, number | string>;
    /** Replaces the script's seed of random numbers: a whole number of 32 bits. */
    seed?: number;
    /** Files that the script reads, by their names: NumPy arrays (.npy). */
    files?: Record<string, Uint8Array>;
    /**
     * Whether results have the bits of the program also where numbers are below 1.2e-38. Steps then
     * take eight times as long.
     */
    exact?: boolean;
}

/** The values of all cells, row by row and slice by slice. Crawling cells form one row. */
export interface Values {
    data: Float32Array;
    width: number;
    height: number;
    depth: number;
}

export interface PictureOptions {
    /** An expression instead of the script's picture. */
    show?: string;
    /** The name of a palette, such as "viridis". */
    palette?: string;
    /** The width of a cell in pixels. */
    scale?: number;
    /** The values at both ends of the palette. */
    range?: [number, number];
}

/** A script that runs. Calls return when their work is done. */
export class Pattern {
    private constructor();
    /** The warnings of the script. */
    readonly messages: Message[];
    readonly parameters: Control[];
    /** The names of the species of the present stage. */
    readonly species: string[];
    readonly stages: string[];
    /** The stage that takes steps now, or the last stage when all have finished. */
    readonly stage: string;
    /** The number of complete steps of the present stage. */
    readonly steps: number;
    /** Remarks about the result, one sentence each. */
    readonly remarks: string[];
    readonly finished: boolean;
    /**
     * Takes at most `count` steps, and continues with the next stage when one ends. Returns how
     * many were taken.
     */
    step(count?: number): number;
    /** Takes all steps. */
    run(): this;
    /**
     * The values of an expression, such as "b" or "a - b", in all cells. They are NaN outside a
     * mask.
     */
    values(expression: string): Values;
    /** The present picture as a PNG file. Surfaces in space cannot be drawn. */
    picture(options?: PictureOptions): Uint8Array;
    /** Wavelength, spots, area and other measures of the picture, or of an expression. */
    features(show?: string): Record<string, number>;
    /** Changes a parameter or setting: "ka" in all stages, or "spots.ka" in one. */
    set(name: string, value: number | string): void;
    /** Gives a species, a parameter that varies, or `frozen` the values of an expression of the present state. */
    paint(item: string, expression: string): void;
    /** Continues with another script. Items of the same name keep their values. */
    set_script(text: string): void;
    begin_next_stage(): void;
    undo(): void;
    redo(): void;
    /** The log of all steps and changes, which `cascade repl` repeats. */
    session(): string;
}

export class Cascade {
    private constructor();
    /** Loads the engine beside the package, or an engine from its bytes or its module. */
    static load(engine?: BufferSource | WebAssembly.Module): Promise<Cascade>;
    /** Checks a script and computes its starting values. Throws a CascadeError if it has errors. */
    pattern(script: string, options?: Options): Pattern;
    /** The errors and warnings of a script. */
    check(script: string, options?: Options): Message[];
}

/** The same as Cascade.load(). */
export function load(engine?: BufferSource | WebAssembly.Module): Promise<Cascade>;
