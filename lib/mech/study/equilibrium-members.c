/* equilibrium-members.c -- a solved branch as places: periods of coordinates, their members inside the declared
 * domains, and the conditions under which each exists. */
#include "mech/dynamics/quantity.h"
#include "mech/scene/access.h"
#include "mech/study/equilibrium-bands.h"
#include "mech/study/equilibrium-search.h"
#include "normal/prove/decide.h"
#include "normal/refute/constant.h"
#include "normal/simplify/positive.h"
#include "normal/simplify/simplify.h"
#include "normal/solve/solve.h"

enum { MOST_SOLUTIONS = 1024, MOST_RATES = 16 };

/* --- periods --------------------------------------------------------------------------- */

/* Whether a shift of u by `period` changes none of the LIST of equations. */
static bool
is_period(const qdot_rest *r, qdot_expr u, qdot_expr period, qdot_expr equations)
{
    for (uint32_t i = 0; i < qdot_expr_count(r->pool, equations); i++) {
        qdot_expr one = qdot_expr_arg(r->pool, equations, i);

        if (!qdot_is_period(r->pool, 1, &one, u, period, &r->facts))
            return false;
    }
    return true;
}

bool
qdot_rest_is_angle(const qdot_rest *r, qdot_expr u, qdot_expr equations)
{
    return is_period(r, u, qdot_mul(r->pool, qdot_expr_int(r->pool, 2), QDOT_PI), equations);
}

/* The rates c at which u occurs in circular functions, sin(c u + d), each once; false: one is not linear in u. */
static bool
circular_rates(qdot_rest *r, qdot_expr u, qdot_expr *rate, size_t *n)
{
    qdot_pool *pool = r->pool;
    bool linear = true;
    qdot_walk w;

    *n = 0;
    if (qdot_walk_begin(pool, r->equations, &w) != QDOT_OK) {
        (void)qdot_pool_fail(pool);
        return false;
    }
    for (size_t i = 0; i < w.n && linear; i++) {
        uint32_t op = qdot_expr_node(pool, w.at[i])->op;
        qdot_expr c;

        if (qdot_expr_kind(pool, w.at[i]) != QDOT_FUN || op > QDOT_COT ||
            !qdot_expr_contains(pool, w.at[i], u))
            continue;
        c = qdot_diff(pool, qdot_expr_arg(pool, w.at[i], 0), u);
        linear = c != QDOT_NIL && !qdot_expr_contains(pool, c, u) && *n < MOST_RATES;
        if (linear && qdot_expr_place(*n, rate, c) == *n)
            rate[(*n)++] = c;
    }
    qdot_walk_end(&w);
    return linear && *n > 0;
}

/* 2 pi over the greatest rate of which all are whole multiples; nil: there is none. */
static qdot_expr
common_period(qdot_rest *r, const qdot_expr *rate, size_t n)
{
    qdot_pool *pool = r->pool;
    qdot_expr period = QDOT_NIL;
    bool common = true;
    fmpq_t unit;

    fmpq_init(unit);
    fmpq_one(unit);
    for (size_t i = 1; i < n && common; i++) {
        qdot_expr ratio = qdot_simplify(pool, qdot_div(pool, rate[i], rate[0]), &r->facts);
        const fmpq *q = ratio == QDOT_NIL ? NULL : qdot_expr_rational(pool, ratio);

        common = q != NULL;
        if (common)
            fmpq_gcd(unit, unit, q);
    }
    if (common)
        period = qdot_div(pool, qdot_mul(pool, qdot_expr_int(pool, 2), QDOT_PI),
                          qdot_mul(pool, qdot_expr_fmpq(pool, unit), rate[0]));
    fmpq_clear(unit);
    if (period != QDOT_NIL && qdot_expr_is_negative(pool, period))
        period = qdot_neg(pool, period);
    return period;
}

/* Whether the equations of motion too are the same after that shift of u: then all members of a family are alike. */
static bool
moves_alike(qdot_rest *r, qdot_expr u, qdot_expr period)
{
    for (size_t i = 0; i < r->s->coordinates.n; i++) {
        qdot_expr equation = qdot_mech_equation(r->s, r->s->coordinates.at[i]), gap;

        if (equation == QDOT_NIL)
            return false;
        gap = qdot_sub(r->pool, qdot_expr_arg(r->pool, equation, 0),
                       qdot_expr_arg(r->pool, equation, 1));
        if (gap == QDOT_NIL || !qdot_is_period(r->pool, 1, &gap, u, period, &r->facts))
            return false;
    }
    for (size_t k = 0; k < r->s->constraints.n; k++)
        if (!qdot_is_period(r->pool, 1, &r->s->constraints.at[k].f, u, period, &r->facts))
            return false;
    return true;
}

static qdot_status
find_period(qdot_rest *r, qdot_expr u, qdot_expr *period)
{
    qdot_pool *pool = r->pool;
    qdot_expr rate[MOST_RATES];
    size_t rates;

    *period = QDOT_FALSE;
    if (circular_rates(r, u, rate, &rates)) {
        qdot_expr turn = qdot_mul(pool, qdot_expr_int(pool, 2), QDOT_PI),
                  least = common_period(r, rate, rates);

        if (is_period(r, u, turn, r->equations))
            *period = turn;
        else if (least != QDOT_NIL && is_period(r, u, least, r->equations) &&
                 moves_alike(r, u, least))
            *period = least;
    }
    return qdot_pool_check(pool);
}

qdot_status
qdot_rest_period(qdot_rest *r, qdot_expr u, qdot_expr *period)
{
    size_t i = qdot_expr_place(r->coordinates, r->unknowns.at, u);

    *period = QDOT_NIL;
    if (i == r->coordinates)
        return QDOT_OK;
    while (r->period.n < r->coordinates)
        QDOT_TRY(qdot_vec_push(&r->period, QDOT_NIL));
    if (r->period.at[i] == QDOT_NIL)
        QDOT_TRY(find_period(r, u, &r->period.at[i]));
    *period = r->period.at[i] == QDOT_FALSE ? QDOT_NIL : r->period.at[i];
    return QDOT_OK;
}

/* --- places ---------------------------------------------------------------------------- */

/* Whether something in e is divided by a constant that is proved to be 0. */
static bool
divides_by_zero(const qdot_rest *r, qdot_expr e)
{
    qdot_pool *pool = r->pool;
    bool found = false;
    qdot_walk w;

    if (qdot_walk_begin(pool, e, &w) != QDOT_OK) {
        (void)qdot_pool_fail(pool);
        return false;
    }
    for (size_t i = 0; i < w.n && !found; i++) {
        qdot_expr node = w.at[i];
        uint32_t n = qdot_expr_kind(pool, node) == QDOT_PROD ? qdot_expr_count(pool, node) : 0;

        for (uint32_t k = 1; k + 1 < n && !found; k += 2) {
            qdot_expr base = qdot_expr_arg(pool, node, k);
            const fmpq *exponent = qdot_expr_rational(pool, qdot_expr_arg(pool, node, k + 1));

            found = exponent != NULL && fmpq_sgn(exponent) < 0 &&
                    (qdot_expr_node(pool, base)->sign & QDOT_NE0) == 0 &&
                    qdot_is_constant(pool, base) && qdot_is_zero(pool, base, &r->facts);
        }
    }
    qdot_walk_end(&w);
    return found;
}

/* Whether the equations may be 0 there: they have values (that a numerator vanishes is not enough), and none is
 * refuted; *conditions gets where all of it is defined. */
static qdot_status
may_rest(qdot_rest *r, const qdot_rest_branch *b, qdot_expr *conditions, bool *yes)
{
    qdot_pool *pool = r->pool;
    qdot_expr there = qdot_solve_without_turns(
                  pool, qdot_rest_put(r, b->whole == QDOT_NIL ? r->equations : b->whole, b->known)),
              room[QDOT_CONDITIONS_MOST];
    qdot_expr energy = qdot_solve_without_turns(pool, qdot_rest_put(r, r->energy, b->known));
    qdot_facts facts;
    qdot_status status = qdot_pool_check(pool);

    *yes = status == QDOT_OK && !divides_by_zero(r, b->known);
    if (*yes) {
        *conditions = qdot_conditions_all(pool, *conditions,
                                          qdot_conditions_of_domain(pool, b->known, QDOT_NIL));
        *conditions = qdot_conditions_all(pool, *conditions,
                                          qdot_conditions_of_domain(pool, there, QDOT_NIL));
        *conditions = qdot_conditions_all(pool, *conditions,
                                          qdot_conditions_of_domain(pool, energy, QDOT_NIL));
        *conditions = qdot_conditions_at(pool, *conditions, 0, NULL, NULL, &r->facts);
        QDOT_TRY(qdot_pool_check(pool));
        *yes = *conditions != QDOT_FALSE;
    }
    facts = qdot_facts_and(pool, &r->facts, *conditions, room);
    for (uint32_t i = 0; *yes && i < qdot_expr_count(pool, there); i++) {
        qdot_decision d;

        if (qdot_expr_arg(pool, there, i) == QDOT_ZERO)
            continue;
        QDOT_TRY(
            qdot_decide_equal(pool, qdot_expr_arg(pool, there, i), QDOT_ZERO, &facts, &d));
        *yes = d.verdict != QDOT_REFUTED;
        if (!*yes && qdot_solve_integers(pool, there) > 0) /* perhaps for some integers */
            r->complete = false;
    }
    return status == QDOT_EDOMAIN ? QDOT_OK : status;
}

/* What a place consists of while its unknowns get their members. */
typedef struct {
    qdot_expr *symbol, *value; /* [n] */
    size_t n;
    qdot_expr *equation; /* [n] symbol = member */
} place;

static qdot_status
append_place(qdot_rest *r, const place *p, qdot_expr conditions)
{
    qdot_equilibrium e = {.exists = qdot_conditions_generic(r->pool, conditions)};
    size_t shown = 0;
    qdot_expr *list = qdot_malloc((p->n + 1) * sizeof *list);

    if (list == NULL)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < p->n; i++) /* the sides of corners are no unknowns of a user */
        if (!qdot_expr_is_class(r->pool, p->symbol[i], QDOT_FORMAL))
            list[shown++] = p->equation[i];
    e.equations = qdot_list(r->pool, (uint32_t)shown, list);
    qdot_free(list);
    QDOT_TRY(qdot_pool_check(r->pool));
    for (size_t i = 0; i < r->found.n; i++)
        if (r->found.at[i].equations == e.equations &&
            qdot_conditions_join(r->pool, &r->found.at[i].exists, e.exists, &r->facts))
            return qdot_pool_check(r->pool);
    if (r->found.n >= MOST_SOLUTIONS)
        return qdot_fail(QDOT_ELIMIT, "the scene has more than %d equilibria",
                         MOST_SOLUTIONS);
    return qdot_vec_push(&r->found, e);
}

/* Sides of jumps that nothing determines may have any value that the conditions leave: where there is one, the
 * conditions on them are met. *conditions: FALSE where there is none. */
static qdot_status
choose_sides(qdot_rest *r, qdot_expr *conditions)
{
    qdot_pool *pool = r->pool;

    for (size_t i = r->searched; i < r->unknowns.n && *conditions != QDOT_FALSE; i++) {
        qdot_expr side = r->unknowns.at[i], on[QDOT_CONDITIONS_MOST], others = QDOT_NIL;
        uint32_t n = *conditions == QDOT_NIL ? 0 : qdot_expr_count(pool, *conditions);
        qdot_bands bands;
        size_t count = 0;
        bool found;
        qdot_status status;

        for (uint32_t k = 0; k < n; k++) {
            qdot_expr one = qdot_expr_arg(pool, *conditions, k);

            if (qdot_expr_contains(pool, one, side) && count < QDOT_CONDITIONS_MOST)
                on[count++] = one;
            else
                others = qdot_conditions_and(pool, others, one);
        }
        if (count == 0)
            continue;
        status = qdot_bands_find(pool, side, count, on, &r->facts, &bands, &found);
        if (status == QDOT_OK && !found)
            r->complete = false;
        *conditions = !found || (bands.at.n == 0 && !bands.whole)
                          ? QDOT_FALSE
                          : qdot_conditions_all(pool, others, bands.also);
        qdot_bands_clear(&bands);
        QDOT_TRY(status);
    }
    return qdot_pool_check(pool);
}

/* How many integers count members already, of the unknowns before the i-th and in the values of all: each family has
 * one of its own. */
static unsigned
integers_before(qdot_rest *r, const place *p, size_t i)
{
    unsigned a = qdot_solve_integers(r->pool, qdot_list(r->pool, (uint32_t)i, p->equation)),
             b = qdot_solve_integers(r->pool, qdot_list(r->pool, (uint32_t)p->n, p->value));

    return a > b ? a : b;
}

/* The members of the i-th unknown and of those behind it, inside their domains. */
static qdot_status
append_members(qdot_rest *r, const place *p, size_t i, qdot_expr conditions)
{
    qdot_pool *pool = r->pool;
    qdot_solutions members = {.complete = true};
    qdot_expr u, period, turn = qdot_mul(pool, qdot_expr_int(pool, 2), QDOT_PI);
    qdot_window window;
    qdot_status status;

    if (i == p->n) {
        QDOT_TRY(choose_sides(r, &conditions));
        return conditions == QDOT_FALSE ? QDOT_OK : append_place(r, p, conditions);
    }
    u = p->symbol[i];
    QDOT_TRY(qdot_rest_period(r, u, &period));
    window = qdot_solve_window(pool, u, period == turn);
    window.integer = integers_before(r, p, i);
    status = qdot_solve_members(pool, u, &(qdot_root){.value = p->value[i], .period = period}, &window,
                                &r->facts, &members);
    r->complete = r->complete && members.complete;
    r->recurs = r->recurs || members.recurs;
    for (size_t k = 0; k < members.root.n && status == QDOT_OK; k++) {
        qdot_expr all = qdot_conditions_all(pool, conditions, members.root.at[k].condition);

        if (members.root.at[k].condition != QDOT_NIL && all != QDOT_FALSE)
            all = qdot_conditions_at(pool, all, 0, NULL, NULL, &r->facts);
        p->equation[i] = qdot_rel(pool, QDOT_EQ, u, members.root.at[k].value);
        status = qdot_pool_check(pool);
        if (status == QDOT_OK && all != QDOT_FALSE)
            status = append_members(r, p, i + 1, all);
    }
    qdot_solutions_clear(&members);
    return status;
}

qdot_status
qdot_rest_emit(qdot_rest *r, const qdot_rest_branch *b)
{
    qdot_pool *pool = r->pool;
    size_t n = r->unknowns.n;
    qdot_expr conditions = qdot_conditions_at(pool, b->conditions, 0, NULL, NULL, &r->facts),
              room[QDOT_CONDITIONS_MOST];
    qdot_facts facts;
    place p = {.symbol = qdot_malloc((3 * n + 1) * sizeof *p.symbol)};
    qdot_status status = p.symbol == NULL ? QDOT_ENOMEM : qdot_pool_check(pool);
    bool yes = false;

    if (status == QDOT_OK && conditions != QDOT_FALSE)
        status = may_rest(r, b, &conditions, &yes);
    if (status != QDOT_OK || !yes) {
        qdot_free(p.symbol);
        return status;
    }
    facts = qdot_facts_and(pool, &r->facts, conditions, room);
    p.value = p.symbol + n;
    p.equation = p.value + n;
    for (size_t i = 0; i < n; i++)
        for (uint32_t k = 0; k < qdot_expr_count(pool, b->known); k++) {
            qdot_expr one = qdot_expr_arg(pool, b->known, k);

            if (qdot_expr_arg(pool, one, 0) != r->unknowns.at[i])
                continue;
            p.symbol[p.n] = r->unknowns.at[i];
            p.value[p.n++] = qdot_simplify(pool, qdot_expr_arg(pool, one, 1), &facts);
        }
    status = qdot_pool_check(pool);
    if (status == QDOT_OK)
        status = append_members(r, &p, 0, conditions);
    qdot_free(p.symbol);
    return status;
}
