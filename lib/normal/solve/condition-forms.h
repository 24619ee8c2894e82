/* condition-forms.h -- conditions 0 < g and 0 <= g whose gap g holds magnitudes or square roots, by a simpler gap.
 *
 *     v - |v|      is 0 where v >= 0 and negative elsewhere
 *     s - t        has the sign of s^2 - t^2, s and t not negative
 *     s + e + c    is positive where s^2 >= e^2, s and c not negative
 *
 * Tests  tests/normal/solve/test_condition-forms.c
 */
#ifndef QDOT_NORMAL_CONDITION_FORMS_H
#define QDOT_NORMAL_CONDITION_FORMS_H

#include "expr/id.h"

/* Whether e may be 0 in whole regions, as |a| - a is: with other values of |u|, sign u, max, min put in, it is 0
 * identically. */
bool qdot_vanishes_in_regions(qdot_pool *pool, qdot_expr e);
/* Whether e holds a power with an exponent that is no integer: such a sum, as sqrt((a - 1)^2) - a + 1, may be 0 in regions
 * without a choice in it. */
bool qdot_holds_root(qdot_pool *pool, qdot_expr e);

/* Of a gap k |v| + k v or k |v| - k v, k a number: v or -v, which is positive where the gap is (strict), or not negative
 * where the gap is not negative. QDOT_ONE: the condition always holds, QDOT_MINUS_ONE: never. Nil: the gap has another
 * form. */
qdot_expr qdot_condition_without_magnitude(qdot_pool *pool, qdot_expr gap, bool strict);

/* A - B exp(r/c) for a gap c log(A) - c log(B) - r, c > 0, r a number, and alike for sums of several logarithms with
 * coefficients c and -c: positive where the gap is, and not negative where the gap is not negative. One of the arguments
 * before which c stands may be of any sign, for A > B > 0 says that it is positive. Nil: others are not known to be
 * positive, or the gap has another form. */
qdot_expr qdot_condition_of_logarithms(qdot_pool *pool, qdot_expr gap);

/* Of a gap with a power beside a constant, as 3 - 2 sqrt(u): 9/4 - u, which is positive where the gap is, and alike of
 * several powers of what is never negative. *base: what must not be negative for that, nil if it cannot be. Nil: the gap
 * has another form. */
qdot_expr qdot_condition_of_power(qdot_pool *pool, qdot_expr gap, qdot_expr *base);

/* For a gap s + e + c or e - s - c, where s is the one term with a square root and not negative, c > 0 the constant terms:
 * s^2 - e^2. Where that is not negative s >= |e|, and the gap is positive (*above) or negative. Nil: another form. */
qdot_expr qdot_condition_beside_root(qdot_pool *pool, qdot_expr gap, bool *above);

/* For a condition s - t > 0 with square roots: s^2 - t^2 if s and t are never negative; else nil. */
qdot_expr qdot_condition_squared(qdot_pool *pool, qdot_expr gap);

/* A relation between c h(u) + d and a number, u not a number and h monotone, as one of u: atan(u) < 1 is u < tan(1). Where
 * the number is no value of h it stays as it is. */
qdot_expr qdot_condition_unfolded(qdot_pool *pool, qdot_expr relation);

/* v - h^{-1}(0) for u = h(v) with monotonic h, which has the same zeros as u; otherwise u. */
qdot_expr qdot_argument_at_zero(qdot_pool *pool, qdot_expr u);

#endif
