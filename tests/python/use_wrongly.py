"""Errors and misuse."""

import gc
import os
import pickle
import threading
import unittest

import cascade
import numpy

from common import SCRIPT


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


class Misuse(unittest.TestCase):
    def test_of_a_pattern_without_init_raises(self):
        empty = cascade.Pattern.__new__(cascade.Pattern)
        for use in [lambda: empty.step(), lambda: empty["u"], lambda: empty.steps, empty.run, empty.cancel, empty.picture,
                    lambda: repr(empty), lambda: pickle.dumps(empty), lambda: empty.shape]:
            with self.assertRaises((TypeError, AttributeError)):
                use()
        with self.assertRaises(TypeError):
            cascade.Pattern()

        class Careless(cascade.Pattern):
            def __init__(self):
                pass

        with self.assertRaises(TypeError):
            Careless()

    def test_after_a_fork(self):
        pattern = cascade.Pattern(SCRIPT)
        pattern.step(2)
        child = os.fork()
        if child == 0:
            try:
                pattern.step(1)
            except RuntimeError as error:
                own = cascade.Pattern(SCRIPT, native=False).run()
                del pattern
                gc.collect()
                os._exit(17 if "forked" in str(error) and own.finished else 1)
            os._exit(2)
        self.assertEqual(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]), 17)
        self.assertEqual(pattern.step(1), 1)

    def test_by_several_threads_is_refused_but_harmless(self):
        pattern = cascade.Pattern(SCRIPT)
        refused = []

        def use():
            for _ in range(200):
                try:
                    pattern.step(1)
                    pattern["u"] = pattern["u"] * 1
                except RuntimeError as error:
                    refused.append(str(error))

        threads = [threading.Thread(target=use) for _ in range(3)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertTrue(all("another call" in each for each in refused))
        self.assertTrue(pattern.finished)
