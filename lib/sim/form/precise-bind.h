/* precise-bind.h -- a plan as a system in numbers of any precision.
 *
 *     M(q, t) q'' = f(q, q', t),   order k:  M_0 a_k = f_k - sum_{j=1..k} M_j a_{k-j}
 *
 * block by block as motion-series.h has it, M_0 factored once a step by elimination with pivots.
 * With constraints the same of [M A^T; A 0] (q'', -lambda) = (f, gamma): nothing is projected,
 * since the guard digits that the drift eats are among those that are measured.
 *
 * Tests  tests/sim/digits/test_precise.c
 */
#ifndef QDOT_SIM_PRECISE_BIND_H
#define QDOT_SIM_PRECISE_BIND_H

#include "ode/precise.h"
#include "sim/model/equations.h"

typedef struct qdot_precise_bind qdot_precise_bind;

/* The plan is borrowed, its pool used here and not after. Errors: QDOT_ESINGULAR names
 * the coordinate of a constant M; QDOT_ELIMIT: the coefficients do not fit into 2 GB;
 * those of constants; QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_precise_bind_new(const qdot_plan *plan, int most,
                                                  mpfr_prec_t bits,
                                                  qdot_precise_bind **bind);
void qdot_precise_bind_free(qdot_precise_bind *bind);

/* The system of equations for ode/precise.h, with n = 2 plan->n; valid while the bind lives. */
const qdot_precise_system *qdot_precise_bind_system(const qdot_precise_bind *bind);

/* The acceleration q''_i at the state last passed to `begin`. */
mpfr_srcptr qdot_precise_bind_acceleration(const qdot_precise_bind *bind, size_t i);

/* Read the Lagrange multiplier of constraint k at the state last passed to `begin`. */
void qdot_precise_bind_multiplier(const qdot_precise_bind *bind, size_t k, mpfr_ptr lambda);

/* The number of times that the mass matrix M was factored. */
size_t qdot_precise_bind_factored(const qdot_precise_bind *bind);

#endif
