/* repeated-zeros.h -- a function without jumps that vanishes where one with jumps is 0.
 *
 * g = c f + d, with numbers c and d, is 0 where f = k = -d/c:
 *
 *     f                zeros                       u
 *     mod(a, b)        a = k + n b, 0 <= k/b < 1   sin(pi (a - k)/b)
 *     tan(a)           a = atan(k) + n pi          sin(a - atan(k))
 *     floor(a)         k <= a < k + 1, k integer   min(a - k, 0) + max(a - k - 1, 0)
 *     atan2(y, x)      -pi < k <= pi               y cos(k) - x sin(k), on one of two half planes
 *
 * No jump of f, nor a pole, is a zero of u, and each zero is simple; so u is followed as any smooth function is. Every
 * second zero of the sines has the other way than g: u times the sign of `turn` goes as g does.
 *
 * Tests  tests/sim/model/test_repeated-zeros.c, tests/script/events/event-strobes.lag, event-powers.lag
 */
#ifndef QDOT_SIM_REPEATED_ZEROS_H
#define QDOT_SIM_REPEATED_ZEROS_H

#include "expr/id.h"

typedef struct {
    qdot_expr u; /* smooth function with the zeros of g; g itself if there is none, or g has accelerations or multipliers */
    qdot_expr turn; /* sign of dg/du at a zero of u, never 0; nil: g rises and falls with u */
    bool half;      /* zeros of u with turn < 0 are not zeros of g */
    bool touches;   /* g does not change sign: f reaches k by a jump, or g is v^2 */
} qdot_repeated;

/* Find u (and `turn`) for the function g with parameter values. Errors: of the pool; a constant is not real. */
QDOT_MUST_CHECK qdot_status qdot_repeated_zeros(qdot_pool *pool, qdot_expr g, qdot_repeated *out);

/* What is watched for the zeros of g: first v in place of |v|, v^2 or a product of such (`touches`), simple factors in
 * place of high powers (simple-zeros.h); then as above. Errors: the same. */
QDOT_MUST_CHECK qdot_status qdot_watched_zeros(qdot_pool *pool, qdot_expr g, qdot_repeated *out);

#endif
