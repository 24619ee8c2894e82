# The chain of N links by SymPy's LagrangesMethod, to M and f: seconds, one line for each N given.
import sys
import time

from sympy import Rational, cos, sin, symbols
from sympy.physics.mechanics import LagrangesMethod, dynamicsymbols


def derive(n):
    t, g = dynamicsymbols._t, symbols("g", positive=True)
    m = symbols(f"m1:{n + 1}", positive=True)
    l = symbols(f"l1:{n + 1}", positive=True)
    q = dynamicsymbols(f"theta1:{n + 1}")
    x = y = 0
    kinetic = potential = 0
    for k in range(n):
        x, y = x + l[k] * sin(q[k]), y - l[k] * cos(q[k])
        vx, vy = x.diff(t), y.diff(t)
        kinetic += Rational(1, 2) * m[k] * (vx**2 + vy**2)
        potential += m[k] * g * y
    method = LagrangesMethod(kinetic - potential, list(q))
    method.form_lagranges_equations()
    return method.mass_matrix, method.forcing


for n in map(int, sys.argv[1:]):
    began = time.perf_counter()
    derive(n)
    print(n, time.perf_counter() - began, flush=True)
