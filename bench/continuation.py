#!/usr/bin/env python3
"""The time of a point of `cascade continue`: bench/continuation.py build/release/cascade [--turns 3] [--points 100].

Follows a front of Allen and Cahn's equation, u' = p u - u^3 + lap(u), between sides without flux:

- on a line of 256 cells;
- on a plane of 128 x 128 cells, by turns with a program in SciPy (Debian's python3-scipy) below, which factorises the
  same Jacobians with splu: for each round of Newton's method with the row of the arc, for the tangent, and for the 16
  eigenvalues nearest to 0.

Prints the medians of the seconds of a point, and the ratio. Both programs compute the stability of each point, with one
thread.
"""

import argparse
import os
import statistics
import subprocess
import tempfile
import time

SPACING = 0.05
SCRIPT = """system front {{
  p: 0.64
  u: sqrt(p) * tanh(sqrt(p / 2) * (domain.x - domain.width / 2))
  u' = p * u - u^3 + lap(u)
}}
domain {{ grid: {width}, {height}; spacing: {spacing}; boundary: noflux }}
stage only: front {{ iterations: 1; speed: 0.0001 }}
"""
ONE_THREAD = dict(os.environ, OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1")


def difference(seconds_and_points, few, many):
    """The time of a point: that of many points less that of a few, which includes the start of the program."""
    first, rows_of_first = seconds_and_points(few)
    all_of_them, rows = seconds_and_points(many)
    return (all_of_them - first) / (rows - rows_of_first)


def cascade_point(cascade, folder, width, height, points):
    with open(os.path.join(folder, "front.cascade"), "w") as file:
        file.write(SCRIPT.format(width=width, height=height, spacing=SPACING))

    def follow(count):
        begin = time.perf_counter()
        subprocess.run([cascade, "continue", "front.cascade", "--vary", "p=0.3..1", "--points", str(count), "--step", "0.01",
                        "-q", "-o", "table.csv", "--threads", "1"], cwd=folder, env=ONE_THREAD, check=True,
                       stdout=subprocess.PIPE)
        with open(os.path.join(folder, "table.csv")) as file:
            rows = sum(1 for _ in file) - 1
        return time.perf_counter() - begin, rows

    return difference(follow, 1, max(2, points // 2))


class SciPy:
    """Pseudo-arclength continuation of the same states, with splu."""

    def __init__(self, side):
        import numpy
        from scipy import sparse
        self.numpy, self.sparse = numpy, sparse
        one = sparse.diags([numpy.ones(side - 1), -2 * numpy.ones(side), numpy.ones(side - 1)], [-1, 0, 1]).tolil()
        one[0, 0] = one[-1, -1] = -1
        eye = sparse.identity(side)
        self.laplacian = ((sparse.kron(eye, one) + sparse.kron(one, eye)) / SPACING**2).tocsc()
        x = (numpy.arange(side) + 0.5) * SPACING
        self.p = 0.64
        front = numpy.sqrt(self.p) * numpy.tanh(numpy.sqrt(self.p / 2) * (x - side * SPACING / 2))
        self.u = numpy.tile(front, side)
        self.scale = 1 / (self.u @ self.u)

    def whole(self, u, p, way):
        sparse, numpy = self.sparse, self.numpy
        jacobian = self.laplacian + sparse.diags(p - 3 * u**2)
        border = sparse.csc_matrix(numpy.append(self.scale * way[:-1], way[-1] / 0.49))
        return jacobian, sparse.vstack([sparse.hstack([jacobian, sparse.csc_matrix(u).T]), border]).tocsc()

    def tangent(self, u, p, way):
        from scipy.sparse.linalg import splu
        right = self.numpy.zeros(len(u) + 1)
        right[-1] = 1
        found = splu(self.whole(u, p, way)[1]).solve(right)
        return found / self.numpy.sqrt(self.length(found))

    def length(self, way):
        return self.scale * (way[:-1] @ way[:-1]) + way[-1]**2 / 0.49

    def follow(self, count):
        from scipy.sparse.linalg import eigs, splu
        numpy = self.numpy
        u, p = self.u.copy(), self.p
        way = numpy.zeros(len(u) + 1)
        way[-1] = 1
        begin = time.perf_counter()
        for number in range(count):
            if number > 0:
                u, p = u + 0.01 * way[:-1], p + 0.01 * way[-1]
            guess = numpy.append(u, p)
            for _ in range(12):
                jacobian, whole = self.whole(u, p, way)
                apart = numpy.append(u, p) - guess
                rest = self.scale * (way[:-1] @ apart[:-1]) + way[-1] * apart[-1] / 0.49
                rates = p * u - u**3 + self.laplacian @ u
                step = splu(whole).solve(-numpy.append(rates, rest))
                u, p = u + step[:-1], p + step[-1]
                if self.length(step) < 1e-18:
                    break
            way = self.tangent(u, p, way)
            eigs(self.laplacian + self.sparse.diags(p - 3 * u**2), k=16, sigma=1e-3, return_eigenvectors=False)
        return time.perf_counter() - begin, count

    def point(self, points):
        return difference(self.follow, 1, points)


def compared(name, peer_name, own, peer, turns):
    times = [(own(), peer()) for _ in range(turns)]
    own_time, peer_time = (statistics.median(column) for column in zip(*times))
    ratio = statistics.median(a / b for a, b in times)
    print(f"{name}: cascade {own_time:.4f} s a point, {peer_name} {peer_time:.4f} s, ratio {ratio:.3f}", flush=True)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("cascade")
    parser.add_argument("--turns", type=int, default=3)
    parser.add_argument("--points", type=int, default=100)
    parser.add_argument("--side", type=int, default=128)
    options = parser.parse_args()
    cascade = os.path.abspath(options.cascade)
    with tempfile.TemporaryDirectory() as folder:
        line = [cascade_point(cascade, folder, 256, 1, options.points) for _ in range(options.turns)]
        print(f"256 cells: cascade {statistics.median(line):.5f} s a point", flush=True)
        scipy = SciPy(options.side)
        few = max(6, options.points // 10)
        compared(f"{options.side} x {options.side} cells", "SciPy's splu",
                 lambda: cascade_point(cascade, folder, options.side, options.side, few), lambda: scipy.point(few),
                 options.turns)


if __name__ == "__main__":
    main()
