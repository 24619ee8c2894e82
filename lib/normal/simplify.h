/* simplify.h -- the form a person would write.
 *
 * Among equal forms (normal form, factored, Pythagoras either way, sums of angles, common factors
 * out, collected in velocities and accelerations) the one with the fewest operations.
 * Deterministic. Works on any kind of value; never fails for size: when its work budget is
 * spent it returns the best form so far (e itself if none).
 */
#ifndef QDOT_NORMAL_SIMPLIFY_H
#define QDOT_NORMAL_SIMPLIFY_H

#include "expr/expr.h"
#include "normal/decide.h"

qdot_expr qdot_simplify(qdot_pool *pool, qdot_expr e, const qdot_facts *facts);

/* The same with a budget for each scalar, in operations on terms of polynomials;
 * *spent: whether one was spent, so that there may be a shorter form. */
enum { QDOT_SIMPLIFY_WORK = 4000000 };
qdot_expr qdot_simplify_within(qdot_pool *pool, qdot_expr e, const qdot_facts *facts,
                               int64_t work, bool *spent);

/* Whether e is seen at a glance to be as simple as it can be without relations: powers of symbols
 * times one function and one sum of parameters at most. e a scalar. */
bool qdot_simplify_is_done(const qdot_pool *pool, qdot_expr e);

/* Whether e is a sum of terms in different velocities and accelerations, one in each to whatever power,
 * times parameters, one sum of them and one sine or cosine of a coordinate or of the difference of two
 * at most: nothing in two of them goes together but a common factor. */
bool qdot_simplify_is_collected(const qdot_pool *pool, qdot_expr e);

/* The simplest form of e without relations where it is seen at a glance: e itself if it is done,
 * P cos(a - b) for P cos(a) cos(b) + P sin(a) sin(b) and its like, P powers of symbols and a, b
 * coordinates. Nil: it takes more than a glance. e a scalar. */
qdot_expr qdot_simplify_seen(qdot_pool *pool, qdot_expr e);

/* e with u for |u|, 1 for sign u where the conditions of `facts` make u > 0, and so with -u, -1; of
 * what declared domains say the constructors know. qdot_simplify does so. */
qdot_expr qdot_known_signs(qdot_pool *pool, qdot_expr e, const qdot_facts *facts);

/* A sum with the factors that all its terms share in front, where that is shorter; a product of a
 * fraction and a sum with other numbers in it as that sum, each term with its own. The form of T,
 * of equations, of Hamilton's function. */
qdot_expr qdot_common_out(qdot_pool *pool, qdot_expr e);

/* The exact normal form as an expression: numerator over denominator, coprime, expanded. */
qdot_expr qdot_normal(qdot_pool *pool, qdot_expr e, const qdot_facts *facts);

/* Solve the n x n linear system A x = b symbolically, block by block, fraction-free, zero pivots
 * recognised by the normal form; small blocks whose solution multiplied out would be longer than
 * what was given, by Cramer's rule (cramer.h). QDOT_ESINGULAR: *pivot is the column without one.
 * QDOT_ELIMIT past the budget: the message says how large. A [n*n] row-major, b [n], x [n]. */
QDOT_MUST_CHECK qdot_status qdot_solve_linear(qdot_pool *pool, uint32_t n,
                                              const qdot_expr *A, const qdot_expr *b,
                                              qdot_expr *x, uint32_t *pivot,
                                              const qdot_facts *facts);
#endif
