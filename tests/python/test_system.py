"""test_system.py -- statements, answers, errors and notices of a system."""
import decimal
import fractions
import os
import sys
import tempfile
import unittest
import warnings

import numpy
import qdot
from qdot import errors
from qdot.system import written
from scenes import oscillator, pendulum


class Errors(unittest.TestCase):
    def test_an_error_has_place_source_caret_and_hint(self):
        with self.assertRaises(qdot.UnknownNameError) as caught:
            qdot.System("param m = 1\nset n = 2")
        error = caught.exception
        self.assertEqual((error.file, error.line, error.column), ("declare", 2, 5))
        self.assertEqual(error.message, "there is no parameter `n`")
        self.assertEqual(error.source, "set n = 2")
        self.assertEqual(error.hint, "write param n = 2")
        self.assertEqual(str(error).split("\n")[2], "      ^")
        self.assertEqual(error.code, 3)
        qdot.System("param m = 1; " + error.hint[len("write "):])

    def test_each_result_has_its_class(self):
        s = pendulum()
        for kind, call in (
            (qdot.LanguageError, lambda: s.declare("param ((")),
            (qdot.UnknownNameError, lambda: s.derive("nothing")),
            (qdot.KindError, lambda: s.number("(1, 2)")),
            (qdot.DomainError, lambda: s.derive("1/0")),
            (qdot.UnsetError, lambda: qdot.System("param a").number("a")),
            (qdot.FileError, lambda: s.declare('include "/no/such/file.lag"')),
            (qdot.InvalidError, lambda: s.ask("T", notation="roman")),
        ):
            with self.subTest(kind.__name__), self.assertRaises(kind):
                call()

    def test_classes_stand_for_the_results_of_the_library(self):
        self.assertEqual(sorted(errors._CLASSES), list(range(1, 14)))
        for code, kind in errors._CLASSES.items():
            self.assertIsInstance(errors.error_of(code, "text"), kind)
            self.assertTrue(kind.__doc__)

    def test_statements_before_the_one_that_fails_stay(self):
        s = qdot.System()
        with self.assertRaises(qdot.Error):
            s.declare("param a = 3\nset b = 1")
        self.assertEqual(s.number("a"), 3)

    def test_answers_before_the_failure_are_at_the_exception(self):
        with self.assertRaises(qdot.Error) as caught:
            pendulum().ask("T\nnothing", notation="plain")
        self.assertIn("theta'^2", caught.exception.answers)

    def test_what_is_no_text_is_refused(self):
        with self.assertRaises(TypeError):
            qdot.System().declare(3)
        with self.assertRaisesRegex(qdot.InvalidError, "NUL: character 7"):
            qdot.System().declare("param a\0b")
        for call in "declare", "derive", "run", "check", "rows", "complete", "plot", "sweep":
            with self.assertRaisesRegex(qdot.InvalidError, "character [0-9]+, .*surrogate"):
                getattr(qdot.System(), call)("x\ud800")
        for call in "sweep", "table", "fit", "plot", "animate", "report", "numbers", "rows", "motion":
            with self.subTest(call), self.assertRaisesRegex(TypeError, "a text is wanted, not float"):
                getattr(qdot.System(), call)(1.5)
        with self.assertRaises(TypeError):
            qdot.System().progress(3)

    def test_hints_name_methods_not_functions_of_c(self):
        with self.assertRaises(qdot.KindError) as caught:
            s = oscillator()
            s.run("0..1 as a")
            s.derive("value(x, 1)")
        self.assertEqual(caught.exception.hint, "System.number, or Motion.values for many")

    def test_answers_without_numbers_are_no_numbers(self):
        for text in "", "x", "print 3":
            with self.assertRaisesRegex(qdot.InvalidError, "no numbers among the answers"):
                oscillator().numbers(text)

    def test_a_traceback_ends_at_the_call(self):
        try:
            qdot.System().declare("nothing")
        except qdot.Error as error:
            depth, traceback = 0, error.__traceback__
            while traceback is not None:
                depth, traceback = depth + 1, traceback.tb_next
            self.assertLessEqual(depth, 3)


class Notices(unittest.TestCase):
    def test_a_notice_is_a_warning_at_the_line_of_the_caller(self):
        s = qdot.System()
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            s.declare("V = 3"); line = sys._getframe().f_lineno  # noqa: E702
        self.assertEqual([w.category for w in caught], [qdot.Notice])
        self.assertTrue(str(caught[0].message).startswith("`V` is now your own"))
        self.assertEqual((caught[0].filename, caught[0].lineno), (__file__, line))


class Asking(unittest.TestCase):
    def test_values_are_written_exactly(self):
        s = qdot.System("param a, b[k] for k = 1..2")
        for value, text in (
            (0.1, "0.1"),
            (3, "3"),
            (-2.5e-7, "-0.00000025"),
            (fractions.Fraction(1, 3), "1/3"),
            (numpy.float64(0.3), "0.3"),
            (numpy.int64(7), "7"),
            ("2*pi", "2*pi"),
        ):
            s.set(a=value)
            self.assertAlmostEqual(s.number("a"), s.number(text), 15)
            self.assertEqual(s.check(f"{written(value)} == {text}"), qdot.Truth.PROVED, text)
        for value in float("inf"), float("nan"), decimal.Decimal("NaN"), decimal.Decimal("-Infinity"):
            with self.assertRaises(qdot.InvalidError):
                s.set(a=value)
        for value in None, 1j, numpy.complex128(1), b"1", {}, object(), len, numpy.array(1j):
            with self.subTest(value=value), self.assertRaisesRegex(TypeError, "a value is a real number"):
                s.set(a=value)
        for name in None, 3, ("a",):
            with self.subTest(name=name), self.assertRaisesRegex(TypeError, "a name is a text"):
                s.set({name: 3})
        for value, number in (numpy.array(3), 3), (numpy.bool_(True), 1), (decimal.Decimal("1E+2"), 100):
            self.assertEqual(s.set(a=value).number("a"), number)
        self.assertEqual(s.set(a=s.derive("1/4")).number("a"), 0.25)
        self.assertEqual(written(10**5000), "1" + 5000 * "0")
        s.set(a=10**5000)
        s.set({"b[1]": 4, "b[2]": 5})
        self.assertEqual(s.number("b[1]*b[2]"), 20)

    def test_start_sets_initial_values(self):
        s = pendulum().start({"theta": 1, "theta'": -2.5})
        self.assertEqual(s.run("0..0.1").values("[theta, theta']", 0).tolist(), [1, -2.5])

    def test_truth_is_true_false_or_neither(self):
        s = pendulum()
        self.assertTrue(s.check("conserved energy"))
        self.assertFalse(s.check("T == 0"))
        with self.assertRaises(TypeError):
            bool(qdot.Truth.UNDECIDED)

    def test_a_number_comes_with_its_error(self):
        s = oscillator()
        s.run("0..10 as a")
        value, error = s.number("value(a.x, 10)", error=True)
        self.assertTrue(abs(value - numpy.cos(10)) <= error < 1e-10)
        self.assertEqual(s.number("1/4"), 0.25)

    def test_ask_answers_in_each_notation(self):
        s = pendulum()
        self.assertEqual(s.ask("T", "plain"), "T = 1/2*m*l^2*theta'^2\n")
        self.assertIn("\\dot{\\theta}", s.ask("T", "latex"))
        self.assertIn("<mi", s.ask("T", "mathml"))
        self.assertIn('"kind":"expr"', s.ask("T", "json"))
        self.assertIn("½", s.ask("T"))

    def test_display_answers_with_objects_also_of_a_failure(self):
        answers = pendulum().display("T\nnothing\nT")
        self.assertEqual([answer["kind"] for answer in answers], ["expr", "error"])
        self.assertEqual((answers[1]["line"], answers[1]["column"]), (2, 1))

    def test_positions_count_characters(self):
        s = qdot.System("param länge; coord theta")
        self.assertEqual(s.complete("länge + th"), (8, ["theta"]))
        self.assertEqual(s.complete("länge + th, 1", 10), (8, ["theta"]))

    def test_a_file_is_read_with_what_it_includes(self):
        with tempfile.TemporaryDirectory() as folder:
            with open(os.path.join(folder, "b.lag"), "w") as file:
                file.write("param b = 2\n")
            with open(os.path.join(folder, "a.lag"), "w") as file:
                file.write('include "b.lag"\nparam a = 3*b\n')
            s = qdot.System.from_file(os.path.join(folder, "a.lag"))
        self.assertEqual(s.number("a"), 6)

    def test_a_closed_system_says_so(self):
        with pendulum() as s:
            motion = s.run("0..1")
        with self.assertRaisesRegex(ValueError, "closed"):
            s.derive("T")
        self.assertEqual(motion.values("theta", 0), 2)
        self.assertEqual(repr(s), "<qdot.System: closed>")

    def test_formulas_keep_their_value(self):
        s = qdot.System("param a; coord x\nE = a*x")
        formula = s.derive("E")
        s.declare("E = 7*x")
        self.assertEqual((str(formula), formula.latex), ("a*x", "a x"))

    def test_a_list_of_formulas_has_members(self):
        s = qdot.System("param m; coord x, y; particle p mass m at (x, y)")
        equations = s.derive("eom")
        self.assertEqual([str(e) for e in equations], ["m*x'' = 0", "m*y'' = 0"])
        self.assertIn("gathered", equations._repr_latex_())
        self.assertEqual(equations.mathml.count("<math"), 2)


if __name__ == "__main__":
    unittest.main()
