"""interrupts.py PROGRAM COUNT [SEED] -- press Ctrl-C at random times; print a TAP point and figures.

A person types statements at a prompt, presses Ctrl-C while one is at work, and asks `check 2 + 2 == 4`: the program
must be there and prove it. A statement is done as often as it takes for COUNT interrupts in all; its time without one
bounds the random times.
"""
import os
import pty
import random
import select
import signal
import sys
import time

scenes = [
    ("coord x\nparticle p mass 1 at x\npotential x^4/4\nstart x = 1\n", "run 0..2000"),
    ("coord y\nparticle p mass 1 at y\ngravity -1\nstart y = 1\n"
     "event floor: y = 0 falling then y' = -9*y'/10\n", "run 0..15"),
    ("coord x\nparticle p mass 1 at x\npotential x^2/2\nstart x = 1\n", "run 0..5 digits 60"),
    ("param k = 1\ncoord x\nparticle p mass 1 at x\npotential k*x^2/2\nstart x = 1\n",
     "sweep k = 1..2 count 200 run 0..50 : x"),
    ("coord a, b\nparticle p mass 1 at (sin(a), -cos(a))\n"
     "particle q mass 1 at (sin(a) + sin(b), -cos(a) - cos(b))\ngravity (0, -9.81)\nstart a = 2, b = 2\n",
     "lyapunov 0..200"),
    ("coord y\nparticle p mass 1 at y\ngravity -9.81\nstart y = 1000\nevent e: exp(-y) = 2\n", "run 0..100"),
]


class Terminal:
    def __init__(self, program):
        self.pid, self.fd = pty.fork()
        if self.pid == 0:
            os.environ.update(TERM="dumb", HOME="/nonexistent", LC_ALL="C")
            os.execv(program, [program, "-q"])
        self.seen = b""

    def type(self, text):
        for line in text.splitlines():
            os.write(self.fd, line.encode() + b"\n")

    def wait(self, mark, seconds):
        """Read until `mark` has come; whether it has."""
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
    terminal.type("check 2 + 2 == 4")
    return terminal.wait(b"proved", 30)


def main():
    program, count = sys.argv[1], int(sys.argv[2])
    chance = random.Random(int(sys.argv[3]) if len(sys.argv) > 3 else 1)
    lost = []
    longest = 0

    print("1..1", flush=True)
    for i, (scene, statement) in enumerate(scenes):
        terminal = Terminal(program)
        terminal.type(scene)
        if not answers(terminal):
            print("not ok 1 - the scene is read\n#", scene)
            return
        start = time.monotonic()
        terminal.type(statement)
        answers(terminal)
        whole = max(time.monotonic() - start, 0.01)
        for k in range(i, count, len(scenes)):
            terminal.type(statement)
            time.sleep(chance.uniform(0, 1.1 * whole))
            os.write(terminal.fd, b"\x03")
            pressed = time.monotonic()
            time.sleep(0.02)  # it throws away what is typed before it is heard
            if not answers(terminal):
                ended = terminal.close()
                lost.append("%s: interrupt %d, status %d" % (statement, k, ended))
                terminal = Terminal(program)
                terminal.type(scene)
                answers(terminal)
                continue
            longest = max(longest, time.monotonic() - pressed)
        terminal.close()
    print("ok 1" if not lost else "not ok 1", "- Ctrl-C at random times ends a statement and no more")
    print("# %d interrupts, %d not survived, the longest wait %.2f s" % (count, len(lost), longest))
    for line in lost[:20]:
        print("#", line)


main()
