/* constant.h -- values of expressions without symbols, from balls, as doubles or MPFR numbers.
 *
 * Tests  tests/expr/test_constant.c
 */
#ifndef QDOT_EXPR_CONSTANT_H
#define QDOT_EXPR_CONSTANT_H

#include <mpfr.h>

#include "expr/id.h"


/* One constant expression (no symbols) as a double, correctly rounded if 256 bits decide.
 * QDOT_EUNSET names a symbol without a value; QDOT_EDOMAIN: not real or undefined. */
QDOT_MUST_CHECK qdot_status qdot_constant_double(qdot_pool *pool, qdot_expr e, double *value);

/* As qdot_constant_double; *side is the sign of the exact value minus *value: -1, 0 or 1. */
QDOT_MUST_CHECK qdot_status qdot_constant_round(qdot_pool *pool, qdot_expr e,
                                                double *value, int *side);

/* As qdot_constant_round; *low: e = *value + *low to about twice the precision. */
QDOT_MUST_CHECK qdot_status qdot_constant_split(qdot_pool *pool, qdot_expr e,
                                                double *value, int *side, double *low);

/* e rounded to the precision of x, to within a unit of its last bit, found in balls of growing
 * precision. A value that is 0 to eight times that precision is taken as 0. Errors: as
 * qdot_constant_double. */
QDOT_MUST_CHECK qdot_status qdot_constant_real(qdot_pool *pool, qdot_expr e, mpfr_ptr x);

/* x as an exact rational number; nil: not finite, or a failure of the pool. */
qdot_expr qdot_constant_of_real(qdot_pool *pool, mpfr_srcptr x);

/* Fail with QDOT_EUNSET for the symbol or function application `e` that has no value. */
qdot_status qdot_constant_unset(const qdot_pool *pool, qdot_expr e);
/* The same for all parameters, momenta and applications among e [n] at once; for the first where it
 * is something else. QDOT_OK: n is 0. */
qdot_status qdot_constant_unset_all(const qdot_pool *pool, size_t n, const qdot_expr *e);

/* Whether, since the last call, the error of the number of an integral was an estimate and not a bound. */
bool qdot_constant_estimated_taken(qdot_pool *pool);

#endif
