#!/usr/bin/env python3
"""The time of a step on many ranks, on paper and simulated: bench/ranks_model.py MEASURED.json …

The files are written by bench/ranks.py --save. The first one on 2 ranks and the last one on 4 ranks give the constants
of the kernels, and the measured processor times of all files are compared with the model. Then the model is applied to
large grids on fast networks, and a simulator lets 1,000 virtual ranks take steps whose times are drawn from the
measured ones. All times are seconds for a step of a rank whose part has `rows` rows of `width` cells, with a halo of T
rows, exchanged every T steps:

  kernels    cell * width * rows
  fixed      seconds of a step that do not depend on the cells: starting kernels and messages
  repeated   cell * width * (T - 1): rows of the halo that both neighbours compute
  latency    latency * 2 * species / T: a message for each species and neighbour
  transfer   2 * species * width * bytes / bandwidth, which does not depend on T
  agreement  latency * 2 * log2(ranks) / batch: before each batch of steps, ranks learn how many steps it has, and
             after it whether all values are finite
  uneven     what the largest part has more than the mean: rows are whole

Cascade chooses T = 16, or fewer if parts have fewer than 128 rows (solvers/part_halos.h). Ranks compute nothing while
halos travel. A volume is a plane whose rows are slices, with `width` cells each.
"""

import argparse
import json
import math
import random

SPECIES = 2
BYTES = 4


class Machine:
    def __init__(self, cell, fixed, latency, bandwidth, batch):
        self.cell, self.fixed, self.latency, self.bandwidth, self.batch = cell, fixed, latency, bandwidth, batch

    def terms(self, width, rows, ranks, halo=1):
        """The terms of a step by name. `rows` are the rows of the whole grid."""
        own = rows / ranks
        neighbours = 2 if ranks > 1 else 0
        return {
            "kernels": self.cell * width * own,
            "fixed": self.fixed if ranks > 1 else 0,
            "repeated": self.cell * width * (halo - 1) if ranks > 1 else 0,
            "latency": self.latency * neighbours * SPECIES / halo,
            "transfer": neighbours * SPECIES * width * BYTES / self.bandwidth,
            "agreement": self.latency * 2 * math.ceil(math.log2(ranks)) / self.batch if ranks > 1 else 0,
            "uneven": self.cell * width * (math.ceil(own) - own),
        }


def halo_of(rows, ranks):
    """The rows of the halos that Cascade chooses for Euler's method."""
    return max(1, min(16, rows // ranks // 8)) if ranks > 1 else 1


def efficiency(terms):
    return terms["kernels"] / sum(terms.values())


def smallest_part(machine, width, ranks, least=0.95):
    """The fewest rows of a part with which `least` of the ideal is reached."""
    low, high = 1, 1 << 40
    while low < high:
        middle = (low + high) // 2
        halo = halo_of(middle * ranks, ranks)
        if efficiency(machine.terms(width, middle * ranks, ranks, halo)) >= least:
            high = middle
        else:
            low = middle + 1
    return low


def simulate(machine, width, rows, ranks, halo, factors, steps, seed=1):
    """Seconds for a step of ranks in a ring that wait for their neighbours. The time of each rank's kernels is the
    model's, multiplied by one of the measured factors."""
    draw = random.Random(seed)
    parts = [rows // ranks + (1 if rank < rows % ranks else 0) for rank in range(ranks)]
    terms = machine.terms(width, rows, ranks, halo)
    message = halo * (terms["latency"] + terms["transfer"])
    agreement = terms["agreement"] * machine.batch
    clocks = [0.0] * ranks
    for step in range(0, steps, halo):
        sent = [clock + message for clock in clocks]
        for rank in range(ranks):
            begin = max(clocks[rank], sent[rank - 1], sent[(rank + 1) % ranks]) if ranks > 1 else clocks[rank]
            for inner in range(halo):
                extra = 2 * (halo - 1 - inner) if ranks > 1 else 0
                begin += machine.cell * width * (parts[rank] + extra) * draw.choice(factors)
            clocks[rank] = begin + halo * terms["fixed"]
        if ranks > 1 and step // machine.batch != (step + halo) // machine.batch:
            clocks = [max(clocks) + agreement] * ranks
    return max(clocks) / steps


def read(path):
    with open(path, encoding="utf-8") as file:
        return json.load(file)


def kernels_of(measured, ranks):
    """The measured processor seconds for a step of each rank."""
    return [rank["processor"] for rank in measured["ranks"][ranks]]


def cells_of(measured, ranks):
    """The cells that a rank computes in a step, as the mean of the steps between two exchanges."""
    side = measured["side"]
    return side * (side / ranks + halo_of(side, ranks) - 1)


def compare(machine, measured):
    for ranks in sorted(measured["ranks"], key=int):
        found = min(kernels_of(measured, ranks))
        halo = halo_of(measured["side"], int(ranks))
        terms = machine.terms(measured["side"], measured["side"], int(ranks), halo)
        wanted = terms["kernels"] + terms["fixed"] + terms["repeated"]
        print(f"  {measured['side']:>6} x {measured['side']:<6} on {ranks} ranks: measured {1e3 * found:8.3f} ms, "
              f"model {1e3 * wanted:8.3f} ms, ratio {wanted / found:.3f}")
        sent = measured["ranks"][ranks][0]["bytes"]
        padded = (measured["side"] + 15) // 16 * 16 + 32
        wanted = 2 * SPECIES * padded * BYTES
        print(f"{'':>9}bytes of halos a step: measured {sent:,.0f}, model {wanted:,.0f}")


def tell(machine, name, width, rows, ranks, factors, steps):
    print(f"{name}: {width * rows:.1e} cells on {ranks} ranks, each with {rows / ranks:,.0f} rows of {width:,} cells")
    for halo in sorted({min(4, halo_of(rows, ranks)), halo_of(rows, ranks)}):
        terms = machine.terms(width, rows, ranks, halo)
        words = ", ".join(f"{key} {1e3 * value:.3g}" for key, value in terms.items())
        print(f"  T = {halo:<2}  {words} ms: {efficiency(terms):.3f} of ideal; 0.95 needs "
              f"{smallest_part(machine, width, ranks):,} rows a rank")
        if ranks <= 1000 and steps > 0:
            step = simulate(machine, width, rows, ranks, halo, factors, steps)
            ideal = machine.cell * width * rows / ranks
            print(f"          simulated {1e3 * step:.4g} ms a step: {ideal / step:.3f} of ideal")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("measured", nargs="+")
    parser.add_argument("--latency", type=float, default=2e-6, help="seconds of a short message")
    parser.add_argument("--bandwidth", type=float, default=10e9, help="bytes a second to both neighbours together")
    parser.add_argument("--cores", type=int, default=32, help="cores of a node, each as fast as the measured one")
    parser.add_argument("--batch", type=int, default=16, help="steps between two agreements")
    parser.add_argument("--steps", type=int, default=160, help="steps to simulate; 0: none")
    options = parser.parse_args()
    files = [read(path) for path in options.measured]
    first = files[0]
    # The constants are measured on the largest and the smallest part, and the other runs test them. Other programs only
    # make times longer, so the least one counts; the simulator draws from all of them.
    last = files[-1]
    least = min(kernels_of(first, "2"))
    many, few = cells_of(first, 2), cells_of(last, 4)
    cell = (least - min(kernels_of(last, "4"))) / (many - few)
    fixed = least - cell * many
    factors = [each / min(first["turns"]["2"]) for each in first["turns"]["2"]]
    print(f"kernels: {1e9 * cell:.3f} ns a cell and step on one core, and {1e6 * fixed:.0f} us a step; up to "
          f"{max(factors):.2f} times that in single runs")
    core = Machine(cell, fixed, options.latency, options.bandwidth, options.batch)
    for measured in files:
        compare(core, measured)
    node = Machine(cell / options.cores, fixed, options.latency, options.bandwidth, options.batch)
    print(f"nodes of {options.cores} such cores, {1e6 * options.latency:.1f} us, {options.bandwidth / 1e9:.1f} GB/s:")
    for name, width, rows, ranks in (("a plane", 100_000, 100_000, 16), ("a plane", 1_000_000, 1_000_000, 1000),
                                     ("a volume", 2160 * 2160, 2160, 16), ("a volume", 10_000 * 10_000, 10_000, 1000),
                                     ("Gray and Scott in a volume", 4096 * 4096, 4096, 64)):
        tell(node, name, width, rows, ranks, factors, options.steps)


if __name__ == "__main__":
    main()
