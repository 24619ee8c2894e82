/* nested.c -- sums over many sets of the same items, each made of those it contains.
 *
 *     S(A) = S(B) + S(C) + ... + the items of A in none of B, C, ...
 *
 * B, C, ... the largest sets, smaller than A and apart from each other, whose sums are
 * there. Along a chain each set is the one before and one item more: accelerations are
 * added up from the root outward, forces from the tip inward, as in the recursions of
 * Newton and Euler, without any notion of a joint.
 */
#include "mech/dynamics/nested.h"

#include <stdlib.h>
#include <string.h>

#include "base/interrupt.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/function.h"

typedef struct {
    uint32_t set;
    size_t size;
} ranked;

static int
compare_sizes(const void *a, const void *b)
{
    const ranked *x = a, *y = b;

    if (x->size != y->size)
        return x->size < y->size ? -1 : 1;
    return x->set < y->set ? -1 : x->set > y->set;
}

static bool
is_superset(const uint64_t *a, const uint64_t *b, size_t words)
{
    for (size_t i = 0; i < words; i++)
        if (b[i] & ~a[i])
            return false;
    return true;
}

/* The sum of set at[k].set of those ranked before it and of items; `left` and `parts` are
 * work space. */
static qdot_expr
sum_from_smaller_sets(qdot_pool *pool, const qdot_family *f, const ranked *at, size_t k,
                      const qdot_expr *sum, uint64_t *left, qdot_expr *parts)
{
    size_t n = 0, remain = at[k].size;

    memcpy(left, f->bits + at[k].set * f->words, f->words * sizeof *left);
    for (size_t j = k; j-- > 0 && at[j].size > 1 && remain > 1;) {
        const uint64_t *other = f->bits + at[j].set * f->words;

        if (at[j].size > remain || !is_superset(left, other, f->words))
            continue;
        for (size_t i = 0; i < f->words; i++)
            left[i] &= ~other[i];
        remain -= at[j].size;
        parts[n++] = sum[at[j].set];
    }
    for (size_t p = 0; p < f->items && remain > 0; p++)
        if (left[p / 64] >> p % 64 & 1) {
            parts[n++] = f->value[p];
            remain--;
        }
    return qdot_hold(pool, qdot_sum(pool, n, parts));
}

bool
qdot_nested_sums(qdot_scene *s, const qdot_family *f, qdot_expr *sum)
{
    qdot_pool *pool = s->pool;
    ranked *at = qdot_calloc(f->sets + 1, sizeof *at);
    uint64_t *left = qdot_calloc(f->words + 1, sizeof *left);
    qdot_expr *parts = qdot_calloc(f->items + 1, sizeof *parts);

    if (!at || !left || !parts)
        qdot_pool_fail(pool);
    for (size_t k = 0; k < f->sets && !qdot_pool_failed(pool); k++) {
        at[k].set = (uint32_t)k;
        for (size_t i = 0; i < f->words; i++)
            at[k].size += (size_t)__builtin_popcountll(f->bits[k * f->words + i]);
    }
    if (!qdot_pool_failed(pool) && f->sets > 1)
        qsort(at, f->sets, sizeof *at, compare_sizes);
    for (size_t k = 0; k < f->sets && !qdot_pool_failed(pool); k++) {
        if (qdot_interrupt_check() != QDOT_OK)
            qdot_pool_fail(pool);
        else
            sum[at[k].set] = sum_from_smaller_sets(pool, f, at, k, sum, left, parts);
    }
    qdot_free(parts);
    qdot_free(left);
    qdot_free(at);
    return !qdot_pool_failed(pool);
}
