/* multiply.h -- sums and products of expanded expressions, multiplied out as polynomials by FLINT.
 *
 *     c + c1 x1 + c2 x2 + ...    a sum
 *     c x1^n1 x2^n2 ...          a product, n >= 1
 *
 * Each x is an expanded expression or an earlier item of the list, so (f + 1)*f with f = (x + y)^20 never becomes an
 * expression before its end. The variables of the polynomials are what cannot be multiplied out: symbols, functions,
 * derivatives, roots b^(1/q), powers b^e with another exponent, each with its inverse as a variable of its own. Terms of
 * the result are built as products of the pool, which joins what these variables have in common: sqrt(2)^2, x*x^(-1).
 *
 * The result is the expression that multiplying term by term gives, for this is what the pool makes of the same terms. It
 * takes 0.2 to 0.3 us a term and some 5 ns a product of terms, where a product of terms as expressions takes 0.5 us.
 *
 * Source  Monagan & Pearce, J. Symb. Comp. 46 (2011) 807 (the heaps by which FLINT multiplies).
 * Tests   tests/expr/polynomial/test_multiply.c
 */
#ifndef QDOT_EXPR_MULTIPLY_H
#define QDOT_EXPR_MULTIPLY_H

#include "base/memory.h"
#include "expr/id.h"

enum { QDOT_MULTIPLY_MOST_TERMS = 1000000 }; /* the most terms that a polynomial may have on the way */

typedef struct {
    qdot_expr e;    /* an expanded expression; nil: the value of an earlier item */
    uint32_t item;  /* the index of that item */
    qdot_expr c;    /* in a sum: its coefficient, a NUM */
    uint64_t power; /* in a product: its exponent, >= 1 */
} qdot_multiply_part;

typedef struct {
    bool is_sum;
    qdot_expr c;       /* the constant of a sum, the coefficient of a product; a NUM */
    size_t from, n;    /* parts[from ... from + n - 1] */
    double terms;      /* it has at most so many terms */
} qdot_multiply_item;

typedef struct {
    qdot_vec(qdot_multiply_item) items;
    qdot_vec(qdot_multiply_part) parts;
} qdot_multiply_list; /* start with {0}; free items.at and parts.at */

/* The number of terms that a sum of t terms to the power n has at most: (n + t - 1)! / (n! (t - 1)!). */
double qdot_multiply_terms_of_power(double t, uint64_t n);

/* The value of an item as an expanded expression. Nil, and the pool has failed: QDOT_ELIMIT if it would have more than
 * QDOT_MULTIPLY_MOST_TERMS terms, on the way or at its end, or if the budget of the pool does not last; QDOT_EINTR,
 * QDOT_ENOMEM. */
qdot_expr qdot_multiply_out(qdot_pool *pool, const qdot_multiply_list *list, uint32_t item);

#endif
