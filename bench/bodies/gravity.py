#!/usr/bin/env python3
"""gravity.py -- bodies that attract each other, beside IAS15 of REBOUND or DOP853 of SciPy.

    bench/bodies/gravity.py [QDOT]          QDOT: the program (default: build/qdot)

For 3, 6, 20 and 100 bodies (Sun, Jupiter and Saturn; the outer Solar System of Hairer, Lubich & Wanner, I.2.4; two
clusters of points that come no nearer than a seventh of their mean distance): the time of the integration by `run` at its default
tolerance, its two companions left out, and that of the peer; their ratio; the largest distance of a coordinate at the end from a run
with the tolerance 1e-14, over the size of the system; the time and memory of the whole process.

REBOUND=DIR names a folder with rebound.h and librebound.a; without it the peer is DOP853 at 1e-12. Each time is the least of
three. Nothing is left behind.
"""

import json
import os
import random
import resource
import subprocess
import sys
import tempfile
import time

G_OF_DAYS = 2.95912208286e-4
OUTER = [
    (1.00000597682, [0, 0, 0], [0, 0, 0]),
    (0.000954786104043, [-3.5023653, -3.8169847, -1.5507963], [0.00565429, -0.00412490, -0.00190589]),
    (0.000285583733151, [9.0755314, -3.0458353, -1.6483708], [0.00168318, 0.00483525, 0.00192462]),
    (0.0000437273164546, [8.3101420, -16.2901086, -7.2521278], [0.00354178, 0.00137102, 0.00055029]),
    (0.0000517759138449, [11.4707666, -25.7294829, -10.8169456], [0.00288930, 0.00114527, 0.00039677]),
    (1 / 1.3e8, [-15.5387357, -25.2225594, -3.1902382], [0.00276725, -0.00170702, -0.00136504]),
]


def cluster(n):
    """n bodies at least 0.7 apart in a ball, at rest but for a few tenths of the free fall velocity."""
    draw = random.Random(7)
    radius, places = 1.2 * n ** (1 / 3), []
    while len(places) < n:
        p = [draw.uniform(-radius, radius) for _ in range(3)]
        if sum(c * c for c in p) <= radius**2 and all(
            sum((a - b) ** 2 for a, b in zip(p, q)) >= 0.5 for q in places
        ):
            places.append(p)
    rounded = lambda v: [round(c, 6) for c in v]
    velocities = [[draw.uniform(-0.3, 0.3) for _ in range(3)] for _ in range(n)]
    return [(round(draw.uniform(0.5, 1.5), 3) / n, rounded(p), rounded(v)) for p, v in zip(places, velocities)]


SCENES = {
    "sun jupiter saturn": (G_OF_DAYS, OUTER[:3], 4000000),
    "outer solar system": (G_OF_DAYS, OUTER, 4000000),
    "20 bodies": (1.0, cluster(20), 20),
    "100 bodies": (1.0, cluster(100), 2),
}

PEER = r"""
#include <stdio.h>
#include <stdlib.h>
#include <time.h>
#include "rebound.h"
int main(int c, char **v)
{
    const int n = atoi(v[1]);
    struct timespec a, b;
    struct reb_simulation *r = reb_simulation_create();
    (void)c;
    r->G = atof(v[2]);
    r->integrator = REB_INTEGRATOR_IAS15;
    for (int i = 0; i < n; i++) {
        struct reb_particle p = {0};
        if (scanf("%lf%lf%lf%lf%lf%lf%lf", &p.m, &p.x, &p.y, &p.z, &p.vx, &p.vy, &p.vz) != 7) return 1;
        reb_simulation_add(r, p);
    }
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &a);
    reb_simulation_integrate(r, atof(v[3]));
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &b);
    printf("%.9g\n", b.tv_sec - a.tv_sec + 1e-9 * (b.tv_nsec - a.tv_nsec));
    for (int i = 0; i < n; i++) printf("%.17g %.17g %.17g\n", r->particles[i].x, r->particles[i].y, r->particles[i].z);
    return 0;
}
"""


def script(G, bodies, end, options):
    """The scene in the language."""
    n = len(bodies)
    lines = [
        f"coord x[k], y[k], z[k] for k = 1..{n}",
        f"param G = {G!r}",
        f"param m[k] for k = 1..{n}",
        f"particle a[k] mass m[k] at (x[k], y[k], z[k]) for k = 1..{n}",
        f"potential sum(sum(-G*m[i]*m[j]/norm(a[i] - a[j]), j, i+1, {n}), i, 1, {n})",
    ]
    for k, (m, p, v) in enumerate(bodies, 1):
        lines.append(f"set m[{k}] = {m!r}")
        lines.append("start " + ", ".join(f"{c}[{k}] = {p[i]!r}, {c}[{k}]' = {v[i]!r}" for i, c in enumerate("xyz")))
    lines.append(f"run 0..{end}{options}")
    return "\n".join(lines) + "\n"


def run_qdot(program, folder, G, bodies, end, options=""):
    path = os.path.join(folder, "scene.lag")
    with open(path, "w") as f:
        f.write(script(G, bodies, end, options))
    begun = time.time()
    out = subprocess.run([program, "--json", path], capture_output=True, text=True, check=True).stdout
    whole = time.time() - begun
    report = next(r for r in map(json.loads, out.splitlines()) if r.get("kind") == "run")
    state = report["state"]
    return report["cpu"], [state[f"{c}[{k}]"] for k in range(1, len(bodies) + 1) for c in "xyz"], whole


def run_rebound(program, G, bodies, end):
    text = "\n".join(" ".join(map(repr, [m, *p, *v])) for m, p, v in bodies)
    out = subprocess.run([program, str(len(bodies)), repr(G), str(end)], input=text, capture_output=True, text=True, check=True)
    time_, *rows = out.stdout.split("\n")
    return float(time_), [float(c) for row in rows for c in row.split()]


def run_scipy(G, bodies, end):
    import numpy
    from scipy.integrate import solve_ivp

    n = len(bodies)
    masses = numpy.array([b[0] for b in bodies])

    def rates(_, y):
        x = y[: 3 * n].reshape(n, 3)
        d = x[None] - x[:, None]
        r = numpy.sqrt((d**2).sum(2)) + numpy.eye(n)
        return numpy.concatenate([y[3 * n :], (G * (masses / r**3)[..., None] * d).sum(1).ravel()])

    start = numpy.array([b[1] for b in bodies] + [b[2] for b in bodies], float).ravel()
    begun = time.process_time()
    y = solve_ivp(rates, (0, end), start, method="DOP853", rtol=1e-12, atol=1e-14).y[:, -1]
    return time.process_time() - begun, list(y[: 3 * n])


def main():
    program = sys.argv[1] if len(sys.argv) > 1 else "build/qdot"
    with tempfile.TemporaryDirectory() as folder:
        peer = None
        if "REBOUND" in os.environ:
            source, peer = os.path.join(folder, "peer.c"), os.path.join(folder, "peer")
            with open(source, "w") as f:
                f.write(PEER)
            library = os.environ["REBOUND"]
            subprocess.run(["gcc", "-O3", "-march=native", "-I", library, source, os.path.join(library, "librebound.a"),
                            "-lm", "-lpthread", "-lrt", "-o", peer], check=True)
        print(f"{'scene':20} {'qdot':>9} {'IAS15' if peer else 'DOP853':>9} {'ratio':>6} {'error':>8} {'of peer':>8} {'whole':>7}")
        for name, (G, bodies, end) in SCENES.items():
            size = max(abs(c) for _, p, _ in bodies for c in p)
            runs = [run_qdot(program, folder, G, bodies, end) for _ in range(3)]
            peers = [run_rebound(peer, G, bodies, end) if peer else run_scipy(G, bodies, end) for _ in range(3 if peer else 1)]
            _, exact, _ = run_qdot(program, folder, G, bodies, end, " tol 1e-14")
            apart = lambda values: max(abs(a - b) for a, b in zip(values, exact)) / size
            ours, theirs = min(r[0] for r in runs), min(p[0] for p in peers)
            print(f"{name:20} {ours * 1e3:6.1f} ms {theirs * 1e3:6.1f} ms {ours / theirs:6.2f} {apart(runs[0][1]):8.1e} "
                  f"{apart(peers[0][1]):8.1e} {min(r[2] for r in runs):5.2f} s", flush=True)
        print(f"memory of the largest process: {resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024:.0f} MB")


if __name__ == "__main__":
    main()
