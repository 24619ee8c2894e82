# sympy-peer -- the scenes of bench/symbolic by SymPy.
#
#   sympy-peer lagrange|direct|kane SCENE N     the equations M q'' = f
#   sympy-peer simplify SCENE                   an expression in a form for people
#   sympy-peer decide LEFT RIGHT                whether they are equal
#
# Prints lines `word value`: seconds (CPU, without the import), operations (of M and f), shared
# (operations after cse), lowered (the same with numbers for the parameters), value (the sum of
# M's and f's entries at one point, to compare programs), verdict. The methods:
#
#   lagrange   sympy.physics.mechanics.LagrangesMethod
#   kane       sympy.physics.mechanics.KanesMethod, as its manual's chain is written
#   direct     by hand, the least work that gives M and f: with J = dr/dq and J' its rate,
#              M = sum m J^T J, f = -sum m J^T J' q' - dV/dq, nothing expanded
import sys
import time

import sympy as sp
from sympy.physics import mechanics as me

began = 0.0


def tell(word, value):
    print(word, value, flush=True)


# --- scenes -------------------------------------------------------------------------------


class Scene:
    """Positions with their masses, the potential's terms, coordinates as given."""

    def __init__(self, name, n, coordinates):
        self.g = sp.Symbol("g", positive=True)
        m = sp.symbols(f"m1:{n + 1}", positive=True)
        l = sp.symbols(f"l1:{n + 1}", positive=True)
        self.parents = None
        self.masses = list(m)
        self.potential = []
        if name == "planar" or name == "tree":
            q = coordinates(f"theta1:{n + 1}")
            steps = [(l[k] * sp.sin(q[k]), -l[k] * sp.cos(q[k])) for k in range(n)]
            half = name == "tree"
            self.parents = [(k + 1) // 2 - 1 if half else k - 1 for k in range(n)]
        elif name == "spatial":
            q = coordinates(f"theta1:{n + 1}") + coordinates(f"phi1:{n + 1}")
            steps = [
                (
                    l[k] * sp.sin(q[k]) * sp.cos(q[n + k]),
                    l[k] * sp.sin(q[k]) * sp.sin(q[n + k]),
                    -l[k] * sp.cos(q[k]),
                )
                for k in range(n)
            ]
            self.parents = [k - 1 for k in range(n)]
        else:
            q = self.net(n, coordinates)
        self.q = list(q)
        count = range(1, n + 1)
        self.numbers = {self.g: 9.81}
        self.numbers.update({m[k - 1]: 1 + k / 10 for k in count})
        self.numbers.update({l[k - 1]: 2 - k / 200 for k in count})
        self.numbers.update(zip(sp.symbols("m k a", positive=True), (1.1, 3.0, 0.7)))
        if self.parents:
            self.steps = steps
            self.points = []
            for k in range(n):
                base = self.points[self.parents[k]] if self.parents[k] >= 0 else None
                step = steps[k]
                self.points.append(
                    step if base is None else tuple(a + b for a, b in zip(base, step))
                )
            for mass, point in zip(m, self.points):
                self.potential.append(mass * self.g * point[-1])

    def net(self, n, coordinates):
        mass, k, a = sp.symbols("m k a", positive=True)
        x, y = coordinates(f"x1:{n * n + 1}"), coordinates(f"y1:{n * n + 1}")
        self.points = list(zip(x, y))
        self.steps = self.points
        self.masses = [mass] * (n * n)

        def spring(p, r):
            length = sp.sqrt((p[0] - r[0]) ** 2 + (p[1] - r[1]) ** 2)
            self.potential.append(k * (length - a) ** 2 / 2)

        for i in range(n):
            for j in range(n):
                here = self.points[i * n + j]
                if i + 1 < n:
                    spring(here, self.points[(i + 1) * n + j])
                if j + 1 < n:
                    spring(here, self.points[i * n + j + 1])
            spring(self.points[i * n], ((i + 1) * a, sp.Integer(0)))
        self.potential += [mass * self.g * point[1] for point in self.points]
        return list(x) + list(y)


# --- methods ------------------------------------------------------------------------------


def by_lagrange(name, n):
    s = Scene(name, n, lambda names: list(me.dynamicsymbols(names)))
    t = me.dynamicsymbols._t
    kinetic = sum(
        m / 2 * sum(c.diff(t) ** 2 for c in point) for m, point in zip(s.masses, s.points)
    )
    method = me.LagrangesMethod(kinetic - sum(s.potential), s.q)
    method.form_lagranges_equations()
    return method.mass_matrix, method.forcing, s, [c.diff(t) for c in s.q]


def by_kane(name, n):
    s = Scene(name, n, lambda names: list(me.dynamicsymbols(names)))
    u = me.dynamicsymbols(f"u1:{len(s.q) + 1}")
    t = me.dynamicsymbols._t
    frame, origin = me.ReferenceFrame("I"), me.Point("O")
    axes = [frame.x, frame.y, frame.z]
    origin.set_vel(frame, 0)
    rates = dict(zip([c.diff(t) for c in s.q], u))
    particles, loads, points = [], [], []
    for k, (mass, step) in enumerate(zip(s.masses, s.steps)):
        base = points[s.parents[k]] if s.parents and s.parents[k] >= 0 else origin
        place = sum((c * e for c, e in zip(step, axes)), 0 * frame.x)
        point = base.locatenew(f"P{k}", place)
        speed = sum(
            (c.diff(t).subs(rates) * e for c, e in zip(step, axes)), 0 * frame.x
        )
        point.set_vel(frame, base.vel(frame) + speed)
        points.append(point)
        particles.append(me.Particle(f"B{k}", point, mass))
    if s.parents:
        for mass, point in zip(s.masses, points):
            loads.append((point, -mass * s.g * axes[len(s.steps[0]) - 1]))
    else:
        at = {c: (point, e) for point, p in zip(points, s.points) for c, e in zip(p, axes)}
        pull = dict.fromkeys(s.q, sp.Integer(0))
        for term in s.potential:
            for c in set(s.q) & term.atoms(sp.Function):
                pull[c] -= term.diff(c)
        loads = [(at[c][0], pull[c] * at[c][1]) for c in s.q]
    method = me.KanesMethod(frame, s.q, u, [a.diff(t) - b for a, b in zip(s.q, u)])
    method.kanes_equations(particles, loads)
    return method.mass_matrix, method.forcing, s, u


def by_hand(name, n):
    s = Scene(name, n, lambda names: list(sp.symbols(names, real=True)))
    number = {c: i for i, c in enumerate(s.q)}
    v = sp.symbols(f"v1:{len(s.q) + 1}", real=True)
    M = [[[] for _ in s.q] for _ in s.q]
    f = [[] for _ in s.q]
    slopes = {}
    for mass, point in zip(s.masses, s.points):
        for c in point:
            J, turn = {}, []
            for x in sorted(c.free_symbols & number.keys(), key=number.get):
                d = c.diff(x)
                J[number[x]] = d
                for y in d.free_symbols & number.keys():
                    pair = (d, y)
                    if pair not in slopes:
                        slopes[pair] = d.diff(y)
                    turn.append(slopes[pair] * v[number[x]] * v[number[y]])
            turn = sp.Add(*turn)
            for i, a in J.items():
                for j, b in J.items():
                    if j <= i:
                        M[i][j].append(mass * a * b)
                if turn != 0:
                    f[i].append(-mass * a * turn)
    for term in s.potential:
        for x in term.free_symbols & number.keys():
            f[number[x]].append(-term.diff(x))
    size = len(s.q)
    mass = sp.zeros(size, size)
    for i in range(size):
        for j in range(i + 1):
            mass[i, j] = mass[j, i] = sp.Add(*M[i][j])
    return mass, sp.Matrix([sp.Add(*terms) for terms in f]), s, v


# --- forms for people ---------------------------------------------------------------------


def to_simplify(name):
    if name == "double":
        m1, m2, L1, L2 = sp.symbols("m1 m2 L1 L2", positive=True)
        a, b, va, vb = sp.symbols("theta1 theta2 v1 v2", real=True)
        x1, y1 = L1 * sp.sin(a), -L1 * sp.cos(a)
        x2, y2 = x1 + L2 * sp.sin(b), y1 - L2 * sp.cos(b)
        speed = lambda c: c.diff(a) * va + c.diff(b) * vb
        return [
            m1 * (speed(x1) ** 2 + speed(y1) ** 2) / 2
            + m2 * (speed(x2) ** 2 + speed(y2) ** 2) / 2
        ]
    c = sp.Symbol("a", positive=True)
    u, v, phi = sp.symbols("u v phi", real=True)
    r = None
    if name == "toroidal":
        scale = c / (sp.cosh(v) - sp.cos(u))
        r = (sp.sinh(v) * sp.cos(phi), sp.sinh(v) * sp.sin(phi), sp.sin(u))
    elif name == "bispherical":
        scale = c / (sp.cosh(v) - sp.cos(u))
        r = (sp.sin(u) * sp.cos(phi), sp.sin(u) * sp.sin(phi), sp.sinh(v))
    elif name == "prolate":
        scale = c
        r = (
            sp.sinh(v) * sp.sin(u) * sp.cos(phi),
            sp.sinh(v) * sp.sin(u) * sp.sin(phi),
            sp.cosh(v) * sp.cos(u),
        )
    r = [scale * x for x in r]
    q = (u, v, phi)
    return [
        sum(x.diff(q[i]) * x.diff(q[j]) for x in r) for i in range(3) for j in range(i, 3)
    ]


def simplified(name):
    entries = to_simplify(name)
    ways = [
        sp.simplify,
        sp.trigsimp,
        lambda e: sp.factor(sp.trigsimp(e)),
        lambda e: sp.factor(sp.simplify(e)),
    ]
    best = None
    for way in ways:
        sp.core.cache.clear_cache()
        start = time.process_time()
        result = [way(e) for e in entries]
        spent = time.process_time() - start
        count = sum(sp.count_ops(e) for e in result)
        if best is None or count < best[0]:
            best = (count, spent, result)
            tell("seconds", f"{spent:.6f}")
            tell("operations", count)
            for e in result:
                tell("form", e)


# --- verdicts -----------------------------------------------------------------------------


def decide(left, right):
    positive = "m m1 m2 M a b c g k L L1 L2 r"
    real = "x y z u v theta phi psi theta1 theta2 w w1 w2 omega"
    names = {s: sp.Symbol(s, positive=True) for s in positive.split()}
    names.update({s: sp.Symbol(s, real=True) for s in real.split()})
    difference = sp.sympify(f"({left}) - ({right})".replace("^", "**"), locals=names)
    start = time.process_time()
    verdict = "undecided"
    if sp.simplify(difference) == 0:
        verdict = "proved"
    else:
        equal = difference.equals(0)
        if equal is not None:
            verdict = "proved" if equal else "refuted"
    tell("seconds", f"{time.process_time() - start:.6f}")
    tell("verdict", verdict)


def shared(word, entries):
    parts, entries = sp.cse(entries, symbols=sp.numbered_symbols("common"))
    tell(word, sum(sp.count_ops(e) for _, e in parts) + sum(map(sp.count_ops, entries)))
    return parts, entries


def main(arguments):
    if arguments[0] == "decide":
        decide(*arguments[1:])
        return
    if arguments[0] == "simplify":
        simplified(arguments[1])
        return
    derive = {"lagrange": by_lagrange, "kane": by_kane, "direct": by_hand}[arguments[0]]
    start = time.process_time()
    M, f, s, v = derive(arguments[1], int(arguments[2]))
    tell("seconds", f"{time.process_time() - start:.6f}")
    # entry by entry: count_ops of a matrix is slower
    tell("operations", sum(sp.count_ops(e) for e in list(M) + list(f)))
    plain = {c: sp.Symbol(f"number{i}") for i, c in enumerate([*v, *s.q])}
    entries = [e.xreplace(plain) for e in list(M) + list(f)]
    parts, entries = shared("shared", entries)
    parameters = {c: sp.Float(x) for c, x in s.numbers.items()}
    shared("lowered", [e.xreplace({**plain, **parameters}) for e in list(M) + list(f)])
    numbers = dict(s.numbers)
    numbers.update({plain[c]: (50 - 7 * i) / 100 for i, c in enumerate(v, 1)})
    numbers.update({plain[c]: (3 + i) / 10 for i, c in enumerate(s.q, 1)})
    numbers = {c: sp.Float(x) for c, x in numbers.items()}
    for symbol, e in parts:
        numbers[symbol] = e.xreplace(numbers)
    tell("value", f"{sum(e.xreplace(numbers) for e in entries):.12f}")


main(sys.argv[1:])
