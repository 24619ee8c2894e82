"""test_motion.py -- motions as arrays, against closed forms."""
import decimal
import fractions
import gc
import unittest
import unittest.mock

import numpy
import qdot
from scenes import oscillator, pendulum

try:
    import pandas
except ImportError:
    pandas = None


class Values(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.motion = oscillator().run("0..10")

    def test_values_are_those_of_the_closed_form_within_their_errors(self):
        t = numpy.random.default_rng(1).uniform(0, 10, 500)
        (x, v), (dx, dv) = self.motion.values(["x", "x'"], t, errors=True)
        self.assertTrue((abs(x - numpy.cos(t)) <= dx + 1e-15).all())
        self.assertTrue((abs(v + numpy.sin(t)) <= dv + 1e-15).all())
        self.assertLess(max(dx.max(), dv.max()), 1e-12)

    def test_shapes_follow_expressions_and_times(self):
        for expressions, times, shape in (
            ("x", 1, ()),
            ("x", [1, 2, 3], (3,)),
            ("x", numpy.ones((2, 3)), (2, 3)),
            ("x", [], (0,)),
            ("(x, x')", [1, 2, 3], (2, 3)),
            ("[x]", [1, 2, 3], (1, 3)),
            (["x"], [1, 2, 3], (1, 3)),
            (["x", "x'", "x''"], 1, (3,)),
            (["x", "x'"], numpy.ones((2, 3)), (2, 2, 3)),
            ([], [1, 2, 3], (0, 3)),
        ):
            with self.subTest(expressions=expressions):
                values, errors = self.motion.values(expressions, times, errors=True)
                self.assertEqual((values.shape, errors.shape), (shape, shape))
                self.assertTrue((values == self.motion.values(expressions, times)).all())

    def test_a_dictionary_gives_a_dictionary(self):
        values = self.motion.values({"place": "x", "speed": "x'"}, [0, 1])
        self.assertEqual(list(values), ["place", "speed"])
        self.assertTrue((values["place"] == self.motion.values("x", [0, 1])).all())

    def test_errors_are_computed_where_they_are_wanted(self):
        run, asked = oscillator().run("0..3"), []
        library = run._session.library
        values, t = library.qdot_motion_values, numpy.linspace(0, 3, 9)

        def told(*arguments):
            asked.append(arguments[-1] is not None)
            return values(*arguments)

        with unittest.mock.patch.object(library, "qdot_motion_values", told):
            for expressions in "x", ["x", "x'"], {"a": "x"}:
                run.values(expressions, t)
                run.values(expressions, t, errors=1)
        self.assertEqual(asked, 3 * [False, True])

    def test_times_may_be_any_array(self):
        t = numpy.arange(10)[::-3]
        self.assertTrue(numpy.allclose(self.motion.values("x", t), numpy.cos(t), atol=1e-12))

    def test_times_are_real_numbers(self):
        masked = numpy.ma.array([1.0, 30.0], mask=[False, True])
        for times in None, 1j, [1, 1j], "1", ["1", "2"], b"1", [None, 1], {1, 2}, numpy.datetime64("2020"):
            with self.subTest(times=times):
                for call in self.motion.values, self.motion.to_dataframe if pandas else self.motion.values:
                    with self.assertRaisesRegex(TypeError, "times are real numbers, not"):
                        call("x", numpy.array(times) if times is None else times)
        for times in masked, float("nan"), [0, float("nan")], float("inf"):
            with self.assertRaises(qdot.DomainError):
                self.motion.values("x", times)
        exact = [1, fractions.Fraction(1, 2), decimal.Decimal("0.25"), numpy.float32(3), True]
        self.assertTrue(numpy.allclose(self.motion.values("x", exact), numpy.cos([1, 0.5, 0.25, 3, 1])))
        self.assertAlmostEqual(self.motion.values("x", masked[:1])[0], numpy.cos(1))

    def test_a_range_is_of_real_numbers_in_the_run(self):
        for bounds in (float("nan"), 5), (0, float("nan")), (-1, 5), (0, float("inf")):
            for what in "max", "min", "mean", "drift":
                with self.subTest(bounds=bounds, what=what), self.assertRaises(qdot.DomainError):
                    self.motion.over(what, "x", *bounds)
        for bound in [1, 2], "1", 1j, numpy.arange(3):
            with self.subTest(bound=bound), self.assertRaisesRegex(TypeError, "start is a real number"):
                self.motion.max("x", bound)
        self.assertEqual(self.motion.max("x", 2, 8), self.motion.max("x", 8, numpy.float64(2)))
        with self.assertRaisesRegex(qdot.InvalidError, "'average' is none of max, min, mean, drift"):
            self.motion.over("average", "x")

    def test_expressions_may_be_formulas_vectors_by_name_and_have_comments(self):
        s = oscillator()
        motion, t = s.run("0..2"), [0.5, 1]
        energy = s.derive("energy")
        self.assertTrue((motion.values(energy, t) == motion.values("energy", t)).all())
        self.assertEqual(motion.values([energy, "x"], t).shape, (2, 2))
        self.assertEqual(motion.max(energy), motion.max("energy"))
        self.assertEqual(motion.values(["x # place", "x'"], t).shape, (2, 2))
        values, errors = motion.values({"place": "(x, 0)", "speed": "x'", "E": energy}, t, errors=True)
        self.assertEqual([v.shape for v in values.values()], [(2, 2), (2,), (2,)])
        self.assertEqual([v.shape for v in errors.values()], [(2, 2), (2,), (2,)])
        self.assertTrue(numpy.allclose(values["place"][0], numpy.cos(t)))
        with self.assertRaisesRegex(TypeError, "a text is wanted, not NoneType"):
            motion.values([None], t)

    def test_what_cannot_be_read_is_an_error(self):
        with self.assertRaises(qdot.DomainError):
            self.motion.values("x", [1, 11])
        with self.assertRaises(qdot.UnknownNameError):
            self.motion.values(["x", "y"], 1)
        with self.assertRaises(qdot.KindError):
            self.motion.values(["x", "(x, x)"], 1)

    def test_extrema_means_and_drifts(self):
        for what, value in (("max", 1), ("min", -1), ("mean", numpy.sin(10) / 10)):
            found, error = self.motion.over(what, "x")
            self.assertTrue(abs(found - value) <= error + 1e-15, what)
            self.assertEqual(getattr(self.motion, what)("x"), found)
        self.assertAlmostEqual(self.motion.max("x", 1, 2), numpy.cos(1), 12)
        self.assertLess(self.motion.drift("energy"), 1e-12)


class Wholes(unittest.TestCase):
    def test_summary_end_steps_and_conserved(self):
        motion = oscillator().run("0..10 tol 1e-9 method dop853")
        summary = motion.summary
        self.assertEqual((summary.start, summary.end), (0, 10))
        self.assertEqual((summary.tolerance, summary.method), (1e-9, "dop853"))
        self.assertIsNone(summary.reason)
        self.assertEqual(motion.coordinates, ["x"])
        self.assertAlmostEqual(motion.end["x"], numpy.cos(10), 7)
        self.assertAlmostEqual(motion.end["x'"], -numpy.sin(10), 7)
        self.assertEqual((motion.steps[0], motion.steps[-1]), (0, 10))
        self.assertEqual([q.name for q in motion.conserved], ["energy"])
        self.assertIn("dop853", repr(motion))
        self.assertIn("<table>", motion._repr_html_())

    def test_events_have_times_with_errors(self):
        s = oscillator().declare("event cross: x = 0 falling")
        first = s.run("0..10").events[0]
        self.assertEqual((first.name, first.way), ("cross", -1))
        self.assertTrue(abs(first.time - numpy.pi / 2) <= first.error < 1e-10)

    def test_a_run_that_fails_gives_what_there_is(self):
        s = qdot.System("coord x; particle p mass 1 at (x, 0); force (x'^2, 0) on p; start x' = 1")
        with self.assertRaises(qdot.FailedError) as caught:
            s.run("0..2")
        self.assertLess(caught.exception.motion.summary.end, 1.001)

    def test_a_motion_outlives_its_system(self):
        s = pendulum()
        motion = s.run("0..1")
        del s
        gc.collect()
        self.assertEqual(motion.values("theta", 0), 2)
        self.assertEqual(motion.summary.end, 1)

    def test_a_motion_of_a_run_that_is_gone_says_so(self):
        s = oscillator()
        motion = s.run("0..1 as a")
        s.declare("reset")
        with self.assertRaises(qdot.UnknownNameError):
            motion.values("x", 0)

    def test_a_run_of_a_statement_is_a_motion(self):
        s = oscillator()
        with self.assertRaisesRegex(qdot.UnknownNameError, "there is no run yet"):
            s.motion()
        s.declare("run 0..10 as a; run 0..2")
        self.assertEqual([s.motion(name).summary.end for name in ("a", "run2", None)], [10, 2, 2])
        s.declare("run 0..3 as theta; sweep x = [1, 2] run 0..1 : value(x, 1) as phi")
        self.assertEqual((s.motion("θ").summary.end, len(s.rows("φ"))), (3, 2))
        gc.collect()
        self.assertAlmostEqual(s.motion("a").values("x", 3), numpy.cos(3))
        with self.assertRaisesRegex(qdot.UnknownNameError, "there is no run `b`"):
            s.motion("b")

    @unittest.skipUnless(pandas, "no pandas")
    def test_a_dataframe_has_times_as_its_index(self):
        motion = oscillator().run("0..10")
        frame = motion.to_dataframe()
        self.assertEqual(list(frame.columns), ["x", "x'"])
        self.assertEqual(frame.index.name, "t")
        self.assertTrue((frame.index == motion.steps).all())
        frame = motion.to_dataframe({"place": "x"}, [0, 1], errors=True)
        self.assertEqual(list(frame.columns), ["place", "error of place"])
        self.assertTrue((frame["place"] == motion.values("x", [0, 1])).all())


if __name__ == "__main__":
    unittest.main()
