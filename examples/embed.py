"""embed.py -- qdot from Python: a pendulum declared, derived, decided, run and read.

    python3 embed.py

With the package `qdot`, which `make install` brings; examples/embed.c does the same in C.
"""
import qdot

system = qdot.System("""
    param m, l, g > 0
    coord theta
    particle bob mass m at (l*sin(theta), -l*cos(theta))
    gravity (0, -g)""")
system.set(m=1, l=1, g=9.81).start({"theta": 2})
for expression in "T", "V", "eom":
    print(f"{expression}: {system.derive(expression)}")
for claim in "conserved energy", "T == m*l^2*theta'^2":
    print(f"{claim}: {system.check(claim)}")

motion = system.run("0..10 tol 1e-12")
times = [0, 2.5, 5, 7.5, 10]
values, errors = motion.values(["theta", "theta'"], times, errors=True)
for t, theta, speed, error in zip(times, *values, errors.max(axis=0)):
    print(f"t = {t:4.1f}  theta = {theta:11.8f}  theta' = {speed:11.8f}"
          f"{'' if error < 1e-9 else ' (uncertain)'}")
largest = motion.max("theta'")
print(f"largest theta': {largest:.8f}")
summary = motion.summary
print(f"method {summary.method}, energy drift below 1e-10: "
      f"{'yes' if summary.energy_drift < 1e-10 else 'no'}")
try:
    system.declare("set l = 2, k = 3")
except qdot.Error as error:
    print(f"unknown or taken name:\n{error}")
