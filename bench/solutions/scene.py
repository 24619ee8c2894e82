"""scene.py -- one scene: its declarations, the script that asks, values of its parameters; pieces to draw it from."""
import math, random, re
from dataclasses import dataclass, field
from fractions import Fraction

import mpmath

from formula import names, read, value


@dataclass
class Scene:
    kind: str
    index: int
    seed: str = "1"
    params: dict = field(default_factory=dict)        # name: "", "> 0" or "< 0"
    # solve
    lhs: str = ""
    rhs: str = "0"
    unknown: str = "x"
    turn: bool = False                                # has the period 2*pi: a list within one turn will do
    # equilibria
    potential: str = ""
    coords: list = field(default_factory=list)        # (name, low, high, is an angle); ends None or formulas
    friction: dict = field(default_factory=dict)      # coordinate: threshold of -mu*sign(q')
    damping: dict = field(default_factory=dict)       # coordinate: coefficient of -c*q'
    corners: list = field(default_factory=list)       # (c, f): c*abs(f) beside the potential
    statements: str = ""                              # instead of a Lagrangian
    reach: float = 40
    assume: list = field(default_factory=list)        # relations between parameters
    constraint: str = ""                              # in x and y, = 0, with a curve x(s), y(s) along it
    curve: tuple = ()
    specials: list = field(default_factory=list)      # {parameter: formula}: values that count too
    hints: list = field(default_factory=list)         # formulas that may be zeros: checked, not believed

    def script(self):
        out = [f"param {n} {s}".rstrip() for n, s in self.params.items()]
        for name, lo, hi, _ in self.coords:
            below, above = ("<=" if e and e[0] == "=" else "<" for e in (lo, hi))
            lo, hi = (bare(e) for e in (lo, hi))
            if lo and re.match(r"\w+\(", lo):           # `coord sqrt(2) < x` would declare a function
                lo = f"({lo})"
            if lo and hi:
                out.append(f"coord {lo} {below} {name} {above} {hi}")
            elif lo:
                out.append(f"coord {name} {below.replace('<', '>')} {lo}")
            else:
                out.append(f"coord {name}" + (f" {above} {hi}" if hi else ""))
        out += [f"assume {a}" for a in self.assume]
        if self.lhs:
            out.append(f"solve({self.lhs} = {self.rhs}, {self.unknown})")
        else:
            if self.statements:
                out.append(self.statements)
            else:
                squares = " + ".join(f"{c[0]}'^2/2" for c in self.coords)
                V = self.full_potential()
                out.append(f"lagrangian {squares} - ({V})")
            out += [f"force -{m}*sign({q}') on {q}" for q, m in self.friction.items()]
            out += [f"force -{m}*{q}' on {q}" for q, m in self.damping.items()]
            out.append("equilibria")
        return "\n".join(out) + "\n"

    def special_samples(self):
        """Values of the parameters, some of them special."""
        for at, special in zip(self.samples(max(2, len(self.specials))), self.specials):
            for name, formula in special.items():
                at[name] = value(formula, at)
            yield at

    def edge_samples(self, count):
        """Small and equal values of the parameters, where divisors vanish and roots meet."""
        draw = random.Random(f"edges {self.kind} {self.seed} {self.index}")
        out = []
        for _ in range(20 * count if self.params else 0):
            at = {}
            for n, sign in self.params.items():
                others = [v for o in at.values() for v in (o, o, -o, o ** 2, o ** 2 / 4, 1 / o if o else o)]
                at[n] = draw.choice(others if others and draw.random() < 0.4 else
                                    [mpmath.mpf(v) / 2 for v in (0, 0, 0, 2, -2, 1, -1, 4, -4, 6)])
            both = [(value(bare(lo), at), value(bare(hi), at)) for _, lo, hi, _ in self.coords if lo and hi]
            if all(v > 0 if self.params[n] == "> 0" else v < 0 if self.params[n] == "< 0" else True
                   for n, v in at.items()) and all(lo < hi for lo, hi in both) and \
                    all(value(a, at) is True for a in self.assume) and at not in out:
                out.append(at)
            if len(out) == count:
                break
        return out

    def full_potential(self):
        return " + ".join(p for p in [self.potential] + [f"{c}*abs({f})" for c, f in self.corners] if p)

    def samples(self, count):
        """Values of the parameters, in 50 digits; ends of domains in their order."""
        draw = random.Random(f"values {self.kind} {self.seed} {self.index}")
        out = []
        for _ in range(60 * count):
            at = {}
            for n, sign in self.params.items():
                v = self.magnitude(draw, list(at.values()))
                at[n] = -v if sign == "< 0" or (sign == "" and draw.random() < 0.5) else v
            both = [(value(bare(lo), at), value(bare(hi), at)) for _, lo, hi, _ in self.coords if lo and hi]
            if all(lo < hi for lo, hi in both) and all(value(a, at) for a in self.assume):
                out.append(at)
            if len(out) == (count if self.params else 1):
                break
        return out

    @staticmethod
    def magnitude(draw, others):
        """Of order 1; now and then beside a simple ratio to another value: there conditions change."""
        if others and draw.random() < 0.35:
            ratio = Fraction(draw.choice((4, 8, 2, 16, 1, 12, 36)) * draw.choice((97, 103, 91, 109)), 400)
            return abs(draw.choice(others)) * ratio.numerator / ratio.denominator
        v = draw.uniform(0.05, 1.6) if draw.random() < 0.55 else math.exp(draw.uniform(-1.6, 2.2))
        return mpmath.mpf(round(v * 1000) * 2 + 1) / 2048


def bare(end):
    """An end of a domain without the sign that says it belongs to it."""
    return end.lstrip("=") if end else end


def pick(scene, forms):
    """One of the forms: scenes that follow each other take different ones, until all had their turn."""
    order = list(range(len(forms)))
    random.Random(f"order {scene.kind} {scene.seed} {scene.index // len(forms)}").shuffle(order)
    return forms[order[scene.index % len(forms)]]


# --- pieces ---------------------------------------------------------------------------------

def num(draw, top=5, den=(1, 1, 1, 2, 3), zero=False):
    while True:
        v = Fraction(draw.randint(-top, top), draw.choice(den))
        if v or zero:
            return v


def term(c, f, first=False):
    """`- 3/2*x` with its sign."""
    c = Fraction(c)
    body = f if abs(c) == 1 and f else (f"{abs(c)}*{f}" if f else f"{abs(c)}")
    return ("-" if c < 0 else "") + body if first else (" - " if c < 0 else " + ") + body


def total(pairs):
    pairs = [(c, f) for c, f in pairs if c]
    return "".join(term(c, f, i == 0) for i, (c, f) in enumerate(pairs)) or "0"


def shifted(x, r):
    return x if r == 0 else f"({x}{term(-Fraction(r), '')})"


def expand(roots):
    """Coefficients of prod (x - r), lowest first."""
    c = [Fraction(1)]
    for r in roots:
        c = [(c[i - 1] if i else 0) - (c[i] * r if i < len(c) else 0) for i in range(len(c) + 1)]
    return c


def polynomial(c, x="x"):
    return total([(c[k], f"{x}^{k}" if k > 1 else x if k else "") for k in range(len(c) - 1, -1, -1)])


ENDS = ["0", "1", "2", "-1", "-2", "1/2", "3", "pi", "-pi", "pi/2", "-pi/2", "sqrt(2)", "-sqrt(3)", "2*pi",
        "10", "3*pi/4", "exp(1)", "sqrt(5)/2", "-3*pi", "4*pi"]
TURNS = [("0", "2*pi"), ("0", "2*pi"), ("-pi/2", "pi/2"), ("0", "pi"), ("10", None), ("-pi", "pi"), ("0", "4*pi"),
         ("1", "7"), ("pi", "2*pi"), ("-10", "-3"), (None, "-2"), ("sqrt(2)", "2*sqrt(3)"), ("pi/4", "5*pi/4"),
         ("-2*pi", "0"), ("-1", "1"), ("0", None)]
SIGNS = ["", "", "> 0", "< 0"]
WAVES = ("sin(", "cos(", "tan(")                      # formulas with these have zeros without end


def domain(draw, p=0.5, parameter=False, params=None):
    return closed(draw, open_domain(draw, p, parameter, params))


def closed(draw, ends):
    """Now and then an end that belongs to the domain."""
    return tuple("=" + e if e and draw.random() < 0.08 else e for e in ends)


def open_domain(draw, p, parameter, params):
    """Two ends, possibly none; with parameters a name may be an end."""
    if draw.random() > p:
        return None, None
    if parameter and params is not None and draw.random() < 0.6:
        params["L"] = "> 0"
        return draw.choice([("0", "L"), ("-L", "L"), ("L", None), (None, "L"), ("0", "2*L"), ("L", "L + 1"),
                            ("0", "pi*L")])
    kind = draw.random()
    if kind < 0.2:
        return draw.choice(ENDS), None
    if kind < 0.35:
        return None, draw.choice(ENDS)
    while True:
        a, b = draw.choice(ENDS), draw.choice(ENDS)
        if value(a, {}) < value(b, {}):
            return a, b


def angle_domain(draw):
    return closed(draw, draw.choice(TURNS))


def sign(draw):
    return draw.choice(SIGNS)


def signs(s, d, *texts, positive=""):
    """Declare the parameters that occur in these formulas."""
    for n in sorted(set().union(*[names(read(t)) for t in texts]) - {*"xyzuv", "th"}):
        s.params[n] = "> 0" if n in positive else sign(d)


def rename(s, old, new):
    change = lambda t: re.sub(rf"\b{old}\b", new, t) if isinstance(t, str) else t
    for f in ("lhs", "rhs", "unknown", "potential", "constraint"):
        setattr(s, f, change(getattr(s, f)))
    s.params = {change(k): v for k, v in s.params.items()}
    s.coords = [tuple(change(v) for v in c) for c in s.coords]
    s.friction, s.damping = ({change(k): change(v) for k, v in f.items()} for f in (s.friction, s.damping))
    s.corners = [(change(c), change(f)) for c, f in s.corners]
    s.assume, s.hints = [change(a) for a in s.assume], [change(h) for h in s.hints]


def draw_scene(kind, seed, index, fill):
    """The scene of that number; fill(scene, draw) states what its kind is."""
    scene = Scene(kind, index, str(seed))
    draw = random.Random(f"{kind} {seed} {index}")
    fill(scene, draw)
    old = [n for n in [scene.coords[0][0], *scene.params] if n in ("x", "a", "th")]
    if old and not scene.statements and draw.random() < 0.05:
        rename(scene, draw.choice(old), "n")          # the name that the integer of a family would have
    return scene
