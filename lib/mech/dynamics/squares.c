/* squares.c -- writes a quadratic form as a sum of squares: tries pivots in every order, and keeps the shortest result. */

#include "mech/dynamics/squares.h"

#include "base/memory.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "mech/scene/access.h"
#include "normal/simplify/simplify.h"

enum { MOST = 3 };

void
qdot_squares_begin(qdot_squares *q, qdot_scene *s)
{
    *q = (qdot_squares){.s = s, .rest = QDOT_ZERO};
}

void
qdot_squares_clear(qdot_squares *q)
{
    qdot_free(q->at.at);
    *q = (qdot_squares){0};
}

static bool
depends_on_motion(const qdot_scene *s, qdot_expr e)
{
    return (qdot_mech_holds(s, e) & ~(uint32_t)(QDOT_HAS_PARAM | QDOT_HAS_FUN)) != 0;
}

/* Split the coefficient D of a square into key * rest, where the key contains neither coordinates nor t. */
static void
split_constant_factor(qdot_scene *s, qdot_expr D, qdot_expr *key, qdot_expr *rest)
{
    qdot_pool *pool = s->pool;

    *key = D;
    *rest = QDOT_ONE;
    if (!depends_on_motion(s, D))
        return;
    *key = QDOT_ONE;
    *rest = D;
    if (qdot_expr_kind(pool, D) != QDOT_PROD)
        return;
    *key = qdot_expr_arg(pool, D, 0);
    for (uint32_t i = 1; i < qdot_expr_count(pool, D); i += 2) {
        qdot_expr b = qdot_expr_arg(pool, D, i);

        if (!depends_on_motion(s, b))
            *key = qdot_mul(pool, *key, qdot_pow(pool, b, qdot_expr_arg(pool, D, i + 1)));
    }
    *rest = qdot_div(pool, D, *key);
}

qdot_status
qdot_squares_add(qdot_squares *q, qdot_expr D, qdot_expr u)
{
    qdot_pool *pool = q->s->pool;
    qdot_square one;
    qdot_expr rest;

    split_constant_factor(q->s, D, &one.key, &rest);
    one.sum = qdot_mul(pool, rest, qdot_pow_int(pool, u, 2));
    for (size_t i = 0; i < q->at.n; i++)
        if (q->at.at[i].key == one.key) {
            q->at.at[i].sum = qdot_add(pool, q->at.at[i].sum, one.sum);
            return qdot_pool_check(pool);
        }
    QDOT_TRY(qdot_vec_push(&q->at, one));
    return qdot_pool_check(pool);
}

qdot_expr
qdot_squares_sum(const qdot_squares *q)
{
    qdot_pool *pool = q->s->pool;
    qdot_expr sum = q->rest;

    for (size_t i = 0; i < q->at.n; i++)
        sum = qdot_add(
            pool, sum,
            qdot_mul(pool, qdot_mul(pool, QDOT_HALF, q->at.at[i].key), q->at.at[i].sum));
    return sum;
}

void
qdot_squares_blocks(size_t n, const qdot_expr *A, size_t *block)
{
    for (size_t i = 0; i < n; i++)
        block[i] = i;
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < i; j++) {
            size_t from = block[i], to = block[j];

            if (A[i * n + j] == QDOT_ZERO || from == to)
                continue;
            if (from < to) {
                from = block[j];
                to = block[i];
            }
            for (size_t k = 0; k < n; k++)
                if (block[k] == from)
                    block[k] = to;
        }
}

/* Whether e, or a factor of e, is a sum that contains coordinates. */
static bool
has_sum(const qdot_scene *s, qdot_expr e)
{
    const qdot_pool *pool = s->pool;

    if (qdot_expr_kind(pool, e) == QDOT_SUM)
        return depends_on_motion(s, e);
    for (uint32_t i = 1;
         qdot_expr_kind(pool, e) == QDOT_PROD && i < qdot_expr_count(pool, e); i += 2)
        if (qdot_expr_kind(pool, qdot_expr_arg(pool, e, i)) == QDOT_SUM &&
            depends_on_motion(s, qdot_expr_arg(pool, e, i)))
            return true;
    return false;
}

bool
qdot_squares_worth(const qdot_scene *s, size_t n, const qdot_expr *A)
{
    for (size_t i = 0; i < n; i++)
        if (has_sum(s, A[i * n + i]))
            return true;
    return false;
}

/* Write a square D (v + b/a w)^2 as D/a^2 (a v + b w)^2 if D has the factor a^2. */
static void
clear_denominators(qdot_pool *pool, size_t n, qdot_expr *D, qdot_expr *l)
{
    for (size_t j = 0; j < n; j++)
        for (uint32_t i = 1;
             qdot_expr_kind(pool, l[j]) == QDOT_PROD && i < qdot_expr_count(pool, l[j]);
             i += 2) {
            qdot_expr b = qdot_expr_arg(pool, l[j], i), rest;

            if (qdot_expr_arg(pool, l[j], i + 1) != QDOT_MINUS_ONE)
                continue;
            rest = qdot_div(pool, *D, qdot_pow_int(pool, b, 2));
            if (rest == QDOT_NIL ||
                qdot_expr_size(pool, rest) >= qdot_expr_size(pool, *D))
                continue;
            *D = rest;
            for (size_t k = 0; k < n; k++)
                l[k] = qdot_mul(pool, l[k], b);
            i = 0;
        }
}

/* v^T A v as a sum of D u^2, completing squares in the order given; D [n], u [n]. False if some D is 0 or contains
 * a sum. */
static bool
eliminate_in_order(qdot_scene *s, size_t n, const qdot_expr *A, const qdot_expr *v,
                   const int *order, qdot_expr *D, qdot_expr *u)
{
    qdot_pool *pool = s->pool;
    qdot_facts facts = qdot_scene_facts(s);
    qdot_expr B[MOST * MOST], l[MOST];

    for (size_t i = 0; i < n * n; i++)
        B[i] = A[i];
    for (size_t k = 0; k < n; k++) {
        size_t p = (size_t)order[k];

        D[k] = B[p * n + p];
        if (D[k] == QDOT_NIL || D[k] == QDOT_ZERO || has_sum(s, D[k]))
            return false;
        for (size_t i = 0; i < n; i++)
            l[i] = i == p ? QDOT_ONE : QDOT_ZERO;
        for (size_t i = k + 1; i < n; i++) {
            size_t r = (size_t)order[i];

            l[r] = qdot_simplify(pool, qdot_div(pool, B[p * n + r], D[k]), &facts);
        }
        for (size_t i = k + 1; i < n; i++)
            for (size_t j = k + 1; j < n; j++) {
                size_t a = (size_t)order[i], b = (size_t)order[j];
                qdot_expr less = qdot_mul(pool, l[a], B[p * n + b]);

                if (less != QDOT_ZERO)
                    B[a * n + b] =
                        qdot_simplify(pool, qdot_sub(pool, B[a * n + b], less), &facts);
            }
        clear_denominators(pool, n, &D[k], l);
        u[k] = QDOT_ZERO;
        for (size_t i = 0; i < n; i++)
            u[k] = qdot_add(pool, u[k], qdot_mul(pool, l[i], v[i]));
        if (qdot_pool_failed(pool))
            return false;
    }
    return true;
}

qdot_status
qdot_squares_complete(qdot_squares *q, size_t n, const qdot_expr *A, const qdot_expr *v,
                      bool *done)
{
    static const int orders[6][MOST] = {{0, 1, 2}, {1, 0, 2}, {2, 0, 1},
                                        {2, 1, 0}, {1, 2, 0}, {0, 2, 1}};
    qdot_pool *pool = q->s->pool;
    qdot_expr D[MOST], u[MOST], best_D[MOST], best_u[MOST];
    uint64_t least = UINT64_MAX;

    *done = false;
    for (int k = 0; k < (n == 2 ? 2 : 6); k++) {
        qdot_expr sum = QDOT_ZERO;
        uint64_t size;

        if (!eliminate_in_order(q->s, n, A, v, orders[k], D, u))
            continue;
        for (size_t i = 0; i < n; i++)
            sum = qdot_add(pool, sum, qdot_mul(pool, D[i], qdot_pow_int(pool, u[i], 2)));
        size = qdot_expr_size(pool, sum);
        if (sum == QDOT_NIL || size >= least)
            continue;
        least = size;
        for (size_t i = 0; i < n; i++) {
            best_D[i] = D[i];
            best_u[i] = u[i];
        }
    }
    QDOT_TRY(qdot_pool_check(pool));
    for (size_t i = 0; i < n && least < UINT64_MAX; i++)
        QDOT_TRY(qdot_squares_add(q, best_D[i], best_u[i]));
    *done = least < UINT64_MAX;
    return QDOT_OK;
}
