"""references.py [FILE] -- write the table of definite integrals with 30 digits by mpmath; the rows as they are without digits.

A row is `E | from | to | digits | how`, the last empty or

    a list of places   at which the quadrature (tanh-sinh, 60 digits) splits the range
    sin K              E is a rational function times sin(K x) or cos(K x): Levin's way, sums over half periods
    square             E(x) = g(x^2): over u = x^2, likewise with K = 1
    one, half          E = (1 - cos x)/x^2 or (sin x)^2/x^2: by parts, the integral of sin(K x)/x, K = 1 or 2
"""
import sys
from pathlib import Path

from mpmath import inf, mp, mpf

import formula


def place(text):
    sign = -1 if text.startswith("-inf") else 1
    return sign * inf if text.lstrip("-") == "infinity" else formula.read(text)({}, mpf(0))


def integrate(e, lo, hi, how):
    f = formula.read(e)

    def at(x):
        return f({}, x)

    if how.startswith("sin"):
        k = place(how.split()[1])
        return mp.quad(at, [0, mp.pi / k]) + mp.quadosc(at, [mp.pi / k, inf], omega=k)
    if how == "square":
        def over_u(u):
            return at(mp.sqrt(u)) / (2 * mp.sqrt(u))
        return mp.quad(at, [0, mp.sqrt(mp.pi)]) + mp.quadosc(over_u, [mp.pi, inf], omega=1)
    if how in ("one", "half"):
        k = 1 if how == "one" else 2

        def by_parts(x):
            return mp.sin(k * x) / x
        return mp.quad(by_parts, [0, mp.pi / k]) + mp.quadosc(by_parts, [mp.pi / k, inf], omega=k)
    ends = [place(lo)] + [place(p) for p in how.split(",") if p.strip()] + [place(hi)]
    return mp.quad(at, ends, maxdegree=12)


def main(path):
    mp.dps = 60
    out = []
    for line in Path(path).read_text().splitlines():
        if line.startswith("#") or not line.strip():
            out.append(line)
            continue
        e, lo, hi, _, how = [p.strip() for p in (line + " | " * 4).split("|")][:5]
        out.append(" | ".join([e, lo, hi, mp.nstr(integrate(e, lo, hi, how), 32)] + ([how] if how else [])))
    Path(path).write_text("\n".join(out) + "\n")


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parent / "definite.txt")
