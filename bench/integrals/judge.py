"""judge.py -- judge antiderivatives by mpmath, definite integrals by references with 30 digits; bench/integrals/run calls it."""
import argparse
import os
import random
import re
import resource
import subprocess
from pathlib import Path

from mpmath import mp, mpf

import formula

here = Path(__file__).parent
POINTS = 20
PARAMETERS = "a b c f g n".split()
slowest = []


def processor_time():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def ask(statements):
    """What the program prints, a line each, and its standard error; a run of more than a second of CPU is told."""
    before = processor_time()
    done = subprocess.run([os.environ["QDOT"], "-q", "-"], input="\n".join(statements), capture_output=True, text=True)
    used = processor_time() - before
    slowest.append((used, statements[-1]))
    if used > 1:
        print(f"slow: {used:.2f} s: {statements[-1]}", flush=True)
    return done.stdout.strip().splitlines(), done.stderr.strip()


# --- antiderivatives ------------------------------------------------------------------------------------------


def declarations(e):
    if "f(x)" in e:
        return ["param a > 0, b > 0, c > 0, g, n, x", "function f(x)"]
    return ["param a > 0, b > 0, c > 0, f, g, n, x"]


def random_values():
    values = {p: mpf(random.randint(30, 300)) / 100 for p in "abc"}
    values.update({p: mpf(random.randint(-300, 300)) / 100 for p in "fg"})
    values["n"] = mpf(random.randint(1, 4))
    values["f(x)"] = lambda x: mp.sin(x) + mpf(1) / 3  # for an undefined function
    values["f'(x)"] = mp.cos
    values["f''(x)"] = lambda x: -mp.sin(x)
    return values


def disagreement(E, F):
    """A place where F' is not E, or where F jumps though E is finite; None where none was seen, and how many were tried."""
    tried = 0
    for _ in range(60 * POINTS):
        if tried == POINTS:
            break
        values = random_values()
        p = mpf(random.randint(-6000, 6000)) / 1000

        def integrand(x):
            return E(values, x)

        def primitive(x):
            return F(values, x)

        try:
            slope = mp.diff(primitive, p, h=mpf(10) ** -10)
            here_ = integrand(p)
        except formula.Undefined:
            continue
        tried += 1
        if abs(slope - here_) > mpf(10) ** -8 * (1 + abs(here_)):
            return f"F' = {mp.nstr(slope, 12)}, E = {mp.nstr(here_, 12)} at x = {p}, {shown(values)}", tried
        q = p + random.choice([1, 3, 7])
        try:
            fine, coarse = simpson(integrand, p, q, 60), simpson(integrand, p, q, 44)
            change = primitive(q) - primitive(p)
        except formula.Undefined:
            continue
        if abs(fine - coarse) > mpf("0.001") * (1 + abs(fine)):  # a pole, or too steep
            continue
        area = fine
        if abs(change - area) > mpf("0.02") * (1 + abs(area)):
            return f"F(q) - F(p) = {mp.nstr(change, 8)}, integral {mp.nstr(area, 8)} from {p} to {q}, {shown(values)}", tried
    return None, tried


def with_primes(text):
    return text.replace("diff(f(x), x, 2)", "f''(x)").replace("diff(f(x), x)", "f'(x)")


def simpson(f, p, q, n):
    """Enough to see a jump, which is no small number."""
    v = [f(p + (q - p) * i / n) for i in range(n + 1)]
    for i in range(n):
        if v[i] * v[i + 1] < 0:
            left, right = p + (q - p) * i / n, p + (q - p) * (i + 1) / n
            for _ in range(12):
                middle = (left + right) / 2
                left, right = (middle, right) if f(middle) * v[i] > 0 else (left, middle)
            if abs(f(left)) > max(abs(v[i]), abs(v[i + 1])):
                raise formula.Undefined  # it changes its sign at a pole
    return (q - p) / (3 * n) * (v[0] + v[-1] + 4 * sum(v[1::2]) + 2 * sum(v[2:-1:2]))


def shown(values):
    return ", ".join(f"{k} = {mp.nstr(v, 4)}" for k, v in values.items() if k in PARAMETERS)


def judge_antiderivatives(table):
    counts = dict.fromkeys(["found", "left", "unsure", "wrong"], 0)
    few = 0
    for e in rows(table):
        out, err = ask(declarations(e) + [f"F = integral({e}, x)", "print F", f"check diff(F, x) == {e}"])
        F = out[0] if out else ""
        if err.find("error:") >= 0 or not F or "integral(" in F:
            verdict = "left"
        elif not any(line.startswith("proved") for line in out):
            verdict = "unsure"
        else:
            at, tried = disagreement(*[formula.read(with_primes(text)) for text in (e, F)])
            few += tried < POINTS
            verdict = "wrong" if at else "found"
            if at:
                print(f"wrong: {e}: {at}")
        counts[verdict] += 1
        if verdict in ("left", "unsure"):
            print(f"{verdict}: {e}")
    print("antiderivatives: " + ", ".join(f"{k} {v}" for k, v in counts.items())
          + (f"; {few} at fewer than {POINTS} points" if few else ""))
    return counts["wrong"]


# --- definite integrals ---------------------------------------------------------------------------------------


def judge_definite(table):
    counts = dict.fromkeys(["exact", "a number", "without a number", "wrong"], 0)
    for row in rows(table):
        e, lo, hi, digits = [part.strip() for part in row.split("|")][:4]
        call = f"integral({e}, x, {lo}, {hi})"
        out, err = ask(["param x", f"print {call}"])
        exact = bool(out) and "integral(" not in out[0] and "error:" not in err
        number, err = ask(["param x", f"print numeric({call}, 30)"])
        found = re.fullmatch(r"(\S+)(?: (?:±|\+-) (\S+))?", number[-1]) if number else None
        if found is None:
            verdict = "without a number"
        else:
            off = abs(mpf(found[1]) - mpf(digits))
            allowed = (mpf(found[2]) if found[2] else 0) + mpf(10) ** -28 * abs(mpf(digits)) + mpf(10) ** -29
            verdict = "wrong" if off > allowed else "exact" if exact else "a number"
            if verdict == "wrong":
                print(f"wrong: {call} = {number[0]}, not {digits}")
        counts[verdict] += 1
        if verdict == "without a number":
            print(f"{verdict}: {call}: {err.splitlines()[0] if err else ''}")
    print("definite: " + ", ".join(f"{k} {v}" for k, v in counts.items()))
    return counts["wrong"]


def rows(path):
    return [line.strip() for line in Path(path).read_text().splitlines() if line.strip() and not line.startswith("#")]


if __name__ == "__main__":
    words = argparse.ArgumentParser()
    words.add_argument("--table", default=here / "table.txt")
    words.add_argument("--definite", default=here / "definite.txt")
    given = words.parse_args()
    mp.dps = 30
    random.seed(1)
    wrong = judge_antiderivatives(given.table) + judge_definite(given.definite)
    used, statement = max(slowest)
    print(f"slowest run of the program: {used:.2f} s of CPU, {statement}")
    raise SystemExit(wrong > 0)
