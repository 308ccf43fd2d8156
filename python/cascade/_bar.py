"""The progress of a run on standard error."""

import contextlib
import sys


class Bar:
    """Draws the progress of a run as a line."""

    def __init__(self):
        self._width = 0

    @classmethod
    @contextlib.contextmanager
    def watching(cls, progress):
        """The function that watches a run: `progress` itself, a bar if it is True, or None."""
        if progress is not True:
            yield progress or None
            return
        bar = cls()
        try:
            yield bar
        finally:
            bar.end()

    def __call__(self, now):
        share = now.t / now.duration if now.duration else now.step / max(now.steps, 1)
        filled = int(24 * min(share, 1))
        left = f", {now.seconds_left:.0f} s left" if now.seconds_left >= 0 else ""
        line = f"{now.stage} [{'#' * filled}{'.' * (24 - filled)}] step {now.step} of {now.steps}{left}"
        print("\r" + line.ljust(self._width), end="", file=sys.stderr, flush=True)
        self._width = len(line)

    def end(self):
        """Ends the line."""
        if self._width:
            print(file=sys.stderr)
