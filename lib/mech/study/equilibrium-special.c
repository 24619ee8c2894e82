/* equilibrium-special.c -- values of parameters at which the listed rests are not those of the scene.
 *
 * Parameters are generic: x = b/a is listed without a condition a != 0. Such a divisor, if its sign is not
 * declared and no condition of the place excludes its zero, is told with the list.
 *
 * 0 < theta < pi leaves out the poles of a sphere, where a rest may be: such an end of a chart is told too. */
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/elementary.h"
#include "expr/exact.h"
#include "expr/list.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "mech/coordinates/chart.h"
#include "mech/study/equilibrium-search.h"
#include "normal/simplify/positive.h"
#include "normal/solve/conditions.h"
#include "normal/solve/solve.h"

enum { MOST_SPECIAL = 8 };

qdot_status
qdot_rest_is_excluded(const qdot_rest *r, qdot_expr exists, qdot_expr d, bool *yes)
{
    qdot_pool *pool = r->pool;
    qdot_expr atoms = qdot_expr_atoms(pool, d, true), at;
    qdot_solutions zero = {.complete = true};
    qdot_status status = QDOT_OK;

    *yes = false;
    if (exists == QDOT_NIL || atoms == QDOT_NIL || qdot_expr_count(pool, atoms) == 0)
        return qdot_pool_check(pool);
    at = qdot_expr_arg(pool, atoms, 0);
    if (qdot_expr_kind(pool, at) == QDOT_SYM)
        status = qdot_solve(pool, d, at, &r->facts, &zero);
    if (status == QDOT_OK && zero.complete && zero.root.n == 1 && zero.root.at[0].period == QDOT_NIL) {
        qdot_expr there = qdot_conditions_at(pool, exists, 1, &at, &zero.root.at[0].value, &r->facts);

        *yes = there == QDOT_FALSE;
        status = qdot_pool_check(pool);
        if (status == QDOT_EDOMAIN) { /* the equations are undefined at this parameter value */
            *yes = true;
            status = QDOT_OK;
        }
    }
    qdot_solutions_clear(&zero);
    return status == QDOT_EDOMAIN ? QDOT_OK : status;
}

qdot_status
qdot_rest_add_factors(qdot_pool *pool, qdot_expr e, qdot_expr *list)
{
    qdot_expr factors = e == QDOT_NIL ? QDOT_NIL : qdot_solve_factors(pool, e);

    QDOT_TRY(qdot_pool_check(pool));
    for (uint32_t i = 0; i < qdot_expr_count(pool, factors); i++) {
        const qdot_expr one = qdot_expr_arg(pool, factors, i);
        const bool root = qdot_expr_kind(pool, one) == QDOT_PROD && qdot_expr_count(pool, one) == 3;

        if (root || qdot_expr_is_function(pool, one, QDOT_ABS) || qdot_expr_is_function(pool, one, QDOT_SIGN))
            QDOT_TRY(qdot_rest_add_factors(pool, qdot_expr_arg(pool, one, root ? 1 : 0), list));
        else if (!qdot_list_has(pool, *list, one) && (qdot_expr_node(pool, one)->sign & QDOT_NE0) == 0)
            *list = qdot_list_appended(pool, *list, 1, &one);
    }
    return qdot_pool_check(pool);
}

/* Append those divisors in the formulas of an equilibrium that may be 0 to the LIST *special. */
static qdot_status
add_divisors(const qdot_rest *r, const qdot_equilibrium *e, qdot_expr *special)
{
    qdot_pool *pool = r->pool;
    qdot_walk w;
    qdot_status status = QDOT_OK;

    QDOT_TRY(qdot_walk_begin(pool, e->equations, &w));
    for (size_t i = 0; i < w.n && status == QDOT_OK; i++) {
        uint32_t n = qdot_expr_kind(pool, w.at[i]) == QDOT_PROD ? qdot_expr_count(pool, w.at[i]) : 0;

        for (uint32_t k = 1; k + 1 < n && status == QDOT_OK; k += 2) {
            qdot_expr base = qdot_expr_arg(pool, w.at[i], k);
            const fmpq *exponent = qdot_expr_rational(pool, qdot_expr_arg(pool, w.at[i], k + 1));
            uint32_t had = *special == QDOT_NIL ? 0 : qdot_expr_count(pool, *special);
            bool out = exponent == NULL || fmpq_sgn(exponent) >= 0 || had == MOST_SPECIAL ||
                       qdot_list_has(pool, *special, base) ||
                       (qdot_expr_node(pool, base)->sign & QDOT_NE0) != 0 ||
                       !qdot_is_generic(pool, base) || qdot_expr_is_constant(pool, base);

            if (!out)
                status = qdot_rest_is_excluded(r, e->exists, base, &out);
            if (!out && status == QDOT_OK)
                *special = qdot_list_appended(pool, *special, 1, &base);
        }
    }
    qdot_walk_end(&w);
    return status;
}

qdot_status
qdot_rest_special(const qdot_rest *r, size_t n, const qdot_equilibrium *places, qdot_expr *special)
{
    *special = QDOT_NIL;
    for (size_t i = 0; i < n; i++)
        if (!places[i].numeric)
            QDOT_TRY(add_divisors(r, &places[i], special));
    return qdot_pool_check(r->pool);
}

/* --- no place at all ------------------------------------------------------------------------------ */

/* What of parameters is 0 where conditions hold that generic parameters do not fulfil, one alone as -a^2 >= 0, or two as
 * a >= 1 and a <= 1; nil: this is not known. */
static qdot_expr
special_parameter_equation(const qdot_rest *r, qdot_expr set)
{
    qdot_pool *pool = r->pool;
    const uint32_t n = set == QDOT_NIL ? 0 : qdot_expr_count(pool, set);
    qdot_expr zero = QDOT_NIL;

    for (uint32_t i = 0; i < n && zero == QDOT_NIL; i++) {
        const qdot_expr one = qdot_expr_arg(pool, set, i),
                        gap = qdot_expr_kind(pool, one) == QDOT_REL ? qdot_positive_of(pool, one) : QDOT_NIL;

        if (gap == QDOT_NIL || !qdot_is_generic(pool, gap))
            continue;
        zero = qdot_condition(pool, gap, false, &r->facts) == QDOT_FALSE ? gap : QDOT_NIL;
        for (uint32_t k = i + 1; k < n && zero == QDOT_NIL; k++) {
            const qdot_expr other = qdot_expr_arg(pool, set, k);

            if (qdot_expr_kind(pool, other) == QDOT_REL &&
                qdot_expand(pool, qdot_add(pool, gap, qdot_positive_of(pool, other))) == QDOT_ZERO)
                zero = gap;
        }
    }
    return zero;
}

/* Search once more, for single values of parameters too: of x^3/3 + a^2 x they have a rest at a = 0, of
 * x^2/2 + sqrt(a - 1) + sqrt(1 - a) an energy at a = 1. */
static qdot_status
add_special_values(qdot_rest *r, qdot_expr *special)
{
    qdot_rest exact;
    qdot_status status = qdot_rest_begin(&exact, r->s);

    exact.facts.exact = exact.system.facts.exact = true;
    if (status == QDOT_OK)
        status = qdot_rest_find_exactly(&exact);
    r->system.complete = r->system.complete && exact.system.complete && !exact.unresolved;
    for (size_t i = 0; i < exact.found.n && status == QDOT_OK; i++) {
        const qdot_expr zero = special_parameter_equation(r, exact.found.at[i].exists);

        status = qdot_pool_check(r->pool);
        if (zero == QDOT_NIL)
            r->system.complete = false;
        else if (status == QDOT_OK)
            status = qdot_rest_add_factors(r->pool, zero, special);
    }
    qdot_rest_end(&exact);
    return status;
}

qdot_status
qdot_rest_none(qdot_rest *r, qdot_expr *special)
{
    for (size_t i = 0; i < r->system.special.n; i++)
        QDOT_TRY(qdot_rest_add_factors(r->pool, r->system.special.at[i], special));
    return r->formulas ? add_special_values(r, special) : QDOT_OK; /* equilibria in numbers hold for the given values of parameters */
}

/* --- poles --------------------------------------------------------------------------------------- */

/* Whether the expression d is 0 at an open end of the domain of the coordinate q. */
static bool
is_zero_at_end(qdot_pool *pool, qdot_expr d, qdot_expr q)
{
    const qdot_symbol *x = qdot_expr_symbol(pool, q);
    const qdot_expr end[2] = {x->lo_open ? x->lo : QDOT_NIL, x->hi_open ? x->hi : QDOT_NIL};

    for (int k = 0; k < 2; k++)
        if (end[k] != QDOT_NIL && qdot_subs(pool, d, 1, &q, &end[k]) == QDOT_ZERO)
            return true;
    return false;
}

/* Whether the scene becomes regular if group g, or all groups, are replaced; if one is a square root, only g is tried. */
static qdot_status
scene_is_regular(qdot_scene *s, const qdot_chart_groups *all, size_t g, bool *regular)
{
    const qdot_chart_groups one = {.at = all->at + g, .n = 1, .capacity = 1};
    int ways = 2, *sign = qdot_calloc(all->n, sizeof *sign);
    qdot_status status = sign ? QDOT_OK : QDOT_ENOMEM;

    *regular = false;
    for (size_t i = 0; i < all->n && sign != NULL; i++) {
        sign[i] = 1;
        ways = all->at[i].kind == QDOT_CHART_ROOT ? 1 : ways;
    }
    for (int k = 0; k < ways && status == QDOT_OK && !*regular; k++) {
        qdot_chart chart = {0};

        status = qdot_chart_make(s, k ? all : &one, sign, false, &chart);
        *regular = status == QDOT_OK && chart.scene != NULL;
        qdot_chart_clear(&chart);
    }
    qdot_free(sign);
    return status;
}

static bool
has_open_end(const qdot_scene *s)
{
    for (size_t i = 0; i < s->coordinates.n; i++) {
        const qdot_symbol *x = qdot_expr_symbol(s->pool, s->coordinates.at[i]);

        if ((x->lo != QDOT_NIL && x->lo_open) || (x->hi != QDOT_NIL && x->hi_open))
            return true;
    }
    return false;
}

qdot_status
qdot_rest_pole(const qdot_rest *r, const char **pole)
{
    qdot_chart_groups groups = {0};
    qdot_status status;

    *pole = NULL;
    if (!has_open_end(r->s))
        return QDOT_OK;
    status = qdot_chart_find(r->s, false, &groups);
    for (size_t g = 0; g < groups.n && status == QDOT_OK && *pole == NULL; g++) {
        const qdot_chart_group *of = &groups.at[g];
        const qdot_expr d = of->kind == QDOT_CHART_ROOT ? QDOT_ONE : qdot_chart_distance(r->s, of);

        for (size_t i = 0; i < qdot_chart_size(of->kind) && *pole == NULL && d != QDOT_NIL && status == QDOT_OK; i++) {
            const qdot_expr q = r->s->coordinates.at[of->index[i]];
            bool regular = is_zero_at_end(r->pool, d, q);

            if (regular)
                status = scene_is_regular(r->s, &groups, g, &regular);
            if (regular && status == QDOT_OK)
                *pole = qdot_expr_symbol(r->pool, q)->name;
        }
        if (status != QDOT_OK)
            break;
        status = qdot_pool_check(r->pool);
    }
    qdot_free(groups.at);
    return status;
}
