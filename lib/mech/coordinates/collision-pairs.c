/* collision-pairs.c -- finds pairs of points whose distance, when it vanishes, makes accelerations singular. */
#include "expr/build.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/node.h"
#include "mech/coordinates/collision.h"

#include "expr/calculus.h"
#include "expr/walk.h"

/* --- squares and linear forms ------------------------------------------------------------------ */

static bool
contains_coordinates(const qdot_collision_equations *of, qdot_expr e)
{
    return qdot_expr_contains_any(of->pool, e, of->n, of->q);
}

/* Whether e is a number. */
static bool
is_numeral(const qdot_collision_equations *of, qdot_expr e)
{
    return e != QDOT_NIL && qdot_expr_kind(of->pool, e) == QDOT_NUM;
}

/* Whether e is a linear combination of coordinates only: a distance in one dimension; if so fill *pair. */
static bool
find_linear_distance(const qdot_collision_equations *of, qdot_expr e, qdot_collision_pair *pair)
{
    qdot_expr rest = e, first = QDOT_NIL;

    for (size_t i = 0; i < of->n; i++) {
        const qdot_expr slope = qdot_diff(of->pool, e, of->q[i]);

        if (!is_numeral(of, slope))
            return false;
        rest = qdot_subs(of->pool, rest, 1, of->q + i, (qdot_expr[]){QDOT_ZERO});
        if (slope != QDOT_ZERO && first == QDOT_NIL) {
            first = slope;
            pair->pivot[0] = i;
        }
    }
    if (first == QDOT_NIL || !is_numeral(of, rest))
        return false;
    pair->d = 1;
    pair->x[0] = qdot_expand(of->pool, qdot_div(of->pool, e, first));
    pair->distance = qdot_fun1(of->pool, QDOT_ABS, pair->x[0]);
    return true;
}

/* Whether e is scale (x_1^2 + x_2^2 ...) with every x linear in coordinates, by completing squares. */
static bool
find_sum_of_squares(const qdot_collision_equations *of, qdot_expr e, qdot_collision_pair *pair)
{
    qdot_pool *pool = of->pool;
    qdot_expr rest = qdot_expand(pool, e);

    pair->square = e;
    for (size_t i = 0; i < of->n && rest != QDOT_NIL; i++) {
        const qdot_expr slope = qdot_diff(pool, rest, of->q[i]);
        const qdot_expr twice = qdot_diff(pool, slope, of->q[i]);
        qdot_collision_pair line;

        if (slope == QDOT_ZERO)
            continue;
        if (pair->d == QDOT_COLLISION_MOST || !is_numeral(of, twice) || twice == QDOT_ZERO)
            return false;
        if (pair->d == 0)
            pair->scale = qdot_mul(pool, QDOT_HALF, twice);
        if (qdot_mul(pool, QDOT_HALF, twice) != pair->scale ||
            !find_linear_distance(of, qdot_div(pool, slope, twice), &line))
            return false;
        pair->x[pair->d] = line.x[0];
        pair->pivot[pair->d++] = i;
        rest = qdot_expand(pool, qdot_sub(pool, rest,
                                          qdot_mul(pool, pair->scale,
                                                   qdot_pow_int(pool, line.x[0], 2))));
    }
    pair->distance = qdot_sqrt(pool, qdot_div(pool, e, pair->scale));
    return rest == QDOT_ZERO && pair->d > 0 && !qdot_expr_is_negative(pool, pair->scale);
}

/* --- expressions by which others are divided --------------------------------------- */

static bool
is_pair_known(const qdot_collision_pairs *pairs, const qdot_collision_pair *x)
{
    for (size_t i = 0; i < pairs->n; i++) {
        const qdot_collision_pair *p = pairs->at + i;
        bool same = p->d == x->d && (x->d == 1 || p->square == x->square);

        for (size_t k = 0; k < x->d && same; k++)
            same = p->x[k] == x->x[k];
        if (same)
            return true;
    }
    return false;
}

static qdot_status
add_pair(const qdot_collision_equations *of, qdot_expr base, bool line,
         qdot_collision_pairs *pairs)
{
    qdot_collision_pair pair = {0};

    if (!(line ? find_linear_distance(of, base, &pair) : find_sum_of_squares(of, base, &pair)) ||
        is_pair_known(pairs, &pair))
        return qdot_pool_check(of->pool);
    return qdot_vec_push(pairs, pair);
}

/* A divisor in the equations that contains coordinates, or the argument of an absolute value. */
typedef struct {
    qdot_expr e;
    bool whole; /* the divisor e occurs in integer powers only */
} divisor;

typedef qdot_vec(divisor) divisors;

static qdot_status
find_divisors(const qdot_collision_equations *of, size_t m, const qdot_expr *exprs,
              divisors *list)
{
    qdot_pool *pool = of->pool;
    qdot_status status = QDOT_OK;
    qdot_walk w;

    QDOT_TRY(qdot_walk_begin_n(pool, m, exprs, &w));
    for (size_t i = 0; i < w.n && status == QDOT_OK; i++) {
        const qdot_node *node = qdot_expr_node(pool, w.at[i]);

        if (node->kind == QDOT_FUN && node->op == QDOT_ABS)
            status =
                qdot_vec_push(list, ((divisor){qdot_expr_arg(pool, w.at[i], 0), true}));
        for (uint32_t f = 1; node->kind == QDOT_PROD &&
                             f + 1 < qdot_expr_count(pool, w.at[i]) && status == QDOT_OK;
             f += 2) {
            const qdot_expr base = qdot_expr_arg(pool, w.at[i], f),
                            exponent = qdot_expr_arg(pool, w.at[i], f + 1);
            int64_t k;

            if (is_numeral(of, exponent) && qdot_expr_is_negative(pool, exponent) &&
                contains_coordinates(of, base))
                status = qdot_vec_push(
                    list, ((divisor){base, qdot_expr_to_int(pool, exponent, &k)}));
        }
    }
    qdot_walk_end(&w);
    return status;
}

bool
qdot_collision_may(const qdot_collision_equations *of, qdot_expr e)
{
    divisors list = {0};
    const bool may = find_divisors(of, 1, &e, &list) == QDOT_OK && list.n > 0;

    qdot_free(list.at);
    return may;
}

qdot_status
qdot_collision_find(const qdot_collision_equations *of, size_t m, const qdot_expr *exprs,
                    qdot_collision_pairs *pairs)
{
    divisors list = {0};
    qdot_status status = find_divisors(of, m, exprs, &list);

    for (size_t i = 0; i < list.n && status == QDOT_OK; i++)
        status = add_pair(of, list.at[i].e, list.at[i].whole, pairs);
    qdot_free(list.at);
    return status;
}

/* --- powers of the squared distance ---------------------------------------------------------------- */

typedef struct {
    const qdot_collision_pair *pair;
    qdot_expr R;
} distance;

static qdot_expr
replace_distance_powers(qdot_pool *pool, qdot_expr node, void *user)
{
    const distance *x = user;
    qdot_expr factor = QDOT_ONE;

    for (uint32_t i = 1; i + 1 < qdot_expr_count(pool, node); i += 2) {
        const qdot_expr base = qdot_expr_arg(pool, node, i),
                        exponent = qdot_expr_arg(pool, node, i + 1);

        if (base != x->pair->square)
            continue;
        factor = qdot_mul(pool, factor,
                          qdot_div(pool, qdot_pow(pool, x->pair->scale, exponent),
                                   qdot_pow(pool, base, exponent)));
        factor = qdot_mul(
            pool, factor,
            qdot_pow(pool, x->R, qdot_mul(pool, qdot_expr_int(pool, 2), exponent)));
    }
    return factor == QDOT_ONE ? node : qdot_mul(pool, node, factor);
}

qdot_expr
qdot_collision_put_distance(qdot_pool *pool, qdot_expr e, const qdot_collision_pair *pair,
                            qdot_expr R)
{
    distance x = {pair, R};

    return pair->d == 1 ? e : qdot_walk_replace(pool, e, QDOT_PROD, replace_distance_powers, &x);
}
