"""Runs of a script with many combinations of values."""

import concurrent.futures
import itertools
import os
import threading

from ._core import Error
from ._pattern import Pattern


def sweep(script, vary, *, show="", measure=None, threads=0, **arguments):
    """Runs a script with all combinations of values, several runs at a time, and returns a table.

    `vary` gives lists of values for parameters, settings or the seed, such as
    {"ka": [1/80, 1/60], "seed": range(3)}. The last one varies fastest. Each run is a row with its
    values, the features of the picture or of the expression `show`, the steps of the last stage, and
    a "remark". The remark of a run that failed is its error, and it has no features. `measure` is a
    function that receives the finished pattern and returns a dictionary with further columns. Other
    arguments are passed to Pattern.

    The table is a pandas.DataFrame if pandas is installed, and otherwise a list of dictionaries.
    `threads` is the number of runs at the same time. 0 means as many as there are processors.
    """
    names = list(vary)
    is_stopped = threading.Event()

    def row_of(values):
        row = dict(zip(names, values))
        pattern = Pattern(script, threads=1, **arguments, **row)
        try:
            pattern.run(lambda progress: not is_stopped.is_set())
        except Error as error:
            return row | {"remark": error.message}
        row |= pattern.features(show)
        row |= {"steps": pattern.steps, "remark": "; ".join(pattern.remarks)}
        return row | (measure(pattern) if measure else {})

    with concurrent.futures.ThreadPoolExecutor(threads or os.cpu_count()) as workers:
        runs = [workers.submit(row_of, values) for values in itertools.product(*vary.values())]
        try:
            rows = [run.result() for run in runs]
        except BaseException:
            is_stopped.set()
            workers.shutdown(wait=False, cancel_futures=True)
            raise
    try:
        import pandas
    except ImportError:
        return rows
    return pandas.DataFrame(rows)
