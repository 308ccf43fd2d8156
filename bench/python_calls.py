#!/usr/bin/env python3
"""What calls of the Python module cost: PYTHONPATH=build/release/python bench/python_calls.py.

Least processor time of several repeats, in microseconds. The first table compares step(1) in a loop
with its share of step(5000), and with calls that do nothing; the C library pays for step(1), too
(cascade_embedding_bench). The second compares the values of a species of 2048 x 2048 cells with a
copy by NumPy.
"""

import time

import cascade


def cost(call, count, repeats=15):
    best = float("inf")
    for _ in range(repeats):
        start = time.process_time()
        for _ in range(count):
            call()
        best = min(best, (time.process_time() - start) / count)
    return best * 1e6


def steps(side):
    pattern = cascade.Pattern(f"domain {{ grid: {side}, {side} }}\nstage one: turing_spots {{ iterations: 1000000000 }}",
                              threads=1)
    pattern.step(20000)
    empty = cost(lambda: pattern.steps, 20000)
    single = cost(lambda: pattern.step(1), 5000)
    share = cost(lambda: pattern.step(5000), 1) / 5000
    print(f"{side}²: step(1) {single:.2f}, of step(5000) {share:.2f}, an empty call {empty:.2f}, "
          f"a view {cost(lambda: pattern['b'], 5000):.2f}")


def values(side):
    pattern = cascade.Pattern(f"domain {{ grid: {side}, {side} }}\nstage one: turing_spots {{ iterations: 1 }}")
    b = pattern["b"]
    print(f"{side}²: a view {cost(lambda: pattern['b'], 100):.2f}, "
          f"a copy {cost(lambda: pattern.values('b', copy=True), 4):.0f}, "
          f"NumPy's own {cost(lambda: b.copy(), 4):.0f}")


if __name__ == "__main__":
    for side in (32, 64):
        steps(side)
    values(2048)
