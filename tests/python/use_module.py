"""What the Python module promises; run by tests/python_test.sh with the program in $CASCADE."""

import ast
import gc
import os
import pathlib
import signal
import subprocess
import threading
import types
import unittest
import unittest.mock

import cascade
import numpy

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
ENDLESS = "system s { u: x; u' = 0.1 * lap(u) }\nstage one: s { iterations: 1000000000 }\n"


def address(array):
    return array.__array_interface__["data"][0]


class Values(unittest.TestCase):
    def test_the_same_bits_as_run(self):
        for number, name in enumerate(["leopard", "honeycomb", "brusselator", "surfaces/torus",
                                       "figure_3_2", "fish", "eroded_stripes"]):
            path = SOURCE / "examples" / f"{name}.cascade"
            folder = f"saved{number}"
            subprocess.run([os.environ["CASCADE"], "run", path, "--set", "iterations=40", "--save", folder,
                            "-o", "run.png"], check=True, capture_output=True)
            pattern = cascade.Pattern(path, iterations=40).run()
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


class Runs(unittest.TestCase):
    def test_ctrl_c_ends_steps_and_the_pattern_goes_on(self):
        pattern = cascade.Pattern(ENDLESS)
        timer = threading.Timer(0.3, lambda: os.kill(os.getpid(), signal.SIGINT))
        timer.start()
        with self.assertRaises(KeyboardInterrupt):
            pattern.run()
        steps = pattern.steps
        self.assertGreater(steps, 0)
        self.assertEqual(pattern.step(5), 5)
        self.assertEqual(pattern.steps, steps + 5)

    def test_other_threads_go_on_meanwhile(self):
        pattern = cascade.Pattern(ENDLESS)
        has_begun = threading.Event()

        def watch(progress):
            if progress.step > 0:
                has_begun.set()

        thread = threading.Thread(target=pattern.run, args=(watch,))
        thread.start()
        self.assertTrue(has_begun.wait(60))
        with self.assertRaisesRegex(RuntimeError, "another call"):
            pattern.step(1)
        while thread.is_alive():
            pattern.cancel()
            thread.join(0.01)
        self.assertGreater(pattern.steps, 0)

    def test_a_watcher_sees_progress_and_may_end_the_run(self):
        seen = []

        def watch(progress):
            seen.append((progress.stage, progress.step, progress.steps))
            return len(seen) < 3

        cascade.Pattern(ENDLESS).run(progress=watch)
        self.assertEqual(seen[0][0], "one")
        self.assertEqual(seen[0][2], 1000000000)

        def fails(progress):
            raise ZeroDivisionError

        with self.assertRaises(ZeroDivisionError):
            cascade.Pattern(ENDLESS).run(progress=fails)

    def test_changes_sessions_and_saved_runs(self):
        pattern = cascade.Pattern(SCRIPT)
        pattern.step(3)
        pattern["u"] = "u + disc(0.3, 0.3, 0.2)"
        pattern.parameters.rate = 0.15
        pattern.undo()
        pattern.redo()
        pattern.begin_next_stage()
        pattern.step(4)
        for again in [cascade.Pattern.play(pattern.session()), cascade.Pattern.play(pattern.picture())]:
            numpy.testing.assert_array_equal(again["u"], pattern["u"])
        pattern.save("saved")
        again = cascade.Pattern("saved")
        numpy.testing.assert_array_equal(again.run()["u"], pattern.run()["u"])
        pattern.write_picture("python.png")
        self.assertEqual(pathlib.Path("python.png").read_bytes(), pattern._repr_png_())

    def test_parameters_have_ranges_and_docs(self):
        pattern = cascade.Pattern(SCRIPT, rate=0.2, **{"two.rate": "1/8"})
        rate = pattern.parameters.rate
        self.assertEqual((rate.doc, rate.low, rate.high, rate.step), ("How fast it goes.", 0, 1, 0.05))
        self.assertEqual(numpy.float32(rate.value), numpy.float32(0.2))
        pattern.parameters["one.rate"] = 1 / 3
        self.assertEqual(numpy.float32(float(pattern.parameters["rate"])), numpy.float32(1 / 3))
        self.assertEqual(list(pattern.parameters), ["one.rate", "one.place", "two.rate", "two.place"])
        self.assertIn("rate", dir(pattern.parameters))
        self.assertIn("How fast it goes.", repr(pattern.parameters))
        with self.assertRaises(AttributeError):
            pattern.parameters.rote
        with self.assertRaises(KeyError):
            pattern.parameters["rote"]
        self.assertEqual(pattern.run().parameters["two.rate"].value, 0.125)

    def test_features_analysis_and_remarks(self):
        pattern = cascade.Pattern("domain { grid: 48, 48 }\nstage one: turing_spots { iterations: 5 }").run()
        self.assertGreater(pattern.features("b")["mean"], 0)
        self.assertIsInstance(pattern.analyze(), dict)
        even = cascade.Pattern("domain { grid: 8, 8 }\nsystem s { u: 1; u' = lap(u) }\n"
                               "stage one: s { iterations: 5 }").run()
        self.assertTrue(even.remarks)


class Sweeps(unittest.TestCase):
    def test_have_a_row_for_each_run(self):
        script = SCRIPT.replace("sin(7 * x + 3 * y)", "sin(7 * x) + random(0, 0.1)")
        rows = cascade.sweep(script, {"rate": [0.1, 0.2], "seed": range(2)}, show="u",
                             measure=lambda pattern: {"corner": float(pattern["u"][0, 0])})
        self.assertEqual([(row["rate"], row["seed"]) for row in rows], [(0.1, 0), (0.1, 1), (0.2, 0), (0.2, 1)])
        alone = cascade.Pattern(script, rate=0.2, seed=1).run()
        self.assertEqual(rows[3]["corner"], alone["u"][0, 0])
        self.assertEqual(rows[3]["deviation"], alone.features("u")["deviation"])
        self.assertEqual(rows[3]["steps"], 20)
        self.assertEqual(len({row["corner"] for row in rows}), 4)

    def test_keep_runs_that_fail_and_refuse_wrong_scripts(self):
        rows = cascade.sweep("system bomb { k: 1; u: 1; u' = k * u * u * u }\n"
                             "stage one: bomb { iterations: 200 }", {"k": [-0.1, 1]})
        self.assertIn("mean", rows[0])
        self.assertNotIn("mean", rows[1])
        self.assertIn("not finite", rows[1]["remark"])
        with self.assertRaises(cascade.Error):
            cascade.sweep(SCRIPT, {"rote": [1]})

    def test_end_at_ctrl_c(self):
        threading.Timer(0.3, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
        with self.assertRaises(KeyboardInterrupt):
            cascade.sweep(ENDLESS, {"seed": range(4)}, threads=2)

    def test_are_tables_of_pandas_where_it_is(self):
        pandas = types.ModuleType("pandas")
        pandas.DataFrame = tuple
        with unittest.mock.patch.dict("sys.modules", {"pandas": pandas}):
            self.assertIsInstance(cascade.sweep(SCRIPT, {"rate": [0.1]}), tuple)


class Errors(unittest.TestCase):
    def fault(self, call):
        with self.assertRaises(cascade.Error) as caught:
            call()
        return caught.exception

    def test_have_place_and_hint(self):
        error = self.fault(lambda: cascade.Pattern("stage one: turing_spots {\n  kaa: 1\n}\n"))
        self.assertEqual((error.line, error.column, error.file), (2, 3, "<script>"))
        self.assertIn("kaa", error.message)
        self.assertIn("ka", error.hint)
        self.assertIn("^~~", str(error))
        self.assertIsInstance(error, ValueError)
        self.assertEqual(cascade.Error("mine").line, 0)

    def test_of_changes_leave_the_pattern_as_it_was(self):
        pattern = cascade.Pattern(SCRIPT)
        before = pattern["u"]
        for call in [lambda: pattern.set("rote", 1), lambda: pattern.set("rate", float("nan")),
                     lambda: pattern["nobody"], lambda: pattern.paint("u", "1/0"), pattern.undo,
                     lambda: pattern.set_script("stage x: nobody { }"), lambda: pattern.features("nobody"),
                     lambda: pattern.picture("nobody"), lambda: pattern.write_picture("x.tiff"),
                     lambda: pattern.analyze("nobody"), lambda: cascade.Pattern(SCRIPT, rote=1),
                     lambda: cascade.Pattern("missing.cascade"), lambda: cascade.Pattern.play("nonsense")]:
            self.assertTrue(str(self.fault(call)))
        numpy.testing.assert_array_equal(pattern["u"], before)
        self.assertEqual(self.fault(lambda: pattern["u + nobody"]).column, 5)
        with self.assertRaises(ValueError):
            pattern.step(-1)
        with self.assertRaises(TypeError):
            pattern.set("rate", None)

    def test_of_a_run_that_fails(self):
        pattern = cascade.Pattern("system bomb { u: 1; u' = u * u * u }\nstage one: bomb { iterations: 1000 }")
        self.assertIn("not finite", str(self.fault(pattern.run)))
        self.assertIn("not finite", str(self.fault(lambda: pattern["u"])))


class Documentation(unittest.TestCase):
    def test_everything_has_a_docstring_and_a_type(self):
        stub = (pathlib.Path(cascade.__file__).parent / "__init__.pyi").read_text()
        ast.parse(stub)
        of_pattern = stub[stub.index("class Pattern:"):]
        for name in dir(cascade.Pattern):
            if not name.startswith("_"):
                self.assertTrue(getattr(cascade.Pattern, name).__doc__, name)
                self.assertIn(f"def {name}(", of_pattern)
        for name in cascade.__all__:
            if name != "__version__":
                self.assertTrue(getattr(cascade, name).__doc__, name)


if __name__ == "__main__":
    unittest.main()
