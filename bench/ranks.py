#!/usr/bin/env python3
"""What ranks cost: bench/ranks.py build/release/cascade [--side 2048] [--steps 200] [--turns 5] [--save FILE].

Takes steps of Gray and Scott's reaction on side x side cells, by turns in one process and on 2 and 4 ranks, each with
one thread, and prints processor seconds for a step, summed over the ranks. On ranks they are the times of kernels and
copies alone, because MPI uses the processor while it waits. The time in messages is given apart; it is long if there
are more ranks than idle cores. The bytes of halos are compared with theory. --save writes all numbers for
bench/ranks_model.py.
"""

import argparse
import json
import os
import re
import resource
import statistics
import subprocess
import tempfile

SPECIES = 2
ENVIRONMENT = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")


def children_seconds():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def run(command, folder):
    return subprocess.run(command, cwd=folder, env=ENVIRONMENT, text=True, capture_output=True, check=True).stderr


def script(side, steps, folder):
    path = os.path.join(folder, f"steps_{side}_{steps}.cascade")
    with open(path, "w", encoding="utf-8") as file:
        file.write(f"domain {{ grid: {side}, {side} }}\nstage s: gray_scott {{ iterations: {steps} }}\n")
    return path


def one_process(cascade, side, steps, folder):
    """Processor seconds of one process."""
    before = children_seconds()
    run([cascade, "run", script(side, steps, folder), "--threads", "1", "-q"], folder)
    return children_seconds() - before


def on_ranks(cascade, ranks, side, steps, folder):
    """What each rank has spent on a step: processor and message seconds and bytes."""
    text = run([cascade, "run", script(side, steps, folder), "--ranks", str(ranks), "--threads", "1", "-q", "--timing"],
               folder)
    lines = re.findall(r"^  \d+ on \S+ +([\d.]+) ms +([\d.]+) ms +([\d,]+)$", text, re.MULTILINE)
    assert len(lines) == ranks, text
    return [{"processor": float(processor) / 1e3 / steps, "messages": float(messages) / 1e3 / steps,
             "bytes": int(sent.replace(",", "")) / steps} for processor, messages, sent in lines]


def padded(side):
    """The numbers in a row in memory."""
    return (side + 15) // 16 * 16 + 32


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("cascade")
    parser.add_argument("--side", type=int, default=2048)
    parser.add_argument("--steps", type=int, default=200)
    parser.add_argument("--turns", type=int, default=5)
    parser.add_argument("--save")
    options = parser.parse_args()
    cascade = os.path.abspath(options.cascade)
    counts = (2, 4)
    short, long, shared = [], [], {count: [] for count in counts}
    few, many = 2 * options.steps, 10 * options.steps  # The first steps try several tilings.
    with tempfile.TemporaryDirectory() as folder:
        for _ in range(options.turns):
            short.append(one_process(cascade, options.side, few, folder))
            long.append(one_process(cascade, options.side, many, folder))
            for count in counts:
                shared[count].append(on_ranks(cascade, count, options.side, options.steps, folder))
    print(f"{options.side} x {options.side} cells, {options.steps} steps, {options.turns} turns, "
          f"load {os.getloadavg()[0]:.1f} on {os.cpu_count()} cores")
    # Other programs only make times longer, so the least ones count.
    base = (min(long) - min(short)) / (many - few)
    print(f"one process   {1e3 * base:9.3f} ms of processor time a step")
    for count in counts:
        sums = [sum(rank["processor"] for rank in turn) for turn in shared[count]]
        waits = [sum(rank["messages"] for rank in turn) / count for turn in shared[count]]
        print(f"{count} ranks       {1e3 * min(sums):9.3f} ms of processor time a step, at most {1e3 * max(sums):.3f}: "
              f"{min(sums) / base:.3f} of one process; {1e3 * statistics.median(waits):.3f} ms in messages")
        sent = {rank["bytes"] for turn in shared[count] for rank in turn}
        # Two neighbours get a row of each species after each step, and once at the start.
        theory = 2 * padded(options.side) * 4 * SPECIES * (options.steps + 1) / options.steps
        print(f"              {', '.join(f'{each:,.0f}' for each in sorted(sent))} bytes of halos a step; theory {theory:,.0f}")
    if options.save:
        with open(options.save, "w", encoding="utf-8") as file:
            json.dump({"side": options.side, "steps": options.steps, "alone": base,
                       "ranks": {str(count): shared[count] for count in counts}}, file, indent=1)


if __name__ == "__main__":
    main()
