"""second.py -- the values of cases.py found another way.

By numbers where cases.py has a closed form: extrapolation (Gragg, Bulirsch & Stoer) in 64-bit mantissas of
equations written by hand, in other coordinates where those of the scene are singular; exponentials of
matrices by eigenvectors or with the drive as a further oscillator; Duhamel's integrals by quadrature. Energies
of chaotic motions: from Lagrange's equations written by hand, a little later. Each function gives the values of
one case in the order in which cases.py has them; an entry is (function, how far it can be right).
"""
import mpmath as m
import numpy as np
from mpmath import matrix, mpf

L = np.longdouble
PI = L("3.14159265358979323846264338327950288")


def text(x):
    """a longdouble as an mpf"""
    return mpf(repr(x).split("'")[1] if "'" in repr(x) else repr(x))


def gbs(f, y, t, tol=2e-17, first=0.05, L=L):
    """y at t of y' = f(t, y) from 0: Gragg's midpoint rule extrapolated to order 18, steps by the tolerance,
    in numbers of the type L."""
    rows = 9
    n = [2 * (k + 1) for k in range(rows)]
    y, s, h = np.array([L(x) for x in y]), L(0), L(first)
    carry = 0 * y
    t = L(t)
    while s < t:
        h = min(h, t - s)
        table, start = [], f(s, y)
        for k in range(rows):
            d = h / n[k]
            before, now = y, y + d * start
            for i in range(1, n[k]):
                before, now = now, before + 2 * d * f(s + i * d, now)
            row = [(now + before + d * f(s + h, now)) / 2 - y]
            for j in range(k):
                r = (L(n[k]) / n[k - j - 1]) ** 2
                row.append(row[j] + (row[j] - table[-1][j]) / (r - 1))
            table.append(row)
        size = max(1, max(abs(y)))
        error = float(max(abs((table[-1][-1] - table[-1][-2]) / size)))
        if error <= tol:
            s = t if h >= t - s else s + h
            step = table[-1][-1] + carry
            new = y + step
            carry = step - (new - y)
            y = new
        h *= L(min(3, max(0.2, 0.8 * (1 / (error / tol + 1e-9)) ** (1 / 17))))
    return y


def vector(*x):
    return np.array(x)


def numbers(f, y, t, *read):
    """Functions `read` of the state at t."""
    end = gbs(f, y, t)
    return [text(g(end)) for g in read]


def component(k):
    return lambda y: y[k]


def exponential(A, y0, t):
    """exp(A t) y0 by eigenvectors."""
    n = len(y0)
    M = matrix(n, n)
    for i in range(n):
        for j in range(n):
            M[i, j] = mpf(A[i][j])
    values, vectors = m.eig(M)
    parts = m.lu_solve(vectors, matrix([mpf(y) for y in y0]))
    return [m.re(sum(vectors[i, k] * parts[k] * m.exp(values[k] * mpf(t)) for k in range(n))) for i in range(n)]


def duhamel(kernel, f, ends):
    """int kernel(t - s) f(s) ds over the pieces between `ends`, the last of them t."""
    return m.quad(lambda s: kernel(ends[-1] - s) * f(s), ends)


def kicked_by(width):
    """x at 10 of an oscillator at rest after a Gaussian kick of momentum 1 about 5"""
    w = mpf(width)
    return duhamel(m.sin, lambda s: m.exp(-((s - 5) / w) ** 2 / 2) / (w * m.sqrt(2 * m.pi)),
                   [5 + w * k for k in range(-14, 15)] + [mpf(10)])


def slowing(k):
    """x where x'' = -x'^(1 - 1/k) from x' = 1 comes to rest, by w = x'^(1/k), w' = -1/k"""
    return numbers(lambda s, y: vector(y[1] ** k, L(-1) / k), [0, 1], k, component(0)) + [mpf(0)]


def pendulum(start, g, t):
    return numbers(lambda s, y: vector(y[1], -L(g) * np.sin(y[0])), [start, 0], t, component(0))[0]


def central(k, power, y, t):
    """x, y of r'' = -k r/|r|^power"""
    def f(s, y):
        r = np.sqrt(y[0] ** 2 + y[1] ** 2)
        return vector(y[2], y[3], -L(k) * y[0] / r ** power, -L(k) * y[1] / r ** power)
    return numbers(f, y, t, component(0), component(1))


def regularised(a, e, t):
    """x, y of Kepler's ellipse by Levi-Civita's oscillator u'' = -u/(4a), dt = r ds, r = |u|^2."""
    a, e, t = mpf(a), mpf(e), mpf(t)
    w = 1 / (2 * m.sqrt(a))
    u0, u1 = m.sqrt(a * (1 - e)), m.sqrt(a * (1 + e))
    time = lambda s: u0 ** 2 * (s / 2 + m.sin(2 * w * s) / (4 * w)) + u1 ** 2 * (s / 2 - m.sin(2 * w * s) / (4 * w))
    low, high = mpf(0), t / (a * (1 - e))
    for _ in range(int(3.4 * m.mp.dps) + 60):
        middle = (low + high) / 2
        low, high = (low, middle) if time(middle) > t else (middle, high)
    u, v = u0 * m.cos(w * low), u1 * m.sin(w * low)
    return [u * u - v * v, 2 * u * v]


def fallen(r0, t):
    """fall by u'' = -u/(2 r0), dt = r ds, r = u^2, from u = sqrt(r0) at rest."""
    r0, t = mpf(r0), mpf(t)
    w = 1 / m.sqrt(2 * r0)
    time = lambda s: r0 * (s / 2 + m.sin(2 * w * s) / (4 * w))
    low, high = mpf(0), 4 * t / r0
    for _ in range(int(3.4 * m.mp.dps) + 60):
        middle = (low + high) / 2
        low, high = (low, middle) if time(middle) > t else (middle, high)
    return r0 * m.cos(w * low) ** 2


def stepped(x, v, t, accelerations):
    """Pieces of constant acceleration: (length, a) until t."""
    for length, a in accelerations:
        x, v = x + v * length + a * length ** 2 / 2, v + a * length
    return [x, v]


# --- a -----------------------------------------------------------------------------------------


def a3():
    """v' = -g + c v^2, v = -u'/(c u): u'' = c g u; y = -log(u)/c"""
    c, g = mpf(20000), mpf("9.81")
    big = m.expm(matrix([[0, 1], [c * g, 0]]) * 5, method="taylor") * matrix([1, 0])
    return [-m.log(big[0]) / c, -big[1] / (c * big[0])]


def a4():
    """The drive cos t as an oscillator of its own."""
    end = exponential([["-1e4", "1e4", 0], [0, 0, -1], [0, 1, 0]], [0, 1, 0], 10)
    return [end[0]]


def a5():
    """Modes of the chain, whose damping is proportional."""
    K = matrix(4, 4)
    for i in range(4):
        K[i, i] = 1 if i == 3 else 2
        if i:
            K[i, i - 1] = K[i - 1, i] = -1
    values, Q = m.eigsy(K)
    x = [mpf(0)] * 4
    for k in range(4):
        c, s = 900 * values[k], 40000 * values[k]
        root = m.sqrt(m.mpc(c * c / 4 - s))
        t, z = mpf("0.1"), Q[3, k] * mpf("0.1")
        q = z * m.exp(-c * t / 2) * (m.cosh(root * t) + c / (2 * root) * m.sinh(root * t))
        for i in range(4):
            x[i] += m.re(q) * Q[i, k]
    return [x[0], x[3]]


def two_scales():
    """Sum and difference of the two: modes of K."""
    K = matrix([["50001", "-50000"], ["-50000", "50000"]])
    values, Q = m.eigsy(K)
    start = [mpf(1), mpf("1.01")]
    q = [sum(Q[i, k] * start[i] for i in range(2)) * m.cos(m.sqrt(values[k]) * 20) for k in range(2)]
    return [sum(Q[i, k] * q[k] for k in range(2)) for i in range(2)]


def frame():
    end = exponential([[0, 0, 1, 0], [0, 0, 0, 1], ["-1000000.5", "999999.5", "-1000", "1000"],
                       ["999999.5", "-1000000.5", "1000", "-1000"]], [1, 1, 0, 0], 30)
    return [end[0], end[3]]


# --- b, c --------------------------------------------------------------------------------------


def cycloid():
    """(2 + 2 cos u) u'' = sin u u'^2 - sin u"""
    return numbers(lambda s, y: vector(y[1], np.sin(y[0]) * (y[1] ** 2 - 1) / (2 + 2 * np.cos(y[0]))),
                   [2, 0], 2000, lambda y: np.sin(y[0] / 2))


def links(s, y):
    """masses 2, 1, lengths 1, 1/2"""
    a, b, p, q = y
    c, d = np.cos(a - b), np.sin(a - b)
    M = [[L(3), c / 2], [c / 2, L(1) / 4]]
    f = [-d / 2 * q * q - 3 * np.sin(a), d / 2 * p * p - np.sin(b) / 2]
    det = M[0][0] * M[1][1] - M[0][1] ** 2
    return vector(p, q, (f[0] * M[1][1] - f[1] * M[0][1]) / det, (f[1] * M[0][0] - f[0] * M[0][1]) / det)


def links_energy(y):
    a, b, p, q = y
    v = [np.cos(a) * p, np.sin(a) * p]
    w = [v[0] + np.cos(b) * q / 2, v[1] + np.sin(b) * q / 2]
    return v[0] ** 2 + v[1] ** 2 + (w[0] ** 2 + w[1] ** 2) / 2 - 3 * np.cos(a) - np.cos(b) / 2


def spring_energy(y):
    """x, z of the bob, Cartesian"""
    r = np.sqrt(y[0] ** 2 + y[1] ** 2)
    return (y[2] ** 2 + y[3] ** 2) / 2 + y[1] + 2 * (r - 1) ** 2


def spring(s, y):
    r = np.sqrt(y[0] ** 2 + y[1] ** 2)
    k = -4 * (r - 1) / r
    return vector(y[2], y[3], k * y[0], k * y[1] - 1)


def cart(s, y):
    x, a, p, q = y
    c, d = np.cos(a), np.sin(a)
    f, g = d * q * q - x, -d
    det = 2 - c * c
    return vector(p, q, (f - c * g) / det, (2 * g - c * f) / det)


def cart_energy(y):
    x, a, p, q = y
    return p * p + np.cos(a) * p * q + q * q / 2 - np.cos(a) + x * x / 2


def quartic(s, y):
    return vector(y[2], y[3], -y[0] * y[1] ** 2 - y[0] ** 3 / 50, -y[1] * y[0] ** 2 - y[1] ** 3 / 50)


def quartic_energy(y):
    return (y[2] ** 2 + y[3] ** 2 + y[0] ** 2 * y[1] ** 2) / 2 + (y[0] ** 4 + y[1] ** 4) / 200


# --- d ... -------------------------------------------------------------------------------------


def past(miss):
    """The straight line from the polar start, turned into x, y."""
    miss = mpf(miss)
    r, angle = m.sqrt(1 + miss ** 2), m.atan(miss)
    rate, turn = -1 / r, miss / r ** 2
    c, s = m.cos(angle), m.sin(angle)
    return [r * c + 3 * (rate * c - r * turn * s), r * s + 3 * (rate * s + r * turn * c)]


def sphere(s, y):
    k = -(y[3:] @ y[3:])
    return np.concatenate([y[3:], k * y[:3]])


def parabolic():
    u, v, p = mpf(1), mpf(1) / 1000, mpf(-1)
    return [u * v + 2 * p * v, (u * u - v * v) / 2 + 2 * u * p]


def upright():
    """In 45 digits."""
    end = gbs(lambda s, y: vector(y[1], -m.sin(y[0])), [m.pi - mpf(10) ** -6, 0], 40, 1e-30, 0.01, mpf)
    return [end[0]]


def zigzag():
    """Pieces between zeros: from 1 the zero is at sqrt 2, then every 2 sqrt 2."""
    q, pieces, t, a = m.sqrt(2), [], mpf(0), -1
    length = q
    while t + length < 50:
        pieces.append((length, a))
        t, length, a = t + length, 2 * q, -a
    return stepped(mpf(1), mpf(0), 50, pieces + [(50 - t, a)])[:1]


def half_spring():
    """Down, through the spring by its exponential, up again."""
    down = m.sqrt(2)
    end = exponential([[0, 1, 0], ["-100", 0, "-1"], [0, 0, 0]], [0, -down, 1], 2 * (m.pi - m.atan(10 * m.sqrt(2))) / 10)
    return stepped(end[0], end[1], 0, [(down, -1)])


def fractional():
    """The period by quadrature; whole periods end where they began."""
    quarter = m.quad(lambda z: 4 * z ** (mpf(1) / 3) / 3 / m.sqrt(2 * (1 - z * z)), [0, mpf(1) / 2, 1])
    T = 4 * m.sqrt(m.pi / 2) * 2 / 3 * mpf("1.354117939426400416945288") / mpf("0.9277193336300392007083495")
    late = T - 4 * quarter
    return [1 - mpf(3) / 4 * late ** 2, -mpf(3) / 2 * late]


def breathing():
    """The angle from the angular momentum, which is kept: x, y and their rates."""
    angle = m.quad(lambda s: 1 / (2 + m.sin(s)) ** 2, m.linspace(0, 6, 7))
    r, rate = 2 + m.sin(6), m.cos(6)
    x, y = r * m.cos(angle), r * m.sin(angle)
    p, q = rate * m.cos(angle) - m.sin(angle) / r, rate * m.sin(angle) + m.cos(angle) / r
    return [x * x + y * y, x * q - y * p]


def bouncing():
    """The times of the hits as a geometric sum."""
    e = mpf("0.9")
    n = int(m.floor(m.log(1 - (15 - 1) * (1 - e) / (2 * e)) / m.log(e)))
    at, v = 1 + 2 * e * (1 - e ** n) / (1 - e), 2 * e ** (n + 1)
    s = 15 - at
    return [v * s - s * s]


def kicked():
    """Halved at t = 1, 3, 5, 7, 9, where sin(pi t) falls through 0."""
    ends = [mpf(k) for k in (0, 1, 3, 5, 7, 9)] + [mpf("9.5")]
    return [sum((b - a) * mpf(2) ** -k for k, (a, b) in enumerate(zip(ends, ends[1:])))]


def oscillator(w, x0, v0, t):
    return exponential([[0, 1], [-mpf(w) ** 2, 0]], [x0, v0], t)


def driven(w, t):
    """x'' = -x + cos w t from rest: the drive as an oscillator of its own."""
    return exponential([[0, 1, 0, 0], [-1, 0, 1, 0], [0, 0, 0, 1], [0, 0, -mpf(w) ** 2, 0]], [0, 0, 1, 0], t)[:1]


def damped(c, t):
    return exponential([[0, 1], [-1, -mpf(c)]], [1, 0], t)[0]


KEEP, FINE = "1e-30", "1e-15"
WAYS = {
    "a1-overdamped": (lambda: exponential([[0, 1], [-2, "-3e5"]], [2, 0], 7), KEEP),
    "a2-two-scales": (two_scales, KEEP),
    "a3-quadratic-drag": (a3, KEEP),
    "a4-relaxing-drive": (a4, KEEP),
    "a5-damped-chain": (a5, KEEP),
    "a6-stiff-frame": (frame, KEEP),
    "a7-three-scales": (lambda: exponential([[0, 0, 0, 1, 0, 0], [0, 0, 0, 0, 1, 0], [0, 0, 0, 0, 0, 1], [-1001, 1000, 0, 0, 0, 0],
                                             [10 ** 6, -2 * 10 ** 6, 10 ** 6, 0, 0, 0], [0, 10 ** 9, -10 ** 9, 0, 0, -10 ** 7]],
                                            [1, 1, 1, 0, 0, 0], 10)[::2], KEEP),
    "b1-oscillator": (lambda: oscillator(2, 3, 0, 20000)[:1], KEEP),
    "b2-pendulum": (lambda: [pendulum(1, 4, 5000)], "1e-11"),
    "b3-ellipse": (lambda: regularised(1, "0.7", 3000), KEEP),
    "b4-quartic": (lambda: numbers(lambda s, y: vector(y[1], -y[0] ** 3), [1, 0], 2000, component(0)), "1e-11"),
    "b5-cycloid": (cycloid, "1e-13"),
    "c1-unequal-links": (lambda: numbers(links, [L("2.2"), -1, 0, 0], 4, links_energy), FINE),
    "c2-coupled-quartic": (lambda: numbers(quartic, [1, L("0.3"), 0, 1], 4, quartic_energy), FINE),
    "c3-spring-pendulum": (lambda: numbers(spring, [L("1.5") * np.sin(L("2.5")), -L("1.5") * np.cos(L("2.5")), 0, 0],
                                           4, spring_energy), FINE),
    "c4-cart-on-spring": (lambda: numbers(cart, [2, L("2.9"), 0, 0], 4, cart_energy), FINE),
    "c5-regular-for-once": (lambda: oscillator(1, 1, 0, 1000)[:1] + oscillator(2, 1, 0, 1000)[:1], KEEP),
    "d1-past-the-origin-1e-2": (lambda: past("1e-2"), KEEP),
    "d2-past-the-origin-1e-5": (lambda: past("1e-5"), KEEP),
    "d3-past-the-origin-1e-8": (lambda: past("1e-8"), KEEP),
    "d4-oscillator-in-polar": (lambda: oscillator(1, 1, 0, 30)[:1] + oscillator(1, 0, "0.001", 30)[:1], KEEP),
    "d5-great-circle": (lambda: numbers(sphere, [1, 0, 0, 0, L("1e-4"), -1], 10, component(2)), FINE),
    "d6-parabolic": (parabolic, KEEP),
    "e1-ellipse-0.9995": (lambda: regularised(1, "0.9995", 3), KEEP),
    "e2-nearly-upright": (upright, "1e-20"),
    "e3-molecule": (lambda: oscillator(m.sqrt(500 / mpf("1.6e-27")), "1e-11", 0, "1e-12")[:1], KEEP),
    "e4-planet": (lambda: [mpf("1.2e11") * x for x in central(
        mpf("8e44") / mpf("6e24") / mpf("1.2e11") ** 3, 3,
        [1, 0, 0, text(np.sqrt(L("1.2"))) * m.sqrt(mpf("8e44") / mpf("6e24") / mpf("1.2e11") ** 3)],
        mpf("9e7"))], "1e-14"),
    "e5-offset": (lambda: [2 ** 24 + oscillator(1, 1, 0, 20)[0]], KEEP),
    "e6-small-beside-large": (lambda: oscillator(1, 1, 0, 10)[:1] + oscillator(3, "1e-9", 0, 10)[:1], KEEP),
    "e7-through-the-centre": (lambda: [fallen(1, 5)], KEEP),
    "e8-flyby-1e-8": (lambda: regularised(1, 1 - mpf(10) ** -8, 3), KEEP),
    "e9-nearly-straight": (lambda: [-x for x in regularised(1, 1 - mpf(10) ** -9, 20 + m.pi)], KEEP),
    "e10-separatrix": (lambda: numbers(lambda s, y: vector(2 * np.cos(y[0] / 2)), [0], 25, component(0)), FINE),
    "f1-wedge": (zigzag, KEEP),
    "f2-slides-and-stays": (lambda: stepped(mpf(0), mpf(1), 2, [(mpf(2), -mpf(1) / 2)])[:1], KEEP),
    "f3-half-spring": (half_spring, KEEP),
    "f4-square-wave": (lambda: stepped(mpf(0), -mpf(1) / 2, 20, [(mpf(1), (-1) ** k) for k in range(20)]), KEEP),
    "f5-mod-drive": (lambda: [9 * (mpf(1) / 12 + duhamel(lambda s: s, lambda s: s - mpf(1) / 2, [0, 1])), mpf(1) / 12], KEEP),
    "f6-fractional": (fractional, "1e-22"),
    "f7-kick-of-1e-8": (lambda: [kicked_by("1e-8")], KEEP),
    "f8-kick-of-1e-10": (lambda: [kicked_by("1e-10")], KEEP),
    "f9-friction-to-the-1-2": (lambda: slowing(2), FINE),
    "f10-friction-to-the-2-3": (lambda: slowing(3), FINE),
    "f11-friction-to-the-9-10": (lambda: slowing(10), FINE),
    "f12-held-until-driven": (lambda: [m.quad(lambda w: 2 * w ** 3 / (w + mpf(1) / 2), [0, 1]), mpf(0)], KEEP),
    "g1-pendulum": (lambda: (lambda a: [m.sin(a), -m.cos(a)])(pendulum(1, 4, 50)), FINE),
    "g2-great-circle": (lambda: numbers(sphere, [1, 0, 0, 0, L("0.6"), L("0.8")], 100, component(0), component(2)), "1e-14"),
    "g3-atwood": (lambda: (lambda x: [x[0], -x[1]])(stepped(mpf(0), mpf(0), 3, [(mpf(3), (3 - 2) * mpf(10) / (3 + 2))])), KEEP),
    "g4-knife-edge": (lambda: numbers(lambda s, y: vector(np.cos(y[2]), np.sin(y[2]), L(2)), [0, 0, 0], 30,
                                      component(0), component(1)), "1e-14"),
    "g5-rolling": (lambda: stepped(mpf(0), mpf(0), 10, [(mpf(10), 3 / (1 + mpf(1) / 2))])[:1], KEEP),
    "h1-on-a-course": (lambda: oscillator(3, 0, 3, 10)[:1] + stepped(mpf(0), mpf(0), 10, [(mpf(10), -1)])[:1], KEEP),
    "h2-bead-on-spoke": (lambda: (lambda s: [s * m.cos(5), s * m.sin(5)])(exponential([[0, 1], [1, 0]], [1, 0], 5)[0]), KEEP),
    "h3-breathing-circle": (breathing, KEEP),
    "h4-given-acceleration": (lambda: oscillator(1, 1, 0, 20)[:1] + stepped(mpf(0), mpf(1), 20, [(mpf(20), 0)])[:1], KEEP),
    "i1-resonance": (lambda: [duhamel(m.sin, m.cos, m.linspace(0, 500, 501))], KEEP),
    "i2-fast": (lambda: driven(30000, 3), KEEP),
    "i3-chirp": (lambda: [duhamel(lambda s: s, lambda s: 2 * m.cos(s * s) - 4 * s * s * m.sin(s * s),
                                  [m.sqrt(k) for k in range(401)])], KEEP),
    "i4-pulse": (lambda: [duhamel(k, lambda s: 1000 / m.sqrt(m.pi) * m.exp(-(1000 * (s - 2)) ** 2),
                                  [0] + [2 + mpf(z) / 1000 for z in range(-12, 13)] + [5])
                          for k in (lambda s: s, lambda s: 1)], KEEP),
    "i5-lorentzian": (lambda: [duhamel(lambda s: 1, lambda s: mpf("1e-6") / m.pi / ((s - 1) ** 2 + mpf("1e-12")),
                                       sorted([mpf(0), mpf(1), mpf(4)] + [1 + g * mpf(10) ** -k for k in range(1, 8) for g in (1, -1)]))],
                      KEEP),
    "i6-beats": (lambda: driven("1.001", 3000), KEEP),
    "i7-root-of-time": (lambda: [m.quad(lambda u: 2 * m.sin(5 - u * u) * u * u, m.linspace(0, m.sqrt(5), 9))], KEEP),
    "i8-tenth-root-of-time": (lambda: [m.quad(lambda u: 10 * (5 - u ** 10) * u ** 10, [0, mpf(5) ** (mpf(1) / 10)])], KEEP),
    "j1-relativistic": (lambda: numbers(lambda s, y: vector(y[1] / np.sqrt(1 + y[1] ** 2), L(1)), [0, 0], 100, component(0)),
                        FINE),
    "j2-cyclotron": (lambda: list(m.expm(matrix([[0, 0, 1, 0, 0], [0, 0, 0, 1, 0], [0, 0, 0, 100, 1], [0, 0, -100, 0, 0],
                                                 [0, 0, 0, 0, 0]]) * 20, method="taylor")[:2, 4]), KEEP),
    "j3-toda": (lambda: numbers(lambda s, y: vector(y[1], -np.exp(2 * y[0])), [0, 0], 6, component(0)), FINE),
    "j4-rocket": (lambda: [duhamel(lambda s: s, lambda s: 2 / (10 - s), [0, 5, 8, 9]), duhamel(lambda s: 1, lambda s: 2 / (10 - s), [0, 5, 8, 9])],
                  KEEP),
    "j5-geodesic": (lambda: numbers(lambda s, y: vector(y[2], y[3], 2 * y[2] * y[3] / y[1], (y[3] ** 2 - y[2] ** 2) / y[1]),
                                    [0, 1, 1, 0], 8, component(0), component(1)), FINE),
    "j6-inverse-cube": (lambda: (lambda p: [m.sqrt(p[0] ** 2 + p[1] ** 2), m.atan2(p[1], p[0])])(
        central(-3, 4, [1, 0, 0, 1], 50)), "1e-14"),
    "j7-far-exponentials": (lambda: numbers(lambda s, y: vector(y[1], -1 / (1 + 2 * np.exp(-y[0]))), [900, -1], 20, component(0)),
                            FINE),
    "k1-bouncing": (bouncing, KEEP),
    "k2-graze": (lambda: oscillator(1, 1, 0, 20)[:1], KEEP),
    "k3-two-at-once": (lambda: [abs(1 - mpf(5)), abs(2 - 2 * mpf(5))], KEEP),
    "k4-kicked": (kicked, KEEP),
    "l1-amplitudes": (lambda: [pendulum(3, 1, 100), pendulum(L("0.1"), 1, 100), pendulum(1, 1, 100)], "1e-12"),
    "l2-damping": (lambda: [damped(100, 20), damped(1, 20)], KEEP),
}
