"""Steps, watchers, changes and sweeps."""

import os
import pathlib
import signal
import threading
import types
import unittest
import unittest.mock

import cascade
import numpy

from common import ENDLESS, SCRIPT


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
    def setUp(self):
        # Tables are lists, also where pandas is installed.
        without = unittest.mock.patch.dict("sys.modules", {"pandas": None})
        without.start()
        self.addCleanup(without.stop)

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
