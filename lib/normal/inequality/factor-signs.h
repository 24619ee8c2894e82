/* factor-signs.h -- the sign of an expression as that of a product: of its factors, of those that are linear in a sine or
 * cosine at both ends of its range. Within qdot_flint_run (expr/polynomial/flint.h).
 *
 * Tests  tests/normal/inequality/test_less.c
 */
#ifndef QDOT_NORMAL_FACTOR_SIGNS_H
#define QDOT_NORMAL_FACTOR_SIGNS_H

#include "expr/id.h"

/* What is known of the sign of e, as bits QDOT_GE0, QDOT_LE0, QDOT_NE0; 0: nothing. */
uint8_t qdot_sign_by_factors(qdot_pool *pool, qdot_expr e);

/* The expression e without its factors of known sign; it has the sign of e wherever e is defined. */
qdot_expr qdot_without_signed_factors(qdot_pool *pool, qdot_expr e);

#endif
