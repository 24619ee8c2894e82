"""test_magic.py -- cells in the language of qdot beside cells of Python."""
import contextlib
import io
import re
import unittest

try:
    import IPython.core.completer
    from IPython.core.interactiveshell import InteractiveShell
    from IPython.utils.capture import capture_output
except ImportError as missing:
    raise unittest.SkipTest(f"no {missing.name}")
import numpy
import qdot

SCENE = "coord x\nparticle p mass m at (x, 0)\npotential k*x^2/2\nstart x = 1\n"


class Magic(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.shell = InteractiveShell.instance()
        cls.shell.colors = "NoColor"

    def setUp(self):
        self.shell.reset(new_session=False)
        self.shell.extension_manager.loaded.discard("qdot")
        self.shell.run_line_magic("load_ext", "qdot")
        self.names = self.shell.user_ns

    def cell(self, options, code):
        with capture_output() as said:
            self.shell.run_cell_magic("qdot", options, code)
        return said

    def line(self, text):
        with capture_output() as said:
            self.shell.run_line_magic("qdot", text)
        return said

    def fails(self, text):
        """Return what a cell of the notebook that fails says."""
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed), contextlib.redirect_stderr(printed):
            self.assertFalse(self.shell.run_cell(text).success)
        return re.sub(r"\x1b\[[0-9;]*m", "", printed.getvalue())

    def test_numbers_go_in_and_formulas_come_out(self):
        self.names.update(m=2, k=numpy.float64(8))
        self.cell("-i m,k -o T", SCENE)
        self.assertEqual(str(self.names["T"]), "1/2*m*x'^2")
        self.names["k"] = 2  # a parameter that is there is set
        self.cell('-i k -o "x1=value(x, 1)"', "run 0..1")
        self.assertAlmostEqual(self.names["x1"], numpy.cos(1), delta=self.names["x1"].error)
        self.assertGreater(self.names["x1"].error, 0)
        self.assertIn("±", repr(self.names["x1"]))

    def test_a_variable_named_as_a_coordinate_is_its_start(self):
        self.names.update(m=1, k=1, x=0.25)
        self.cell("-i m,k", SCENE)
        self.cell('-i x -o "x0=value(x, 0)"', "run 0..1")
        self.assertEqual(self.names["x0"], 0.25)

    def test_a_run_comes_out_as_a_motion(self):
        self.names.update(m=1, k=1)
        self.cell('-i m,k -o "a=run 0..10"', SCENE)
        self.assertAlmostEqual(self.names["a"].values("x", [1.0])[0], numpy.cos(1))

    def test_a_run_of_the_session_comes_out_by_its_name(self):
        self.names.update(m=1, k=1)
        self.cell("-i m,k -o a,T,run2", SCENE + "run 0..10 as a\nrun 0..2")
        self.assertAlmostEqual(self.names["a"].values("x", 10), numpy.cos(10))
        self.assertEqual((self.names["run2"].summary.end, str(self.names["T"])), (2, "1/2*m*x'^2"))
        self.line("-o again=a")
        self.assertEqual(self.names["again"].summary.end, 10)
        self.assertIn("UsageError: -o: `b`: unknown name `b`; `param b`", self.fails("%qdot -o b"))

    def words(self, text, cursor=None):
        """Return what Tab offers in a cell, as what it would become, and the rest of the cell."""
        cursor = len(text) if cursor is None else cursor
        with IPython.core.completer.provisionalcompleter():
            found = list(self.shell.Completer.completions(text, cursor))
        return [text[: one.start] + one.text + text[one.end :] for one in found]

    def test_tab_completes_words_of_the_language(self):
        self.names.update(mass=1, matrix=2, system=qdot.System("coord theta"), s=3)
        self.line("coord phi; param omega")
        for text, wanted in (
            ("%%qdot\nstart ph", ["%%qdot\nstart phi"]),
            ("%%qdot -i mass\n# θ\nT\nstart ph", ["%%qdot -i mass\n# θ\nT\nstart phi"]),
            ("%%qdot --system system\nstart th", ["%%qdot --system system\nstart theta"]),
            ("%qdot sensitiv", ["%qdot sensitivity"]),
            ("x = 1\n%qdot -o T,x1=2 start ph", ["x = 1\n%qdot -o T,x1=2 start phi"]),
            ("%%qdot -i ma", ["%%qdot -i mass", "%%qdot -i matrix"]),
            ("%%qdot -i s,mas", ["%%qdot -i s,mass"]),
            ("%%qdot --system sy", ["%%qdot --system system"]),
            ("%%qdot --sy", ["%%qdot --system"]),
            ("%%qdot -o x1=ome", ["%%qdot -o x1=omega"]),
            ("%%qdot\nnowordbeginsso", []),
            ("%%qdot\n\0", []),
        ):
            with self.subTest(repr(text)):
                self.assertEqual(self.words(text), wanted)
        self.assertEqual(self.words("%%qdot\nstart ph = 1\nT", 15), ["%%qdot\nstart phi = 1\nT"])
        self.assertIn("numpy.linspace", self.words("import numpy\nnumpy.linsp")[0].split("\n"))
        self.shell.run_line_magic("reload_ext", "qdot")
        self.assertEqual(self.words("%%qdot\nsensitiv"), ["%%qdot\nsensitivity"])
        for text in "%%qdot -i mass --system s -o T\nrun 0..10\nx", "%qdot -o a run 0..3", "y = 1\n%qdot":
            for cursor in range(len(text) + 1):
                self.words(text, cursor)

    def test_a_table_is_the_file_of_its_name(self):
        t = numpy.linspace(0, 2, 9)
        self.names.update(m=1, k=1, data={"t": t, "x": numpy.cos(2 * t)})
        self.cell("-i m,k", SCENE)
        self.cell("-i data -o found=k", 'set k = 3\nfit k to "data" : t, x')
        self.line('-o "found=numeric(k)"')
        self.assertAlmostEqual(self.names["found"], 4)
        array = numpy.array(list(zip(t, numpy.cos(3 * t))), dtype=[("t", float), ("x", float)])
        self.names["data"] = array
        self.cell('-i data -o "found=numeric(k)"', 'fit k to "data" : t, x')
        self.assertAlmostEqual(self.names["found"], 9)

    def test_lists_matrices_and_formulas_go_in(self):
        self.names.update(v=[1, 0.5], A=numpy.array([[1, 2], [3, 4]]))
        said = self.cell("-i v,A", "v[2]\ndet(A)")
        texts = [output.data["text/plain"] for output in said.outputs]
        self.assertEqual(texts, ["v[2] = ½", "det(A) = −2"])
        self.names["half"] = qdot.System("coord q").derive("q/2")
        self.line("coord q")
        said = self.cell("-i half", "half")
        self.assertIn("q", said.outputs[0].data["text/plain"])

    def test_a_line_is_a_statement(self):
        said = self.line("-o third 1/3; third = 1/3")
        self.assertEqual(said.outputs[0].data["text/latex"], r"$\displaystyle \frac{1}{3}$")
        self.assertAlmostEqual(self.names["third"], 1 / 3)

    def test_systems_are_held_by_variables(self):
        self.cell("--system first", "param a = 1")
        self.cell("--system second", "param a = 2")
        self.assertEqual([self.names[s].number("a") for s in ("first", "second")], [1, 2])
        self.names["first"].declare("set a = 3")
        self.line('--system first -o "a=numeric(a)"')
        self.assertEqual(self.names["a"], 3)

    def test_an_error_shows_its_line_and_no_traceback(self):
        said = self.fails("%%qdot\nparam m = 1\nset n = 2\n")
        self.assertIn(
            "2:5: error: there is no parameter `n`\n  set n = 2\n      ^\n  hint: write param n = 2",
            said,
        )
        self.assertNotIn("Traceback", said)

    def test_what_cannot_be_passed_is_said(self):
        self.names.update(
            f=len,
            z=1j,
            s="text",
            ragged=[[1, 2], [3]],
            empty=None,
            columns={"t": [1], "x": [1, 2]},
            nan=float("nan"),
            complexes=numpy.array([1j]),
            nones=[1, None],
            cells={"t": 1, "x": 2},
        )
        for name in "f z s ragged empty columns nan missing complexes nones cells".split():
            said = self.fails(f"%%qdot -i {name}\n1\n")
            self.assertIn(f"`{name}`", said)
            self.assertNotIn("Traceback", said)
        for options in ("--wrong 1", "-o 2x", "--system s", "T", "-o class=1", "--system class", "-o x=",
                        "-o =x", "-o x=nonsense", "-o x=1/0", "-o x=run"):
            said = self.fails(f"%%qdot {options}\n1\n")
            self.assertIn("UsageError", said)
            self.assertNotIn("Traceback", said)


if __name__ == "__main__":
    unittest.main()
