// Exercises in the comments of a script: their texts, goals and locked lines (spec/page.md).

export interface Goal { feature: string; low: number; high: number }

/// Texts by language. The text of "" is used for all languages without a text.
export type Texts = Record<string, string>;
export interface Exercise { title: Texts; task: Texts; hint: Texts; target: string; goals: Goal[]; wrong: string[] }

export const features = ["wavelength", "spots", "holes", "area", "angle", "anisotropy", "mean", "deviation", "smallest", "largest"];

const number = String.raw`([-+]?(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?)`;
const between = new RegExp(`^(\\w+)\\s+in\\s+${number}\\s*\\.\\.\\s*${number}$`);
const beyond = new RegExp(`^(\\w+)\\s*([<>])\\s*${number}$`);

function goal_of(text: string): Goal | undefined {
    const range = between.exec(text), side = beyond.exec(text);
    const goal = range ? { feature: range[1], low: Number(range[2]), high: Number(range[3]) }
        : side ? { feature: side[1], low: side[2] === ">" ? Number(side[3]) : -Infinity, high: side[2] === "<" ? Number(side[3]) : Infinity } : undefined;
    return goal && features.includes(goal.feature) && goal.low < goal.high ? goal : undefined;
}

const begins = /^#\s*exercise(?:\s+([a-z]{2}))?\s*:/, entry = /^#\s*(exercise|task|hint|goal|target)(?:\s+([a-z]{2}))?\s*:\s*(.*?)\s*$/;

/// The lines of the comment that contains an exercise, counted from 0: the first line, and the line after the last one.
function lines_of(lines: string[]): [number, number] | undefined {
    const first = lines.findIndex((line) => begins.test(line));
    if (first < 0) return undefined;
    const length = lines.slice(first).findIndex((line) => !line.startsWith("#"));
    return [first, length < 0 ? lines.length : first + length];
}

/// The exercise of a script, or undefined if there is none. A line without a word before a ':'
/// continues the text of the line before it.
export function exercise_of(script: string): Exercise | undefined {
    const lines = script.split("\n"), range = lines_of(lines);
    if (!range) return undefined;
    const found: Exercise = { title: {}, task: {}, hint: {}, target: "", goals: [], wrong: [] };
    let last: { texts: Texts; language: string } | undefined;
    for (const line of lines.slice(...range)) {
        const [, word, language = "", text] = entry.exec(line) ?? [];
        if (!word) {
            if (is_lock(line) || is_end_of_lock(line)) break;
            if (last) last.texts[last.language] += ` ${line.replace(/^#\s*/, "").trim()}`;
            continue;
        }
        last = undefined;
        if (word === "target") found.target = text;
        else if (word === "goal") {
            const goal = goal_of(text);
            if (goal) found.goals.push(goal);
            else found.wrong.push(text);
        } else {
            const texts = word === "exercise" ? found.title : word === "task" ? found.task : found.hint;
            texts[language] = text;
            last = { texts, language };
        }
    }
    return found;
}

const is_lock = (line: string) => /^#\s*locked\s*$/.test(line), is_end_of_lock = (line: string) => /^#\s*open\s*$/.test(line);

/// The parts that no user may change, as offsets from the start of a line to the end of a line: the exercise itself,
/// and the lines from `# locked` to `# open` or the end. Empty for scripts without an exercise.
export function locked_parts(script: string): [from: number, to: number][] {
    const lines = script.split("\n"), exercise = lines_of(lines);
    if (!exercise) return [];
    const parts: [number, number][] = [];
    let offset = 0, is_locked = false, was_locked = false;
    lines.forEach((line, k) => {
        if (is_lock(line)) is_locked = true;
        const is_held = is_locked || (k >= exercise[0] && k < exercise[1]);
        if (is_held && was_locked) parts[parts.length - 1][1] = offset + line.length;
        else if (is_held) parts.push([offset, offset + line.length]);
        was_locked = is_held;
        if (is_end_of_lock(line)) is_locked = false;
        offset += line.length + 1;
    });
    return parts;
}

/// Whether a change of a text from `from` to `to` touches a locked part. Text that a learner writes directly beside a
/// locked part would join its line, so the ends count too.
export const touches = (parts: [number, number][], from: number, to: number) => parts.some(([begin, end]) => to >= begin && from <= end);

export const text_in = (texts: Texts, language: string) => texts[language.slice(0, 2)] ?? texts[""] ?? Object.values(texts)[0] ?? "";
