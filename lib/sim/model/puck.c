/* puck.c -- finds discs sliding on rough planes: the directions w/|w| of their velocities, also at rest. */
#include "sim/model/puck.h"

#include <stdio.h>

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/constant.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "normal/prove/decide.h"
#include "normal/solve/linear.h"
#include "sim/model/substitute.h"

/* --- finding directions of velocities ------------------------------------------------ */

/* Find twice the exponent of factor i of a product; false if that is no integer. */
static bool
find_twice_exponent(qdot_pool *pool, qdot_expr product, uint32_t i, int64_t *twice)
{
    const qdot_expr exponent = qdot_expr_arg(pool, product, i + 1);

    return qdot_expr_kind(pool, exponent) == QDOT_NUM &&
           qdot_expr_to_int(pool, qdot_mul(pool, qdot_expr_int(pool, 2), exponent),
                            twice);
}

static bool
contains_kind(const qdot_pool *pool, qdot_expr e, uint32_t what)
{
    return e != QDOT_NIL && (qdot_expr_node(pool, e)->holds & what) != 0;
}

static qdot_expr
half_derivative(qdot_pool *pool, qdot_expr e, qdot_expr v)
{
    return qdot_mul(pool, QDOT_HALF, qdot_diff(pool, e, v));
}

/* In e, replace the velocities that constraints relate to others by expressions in those others. */
static qdot_expr
replace_dependent_velocities(qdot_pool *pool, const qdot_puck *puck, qdot_expr e)
{
    return puck->n_tied == 0
               ? e
               : qdot_subs(pool, e, puck->n_tied, puck->tied_symbol, puck->to);
}

/* Solve the constraint f = 0 for a velocity contained in w: the last one with a constant coefficient. */
static qdot_status
solve_for_velocity(const qdot_scene *scene, qdot_expr f, qdot_puck *puck)
{
    qdot_pool *pool = scene->pool;
    const size_t k = puck->n_tied;
    const qdot_expr zero = QDOT_ZERO;

    for (size_t j = scene->coordinates.n; j-- > 0 && puck->n_tied == k;) {
        const qdot_expr v = qdot_symbol_jet(pool, scene->coordinates.at[j], 1);
        const qdot_expr slope = qdot_diff(pool, f, v);
        qdot_expr to;

        QDOT_TRY(qdot_pool_check(pool));
        if (slope == QDOT_ZERO || contains_kind(pool, slope, ~0u)
            || !qdot_expr_contains(pool, puck->square, v))
            continue;
        to = qdot_neg(pool, qdot_div(pool, qdot_subs(pool, f, 1, &v, &zero), slope));
        for (size_t i = 0; i < k; i++)
            puck->to[i] = qdot_subs(pool, puck->to[i], 1, &v, &to);
        puck->tied[k] = j;
        puck->tied_symbol[k] = v;
        puck->to[puck->n_tied++] = to;
    }
    return qdot_pool_check(pool);
}

/* Find the velocities in the sliding velocity w that a constraint expresses by other velocities. */
static qdot_status
find_dependent_velocities(const qdot_scene *scene, const qdot_run_request *request, qdot_puck *puck)
{
    qdot_pool *pool = scene->pool;

    for (size_t c = 0; c < scene->constraints.n && puck->n_tied < QDOT_PUCK_MOST_TIED; c++) {
        const qdot_constraint *from = &scene->constraints.at[c];
        qdot_expr f = qdot_substitute(pool, from->f, request->n_values, request->symbols,
                                      request->values);

        if (from->kind == QDOT_HOLONOMIC && f != QDOT_NIL)
            f = qdot_ddt(pool, f);
        QDOT_TRY(qdot_pool_check(pool));
        QDOT_TRY(solve_for_velocity(scene, replace_dependent_velocities(pool, puck, f), puck));
    }
    return qdot_pool_check(pool);
}

/* Find the derivatives of the dependent velocities by the independent ones. */
static qdot_status
find_velocity_ratios(qdot_pool *pool, qdot_puck *puck)
{
    for (size_t j = 0; j < puck->n_tied; j++)
        for (size_t a = 0; a < puck->k; a++) {
            const qdot_expr slope = qdot_diff(pool, puck->to[j], puck->symbol[a]);

            QDOT_TRY(qdot_pool_check(pool));
            QDOT_TRY(qdot_constant_double(pool, slope, &puck->follow[j][a]));
        }
    return QDOT_OK;
}

/* Choose the velocities that rest determines: one after another |w|^2 is at its least by each, and it
 * is 0 in the end. *fits: whether |w|^2 is a square in this sense. */
static qdot_status
choose_independent_velocities(const qdot_scene *scene, const qdot_facts *facts, qdot_puck *puck,
                              bool *fits)
{
    qdot_pool *pool = scene->pool;
    qdot_expr left = replace_dependent_velocities(pool, puck, puck->square);

    *fits = false;
    puck->k = 0;
    for (size_t j = 0; j < scene->coordinates.n && left != QDOT_NIL; j++) {
        const qdot_expr v = qdot_symbol_jet(pool, scene->coordinates.at[j], 1);
        const qdot_expr slope = half_derivative(pool, left, v);
        const qdot_expr bend = qdot_diff(pool, slope, v);

        QDOT_TRY(qdot_pool_check(pool));
        if (slope == QDOT_ZERO)
            continue;
        if (contains_kind(pool, bend, QDOT_HAS_VELOCITY) || puck->k == QDOT_PUCK_MOST)
            return QDOT_OK;
        if (bend == QDOT_ZERO || qdot_is_zero(pool, bend, facts))
            continue;
        puck->velocity[puck->k++] = j;
        left = qdot_sub(pool, left, qdot_div(pool, qdot_pow_int(pool, slope, 2), bend));
        left = qdot_expand(pool, left);
    }
    QDOT_TRY(qdot_pool_check(pool));
    *fits = puck->k > 0 && (left == QDOT_ZERO || qdot_is_zero(pool, left, facts));
    return qdot_pool_check(pool);
}

/* Find G and d of |w|^2 = d.G d, where G d is half the gradient of |w|^2 by the independent velocities. */
static qdot_status
find_quadratic_form(const qdot_scene *scene, const qdot_facts *facts, qdot_puck *puck)
{
    qdot_pool *pool = scene->pool;
    const size_t k = puck->k;
    qdot_expr *v = puck->symbol, h[QDOT_PUCK_MOST];
    const qdot_expr square = replace_dependent_velocities(pool, puck, puck->square);
    uint32_t pivot;

    for (size_t a = 0; a < k; a++)
        v[a] = qdot_symbol_jet(pool, scene->coordinates.at[puck->velocity[a]], 1);
    for (size_t a = 0; a < k; a++) {
        h[a] = half_derivative(pool, square, v[a]);
        for (size_t b = 0; b < k; b++)
            puck->metric[a * k + b] = qdot_expand(pool, qdot_diff(pool, h[a], v[b]));
    }
    QDOT_TRY(qdot_pool_check(pool));
    QDOT_TRY(
        qdot_solve_linear(pool, (uint32_t)k, puck->metric, h, puck->rest, &pivot, facts));
    for (size_t a = 0; a < k; a++)
        puck->rest[a] = qdot_expand(pool, puck->rest[a]);
    return qdot_pool_check(pool);
}

static qdot_status
append_disc(qdot_switches *s, qdot_puck *puck)
{
    qdot_surface x = {.u = puck->square, .puck = s->pucks.n + 1};
    char name[40];

    puck->surface = s->surfaces.n;
    puck->first = s->n_puck_symbols;
    for (size_t a = 0; a <= puck->k; a++) { /* give the symbols names with a space, which no user's name contains */
        qdot_expr *to = a < puck->k ? &puck->share[a] : &puck->inverse;

        snprintf(name, sizeof name, "puck %zu %zu", s->pucks.n + 1, a);
        *to = qdot_symbol_get(s->pool, QDOT_FORMAL, name);
    }
    snprintf(name, sizeof name, "puck %zu", s->pucks.n + 1);
    x.side = puck->length = qdot_symbol_get(s->pool, QDOT_FORMAL, name);
    QDOT_TRY(qdot_pool_check(s->pool));
    s->n_puck_symbols += puck->k + 1;
    QDOT_TRY(qdot_vec_push(&s->surfaces, x));
    return qdot_vec_push(&s->pucks, *puck);
}

static qdot_status
add_disc_if_suitable(const qdot_scene *scene, const qdot_run_request *request, qdot_switches *s,
                     qdot_expr square)
{
    const qdot_facts of = qdot_scene_facts(scene), *facts = &of;
    qdot_puck puck = {.square = square};
    qdot_status status;
    bool fits;

    for (size_t i = 0; i < s->pucks.n; i++)
        if (s->pucks.at[i].square == square)
            return QDOT_OK;
    QDOT_TRY(find_dependent_velocities(scene, request, &puck));
    QDOT_TRY(choose_independent_velocities(scene, facts, &puck, &fits));
    if (!fits)
        return QDOT_OK;
    status = find_quadratic_form(scene, facts, &puck);
    if (status == QDOT_ESINGULAR)
        return QDOT_OK;
    if (status == QDOT_OK)
        status = find_velocity_ratios(scene->pool, &puck);
    return status == QDOT_OK ? append_disc(s, &puck) : status;
}

qdot_status
qdot_pucks_find(const qdot_scene *scene, const qdot_run_request *request,
                qdot_switches *s)
{
    qdot_pool *pool = scene->pool;
    qdot_status status = QDOT_OK;
    qdot_walk walk;

    if (s->forcing == QDOT_NIL || request->digits > 0 || request->lanes)
        return QDOT_OK;
    QDOT_TRY(qdot_walk_begin(pool, s->forcing, &walk));
    for (size_t i = 0; i < walk.n && status == QDOT_OK; i++) {
        const qdot_expr e = walk.at[i];

        for (uint32_t k = 1; qdot_expr_kind(pool, e) == QDOT_PROD &&
                             k + 1 < qdot_expr_count(pool, e) && status == QDOT_OK;
             k += 2) {
            const qdot_expr base = qdot_expr_arg(pool, e, k);
            int64_t twice;

            if (qdot_expr_kind(pool, base) == QDOT_SUM &&
                contains_kind(pool, base, QDOT_HAS_VELOCITY) &&
                !contains_kind(pool, base, QDOT_HAS_ACCELERATION | QDOT_HAS_MULTIPLIER) &&
                find_twice_exponent(pool, e, k, &twice) && twice == -1)
                status = add_disc_if_suitable(scene, request, s, base);
        }
    }
    qdot_walk_end(&walk);
    return status == QDOT_OK ? qdot_pool_check(pool) : status;
}

/* --- expressions near rest ----------------------------------------------------------- */

/* How powers of the speed |w| are rewritten, except even positive powers. */
typedef struct {
    const qdot_puck *puck;
    enum {
        AT_REST,     /* disc at rest: 1/|w| becomes the symbol `inverse`, positive powers become 0 */
        AS_INVERSES, /* all powers by the symbol `inverse` and |w|^2 */
        AS_LENGTHS   /* all powers by the symbol `length` */
    } by;
    bool refused; /* if AT_REST: the expression contains a negative power other than 1/|w| */
} replacement;

static qdot_expr rewrite_speed(qdot_pool *pool, qdot_expr e, replacement *r);

static qdot_expr
replace_speed_powers(qdot_pool *pool, qdot_expr node, void *user)
{
    replacement *r = user;
    const qdot_expr square = r->puck->square;
    int64_t twice = 0;
    uint32_t at = 0;
    qdot_expr rest;

    if (qdot_expr_kind(pool, node) != QDOT_PROD)
        return QDOT_NIL;
    for (uint32_t k = 1; k + 1 < qdot_expr_count(pool, node); k += 2)
        if (qdot_expr_arg(pool, node, k) == square &&
            find_twice_exponent(pool, node, k, &twice) && (twice % 2 != 0 || twice < 0))
            at = k;
    if (at == 0)
        return QDOT_NIL;
    (void)find_twice_exponent(pool, node, at, &twice);
    r->refused |= twice < -1;
    rest =
        qdot_div(pool, node, qdot_pow(pool, square, qdot_expr_arg(pool, node, at + 1)));
    rest = rewrite_speed(pool, rest, r);
    if (r->by == AS_LENGTHS)
        return qdot_mul(pool, rest, qdot_pow_int(pool, r->puck->length, twice));
    if (twice > 0 && r->by == AT_REST)
        return QDOT_ZERO;
    if (twice > 0)
        rest = qdot_mul(pool, rest, qdot_pow_int(pool, square, (twice + 1) / 2));
    return qdot_mul(pool, rest,
                    qdot_pow_int(pool, r->puck->inverse, twice > 0 ? 1 : -twice));
}

static qdot_expr
rewrite_speed(qdot_pool *pool, qdot_expr e, replacement *r)
{
    return e == QDOT_NIL ? e : qdot_walk_map(pool, e, replace_speed_powers, r);
}

static bool
contains_expression(const qdot_pool *pool, qdot_expr e, qdot_expr x)
{
    return e != QDOT_NIL && qdot_expr_contains(pool, e, x);
}

/* The force at rest in place of C/|w|: sum B_j s_j, with friction ratios s to be found; C: the coefficient. */
static qdot_expr
force_at_rest(qdot_pool *pool, const qdot_puck *puck, qdot_expr C)
{
    qdot_expr sum = QDOT_ZERO;

    for (size_t a = 0; a < puck->k; a++)
        sum =
            qdot_add(pool, sum,
                     qdot_mul(pool, puck->share[a], qdot_diff(pool, C, puck->symbol[a])));
    return sum;
}

/* The coefficient C of 1/|w|, evaluated at w = 0 (disc at rest). */
static qdot_expr
coefficient_at_rest(qdot_pool *pool, const qdot_puck *puck, qdot_expr C)
{
    qdot_expr to[QDOT_PUCK_MOST];

    for (size_t a = 0; a < puck->k; a++)
        to[a] = qdot_sub(pool, puck->symbol[a], puck->rest[a]);
    return qdot_subs(pool, C, puck->k, puck->symbol, to);
}

static qdot_status
rewrite_at_rest(qdot_pool *pool, const qdot_puck *puck, const qdot_facts *facts, qdot_expr *e)
{
    replacement r = {.puck = puck, .by = AT_REST};
    const qdot_expr zero = QDOT_ZERO, all = rewrite_speed(pool, *e, &r);
    qdot_expr C, left;

    QDOT_TRY(qdot_pool_check(pool));
    C = replace_dependent_velocities(pool, puck, qdot_diff(pool, all, puck->inverse));
    QDOT_TRY(qdot_pool_check(pool));
    if (r.refused || contains_expression(pool, C, puck->inverse))
        return qdot_fail(
            QDOT_EFAILED,
            "a force there is not proportional to the direction of the motion");
    left = coefficient_at_rest(pool, puck, C);
    QDOT_TRY(qdot_pool_check(pool));
    if (left != QDOT_ZERO && !qdot_is_zero(pool, left, facts))
        return qdot_fail(QDOT_EFAILED, "a force there is infinite");
    *e = qdot_add(pool, qdot_subs(pool, all, 1, &puck->inverse, &zero),
                  force_at_rest(pool, puck, C));
    return qdot_pool_check(pool);
}

qdot_status
qdot_puck_hold(qdot_pool *pool, const qdot_puck *puck, const qdot_facts *facts, size_t n,
               qdot_expr *e)
{
    for (size_t i = 0; i < n; i++)
        QDOT_TRY(rewrite_at_rest(pool, puck, facts, &e[i]));
    return QDOT_OK;
}

qdot_expr
qdot_puck_square(qdot_pool *pool, const qdot_puck *puck, const qdot_expr *share)
{
    qdot_expr sum = QDOT_ZERO;

    for (size_t a = 0; a < puck->k; a++)
        for (size_t b = 0; b < puck->k; b++)
            sum = qdot_add(pool, sum,
                           qdot_mul(pool, puck->metric[a * puck->k + b],
                                    qdot_mul(pool, share[a], share[b])));
    return sum;
}

qdot_expr
qdot_puck_inverse_root(qdot_pool *pool, qdot_expr square)
{
    const qdot_expr more = qdot_sub(pool, square, QDOT_ONE);
    qdot_expr sum = QDOT_ONE;

    for (int64_t n = 5; n >= 1; n--) { /* evaluate the series by Horner's rule: 1 - z/2 (1 - 3 z/4 (1 - 5 z/6 (...))) */
        const qdot_expr c =
            qdot_div(pool, qdot_expr_int(pool, 2 * n - 1), qdot_expr_int(pool, 2 * n));

        sum = qdot_sub(pool, QDOT_ONE, qdot_mul(pool, qdot_mul(pool, c, more), sum));
    }
    return sum;
}

/* Whether e contains a negative power of x. */
static bool
contains_negative_power(const qdot_pool *pool, qdot_expr e, qdot_expr x, qdot_status *status)
{
    bool found = false;
    qdot_walk walk;

    *status = qdot_walk_begin(pool, e, &walk);
    for (size_t i = 0; *status == QDOT_OK && i < walk.n; i++)
        for (uint32_t k = 1; qdot_expr_kind(pool, walk.at[i]) == QDOT_PROD &&
                             k + 1 < qdot_expr_count(pool, walk.at[i]);
             k += 2)
            found =
                found || (qdot_expr_arg(pool, walk.at[i], k) == x &&
                          qdot_expr_is_negative((qdot_pool *)pool,
                                                qdot_expr_arg(pool, walk.at[i], k + 1)));
    qdot_walk_end(&walk);
    return found;
}

qdot_status
qdot_puck_reading(qdot_pool *pool, const qdot_puck *puck, qdot_expr *e)
{
    replacement near = {.puck = puck, .by = AS_LENGTHS},
                moving = {.puck = puck, .by = AS_INVERSES};
    const qdot_expr zeros[QDOT_PUCK_MOST] = {QDOT_ZERO, QDOT_ZERO, QDOT_ZERO,
                                             QDOT_ZERO, QDOT_ZERO, QDOT_ZERO};
    qdot_expr to[QDOT_PUCK_MOST], rest = rewrite_speed(pool, *e, &near);
    qdot_status status;

    if (rest == *e) /* the expression does not contain the direction w/|w| */
        return QDOT_OK;
    for (size_t a = 0; a < puck->k; a++)
        to[a] = qdot_add(pool, qdot_sub(pool, puck->symbol[a], puck->rest[a]),
                         qdot_mul(pool, puck->length, puck->share[a]));
    rest = replace_dependent_velocities(pool, puck, rest);
    rest = qdot_expand(pool, qdot_subs(pool, rest, puck->k, puck->symbol, to));
    QDOT_TRY(qdot_pool_check(pool));
    if (contains_negative_power(pool, rest, puck->length, &status))
        return qdot_fail(
            QDOT_EFAILED,
            "it has no value where the motion rests: it is no function of the direction "
            "of a velocity");
    QDOT_TRY(status);
    rest = qdot_subs(pool, rest, 1, &puck->length, zeros);
    *e = qdot_add(
        pool, rewrite_speed(pool, *e, &moving),
        qdot_sub(pool, rest, qdot_subs(pool, rest, puck->k, puck->share, zeros)));
    return qdot_pool_check(pool);
}
