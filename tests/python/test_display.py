"""test_display.py -- answers as outputs of a notebook: what a browser and what a terminal shows."""
import base64
import html
import os
import re
import tempfile
import unittest
import xml.etree.ElementTree

import qdot
from qdot.display import error_lines, outputs, page_html, progress_bundle
from qdot.notation import bound_text, latex_name, number_text, unicode_formula, unicode_name


def one(answer, **more):
    """Return the only output of one answer."""
    shown = outputs([answer], **more)
    assert len(shown) == 1, shown
    return shown[0]


def cells(page):
    """Return the texts of the cells of the HTML's tables, row by row; it must be well-formed."""
    tree = xml.etree.ElementTree.fromstring(f"<div>{page}</div>")
    return [["".join(cell.itertext()) for cell in row] for row in tree.iter("tr")]


def row(*values, **more):
    return {"kind": "row", "name": "curve", "values": list(values), **more}


class Numbers(unittest.TestCase):
    def test_a_value_has_the_digits_that_its_error_leaves(self):
        for value, error, text in (
            (1.25, 0.0, "1.25"),
            (0.1, 0.0, "0.1"),
            (1e-20, 0.0, "1e-20"),
            (123456.0, 0.0, "123456"),
            (-1.4107066889415911, 1.07e-13, "-1.4107066889416 ± 2e-13"),
            (0.13311084972674495, 1.25e-5, "0.13311 ± 2e-5"),
            (-30.15573, 3.8e-4, "-30.1557 ± 0.0004"),
            (1.2996, 0.001, "1.300 ± 0.001"),
            (31415.9, 200.0, "31400 ± 200"),
            (6.02214e23, 1e19, "6.0221e23 ± 1e19"),
            (1e-16, 2e-13, "0 ± 2e-13"),
            (8.0, 3.6e-16, "8 ± 4e-16"),
            (0.5, None, "0.5 ± unknown"),
            (0.5, float("inf"), "0.5 ± unknown"),
            (None, None, "unknown"),
            ([1.0, -2.0], 0.0, "1 - 2i"),
            ("1.41421356237309504880", 1e-20, "1.41421356237309504880 ± 1e-20"),
        ):
            self.assertEqual(number_text(value, error), text)

    def test_a_bound_rounded_stays_a_bound(self):
        for k in range(-40, 40):
            for digits in (1.0, 1.0001, 1.5, 2.0, 9.0, 9.00001, 9.9999):
                bound = digits * 10.0**k
                self.assertGreaterEqual(float(bound_text(bound)), bound * (1 - 1e-9))
                self.assertLessEqual(float(bound_text(bound)), bound * 2.0001)

    def test_the_rounded_value_is_within_its_error(self):
        for value in (1.23456789, 9.99999, -0.000123456, 98765.4321, 5e-7):
            for power in range(-12, 4):
                text, _, bound = number_text(value, 1.3 * 10.0**power).partition(" ± ")
                self.assertLessEqual(abs(float(text) - value), 0.5000001 * float(bound) + 1e-15)

    def test_names_are_written_as_physicists_do(self):
        self.assertEqual(unicode_name("theta1'"), "θ\u0307₁")
        self.assertEqual(unicode_name("x''"), "ẍ")
        self.assertEqual(unicode_name("deltatheta"), "δθ")
        self.assertEqual(unicode_name("max(abs(x1), 10..20)"), "max(abs(x₁), 10..20)")
        self.assertEqual(unicode_name("mu_k"), "mu_k")
        self.assertEqual(latex_name("Omega2''"), r"\ddot{\Omega}_{2}")
        self.assertEqual(latex_name("speed"), r"\mathrm{speed}")
        self.assertEqual(
            latex_name("max(abs(x1'), 0..5)"),
            r"\operatorname{max}(\operatorname{abs}(\dot{x}_{1}),\ 0..5)",
        )
        self.assertEqual(latex_name("lambda[rod_1]^2"), r"\lambda[\mathrm{rod\_1}]^{2}")


class Formulas(unittest.TestCase):
    def test_a_formula_is_latex_for_browsers_and_a_line_for_terminals(self):
        (answer,) = qdot.System("param m; coord x; particle p mass m at (x, 0)").display("T")
        output = one(answer)
        self.assertEqual(
            output.data["text/latex"], r"$\displaystyle T = \frac{1}{2} m \dot{x}^{2}$"
        )
        self.assertEqual(output.text, "T = ½\u202fm\u202fẋ²")

    def test_the_line_for_terminals_is_read_back(self):
        system = qdot.System("param a, b1; coord x, theta1; function f(x)")
        for plain in (
            "1/2*a*x'^2 - 2*b1/theta1^12",
            "sqrt(a)*x^(-1/2) + 1.5e-3",
            "x^2/2*theta1''^3 - -a",
            "a^1/2",
            "diff(f(x), x, 2)*(1/2)",
            "[1/2, x; -a, 2^10]",
            "x = -1/2",
            "1/2^a + 1/2/a + 11/2*a",
        ):
            text = unicode_formula(plain)
            self.assertEqual(system.derive(text), system.derive(plain), text)

    def test_an_equation_has_its_name_before_a_colon(self):
        output = one(
            {"kind": "expr", "name": "eom[x]", "plain": "m*x'' = 0", "latex": r"m \ddot{x} = 0"}
        )
        self.assertEqual(output.text, "eom[x]: m\u202fẍ = 0")
        listed = one({"kind": "expr", "name": "e", "plain": "[x = 0]", "latex": "[x = 0]"})
        self.assertEqual(listed.text, "e = [x = 0]")

    def test_a_unit_is_upright(self):
        (answer,) = qdot.System("param m [kg]; coord x [m]; particle p mass m at (x, 0)").display(
            "p[x]"
        )
        self.assertEqual(
            one(answer).data["text/latex"],
            r"$\displaystyle p_{x} = m \dot{x}\ [\mathrm{kg\,m/s}]$",
        )

    def test_an_answer_that_is_its_own_name_is_written_once(self):
        output = one({"kind": "expr", "name": "2*x", "plain": "2*x", "latex": "2 x"})
        self.assertEqual(
            (output.text, output.data["text/latex"]), ("2\u202fx", r"$\displaystyle 2 x$")
        )

    def test_words_on_a_formula_stand_behind_it(self):
        formula = {"kind": "expr", "name": "equilibria[1]", "plain": "[x = 0]", "latex": "[x = 0]"}
        words = {"kind": "text", "name": "equilibria[1]", "text": "stable when k > 0"}
        (output,) = outputs([formula, words])
        self.assertTrue(output.text.endswith(", stable when k > 0"))
        self.assertTrue(output.data["text/latex"].endswith(r",\quad \text{stable when k > 0}$"))
        self.assertEqual(len(outputs([formula, {**words, "text": "a\nb"}])), 2)

    def test_a_number_has_its_error(self):
        output = one(
            {"kind": "number", "name": "value(x, 5)", "value": 2.5, "error": 2e-13, "unit": "m/s^2"}
        )
        self.assertEqual(output.text, "value(x, 5) = 2.5000000000000 ± 2e-13 [m/s^2]")
        self.assertIn(r"2.5000000000000 \pm 2 \times 10^{-13}", output.data["text/latex"])
        several = one(
            {"kind": "numbers", "name": "value(x, y, 5)", "values": [1, 2], "errors": [0.1, None]}
        )
        self.assertEqual(several.text, "value(x, y, 5) = 1.0 ± 0.1, 2 ± unknown")

    def test_the_unknowns_of_a_fit_have_standard_errors(self):
        fit = [
            {"kind": "number", "name": "g", "value": 9.8123, "error": 0.01234, "statement": 4},
            {"kind": "number", "name": "chi^2", "value": 0.5, "error": None, "statement": 4},
            {
                "kind": "number",
                "name": "degrees of freedom",
                "value": 3,
                "error": 0,
                "statement": 4,
            },
        ]
        (output,) = outputs(fit)
        self.assertEqual(
            cells(output.data["text/html"]),
            [["g", "9.812 ± 0.012"], ["χ²", "0.5"], ["degrees of freedom", "3"]],
        )


class Tables(unittest.TestCase):
    def test_rows_make_one_table_with_errors(self):
        columns = {
            "kind": "columns",
            "name": "curve",
            "columns": ["omega", "max(abs(x))"],
            "units": ["1/s", None],
        }
        table = [
            columns,
            row(1, 0.5, errors=[0, 2e-4], status="done"),
            row(2, 1.5, errors=[0, None], status="done"),
        ]
        (output,) = outputs(table)
        self.assertEqual(
            cells(output.data["text/html"]),
            [["ω [1/s]", "max(abs(x))"], ["1", "0.5000 ± 0.0002"], ["2", "1.5 ± unknown"]],
        )
        self.assertEqual(output.text.split("\n")[0], "curve:")
        self.assertEqual(len(output.text.split("\n")), 4)

    def test_a_row_that_failed_says_why(self):
        (output,) = outputs(
            [
                row(1, 0.5, errors=[0, 0.1], status="done"),
                row(2, None, errors=[0, None], status="failed", reason="r reached 0 <at> t = 3"),
            ]
        )
        self.assertEqual(
            cells(output.data["text/html"])[-1], ["2", "–", "failed: r reached 0 <at> t = 3"]
        )

    def test_branches_say_what_is_stable(self):
        branch = [
            {"kind": "columns", "name": "branch[1]", "columns": ["Omega", "theta"]},
            {"kind": "row", "name": "branch[1]", "values": [0, 0], "stable": True},
            {"kind": "row", "name": "branch[1]", "values": [4, 0], "stable": False},
            {"kind": "row", "name": "bifurcation", "type": "pitchfork", "values": [3.1, 0]},
        ]
        first, second = outputs(branch)
        self.assertEqual(
            [line[-1] for line in cells(first.data["text/html"])], ["stable", "stable", "unstable"]
        )
        self.assertEqual(cells(second.data["text/html"]), [["type"], ["3.1", "0", "pitchfork"]][1:])

    def test_a_long_table_shows_its_ends_and_its_length(self):
        (output,) = outputs([row(k, k * k) for k in range(1000)])
        shown = cells(output.data["text/html"])
        self.assertLess(len(shown), 30)
        self.assertEqual((shown[0][0], shown[-1][0]), ("0", "999"))
        self.assertIn("1000 rows", output.text)

    def test_units_make_a_table(self):
        (output,) = outputs(
            [
                {"kind": "unit", "name": "m", "dimension": "a mass", "unit": "kg"},
                {"kind": "unit", "name": "mu", "dimension": "a number", "unit": ""},
            ]
        )
        self.assertEqual(cells(output.data["text/html"])[2], ["μ", "a number", "–"])


class Runs(unittest.TestCase):
    RUN = {
        "kind": "run",
        "name": "run1",
        "method": "taylor",
        "t": [0, 20],
        "tol": 1e-12,
        "steps": 351,
        "rejected": 0,
        "evals": 351,
        "cpu": 0.0005,
        "cpu_total": 2.5,
        "error": 1.25e-5,
        "horizon": None,
        "drifts": {"energy": 2.3e-14},
        "constraint_drift": None,
        "state": {"theta": -30.155732472969305, "theta'": 4.799269779374675},
        "status": "done",
        "reason": None,
    }

    def test_the_end_state_has_absolute_errors(self):
        output = one(self.RUN)
        shown = dict(line for line in cells(output.data["text/html"]))
        self.assertEqual(shown["θ"], "-30.1557 ± 0.0004")
        self.assertEqual(shown["θ\u0307"], "4.79927 ± 6e-5")
        self.assertEqual(shown["error of the end state"], "at most 2e-5 of max(1, |value|)")
        self.assertEqual(shown["CPU time"], "0.5 ms, in all 2.5 s")
        self.assertIn("θ = -30.1557 ± 0.0004", output.text)

    def test_an_unknown_error_is_said(self):
        output = one({**self.RUN, "error": None})
        self.assertIn("error of the end state: unknown", output.text)
        self.assertIn("± unknown", output.text)

    def test_beyond_the_horizon_no_number_is_shown(self):
        output = one({**self.RUN, "horizon": 17.3})
        self.assertNotIn("30.15", output.text + output.data["text/html"])
        self.assertIn("horizon: t = 17.3", output.text)

    def test_multipliers_have_their_own_errors(self):
        state = {"x": 0.5, "lambda[rod]": -14.7251}
        output = one({**self.RUN, "state": state, "constraints": {"errors": {"lambda[rod]": 0.02}}})
        self.assertIn("λ[rod] = -14.73 ± 0.02", output.text)


class Checks(unittest.TestCase):
    REFUTED = {
        "kind": "check",
        "verdict": "refuted",
        "claim": "T == x'^2",
        "left": "m*x'^2",
        "right": "x'^2",
        "at": {"m": 2, "x'": -1},
        "values": [2, 1],
    }

    def test_a_refuted_claim_shows_its_counterexample(self):
        output = one(self.REFUTED)
        self.assertEqual(
            output.text, "✗ refuted at m = 2, ẋ = -1: left = 2, right = 1   (T == x'^2)"
        )
        self.assertEqual(
            cells(output.data["text/html"]), [["m", "ẋ", "left", "right"], ["2", "-1", "2", "1"]]
        )

    def test_a_refutation_that_was_expected_is_no_failure(self):
        self.assertTrue(
            one({**self.REFUTED, "claim": "not T == x'^2"}).text.startswith("✓ refuted")
        )
        self.assertTrue(
            one({**self.REFUTED, "claim": "not x == x", "verdict": "proved"}).text.startswith(
                "✗ proved"
            )
        )

    def test_undecided_claims_no_proof(self):
        undecided = {"kind": "check", "verdict": "undecided", "claim": "a == b", "digits": 40}
        self.assertIn(
            "undecided: equal at random points to 40 digits, no proof", one(undecided).text
        )
        self.assertIn("no counterexample", one({**undecided, "digits": 0}).text)


class Figures(unittest.TestCase):
    SVG = '<?xml version="1.0"?>\n<svg xmlns="http://www.w3.org/2000/svg"><path d="M0 0"/></svg>'

    def test_a_figure_is_an_svg_element(self):
        output = one(
            {"kind": "figure", "mime": "image/svg+xml", "data": self.SVG, "name": "qdot-1"}
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
            for name in ("a.svg", "b.png", "c.gif", "d.html", "e.csv", "missing.svg"):
                wrote, *shown = outputs([{"kind": "file", "path": name}], folder=folder)
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
        shown = outputs(
            [
                {"kind": "text", "text": "a"},
                {"kind": "text", "text": "b\n"},
                {"kind": "notice", "message": "mind the gap"},
            ]
        )
        self.assertEqual(
            [(o.kind, o.text) for o in shown],
            [("stdout", "a\nb\n"), ("stderr", "notice: mind the gap\n")],
        )

    def test_an_error_shows_its_line_with_a_caret_and_a_hint(self):
        error = {
            "kind": "error",
            "file": "ask",
            "line": 2,
            "column": 4,
            "message": "unknown name `y`",
            "hint": "write x",
        }
        self.assertEqual(
            error_lines(error, "coord x\nθ +y", "In[3]"),
            ["In[3]:2:4: error: unknown name `y`", "  θ +y", "     ^", "  hint: write x"],
        )
        other = {**error, "file": "other.lag", "hint": None}
        self.assertEqual(
            error_lines(other, "coord x\ny", "In[3]"), ["other.lag:2:4: error: unknown name `y`"]
        )

    def test_an_answer_of_a_later_library_is_not_lost(self):
        self.assertIn("surprise", one({"kind": "surprise", "data": 1}).text)

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
        shown = outputs(answers)
        self.assertEqual(shown[-1].kind, "error")
        for output in shown:
            self.assertTrue(output.text.strip())
            if "text/html" in output.data:
                xml.etree.ElementTree.fromstring(f"<div>{output.data['text/html']}</div>")


if __name__ == "__main__":
    unittest.main()
