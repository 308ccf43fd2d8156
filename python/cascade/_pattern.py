"""The class Pattern."""

import json
import os
import pathlib
import tempfile
import typing

import numpy

from . import _core
from ._bar import Bar
from ._parameters import Parameters
from ._shown import Film, Page


class Model(typing.NamedTuple):
    """The cells and triangles of a model, as arrays.

    Positions are (x, y, z) in the coordinates of scripts: 0 to 1 along the longest side of the
    model's box, with y upwards.
    """

    points: numpy.ndarray
    """(cells, 3): the positions of the cells, in the order of Pattern.values()."""
    areas: numpy.ndarray
    """(cells,): the areas of the cells, in the square of the unit of positions."""
    links: numpy.ndarray
    """(links, 2): pairs of adjacent cells, between which species diffuse; the lower cell is first."""
    weights: numpy.ndarray
    """(links,): the length of the edge between both cells, divided by their distance."""
    vertices: numpy.ndarray
    """(vertices, 3): the points of the model's triangles."""
    triangles: numpy.ndarray
    """(triangles, 3): the vertices of each triangle, counterclockwise seen from outside."""


class Pattern(_core.Pattern):
    """A script that runs.

    `script` is the text of a script, or a path. The path may lead to a script, to a picture that
    contains one, to a session or to the folder of a saved run. A string without a line break, colon
    or brace is a path, and so is any object that os.fspath() accepts.

    Keywords set parameters or settings, as `--set` does, to numbers or to expressions in strings.
    `**{"spots.ka": 1/80}` sets a parameter of a single stage. An array gives a species of the first
    stage its starting values, or a parameter its values in all cells (see paint()). `seed` replaces
    the script's seed of random numbers. Relative paths in a script that is given as text start at
    `folder`. `threads=0` uses all threads of the machine, and `native=False` interprets the
    equations. No result depends on these two.
    """

    def __init__(self, script, *, folder=".", seed=None, threads=0, native=True, **parameters):
        arrays = {name: value for name, value in parameters.items() if _has_sides(value)}
        sets = [f"{name}={_expression(value)}" for name, value in parameters.items() if name not in arrays]
        self._folder = os.fspath(folder)
        if isinstance(script, str) and any(letter in script for letter in "\n:{"):
            super().__init__(script, self._folder, threads, native, sets, seed)
        else:
            path = os.fspath(script)
            self._folder = os.path.dirname(path) or "."
            super().__init__(path=path, threads=threads, native=native, sets=sets, seed=seed)
        for name, values in arrays.items():
            self.paint(name.removeprefix(f"{self.stages[0]}."), values)

    @classmethod
    def play(cls, session, *, folder=".", threads=0, native=True):
        """Plays a session and returns the pattern at its end. `session` is the result of session(), or
        the bytes of a picture."""
        pattern = cls.__new__(cls)
        if isinstance(session, str):
            session = session.encode()
        pattern._folder = os.fspath(folder)
        _core.Pattern.__init__(pattern, session=session, folder=pattern._folder, threads=threads, native=native)
        return pattern

    def __reduce__(self):
        # The session grows the same pattern again, bit for bit, in any process.
        return _played, (type(self), self.session(), os.path.abspath(self._folder))

    def run(self, progress=False):
        """Takes all steps, and returns the pattern.

        With progress=True, draws a bar on standard error. If `progress` is a function, it receives a
        Progress ten times a second, and ends the call by returning False. Ctrl-C ends the call after
        the present step. In both cases a later run() continues.
        """
        with Bar.watching(progress) as watch:
            self.step(2**63 - 1, watch)
        return self

    @property
    def parameters(self):
        """The parameters with their values, ranges and descriptions (see Parameters)."""
        return Parameters(self)

    def paint(self, item, values):
        """Gives the cells new values of a species, of a parameter that varies, or of `frozen`.

        `values` is an expression of the present state of the current stage, such as
        'if(disc(0.5, 0.5, 0.1) > 0, 8, b)', or a number, or an array with the shape of values(item)
        and real numbers of any type. Numbers must be finite, except outside the domain's mask, where
        they are ignored. Before the first step, the values are the starting values.
        """
        if _has_sides(values):
            self._set_values(item, _plain_array(values))
        else:
            self._paint(item, _expression(values))

    def __setitem__(self, item, values):
        self.paint(item, values)

    def save(self, folder):
        """Saves all values in a folder. Pattern(folder) and `cascade run --resume` continue from it."""
        self._save(os.fspath(folder))

    def write(self, path, **options):
        """Writes the present moment to a file in the format of its ending, as `cascade run -o` does.

        Possible endings: .png for pictures, .svg and .pdf for figures, .glb, .ply, .obj, .vtp and .stl
        for models, .npz and .cells.vtp for crawling cells, .vti and .vdb for volumes. `options` have
        the names and values of the options of `cascade run`: show="a - b", palette="viridis", range=(0, 8),
        size=(800, 800), bake=2048, and others. With turntable=N, a film shows N directions.
        """
        self._write(os.fspath(path), _options(options))

    def write_picture(self, path, expression=""):
        """Writes picture() to a file whose name ends in .png."""
        self._write_picture(os.fspath(path), expression)

    def film(self, path=None, *, every=0, progress=False, **options):
        """Takes all remaining steps, and returns a Film of them.

        The film has a frame after every `every` steps; 0 means at the interval of a stage, or about 50
        frames. It is written to `path` if that is given. The ending is .gif, .webp or .apng, or, where
        ffmpeg is installed, .mp4 or .webm; without a path the film is a WebP. `options` are as in
        write(), and fps or seconds. `progress` is as in run().
        """
        with tempfile.TemporaryDirectory() as folder, Bar.watching(progress) as watch:
            file = pathlib.Path(folder, "film.webp") if path is None else pathlib.Path(path)
            self._film(str(file), every, _options(options), watch)
            return Film(file.read_bytes(), file.suffix.lower())

    def page(self, height=720):
        """Returns the script as a Page that runs in the browser and that notebooks show in a frame.

        It begins with the script's starting values, and contains the parameters that were set, but no
        painted values. `height` is the height of the frame in pixels.
        """
        return Page(self._page(), height)

    @property
    def model(self):
        """The points, links and triangles of the model on which the pattern grows (see Model). Raises
        Error if the pattern grows on a grid."""
        return Model(**self._model())

    def analyze(self, stage=""):
        """Predicts what will grow in a stage before it runs. Returns a dictionary with the contents
        of `cascade analyze --json`. An empty `stage` means the first stage."""
        return json.loads(self._analysis(stage, True))

    def __repr__(self):
        return f"<cascade.Pattern: stage '{self.stage}', step {self.steps}, cells {self.shape}>"


def _played(kind, session, folder):
    return kind.play(session, folder=folder)


def _has_sides(value):
    """Whether a value is an array, or a list that becomes one, rather than a number or an expression."""
    return not isinstance(value, (str, bytes)) and numpy.ndim(value) > 0


def _options(options):
    """Options as JSON. Numbers of NumPy become numbers of Python."""
    return json.dumps(options, default=lambda value: numpy.asarray(value).tolist())


def _plain_array(values):
    if isinstance(values, numpy.ma.MaskedArray):
        values = values.filled(numpy.nan)
    return numpy.asarray(values)


def _expression(value):
    return value if isinstance(value, str) else repr(float(value))
