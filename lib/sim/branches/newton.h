/* newton.h -- n equations in n unknowns, solved to the last bits and proved.
 *
 *     x <- x - f'(x)^-1 f(x)
 *
 * with the exact derivatives of the equations' tape, until rounding is all that moves x. A zero is
 * then proved by Krawczyk's test (normal/solve/isolate.h), which also states how far x can be from
 * it; where it cannot be, twice the last step is its error.
 *
 * Tests  tests/sim/branches/test_continuation.c
 */
#ifndef QDOT_SIM_NEWTON_H
#define QDOT_SIM_NEWTON_H

#include "num/lu.h"
#include "tape/tape.h"

typedef struct {
    qdot_pool *pool;
    size_t n;
    qdot_expr *x, *f; /* [n] unknowns and equations, owned */
    qdot_tape *tape;
    double *f_value, *J, *step, *work; /* values [n], Jacobian [n x n], step and scratch [n] */
    qdot_lu_row *rows;
    bool regular; /* it is proved that the latest zero is regular (J not singular), or n is too large for a proof */
} qdot_newton;

/* Room for n equations; then x and f are filled, then they are lowered. From {0}; ended in any
 * case. Errors: QDOT_EUNSET and those of the pool. */
QDOT_MUST_CHECK qdot_status qdot_newton_begin(qdot_newton *s, qdot_pool *pool, size_t n);
QDOT_MUST_CHECK qdot_status qdot_newton_lower(qdot_newton *s);
void qdot_newton_end(qdot_newton *s);

/* From a guess x [n] to the zero near it, its error to error [n]. False where it does not converge:
 * x is anything then. */
QDOT_MUST_CHECK qdot_status qdot_newton_solve(qdot_newton *s, double *x, double *error,
                                              bool *found);

#endif
