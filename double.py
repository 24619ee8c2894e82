# coord theta1
# coord theta2
# particle a mass m1 at (L1*sin(theta1), -L1*cos(theta1))
# particle b mass m2 at (L1*sin(theta1) + L2*sin(theta2), -L1*cos(theta1) - L2*cos(theta2))
# gravity (0, -g)
#
#     M(q, t) q'' = f(q, q', t),   state = (q, q')
#
# Written by qdot. `python3 double.py` integrates and prints t, q, q'; as a module:
#
#     import double as s
#     run = s.integrate(s.Parameters())
from dataclasses import dataclass

import numpy as np


@dataclass
class Parameters:
    """The values of `set`; nan: none."""

    m1: float = 1.0  # m1
    m2: float = 1.0  # m2
    L1: float = 1.0  # L1
    L2: float = 1.0  # L2
    g: float = 9.81  # g


COORDINATES = ["theta1", "theta2"]
START = np.array([2.0, 2.0, 0.0, 0.0])
SPAN = (0.0, 2.0)
TOLERANCE = 1e-12


def equations(t, state, p):
    """M and f."""
    M = np.zeros((2, 2))
    f = np.zeros(2)
    theta1 = state[0]
    theta2 = state[1]
    theta1_dot = state[2]
    theta2_dot = state[3]
    m1 = p.m1
    m2 = p.m2
    L1 = p.L1
    L2 = p.L2
    g = p.g
    w1 = m1 + m2
    w2 = np.sin(theta1)
    w3 = np.cos(theta1)
    w4 = np.sin(theta2)
    w5 = np.cos(theta2)
    w6 = L2*(m2*L1)
    w7 = (w2*w4 + w3*w5)*w6
    w8 = (w2*w5 - w3*w4)*w6
    w9 = -(w8*(theta2_dot*theta2_dot) + w2*(g*(L1*w1)))
    M[0, 0] = w1*(L1*L1)
    M[0, 1] = w7
    M[1, 0] = w7
    M[1, 1] = m2*(L2*L2)
    f[0] = w9
    f[1] = w8*(theta1_dot*theta1_dot) - w4*(g*(m2*L2))
    return M, f


def accelerations(t, state, p):
    """q''."""
    M, f = equations(t, state, p)
    return np.linalg.solve(M, f)


def derivative(t, state, p):
    """state' = (q', q'')."""
    return np.concatenate((state[2:], accelerations(t, state, p)))


def jacobian(t, state, p):
    """d(state')/d(state), exact derivatives."""
    M, f = equations(t, state, p)
    acc = np.linalg.solve(M, f)
    R = np.zeros((2, 4))
    theta1 = state[0]
    theta2 = state[1]
    theta1_dot = state[2]
    theta2_dot = state[3]
    theta1_ddot = acc[0]
    theta2_ddot = acc[1]
    m1 = p.m1
    m2 = p.m2
    L1 = p.L1
    L2 = p.L2
    g = p.g
    w1 = np.sin(theta1)
    w2 = np.cos(theta1)
    w3 = np.sin(theta2)
    w4 = np.cos(theta2)
    w5 = L2*(m2*L1)
    w6 = (w1*w4 - w2*w3)*w5
    w7 = theta2_ddot*w6
    w8 = (w1*w3 + w2*w4)*w5
    w9 = w8*(theta2_dot*theta2_dot)
    w10 = w8*(theta1_dot*theta1_dot) + theta1_ddot*w6
    R[0, 0] = w7 - w9 - w2*(g*(L1*(m1 + m2)))
    R[0, 1] = w9 - w7
    R[0, 3] = theta2_dot*w6*(-2.0)
    R[1, 0] = w10
    R[1, 1] = -(w4*(g*(m2*L2)) + w10)
    R[1, 2] = theta1_dot*w6*2.0
    J = np.zeros((4, 4))
    J[:2, 2:] = np.eye(2)
    J[2:] = np.linalg.solve(M, R)[:2]
    return J


def energy(t, state, p):
    """sum p q' - L."""
    theta1 = state[0]
    theta2 = state[1]
    theta1_dot = state[2]
    theta2_dot = state[3]
    m1 = p.m1
    m2 = p.m2
    L1 = p.L1
    L2 = p.L2
    g = p.g
    w1 = m1 + m2
    w2 = np.cos(theta1)
    w3 = np.cos(theta2)
    w4 = (np.sin(theta1)*np.sin(theta2) + w2*w3)*(L2*(m2*L1))
    w5 = theta1_dot*(theta2_dot*w4 + theta1_dot*(w1*(L1*L1)))
    w6 = theta2_dot*(theta1_dot*w4 + theta2_dot*(m2*(L2*L2))) + w5
    return w6*0.5 - (w3*(g*(m2*L2)) + w2*(g*(L1*w1)))


def integrate(p, state=START, span=SPAN, tol=TOLERANCE, method="DOP853", **options):
    """The result of scipy.integrate.solve_ivp, with its dense output."""
    from scipy.integrate import solve_ivp

    if method in ("Radau", "BDF", "LSODA"):
        options.setdefault("jac", jacobian)
    return solve_ivp(derivative, span, state, method, args=(p,), dense_output=True,
                     rtol=max(tol, 2.3e-14), atol=tol, **options)


if __name__ == "__main__":
    runs = [integrate(Parameters())]
    for run in runs:
        for t in np.linspace(run.t[0], run.t[-1], 101):
            print(repr(float(t)), *(repr(float(x)) for x in run.sol(t)))
        if run.status < 0:
            raise SystemExit(run.message)
