/* terms.h -- expanded expressions as polynomials of FLINT, and back.
 *
 *     c g1^k1 g2^k2 ...  <->  c x1^k1 x2^k2 ...,  k >= 0
 *
 * A variable x stands for a power g = b^u of a base b that a product of the pool has: u = 1 or -1 for whole exponents, 1/q or
 * -1/q for p/q, the exponent itself if it is no number. Inside a guarded computation (flint.h) only.
 *
 * Tests  tests/expr/polynomial/test_multiply.c
 */
#ifndef QDOT_EXPR_TERMS_H
#define QDOT_EXPR_TERMS_H

#include <flint/fmpz_mpoly.h>

#include "base/memory.h"
#include "expr/id.h"

typedef struct {
    qdot_expr base, unit; /* the variable stands for base^unit */
} qdot_variable_power;

/* Start with {.pool = pool}; find the variables of all expressions, then settle, then read and write. */
typedef struct {
    qdot_pool *pool;
    qdot_vec(qdot_variable_power) at; /* in the order of the variables: the last factor of a term first */
    slong n;                          /* how many; 0 before they are settled */
    bool apart;                       /* no base stands for two of them, and products need only be sorted */
    fmpz_mpoly_ctx_t ctx;
    ulong *exp; /* [n] work space */
} qdot_variables;

/* Add what occurs in the terms of e. */
void qdot_variables_find(qdot_variables *v, qdot_expr e);
void qdot_variables_settle(qdot_variables *v);
void qdot_variables_end(qdot_variables *v);

/* e = c p. */
void qdot_terms_read(qdot_variables *v, fmpz_mpoly_t p, fmpq_t c, qdot_expr e);
/* The expression c p. Nil: the pool failed. */
qdot_expr qdot_terms_write(qdot_variables *v, const fmpz_mpoly_t p, const fmpq_t c);

#endif
