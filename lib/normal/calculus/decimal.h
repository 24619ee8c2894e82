/* decimal.h -- constants as decimal numbers: pi as 3.1416, sqrt(2) m as 1.4142 m.
 *
 * A decimal number is an exact rational. What was proved to be 0 is 0; a constant of which neither its digits nor
 * that proof can be found fails.
 *
 * Tests  tests/lang/functions/test_numeric.c, tests/script/solve/numeric.lag, tests/bad/solve/numeric-*.lag
 */
#ifndef QDOT_NORMAL_DECIMAL_H
#define QDOT_NORMAL_DECIMAL_H

#include "expr/id.h"

/* The constant e rounded to so many digits; |e - *value| <= *error. QDOT_EDOMAIN: not real, undefined, not told from
 * 0; QDOT_ELIMIT: too large or too small to be written. */
QDOT_MUST_CHECK qdot_status qdot_decimal(qdot_pool *pool, qdot_expr e, int digits, qdot_expr *value,
                                         double *error);

/* Write e with each maximal constant subexpression as a decimal of `digits` digits. Errors: as qdot_decimal. */
QDOT_MUST_CHECK qdot_status qdot_decimals_beside_symbols(qdot_pool *pool, qdot_expr e, int digits,
                                                         qdot_expr *value);

#endif
