"""cases.py -- hard cases by families, each with its reference in closed form.

    a stiff                 b long times           c chaos                d singular coordinates
    e near-degenerate,      f not smooth           g constraints          h prescribed motions (index 3)
      far from 1
    i driven                j exotic forces        k events               l scans

A case: name, scene, length of the run, what is looked at with its exact value, and methods to try
beside `auto`. Exact values are functions of no argument, evaluated by mpmath at two precisions:
closed forms (elementary, elliptic, Kepler's equation, exponentials of matrices), or energies.
`horizon`: the motion is chaotic, and only what is said to hold is looked at.
"""
from mpmath import mp, mpf, matrix, expm
import mpmath as m

CASES = []


def case(name, scene, T, values, methods=(), horizon=False, tols=("1e-6", "1e-9", "1e-12")):
    CASES.append(dict(name=name, family=name[0], scene=scene, T=T, values=values,
                      methods=list(methods), horizon=horizon, tols=list(tols)))


def fall(r0, t, mu=1):
    """Distance of a point that falls from rest at r0 into the centre and comes back, again and again."""
    a, t, mu = mpf(r0) / 2, mpf(t), mpf(mu)
    M = m.fmod(m.pi + m.sqrt(mu / a ** 3) * t, 2 * m.pi)
    E = m.findroot(lambda E: E - m.sin(E) - M, m.pi)
    return a * (1 - m.cos(E))


def linear(A, y0, t):
    """exp(A t) y0, A [n x n] and y0 [n] of texts"""
    n = len(y0)
    M = matrix(n, n)
    for i in range(n):
        for j in range(n):
            M[i, j] = mpf(A[i][j])
    return expm(M * mpf(t), method="taylor") * matrix([mpf(y) for y in y0])


def overdamped(c, k, x0, t):
    """x'' + c x' + k x = 0 from x0 at rest: x, x'"""
    c, k, x0, t = map(mpf, (c, k, x0, t))
    root = m.sqrt(c * c / 4 - k)
    slow, fast = -k / (c / 2 + root), -(c / 2 + root)
    a = x0 * fast / (fast - slow)
    b = -x0 * slow / (fast - slow)
    return a * m.exp(slow * t) + b * m.exp(fast * t), a * slow * m.exp(slow * t) + b * fast * m.exp(fast * t)


def pendulum(theta0, g, t):
    """Angle of a pendulum of length 1 that starts at rest at theta0, |theta0| < pi."""
    k = m.sin(mpf(theta0) / 2)
    w = m.sqrt(mpf(g))
    sn = m.ellipfun("sn")
    return 2 * m.asin(k * sn(m.ellipk(k * k) - w * mpf(t), m=k * k))


def kepler(a, e, t, mu=1):
    """Position of an ellipse from its pericentre on the x axis: x, y"""
    a, e, t, mu = map(mpf, (a, e, t, mu))
    n = m.sqrt(mu / a ** 3)
    M = m.fmod(n * t, 2 * m.pi)
    E = m.findroot(lambda E: E - e * m.sin(E) - M, M + e * m.sin(M) / (1 - m.sin(M + e) + m.sin(M))
                   if e < 0.9 else m.pi if M > 0.2 else (6 * M) ** (mpf(1) / 3))
    return a * (m.cos(E) - e), a * m.sqrt(1 - e * e) * m.sin(E)


# --- a: stiff ----------------------------------------------------------------------------------

case("a1-overdamped", """coord x
particle p mass 1 at x
potential x^2
force -3e5*x' on x
start x = 2""", "7", {"x": lambda: overdamped("3e5", 2, 2, 7)[0], "x'": lambda: overdamped("3e5", 2, 2, 7)[1]},
     ["bsimp", "msbdf"])
case("a2-two-scales", """coord x, y
particle p mass 1 at x
particle q mass 1 at y
potential x^2/2 + 5e4*(y - x)^2/2
start x = 1, y = 1.01""", "20", {
    "x": lambda: linear([[0, 0, 1, 0], [0, 0, 0, 1], ["-50001", "50000", 0, 0], ["50000", "-50000", 0, 0]],
                        [1, "1.01", 0, 0], 20)[0],
    "y": lambda: linear([[0, 0, 1, 0], [0, 0, 0, 1], ["-50001", "50000", 0, 0], ["50000", "-50000", 0, 0]],
                        [1, "1.01", 0, 0], 20)[1]}, ["bsimp"], tols=("1e-6", "1e-9"))
case("a3-quadratic-drag", """coord y
particle p mass 1 at y
gravity -9.81
force 2e4*y'^2 on y
start y = 0""", "5", {
    "y": lambda: -m.log(m.cosh(m.sqrt(mpf("9.81") * 20000) * 5)) / 20000,
    "y'": lambda: -m.sqrt(mpf("9.81") / 20000) * m.tanh(m.sqrt(mpf("9.81") * 20000) * 5)}, ["bsimp", "msbdf"])
case("a4-relaxing-drive", """coord x
particle p mass 1 at x
force 1e4*(cos(t) - x') on x
start x = 0""", "10", {
    "x'": lambda: (mpf(10) ** 8 * m.cos(10) + mpf(10) ** 4 * m.sin(10)) / (mpf(10) ** 8 + 1)
    - mpf(10) ** 8 / (mpf(10) ** 8 + 1) * m.exp(-mpf(10) ** 5)}, ["bsimp", "msbdf"])


def chain(t):
    n, k, c = 4, 40000, 900
    A = [[0] * (2 * n) for _ in range(2 * n)]
    for i in range(n):
        A[i][n + i] = 1
        for j, s in ((i - 1, 1), (i + 1, 1), (i, -1 if i == n - 1 else -2)):
            if 0 <= j < n:
                A[n + i][j] += s * k
                A[n + i][n + j] += s * c
    return linear(A, [0, 0, 0, "0.1"] + [0] * n, t)


case("a5-damped-chain", """coord x[i] for i = 1..4
particle p[i] mass 1 at x[i] for i = 1..4
potential 20000*(x[1]^2 + (x[2] - x[1])^2 + (x[3] - x[2])^2 + (x[4] - x[3])^2)
dissipation 450*(x[1]'^2 + (x[2]' - x[1]')^2 + (x[3]' - x[2]')^2 + (x[4]' - x[3]')^2)
start x[4] = 1/10""", "1/10", {"x[1]": lambda: chain("0.1")[0], "x[4]": lambda: chain("0.1")[3]},
     ["bsimp", "msbdf"])
case("a6-stiff-frame", """coord x, y
particle p mass 1 at (x, y)
potential 1e6*(x - y)^2/2 + (x + y)^2/4
dissipation 500*(x' - y')^2
start x = 1, y = 1""", "30", {"x": lambda: m.cos(30), "y'": lambda: -m.sin(30)}, ["bsimp"])
THREE = [[0, 0, 0, 1, 0, 0], [0, 0, 0, 0, 1, 0], [0, 0, 0, 0, 0, 1], [-1001, 1000, 0, 0, 0, 0],
         [10 ** 6, -2 * 10 ** 6, 10 ** 6, 0, 0, 0], [0, 10 ** 9, -10 ** 9, 0, 0, -10 ** 7]]
case("a7-three-scales", """coord x, y, z
particle p mass 1 at x
particle q mass 1e-3 at y
particle s mass 1e-6 at z
potential x^2/2 + 1000*(y - x)^2/2 + 1000*(z - y)^2/2
force -10*z' on z
start x = 1, y = 1, z = 1""", "10", {"x": lambda: linear(THREE, [1, 1, 1, 0, 0, 0], 10)[0],
                                     "z": lambda: linear(THREE, [1, 1, 1, 0, 0, 0], 10)[2]}, ["bsimp"])

# --- b: long times -----------------------------------------------------------------------------

case("b1-oscillator", "coord x\nparticle p mass 1 at x\npotential 2*x^2\nstart x = 3", "20000",
     {"x": lambda: 3 * m.cos(40000)}, ["dop853"])
case("b2-pendulum", """coord a
particle p mass 1 at (sin(a), -cos(a))
gravity (0, -4)
start a = 1""", "5000", {"a": lambda: pendulum(1, 4, 5000)}, ["rk8pd"])
case("b3-ellipse", """coord x, y
particle p mass 1 at (x, y)
potential -1/norm(p)
start x = 0.3, y' = sqrt(17/3)""", "3000", {"x": lambda: kepler(1, "0.7", 3000)[0], "y": lambda: kepler(1, "0.7", 3000)[1]},
     ["dop853"])
case("b4-quartic", "coord x\nlagrangian x'^2/2 - x^4/4\nstart x = 1", "2000",
     {"x": lambda: m.ellipfun("cn")(mpf(2000), m=mpf(1) / 2)}, ["dop853"])
case("b5-cycloid", """coord u
particle p mass 1 at (u + sin(u), 1 - cos(u))
gravity (0, -1)
start u = 2""", "2000", {"sin(u/2)": lambda: m.sin(1) * m.cos(1000)})

# --- c: chaos ----------------------------------------------------------------------------------

case("c1-unequal-links", """coord a, b
r = (sin(a), -cos(a))
particle p mass 2 at r
particle q mass 1 at r + (sin(b), -cos(b))/2
gravity (0, -1)
start a = 2.2, b = -1""", "300", {"energy": lambda: -3 * m.cos(mpf("2.2")) - m.cos(1) / 2}, horizon=True)
case("c2-coupled-quartic", """coord x, y
lagrangian (x'^2 + y'^2)/2 - x^2*y^2/2 - (x^4 + y^4)/200
start x = 1, y = 0.3, y' = 1""", "500",
     {"energy": lambda: mpf("0.5") + mpf("0.045") + (1 + mpf("0.0081")) / 200}, horizon=True)
case("c3-spring-pendulum", """coord r > 0, a
particle p mass 1 at (r*sin(a), -r*cos(a))
gravity (0, -1)
potential 2*(r - 1)^2
start r = 1.5, a = 2.5""", "400", {"energy": lambda: -mpf("1.5") * m.cos(mpf("2.5")) + mpf("0.5")}, horizon=True)
case("c4-cart-on-spring", """coord x, a
particle cart mass 1 at (x, 0)
particle bob mass 1 at (x + sin(a), -cos(a))
gravity (0, -1)
potential x^2/2
start x = 2, a = 2.9""", "400", {"energy": lambda: 2 - m.cos(mpf("2.9"))}, horizon=True)
case("c5-regular-for-once", "coord x, y\nlagrangian (x'^2 + y'^2)/2 - x^2/2 - 2*y^2\nstart x = 1, y = 1",
     "1000", {"x": lambda: m.cos(1000), "y": lambda: m.cos(2000)})

# --- d: singular coordinates -------------------------------------------------------------------

polar = "coord r > 0, f\nparticle p mass 1 at (r*cos(f), r*sin(f))\n"
for number, miss in (("1", "1e-2"), ("2", "1e-5"), ("3", "1e-8")):
    case("d%s-past-the-origin-%s" % (number, miss), polar + "start r = sqrt(1 + %s^2), f = atan(%s), r' = -1/sqrt(1 + %s^2), "
         "f' = %s/(1 + %s^2)" % ((miss,) * 5), "3",
         {"r*cos(f)": lambda: mpf(-2), "r*sin(f)": (lambda miss: lambda: mpf(miss))(miss)}, ["dop853"])
case("d4-oscillator-in-polar", polar + "potential r^2/2\nstart r = 1, f' = 1/1000", "30",
     {"r*cos(f)": lambda: m.cos(30), "r*sin(f)": lambda: m.sin(30) / 1000})
case("d5-great-circle", """coord 0 < a < pi, f
particle p mass 1 at (sin(a)*cos(f), sin(a)*sin(f), cos(a))
start a = pi/2, a' = 1, f' = 1/10000""", "10", {
    "cos(a)": lambda: -m.sin(10 * m.sqrt(1 + mpf(10) ** -8)) / m.sqrt(1 + mpf(10) ** -8)})
case("d6-parabolic", """coord u, v
particle p mass 1 at (u*v, (u^2 - v^2)/2)
start u = 1, v = 1/1000, u' = -1, v' = 0""", "2", {
    "u*v": lambda: mpf(1) / 1000 - mpf(2) / 1000, "(u^2 - v^2)/2": lambda: (1 - mpf(10) ** -6) / 2 - 2})

# --- e: near-degenerate, far from 1 -------------------------------------------------------------

case("e1-ellipse-0.9995", """coord x, y
particle p mass 1 at (x, y)
potential -1/norm(p)
start x = 1 - 0.9995, y' = sqrt(1.9995/0.0005)""", "3", {
    "x": lambda: kepler(1, "0.9995", 3)[0], "y": lambda: kepler(1, "0.9995", 3)[1]}, ["dop853"])
case("e2-nearly-upright", """coord a
particle p mass 1 at (sin(a), -cos(a))
gravity (0, -1)
start a = pi - 1e-6""", "40", {"a": lambda: pendulum(m.pi - mpf(10) ** -6, 1, 40)})
case("e3-molecule", """coord x
particle p mass 1.6e-27 at x
potential 500*x^2/2
start x = 1e-11""", "1e-12", {"x": lambda: mpf("1e-11") * m.cos(m.sqrt(500 / mpf("1.6e-27")) * mpf("1e-12"))}, ["dop853"])
case("e4-planet", """coord x, y
particle p mass 6e24 at (x, y)
potential -8e44/norm(p)
start x = 1.2e11, y' = sqrt(8e44/6e24/1.2e11*1.2)""", "9e7", {
    "x": lambda: kepler(mpf("1.5e11"), "0.2", "9e7", mpf("8e44") / mpf("6e24"))[0],
    "y": lambda: kepler(mpf("1.5e11"), "0.2", "9e7", mpf("8e44") / mpf("6e24"))[1]}, ["dop853"])
case("e5-offset", "coord x\nparticle p mass 1 at x\npotential (x - 2^24)^2/2\nstart x = 2^24 + 1", "20",
     {"x": lambda: 2 ** 24 + m.cos(20)})
case("e6-small-beside-large", "coord x, y\nlagrangian (x'^2 + y'^2)/2 - x^2/2 - 9*y^2/2\nstart x = 1, y = 1e-9",
     "10", {"x": lambda: m.cos(10), "y": lambda: mpf("1e-9") * m.cos(30)})
case("e7-through-the-centre", """coord x, y
particle p mass 1 at (x, y)
potential -1/norm(p)
start x = 1""", "5", {"x": lambda: fall(1, 5)}, ["dop853"])
case("e8-flyby-1e-8", """coord x, y
particle p mass 1 at (x, y)
potential -1/norm(p)
start x = 1e-8, y' = sqrt((2 - 1e-8)/1e-8)""", "3", {
    "x": lambda: kepler(1, 1 - mpf(10) ** -8, 3)[0], "y": lambda: kepler(1, 1 - mpf(10) ** -8, 3)[1]}, ["dop853"])
case("e9-nearly-straight", """coord x, y
particle p mass 1 at (x, y)
potential -1/norm(p)
start x = 2 - 1e-9, y' = sqrt(1e-9/(2 - 1e-9))""", "20", {
    "x": lambda: -kepler(1, 1 - mpf(10) ** -9, 20 + m.pi)[0], "y": lambda: -kepler(1, 1 - mpf(10) ** -9, 20 + m.pi)[1]},
     ["dop853"])

case("e10-separatrix", "coord a\nparticle p mass 1 at (sin(a), -cos(a))\ngravity (0, -1)\nstart a = 0, a' = 2", "25", {
    "a": lambda: 4 * m.atan(m.exp(25)) - m.pi})

# --- f: not smooth -----------------------------------------------------------------------------


def zigzag(t):
    """x'' = -sign(x) from x = 1 at rest"""
    q = m.sqrt(2)
    n = int(m.floor((mpf(t) + q) / (2 * q)))
    s = mpf(t) - 2 * q * n
    return (-1) ** n * (1 - s * s / 2)


case("f1-wedge", "coord x\nparticle p mass 1 at x\npotential abs(x)\nstart x = 1", "50",
     {"x": lambda: zigzag(50)}, ["dop853"])
case("f2-slides-and-stays", """coord x
particle p mass 1 at x
force -sign(x')/2 on x
start x = 0, x' = 1""", "5", {"x": lambda: mpf(1)})
case("f3-half-spring", """coord x
particle p mass 1 at x
gravity -1
potential 100*max(0, -x)^2/2
start x = 1""", "2*sqrt(2) + 2*(pi - atan(10*sqrt(2)))/10", {"x": lambda: mpf(1), "x'": lambda: mpf(0)}, ["rk8pd"])
case("f4-square-wave", """coord x
particle p mass 1 at x
force sign(sin(pi*t)) on x
start x = 0, x' = -1/2""", "20", {"x": lambda: mpf(0), "x'": lambda: mpf(-1) / 2}, ["dop853"])
case("f5-mod-drive", """coord x
particle p mass 1 at x
force mod(t, 1) - 1/2 on x
start x = 0, x' = 1/12""", "9", {"x": lambda: mpf(0), "x'": lambda: mpf(1) / 12})
case("f6-fractional", "coord x\nlagrangian x'^2/2 - abs(x)^(3/2)\nstart x = 1",
     "4*sqrt(pi/2)*2/3*1.354117939426400416945288/0.9277193336300392007083495", {"x": lambda: mpf(1), "x'": lambda: mpf(0)}, ["dop853"])
for number, width in (("7", "1e-8"), ("8", "1e-10")):
    case("f%s-kick-of-%s" % (number, width), """coord x
particle p mass 1 at x
potential x^2/2
force exp(-(t - 5)^2/(2*%s^2))/(%s*sqrt(2*pi)) on x
start x = 0""" % (width, width), "10", {
        "x": (lambda width: lambda: m.exp(-mpf(width) ** 2 / 2) * m.sin(5))(width)})

for number, power, way in (("9", "1/2", "2/3"), ("10", "2/3", "3/4"), ("11", "9/10", "10/11")):
    case("f%s-friction-to-the-%s" % (number, power.replace("/", "-")), """coord x
particle p mass 1 at x
force -abs(x')^(%s)*sign(x') on x
start x = 0, x' = 1""" % power, "15", {"x": lambda way=way: mpf(way.split("/")[0]) / mpf(way.split("/")[1]), "x'": lambda: mpf(0)})
case("f12-held-until-driven", """coord x
particle p mass 1 at x
force -sqrt(abs(x'))*sign(x') - sign(x')/2 + max(t - 3, 0)/4 on x
start x = 0, x' = 1""", "4", {
    "x": lambda: mpf(2) / 3 - m.log(3) / 4, "x'": lambda: mpf(0)}, ["dop853"])

# --- g: constraints ----------------------------------------------------------------------------

case("g1-pendulum", """coord x, y
particle p mass 1 at (x, y)
gravity (0, -4)
constraint rod: x^2 + y^2 = 1
start x = sin(1), y = -cos(1)""", "50", {"x": lambda: m.sin(pendulum(1, 4, 50)), "y": lambda: -m.cos(pendulum(1, 4, 50))},
     ["dop853"])
case("g2-great-circle", """coord x, y, z
particle p mass 1 at (x, y, z)
constraint ball: x^2 + y^2 + z^2 = 1
start x = 1, y = 0, z = 0, y' = 0.6, z' = 0.8""", "100", {"x": lambda: m.cos(100), "z": lambda: mpf("0.8") * m.sin(100)})
case("g3-atwood", """coord x, y
particle p mass 2 at x
particle q mass 3 at y
gravity -10
constraint rope: x + y = 0
start x = 0, y = 0""", "3", {"x": lambda: mpf(9), "y'": lambda: mpf(-6)})
case("g4-knife-edge", """coord x, y, f
body b mass 1 inertia 1 at (x, y) angle f
constraint blade: x'*sin(f) - y'*cos(f) = 0
start x' = 1, f' = 2""", "30", {"x": lambda: m.sin(60) / 2, "y": lambda: (1 - m.cos(60)) / 2})
case("g5-rolling", """coord x, f
body disk mass 1 inertia 1/2 at (x, 1) angle f
constraint roll: x' + f' = 0
force (3, 0) on disk
start x = 0""", "10", {"x": lambda: mpf(100)})

# --- h: prescribed motions ---------------------------------------------------------------------

case("h1-on-a-course", """coord x, y
particle p mass 1 at (x, y)
gravity (0, -1)
constraint course: x = sin(3*t)
start x = 0, x' = 3""", "10", {"x": lambda: m.sin(30), "y": lambda: mpf(-50)})
case("h2-bead-on-spoke", """coord x, y
particle p mass 1 at (x, y)
constraint spoke: x*sin(t) - y*cos(t) = 0
start x = 1, y = 0, y' = 1""", "5", {"x": lambda: m.cosh(5) * m.cos(5), "y": lambda: m.cosh(5) * m.sin(5)})
case("h3-breathing-circle", """coord x, y
particle p mass 1 at (x, y)
constraint circle: x^2 + y^2 = (2 + sin(t))^2
start x = 2, y = 0, x' = 1, y' = 1/2""", "6", {
    "x^2 + y^2": lambda: (2 + m.sin(6)) ** 2, "x*y' - y*x'": lambda: mpf(1)})
case("h4-given-acceleration", """coord x, y
particle p mass 1 at (x, y)
constraint prog: x'' = -x
start x = 1, y' = 1""", "20", {"x": lambda: m.cos(20), "y": lambda: mpf(20)})

# --- i: driven ---------------------------------------------------------------------------------

case("i1-resonance", "coord x\nparticle p mass 1 at x\npotential x^2/2\nforce cos(t) on x\nstart x = 0", "500",
     {"x": lambda: 250 * m.sin(500)})
case("i2-fast", "coord x\nparticle p mass 1 at x\npotential x^2/2\nforce cos(30000*t) on x\nstart x = 0", "3",
     {"x": lambda: (m.cos(30000 * mpf(3)) - m.cos(3)) / (1 - mpf(30000) ** 2)}, tols=("1e-6", "1e-9"))
case("i3-chirp", "coord x\nparticle p mass 1 at x\nforce 2*cos(t^2) - 4*t^2*sin(t^2) on x\nstart x = 0", "20",
     {"x": lambda: m.sin(400)}, ["dop853"])
case("i4-pulse", "coord x\nparticle p mass 1 at x\nforce 1000/sqrt(pi)*exp(-(1000*(t - 2))^2) on x\nstart x = 0", "5",
     {"x": lambda: mpf(3), "x'": lambda: mpf(1)}, ["dop853"])
case("i5-lorentzian", "coord x\nparticle p mass 1 at x\nforce 1e-6/pi/((t - 1)^2 + 1e-12) on x\nstart x = 0", "4",
     {"x'": lambda: (m.atan(mpf(3) * 10 ** 6) + m.atan(mpf(10) ** 6)) / m.pi}, ["dop853"])
case("i6-beats", "coord x\nparticle p mass 1 at x\npotential x^2/2\nforce cos(1.001*t) on x\nstart x = 0", "3000",
     {"x": lambda: (m.cos(mpf("1.001") * 3000) - m.cos(3000)) / (1 - mpf("1.001") ** 2)})

case("i7-root-of-time", "coord x\nparticle p mass 1 at x\npotential x^2/2\nforce sqrt(t) on x\nstart x = 0", "5", {
    "x": lambda: mpf(4) / 15 * mpf(5) ** 2.5 * m.hyp1f2(1, mpf(7) / 4, mpf(9) / 4, -mpf(25) / 4)}, ["dop853"])
case("i8-tenth-root-of-time", "coord x\nparticle p mass 1 at x\nforce t^(1/10) on x\nstart x = 0", "5", {
    "x": lambda: mpf(5) ** (mpf(21) / 10) / (mpf(231) / 100)})

# --- j: exotic forces --------------------------------------------------------------------------

case("j1-relativistic", "coord x\nlagrangian 1 - sqrt(1 - x'^2) + x\nstart x = 0", "100",
     {"x": lambda: m.sqrt(1 + mpf(10) ** 4) - 1}, ["dop853"])
case("j2-cyclotron", """coord x, y
lagrangian (x'^2 + y'^2)/2 + 50*(x*y' - y*x') + x
start x = 0, y = 0""", "20", {
    "x": lambda: (1 - m.cos(2000)) / mpf(10) ** 4, "y": lambda: -(mpf(2000) - m.sin(2000)) / mpf(10) ** 4})
case("j3-toda", "coord x\nlagrangian x'^2/2 - exp(2*x)/2\nstart x = 0", "6",
     {"x": lambda: -m.log(m.cosh(6))})
case("j4-rocket", """coord x
param c = 2
lagrangian x'^2/2
force c/(10 - t) on x
start x = 0""", "9", {"x": lambda: 2 * (9 - m.log(10)), "x'": lambda: 2 * m.log(10)})
case("j5-geodesic", "coord u, v > 0\nlagrangian (u'^2 + v'^2)/(2*v^2)\nstart u = 0, v = 1, u' = 1, v' = 0", "8",
     {"u": lambda: m.tanh(8), "v": lambda: 1 / m.cosh(8)})
case("j6-inverse-cube", "coord r > 0, f\nparticle p mass 1 at (r*cos(f), r*sin(f))\npotential 3/(2*r^2)\n"
     "start r = 1, f' = 1", "50", {"r": lambda: m.sqrt(1 + 4 * mpf(2500)), "f": lambda: m.atan(100) / 2})

case("j7-far-exponentials", """coord x
particle p mass 1 at x
potential log(2 + exp(x)) + cosh(x)/(1 + cosh(x)^2)
start x = 900, x' = -1""", "20", {"x": lambda: mpf(680)}, ["radau"])

# --- k: events ---------------------------------------------------------------------------------


def bounces(t, e):
    """Height 1 under gravity 2 onto y = 0, restitution e: y at t"""
    v, at, e, t = mpf(2), mpf(1), mpf(e), mpf(t)
    while True:
        v *= e
        if at + v > t:
            s = t - at
            return v * s - s * s
        at += v


case("k1-bouncing", """coord y
particle p mass 1 at y
gravity -2
start y = 1
event hit: y = 0 falling then y' = -9/10*y'""", "15", {"y": lambda: bounces(15, "0.9")}, ["dop853"])
case("k2-graze", """coord x
particle p mass 1 at x
potential x^2/2
start x = 1
event top: x = 1 - 1e-8 rising then x' = x'""", "20", {"x": lambda: m.cos(20)})
case("k3-two-at-once", """coord x, y
particle p mass 1 at x
particle q mass 1 at y
start x = 1, x' = -1, y = 2, y' = -2
event a: x = 0 falling then x' = -x'
event b: y = 0 falling then y' = -y'""", "5", {"x": lambda: mpf(4), "y": lambda: mpf(8)})
case("k4-kicked", """coord x
param k = 0
particle p mass 1 at x
start x = 0, x' = 1
event kick: sin(pi*t) = 0 falling then x' = x'/2""", "19/2", {
    "x": lambda: sum(mpf(1) / 2 ** i * (2 if i else 1) for i in range(5)) + mpf(1) / 2 ** 5 / 2})

# --- l: scans ----------------------------------------------------------------------------------

case("l1-amplitudes", """coord a
param A = 1
particle p mass 1 at (sin(a), -cos(a))
gravity (0, -1)
start a = A
run 0..100 with A = 3 as big
run 0..100 with A = 1/10 as little""", "100", {
    "big.a": lambda: pendulum(3, 1, 100), "little.a": lambda: pendulum("0.1", 1, 100), "a": lambda: pendulum(1, 1, 100)})
case("l2-damping", """coord x
param c = 1
particle p mass 1 at x
potential x^2/2
force -c*x' on x
start x = 1
run 0..20 with c = 100 as stiff""", "20", {
    "stiff.x": lambda: overdamped(100, 1, 1, 20)[0],
    "x": lambda: m.exp(-10) * (m.cos(m.sqrt(3) * 10) + m.sin(m.sqrt(3) * 10) / m.sqrt(3))})
