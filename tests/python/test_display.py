"""test_display.py -- answers as outputs of a notebook: what a browser and what a terminal shows."""
import base64
import html
import os
import re
import tempfile
import unittest
import xml.etree.ElementTree

import qdot
from qdot.display import outputs, page_html, progress_bundle

SCENE = """
    param m = 1, k = 4
    coord x
    particle p mass m at (x, 0); potential k*x^2/2
    start x = 1
"""


def shown(text, scene=SCENE):
    """Return the outputs of statements on a scene."""
    return outputs(qdot.System(scene).display(text, "In[3]"))


def one(text, scene=SCENE):
    """Return the only output of statements on a scene."""
    (output,) = shown(text, scene)
    return output


def cells(page):
    """Return the texts of the cells of the HTML's tables, row by row; it must be well-formed."""
    tree = xml.etree.ElementTree.fromstring(f"<div>{page}</div>")
    return [["".join(cell.itertext()) for cell in row] for row in tree.iter("tr")]


class Formulas(unittest.TestCase):
    def test_a_formula_is_latex_for_browsers_and_a_line_for_terminals(self):
        output = one("T")
        self.assertEqual(
            output.data["text/latex"], r"$\displaystyle T = \frac{1}{2} m \dot{x}^{2}$"
        )
        self.assertEqual(output.text, "T = ½\u202fm\u202fx\u0307²")

    def test_the_line_for_terminals_is_read_back(self):
        system = qdot.System("param a, b1; coord x, theta1; function f(x)")
        for plain in (
            "1/2*a*x'^2 - 2*b1/theta1^12",
            "sqrt(a)*x^(-1/2) + 1.5e-3",
            "x^2/2*theta1''^3 - -a",
            "a^1/2",
            "[1/2, x; -a, 2^10]",
        ):
            text = outputs(system.display(f"print {plain}"))[-1].text
            self.assertEqual(system.derive(text.rstrip()), system.derive(plain), text)

    def test_a_unit_is_upright(self):
        output = one("p[x]", "param m [kg]; coord x [m]; particle p mass m at (x, 0)")
        self.assertEqual(
            output.data["text/latex"], r"$\displaystyle p_{x} = m \dot{x}\ [\mathrm{kg\,m/s}]$"
        )

    def test_a_number_has_its_error(self):
        _, output = shown("run 0..5; value(x, 5)")
        self.assertRegex(output.text, r"^value\(x, 5\) = -0\.8390715290\d+ ± \de-1\d$")
        self.assertRegex(output.data["text/latex"], r" \\pm \d \\cdot 10\^\{-1\d\}\$$")

    def test_the_numbers_of_one_statement_are_one_output(self):
        found = one("find x = 1 such that value(x, 3) = 2 after 0..3", SCENE + "run 0..1")
        self.assertIn("x = ", found.text)

    def test_lines_with_formulas_are_a_part_of_a_page(self):
        output = one("print \"T < is\", T")
        self.assertEqual(output.text, "T < is ½\u202fm\u202fx\u0307²")
        self.assertIn("<p>T &lt; is <math", output.data["text/html"])


class Tables(unittest.TestCase):
    SWEEP = "sweep k = 1..2 step 1 run 0..1 : max(x, 0..1) as curve"

    def test_rows_make_one_table_with_errors(self):
        output = one(self.SWEEP)
        table = cells(output.data["text/html"])
        self.assertEqual(table[0], ["k", "max(x, 0..1)"])
        self.assertEqual([line[0] for line in table[1:]], ["1", "2"])
        self.assertRegex(table[1][1], r"^1 ± \de-1\d$")
        self.assertEqual(output.text.split("\n")[0], "curve:")
        self.assertEqual(len(output.text.split("\n")), 4)
        self.assertEqual(cells(one("table x every 1", SCENE + "run 0..2").data["text/html"])[2][0], "1")

    def test_a_row_that_failed_says_why(self):
        scene = SCENE.replace("k = 4", "k > 0 = 4")
        output = one("sweep k = [1, -1] run 0..1 : max(x, 0..1)", scene)
        self.assertEqual(
            cells(output.data["text/html"])[-1], ["-1", "–", "k = -1 is outside its domain: k > 0"]
        )

    def test_a_long_table_shows_its_ends_and_its_length(self):
        output = one("table x every 0.01", SCENE + "run 0..9.99")
        table = cells(output.data["text/html"])
        self.assertLess(len(table), 30)
        self.assertEqual((table[1][0], table[-1][0]), ("0", "9.99"))
        self.assertIn("1000 rows", output.text)

    def test_units_make_a_table(self):
        output = one("units", "param m = 1 [kg], mu = 2")
        self.assertEqual(cells(output.data["text/html"])[0], ["m", "a mass", "kg"])


class Runs(unittest.TestCase):
    def test_the_report_is_the_prompts_and_a_table_with_errors(self):
        output = one("run 0..5 tol 1e-9")
        self.assertTrue(output.text.startswith("run1: t = 0..5, method taylor, tol 1e-9, done\n  "))
        table = dict(cells(output.data["text/html"]))
        self.assertRegex(table["x"], r"^-0\.83907\d+ ± \de-\d+$")
        self.assertRegex(table["error of the end state"], "^at most ")

    def test_beyond_the_horizon_no_number_is_shown(self):
        scene = """
            coord a, b
            particle p mass 1 at (sin(a), -cos(a)); gravity (0, -9.81)
            particle q mass 1 at (sin(a) + sin(b), -cos(a) - cos(b))
            start a = 2, b = 1
        """
        output = one("run 0..200 tol 1e-6", scene)
        self.assertIn("horizon: t = ", output.text)
        self.assertNotIn("<math", output.data["text/html"])


class Checks(unittest.TestCase):
    def test_a_check_has_its_claim_and_the_colour_of_what_was_wanted(self):
        for claim, text, look in (
            ("T == m*x'^2/2", "proved", "holds"),
            ("x == 2", "refuted at x = 1: left = 1, right = 2", "fails"),
            ("not x == 2", "refuted at x = 1: left = 1, right = 2", "holds"),
            ("conserved (T + V)^2", "proved", "holds"),
        ):
            output = one("check " + claim)
            self.assertEqual(output.text, text)
            self.assertIn(f'<div class="check {look}">', output.data["text/html"])
            self.assertIn(f"<code>{html.escape(claim, quote=False)}</code>", output.data["text/html"])


class Figures(unittest.TestCase):
    SVG = '<?xml version="1.0"?>\n<svg xmlns="http://www.w3.org/2000/svg"><path d="M0 0"/></svg>'

    def test_a_figure_is_an_svg_element(self):
        (output,) = outputs(
            [{"kind": "figure", "mime": "image/svg+xml", "data": self.SVG, "name": "qdot-1"}]
        )
        self.assertTrue(output.data["image/svg+xml"].startswith("<svg"))
        coded = re.search(r'src="data:image/svg\+xml;base64,([^"]*)"', output.data["text/html"])[1]
        self.assertEqual(base64.b64decode(coded).decode(), output.data["image/svg+xml"])
        self.assertEqual(output.text, "[qdot-1]")

    def test_a_page_survives_being_an_attribute(self):
        page = '<!DOCTYPE html><p title="a&quot;b">x < y && z\'s "q"</p><script>if (1 < 2) f("</p>")</script>'
        shown = page_html(page)
        found = re.search(r'srcdoc="([^"]*)"', shown)
        self.assertEqual(html.unescape(found[1]), page)
        self.assertNotRegex(shown, r"https?://")

    def test_files_that_are_pictures_are_shown(self):
        with tempfile.TemporaryDirectory() as folder:
            for name, data in (
                ("a.svg", self.SVG.encode()),
                ("b.png", b"\x89PNG"),
                ("c.gif", b"GIF89a"),
                ("d.html", b"<p>page</p>"),
                ("e.csv", b"t,x\n"),
            ):
                with open(os.path.join(folder, name), "wb") as file:
                    file.write(data)
            kinds = {}

            def file_answer(name):
                return {"kind": "file", "path": name, "text": f"wrote {name}"}

            for name in ("a.svg", "b.png", "c.gif", "d.html", "e.csv", "missing.svg"):
                wrote, *shown = outputs([file_answer(name)], folder=folder)
                self.assertEqual(wrote.text, f"wrote {name}\n")
                kinds[name] = sorted(set(shown[0].data) - {"text/plain"}) if shown else []
            self.assertEqual(
                kinds,
                {
                    "a.svg": ["image/svg+xml", "text/html"],
                    "b.png": ["image/png"],
                    "c.gif": ["text/html"],
                    "d.html": ["text/html"],
                    "e.csv": [],
                    "missing.svg": [],
                },
            )

    def test_a_bar_says_how_much_is_done(self):
        bundle = progress_bundle("run 0..1e6", 0.5, 12.0)
        self.assertIn("50%, 12 s left", bundle["text/plain"])
        self.assertIn('value="0.5000"', bundle["text/html"])
        self.assertNotIn("left", progress_bundle("sweep", float("nan"), None)["text/plain"])


class Texts(unittest.TestCase):
    def test_texts_are_printed_and_notices_are_warnings(self):
        output = shown('print "a"; print "b"; run 0..1; plot nothing', "coord x; particle p mass 1 at (x, 0)")
        self.assertEqual([o.kind for o in output], ["stdout", "stderr", "display", "error"])
        self.assertEqual(output[0].text, "a\nb\n")
        self.assertTrue(output[1].text.startswith("notice: "))

    def test_an_error_shows_its_line_with_a_caret_and_a_hint(self):
        output = one("x + y")
        self.assertEqual(
            output.text.split("\n")[:3], ["In[3]:1:5: error: unknown name `y`", "  x + y", "      ^"]
        )
        self.assertTrue(output.text.split("\n")[3].startswith("  hint: "))

    def test_a_name_of_another_cell_is_found_there(self):
        system = qdot.System()
        self.assertEqual(system.display("param a", "In[3]"), [])
        (output,) = outputs(system.display("\ncoord a", "In[7]"))
        self.assertTrue(output.text.startswith("In[7]:2:7: error: `a` was declared before, at In[3]:1\n"))

    def test_an_answer_of_a_later_library_is_not_lost(self):
        (output,) = outputs([{"kind": "surprise", "data": 1}])
        self.assertIn("surprise", output.text)

    def test_each_answer_of_a_session_has_an_output(self):
        answers = qdot.System().display(
            """
            param m = 1, k = 4
            coord x
            particle p mass m at (x, 0); potential k*x^2/2
            start x = 1
            T; eom; equilibria; dof; conserved; scene; help run
            check conserved energy; check T == 1
            run 0..5; value(x, x', 3); table x every 1
            sweep k = 1..2 step 0.5 run 0..1 : x as curve
            x = 1
        """
        )
        every = outputs(answers)
        self.assertEqual(every[-1].kind, "error")
        for output in every:
            self.assertTrue(output.text.strip())
            if "text/html" in output.data:
                xml.etree.ElementTree.fromstring(f"<div>{output.data['text/html']}</div>")


if __name__ == "__main__":
    unittest.main()
