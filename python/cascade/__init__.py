"""Cascade: patterns that grow, from a page of text.

    import cascade
    spots = cascade.Pattern("stage one: turing_spots { iterations: 6000 }", ka=1/80)
    spots.run()
    spots.values("b")          # a NumPy array
    spots                      # in a notebook: its picture

docs/python.md in the sources explains more. An invalid script, expression or change raises
cascade.Error.
"""

from ._core import Error, Message, Parameter, Progress, __version__
from ._parameters import Parameters
from ._pattern import Model, Pattern
from ._shown import Film, Page
from ._sweep import sweep

__all__ = ["Error", "Film", "Message", "Model", "Page", "Parameter", "Parameters", "Pattern", "Progress",
           "__version__", "sweep"]
