"""Pictures, films, models and pages."""

import os
import pathlib
import unittest

import cascade
import numpy

from common import ENDLESS, SCRIPT


class Files(unittest.TestCase):
    def test_are_written_in_all_formats(self):
        plane = cascade.Pattern(SCRIPT, iterations=3).run()
        volume = cascade.Pattern("domain { grid: 8, 6, 4 }\nstage one: turing_spots { iterations: 3 }").run()
        ball = cascade.Pattern("domain { surface: sphere; cells: 300 }\nstage one: turing_spots { iterations: 3 }").run()
        skin = cascade.Pattern("domain { grid: 8, 8 }\nstage one: scales { founders: 20; r: 0.05; duration: 0.1 }").run()
        for pattern, name, beginning in [
                (plane, "p.png", b"\x89PNG"), (plane, "p.svg", b"<svg"), (plane, "p.pdf", b"%PDF"),
                (plane, "p.vti", b"<"), (volume, "v.vti", b"<"), (ball, "b.ply", b"ply"), (ball, "b.obj", b""),
                (ball, "b.glb", b"glTF"), (ball, "b.vtp", b"<"), (ball, "b.stl", b""), (skin, "s.npz", b"PK"),
                (skin, "s.cells.vtp", b"<"), (skin, "s.glb", b"glTF")]:
            pattern.write(name)
            self.assertIn(beginning, pathlib.Path(name).read_bytes()[:200], name)
        plane.write(pathlib.Path("o.png"), show="2 * u", palette="viridis", scale=2, range=(0, numpy.float32(3)))
        self.assertNotEqual(pathlib.Path("o.png").read_bytes(), pathlib.Path("p.png").read_bytes())
        plane.write("tile.glb", bake=64)
        numpy.testing.assert_array_equal(cascade.Pattern("p.png")["u"], plane["u"])

    def test_are_refused_with_a_reason(self):
        pattern = cascade.Pattern(SCRIPT, iterations=3)
        for call, words in [(lambda: pattern.write("x.tiff"), "tiff.*\\.svg"), (lambda: pattern.write("x.glb"), "model"),
                            (lambda: pattern.write("x.gif"), "film"), (lambda: pattern.write("x.png", colour=3), "colour.*palette"),
                            (lambda: pattern.write("x.png", scale=1000), "scale.*1000"), (lambda: pattern.write("x.vdb"), "volume"),
                            (lambda: pattern.write("x.png", show="nobody"), "nobody"), (lambda: pattern.write("nowhere/x.png"), "nowhere"),
                            (lambda: pattern.film("x.png"), "film"), (lambda: pattern.film("x.gif", fps=1000), "fps"),
                            (lambda: pattern.film("nowhere/x.gif"), "nowhere"), (lambda: pattern.film(every=-1), "negative"),
                            (lambda: pattern.film(show="nobody"), "nobody")]:
            with self.assertRaisesRegex(cascade.Error, f"(?s){words}"):
                call()
        self.assertEqual(pattern.steps, 0)
        self.assertFalse([file for file in os.listdir() if file.startswith("x.")])

    def test_films_show_the_steps(self):
        pattern = cascade.Pattern(SCRIPT)
        film = pattern.film(every=10, show="u", scale=2, fps=20)
        self.assertTrue(pattern.finished)
        self.assertEqual((film.media_type, film.data[:4], film.data[8:12]), ("image/webp", b"RIFF", b"WEBP"))
        self.assertEqual(film.data.count(b"ANMF"), 6)     # Steps 0 to 30 and 10 to 20; a stage goes on from its end.
        self.assertIn("data:image/webp;base64,", film._repr_html_())
        film.save("film.webp")
        numpy.testing.assert_array_equal(pattern["u"], cascade.Pattern(SCRIPT).run()["u"])
        self.assertEqual(cascade.Pattern(SCRIPT).film("film.gif").data, pathlib.Path("film.gif").read_bytes())

        def stop(progress):
            return False

        with self.assertRaisesRegex(cascade.Error, "cancelled"):
            cascade.Pattern(ENDLESS).film("never.gif", every=1000, progress=stop)
        self.assertFalse(os.path.exists("never.gif"))

    def test_pages_carry_their_engine(self):
        pattern = cascade.Pattern("# </script>\n" + SCRIPT, rate=0.7)
        if not pathlib.Path(os.environ["BUILD"], "engine.wasm").exists():
            with self.assertRaisesRegex(cascade.Error, "engine.wasm"):
                pattern.page()
            return
        page = pattern.page(height=300)
        self.assertIn('id="engine"', page.html)
        self.assertIn("rate=0.7", page.html)
        frame = page._repr_html_()
        self.assertTrue(frame.startswith("<iframe") and 'height="300"' in frame and "sandbox" in frame)
        self.assertNotIn("<script", frame)
        page.save("page.html")
        self.assertEqual(pathlib.Path("page.html").read_text(), page.html)
