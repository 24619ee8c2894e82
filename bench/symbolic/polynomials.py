#!/usr/bin/env python3
"""Expansions, cancellations and factorisations by qdot, PARI, giac and GiNaC: user times of whole processes.

    bench/symbolic/polynomials.py [--rounds N] [--cap SECONDS] [NAME ...]

QDOT is the program; build/qdot unless set. Every round runs each program once for each scene; a line has the median of
the user times, from start to exit, results not printed, and the time over that of qdot. `-`: the program is not there, or
was not done within the cap. A result is checked by its value at a point, an exact number, in a process that is not timed;
who disagrees with qdot is told. `start` is a process that only starts.

Sources: Fateman, SIGSAM Bulletin 37 (2003) 4, dense powers f*(f + 1). Monagan & Pearce, CASC 2007 and J. Symb. Comp. 46
(2011) 807, dense and sparse products. Horowitz, J. ACM 22 (1975) 450, a product whose terms hardly meet. Zippel, EUROSAM
1979, and Moses & Yun, Proc. ACM 1973, greatest common divisors, here what cancels. Wang, Math. Comp. 32 (1978) 1215,
factorisations.
"""
import os
import resource
import shutil
import statistics
import subprocess
import sys
import tempfile

here = os.path.dirname(os.path.abspath(__file__))
qdot = os.path.abspath(os.environ.get("QDOT", os.path.join(here, "..", "..", "build", "qdot")))
variables = ["x", "y", "z", "w", "u"]
point = [2, 3, 5, 7, 11]
sparse = ("(1 + x + y + 2*z^2 + 3*w^3 + 5*u^5)^6", "(1 + u + w + 2*z^2 + 3*y^3 + 5*x^5)^6")
zippel = ("x*y*z + 3*w^2*u - 7", "x^2*w - 2*y*u + 5*z + 1", "y^2*z - 4*x*u^2 + w - 3")
dense = ("(1 + x + y + z)^3", "(2 - x + 3*y - z)^3", "(3 + x - y + 5*z)^3")
wang = ("(z + x*y + 10)*(x*z + y + 30)*(y*z + x + 20)", "(x^3*(z + y) + z - 11)*(x^2*(z^2 + y^2) + y + 90)",
        "(w + x*y + z^2 - 3)*(x*w^2 + y*z + 5)*(x + y*w - z*u + 2)")

# name, what is done, and to what; a cancellation has a numerator and a denominator, which are multiplied out first
scenes = [
    ("fateman", "expand", "(1 + x + y + z)^20*((1 + x + y + z)^20 + 1)"),
    ("dense", "expand", "(1 + x + y + z + w)^14*((1 + x + y + z + w)^14 + 1)"),
    ("sparse", "expand", "%s*%s" % sparse),
    ("power", "expand", "(1 + x + y + z)^40"),
    ("horowitz", "expand", "(1 + x^31 + y^37 + z^41 + w^43)^4*(2 - x^47 + y^53 - z^59 + w^61)^4"),
    ("zippel", "cancel", "(%s)*(%s)" % zippel[:2], "(%s)*(%s)" % zippel[1:]),
    ("moses-yun", "cancel", "%s*%s" % dense[:2], "%s*%s" % dense[1:]),
    ("wang-1", "factor", wang[0]),
    ("wang-2", "factor", wang[1]),
    ("wang-3", "factor", wang[2]),
]

ginac_source = r"""
#include <ginac/ginac.h>
#include <iostream>
using namespace GiNaC;
int main(int n, char **argument)
{
    symbol x("x"), y("y"), z("z"), w("w"), u("u");
    symtab table = {{"x", x}, {"y", y}, {"z", z}, {"w", w}, {"u", u}};
    parser reader(table);
    std::string what = argument[1];
    if (what == "start")
        return 0;
    ex a = reader(argument[2]), r = expand(a);
    if (what == "cancel")
        r = normal(r / expand(reader(argument[3])));
    if (what == "factor")
        r = factor(r);
    if (n > 4)
        std::cout << r.subs(lst{x == 2, y == 3, z == 5, w == 7, u == 11}) << "\n";
}
"""


def command_qdot(scene, value):
    what = scene[1]
    text = "coord %s\n" % ", ".join(variables)
    if what == "expand":
        text += "r = expand(%s)\n" % scene[2]
    elif what == "factor":
        text += "a = expand(%s)\nr = factor(a)\n" % scene[2]
    elif what == "cancel":
        text += "a = expand(%s)\nb = expand(%s)\nr = factor(a/b)\n" % scene[2:]
    if value:
        text += "print subs(r, %s)\n" % ", ".join("%s = %d" % p for p in zip(variables, point))
    return [qdot, "-q", "/dev/stdin"], text


def command_pari(scene, value):
    what = scene[1]
    text = ""
    if what == "expand":
        text = "r = %s;\n" % scene[2]
    elif what == "factor":
        text = "r = factor(%s);\n" % scene[2]
    elif what == "cancel":
        text = "r = (%s)/(%s);\n" % scene[2:]
    if value:
        at = "subst(" * 5 + "r" + "".join(", %s, %d)" % p for p in zip(variables, point))
        text += ("r = factorback(r);\n" if what == "factor" else "") + "print(%s);\n" % at
    return ["gp", "-q", "-f", "-D", "parisizemax=1G"], text


def command_giac(scene, value):
    what = scene[1]
    text = ""
    if what == "expand":
        text = "r:=expand(%s):;\n" % scene[2]
    elif what == "factor":
        text = "a:=expand(%s):;\nr:=factor(a):;\n" % scene[2]
    elif what == "cancel":
        text = "a:=expand(%s):;\nb:=expand(%s):;\nr:=ratnormal(a/b):;\n" % scene[2:]
    if value:
        text += "subst(r,[%s],%s);\n" % (",".join(variables), point)
    return ["giac", "/dev/stdin"], text


def command_ginac(scene, value):
    return [program, scene[1], scene[2] if len(scene) > 2 else "", scene[3] if len(scene) > 3 else "1"] + ["value"] * value, ""


def run(command, cap):
    """User seconds of the process and its output; None if it failed or was not done."""
    words, text = command
    with tempfile.TemporaryFile("w+") as out, tempfile.TemporaryFile("w+") as source:
        source.write(text)
        source.seek(0)
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        try:
            done = subprocess.run(words, stdin=source, stdout=out, stderr=subprocess.DEVNULL, timeout=cap)
        except subprocess.TimeoutExpired:
            return None, ""
        used = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
        out.seek(0)
        return (used if done.returncode == 0 else None), out.read()


def first_number(text):
    """The first word of the output that is a number; of giac behind its words for what it kept silent."""
    words = [w for w in text.replace("=", " ").replace("\"", " ").split() if w.lstrip("-").replace("/", "").isdigit()]
    return words[0] if words else None


def main():
    global program
    words, rounds, cap = sys.argv[1:], 5, 60
    while words and words[0].startswith("--"):
        if words[0] == "--rounds" and len(words) > 1:
            rounds = int(words[1])
        elif words[0] == "--cap" and len(words) > 1:
            cap = float(words[1])
        else:
            sys.exit("usage: bench/symbolic/polynomials.py [--rounds N] [--cap SECONDS] [NAME ...]")
        words = words[2:]
    with tempfile.TemporaryDirectory() as folder:
        peers = {"qdot": command_qdot}
        program = os.path.join(folder, "ginac")
        for name, command, package in (("gp", command_pari, "pari-gp"), ("giac", command_giac, "xcas")):
            if shutil.which(name):
                peers[name] = command
            else:
                print("# %s: skipped: not installed (Debian: %s)" % (name, package))
        made = subprocess.run([os.environ.get("CXX", "g++"), "-O2", "-x", "c++", "-", "-o", program, "-lginac", "-lcln"],
                              input=ginac_source, text=True, stderr=subprocess.DEVNULL) if shutil.which("g++") else None
        if made is not None and made.returncode == 0:
            peers["ginac"] = command_ginac
        else:
            print("# ginac: skipped: not installed (Debian: libginac-dev)")
        print("%-10s" % "# scene", *["%10s" % p for p in peers], *["%10s" % (p + "/qdot") for p in peers if p != "qdot"])
        for scene in [("start", "start")] + scenes:
            if words and scene[0] not in words:
                continue
            times = {p: [] for p in peers}
            for _ in range(rounds):
                for p in peers:
                    if None not in times[p]:
                        times[p].append(run(peers[p](scene, False), cap)[0])
            median = {p: None if None in times[p] else statistics.median(times[p]) for p in peers}
            ratio = [None if None in (median[p], median["qdot"]) else median[p] / max(median["qdot"], 1e-4) for p in peers]
            print("%-10s" % scene[0], *["%10s" % ("-" if median[p] is None else "%.4f" % median[p]) for p in peers],
                  *["%10s" % ("-" if r is None else "%.2f" % r) for r in ratio[1:]], flush=True)
            if scene[1] != "start":
                values = {p: first_number(run(peers[p](scene, True), cap)[1]) for p in peers if median[p] is not None}
                for p in values:
                    if values[p] is None or values[p] != values["qdot"]:
                        print("# %s: %s at the point: %s, by qdot %s" % (scene[0], p, values[p], values["qdot"]))


main()
