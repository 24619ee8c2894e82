/* chart-express.c -- expressions in other coordinates. */
#include "mech/study/chart.h"

#include <stdlib.h>

#include "expr/calculus.h"
#include "expr/walk.h"
#include "mech/scene/access.h"

/* Multiples of an angle beyond this are left as they are. */
enum { MOST_MULTIPLE = 12 };

typedef qdot_vec(qdot_expr) expressions;

/* Replacements of one expression. */
typedef struct {
    const qdot_chart *c;
    qdot_pool *pool;
    expressions from, to;
} rewriting;

static qdot_status
replace(rewriting *r, qdot_expr from, qdot_expr to)
{
    QDOT_TRY(qdot_vec_push(&r->from, from));
    return qdot_vec_push(&r->to, to);
}

/* --- sines and cosines ---------------------------------------------------------------- */

typedef struct {
    qdot_expr cosine, sine;
} direction;

/* Of the sum of two angles. */
static direction
turned(qdot_pool *pool, direction a, direction b)
{
    return (direction){qdot_sub(pool, qdot_mul(pool, a.cosine, b.cosine),
                                qdot_mul(pool, a.sine, b.sine)),
                       qdot_add(pool, qdot_mul(pool, a.sine, b.cosine),
                                qdot_mul(pool, a.cosine, b.sine))};
}

/* Of `angle`, whose multiples of moved angles are whole numbers; false if one is not. */
static bool
find_direction(const rewriting *r, qdot_expr angle, direction *d)
{
    qdot_pool *pool = r->pool;
    direction sum = {QDOT_ONE, QDOT_ZERO};

    for (size_t i = 0; i < r->c->moved.n; i++) {
        const qdot_chart_moved *m = r->c->moved.at + i;
        direction one = {m->cosine, m->sine};
        long times;

        if (!m->angle || !qdot_expr_contains(pool, angle, m->q))
            continue;
        if (!qdot_expr_to_int(pool, qdot_diff(pool, angle, m->q), &times) ||
            labs(times) > MOST_MULTIPLE)
            return false;
        if (times < 0)
            one.sine = qdot_neg(pool, one.sine);
        for (long k = 0; k < labs(times); k++)
            sum = turned(pool, sum, one);
        angle = qdot_subs(pool, angle, 1, &m->q, (qdot_expr[]){QDOT_ZERO});
    }
    for (size_t i = 0; i < r->c->moved.n; i++)
        if (qdot_expr_contains(pool, angle, r->c->moved.at[i].q))
            return false; /* a length is left in it */
    *d = turned(
        pool, sum,
        (direction){qdot_fun1(pool, QDOT_COS, angle), qdot_fun1(pool, QDOT_SIN, angle)});
    return true;
}

static qdot_expr
of_direction(qdot_pool *pool, uint16_t function, direction d)
{
    switch (function) {
    case QDOT_SIN: return d.sine;
    case QDOT_COS: return d.cosine;
    case QDOT_TAN: return qdot_div(pool, d.sine, d.cosine);
    case QDOT_COT: return qdot_div(pool, d.cosine, d.sine);
    case QDOT_SEC: return qdot_div(pool, QDOT_ONE, d.cosine);
    case QDOT_CSC: return qdot_div(pool, QDOT_ONE, d.sine);
    default: return QDOT_NIL;
    }
}

static bool
is_trigonometric(const qdot_pool *pool, qdot_expr e)
{
    const qdot_node *node = qdot_expr_node(pool, e);

    return node->kind == QDOT_FUN &&
           (node->op == QDOT_SIN || node->op == QDOT_COS || node->op == QDOT_TAN ||
            node->op == QDOT_COT || node->op == QDOT_SEC || node->op == QDOT_CSC);
}

static bool
holds_moved_angle(const rewriting *r, qdot_expr e)
{
    for (size_t i = 0; i < r->c->moved.n; i++)
        if (r->c->moved.at[i].angle &&
            qdot_expr_contains(r->pool, e, r->c->moved.at[i].q))
            return true;
    return false;
}

static qdot_status
replace_trigonometric(rewriting *r, qdot_expr e)
{
    expressions found = {0};
    qdot_status status;
    qdot_walk w;

    QDOT_TRY(qdot_walk_begin(r->pool, e, &w));
    status = QDOT_OK;
    for (size_t i = 0; i < w.n && status == QDOT_OK; i++)
        if (is_trigonometric(r->pool, w.at[i]))
            status = qdot_vec_push(&found, w.at[i]);
    qdot_walk_end(&w);
    for (size_t i = 0; i < found.n && status == QDOT_OK; i++) {
        const qdot_expr f = found.at[i], angle = qdot_expr_arg(r->pool, f, 0);
        direction d;

        if (holds_moved_angle(r, angle) && find_direction(r, angle, &d))
            status =
                replace(r, f, of_direction(r->pool, qdot_expr_node(r->pool, f)->op, d));
    }
    qdot_free(found.at);
    return status;
}

/* --- coordinates and their rates ------------------------------------------------------- */

/* de/dt, where N' = (N^2)'/(2 N). */
static qdot_expr
rate(const qdot_chart *c, qdot_pool *pool, qdot_expr e)
{
    qdot_expr sum = qdot_ddt(pool, e);

    for (size_t i = 0; i < c->distances.n; i++) {
        const qdot_chart_distance *d = c->distances.at + i;
        const qdot_expr change = qdot_div(
            pool, qdot_mul(pool, QDOT_HALF, qdot_ddt(pool, d->square)), d->symbol);

        if (qdot_expr_contains(pool, e, d->symbol))
            sum = qdot_add(pool, sum,
                           qdot_mul(pool, qdot_diff(pool, e, d->symbol), change));
    }
    return sum;
}

/* d atan2(y, x)/dt */
static qdot_expr
angle_rate(const qdot_chart *c, qdot_pool *pool, const qdot_chart_moved *m)
{
    const qdot_expr turn = qdot_sub(pool, qdot_mul(pool, m->x, rate(c, pool, m->y)),
                                    qdot_mul(pool, m->y, rate(c, pool, m->x)));

    return qdot_div(
        pool, turn,
        qdot_add(pool, qdot_mul(pool, m->x, m->x), qdot_mul(pool, m->y, m->y)));
}

static qdot_status
replace_coordinates(rewriting *r, uint32_t holds)
{
    const qdot_chart *c = r->c;
    qdot_pool *pool = r->pool;

    for (size_t i = 0; i < c->moved.n; i++) {
        const qdot_chart_moved *m = c->moved.at + i;
        qdot_expr first;

        QDOT_TRY(replace(r, m->q, m->angle ? m->bare : m->value));
        if (!(holds & (QDOT_HAS_VELOCITY | QDOT_HAS_ACCELERATION)))
            continue;
        first = m->angle ? angle_rate(c, pool, m) : rate(c, pool, m->value);
        QDOT_TRY(replace(r, qdot_symbol_jet(pool, m->q, 1), first));
        if (holds & QDOT_HAS_ACCELERATION)
            QDOT_TRY(replace(r, qdot_symbol_jet(pool, m->q, 2), rate(c, pool, first)));
    }
    return QDOT_OK;
}

qdot_expr
qdot_chart_put(const qdot_chart *c, qdot_expr e)
{
    rewriting r = {.c = c, .pool = c->pool};
    qdot_status status;

    if (e == QDOT_NIL)
        return QDOT_NIL;
    status = replace_trigonometric(&r, e);
    if (status == QDOT_OK)
        status = replace_coordinates(&r, qdot_expr_node(r.pool, e)->holds);
    e = status == QDOT_OK ? qdot_subs(r.pool, e, r.from.n, r.from.at, r.to.at)
                          : qdot_pool_fail(r.pool);
    qdot_free(r.from.at);
    qdot_free(r.to.at);
    return e;
}

/* The angle of m, within half a turn of so many quarters. */
static qdot_expr
angle_from(qdot_pool *pool, const qdot_chart_moved *m, long quarters)
{
    const qdot_expr x[] = {m->x, m->y, qdot_neg(pool, m->x), qdot_neg(pool, m->y)};
    const size_t k = (size_t)(((quarters % 4) + 4) % 4);
    /* y, then x, turned back by k quarters */
    const qdot_expr sides[] = {x[(k + 1) % 4], x[k]};

    return qdot_add(pool, qdot_mul(pool, qdot_expr_ratio(pool, quarters, 2), QDOT_PI),
                    qdot_fun(pool, QDOT_ATAN2, 2, sides));
}

qdot_expr
qdot_chart_express(const qdot_chart *c, qdot_expr e, const long *quarters, bool *turns)
{
    qdot_pool *pool = c->pool;

    if (turns)
        *turns = false;
    e = qdot_chart_put(c, e);
    for (size_t i = 0; i < c->moved.n && e != QDOT_NIL; i++) {
        const qdot_chart_moved *m = c->moved.at + i;
        qdot_expr angle;

        if (!m->angle || !qdot_expr_contains(pool, e, m->bare))
            continue;
        angle = angle_from(pool, m, quarters ? quarters[i] : 0);
        e = qdot_subs(pool, e, 1, &m->bare, &angle);
        if (turns)
            *turns = true;
    }
    for (size_t i = 0; i < c->distances.n && e != QDOT_NIL; i++) {
        const qdot_expr N = qdot_sqrt(pool, c->distances.at[i].square);

        e = qdot_subs(pool, e, 1, &c->distances.at[i].symbol, &N);
    }
    return e;
}

qdot_expr
qdot_chart_given(const qdot_chart *c, qdot_expr e)
{
    for (uint32_t order = 2; order-- > 0;)
        for (size_t i = 0; i < c->fresh.n; i++) {
            const qdot_expr given = c->fresh.at[i].given;
            const qdot_expr from = qdot_symbol_jet(c->pool, c->fresh.at[i].q, order);
            const qdot_expr to = order ? qdot_ddt(c->pool, given) : given;

            e = qdot_subs(c->pool, e, 1, &from, &to);
        }
    return e;
}

/* --- what is regular -------------------------------------------------------------------- */

/* Base and exponent of factor k of a product. */
static qdot_expr
base_of(const qdot_pool *pool, qdot_expr product, uint32_t k)
{
    return qdot_expr_arg(pool, product, 1 + 2 * k);
}

static qdot_expr
exponent_of(const qdot_pool *pool, qdot_expr product, uint32_t k)
{
    return qdot_expr_arg(pool, product, 2 + 2 * k);
}

static uint32_t
factors_of(const qdot_pool *pool, qdot_expr product)
{
    return (qdot_expr_count(pool, product) - 1) / 2;
}

/* Even powers of N as powers of N^2. */
static qdot_expr
put_squares(qdot_pool *pool, qdot_expr node, void *user)
{
    const qdot_chart *c = user;
    qdot_expr factor = QDOT_ONE;

    for (uint32_t f = 0; f < factors_of(pool, node); f++) {
        const qdot_expr base = base_of(pool, node, f),
                        exponent = exponent_of(pool, node, f);
        long k;

        if (!qdot_expr_to_int(pool, exponent, &k) || k % 2 != 0)
            continue;
        for (size_t i = 0; i < c->distances.n; i++)
            if (base == c->distances.at[i].symbol)
                factor = qdot_mul(
                    pool, factor,
                    qdot_mul(pool, qdot_pow_int(pool, base, -k),
                             qdot_pow_int(pool, c->distances.at[i].square, k / 2)));
    }
    return factor == QDOT_ONE ? node : qdot_mul(pool, node, factor);
}

/* Whether `e` is N^2 of a group, or a factor of it. */
static bool
is_of_square(const qdot_chart *c, const qdot_pool *pool, qdot_expr e)
{
    for (size_t i = 0; i < c->distances.n; i++) {
        const qdot_expr square = c->distances.at[i].square;

        if (e == square)
            return true;
        if (qdot_expr_kind(pool, square) != QDOT_PROD)
            continue;
        for (uint32_t f = 0; f < factors_of(pool, square); f++)
            if (e == base_of(pool, square, f))
                return true;
    }
    return false;
}

/* Whether e holds an angle outside of sin and cos. */
static bool
holds_bare(const qdot_chart *c, qdot_expr e)
{
    for (size_t i = 0; i < c->moved.n; i++)
        if (c->moved.at[i].angle && qdot_expr_contains(c->pool, e, c->moved.at[i].bare))
            return true;
    return false;
}

/* Whether e holds N, a power of N^2 that is not smooth, or an angle outside of sin and cos. */
static bool
is_singular(const qdot_chart *c, qdot_pool *pool, qdot_expr e)
{
    bool singular = holds_bare(c, e);
    qdot_walk w;

    for (size_t i = 0; i < c->distances.n; i++)
        singular = singular || qdot_expr_contains(pool, e, c->distances.at[i].symbol);
    if (singular || qdot_walk_begin(pool, e, &w) != QDOT_OK)
        return true;
    for (size_t i = 0; i < w.n; i++)
        for (uint32_t f = 0;
             qdot_expr_kind(pool, w.at[i]) == QDOT_PROD && f < factors_of(pool, w.at[i]);
             f++) {
            long k;

            singular =
                singular ||
                (is_of_square(c, pool, base_of(pool, w.at[i], f)) &&
                 !(qdot_expr_to_int(pool, exponent_of(pool, w.at[i], f), &k) && k > 0));
        }
    qdot_walk_end(&w);
    return singular;
}

qdot_expr
qdot_chart_regular(const qdot_chart *c, qdot_expr e)
{
    qdot_pool *pool = c->pool;

    e = qdot_chart_put(c, e);
    if (e == QDOT_NIL || holds_bare(c, e)) /* no simplification would help */
        return QDOT_NIL;
    for (int tries = 0; tries < 3; tries++) {
        e = qdot_walk_replace(pool, e, QDOT_PROD, put_squares, (void *)(uintptr_t)c);
        if (e == QDOT_NIL)
            return QDOT_NIL;
        if (!is_singular(c, pool, e))
            return e;
        e = tries == 0 ? qdot_expand(pool, e) : qdot_mech_tidy(c->of, e);
    }
    return QDOT_NIL;
}
