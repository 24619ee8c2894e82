# One scene by SciPy's DOP853, over a ladder of tolerances: lines as of peers.cc.
#
#   scipy_dop853.py SCENE FROM TO STEPS MOST
import math
import sys
import time

import numpy as np
from scipy.integrate import solve_ivp

g = 9.81


def pendulum(t, y):
    return y[1], -g * math.sin(y[0])


def double(t, y):
    p, q, v, w = y
    s, c = math.sin(p - q), math.cos(p - q)
    a = -s * w * w - 2 * g * math.sin(p)
    b = s * v * v - g * math.sin(q)
    d = 2 - c * c
    return v, w, (a - c * b) / d, (2 * b - c * a) / d


def kepler_polar(t, y):
    r, _, v, w = y
    return v, w, r * w * w - 1 / r**2, -2 * v * w / r


def spherical_pole(t, y):
    s, c = math.sin(y[0]), math.cos(y[0])
    return y[2], y[3], s * (c * y[3] ** 2 - g), -2 * c / s * y[2] * y[3]


def stiff_spring(t, y):
    r, p, v, w = y
    return (v, w, r * w * w + g * math.cos(p) - 1e6 * (r - 1),
            -(g * math.sin(p) + 2 * v * w) / r)


def chain(n):
    count = np.arange(n, 0, -1)
    least = np.minimum.outer(count, count)

    def f(t, y):
        theta, w = y[:n], y[n:]
        difference = np.subtract.outer(theta, theta)
        side = -(least * np.sin(difference)) @ w**2 - count * g * np.sin(theta)
        return np.concatenate([w, np.linalg.solve(least * np.cos(difference), side)])

    return f, 5, [math.pi / 2] * n + [0] * n


scenes = {
    "pendulum": (pendulum, 1000, [2, 0]),
    "double": (double, 20, [2, 2, 0, 0]),
    "kepler_polar": (kepler_polar, 200 * math.pi, [0.1, 0, 0, 10 * math.sqrt(19)]),
    "spherical_pole": (spherical_pole, 100, [1, 0, 0, 0.01]),
    "stiff_spring": (stiff_spring, 10, [1.00000981, 1, 0, 0]),
    **{f"chain{n}": chain(n) for n in (8, 16, 32, 64)},
}

f, end, start = scenes[sys.argv[1]]
power, to, a_decade, most = map(float, sys.argv[2:])
while power > to - 1e-9:
    tol = 10**power
    began = time.process_time()
    run = solve_ivp(f, (0, end), start, "DOP853", t_eval=[end], rtol=tol, atol=tol)
    taken = time.process_time() - began
    if run.success:
        print(f"{tol:.3g} {taken:.9f} {run.nfev}", *(f"{x:.17g}" for x in run.y[:, -1]))
    else:
        print(f"{tol:.3g} failed")
    sys.stdout.flush()
    if taken > most:
        break
    power -= 1 / a_decade
