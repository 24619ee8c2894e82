"""test_figures.py -- figures, animations, reports, tables and numbers of a system."""
import html.parser
import os
import shutil
import tempfile
import unittest
import xml.etree.ElementTree

import numpy
import qdot
from scenes import oscillator, pendulum

try:
    import pandas
except ImportError:
    pandas = None

EXAMPLES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "examples")


class Frame(html.parser.HTMLParser):
    """Reads the page that an iframe holds."""

    page = None

    def handle_starttag(self, tag, attributes):
        if tag == "iframe":
            self.page = dict(attributes)["srcdoc"]


class Figures(unittest.TestCase):
    @unittest.skipUnless(shutil.which("gnuplot"), "no gnuplot")
    def test_a_figure_is_svg(self):
        s = pendulum()
        s.run("0..10 as a")
        figure = s.plot("theta, theta'")
        self.assertTrue(xml.etree.ElementTree.fromstring(figure._repr_svg_()).tag.endswith("svg"))
        self.assertIn("theta", repr(figure))
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "a.svg")
            figure.save(path)
            with open(path, encoding="utf-8") as file:
                self.assertEqual(file.read(), figure.svg)
            with self.assertRaises(qdot.InvalidError):
                figure.save(os.path.join(folder, "a.png"))

    def test_pages_are_framed_whole(self):
        s = pendulum()
        s.run("0..10 as a")
        for page, kind in (s.animate(), qdot.Animation), (s.report(), qdot.Report):
            self.assertIs(type(page), kind)
            frame = Frame()
            frame.feed(page._repr_html_())
            self.assertEqual(frame.page, page.html)
            self.assertIn("<!DOCTYPE html>", page.html)

    def test_nothing_to_show_is_an_error(self):
        with self.assertRaises(qdot.Error):
            pendulum().animate()

    def test_files_have_names_of_any_kind_with_the_right_ending(self):
        figure = qdot.Figure("<svg/>", "x")
        with tempfile.TemporaryDirectory() as folder:
            for name in "a.svg", b"b.svg", "ü c.SVG":
                path = os.path.join(folder if isinstance(name, str) else folder.encode(), name)
                figure.save(path)
                self.assertTrue(os.path.exists(path))
            for name in "", "a.png", "svg":
                with self.assertRaisesRegex(qdot.InvalidError, f"{name!r}, does not end in .svg"):
                    figure.save(name)
            with self.assertRaises(OSError):
                figure.save(os.path.join(folder, "no", "a.svg"))

    def test_what_stands_at_the_prompt_is_short(self):
        text = "+".join(f"x^{k}" for k in range(2, 3000))
        formula = qdot.System("coord x").derive(text)
        for one in qdot.Figure("<svg/>", text), formula, formula.lambdify("x"):
            self.assertLess(len(repr(one)), 1100)
        self.assertGreater(len(str(formula)), 10000)


class Tables(unittest.TestCase):
    def test_a_sweep_is_columns_with_errors(self):
        s = oscillator()
        table = s.sweep("x = [1, 2, 3] run 0..10 : value(x, 10), value(x', 10) as res")
        self.assertEqual(table.columns, ["x", "value(x, 10)", "value(x', 10)"])
        for column, exact in ("value(x, 10)", numpy.cos(10)), ("value(x', 10)", -numpy.sin(10)):
            off = abs(table[column] - exact * table["x"])
            self.assertTrue((off <= table.errors(column) + 1e-15).all())
        self.assertEqual(len(table), 3)
        for again in s.table("res"), s.rows("res"):
            self.assertEqual(again.columns, table.columns)
            for column in table:
                self.assertTrue((again[column] == table[column]).all())
                self.assertTrue((again.errors(column) == table.errors(column)).all())
        self.assertEqual(list(dict(table)), table.columns)
        with self.assertRaisesRegex(KeyError, "no number 'zz': numeric"):
            oscillator().numbers("numeric(1/3)")["zz"]
        with self.assertRaisesRegex(KeyError, "value"):
            table["y"]

    def test_rows_that_fail_stay(self):
        s = qdot.System("coord x; particle p mass 1 at (x, 0); force (x'^2, 0) on p")
        table = s.sweep("x' = [0.1, 1] run 0..2 : value(x, 2) as res")
        for again in table, s.table("res"):
            self.assertEqual(numpy.isnan(again["value(x, 2)"]).tolist(), [False, True])
            self.assertEqual(again["reason"][0], "")
            self.assertIn("singularity", again["reason"][1])
            self.assertIn("singularity", again._repr_html_())
            with self.assertRaisesRegex(KeyError, "texts"):
                again.errors("reason")
        with self.assertRaises(qdot.UnknownNameError):
            s.rows("nothing")

    def test_a_table_is_shown_with_its_errors(self):
        table = oscillator().sweep("x = 1..100 step 1 run 0..1 : value(x, 1) as res")
        page = table._repr_html_()
        self.assertEqual(page.count("<tr>"), 62)
        self.assertIn("40 more rows", page)

    @unittest.skipUnless(pandas, "no pandas")
    def test_a_table_is_a_dataframe(self):
        table = oscillator().sweep("x = [1, 2] run 0..1 : value(x, 1) as res")
        frame = table.to_dataframe(errors=True)
        self.assertEqual(list(frame["x"]), [1, 2])
        self.assertEqual(len(frame.columns), 4)

    def test_a_page_shows_cells_to_their_errors(self):
        page = oscillator().sweep("x = [1, 2] run 0..1 : value(x, 1) as res")._repr_html_()
        self.assertRegex(page, r"<tr><td>1</td><td>-?0\.\d+ ± \de-\d+</td></tr>")


class Fits(unittest.TestCase):
    def test_a_fit_has_values_errors_and_covariance(self):
        s = qdot.System("param m = 1; param k; coord x; particle p mass m at (x, 0); potential k*x^2/2")
        s.set(k=3)
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "data.csv")
            random = numpy.random.default_rng(1)
            t = numpy.linspace(0, 10, 200)
            x = 0.7 * numpy.cos(2 * t) + random.normal(0, 0.01, t.size)
            numpy.savetxt(path, numpy.column_stack([t, x]), "%.17g", ",", header="t,x", comments="")
            fit = s.fit(f'k, x to "{path}" : t, x sigma 0.01')
        self.assertEqual(list(fit), ["k", "x"])
        for name, value in ("k", 4), ("x", 0.7):
            self.assertLess(abs(fit[name] - value), 4 * fit.errors[name])
            self.assertLess(fit.errors[name], 0.01)
        self.assertRegex(repr(fit), r"<qdot.Fit: k = \d\.\d+ ± 0\.0+\d\d, x = 0\.\d+ ± 0\.0+\d\d>")
        self.assertEqual(fit.degrees_of_freedom, 198)
        self.assertTrue(100 < fit.chi2 < 300)
        self.assertTrue(numpy.allclose(numpy.sqrt(numpy.diag(fit.covariance)), list(fit.errors.values())))

    def test_sensitivities_are_numbers_by_name(self):
        s = oscillator()
        s.run("0..1")
        found = s.numbers("sensitivity value(x, 1) of x")
        self.assertAlmostEqual(found["d(value(x, 1))/d(x)"], numpy.cos(1), 10)

    def test_complex_numbers_are_complex(self):
        s = qdot.System("""coord x, y; particle p mass 1 at (x, y); potential x^2/2 + y^2
                           start x = 1""")
        s.run("0..2*pi")
        multipliers = list(s.numbers("floquet").values())
        angle = 2 * numpy.pi * numpy.sqrt(2)
        for sign in 1, -1:
            self.assertLess(min(abs(m - numpy.exp(sign * 1j * angle)) for m in multipliers), 1e-9)


if __name__ == "__main__":
    unittest.main()
