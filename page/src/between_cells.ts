// Values between the centres of a plane's cells, as in `cascade run --size`: the cubic curves of core/between_cells.h,
// first along columns, then along rows.

/// A plane: `rows` rows of `columns` numbers.
export interface Values { columns: number; rows: number; numbers: Float32Array }

const beyond = 3;  ///< How many cells beyond a side the curves read.

/// The cell whose value is used for a position beyond a side: a cell at the opposite side if the
/// plane repeats, otherwise the nearest cell of the plane.
export const inside = (place: number, count: number, repeats: boolean) =>
    repeats ? (place % count + count) % count : Math.min(Math.max(place, 0), count - 1);

/// The slope at the middle one of five cells, as the change from one cell to the next.
function slope_in(a: number, b: number, c: number, d: number, e: number): number {
    const before = c - b, after = d - c, bend = after - before, left = before - (b - a), right = e - d - after;
    let least = bend, largest = bend;
    if (left < least) least = left;
    if (left > largest) largest = left;
    if (right < least) least = right;
    if (right > largest) largest = right;
    const smaller = Math.abs(Math.abs(before) < Math.abs(after) ? before : after);
    const most = Math.max(3 * smaller, least, -largest), slope = (before + after) / 2;
    return slope > most ? most : slope < -most ? -most : slope;
}

/// Divides a cell into `scale` parts. Returns for the centre of each part the last cell whose
/// centre is before it, counted from the divided cell, and the weights of the rise to the next cell
/// and of the slopes in both cells.
function parts_of_cell(scale: number) {
    return Array.from({ length: scale }, (_, k) => {
        const place = (k + 0.5) / scale - 0.5, before = Math.floor(place), part = place - before, rest = 1 - part;
        return { before, rise: part * part * (3 - 2 * part), first: part * rest * rest, last: -part * part * rest };
    });
}

/// The values at the centres of `scale` × `scale` parts of each cell. All numbers must be finite. The last argument
/// says whether rows repeat and whether columns repeat.
export function divided({ columns, rows, numbers }: Values, scale: number, [across, down]: [boolean, boolean]): Values {
    const parts = parts_of_cell(scale), width = columns * scale, result = new Float32Array(width * rows * scale);
    const start = (row: number) => columns * inside(row, rows, down);
    // The first row of slopes is that of row −1, which the first parts need.
    const slopes = new Float32Array(columns * (rows + 2));
    for (let row = -1; row <= rows; ++row) {
        const [a, b, c, d, e] = [-2, -1, 0, 1, 2].map((away) => start(row + away)), at = columns * (row + 1);
        for (let k = 0; k < columns; ++k) slopes[at + k] = slope_in(numbers[a + k], numbers[b + k], numbers[c + k], numbers[d + k], numbers[e + k]);
    }
    const line = new Float64Array(columns + 2 * beyond), along = new Float64Array(columns + 2);
    for (let row = 0, out = 0; row < rows * scale; ++row) {
        const part = parts[row % scale], before = Math.floor(row / scale) + part.before;
        const from = start(before), to = start(before + 1), at = columns * (before + 1);
        for (let k = 0; k < columns; ++k) {
            line[beyond + k] = numbers[from + k] + part.rise * (numbers[to + k] - numbers[from + k]) + part.first * slopes[at + k] + part.last * slopes[at + columns + k];
        }
        for (let k = 1; k <= beyond; ++k) {
            line[beyond - k] = line[beyond + inside(-k, columns, across)];
            line[beyond + columns - 1 + k] = line[beyond + inside(columns - 1 + k, columns, across)];
        }
        for (let k = 0; k < along.length; ++k) along[k] = slope_in(line[k], line[k + 1], line[k + 2], line[k + 3], line[k + 4]);
        for (let k = 0; k < columns; ++k) {
            for (let p = 0; p < scale; ++p, ++out) {
                const { before, rise, first, last } = parts[p], cell = k + before, value = line[beyond + cell];
                result[out] = value + rise * (line[beyond + cell + 1] - value) + first * along[cell + 1] + last * along[cell + 2];
            }
        }
    }
    return { columns: width, rows: rows * scale, numbers: result };
}

const largest = 1e30;  ///< Replaces infinity, since curves need finite values.

function are_plain(numbers: Float32Array): boolean {
    for (let k = 0; k < numbers.length; ++k) if (!(Math.abs(numbers[k]) <= largest)) return false;
    return true;
}

/// A plane of finite numbers. Cells without a value (NaN) get the mean of their neighbours, as far
/// as curves read them. `there` is 1 in cells with a value and 0 in others. It is undefined if all
/// cells have a value.
export function filled({ columns, rows, numbers }: Values, [across, down]: [boolean, boolean]): { values: Values; there?: Values } {
    if (are_plain(numbers)) return { values: { columns, rows, numbers } };
    let found = numbers.map((number) => Number.isNaN(number) ? NaN : Math.min(Math.max(number, -largest), largest));
    const there = found.map((number) => Number(!Number.isNaN(number)));
    for (let ring = 0; ring < beyond; ++ring) {
        const before = found;
        found = before.map((number, cell) => {
            if (!Number.isNaN(number)) return number;
            const row = Math.floor(cell / columns), column = cell - columns * row;
            let sum = 0, count = 0;
            for (const [right, below] of [[-1, 0], [1, 0], [0, -1], [0, 1], [-1, -1], [1, -1], [-1, 1], [1, 1]]) {
                const near = before[columns * inside(row + below, rows, down) + inside(column + right, columns, across)];
                if (Number.isNaN(near)) continue;
                sum += near;
                ++count;
            }
            return count > 0 ? sum / count : NaN;
        });
    }
    const numbers_found = found.map((number) => Number.isNaN(number) ? 0 : number);
    return { values: { columns, rows, numbers: numbers_found }, there: { columns, rows, numbers: there } };
}
