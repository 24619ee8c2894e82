"""kinks.py -- equations linear on either side of each |u|, max, min, sign u and if(...): drawn, asked, and judged exactly.

On each combination of sides, u > 0, u < 0 or u = 0 of every switch, the equations are linear: solved in fractions, at
random values of the parameters. Their solutions that lie on these sides must be listed; what is listed, where its condition
holds, must solve the equations inside the domains, no two entries be the same, and each condition hold somewhere. `solve`
of one unknown is asked with products too, and its truth found at all points where a side or a sign changes and between
them; `equilibria` is asked with potentials whose forces are continuous.
"""
import itertools, random, re
from fractions import Fraction

import mpmath
import scipy.optimize

from answer import ask, run_script
from formula import names, read, value
from scene import num, total
from systems import entries
from verdict import Verdict, short

MODES = ("solve 1", "solve 1", "solve 2", "solve 2", "solve 3", "rest 1", "rest 2", "rest 2", "rest 3")
SAMPLES = 12


class Form:
    """A linear form: {name: coefficient}, "" the constant."""
    def __init__(self, c):
        self.c = {n: v for n, v in c.items() if v}

    def text(self):
        return total([(v, n) for n, v in sorted(self.c.items(), key=lambda p: (p[0] == "", p[0]))])

    def at(self, at):
        return sum((v * (at.get(n, 0) if n else 1) for n, v in self.c.items()), Fraction(0))

    def __add__(self, other):
        return Form({n: self.c.get(n, 0) + other.c.get(n, 0) for n in {*self.c, *other.c}})

    def __mul__(self, k):
        return Form({n: v * k for n, v in self.c.items()})


def draw_form(d, unknowns, params, most=2):
    c = {u: num(d, 2, (1,)) for u in d.sample(unknowns, d.randint(1, min(most, len(unknowns))))}
    if params and d.random() < 0.6:
        c[d.choice(params)] = num(d, 2, (1,))
    if d.random() < 0.5:
        c[""] = num(d, 2, (1, 1, 2))
    return Form(c)


class Kink:
    """A function of linear forms: its text, u, and the form that it is where u > 0, u < 0, u = 0."""
    def __init__(self, d, unknowns, params, smooth=False):
        u = self.u = draw_form(d, unknowns, params)
        zero, one = Form({}), Form({"": Fraction(1)})
        t, v = u.text(), draw_form(d, unknowns, params)
        kind = d.choice(["max0", "max0", "max", "min", "abs", "if"] + ([] if smooth else ["sign", "jump", "times"]))
        if kind == "max0":
            self.text, self.side = f"max({t}, 0)", (u, zero, zero)
        elif kind == "max":
            self.text, self.side = f"max({(u + v).text()}, {v.text()})", (u + v, v, v)
        elif kind == "min":
            self.text, self.side = f"min({(u + v).text()}, {v.text()})", (v, u + v, v)
        elif kind == "abs":
            self.text, self.side = f"abs({t})", (u, u * -1, zero)
        elif kind == "if":
            self.text, self.side = f"if({t} > 0, {(u * 2).text()}, {(u * -1).text()})", (u * 2, u * -1, zero)
        elif kind == "sign":
            self.text, self.side = f"sign({t})", (one, one * -1, zero)
        elif kind == "jump":
            self.text, self.side = f"if({t} >= 0, {v.text()}, {(v * -1).text()})", (v, v * -1, v)
        else:
            self.text, self.side = f"max({t}, 0)*if({t} > 0, 2, 1)", (u * 2, zero, zero)


def linear(rows, unknowns, at):
    """The only solution of forms = 0 at values of the parameters; None: there is none, or many."""
    rows = [[f.c.get(u, Fraction(0)) for u in unknowns]
            + [-Form({n: v for n, v in f.c.items() if n not in unknowns}).at(at)] for f in rows]
    n, rank = len(unknowns), 0
    for k in range(n):
        pivot = next((r for r in range(rank, len(rows)) if rows[r][k]), None)
        if pivot is None:
            return None
        rows[rank], rows[pivot] = rows[pivot], rows[rank]
        rows[rank] = [v / rows[rank][k] for v in rows[rank]]
        for r in range(len(rows)):
            if r != rank and rows[r][k]:
                rows[r] = [v - rows[r][k] * w for v, w in zip(rows[r], rows[rank])]
        rank += 1
    return None if any(r[n] for r in rows[rank:]) else {u: rows[k][n] for k, u in enumerate(unknowns)}


class Scene:
    def __init__(self, seed, index):
        d = self.draw = random.Random(f"kinks {seed} {index}")
        self.mode = MODES[index % len(MODES)]
        n = int(self.mode[-1])
        self.unknowns = list("xyz"[:n])
        params = list("ab"[:d.randint(0, 2)])
        count = d.randint(1, 3 if n < 3 else 2)
        self.ends = {u: self.domain(d) for u in self.unknowns}
        self.factors = 1
        if self.mode.startswith("rest"):
            self.by_potential(d, params, count)
        else:
            self.by_equations(d, params, count)
        used = set().union(*[names(read(t)) for t in self.formulas()])
        self.params = {p: d.choice(["", "", "> 0"]) for p in params if p in used}

    @staticmethod
    def domain(d):
        if d.random() < 0.7:
            return None, None
        lo = d.randint(-3, 2)
        return d.choice([(lo, None), (None, lo), (lo, lo + d.randint(1, 4))])

    def by_equations(self, d, params, count):
        one = len(self.unknowns) == 1
        self.kinks = [Kink(d, self.unknowns, params) for _ in range(count)]
        self.factors = d.randint(1, 2) if one else 1
        self.linear, self.of = [], []                 # of each equation or factor: its linear part, {kink: coefficient}
        for i in range(self.factors if one else len(self.unknowns)):
            self.linear.append(draw_form(d, self.unknowns, params) if d.random() < 0.8 else Form({}))
            self.of.append({k: num(d, 2, (1,)) for k in range(count) if d.random() < 0.7})
            if not self.of[-1] and not self.linear[-1].c:
                self.of[-1] = {d.randrange(count): Fraction(1)}

    def by_potential(self, d, params, count):
        """V = q^2/2 ... + c max(u, 0)^2 ...: forces continuous and linear on either side."""
        self.kinks, self.of, self.linear, V = [], [{} for _ in self.unknowns], [Form({}) for _ in self.unknowns], []
        for i, u in enumerate(self.unknowns):
            k = num(d, 2, (1,)) if d.random() < 0.85 else Fraction(0)
            if k:
                V.append((k / 2, f"{u}^2"))
                self.linear[i] += Form({u: k})
            load = d.choice([*params, "", ""])
            V.append((-num(d, 2, (1,)), "*".join(n for n in (load, u) if n)))
            self.linear[i] += Form({load: V[-1][0]})
        for _ in range(count):
            u, c = draw_form(d, self.unknowns, params), num(d, 2, (1, 2))
            t, k = u.text(), len(self.kinks)
            kink = Kink(d, self.unknowns, params, True)
            kink.u, kind = u, d.choice(["max", "max", "if", "abs"])
            if kind == "max":
                V.append((c, f"max({t}, 0)^2"))
                kink.side = (u * 2, Form({}), Form({}))
            elif kind == "if":
                V.append((c, f"if({t} > 0, ({t})^2, 0)"))
                kink.side = (u * 2, Form({}), Form({}))
            else:
                V.append((c, f"({t})*abs({t})"))
                kink.side = (u * 2, u * -2, Form({}))
            self.kinks.append(kink)
            for i, q in enumerate(self.unknowns):
                if q in u.c:
                    self.of[i][k] = c * u.c[q]
        self.V = total(V)

    def formulas(self):
        if self.mode.startswith("rest"):
            return [self.V]
        parts = []
        for form, of in zip(self.linear, self.of):
            parts.append(total([(1, form.text())] * bool(form.c) + [(c, self.kinks[k].text) for k, c in of.items()]))
        return ["*".join(f"({p})" for p in parts)] if self.factors > 1 else parts

    def script(self):
        out = [f"param {p} {s}".rstrip() for p, s in self.params.items()]
        for u, (lo, hi) in self.ends.items():
            out.append(f"coord {u}" if lo is None and hi is None else f"coord {u} > {lo}" if hi is None else
                       f"coord {u} < {hi}" if lo is None else f"coord {lo} < {u} < {hi}")
        f = self.formulas()
        if self.mode.startswith("rest"):
            T = " + ".join(f"{u}'^2/2" for u in self.unknowns)
            out += [f"lagrangian {T} - ({f[0]})", "equilibria"]
        elif len(self.unknowns) == 1:
            out.append(f"solve({f[0]} = 0, x)")
        else:
            out.append("solve([" + ", ".join(f"{e} = 0" for e in f) + "], [" + ", ".join(self.unknowns) + "])")
        return "\n".join(out) + "\n"

    def values(self):
        """No simple ones, at which conditions change."""
        def one(prime, sign):
            v = Fraction(self.draw.choice([k for k in range(1, 300) if k % prime]), prime)
            return v if sign or self.draw.random() < 0.5 else -v
        return {p: one(prime, s) for prime, (p, s) in zip((53, 59), self.params.items())}

    def inside(self, at):
        return all((lo is None or at[u] > lo) and (hi is None or at[u] < hi) for u, (lo, hi) in self.ends.items())

    def rests(self, at):
        """What each equation or factor is there."""
        sides = [kink.side[0 if v > 0 else 1 if v < 0 else 2].at(at) for kink in self.kinks for v in (kink.u.at(at),)]
        f = [form.at(at) + sum(c * sides[k] for k, c in of.items()) for form, of in zip(self.linear, self.of)]
        return [f[0] * f[1]] if self.factors > 1 else f

    def zeros(self, at):
        """Those that are alone on their sides."""
        found = []
        for which in itertools.product(range(3), repeat=len(self.kinks)):
            rows = []
            for form, of in zip(self.linear, self.of):
                for k, c in of.items():
                    form = form + self.kinks[k].side[which[k]] * c
                rows.append(form)
            rows += [kink.u for kink, side in zip(self.kinks, which) if side == 2]
            there = linear(rows, self.unknowns, at)
            if there is None:
                continue
            there = dict(at, **there)
            signs = [0 if v > 0 else 1 if v < 0 else 2 for kink in self.kinks for v in (kink.u.at(there),)]
            if tuple(signs) == which and self.inside(there) and there not in found:
                found.append(there)
        return found

    def probes(self, at):
        """Of one unknown: where a side or a sign may change, and between."""
        points = {-kink.u.at(dict(at, x=0)) / kink.u.c["x"] for kink in self.kinks if kink.u.c.get("x")}
        for form, of in zip(self.linear, self.of):
            for which in itertools.product(range(3), repeat=len(self.kinks)):
                whole = form
                for k, c in of.items():
                    whole = whole + self.kinks[k].side[which[k]] * c
                if whole.c.get("x"):
                    points.add(-whole.at(dict(at, x=0)) / whole.c["x"])
        points |= {Fraction(e) for e in self.ends["x"] if e is not None}
        points = sorted(points)
        points += [(a + b) / 2 for a, b in zip(points, points[1:])]
        points += [min(points) - 1, max(points) + 1] if points else [Fraction(0)]
        return [p for p in (dict(at, x=p) for p in points) if self.inside(p)]


# --- what is listed ---------------------------------------------------------------------------------

def listed_of(scene, said):
    """[({unknown: formula}, relations, condition)]"""
    return [({n: f for n, f in e.equations if n in scene.unknowns}, e.relations, e.exists) for e in said.entries]


def mp(at):
    return {n: mpmath.mpf(v.numerator) / v.denominator for n, v in at.items()}


def holds(relation, at):
    return value(relation, at) is True


def is_at(entry, point):
    """Whether the entry lists that point."""
    solved, relations, condition = entry
    at = mp(point)
    for u, f in solved.items():
        v = value(f, at)
        if v is None or v is True or v is False or abs(v - at[u]) > 1e-25:
            return False
    return all(holds(r, at) for r in relations) and (condition is None or holds(condition, at))


def place(scene, entry, at):
    """The point of an entry that has one, where its condition holds; "not real"; None."""
    solved, relations, condition = entry
    if set(solved) != set(scene.unknowns) or relations:
        return None
    here = mp(at)
    there = dict(here, **{u: value(f, here) for u, f in solved.items()})
    if condition is not None and not holds(condition, there):
        return None
    return "not real" if any(there[u] is None for u in solved) else there


def nearest(scene, at, there):
    """The point in fractions, for entries are."""
    return dict(at, **{u: Fraction(str(mpmath.nstr(there[u], 30))).limit_denominator(10**9) for u in scene.unknowns})


def compare(scene, verdict, listed, partial):
    seen = [False] * len(listed)
    for round in range(SAMPLES if scene.params else 1):
        at = scene.values()
        points = []
        for i, entry in enumerate(listed):
            there = place(scene, entry, at)
            if there is None:
                continue
            seen[i] = True
            if there == "not real":
                verdict.add("condition", f"{entry} is not real at {short(mp(at))}")
                continue
            point = nearest(scene, at, there)
            if not scene.inside(point):
                verdict.add("wrong", f"{entry} lies outside at {short(mp(at))}")
            elif any(scene.rests(point)):
                verdict.add("wrong", f"{entry} is none at {short(mp(at))}")
            elif point in points:
                verdict.add("twice", f"{entry} is listed twice at {short(mp(at))}")
            points.append(point)
        if len(scene.unknowns) == 1:
            zeros = scene.probes(at)
            for p in zeros:
                if any(scene.rests(p)) and any(is_at(e, p) for e in listed):
                    verdict.add("wrong", f"listed at {short(mp(p))}, where the rest is {scene.rests(p)[0]}")
            zeros = [p for p in zeros if not any(scene.rests(p))]
        else:
            zeros = scene.zeros(at)
        for zero in zeros:
            if not any(is_at(e, zero) for e in listed):
                verdict.add("said" if partial else "incomplete", f"{short(mp(zero))} is not listed")
    for entry, one in zip(listed, seen):
        if not one and entry[2] is not None and set(entry[0]) == set(scene.unknowns) and not exists(scene, entry):
            verdict.add("condition", f"{entry} never exists")


def exists(scene, entry):
    """Whether linear conditions hold at some values of the parameters; others: it is not asked."""
    if "if(" in entry[2]:
        return True
    params, rows, strict = list(scene.params), [], []
    origin = {p: mpmath.mpf(0) for p in params}
    for relation in entry[2].split(" and "):
        parts = re.fullmatch(r"(.*?) (<=|>=|<|>) (.*)", relation)
        if parts is None:
            return True
        left, right = (parts[1], parts[3]) if parts[2][0] == ">" else (parts[3], parts[1])
        gap = lambda at: float(value(left, at) - value(right, at))  # noqa: E731 -- to be positive
        c = [gap(origin)] + [gap(dict(origin, **{p: mpmath.mpf(1)})) - gap(origin) for p in params]
        at = {p: mpmath.mpf(scene.draw.randint(-999, 999)) / 7 for p in params}
        if abs(c[0] + sum(k * float(at[p]) for k, p in zip(c[1:], params)) - gap(at)) > 1e-9:
            return True
        rows.append(c)
        strict.append(len(parts[2]) == 1)
    for i, p in enumerate(params):
        if scene.params[p]:
            rows.append([0.0] + [float(k == i) for k in range(len(params))])
            strict.append(True)
    # the greatest t <= 1 with every strict gap at least t, every other at least 0
    found = scipy.optimize.linprog([0.0] * len(params) + [-1.0], bounds=[(None, None)] * len(params) + [(None, 1)],
                                   A_ub=[[-k for k in c[1:]] + [float(s)] for c, s in zip(rows, strict)],
                                   b_ub=[c[0] for c in rows])
    return found.status == 3 or (found.status == 0 and (-found.fun > 1e-9 or not any(strict)))


def judge(program, seed, index, timeout=30):
    """The script, what was said, and the verdict."""
    scene, verdict = Scene(seed, index), Verdict()
    script = scene.script()
    if scene.mode.startswith("solve") and len(scene.unknowns) > 1:
        p = run_script(program, script, timeout=timeout)
        output, crash, status = p.stdout + p.stderr, p.returncode == 124 or p.returncode < 0 or p.returncode > 2, p.returncode
        listed = [(solved, [], when) for solved, when in entries(output)]
        partial, every = "may be others" in output, "hold for all values" in output
    else:
        said = ask(program, script, scene.unknowns[0] if scene.mode == "solve 1" else None, timeout=timeout)
        output, crash, status = said.output, said.crash, 1 if said.error else 0
        listed, partial, every = listed_of(scene, said), said.partial, said.every
    if crash:
        verdict.add("crash", str(crash))
    elif status and re.search("cannot be (solved|found)|need a value", output):
        verdict.add("said", "not solved")
    elif every and status:
        verdict.add("said", "every value")
    elif status:
        verdict.add("error", output.strip()[-200:])
    else:
        compare(scene, verdict, listed, partial)
    return script, output, verdict
