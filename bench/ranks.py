#!/usr/bin/env python3
"""What ranks cost: bench/ranks.py build/release/cascade [--side 2048] [--steps 200] [--turns 5] [--save FILE].

Takes steps of Gray and Scott's reaction on side x side cells, by turns in one process and on 2 and 4 ranks, each
with one thread, and prints processor seconds for a step, summed over the ranks. On ranks they are the times of kernels
and copies alone, because MPI uses the processor while it waits. The time in messages is given apart; it is long if
there are more ranks than idle cores. All are differences between a long and a short run, so that the start of a run
does not count. The bytes of halos are compared with theory. --save writes all numbers for bench/ranks_model.py.
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
    """What each rank has spent: processor and message seconds, bytes, and the exchanges of rank 0."""
    text = run([cascade, "run", script(side, steps, folder), "--ranks", str(ranks), "--threads", "1", "-q", "--timing"],
               folder)
    lines = re.findall(r"^  \d+ on \S+ +([\d.]+) ms +([\d.]+) ms +([\d,]+)$", text, re.MULTILINE)
    assert len(lines) == ranks, text
    exchanges = int(re.search(r"bytes of halos in (\d+) exchanges", text).group(1))
    return [{"processor": float(processor) / 1e3, "messages": float(messages) / 1e3,
             "bytes": int(sent.replace(",", "")), "exchanges": exchanges} for processor, messages, sent in lines]


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
    short, long = [], []
    shared_short, shared_long = {count: [] for count in counts}, {count: [] for count in counts}
    few, many = options.steps, 5 * options.steps  # The first steps try several tilings.
    with tempfile.TemporaryDirectory() as folder:
        for _ in range(options.turns):
            short.append(one_process(cascade, options.side, few, folder))
            long.append(one_process(cascade, options.side, many, folder))
            for count in counts:
                shared_short[count].append(on_ranks(cascade, count, options.side, few, folder))
                shared_long[count].append(on_ranks(cascade, count, options.side, many, folder))
    print(f"{options.side} x {options.side} cells, {many - few} steps, {options.turns} turns, "
          f"load {os.getloadavg()[0]:.1f} on {os.cpu_count()} cores")
    base = (min(long) - min(short)) / (many - few)
    print(f"one process   {1e3 * base:9.3f} ms of processor time a step")
    # Other programs only make times longer, so the least time of all turns counts.
    def of_step(count, rank, key):
        long_run, short_run = (min(turn[rank][key] for turn in turns[count]) for turns in (shared_long, shared_short))
        return (long_run - short_run) / (many - few)

    shared = {count: [{key: of_step(count, rank, key) for key in ("processor", "messages", "bytes")}
                      for rank in range(count)] for count in counts}
    for count in counts:
        total = sum(rank["processor"] for rank in shared[count])
        waits = [sum(rank["messages"] for rank in turn) / count / many for turn in shared_long[count]]
        print(f"{count} ranks       {1e3 * total:9.3f} ms of processor time a step: {total / base:.3f} of one process; "
              f"{1e3 * statistics.median(waits):.3f} ms in messages")
        sent = {rank["bytes"] for rank in shared[count]}
        exchanges = statistics.median(turn[0]["exchanges"] for turn in shared_long[count]) / many
        # For each step, two neighbours get a row of each species: T rows after T steps.
        theory = 2 * padded(options.side) * 4 * SPECIES
        print(f"              {', '.join(f'{each:,.0f}' for each in sorted(sent))} bytes of halos a step; theory "
              f"{theory:,.0f}; an exchange every {1 / exchanges:.1f} steps")
    if options.save:
        with open(options.save, "w", encoding="utf-8") as file:
            json.dump({"side": options.side, "steps": many - few, "alone": base,
                       "ranks": {str(count): shared[count] for count in counts},
                       "turns": {str(count): [sum(rank["processor"] for rank in turn) / many
                                              for turn in shared_long[count]] for count in counts}}, file, indent=1)


if __name__ == "__main__":
    main()
