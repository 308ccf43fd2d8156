"""Arrays as values, and the arrays of models."""

import copy
import gc
import pickle
import unittest

import cascade
import numpy

from common import SCRIPT


class Arrays(unittest.TestCase):
    def test_are_starting_values(self):
        start = numpy.random.default_rng(1).random((24, 40))
        for number_type in [numpy.float32, numpy.float64]:
            pattern = cascade.Pattern(SCRIPT, u=start.astype(number_type))
            self.assertEqual(pattern.steps, 0)
            numpy.testing.assert_array_equal(pattern["u"], start.astype(numpy.float32))
        double = cascade.Pattern(SCRIPT.replace("40, 24", "40, 24; precision: double"), **{"one.u": start})
        numpy.testing.assert_array_equal(double["u"], start)

    def test_have_any_strides_and_real_type(self):
        pattern = cascade.Pattern(SCRIPT)
        numbers = numpy.arange(4 * 24 * 40).reshape(48, 80)
        for array in [numbers[::2, ::2], numbers[::-2, ::2], numbers.T[:40, :24].T, numbers[:24, :40].astype(">f8"),
                      numbers[:24, :40] > 9, numpy.asfortranarray(numbers[:24, :40]), numbers[:24, :40].tolist(),
                      numbers[:24, :40].astype(numpy.float16), numpy.broadcast_to(numpy.float32(3), (24, 40))]:
            pattern["u"] = array
            numpy.testing.assert_array_equal(pattern["u"], numpy.asarray(array, numpy.float32))
        pattern["u"] = pattern["u"][::-1]          # A view of the pattern itself.
        pattern["place"] = numpy.full((24, 40), 2.5)
        self.assertEqual(set(pattern["place"].ravel()), {2.5})
        pattern["u"] = 0.25
        pattern["u"] = numpy.float32(0.25)
        self.assertEqual(set(pattern["u"].ravel()), {0.25})

    def test_belong_to_the_session(self):
        start = numpy.random.default_rng(2).random((24, 40))
        pattern = cascade.Pattern(SCRIPT, u=start)
        pattern.step(4)
        before = pattern["u"]
        pattern["u"] = 2 * before
        pattern.step(3)
        for again in [cascade.Pattern.play(pattern.session()), cascade.Pattern.play(pattern.picture()),
                      pickle.loads(pickle.dumps(pattern)), copy.copy(pattern)]:
            numpy.testing.assert_array_equal(again["u"], pattern["u"])
        pattern.undo()
        numpy.testing.assert_array_equal(pattern["u"], before)
        pattern.redo()
        self.assertEqual(pattern.steps, 7)

    def test_of_masks_models_volumes_and_crawling_cells(self):
        masked = cascade.Pattern("domain { grid: 8, 8; mask: x > 0.5 }\nstage one: turing_spots { }")
        values = masked.values("b", copy=True)
        masked["b"] = values + 1                   # NaN outside, where values are ignored.
        numpy.testing.assert_array_equal(masked["b"], values + 1)
        volume = cascade.Pattern("domain { grid: 8, 6, 4 }\nstage one: turing_spots { }")
        numbers = numpy.arange(8 * 6 * 4, dtype=numpy.float32).reshape(4, 6, 8)
        volume["b"] = numbers
        numpy.testing.assert_array_equal(volume["b"], numbers)
        ball = cascade.Pattern("domain { surface: sphere; cells: 501 }\nstage one: turing_spots { }")
        numbers = numpy.arange(501, dtype=numpy.float32)
        ball["b"] = numbers
        numpy.testing.assert_array_equal(ball["b"], numbers)
        skin = cascade.Pattern("domain { grid: 8, 8 }\nstage one: scales { founders: 30; r: 0.05; duration: 1 }")
        numbers = numpy.linspace(0.04, 0.05, len(skin["r"]), dtype=numpy.float32)
        skin["r"] = numbers
        numpy.testing.assert_array_equal(skin["r"], numbers)

    def test_that_do_not_fit_raise_one_error_and_change_nothing(self):
        pattern = cascade.Pattern(SCRIPT)
        before = pattern["u"]
        nan = numpy.ones((24, 40))
        nan[3, 4] = numpy.nan
        for array, words in [(numpy.ones((40, 24)), "shape \\(40, 24\\) .* shape \\(24, 40\\)"), (numpy.ones(960), "shape"),
                             (numpy.ones((24, 40, 1)), "shape"), (numpy.ones((0, 40)), "shape"), (nan, "finite"),
                             (numpy.full((24, 40), 1e300), "finite"), (numpy.ones((24, 40), complex), "complex128"),
                             (numpy.full((24, 40), "a"), "<U1"), (numpy.full((24, 40), None), "object"),
                             (numpy.ma.masked_equal(numpy.ones((24, 40)), 1), "finite")]:
            with self.assertRaisesRegex(cascade.Error, words):
                pattern["u"] = array
        for name in ["nobody", "rate", "two.u"]:
            with self.assertRaises(cascade.Error):
                pattern[name] = numpy.ones((24, 40))
        with self.assertRaisesRegex(cascade.Error, "rate"):
            cascade.Pattern(SCRIPT, rate=numpy.ones((24, 40)))
        numpy.testing.assert_array_equal(pattern["u"], before)

    def test_of_models(self):
        ball = cascade.Pattern("domain { surface: sphere; cells: 400 }\nstage one: turing_spots { }")
        model = ball.model
        self.assertEqual((model.points.shape, model.areas.shape), ((400, 3), (400,)))
        numpy.testing.assert_allclose(numpy.linalg.norm(model.points - 0.5, axis=1), 0.5, atol=0.02)
        self.assertAlmostEqual(model.areas.sum(), numpy.pi, delta=0.05)
        self.assertEqual(model.links.shape, (len(model.weights), 2))
        self.assertTrue((model.links[:, 0] < model.links[:, 1]).all())
        self.assertEqual(len(numpy.unique(model.links, axis=0)), len(model.links))
        self.assertEqual((numpy.bincount(model.links.ravel(), minlength=400) > 3).all(), True)
        self.assertTrue((model.weights > 0).all())
        corners = model.vertices[model.triangles]
        normals = numpy.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        self.assertTrue(((normals * (corners.mean(axis=1) - 0.5)).sum(axis=1) > 0).all())
        high = numpy.asarray(ball["if(y > 0.5, 1, 0)"])
        numpy.testing.assert_array_equal(high, model.points[:, 1] > 0.5)
        del ball
        gc.collect()
        self.assertEqual(model.points.shape, (400, 3))
        with self.assertRaisesRegex(cascade.Error, "grid"):
            cascade.Pattern(SCRIPT).model
