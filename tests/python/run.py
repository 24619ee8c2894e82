"""run.py -- run the tests of the Python package and the examples in its docstrings, and print TAP.

    QDOT_LIBRARY=build/.libs/libqdot.so.0 PYTHONPATH=python python3 tests/python/run.py [test_NAME...]
"""
import doctest
import importlib
import importlib.util
import os
import pkgutil
import re
import signal
import sys
import unittest

import qdot

HERE = os.path.dirname(os.path.abspath(__file__))


class Points(unittest.TestResult):
    """Prints a point for each test, with what went wrong."""

    def point(self, test, verdict, skipped="", said=""):
        name = test.id().replace("_", " ").replace("#", "")
        more = f" # SKIP {skipped}" if skipped else ""
        print(f"{verdict} {self.testsRun} - {name}{more}", flush=True)
        for line in said.splitlines():
            print("#", line, flush=True)

    def addSuccess(self, test):
        self.point(test, "ok")

    def addSkip(self, test, reason):
        self.point(test, "ok", skipped=reason)

    def addFailure(self, test, error):
        super().addFailure(test, error)
        self.point(test, "not ok", said=self.failures[-1][1])

    def addError(self, test, error):
        super().addError(test, error)
        self.point(test, "not ok", said=self.errors[-1][1])

    def addSubTest(self, test, subtest, error):
        super().addSubTest(test, subtest, error)
        if error is not None:
            self.testsRun += 1
            said = (self.failures + self.errors)[-1][1]
            self.point(subtest, "not ok", said=said)


def modules(package):
    """Yield the package's modules that can be imported with what is installed here."""
    yield package
    for found in pkgutil.walk_packages(package.__path__, package.__name__ + "."):
        if found.name.endswith("__main__"):
            continue
        try:
            yield importlib.import_module(found.name)
        except ImportError as error:
            if error.name and error.name.startswith("qdot"):
                raise
            print(f"# {found.name} is left out: {error}")


def manual():
    """Return the examples of the manual's chapter as a test."""
    path = os.path.join(HERE, "..", "..", "doc", "python.texi")
    with open(path, encoding="utf-8") as file:
        lines = file.read().splitlines()
    lines = ["" if re.match(r"@[a-z]", line) else re.sub(r"@([@{}])", r"\1", line) for line in lines]
    test = doctest.DocTestParser().get_doctest("\n".join(lines) + "\n", {}, "the manual", path, 0)
    return possible(test)


def possible(test):
    """Return a test of examples, without those that want SymPy where it is not installed."""
    if importlib.util.find_spec("sympy") is None:
        for example in test.examples:
            if "sympy" in example.source:
                example.options[doctest.SKIP] = True
    return doctest.DocTestCase(test)


def main():
    names = sys.argv[1:]
    suite = unittest.TestSuite()
    sys.path.insert(0, HERE)
    signal.signal(signal.SIGINT, signal.default_int_handler)  # in the background it is ignored
    suite.addTests(unittest.defaultTestLoader.discover(HERE, top_level_dir=HERE))
    for module in modules(qdot):
        found = doctest.DocTestFinder().find(module)
        suite.addTest(unittest.TestSuite([possible(test) for test in found if test.examples]))
    suite.addTest(unittest.TestSuite([manual()]))
    tests = [test for part in suite for test in flat(part)]
    tests = [test for test in tests if not names or any(name in test.id() for name in names)]
    if not tests:
        sys.exit("run.py: no tests")
    result = Points()
    unittest.TestSuite(tests).run(result)
    print(f"1..{result.testsRun}")
    sys.exit(0 if result.wasSuccessful() else 1)


def flat(part):
    """Yield the tests of a suite of suites."""
    if isinstance(part, unittest.TestSuite):
        for member in part:
            yield from flat(member)
    else:
        yield part


if __name__ == "__main__":
    main()
