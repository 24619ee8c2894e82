"""run_all.py -- run the tests of the kernel, the magics and the example notebooks, and print TAP.

    PYTHONPATH=python python3 tests/python/jupyter/run_all.py [test_NAME...]

They are apart from the other tests of the package because each needs more of Jupyter, and more time.
"""
import os
import sys
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(1, os.path.dirname(HERE))

from run import Points, flat  # noqa: E402


def main():
    names = sys.argv[1:]
    suite = unittest.defaultTestLoader.discover(HERE, top_level_dir=HERE)
    tests = [test for test in flat(suite) if not names or any(name in test.id() for name in names)]
    if not tests:
        sys.exit("run_all.py: no tests")
    result = Points()
    unittest.TestSuite(tests).run(result)
    print(f"1..{result.testsRun}")
    sys.exit(0 if result.wasSuccessful() else 1)


if __name__ == "__main__":
    main()
