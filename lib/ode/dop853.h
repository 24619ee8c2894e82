/* dop853.h -- Dormand & Prince's method of order 8, with errors of orders 5 and 3 and a
 * polynomial of degree 7 between the ends of a step.
 *
 *     k_s = f(t + c_s h, y + h sum_j a_sj k_j),   s = 0 .. 11,   k_0 = f(t, y)
 *     y(t + h) = y + h sum_j b_j k_j,   k_12 = f there, the k_0 of the next step
 *
 * Twelve evaluations a step taken, eleven a step refused. With E5 and E3 the largest
 * components, in units of tol max(s_i, |y_i|), of how far the results of orders 5 and 3 are
 * off,
 *
 *     ratio = E5^2 / sqrt(E5^2 + E3^2 / 100),
 *
 * which goes as h^8 (eq. II.10.16 in the maximum norm).
 *
 * Between the ends, with x = (t' - t)/h and three more evaluations k_13 .. k_15,
 *
 *     y(t') = y + x (F0 + (1-x) (F1 + x (F2 + (1-x) (F3 + x (F4 + (1-x) (F5 + x F6))))))
 *     F0 = y(t + h) - y,  F1 = h k_0 - F0,  F2 = 2 F0 - h (k_0 + k_12),
 *     F_p = h sum_j d_pj k_j for p = 3 .. 6
 *
 * with an error of h^8, while that of the step is h^9. Measured, a step's polynomial errs by up
 * to five tolerances more than its ends, so trajectory.h uses the polynomials of half steps: then
 * it is 0.15 tolerances at most (below tol 1e-6).
 *
 * Its companion (companion.h) uses the same method: the error estimate of rk8pd has too much
 * rounding for a tight tolerance if f is large (a stiff spring, k/m = 1e6, at tol 1e-14: 2.8
 * million steps for 63,000). If all is rounding the two may agree by chance: of 1224 runs at tol
 * 1e-6 .. 1e-16 fifteen, all at 1e-14 or less, erred by more than three times the stated error,
 * at most twenty times.
 *
 * Source  Hairer, Norsett & Wanner, Solving Ordinary Differential Equations I, 2nd ed.
 *         (1993), II.5, II.6, II.10; the coefficients in dop853.def.
 * Tests   tests/ode/test_dop853.c
 */
#ifndef QDOT_ODE_DOP853_H
#define QDOT_ODE_DOP853_H

#include "ode/stepper.h"

/* The functions of the method dop853, for the table of method.h. */
extern const qdot_ode_kernel qdot_dop853;

#endif
