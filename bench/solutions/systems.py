"""systems.py -- systems of equations for `solve([...], [...])`: drawn, asked, and judged.

Each listed solution is put back, in 50 digits, at random values of the parameters, of the integers and of the unknowns
that it leaves free; simple zeros found by Newton's steps from many starts must be among them.
"""
import itertools, random, re

import mpmath
import numpy as np

from answer import run_script, split
from formula import array, names, read, value
from scene import num
from verdict import Verdict, short

INTEGERS = ("n", "n1", "n2")
DOMAINS = [("0", "2"), ("-1", "1"), ("0", None), ("1", "5"), (None, "0"), ("0", "sqrt(2)"), ("0", "2*pi")]
FORMS = {                                             # of two equations, one of each list
    "angles": (["sin(x)", "cos(x)", "sin(x)*cos(y)", "sin(x + y)", "cos(x - y)", "sin(x) + sin(y) - 1/2",
                "cos(x) - cos(y)", "sin(2*x)", "sin(x)*sin(y)", "cos(2*x - y)", "tan(x) - 1"],
               ["cos(y)", "sin(y) - 1/2", "sin(x - y)", "cos(x + y)", "cos(x)*sin(y)", "sin(y) - cos(x)",
                "cos(x) + cos(y)", "sin(2*y) - 1", "cos(y)^2 - 1/2", "sin(x) - sin(y)"]),
    "angle and length": (["y - 2*cos(x)", "y^2 - sin(x)", "y*sin(x)", "y*cos(x) - 1", "x*sin(y)", "x*y",
                          "(y - 1)*sin(x) + y*cos(x)", "y - x", "x + y - pi"],
                         ["sin(x)", "cos(x) - 1/2", "y^2 - 1", "y - sin(x)", "y*(y - 1)", "cos(2*x)",
                          "y^2*sin(x) - y"]),
    "families": (["sin(pi*x)", "cos(pi*x)", "sin(3*x)", "sin(x/2)", "cos(2*x) - 1/2"],
                 ["y - x", "y^2 - y", "x*y", "sin(pi*y)", "y - cos(pi*x)", "(x - 1)*y", "x - 2*y^2"]),
    "kinks": (["abs(x) - y", "abs(x) + abs(y) - 1", "abs(x - 1) + y - 2", "max(x, y) - 1", "abs(x) - x"],
              ["x + y - 1", "x - 2*y", "x^2 - y^2", "y - 1", "x*y - 1/4", "y^2 - 1"]),
    "roots": (["sqrt(x) - y", "sqrt(x + y) - 2", "sqrt(x) + sqrt(y) - 3", "x*sqrt(y) - 1", "sqrt(x^2 + y^2) - 5",
               "sqrt(x - y) - x"], ["x + y - 6", "x - y - 1", "x*y - 4", "y - x^2", "x - 4", "3*x - 4*y"]),
    "exponentials": (["exp(x) - y", "log(x) - y", "exp(x)*y - 1", "x - log(y)", "exp(x + y) - 1"],
                     ["y - 2", "x*y - y", "y^2 - 1", "x - y", "x + y", "x*(y - 1)"]),
    "quotients": (["1/x - y", "x/y - 1", "1/(x - y) - 1", "y/x + x", "x/(x + y) - 1/2", "(x^2 - y^2)/(x - y)"],
                  ["x - y", "x*y - 1", "x + y - 3", "x^2 - y^2", "x^2 + y^2 - 2", "x*(y - 1)"]),
    "linear with parameters": (["a*x + y - 1", "a*x + b*y", "x + a*y - b", "(a - 1)*x + y", "a*x - b"],
                               ["x + y - b", "x - a*y", "b*x + y - 1", "x + b*y - a", "2*x + y - a*b"]),
    "with parameters": (["x^2 + y^2 - a", "x*y - a", "x^2 - a", "a*x^2 - y", "x^2 + y^2 - a^2", "x*(y - a)",
                         "x^2 + a*y^2 - 1", "x^3 - a*x", "x^4 - a", "x^2 - a*x + y"],
                        ["x - b*y", "x + y - b", "y - b", "x*y - b*y", "x + y", "x - b"]),
}


def polynomial(draw, degree, terms):
    out = []
    for _ in range(terms):
        powers = [draw.choice("xy") for _ in range(draw.randint(1, degree))]
        out.append(f"({num(draw, 3, (1, 1, 1, 2))})*" + "*".join(powers))
    return " + ".join(out) + f" - ({num(draw, 3, (1, 1, 2))})"


class System:
    def __init__(self, seed, index):
        draw = self.draw = random.Random(f"systems {seed} {index}")
        form = draw.choice(["polynomials", *FORMS])
        if form == "polynomials":
            self.f = [polynomial(draw, 2, draw.randint(1, 3)), polynomial(draw, draw.choice((1, 1, 2)), 2)]
        else:
            self.f = [draw.choice(side) for side in FORMS[form]]
        used = set().union(*[names(read(f)) for f in self.f])
        self.params = {p: draw.choice(["", "> 0"]) for p in sorted(used - {"x", "y"})}
        self.domain = {u: draw.choice(DOMAINS) if draw.random() < 0.25 else (None, None) for u in "xy"}

    def script(self):
        out = [f"param {p} {s}".rstrip() for p, s in self.params.items()]
        for u, (lo, hi) in self.domain.items():
            out.append(f"coord {lo} < {u} < {hi}" if lo and hi else f"coord {u} > {lo}" if lo else
                       f"coord {u} < {hi}" if hi else f"coord {u}")
        return "\n".join(out) + "\nsolve([" + ", ".join(f"{f} = 0" for f in self.f) + "], [x, y])\n"

    def values(self):
        """Values of the parameters."""
        return {p: mpmath.mpf(self.draw.randint(13, 192)) / 64 * (1 if s or self.draw.random() < 0.5 else -1)
                for p, s in self.params.items()}

    def outside(self, at, slack=0):
        """The unknowns that lie beyond their domains by more than `slack`."""
        return [u for u, (lo, hi) in self.domain.items()
                if (lo and at[u] < value(lo, {}) - slack) or (hi and at[u] > value(hi, {}) + slack)]


def entries(output):
    """[({unknown: formula}, condition or None)]"""
    when = dict(re.findall(r"^notice: (\[.*\]) exists when (.*)$", output, re.M))
    return [(dict(p.split(" = ", 1) for p in split(text[1:-1]) if p), when.get(text))
            for text in re.findall(r"^(?:(?:solve\(.*\)|%\d+)\[\d+\] = )?(\[\w.*\])$", output, re.M)]


def place(entry, at):
    """x and y of an entry where its condition holds; None: it is none there."""
    solved, condition = entry
    there = dict(at, **{u: value(f, at) for u, f in solved.items()})
    return there if condition is None or value(condition, there) is True else None


def put_back(system, verdict, listed, at):
    draw = system.draw
    for entry in listed:
        free = [u for u in "xy" if u not in entry[0]]
        for _ in range(4):
            there = place(entry, dict(at, **{n: mpmath.mpf(draw.randint(-2, 2)) for n in INTEGERS},
                                      **{u: mpmath.mpf(draw.randint(-100, 100)) / 37 for u in free}))
            if there is None:
                continue
            if any(there[u] is None for u in "xy"):
                verdict.add("condition", f"{entry} is not real at {short(at)}")
                continue
            beyond = system.outside(there, mpmath.mpf(10) ** -30)
            if any(u in free for u in beyond):
                continue
            rest = [value(f, there) for f in system.f]
            if beyond:
                verdict.add("wrong", f"{entry} lies outside at {short(there)}")
            elif any(r is None or abs(r) > mpmath.mpf(10) ** -9 for r in rest):
                verdict.add("wrong", f"{entry} is none at {short(there)}")


def confirmed(system, at):
    """Whether a few more of Newton's steps, in 50 digits, end at a zero beside `at` (beside a pole they do not)."""
    p, h = mpmath.matrix([at["x"], at["y"]]), mpmath.mpf(10) ** -25

    def of(q):
        return [value(f, dict(at, x=q[0], y=q[1])) for f in system.f]

    for _ in range(6):
        g = of(p)
        sides = [(of(p + h * e), of(p - h * e)) for e in (mpmath.matrix([1, 0]), mpmath.matrix([0, 1]))]
        if any(v is None for row in [g, *itertools.chain(*sides)] for v in row):
            return False
        J = mpmath.matrix(2, 2)
        for i, j in itertools.product(range(2), range(2)):
            J[i, j] = (sides[j][0][i] - sides[j][1][i]) / (2 * h)
        try:
            p -= mpmath.lu_solve(J, mpmath.matrix(g))
        except ZeroDivisionError:
            return False
    g = of(p)
    return all(v is not None and abs(v) < mpmath.mpf(10) ** -20 for v in g) and \
        max(abs(p[0] - at["x"]), abs(p[1] - at["y"])) < 1e-7


def simple_zeros(system, at, reach=9.0, starts=200):
    """Zeros inside the domains at which the slopes are regular, from Newton's steps with slopes by differences."""
    trees, rng = [read(f) for f in system.f], np.random.default_rng(system.draw.randint(0, 10**9))
    low, high = [], []
    for lo, hi in system.domain.values():
        low.append(float(value(lo, {})) if lo else float(value(hi, {})) - 2 * reach if hi else -reach)
        high.append(float(value(hi, {})) if hi else low[-1] + 2 * reach)
    p = rng.uniform(low, high, (starts, 2))
    numbers = {k: float(v) for k, v in at.items()}

    def of(q):
        here = dict(numbers, x=q[:, 0], y=q[:, 1])
        return np.stack([np.broadcast_to(np.asarray(array(t, here), float), len(q)) for t in trees], 1)

    def slopes(q):
        h = 1e-6
        return np.stack([(of(q + h * e) - of(q - h * e)) / (2 * h) for e in np.eye(2)], 2)

    with np.errstate(all="ignore"):
        for _ in range(40):
            J, g = slopes(p), of(p)
            det = J[:, 0, 0] * J[:, 1, 1] - J[:, 0, 1] * J[:, 1, 0]
            step = np.stack([J[:, 1, 1] * g[:, 0] - J[:, 0, 1] * g[:, 1],
                             J[:, 0, 0] * g[:, 1] - J[:, 1, 0] * g[:, 0]], 1) / det[:, None]
            p = p - step * np.minimum(1, 2 / (np.abs(step).max(1) + 1e-300))[:, None]
        good = (np.abs(of(p)).max(1) < 1e-9) & (np.abs(det) > 1e-4) & (np.abs(p).max(1) < 3 * reach)
    found = []
    for q in p[good]:
        there = dict(at, x=mpmath.mpf(q[0]), y=mpmath.mpf(q[1]))
        if not system.outside(there, -1e-7) and all(np.abs(q - z).max() > 1e-6 for z in found) and \
                confirmed(system, there):
            found.append(q)
    return found


def is_listed(system, listed, zero, at, turns):
    """Whether an entry is that zero; an unknown in which the equations have the period 2 pi may differ by turns."""
    for entry in listed:
        used = set().union(*[names(f) for f in entry[0].values()]) if entry[0] else set()
        integers = [n for n in INTEGERS if n in used]
        free = {u: mpmath.mpf(float(zero["xy".index(u)])) for u in "xy" if u not in entry[0]}
        for ks in itertools.product(range(-14, 15), repeat=min(len(integers), 2)):
            there = place(entry, dict(at, **free, **{n: mpmath.mpf(k) for n, k in zip(integers, ks)}))
            if there is None or any(there[u] is None for u in "xy"):
                continue
            gaps = [float(there[u]) - zero[i] for i, u in enumerate("xy")]
            gaps = [(g + np.pi) % (2 * np.pi) - np.pi if turns[u] else g for u, g in zip("xy", gaps)]
            if max(map(abs, gaps)) < 1e-5:
                return True
    return False


def recurs(system, u):
    """Whether the equations have the period 2 pi in u, as far as four random points tell."""
    for _ in range(4):
        at = dict(system.values(), x=mpmath.mpf(system.draw.random()), y=mpmath.mpf(system.draw.random()))
        turned = dict(at, **{u: at[u] + 2 * mpmath.pi})
        for f in system.f:
            a, b = value(f, at), value(f, turned)
            if a is None or b is None or abs(a - b) > 1e-20:
                return False
    return True


def judge(program, seed, index, timeout=20):
    """The system, what was said, and the verdict."""
    system, verdict = System(seed, index), Verdict()
    p = run_script(program, system.script(), timeout=timeout)
    said = p.stdout + p.stderr
    if p.returncode == 124 or p.returncode < 0 or p.returncode > 2:
        verdict.add("crash", f"status {p.returncode}")
    elif "cannot be solved" in said or "hold for all values" in said:
        verdict.add("said", said.strip().splitlines()[0])
    elif p.returncode != 0:
        verdict.add("error", said.strip().splitlines()[0])
    else:
        listed, turns = entries(said), {u: recurs(system, u) for u in "xy"}
        for _ in range(3 if system.params else 1):
            at = system.values()
            put_back(system, verdict, listed, at)
            for zero in simple_zeros(system, at):
                if not is_listed(system, listed, zero, at, turns):
                    verdict.add("incomplete", f"{zero} at {short(at)} is not listed")
    return system.script(), said, verdict
