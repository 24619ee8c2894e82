/* kinks.c -- antiderivatives of what holds abs, sign, max, min and if, piece by piece. */
#include "normal/integral/piecewise.h"

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/elementary.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "normal/calculus/expansion.h"
#include "normal/field/normal-form.h"
#include "normal/integral/ends.h"
#include "normal/simplify/positive.h"
#include "normal/simplify/simplify.h"
#include "normal/solve/solve.h"

enum { MOST_PLACES = 8 };

/* What a kink is decided by: the sign of gap between the places [n], ascending; sign [n + 1]. */
typedef struct {
    qdot_pool *pool;
    const qdot_facts *facts;
    qdot_expr x, node, gap;
    qdot_expr place[MOST_PLACES];
    int sign[MOST_PLACES + 1];
    size_t n;
} kink;

static const qdot_fun_id kinked[] = {QDOT_ABS, QDOT_SIGN, QDOT_MAX, QDOT_MIN, QDOT_IF};

static bool
is_kinked(const qdot_pool *pool, qdot_expr e)
{
    for (size_t i = 0; i < sizeof kinked / sizeof *kinked; i++)
        if (qdot_expr_is_function(pool, e, kinked[i]))
            return true;
    return false;
}

bool
qdot_piecewise_kinks(qdot_pool *pool, qdot_expr e, qdot_expr x)
{
    return qdot_expr_find_function(pool, e, sizeof kinked / sizeof *kinked, kinked, x) != QDOT_NIL;
}

/* The expression whose sign decides the node; nil: none does. */
static qdot_expr
gap_of(qdot_pool *pool, qdot_expr node)
{
    const qdot_expr u = qdot_expr_arg(pool, node, 0);

    switch ((qdot_fun_id)qdot_expr_node(pool, node)->op) {
    case QDOT_ABS:
    case QDOT_SIGN: return u;
    case QDOT_MAX:
    case QDOT_MIN: return qdot_sub(pool, qdot_expr_arg(pool, node, 1), u);
    default:
        return qdot_expr_kind(pool, u) != QDOT_REL || qdot_expr_node(pool, u)->op == QDOT_EQ
                   ? QDOT_NIL
                   : qdot_sub(pool, qdot_expr_arg(pool, u, 1), qdot_expr_arg(pool, u, 0));
    }
}

/* What the node is where its gap has the sign. */
static qdot_expr
node_at_sign(qdot_pool *pool, qdot_expr node, int sign)
{
    const qdot_fun_id id = (qdot_fun_id)qdot_expr_node(pool, node)->op;
    const qdot_expr u = qdot_expr_arg(pool, node, 0);

    switch (id) {
    case QDOT_ABS: return sign > 0 ? u : qdot_neg(pool, u);
    case QDOT_SIGN: return qdot_expr_int(pool, sign);
    case QDOT_MAX:
    case QDOT_MIN: { /* without the one of the first two that it is not */
        const uint32_t n = qdot_expr_count(pool, node);
        qdot_expr args[2 + MOST_PLACES];

        if (n > 2 + MOST_PLACES)
            return QDOT_NIL;
        args[0] = qdot_expr_arg(pool, node, (sign > 0) == (id == QDOT_MAX) ? 1 : 0);
        for (uint32_t i = 2; i < n; i++)
            args[i - 1] = qdot_expr_arg(pool, node, i);
        return n == 2 ? args[0] : qdot_fun(pool, id, n - 1, args);
    }
    default: return qdot_expr_arg(pool, node, sign > 0 ? 1 : 2);
    }
}

static bool
is_constant_value(qdot_pool *pool, qdot_expr e)
{
    return e != QDOT_NIL && qdot_expr_is_constant(pool, e);
}

/* The sign of the gap at a number. */
static int
sign_of_gap_at(const kink *k, qdot_expr at)
{
    const qdot_expr value = qdot_subs(k->pool, k->gap, 1, &k->x, &at);

    if (value == QDOT_NIL) {
        (void)!qdot_pool_check(k->pool);
        return 0;
    }
    return qdot_proved_sign(k->pool, value, k->facts);
}

/* The places of a gap that is linear in x. */
static bool
find_linear_place(kink *k, qdot_expr slope)
{
    qdot_pool *pool = k->pool;
    const qdot_expr zero = QDOT_ZERO;
    const int sign = qdot_proved_sign(pool, slope, k->facts);

    if (sign != 1 && sign != -1)
        return false;
    k->n = 1;
    k->place[0] = qdot_normal(pool, qdot_neg(pool, qdot_div(pool, qdot_subs(pool, k->gap, 1, &k->x, &zero), slope)), NULL);
    k->sign[0] = -sign;
    k->sign[1] = sign;
    return k->place[0] != QDOT_NIL;
}

/* The places of another gap, which holds no parameters and is finite everywhere; false: they are not all known. */
static bool
find_kink_places(kink *k)
{
    qdot_pool *pool = k->pool;
    const qdot_expr slope = qdot_diff(pool, k->gap, k->x), zero = QDOT_ZERO;
    qdot_solutions roots = {0};
    qdot_status status;
    bool known;

    if (slope == QDOT_NIL || slope == QDOT_ZERO)
        return false;
    if (!qdot_expr_contains(pool, slope, k->x))
        return find_linear_place(k, slope);
    if (!is_constant_value(pool, qdot_subs(pool, k->gap, 1, &k->x, &zero))) {
        (void)!qdot_pool_check(pool);
        return false;
    }
    status = qdot_solve(pool, k->gap, k->x, k->facts, &roots);
    known = status == QDOT_OK && roots.complete && !roots.single && !roots.recurs && roots.root.n <= MOST_PLACES;
    for (size_t i = 0; i < roots.root.n && known; i++) {
        const qdot_root *root = &roots.root.at[i];

        known = root->period == QDOT_NIL && root->condition == QDOT_NIL && is_constant_value(pool, root->value);
        k->place[k->n++] = root->value;
    }
    qdot_solutions_clear(&roots);
    if (qdot_grave(status) != QDOT_OK)
        return qdot_pool_fail(pool) != QDOT_NIL;
    for (size_t i = 0; i <= k->n && known; i++) {
        const qdot_expr at = k->n == 0   ? QDOT_ZERO
                             : i == 0    ? qdot_sub(pool, k->place[0], QDOT_ONE)
                             : i == k->n ? qdot_add(pool, k->place[i - 1], QDOT_ONE)
                                         : qdot_mul(pool, QDOT_HALF, qdot_add(pool, k->place[i - 1], k->place[i]));

        k->sign[i] = sign_of_gap_at(k, at);
        known = k->sign[i] == 1 || k->sign[i] == -1;
        if (i > 0 && i < k->n)
            known = known && qdot_proved_sign(pool, qdot_sub(pool, k->place[i], k->place[i - 1]), k->facts) == 1;
    }
    return known;
}

/* Whether no factor of the product makes it infinite or undefined for any x. */
static bool
is_finite_product(const qdot_pool *pool, qdot_expr e, qdot_expr x)
{
    for (uint32_t k = 1; k < qdot_expr_count(pool, e); k += 2) {
        const qdot_expr base = qdot_expr_arg(pool, e, k);
        const uint8_t sign = qdot_expr_sign(pool, base);
        int64_t power;

        if (!qdot_expr_contains(pool, base, x) || (sign & QDOT_POS) == QDOT_POS)
            continue;
        if (!qdot_expr_to_int(pool, qdot_expr_arg(pool, e, k + 1), &power) || (power < 0 && !(sign & QDOT_NE0)))
            return false;
    }
    return true;
}

bool
qdot_piecewise_finite(qdot_pool *pool, qdot_expr e, qdot_expr x)
{
    bool finite = true;
    qdot_walk w;

    if (qdot_walk_begin(pool, e, &w) != QDOT_OK)
        return false;
    for (size_t i = 0; i < w.n && finite; i++) {
        const qdot_expr at = w.at[i];
        const qdot_kind kind = qdot_expr_kind(pool, at);

        if (!qdot_expr_contains(pool, at, x) || at == x || kind == QDOT_SUM || kind == QDOT_REL)
            continue;
        finite = kind == QDOT_PROD ? is_finite_product(pool, at, x)
                                   : qdot_expr_is_function_that(pool, at, QDOT_FUN_ENTIRE) || is_kinked(pool, at) ||
                                         qdot_expr_is_function(pool, at, QDOT_FLOOR) ||
                                         (qdot_expr_is_function(pool, at, QDOT_MOD) &&
                                          !qdot_expr_contains(pool, qdot_expr_arg(pool, at, 1), x));
    }
    qdot_walk_end(&w);
    return finite;
}

/* if(RELATION, a, b) of numbers as what it is. */
static qdot_expr
settle_choice(qdot_pool *pool, qdot_expr node, void *user)
{
    const qdot_expr gap = qdot_expr_is_function(pool, node, QDOT_IF) ? gap_of(pool, node) : QDOT_NIL;
    const int sign = gap == QDOT_NIL || !is_constant_value(pool, gap) ? 2 : qdot_proved_sign(pool, gap, user);

    return sign == 1 || sign == -1 ? node_at_sign(pool, node, sign) : node;
}

qdot_expr
qdot_piecewise_at(qdot_pool *pool, qdot_expr F, qdot_expr x, qdot_expr at, const qdot_facts *facts)
{
    qdot_facts assumed = facts == NULL ? (qdot_facts){0} : *facts;

    return qdot_walk_replace(pool, qdot_subs(pool, F, 1, &x, &at), QDOT_FUN, settle_choice, &assumed);
}

/* What is to be added to G so that it goes on from F at a place; 0 where both are infinite. */
static bool
find_constant(const kink *k, qdot_expr F, qdot_expr G, qdot_expr at, qdot_expr *constant)
{
    qdot_end left, right;

    *constant = QDOT_ZERO;
    if (qdot_end_value(k->pool, F, k->x, at, -1, k->facts, &left) != QDOT_OK ||
        qdot_end_value(k->pool, G, k->x, at, 1, k->facts, &right) != QDOT_OK)
        return qdot_pool_fail(k->pool) != QDOT_NIL;
    if (left.kind == QDOT_END_VALUE && right.kind == QDOT_END_VALUE)
        *constant = qdot_piecewise_at(k->pool, qdot_sub(k->pool, left.value, right.value), k->x, k->x, k->facts);
    return left.kind != QDOT_END_UNKNOWN && right.kind != QDOT_END_UNKNOWN;
}

/* F0 below the only place, F1 above it: with sign(gap) where they are opposite, else by cases. */
static qdot_expr
join_two(const kink *k, qdot_expr F0, qdot_expr F1)
{
    qdot_pool *pool = k->pool;
    const qdot_expr up = k->sign[1] > 0 ? F1 : F0, down = k->sign[1] > 0 ? F0 : F1;
    const qdot_expr relation = qdot_expr_is_function(pool, k->node, QDOT_IF)
                                   ? qdot_expr_arg(pool, k->node, 0)
                                   : qdot_positive_without_minus(pool, k->gap);

    if (qdot_normal(pool, qdot_add(pool, up, down), NULL) == QDOT_ZERO)
        return qdot_mul(pool, qdot_fun1(pool, QDOT_SIGN, k->gap), up);
    return qdot_fun(pool, QDOT_IF, 3, (qdot_expr[]){relation, up, down});
}

/* Join the antiderivatives F [n + 1] of the pieces. */
static qdot_expr
join_pieces(const kink *k, qdot_expr *F)
{
    qdot_pool *pool = k->pool;
    qdot_expr joined;

    for (size_t i = 1; i <= k->n; i++) {
        qdot_expr constant;

        if (!find_constant(k, F[i - 1], F[i], k->place[i - 1], &constant))
            return QDOT_NIL;
        if (k->n == 1 && constant != QDOT_ZERO) { /* both 0 at the place if they can be */
            qdot_end end;

            if (qdot_end_value(pool, F[1], k->x, k->place[0], 1, k->facts, &end) != QDOT_OK)
                return qdot_pool_fail(pool);
            end.value = qdot_piecewise_at(pool, end.value, k->x, k->x, k->facts);
            F[1] = qdot_simplify(pool, qdot_sub(pool, F[1], end.value), k->facts);
            F[0] = qdot_simplify(pool, qdot_sub(pool, F[0], qdot_add(pool, end.value, constant)), k->facts);
        } else {
            F[i] = qdot_simplify(pool, qdot_add(pool, F[i], constant), k->facts);
        }
    }
    if (k->n == 1)
        return join_two(k, F[0], F[1]);
    joined = F[k->n];
    for (size_t i = k->n; i-- > 0;)
        if (F[i] != joined)
            joined = qdot_fun(pool, QDOT_IF, 3, (qdot_expr[]){qdot_rel(pool, QDOT_LT, k->x, k->place[i]), F[i], joined});
    return joined;
}

qdot_expr
qdot_kinks_antiderivative(qdot_pool *pool, qdot_expr e, qdot_expr x, const qdot_facts *facts, qdot_piece_find *find)
{
    kink k = {.pool = pool, .facts = facts, .x = x};
    qdot_expr F[MOST_PLACES + 1];

    k.node = qdot_expr_find_function(pool, e, sizeof kinked / sizeof *kinked, kinked, x);
    k.gap = k.node == QDOT_NIL ? QDOT_NIL : gap_of(pool, k.node);
    if (k.gap == QDOT_NIL || qdot_piecewise_steps(pool, k.gap, x) || !qdot_piecewise_finite(pool, k.gap, x) || !find_kink_places(&k))
        return QDOT_NIL;
    for (size_t i = 0; i <= k.n; i++) {
        const qdot_expr to = node_at_sign(pool, k.node, k.sign[i]);

        F[i] = QDOT_NIL;
        for (size_t j = 0; j < i && F[i] == QDOT_NIL; j++)
            if (k.sign[j] == k.sign[i])
                F[i] = F[j];
        if (F[i] == QDOT_NIL && to != QDOT_NIL)
            F[i] = find(pool, qdot_subs(pool, e, 1, &k.node, &to), x, facts);
        if (F[i] == QDOT_NIL)
            return QDOT_NIL;
    }
    return join_pieces(&k, F);
}

/* --- waves ------------------------------------------------------------------------------- */

/* |u| for u a sine or cosine times what does not hold x: c sin(mod(v, pi)); nil: it is none. */
static qdot_expr
size_of_wave(qdot_pool *pool, qdot_expr u, qdot_expr x)
{
    const bool product = qdot_expr_kind(pool, u) == QDOT_PROD;
    qdot_expr front = product ? qdot_fun1(pool, QDOT_ABS, qdot_expr_arg(pool, u, 0)) : QDOT_ONE, wave = product ? QDOT_NIL : u, v;

    for (uint32_t i = 1; product && i < qdot_expr_count(pool, u); i += 2) {
        const qdot_expr b = qdot_expr_arg(pool, u, i), p = qdot_expr_arg(pool, u, i + 1);

        if (!qdot_expr_contains(pool, b, x))
            front = qdot_mul(pool, front, qdot_fun1(pool, QDOT_ABS, qdot_pow(pool, b, p)));
        else if (p != QDOT_ONE || wave != QDOT_NIL)
            return QDOT_NIL;
        else
            wave = b;
    }
    if (wave == QDOT_NIL || (!qdot_expr_is_function(pool, wave, QDOT_SIN) && !qdot_expr_is_function(pool, wave, QDOT_COS)))
        return QDOT_NIL;
    v = qdot_expr_arg(pool, wave, 0);
    if (qdot_expr_is_function(pool, wave, QDOT_COS))
        v = qdot_add(pool, v, qdot_mul(pool, QDOT_HALF, QDOT_PI));
    return qdot_mul(pool, front, qdot_fun1(pool, QDOT_SIN, qdot_fun(pool, QDOT_MOD, 2, (qdot_expr[]){v, QDOT_PI})));
}

static qdot_expr
kink_as_steps(qdot_pool *pool, qdot_expr node, void *user)
{
    const qdot_expr x = *(const qdot_expr *)user;
    const bool max = qdot_expr_is_function(pool, node, QDOT_MAX), min = qdot_expr_is_function(pool, node, QDOT_MIN);
    qdot_expr size;

    if (!qdot_expr_contains(pool, node, x) || (!max && !min && !qdot_expr_is_function(pool, node, QDOT_ABS)) ||
        ((max || min) && qdot_expr_count(pool, node) != 2))
        return node;
    size = size_of_wave(pool, gap_of(pool, node), x);
    if (size == QDOT_NIL)
        return node;
    if (!max && !min)
        return size;
    size = max ? size : qdot_neg(pool, size);
    return qdot_mul(pool, QDOT_HALF,
                    qdot_sum(pool, 3, (qdot_expr[]){qdot_expr_arg(pool, node, 0), qdot_expr_arg(pool, node, 1), size}));
}

qdot_expr
qdot_piecewise_waves(qdot_pool *pool, qdot_expr e, qdot_expr x)
{
    return qdot_walk_replace(pool, e, QDOT_FUN, kink_as_steps, &x);
}
