/* dimensions.h -- the dimensions of symbols, inferred from the expressions in which they stand.
 *
 * Every symbol (a parameter, a coordinate, a function, a multiplier) has an unknown dimension, a vector of exponents. The
 * dimension of an expression is affine in these: dim(m*x'^2) = dim(m) + 2 dim(x) - 2 time. A sum, an equation, the
 * argument of a function each say that two such forms are equal: a linear equation over the rationals, whose
 * coefficients are the same for all base quantities. They are solved one after another, by elimination; an equation
 * that contradicts those before it is refused, and leaves no trace.
 *
 *     number               0; the number 0 has every dimension
 *     t                    time
 *     q', q''              dim(q) - time, dim(q) - 2 time
 *     p[q], dq, delta[q]   energy + time - dim(q), or that of what p[q] stands for, dim(q), dim(q)
 *     a unit, [kg]         itself: units are symbols whose value is 1 (expr/unit.h)
 *     a + b                dim(a) = dim(b)
 *     a^x                  x dim(a) for a rational number x; else dim(a) = dim(x) = 0
 *     sin(a) ...           dim(a) = 0;   abs, min, max, mod, if: the dimension of their values; sign: 0
 *     a number of a run    0, since its unit stands beside it, but for what stands for something
 *     f(a, b)              dim(f), less that of the arguments by which it is differentiated; dim(a) is the same everywhere
 *
 * Tests  tests/dimensions/test_dimensions.c
 */
#ifndef QDOT_DIMENSIONS_H
#define QDOT_DIMENSIONS_H

#include "expr/id.h"
#include "units/dimension.h"

typedef struct qdot_dimensions qdot_dimensions;

/* What a symbol stands for, such as a value along a run, a momentum, a multiplier: an expression of the same dimension; nil:
 * nothing. */
typedef qdot_expr (*qdot_stands_for)(const void *user, qdot_expr symbol);

/* NULL: no memory. The pool is borrowed. */
qdot_dimensions *qdot_dimensions_new(qdot_pool *pool, qdot_stands_for stands_for, const void *user);
void qdot_dimensions_free(qdot_dimensions *d);

/* Each of these fails with QDOT_ETYPE and a message that names both dimensions where what it says contradicts what is
 * known; QDOT_ENOMEM. */

/* The sums, relations and arguments of functions within e must agree. */
QDOT_MUST_CHECK qdot_status qdot_dimensions_visit(qdot_dimensions *d, qdot_expr e);
/* a and b (scalars, or both vectors) are of one dimension; `format` says how they meet: "%s is added to %s". */
QDOT_MUST_CHECK qdot_status qdot_dimensions_join(qdot_dimensions *d, qdot_expr a, qdot_expr b, const char *format);
/* e is of this dimension; `format` says what it should be, from the two dimensions in words: "its mass is %s, not %s". */
QDOT_MUST_CHECK qdot_status qdot_dimensions_fix(qdot_dimensions *d, qdot_expr e, qdot_dimension is, const char *format);

/* What is known of a dimension. */
typedef enum { QDOT_DIMENSION_KNOWN, QDOT_DIMENSION_FREE, QDOT_DIMENSION_ANY, QDOT_DIMENSION_NONE } qdot_dimension_state;
/* The dimension of e: KNOWN; FREE: not determined, up to the dimensions of other symbols; ANY: e is 0; NONE: it is a vector
 * with components of several dimensions, or contradicts what is known. Records no failure. */
qdot_dimension_state qdot_dimensions_of(qdot_dimensions *d, qdot_expr e, qdot_dimension *dimension);

/* How many equations have been found independent: it grows with each that told something new. */
size_t qdot_dimensions_rank(const qdot_dimensions *d);

/* Append the dimension of e, in words: "a force"; where it is FREE, by other names: "the dimension of k times m^2". */
void qdot_dimensions_words(qdot_dimensions *d, qdot_expr e, qdot_text *out);

/* A basis of the products of powers of the x [n] that have no dimension (Buckingham's theorem): rows of n integer
 * exponents, shortest first; *power is to be freed. What is not determined of their dimensions counts as further base
 * quantities. */
QDOT_MUST_CHECK qdot_status qdot_dimensions_groups(qdot_dimensions *d, size_t n, const qdot_expr *x, size_t *count,
                                                   int32_t **power);

#endif
