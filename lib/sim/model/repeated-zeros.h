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
    qdot_expr u;    /* g itself where it is none of these, or holds accelerations or multipliers */
    qdot_expr turn; /* not 0 at a zero of u; NIL: u goes as g does */
    bool half;      /* zeros of u at which turn < 0 are none of g */
    bool touches;   /* whatever u does, g only touches 0: k is the value to which f jumps, or g is v^2 */
} qdot_repeated;

/* Find u for the function g with parameter values. Errors: of the pool; of a constant that is not real. */
QDOT_MUST_CHECK qdot_status qdot_repeated_zeros(qdot_pool *pool, qdot_expr g, qdot_repeated *out);

/* What is watched for the zeros of g: first v in place of |v|, v^2 or a product of such (`touches`), simple factors in
 * place of high powers (simple-zeros.h); then as above. Errors: the same. */
QDOT_MUST_CHECK qdot_status qdot_watched_zeros(qdot_pool *pool, qdot_expr g, qdot_repeated *out);

#endif
