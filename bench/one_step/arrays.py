#!/usr/bin/env python3
"""Steps of Gray and Scott's reaction in Python: with lists, NumPy and Numba (docs/one_step.md).

    arrays.py VARIANT SIDE STEPS [FILE]

takes STEPS steps on SIDE × SIDE cells, prints the seconds of processor time that they took, and writes v to
FILE in single precision. Numba's compilation is not counted.
"""

import sys
import time

import numpy as np

diff_u, diff_v, feed, kill = (np.float32(number) for number in (0.16, 0.08, 0.037, 0.060))


def start(side):
    x = (np.arange(side) + 0.5) / side
    y = x[:, np.newaxis]
    cos, pi = np.cos, np.pi
    v = 0.2 + 0.1 * cos(10 * pi * x) * cos(6 * pi * y) + 0.05 * cos(4 * pi * x) * cos(14 * pi * y)
    return (1 - v).astype(np.float32), v.astype(np.float32)


# lines: Python's lists
def step_of_lists(u, v):
    n = len(u)
    next_u = [[0.0] * n for _ in range(n)]
    next_v = [[0.0] * n for _ in range(n)]
    for k in range(n):
        for i in range(n):
            left, right, above, below = i - 1, (i + 1) % n, k - 1, (k + 1) % n
            lap_u = u[k][left] + u[k][right] + u[above][i] + u[below][i] - 4 * u[k][i]
            lap_v = v[k][left] + v[k][right] + v[above][i] + v[below][i] - 4 * v[k][i]
            rate = u[k][i] * v[k][i] ** 2
            next_u[k][i] = u[k][i] + 0.16 * lap_u - rate + 0.037 * (1 - u[k][i])
            next_v[k][i] = v[k][i] + 0.08 * lap_v + rate - 0.097 * v[k][i]
    return next_u, next_v
# end


# lines: NumPy, np.roll
def lap(u):
    return np.roll(u, 1, 0) + np.roll(u, -1, 0) + np.roll(u, 1, 1) + np.roll(u, -1, 1) - 4 * u


def step_of_rolls(u, v):
    rate = u * v * v
    return u + diff_u * lap(u) - rate + feed * (1 - u), v + diff_v * lap(v) + rate - (feed + kill) * v
# end


# lines: NumPy, views and out=
def fill_border(plane):
    plane[0], plane[-1] = plane[-2], plane[1]
    plane[:, 0], plane[:, -1] = plane[:, -2], plane[:, 1]


def lap_of_views(plane, out):
    np.add(plane[:-2, 1:-1], plane[2:, 1:-1], out=out)
    out += plane[1:-1, :-2]
    out += plane[1:-1, 2:]
    out -= 4 * plane[1:-1, 1:-1]


def step_of_views(u, v, lap_u, lap_v, rate, work):
    fill_border(u)
    fill_border(v)
    lap_of_views(u, lap_u)
    lap_of_views(v, lap_v)
    inner_u, inner_v = u[1:-1, 1:-1], v[1:-1, 1:-1]
    np.multiply(inner_v, inner_v, out=rate)
    rate *= inner_u
    lap_u *= diff_u
    lap_u -= rate
    np.subtract(1, inner_u, out=work)
    work *= feed
    lap_u += work
    lap_v *= diff_v
    lap_v += rate
    np.multiply(inner_v, feed + kill, out=work)
    lap_v -= work
    inner_u += lap_u
    inner_v += lap_v
# end


# lines: Numba
def steps_of_numba(u, v, next_u, next_v, steps):
    n = u.shape[0] - 2
    for _ in range(steps):
        for plane in (u, v):
            plane[0], plane[-1] = plane[-2], plane[1]
            plane[:, 0], plane[:, -1] = plane[:, -2], plane[:, 1]
        for k in range(1, n + 1):
            for i in range(1, n + 1):
                a, b = u[k, i], v[k, i]
                lap_u = u[k, i - 1] + u[k, i + 1] + u[k - 1, i] + u[k + 1, i] - np.float32(4) * a
                lap_v = v[k, i - 1] + v[k, i + 1] + v[k - 1, i] + v[k + 1, i] - np.float32(4) * b
                rate = a * b * b
                next_u[k, i] = a + diff_u * lap_u - rate + feed * (np.float32(1) - a)
                next_v[k, i] = b + diff_v * lap_v + rate - (feed + kill) * b
        u, next_u = next_u, u
        v, next_v = next_v, v
    return v
# end


def padded(plane):
    return np.pad(plane, 1)


def lists(u, v, steps):
    u, v = u.tolist(), v.tolist()
    for _ in range(steps):
        u, v = step_of_lists(u, v)
    return lambda: np.array(v, np.float32)


def rolls(u, v, steps):
    for _ in range(steps):
        u, v = step_of_rolls(u, v)
    return lambda: v


def views(u, v, steps):
    space = [np.empty_like(u) for _ in range(4)]
    u, v = padded(u), padded(v)
    for _ in range(steps):
        step_of_views(u, v, *space)
    return lambda: v[1:-1, 1:-1]


def numba(u, v, steps):
    planes = [padded(u), padded(v), padded(u), padded(v)]
    end = compiled(*planes, steps)
    return lambda: end[1:-1, 1:-1]


variants = {"lists": lists, "rolls": rolls, "views": views, "numba": numba}

if __name__ == "__main__":
    if len(sys.argv) < 4 or sys.argv[1] not in variants:
        sys.exit(__doc__)
    side, steps = int(sys.argv[2]), int(sys.argv[3])
    if sys.argv[1] == "numba":
        from numba import njit

        compiled = njit(steps_of_numba)
        numba(*start(8), 1)
    u, v = start(side)
    begin = time.process_time()
    end = variants[sys.argv[1]](u, v, steps)
    print(f"{time.process_time() - begin:.6f}")
    if len(sys.argv) > 4:
        np.ascontiguousarray(end(), np.float32).tofile(sys.argv[4])
