"""scenes.py -- random scenes with events and switches, and what is true of them.

Closed forms, or collisions one by one. A kind draws its numbers from rng and gives a script, which ends with the
values that are asked for, these values in 50 digits, and the error of these where they are less exact, relative to
max(1, |value|). A further kind is a further function NAME_scene; relays.py, nested.py and contacts.py have more.
"""
import re

import mpmath as mp

mp.mp.dps = 50


def R(x):
    """A number as a script has it, exactly."""
    return mp.mpf(repr(x)) if not isinstance(x, str) else mp.mpf(x)


def num(rng, a, b, d=4):
    """A random decimal number."""
    return round(rng.uniform(a, b), d)


def bounce_ref(h, v, e, g, H, T):
    """Height and velocity at T of a ball that falls from h with v on a table at H."""
    t = mp.mpf(0)
    y = h - H
    for _ in range(200000):
        s = (v + mp.sqrt(v*v + 2*g*y))/g
        if t + s >= T:
            s = T - t
            return H + y + v*s - g*s*s/2, v - g*s
        v = -e*(v - g*s)
        y = mp.mpf(0)
        t += s
        if v < mp.mpf(10)**-30:
            return H, mp.mpf(0)
    return None, None


def rest_scene(rng):
    """A ball above a table at height H bounces with factor e until it rests."""
    H = rng.choice([0, 1, 1, 3, 0.1, 7.3, 100, -2, 1000])
    e = rng.choice([0.9, 0.5, 0.8, 0.95, 0.3, 0.7, 0.99])
    g = rng.choice([9.81, 1, 10])
    up = num(rng, 0, 2)
    v0 = num(rng, -1, 3)
    if up == 0:
        up = 0.5
    h0 = '%s' % mp.nstr(R(H) + R(up), 15)
    g_, e_, H_ = R(g), R(e), R(H)
    v = mp.sqrt(R(v0)**2 + 2*g_*R(up))
    tfirst = (R(v0) + v)/g_
    trest = tfirst + 2*v*e_/g_/(1-e_)
    T = rng.choice([trest*mp.mpf('0.7'), trest*mp.mpf('0.95'), trest*mp.mpf('1.2'), trest*3])
    T = '%s' % mp.nstr(T, 6)
    ref, rv = bounce_ref(R(h0), R(v0), e_, g_, H_, R(T))
    s = ("coord h\n"
         "particle b mass 1 at h\n"
         "gravity -%s\n"
         "start h = %s, h' = %s\n"
         "event floor: h = %s falling then h' = -%s*h'\n"
         "run 0..%s\n"
         "value(h, %s)\n"
         "value(h', %s)\n"
         % (g, h0, v0, H, e, T, T, T))
    return s, [ref, rv]


def chain_scene(rng):
    """Elastic collisions of free masses with each other and a wall."""
    n = rng.choice([2, 2, 3])
    m = [1] + [rng.choice([1, 3, 100, 1e4, 1e6, 0.5]) for _ in range(n-1)]
    if n == 2:
        m[1] = rng.choice([1, 3, 16, 100, 1e4, 1e6, 1e8])
    else:
        m[1:] = [rng.choice([1, 2, 3, 10]) for _ in range(n-1)]
    x = [i+1 for i in range(n)]
    v = [0]*(n-1) + [-1]
    T = num(rng, 3, 12, 3)
    X = [R(a) for a in x]
    V = [R(a) for a in v]
    M = [R(repr(a)) for a in m]
    t = mp.mpf(0)
    cnt = 0
    while True:
        best = None
        if V[0] < 0:
            best = (-X[0]/V[0], -1)
        for i in range(n-1):
            if V[i] > V[i+1]:
                d = (X[i+1]-X[i])/(V[i]-V[i+1])
                if best is None or d < best[0] - mp.mpf(10)**-40:
                    best = (d, i)
        if best is None or t + best[0] >= R(T):
            break
        d, i = best
        t += d
        X = [X[k]+V[k]*d for k in range(n)]
        cnt += 1
        if i < 0:
            V[0] = -V[0]
            X[0] = mp.mpf(0)
        else:
            a, b = V[i], V[i+1]
            ma, mb = M[i], M[i+1]
            V[i] = ((ma-mb)*a + 2*mb*b)/(ma+mb)
            V[i+1] = ((mb-ma)*b + 2*ma*a)/(ma+mb)
            X[i+1] = X[i]
        if cnt > 60000:
            break
    d = R(T) - t
    X = [X[k]+V[k]*d for k in range(n)]
    s = 'coord ' + ', '.join('x%d' % i for i in range(n)) + '\n'
    for i in range(n):
        s += 'particle p%d mass %s at x%d\n' % (i, repr(m[i]).replace('e+0','e'), i)
    s += 'event wall: x0 = 0 falling then x0\' = -x0\'\n'
    for i in range(n-1):
        a, b = repr(m[i]), repr(m[i+1])
        s += ("event hit%d: x%d - x%d = 0 falling then x%d' = ((%s - %s)*x%d' + 2*%s*x%d')/(%s + %s), "
             "x%d' = ((%s - %s)*x%d' + 2*%s*x%d')/(%s + %s)\n"
             % (i, i+1, i, i, a, b, i, b, i+1, a, b, i+1, b, a, i+1, a, i, a, b))
    s += "start " + ", ".join("x%d = %d, x%d' = %d" % (i, x[i], i, v[i]) for i in range(n))
    s += "\nrun 0..%s\n" % T
    for i in range(n):
        s += 'value(x%d, %s)\n' % (i, T)
    return s, X


def cradle_scene(rng):
    """Equal masses that touch, each on a spring of its own: blows go through."""
    n = rng.choice([3, 4, 5])
    A = num(rng, 0.1, 1)
    w = rng.choice([1, 2, 3.3])
    T = num(rng, 0.1, 10, 3)
    # the first until a quarter of its period, then the last for half a period, then the first
    q = mp.pi/2/R(w)
    ph = R(T) % (4*q)
    u = [mp.mpf(0)]*n
    if ph < q or ph >= 3*q:
        u[0] = -R(A)*mp.cos(R(w)*ph)
    else:
        u[n-1] = -R(A)*mp.cos(R(w)*ph)
    s = ("coord u[k] for k = 1..%d\n"
         "particle p[k] mass 1 at u[k] for k = 1..%d\n"
         "potential %s^2*u[k]^2/2 for k = 1..%d\n"
         % (n, n, w, n))
    for i in range(1, n):
        s += ("event e%d: u[%d] - u[%d] = 0 rising then u[%d]' = u[%d]', u[%d]' = u[%d]'\n"
             % (i, i, i+1, i, i+1, i+1, i))
    s += 'start u[1] = -%s\nrun 0..%s\n' % (A, T)
    for i in range(1, n+1):
        s += 'value(u[%d], %s)\n' % (i, T)
    return s, u


def elastic_scene(rng):
    """A ball that bounces for ever."""
    h = rng.choice([0.001, 0.01, 1, 0.1])
    H = rng.choice([0, 0, 1, 5])
    T = rng.choice([100, 300, 33.3])
    if h == 0.001:
        T = rng.choice([30, 100])
    g = R('9.81')
    hh = R(repr(h))
    q = mp.sqrt(2*hh/g)
    ph = (R(repr(T)) + q) % (2*q) - q
    h0 = mp.nstr(R(H)+hh, 15)
    s = ("coord h\n"
         "particle b mass 1 at h\n"
         "gravity -9.81\n"
         "start h = %s\n"
         "event floor: h = %s falling then h' = -h'\n"
         "run 0..%s\n"
         "value(h, %s)\n"
         "value(h', %s)\n"
         % (h0, H, T, T, T))
    return s, [R(H) + hh - g*ph*ph/2, -g*ph]


def double_scene(rng):
    """Two crossings d apart."""
    a = num(rng, 0.5, 4, 3)
    d = rng.choice([1e-3, 1e-5, 1e-6, 1e-7, 1e-8, 1e-4])
    b = mp.nstr(R(a)+R(repr(d)), 15)
    s = ("coord x\n"
         "particle p mass 1 at x\n"
         "start x' = 1\n"
         "event e: (x - %s)*(x - %s) = 0\n"
         "run 0..5\n"
         "e[1]\n"
         "e[2]\n"
         % (a, b))
    return s, [R(a), R(b)]


def doublecos_scene(rng):
    """x of cos t through 1 - d."""
    d = rng.choice([1e-4, 1e-8, 1e-10, 1e-12, 1e-14, 1e-16, 3e-16])
    n = rng.choice([1, 1, 2])
    t = mp.acos(1-R(repr(d)))
    s = ("coord x\n"
         "particle p mass 1 at x\n"
         "potential x^2/2\n"
         "start x = 1\n"
         "event e: x = 1 - %s rising\n"
         "run 0..10\n"
         "e[1]\n"
         % d)
    return s, [2*mp.pi - t]


def starton_scene(rng):
    """An oscillator that starts on its event."""
    c = num(rng, -0.9, 0.9, 3)
    v = num(rng, 0.2, 1.5, 3) * rng.choice([1, -1])
    way = rng.choice(['', 'rising', 'falling'])
    # x = c cos t + v sin t ; x = c again at t=2 phi, phi = atan2(v, c)
    phi = mp.atan2(R(v), R(c))
    t1 = (2*phi) % (2*mp.pi)
    t2 = 2*mp.pi
    first = -1 if v > 0 else 1
    ts = [(t1, first), (t2, -first), (t1 + 2*mp.pi, first), (4*mp.pi, -first)]
    ts = [t for t, s_ in ts if way == '' or (way == 'rising') == (s_ > 0)]
    s = ("coord x\n"
         "particle p mass 1 at x\n"
         "potential x^2/2\n"
         "start x = %s, x' = %s\n"
         "event e: x = %s %s\n"
         "run 0..14\n"
         % (c, v, c, way))
    for i in range(2):
        s += 'e[%d]\n' % (i+1)
    return s, ts[:2]


def nothing_scene(rng):
    """An event that changes nothing."""
    tol = rng.choice(['1e-12', '1e-15', '1e-14'])
    w = num(rng, 0.5, 3, 3)
    T = num(rng, 5, 40, 2)
    A = num(rng, 0.3, 1.5, 3)
    ev = rng.choice(['x = 0.1 then x\' = x\'', 'x = 0', 'x\' = 0.2 rising', 'x = -0.2 falling then x\' = x\''])
    s = ("coord x\n"
         "particle p mass 1 at x\n"
         "potential %s^2*x^2/2\n"
         "start x = %s\n"
         "event e: %s\n"
         "run 0..%s tol %s\n"
         "value(x, %s)\n"
         "value(x', %s)\n"
         % (w, A, ev, T, tol, T, T))
    return s, [R(A)*mp.cos(R(w)*R(T)), -R(w)*R(A)*mp.sin(R(w)*R(T))]


def drive_scene(rng):
    """A drive, turned about at a given time."""
    w = rng.choice([0.1, 1, 0.5, 2])
    t0 = num(rng, 1, 100, 2)
    T = t0 + num(rng, 1, 20, 2)
    a = num(rng, 0.2, 2, 2)
    # x'' = a sin(w t), x(0)=0,x'(0)=0: x = a t/w - a sin(wt)/w^2 ; at t0: x' = -x'
    W, A = R(w), R(a)
    tt = R(t0)
    TT = R(mp.nstr(mp.mpf(repr(t0)) + 0, 15))
    T = mp.nstr(R(repr(round(T, 2))), 15)
    X = lambda t: A*t/W - A*mp.sin(W*t)/W**2
    V = lambda t: A/W - A*mp.cos(W*t)/W
    x0, v0 = X(tt), V(tt)
    d = R(T) - tt
    x = x0 + (X(R(T)) - x0 - V(tt)*d) + (-v0)*d
    v = -v0 + V(R(T)) - v0
    s = ("coord x\n"
         "particle p mass 1 at x\n"
         "force %s*sin(%s*t) on x\n"
         "event e: t = %s then x' = -x'\n"
         "run 0..%s\n"
         "value(x, %s)\n"
         "value(x', %s)\n"
         % (a, w, t0, T, T, T))
    return s, [x, v]


def plates_scene(rng):
    """A block pushed against another: bounces without end, then one motion."""
    m, M = rng.choice([1, 2, 3]), rng.choice([1, 5, 0.5])
    f = num(rng, 0.5, 3, 2)
    e = rng.choice([0.5, 0.7, 0.3, 0.8])
    gap = num(rng, 0.1, 1, 2)
    x0 = rng.choice([0, 0, 2])
    # r = y - x has r'' = -f/m, the centre of mass the acceleration f/(m + M)
    mm, MM, ff, ee = R(m), R(M), R(f), R(e)
    a = ff/mm
    trest = mp.sqrt(2*R(gap)/a)*(1 + 2*ee/(1-ee))
    T = mp.nstr(trest*rng.choice([mp.mpf('0.6'), mp.mpf('1.3'), 3]), 6)
    r, rv = bounce_ref(R(gap), mp.mpf(0), ee, a, mp.mpf(0), R(T))
    cm = (mm*R(x0) + MM*(R(x0)+R(gap)))/(mm+MM) + ff/(mm+MM)*R(T)**2/2
    x = cm - MM*r/(mm+MM)
    y = x + r
    s = ("coord x, y\n"
         "particle b mass %s at x\n"
         "particle c mass %s at y\n"
         "force %s on x\n"
         "event hit: y - x = 0 falling then x' = (%s*x' + %s*y' + %s*%s*(y' - x'))/(%s + %s), y' "
         "= (%s*x' + %s*y' - %s*%s*(y' - x'))/(%s + %s)\n"
         "start x = %s, y = %s\n"
         "run 0..%s\n"
         "value(x, %s)\n"
         "value(y, %s)\n"
         % (m, M, f, m, M, M, e, m, M, m, M, m, e, m, M, x0, mp.nstr(R(x0)+R(gap), 12), T, T, T))
    return s, [x, y]


def ball():
    """The lines of one particle on x."""
    return "coord x\nparticle p mass 1 at x\n"


def movingwall_scene(rng):
    """A ball between a wall at rest and one that comes or goes, elastic."""
    L, u, v, T = num(rng, 1, 3, 2), num(rng, -0.2, 0.3, 2), num(rng, 0.5, 3, 2), num(rng, 2, 8, 2)
    T = min(T, round(0.8*L/abs(u), 2)) if u < 0 else T
    x, w, t = R(L)/2, R(v), mp.mpf(0)
    while True:
        hits = [d for d in ((-x/w, 0) if w < 0 else None, ((R(L) + R(u)*t - x)/(w - R(u)), 1) if w > R(u) else None) if d]
        d, right = min(hits) if hits else (mp.inf, 0)
        if t + d >= R(T):
            d = R(T) - t
            return (ball() + "event left: x = 0 falling then x' = -x'\nevent right: x = %s + %s*t rising then x' = 2*%s - x'\n"
                    "start x = %s/2, x' = %s\nrun 0..%s\nvalue(x, %s)\nvalue(x', %s)\n" % (L, u, u, L, v, T, T, T)), [x + w*d, w]
        x, t = x + w*d, t + d
        w = 2*R(u) - w if right else -w


def oblique_scene(rng):
    """A ball thrown obliquely: each bounce takes e of one velocity and m of the other, both parameters."""
    e, m, g = num(rng, 0.4, 0.95, 2), num(rng, 0.5, 1, 2), rng.choice([1, 9.81, 10])
    a, b, T = num(rng, -2, 2, 2), num(rng, 1, 4, 2), num(rng, 0.3, 3, 2)
    x, y, vx, vy, t = mp.mpf(0), mp.mpf(1), R(a), R(b), mp.mpf(0)
    for _ in range(400):
        d = (vy + mp.sqrt(vy*vy + 2*R(g)*y))/R(g)
        if t + d >= R(T) or vy < mp.mpf(10)**-30 and y == 0:
            d = R(T) - t
            break
        x, y, vy, t = x + vx*d, mp.mpf(0), -R(e)*(vy - R(g)*d), t + d
        vx *= R(m)
    rests = y == 0 and vy < mp.mpf(10)**-30
    if rests:  # what the rest of the bounces leaves of vx depends on how many there are
        return oblique_scene(rng)
    return ("param e = %s, m = %s\ncoord x, y\nparticle p mass 1 at (x, y)\ngravity (0, -%s)\n"
            "event floor: y = 0 falling then x' = m*x', y' = -e*y'\nstart x' = %s, y = 1, y' = %s\nrun 0..%s\n"
            "value(x, %s)\nvalue(y, %s)\n" % (e, m, g, a, b, T, T, T)), [x + vx*d, y + vy*d - R(g)*d*d/2]


def box_scene(rng):
    """Two balls of different masses in a box, elastic."""
    M, L, T = rng.choice([1, 2, 3, 7, 100]), num(rng, 1.5, 4, 2), num(rng, 3, 15, 2)
    v, w = num(rng, -2, 2, 2), num(rng, -2, 2, 2)
    x, y, V, W, t, m = R(L)/4, 3*R(L)/4, R(v), R(w), mp.mpf(0), R(M)
    while True:
        hits = [(mp.inf, 3)]
        if V < 0:
            hits.append((-x/V, 0))
        if W > 0:
            hits.append(((R(L) - y)/W, 1))
        if V > W:
            hits.append(((y - x)/(V - W), 2))
        d, what = min(hits)
        if t + d >= R(T):
            d = R(T) - t
            break
        x, y, t = x + V*d, y + W*d, t + d
        if what == 0:
            V = -V
        elif what == 1:
            W = -W
        else:
            V, W = ((1 - m)*V + 2*m*W)/(1 + m), ((m - 1)*W + 2*V)/(1 + m)
    return ("coord x, y\nparticle p mass 1 at x\nparticle q mass %s at y\nevent a: x = 0 falling then x' = -x'\n"
            "event b: y = %s rising then y' = -y'\nevent c: y - x = 0 falling then x' = ((1 - %s)*x' + 2*%s*y')/(1 + %s), "
            "y' = ((%s - 1)*y' + 2*x')/(1 + %s)\nstart x = %s/4, y = 3*%s/4, x' = %s, y' = %s\nrun 0..%s\nvalue(x, %s)\n"
            "value(y, %s)\n" % (M, L, M, M, M, M, M, L, L, v, w, T, T, T)), [x + V*d, y + W*d]


def startimpact_scene(rng):
    """A ball that starts on the floor and moves into it."""
    H, e, v, T = rng.choice([0, 0, 1, 7.3]), num(rng, 0.3, 1, 2), num(rng, 0.5, 4, 2), num(rng, 0.05, 2, 2)
    y, w = bounce_ref(R(H), R(e)*R(v), R(e), mp.mpf(10), R(H), R(T))
    return ("coord h\nparticle b mass 1 at h\ngravity -10\nevent floor: h = %s falling then h' = -%s*h'\n"
            "start h = %s, h' = -%s\nrun 0..%s\nvalue(h, %s)\n" % (H, e, H, v, T, T)), [y]


def atonce_scene(rng):
    """A relay, and an event at its surface that changes the speed there."""
    F, k, v, T = num(rng, 0.5, 3, 2), num(rng, 1, 1.3, 2), num(rng, 0.5, 2, 2), num(rng, 1, 8, 2)
    x, w, s, t = mp.mpf(0), R(v), 1, mp.mpf(0)
    while True:
        d = 2*abs(w)/R(F)
        if t + d >= R(T):
            d = R(T) - t
            break
        t += d
        w = -w*R(k)
        s = -s
    return (ball() + "force -%s*sign(x) on x\nevent e: x = 0 then x' = %s*x'\nstart x' = %s\nrun 0..%s\nvalue(x, %s)\n"
            "value(x', %s)\n" % (F, k, v, T, T, T)), [w*d - s*R(F)*d*d/2, w - s*R(F)*d]


def thenparam_scene(rng):
    """Each bounce changes the gravity."""
    q, T, h = num(rng, 0.7, 1, 2), num(rng, 1, 5, 2), num(rng, 0.3, 2, 2)
    y, w, g, t = R(h), mp.mpf(0), mp.mpf(10), mp.mpf(0)
    while True:
        d = (w + mp.sqrt(w*w + 2*g*y))/g
        if t + d >= R(T):
            d = R(T) - t
            break
        y, w, t = mp.mpf(0), -(w - g*d), t + d
        g *= R(q)
    return ("param g = 10\ncoord h\nparticle b mass 1 at h\ngravity -g\nevent floor: h = 0 falling then h' = -h', g = %s*g\n"
            "start h = %s\nrun 0..%s\nvalue(h, %s)\nvalue(h', %s)\n" % (q, h, T, T, T)), [y + w*d - g*d*d/2, w - g*d]


def terminal_scene(rng):
    """An event at the end of the run, and a stop."""
    w, A, k = num(rng, 0.5, 3, 2), num(rng, 0.3, 2, 2), num(rng, -2, 2, 2)
    if rng.random() < 0.5:
        T = num(rng, 1, 9, 2)
        return (ball() + "potential %s^2*x^2/2\nevent e: t = %s then x' = %s*x'\nstart x = %s\nrun 0..%s\nvalue(x, %s)\n"
                "value(x', %s)\n" % (w, T, k, A, T, T, T)), [R(A)*mp.cos(R(w)*R(T)), -R(k)*R(A)*R(w)*mp.sin(R(w)*R(T))]
    c = num(rng, -0.9, 0.9, 2)
    return (ball() + "potential %s^2*x^2/2\nevent e: x = %s*%s rising stop\nstart x = %s\nrun 0..100\ne[1]\n"
            % (w, c, A, A)), [(2*mp.pi - mp.acos(R(c)))/R(w)]


def between_ref(g, e, L, v, T):
    """Place and velocity at T of a ball that starts in the middle of |x| < L with v, with the acceleration -g and e < 1."""
    x, t = mp.mpf(0), mp.mpf(0)
    while True:
        hits = []
        for wall in (L, -L):
            D = v*v - 2*g*(wall - x)
            for sign in (1, -1) if D >= 0 else ():
                d = (v + sign*mp.sqrt(D))/g
                if d > mp.mpf(10)**-40 and wall*(v - g*d) > 0:
                    hits.append((d, wall))
        d, wall = min(hits)
        if t + d >= T:
            d = T - t
            return x + v*d - g*d*d/2, v - g*d
        x, t, v = wall, t + d, -e*(v - g*d)
        if abs(v) < mp.mpf(10)**-25:
            return -L, mp.mpf(0)


def walls_scene(rng):
    """A ball between two walls that are one event, pulled to one of them: it comes to rest there."""
    e, g, L = num(rng, 0.2, 0.95, 2), rng.choice([1, 2.5, 9.81]), rng.choice([1, 0.5, 2.25])
    v, T = num(rng, -4, 4, 2), rng.choice([5, 20, 100])
    form = rng.choice(["abs(x) = %s rising", "max(x, -x) = %s rising", "if(x > 0, x, -x) = %s rising",
                       "min(x, -x) = -%s falling", "sqrt(x^2) = %s rising", "x^2 = %s^2 rising"]) % L
    return (ball() + "force -%s on x\nevent hit: %s then x' = -%s*x'\nstart x' = %s\nrun 0..%s\nvalue(x, %s)\n"
            "value(x', %s)\n" % (g, form, e, v, T, T, T)), list(between_ref(R(g), R(e), R(L), R(v), R(T)))


def platform_scene(rng):
    """A ball on a floor that moves up and down slowly enough for it to stay, before it comes to rest."""
    H, e, g = rng.choice([0, 1, 3]), num(rng, 0.3, 0.9, 2), 10
    u = num(rng, -0.3, 0.3, 2)
    v = mp.sqrt(R(u)**2 + 2*g)
    T = num(rng, 0.3, 0.97*float((v - R(u))/g + 2*v*R(e)/g/(1 - R(e))), 2)
    y, w = bounce_ref(R(1), -R(u), R(e), mp.mpf(g), mp.mpf(0), R(T))
    return ("coord h\nparticle b mass 1 at h\ngravity -%s\nevent floor: h = %s + %s*t falling then h' = %s - %s*(h' - %s)\n"
            "start h = %s + 1\nrun 0..%s\nvalue(h, %s)\nvalue(h', %s)\n" % (g, H, u, u, e, u, H, T, T, T)), [
                R(H) + R(u)*R(T) + y, R(u) + w]


def third_scene(rng):
    """A place reached with neither velocity nor force: a crossing of third order."""
    a = num(rng, 0.5, 3, 2)
    return (ball() + "force 6*(t - %s) on x\nevent e: x = 0 rising\nstart x = -(%s)^3, x' = 3*(%s)^2\nrun 0..%s + 1\ne[1]\n"
            % (a, a, a, a)), [R(a)]


KINDS = {name[:-6]: kind for name, kind in list(globals().items()) if name.endswith("_scene")}

METHODS = ("taylor", "dop853", "rk8pd", "rkf45", "radau", "msadams", "msbdf", "bsimp", "gauss4", "gauss8", "gauss12", "verlet",
           "composition8", "variational")


def by_method(script, method):
    """The script with its runs by that method; those that have one keep it."""
    return "".join(line.rstrip("\n") + " method %s\n" % method
                   if line.startswith("run ") and not re.search("method|digits", line) else line
                   for line in script.splitlines(True))
