"""search.py -- all real zeros, found without the program: in one unknown on a grid, in several from many starts.

Every zero is confirmed in 50 digits, so none is invented; that none is missed is only likely, and what
is missed makes a verdict milder, never unjust.
"""
import ast, math, random

import mpmath
import numpy as np
import sympy

from formula import NAN, Real, array, mp, symbolic

TINY = mpmath.mpf(10) ** -28
STEP = mpmath.mpf(10) ** -22


# --- one unknown --------------------------------------------------------------------------------

def grid(lo, hi, reach=40, n=1 << 14):
    """Points inside (lo, hi): dense and dyadic near, by their logarithms far away."""
    a, b = max(lo, -reach if hi > -reach else hi - 2 * reach), min(hi, reach if lo < reach else lo + 2 * reach)
    parts = [np.linspace(a, b, n + 1)]
    near = np.arange(-2048, 2049) / 512.0
    parts.append(near)
    far = 2.0 ** np.arange(0, 22, 1 / 64)
    if hi == math.inf:
        parts.append(b + far)
        parts.append(far * reach / 2)
    if lo == -math.inf:
        parts.append(a - far)
        parts.append(-far * reach / 2)
    for end in (lo, hi):
        if math.isfinite(end):
            close = 2.0 ** np.arange(-20, 0, 1 / 8) * min(1, (hi - lo) / 4)
            parts.append(end + close if end == lo else end - close)
    x = np.unique(np.concatenate(parts))
    return x[(x > lo) & (x < hi)]


def bisect(g, a, b):
    """Where g changes its sign, to all digits; nan if g loses its value."""
    a, b = mpmath.mpf(float(a)), mpmath.mpf(float(b))
    ga = g(a)
    if mpmath.isnan(ga):
        return NAN
    if ga == 0:
        return a
    gb = g(b)
    if gb == 0:
        return b
    if mpmath.isnan(gb) or (ga > 0) == (gb > 0):
        return NAN
    side = 0
    for k in range(250):
        if abs(b - a) <= TINY * (1 + abs(a)):
            break
        if k < 12 or k % 3 == 0 or gb == ga:
            m = (a + b) / 2
        else:
            m = (a * gb - b * ga) / (gb - ga)
            if not (min(a, b) < m < max(a, b)):
                m = (a + b) / 2
        gm = g(m)
        if mpmath.isnan(gm):
            return NAN
        if gm == 0:
            return m
        if (gm > 0) == (ga > 0):
            a, ga = m, gm
            if side == 1:
                gb /= 2
            side = 1
        else:
            b, gb = m, gm
            if side == -1:
                ga /= 2
            side = -1
    return (a + b) / 2


def zeros(tree, x, at, lo, hi, reach=40):
    """Zeros of a formula on (lo, hi), and samples of the intervals where it vanishes throughout."""
    doubles = {k: float(v) for k, v in at.items()}
    points = grid(float(lo), float(hi), reach)
    with np.errstate(all="ignore"):
        y = array(tree, dict(doubles, **{x: points}))
        y = np.broadcast_to(np.asarray(y, float), points.shape)
    f = lambda v: Real.of(tree, dict(at, **{x: v}))
    found, spans = [], []
    finite = np.isfinite(y)
    scale = np.nanmedian(np.abs(y[finite])) if finite.any() else 1.0
    small = finite & (np.abs(y) <= 1e-13 * max(scale, 1.0))
    # intervals of zeros: three neighbours in a row
    inner = np.flatnonzero(small[:-2] & small[1:-1] & small[2:]) + 1
    for i in inner[:: max(1, len(inner) // 12)]:
        v = mpmath.mpf(float(points[i])) + mpmath.mpf(1) / 2**40 / 3
        beside = (0, mpmath.mpf(1) / 2**25, -mpmath.mpf(1) / 2**25)
        near = inside(v, lo, hi) and not (abs(v) > 20 and fading(tree))
        if near and all(vanishes(lambda: f(v + d)) for d in beside):
            spans.append(v)
    mask = np.zeros(len(points), bool)
    if spans:
        for k in (-1, 0, 1):
            mask[inner + k] = True
    sign = np.sign(y)
    brackets = list(np.flatnonzero(finite[:-1] & finite[1:] & (sign[:-1] * sign[1:] < 0))[:400])
    brackets = [(i, i + 1) for i in brackets[:: 1 + len(brackets) // 40]]
    for i in sorted(np.flatnonzero(small & ~mask), key=lambda i: abs(points[i]))[:60]:
        v = mpmath.mpf(float(points[i]))
        if f(v) == 0:
            found.append(v)
        elif 0 < i < len(points) - 1 and sign[i] == 0 and sign[i - 1] * sign[i + 1] < 0:
            brackets.append((i - 1, i + 1))
    for i, j in brackets:
        v = bisect(f, points[i], points[j])
        if not mpmath.isnan(v):
            fv = f(v)
            if not mpmath.isnan(fv) and abs(fv) <= 1e-16 * min(abs(y[i]), abs(y[j])):
                near = mpmath.nint(v * 720720) / 720720
                if all(abs(f(v + d)) < 1e-8 for d in (STEP, -STEP)):
                    found.append(v)
                elif abs(near - v) < STEP and f(near) == 0:     # a jump: only its value at the place counts
                    found.append(near)
    h = np.abs(y)
    with np.errstate(invalid="ignore"):
        least = (h[1:-1] <= h[:-2]) & (h[1:-1] <= h[2:]) & (h[1:-1] < 1e-2 * max(scale, 1e-9))
        touch = np.flatnonzero(finite[:-2] & finite[1:-1] & finite[2:] & least & ~mask[1:-1]) + 1
    for i in touch[:: 1 + len(touch) // 40]:
        v = bisect(lambda v: f(v + STEP) - f(v - STEP), points[i - 1], points[i + 1])
        if not mpmath.isnan(v):
            fv, around = f(v), min(abs(f(mpmath.mpf(float(points[k])))) for k in (i - 1, i + 1))
            if not mpmath.isnan(fv) and not mpmath.isnan(around) and abs(fv) <= mpmath.mpf(10) ** -15 * around:
                found.append(v)
    out = []
    for v in sorted(found):
        new = not out or abs(v - out[-1]) > 1e-9 * (1 + abs(v))
        if new and inside(v, lo, hi) and not (abs(v) > 30 and fading(tree)) and defined(tree, dict(at, **{x: v})):
            out.append(v)
    return out, spans


def inside(v, lo, hi):
    """Strictly, and not by rounding alone."""
    margin = 1e-9 * (1 + abs(v))
    return lo + margin < v < hi - margin


def fading(tree):
    """Does it hold functions that vanish to all digits far out?"""
    return any(isinstance(n, ast.Call) and n.func.id in ("exp", "tanh", "cosh", "sinh") for n in ast.walk(tree))


def defined(tree, at):
    """No denominator vanishes here (a zero of numerator and denominator is none)."""
    for node in ast.walk(tree):
        if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Div):
            d = Real.of(node.right, at)
        elif isinstance(node, ast.Call) and node.func.id == "log":
            d = Real.of(node.args[0], at)
        elif isinstance(node, ast.BinOp) and isinstance(node.op, ast.Pow) and Real.of(node.right, at) < 0:
            d = Real.of(node.left, at)
        else:
            continue
        if mpmath.isnan(d) or abs(d) < 1e-15:
            return False
    return True


def vanishes(residual):
    """Is it exactly zero? It is zero, or shrinks with the precision it is computed in (and does not just fade)."""
    r = residual()
    if mpmath.isnan(r):
        return False
    if r == 0:
        return True
    if abs(r) > 1e-20:
        return False
    with mp.workdps(90):
        finer = residual()
    return not mpmath.isnan(finer) and abs(finer) <= mpmath.mpf(10) ** -15 * abs(r)


# --- several unknowns ---------------------------------------------------------------------------

class Forces:
    """Gradient and Hessian of a smooth potential, over arrays and in 50 digits."""
    def __init__(self, potential, coordinates, parameters):
        self.q = coordinates
        symbols = [sympy.Symbol(n, real=True) for n in coordinates + parameters]
        V = symbolic(potential)
        self.gradient = [sympy.diff(V, s) for s in symbols[: len(coordinates)]]
        hessian = [sympy.diff(g, s) for g in self.gradient for s in symbols[: len(coordinates)]]
        self.fast = sympy.lambdify(symbols, self.gradient + hessian, "numpy", cse=True)
        self.exact = sympy.lambdify(symbols, self.gradient + hessian, "mpmath", cse=True)
        self.parameters = parameters

    def arrays(self, q, at):
        """Gradients (m, n) and Hessians (m, n, n) at points (m, n)."""
        n, m = len(self.q), len(q)
        with np.errstate(all="ignore"):
            out = self.fast(*[q[:, i] for i in range(n)], *[float(at[p]) for p in self.parameters])
        out = np.stack([np.broadcast_to(np.asarray(o, float), (m,)) for o in out], 1)
        return out[:, :n], out[:, n:].reshape(m, n, n)

    def at(self, q, at):
        """Gradient and Hessian in 50 digits; None where they have no real value."""
        n = len(self.q)
        try:
            out = self.exact(*q, *[at[p] for p in self.parameters])
        except (ZeroDivisionError, ValueError, OverflowError, TypeError):
            return None
        out = [mpmath.mpmathify(o) for o in out]
        if any(isinstance(o, mpmath.mpc) or not mpmath.isfinite(o) for o in out):
            return None
        return out[:n], [out[n + i * n : n + (i + 1) * n] for i in range(n)]


def starts(box, count, draw):
    columns = []
    for lo, hi, angle in box:
        if math.isfinite(lo) and math.isfinite(hi):
            columns.append(np.array([draw.uniform(lo, hi) for _ in range(count)]))
        else:
            c = []
            for _ in range(count):
                kind = draw.random()
                v = draw.uniform(-3, 3) if kind < 0.6 else draw.uniform(-12, 12) if kind < 0.9 else \
                    draw.choice((-1, 1)) * 10 ** draw.uniform(-3, 3)
                if lo > -math.inf:
                    v = lo + abs(v)
                elif hi < math.inf:
                    v = hi - abs(v)
                c.append(v)
            columns.append(np.array(c))
    return np.stack(columns, 1)


def wrap(v):
    """An angle in (-pi, pi]."""
    v = v - 2 * mpmath.pi * mpmath.floor((v + mpmath.pi) / (2 * mpmath.pi))
    return mpmath.mpf(mpmath.pi) if abs(v + mpmath.pi) < mpmath.mpf(10) ** -12 else v


def stationary(forces, at, box, seed, count=900):
    """Points where all forces vanish, inside the box: [(point, 'isolated' or 'set')]. box: (lo, hi, is an angle)."""
    draw = random.Random(f"starts {seed}")
    n = len(forces.q)
    q = starts(box, count, draw)
    edge = np.array([[0.5 if a else 4.0 for _, _, a in box]])
    for k in range(60):
        F, J = forces.arrays(q, at)
        good = np.isfinite(F).all(1) & np.isfinite(J).all((1, 2)) & (np.abs(q) < 1e5).all(1)
        if k > 20:
            good &= ~(np.abs(F).max(1) > 1e6)
        q, F, J = q[good], F[good], J[good]
        if not len(q):
            return []
        JT = np.swapaxes(J, 1, 2)
        A = JT @ J
        r = (JT @ F[:, :, None])[:, :, 0]
        norm = np.abs(A).max((1, 2)) + 1e-300
        mu = np.minimum(1e-6, (F**2).sum(1)) * 1e-3 * norm + 1e-14 * norm
        A = A + mu[:, None, None] * np.eye(n)
        try:
            d = np.linalg.solve(A, r[:, :, None])[:, :, 0]
        except np.linalg.LinAlgError:
            d = np.stack([np.linalg.lstsq(a, b, rcond=None)[0] for a, b in zip(A, r)])
        d = np.clip(d, -edge, edge)
        q = q - d
    F, J = forces.arrays(q, at)
    ok = np.isfinite(F).all(1) & (np.abs(F).max(1) < 1e-6) & (np.abs(d).max(1) < 1e-5 * (1 + np.abs(q).max(1)))
    q = q[ok]
    for i, (_, _, angle) in enumerate(box):
        if angle:
            q[:, i] = np.mod(q[:, i] + math.pi, 2 * math.pi) - math.pi
    # cells of 1e-5, so that each place is confirmed once
    seen, points = set(), []
    for row in q:
        key = tuple(np.round(row / (1 + np.abs(row)) * 1e4).astype(int))
        if any(tuple(np.add(key, s)) in seen for s in np.ndindex(*(3,) * n) for s in [np.array(s) - 1]):
            continue
        seen.add(key)
        points.append(row)
    out, sets, lost = [], 0, 0
    for row in points[:80]:
        if sets > 12 or lost > 12:
            break
        try:
            p = polish(forces, [mpmath.mpf(float(v)) for v in row], at)
        except ZeroDivisionError:
            p = None
        if p is None:
            lost += 1
            continue
        p, isolated = p
        p = [wrap(v) if b[2] else v for v, b in zip(p, box)]
        far = not isolated and max(abs(v) for v in p) > 12
        if far or not all(b[2] or inside(v, b[0], b[1]) for v, b in zip(p, box)):
            continue
        if any(all(abs(u - v) < 1e-7 * (1 + abs(v)) for u, v in zip(p, other)) for other, _ in out):
            continue
        sets += not isolated
        out.append((p, isolated))
    return out


def gauss(A, b):
    """(solution, determinant) of a small system of lists; (None, 0) if it is singular."""
    n = len(b)
    A = [list(row) + [v] for row, v in zip(A, b)]
    det = mpmath.mpf(1)
    for k in range(n):
        i = max(range(k, n), key=lambda r: abs(A[r][k]))
        if A[i][k] == 0:
            return None, mpmath.mpf(0)
        if i != k:
            A[i], A[k], det = A[k], A[i], -det
        det *= A[k][k]
        for r in range(k + 1, n):
            f = A[r][k] / A[k][k]
            A[r] = [u - f * v for u, v in zip(A[r], A[k])]
    x = [mpmath.mpf(0)] * n
    for k in reversed(range(n)):
        x[k] = (A[k][n] - sum((A[k][c] * x[c] for c in range(k + 1, n)), mpmath.mpf(0))) / A[k][k]
    return x, det


def damped(H, F, mu):
    """The step of least squares with a damping mu."""
    n = len(F)
    A = [[sum(H[k][i] * H[k][j] for k in range(n)) + (mu if i == j else 0) for j in range(n)] for i in range(n)]
    return gauss(A, [sum(H[k][i] * F[k] for k in range(n)) for i in range(n)])[0]


def polish(forces, p, at, move=1e-2):
    """Newton in 50 digits: (zero, whether it is regular); None if it does not converge to one."""
    n = len(p)
    start = list(p)
    for k in range(150):
        both = forces.at(p, at)
        if both is None:
            return None
        F, H = both
        size = max(abs(h) for row in H for h in row)
        force = max(abs(f) for f in F)
        if size == 0:
            return (p, False) if force == 0 else None
        d, det = gauss(H, F)
        det = abs(det) / size**n
        regular = det > 1e-9
        if not regular:
            if force <= mpmath.mpf(10) ** -24 * size:
                return degenerate(forces, p, at)
            d = damped(H, F, size**2 * mpmath.mpf(10) ** -22)
        step = max(abs(x) for x in d)
        if regular and step < mpmath.mpf(10) ** -30 * (1 + max(abs(x) for x in p)):
            return p, bool(det > 1e-6 and size > 1e-8)
        if k > 60 and step < 1e-9 and size < 1e-12:
            return degenerate(forces, p, at)
        if k > 20 and step > 1e-4:
            return None
        p = [u - v for u, v in zip(p, d)]
        if any(abs(u - v) > move * (1 + abs(v)) for u, v in zip(p, start)):
            return None
    return None


def degenerate(forces, p, at):
    """A zero with a singular Hessian: a round place, or one that more steps bring closer by far.

    (Forces that only fade far out are brought no closer.)"""
    near = [mpmath.nint(x * 10**6) / 10**6 for x in p]
    with mp.workdps(100):
        F = forces.at(near, at)
        if F is not None:
            force = max(abs(f) for f in F[0])
            with mp.workdps(200):
                finer = max(abs(f) for f in forces.at(near, at)[0])
            if force == 0 or (force < mpmath.mpf(10) ** -90 and finer < force * mpmath.mpf(10) ** -50):
                return near, False
        force = max(abs(f) for f in forces.at(p, at)[0])
        q = list(p)
        for k in range(3):
            F, H = forces.at(q, at)
            size = max(abs(h) for row in H for h in row)
            if size == 0:
                return None
            d = damped(H, F, size**2 * mpmath.mpf(10) ** -60)
            q = [u - v for u, v in zip(q, d)]
        moved = max(abs(u - v) for u, v in zip(p, q))
        finer = forces.at(q, at)
        if finer is None or moved > 1e-4:
            return None
        if max(abs(f) for f in finer[0]) > min(force * mpmath.mpf(10) ** -12, mpmath.mpf(10) ** -75):
            return None
    return q, False
