/* solutions.c -- the roots of an equation inside a domain: members of periodic families, and conditions. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "normal/inequality/boxes.h"
#include "normal/prove/decide.h"
#include "normal/refute/ball.h"
#include "normal/refute/enclosure.h"
#include "normal/simplify/simplify.h"
#include "normal/solve/solutions.h"
#include "normal/solve/zeros.h"

/* Roots that recur with a period are listed one by one if the window holds at most MOST_MEMBERS of them, or, where its ends
 * depend on parameters, if none lies MOST_PERIODS or more to either side; else they are given as a family, with an
 * integer n. */
enum { MOST_MEMBERS = 1000, MOST_PERIODS = 12, MOST_INTEGERS = 16, LARGEST_BOUNDED = 400 };

static const qdot_window window_whole = {.lo = QDOT_NIL, .lo_open = true, .hi_open = true};

/* --- windows in which roots are listed ------------------------------------------------- */

qdot_window
qdot_window_turn(qdot_pool *pool, qdot_window w)
{
    qdot_expr turn = qdot_mul(pool, qdot_expr_int(pool, 2), QDOT_PI);

    if (w.lo != QDOT_NIL && w.hi != QDOT_NIL)
        return w;
    if (w.lo != QDOT_NIL)
        return (qdot_window){w.lo, qdot_add(pool, w.lo, turn), w.lo_open, !w.lo_open, false, true, 0};
    if (w.hi != QDOT_NIL)
        return (qdot_window){qdot_sub(pool, w.hi, turn), w.hi, !w.hi_open, w.hi_open, false, true, 0};
    return (qdot_window){qdot_neg(pool, QDOT_PI), QDOT_PI, true, false, true, false, 0};
}

qdot_window
qdot_solve_window(qdot_pool *pool, qdot_expr x, bool angle)
{
    const qdot_symbol *symbol = qdot_expr_symbol(pool, x);
    qdot_window w = window_whole;

    if (symbol != NULL)
        w = (qdot_window){symbol->lo, symbol->hi, symbol->lo_open, symbol->hi_open, false,
                          false, 0};
    return angle ? qdot_window_turn(pool, w) : w;
}

/* Whether a is proved to be a tighter end of a window than b (nil: it has none): a > b for a lower end, a < b for an upper
 * one; a = b too, if it belongs to the window by b alone. */
static bool
is_tighter(qdot_pool *pool, qdot_expr a, bool open, qdot_expr b, bool b_open, bool lower,
           const qdot_facts *facts)
{
    qdot_expr gap = b == QDOT_NIL ? QDOT_NIL : lower ? qdot_sub(pool, a, b) : qdot_sub(pool, b, a);

    return b == QDOT_NIL || qdot_condition(pool, gap, !open || b_open, facts) == QDOT_TRUE;
}

qdot_window
qdot_solve_tighten(qdot_pool *pool, qdot_expr x, qdot_expr conditions, qdot_window w,
                   const qdot_facts *facts)
{
    uint32_t n = conditions == QDOT_NIL ? 0 : qdot_expr_count(pool, conditions);

    for (uint32_t i = 0; i < n; i++) {
        qdot_expr one = qdot_expr_arg(pool, conditions, i), gap, slope, end;
        bool open = qdot_expr_node(pool, one)->op == QDOT_LT;
        const fmpq *c;
        int rises;

        gap = qdot_sub(pool, qdot_expr_arg(pool, one, 1), qdot_expr_arg(pool, one, 0));
        slope = qdot_diff(pool, gap, x);
        c = slope == QDOT_NIL ? NULL : qdot_expr_rational(pool, slope);
        if (c == NULL || fmpq_is_zero(c))
            continue;
        rises = fmpq_sgn(c);
        end = qdot_simplify(pool, qdot_sub(pool, x, qdot_div(pool, gap, slope)), facts);
        if (end == QDOT_NIL || !qdot_expr_is_constant(pool, end))
            continue;
        if (rises > 0 && is_tighter(pool, end, open, w.lo, w.lo_open, true, facts)) {
            w.lo = end;
            w.lo_open = open;
            w.turn = w.recurs = false;
        } else if (rises < 0 && is_tighter(pool, end, open, w.hi, w.hi_open, false, facts)) {
            w.hi = end;
            w.hi_open = open;
            w.turn = w.recurs = false;
        }
    }
    return w;
}

bool
qdot_is_period(qdot_pool *pool, qdot_expr e, qdot_expr x, qdot_expr period, const qdot_facts *facts)
{
    const bool list = e != QDOT_NIL && qdot_expr_kind(pool, e) == QDOT_LIST;
    const uint32_t n = e == QDOT_NIL ? 0 : list ? qdot_expr_count(pool, e) : 1;
    qdot_expr shifted = qdot_add(pool, x, period);

    for (uint32_t i = 0; i < n; i++) {
        qdot_expr f = list ? qdot_expr_arg(pool, e, i) : e, there;

        if (!qdot_expr_contains(pool, f, x))
            continue;
        there = qdot_subs(pool, f, 1, &x, &shifted);
        if (there == QDOT_NIL && qdot_pool_check(pool) != QDOT_EDOMAIN)
            (void)qdot_pool_fail(pool);
        if (there == QDOT_NIL || !qdot_is_zero(pool, qdot_sub(pool, there, f), facts))
            return false;
    }
    return e != QDOT_NIL;
}

bool
qdot_is_angle(qdot_pool *pool, qdot_expr e, qdot_expr x, const qdot_facts *facts)
{
    return qdot_is_period(pool, e, x, qdot_mul(pool, qdot_expr_int(pool, 2), QDOT_PI), facts);
}

qdot_expr
qdot_solve_integer(qdot_pool *pool, unsigned k)
{
    char name[24] = "n";

    for (unsigned i = 1; qdot_symbol_is_declared(pool, name) || k-- > 0; i++)
        snprintf(name, sizeof name, "n%u", i);
    return qdot_symbol_get(pool, QDOT_FORMAL, name);
}

unsigned
qdot_solve_integers(qdot_pool *pool, qdot_expr e)
{
    unsigned n = MOST_INTEGERS;

    while (n > 0 && !qdot_expr_contains(pool, e, qdot_solve_integer(pool, n - 1)))
        n--;
    return n;
}

/* For a circular function f(u): remove integer multiples of its period from u. */
static qdot_expr
remove_turns(qdot_pool *pool, qdot_expr f, void *user)
{
    const uint32_t op = qdot_expr_node(pool, f)->op;
    qdot_expr u = qdot_expr_count(pool, f) == 1 ? qdot_expr_arg(pool, f, 0) : QDOT_NIL,
              period = op == QDOT_TAN || op == QDOT_COT ? QDOT_PI : qdot_mul(pool, qdot_expr_int(pool, 2), QDOT_PI);

    (void)user;
    if (u == QDOT_NIL || op > QDOT_COT)
        return f;
    for (unsigned k = 0, n = qdot_solve_integers(pool, u); k < n; k++) {
        qdot_expr integer = qdot_solve_integer(pool, k), zero = QDOT_ZERO, turns;
        const fmpq *whole;

        if (!qdot_expr_contains(pool, u, integer))
            continue;
        turns = qdot_simplify(pool, qdot_div(pool, qdot_diff(pool, u, integer), period), NULL);
        whole = turns == QDOT_NIL ? NULL : qdot_expr_rational(pool, turns);
        if (whole == NULL || !fmpz_is_one(fmpq_denref(whole)))
            return turns == QDOT_NIL ? QDOT_NIL : f;
        u = qdot_subs(pool, u, 1, &integer, &zero);
    }
    return qdot_fun1(pool, op, u);
}

qdot_expr
qdot_solve_without_turns(qdot_pool *pool, qdot_expr e)
{
    return qdot_walk_replace(pool, e, QDOT_FUN, remove_turns, NULL);
}

qdot_expr
qdot_solve_one_member(qdot_pool *pool, qdot_expr e)
{
    qdot_expr integer[MOST_INTEGERS], zero[MOST_INTEGERS];

    for (unsigned k = 0; k < MOST_INTEGERS; k++) {
        integer[k] = qdot_solve_integer(pool, k);
        zero[k] = QDOT_ZERO;
    }
    return qdot_subs(pool, e, MOST_INTEGERS, integer, zero);
}

/* Arguments of the functions that list the members of a periodic root inside an interval. */
typedef struct {
    qdot_pool *pool;
    qdot_expr x;
    const qdot_root *root;
    const qdot_window *window;
    const qdot_facts *facts;
    qdot_solutions *out;
} members;

/* --- the members: one value ------------------------------------------------------------ */

qdot_expr
qdot_window_relations(qdot_pool *pool, const qdot_window *w, qdot_expr value)
{
    qdot_expr relations = QDOT_NIL;

    if (w->lo != QDOT_NIL)
        relations = qdot_conditions_and(
            pool, relations, qdot_rel(pool, w->lo_open ? QDOT_LT : QDOT_LE, w->lo, value));
    if (w->hi != QDOT_NIL)
        relations = qdot_conditions_and(
            pool, relations, qdot_rel(pool, w->hi_open ? QDOT_LT : QDOT_LE, value, w->hi));
    return relations;
}

/* Whether no parameters take the value into the window, by bounds over boxes: of the relations as they are, for what they are
 * multiplied by to be short may be 0. */
static bool
is_never_inside(qdot_pool *pool, qdot_expr set, qdot_expr relations, const qdot_facts *facts)
{
    qdot_expr room[QDOT_CONDITIONS_MOST], all = qdot_conditions_all(pool, set, relations);
    const qdot_facts known = qdot_facts_and(pool, facts, all, room);
    bool never = false;

    if (all != QDOT_NIL && qdot_expr_size(pool, all) <= LARGEST_BOUNDED &&
        qdot_boxes_exclude(pool, &known, &never) != QDOT_OK)
        (void)qdot_pool_fail(pool);
    return never;
}

/* The set of conditions extended by those under which `value` lies in the interval w. */
static qdot_expr
add_interval_conditions(qdot_pool *pool, qdot_expr set, qdot_expr value, const qdot_window *w,
       const qdot_facts *facts)
{
    qdot_expr room[QDOT_CONDITIONS_MOST], relations = qdot_window_relations(pool, w, value);

    if (relations == QDOT_NIL || relations == QDOT_FALSE || set == QDOT_FALSE)
        return relations == QDOT_FALSE ? QDOT_FALSE : set;
    if (is_never_inside(pool, set, relations, facts))
        return QDOT_FALSE;
    /* decide these together with the value's own conditions, which may contradict them */
    if (set != QDOT_NIL) {
        qdot_facts all = qdot_facts_and(pool, facts, set, room);

        relations = qdot_conditions_at(pool, relations, 0, NULL, NULL, &all);
        return relations == QDOT_NIL
                   ? set
                   : qdot_conditions_at(pool, qdot_conditions_all(pool, set, relations), 0, NULL,
                                        NULL, facts);
    }
    return qdot_conditions_at(pool, relations, 0, NULL, NULL, facts);
}

static qdot_status
append_value(const members *m, qdot_expr value, const qdot_window *w)
{
    qdot_root one = {qdot_simplify(m->pool, value, m->facts), QDOT_NIL, QDOT_NIL, QDOT_NIL};
    qdot_expr room[QDOT_CONDITIONS_MOST];

    QDOT_TRY(qdot_pool_check(m->pool));
    one.condition = add_interval_conditions(m->pool, m->root->condition, one.value, w, m->facts);
    if (one.condition != QDOT_FALSE && m->root->members != QDOT_NIL) {
        const qdot_facts known = qdot_facts_and(m->pool, m->facts, one.condition, room);

        one.condition = qdot_conditions_all(
            m->pool, one.condition,
            qdot_conditions_at(m->pool, m->root->members, 1, &m->x, &one.value, &known));
    }
    QDOT_TRY(qdot_pool_check(m->pool));
    return one.condition == QDOT_FALSE ? QDOT_OK : qdot_vec_push(&m->out->root, one);
}

/* --- the members: families ------------------------------------------------------------- */

/* Whether e is a constant; *v: its value as a double. */
static bool
constant_as_double(qdot_pool *pool, qdot_expr e, double *v)
{
    return e != QDOT_NIL && qdot_expr_is_constant(pool, e) &&
           qdot_ball_double(pool, e, NULL, NULL, v) && isfinite(*v);
}

/* Find the number of periods between the base member and `end` of the interval, if it is a constant. */
static bool
count_periods_to(const members *m, qdot_expr end, double *v)
{
    qdot_expr e;

    if (end == QDOT_NIL)
        return false;
    e = qdot_div(m->pool, qdot_sub(m->pool, end, m->root->value), m->root->period);
    return constant_as_double(m->pool, qdot_simplify(m->pool, e, m->facts), v);
}

static qdot_expr
family_member(const members *m, int64_t k)
{
    return qdot_add(m->pool, m->root->value,
                    qdot_mul(m->pool, qdot_expr_int(m->pool, k), m->root->period));
}

/* Add members number first ... last; those near an end of the window are decided exactly, the
 * others lie inside. */
static qdot_status
append_members_between(const members *m, double first, double last)
{
    for (int64_t k = (int64_t)ceil(first - 1e-6); k <= (int64_t)floor(last + 1e-6); k++) {
        bool is_near = (double)k - first < 1e-6 || last - (double)k < 1e-6;

        QDOT_TRY(append_value(m, family_member(m, k), is_near ? m->window : &window_whole));
    }
    return QDOT_OK;
}

/* --- the members: families with bounded values --- */

/* Find bounds of each e [m] over the declared domains of all symbols in it; infinite if unknown. */
static qdot_status
find_bounds_over_domains(qdot_pool *pool, size_t m, const qdot_expr *e, qdot_interval *to)
{
    qdot_expr atoms = qdot_expr_atoms(pool, qdot_list(pool, (uint32_t)m, e), true),
              x[QDOT_ENCLOSURE_MOST];
    qdot_interval X[QDOT_ENCLOSURE_MOST];
    qdot_enclosure *bounds;
    qdot_status status;
    size_t n = 0;

    for (size_t i = 0; i < m; i++)
        to[i] = qdot_interval_whole;
    QDOT_TRY(qdot_pool_check(pool));
    for (uint32_t i = 0; i < qdot_expr_count(pool, atoms); i++) {
        qdot_expr a = qdot_expr_arg(pool, atoms, i);

        if (n == QDOT_ENCLOSURE_MOST || qdot_expr_kind(pool, a) != QDOT_SYM)
            return QDOT_OK;
        X[n] = qdot_ball_domain(pool, a);
        x[n++] = a;
    }
    status = qdot_enclosure_new(pool, m, e, n, x, &bounds);
    if (status == QDOT_ETYPE)
        return QDOT_OK;
    QDOT_TRY(status);
    qdot_enclosure_eval(bounds, X, false);
    for (size_t i = 0; i < m; i++)
        to[i] = qdot_enclosure_get(bounds, i)->y;
    qdot_enclosure_free(bounds);
    return QDOT_OK;
}

/* Add the members between the ends of the window. How many periods away each end is depends on parameters; intervals bound
 * that over their declared domains. *bounded: there are few enough; else none is added. */
static qdot_status
append_members_within_bounds(const members *m, bool *bounded)
{
    qdot_expr e[2] = {m->window->lo, m->window->hi};
    qdot_interval to[2];

    for (int i = 0; i < 2; i++)
        e[i] = qdot_div(m->pool, qdot_sub(m->pool, e[i], m->root->value), m->root->period);
    if (!qdot_expr_is_constant(m->pool, m->root->period)) /* 1/b for each term of a b */
        for (int i = 0; i < 2; i++)
            e[i] = qdot_simplify(m->pool, e[i], m->facts);
    QDOT_TRY(qdot_pool_check(m->pool));
    QDOT_TRY(find_bounds_over_domains(m->pool, 2, e, to));
    *bounded = to[1].hi - to[0].lo <= 2 * MOST_PERIODS;
    for (double k = ceil(to[0].lo); k <= floor(to[1].hi) && *bounded; k++) {
        bool inside = k > to[0].hi && k < to[1].lo;

        QDOT_TRY(append_value(m, family_member(m, (int64_t)k), inside ? &window_whole : m->window));
    }
    return QDOT_OK;
}

/* Whether the member k periods from the base is proved to lie beyond the end of the interval on its side. */
static bool
is_beyond_end(const members *m, int64_t k)
{
    const qdot_window *w = m->window;
    qdot_expr value = family_member(m, k),
              gap = k > 0 ? qdot_sub(m->pool, w->hi, value) : qdot_sub(m->pool, value, w->lo);

    return qdot_condition(m->pool, gap, k > 0 ? w->hi_open : w->lo_open, m->facts) == QDOT_FALSE;
}

/* Append members from the base in both directions up to the first that is proved to lie beyond the end. */
static qdot_status
append_members_outward(const members *m)
{
    for (int64_t direction = 1; direction >= -1; direction -= 2)
        for (int64_t k = direction > 0 ? 0 : -1; llabs(k) < MOST_PERIODS && !(k != 0 && is_beyond_end(m, k)); k += direction)
            QDOT_TRY(append_value(m, family_member(m, k), m->window));
    return qdot_pool_check(m->pool);
}

/* Append as many members as make a full turn; *few: there are few enough, otherwise none is appended. */
static qdot_status
append_members_of_turn(const members *m, bool *few)
{
    qdot_expr turn = qdot_mul(m->pool, qdot_expr_int(m->pool, 2), QDOT_PI);
    double n;

    turn = qdot_simplify(m->pool, qdot_div(m->pool, turn, m->root->period), m->facts);
    *few = constant_as_double(m->pool, turn, &n) && n < MOST_MEMBERS + 0.5;
    for (int64_t k = 0; *few && k < llround(n); k++) /* the integers in the order 0, -1, 1, -2 ... */
        QDOT_TRY(append_value(m, family_member(m, k % 2 == 0 ? k / 2 : -(k / 2) - 1), &window_whole));
    return qdot_pool_check(m->pool);
}

/* Append the whole family as one root, value + n period, with the conditions on n. */
static qdot_status
append_family(const members *m)
{
    qdot_pool *pool = m->pool;
    const qdot_window *w = m->window;
    qdot_expr n = qdot_solve_integer(pool, w->integer), value = m->root->value;
    qdot_root from = *m->root;
    qdot_window rest = *w;
    members all = *m;
    double at;

    if (w->lo != QDOT_NIL && w->hi == QDOT_NIL && count_periods_to(m, w->lo, &at) &&
        qdot_condition(pool, m->root->period, true, m->facts) == QDOT_TRUE) {
        /* number the members so that the first inside the interval has n = 0 */
        qdot_expr first = family_member(m, (int64_t)ceil(at - 1e-6));

        if (qdot_condition(pool, qdot_sub(pool, first, w->lo), w->lo_open, m->facts) == QDOT_FALSE)
            first = qdot_add(pool, first, m->root->period);
        value = qdot_simplify(pool, first, m->facts);
        from.condition =
            qdot_conditions_and(pool, m->root->condition, qdot_rel(pool, QDOT_LE, QDOT_ZERO, n));
        rest.lo = QDOT_NIL;
    }
    QDOT_TRY(qdot_pool_check(pool));
    all.root = &from;
    return append_value(&all, qdot_add(pool, value, qdot_mul(pool, n, m->root->period)), &rest);
}

qdot_status
qdot_solve_members(qdot_pool *pool, qdot_expr x, const qdot_root *root, const qdot_window *window,
                   const qdot_facts *facts, qdot_solutions *out)
{
    qdot_window w = qdot_solve_tighten(pool, x, root->members, *window, facts);
    const members m = {pool, x, root, &w, facts, out};
    const bool recurs = out->recurs || (w.recurs && root->period != QDOT_NIL);
    double first, last;
    bool bounded, few = true;

    if (root->period == QDOT_NIL)
        return append_value(&m, root->value, root->value == x ? &window_whole : &w);
    if (w.lo == QDOT_NIL || w.hi == QDOT_NIL)
        return append_family(&m);
    if (count_periods_to(&m, w.lo, &first) && count_periods_to(&m, w.hi, &last) && fabs(last - first) <= MOST_MEMBERS) {
        out->recurs = recurs;
        return append_members_between(&m, fmin(first, last), fmax(first, last));
    }
    QDOT_TRY(qdot_pool_check(pool));
    if (w.turn && qdot_expr_is_constant(pool, root->period)) {
        QDOT_TRY(append_members_of_turn(&m, &few));
        if (few)
            return QDOT_OK;
    }
    if (few && (qdot_expr_is_constant(pool, root->period) || (qdot_expr_sign(pool, root->period) & QDOT_POS) == QDOT_POS)) {
        QDOT_TRY(append_members_within_bounds(&m, &bounded));
        if (bounded) {
            out->recurs = recurs;
            return QDOT_OK;
        }
        if (!w.recurs && qdot_expr_is_constant(pool, root->period) && is_beyond_end(&m, MOST_PERIODS) && is_beyond_end(&m, -MOST_PERIODS))
            return append_members_outward(&m);
        QDOT_TRY(qdot_pool_check(pool));
    }
    if (!few || w.recurs) { /* list families over the whole domain of x, not only within one turn */
        w = qdot_solve_window(pool, x, false);
        w.integer = window->integer;
    }
    return append_family(&m);
}

void
qdot_solutions_clear(qdot_solutions *s)
{
    qdot_free(s->root.at);
    qdot_free(s->divisor.at);
    qdot_free(s->special.at);
    *s = (qdot_solutions){0};
}
