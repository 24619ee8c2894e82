/* equilibrium-kinks.c -- forces that jump, as functions of signs; and kinks that the search does not resolve.
 *
 * The search for rests at corners (equilibrium-corners.c) knows jumps by signs. Others are written so:
 *
 *     max(a, b) = (a + b + |a - b|)/2,   |u|^-1 = sign(u)/u,
 *     if(u > 0, A, B) = (A + B)/2 + sign(u) (A - B)/2.
 *
 * The last is done where A - B does not vanish with u (else nothing jumps) and the energy is continuous there. Where
 * b >= 0 vanishes, forces with a root of b in the denominator have a direction but no value: at the tip of a cone,
 * sqrt(x^2 + y^2). No rest is there if they point away from it, as at the end of a spring with a natural length.
 */
#include <inttypes.h>
#include <math.h>
#include <stdio.h>

#include "expr/build.h"
#include "expr/elementary.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "mech/dynamics/direction.h"
#include "mech/dynamics/generic.h"
#include "mech/dynamics/quantity.h"
#include "mech/scene/access.h"
#include "mech/study/equilibrium-search.h"
#include "mech/linear/linear-motion.h"
#include "normal/inequality/less.h"
#include "normal/prove/decide.h"
#include "normal/prove/rewrite.h"
#include "normal/simplify/simplify.h"
#include "normal/solve/conditions.h"
#include "normal/solve/solve.h"

enum { SAMPLES = 64, MOST_NESTED = 3 };

static bool
contains_coordinate(const qdot_rest *r, qdot_expr e)
{
    return (qdot_mech_holds(r->s, e) & QDOT_HAS_COORD) != 0;
}

/* --- jumps as signs --------------------------------------------------------------------------- */

/* The expression u of a condition u > 0 or u >= 0; nil for other conditions. */
static qdot_expr
condition_difference(qdot_pool *pool, qdot_expr condition)
{
    if (qdot_expr_kind(pool, condition) != QDOT_REL ||
        qdot_expr_node(pool, condition)->op == QDOT_EQ)
        return QDOT_NIL;
    return qdot_sub(pool, qdot_expr_arg(pool, condition, 1),
                    qdot_expr_arg(pool, condition, 0));
}

/* Replace a sign by a symbol: where its argument is 0, friction may give it any value in -1 ... 1. */
static qdot_expr
replace_sign_by_symbol(qdot_pool *pool, qdot_expr e, void *user)
{
    char name[32];

    if (!qdot_expr_is_function(pool, e, QDOT_SIGN) || !contains_coordinate(user, e))
        return e;
    snprintf(name, sizeof name, "(side of %" PRIu64 ")", (uint64_t)e);
    return qdot_symbol_get(pool, QDOT_FORMAL, name);
}

/* Whether e is proved to vanish wherever u does, for any values of its signs there. */
static qdot_status
vanishes_with(const qdot_rest *r, qdot_expr e, qdot_expr u, bool *yes)
{
    qdot_pool *pool = r->pool;
    qdot_solutions found;
    qdot_expr x = QDOT_NIL;
    qdot_status status;

    *yes = e == QDOT_ZERO;
    for (size_t i = 0; i < r->s->coordinates.n && x == QDOT_NIL; i++)
        if (qdot_expr_contains(pool, u, r->s->coordinates.at[i]))
            x = r->s->coordinates.at[i];
    if (*yes || x == QDOT_NIL)
        return QDOT_OK;
    e = e == QDOT_NIL ? QDOT_NIL : qdot_walk_replace(pool, e, QDOT_FUN, replace_sign_by_symbol, (void *)r);
    QDOT_TRY(qdot_pool_check(pool));
    status = qdot_solve(pool, u, x, &r->facts, &found);
    *yes = status == QDOT_OK && found.complete && found.divisor.n == 0;
    for (size_t i = 0; *yes && i < found.root.n; i++) {
        qdot_expr room[QDOT_CONDITIONS_MOST], there;
        qdot_facts facts =
            qdot_facts_and(pool, &r->facts, found.root.at[i].condition, room);

        there = qdot_subs(pool, e, 1, &x, &found.root.at[i].value);
        *yes = found.root.at[i].value != x && there != QDOT_NIL &&
               qdot_is_zero(pool, there, &facts);
    }
    qdot_solutions_clear(&found);
    if (status == QDOT_OK)
        status = qdot_pool_check(pool);
    if (status != QDOT_EDOMAIN)
        return status;
    *yes = false;
    return QDOT_OK;
}

qdot_status
qdot_rest_jumps(const qdot_rest *r, qdot_expr equations, qdot_expr u, bool *yes)
{
    qdot_pool *pool = r->pool;
    qdot_expr sign = qdot_fun1(pool, QDOT_SIGN, u), side = qdot_symbol_get(pool, QDOT_FORMAL, "(side)");

    *yes = false;
    for (uint32_t i = 0; i < qdot_expr_count(pool, equations) && !*yes; i++) {
        qdot_expr G = qdot_subs(pool, qdot_expr_arg(pool, equations, i), 1, &sign, &side);
        bool alike;

        G = qdot_diff(pool, G, side);
        QDOT_TRY(qdot_pool_check(pool));
        QDOT_TRY(vanishes_with(r, G, u, &alike));
        *yes = !alike;
    }
    return QDOT_OK;
}

/* Whether the energy is continuous at u = 0: the branches of each if(...) that depends on u agree there. */
static qdot_status
is_continuous(const qdot_rest *r, qdot_expr u, bool *yes)
{
    qdot_pool *pool = r->pool;
    qdot_status status = QDOT_OK;
    qdot_walk w;

    *yes = true;
    QDOT_TRY(qdot_walk_begin(pool, r->energy, &w));
    for (size_t i = 0; i < w.n && *yes && status == QDOT_OK; i++) {
        qdot_expr gap;

        if (!qdot_expr_is_function(pool, w.at[i], QDOT_IF))
            continue;
        gap = condition_difference(pool, qdot_expr_arg(pool, w.at[i], 0));
        if (gap == QDOT_NIL || (u != QDOT_NIL && gap != u) || !contains_coordinate(r, gap))
            continue;
        gap = qdot_sub(pool, qdot_expr_arg(pool, w.at[i], 1),
                       qdot_expr_arg(pool, w.at[i], 2));
        status = vanishes_with(r, gap,
                               condition_difference(pool, qdot_expr_arg(pool, w.at[i], 0)), yes);
    }
    qdot_walk_end(&w);
    return status;
}

typedef struct {
    qdot_rest *r;
    qdot_status status;
} rewriting;

static qdot_expr
divide_by_two(qdot_pool *pool, qdot_expr e)
{
    return qdot_div(pool, e, qdot_expr_int(pool, 2));
}

static qdot_expr
rewrite_function_by_signs(qdot_pool *pool, qdot_expr e, void *user)
{
    rewriting *w = user;
    qdot_expr u, yes, no;
    bool continuous, alike;

    if (w->status != QDOT_OK || !contains_coordinate(w->r, e))
        return e;
    if (qdot_expr_is_function(pool, e, QDOT_MAX) || qdot_expr_is_function(pool, e, QDOT_MIN))
        return qdot_rewrite_extreme(pool, e);
    if (!qdot_expr_is_function(pool, e, QDOT_IF))
        return e;
    u = condition_difference(pool, qdot_expr_arg(pool, e, 0));
    if (u != QDOT_NIL && !contains_coordinate(w->r, u))
        return e;
    if (u == QDOT_NIL) {
        w->r->unresolved = true;
        return e;
    }
    yes = qdot_expr_arg(pool, e, 1);
    no = qdot_expr_arg(pool, e, 2);
    w->status = vanishes_with(w->r, qdot_sub(pool, yes, no), u, &alike);
    if (w->status != QDOT_OK || alike)
        return e;
    w->status = is_continuous(w->r, u, &continuous);
    if (!continuous) {
        w->r->unresolved = true;
        return e;
    }
    u = qdot_mul(pool, qdot_fun1(pool, QDOT_SIGN, u), qdot_sub(pool, yes, no));
    return divide_by_two(pool, qdot_add(pool, u, qdot_add(pool, yes, no)));
}

/* Whether e > 0 is proved. */
static bool
ratio_is_positive(qdot_pool *pool, qdot_expr e, const qdot_facts *facts)
{
    qdot_decision d;

    return qdot_decide_less(pool, QDOT_ZERO, e, true, facts, &d) == QDOT_OK && d.verdict == QDOT_PROVED;
}

/* The sign of u / v for v > 0 (up) or v < 0, with |v| and sign v inserted; 0 if unknown. */
static int
sign_beside(qdot_pool *pool, qdot_expr u, qdot_expr v, bool up, const qdot_facts *facts)
{
    const qdot_expr from[2] = {qdot_fun1(pool, QDOT_ABS, v), qdot_fun1(pool, QDOT_SIGN, v)},
                    to[2] = {up ? v : qdot_neg(pool, v), up ? QDOT_ONE : QDOT_MINUS_ONE};
    qdot_expr ratio = qdot_subs(pool, u, 2, from, to);

    /* repeat for nested absolute values: |4 x + |x||, |5 x|, 5 |x|, 5 x */
    for (int i = 0; i < MOST_NESTED && ratio != QDOT_NIL; i++)
        ratio = qdot_subs(pool, qdot_simplify(pool, ratio, facts), 2, from, to);
    ratio = qdot_simplify(pool, qdot_div(pool, ratio, v), facts);
    if (ratio == QDOT_NIL)
        return 0;
    if (ratio_is_positive(pool, ratio, facts))
        return 1;
    return ratio_is_positive(pool, qdot_neg(pool, ratio), facts) ? -1 : 0;
}

/* By sign v alone the sign of a u that is v times another number on either side of v = 0: sign(x) for
 * sign(5 x + |x|), so that max(x, 2 x, -x) has one kink. */
static qdot_expr
simplify_nested_sign(qdot_pool *pool, qdot_expr e, void *user)
{
    rewriting *w = user;
    qdot_expr u = qdot_expr_arg(pool, e, 0), by = e;
    qdot_walk walk;

    if (w->status != QDOT_OK || !qdot_expr_is_function(pool, e, QDOT_SIGN) || !contains_coordinate(w->r, u))
        return e;
    w->status = qdot_walk_begin(pool, u, &walk);
    for (size_t i = 0; w->status == QDOT_OK && i < walk.n && by == e; i++) {
        qdot_expr v;
        int above, below;

        if (!qdot_expr_is_function(pool, walk.at[i], QDOT_ABS) && !qdot_expr_is_function(pool, walk.at[i], QDOT_SIGN))
            continue;
        v = qdot_expr_arg(pool, walk.at[i], 0);
        above = sign_beside(pool, u, v, true, &w->r->facts);
        below = above == 0 ? 0 : -sign_beside(pool, u, v, false, &w->r->facts);
        if (above != 0 && below != 0)
            by = above == below ? qdot_expr_int(pool, above)
                                : qdot_mul(pool, qdot_expr_int(pool, above), qdot_fun1(pool, QDOT_SIGN, v));
    }
    qdot_walk_end(&walk);
    return by;
}

/* Replace |u|^k in a product, for odd k < 0, by sign(u) u^k. */
static qdot_expr
rewrite_odd_powers_by_sign(qdot_pool *pool, qdot_expr e, void *user)
{
    uint32_t n = qdot_expr_count(pool, e);
    qdot_expr product = e;

    (void)user;
    for (uint32_t i = 1; i + 1 < n; i += 2) {
        qdot_expr size = qdot_expr_arg(pool, e, i), u;
        int64_t k;

        if (!qdot_is_inverse_magnitude(pool, e, i, &k))
            continue;
        u = qdot_expr_arg(pool, size, 0);
        product = qdot_mul(pool, product, qdot_pow_int(pool, size, -k));
        product = qdot_mul(pool, product, qdot_pow_int(pool, u, k));
        product = qdot_mul(pool, product, qdot_fun1(pool, QDOT_SIGN, u));
    }
    return product;
}

/* Replace sign(u)^k in a product by sign(u) for odd k, and by 1 for even k. */
static qdot_expr
simplify_powers_of_sign(qdot_pool *pool, qdot_expr e, void *user)
{
    qdot_expr product = e;

    (void)user;
    for (uint32_t i = 1; i + 1 < qdot_expr_count(pool, e); i += 2) {
        qdot_expr sign = qdot_expr_arg(pool, e, i);
        int64_t k;

        if (qdot_expr_is_function(pool, sign, QDOT_SIGN) &&
            qdot_expr_to_int(pool, qdot_expr_arg(pool, e, i + 1), &k) && k > 1)
            product = qdot_mul(pool, product, qdot_pow_int(pool, sign, k % 2 - k));
    }
    return product;
}

/* Write if(u > 0, A, B) by the sign of u, if u contains velocities and is 0 at rest. */
static qdot_expr
rewrite_slip_condition_by_sign(qdot_pool *pool, qdot_expr e, void *user)
{
    const qdot_rest *r = user;
    qdot_expr u = qdot_expr_is_function(pool, e, QDOT_IF) ? condition_difference(pool, qdot_expr_arg(pool, e, 0))
                                                          : QDOT_NIL,
              yes, no;

    if (u == QDOT_NIL || (qdot_mech_holds(r->s, u) & QDOT_HAS_VELOCITY) == 0 ||
        qdot_rest_value(r->s, qdot_list(pool, 0, NULL), u) != QDOT_ZERO)
        return e;
    yes = qdot_expr_arg(pool, e, 1);
    no = qdot_expr_arg(pool, e, 2);
    return divide_by_two(pool, qdot_add(pool, qdot_mul(pool, qdot_fun1(pool, QDOT_SIGN, u), qdot_sub(pool, yes, no)),
                                        qdot_add(pool, yes, no)));
}

qdot_expr
qdot_rest_slips_by_signs(qdot_rest *r, qdot_expr force)
{
    qdot_pool *pool = r->pool;
    qdot_expr by = qdot_walk_replace(pool, force, QDOT_FUN, rewrite_slip_condition_by_sign, r);

    if (by != QDOT_NIL)
        qdot_directions_as_signs(pool, 1, &by);
    if (by != QDOT_NIL && by != force)
        by = qdot_expand(pool, by);
    return by == QDOT_NIL ? by : qdot_walk_replace(pool, by, QDOT_PROD, simplify_powers_of_sign, NULL);
}

qdot_status
qdot_rest_by_signs(qdot_rest *r, qdot_expr list, qdot_expr *out)
{
    qdot_pool *pool = r->pool;
    rewriting w = {r, QDOT_OK};
    uint32_t n = qdot_expr_count(pool, list);
    qdot_expr all = QDOT_NIL, by, nested;

    *out = list;
    by = qdot_walk_replace(pool, list, QDOT_PROD, rewrite_odd_powers_by_sign, NULL);
    if (by != QDOT_NIL)
        by = qdot_walk_replace(pool, by, QDOT_FUN, rewrite_function_by_signs, &w);
    nested = by;
    if (by != QDOT_NIL)
        by = qdot_walk_replace(pool, by, QDOT_FUN, simplify_nested_sign, &w);
    if (by != QDOT_NIL && by != nested)
        by = qdot_walk_replace(pool, qdot_expand(pool, by), QDOT_PROD, simplify_powers_of_sign, NULL);
    QDOT_TRY(w.status);
    QDOT_TRY(qdot_pool_check(pool));
    if (by == list)
        return QDOT_OK;
    for (uint32_t i = 0; i < n; i++) {
        qdot_expr one = qdot_simplify(pool, qdot_expr_arg(pool, by, i), &r->facts);

        all = qdot_list_appended(pool, all, 1, &one);
    }
    *out = all;
    return qdot_pool_check(pool);
}

/* --- tips: places where a root of the forces vanishes ----------------------------------------- */

/* Whether a constraint prevents b from becoming 0. */
static bool
is_kept_from_zero(const qdot_rest *r, qdot_expr b)
{
    const qdot_expr zero = QDOT_ZERO;

    for (size_t k = 0; k < r->s->constraints.n; k++) {
        qdot_expr f = r->s->constraints.at[k].f,
                  there = qdot_subs(r->pool, f, 1, &b, &zero);

        if (there != QDOT_NIL && there != f && !contains_coordinate(r, there) &&
            !qdot_is_zero(r->pool, there, &r->facts))
            return true;
    }
    return false;
}

/* Whether b may have the minimum 0: it is not proved non-zero, and no sample is negative. */
static qdot_status
may_touch_zero(const qdot_rest *r, qdot_expr b, bool *yes)
{
    *yes = (qdot_expr_node(r->pool, b)->sign & QDOT_NE0) == 0 &&
           qdot_condition(r->pool, b, true, &r->facts) != QDOT_TRUE;
    for (uint64_t seed = 1; *yes && seed <= SAMPLES; seed++) {
        double value;

        QDOT_TRY(qdot_generic_evaluate(
            r->pool, 1, &b, &(qdot_generic_point){0, NULL, NULL, seed}, &value));
        *yes = !(value < 0);
    }
    return QDOT_OK;
}

/* Whether forces that contain powers of b = s^2 are proved to point away from b = 0, or to diverge there. */
static bool
forces_point_away(const qdot_rest *r, qdot_expr b)
{
    qdot_pool *pool = r->pool;
    qdot_expr s = qdot_symbol_get(pool, QDOT_FORMAL, "(root)"), square, sum = QDOT_ZERO;
    const qdot_expr zero = QDOT_ZERO;

    qdot_symbol_domain(pool, s, QDOT_ZERO, true, QDOT_NIL, false);
    square = qdot_pow_int(pool, s, 2);
    for (size_t i = 0; i < r->s->coordinates.n; i++) {
        qdot_expr slope = qdot_diff(pool, b, r->s->coordinates.at[i]),
                  force = qdot_expr_arg(pool, r->forces, (uint32_t)i);

        sum = qdot_add(pool, sum,
                       qdot_mul(pool, slope, qdot_subs(pool, force, 1, &b, &square)));
    }
    sum = qdot_expand(pool, qdot_mul(pool, s, sum));
    if (sum == QDOT_NIL)
        return false;
    sum = qdot_subs(pool, sum, 1, &s, &zero);
    if (sum == QDOT_NIL)
        return qdot_pool_check(pool) == QDOT_EDOMAIN;
    return qdot_condition(pool, sum, false, &r->facts) == QDOT_TRUE;
}

qdot_status
qdot_rest_tips(qdot_rest *r)
{
    qdot_pool *pool = r->pool;
    qdot_status status = QDOT_OK;
    qdot_walk w;

    QDOT_TRY(qdot_walk_begin(pool, r->forces, &w));
    for (size_t i = 0; i < w.n && !r->unresolved && status == QDOT_OK; i++) {
        uint32_t n = qdot_expr_kind(pool, w.at[i]) == QDOT_PROD
                         ? qdot_expr_count(pool, w.at[i])
                         : 0;

        for (uint32_t k = 1; k + 1 < n && !r->unresolved && status == QDOT_OK; k += 2) {
            qdot_expr b = qdot_expr_arg(pool, w.at[i], k);
            const fmpq *p = qdot_expr_rational(pool, qdot_expr_arg(pool, w.at[i], k + 1));
            bool touches;

            if (p == NULL || fmpz_is_one(fmpq_denref(p)) || fmpq_sgn(p) > 0 ||
                fmpq_cmp_si(p, -1) < 0 || !contains_coordinate(r, b))
                continue;
            status = may_touch_zero(r, b, &touches);
            if (status == QDOT_OK && touches && !is_kept_from_zero(r, b))
                r->unresolved = !(fmpz_equal_si(fmpq_denref(p), 2) && forces_point_away(r, b));
            if (status == QDOT_OK)
                status = qdot_pool_check(pool);
        }
    }
    qdot_walk_end(&w);
    return status;
}

/* --- energies that jump ----------------------------------------------------------------------- */

/* The function `node` steps from `below` to `above` where u = 0. *yes: the energy has no step there, because the change
 * that `node` makes in it vanishes at u = 0. */
static qdot_status
energy_is_continuous_at_step(const qdot_rest *r, qdot_expr node, qdot_expr below, qdot_expr above, qdot_expr u, bool *yes)
{
    qdot_pool *pool = r->pool;
    qdot_expr step = qdot_sub(pool, qdot_subs(pool, r->energy, 1, &node, &above),
                              qdot_subs(pool, r->energy, 1, &node, &below));

    step = qdot_simplify(pool, step, &r->facts);
    QDOT_TRY(qdot_pool_check(pool));
    return vanishes_with(r, step, u, yes);
}

/* Append to the list the difference u of each relation in a condition, which changes only where some u is 0. */
static qdot_expr
append_condition_differences(qdot_pool *pool, qdot_expr condition, qdot_expr list)
{
    if (qdot_expr_kind(pool, condition) == QDOT_REL) {
        qdot_expr gap = qdot_sub(pool, qdot_expr_arg(pool, condition, 1), qdot_expr_arg(pool, condition, 0));

        return qdot_list_appended(pool, list, 1, &gap);
    }
    for (uint32_t i = 0; i < qdot_expr_count(pool, condition); i++)
        list = append_condition_differences(pool, qdot_expr_arg(pool, condition, i), list);
    return list;
}

/* Whether the energy is continuous although the function `node` jumps; if not, append to *zeros
 * what vanishes at the jump. */
static qdot_status
is_continuous_despite_jump(const qdot_rest *r, qdot_expr node, qdot_expr *zeros, bool *yes)
{
    qdot_pool *pool = r->pool;
    const qdot_expr a = qdot_expr_arg(pool, node, 0), m = qdot_symbol_get(pool, QDOT_FORMAL, "(step)");
    qdot_expr at = a, b;
    bool smooth = true;

    *yes = false;
    switch (qdot_expr_node(pool, node)->op) {
    case QDOT_SIGN:
        QDOT_TRY(energy_is_continuous_at_step(r, node, QDOT_MINUS_ONE, QDOT_ONE, a, &smooth));
        break;
    case QDOT_FLOOR: /* floor(a) jumps from m - 1 to m where a = m */
        at = qdot_fun1(pool, QDOT_SIN, qdot_mul(pool, QDOT_PI, a));
        QDOT_TRY(energy_is_continuous_at_step(r, node, qdot_sub(pool, m, QDOT_ONE), m, qdot_sub(pool, a, m), &smooth));
        break;
    case QDOT_MOD: /* a mod b jumps from b to 0 where a = m b */
        b = qdot_expr_arg(pool, node, 1);
        at = qdot_fun1(pool, QDOT_SIN, qdot_mul(pool, QDOT_PI, qdot_div(pool, a, b)));
        QDOT_TRY(energy_is_continuous_at_step(r, node, b, QDOT_ZERO, qdot_sub(pool, a, qdot_mul(pool, m, b)), &smooth));
        break;
    case QDOT_IF:
        b = append_condition_differences(pool, a, qdot_list(pool, 0, NULL));
        QDOT_TRY(qdot_pool_check(pool));
        for (uint32_t i = 0; i < qdot_expr_count(pool, b) && smooth; i++)
            QDOT_TRY(energy_is_continuous_at_step(r, node, qdot_expr_arg(pool, node, 2), qdot_expr_arg(pool, node, 1),
                                                  qdot_expr_arg(pool, b, i), &smooth));
        if (!smooth)
            *zeros = append_condition_differences(pool, a, *zeros);
        *yes = !smooth;
        return qdot_pool_check(pool);
    default:
        return QDOT_OK;
    }
    if (!smooth)
        *zeros = qdot_list_appended(pool, *zeros, 1, &at);
    *yes = !smooth;
    return qdot_pool_check(pool);
}

/* Whether u != 0 is proved. */
static bool
is_proved_nonzero(const qdot_rest *r, qdot_expr u, const qdot_facts *facts)
{
    return qdot_condition(r->pool, u, true, facts) == QDOT_TRUE ||
           qdot_condition(r->pool, qdot_neg(r->pool, u), true, facts) == QDOT_TRUE;
}

/* Find whether one of the `zeros` vanishes at the equilibrium e: *yes: certainly; *may: not decided. */
static qdot_status
lies_on_zeros(qdot_rest *r, const qdot_equilibrium *e, qdot_expr zeros, bool *yes, bool *may)
{
    qdot_pool *pool = r->pool;

    *yes = *may = false;
    for (uint32_t i = 0; i < qdot_expr_count(pool, zeros) && !*yes; i++) {
        qdot_expr u = qdot_rest_value(r->s, e->equations, qdot_expr_arg(pool, zeros, i)), room[QDOT_CONDITIONS_MOST];
        const qdot_facts facts = qdot_facts_and(pool, &r->facts, e->exists, room);
        qdot_decision d;

        if (u == QDOT_NIL && qdot_pool_check(pool) == QDOT_EDOMAIN) {
            *may = true;
            continue;
        }
        QDOT_TRY(qdot_pool_check(pool));
        if (e->numeric) {
            double value;

            QDOT_TRY(qdot_generic_evaluate(pool, 1, &u, &(qdot_generic_point){0, NULL, NULL, 1}, &value));
            *may = *may || !(fabs(value) > 1e-9);
            continue;
        }
        QDOT_TRY(qdot_decide_equal(pool, u, QDOT_ZERO, &facts, &d));
        *yes = d.verdict == QDOT_PROVED;
        *may = *may || (d.verdict != QDOT_PROVED && !is_proved_nonzero(r, u, &facts));
    }
    return qdot_pool_check(pool);
}

qdot_status
qdot_rest_leave_out_jumps(qdot_rest *r, qdot_expr *jump)
{
    qdot_expr zeros = qdot_list(r->pool, 0, NULL);
    qdot_status status = QDOT_OK;
    size_t kept = 0;
    qdot_walk w;

    *jump = QDOT_NIL;
    QDOT_TRY(qdot_walk_begin(r->pool, r->energy, &w));
    for (size_t i = 0; i < w.n && status == QDOT_OK; i++) {
        bool yes = false;

        if (qdot_expr_kind(r->pool, w.at[i]) == QDOT_FUN && contains_coordinate(r, w.at[i]))
            status = is_continuous_despite_jump(r, w.at[i], &zeros, &yes);
        if (yes && *jump == QDOT_NIL)
            *jump = w.at[i];
    }
    qdot_walk_end(&w);
    QDOT_TRY(status);
    if (*jump == QDOT_NIL)
        return QDOT_OK;
    r->unresolved = true;
    for (size_t i = 0; i < r->found.n; i++) {
        bool on;

        QDOT_TRY(lies_on_zeros(r, &r->found.at[i], zeros, &on, &r->found.at[i].may_jump));
        if (!on)
            r->found.at[kept++] = r->found.at[i];
    }
    r->found.n = kept;
    return QDOT_OK;
}
