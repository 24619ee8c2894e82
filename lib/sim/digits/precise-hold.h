/* precise-hold.h -- states brought onto the constraints, in all digits.
 *
 * F(x) = 0 are the constraints on positions, x = q, or on velocities, x = q', whose A = dF/dx has
 * the full rank over the free x_i. After an event has set some values, the others are free; as in
 * doubles (qdot_constrained_put) each step of Newton's method is the shortest one in the metric of
 * M at the state before it,
 *
 *     min dx^T M dx,   A dx = -F(x).
 *
 * Of a start, the point nearest to the values a as given is found (sim/start/start.h):
 *
 *     W (x - a) + A(x)^T lambda = 0,   F(x) = 0
 *
 * by Newton's method from the nearest point in doubles. W is 1 where only values that were not
 * named are free, M at a where all move. The derivative of A^T lambda is taken by differences over
 * half the digits: a step doubles the digits, or adds half of all.
 *
 * All matrices are evaluated and factored in MPFR.
 *
 * Tests  tests/script/digits/digits-constraint-events.lag, tests/script/digits/digits-start.lag
 */
#ifndef QDOT_SIM_PRECISE_HOLD_H
#define QDOT_SIM_PRECISE_HOLD_H

#include <mpfr.h>

#include "sim/model/equations.h"

typedef struct qdot_precise_hold qdot_precise_hold;

/* For a plan with constraints, which is borrowed; *hold is NULL for one without. Reads the pool: to
 * be called before threads begin. Errors: QDOT_ENOMEM, those of a constant. */
QDOT_MUST_CHECK qdot_status qdot_precise_hold_new(const qdot_plan *plan, mpfr_prec_t bits,
                                                  qdot_precise_hold **hold);
void qdot_precise_hold_free(qdot_precise_hold *hold);

/* Bring y [2n] at t onto the constraints after an event has set the values q_set, v_set [n] (NULL:
 * none: that level stays). QDOT_EDOMAIN: the constraints do not allow these values. */
QDOT_MUST_CHECK qdot_status qdot_precise_hold_put(qdot_precise_hold *hold, mpfr_srcptr t,
                                                  mpfr_t *y, const bool *q_set,
                                                  const bool *v_set);

/* Replace the positions or velocities of y [2n], a, by those nearest to them that keep the
 * constraints, near [n] in doubles; only free [n] values move. massive: in the metric of M, else of
 * 1. QDOT_EDOMAIN: not found. */
QDOT_MUST_CHECK qdot_status qdot_precise_hold_nearest(qdot_precise_hold *hold,
                                                      mpfr_srcptr t, mpfr_t *y,
                                                      bool velocities, const bool *free,
                                                      bool massive, const double *near);

#endif
