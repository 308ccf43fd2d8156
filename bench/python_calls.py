#!/usr/bin/env python3
"""What calls of the Python module cost: PYTHONPATH=build/release/python bench/python_calls.py.

Prints ratios of the least processor times of several repeats. The first lines give the overhead of
step(1) in a loop, compared with its share of step(5000), in empty calls of the module (at most 3 is
the goal; the C library pays for step(1), too: cascade_embedding_bench). The last line compares a copy
of a species of 2048 x 2048 cells with NumPy's own copy of it (at most 1.5 is the goal).
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
    view = cost(lambda: pattern["b"], 5000)
    print(f"{side}²: step(1) costs {(single - share) / empty:.2f} empty calls more than its step, a view {view / empty:.2f}; "
          f"an empty call costs {empty:.2f} µs, a step {share:.2f} µs")


def values(side):
    pattern = cascade.Pattern(f"domain {{ grid: {side}, {side} }}\nstage one: turing_spots {{ iterations: 1 }}")
    b = pattern["b"]
    own = cost(lambda: b.copy(), 4)
    print(f"{side}²: a copy costs {cost(lambda: pattern.values('b', copy=True), 4) / own:.2f} of NumPy's, "
          f"a view {cost(lambda: pattern['b'], 100) / own:.5f}; NumPy's copy costs {own:.0f} µs")


if __name__ == "__main__":
    for side in (32, 64):
        steps(side)
    values(2048)
