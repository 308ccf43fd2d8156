"""Scripts of the tests of the Python module."""

import os
import pathlib

SOURCE = pathlib.Path(os.environ["SOURCE"])
SCRIPT = """domain { grid: 40, 24 }
system s {
  ## How fast it goes.
  rate: 0.1 in 0 .. 1 step 0.05
  place: x
  u: 1 + 0.5 * sin(7 * x + 3 * y)
  u' = rate * lap(u)
}
stage one: s { iterations: 30 }
stage two: s { iterations: 20; u: u }
"""
EXAMPLES = ["leopard", "honeycomb", "brusselator", "surfaces/torus", "figure_3_2", "fish", "eroded_stripes",
            "autocatalytic_spots", "bumpy_stripes", "butterfly", "fitzhugh_nagumo", "gray_scott_coral",
            "gray_scott_mitosis", "lionfish", "plates", "small_spots", "squirrel", "thin_lines", "vary_spots",
            "wide_spots"]
ENDLESS = "system s { u: x; u' = 0.1 * lap(u) }\nstage one: s { iterations: 1000000000 }\n"
