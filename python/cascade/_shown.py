"""Films and pages, which notebooks show."""

import base64
import html
import os
import pathlib

_MEDIA = {".gif": "image/gif", ".webp": "image/webp", ".apng": "image/apng", ".mp4": "video/mp4", ".webm": "video/webm"}


class Film:
    """A film of a pattern. A notebook shows it if it is the last value of a cell.

    `data` are the bytes of its file, and `media_type` is their type, such as "image/webp".
    """

    def __init__(self, data, ending):
        self.data = data
        self.media_type = _MEDIA[ending]

    def save(self, path):
        """Writes the film to a file, in the format that it has."""
        pathlib.Path(path).write_bytes(self.data)

    def _repr_html_(self):
        source = f"data:{self.media_type};base64,{base64.b64encode(self.data).decode()}"
        if self.media_type.startswith("video/"):
            return f'<video controls loop src="{source}"></video>'
        return f'<img src="{source}" alt="A film of a pattern">'

    def __repr__(self):
        return f"<cascade.Film: {self.media_type}, {len(self.data)} bytes>"


class Page:
    """A page on which a script runs in the browser, with sliders, text and painting.

    A notebook shows it in a frame. The page needs no Python: it carries its engine. `html` is its text,
    and `height` the height of the frame in pixels.
    """

    def __init__(self, text, height):
        self.html = text
        self.height = int(height)

    def save(self, path):
        """Writes the page to a file, which a browser can open."""
        with open(os.fspath(path), "w", encoding="utf-8") as file:
            file.write(self.html)

    def _repr_html_(self):
        return (f'<iframe width="100%" height="{self.height}" style="border: 0" title="Cascade" '
                f'sandbox="allow-scripts allow-downloads" srcdoc="{html.escape(self.html)}"></iframe>')

    def __repr__(self):
        return f"<cascade.Page: {len(self.html)} characters of HTML>"
