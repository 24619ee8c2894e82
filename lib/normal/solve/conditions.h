/* conditions.h -- conditions under which a solution exists: relations, each decided as far as possible.
 *
 * A set of conditions is a LIST of relations a < b and a <= b that must all hold; nil where there is none,
 * QDOT_FALSE where they cannot hold. A relation is decided from the declared domains and the facts, by proof
 * (normal/inequality): one that always holds is left out, one that never holds makes the set QDOT_FALSE.
 *
 * Tests  tests/normal/solve/test_condition-forms.c
 */
#ifndef QDOT_NORMAL_CONDITIONS_H
#define QDOT_NORMAL_CONDITIONS_H

#include "normal/field/facts.h"

/* Whether e contains only parameters, momenta and functions of them, which have generic values. */
bool qdot_is_generic(const qdot_pool *pool, qdot_expr e);

/* Whether the zeros of e do not count: it holds parameters alone, which are generic. They do count if facts->exact is
 * set, and where e is 0 in a whole region of the parameters, as |a| - a is. */
bool qdot_is_taken_generic(qdot_pool *pool, qdot_expr e, const qdot_facts *facts);

/* 0 < gap, or 0 <= gap if not strict: QDOT_TRUE, QDOT_FALSE if that is proved; else a relation, in its shortest
 * form. Unless facts->exact parameters are generic: where 0 <= gap is proved of them, 0 < gap counts as true. Nil on
 * failure. */
qdot_expr qdot_condition(qdot_pool *pool, qdot_expr gap, bool strict, const qdot_facts *facts);

/* The set of conditions with one more relation; the second function: the union of two sets. */
qdot_expr qdot_conditions_and(qdot_pool *pool, qdot_expr set, qdot_expr relation);
qdot_expr qdot_conditions_all(qdot_pool *pool, qdot_expr set, qdot_expr other);
/* The set of conditions with the further condition u != 0, written as 0 < |u|. */
qdot_expr qdot_conditions_and_nonzero(qdot_pool *pool, qdot_expr set, qdot_expr u);

/* Join two alternative sets of conditions to one, *set; false if no single set is equivalent. */
bool qdot_conditions_join(qdot_pool *pool, qdot_expr *set, qdot_expr other, const qdot_facts *facts);

/* The set with a < b in place of a <= b between parameters, because these have generic values. */
qdot_expr qdot_conditions_generic(qdot_pool *pool, qdot_expr set);
/* The set without relations that follow from the others, and with a < b in place of a <= b if a != b follows. */
qdot_expr qdot_conditions_reduce(qdot_pool *pool, qdot_expr set, const qdot_facts *facts);

/* The set with values put in for the symbols from [n], decided anew; a relation that is not defined there does
 * not hold. Relations that contradict each other: QDOT_FALSE. On failure nil, and the pool has failed. */
qdot_expr qdot_conditions_at(qdot_pool *pool, qdot_expr set, size_t n, const qdot_expr *from,
                             const qdot_expr *to, const qdot_facts *facts);

/* The conditions under which every part of f that holds x (nil: every part) is defined: of bases of roots, logarithms
 * and inverse functions. Denominators and poles are not among them. (definedness.c) */
qdot_expr qdot_conditions_of_domain(qdot_pool *pool, qdot_expr f, qdot_expr x);
/* The conditions under which the function node is defined, without those of its arguments. (definedness.c) */
qdot_expr qdot_conditions_of_function(qdot_pool *pool, qdot_expr function);
/* That no denominator in f that holds x (nil: any) is 0 and no part of it has a pole: 0 < |u| for u != 0.
 * (definedness.c) */
qdot_expr qdot_conditions_of_divisors(qdot_pool *pool, qdot_expr f, qdot_expr x);
/* Whether the base of a power in F [n], with one of the x [m] in its exponent, is not proved to be positive or 0: where it
 * is negative the power is real at single places only, and a formula need not give all solutions of F = 0. facts may be
 * NULL. (definedness.c) */
QDOT_MUST_CHECK qdot_status qdot_has_single_places(qdot_pool *pool, size_t n, const qdot_expr *F, size_t m,
                                                   const qdot_expr *x, const qdot_facts *facts, bool *yes);
/* The expression u if the relation is 0 < |u|; else nil. */
qdot_expr qdot_conditions_nonzero(const qdot_pool *pool, qdot_expr relation);
/* The relation u != 0 written with two sides, where negative terms are moved to the other side. */
qdot_expr qdot_conditions_unequal(qdot_pool *pool, qdot_expr u);

/* The facts with the relations of a set (nil: none) added; `room` [QDOT_CONDITIONS_MOST] holds them. More than
 * that are left out. */
enum { QDOT_CONDITIONS_MOST = 24 };
qdot_facts qdot_facts_and(const qdot_pool *pool, const qdot_facts *facts, qdot_expr set,
                          qdot_expr *room);

#endif
