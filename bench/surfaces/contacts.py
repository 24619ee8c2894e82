"""contacts.py -- contacts that end in sliding or in rest together, events at once, coordinates more than are free.

As scenes.py; references in closed form, or blow by blow in 50 digits.
"""
import mpmath as mp

from scenes import R, bounce_ref, num

TINY = mp.mpf(10)**-30
ANGLES = {"0": mp.mpf(0), "pi/2": mp.pi/2, "-pi/2": -mp.pi/2, "pi": +mp.pi, "pi/3": mp.pi/3}


def turn(angle):
    """Cosine and sine, exactly 0 where they are."""
    a = ANGLES[angle]
    return mp.mpf(0) if "pi/2" in angle else mp.cos(a), mp.mpf(0) if angle in ("0", "pi") else mp.sin(a)


def values(names, T):
    """The statements that ask for these at T."""
    return "".join("value(%s, %s)\n" % (name, T) for name in names)


def slope_scene(rng):
    """A ball on a slope without friction: bounces until it slides."""
    p, q, d = rng.choice([(3, 4, 5), (5, 12, 13), (0, 1, 1), (-3, 4, 5)])
    g, e, h = rng.choice(["9.81", "1", "10"]), rng.choice(["0.3", "0.5", "0.8", "0.9", "1"]), num(rng, 0.1, 1.5, 2)
    v, w, T = num(rng, -1, 1, 2), num(rng, -1, 1, 2), rng.choice(["0.6", "1.5", "4", "15"])
    s, c = mp.mpf(p)/d, mp.mpf(q)/d
    n, _ = bounce_ref(R(h)*c, -s*R(v) + c*R(w), R(e), R(g)*c, mp.mpf(0), R(T))
    along = R(h)*s + (c*R(v) + s*R(w))*R(T) - R(g)*s*R(T)**2/2
    blow = "(1 + %s)*(%s*y' - (%s)*x')/%s" % (e, q, p, d*d)
    return ("coord x, y\nparticle m mass 1 at (x, y)\ngravity (0, -%s)\nevent hit: %s*y - (%s)*x = 0 falling then "
            "x' = x' + (%s)*%s, y' = y' - %s*%s\nstart y = %s, x' = %s, y' = %s\nrun 0..%s\n"
            % (g, q, p, p, blow, q, blow, h, v, w, T) + values("xy", T)), [along*c - n*s, along*s + n*c]


def atwall_scene(rng):
    """A block that pushes another against a wall, until both rest there."""
    m, M, f = rng.choice([1, 2, 10]), rng.choice([1, 3, 0.5]), num(rng, 0.5, 5, 2)
    e, k, b = rng.choice(["0.5", "0.8", "1"]), rng.choice(["0.5", "0.7"]), num(rng, 0.6, 1.5, 2)
    T = rng.choice(["0.8", "1.7", "3", "6", "12"])
    x, y, v, w, t, a = R("0.5"), R(b), mp.mpf(0), mp.mpf(0), mp.mpf(0), R(f)/R(M)
    for _ in range(6000):
        if max(abs(x), abs(y), v*v, w*w) < mp.mpf(10)**-26:
            x = y = mp.mpf(0)
            break
        meets = (w - v + mp.sqrt((w - v)**2 + 2*a*max(y - x, 0)))/a
        d = min(meets, -x/v) if v < 0 else meets
        if t + d > R(T):
            d = R(T) - t
            x, y = x + v*d, y + w*d - a*d*d/2
            break
        x, y, w, t = x + v*d, y + w*d - a*d*d/2, w - a*d, t + d
        if d < meets:
            x, v = mp.mpf(0), -R(e)*v
        else:
            mean, by = (m*v + R(M)*w)/(m + R(M)), R(k)*(v - w)/(m + R(M))
            y, v, w = x, mean - R(M)*by, mean + m*by
    else:
        return atwall_scene(rng)
    mean = "(%s*x' + %s*y'" % (m, M)
    return ("coord x, y\nparticle p mass %s at x\nparticle q mass %s at y\nforce -%s on y\nevent wall: x = 0 falling then "
            "x' = -%s*x'\nevent c: y - x = 0 falling then x' = %s - %s*%s*(x' - y'))/(%s + %s), y' = %s + %s*%s*(x' - y'))"
            "/(%s + %s)\nstart x = 0.5, y = %s\nrun 0..%s\n" % (m, M, f, e, mean, M, k, m, M, mean, m, k, m, M, b, T)
            + values("xy", T)), [x, y]


def twoballs_scene(rng):
    """Two balls that fall side by side and are stopped at the same moment, the second a step higher."""
    g, h, H, T = rng.choice(["9.81", "1", "4"]), num(rng, 0.2, 2, 2), rng.choice([0, 1]), rng.choice(["1", "3", "9"])
    e, k = rng.choice(["0", "0.5", "0.9", "1"]), rng.choice(["0.5", "0.9", "1"])
    y, _ = bounce_ref(R(h), mp.mpf(0), R(e), R(g), mp.mpf(0), R(T))
    z, w = bounce_ref(R(h), mp.mpf(0), R(k), R(g), mp.mpf(0), R(T))
    return ("coord y, z\nparticle p mass 1 at y\nparticle q mass 2 at z\ngravity -%s\nevent a: y = 0 falling then y' = -%s*y'\n"
            "event b: z = %s falling then z' = -%s*z'\nstart y = %s, z = %s\nrun 0..%s\n"
            % (g, e, H, k, h, mp.nstr(R(h) + H, 10), T) + values(("y", "z", "z'"), T)), [y, H + z, w]


def level_scene(rng):
    """A level that each crossing moves up."""
    v, step, low = num(rng, 0.2, 2, 2), rng.choice(["0.25", "0.1", "0.5"]), rng.choice(["0", "0.3", "-0.5"])
    return ("param L\ncoord x\nparticle p mass 1 at x\nset L = %s\nstart x = -1, x' = %s\nevent e: x = L rising then L = L + %s\n"
            "run 0..20\ne[1]\ne[2]\ne[3]\n" % (low, v, step)), [(R(low) + 1 + n*R(step))/R(v) for n in range(3)]


def drag_scene(rng):
    """A ball with drag bounces until it rests."""
    c, g, e = rng.choice(["0.1", "0.5", "1"]), rng.choice(["9.81", "1"]), rng.choice(["1", "0.8", "0.5"])
    h, T = num(rng, 0.3, 2, 2), rng.choice(["1", "2.5", "6", "20"])
    C, G, x, v, t = R(c), R(g), R(h), mp.mpf(0), mp.mpf(0)

    def place(d):
        return x - G/C*d + (v + G/C)*(1 - mp.exp(-C*d))/C

    for _ in range(4000):
        if x == 0 and v < mp.mpf(10)**-14:
            v = mp.mpf(0)
            break
        a, b = (v/G, 2*v/G) if x == 0 else (mp.sqrt(2*x/G)/2, mp.sqrt(2*x/G) + 3*C*x/G + 5)
        while place(a) <= 0:
            a *= mp.mpf("0.9")
        d = mp.findroot(place, (a, b), solver="anderson", tol=mp.mpf(10)**-60)
        if t + d >= R(T):
            d = R(T) - t
            x, v = place(d), (v + G/C)*mp.exp(-C*d) - G/C
            break
        x, v, t = mp.mpf(0), -R(e)*((v + G/C)*mp.exp(-C*d) - G/C), t + d
    return ("coord y\nparticle p mass 1 at y\ngravity -%s\nforce -%s*y' on y\nevent hit: y = 0 falling then y' = -%s*y'\n"
            "start y = %s\nrun 0..%s\n" % (g, c, e, h, T) + values(("y", "y'"), T)), [x, v]


def axis(F, G, u, v, T):
    """u and u' at T of u'' = G - F sign(u'), |G| < F."""
    a = G - F*mp.sign(v)
    d = min(-v/a, T) if v else mp.mpf(0)
    return u + v*d + a*d*d/2, v + a*d if d == T else mp.mpf(0)


def turned_scene(rng):
    """Dry friction along each of two axes that are turned."""
    p, q, n = rng.choice([(3, 4, "5"), (5, 12, "13"), (1, 0, "1"), (1, 1, "sqrt(2)")])
    d = mp.sqrt(p*p + q*q)
    F, G = [num(rng, 0.5, 3, 2) for _ in "uv"], [rng.choice([0, num(rng, -0.4, 0.4, 2)]) for _ in "uv"]
    x, y, T = num(rng, -2, 2, 2), num(rng, -2, 2, 2), rng.choice(["0.5", "2.5", "12"])
    # u and w: along the axes, each with its own friction
    (u, du), (w, dw) = (axis(R(f), R(g), mp.mpf(0), v/d, R(T)) for f, g, v in
                        zip(F, G, (p*R(x) + q*R(y), p*R(y) - q*R(x))))
    f, g = ("(%s - %s*sign(%s))" % (G[i], F[i], v) for i, v in enumerate(("%s*x' + %s*y'" % (p, q), "%s*y' - %s*x'" % (p, q))))
    return ("coord x, y\nparticle m mass 1 at (x, y)\nforce ((%s*%s - %s*%s)/%s, (%s*%s + %s*%s)/%s) on m\n"
            "start x' = %s, y' = %s\nrun 0..%s\n" % (p, f, q, g, n, q, f, p, g, n, x, y, T) + values(("x", "y", "x'"), T)), [
                (p*u - q*w)/d, (q*u + p*w)/d, (p*du - q*dw)/d]


def rod_scene(rng):
    """A bead on a straight rod, upright too: one of x and y is more than is free, and vanishes at the start."""
    angle, g, v, T = rng.choice(list(ANGLES)), rng.choice(["9.81", "1"]), num(rng, -3, 3, 2), rng.choice(["1", "3"])
    c, s = turn(angle)
    z = R(v)*R(T) - R(g)*s*R(T)**2/2
    velocity = {"x": "x' = (%s)*cos(%s)" % (v, angle), "y": "y' = (%s)*sin(%s)" % (v, angle)}
    start = rng.choice([velocity["x"] + ", " + velocity["y"], velocity["y" if s else "x"]])
    return ("coord x, y\nparticle p mass 1 at (x, y)\ngravity (0, -%s)\nconstraint x*sin(%s) = y*cos(%s)\nstart %s\nrun 0..%s\n"
            % (g, angle, angle, start, T) + values("xy", T)), [z*c, z*s]


def disk_scene(rng):
    """An upright disk that rolls, its velocity given or left to the constraints."""
    r, turns, spin = rng.choice(["0.3", "1", "2"]), rng.choice([0, 0.7, -1.3, 2]), num(rng, -5, 5, 2)
    angle, T = rng.choice(list(ANGLES)), rng.choice(["1", "5", "20"])
    a, w = ANGLES[angle], R(turns)
    c, s = ((mp.sin(a + w*R(T)) - mp.sin(a))/w, (mp.cos(a) - mp.cos(a + w*R(T)))/w) if turns else (
        x*R(T) for x in turn(angle))
    given = rng.choice(["", ", x' = -%s*(%s)*cos(%s), y' = -%s*(%s)*sin(%s)" % (r, spin, angle, r, spin, angle)])
    return ("coord x, y, phi, psi\nbody disk mass 1 inertia (0.02, 0.02, 0.045) at (x, y, %s) euler(phi, pi/2, psi)\n"
            "constraint roll: velocity(disk, (x, y, 0)) = (0, 0, 0)\nstart phi = %s, phi' = %s, psi' = %s%s\nrun 0..%s\n"
            % (r, angle, turns, spin, given, T) + values("xy", T)), [-R(r)*R(spin)*c, -R(r)*R(spin)*s]


def swing_scene(rng):
    """A pendulum in x and y, from its lowest place or at rest from a given angle."""
    g, L, T = rng.choice(["9.81", "1", "4"]), rng.choice(["1", "2", "0.5"]), rng.choice(["1", "3", "7", "15"])
    o = mp.sqrt(R(g)/R(L))
    if rng.random() < 0.5:
        v = num(rng, 0.3, 6, 2)
        k = R(v)/R(L)/(2*o)
        if abs(k - 1) < 0.05:
            return swing_scene(rng)
        m = min(k, 1/k)**2
        sn, dn = (mp.ellipfun(n, o*R(T)*max(k, 1), m=m) for n in ("sn", "dn"))
        half, other = (k*sn, dn) if k < 1 else (sn, mp.ellipfun("cn", o*R(T)*k, m=m))  # sine and cosine of half the angle
        start = "x = %s*sin(0), y = -%s*cos(0), x' = %s" % (L, L, v)
    else:
        angle = rng.choice(["pi/2", "pi/3"])
        k = mp.sin(ANGLES[angle]/2)
        cn, dn = (mp.ellipfun(n, o*R(T), m=k*k) for n in ("cn", "dn"))
        half, other = k*cn/dn, mp.sqrt(1 - k*k)/dn
        start = "x = %s*sin(%s), y = -%s*cos(%s)" % (L, angle, L, angle)
    return ("coord x, y\nparticle p mass 1 at (x, y)\ngravity (0, -%s)\nconstraint x^2 + y^2 = %s^2\nstart %s\nrun 0..%s\n"
            % (g, L, start, T) + values("xy", T)), [2*R(L)*half*other, R(L)*(2*half**2 - 1)]


KINDS = {name[:-6]: kind for name, kind in list(globals().items()) if name.endswith("_scene")}
