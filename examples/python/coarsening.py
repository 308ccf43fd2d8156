"""Measures how an alloy coarsens: fits L = a + b t^n to the first moment of its structure factor, over several seeds.

    python3 coarsening.py [CELLS [DURATION [SEEDS]]]        needs numpy and h5py; CASCADE names the program

The exponent of Lifshitz and Slyozov (1961) is n = 1/3. The window of the fit is the time from DURATION / 20 to
DURATION. Lengths at several times of one run depend on each other, so the error of n is taken from the seeds: the
standard deviation of the n of single runs, divided by the square root of their number. 64 cells, duration 400 and 2
seeds gave n = 0.337 ± 0.051; 128, 2000 and 5 gave 0.377 ± 0.045. Writes lengths.csv (time and
length for each seed), structure.csv (S over k) and pairs.csv (g over r), which are means over the seeds at the end.
"""

import csv
import os
import subprocess
import sys

import h5py
import numpy

cells, duration, seeds = (int(n) for n in (sys.argv[1:] + ["256", "4000", "10"][len(sys.argv) - 1 :]))
program = os.environ.get("CASCADE", "cascade")
times = duration * numpy.geomspace(1 / 20, 1, 25)

script = f"""
domain {{ grid: {cells}, {cells} }}
stage coarsening: cahn_hilliard {{ solver: etdrk4; speed: 0.2; duration: {duration} }}
"""


def lengths(seed):
    """Runs the script, and returns the lengths at `times` and the field at the end."""
    with open("coarsening.cascade", "w") as file:
        file.write(script)
    moments = ",".join(f"{time:.9g}" for time in times)
    subprocess.run(
        [program, "run", "coarsening.cascade", "-q", "--seed", str(seed), "--at", moments, "--log", "length",
         "--log-file", "log.csv", "--series", "coarsening.h5", "-o", "coarsening.png"],
        check=True,
    )
    with open("log.csv") as file:
        rows = [(float(row["t"]), float(row["length"])) for row in csv.DictReader(file)]
    with h5py.File("coarsening.h5") as file:
        field = file["c"][len(file["time"]) - 1].astype(float)
    logged = numpy.array(rows).T
    return numpy.interp(times, logged[0], logged[1]), field


def fit(values):
    """The n of the least squares of a + b t^n. For each n, a and b follow from linear equations."""

    def misfit(n):
        terms = numpy.column_stack([numpy.ones_like(times), times**n])
        return numpy.sum((terms @ numpy.linalg.lstsq(terms, values, rcond=None)[0] - values) ** 2)

    choices = numpy.linspace(0.05, 1, 20)
    step = choices[1] - choices[0]
    best = min(choices, key=misfit)
    while step > 1e-5:  # The smallest misfit lies between the neighbours of the best choice.
        choices = numpy.linspace(best - step, best + step, 21)
        step = choices[1] - choices[0]
        best = min(choices, key=misfit)
    return best


def mean_over_rings(values):
    """Means over the rings 0, 1, 2 … of waves, or of distances, in a periodic square of cells."""
    steps = numpy.minimum(numpy.arange(cells), cells - numpy.arange(cells))
    ring = numpy.rint(numpy.hypot(steps[:, None], steps[None, :])).astype(int).ravel()
    return (numpy.bincount(ring, values.ravel()) / numpy.bincount(ring))[: cells // 2 + 1]


def structure_factor(field):
    """S(k), the power of waves averaged over rings, for k = 0, 1/cells, 2/cells … waves in a cell."""
    return mean_over_rings(abs(numpy.fft.fft2(field - field.mean())) ** 2 / field.size)


def pair_correlation(field):
    """g(r), the correlation of cells at the distance r = 0, 1, 2 … cells."""
    power = abs(numpy.fft.fft2(field - field.mean())) ** 2
    pairs = numpy.fft.ifft2(power).real
    return mean_over_rings(pairs / pairs[0, 0])


def write(name, head, columns):
    with open(name, "w", newline="") as file:
        table = csv.writer(file)
        table.writerow(head)
        table.writerows(zip(*columns))


runs = [lengths(seed) for seed in range(1, seeds + 1)]
exponents = numpy.array([fit(values) for values, _ in runs])
write("lengths.csv", ["time"] + [f"seed {k + 1}" for k in range(seeds)], [times] + [values for values, _ in runs])
factors = numpy.mean([structure_factor(field) for _, field in runs], axis=0)
pairs = numpy.mean([pair_correlation(field) for _, field in runs], axis=0)
write("structure.csv", ["k", "S"], [numpy.arange(len(factors)) / cells, factors])
write("pairs.csv", ["r", "g"], [numpy.arange(len(pairs)), pairs])
error = exponents.std(ddof=1) / numpy.sqrt(seeds) if seeds > 1 else float("nan")
mean = fit(numpy.mean([values for values, _ in runs], axis=0))
print(f"n = {exponents.mean():.4f} ± {error:.4f} over {seeds} runs, window {times[0]:g} … {times[-1]:g}")
print(f"n = {mean:.4f} of the mean length, which is {runs[0][0][-1]:.2f} cells at the end of the first run")
