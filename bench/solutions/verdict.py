"""verdict.py -- what was said, against all real zeros inside the domain, at random values of the parameters."""
import ast, itertools, random, re

import mpmath
import numpy as np
import sympy

from formula import Real, Unreadable, array, names, read, symbolic, value
from scene import bare
from search import Forces, gauss, grid, inside, polish, stationary, vanishes, wrap, zeros

WORST = ["crash", "wrong", "stability", "incomplete", "condition", "twice", "visible", "error", "said", "right"]
REASONS = re.compile(r"cannot|not built|too |more than|budget|needs|only|no closed|must")


def short(at):
    return "{" + ", ".join(f"{k} = {mpmath.nstr(v, 6)}" for k, v in at.items()) + "}"


class Verdict:
    """What was found of one scene: the first instance of each verdict; its word is the worst."""
    def __init__(self):
        self.found = {}
        self.weak = 0                                   # stability undecided where it is plain

    def add(self, word, text):
        self.found.setdefault(word, text)

    @property
    def word(self):
        return next((v for v in WORST if v in self.found), "right")

    @property
    def detail(self):
        return self.found.get(self.word, "")


def ends(scene, at):
    """The ends of all domains, at these parameters."""
    end = lambda e, none: value(bare(e), at) if e else mpmath.mpf(none)
    return [(end(lo, "-inf"), end(hi, "inf")) for _, lo, hi, _ in scene.coords]


def window(scene, lo, hi):
    """Where a periodic formula is looked at: all of a bounded domain, unless it is long."""
    reach = scene.reach
    return (max(lo, -reach if hi > -reach else hi - 2 * reach), min(hi, reach if lo < reach else lo + 2 * reach))


def stretch(lo, hi, wide):
    """A bounded part of a domain to draw from."""
    if mpmath.isfinite(lo) and mpmath.isfinite(hi):
        return lo, hi
    if mpmath.isfinite(lo):
        return lo, lo + wide
    return (hi - wide, hi) if mpmath.isfinite(hi) else (mpmath.mpf(-wide), mpmath.mpf(wide))


def refused(verdict, said):
    """A crash, or an error that answers nothing: then there is nothing to compare."""
    if said.crash:
        verdict.add("crash", said.crash)
    elif said.error and not said.every and not said.none:
        words = said.error + " " + (said.hint or "")
        reason = REASONS.search(words) and not re.search(r"equations for \d+ unknowns", words)
        verdict.add("said" if reason else "error", said.error)
    return bool(verdict.found)


def missing(verdict, said, text):
    """A solution that is there and not listed."""
    if said.partial:
        verdict.add("said", text)
    elif not said.entries:
        verdict.add("wrong", "says there is none; " + text)
    else:
        verdict.add("incomplete", text)


def member(scene, i, at, of, rough=False):
    """Is a value of the i-th unknown in its domain? of(): it, in the precision in force. rough: 15 digits of it."""
    v = of()
    for end, sign in zip(scene.coords[i][1:3], (1, -1)):
        if end:
            d = sign * (v - value(bare(end), at))
            if rough and abs(d) < 1e-9:
                continue
            if abs(d) < 1e-20 and vanishes(lambda: of() - value(bare(end), at)):
                if end[0] == "=":
                    continue
                return False
            if d < 0:
                return False
    return True


def integers(entry, known, reach):
    """Values of the integers of a family, all within reach; [{}] if it is none."""
    free = entry.free(known)
    if not free:
        return [{}]
    if len(free) > 2:
        raise Unreadable("integers " + " ".join(free))
    span = range(-reach, reach + 1)
    return [dict(zip(free, (mpmath.mpf(n) for n in c))) for c in itertools.product(span, repeat=len(free))]


# --- solve --------------------------------------------------------------------------------------

def compare_roots(scene, said):
    verdict = Verdict()
    if refused(verdict, said):
        return verdict
    x = scene.unknown
    tree = read(f"({scene.lhs}) - ({scene.rhs})")
    known = set(scene.params) | {x}
    waving = scene.turn or scene.kind == "families" or bool(re.search(r"\b(sin|cos|tan)\(", scene.lhs + scene.rhs))
    seen = [[] for _ in said.entries]
    samples = scene.samples(70)
    for at in samples[:10] + [at for at in samples[10:] if suspicious(scene, said, tree, x, at)][:6]:
        if undefined(tree, at):
            continue
        (lo, hi), = ends(scene, at)
        part = window(scene, lo, hi) if waving else (lo, hi)
        truth, spans = zeros(tree, x, at, *part)
        for h in scene.hints + [bare(e) for e in scene.coords[0][1:3] if e and e[0] == "="]:
            of = lambda: value(h, at)
            if member(scene, 0, at, of) and vanishes(lambda: Real.of(tree, dict(at, **{x: of()}))):
                truth.append(of())
        bounded = mpmath.isfinite(lo) and mpmath.isfinite(hi)
        turn = waving and (said.turns or recurs(tree, x, at))
        if said.every:
            if not truth_everywhere(tree, x, at, lo, hi):
                verdict.add("wrong", f"holds for every value is false at {short(at)}; zeros {shown(truth)}")
            continue
        listed, sets = [], []
        for k, e in enumerate(said.entries):
            states = entry_states(e, scene, tree, x, at, lo, hi, known, scene.reach)
            seen[k] += [(s, at, v) for s, v in states]
            listed += [v for s, v in states if s == "root"]
            if e.relations and not e.equations:
                sets.append(e)
        near = mpmath.mpf(10) ** (-20 if scene.hints else -9)
        for v in truth + spans:
            if any(abs(u - v) <= near * (1 + abs(v)) for u in listed):
                continue
            if any(holds(e, dict(at, **{x: u})) for e in sets for u in (v, mpmath.nint(v * 720720) / 720720)):
                continue
            if turn and not bounded and any(abs(wrap(u - v)) < 1e-9 * (1 + abs(v)) for u in listed):
                continue
            of = " (of an interval)" if v in spans else ""
            missing(verdict, said, f"{x} = {mpmath.nstr(v, 12)} is missing at {short(at)}{of}")
            break
    for at in [*scene.special_samples(), *scene.edge_samples(14)]:
        compare_special(verdict, scene, said, tree, x, at, known)
    for e, states in zip(said.entries, seen):
        if scene.params and not any(s == "root" for s, _, _ in states):
            for at in scene.samples(60)[8:]:
                (lo, hi), = ends(scene, at)
                more = entry_states(e, scene, tree, x, at, lo, hi, known, 8)
                states += [(s, at, v) for s, v in more if s == "root"]
        weigh(verdict, e.text + (f" [{e.words}]" if e.words else ""), e.exists is not None, states)
    return verdict


def compare_special(verdict, scene, said, tree, x, at, known):
    """At special values of parameters: no entry without a value, and every zero listed or in a notice."""
    if undefined(tree, at):
        return
    (lo, hi), = ends(scene, at)
    part = window(scene, lo, hi)
    truth, spans = zeros(tree, x, at, *part)
    listed, every = [], said.every
    for e in said.entries:
        for state, v in entry_states(e, scene, tree, x, at, lo, hi, known, scene.reach):
            if state == "root":
                listed.append(v)
            elif state != "idle":
                verdict.add("condition", f"{e.text} [{e.words}] is none at {short(at)}")
    sets = [e for e in said.entries if e.relations and not e.equations]
    for where, entries in said.special:
        sides = [(value(left, at), value(right, at)) for left, right in where]
        if not all(abs(left - right) <= 1e-30 for left, right in sides):
            continue
        every = every or entries is None
        for e in entries or []:
            for state, v in entry_states(e, scene, tree, x, at, lo, hi, known, scene.reach):
                if state == "root":
                    listed.append(v)
                elif state != "idle":
                    verdict.add("condition", f"special {e.text} is none at {short(at)}")
            if e.relations and not e.equations:
                sets.append(e)
    for v in [] if every else truth + spans:
        if any(holds(e, dict(at, **{x: u})) for e in sets for u in (v, mpmath.nint(v * 720720) / 720720)):
            continue
        if not any(abs(u - v) <= 1e-9 * (1 + abs(v)) or abs(wrap(u - v)) <= 1e-9 * (1 + abs(v)) for u in listed):
            missing(verdict, said, f"{x} = {mpmath.nstr(v, 12)} is missing at special {short(at)}")
            return
    if every and not truth_everywhere(tree, x, at, lo, hi):
        verdict.add("wrong", f"holds for every value is false at {short(at)}")


def suspicious(scene, said, tree, x, at):
    """On a coarse grid, in doubles: a change of sign where nothing is listed."""
    try:
        (lo, hi), = ends(scene, at)
        points = grid(float(lo), float(hi), scene.reach, 512)
        with np.errstate(all="ignore"):
            y = array(tree, dict({k: float(v) for k, v in at.items()}, **{x: points}))
            y = np.broadcast_to(np.asarray(y, float), points.shape)
            product = y[:-1] * y[1:]
        change = np.flatnonzero((product < 0) & np.isfinite(product) & (np.abs(points[1:]) < 1000))[:20]
        active = [e for e in said.entries if not e.free(set(at) | {x}) and
                  (e.exists is None or value(e.exists, at) is True)]
        listed = [float(value(f, at)) for e in active for _, f in e.equations]
        return any(not any(points[i] - 1e-9 <= v <= points[i + 1] + 1e-9 for v in listed) for i in change)
    except (Unreadable, KeyError, TypeError, ValueError):
        return True


def recurs(tree, x, at):
    """Has it the period 2*pi? At nine places, in 50 digits."""
    f = lambda v: Real.of(tree, dict(at, **{x: v}))
    places = [mpmath.mpf(k) * 7 / 9 - 3 for k in range(9)]
    pairs = [(f(v), f(v + 2 * mpmath.pi)) for v in places]
    pairs = [(a, b) for a, b in pairs if not (mpmath.isnan(a) and mpmath.isnan(b))]
    return bool(pairs) and all(abs(a - b) <= mpmath.mpf(10) ** -30 * (1 + abs(a)) for a, b in pairs)


def shown(points):
    return ", ".join(mpmath.nstr(v, 8) for v in points[:6]) or "none"


def truth_everywhere(tree, x, at, lo, hi):
    """Does it vanish at each of twelve places, wherever it is defined?"""
    draw = random.Random(1)
    for _ in range(12):
        a, b = stretch(lo, hi, 10)
        v = a + (b - a) * mpmath.mpf(draw.random())
        f = Real.of(tree, dict(at, **{x: v}))
        if not mpmath.isnan(f) and not vanishes(lambda: Real.of(tree, dict(at, **{x: v}))):
            return False
    return True


def holds(e, at, turns=()):
    """Does an entry that stands for a set hold this place, or one that is whole turns of these unknowns away?"""
    shifts = itertools.product((0, 1, -1, 2, -2), repeat=len(turns))
    places = (dict(at, **{n: at[n] + 2 * k * mpmath.pi for n, k in zip(turns, by)}) for by in shifts)
    return any(all(value(r, p) for r in e.relations) and (e.exists is None or value(e.exists, p) is True)
               for p in places)


def entry_states(e, scene, tree, x, at, lo, hi, known, reach):
    """[(state, value)] of one entry at these parameters: idle, root, notreal, notroot, outside."""
    if e.relations and not e.equations:
        out = []
        a, b = stretch(lo, hi, 10)
        for v in (a + (b - a) * (mpmath.mpf(k) / 62 + mpmath.mpf(1) / 977) for k in range(62)):
            if lo < v < hi and holds(e, dict(at, **{x: v})):
                out.append(("root" if vanishes(lambda: Real.of(tree, dict(at, **{x: v}))) else "notroot", v))
        return out or [("idle", None)]
    out = []
    formula = read(e.equations[0][1])
    family = bool(e.free(known))
    part = window(scene, lo, hi) if reach < 30 else (max(lo, mpmath.mpf(-30)), min(hi, mpmath.mpf(30)))
    for n in integers(e, known, 250 if len(e.free(known)) == 1 else 25):
        here = dict(at, **n)
        if e.exists is not None and value(e.exists, here) is not True:
            out.append(("idle", None))
            continue
        v = Real.of(formula, here)
        if mpmath.isnan(v):
            out.append(("notreal", None))
        elif family and not member(scene, 0, at, lambda: Real.of(formula, here)):
            out.append(("outside", v))
        elif family and not part[0] <= v <= part[1]:
            out.append(("idle", v))
        elif not (vanishes(lambda: Real.of(tree, dict(here, **{x: Real.of(formula, here)}))) or
                  e.numeric and near_zero(tree, x, v, at)):
            out.append(("notroot", v))
        elif not member(scene, 0, at, lambda: Real.of(formula, here), e.numeric):
            out.append(("outside", v))
        else:
            out.append(("root", v))
    return out


def near_zero(tree, x, v, at):
    """Of a number of 15 digits: is there a zero within 1e-9 of it?"""
    d = mpmath.mpf(10) ** -9 * (1 + abs(v))
    f = lambda u: Real.of(tree, dict(at, **{x: u}))
    a, m, b = f(v - d), f(v), f(v + d)
    if mpmath.isnan(a) or mpmath.isnan(b):
        return False
    return a * b <= 0 or abs(m) < 1e-3 * max(abs(a), abs(b))


def weigh(verdict, text, conditioned, states):
    """One entry over all samples: never a solution, or not always one."""
    bad = [(s, at, v) for s, at, v in states if s in ("notreal", "notroot", "outside")]
    if not bad:
        return
    s, at, v = next((b for b in bad if b[0] != "notreal"), bad[0])
    word = {"notreal": "is not real", "notroot": "is no solution", "outside": "is outside the domain"}[s]
    text = f"{text} {word} at {short(at)}"
    if v is not None:
        text += ": " + (v if isinstance(v, str) else mpmath.nstr(v, 12))
    if not any(state == "root" for state, _, _ in states):
        verdict.add("wrong", text)
    else:
        verdict.add("visible" if s == "notreal" and not conditioned else "condition", text)


# --- equilibria ---------------------------------------------------------------------------------

def plain(expression):
    """SymPy's expression as a tree."""
    return read(str(expression).replace("Abs(", "abs(").replace("Max(", "max(").replace("Min(", "min("))


class Rests:
    """Where a scene may rest: gradients with corners and dry friction, and points found by search."""
    def __init__(self, scene):
        self.scene = scene
        self.q = [c[0] for c in scene.coords]
        symbols = [sympy.Symbol(n, real=True) for n in self.q]
        self.V = symbolic(scene.potential)
        self.gradient = [plain(sympy.diff(self.V, s)) for s in symbols]
        self.corners = [(read(c), read(f), [plain(sympy.diff(symbolic(f), s)) for s in symbols])
                        for c, f in scene.corners]
        self.friction = [read(scene.friction[n]) if n in scene.friction else None for n in self.q]
        self.forces = None
        if len(self.q) > 1 and not scene.corners and not scene.constraint:
            self.forces = Forces(scene.potential, self.q, list(scene.params))
        self.potential = read(scene.full_potential())
        if scene.constraint:
            g = [sympy.diff(symbolic(scene.constraint), v) for v in symbols]
            cross = sympy.diff(self.V, symbols[0]) * g[1] - sympy.diff(self.V, symbols[1]) * g[0]
            self.gradient = [read(scene.constraint), plain(cross)]

    def pulls(self, at):
        """For each coordinate (force without what a corner or friction may hold, how much that is)."""
        total = [Real.of(g, at) for g in self.gradient]
        slack = [mpmath.mpf(0)] * len(self.q)
        for c, f, df in self.corners:
            c, f = Real.of(c, at), Real.of(f, at)
            for i, g in enumerate(df):
                g = Real.of(g, at)
                if abs(f) < mpmath.mpf(10) ** -30:
                    slack[i] += c * abs(g)
                else:
                    total[i] += c * mpmath.sign(f) * g
        for i, mu in enumerate(self.friction):
            if mu is not None:
                slack[i] += abs(Real.of(mu, at))
        return total, slack

    def has_energy(self, at):
        """Is the potential real there? The slope of a*log(x) is a number where the potential is none."""
        return not mpmath.isnan(Real.of(self.potential, at))

    def is_rest(self, place):
        """place(): the values of everything, computed anew in the precision in force."""
        total, slack = self.pulls(place())
        if any(mpmath.isnan(g) for g in total) or not self.has_energy(place()):
            return False
        for i in range(len(self.q)):
            held = slack[i] > 0 and abs(total[i]) <= slack[i] * (1 + mpmath.mpf(10) ** -25)
            if not held and not vanishes(lambda: self.pulls(place())[0][i]):
                return False
        return True

    def near_rest(self, at):
        """A number of 15 digits: is there a rest within 1e-8?"""
        total, slack = self.pulls(at)
        if any(mpmath.isnan(g) for g in total):
            return False
        if self.forces:
            place = [at[n] for n in self.q]
            both = self.forces.at(place, at)
            step = gauss(both[1], both[0])[0] if both else None
            small = step is not None and all(abs(d) <= 1e-9 * (1 + abs(v)) for d, v in zip(step, place))
            return small or polish(self.forces, place, at, 1e-7) is not None
        if any(s > 0 for s in slack):
            return all(abs(g) <= s + 1e-9 for g, s in zip(total, slack))
        if len(self.q) == 1:
            x = self.q[0]
            d = mpmath.mpf(10) ** -9 * (1 + abs(at[x]))
            a, b = (self.pulls(dict(at, **{x: at[x] + k * d}))[0][0] for k in (-1, 1))
            return mpmath.isfinite(a * b) and (a * b <= 0 or abs(total[0]) < 1e-3 * max(abs(a), abs(b)))
        return all(abs(g) < 1e-8 for g in total)

    def truth(self, at, seed):
        """[(place, whether it is regular)] inside the domain."""
        scene, box = self.scene, ends(self.scene, at)
        angle = [c[3] for c in scene.coords]
        box = [(-mpmath.pi, +mpmath.pi) if a else b for a, b in zip(angle, box)]
        within = lambda p: (all(a or inside(v, lo, hi) for v, (lo, hi), a in zip(p, box, angle))
                            and self.has_energy(dict(at, **dict(zip(self.q, p)))))
        if scene.constraint:
            s = sympy.Symbol("s", real=True)
            on = {sympy.Symbol(n, real=True): symbolic(c) for n, c in zip(self.q, scene.curve)}
            W = self.V.subs(on, simultaneous=True)
            places = zeros(plain(sympy.diff(W, s)), "s", at, mpmath.mpf("-3.2"), mpmath.mpf("3.2"))[0]
            places = [[value(c, dict(at, s=v)) for c in scene.curve] for v in places]
            return [(p, True) for p in places if within(p)]
        if len(self.q) == 1:
            x = self.q[0]
            closed = [bare(e) for e in scene.coords[0][1:3] if e and e[0] == "="]
            closed = [e for e in closed if self.is_rest(lambda: dict(at, **{x: value(e, at)}))]
            inner = [(p, regular) for p, regular in self.truth_line(at, box[0], angle[0]) if within(p)]
            return inner + [([value(e, at)], True) for e in closed]
        if not scene.corners and not scene.friction:
            flat = [(float(lo), float(hi), a) for (lo, hi), a in zip(box, angle)]
            waves = re.search(r"\b(sin|cos|tan)\(", scene.potential)
            found = stationary(self.forces, at, flat, seed)
            return [(p, regular) for p, regular in found if (not waves or max(abs(v) for v in p) < 12)
                    and self.has_energy(dict(at, **dict(zip(self.q, p))))]
        return [(p, regular) for p, regular in self.truth_plane(at, box) if within(p)]

    def force(self):
        """dV/dx along a line, corners with it."""
        x = sympy.Symbol(self.q[0], real=True)
        parts = [f"({sympy.diff(self.V, x)})"]
        parts += [f"({c})*sign({f})*({sympy.diff(symbolic(f), x)})" for c, f in self.scene.corners]
        return read(" + ".join(parts).replace("Abs(", "abs("))

    def truth_line(self, at, box, angle):
        """One coordinate: zeros of the force, corners that hold, places of a band of friction."""
        x, scene = self.q[0], self.scene
        lo, hi = box
        waving = bool(re.search(r"\b(sin|cos|tan)\(", scene.potential))
        if waving:
            lo, hi = window(scene, lo, hi)
        if angle:
            lo, hi = lo - mpmath.mpf(1) / 1000, hi + mpmath.mpf(1) / 1000
        tree = self.force()
        if scene.friction:
            mu = abs(Real.of(self.friction[0], at))
            low, high = max(lo, mpmath.mpf(-scene.reach)), min(hi, mpmath.mpf(scene.reach))
            if low >= high:
                low, high = stretch(lo, hi, 10)
            out = []
            for k in range(1, 60):
                v = low + (high - low) * (mpmath.mpf(k) / 60 + mpmath.mpf(1) / 977)
                g = Real.of(tree, dict(at, **{x: v}))
                if lo < v < hi and not mpmath.isnan(g) and abs(g) < mu * mpmath.mpf("0.999"):
                    out.append(([v], False))
            return out
        truth, spans = zeros(tree, x, at, lo, hi)
        edges = [v for v in (self.edge(f, x, at) for _, f, _ in self.corners) if v is not None]
        out = [([v], True) for v in truth if not any(abs(v - e) < 1e-12 for e in edges)]
        out += [([v], False) for v in spans]
        for e in edges:
            total, slack = self.pulls(dict(at, **{x: e}))
            if abs(total[0]) < slack[0] * mpmath.mpf("0.9999"):
                out.append(([e], True))
        if angle:
            out = [([wrap(p[0])], regular) for p, regular in out]
        return out

    def edge(self, f, x, at):
        """Where a corner's formula, linear in x, vanishes."""
        a, b = Real.of(f, dict(at, **{x: mpmath.mpf(0)})), Real.of(f, dict(at, **{x: mpmath.mpf(1)}))
        return None if a == b else -a / (b - a)

    def truth_plane(self, at, box):
        """Two coordinates, the corner or the friction in x."""
        x, y = self.q
        dx, dy = self.gradient
        out = []
        (xl, xh), (yl, yh) = box
        if self.corners:
            c = Real.of(self.corners[0][0], at)
            for v in zeros(dy, y, dict(at, **{x: mpmath.mpf(0)}), yl, yh)[0]:
                if abs(Real.of(dx, dict(at, **{x: mpmath.mpf(0), y: v}))) < c * mpmath.mpf("0.9999"):
                    out.append(([mpmath.mpf(0), v], True))
            for side in (1, -1):
                potential = f"{self.scene.potential} + {side}*({self.scene.corners[0][0]})*{x}"
                forces = Forces(potential, self.q, list(self.scene.params))
                half = [(max(xl, mpmath.mpf(0)), xh) if side > 0 else (xl, min(xh, mpmath.mpf(0))), (yl, yh)]
                if half[0][0] < half[0][1]:
                    out += stationary(forces, at, [(float(a), float(b), False) for a, b in half], side)
            return out
        mu = abs(Real.of(self.friction[0], at))
        low, high = max(xl, mpmath.mpf(-4)), min(xh, mpmath.mpf(4))
        if low >= high:
            low, high = stretch(xl, xh, 4)
        for k in range(1, 24):
            u = low + (high - low) * (mpmath.mpf(k) / 24 + mpmath.mpf(1) / 977)
            if xl < u < xh:
                for v in zeros(dy, y, dict(at, **{x: u}), yl, yh)[0]:
                    if abs(Real.of(dx, dict(at, **{x: u, y: v}))) < mu * mpmath.mpf("0.999"):
                        out.append(([u, v], False))
        return out

    def stability(self, p, at):
        """'stable', 'unstable' or None: by the Hessian; along a line by the potential beside."""
        if self.scene.friction or self.scene.constraint:
            return None
        here = dict(at, **dict(zip(self.q, p)))
        if len(self.q) == 1:
            x, d = self.q[0], mpmath.mpf(10) ** -4
            V0, Va, Vb = (Real.of(self.potential, dict(here, **{x: p[0] + k * d})) for k in (0, -1, 1))
            if any(mpmath.isnan(v) for v in (V0, Va, Vb)):
                return None
            margin = mpmath.mpf(10) ** -40 * (1 + abs(V0))
            if Va > V0 + margin and Vb > V0 + margin:
                return "stable"
            return "unstable" if Va < V0 - margin or Vb < V0 - margin else None
        both = self.forces.at(p, at) if self.forces else None
        if both is None:
            return None
        eigen = np.linalg.eigvalsh(np.array([[float(h) for h in row] for row in both[1]]))
        size = max(abs(v) for v in eigen)
        if min(eigen) < -1e-8 * size:
            return "unstable"
        return "stable" if min(eigen) > 1e-8 * size else None


def place_entry(e, scene, at, box, known, draw, ints):
    """Values of all coordinates on one entry, as a function of the precision; free ones drawn."""
    given = {n for n, _ in e.equations}
    free = {}
    for (n, *_), (lo, hi) in zip(scene.coords, box):
        if n not in given:
            a, b = stretch(lo, hi, 3 if draw.random() < 0.6 else 25)
            free[n] = a + (b - a) * mpmath.mpf(draw.random())

    def place():
        here = dict(at, **ints, **free)
        left = list(e.equations)
        while left:
            ready = [(n, f) for n, f in left if names(f) <= set(here)]
            if not ready:
                raise Unreadable("equations in a circle: " + e.text)
            for n, f in ready:
                here[n] = value(f, here)
            left = [(n, f) for n, f in left if n not in here]
        return here
    return place


def entry_rest_states(e, rests, scene, at, box, known, draw):
    """[(state, words, place)] of one entry at these parameters."""
    out = []
    wants_draw = bool(set(rests.q) - {n for n, _ in e.equations})
    for ints in integers(e, known, 3 if len(rests.q) > 1 else 12):
        for _ in range(14 if wants_draw else 1):
            place = place_entry(e, scene, at, box, known, draw, ints)
            here = place()
            if not all(value(r, here) is True for r in e.relations):
                continue
            if e.exists is not None and value(e.exists, here) is not True:
                out.append(("idle", None, None))
                continue
            text = ", ".join(f"{n} = {mpmath.nstr(here[n], 10)}" for n in rests.q)
            if any(mpmath.isnan(here[n]) for n in rests.q):
                out.append(("notreal", None, None))
            elif not rests.is_rest(place) and not (e.numeric and rests.near_rest(here)):
                out.append(("notroot", text, here))
            elif not all(member(scene, i, here, lambda: place()[n], e.numeric) for i, n in enumerate(rests.q)):
                out.append(("outside", text, here))
            else:
                out.append(("root", text, here))
    return out or [("idle", None, None)]


def undefined(tree, at):
    """Is a part that holds only parameters without a value? Then the whole statement has none."""
    for node in ast.walk(tree):
        if isinstance(node, (ast.BinOp, ast.Call)) and names(node) <= set(at) and mpmath.isnan(Real.of(node, at)):
            return True
    return False


def on_entry(e, scene, p, at, known, regular=True):
    """Is this place of rest on the entry?"""
    here = dict(at, **{c[0]: v for c, v in zip(scene.coords, p)})
    angle = {c[0]: c[3] or (scene.turn and not (c[1] and c[2])) for c in scene.coords}
    near = 1e-9 if regular and not e.numeric else 1e-5
    for ints in integers(e, known, 40 if len(e.free(known)) == 1 else 8):
        now = dict(here, **ints)
        off = [(here[n] - value(f, now), abs(here[n]), angle[n]) for n, f in e.equations]
        if all(abs(wrap(d) if turns else d) <= near * (1 + size) for d, size, turns in off) and \
                holds(e, now, [n for n in angle if angle[n]]):
            return True
    return False


def compare_rests(scene, said):
    verdict = Verdict()
    if refused(verdict, said):
        return verdict
    rests = Rests(scene)
    known = set(scene.params) | set(rests.q)
    seen = [[] for _ in said.entries]
    samples = scene.samples(70 if len(rests.q) == 1 else 6)
    if len(rests.q) == 1 and not scene.friction:
        x, force = rests.q[0], rests.force()
        samples = samples[:10] + [at for at in samples[10:] if suspicious(scene, said, force, x, at)][:6]
    for number, at in enumerate(samples):
        if undefined(rests.potential, at):
            continue
        box = ends(scene, at)
        draw = random.Random(number)
        for k, e in enumerate(said.entries):
            states = entry_rest_states(e, rests, scene, at, box, known, draw)
            seen[k] += [(s, at, t) for s, t, _ in states]
            for s, _, here in states:
                if s == "root":
                    compare_stability(verdict, e, rests, [here[n] for n in rests.q], at, here)
        if said.every:
            parts = [stretch(lo, hi, 9) for lo, hi in box]
            places = [{n: a + (b - a) * k / 11 for n, (a, b) in zip(rests.q, parts)} for k in range(1, 11)]
            if not all(rests.is_rest(lambda: dict(at, **place)) for place in places):
                verdict.add("wrong", "says it holds for every value: " + (said.error or " ".join(said.notes)))
            continue
        for p, regular in rests.truth(at, f"{scene.kind} {scene.index} {number}"):
            if not any(on_entry(e, scene, p, at, known, regular) for e in said.entries):
                where = ", ".join(f"{n} = {mpmath.nstr(v, 10)}" for n, v in zip(rests.q, p))
                kind = "" if regular else " (degenerate, or of a set)"
                missing(verdict, said, f"{where} is missing at {short(at)}{kind}")
                break
    for e, states in zip(said.entries, seen):
        if scene.params and not any(s == "root" for s, _, _ in states):
            for at in scene.samples(60)[8:]:
                more = entry_rest_states(e, rests, scene, at, ends(scene, at), known, draw)
                states += [(s, at, t) for s, t, _ in more if s == "root"]
        weigh(verdict, f"{e.text} [{e.words}]", e.exists is not None, states)
    return verdict


def compare_stability(verdict, e, rests, p, at, here):
    """`stable when C` says nothing where C does not hold."""
    truth = rests.stability(p, at)
    if truth is None or e.stability is None:
        return
    holds = e.stable_when is None or value(e.stable_when, here) is True
    if holds and e.stability in ("stable", "stable to first order") and truth == "unstable":
        verdict.add("stability", f"{e.text} [{e.words}] is unstable at {short(at)}")
    elif holds and e.stability == "unstable" and truth == "stable":
        verdict.add("stability", f"{e.text} [{e.words}] is stable at {short(at)}")
    elif "undecided" in e.stability:
        verdict.weak += 1


def compare(scene, said):
    try:
        return compare_roots(scene, said) if scene.lhs else compare_rests(scene, said)
    except Unreadable as why:                           # a name that is nothing, a circle, another form
        verdict = Verdict()
        verdict.add("error", f"not understood: {why}")
        return verdict
