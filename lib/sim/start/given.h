/* given.h -- the values of a start as balls, so that what is 0 there is not rounded.
 *
 * A value that is still as it was asked for is that expression (-pi/2, not the double beside it); one
 * that was moved is known to two doubles. So cos(theta) at theta = -pi/2 is 0, and no slope of 6e-17.
 *
 * Tests  tests/sim/start/test_start.c
 */
#ifndef QDOT_SIM_GIVEN_H
#define QDOT_SIM_GIVEN_H

#include "num/arb.h"
#include "sim/model/equations.h"
#include "sim/model/request.h"

enum { QDOT_GIVEN_BITS = 256 };

typedef struct {
    size_t n; /* length of the state y: 2n for n coordinates */
    const qdot_plan *plan;
    arb_ptr at; /* [n] start values of q, q' as balls (numbers with error bounds) */
} qdot_given;

/* Set up the start state y + low [2n] of a request as balls. Clear g in any case. */
QDOT_MUST_CHECK qdot_status qdot_given_init(qdot_given *g, const qdot_plan *plan,
                                            const qdot_run_request *request, const double *y,
                                            const double *low);
void qdot_given_clear(qdot_given *g);

/* Evaluate expressions [m] of the plan's inputs at the start, rounded; 0 for those not proved
 * different from 0. */
QDOT_MUST_CHECK qdot_status qdot_given_evaluate(const qdot_given *g, size_t m,
                                                const qdot_expr *e, double *out);

/* The midpoint of a ball as a double: 0 if the ball contains 0, NAN if it is NULL or not finite. */
double qdot_given_double(arb_srcptr b);

#endif
