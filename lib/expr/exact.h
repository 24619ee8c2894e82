/* exact.h -- exact rational numbers as expressions.
 *
 * Tests  tests/expr/test_pool.c, tests/expr/test_rational.c
 */
#ifndef QDOT_EXPR_EXACT_H
#define QDOT_EXPR_EXACT_H

#include <flint/fmpq.h>

#include "expr/id.h"

/* The rational value of a NUM; NULL for any other kind. It stays valid as long as the pool. */
const fmpq *qdot_expr_rational(const qdot_pool *pool, qdot_expr e);
/* Whether e is an integer that fits 64 bits; *value is the integer. */
bool qdot_expr_to_int(const qdot_pool *pool, qdot_expr e, int64_t *value);

qdot_expr qdot_expr_int(qdot_pool *pool, int64_t n);
qdot_expr qdot_expr_ratio(qdot_pool *pool, int64_t n, int64_t d);
qdot_expr qdot_expr_fmpz(qdot_pool *pool, const fmpz_t n);
qdot_expr qdot_expr_fmpq(qdot_pool *pool, const fmpq_t x);
/* Make the exact number written as a decimal: "9.81" is 981/100; QDOT_ELIMIT: more than 10^6 digits. */
qdot_expr qdot_expr_decimal(qdot_pool *pool, const char *text, size_t length);
/* The rational that equals a finite double exactly. */
qdot_expr qdot_expr_of_double(qdot_pool *pool, double x);

#endif
