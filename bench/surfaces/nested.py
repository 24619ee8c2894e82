"""nested.py -- switches inside switches at random, with branches that are undefined where they are not taken.

As scenes.py; references by DOP853 of SciPy, which evaluates only the branch that is taken, and the error of these. A node
of the force is its text and a function of x, v, t.
"""
import math

import mpmath as mp
from scenes import num

POWERS = {"1.5": 1.5, "2.5": 2.5, "2": 2, "3": 3, "1.2": 1.2, "(3/2)": 1.5}


def line(r):
    """What switches: linear, or a drive."""
    k, a = r.random(), num(r, -0.8, 0.8, 2)
    if k < 0.6:
        return "(x - (%s))" % a, lambda x, v, t: x - a
    if k < 0.75:
        return "(x' - (%s))" % a, lambda x, v, t: v - a
    if k < 0.85:
        return "(sin(2*t) - (%s))" % a, lambda x, v, t: math.sin(2*t) - a
    b = num(r, -1, 1, 2)
    return "(%s*x - (%s))" % (b, a), lambda x, v, t: b*x - a


def positive(r, depth):
    """A node that is never negative."""
    k = r.randrange(7)
    text, f = line(r) if depth <= 0 or r.random() < 0.5 else node(r, depth - 1)
    p = r.choice(list(POWERS))
    P = POWERS[p]
    if k == 0:
        return "(max(%s, 0)^%s)" % (text, p), lambda *y: max(f(*y), 0)**P
    if k == 1:
        return "(abs(%s)^%s)" % (text, p), lambda *y: abs(f(*y))**P
    if k == 2:
        return "(max(-%s, 0)^%s)" % (text, p), lambda *y: max(-f(*y), 0)**P
    if k == 3:
        return "if(%s > 0, (%s)^%s, 0)" % (text, text, p), lambda *y: f(*y)**P if f(*y) > 0 else 0
    if k == 4:
        return "if(%s < 0, (-%s)^%s, 0)" % (text, text, p), lambda *y: (-f(*y))**P if f(*y) < 0 else 0
    if k == 5:
        return "if(%s > 0, log(1 + %s), 0)" % (text, text), lambda *y: math.log(1 + f(*y)) if f(*y) > 0 else 0
    return "max(%s, 0)" % text, lambda *y: max(f(*y), 0)


def branch(r, c):
    """A switch whose branches have powers that are undefined on the other side."""
    (text, f), p = line(r), r.choice(["1.5", "2.5"])
    P = POWERS[p]
    if r.random() < 0.5:
        return ("if(%s < 0, max((-%s)^%s, 0), 0)" % (text, text, p),
                lambda *y: max((-f(*y))**P, 0) if f(*y) < 0 else 0)
    return ("if(%s > 0, min(%s^%s, %s), min((-%s)^%s, %s))" % (text, text, p, c, text, p, c),
            lambda *y: min(abs(f(*y))**P, c))


def node(r, depth):
    if depth <= 0:
        return positive(r, 0) if r.random() < 0.6 else line(r)
    k, (a, f), c = r.randrange(12), positive(r, depth - 1), num(r, 0.05, 0.6, 2)
    if k in (6, 7):
        return branch(r, c)
    if k == 8:
        return "sign(%s)*%s" % (a, a), f
    if k < 5:
        return (("max(%s, 0)" % a, lambda *y: max(f(*y), 0)), ("min(%s, %s)" % (a, c), lambda *y: min(f(*y), c)),
                ("max(%s, %s)" % (a, c), lambda *y: max(f(*y), c)), ("abs(%s - %s)" % (a, c), lambda *y: abs(f(*y) - c)),
                ("max(%s - %s, 0)" % (a, c), lambda *y: max(f(*y) - c, 0)))[k]
    if k in (9, 10):
        b, g = positive(r, depth - 1)
        return (("max(%s, %s, 0)" % (a, b), lambda *y: max(f(*y), g(*y), 0)) if k == 9 else
                ("min(%s, %s)" % (a, b), lambda *y: min(f(*y), g(*y))))
    b, g = node(r, depth - 1)
    if k == 11:
        return "if(%s > 0, %s*%s, 0)" % (a, a, b), lambda *y: f(*y)*g(*y) if f(*y) > 0 else 0
    text, s = line(r)
    return ("if(%s > 0, %s*max(%s, 0), 0)" % (text, text, b),
            lambda *y: s(*y)*max(g(*y), 0) if s(*y) > 0 else 0)


def reference(force, start, T):
    """The state at T, and the distance from a second run."""
    from scipy.integrate import solve_ivp
    ends = []
    for rtol, step in ((1e-13, 0.02), (3e-12, 0.05)):
        s = solve_ivp(lambda t, y: [y[1], force(y[0], y[1], t)], (0, T), start, method="DOP853", rtol=rtol, atol=1e-14,
                      max_step=step)
        if not s.success:
            return None, math.inf
        ends.append(s.y[:, -1])
    return ends[0], abs(ends[0] - ends[1]).max()


def nested_scene(rng):
    """One particle under such a force, by runs, sweeps, `digits`, beside slopes."""
    text, f = node(rng, rng.choice([1, 2, 2, 3]))
    A, k, c = rng.choice([1, -1, 2, 5, -3]), rng.choice([1, 2, 4]), rng.choice([0, 0, 0.1])
    x, v, T = num(rng, -1, 1, 2), num(rng, -1, 1, 2), num(rng, 2, 6, 1)
    how = rng.choice(["", "", "", "", "method gauss8 tol 1e-11", "method radau tol 1e-11", "method dop853 tol 1e-11", "digits 20",
                      "sweep", "slopes"])
    end, off = reference(lambda x, v, t: -k*x - c*v + A*f(x, v, t), [x, v], T)
    if off > 1e-6:
        return nested_scene(rng)
    s = ("param K\nset K = %s\ncoord x\nparticle p mass 1 at x\nforce -K*x - %s*x' + (%s)*(%s) on x\nstart x = %s, x' = %s\n"
         % (k, c, A, text, x, v))
    asked = "value(x, %s)" % T, "value(x', %s)" % T
    if how == "sweep":
        s += ("sweep K = [%s, %s, %s, %s, %s] run 0..%s : %s, %s as S\ntable S\n"
              % (k, k + .1, k + .2, k + .3, k + .4, T, *asked))
    elif how == "slopes":
        s += "run 0..%s\nsensitivity %s of x\n%s\n%s\n" % (T, asked[0], *asked)
    else:
        s += "run 0..%s %s\n%s\n%s\n" % (T, how, *asked)
    return s, [mp.mpf(float(e)) for e in end], 30*off + 1e-9


KINDS = {"nested": nested_scene}
