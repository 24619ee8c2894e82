/* saddle-solver.h -- [M A^T; A 0] of a series under constraints, and what it says of their independence.
 *
 * It is factored by its pattern, or by the null space where rows are, or nearly, dependent
 * (num/saddle.h): the motion goes on there, only its series is less sure.
 *
 * Tests  tests/sim/model/test_constraints.c
 */
#ifndef QDOT_SIM_SADDLE_SOLVER_H
#define QDOT_SIM_SADDLE_SOLVER_H

#include "series/taylor.h"
#include "sim/model/constraints.h"

/* Orders that are solved for with a correction by the residual: an error of the inverse is the same at
 * every order of a step, and so a drift of the energy instead of noise. With 0 that of the Cartesian
 * pendulum grows as t; from 3 on as the square root of t. Series shorter than the other are for
 * tolerances at which no rounding counts. */
enum { QDOT_SADDLE_REFINED = 3, QDOT_SADDLE_LEAST_REFINED = 18 };

/* An entry of the mass matrix M or of the constraint matrix A. */
typedef struct {
    const double *series; /* Taylor coefficients of the entry, up to the sign; borrowed */
    double sign;          /* the entry is `sign` times the series */
} qdot_saddle_series;

typedef struct {
    const qdot_plan *plan;
    qdot_saddle matrix;        /* the linear system for q'' and -lambda */
    qdot_saddle_series *M, *A; /* entries of M [n_masses] and of A [n_slopes] */
    double best;               /* largest measure of the constraints' independence in factorisations so far */
    double *weak;              /* [m + n] scratch */
} qdot_saddle_solver;

/* Of a plan with constraints and the series of its motion (motion-of-constraints.h), borrowed. Errors:
 * QDOT_ENOMEM; clear it in any case. */
QDOT_MUST_CHECK qdot_status qdot_saddle_solver_init(qdot_saddle_solver *s, const qdot_plan *plan,
                                                    const qdot_taylor *series);
void qdot_saddle_solver_clear(qdot_saddle_solver *s);

/* Before the first factorisation: measure the rows near the state y [2n], t (qdot_constrained_look_beside).
 * Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_saddle_solver_look(qdot_saddle_solver *s, double t, const double *y);

/* Factor the matrix; its entries must be known to order 0. Errors: those of qdot_constrained_factor. */
QDOT_MUST_CHECK qdot_status qdot_saddle_solver_factor(qdot_saddle_solver *s);

/* Relative noise of coefficients, of a series whose matrix is factored; how far ahead constraints
 * become dependent, 0: nothing is seen, from orders up to 3 of A: as qdot_ode_series has them. */
double qdot_saddle_solver_noise(qdot_saddle_solver *s);
double qdot_saddle_solver_ahead(qdot_saddle_solver *s, double unit);

#endif
