"""Cascade: patterns that grow, from a page of text.

    import cascade
    spots = cascade.Pattern("stage one: turing_spots { iterations: 6000 }", ka=1/80)
    spots.run()
    spots.values("b")          # a NumPy array
    spots                      # in a notebook: its picture

docs/python.md of the sources has more. A wrong script, expression or change raises cascade.Error.
"""

import concurrent.futures
import itertools
import json
import os
import sys
import threading

from . import _core
from ._core import Error, Message, Parameter, Progress, __version__

__all__ = ["Error", "Message", "Parameter", "Parameters", "Pattern", "Progress", "__version__", "sweep"]


class Parameters:
    """The parameters of a pattern: by 'stage.name', or by the name alone for the current stage.

    pattern.parameters["ka"] and pattern.parameters.ka are Parameter objects, which have value, low,
    high, step and doc. Assigning a number or an expression sets one: pattern.parameters.ka = 1/80.
    """

    def __init__(self, pattern):
        object.__setattr__(self, "_pattern", pattern)

    def __iter__(self):
        return (f"{p.stage}.{p.name}" for p in self._pattern._parameters())

    def __len__(self):
        return len(self._pattern._parameters())

    def __getitem__(self, name):
        stage, dot, short = name.partition(".")
        if not dot:
            stage, short = self._pattern.stage, name
        for parameter in self._pattern._parameters():
            if parameter.stage == stage and parameter.name == short:
                return parameter
        raise KeyError(name)

    def __setitem__(self, name, value):
        self._pattern.set(name, value)

    def __getattr__(self, name):
        try:
            return self[name]
        except KeyError:
            raise AttributeError(f"stage '{self._pattern.stage}' has no parameter '{name}'") from None

    def __setattr__(self, name, value):
        self[name] = value

    def __dir__(self):
        stage = self._pattern.stage
        return [p.name for p in self._pattern._parameters() if p.stage == stage]

    def __repr__(self):
        return "\n".join(
            f"{p.stage}.{p.name} = {p.value:.9g}" + (f"  in {p.low:g} .. {p.high:g}" if p.low is not None else "")
            + (f"  {p.doc}" if p.doc else "")
            for p in self._pattern._parameters())


class Pattern(_core.Pattern):
    """A script that runs.

    `script` is the text of a script, or the path of one, of a picture that carries one, of a session
    or of the folder of a saved run. A string without a line end, colon or brace is a path, and so is
    anything that os.fspath() takes.

    Keywords are parameters or settings, as `--set` takes them: numbers, or expressions as strings.
    `**{"spots.ka": 1/80}` sets one of one stage. `seed` is that of all random numbers, in place of the
    script's. Paths in a text are relative to `folder`. `threads` 0 means all; native=False interprets
    the equations. No result depends on the last two.
    """

    def __init__(self, script, *, folder=".", seed=None, threads=0, native=True, **parameters):
        sets = [f"{name}={_expression(value)}" for name, value in parameters.items()]
        if isinstance(script, str) and any(letter in script for letter in "\n:{"):
            super().__init__(script, os.fspath(folder), threads, native, sets, seed)
        else:
            super().__init__(path=os.fspath(script), threads=threads, native=native, sets=sets, seed=seed)

    @classmethod
    def play(cls, session, *, folder=".", threads=0, native=True):
        """The pattern at the end of a session: what session() gives, or the bytes of a picture."""
        pattern = cls.__new__(cls)
        if isinstance(session, str):
            session = session.encode()
        _core.Pattern.__init__(pattern, session=session, folder=os.fspath(folder), threads=threads, native=native)
        return pattern

    def run(self, progress=False):
        """Takes all steps, and returns the pattern.

        progress=True draws a bar on standard error; a function gets the Progress ten times a second,
        and ends the call where it returns False. Ctrl-C ends it after the present step. In both cases
        a later run() goes on.
        """
        watch = _Bar() if progress is True else progress or None
        try:
            self.step(2**63 - 1, watch)
        finally:
            if progress is True:
                watch.end()
        return self

    @property
    def parameters(self):
        """The parameters with their values, ranges and docs; see Parameters."""
        return Parameters(self)

    def __setitem__(self, item, expression):
        self.paint(item, expression)

    def analyze(self, stage=""):
        """What will grow in a stage, or in the first one, before it runs: a dictionary, as
        `cascade analyze --json` writes it."""
        return json.loads(self._analysis(stage, True))

    def __repr__(self):
        return f"<cascade.Pattern: stage '{self.stage}', step {self.steps}, cells {self.shape}>"


def sweep(script, vary, *, show="", measure=None, threads=0, **arguments):
    """Runs a script with all combinations of values, several runs at a time, and returns a table.

    vary={"ka": [1/80, 1/60], "seed": range(3)} names parameters, settings or the seed; the last one
    varies fastest. Each run is a row: the values, the features of the picture or of the expression
    `show`, the steps of the last stage, and as "remark" why it failed, or the remarks on it. A run
    that fails has no features. `measure` is a function of the finished pattern and returns a
    dictionary of more columns. Other arguments are those of Pattern.

    The table is a pandas.DataFrame where pandas is installed, otherwise a list of dictionaries.
    `threads` is the number of runs at a time, 0 for as many as there are processors.
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


def _expression(value):
    return value if isinstance(value, str) else repr(float(value))


class _Bar:
    """Draws the progress of a run in a line of standard error."""

    def __init__(self):
        self._width = 0

    def __call__(self, now):
        share = now.t / now.duration if now.duration else now.step / max(now.steps, 1)
        filled = int(24 * min(share, 1))
        left = f", {now.seconds_left:.0f} s left" if now.seconds_left >= 0 else ""
        line = f"{now.stage} [{'#' * filled}{'.' * (24 - filled)}] step {now.step} of {now.steps}{left}"
        print("\r" + line.ljust(self._width), end="", file=sys.stderr, flush=True)
        self._width = len(line)

    def end(self):
        if self._width:
            print(file=sys.stderr)
