/* simultaneous-members.c -- a solved branch as solutions: periods of the unknowns, their members inside the declared
 * domains, and the conditions under which each exists. */
#include <math.h>

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/list.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "normal/prove/decide.h"
#include "normal/refute/ball.h"
#include "normal/simplify/simplify.h"
#include "normal/solve/simultaneous.h"
#include "normal/solve/solve.h"

enum { MOST_SOLUTIONS = 1024, MOST_RATES = 16, MOST_LISTED = 64 };

/* --- common periods of equations ------------------------------------------------------- */

/* The different rates c at which u occurs in circular functions sin(c u + d); false if one is not
 * linear in u. */
static bool
find_rates(qdot_simultaneous *s, qdot_expr u, qdot_expr *rate, size_t *n)
{
    qdot_pool *pool = s->pool;
    bool linear = true;
    qdot_walk w;

    *n = 0;
    if (qdot_walk_begin(pool, s->equations, &w) != QDOT_OK) {
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

/* The period 2 pi/r with the largest r of which all rates (factors of u) are integer multiples; nil if there is none. */
static qdot_expr
common_period(qdot_simultaneous *s, const qdot_expr *rate, size_t n)
{
    qdot_pool *pool = s->pool;
    qdot_expr period = QDOT_NIL;
    bool common = true;
    fmpq_t unit;

    fmpq_init(unit);
    fmpq_one(unit);
    for (size_t i = 1; i < n && common; i++) {
        qdot_expr ratio = qdot_simplify(pool, qdot_div(pool, rate[i], rate[0]), &s->facts);
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

static qdot_status
find_period(qdot_simultaneous *s, qdot_expr u, qdot_expr *period)
{
    qdot_pool *pool = s->pool;
    qdot_expr rate[MOST_RATES];
    size_t rates;

    *period = QDOT_FALSE;
    if (find_rates(s, u, rate, &rates)) {
        qdot_expr turn = qdot_mul(pool, qdot_expr_int(pool, 2), QDOT_PI),
                  least = common_period(s, rate, rates);

        if (qdot_is_period(s->pool, s->equations, u, turn, &s->facts))
            *period = turn;
        else if (least != QDOT_NIL && qdot_is_period(s->pool, s->equations, u, least, &s->facts) &&
                 (s->alike == NULL || s->alike(s->user, u, least)))
            *period = least;
    }
    return qdot_pool_check(pool);
}

qdot_status
qdot_simultaneous_period(qdot_simultaneous *s, qdot_expr u, qdot_expr *period)
{
    size_t i = qdot_expr_place(s->places, s->unknowns.at, u);

    *period = QDOT_NIL;
    if (i == s->places)
        return QDOT_OK;
    while (s->period.n < s->places)
        QDOT_TRY(qdot_vec_push(&s->period, QDOT_NIL));
    if (s->period.at[i] == QDOT_NIL)
        QDOT_TRY(find_period(s, u, &s->period.at[i]));
    *period = s->period.at[i] == QDOT_FALSE ? QDOT_NIL : s->period.at[i];
    return QDOT_OK;
}

/* --- solutions and their families ------------------------------------------------------ */

/* Whether e contains a division by a constant that is proved to be 0. */
static bool
divides_by_zero(const qdot_simultaneous *s, qdot_expr e)
{
    qdot_pool *pool = s->pool;
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
                    qdot_expr_is_constant(pool, base) && qdot_is_zero(pool, base, &s->facts);
        }
    }
    qdot_walk_end(&w);
    return found;
}

/* Add to the set that each unknown without a period lies in its declared domain. */
static qdot_status
add_domains(qdot_simultaneous *s, qdot_expr known, qdot_expr *set)
{
    qdot_pool *pool = s->pool;

    for (uint32_t i = 0; i < qdot_expr_count(pool, known) && *set != QDOT_FALSE; i++) {
        qdot_expr u = qdot_expr_arg(pool, qdot_expr_arg(pool, known, i), 0),
                  value = qdot_expr_arg(pool, qdot_expr_arg(pool, known, i), 1), period;
        qdot_window window;

        QDOT_TRY(qdot_simultaneous_period(s, u, &period));
        if (period != QDOT_NIL)
            continue;
        window = qdot_simultaneous_window(s, u, false);
        *set = qdot_conditions_all(pool, *set, qdot_window_relations(pool, &window, value));
        QDOT_TRY(qdot_pool_check(pool));
    }
    if (*set != QDOT_FALSE)
        *set = qdot_conditions_at(pool, *set, 0, NULL, NULL, &s->facts);
    return qdot_pool_check(pool);
}

/* The set and the conditions under which what must have a value has one as it is written, where the values of `known`
 * are put in. */
static qdot_expr
add_domain_as_written(const qdot_simultaneous *s, qdot_expr known, qdot_expr set)
{
    qdot_pool *pool = s->pool;

    if (s->domain == QDOT_NIL || s->domain == QDOT_FALSE)
        return s->domain == QDOT_NIL ? set : QDOT_FALSE;
    for (uint32_t i = 0; i < qdot_expr_count(pool, s->domain) && set != QDOT_FALSE; i++) {
        qdot_expr one = qdot_simultaneous_put(pool, qdot_expr_arg(pool, s->domain, i), known);

        if (one == QDOT_NIL)
            return qdot_pool_check(pool) == QDOT_EDOMAIN ? QDOT_FALSE : qdot_pool_fail(pool);
        set = qdot_conditions_and(pool, set, qdot_solve_without_turns(pool, one));
    }
    return set;
}

/* Whether the equations may be 0 there: they have values (that a numerator vanishes is not enough), and none is
 * refuted inside the domains; *conditions gets where all of it is defined. */
static qdot_status
may_be_solution(qdot_simultaneous *s, const qdot_simultaneous_branch *b, qdot_expr *conditions, bool *yes)
{
    qdot_pool *pool = s->pool;
    qdot_expr whole = b->whole == QDOT_NIL ? s->equations : b->whole,
              there = qdot_solve_without_turns(pool, qdot_simultaneous_put(pool, whole, b->known)),
              also = qdot_solve_without_turns(pool, qdot_simultaneous_put(pool, s->defined, b->known)),
              room[QDOT_CONDITIONS_MOST];
    qdot_expr inside;
    qdot_facts facts;
    qdot_status status = qdot_pool_check(pool);

    *yes = status == QDOT_OK && !divides_by_zero(s, b->known);
    if (*yes) {
        *conditions = qdot_conditions_all(pool, *conditions,
                                          qdot_conditions_of_domain(pool, b->known, QDOT_NIL));
        *conditions = qdot_conditions_all(pool, *conditions,
                                          qdot_conditions_of_domain(pool, there, QDOT_NIL));
        *conditions = qdot_conditions_all(pool, *conditions,
                                          qdot_conditions_of_domain(pool, also, QDOT_NIL));
        *conditions = add_domain_as_written(s, b->known, *conditions);
        *conditions = qdot_conditions_at(pool, *conditions, 0, NULL, NULL, &s->facts);
        QDOT_TRY(qdot_pool_check(pool));
        *yes = *conditions != QDOT_FALSE;
    }
    inside = *conditions;
    if (*yes) {
        QDOT_TRY(add_domains(s, b->known, &inside));
        *yes = inside != QDOT_FALSE;
    }
    facts = qdot_facts_and(pool, &s->facts, inside, room);
    for (uint32_t i = 0; *yes && i < qdot_expr_count(pool, there); i++) {
        qdot_decision d;

        if (qdot_expr_arg(pool, there, i) == QDOT_ZERO)
            continue;
        QDOT_TRY(
            qdot_decide_equal(pool, qdot_expr_arg(pool, there, i), QDOT_ZERO, &facts, &d));
        *yes = d.verdict != QDOT_REFUTED;
        if (!*yes && qdot_solve_integers(pool, there) > 0) /* incomplete, since some integers of the family may solve it */
            s->complete = false;
    }
    return status == QDOT_EDOMAIN ? QDOT_OK : status;
}

/* A solution while its periodic unknowns are replaced by members of their families. */
typedef struct {
    qdot_expr *symbol, *value; /* [n] the unknowns that the solution determines, and their values */
    size_t n;
    qdot_expr *equation; /* [n] the equations symbol = member of the family */
} solution;

static qdot_status
append_to_solutions(qdot_simultaneous *s, qdot_expr values, qdot_expr conditions)
{
    QDOT_TRY(qdot_pool_check(s->pool));
    if (s->found.n >= MOST_SOLUTIONS)
        return qdot_fail(QDOT_ELIMIT, "there are more than %d solutions", MOST_SOLUTIONS);
    return qdot_vec_push(&s->found, ((qdot_simultaneous_solution){.values = values, .conditions = conditions}));
}

/* Bounds of the integer n by conditions a n + b > 0 with constants a and b, in doubles and a little too wide. False: they
 * do not bound it on both sides, or MOST_LISTED values or more are left. */
static bool
find_integer_bounds(qdot_simultaneous *s, qdot_expr conditions, qdot_expr n, double *lo, double *hi)
{
    qdot_pool *pool = s->pool;
    uint32_t count = conditions == QDOT_NIL ? 0 : qdot_expr_count(pool, conditions);
    qdot_expr zero = QDOT_ZERO;

    *lo = -INFINITY;
    *hi = INFINITY;
    for (uint32_t i = 0; i < count; i++) {
        qdot_expr one = qdot_expr_arg(pool, conditions, i), gap, slope;
        double a, b;

        if (qdot_expr_kind(pool, one) != QDOT_REL || !qdot_expr_contains(pool, one, n))
            continue;
        gap = qdot_sub(pool, qdot_expr_arg(pool, one, 1), qdot_expr_arg(pool, one, 0));
        slope = qdot_diff(pool, gap, n);
        gap = qdot_subs(pool, gap, 1, &n, &zero);
        if (slope == QDOT_NIL || gap == QDOT_NIL || !qdot_expr_is_constant(pool, slope) || !qdot_expr_is_constant(pool, gap) ||
            !qdot_ball_double(pool, slope, NULL, NULL, &a) || !qdot_ball_double(pool, gap, NULL, NULL, &b) || a == 0)
            continue;
        if (a > 0)
            *lo = fmax(*lo, ceil(-b / a - 1e-6));
        else
            *hi = fmin(*hi, floor(-b / a + 1e-6));
    }
    return isfinite(*lo) && isfinite(*hi) && *hi - *lo < MOST_LISTED;
}

/* Append a solution; if conditions bound an integer in it on both sides, one solution for each
 * value of the integer. */
static qdot_status
append_solution(qdot_simultaneous *s, const solution *p, qdot_expr conditions)
{
    qdot_pool *pool = s->pool;
    qdot_expr values = qdot_list(pool, (uint32_t)p->n, p->equation), n;
    double lo = 0, hi = 0;

    QDOT_TRY(qdot_pool_check(pool));
    if (conditions == QDOT_NIL || qdot_solve_integers(pool, values) != 1)
        return append_to_solutions(s, values, conditions);
    n = qdot_solve_integer(pool, 0);
    if (!qdot_expr_contains(pool, values, n) || !find_integer_bounds(s, conditions, n, &lo, &hi))
        return append_to_solutions(s, values, conditions);
    for (double k = lo; k <= hi; k++) {
        qdot_expr number = qdot_expr_int(pool, (int64_t)k),
                  there = qdot_conditions_at(pool, conditions, 1, &n, &number, &s->facts);

        QDOT_TRY(qdot_pool_check(pool));
        if (there != QDOT_FALSE)
            QDOT_TRY(append_to_solutions(s, qdot_subs(pool, values, 1, &n, &number), there));
    }
    return QDOT_OK;
}

/* How many integers count members already, of the unknowns before the i-th and in the values of all: each family has
 * one of its own. */
static unsigned
count_integers_in_use(qdot_simultaneous *s, const solution *p, size_t i)
{
    unsigned a = qdot_solve_integers(s->pool, qdot_list(s->pool, (uint32_t)i, p->equation)),
             b = qdot_solve_integers(s->pool, qdot_list(s->pool, (uint32_t)p->n, p->value));

    return a > b ? a : b;
}

/* Append the solutions for those members of the families of unknowns i, i + 1 ... that lie inside their domains. */
static qdot_status
append_family_members(qdot_simultaneous *s, const solution *p, size_t i, qdot_expr conditions)
{
    qdot_pool *pool = s->pool;
    qdot_solutions members = {.complete = true};
    qdot_expr u, period, turn = qdot_mul(pool, qdot_expr_int(pool, 2), QDOT_PI);
    qdot_window window;
    qdot_status status;

    if (i == p->n)
        return append_solution(s, p, conditions);
    u = p->symbol[i];
    QDOT_TRY(qdot_simultaneous_period(s, u, &period));
    window = qdot_simultaneous_window(s, u, period == turn);
    window.integer = count_integers_in_use(s, p, i);
    status = qdot_solve_members(pool, u, &(qdot_root){.value = p->value[i], .period = period}, &window,
                                &s->facts, &members);
    s->complete = s->complete && members.complete;
    s->recurs = s->recurs || members.recurs;
    for (size_t k = 0; k < members.root.n && status == QDOT_OK; k++) {
        qdot_expr all = qdot_conditions_all(pool, conditions, members.root.at[k].condition);

        if (members.root.at[k].condition != QDOT_NIL && all != QDOT_FALSE)
            all = qdot_conditions_at(pool, all, 0, NULL, NULL, &s->facts);
        p->equation[i] = qdot_rel(pool, QDOT_EQ, u, members.root.at[k].value);
        status = qdot_pool_check(pool);
        if (status == QDOT_OK && all != QDOT_FALSE)
            status = append_family_members(s, p, i + 1, all);
    }
    qdot_solutions_clear(&members);
    return status;
}

/* The equations u = value with simplified values: only then a value that is 0 is recognised as a pole of 1/u. */
static qdot_expr
simplify_known_values(const qdot_simultaneous *s, qdot_expr known)
{
    qdot_expr list = qdot_list(s->pool, 0, NULL);

    for (uint32_t i = 0; i < qdot_expr_count(s->pool, known); i++) {
        qdot_expr one = qdot_expr_arg(s->pool, known, i),
                  value = qdot_simplify(s->pool, qdot_expr_arg(s->pool, one, 1), &s->facts);

        one = qdot_rel(s->pool, QDOT_EQ, qdot_expr_arg(s->pool, one, 0), value);
        list = qdot_list_appended(s->pool, list, 1, &one);
    }
    return list;
}

qdot_status
qdot_simultaneous_emit(qdot_simultaneous *s, const qdot_simultaneous_branch *branch)
{
    qdot_pool *pool = s->pool;
    size_t n = s->unknowns.n;
    const qdot_simultaneous_branch simple = {.known = simplify_known_values(s, branch->known), .whole = branch->whole},
                                   *b = &simple;
    qdot_expr conditions = qdot_conditions_at(pool, branch->conditions, 0, NULL, NULL, &s->facts),
              room[QDOT_CONDITIONS_MOST];
    qdot_facts facts;
    solution p = {.symbol = qdot_malloc((3 * n + 1) * sizeof *p.symbol)};
    qdot_status status = p.symbol == NULL ? QDOT_ENOMEM : qdot_pool_check(pool);
    bool yes = false;

    if (status == QDOT_OK && conditions != QDOT_FALSE)
        status = may_be_solution(s, b, &conditions, &yes);
    if (status != QDOT_OK || !yes) {
        qdot_free(p.symbol);
        return status;
    }
    facts = qdot_facts_and(pool, &s->facts, conditions, room);
    p.value = p.symbol + n;
    p.equation = p.value + n;
    for (size_t i = 0; i < n; i++)
        for (uint32_t k = 0; k < qdot_expr_count(pool, b->known); k++) {
            qdot_expr one = qdot_expr_arg(pool, b->known, k);

            if (qdot_expr_arg(pool, one, 0) != s->unknowns.at[i])
                continue;
            p.symbol[p.n] = s->unknowns.at[i];
            p.value[p.n++] = qdot_simplify(pool, qdot_expr_arg(pool, one, 1), &facts);
        }
    status = qdot_pool_check(pool);
    if (status == QDOT_OK)
        status = append_family_members(s, &p, 0, conditions);
    qdot_free(p.symbol);
    return status;
}
