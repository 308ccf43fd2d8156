"""Values of patterns as arrays that share their memory."""

import gc
import os
import pathlib
import subprocess
import unittest

import cascade
import numpy

from common import EXAMPLES, SCRIPT, SOURCE


def address(array):
    return array.__array_interface__["data"][0]


class Values(unittest.TestCase):
    def test_the_same_bits_as_run(self):
        # Small grids and few steps, because what is compared is how both begin, step and end.
        for number, name in enumerate(EXAMPLES):
            path = SOURCE / "examples" / f"{name}.cascade"
            folder = f"saved{number}"
            subprocess.run([os.environ["CASCADE"], "run", path, "--set", "iterations=20", "--save", folder,
                            "-o", "run.png", "--quiet"], check=True, capture_output=True)
            pattern = cascade.Pattern(path, iterations=20).run()
            for species in pattern.species():
                expected = numpy.load(f"{folder}/{pattern.stage}.{species}.npy")
                found = pattern.values(species)
                self.assertEqual(expected.dtype, found.dtype)
                numpy.testing.assert_array_equal(expected.squeeze(), found, err_msg=f"{name}: {species}")

    def test_lie_in_the_patterns_memory(self):
        pattern = cascade.Pattern(SCRIPT)
        pattern.step(3)
        u, again, place = pattern.values("u"), pattern["u"], pattern.values("place")
        self.assertEqual(u.shape, (24, 40))
        self.assertEqual(address(u), address(again))
        self.assertNotEqual(address(u), address(pattern.values("1 * u")))
        self.assertEqual(address(place), address(pattern.values("place")))
        self.assertFalse(u.flags.writeable)
        self.assertFalse(u.flags.owndata)
        with self.assertRaises(ValueError):
            u[0, 0] = 1
        own = pattern.values("u", copy=True)
        self.assertTrue(own.flags.writeable)
        self.assertNotEqual(address(own), address(u))
        numpy.testing.assert_array_equal(own, u)

    def test_show_the_moment_at_which_they_were_read(self):
        pattern = cascade.Pattern(SCRIPT)
        kept = []
        while pattern.step(7):
            kept.append((pattern["u"], pattern.values("u", copy=True)))
        pattern.paint("u", "7")
        del pattern
        gc.collect()
        for shown, copied in kept:
            numpy.testing.assert_array_equal(shown, copied)
        self.assertTrue((kept[0][1] != kept[1][1]).any())

    def test_steps_do_not_depend_on_arrays_that_are_kept(self):
        alone, watched = cascade.Pattern(SCRIPT).run(), cascade.Pattern(SCRIPT)
        kept = []
        while watched.step(1):
            kept.append(watched["u"])
        numpy.testing.assert_array_equal(alone["u"], watched["u"])

    def test_without_arrays_steps_copy_nothing(self):
        pattern = cascade.Pattern(SCRIPT)
        pattern.step(2)
        places = set()
        for _ in range(12):
            places.add(address(pattern["u"]))
            pattern.step(1)
        self.assertLessEqual(len(places), 3)

    def test_precision_shapes_and_masks(self):
        double = cascade.Pattern("domain { grid: 8, 6; precision: double }\nstage one: turing_spots { }")
        self.assertEqual(double["b"].dtype, numpy.float64)
        volume = cascade.Pattern("domain { grid: 8, 6, 4 }\nstage one: turing_spots { }")
        self.assertEqual((volume["b"].shape, volume.shape), ((4, 6, 8), (4, 6, 8)))
        line = cascade.Pattern("domain { grid: 9 }\nstage one: turing_spots { }")
        self.assertEqual((line["b"].shape, line.shape), ((9,), (9,)))
        masked = cascade.Pattern("domain { grid: 8, 8; mask: x > 0.5 }\nstage one: turing_spots { }")
        self.assertEqual(numpy.isnan(masked["b"]).sum(), 32)
        cells = cascade.Pattern("domain { surface: sphere; cells: 500 }\nstage one: turing_spots { }")
        self.assertEqual(cells["b"].shape, cells.shape)

    def test_memory_is_given_back(self):
        def resident():
            return int(pathlib.Path("/proc/self/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")

        def use():
            pattern = cascade.Pattern("domain { grid: 256, 256 }\nstage one: turing_spots { }", native=False)
            arrays = [pattern["a"], pattern["b"], pattern["a + b"]]
            pattern.step(1)
            arrays.append(pattern["b"])

        for _ in range(5):
            use()
        before = resident()
        for _ in range(60):
            use()
        self.assertLess(resident() - before, 16 << 20)
