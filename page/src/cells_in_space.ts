// The positions in space of cells that crawl, and the floor below the cells if there is no model.
import { type Vector, add, cross, dot } from "./camera";
import type { Cells, Surface } from "./connection";

const numbers_of_placement = 10;
const place_at = ({ placements }: Cells, k: number): Vector => {
    const at = numbers_of_placement * k;
    return [placements[at], placements[at + 1], placements[at + 2]];
};

/// The positions in space of each copy's outermost vertices in 26 directions, or in 6 directions if
/// there are many copies.
export function corners_of(cells: Cells): Float32Array {
    const sides = [-1, 0, 1], { positions, triangles, placements } = cells;
    const directions = sides.flatMap((x) => sides.flatMap((y) => sides.map((z): Vector => [x, y, z])))
        .filter((direction) => dot(direction, direction) > 0 && (cells.cells.length < 5000 || dot(direction, direction) === 1));
    const found: number[] = [];
    cells.ends.forEach((end, k) => {
        const first = k === 0 ? 0 : cells.ends[k - 1], triangle = k === 0 ? 0 : cells.triangle_ends[k - 1];
        const vertices = [...new Set(triangles.subarray(3 * triangle, 3 * cells.triangle_ends[k]))];
        if (end === first || vertices.length === 0) return;
        const place = (vertex: number): Vector => [positions[3 * vertex], positions[3 * vertex + 1], positions[3 * vertex + 2]];
        const farthest = new Set(directions.map((direction) => vertices.reduce((a, b) => dot(direction, place(b)) > dot(direction, place(a)) ? b : a)));
        const corners = [...farthest].map(place);
        for (let copy = first; copy < end; ++copy) {
            const [turn_x, turn_y, turn_z, w, ...stretch] = placements.subarray(numbers_of_placement * copy + 3, numbers_of_placement * (copy + 1));
            const turn: Vector = [turn_x, turn_y, turn_z], spot = place_at(cells, copy);
            for (const [x, y, z] of corners) {
                const along: Vector = [stretch[0] * x, stretch[1] * y, stretch[2] * z], half = cross(turn, along);
                found.push(...add(add(add(spot, along), half, 2 * w), cross(turn, half), 2));
            }
        }
    });
    return Float32Array.from(found);
}

/// The drawn cell that is nearest to a point.
export function nearest_cell(cells: Cells, [x, y, z]: Vector): number {
    let nearest = Infinity, found = 0;
    cells.cells.forEach((cell, k) => {
        const place = place_at(cells, k), away = (place[0] - x) ** 2 + (place[1] - y) ** 2 + (place[2] - z) ** 2;
        if (away < nearest) [nearest, found] = [away, cell];
    });
    return found;
}

/// Half of the width of a cell, or 0 if the cell is not drawn.
export function half_width(cells: Cells, cell: number): number {
    const k = cells.cells.indexOf(cell);
    return k < 0 ? 0 : cells.placements[numbers_of_placement * k + 7];
}

/// The position of a cell, or undefined if the cell is not drawn.
export function place_of_cell(cells: Cells, cell: number): Vector | undefined {
    const k = cells.cells.indexOf(cell);
    return k < 0 ? undefined : place_at(cells, k);
}

/// The floor below cells on a plane or in a box of space. The corners of the box are only used to
/// frame the picture. The y axis of scripts points towards the viewer.
export function floor_of([wide, deep, high]: Vector): Surface {
    const corners: Vector[] = [[0, 0, 0], [0, 0, deep], [wide, 0, deep], [wide, 0, 0]];
    // The floor is slightly above the ground, on which shadows fall.
    const others: Vector[] = high > 0 ? corners.map(([x, , z]) => [x, high, z]) : [[wide / 2, -0.01, deep / 2]];
    const positions = [...corners, ...others];
    return {
        number: 0, up: "y", spacing: 0, positions: new Float32Array(positions.flat()),
        normals: new Float32Array(positions.flatMap(() => [0, 1, 0])), triangles: new Uint32Array(high > 0 ? [] : [0, 1, 2, 0, 2, 3]),
        ends: new Uint32Array(positions.length), cells: new Uint32Array(), weights: new Float32Array(),
    };
}
