/* equilibrium-branches.c -- equilibria on the branches that formulas leave unsolved: y = 0 of the restricted three-body
 * problem is one, on which x is found in numbers.
 *
 * A branch has values for some unknowns and equations for the others. With one unknown less a search by exclusion takes a
 * small part of the time, and what formulas gave beside it stays exact. Whatever is not clear beyond rounding - an end of
 * a domain, a condition, a special value of a parameter - gives the branches up: then all unknowns are searched. */
#include <math.h>

#include "expr/build.h"
#include "expr/list.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "mech/dynamics/generic.h"
#include "mech/study/equilibrium-search.h"
#include "normal/simplify/simplify.h"
#include "normal/solve/solve.h"

/* The largest number of branches; of operations in the equations of a branch that are worth reading. */
enum { MOST_BRANCHES = 16, LARGEST_PRINTED = 60 };

static const double rounding = 1e-9;

static qdot_expr
with_values(const qdot_rest *rest, qdot_expr e)
{
    return e == QDOT_NIL || rest->bind == NULL ? e : rest->bind(rest->user, e);
}

/* The value of e, with the values of parameters put in, at x [searched] (NULL: e is a constant); NaN if it has none. */
static double
value_at(const qdot_rest *rest, qdot_expr e, const double *x)
{
    double value = NAN;

    e = with_values(rest, e);
    if (e == QDOT_NIL || (x == NULL && (qdot_expr_node(rest->pool, e)->holds & ~(uint32_t)QDOT_HAS_FUN) != 0) ||
        qdot_generic_evaluate(rest->pool, 1, &e,
                              &(qdot_generic_point){x == NULL ? 0 : rest->searched, rest->system.unknowns.at, x, 1},
                              &value) != QDOT_OK)
        return NAN;
    return value;
}

typedef enum { NO, YES, UNCLEAR } answer;

/* Whether u > 0, or u >= 0. */
static answer
is_clearly_positive(double u)
{
    return u > rounding ? YES : u < -rounding ? NO : UNCLEAR;
}

/* Whether all relations of a LIST (nil: none) hold at x. */
static answer
conditions_hold(const qdot_rest *rest, qdot_expr list, const double *x)
{
    answer all = YES;

    for (uint32_t i = 0; list != QDOT_NIL && i < qdot_expr_count(rest->pool, list) && all == YES; i++) {
        const qdot_expr one = qdot_expr_arg(rest->pool, list, i);

        if (qdot_expr_kind(rest->pool, one) != QDOT_REL || qdot_expr_node(rest->pool, one)->op == QDOT_EQ)
            return UNCLEAR;
        all = is_clearly_positive(value_at(rest, qdot_expr_arg(rest->pool, one, 1), x) -
                          value_at(rest, qdot_expr_arg(rest->pool, one, 0), x));
    }
    return all;
}

/* Whether the value of the k-th unknown lies inside its declared domain. */
static answer
lies_in_domain(const qdot_rest *rest, size_t k, double value)
{
    answer inside = isfinite(value) ? YES : UNCLEAR;

    for (int which = 0; which < 2 && inside == YES; which++) {
        const qdot_expr end = qdot_rest_domain_end(rest, k, which);

        if (end != QDOT_NIL)
            inside = is_clearly_positive(which == 0 ? value - value_at(rest, end, NULL) : value_at(rest, end, NULL) - value);
    }
    return inside;
}

/* The equation of the unknown u in the LIST `known`, u = value: its value; nil: there is none. */
static qdot_expr
known_value(const qdot_pool *pool, qdot_expr known, qdot_expr u)
{
    for (uint32_t i = 0; i < qdot_expr_count(pool, known); i++)
        if (qdot_expr_arg(pool, qdot_expr_arg(pool, known, i), 0) == u)
            return qdot_expr_arg(pool, qdot_expr_arg(pool, known, i), 1);
    return QDOT_NIL;
}

/* A branch while it is searched: `rest` with the unknowns left alone; where these stand among all; the values of the others. */
typedef struct {
    qdot_rest rest;
    size_t *place; /* [searched] of the unknowns left */
    double *x;     /* [searched] values of all unknowns, those left at the place that is looked at */
    qdot_expr *equation;
    bool inside; /* the known values lie inside their domains */
} branch;

/* The members of a LIST that are not 0, with the values of parameters put in. */
static qdot_expr
equations_left(const qdot_rest *rest, qdot_expr equations)
{
    qdot_expr left = qdot_list(rest->pool, 0, NULL);

    for (uint32_t i = 0; left != QDOT_NIL && i < qdot_expr_count(rest->pool, equations); i++) {
        const qdot_expr one = with_values(rest, qdot_expr_arg(rest->pool, equations, i));

        if (one != QDOT_ZERO)
            left = one == QDOT_NIL ? QDOT_NIL : qdot_list_appended(rest->pool, left, 1, &one);
    }
    return left;
}

/* *clear: some unknowns have values on the branch, all others are left, and there are as many equations as these. */
static qdot_status
read_branch(const qdot_rest *rest, const qdot_simultaneous_branch *b, branch *out, bool *clear)
{
    const qdot_expr equations = equations_left(rest, b->equations);
    const size_t n = rest->searched;

    *out = (branch){.rest = *rest, .inside = true};
    out->rest.system.unknowns.at = qdot_calloc(n + 1, sizeof(qdot_expr));
    out->place = qdot_calloc(n + 1, sizeof *out->place);
    out->x = qdot_calloc(n + 1, sizeof *out->x);
    out->equation = qdot_calloc(n + 1, sizeof *out->equation);
    if (out->rest.system.unknowns.at == NULL || out->place == NULL || out->x == NULL || out->equation == NULL)
        return QDOT_ENOMEM;
    out->rest.system.places = out->rest.searched = 0;
    *clear = equations != QDOT_NIL && qdot_solve_integers(rest->pool, b->equations) == 0;
    for (size_t i = 0; i < n && *clear; i++) {
        const qdot_expr u = rest->system.unknowns.at[i], value = known_value(rest->pool, b->known, u);
        answer inside = YES;

        if (value == QDOT_NIL) {
            out->place[out->rest.searched] = i;
            out->rest.system.unknowns.at[out->rest.searched++] = u;
            out->rest.system.places += i < rest->system.places;
            *clear = qdot_expr_contains(rest->pool, equations, u);
            continue;
        }
        out->x[i] = value_at(rest, value, NULL);
        inside = lies_in_domain(rest, i, out->x[i]);
        out->inside = out->inside && inside == YES;
        *clear = inside != UNCLEAR;
    }
    out->rest.system.unknowns.n = out->rest.searched;
    *clear = *clear && out->rest.searched < n && qdot_expr_count(rest->pool, equations) == out->rest.searched;
    for (size_t i = 0; i < out->rest.searched && *clear; i++)
        out->equation[i] = qdot_expr_arg(rest->pool, equations, (uint32_t)i);
    return qdot_pool_check(rest->pool);
}

static void
end_branch(branch *b)
{
    qdot_free(b->rest.system.unknowns.at);
    qdot_free(b->place);
    qdot_free(b->x);
    qdot_free(b->equation);
}

/* Whether the place b->x is one: where all equations have a value and the conditions of the branch hold. */
static answer
is_rest(const qdot_rest *rest, qdot_expr conditions, const double *x)
{
    const qdot_expr all = rest->system.equations;
    answer holds = conditions_hold(rest, conditions, x);

    for (uint32_t i = 0; i < qdot_expr_count(rest->pool, all) && holds == YES; i++)
        holds = fabs(value_at(rest, qdot_expr_arg(rest->pool, all, i), x)) < 1e-6 ? YES : UNCLEAR;
    return holds;
}

/* Append the rests of a branch to *out; *clear: these are all of it. */
static qdot_status
search_branch(const qdot_rest *rest, const qdot_simultaneous_branch *b, branch *one, qdot_places *out, bool *clear)
{
    const size_t n = rest->searched, m = one->rest.searched;
    qdot_places found = {.at = qdot_calloc((QDOT_PLACES_MOST + 1) * m + 1, sizeof *found.at)};
    qdot_status status = found.at == NULL ? QDOT_ENOMEM : qdot_rest_exclude(&one->rest, one->equation, &found);

    *clear = status == QDOT_OK && found.complete;
    for (size_t k = 0; k < found.n && *clear; k++) {
        answer rests;

        for (size_t i = 0; i < m; i++)
            one->x[one->place[i]] = found.at[k * m + i];
        rests = is_rest(rest, b->conditions, one->x);
        *clear = rests != UNCLEAR && out->n < QDOT_PLACES_MOST;
        for (size_t i = 0; i < n && *clear && rests == YES; i++)
            out->at[out->n * n + i] = one->x[i];
        out->n += *clear && rests == YES;
    }
    qdot_places_clear(&found);
    return status;
}

/* Whether formulas left few branches, and no parameter has a value at which the solutions by formulas may be others. */
static bool
formulas_hold(const qdot_rest *rest)
{
    bool hold = rest->system.narrowed && rest->system.left.n <= MOST_BRANCHES;

    for (size_t i = 0; i < rest->system.special.n && hold; i++)
        hold = fabs(value_at(rest, rest->system.special.at[i], NULL)) > rounding;
    return hold;
}

qdot_status
qdot_rest_search_branches(const qdot_rest *rest, qdot_places *out)
{
    bool clear = formulas_hold(rest);
    qdot_status status = QDOT_OK;

    for (size_t k = 0; k < rest->system.left.n && clear && status == QDOT_OK; k++) {
        const qdot_simultaneous_branch *b = &rest->system.left.at[k];
        branch one;

        status = read_branch(rest, b, &one, &clear);
        if (status == QDOT_OK && clear && one.inside)
            status = search_branch(rest, b, &one, out, &clear);
        end_branch(&one);
    }
    out->complete = clear && status == QDOT_OK;
    if (!out->complete)
        out->n = 0;
    qdot_places_sort(out, rest->searched);
    return status;
}

qdot_status
qdot_rest_unsolved(const qdot_rest *rest, qdot_expr *list)
{
    qdot_pool *pool = rest->pool;

    *list = rest->system.narrowed && rest->system.left.n <= MOST_BRANCHES ? qdot_list(pool, 0, NULL) : QDOT_NIL;
    for (size_t k = 0; k < rest->system.left.n && *list != QDOT_NIL; k++) {
        const qdot_simultaneous_branch *b = &rest->system.left.at[k];
        const qdot_expr there = qdot_simultaneous_put(pool, rest->system.equations, b->known);
        qdot_expr one = b->known;

        for (uint32_t i = 0; there != QDOT_NIL && i < qdot_expr_count(pool, there); i++) {
            const qdot_expr gap = qdot_simplify(pool, qdot_expr_arg(pool, there, i), &rest->facts),
                            left = gap != QDOT_NIL && qdot_expr_is_negative(pool, gap) ? qdot_neg(pool, gap) : gap,
                            equation = qdot_rel(pool, QDOT_EQ, left, QDOT_ZERO);

            if (left != QDOT_NIL && left != QDOT_ZERO)
                one = qdot_list_appended(pool, one, 1, &equation);
        }
        QDOT_TRY(qdot_pool_check(pool));
        if (qdot_expr_size(pool, one) > LARGEST_PRINTED)
            *list = QDOT_NIL;
        else if (qdot_expr_place(qdot_expr_count(pool, *list), qdot_expr_args(pool, *list), one) ==
                 qdot_expr_count(pool, *list))
            *list = qdot_list_appended(pool, *list, 1, &one);
    }
    return qdot_pool_check(pool);
}
