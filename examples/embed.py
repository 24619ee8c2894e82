"""embed.py -- libqdot from Python: a pendulum declared, derived, decided, run and read.

    python3 embed.py

With ctypes alone; LIBQDOT is the path of the library, if the loader does not find it by itself.
"""
import ctypes
import os
from ctypes import POINTER, byref, c_char_p, c_double, c_int, c_size_t, c_void_p

PLAIN, UNICODE, LATEX, MATHML, JSON = range(5)
MAX, MIN, MEAN, DRIFT = range(4)
VERDICTS = ("proved", "refuted", "undecided")

lib = ctypes.CDLL(os.environ.get("LIBQDOT", "libqdot.so.0"))


def prototype(name, result, *arguments):
    function = getattr(lib, name)
    function.restype, function.argtypes = result, arguments


prototype("qdot_result_text", c_char_p, c_int)
prototype("qdot_string_free", None, c_void_p)
prototype("qdot_system_new", c_int, POINTER(c_void_p))
prototype("qdot_system_free", None, c_void_p)
prototype("qdot_system_error", c_char_p, c_void_p)
prototype("qdot_system_declare", c_int, c_void_p, c_char_p)
prototype("qdot_system_derive", c_int, c_void_p, c_char_p, c_int, POINTER(c_void_p))
prototype("qdot_system_decide", c_int, c_void_p, c_char_p, POINTER(c_int))
prototype("qdot_system_run", c_int, c_void_p, c_char_p, POINTER(c_void_p))
prototype("qdot_motion_free", None, c_void_p)
prototype("qdot_motion_summarize", c_int, c_void_p, c_void_p, c_size_t)
prototype("qdot_motion_values", c_int, c_void_p, c_char_p, c_size_t, POINTER(c_double), c_size_t,
          POINTER(c_double), POINTER(c_double))
prototype("qdot_motion_over", c_int, c_void_p, c_int, c_char_p, c_double, c_double,
          POINTER(c_double), POINTER(c_double))


class Summary(ctypes.Structure):
    _fields_ = [(name, c_double) for name in ("start", "end", "tolerance", "error", "horizon",
                                              "energy_drift", "constraint_drift", "cpu")] + \
               [(name, c_size_t) for name in ("steps", "rejected", "evaluations")] + \
               [(name, c_char_p) for name in ("method", "reason", "doubt")]


class Error(Exception):
    """result: a few words; str(): what the library says."""

    def __init__(self, system, result):
        super().__init__(lib.qdot_system_error(system).decode())
        self.result = lib.qdot_result_text(result).decode()


class System:
    def __init__(self, text=""):
        self.handle = c_void_p()
        self.need(lib.qdot_system_new(byref(self.handle)))
        self.declare(text)

    def __del__(self):
        lib.qdot_system_free(self.handle)

    def need(self, result):
        if result != 0:
            raise Error(self.handle, result)

    def declare(self, text):
        self.need(lib.qdot_system_declare(self.handle, text.encode()))

    def derive(self, expression, notation=PLAIN):
        text = c_void_p()
        self.need(lib.qdot_system_derive(self.handle, expression.encode(), notation, byref(text)))
        formula = ctypes.string_at(text).decode()
        lib.qdot_string_free(text)
        return formula

    def decide(self, claim):
        truth = c_int()
        self.need(lib.qdot_system_decide(self.handle, claim.encode(), byref(truth)))
        return VERDICTS[truth.value]

    def run(self, text):
        return Motion(self, text)


class Motion:
    def __init__(self, system, text):
        self.system, self.handle = system, c_void_p()
        system.need(lib.qdot_system_run(system.handle, text.encode(), byref(self.handle)))

    def __del__(self):
        lib.qdot_motion_free(self.handle)

    def values(self, expressions, times):
        """Rows of values and rows of their errors, a row for each time."""
        n, k = len(times), len(expressions)
        values, errors = (c_double * (n * k))(), (c_double * (n * k))()
        self.system.need(lib.qdot_motion_values(
            self.handle, ("[" + ", ".join(expressions) + "]").encode(), n, (c_double * n)(*times), k,
            values, errors))
        return [[list(table[i * k:(i + 1) * k]) for i in range(n)] for table in (values, errors)]

    def over(self, what, expression, start, end):
        value, error = c_double(), c_double()
        self.system.need(lib.qdot_motion_over(self.handle, what, expression.encode(), start, end,
                                              byref(value), byref(error)))
        return value.value, error.value

    def summary(self):
        summary = Summary()
        self.system.need(lib.qdot_motion_summarize(self.handle, byref(summary),
                                                   ctypes.sizeof(summary)))
        return summary


def main():
    system = System("""
        param m, l, g > 0
        coord theta
        particle bob mass m at (l*sin(theta), -l*cos(theta))
        gravity (0, -g)
        set m = 1, l = 1, g = 9.81
        start theta = 2""")
    for expression in "T", "V", "eom":
        print(f"{expression}: {system.derive(expression)}")
    for claim in "conserved energy", "T == m*l^2*theta'^2":
        print(f"{claim}: {system.decide(claim)}")

    motion = system.run("0..10 tol 1e-12")
    times = [0, 2.5, 5, 7.5, 10]
    for t, value, error in zip(times, *motion.values(["theta", "theta'"], times)):
        print(f"t = {t:4.1f}  theta = {value[0]:11.8f}  theta' = {value[1]:11.8f}"
              f"{'' if max(error) < 1e-9 else ' (uncertain)'}")
    highest, _ = motion.over(MAX, "theta'", 0, 10)
    print(f"largest theta': {highest:.8f}")
    summary = motion.summary()
    print(f"method {summary.method.decode()}, energy drift below 1e-10: "
          f"{'yes' if summary.energy_drift < 1e-10 else 'no'}")
    try:
        system.declare("set l = 2, k = 3")
    except Error as error:
        print(f"{error.result}:\n{error}", end="")


if __name__ == "__main__":
    main()
