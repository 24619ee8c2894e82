"""rests.py -- potentials, for `equilibria`, by kinds."""
import re
from fractions import Fraction

from scene import WAVES, angle_domain, domain, expand, num, pick, polynomial, sign, signs, term, total


def monomials(names, degree, draw, count, even=False):
    out = {}
    for _ in range(count * 5):
        e = [0] * len(names)
        for _ in range(draw.randint(1, degree)):
            e[draw.randrange(len(names))] += 1
        if even and any(k % 2 for k in e):
            continue
        out[tuple(e)] = num(draw, 4, (1, 1, 2))
        if len(out) == count:
            break
    return out


def spell(mono, names):
    return "*".join(f"{n}^{k}" if k > 1 else n for n, k in zip(names, mono) if k)


def potential_1(s, d):
    kind = d.random()
    if kind < 0.6:
        c = [0] + [num(d, 5, (1, 1, 2), True) for _ in range(d.choice((2, 3, 4)))]
        if not any(c):
            c = [0, 0, Fraction(1, 2)]
        s.potential = polynomial(c)
    else:
        roots = [num(d, 3, (1, 2), True) for _ in range(d.choice((1, 2, 3)))]
        roots += [r for r in roots if d.random() < 0.25]
        c = expand(roots)
        s.potential = polynomial([0] + [c[k] / (k + 1) for k in range(len(c))])
    s.coords = [("x", *domain(d, 0.5), False)]


def potential_2(s, d):
    kind = d.random()
    if kind < 0.25:
        m = monomials("xy", 4, d, d.randint(2, 4), True)
        s.potential = total([(c, spell(e, "xy")) for e, c in m.items()])
    elif kind < 0.5:
        m = monomials("xy", 3, d, d.randint(2, 4))
        s.potential = total([(c, spell(e, "xy")) for e, c in m.items()]) + d.choice(["", " + (x^2 + y^2)^2/4",
                " + x^4/4 + y^4/4"])
    elif kind < 0.7:
        s.potential = total([(abs(num(d, 2, (1, 2, 4))), "(x^2 + y^2)^2"), (num(d, 3, (1, 2), True), "x^2"),
                             (num(d, 3, (1, 2), True), "y^2"), (num(d, 2, (1, 2), True), "x*y"),
                             (num(d, 2, (1,), True) if d.random() < 0.5 else 0, "x")])
    elif kind < 0.85:
        a, b = d.choice(["1", "2", "y"]), abs(num(d, 2, (1, 2)))
        s.potential = f"(x^2 - {a})^2 + {b}*(y{term(num(d, 2, (1, 2)), '')})^2" + d.choice(["", " + x*y", " - x*y/2"])
    else:
        s.potential = total([(num(d, 3, (1, 2)), "x^2*y"), (num(d, 3, (1, 2)), "y^2"),
                             (num(d, 3, (1, 2), True), "x^2"), (num(d, 3, (1, 3), True), "y^3"),
                             (num(d, 3, (1,), True), "y")])
    s.coords = [("x", *domain(d, 0.2), False), ("y", *domain(d, 0.3), False)]


def potential_3(s, d):
    kind = d.random()
    if kind < 0.4:
        m = monomials("xyz", 2, d, d.randint(2, 4))
        s.potential = total([(c, spell(e, "xyz")) for e, c in m.items()]
                            + [(Fraction(1, 4), "(x^2 + y^2 + z^2)^2")] * (d.random() < 0.6))
    elif kind < 0.7:
        m = monomials("xyz", 3, d, d.randint(3, 4))
        s.potential = total([(c, spell(e, "xyz")) for e, c in m.items()]) + " + x^4 + y^4 + z^4"
    else:
        s.potential = total([(num(d, 3, (1, 2)), v + "^2") for v in "xyz"]
                            + [(num(d, 2, (1,)), d.choice(["x*y", "y*z", "x*y*z", "x^2*z"]))])
    s.coords = [(v, *domain(d, 0.12), False) for v in "xyz"]


def angles_1(s, d):
    a, b = num(d, 5, (1,)), num(d, 5, (1,))
    k = d.choice((2, 2, 3))
    forms = [total([(a, "cos(th)"), (b, f"cos({k}*th)")]), total([(a, "sin(th)"), (b, "cos(th)")]),
             total([(a, "cos(th)"), (b, "sin(th)^2")]), total([(a, f"cos({k}*th)")]),
             total([(a, "sin(th)"), (b, "sin(2*th)")]), "a*cos(th) + b*cos(2*th)", "a*sin(th) + b*cos(th)",
             "a*cos(th) + b*sin(th)^2", total([(a, "sin(th)")]), "a*cos(th) + b*cos(3*th)",
             total([(a, "cos(th)"), (b, "cos(th)^3")]), "-a*cos(th) - b*th"]
    s.potential = pick(s, forms)
    signs(s, d, s.potential)
    ends = angle_domain(d) if d.random() < 0.6 else (None, None)
    s.coords = [("th", *ends, ends == (None, None))]
    s.turn = True
    s.reach = 20


def angles_2(s, d):
    pieces = ["cos(a)", "cos(b)", "cos(a - b)", "sin(a)*sin(b)", "cos(a)*cos(b)", "sin(a)", "sin(b)^2*cos(a)",
              "cos(2*a - b)", "cos(2*a)", "sin(a)*cos(b)", "cos(a + b)", "cos(a)^2", "sin(b)^2"]
    pairs = [("cos(a)*cos(b)", "sin(a)*sin(b)"), ("sin(b)^2*cos(a)", "sin(a)*cos(b)"),
             ("cos(2*a - b)", "sin(a)*sin(b)"), ("sin(a)*cos(b)", "cos(a)*sin(b)"),
             ("cos(a - b)", "cos(a + b)"), ("cos(a)*cos(b)", "cos(a - b)"), ("sin(a)*sin(b)", "cos(a - b)"),
             ("sin(a)^2*cos(b)", "cos(b)^2"), ("cos(2*a)*cos(b)", "sin(a)"),
             ("cos(a)*cos(2*b)", "sin(b)"), ("cos(2*a + b)", "cos(a)*cos(b)"), ("sin(a)*sin(2*b)", "cos(b)"),
             ("cos(a)^2*cos(b)^2", "sin(a)*sin(b)"), ("cos(a - 2*b)", "cos(a)*cos(b)")]
    chosen = list(pick(s, pairs)) if d.random() < 0.6 else d.sample(pieces, d.choice((2, 2, 3)))
    if not any("b" in p for p in chosen) or not any("a" in p.replace("cos", "") for p in chosen):
        chosen.append("cos(a - b)")
    s.potential = total([(num(d, 4, (1,)), p) for p in chosen])
    s.coords = [(q, *(angle_domain(d) if d.random() < 0.12 else (None, None)), False) for q in "ab"]
    s.coords = [(q, lo, hi, lo is None and hi is None) for q, lo, hi, _ in s.coords]
    s.turn = True


def angles_3(s, d):
    pieces = ["cos(a)", "cos(b)", "cos(c)", "cos(a - b)", "cos(b - c)", "cos(a)*cos(b)", "sin(b)*sin(c)",
              "sin(a)", "cos(a)*cos(c)"]
    chosen = d.sample(pieces, 4)
    for q in "abc":
        if not any(q in p.replace("cos", "").replace("sin", "") for p in chosen):
            chosen.append(f"cos({q})")
    s.potential = total([(num(d, 4, (1,)), p) for p in chosen])
    s.coords = [(q, None, None, True) for q in "abc"]


def corners(s, d):
    c = abs(num(d, 3, (1, 2)))
    at = num(d, 2, (1, 2), True)
    kind = d.random()
    if kind < 0.6:
        s.potential = d.choice([total([(num(d, 3, (1, 2)), "x")]), total([(num(d, 3, (1, 2)), "x^2")]),
                                total([(num(d, 3, (1, 2)), "x"), (abs(num(d, 2, (1, 2))), "x^2")]), "x^4/4 - x",
                                "-x^2/2 + x^4/4", "cos(x)"])
        s.corners = [(str(c), f"x{term(-at, '')}" if at else "x")]
        if d.random() < 0.25:
            s.corners.append((str(abs(num(d, 2, (1, 2)))), "x - 3"))
        s.coords = [("x", *domain(d, 0.3), False)]
    else:
        s.potential = d.choice(["y^2 + x*y", "(x - 1)^2 + y^2", "y^4/4 - y^2/2 + x*y/2", "x/2 + y^2 - y",
                                "x^2 + y^2 - x*y - y", "y^2/2 - 3*x"])
        s.corners = [(str(c), "x")]
        s.coords = [("x", None, None, False), ("y", *domain(d, 0.3), False)]
    if d.random() < 0.3 and len(s.corners) == 1:
        s.params["a"] = sign(d)
        s.potential += " - a*x"
    s.reach = 20


def frictions(s, d):
    mu = d.choice(["1", "1/2", "2", "1/4"])
    forms = ["x^2/2", "x^2", "x^4/4 - x^2/2", "(x^2 - 1)^2", "-cos(x)", "x^2/2 - 3*x", "x", "2*x",
             "x^2/2 - x^3/3", "exp(-x^2)", "k*x^2/2", "a*x + x^2/2"]
    s.potential = pick(s, forms)
    s.coords = [("x", *domain(d, 0.35), False)]
    if "k" in s.potential:
        s.params["k"] = "> 0"
    if "a*x" in s.potential:
        s.params["a"] = sign(d)
    if d.random() < 0.25:
        mu = "mu"
        s.params["mu"] = "> 0"
    if d.random() < 0.25:
        s.coords.append(("y", None, None, False))
        s.potential += d.choice([" + y^2", " + y^4/4 - y^2/2", " + x*y + y^2"])
    if "cos" in s.potential and s.coords[0][1] is None and s.coords[0][2] is None:
        s.coords[0] = ("x", None, None, True)
    s.friction = {"x": mu}
    s.reach = 8


def dampings(s, d):
    d.choice([potential_1, potential_2, angles_1])(s, d)
    s.damping = {s.coords[0][0]: str(abs(num(d, 3, (1, 2))))}
    if len(s.coords) == 2:
        s.damping[s.coords[1][0]] = "1"


def parameters_1(s, d):
    forms = ["a*x^4/4 + b*x^2/2", "a*x^2/2 - b*x", "x^4/4 - a*x^2/2", "x^4/4 - a*x^2/2 - b*x^3",
             "a*x^3/3 - b*x", "(x^2 - a)^2", "(x - a)^2*(x + 1)^2", "a*x^3 + b*x", "x^2/2 - a*x",
             "a*exp(x) + b*exp(-x)", "x^2/2 - a*exp(-x^2)",
             "a/x + b*x", "a/x^2 - b/x", "x^4 - a*x", "a*cosh(x) - b*x", "a*abs(x) + x^2/2", "x^3/3 - a*x",
             "a*(exp(-2*x) - 2*exp(-x))", "a*x + b*x^3", "x^6/6 - a*x^2/2", "a*log(x) + x^2/2",
             "(1 - a*x)^2*x^2", "a*sqrt(1 + x^2) - b*x", "x^5/5 - a*x", "a*x^4/4 - x^3/3"]
    s.potential = pick(s, forms)
    signs(s, d, s.potential)
    s.coords = [("x", *(domain(d, 0.4, d.random() < 0.3, s.params) if d.random() < 0.7 else ("0", None)),
                 False)]


def parameters_2(s, d):
    forms = ["(x^2 + y^2)^2/4 - a*x^2/2 - b*y^2/2", "a*x^2*y + y^2/2 - b*y", "x^2/2 + y^2/2 - a*x*y",
             "(x^2 + y^2)^2/4 - a*(x^2 + y^2)/2 - x*y*b", "a*x^2/2 + b*y^2/2 - x", "(x^2 - a)^2 + (y - b*x)^2",
             "x^4/4 - a*x^2/2 + y^4/4 - b*y^2/2", "x^2*y - a*y + b*x^2", "(x*y - a)^2 + x^2",
             "a*(x^2 + y^2)/2 + x^2*y - y^3/3", "(x^2 + y^2 - a)^2", "(x^2 + y^2 - a)^2 + b*x",
             "x^2*y^2 - a*x*y", "x^2*y + a*y^2", "(x - y)^2 + a*x^4/4 - b*y"]
    s.potential = pick(s, forms)
    signs(s, d, s.potential)
    s.coords = [("x", *domain(d, 0.2), False), ("y", *domain(d, 0.3), False)]


def bowls(s, d):
    """Gravity in a bowl, along either axis: the potential as a scene states it."""
    g = pick(s, ["(0, -1)", "(-1, 0)", "(1, 0)", "(0, -2)", "(1, -1)"])
    gx, gy = (Fraction(v) for v in g[1:-1].split(","))
    bowl = pick(s, ["(x^2 + y^2)^2", "x^2 + y^4", "(x^2 + y^2 - 1)^2", "x^4 + y^4", "(x^2 + y^2)^2/4 - x^2/2",
                    "x^2 + 2*y^2 + x*y", "exp(x^2 + y^2)", "(x^2 + y^2)^3/6", "cosh(x) + y^2",
                    "(x^2 + 2*y^2)^2", "(x^2 + y^2)^2 - x*y", "sqrt(1 + x^2 + y^2)*2", "x^4 + x^2*y^2 + y^4",
                    "(x^2 + y^2)^(3/2)"])
    s.potential = f"{bowl} - ({gx})*x - ({gy})*y"
    s.coords = [("x", *domain(d, 0.1), False), ("y", *domain(d, 0.15), False)]
    s.statements = f"particle p mass 1 at (x, y)\ngravity {g}\npotential {bowl}"


def springs(s, d):
    kind = d.random()
    k, l = abs(num(d, 3, (1, 2))), d.choice(["1", "1/2", "2", "0"])
    if kind < 0.4:
        h = d.choice(["1", "2", "1/2"])
        s.coords = [("x", *domain(d, 0.2), False)]
        s.statements = f"particle p mass 1 at (x, 0)\nspring s between p, (0, {h}) stiffness {k} rest {l}"
        s.potential = f"{k}/2*(sqrt(x^2 + ({h})^2) - {l})^2"
        if d.random() < 0.5:
            s.statements += "\nspring r between p, (2, 0) stiffness 1 rest 0"
            s.potential += " + (x - 2)^2/2"
    elif kind < 0.6:
        s.coords = [("x", None, None, False)]
        s.params = {"h": "> 0", "l": "> 0"}
        s.statements = f"particle p mass 1 at (x, 0)\nspring s between p, (0, h) stiffness {k} rest l"
        s.potential = f"{k}/2*(sqrt(x^2 + h^2) - l)^2"
    elif kind < 0.8:
        s.coords = [("th", *(angle_domain(d) if d.random() < 0.4 else (None, None)), False)]
        s.coords = [("th", s.coords[0][1], s.coords[0][2], s.coords[0][1] is None and s.coords[0][2] is None)]
        R, g = d.choice(["1", "2"]), d.choice(["1", "3"])
        s.statements = (f"particle p mass 1 at (sin(th), -cos(th))\ngravity (0, -{g})\n"
                        f"spring s between p, (0, {R}) stiffness {k} rest 0")
        s.potential = f"-{g}*cos(th) + {k}/2*(sin(th)^2 + (-cos(th) - {R})^2)"
        s.turn, s.reach = True, 20
    else:
        s.coords = [("x", None, None, False), ("y", *domain(d, 0.2), False)]
        s.statements = ("particle p mass 1 at (x, y)\ngravity (0, -1)\n"
                        f"spring s between p, (-1, 0) stiffness {k} rest 0\n"
                        f"spring r between p, (1, 0) stiffness {k} rest 0")
        s.potential = f"y + {k}/2*((x + 1)^2 + y^2) + {k}/2*((x - 1)^2 + y^2)"


def wells(s, d):
    a, b = num(d, 4, (1, 2)), num(d, 3, (1, 2))
    one = ["exp(-x^2)", "-exp(-x^2)", f"{abs(a)}*tanh(x)^2", "exp(-2*x) - 2*exp(-x)",
           f"x^2/2{term(a, 'exp(-x^2)')}", f"exp(x){term(b, 'x')}", f"cosh(x){term(b, 'x')}", "x*exp(-x)",
           "x^2*exp(-x^2)", f"log(1 + x^2){term(b, 'x')}", f"tanh(x){term(-abs(b), 'x')}",
           "-1/cosh(x)^2", "exp(-x^2)*x", "x^2*exp(-x)", "(1 - exp(-x))^2", f"(1 - exp(-x))^2{term(b, 'x')}",
           "atan(x) - x/2", "x - exp(-x^2)*sin(x)/10", "log(x) - x", "x - log(x^2 + 1)"]
    two = ["exp(-x^2 - y^2)", "-exp(-x^2 - y^2) + x^2/8", "x*exp(-x^2 - y^2)",
           f"(x^2 + y^2)/2{term(a, 'exp(-x^2 - y^2)')}", "(1 - exp(-x))^2 + y^2*(1 + x^2)",
           "exp(x) + exp(-x)*y^2 - x", "tanh(x)^2 + y^2 - y", "(x^2 - y^2)*exp(-(x^2 + y^2)/2)"]
    if d.random() < 0.65:
        s.potential = pick(s, one)
        s.coords = [("x", *domain(d, 0.35), False)]
    else:
        s.potential = pick(s, two)
        s.coords = [("x", *domain(d, 0.15), False), ("y", *domain(d, 0.2), False)]


def poles(s, d):
    a = abs(num(d, 4, (1, 2)))
    one = ["1/x + x", f"{a}/x^2 - 1/x", "-1/x - x", "1/x^12 - 2/x^6", f"1/x + 1/({a} - x)", "-1/abs(x) + x^2/2",
           "1/(x - 1) - 1/(x + 1)", "1/sin(x)", "1/x^2 + x^2", f"{a}/(x^2 - 1)", "-1/(1 + x^2) + x/4",
           "x^2 + 1/x", "1/abs(x) + 1/abs(x - 1)", "a/x^2 + b*x^2", "a/x - b/x^2"]
    two = ["-1/sqrt((x - 1)^2 + y^2) - 1/sqrt((x + 1)^2 + y^2)", "1/sqrt(x^2 + y^2) + x^2 + 2*y^2",
           "1/(x^2 + y^2) + x", "-1/sqrt(x^2 + y^2) - x/4", "1/x + 1/y + x*y", "1/(x*y) + x + y",
           "1/x + x + y^2", "-1/(1 + x^2 + y^2) + x/8", "(x^2 + y^2)/2 + 1/sqrt((x - 1)^2 + y^2)"]
    if d.random() < 0.65:
        s.potential = pick(s, one)
        s.coords = [("x", *(domain(d, 0.3) if d.random() < 0.7 else ("0", None)), False)]
        signs(s, d, s.potential)
        if "sin" in s.potential:
            s.reach, s.turn = 20, True
            s.coords = [("x", *d.choice([("0", "pi"), ("0", "2*pi"), (None, None)]), False)]
            s.coords = [("x", s.coords[0][1], s.coords[0][2], s.coords[0][1] is None)]
    else:
        s.potential = pick(s, two)
        s.coords = [("x", None, None, False), ("y", None, None, False)]


def sets(s, d):
    """Curves and surfaces of rests beside isolated ones."""
    forms = ["(x^2 + y^2 - 1)^2", "(x*y - 1)^2", "x^2*y^2", "x^2*y", "(x - y)^2", "(x^2 - y)^2",
             "x^2*(y - 1)^2", "(x^2 + y^2 - 1)^2*x^2", "(x^2 - 1)^2*y^2", "x^2", "(x + y)^4",
             "(x^2 + y^2)^2 - 2*x^2", "x*y^2", "(x^2 - y^2)^2",
             "sin(x)^2*y^2", "(x^2 + y^2 - a)^2", "a*(x - y)^2", "(x*y - a)^2", "x^2*y - a*y", "(y - a*x)^2",
             "exp(x*y)", "(x^2 + 4*y^2 - 4)^2", "cos(x - y)", "cos(x)*cos(y)", "(x*y)^2 + x^2", "x^3",
             "(x - 1)^2*(y + 2)^3", "sqrt(x^2 + y^2) - x", "(sqrt(x^2 + y^2) - 1)^2", "(x - y)^4"]
    s.potential = pick(s, forms)
    if "a" in s.potential.replace("abs", ""):
        s.params["a"] = sign(d)
    q = [("x", *domain(d, 0.2), False), ("y", *domain(d, 0.2), False)]
    if "cos(" in s.potential:
        q = [(n, None, None, True) for n in "xy"]
    if "y" not in s.potential and d.random() < 0.6:
        q = q[:1]
    s.coords = q
    s.reach = 14


def chains(s, d):
    """Coupled bodies with parameters."""
    forms = [("k*(x - 1)^2/2 + k*(y - x - 1)^2/2 - f*y", "xy"), ("k*th^2/2 + a*cos(th)", "t"),
             ("a*cos(u) + b*cos(v) + c*(u - v)^2/2", "uv"),
             ("k*x^2/2 + k*(y - x)^2/2 + k*(z - y)^2/2 - g*(x + y + z)", "xyz"),
             ("x^4/4 - x^2/2 + y^4/4 - y^2/2 + c*x*y", "xy"),
             ("x^4/4 - x^2/2 + y^4/4 - y^2/2 + c*(x - y)^2/2", "xy"), ("k*(x^2 + y^2)/2 + g*y - f*x", "xy"),
             ("-a*cos(u) - b*cos(v)", "uv"), ("-a*cos(u) - b*cos(v - u)", "uv"),
             ("-2*g*cos(u) - g*cos(v)", "uv"), ("x^2*(a + y^2)/2 + y^2/2", "xy"),
             ("a*x*y + x^4/4 + y^4/4", "xy"), ("g*y + (x^2 + y^2 - 1)^2", "xy"),
             ("a*x*y*z + x^2 + y^2 + z^2", "xyz"), ("(x - y)^2/2 + (y - z)^2/2 + x^4/4 - a*x", "xyz"),
             ("1/(y - x) + k*x^2/2 + k*y^2/2", "xy"), ("g*y + k*(sqrt(x^2 + y^2) - 1)^2/2", "xy"),
             ("x^2*y^2 + a*(x^2 + y^2)/2", "xy"), ("a*cos(u)*cos(v) + b*sin(u)*sin(v)", "uv"),
             ("a*cos(u - v) + b*cos(u + v)", "uv"), ("a*cos(u - v) + cos(v)", "uv")]
    s.potential, q = pick(s, forms)
    signs(s, d, s.potential, positive="kg")
    names = ["th"] if q == "t" else list(q)
    s.coords = [(n, *(domain(d, 0.15) if q in ("xy", "xyz") else (None, None)),
                 q == "uv" and "(u - v)^2" not in s.potential) for n in names]
    s.reach = 14


def hoops(s, d):
    forms = ["-a*cos(th) - b*sin(th)^2", "a*cos(th) + b*cos(2*th)", "-a*cos(th) - b*sin(th)",
             "a*sin(th)^2 + b*sin(th)", "-a*cos(th) + b*(1 - cos(th))^2", "cos(th) - c*sin(th)", "a*cos(th)^2",
             "a*sin(th)*cos(th)", "-cos(th) - a*th", "cos(p*x)", "sin(p*x)", "cos(6*pi*x/L)",
             "x^2/2 + a*cos(x)", "cos(2*pi*x) + a*x"]
    s.potential = pick(s, forms)
    signs(s, d, s.potential, positive="pL")
    q = "x" if re.search(r"\bx\b", s.potential) else "th"
    if q == "x":
        ends = ("0", "L") if "L" in s.params else d.choice([("0", "5"), ("-2", "2"), (None, None),
                ("0", "2*pi")])
    else:
        ends = d.choice([("0", "2*pi"), ("0", "pi/2"), ("-pi/2", "pi/2"), (None, None), (None, None),
                         ("0", "pi")])
    s.coords = [(q, *ends, q == "th" and ends == (None, None))]
    s.turn = q == "th" and "a*th" not in s.potential
    s.reach = 10


LINE = ["x^2", "x^4/4 - x^2/2", "x^3/3 - x", "cos(x)", "exp(x) - 2*x", "x^2/2 - a*x", "x^4/4 - a*x^2/2",
        "(x^2 - 1)^2", "x^3", "a*x^2/2", "x^3/3 - a*x", "sin(2*x)", "tanh(x)^2", "x*exp(-x)", "x + 1/x",
        "x^6/6 - x^2/2", "x^2*exp(-x^2)", "sqrt(1 + x^2)", "x^2 + x^4", "log(1 + x^2)", "cos(pi*x)", "a*cos(x)",
        "(x - a)^2"]


def named(text, old, new):
    """A formula with another name in it."""
    return re.sub(rf"\b{old}\b", new, text)


def two_lines(s, d):
    """V = f(x) + g(y)."""
    f, g = pick(s, LINE), named(named(d.choice(LINE), "x", "y"), "a", "b")
    s.potential = f"{f} + {g}"
    signs(s, d, s.potential)
    waves = lambda t: any(w in t for w in WAVES)
    s.coords = [("x", *domain(d, 0.45 if not waves(f) else 0.7), False),
                ("y", *domain(d, 0.35 if not waves(g) else 0.7), False)]
    s.coords = [(q, lo, hi, lo is None and hi is None
                 and ("cos(x)" in t or "sin(2*x)" in t or "cos(y)" in t or "sin(2*y)" in t)) for (q, lo, hi,
                         _), t in zip(s.coords, (f, g))]
    s.turn = any(w in f + g for w in ("cos(x)", "cos(y)", "sin(2*"))
    s.reach = 8


def graphs(s, d):
    """V = c (y - h(x))^2/2 + f(x): rests where f' = 0, on the graph."""
    f = pick(s, LINE)
    h = d.choice(["x^2", "sin(x)", "exp(x)", "b*x", "x^3", "abs(b)*x", "1/x", "cos(x)", "x", "sqrt(x)",
                  "log(x)", "b + x", "x^2 - b", "tanh(x)"])
    s.potential = f"{d.choice(['1/2*', '', '2*', '3/2*'])}(y - ({h}))^2 + {f}"
    signs(s, d, s.potential)
    waves = any(w in f for w in WAVES)
    s.coords = [("x", *domain(d, 0.35 if not waves else 0.9), False), ("y", *domain(d, 0.35), False)]
    if waves and s.coords[0][1] is None and s.coords[0][2] is None:
        s.coords[0] = ("x", "-pi", "=pi", False)
    s.turn, s.reach = waves, 8


def factored(s, d):
    """V = f(x) g(y): rests where two of four vanish, and sets where f = f' = 0."""
    factors = ["(x^2 - 1)", "x", "x^2", "exp(x)", "(x - 1)^2", "cos(x)", "(x^2 + 1)", "(x^2 - a)", "sin(x)",
               "(x^3 - x)", "exp(-x^2)", "(x - a)", "(1 + x^2/2)", "(x^2 - 2*x)"]
    f, g = pick(s, factors), named(named(d.choice(factors), "x", "y"), "a", "b")
    s.potential = f"{f}*{g}" + d.choice(["", "", "", " + x^2", " + y^2/2", " - x*y"])
    signs(s, d, s.potential)
    s.coords = [("x", *domain(d, 0.25), False), ("y", *domain(d, 0.25), False)]
    if "+" not in s.potential[-8:] and "-" not in s.potential[-8:]:
        s.coords = [(q, lo, hi, lo is None and hi is None
                     and (f"cos({q})" in s.potential
                          or f"sin({q})" in s.potential)) for q, lo, hi, _ in s.coords]
    s.turn = True
    s.reach = 8


def wires(s, d):
    """A bead on a curve y = f(x), with weight and perhaps a spring."""
    f = pick(s, ["x^2/2", "x^4/4 - x^2/2", "cos(x)", "x^3/3 - x", "cosh(x)", "a*x^2", "sqrt(1 + x^2)",
                 "exp(-x^2)", "x^2*(x - 1)^2", "sin(x) + x/2", "a*x^4 - x^2", "-1/(1 + x^2)", "x^3",
                 "x - log(x)", "abs(x)^3"])
    g = d.choice(["1", "g", "981/100"])
    s.statements = f"particle bead mass 1 at (x, {f})\ngravity (0, -{g})"
    s.potential = f"{g}*({f})"
    if d.random() < 0.4:
        k = d.choice(["1", "k", "1/2"])
        s.statements += f"\npotential {k}*x^2/2"
        s.potential += f" + {k}*x^2/2"
    if g == "g":
        s.params["g"] = "> 0"
    if "k*" in s.potential:
        s.params["k"] = "> 0"
    signs(s, d, f)
    waves = "sin(" in f or "cos(" in f.replace("cosh(", "")
    s.coords = [("x", *(domain(d, 0.4) if not waves else angle_domain(d)), False)]
    s.turn = f == "cos(x)" and "x^2" not in s.potential
    s.reach = 8


def rotating(s, d):
    """Beads on turning hoops, arms and bowls: the potential in the turning frame."""
    R, W, g = d.choice(["R", "1", "2"]), d.choice(["Omega", "2", "1/2"]), d.choice(["g", "1", "981/100"])
    kind = pick(s, ["hoop", "bowl", "arm", "rod", "cone"])
    if kind == "hoop":
        s.statements = (f"particle b mass 1 at {R}*(sin(th)*cos({W}*t), sin(th)*sin({W}*t), -cos(th))\n"
                        f"gravity (0, 0, -{g})")
        s.potential = f"-{g}*{R}*cos(th) - ({R})^2*({W})^2*sin(th)^2/2"
        ends = angle_domain(d) if d.random() < 0.5 else (None, None)
        s.coords, s.turn = [("th", *ends, ends == (None, None))], True
    elif kind == "bowl":
        p = d.choice(["x^2", "x^4", "x^2 + x^4", "x^2/2", "sqrt(1 + x^2)"])
        s.statements = f"particle b mass 1 at (x*cos({W}*t), x*sin({W}*t), {p})\ngravity (0, 0, -{g})"
        s.potential = f"{g}*({p}) - ({W})^2*x^2/2"
        s.coords = [("x", *domain(d, 0.3), False)]
    elif kind == "arm":
        s.statements = f"particle b mass 1 at (x*cos({W}*t), x*sin({W}*t))\npotential k*(x - 1)^2/2"
        s.potential = f"k*(x - 1)^2/2 - ({W})^2*x^2/2"
        s.params["k"] = "> 0"
        s.coords = [("x", *(("0", None) if d.random() < 0.5 else domain(d, 0.3)), False)]
    elif kind == "rod":
        s.statements = f"particle b mass 1 at (({R} + sin(th))*cos({W}*t), ({R} + sin(th))*sin({W}*t), -cos(th))"
        s.potential = f"-({W})^2*({R} + sin(th))^2/2"
        ends = angle_domain(d) if d.random() < 0.5 else (None, None)
        s.coords, s.turn = [("th", *ends, ends == (None, None))], True
    else:
        s.statements = f"particle b mass 1 at (x*cos({W}*t), x*sin({W}*t), {R}*x)\ngravity (0, 0, -{g})"
        s.potential = f"{g}*{R}*x - ({W})^2*x^2/2"
        s.coords = [("x", *(("0", None) if d.random() < 0.5 else domain(d, 0.4)), False)]
    for n, t in (("R", R), ("Omega", W), ("g", g)):
        if n == t and n in s.potential:
            s.params[n] = "> 0"
    s.reach = 8


def rods(s, d):
    """A particle on a circle or an ellipse, in x and y with a constraint."""
    a, b = d.choice([("1", "1"), ("2", "2"), ("2", "1"), ("1", "3"), ("l", "l")])
    if "l" in (a, b):
        s.params["l"] = "> 0"
    g = d.choice(["(0, -1)", "(1, 0)", "(0, -g)", "(1, -1)"])
    gx, gy = g[1:-1].split(", ")
    if "g" in g:
        s.params["g"] = "> 0"
    extra = pick(s, ["", "x^2/2", "x*y", "y^2", "k*x^2/2", "(x - 1)^2", "x^2 - y^2", "-x^2"])
    if "k" in extra:
        s.params["k"] = sign(d)
    s.constraint = f"x^2/({a})^2 + y^2/({b})^2 - 1"
    s.curve = (f"({a})*cos(s)", f"({b})*sin(s)")
    law = f"x^2 + y^2 = ({a})^2" if a == b else f"x^2/({a})^2 + y^2/({b})^2 = 1"
    s.statements = f"particle p mass 1 at (x, y)\ngravity {g}\nconstraint rod: {law}" + (f"\npotential {extra}"
            if extra else "")
    s.potential = f"-({gx})*x - ({gy})*y" + (f" + {extra}" if extra else "")
    s.coords = [("x", *domain(d, 0.1), False), ("y", *domain(d, 0.2), False)]


def waves_beside(s, d):
    """A coordinate both in waves and beside them: its rests have no period."""
    wave = pick(s, ["sin(y)", "cos(y)", "sin(2*y)", "cos(y/2)", "sin(y)*cos(y)", "(cos(y) - 1/2)", "(sin(y)^2 - 1/4)",
                    "sin(pi*y)", "(sin(y) + cos(y))", "cos(y)*sin(y/2)"])
    a, b = num(d, 4, (1,)), num(d, 4, (1, 2))
    s.potential = d.choice([f"{a}*x*{wave} + {b}*y^2/2", f"{a}*x*{wave} + {b}*(y - pi)^2/2",
                            f"{a}*x*{wave} + {b}*y^3", f"k*x*{wave} + {b}*y^2/2", f"{a}*x*{wave} + {b}*y^2/2 + x^2*{wave}"])
    if "k" in s.potential:
        s.params = {"k": d.choice(["> 0", "< 0"])}
    ends = d.choice([(None, None)] * 4 + [("0", None), ("-2", "9")])
    s.coords = [("x", None, None, False), ("y", *ends, False)]
    s.reach = 10


KINDS = {
    "potential-1": potential_1, "potential-2": potential_2, "potential-3": potential_3, "angles-1": angles_1,
    "angles-2": angles_2, "angles-3": angles_3, "corners": corners, "frictions": frictions,
    "dampings": dampings,
    "parameters-1": parameters_1, "parameters-2": parameters_2, "bowls": bowls, "springs": springs,
    "wells": wells,
    "poles": poles, "hoops": hoops, "sets": sets, "chains": chains, "two-lines": two_lines, "graphs": graphs,
    "factored": factored, "wires": wires, "waves-beside": waves_beside, "rotating": rotating, "rods": rods,
}
