"""test_library.py -- where libqdot is missing or something else, the error says what to do."""
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

import qdot

USE = "import qdot; print('imported'); qdot.System()"


class Missing(unittest.TestCase):
    def python(self, folder, *command, **variables):
        """Run Python with the package in a folder."""
        return subprocess.run([sys.executable, *command], env={"PYTHONPATH": folder, **variables}, cwd=folder,
                              capture_output=True, text=True)

    def test_a_path_that_is_no_libqdot(self):
        folder = os.path.dirname(os.path.dirname(qdot.__file__))
        for path in "/no/such/libqdot.so", "/", qdot.__file__, "libm.so.6":
            with self.subTest(path):
                done = self.python(folder, "-c", USE, QDOT_LIBRARY=path)
                self.assertEqual((done.returncode, done.stdout), (1, "imported\n"))
                self.assertRegex(done.stderr, f"ImportError: QDOT_LIBRARY is set to '{path}': .*; set it to")

    def test_no_library_at_all(self):
        with tempfile.TemporaryDirectory() as folder:
            shutil.copytree(os.path.dirname(qdot.__file__), os.path.join(folder, "qdot"),
                            ignore=shutil.ignore_patterns("_where.py", "__pycache__"))
            done = self.python(folder, "-c", USE)
            if done.returncode == 0:
                self.skipTest("libqdot is installed where the loader looks")
            self.assertIn("ImportError: no libqdot is found: install qdot, or set", done.stderr)
            done = self.python(folder, "-m", "qdot.kernel", "install", "--prefix", folder)
            self.assertEqual(done.returncode, 1)
            self.assertRegex(done.stderr, "no libqdot is found|client library is missing")
            self.assertNotIn("Traceback", done.stderr)


if __name__ == "__main__":
    unittest.main()
