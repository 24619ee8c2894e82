"""equations.py -- equations in one unknown, for `solve`, by kinds."""
from fractions import Fraction

from formula import names, read
from scene import WAVES, angle_domain, domain, expand, num, pick, polynomial, shifted, sign, signs, total


def polynomial_numbers(s, d):
    kind = d.random()
    if kind < 0.35:
        roots = [num(d, 4, (1, 1, 2, 3), True) for _ in range(d.randint(1, 3))]
        roots += [d.choice(roots) for _ in range(d.randint(0, 2))]
        s.lhs = polynomial(expand(roots)) if d.random() < 0.5 else "*".join(shifted("x", r) for r in roots)
    elif kind < 0.7:
        c = [num(d, 5, (1, 1, 2), True) for _ in range(d.choice((3, 3, 4, 5)))]
        c[-1] = c[-1] or Fraction(1)
        s.lhs = polynomial(c)
    elif kind < 0.85:
        s.lhs = polynomial([num(d, 6, (1,), True), 0, num(d, 6, (1,)), 0, num(d, 2, (1,))])
    else:
        p, q = ([num(d, 4, (1,)), num(d, 3, (1,), True), last] for last in (num(d, 2, (1,)), 1))
        s.lhs = f"({polynomial(p)})*({polynomial(q)})"
    s.coords = [("x", *domain(d, 0.55), False)]


def polynomial_parameters(s, d):
    a, b = sign(d), sign(d)
    k = num(d, 4, (1, 2))
    forms = [("x^2", "a"), ("a*x", "b"), ("x^2 + a*x + b", "0"), ("a*x^2 + b*x", "0"), ("x^3", "a"),
             ("x^4", "a"), ("(x - a)*(x - b)", "0"),
             ("x^3 - a*x", "0"), ("a*x^3 + b*x", "0"), ("x^2 - 2*a*x + b", "0"), ("x^4 - a*x^2", "0"),
             ("x^2", "a^2"), ("(x - a)^2", "b"),
             ("x^2 + a^2", "0"), ("x^2 - a^2 - 1", "0"), ("a*x^2", "b"), ("x^4 + a*x^2 + b", "0"), ("x^5", "a"),
             ("x^6", "a^2"), ("(x - a)^3", f"{k}"),
             ("x^2 + 2*x + a", "0"), ("a*x + b*x^3", "0"), ("x*(x^2 - a)*(x - b)", "0"),
             ("(x^2 - a)*(x^2 - b)", "0"), ("x^3 - a*x^2 - x + a", "0"),
             ("x^3 - a^3", "0"), ("a*x^4 - b*x^2", "0"), ("x^2 + a*b*x", "0"), (f"x^2 - {abs(k)}*x*a", "0")]
    s.lhs, s.rhs = pick(s, forms)
    s.params = {"a": a}
    if "b" in s.lhs + s.rhs:
        s.params["b"] = b
    s.coords = [("x", *domain(d, 0.45, d.random() < 0.3, s.params), False)]


def trigonometric(s, d):
    k = d.choice((1, 1, 1, 2, 3))
    c = d.choice(["0", "1/2", "-1/2", "sqrt(2)/2", "-sqrt(3)/2", "1", "-1", "1/3", "-2/3", "3/2", "sqrt(3)/2"])
    arg = "x" if k == 1 else f"{k}*x"
    if d.random() < 0.2:
        arg = f"{arg} + {d.choice(['pi/3', 'pi/4', '1', '1/2'])}"
    a, b = num(d, 4, (1,)), num(d, 4, (1,))
    forms = [(f"sin({arg})", c), (f"cos({arg})", c),
             (f"tan({arg})", d.choice(["1", "0", "-sqrt(3)", "2", "-1/2"])),
             (total([(a, f"sin({arg})"), (b, f"cos({arg})")]), d.choice(["0", "0", "1", "2"])),
             ("sin(x)^2", d.choice(["3/4", "1/2", "1/4", "1/3", "1"])),
             ("cos(x) + cos(2*x)", "0"), ("sin(2*x)", "sin(x)"), ("sin(2*x)", "cos(x)"),
             ("2*cos(x)^2 + 3*cos(x) + 1", "0"), ("sin(x)*(2*cos(x) - 1)", "0"),
             ("sin(3*x)", "sin(x)"), ("cos(x)^2 - sin(x)", "1/4"), ("tan(x)^2", "3"),
             ("sin(x) + cos(2*x)", d.choice(["0", "1"])), ("cos(x)^3 - cos(x)", "0"),
             ("sin(x)*cos(x)", d.choice(["1/4", "1/2", "1/5"])), ("sin(x)^2 + a*sin(x)", "0"),
             (f"a*sin({arg})", "b"), ("a*sin(x) + b*cos(x)", "0"), ("cos(x)", "a"),
             ("sin(x)", "a"), ("tan(x)", "a"), ("sin(x)*(cos(x) - a)", "0"), ("cos(x)^2", "a"),
             ("sin(2*x) - a*sin(x)", "0"), ("cos(2*x)", "a*cos(x)"),
             (f"{abs(a)}*sin(x)^2 - cos(x)", "1"), ("1 - cos(x)", "0"), ("sin(x) - 1", "0"),
             ("sin(x)/(1 + cos(x))", "1"), ("(1 - cos(x))/sin(x)", d.choice(["0", "1"]))]
    s.lhs, s.rhs = pick(s, forms)
    signs(s, d, s.lhs, s.rhs)
    s.turn = True
    s.coords = [("x", *(angle_domain(d) if d.random() < 0.65 else (None, None)), False)]
    s.reach = 14


def families(s, d):
    n = d.choice(("2", "3", "4", "6"))
    c = d.choice(["0", "0", "1/2", "-1", "1", "-sqrt(2)/2"])
    forms = [("cos(pi*x)", c, None), ("sin(pi*x)", c, None), ("sin(p*x)", c, "p"), ("cos(p*x)", "0", "p"),
             (f"cos({n}*pi*x/L)", c, "L"), (f"sin({n}*pi*x/L)", "0", "L"),
             ("sin(x/2)", c, None), ("cos(2*x/3)", c, None), ("tan(pi*x)", d.choice(["0", "1"]), None),
             (f"sin({n}*pi*x)", c, None), ("sin(p*x)*cos(p*x)", "0", "p"),
             ("cos(pi*x)^2", "1/2", None), ("sin(pi*x) + cos(pi*x)", "0", None), ("sin(p*x)^2", "1", "p"),
             ("cos(sqrt(2)*x)", c, None), ("sin(x^2)", "0", None),
             ("cos(pi*x)*(x - 1/3)", "0", None), ("sin(pi*x/L)*cos(pi*x/L)", "0", "L"),
             ("2*cos(pi*x/2)", "1", None), ("sin(p*x + 1)", "0", "p"), ("cos(exp(x))", "0", None),
             ("1 - cos(2*pi*x)", "0", None)]
    s.lhs, s.rhs, name = pick(s, forms)
    if name == "p":
        s.params["p"] = d.choice(["> 0", "> 0", ""])
    if name == "L":
        s.params["L"] = "> 0"
    choice = d.random()
    if name == "L" and choice < 0.7:
        ends = d.choice([("0", "L"), ("0", "L"), ("-L", "L"), ("0", "L/2")])
    elif choice < 0.7:
        ends = d.choice([("0", "5"), ("0", "3"), ("-2", "2"), ("0", "2*pi"), ("1", "sqrt(10)"), ("-1/2", "5/2"),
                         ("0", "1"), ("-pi", "pi")])
    elif choice < 0.8:
        ends = d.choice([("0", None), ("10", None), (None, "-1")])
    else:
        ends = (None, None)
    s.coords = [("x", *ends, False)]
    s.reach = 12


def exponentials(s, d):
    k, c = d.choice((1, 2, 3)), d.choice(["1", "2", "1/2", "3", "-1", "5"])
    forms = [(f"exp({k}*x)", c), ("exp(-x)", "a"), ("log(x)", "a"), ("log(x^2 - 1)", "0"),
             ("exp(x) - a*exp(-x)", "0"), ("cosh(x)", "a"), ("sinh(x)", "a"), ("tanh(x)", "a"),
             ("exp(2*x) - 3*exp(x) + 2", "0"), ("log(x) + log(x - 1)", "log(2)"), ("x*exp(x)", "0"),
             ("exp(-x^2)", "a"), ("log(x)^2", "a"), ("exp(2*x) - a*exp(x)", "0"),
             ("exp(x) + exp(-x)", c), ("cosh(x)", c), ("tanh(x)", d.choice(["1/2", "-1/3", "2"])),
             ("log(x + a)", "0"), ("log(x)", "log(a)"), ("exp(x)*(x^2 - 2)", "0"),
             ("a*exp(x) + b*exp(-x)", "0"), ("log(abs(x))", "a"), ("log(x^2)", "a"),
             ("(1 - exp(-x))*exp(-x)", "0"), ("exp(-2*x) - exp(-x)", "-2/9"), ("a*tanh(x) + b*x", "0"),
             ("tanh(x)^2", "a"), ("sinh(x)*(cosh(x) - 2)", "0"), ("sinh(2*x)", "a*sinh(x)"), ("exp(x)", "a*b"),
             ("x*log(x)", "0"), ("log(x) - log(a - x)", "0"),
             ("exp(a*x)", "b"), ("2^x", "8"), ("2^x", "a"), ("exp(x) - 1", "0"), ("cosh(x) - 1", "0"),
             ("x*exp(-x^2/2)*(x^2 - a)", "0"), ("log(x)/x", "0")]
    s.lhs, s.rhs = pick(s, forms)
    signs(s, d, s.lhs, s.rhs)
    s.coords = [("x", *domain(d, 0.4, d.random() < 0.2, s.params), False)]


def magnitudes(s, d):
    c, e = num(d, 4, (1, 2)), abs(num(d, 4, (1, 2)))
    forms = [("abs(x)", "a"), ("abs(x - a)", "b"), ("abs(x)", "x"), ("sqrt(x^2)", "x"), ("sign(x)", "1"),
             ("sign(x)", "a"), ("max(x, 1)", "2"), ("max(x, 1)", "1"), ("min(x, a)", "1"),
             ("abs(x) + abs(x - 1)", d.choice(["1", "2", "3", "1/2", "a"])), ("x*abs(x)", "a"),
             ("abs(x^2 - 1)", d.choice(["a", "1/2", "1", "3", "0"])), ("abs(x - 1)", "abs(x + 2)"),
             ("abs(x)", "-x"), ("abs(x) - x", "2"), ("abs(x) - 2*x", f"{c}"), ("max(x, -x)", "3"),
             ("max(x, 0)", "a"), ("min(x, 0)", "-2"), ("abs(x)*x - x", "0"), ("sign(x)*x", "a"),
             ("sign(x - 1) + x", "0"), ("abs(abs(x) - 2)", "1"), ("x/abs(x)", "1"), ("x/abs(x)", "x"),
             ("sqrt((x - 1)^2)", "x"), (f"abs(x - 1) + {e}*x", f"{c}"), ("max(x, x^2)", "2"),
             ("max(x^2, 1)", "1"), ("min(x^2, 4)", "4"), ("abs(sin(x))", "1/2"), ("abs(x)^3", "a"),
             ("abs(a*x)", "b"), ("sign(x)", "0"), ("x*sign(x - 1)", "0"),
             ("abs(x - a) - abs(x + a)", "0"), ("max(x, a)", "b"), ("x + abs(x - 1)", "1"),
             ("if(x < 1, x, 2 - x)", "1/2"), ("if(x < 0, x + 1, x - 1)", "0"), ("abs(x)^(1/2)", "a"),
             ("exp(-abs(x))", "1/2")]
    s.lhs, s.rhs = pick(s, forms)
    signs(s, d, s.lhs, s.rhs)
    s.turn = "sin(x)" in s.lhs
    s.coords = [("x", *domain(d, 0.35), False)]


def powers(s, d):
    c = d.choice(["2", "-8", "4", "-2", "27", "1/8"])
    forms = [("x^3", "a"), ("x^(2/3)", "a"), ("x^(1/3)", "a"), ("sqrt(x)", "a"), ("sqrt(x + 1)", "x - 1"),
             ("sqrt(x) + sqrt(x - 1)", d.choice(["2", "3/2", "1/2"])), ("x^(3/2)", "a"),
             ("x^(-1/2)", "a"), ("sqrt(a - x^2)", "x"), ("x^3", c), ("x^5", "a"), ("sqrt(x^2 + 1)", "a"),
             ("sqrt(1 - x^2)", "a"), ("x^(2/3)", c), ("x^(1/3)", c), ("x^-3", "a"), ("x^-2", "a"),
             ("x^(4/3)", "a"), ("sqrt(x + a)", "b"), ("sqrt(x)", "x"), ("sqrt(x)", "a*x"),
             ("x - 3*sqrt(x) + 2", "0"), ("x^(5/2) - x^(1/2)", "0"), ("sqrt(x + 3) - sqrt(x)", "1"),
             ("sqrt(2*x + 1)", f"x + {d.choice(['1', '1/2', 'a'])}"),
             ("x/sqrt(1 + x^2)", "a"), ("x/sqrt(1 - x^2)", "a"), ("1/sqrt(x^2 + a^2)", "b"),
             ("x^3 - a^2*x", "0"), ("a*x^3", "b"), ("(x - a)^(1/3)", "b"), ("(x - 1)^3", "a"), ("x^4", "a^4"),
             ("sqrt(x^2 - a^2)", "1"),
             ("x*(1 - 1/sqrt(x^2 + 1))", "a"), ("x*(1 - 2/sqrt(x^2 + 1))", "0"), ("x^3 + a", "0"),
             ("x^2*abs(x)", "a")]
    s.lhs, s.rhs = pick(s, forms)
    signs(s, d, s.lhs, s.rhs)
    s.coords = [("x", *domain(d, 0.35), False)]


def rationals(s, d):
    c = num(d, 4, (1, 2))
    forms = [("1/x", "a"), ("(x^2 - 1)/(x - 1)", "0"), ("x/(x^2 + 1)", d.choice(["a", "1/4", "1/2", "1"])),
             ("1/(x - a) + 1/(x + a)", "0"), ("(x^2 - a^2)/(x - a)", "0"), ("(x - a)/(x - b)", "0"),
             ("1/x + x", f"{c}"), ("a/x^2 - b/x", "0"), ("-1/x^2 + a/x^3", "0"), ("1/x^2 - 1/(1 - x)^2", "0"),
             ("x^2/(x - 1)", f"{c}"), ("1/(1 + x^2) - a", "0"), ("(x^2 - 3*x + 2)/(x^2 - 4)", "0"),
             ("a/x - x", "0"), ("12*(1/x^13 - 1/x^7)", "0"), ("a*x/(1 + x^2)", "b*x"), ("1/x", "1/a"),
             ("(x - 1)/(x + 1)", "a"), ("1/x^3", "a"), ("x + a/x^3", "0"), ("1/(x - 1)^2 - 4/(x + 1)^2", "0"),
             ("k*x - q/x^2", "0"), ("x/(x - a)", "b"), ("x^3/(x^2 - a)", "0"), ("(x^3 - x)/x", "0"),
             ("1/x - 1/(x + a)", "b")]
    s.lhs, s.rhs = pick(s, forms)
    signs(s, d, s.lhs, s.rhs)
    s.coords = [("x", *domain(d, 0.45, d.random() < 0.25, s.params), False)]


def inverses(s, d):
    c = d.choice(["pi/4", "1", "-pi/3", "2", "1/2"])
    forms = [("atan(x)", "a"), ("asin(x)", "a"), ("acos(x)", "a"), ("atan(a*x)", "pi/4"), ("asin(x)^2", "1/4"),
             ("atan(x)", c), ("asin(x)", c), ("acos(x)", c), ("atan(x)^2", "a"), ("asinh(x)", "a"),
             ("acosh(x)", "a"), ("atanh(x)", "a"), ("atan(x) - atan(1/x)", "0"), ("sin(asin(x))", "a"),
             ("acos(2*x - 1)", "a"), ("atan(x - a)", "b"), ("tan(atan(x))", "a"), ("asin(x)", "acos(x)"),
             ("x*atan(x)", "0"), ("asin(a*x)", "b")]
    s.lhs, s.rhs = pick(s, forms)
    signs(s, d, s.lhs, s.rhs)
    s.coords = [("x", *domain(d, 0.35), False)]


def parameter_domains(s, d):
    """A root that is a parameter, in a domain; ends that are parameters."""
    a = sign(d)
    roots = ["a", "2*a", "a + 1", "-a", "a^2", "atan(a)", "log(a)", "asin(a)", "sqrt(a)", "1/a", "exp(a)",
             "a - 1/2", "pi*a", "pi - atan(c)", "tanh(a)", "1 - a^2"]
    root = d.choice(roots)
    forms = [("x", root), (f"x - ({root})", "0"), (f"(x - ({root}))*(x - 1/2)", "0"),
             (f"(x - ({root}))*(x + 3/4)", "0"), (f"x*(x - ({root}))", "0")]
    s.lhs, s.rhs = pick(s, forms)
    if root == "atan(a)" and d.random() < 0.5:
        s.lhs, s.rhs, s.turn = "sin(x) - a*cos(x)", "0", True
    if root == "log(a)" and d.random() < 0.5:
        s.lhs, s.rhs = "exp(x)", "a"
    if root == "asin(a)" and d.random() < 0.5:
        s.lhs, s.rhs, s.turn = "sin(x)", "a", True
    if root == "sqrt(a)" and d.random() < 0.5:
        s.lhs, s.rhs = "x^2", "a"
    if root == "exp(a)" and d.random() < 0.5:
        s.lhs, s.rhs = "log(x)", "a"
    if root == "pi - atan(c)" and d.random() < 0.7:
        s.lhs, s.rhs, s.turn = "sin(x) + c*cos(x)", "0", True
    s.params = {"c" if "c" in root.replace("acos", "") and "pi" in root else "a": a}
    ends = d.choice([("0", "1"), ("-1", "1"), ("0", "pi/2"), ("0", None), (None, "1"), ("1", None), ("0", "L"),
                     ("-L", "L"), ("L", None), ("0", "2*pi"), ("-sqrt(2)", "sqrt(2)"), ("1", "3"),
                     ("l", "l + 1"), ("-pi/2", "pi/2")])
    for n in ("L", "l"):
        if any(e and n in e.replace("pi", "") for e in ends):
            s.params[n] = "> 0" if n == "L" else ""
    s.coords = [("x", *ends, False)]


def mixed(s, d):
    """Two unlike terms: nothing exact, or exact by chance."""
    atoms = ["x", "x^2", "x^3", "sin(x)", "cos(x)", "exp(x)", "exp(-x)", "log(x)", "sqrt(x)", "tanh(x)",
             "atan(x)", "1/x", "abs(x)", "exp(-x^2)", "cosh(x)", "tan(x)", "x^4", "sin(2*x)", "x*exp(x)",
             "1/(1 + x^2)", "cos(pi*x)"]
    a, b = d.sample(atoms, 2)
    s.lhs = total([(num(d, 3, (1, 2)), a), (num(d, 3, (1, 2)), b)])
    s.rhs = d.choice(["0", "0", "1", "2", "-1/2", "3"])
    if d.random() < 0.25:
        s.rhs, s.params = "c", {"c": sign(d)}
    if d.random() < 0.2:
        s.lhs, s.rhs = f"({s.lhs})*(x - {abs(num(d, 3, (1, 2)))})", "0"
    s.coords = [("x", *domain(d, 0.6), False)]
    s.reach = 12


NEAR = {"pi": ["355/113", "22/7", "31415926535897932/10000000000000000", "31415926535897933/10000000000000000",
               "3141592653589793238462643383279502884198/1000000000000000000000000000000000000000", "pi", "3"],
        "sqrt(2)": ["14142135623730950/10000000000000000", "14142135623730951/10000000000000000",
                    "1414213562373095048801688724209699/1000000000000000000000000000000000", "sqrt(2)", "3/2",
                    "2^(1/2)"],
        "exp(1)": ["2718281828459045/1000000000000000", "27182818284590453/10000000000000000", "exp(1)", "5/2"],
        "1": ["1", "999999999999999999/1000000000000000000", "1000000000000000001/1000000000000000000",
              "sin(pi/2)", "1/2"],
        "pi/2": ["157079632679489661/100000000000000000", "157079632679489662/100000000000000000", "pi/2",
                 "asin(1)", "3/2"], "sqrt(3)/2": ["866025403784438646/1000000000000000000",
                         "866025403784438647/1000000000000000000", "sin(pi/3)", "cos(pi/6)", "1/2"],
        "log(2)": ["693147180559945309/1000000000000000000", "693147180559945310/1000000000000000000", "log(2)",
                   "asinh(3/4)", "1/3"]}


def ends_of_domains(s, d):
    """Roots at an end, or beyond it by less than a double shows."""
    end = pick(s, list(NEAR))
    roots = d.sample(NEAR[end], 2)
    s.hints = roots
    s.lhs = "*".join(f"(x - {r if r.isalnum() else '(' + r + ')'})" for r in roots)
    if d.random() < 0.3:
        s.lhs += "*x"
    s.coords = [("x", *d.choice([("-1", end), ("1/4", end), (end, "5"), (end, None), (None, end)]), False)]


def nested(s, d):
    """f(g(x)) = c."""
    outer = ["sin({})", "cos({})", "exp({})", "log({})", "sqrt({})", "abs({})", "({})^2", "({})^3", "1/({})",
             "tanh({})", "atan({})", "({})^(2/3)", "max({}, 0)", "min({}, 1)", "cosh({})", "({})^(1/3)",
             "asin({})", "tan({})", "({})^4", "sign({})", "({})^(-1/2)", "({})^(3/2)"]
    inner = ["x^2", "2*x + 1", "x - a", "a*x", "sin(x)", "cos(x)", "exp(x)", "abs(x)", "x^2 - 1", "1/x",
             "log(x)", "sqrt(x)", "x^3", "x^2 - a", "1 - x^2", "tanh(x)", "abs(x) - 1", "cos(2*x)", "x/2",
             "x^2 + x", "x/(1 + x)", "pi*x", "3 - x", "sqrt(1 - x^2)", "exp(-x)", "abs(x - 1)", "a - cos(x)",
             "1 + sin(x)"]
    values = ["0", "1", "1/2", "-1/2", "2", "-1", "1/3", "sqrt(2)/2", "b", "b", "-sqrt(3)/2", "pi/6", "3"]
    s.lhs = pick(s, outer).format(d.choice(inner))
    s.rhs = d.choice(values)
    if d.random() < 0.25:
        s.lhs = f"{num(d, 3, (1, 2))}*{s.lhs}" if s.lhs[0] != "-" else s.lhs
    signs(s, d, s.lhs, s.rhs)
    s.turn = any(w in s.lhs for w in ("sin(x)", "cos(x)", "cos(2*x)"))
    s.coords = [("x", *(angle_domain(d) if s.turn and d.random() < 0.5 else domain(d, 0.5)), False)]
    s.reach = 7 if any(w in s.lhs for w in WAVES) else 40


def products(s, d):
    """Factors that vanish, or have no value, at each other's zeros."""
    pieces = ["x", "(x + 1)", "(x - 1)", "sqrt(x)", "log(x)", "sqrt(1 - x^2)", "sin(x)", "cos(x)", "(x^2 - 2)",
              "sqrt(x + 2)", "(exp(x) - 1)", "abs(x - 1)", "(x - a)", "(x + a)", "(x^2 - a)", "sqrt(x - 1)",
              "tan(x)", "(1 - cos(x))", "x^(1/3)", "sign(x)", "log(x + 1)", "(x^2 + 1)", "asin(x)", "tanh(x)",
              "cos(pi*x)", "(x - pi)", "(abs(x) - 2)", "max(x, 0)", "acos(x)"]
    a = pick(s, pieces)
    b, c = d.sample([p for p in pieces if p != a and p != "tan(x)"], 2)
    form = d.random()
    s.lhs = f"{a}*{b}" if form < 0.4 else f"{a}/{b}" if form < 0.75 else f"{a}*{b}/{c}"
    signs(s, d, s.lhs)
    s.turn = any(w in s.lhs for w in ("sin(x)", "cos(x)", "tan(x)")) and s.lhs.count("x") == 1
    s.coords = [("x", *domain(d, 0.5), False)]
    s.reach = 7 if any(w in s.lhs.replace("asin(", "(").replace("acos(", "(") for w in WAVES) else 40


def in_function(s, d):
    """A polynomial in one function of x."""
    f = pick(s, ["sin(x)", "cos(x)", "exp(x)", "tanh(x)", "sqrt(x)", "abs(x)", "x^2", "log(x)", "1/x", "tan(x)",
                 "cosh(x)", "exp(-x)", "x^3", "sin(2*x)", "cos(x/2)", "atan(x)", "cos(pi*x)", "x^(1/3)",
                 "(x + 1/x)", "exp(x^2)", "sinh(x)", "x^4", "log(x)/2", "sin(x)^2", "sqrt(x^2 + 1)"])
    kind = d.random()
    if kind < 0.5:
        roots = [num(d, 3, (1, 2, 2, 3), True) / d.choice((1, 1, 2)) for _ in range(d.choice((1, 2, 2, 3)))]
        s.lhs = polynomial(expand(roots), f if "^" not in f and "/" not in f else f"({f})")
    elif kind < 0.75:
        c = [num(d, 3, (1, 2), True), num(d, 3, (1, 2), True), num(d, 2, (1,))]
        s.lhs = polynomial(c, f if "^" not in f and "/" not in f else f"({f})")
    else:
        s.lhs = d.choice([f"({f})^2 - a*({f})", f"({f})^2 - a", f"({f} - a)*({f} - 1/2)",
                          f"({f})^2 + ({f}) - a", f"a*({f})^2 - b", f"({f})^3 - a*({f})",
                          f"({f} - a)*({f} - b)", f"({f})^2 - a^2"])
        signs(s, d, s.lhs)
    s.turn = any(w in f for w in ("sin(x)", "cos(x)", "tan(x)", "sin(2*x)"))
    s.coords = [("x", *(angle_domain(d) if s.turn and d.random() < 0.6 else domain(d, 0.5)), False)]
    s.reach = 9 if any(w in f for w in WAVES) else 40


def assumptions(s, d):
    """Parameters with relations between them, ends that are parameters."""
    s.params = {"a": d.choice(["", "> 0"]), "b": d.choice(["", "> 0"])}
    s.assume = [pick(s, ["a > b", "a > 2*b", "a + b > 0", "a^2 > b^2", "a > 1", "b < 1", "a*b > 0",
                         "a > b + 1"])]
    root = d.choice(["a", "b", "(a + b)/2", "a/2", "2*b", "a - b", "a + b", "b/2", "sqrt(a^2 + b^2)", "-b",
                     "a*b"])
    other = d.choice(["a", "b", "0", "1", "a + 1"])
    s.lhs = d.choice([f"x - ({root})", f"(x - ({root}))*(x - ({other}))", f"(x - ({root}))*(x - ({other}))*x",
                      f"x^2 - ({root})", f"exp(x) - ({root})", f"abs(x) - ({root})", f"sin(x) - ({root})"])
    if s.assume[0].startswith("a > b") and d.random() < 0.7 or s.assume[0] == "a > 2*b" and s.params["b"] == "> 0":
        ends = d.choice([("b", "a"), ("b", None), (None, "a"), ("0", "a"), ("b", "a + b")])
    else:
        ends = d.choice([("0", None), (None, None), ("-1", "1"), ("a", None), (None, "b"), ("0", "pi")])
    s.turn = "sin(x)" in s.lhs
    s.coords = [("x", *ends, False)]
    s.reach = 7 if s.turn else 40


def as_written(s, d):
    """What simplifies away, but must be defined."""
    u = pick(s, ["x", "x - 1", "2*x + 1", "x^2 - 1", "x - a", "1 - x", "x/2", "x + a"])
    form = d.choice(["sin(asin({u}))", "cos(acos({u}))", "tan(atan({u}))", "exp(log({u}))", "sqrt({u})^2", "cosh(acosh({u}))",
                     "sinh(asinh({u}))", "tanh(atanh({u}))", "(({u})^(1/3))^3", "({u})/({u})^(1/3)", "({u})^2/({u})",
                     "({u})*(x - 2)/({u})", "sqrt({u})*sqrt({u})", "log({u}) - log({u}) + x", "tan({u})*cos({u})",
                     "({u})^(3/2)/sqrt({u})", "exp(2*log({u}))", "x + 1/({u}) - 1/({u})", "x*log({u})/log({u})",
                     "asin({u}) + acos({u}) + x", "x^2*({u})^(1/2)/({u})^(1/2)", "({u})^(-2)*({u})^3"]).format(u=u)
    s.lhs = form
    s.rhs = d.choice(["0", "1", "1/2", "2", "-1", "b", "b", "x", "x^2", "3"])
    if d.random() < 0.25:
        s.lhs = f"({form})*(x - {d.choice(['3', '1/2', 'b'])})"
    signs(s, d, s.lhs, s.rhs)
    waves = "tan(" in form and "atan(" not in form
    s.turn = waves and u in ("x", "x - 1", "1 - x", "x - a", "x + a") and s.rhs not in ("x", "x^2") and "*(x" not in s.lhs
    s.coords = [("x", *domain(d, 0.3), False)]
    s.reach = 7 if waves else 40


def without_formula(s, d):
    """Numbers only, and no formula: all zeros on the line, or an error that asks for a range."""
    p, q = num(d, 6, (1, 1, 2)), num(d, 6, (1, 2))
    k, m = d.choice((1, 2, 3, 5, 10)), d.choice((2, 3, 4, 5, 6, 10))
    forms = [(f"x^3 + {p}*x", f"{q}"), (f"x^5 + {p}*x^2", f"{q}"), (f"x^4 + {p}*x + {q}", "0"), ("exp(x)", f"x^{m}"),
             (f"{k}*exp(-x)", f"x + {p}"), ("x", f"cos({k}*x)"), (f"log(x)", f"x/{m} + {p}"), ("2^x", f"{p}*x + {q}"),
             ("sinh(x)", f"{p}*x + {q}"), ("cosh(x)", f"{p}*x^2 + {q}"), ("x^2*exp(-x)", f"1/{m}"), ("sqrt(x)", f"cos({k}*x)"),
             (f"tanh({k}*x)", f"x/{m}"), ("sin(x)", f"x/{m}"), ("abs(x)", f"{k}*cos(x)"), ("x*exp(x)", f"{p}"),
             (f"exp(-x^2)", f"x/{m} + {p}/10"), (f"atan({k}*x)", f"x/{m}"), ("x*log(x)", f"{p}"), (f"x + sin({k}*x)", f"{q}"),
             ("x^(1/3)", f"x^2 + {p}"), ("exp(x/10)", f"x^2 + {p}"), (f"x^3*exp(-x/{m})", f"{abs(q)}/10"),
             ("sin(x)^3 - sin(x)", f"{p}/20"), ("exp(x) - exp(-2*x)", f"{p}*x"), ("x^2 + cos(3*x)", f"{k}"),
             (f"(x^3 - {m}*x + 1)*(x^2 - {k})", "0"), (f"(x^3 + x + {q})*(x - a)", "0"), ("log(x)^2", f"x + {p}"),
             ("x^7 - x + 1", f"{q}"), (f"sqrt(x^2 + 1)", f"exp(x)/{m}"), ("exp(x)", f"{m}*x^2/(1 + x^2)"),
             (f"x^6 - {m}*x^3", f"{p}*x"), ("x*exp(-abs(x))", f"1/{m}"), ("1/x + x^3", f"{q}"),
             ("max(x, 1)", f"exp(x)/{m}"), ("x*sin(x)", f"{p}"), ("tan(x)", "x"),
             ("exp(exp(x))", f"x + {m}"), (f"exp(-exp(x))", f"x/{m}"), ("cosh(exp(x))", f"x^2 + {k}"),
             ("x*log(x)", f"-1/{m}"), ("sqrt(x)*log(x)", f"-1/{k}"), ("x*log(x)^2", f"1/{m}"), ("x*exp(1/x)", f"{m}")]
    s.lhs, s.rhs = pick(s, forms)
    signs(s, d, s.lhs, s.rhs)
    s.turn = s.lhs.startswith("sin(x)^3")
    s.coords = [("x", *domain(d, 0.3), False)]
    s.reach = 12 if s.turn or s.lhs.startswith("x*sin") or s.lhs == "tan(x)" else 45


def special_values(s, d):
    """Parameters that take the values at which the list is another one."""
    zero = [{"a": "0"}, {"a": "0"}]
    forms = [("a*x", "b", zero), ("a*x^2 + b*x", "0", zero), ("a*x^2 + b*x + c", "0", zero), ("sin(a*x)", "0", zero),
             ("sin(a*x)", "1/2", zero), ("(a - 1)*x", "b", [{"a": "1"}]), ("a*b*x", "a", [{"a": "0"}, {"b": "0"}]),
             ("a*x/(x - b)", "0", zero), ("a*exp(x)", "b", zero), ("(a - b)*x", "c", [{"a": "b"}]), ("a*x^3 - b*x", "0", zero),
             ("a*cos(x)", "0", zero), ("a*cos(x)", "b", zero), ("exp(a*x)", "b", zero), ("a*(x - 1) + b*(x - 1)", "0", [{"a": "-b"}]),
             ("a*x^2", "b", zero), ("a*x", "a*b", zero), ("a*tanh(x)", "b", zero), ("a^2*x", "a", zero), ("a*abs(x)", "b", zero),
             ("(a + b)*x", "1", [{"a": "-b"}]), ("a*x^2 + x - b", "0", zero), ("(a^2 - 4)*x", "b", [{"a": "2"}, {"a": "-2"}]),
             ("a*sqrt(x)", "b", zero), ("a*log(x)", "b", zero), ("a*x + b*x^2", "0", [{"b": "0"}]), ("x/a", "b", []),
             ("a*sin(x) + b*cos(x)", "0", zero), ("(x - b)*(a*x - 1)", "0", zero), ("a*x^4 - b", "0", zero),
             ("a*(b*x - 1)", "0", [{"a": "0"}, {"b": "0"}]), ("a*x - b*x", "0", [{"a": "b"}]), ("cos(a*x) - 1", "0", zero)]
    s.lhs, s.rhs, s.specials = pick(s, forms)
    for n in sorted((names(read(s.lhs)) | names(read(s.rhs))) - {"x"}):
        s.params[n] = ""
    s.turn = any(w in s.lhs for w in ("cos(x)", "sin(x)"))
    s.coords = [("x", *domain(d, 0.2), False)]
    s.reach = 7 if any(w in s.lhs for w in WAVES) else 40


KINDS = {
    "polynomial": polynomial_numbers, "polynomial-parameters": polynomial_parameters,
    "trigonometric": trigonometric,
    "families": families, "exponentials": exponentials, "magnitudes": magnitudes, "powers": powers,
    "rationals": rationals,
    "inverses": inverses, "parameter-domains": parameter_domains, "mixed": mixed, "ends": ends_of_domains,
    "nested": nested,
    "as-written": as_written, "without-formula": without_formula, "special-values": special_values,
    "products": products, "in-function": in_function, "assumptions": assumptions,
}
