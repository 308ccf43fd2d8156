// The camera of render/camera.cpp: it frames a surface from any direction, and can enlarge a part of the picture.

export type Vector = [number, number, number];
export const dot = (a: Vector, b: Vector) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const cross = (a: Vector, b: Vector): Vector => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
export const add = (a: Vector, b: Vector, factor = 1): Vector => [a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]];
export const unit = (a: Vector) => add([0, 0, 0], a, 1 / Math.hypot(...a));

const margin = 1.12, half_field = 0.22;

export class Camera {
    azimuth = 30;  ///< In degrees around the upward axis, from the front to the right.
    elevation = 25;
    zoom = 1;
    /// How far the enlarged picture is moved. The whole picture extends from −1 to 1 in both directions.
    right_by = 0;
    up_by = 0;
    right: Vector = [1, 0, 0];
    up: Vector = [0, 1, 0];
    backward: Vector = [0, 0, 1];
    eye: Vector = [0, 0, 1];
    private half_x = half_field;  ///< The tangent of half the field of view.
    private half_y = half_field;
    private near = 0.1;
    private far = 2;

    /// Moves the camera so that all positions fill the picture except for a margin.
    frame(places: Float32Array[], axis: "y" | "z", width: number, height: number) {
        const around = this.azimuth * Math.PI / 180, above = this.elevation * Math.PI / 180;
        const upward: Vector = axis === "y" ? [0, 1, 0] : [0, 0, 1], front: Vector = axis === "y" ? [0, 0, 1] : [0, -1, 0];
        const level = add(add([0, 0, 0], front, Math.cos(around)), cross(upward, front), Math.sin(around));
        this.backward = unit(add(add([0, 0, 0], level, Math.cos(above)), upward, Math.sin(above)));
        this.right = unit(cross(upward, this.backward));
        this.up = cross(this.backward, this.right);
        const smaller = Math.min(width, height), { right, up, backward } = this;
        this.half_x = half_field * width / smaller;
        this.half_y = half_field * height / smaller;
        const half_x = this.half_x / margin, half_y = this.half_y / margin;
        let [left, to_right, below, to_top, nearest, farthest] = Array(6).fill(-Infinity);
        for (const positions of places) for (let k = 0; k < positions.length; k += 3) {
            const p: Vector = [positions[k], positions[k + 1], positions[k + 2]];
            const x = dot(p, right), y = dot(p, up), z = dot(p, backward);
            left = Math.max(left, half_x * z - x);
            to_right = Math.max(to_right, half_x * z + x);
            below = Math.max(below, half_y * z - y);
            to_top = Math.max(to_top, half_y * z + y);
            nearest = Math.max(nearest, z);
            farthest = Math.max(farthest, -z);
        }
        const away = Math.max((left + to_right) / (2 * half_x), (below + to_top) / (2 * half_y));
        this.eye = add(add(add([0, 0, 0], right, (to_right - left) / 2), up, (to_top - below) / 2), backward, away);
        const size = nearest + farthest;
        this.near = Math.max(away - nearest - 0.1 * size, 0.01 * size);
        this.far = away + farthest + size;
    }

    /// The position of a point of space in the picture (−1 … 1 to the right and upwards), and its distance.
    project(place: Vector): Vector {
        const from = add(place, this.eye, -1), away = -dot(from, this.backward);
        return [
            dot(from, this.right) / away / this.half_x * this.zoom + this.right_by,
            dot(from, this.up) / away / this.half_y * this.zoom + this.up_by, away,
        ];
    }

    /// project() as a matrix for shaders, column by column.
    matrix(): Float32Array {
        const { right, up, backward, eye, near, far } = this;
        const rows = [
            add(add([0, 0, 0], right, this.zoom / this.half_x), backward, -this.right_by),
            add(add([0, 0, 0], up, this.zoom / this.half_y), backward, -this.up_by),
            add([0, 0, 0], backward, -(far + near) / (far - near)),
            add([0, 0, 0], backward, -1),
        ].map((row) => [...row, -dot(row, eye)]);
        rows[2][3] -= 2 * far * near / (far - near);
        return new Float32Array([0, 1, 2, 3].flatMap((column) => rows.map((row) => row[column])));
    }

    /// Moves the picture, but keeps its middle part visible.
    shift(right: number, up: number) {
        const inside = (by: number) => Math.min(Math.max(by, 1 - this.zoom), this.zoom - 1);
        this.right_by = inside(this.right_by + right);
        this.up_by = inside(this.up_by + up);
    }
}
