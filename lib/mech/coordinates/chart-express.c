/* chart-express.c -- writes expressions of the coordinates of a chart in its other coordinates. */
#include "expr/build.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "mech/coordinates/chart.h"

#include <stdlib.h>

#include "expr/calculus.h"
#include "expr/walk.h"
#include "mech/scene/access.h"

/* Multiples of an angle larger than this are not expanded into powers of its sine and cosine. */
enum { MOST_MULTIPLE = 12 };

typedef qdot_vec(qdot_expr) expressions;

/* The replacements to be made in one expression when coordinates are changed. */
typedef struct {
    const qdot_chart *c;
    qdot_pool *pool;
    expressions from, to;
} rewriting;

static qdot_status
add_replacement(rewriting *r, qdot_expr from, qdot_expr to)
{
    QDOT_TRY(qdot_vec_push(&r->from, from));
    return qdot_vec_push(&r->to, to);
}

/* --- factors of products ------------------------------------------------------------------- */

/* Find the base and the exponent of factor k of a product. */
static qdot_expr
factor_base(const qdot_pool *pool, qdot_expr product, uint32_t k)
{
    return qdot_expr_arg(pool, product, 1 + 2 * k);
}

static qdot_expr
factor_exponent(const qdot_pool *pool, qdot_expr product, uint32_t k)
{
    return qdot_expr_arg(pool, product, 2 + 2 * k);
}

static uint32_t
factor_count(const qdot_pool *pool, qdot_expr product)
{
    return (qdot_expr_count(pool, product) - 1) / 2;
}

/* --- sines and cosines ---------------------------------------------------------------- */

typedef struct {
    qdot_expr cosine, sine;
} direction;

/* Whether the replaced angle m is given by its cosh and sinh (hyperbolic), or by its cos and sin. */
static bool
is_given_by_functions(const qdot_chart_moved *m, bool hyperbolic)
{
    return m->sort == (hyperbolic ? QDOT_CHART_HYPERBOLIC : QDOT_CHART_ANGLE);
}

/* Sine and cosine of the sum of two angles; cosh and sinh of the sum of two lengths if `hyperbolic`. */
static direction
add_directions(qdot_pool *pool, direction a, direction b, bool hyperbolic)
{
    const qdot_expr sines = qdot_mul(pool, a.sine, b.sine);

    return (direction){qdot_add(pool, qdot_mul(pool, a.cosine, b.cosine),
                                hyperbolic ? sines : qdot_neg(pool, sines)),
                       qdot_add(pool, qdot_mul(pool, a.sine, b.cosine),
                                qdot_mul(pool, a.cosine, b.sine))};
}

/* Find cos and sin of `angle`, a sum of integer multiples of replaced angles; false if a multiple is no integer. */
static bool
find_cosine_and_sine(const rewriting *r, qdot_expr angle, bool hyperbolic, direction *d)
{
    qdot_pool *pool = r->pool;
    direction sum = {QDOT_ONE, QDOT_ZERO};

    for (size_t i = 0; i < r->c->moved.n; i++) {
        const qdot_chart_moved *m = r->c->moved.at + i;
        direction one = {m->cosine, m->sine};
        int64_t times;

        if (!is_given_by_functions(m, hyperbolic) || !qdot_expr_contains(pool, angle, m->q))
            continue;
        if (!qdot_expr_to_int(pool, qdot_diff(pool, angle, m->q), &times) ||
            llabs(times) > MOST_MULTIPLE)
            return false;
        if (times < 0)
            one.sine = qdot_neg(pool, one.sine);
        for (int64_t k = 0; k < llabs(times); k++)
            sum = add_directions(pool, sum, one, hyperbolic);
        angle = qdot_subs(pool, angle, 1, &m->q, (qdot_expr[]){QDOT_ZERO});
    }
    for (size_t i = 0; i < r->c->moved.n; i++)
        if (qdot_expr_contains(pool, angle, r->c->moved.at[i].q))
            return false; /* the rest of the angle still contains a replaced coordinate */
    *d = add_directions(pool, sum,
                        (direction){qdot_fun1(pool, hyperbolic ? QDOT_COSH : QDOT_COS, angle),
                                    qdot_fun1(pool, hyperbolic ? QDOT_SINH : QDOT_SIN, angle)},
                        hyperbolic);
    return true;
}

static qdot_expr
function_of_direction(qdot_pool *pool, uint16_t function, direction d)
{
    switch (function) {
    case QDOT_SINH:
    case QDOT_SIN: return d.sine;
    case QDOT_COSH:
    case QDOT_COS: return d.cosine;
    case QDOT_TANH:
    case QDOT_TAN: return qdot_div(pool, d.sine, d.cosine);
    case QDOT_COT: return qdot_div(pool, d.cosine, d.sine);
    case QDOT_SEC: return qdot_div(pool, QDOT_ONE, d.cosine);
    case QDOT_CSC: return qdot_div(pool, QDOT_ONE, d.sine);
    default: return QDOT_NIL;
    }
}

static bool
is_hyperbolic_function(uint16_t function)
{
    return function == QDOT_SINH || function == QDOT_COSH || function == QDOT_TANH;
}

static bool
contains_replaced_coordinate(const rewriting *r, qdot_expr e, bool hyperbolic)
{
    for (size_t i = 0; i < r->c->moved.n; i++)
        if (is_given_by_functions(r->c->moved.at + i, hyperbolic) &&
            qdot_expr_contains(r->pool, e, r->c->moved.at[i].q))
            return true;
    return false;
}

static qdot_status
replace_functions(rewriting *r, qdot_expr e)
{
    expressions found = {0};
    qdot_status status;
    qdot_walk w;

    QDOT_TRY(qdot_walk_begin(r->pool, e, &w));
    status = QDOT_OK;
    for (size_t i = 0; i < w.n && status == QDOT_OK; i++)
        if (qdot_expr_kind(r->pool, w.at[i]) == QDOT_FUN)
            status = qdot_vec_push(&found, w.at[i]);
    qdot_walk_end(&w);
    for (size_t i = 0; i < found.n && status == QDOT_OK; i++) {
        const uint16_t function = qdot_expr_node(r->pool, found.at[i])->op;
        const bool hyperbolic = is_hyperbolic_function(function);
        qdot_expr angle, now = QDOT_NIL;
        direction d = {QDOT_ONE, QDOT_ZERO};

        if (function_of_direction(r->pool, function, d) == QDOT_NIL)
            continue;
        angle = qdot_expr_arg(r->pool, found.at[i], 0);
        if (contains_replaced_coordinate(r, angle, hyperbolic) && find_cosine_and_sine(r, angle, hyperbolic, &d))
            now = function_of_direction(r->pool, function, d);
        if (now != QDOT_NIL)
            status = add_replacement(r, found.at[i], now);
    }
    qdot_free(found.at);
    return status;
}

/* --- coordinates and their rates ------------------------------------------------------- */

qdot_expr
qdot_chart_rate(const qdot_chart *c, qdot_expr e)
{
    qdot_pool *pool = c->pool;
    qdot_expr sum = qdot_ddt(pool, e);

    for (size_t i = 0; i < c->roots.n; i++) {
        const qdot_chart_root *root = c->roots.at + i;
        qdot_expr change = root->rate;

        if (!qdot_expr_contains(pool, e, root->symbol))
            continue;
        if (change == QDOT_NIL) /* the rate of a root N follows from that of its square: N' = (N^2)'/(2 N) */
            change = qdot_div(
                pool, qdot_mul(pool, QDOT_HALF, qdot_chart_rate(c, root->square)), root->symbol);
        sum = qdot_add(pool, sum, qdot_mul(pool, qdot_diff(pool, e, root->symbol), change));
    }
    return sum;
}

/* The time derivative of a replaced coordinate, in terms of the new coordinates. */
static qdot_expr
rate_of_replaced(const qdot_chart *c, const qdot_chart_moved *m)
{
    qdot_pool *pool = c->pool;
    qdot_expr turn, size;

    if (m->rate != QDOT_NIL)
        return m->rate;
    if (m->sort != QDOT_CHART_ANGLE)
        return qdot_chart_rate(c, m->value);
    /* the rate d atan2(y, x)/dt = (x y' - y x')/(x^2 + y^2) */
    turn = qdot_sub(pool, qdot_mul(pool, m->x, qdot_chart_rate(c, m->y)),
                    qdot_mul(pool, m->y, qdot_chart_rate(c, m->x)));
    size = qdot_add(pool, qdot_mul(pool, m->x, m->x), qdot_mul(pool, m->y, m->y));
    return qdot_div(pool, turn, size);
}

static qdot_status
replace_coordinates(rewriting *r, uint32_t holds)
{
    const qdot_chart *c = r->c;
    qdot_pool *pool = r->pool;

    for (size_t i = 0; i < c->moved.n; i++) {
        const qdot_chart_moved *m = c->moved.at + i;
        qdot_expr first;

        QDOT_TRY(add_replacement(r, m->q, m->bare != QDOT_NIL ? m->bare : m->value));
        if (!(holds & (QDOT_HAS_VELOCITY | QDOT_HAS_ACCELERATION))
            || qdot_expr_symbol(pool, m->q)->class != QDOT_COORD)
            continue;
        first = rate_of_replaced(c, m);
        QDOT_TRY(add_replacement(r, qdot_symbol_jet(pool, m->q, 1), first));
        if (holds & QDOT_HAS_ACCELERATION)
            QDOT_TRY(add_replacement(r, qdot_symbol_jet(pool, m->q, 2), qdot_chart_rate(c, first)));
    }
    return QDOT_OK;
}

/* Replace each power P^(k/2) by w^k, where the new coordinate w is the square root of P. */
static qdot_expr
replace_root_powers(qdot_pool *pool, qdot_expr node, void *user)
{
    const qdot_chart *c = user;
    const qdot_expr two = qdot_expr_int(pool, 2);
    qdot_expr factor = QDOT_ONE;

    for (uint32_t f = 0; f < factor_count(pool, node); f++) {
        const qdot_expr base = factor_base(pool, node, f), exponent = factor_exponent(pool, node, f);
        int64_t twice;

        if (!qdot_expr_to_int(pool, qdot_mul(pool, two, exponent), &twice) || twice % 2 == 0)
            continue;
        for (size_t i = 0; i < c->signs.n; i++)
            if (base == c->signs.at[i].square)
                factor = qdot_mul(
                    pool, factor,
                    qdot_mul(pool, qdot_pow(pool, base, qdot_neg(pool, exponent)),
                             qdot_pow_int(pool, c->signs.at[i].symbol, twice)));
    }
    return factor == QDOT_ONE ? node : qdot_mul(pool, node, factor);
}

/* The expression e with the new coordinates and roots inserted, before products are simplified. */
static qdot_expr
insert_new_coordinates(const qdot_chart *c, qdot_expr e)
{
    rewriting r = {.c = c, .pool = c->pool};
    qdot_status status;
    bool branches = false;

    if (e == QDOT_NIL)
        return QDOT_NIL;
    for (size_t i = 0; i < c->signs.n; i++)
        branches = branches || c->signs.at[i].branch;
    if (branches)
        e = qdot_walk_replace(r.pool, e, QDOT_PROD, replace_root_powers, (void *)(uintptr_t)c);
    if (e == QDOT_NIL)
        return QDOT_NIL;
    status = replace_functions(&r, e);
    if (status == QDOT_OK)
        status = replace_coordinates(&r, qdot_expr_node(r.pool, e)->holds);
    e = status == QDOT_OK ? qdot_subs(r.pool, e, r.from.n, r.from.at, r.to.at)
                          : qdot_pool_fail(r.pool);
    qdot_free(r.from.at);
    qdot_free(r.to.at);
    return e;
}

/* The exponent of `symbol` in a product if it is an integer; 0 otherwise. */
static int64_t
exponent_in_product(const qdot_pool *pool, qdot_expr product, qdot_expr symbol)
{
    int64_t k = 0;

    for (uint32_t f = 0; f < factor_count(pool, product); f++)
        if (factor_base(pool, product, f) == symbol
            && !qdot_expr_to_int(pool, factor_exponent(pool, product, f), &k))
            return 0;
    return k;
}

/* The expression e times (to/from)^times: replaces factors `from` by `to`. */
static qdot_expr
replace_factor(qdot_pool *pool, qdot_expr e, qdot_expr from, qdot_expr to, int64_t times)
{
    return qdot_mul(pool, e,
                    qdot_mul(pool, qdot_pow_int(pool, from, -times),
                             qdot_pow_int(pool, to, times)));
}

/* Replace products of two roots, then even powers of roots and of signs, by their values in new coordinates. */
static qdot_expr
replace_root_squares(qdot_pool *pool, qdot_expr node, void *user)
{
    const qdot_chart *c = user;

    for (size_t i = 0; i < c->roots.n && qdot_expr_kind(pool, node) == QDOT_PROD; i++) {
        const qdot_chart_root *root = c->roots.at + i;
        const int64_t own = exponent_in_product(pool, node, root->symbol);
        const int64_t both =
            root->partner == QDOT_NIL ? 0 : exponent_in_product(pool, node, root->partner);

        if (own > 0 && both > 0)
            node = replace_factor(pool, node, qdot_mul(pool, root->symbol, root->partner),
                                  root->product, own < both ? own : both);
    }
    for (size_t i = 0; i < c->roots.n && qdot_expr_kind(pool, node) == QDOT_PROD; i++) {
        const qdot_chart_root *root = c->roots.at + i;
        const int64_t half = exponent_in_product(pool, node, root->symbol) / 2;

        if (half != 0)
            node = replace_factor(pool, node, qdot_pow_int(pool, root->symbol, 2), root->square, half);
    }
    for (size_t i = 0; i < c->signs.n && qdot_expr_kind(pool, node) == QDOT_PROD; i++) {
        const qdot_chart_sign *s = c->signs.at + i;
        const int64_t half = s->branch ? 0 : exponent_in_product(pool, node, s->symbol) / 2;

        if (half != 0)
            node = replace_factor(pool, node, qdot_pow_int(pool, s->symbol, 2), QDOT_ONE, half);
    }
    return node;
}

qdot_expr
qdot_chart_put(const qdot_chart *c, qdot_expr e)
{
    e = insert_new_coordinates(c, e);
    return e == QDOT_NIL ? e : qdot_walk_replace(c->pool, e, QDOT_PROD, replace_root_squares, (void *)(uintptr_t)c);
}

/* The angle of m, atan2(y, x) with its components x and y, minus `quarters` quarter turns. */
static qdot_expr
angle_minus_quarters(qdot_pool *pool, const qdot_chart_moved *m, int64_t quarters)
{
    const qdot_expr x[] = {m->x, m->y, qdot_neg(pool, m->x), qdot_neg(pool, m->y)};
    const size_t k = (size_t)(((quarters % 4) + 4) % 4);
    /* the components y, then x, turned back by k quarter turns */
    const qdot_expr sides[] = {x[(k + 1) % 4], x[k]};

    return qdot_fun(pool, QDOT_ATAN2, 2, sides);
}

static direction
cosine_and_sine(qdot_pool *pool, qdot_expr angle)
{
    return (direction){qdot_fun1(pool, QDOT_COS, angle), qdot_fun1(pool, QDOT_SIN, angle)};
}

/* The angle of m in e, within half a turn of so many quarters. Of its half, which may be at a zero of
 * sin or cos, the quarters are taken apart: no rounding of pi is left there. */
static qdot_expr
insert_angle(qdot_pool *pool, qdot_expr e, const qdot_chart_moved *m, int64_t quarters)
{
    const qdot_expr turns = qdot_mul(pool, qdot_expr_ratio(pool, quarters, 2), QDOT_PI);
    const qdot_expr beyond = angle_minus_quarters(pool, m, quarters);
    const direction bare = cosine_and_sine(pool, qdot_mul(pool, QDOT_HALF, m->bare));
    const direction half =
        add_directions(pool, cosine_and_sine(pool, qdot_mul(pool, QDOT_HALF, turns)),
                       cosine_and_sine(pool, qdot_mul(pool, QDOT_HALF, beyond)), false);

    return qdot_subs(pool, e, 3, (qdot_expr[]){bare.cosine, bare.sine, m->bare},
                     (qdot_expr[]){half.cosine, half.sine, qdot_add(pool, turns, beyond)});
}

/* Replace the angles, roots and signs in e by their values, which may contain other angles, roots and signs. */
static qdot_expr
insert_values(const qdot_chart *c, qdot_expr e, const int64_t *quarters, bool *turns)
{
    qdot_pool *pool = c->pool;

    for (size_t i = 0; i < c->moved.n && e != QDOT_NIL; i++) {
        const qdot_chart_moved *m = c->moved.at + i;

        if (m->bare == QDOT_NIL || !qdot_expr_contains(pool, e, m->bare))
            continue;
        e = insert_angle(pool, e, m, quarters ? quarters[i] : 0);
        *turns = true;
    }
    for (size_t i = 0; i < c->roots.n && e != QDOT_NIL; i++) {
        const qdot_chart_root *root = c->roots.at + i;
        qdot_expr value = root->value;

        if (!qdot_expr_contains(pool, e, root->symbol))
            continue;
        if (value == QDOT_NIL)
            value = qdot_sqrt(pool, root->square);
        e = qdot_subs(pool, e, 1, &root->symbol, &value);
    }
    for (size_t i = 0; i < c->signs.n && e != QDOT_NIL; i++) {
        const qdot_chart_sign *s = c->signs.at + i;
        const int64_t now = quarters ? quarters[c->moved.n + i] : s->start;
        const qdot_expr value = qdot_expr_int(pool, now);

        if (!qdot_expr_contains(pool, e, s->symbol))
            continue;
        *turns = true;
        if (!s->branch)
            e = qdot_subs(pool, e, 1, &s->symbol, &value);
    }
    return e;
}

qdot_expr
qdot_chart_express(const qdot_chart *c, qdot_expr e, const int64_t *quarters, bool *turns)
{
    bool some = false;

    e = qdot_chart_put(c, e);
    /* thrice: a function of v may contain sinh u, that an angle, that a distance */
    for (int depth = 0; depth < 3 && e != QDOT_NIL; depth++)
        e = insert_values(c, e, quarters, &some);
    if (turns)
        *turns = some;
    return e;
}

const qdot_chart_sign *
qdot_chart_beyond(const qdot_chart *c, qdot_expr e, const int64_t *quarters)
{
    for (size_t i = 0; i < c->signs.n; i++)
        if (c->signs.at[i].branch && quarters[c->moved.n + i] < 0
            && qdot_expr_contains(c->pool, e, c->signs.at[i].symbol))
            return c->signs.at + i;
    return NULL;
}

/* --- regularity of expressions ---------------------------------------------------------- */

/* Whether e is the square of a root, a factor of that square, or a root w that is a new coordinate. */
static bool
is_root_square_or_factor(const qdot_chart *c, const qdot_pool *pool, qdot_expr e)
{
    for (size_t i = 0; i < c->signs.n; i++)
        if (c->signs.at[i].branch && c->signs.at[i].symbol == e)
            return true;
    for (size_t i = 0; i < c->roots.n; i++) {
        const qdot_expr square = c->roots.at[i].square;

        if (e == square)
            return true;
        if (qdot_expr_kind(pool, square) != QDOT_PROD)
            continue;
        for (uint32_t f = 0; f < factor_count(pool, square); f++)
            if (e == factor_base(pool, square, f))
                return true;
    }
    return false;
}

/* Whether e contains an angle elsewhere than in sin and cos. */
static bool
contains_bare_angle(const qdot_chart *c, qdot_expr e)
{
    for (size_t i = 0; i < c->moved.n; i++)
        if (c->moved.at[i].bare != QDOT_NIL &&
            qdot_expr_contains(c->pool, e, c->moved.at[i].bare))
            return true;
    return false;
}

/* Whether e contains a root, a power of its square that is not smooth, or an angle outside of sin and cos. */
static bool
is_singular(const qdot_chart *c, qdot_pool *pool, qdot_expr e)
{
    bool singular = contains_bare_angle(c, e);
    qdot_walk w;

    for (size_t i = 0; i < c->roots.n; i++)
        singular = singular || qdot_expr_contains(pool, e, c->roots.at[i].symbol);
    for (size_t i = 0; i < c->signs.n; i++)
        singular =
            singular || (!c->signs.at[i].branch && qdot_expr_contains(pool, e, c->signs.at[i].symbol));
    if (singular || qdot_walk_begin(pool, e, &w) != QDOT_OK)
        return true;
    for (size_t i = 0; i < w.n; i++)
        for (uint32_t f = 0;
             qdot_expr_kind(pool, w.at[i]) == QDOT_PROD && f < factor_count(pool, w.at[i]);
             f++) {
            int64_t k;

            singular =
                singular ||
                (is_root_square_or_factor(c, pool, factor_base(pool, w.at[i], f)) &&
                 !(qdot_expr_to_int(pool, factor_exponent(pool, w.at[i], f), &k) && k > 0));
        }
    qdot_walk_end(&w);
    return singular;
}

qdot_expr
qdot_chart_regular(const qdot_chart *c, qdot_expr e)
{
    qdot_pool *pool = c->pool;

    e = qdot_chart_put(c, e);
    if (e == QDOT_NIL || contains_bare_angle(c, e)) /* an angle remains outside of sin and cos: no simplification removes it */
        return QDOT_NIL;
    for (int tries = 0; tries < 4 && e != QDOT_NIL; tries++) {
        if (!is_singular(c, pool, e))
            return e;
        e = tries < 2 ? qdot_expand(pool, e) : qdot_mech_tidy(c->of, e);
        if (e != QDOT_NIL)
            e = qdot_walk_replace(pool, e, QDOT_PROD, replace_root_squares, (void *)(uintptr_t)c);
    }
    return QDOT_NIL;
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
