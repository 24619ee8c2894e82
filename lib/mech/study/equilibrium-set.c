/* equilibrium-set.c -- members of the set of equilibria as functions of one parameter, and the walls between
 * cells. */
#include "mech/study/equilibrium-set.h"

#include <math.h>

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/elementary.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "mech/dynamics/generic.h"
#include "normal/simplify/positive.h"
#include "normal/solve/conditions.h"
#include "normal/solve/solve.h"
#include "normal/solve/zeros.h"
#include "num/sort.h"

enum { BUDGET = 20000, MOST_WALLS = 200 };

static bool
contains_only_parameter(const qdot_equilibrium_curve *c, qdot_expr e)
{
    const qdot_expr atoms = qdot_expr_atoms(c->pool, e, true);

    for (uint32_t i = 0; atoms != QDOT_NIL && i < qdot_expr_count(c->pool, atoms); i++) {
        const qdot_expr one = qdot_expr_arg(c->pool, atoms, i);

        if (one != c->parameter && !qdot_expr_is_class(c->pool, one, QDOT_CONST))
            return false;
    }
    return atoms != QDOT_NIL;
}

/* --- members of the set ---------------------------------------------------------------------- */

/* What relations a < b say is positive, with values put in, added to *list; *known: all of them are inequalities
 * of p. */
static qdot_status
append_relation_differences(const qdot_equilibrium_curve *c, qdot_expr relations, qdot_expr *list, bool *known)
{
    qdot_pool *pool = c->pool;

    for (uint32_t i = 0; relations != QDOT_NIL && i < qdot_expr_count(pool, relations); i++) {
        const qdot_expr one = qdot_expr_arg(pool, relations, i);
        qdot_expr gap;

        *known = *known && qdot_expr_kind(pool, one) == QDOT_REL &&
                 (qdot_expr_node(pool, one)->op == QDOT_LT || qdot_expr_node(pool, one)->op == QDOT_LE);
        if (!*known)
            return QDOT_OK;
        gap = c->bind(c->user, qdot_positive_of(pool, one));
        *known = gap != QDOT_NIL && contains_only_parameter(c, gap);
        if (*known)
            *list = qdot_list_appended(pool, *list, 1, &gap);
        else if (qdot_pool_check(pool) != QDOT_EDOMAIN)
            return qdot_pool_check(pool);
    }
    return qdot_pool_check(pool);
}

/* The value of unknown i at an equilibrium, with parameter values; nil if p does not determine it. */
static qdot_expr
value_at_equilibrium(const qdot_equilibrium_curve *c, const qdot_equilibrium *e, size_t i)
{
    for (uint32_t k = 0; k < qdot_expr_count(c->pool, e->equations); k++) {
        const qdot_expr one = qdot_expr_arg(c->pool, e->equations, k);

        if (qdot_expr_arg(c->pool, one, 0) == c->unknown[i]) {
            const qdot_expr value = c->bind(c->user, qdot_expr_arg(c->pool, one, 1));

            return value == QDOT_NIL || !contains_only_parameter(c, value) ? QDOT_NIL : value;
        }
    }
    return QDOT_NIL;
}

/* Add an equilibrium; for a family with integers n, one member. */
static qdot_status
add_set_member(qdot_equilibrium_set *set, qdot_rest *rest, const qdot_equilibrium *e)
{
    const qdot_equilibrium_curve *c = set->c;
    qdot_equilibrium_member one = {.place = *e, .value = qdot_list(c->pool, 0, NULL)};
    bool known = e->range == QDOT_NIL;

    if (known && qdot_solve_integers(c->pool, e->equations) > 0) {
        one.place.equations = qdot_solve_one_member(c->pool, e->equations);
        one.place.exists = e->exists == QDOT_NIL ? QDOT_NIL : qdot_solve_one_member(c->pool, e->exists);
        QDOT_TRY(qdot_pool_check(c->pool));
        set->families = true;
        set->complete = false;
        e = &one.place;
    }
    for (size_t i = 0; i < c->n && known; i++) {
        const qdot_expr value = value_at_equilibrium(c, e, i);

        known = value != QDOT_NIL;
        if (known)
            one.value = qdot_list_appended(c->pool, one.value, 1, &value);
        else if (qdot_pool_check(c->pool) != QDOT_OK && qdot_pool_check(c->pool) != QDOT_EDOMAIN)
            return qdot_pool_check(c->pool);
    }
    if (known)
        QDOT_TRY(append_relation_differences(c, e->exists, &one.value, &known));
    set->complete = set->complete && known;
    if (!known)
        return QDOT_OK;
    QDOT_TRY(qdot_pool_check(c->pool));
    QDOT_TRY(qdot_rest_is_corner(rest, e->equations, &one.corner));
    return qdot_vec_push(&set->member, one);
}

/* --- walls: parameter values at which the set of equilibria may change ------------------------ */

/* Add the zeros of g(p) to the values of p at which the set of equilibria may change ("walls"). */
static qdot_status
add_walls(qdot_equilibrium_set *set, qdot_expr g)
{
    const qdot_equilibrium_curve *c = set->c;
    const qdot_zeros_range range = {.lo = qdot_expr_of_double(c->pool, set->least),
                                    .hi = qdot_expr_of_double(c->pool, set->most)};
    qdot_zeros zeros;
    qdot_status status;

    QDOT_TRY(qdot_pool_check(c->pool));
    if (!qdot_expr_contains(c->pool, g, c->parameter))
        return QDOT_OK;
    status = qdot_zeros_find(c->pool, 1, &g, &c->parameter, &range, BUDGET, &zeros);
    if (status == QDOT_ETYPE || status == QDOT_EDOMAIN) {
        set->complete = false;
        return QDOT_OK;
    }
    QDOT_TRY(status);
    set->complete = set->complete && zeros.complete && set->wall.n + zeros.count <= MOST_WALLS;
    for (size_t i = 0; i < zeros.count && set->wall.n < MOST_WALLS && status == QDOT_OK; i++)
        status = qdot_vec_push(&set->wall, zeros.at[i]);
    for (size_t i = 0; i < zeros.doubts && set->wall.n < MOST_WALLS && status == QDOT_OK; i++)
        status = qdot_vec_push(&set->wall, zeros.doubt[i]);
    qdot_zeros_clear(&zeros);
    return status;
}

/* Add as walls (special values of p) the values at which one of the relations ceases to hold. */
static qdot_status
add_walls_of_relations(qdot_equilibrium_set *set, qdot_expr relations)
{
    qdot_pool *pool = set->c->pool;

    QDOT_TRY(qdot_pool_check(pool));
    for (uint32_t i = 0; relations != QDOT_NIL && relations != QDOT_FALSE && i < qdot_expr_count(pool, relations); i++) {
        const qdot_expr one = qdot_expr_arg(pool, relations, i), u = qdot_conditions_nonzero(pool, one);

        QDOT_TRY(add_walls(set, u != QDOT_NIL ? u : qdot_positive_of(pool, one)));
    }
    return QDOT_OK;
}

/* Add as walls (special values of the parameter p) the values at which u is an integer. */
static qdot_status
add_walls_at_integers(qdot_equilibrium_set *set, qdot_expr u)
{
    qdot_pool *pool = set->c->pool;

    return add_walls(set, qdot_fun1(pool, QDOT_SIN, qdot_mul(pool, QDOT_PI, u)));
}

/* Add the values of p at which a function or relation jumps or has a kink; poles and the ends of domains are not among
 * them. */
static qdot_status
add_walls_of_jump(qdot_equilibrium_set *set, qdot_expr node)
{
    qdot_pool *pool = set->c->pool;
    const uint32_t count = qdot_expr_count(pool, node);
    const qdot_expr first = count > 0 ? qdot_expr_arg(pool, node, 0) : QDOT_NIL,
                    second = count > 1 ? qdot_expr_arg(pool, node, 1) : QDOT_NIL;

    if (qdot_expr_kind(pool, node) == QDOT_REL)
        return add_walls(set, qdot_sub(pool, first, second));
    if (qdot_expr_kind(pool, node) != QDOT_FUN)
        return QDOT_OK;
    switch (qdot_expr_node(pool, node)->op) {
    case QDOT_ABS:
    case QDOT_SIGN:
    case QDOT_ATAN2: /* atan2(y, x) jumps where y = 0 and x <= 0 */
        return add_walls(set, first);
    case QDOT_MIN:
    case QDOT_MAX:
        for (uint32_t i = 1; i < count; i++)
            for (uint32_t k = 0; k < i; k++)
                QDOT_TRY(add_walls(set, qdot_sub(pool, qdot_expr_arg(pool, node, i), qdot_expr_arg(pool, node, k))));
        return QDOT_OK;
    case QDOT_FLOOR:
        return add_walls_at_integers(set, first);
    case QDOT_MOD:
        QDOT_TRY(add_walls(set, second));
        return add_walls_at_integers(set, qdot_div(pool, first, second));
    default:
        return QDOT_OK;
    }
}

static qdot_status
add_walls_of_jumps(qdot_equilibrium_set *set, qdot_expr value)
{
    qdot_status status = QDOT_OK;
    qdot_walk w;

    QDOT_TRY(qdot_walk_begin(set->c->pool, value, &w));
    for (size_t i = 0; i < w.n && status == QDOT_OK; i++)
        if (qdot_expr_contains(set->c->pool, w.at[i], set->c->parameter))
            status = add_walls_of_jump(set, w.at[i]);
    qdot_walk_end(&w);
    return status;
}

/* Walls of a LIST of formulas: where one may jump, has a pole, or ends, and the zeros of those behind the first `n`.
 * *known: these are all. */
static qdot_status
add_walls_of_list(qdot_equilibrium_set *set, qdot_expr list, size_t n, bool *known)
{
    qdot_pool *pool = set->c->pool;
    const bool complete = set->complete;

    set->complete = true;
    QDOT_TRY(add_walls_of_jumps(set, list));
    for (uint32_t i = (uint32_t)n; i < qdot_expr_count(pool, list); i++)
        QDOT_TRY(add_walls(set, qdot_expr_arg(pool, list, i)));
    QDOT_TRY(add_walls_of_relations(set, qdot_conditions_of_domain(pool, list, QDOT_NIL)));
    QDOT_TRY(add_walls_of_relations(set, qdot_conditions_of_divisors(pool, list, QDOT_NIL)));
    *known = set->complete;
    set->complete = complete;
    return QDOT_OK;
}

static qdot_status
add_walls_of_member(qdot_equilibrium_set *set, qdot_equilibrium_member *one)
{
    QDOT_TRY(add_walls_of_list(set, one->value, set->c->n, &one->known));
    set->complete = set->complete && one->known;
    return QDOT_OK;
}

void
qdot_equilibrium_set_sort_walls(qdot_equilibrium_set *set)
{
    size_t kept = 1;

    qdot_sort(set->wall.n, set->wall.at);
    for (size_t i = 1; i < set->wall.n; i++)
        if (set->wall.at[i] > set->wall.at[kept - 1])
            set->wall.at[kept++] = set->wall.at[i];
    set->wall.n = kept;
}

/* --- the whole set ---------------------------------------------------------------------------- */

/* Insert the values of all parameters except p; these may be special values. */
static qdot_status
insert_other_parameters(qdot_equilibrium_curve *c, qdot_rest *rest)
{
    rest->system.equations = c->bind(c->user, rest->system.equations);
    rest->forces = c->bind(c->user, rest->forces);
    rest->energy = rest->system.defined = c->bind(c->user, rest->energy);
    QDOT_TRY(qdot_pool_check(c->pool));
    return qdot_rest_domain(rest);
}

/* Add as walls the single values of p at which the energy or a force is undefined. */
static qdot_status
add_walls_of_undefined(qdot_equilibrium_set *set, const qdot_rest *rest)
{
    qdot_pool *pool = set->c->pool;
    qdot_expr all, unused = QDOT_NIL;

    QDOT_TRY(qdot_rest_undefined(rest, &all, &unused));
    for (uint32_t i = 0; all != QDOT_NIL && i < qdot_expr_count(pool, all); i++) {
        const qdot_expr one = qdot_expr_arg(pool, all, i);
        const size_t walls = set->wall.n;

        QDOT_TRY(add_walls(set, one));
        for (size_t k = walls; k < set->wall.n; k++)
            QDOT_TRY(qdot_vec_push(&set->gap, ((qdot_equilibrium_gap){one, set->wall.at[k]})));
    }
    return qdot_pool_check(pool);
}

/* Find the equilibria with p as a free parameter, into rest->found. */
static qdot_status
find_members(qdot_equilibrium_set *set, qdot_equilibrium_curve *c, qdot_rest *rest)
{
    qdot_equilibria unused = {0};
    qdot_status status = qdot_rest_find(rest, c->bind, c->user, &unused);

    if (status == QDOT_EUNSET || status == QDOT_EFAILED || status == QDOT_ELIMIT) {
        rest->found.n = 0;
        rest->system.complete = false;
        status = QDOT_OK;
    }
    set->complete = rest->system.complete;
    c->judge->forces = rest->forces;
    if (status == QDOT_OK)
        status = qdot_rest_by_signs(rest, rest->forces, &c->judge->by_signs);
    for (size_t i = 0; i < rest->found.n && status == QDOT_OK; i++)
        status = add_set_member(set, rest, &rest->found.at[i]);
    if (status == QDOT_OK)
        status = add_walls_of_undefined(set, rest);
    for (size_t i = 0; i < set->member.n && status == QDOT_OK; i++)
        status = add_walls_of_member(set, &set->member.at[i]);
    return status;
}

qdot_status
qdot_equilibrium_set_begin(qdot_equilibrium_set *set, qdot_equilibrium_curve *c, double least, double most)
{
    qdot_rest rest;
    qdot_status status;

    *set = (qdot_equilibrium_set){.c = c, .least = least, .most = most};
    QDOT_TRY(qdot_vec_push(&set->wall, least));
    QDOT_TRY(qdot_vec_push(&set->wall, most));
    status = qdot_rest_begin(&rest, c->s);
    if (status == QDOT_OK)
        status = insert_other_parameters(c, &rest);
    if (status == QDOT_OK)
        status = find_members(set, c, &rest);
    qdot_equilibrium_set_sort_walls(set);
    if (status == QDOT_OK && !set->complete)
        status = qdot_equilibrium_set_add_folds(set);
    qdot_rest_end(&rest);
    return status;
}

void
qdot_equilibrium_set_end(qdot_equilibrium_set *set)
{
    qdot_free(set->member.at);
    qdot_free(set->wall.at);
    qdot_free(set->gap.at);
    *set = (qdot_equilibrium_set){0};
}

/* Evaluate the members of a LIST at p. */
static qdot_status
evaluate_list(const qdot_equilibrium_curve *c, qdot_expr list, double p, double *value)
{
    return qdot_generic_evaluate(c->pool, qdot_expr_count(c->pool, list), qdot_expr_args(c->pool, list),
                                 &(qdot_generic_point){1, &c->parameter, &p, 1}, value);
}

qdot_status
qdot_equilibrium_set_place(const qdot_equilibrium_set *set, size_t k, double *y, bool *exists)
{
    const size_t n = set->c->n;
    const qdot_expr list = set->member.at[k].value;
    const uint32_t count = qdot_expr_count(set->c->pool, list);
    double *value = qdot_calloc(count + 1, sizeof *value);
    qdot_status status = value ? evaluate_list(set->c, list, y[n], value) : QDOT_ENOMEM;

    *exists = status == QDOT_OK;
    for (size_t i = 0; i < n && status == QDOT_OK; i++) {
        y[i] = value[i];
        *exists = *exists && isfinite(value[i]);
    }
    for (uint32_t i = (uint32_t)n; i < count && *exists; i++)
        *exists = value[i] > 0;
    qdot_free(value);
    return status;
}

static qdot_status
judge_member(qdot_equilibrium_set *set, qdot_equilibrium_member *one)
{
    const qdot_equilibrium_curve *c = set->c;
    bool known = true;

    one->judged = true;
    one->when = qdot_list(c->pool, 0, NULL);
    if (!one->place.may_jump)
        QDOT_TRY(qdot_judge_place(c->judge, &one->place));
    else
        one->place.stability = QDOT_STABILITY_UNDECIDED;
    QDOT_TRY(append_relation_differences(c, one->place.stable_when, &one->when, &known));
    if (!known)
        one->place.stability = QDOT_STABILITY_UNDECIDED;
    return QDOT_OK;
}

qdot_status
qdot_equilibrium_set_add_verdicts(qdot_equilibrium_set *set, size_t k)
{
    qdot_equilibrium_member *one = &set->member.at[k];
    bool known;

    if (!one->judged)
        QDOT_TRY(judge_member(set, one));
    QDOT_TRY(add_walls_of_list(set, one->when, 0, &known));
    if (!known)
        one->place.stability = QDOT_STABILITY_UNDECIDED;
    qdot_equilibrium_set_sort_walls(set);
    return QDOT_OK;
}

qdot_status
qdot_equilibrium_set_judge(qdot_equilibrium_set *set, size_t k, double p, qdot_stability *verdict)
{
    qdot_equilibrium_member *one = &set->member.at[k];
    double *value;
    qdot_status status;

    if (!one->judged)
        QDOT_TRY(judge_member(set, one));
    value = qdot_calloc(qdot_expr_count(set->c->pool, one->when) + 1, sizeof *value);
    status = value ? evaluate_list(set->c, one->when, p, value) : QDOT_ENOMEM;
    *verdict = one->place.stability;
    for (uint32_t i = 0; i < qdot_expr_count(set->c->pool, one->when) && status == QDOT_OK; i++)
        if (!(value[i] > 0))
            *verdict = QDOT_STABILITY_UNDECIDED;
    qdot_free(value);
    return status;
}
