"""scenes.py -- systems that several tests use."""
import qdot

PENDULUM = """
    param m, l, g > 0
    coord theta
    particle bob mass m at (l*sin(theta), -l*cos(theta))
    gravity (0, -g)
    set m = 1, l = 1, g = 9.81
    start theta = 2
"""

OSCILLATOR = "coord x; particle p mass 1 at (x, 0); potential x^2/2; start x = 1"

# its run to 1.5e7 takes many seconds and is not refused for its length
LONG = "coord x; particle p mass 1 at (x, 0); potential x^4; start x = 1"


def pendulum():
    return qdot.System(PENDULUM)


def oscillator():
    return qdot.System(OSCILLATOR)


def end_of_run(t):
    """Return the last time of a run to t, made in the process that is asked."""
    return oscillator().run(f"0..{t}").summary.end
