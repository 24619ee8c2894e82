"""test_notebooks.py -- every notebook of examples/notebooks runs from its first cell to its last."""
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

try:
    import ipykernel
    import nbconvert
    import nbformat
    from nbconvert.preprocessors import ExecutePreprocessor
except ImportError as missing:
    raise unittest.SkipTest(f"no {missing.name}")

assert ipykernel
HERE = os.path.dirname(os.path.abspath(__file__))
NOTEBOOKS = os.path.join(HERE, "..", "..", "..", "examples", "notebooks")


class Notebooks(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        os.environ["JUPYTER_PATH"] = os.path.join(cls.folder.name, "share", "jupyter")
        os.environ["JUPYTER_DATA_DIR"] = os.path.join(cls.folder.name, "data")
        os.environ["JUPYTER_RUNTIME_DIR"] = os.path.join(cls.folder.name, "runtime")
        os.environ["IPYTHONDIR"] = os.path.join(cls.folder.name, "ipython")
        for module in ("qdot.kernel", "ipykernel"):
            subprocess.run(
                [sys.executable, "-m", module, "install", "--prefix", cls.folder.name],
                check=True,
                stdout=subprocess.DEVNULL,
                stderr=subprocess.DEVNULL,
            )

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def execute(self, name):
        """Return the notebook with its outputs, and as a page; executed in a copy of its folder."""
        folder = os.path.join(self.folder.name, name)
        shutil.copytree(NOTEBOOKS, folder)
        notebook = nbformat.read(os.path.join(folder, name + ".ipynb"), as_version=4)
        nbformat.validate(notebook)
        for cell in notebook.cells:
            self.assertFalse(cell.get("outputs"), "stored without outputs")
        ExecutePreprocessor(timeout=120).preprocess(notebook, {"metadata": {"path": folder}})
        self.assertEqual(
            sorted(os.listdir(folder)), sorted(os.listdir(NOTEBOOKS)), "nothing is left beside it"
        )
        page, _ = nbconvert.HTMLExporter().from_notebook_node(notebook)
        return notebook, page

    def outputs(self, notebook, mime):
        """Return the outputs of a kind."""
        return [
            output.data[mime]
            for cell in notebook.cells
            for output in cell.get("outputs", [])
            if mime in output.get("data", {})
        ]

    def shows(self, page, text):
        self.assertTrue(text in page, f"the page lacks {text}")

    def test_double_pendulum(self):
        notebook, page = self.execute("double-pendulum")
        self.assertTrue(
            any(r"\ddot{\theta}_{1}" in text for text in self.outputs(notebook, "text/latex"))
        )
        self.assertEqual(len(self.outputs(notebook, "image/svg+xml")), 2)
        self.shows(page, "<iframe")
        self.shows(page, "✗ refuted")
        self.shows(page, "0.13311 ± 2e-5")

    def test_metrics(self):
        notebook, page = self.execute("metrics")
        self.shows(page, "✓ proved")
        self.assertGreater(len(self.outputs(notebook, "text/latex")), 20)

    def test_lab_pendulum(self):
        notebook, page = self.execute("lab-pendulum")
        self.shows(page, "the pictures scatter by 2.0 mm")
        self.assertEqual(len(self.outputs(notebook, "image/svg+xml")), 2)

    def test_resonance(self):
        notebook, page = self.execute("resonance")
        self.assertEqual(len(self.outputs(notebook, "image/svg+xml")), 3)
        self.shows(page, "✓ proved")


if __name__ == "__main__":
    unittest.main()
