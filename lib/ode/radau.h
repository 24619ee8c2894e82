/* radau.h -- Radau IIA of 3, 5 and 7 stages, orders 5, 9 and 13, for stiff equations.
 *
 * Of M(t, y) v' = f(t, y), q' = v (system.h, qdot_ode_mass_form) the stages V_i = v + Z_i are found
 * from
 *
 *     f(t + c_i h, Q_i, V_i) - M a_i = 0,   a_i = 1/h sum_j (A^-1)_ij Z_j,
 *     Q_i = q + c_i h v + h sum_j a_ij Z_j,
 *
 * by Newton's iteration with the slopes at the beginning of the step, or of an earlier one while it
 * converges fast; M is not inverted. The last stage is the end of the step: such methods damp what is
 * stiff at once (L-stable, stiffly accurate). Equations of order one are the case without q.
 *
 * Multipliers of constraints are further unknowns of each stage, with the constraints of velocities
 * (index 2), which the stages keep; positions are projected between steps. M may be singular where the
 * matrices of the iteration are not. The iteration goes on while multipliers change velocities within
 * h; their errors are not tested, since no step takes anything from the multipliers before it. Errors
 * of velocities with which no mass moves, which follow at every moment, count h-fold, as positions.
 *
 * The iteration begins with the polynomial of the step before (with y, if that was much shorter) and ends
 * when what is missing is below NEWTON of a tolerance and forces agree with accelerations in each stage,
 * within AGREE of their terms: where slopes are large, as in the layer of dry friction, velocities agree
 * long before. The error is that of the formula with a stage more at the beginning of the step: the defect
 * there, filtered,
 *
 *     e = (1 - h/lambda df/dy)^-1  h/lambda (f(t, y) - u'(t)),
 *
 * with the real eigenvalue lambda. It goes as h^(s+1), while the step errs by h^(2s) where nothing is
 * stiff, so it is safe. Where it does not bound the steps, the iteration converges fast (its rate below
 * FAST) and the error of steps of one length fell twice in a row, as a transient dies out, it is taken to
 * fall once more, and the step grows by that too. The number of stages rises where the iteration converges
 * fast and the error bounds the steps, and falls where it does not converge well (above SLOW).
 *
 * Between the ends of a step stands the polynomial of its stages, with an error of h^(s+1).
 *
 * Source  Hairer & Wanner, Solving Ordinary Differential Equations II, 2nd ed. (1996), IV.8, VII.4;
 *         Hairer & Wanner, J. Comput. Appl. Math. 111 (1999) 93.
 * Tests   tests/ode/test_radau.c: orders measured, polynomials, stiff problems
 */
#ifndef QDOT_ODE_RADAU_H
#define QDOT_ODE_RADAU_H

#include "ode/stepper.h"

/* The functions of the method `radau`, for the table of method.h. */
extern const qdot_ode_kernel qdot_radau;

/* For tests: use only 3, 5 or 7 stages from now on. */
void qdot_radau_keep_stages(qdot_ode_stepper *s, size_t stages);

#endif
