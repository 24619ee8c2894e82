/* steady-reduced.c -- steady motions by the equations of motion in independent velocities. */
#include "mech/study/steady-reduced.h"

#include "base/memory.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/function.h"
#include "expr/list.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "mech/scene/scene.h"
#include "mech/study/equilibrium-search.h"
#include "mech/study/equilibrium.h"
#include "mech/study/steady-momenta.h"
#include "mech/study/steady-parts.h"
#include "normal/simplify/positive.h"
#include "normal/simplify/simplify.h"
#include "normal/solve/conditions.h"
#include "normal/solve/simultaneous.h"
#include "normal/solve/solve-factors.h"

enum { MOST_EQUATIONS = 4, MOST_CHOICES = 12 };

/* The equations of steady motions and what they may be solved for: resting coordinates and first-order unknowns, then rates. */
typedef struct {
    qdot_reduced *r;
    size_t n, unknowns;
    qdot_expr e[MOST_EQUATIONS + 1]; /* [n], with a place for one more */
    size_t equations;                /* number of these without one more */
    qdot_expr *unknown;              /* [unknowns] */
    size_t rates;                    /* of these, the last are rates, as parameters */
    qdot_expr *rate, *as_parameter;  /* [rates] */
    qdot_equilibria *out;
} steady_system;

/* --- the equations -------------------------------------------------------------------------------- */

static qdot_status
add_equation(steady_system *x, qdot_expr e)
{
    QDOT_TRY(qdot_pool_check(x->r->pool));
    for (size_t i = 0; i < x->n; i++)
        if (e == x->e[i] || e == qdot_neg(x->r->pool, x->e[i]))
            return qdot_pool_check(x->r->pool);
    if (e == QDOT_ZERO)
        return QDOT_OK;
    if (x->n == MOST_EQUATIONS)
        return qdot_fail(QDOT_ENOTBUILT, "not built yet: steady motions of more than %d equations with velocity constraints or "
                                         "unknown rates", MOST_EQUATIONS);
    x->e[x->n++] = e;
    return QDOT_OK;
}

/* R = 0, first-order unknowns constant, the velocities of resting coordinates 0, holonomic constraints between these. */
static qdot_status
list_equations(steady_system *x)
{
    const qdot_reduced *r = x->r;
    const qdot_scene *s = r->s;

    for (size_t a = 0; a < r->m; a++)
        QDOT_TRY(add_equation(x, qdot_reduced_resting(r, r->R[a])));
    for (size_t k = 0; k < r->states; k++)
        QDOT_TRY(add_equation(x, qdot_reduced_resting(r, r->g[k])));
    for (size_t i = 0; i < r->n; i++)
        if (r->rests[i])
            QDOT_TRY(add_equation(x, qdot_reduced_resting(r, qdot_reduced_velocity(r, i))));
    for (size_t k = 0; k < s->constraints.n; k++) {
        bool rests = false;

        for (size_t i = 0; i < r->n; i++)
            rests = rests || (r->rests[i] && qdot_expr_contains(r->pool, s->constraints.at[k].f, r->q[i]));
        if (s->constraints.at[k].kind == QDOT_HOLONOMIC && rests)
            QDOT_TRY(add_equation(x, qdot_simplify(r->pool, s->constraints.at[k].f, &r->facts)));
    }
    x->equations = x->n;
    for (size_t i = 0; i < x->n; i++)
        x->e[i] = qdot_subs(r->pool, x->e[i], x->rates, x->rate, x->as_parameter);
    return qdot_pool_check(r->pool);
}

/* Rates are parameters while the equations are solved: those that stay free are generic. */
static qdot_status
list_unknowns(steady_system *x)
{
    const qdot_reduced *r = x->r;
    size_t at = 0;

    x->unknown = qdot_calloc(r->n + r->states + 3 * r->m + 1, sizeof *x->unknown);
    if (x->unknown == NULL)
        return QDOT_ENOMEM;
    x->rate = x->unknown + r->n + r->states + r->m;
    x->as_parameter = x->rate + r->m;
    for (size_t i = 0; i < r->n; i++)
        if (r->rests[i])
            x->unknown[at++] = r->q[i];
    for (size_t k = 0; k < r->states; k++)
        x->unknown[at++] = r->s->states.at[k].z;
    for (size_t a = r->m; a-- > 0;)
        if (qdot_reduced_turns(r, a)) {
            x->rate[x->rates] = r->u[a];
            x->as_parameter[x->rates] = qdot_reduced_is_scaled(r, a)
                                            ? r->u[a]
                                            : qdot_symbol_get(r->pool, QDOT_PARAM, qdot_expr_symbol(r->pool, r->u[a])->name);
            x->unknown[at++] = x->as_parameter[x->rates++];
        }
    x->unknowns = at;
    return qdot_pool_check(r->pool);
}

static qdot_expr
with_rates(const steady_system *x, qdot_expr e)
{
    return e == QDOT_NIL ? e : qdot_subs(x->r->pool, e, x->rates, x->as_parameter, x->rate);
}

/* --- one motion ------------------------------------------------------------------------------------ */

/* The value that a solution gives a symbol: its own where it is free. */
static qdot_expr
value_of(const qdot_pool *pool, qdot_expr values, qdot_expr symbol)
{
    for (uint32_t i = 0; i < qdot_expr_count(pool, values); i++)
        if (qdot_expr_arg(pool, qdot_expr_arg(pool, values, i), 0) == symbol)
            return qdot_expr_arg(pool, qdot_expr_arg(pool, values, i), 1);
    return symbol;
}

static qdot_status
append_equation(const qdot_reduced *r, qdot_expr symbol, qdot_expr value, qdot_expr *list)
{
    const qdot_expr one = qdot_rel(r->pool, QDOT_EQ, symbol, value == QDOT_NIL ? value : qdot_simplify(r->pool, value, &r->facts));

    *list = qdot_list_appended(r->pool, *list, 1, &one);
    return qdot_pool_check(r->pool);
}

/* The velocity of coordinate i in a motion whose resting coordinates, first-order unknowns and rates have these values. */
static qdot_expr
velocity_in_motion(const steady_system *x, size_t i, qdot_expr values)
{
    const qdot_reduced *r = x->r;
    qdot_expr e = qdot_reduced_resting(r, qdot_reduced_velocity(r, i));

    for (uint32_t k = 0; k < qdot_expr_count(r->pool, values); k++) {
        const qdot_expr one = qdot_expr_arg(r->pool, values, k), symbol = with_rates(x, qdot_expr_arg(r->pool, one, 0)),
                        value = with_rates(x, qdot_expr_arg(r->pool, one, 1));

        e = qdot_subs(r->pool, e, 1, &symbol, &value);
    }
    return e;
}

/* e with `value` in place of the speed u. */
static qdot_expr
without_speed(const steady_system *x, qdot_expr u, qdot_expr value, qdot_expr e)
{
    e = e == QDOT_NIL ? e : qdot_subs(x->r->pool, e, 1, &u, &value);
    return e == QDOT_NIL ? e : qdot_simplify(x->r->pool, e, &x->r->facts);
}

/* Conditions with `value` in place of the speed u, in their shortest form. */
static qdot_expr
conditions_without_speed(const steady_system *x, qdot_expr u, qdot_expr value, qdot_expr set)
{
    qdot_pool *pool = x->r->pool;
    qdot_expr out = QDOT_NIL;

    for (uint32_t i = 0; set != QDOT_NIL && i < qdot_expr_count(pool, set); i++) {
        qdot_expr one = qdot_expr_arg(pool, set, i);

        if (qdot_expr_contains(pool, one, u)) {
            const qdot_expr gap = without_speed(x, u, value, qdot_positive_of(pool, one));

            one = gap == QDOT_NIL ? gap : qdot_positive(pool, gap, &x->r->facts, 0, NULL);
        }
        if (one == QDOT_NIL)
            return one;
        if (one != QDOT_TRUE)
            out = qdot_conditions_and(pool, out, one);
    }
    return out;
}

/* The coordinate whose velocity in the motion tells the speed u, with the slope by u: that of column a if it can, else one
 * whose slope is not 0 anywhere, if there is one; r->n: none does. */
static size_t
coordinate_of_speed(const steady_system *x, size_t a, qdot_expr list, qdot_expr *slope)
{
    const qdot_reduced *r = x->r;
    size_t best = r->n;
    int quality = 0;

    for (size_t k = 0; k < r->n; k++) {
        const size_t i = k == 0 ? r->independent[a] : k <= r->independent[a] ? k - 1 : k;
        const qdot_expr rate = qdot_symbol_jet(r->pool, r->q[i], 1), value = value_of(r->pool, list, rate);
        const qdot_expr by = r->rests[i] ? QDOT_ZERO : qdot_diff(r->pool, value, r->u[a]);
        const bool sure = by != QDOT_NIL && (qdot_expr_node(r->pool, by)->sign & QDOT_NE0) != 0;
        const int now = by == QDOT_NIL || by == QDOT_ZERO ? 0 : sure ? 3 : k == 0 ? 2 : 1;

        if (now > quality) {
            quality = now;
            best = i;
            *slope = by;
        }
    }
    return best;
}

/* Write a motion whose free speeds are no velocities with free velocities in place of these. */
static qdot_status
name_speeds(steady_system *x, qdot_equilibrium *one)
{
    const qdot_reduced *r = x->r;
    qdot_pool *pool = r->pool;

    for (size_t a = 0; a < r->m; a++) {
        qdot_expr slope = QDOT_NIL, rate, value, rest = QDOT_ZERO, list = qdot_list(pool, 0, NULL);
        size_t i;

        if (!qdot_reduced_is_scaled(r, a) || !qdot_expr_contains(pool, one->equations, r->u[a]))
            continue;
        i = coordinate_of_speed(x, a, one->equations, &slope);
        QDOT_TRY(qdot_pool_check(pool));
        if (i == r->n)
            return QDOT_EDOMAIN;
        rate = qdot_symbol_jet(pool, r->q[i], 1);
        rest = qdot_subs(pool, value_of(pool, one->equations, rate), 1, &r->u[a], &rest);
        value = qdot_div(pool, qdot_sub(pool, rate, rest), slope);
        QDOT_TRY(qdot_rest_add_factors(pool, slope, &x->out->special));
        for (uint32_t k = 0; k < qdot_expr_count(pool, one->equations); k++) {
            const qdot_expr equation = qdot_expr_arg(pool, one->equations, k);

            QDOT_TRY(append_equation(r, qdot_expr_arg(pool, equation, 0),
                                     without_speed(x, r->u[a], value, qdot_expr_arg(pool, equation, 1)), &list));
        }
        one->equations = list;
        one->exists = conditions_without_speed(x, r->u[a], value, one->exists);
        one->stable_when = conditions_without_speed(x, r->u[a], value, one->stable_when);
        QDOT_TRY(qdot_pool_check(pool));
    }
    return QDOT_OK;
}

/* Add a motion: coordinates and first-order unknowns that are constant, then rates. Where the chart is singular there is none. */
static qdot_status
add_steady_motion(steady_system *x, const qdot_simultaneous_solution *found)
{
    const qdot_reduced *r = x->r;
    qdot_expr list = qdot_list(r->pool, 0, NULL);
    qdot_equilibrium one = {.exists = with_rates(x, found->conditions)}, *at;
    const size_t free = x->unknowns - qdot_expr_count(r->pool, found->values), regular = x->unknowns - x->equations;
    qdot_status status = QDOT_OK;

    for (size_t i = 0; i < r->n && status == QDOT_OK; i++)
        if (r->rests[i])
            status = append_equation(r, r->q[i], with_rates(x, value_of(r->pool, found->values, r->q[i])), &list);
    for (size_t k = 0; k < r->states && status == QDOT_OK; k++) {
        const qdot_expr z = r->s->states.at[k].z;

        status = append_equation(r, z, with_rates(x, value_of(r->pool, found->values, z)), &list);
    }
    for (size_t i = 0; i < r->n && status == QDOT_OK; i++)
        if (!r->rests[i])
            status = append_equation(r, qdot_symbol_jet(r->pool, r->q[i], 1), velocity_in_motion(x, i, found->values), &list);
    one.equations = list;
    if (status == QDOT_OK)
        status = qdot_reduced_judge(r, with_rates(x, found->values), free, regular, &one);
    if (status == QDOT_OK)
        status = name_speeds(x, &one);
    if (status == QDOT_EDOMAIN) {
        x->out->complete = false;
        return QDOT_OK;
    }
    QDOT_TRY(status);
    for (size_t i = 0; i < x->out->n; i++)
        if (x->out->at[i].equations == one.equations && x->out->at[i].exists == one.exists)
            return QDOT_OK;
    at = qdot_realloc(x->out->at, (x->out->n + 1) * sizeof *at);
    if (at == NULL)
        return QDOT_ENOMEM;
    x->out->at = at;
    x->out->at[x->out->n++] = one;
    return QDOT_OK;
}

/* --- solving -------------------------------------------------------------------------------------- */

/* What must not be 0 for the solutions to be all: divisors in their values, factors of equations without unknowns u [n]. */
static qdot_status
add_special_values(const steady_system *x, const qdot_expr *u, const qdot_simultaneous *all, qdot_expr *special)
{
    qdot_pool *pool = x->r->pool;

    for (size_t i = 0; i < all->special.n; i++)
        QDOT_TRY(qdot_rest_add_factors(pool, all->special.at[i], special));
    for (size_t i = 0; i < all->found.n; i++) {
        const qdot_expr divisors = qdot_conditions_of_divisors(pool, all->found.at[i].values, QDOT_NIL);

        QDOT_TRY(qdot_pool_check(pool));
        for (uint32_t k = 0; divisors != QDOT_NIL && k < qdot_expr_count(pool, divisors); k++)
            QDOT_TRY(qdot_rest_add_factors(pool, qdot_conditions_nonzero(pool, qdot_expr_arg(pool, divisors, k)), special));
    }
    for (size_t i = 0; i < x->n; i++) {
        const qdot_expr factors = qdot_solve_factors(pool, x->e[i]);

        QDOT_TRY(qdot_pool_check(pool));
        for (uint32_t k = 0; k < qdot_expr_count(pool, factors); k++) {
            const qdot_expr one = qdot_expr_arg(pool, factors, k);
            bool holds = false;

            for (size_t a = 0; a < x->n; a++)
                holds = holds || qdot_expr_contains(pool, one, u[a]);
            if (!holds)
                QDOT_TRY(qdot_rest_add_factors(pool, one, special));
        }
    }
    return QDOT_OK;
}

/* Solve the equations for the unknowns `choice` [n]; *solved: these are all their solutions, and not none. *special: of
 * what is not 0 in these. */
static qdot_status
solve_for(steady_system *x, const size_t *choice, size_t most, qdot_expr *special, bool *solved)
{
    qdot_reduced *r = x->r;
    qdot_simultaneous all;
    qdot_expr u[MOST_EQUATIONS + 1];
    qdot_status status;

    *solved = false;
    for (size_t i = 0; i < x->n; i++) {
        bool holds = false;

        u[i] = x->unknown[choice[i]];
        for (size_t k = 0; k < x->n; k++)
            holds = holds || qdot_expr_contains(r->pool, x->e[k], u[i]);
        if (!holds)
            return QDOT_OK;
    }
    status = qdot_simultaneous_all(r->pool, x->n, x->e, u, QDOT_NIL, &r->facts, &all);
    *solved = status == QDOT_OK && all.complete && all.found.n > 0 && all.found.n <= most;
    for (size_t i = 0; i < all.found.n && status == QDOT_OK && *solved; i++)
        status = add_steady_motion(x, &all.found.at[i]);
    if (status == QDOT_OK && *solved)
        status = add_special_values(x, u, &all, special);
    x->out->recurs = x->out->recurs || (*solved && all.recurs);
    qdot_simultaneous_clear(&all);
    return status == QDOT_ELIMIT ? QDOT_OK : status;
}

/* The next choice of n from m in lexical order; false: there is none. */
static bool
next_choice(size_t n, size_t m, size_t *choice)
{
    size_t i = n;

    while (i-- > 0)
        if (choice[i] + (n - i) < m) {
            choice[i]++;
            for (size_t k = i + 1; k < n; k++)
                choice[k] = choice[k - 1] + 1;
            return true;
        }
    return false;
}

/* Solve for the first choice of unknowns that formulas give, among them `asked` (nil: any): one for which there is a single
 * motion before one with several, unless coordinates alone are solved for. */
static qdot_status
solve_for_some(steady_system *x, qdot_expr asked, qdot_expr *special, bool *solved)
{
    const size_t coordinates = x->unknowns - x->rates;

    *solved = false;
    if (x->n > x->unknowns)
        return QDOT_OK;
    for (int several = asked != QDOT_NIL; several < 2; several++) {
        size_t choice[MOST_EQUATIONS + 1];
        size_t tried = 0;

        for (size_t i = 0; i < x->n; i++)
            choice[i] = i;
        do {
            const bool any = several || choice[x->n - 1] < coordinates;
            bool has = asked == QDOT_NIL;

            for (size_t i = 0; i < x->n; i++)
                has = has || x->unknown[choice[i]] == asked;
            if (has && tried++ < MOST_CHOICES)
                QDOT_TRY(solve_for(x, choice, any ? SIZE_MAX : 1, special, solved));
        } while (!*solved && next_choice(x->n, x->unknowns, choice));
        if (*solved)
            return QDOT_OK;
    }
    return QDOT_OK;
}

/* The motions at which a divisor d vanishes, which formulas for the others leave out; where they are not found d stays among
 * the special values. */
static qdot_status
solve_where_zero(steady_system *x, qdot_expr d)
{
    qdot_expr more = QDOT_NIL;
    bool solved = false, unknown = false;

    for (size_t i = 0; i < x->unknowns; i++)
        unknown = unknown || qdot_expr_contains(x->r->pool, d, x->unknown[i]);
    if (unknown && x->n < MOST_EQUATIONS + 1) {
        const size_t n = x->n;
        qdot_status status;

        x->e[x->n++] = d;
        status = solve_for_some(x, QDOT_NIL, &more, &solved);
        x->n = n;
        QDOT_TRY(status);
    }
    if (!solved) {
        d = with_rates(x, d);
        if (!qdot_list_has(x->r->pool, x->out->special, d))
            x->out->special = qdot_list_appended(x->r->pool, x->out->special, 1, &d);
    }
    return qdot_pool_check(x->r->pool);
}

static qdot_status
refuse_unknown(const steady_system *x, qdot_expr unknown)
{
    (void)qdot_fail(QDOT_EINVAL, "`%.100s` is no free rate of the steady motions", qdot_expr_symbol(x->r->pool, unknown)->name);
    for (size_t k = x->rates; k-- > 0;)
        if (qdot_expr_is_class(x->r->pool, x->rate[k], QDOT_COORD))
            return qdot_hint("steady in %.100s", qdot_expr_symbol(x->r->pool, x->rate[k])->name);
    return qdot_hint("steady");
}

static qdot_status
find_motions(steady_system *x, qdot_expr unknown)
{
    qdot_pool *pool = x->r->pool;
    const size_t k = qdot_expr_place(x->rates, x->rate, unknown);
    qdot_expr special = QDOT_NIL;
    bool solved = false;

    if (unknown != QDOT_NIL && k == x->rates)
        return refuse_unknown(x, unknown);
    x->out->complete = true;
    if (x->n == 0 && unknown == QDOT_NIL)
        return add_steady_motion(x, &(qdot_simultaneous_solution){.values = qdot_list(pool, 0, NULL)});
    if (x->n > 0)
        QDOT_TRY(solve_for_some(x, unknown == QDOT_NIL ? QDOT_NIL : x->as_parameter[k], &special, &solved));
    if (!solved && unknown != QDOT_NIL)
        return qdot_fail(QDOT_EFAILED, "the relation of the steady motions is not solved for `%.100s`",
                         qdot_expr_symbol(pool, unknown)->name);
    if (!solved)
        return qdot_fail(QDOT_EFAILED, "no formula is found for the steady motions");
    for (uint32_t i = 0; special != QDOT_NIL && i < qdot_expr_count(pool, special); i++)
        QDOT_TRY(solve_where_zero(x, qdot_expr_arg(pool, special, i)));
    return qdot_pool_check(pool);
}

/* Of those that the linear motion leaves open or finds stable, the stability at fixed momenta. */
static qdot_status
judge_at_momenta(const steady_system *x)
{
    const qdot_reduced *r = x->r;
    qdot_expr *turning;
    size_t n = 0;
    bool conservative;
    qdot_status status = QDOT_OK;

    QDOT_TRY(qdot_steady_is_conservative(r->s, &conservative));
    if (!conservative)
        return QDOT_OK;
    turning = qdot_calloc(r->m + 1, sizeof *turning);
    if (turning == NULL)
        return QDOT_ENOMEM;
    for (size_t a = 0; a < r->m; a++)
        if (qdot_reduced_turns(r, a))
            turning[n++] = r->q[r->independent[a]];
    for (size_t i = 0; i < x->out->n && status == QDOT_OK; i++)
        if (qdot_steady_is_open(&x->out->at[i]))
            status = qdot_steady_at_momenta(r->s, n, turning, &x->out->at[i]);
    qdot_free(turning);
    return status;
}

qdot_status
qdot_steady_judge_linear(qdot_scene *s, qdot_equilibria *all)
{
    qdot_reduced r;
    steady_system x = {.r = &r, .out = all};
    qdot_status status = qdot_reduced_begin(&r, s, QDOT_NIL);

    if (status == QDOT_OK)
        status = list_unknowns(&x);
    if (status == QDOT_OK)
        status = list_equations(&x);
    for (size_t i = 0; i < all->n && status == QDOT_OK; i++) {
        qdot_equilibrium one = all->at[i];
        size_t free = x.unknowns;

        if (!qdot_steady_is_open(&one))
            continue;
        for (uint32_t k = 0; k < qdot_expr_count(r.pool, one.equations); k++) {
            const qdot_expr equation = qdot_expr_arg(r.pool, one.equations, k), symbol = qdot_expr_arg(r.pool, equation, 0);
            const bool unknown = qdot_expr_place(x.unknowns, x.unknown, symbol) < x.unknowns ||
                                 qdot_expr_place(x.rates, x.rate, symbol) < x.rates;

            free -= unknown && symbol != qdot_expr_arg(r.pool, equation, 1);
        }
        status = qdot_reduced_judge(&r, one.equations, free, x.unknowns - x.equations, &one);
        if (status == QDOT_EDOMAIN)
            status = QDOT_OK;
        else if (status == QDOT_OK && one.stability != QDOT_STABILITY_UNDECIDED)
            all->at[i] = one;
    }
    qdot_free(x.unknown);
    qdot_reduced_end(&r);
    return status == QDOT_ELIMIT || status == QDOT_ENOTBUILT ? QDOT_OK : status;
}

qdot_status
qdot_steady_reduced(qdot_scene *s, qdot_expr unknown, qdot_equilibria *out)
{
    qdot_reduced r;
    steady_system x = {.r = &r, .out = out};
    qdot_status status = qdot_reduced_begin(&r, s, unknown);

    *out = (qdot_equilibria){0};
    if (status == QDOT_OK)
        status = list_unknowns(&x);
    if (status == QDOT_OK && x.rates == 0) {
        (void)qdot_fail(QDOT_EINVAL, "the equations of motion and the constraints hold every coordinate: motions with a constant rate are not looked for");
        status = qdot_hint("equilibria");
    }
    if (status == QDOT_OK)
        status = list_equations(&x);
    if (status == QDOT_OK)
        status = find_motions(&x, unknown);
    if (status == QDOT_OK)
        status = judge_at_momenta(&x);
    qdot_free(x.unknown);
    qdot_reduced_end(&r);
    if (status != QDOT_OK)
        qdot_equilibria_clear(out);
    return status;
}
