"""interrupts.py PROGRAM COUNT [SEED [NAME]] -- press Ctrl-C at random times; print a TAP point and figures.

A person types statements at a prompt, presses Ctrl-C while one is at work, and asks for a product: the program
must be there and answer, what the scene declares must be as before, and a file that a statement writes must be the
whole one or none. A statement is done as often as it takes for COUNT interrupts in all; its time without one bounds the
random times.
"""
import math
import os
import pty
import random
import re
import select
import signal
import sys
import tempfile
import time

spring = "coord x\nparticle p mass 1 at x\npotential k*x^2/2\nstart x = 1\n"
quartic = "coord x\nparticle p mass 1 at x\npotential x^4/4\nstart x = 1\n"
double = ("coord a, b\nparticle p mass 1 at (sin(a), -cos(a))\n"
          "particle q mass 1 at (sin(a) + sin(b), -cos(a) - cos(b))\ngravity (0, -9.81)\nstart a = 2, b = 2\n")
triple = ("param m, l, g > 0\ncoord a, b, c\nu = (l*sin(a), -l*cos(a))\nv = u + (l*sin(b), -l*cos(b))\n"
          "w = v + (l*sin(c), -l*cos(c))\nparticle p mass m at u\nparticle q mass m at v\nparticle r mass m at w\n"
          "gravity (0, -g)\n")
driven = ("param F\ncoord x\nparticle p mass 1 at x\npotential x^4/4 - x^2/2\nforce -x'/4 + F*cos(t) on p\n"
          "set F = 1.5\n")
data = "".join("%g,%.17g\n" % (n / 50, math.exp(-n / 1000) * math.cos(1.1 * n / 50) + 0.01 * (-1) ** n)
               for n in range(3000))

# A name, what is declared, what is interrupted, the files that it writes.
scenes = [
    ("run", quartic, "run 0..40000", []),
    ("run with events", "coord y\nparticle p mass 1 at y\ngravity -1\nstart y = 1\n"
     "event floor: y = 0 falling then y' = -y'\n", "run 0..40000", []),
    ("run digits", quartic, "run 0..40 digits 60", []),
    ("run of an event that overflows", "coord y\nparticle p mass 1 at y\ngravity -9.81\nstart y = 1000\n"
     "event e: exp(-y) = 2\n", "run 0..100", []),
    ("run stiff", "coord x\nparticle p mass 1 at x\nforce -1e6*(x - cos(t)) - 1e4*x' on p\nstart x = 1\n",
     "run 0..60 method radau", []),
    ("sweep", "param k = 1\n" + spring, "sweep k = 1..2 count 9000 run 0..50 : x", []),
    ("sweep by workers", "param k = 1\n" + spring, "sweep k = 1..2 count 2000 run 0..5 : max(x) threads 2", []),
    ("sweep resumed", "param k = 1\n" + spring, "sweep k = 1..2 count 9000 run 0..20 : x resume \"s.h5\"",
     ["s.h5", "s.h5.part"]),
    ("lyapunov", double, "lyapunov 0..1500", []),
    ("equilibria", "param m, l, g > 0\ncoord a, b\nparticle p mass m at (l*sin(a), -l*cos(a))\n"
     "particle q mass m at (l*sin(a) + l*sin(b), -l*cos(a) - l*cos(b))\ngravity (0, -g)\n"
     "spring between p, (l, 0) stiffness g rest l\nset m = 1, l = 1, g = 1\n", "equilibria", []),
    ("equations", triple, "derive\naccel", []),
    ("solve", "param u, v\ncoord x, y\n", "solve([x^2 + y^2 = 5, x*y = 2], [x, y])\nsolve(sin(x) + u*cos(x) = v, x)\n"
     "solve([x^4 + 3*y^3 = 1, x*y^2 + x = 2], [x = 1, y = 1])", []),
    ("check", "param u, v\ncoord x\n", "check (sin(x) + u*cos(x) + v)^24 == (cos(x)*u + v + sin(x))^22*"
     "(v^2 + u^2*cos(x)^2 + sin(x)^2 + 2*u*v*cos(x) + 2*v*sin(x) + u*sin(2*x))", []),
    ("find", double, "find a = 1, b = 1 such that value(a, 8) = 0.3, value(b, 8) = 0.2", []),
    ("find an orbit", driven, "find x = 1.5, x' = 0 such that returns after 2*pi", []),
    ("continue equilibria", "param P\ncoord a, b\nr = (cos(a), sin(a))\ns = r + (cos(b), sin(b))\n"
     "particle p mass 2 at r\nparticle q mass 1 at s\npotential a^2/2 + (b - a)^2/2\n"
     "dissipation a'^2/20 + (b' - a')^2/20\nforce -P*(cos(b), sin(b)) on q\n",
     "continue equilibria in P = 0..40", []),
    ("continue orbits", driven + "find x = 1.5, x' = 0 such that returns after 2*pi as o\n",
     "continue orbit in F = 1.2..1.6", []),
    ("fit", "param k = 1.2, c = 0.1\ncoord x\nparticle p mass 1 at x\npotential k*x^2/2\ndissipation c*x'^2/2\n"
     "start x = 1\n", "fit k, c, x to \"data.csv\" : t, x sigma 0.01", []),
    ("sensitivity", double + "run 0..50\n", "sensitivity value(a, 50) of a, b", []),
    ("what is read from a run", quartic + "run 0..500\n", "max(x)\nmean(x^2)\nvalue(x, 123)", []),
    ("plot", double + "run 0..20\n", "plot a, b vs t to \"p.svg\"", ["p.svg"]),
    ("animate", double + "run 0..1000\n", "animate to \"m.html\"", ["m.html"]),
    ("save", double + "run 0..400 as r\n", "save r to \"r.csv\"", ["r.csv"]),
    ("save session", double + "run 0..400 as r\n", "save session to \"s.lag\"", ["s.lag"]),
    ("load", quartic, "include \"load.lag\"", []),
    ("table", double + "run 0..50\n", "table a, b, energy every 1/50 to \"t.html\"", ["t.html"]),
    ("report", double + "run 0..5\n", "report to \"r.html\"", ["r.html"]),
    ("export", triple, "export c eom to \"e.c\"", ["e.c"]),
    ("poincare", double, "poincare a = 0 rising : b, b' run 0..300", []),
    ("workprecision", quartic, "workprecision 0..1 to \"w.svg\"", ["w.svg"]),
    ("longtime", quartic, "longtime 0..200 tol 1e-6 to \"l.svg\"", ["l.svg"]),
    ("loop", "param k = 1\n" + spring, "run 0..500 as r[n] for n = 1..99", []),
]


class Terminal:
    def __init__(self, program):
        self.pid, self.fd = pty.fork()
        if self.pid == 0:
            os.environ.update(TERM="dumb", HOME="/nonexistent", LC_ALL="C")
            os.environ.pop("DISPLAY", None)
            os.execv(program, [program, "-q"])
        self.seen = b""
        self.passed = b""
        self.questions = 0

    def type(self, text):
        for line in text.splitlines():
            os.write(self.fd, line.encode() + b"\n")

    def wait(self, mark, seconds):
        """Read until `mark` has come; whether it has. What came before it is in `passed`."""
        end = time.monotonic() + seconds
        while mark not in self.seen:
            left = end - time.monotonic()
            if left <= 0 or not select.select([self.fd], [], [], left)[0]:
                return False
            try:
                more = os.read(self.fd, 65536)
            except OSError:
                return False
            if not more:
                return False
            self.seen += more
        self.passed = self.seen[:self.seen.index(mark)]
        self.seen = self.seen[self.seen.index(mark) + len(mark):]
        return True

    def close(self):
        os.close(self.fd)
        try:
            os.kill(self.pid, signal.SIGKILL)
        except OSError:
            pass
        return os.waitpid(self.pid, 0)[1]


def answers(terminal):
    """Whether the prompt answers a new question. It is typed again where Ctrl-C threw it away before it was heard, so
    each has a number of its own: late answers to an older one are passed over."""
    terminal.questions += 1
    for _ in range(30):
        terminal.type("print 2*%d" % (100000 + terminal.questions))
        if terminal.wait(b"%d" % (200000 + 2 * terminal.questions), 2):
            return True
    return False


def declared(terminal):
    """What the scene declares, as the prompt shows it; None where there is no answer."""
    if not answers(terminal):
        return None
    terminal.type("scene")
    if not answers(terminal):
        return None
    lines = terminal.passed.decode("utf-8", "replace").replace("\r", "\n").split("\n")
    # not what was typed, nor values: those are what find and fit are for
    return [line for line in lines if line.strip() and "> " not in line and not line.startswith(("set ", "start "))
            and "print 2*" not in line and not line.strip().isdigit() and line != "scene"]


def put_data():
    with open("data.csv", "w") as file:
        file.write("t,x\n" + data)
    with open("load.lag", "w") as file:
        file.write("run 0..1000\n" * 40)


class Press:
    """One statement, begun and interrupted again and again."""

    def __init__(self, program, name, scene, statement, files):
        self.program, self.name, self.scene, self.statement, self.files = program, name, scene, statement, files
        self.terminal, self.sizes = None, {}

    def begin(self):
        self.terminal = Terminal(self.program)
        self.terminal.type(self.scene)
        self.before = declared(self.terminal)
        return self.before is not None

    def measure(self):
        start = time.monotonic()
        self.terminal.type(self.statement)
        if not answers(self.terminal):
            return False
        self.whole = max(time.monotonic() - start, 0.01)
        self.sizes = {file: os.path.getsize(file) for file in self.files if os.path.exists(file)}
        return re.search(rb":\d+: error: ", self.terminal.passed) is None

    def is_whole(self, file, size):
        if file not in self.sizes:
            return False
        if self.name in ("workprecision", "longtime"):  # they draw what was measured so far, and say so
            with open(file, "rb") as figure:
                return figure.read().rstrip().endswith(b"</svg>")
        return abs(size - self.sizes[file]) <= 40  # dates and seconds in it may be some digits longer or shorter

    def press(self, chance):
        """Seconds until the prompt answers, or a complaint."""
        at = chance.uniform(0, 1.1 * self.whole)
        for file in self.files:
            if os.path.exists(file):
                os.unlink(file)
        self.terminal.type(self.statement)
        time.sleep(at)
        os.write(self.terminal.fd, b"\x03")
        pressed = time.monotonic()
        time.sleep(0.02)
        if not answers(self.terminal):
            return "at %.3f s of %.3f: gone, status %d" % (at, self.whole, self.terminal.close())
        waited = time.monotonic() - pressed
        after = declared(self.terminal)
        if after != self.before:
            self.terminal.close()
            return "at %.3f s of %.3f: the scene is\n#   %s\n#   in place of %s" % (at, self.whole, after, self.before)
        for file in os.listdir("."):
            if file in ("data.csv", "load.lag") or file.endswith(".h5") or file.endswith(".part"):
                continue
            size = os.path.getsize(file)
            if not self.is_whole(file, size):
                os.unlink(file)
                self.terminal.close()
                return "at %.3f s of %.3f: %s is left with %d bytes" % (at, self.whole, file, size)
        return waited


def main():
    program, count = os.path.abspath(sys.argv[1]), int(sys.argv[2])
    chance = random.Random(int(sys.argv[3]) if len(sys.argv) > 3 else 1)
    chosen = [scene for scene in scenes if len(sys.argv) < 5 or scene[0] == sys.argv[4]]
    lost, waits = [], []

    print("1..1", flush=True)
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        for i, scene in enumerate(chosen):
            if i >= count:
                break
            for file in os.listdir("."):
                os.unlink(file)
            put_data()
            statement = Press(program, *scene)
            if not statement.begin() or not statement.measure():
                print("not ok 1 - %s: the statement ends without an interrupt" % scene[0])
                print("#", statement.terminal.passed[-500:])
                return
            longest = 0
            for _ in range(i, count, len(chosen)):
                ended = statement.press(chance)
                if isinstance(ended, str):
                    lost.append("%s: %s" % (scene[0], ended))
                    statement.begin()
                    continue
                longest = max(longest, ended)
            statement.terminal.close()
            waits.append((longest, scene[0], statement.whole))
        os.chdir("/")
    print("ok 1" if not lost else "not ok 1", "- Ctrl-C at random times ends a statement and no more")
    print("# %d interrupts of %d statements, %d not survived, the longest wait %.2f s (%s)"
          % (count, min(count, len(chosen)), len(lost), *max(waits)[:2]))
    if os.environ.get("QDOT_INTERRUPTS"):
        for longest, name, whole in waits:
            print("#   %-32s %8.2f s, longest wait %.2f s" % (name, whole, longest))
    for line in lost[:40]:
        print("#", line)


main()
