"""relays.py -- relays and dry friction at random: sliding, swings about a surface, leaving it.

As scenes.py; references in closed form, or by events in SciPy, whose error is the third that a kind returns. A run may
go on beyond the time that is asked for, which changes nothing of what is true there.
"""
import math

import mpmath as mp
from scenes import R, num

METHODS = ["", "", "", " method dop853", " method radau", " method gauss8", " method rk8pd", " method taylor", " tol 1e-10",
           " method msadams"]


def asked(rng, scene, names, T, truths, slack=0):
    """The scene with a run by some method over some span, and the values asked for at T."""
    how, span = rng.choice(METHODS), rng.choice([1, 1, 1, 1.7, 3])
    return (scene + "run 0..%s%s\n" % (mp.nstr(R(T)*R(span), 12), how)
            + "".join("value(%s, %s)\n" % (name, T) for name in names), truths, slack)


def block(force, start):
    """One particle on x."""
    return "coord x\nparticle p mass 1 at x\nforce %s on x\nstart %s\n" % (force, start)


def tooth(F, V, T):
    """u and u' at T of u'' = -F sign(u), u(0) = 0, u'(0) = V."""
    if V == 0:
        return mp.mpf(0), mp.mpf(0)
    s, V = (1 if V > 0 else -1), abs(V)
    p = T % (4*V/F)
    if p > 2*V/F:
        p, s = p - 2*V/F, -s
    return s*(V*p - F*p*p/2), s*(V - F*p)


def relay_scene(rng):
    """A relay about a place, from there with a small speed."""
    c = rng.choice([0, 1, 0.3, 5, 100, -2])
    v = rng.choice([1e-8, 1e-9, 1e-5, 0.1, 1e-3, 1e-10, 3e-8, 1e-7, 1e-12])
    F, way = rng.choice([1, 1, 2, 0.5, 9.81]), rng.choice([1, -1])
    T = rng.choice([1, 0.5, 2, 10]) if v < 1e-6 or v > 1e-4 else rng.choice([0.002, 0.01])
    u, w = tooth(R(F), way*R(v), R(T))
    return asked(rng, block("-%s*sign(x - %s)" % (F, c), "x = %s, x' = %s" % (c, way*v)), ["x", "x'"], T, [R(c) + u, w])


def relayfar_scene(rng):
    """A relay about a place, from rest beside it."""
    c, a, F, T = rng.choice([0, 1, 0.3, 5]), num(rng, 0.1, 1), num(rng, 0.5, 3), num(rng, 1, 30)
    u, w = tooth(R(F), mp.sqrt(2*R(F)*R(a)), R(T) + mp.sqrt(2*R(a)/R(F)))
    return asked(rng, block("-%s*sign(x - %s)" % (F, c), "x = %s" % mp.nstr(R(c) + R(a), 15)), ["x", "x'"], T, [R(c) + u, w])


def plane_scene(rng):
    """Two relays in a plane."""
    T, truths, forces, start = rng.choice([0.5, 1, 3, 7]), [], [], []
    for x in "xy":
        c, F, way = rng.choice([0, 1, 5, 0.3]), rng.choice([1, 2, 0.7]), rng.choice([1, -1])
        v = rng.choice([1e-8, 3e-9, 0.1, 0.7, 1e-3, 1e-9, 0])
        u, w = tooth(R(F), way*R(v), R(T))
        truths += [R(c) + u, w]
        forces.append("-%s*sign(%s - %s)" % (F, x, c))
        start += ["%s = %s" % (x, c), "%s' = %s" % (x, way*v)]
    return asked(rng, "coord x, y\nparticle p mass 1 at (x, y)\nforce (%s) on p\nstart %s\n"
                 % (", ".join(forces), ", ".join(start)), ["x", "x'", "y", "y'"], T, truths)


def decay_scene(rng):
    """A relay with drag: its swings die out."""
    c, b, F = rng.choice([0, 1, 3]), rng.choice([0.1, 0.5, 1, 2]), rng.choice([1, 2, 0.5])
    V, T = num(rng, 0.1, 1, 3), num(rng, 0.5, 15, 2)
    B, A, t, v, way = R(b), R(F), mp.mpf(0), R(V), 1
    for _ in range(4000):
        k = v + A/B  # u' = k exp(-b t) - F/b from u = 0 with v

        def u(s):
            return k/B*(1 - mp.exp(-B*s)) - A/B*s

        first = 2*v/A*(1 - B*v/A/3)
        s = mp.findroot(u, first) if v > mp.mpf("1e-25") else first
        if s < v/A:
            s = mp.findroot(u, (v/A, 4*v/A), solver="anderson")
        if t + s >= R(T):
            s = R(T) - t
            return asked(rng, block("-%s*sign(x - %s) - %s*x'" % (F, c, b), "x = %s, x' = %s" % (c, V)), ["x", "x'"], T,
                         [R(c) + way*u(s), way*(k*mp.exp(-B*s) - A/B)])
        v, t, way = -(k*mp.exp(-B*s) - A/B), t + s, -way
    return decay_scene(rng)


def ramp_scene(rng):
    """Dry friction against a force that grows: the block stops, sticks, leaves."""
    mu, a, v0, x0 = num(rng, 0.5, 2, 2), num(rng, 0.05, 0.5, 2), num(rng, -0.8, 0, 2), rng.choice([0, 1, 10])
    M, A, t, x, v = R(mu), R(a), mp.mpf(0), R(x0), R(v0)
    if v0 < 0:
        t = (-M + mp.sqrt(M*M - 2*A*v))/A
        x += v*t + M*t*t/2 + A*t**3/6
    T = round(num(rng, 0.3, 2, 2)*float(M/A), 2)
    if R(T) < t:
        truths = [R(x0) + v*R(T) + M*R(T)**2/2 + A*R(T)**3/6, v + M*R(T) + A*R(T)**2/2]
    else:
        d = max(R(T) - M/A, 0)
        truths = [x + A*d**3/6, A*d*d/2]
    return asked(rng, block("-%s*sign(x') + %s*t" % (mu, a), "x = %s, x' = %s" % (x0, v0)), ["x", "x'"], T, truths)


def belt_scene(rng):
    """A block on a belt, held by a spring: it sticks until the spring is as strong as friction, and swings from then on."""
    w, mu, k, T = num(rng, 0.1, 1, 2), num(rng, 0.3, 1.5, 2), rng.choice([1, 2, 4]), num(rng, 1, 20, 2)
    x0 = round(num(rng, -0.9, 0.9, 2)*mu/k, 3)
    W, o, edge = R(w), mp.sqrt(R(k)), R(mu)/R(k)
    d = R(T) - (edge - R(x0))/W
    truths = [R(x0) + W*R(T), W] if d <= 0 else [edge + W/o*mp.sin(o*d), W*mp.cos(o*d)]
    return asked(rng, "coord x\nparticle p mass 1 at x\npotential %s*x^2/2\nforce -%s*sign(x' - %s) on x\nstart x = %s, x' = %s\n"
                 % (k, mu, w, x0, w), ["x", "x'"], T, truths)


def sink_scene(rng):
    """A relay in the velocity: the motion reaches its surface and slides along it."""
    c, q, F = rng.choice([0.5, 1, 2]), rng.choice([0, 1, 3]), rng.choice([5, 10, 20])
    u, v = num(rng, 0.3, 1, 2), num(rng, -0.5, 0.5, 2)
    way = 1 if R(v) + R(c)*R(u) > 0 else -1
    b = way*R(c)*R(v) - R(F)  # how far from the surface: |v + c u| + b t - c F t^2/2, 0 from the start on or once later
    ts = (b + mp.sqrt(b*b + 2*R(c)*R(F)*abs(R(v) + R(c)*R(u))))/(R(c)*R(F))
    there = R(u) + R(v)*ts - way*R(F)*ts*ts/2
    T = mp.nstr(ts + R(num(rng, 0.5, 4, 2)), 6)
    left = there*mp.exp(-R(c)*(R(T) - ts))
    return asked(rng, block("-%s*sign(x' + %s*(x - %s))" % (F, c, q), "x = %s, x' = %s" % (mp.nstr(R(q) + R(u), 12), v)),
                 ["x", "x'"], T, [R(q) + left, -R(c)*left])


def friction_scene(rng):
    """A block that dry friction stops."""
    v, mu, x0 = num(rng, 0.1, 5, 3)*rng.choice([1, -1]), num(rng, 0.1, 2, 3), rng.choice([0, 1, 100, 5.5])
    stop, way = abs(R(v))/R(mu), 1 if v > 0 else -1
    T = mp.nstr(stop*rng.choice([mp.mpf("0.5"), mp.mpf("1.5"), 3]), 6)
    t = min(stop, R(T))
    return asked(rng, block("-%s*sign(x')" % mu, "x = %s, x' = %s" % (x0, v)), ["x", "x'"], T,
                 [R(x0) + R(v)*t - way*R(mu)*t*t/2, R(v) - way*R(mu)*t])


def leave_scene(rng):
    """At rest on the place of a relay until a force that grows is as strong as it."""
    c, F, b, way = rng.choice([0, 1, 7]), num(rng, 0.5, 2, 2), num(rng, 0.2, 1, 2), rng.choice([1, -1])
    T = round(num(rng, 0.3, 2.5, 2)*F/b, 2)
    d = max(R(T) - R(F)/R(b), 0)
    return asked(rng, block("-%s*sign(x - %s) + (%s)*t" % (F, c, way*b), "x = %s" % c), ["x", "x'"], T,
                 [R(c) + way*R(b)*d**3/6, way*R(b)*d*d/2])


def chatterleave_scene(rng):
    """The same entered with a speed: followed here crossing by crossing, in doubles of u."""
    c, F, b = rng.choice([0, 1, 7]), rng.choice([1, 0.8]), rng.choice([0.5, 1])
    v = rng.choice([1e-3, 1e-4, 3e-5, 1e-5, 3e-6])
    T, t, w, s = round(num(rng, 0.4, 1.7, 2)*F/b, 2), 0.0, v, 1
    while True:
        A = b*t - s*F  # u = w d + A d^2/2 + b d^3/6
        D, d = A*A/4 - 4*w*b/6, None
        if D >= 0:
            q = -(A/2 + math.copysign(math.sqrt(D), A/2))/2
            d = min([x for x in (w/q if q else 0, q/(b/6)) if x > 0], default=None)
        if d is None or t + d >= T:
            d = T - t
            return asked(rng, block("-%s*sign(x - %s) + %s*t" % (F, c, b), "x = %s, x' = %s" % (c, v)), ["x", "x'"], T,
                         [R(c) + mp.mpf(w*d + A*d*d/2 + b*d**3/6), mp.mpf(w + A*d + b*d*d/2)], 1e-13)
        w, t = w + A*d + b*d*d/2, t + d
        s = 1 if w > 0 else -1


def blocks_scene(rng):
    """Two blocks with friction and springs, a drive on the second; sticks and slips by SciPy's events."""
    from scipy.integrate import solve_ivp
    mu, k, q = [num(rng, 0.1, 0.8, 2), num(rng, 0.1, 0.8, 2)], rng.choice([1, 2, 5]), rng.choice([0, 1, 2])
    A, w, T = rng.choice([0, 0, 1, 2]), rng.choice([0.5, 1.3, 2]), num(rng, 2, 8, 1)
    start = [num(rng, -1, 1, 2) for _ in range(4)]

    def load(t, y, i):
        return k*(y[1] - y[0]) - q*y[0] if i == 0 else -k*(y[1] - y[0]) + A*math.sin(w*t)

    def side(t, y, i):
        return 0 if abs(load(t, y, i)) < mu[i] else math.copysign(1, load(t, y, i))

    def change(i, moves):
        def event(t, y):
            return y[2 + i] if moves else mu[i] - abs(load(t, y, i))
        event.terminal, event.direction = True, -moves if moves else -1
        return event

    t, y = 0.0, list(start)
    ways = [math.copysign(1, y[2 + i]) if y[2 + i] else side(t, y, i) for i in range(2)]
    for _ in range(300):
        s = solve_ivp(lambda t, y: [y[2] if ways[0] else 0, y[3] if ways[1] else 0]
                      + [load(t, y, i) - mu[i]*ways[i] if ways[i] else 0.0 for i in range(2)], (t, T), y, method="DOP853",
                      rtol=1e-13, atol=1e-14, events=[change(i, ways[i]) for i in range(2)], max_step=0.05)
        t, y = s.t[-1], list(s.y[:, -1])
        if s.status != 1 or t >= T - 1e-14:
            break
        for i in range(2):
            if len(s.t_events[i]):
                y[2 + i] = 0.0
                ways[i] = side(t, y, i) if ways[i] else math.copysign(1, load(t, y, i))
    else:
        return blocks_scene(rng)
    return asked(rng, "coord x, y\nparticle p mass 1 at x\nparticle q mass 1 at y\npotential %s*(y - x)^2/2 + %s*x^2/2\n"
                 "force -%s*sign(x') on x\nforce -%s*sign(y') + %s*sin(%s*t) on y\nstart x = %s, y = %s, x' = %s, y' = %s\n"
                 % (k, q, *mu, A, w, *start), ["x", "y", "x'", "y'"], T, [mp.mpf(v) for v in y], 3e-9)


KINDS = {name[:-6]: kind for name, kind in list(globals().items()) if name.endswith("_scene")}
