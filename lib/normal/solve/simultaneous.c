/* simultaneous.c -- equations solved one unknown at a time, factor by factor; where a step divides, the divisor's zeros
 * are a branch of their own. */
#include "normal/solve/simultaneous.h"

#include <math.h>
#include <stdlib.h>

#include "base/interrupt.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/elementary.h"
#include "expr/exact.h"
#include "expr/list.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "normal/prove/decide.h"
#include "normal/refute/ball.h"
#include "normal/simplify/simplify.h"
#include "normal/solve/condition-forms.h"
#include "normal/solve/sides.h"
#include "normal/solve/solve.h"

enum { MOST_MEMBERS = 64 };

/* How hard a factor is to solve for an unknown: effort_to_solve. */
enum { ALONE, LINEAR, LINEAR_BY_UNKNOWNS, NOT_LINEAR, NOT_THERE = 9 };

/* --- inserting values; special parameter values ---------------------------------- */

qdot_expr
qdot_simultaneous_put(qdot_pool *pool, qdot_expr e, qdot_expr values)
{
    uint32_t n = qdot_expr_count(pool, values);
    qdot_expr *from = qdot_malloc((2 * (size_t)n + 1) * sizeof *from);

    if (from == NULL)
        return qdot_pool_fail(pool);
    for (uint32_t i = 0; i < n; i++) {
        from[i] = qdot_expr_arg(pool, qdot_expr_arg(pool, values, i), 0);
        from[n + i] = qdot_expr_arg(pool, qdot_expr_arg(pool, values, i), 1);
    }
    e = qdot_subs(pool, e, n, from, from + n);
    qdot_free(from);
    return e;
}

/* A bound of a domain with the values that the caller inserts (s->ends); unchanged if it then has no value. */
static qdot_expr
bound_with_values(const qdot_simultaneous *s, qdot_expr end)
{
    qdot_expr there = s->ends == NULL || end == QDOT_NIL ? end : s->ends(s->ends_user, end);

    if (there == QDOT_NIL && end != QDOT_NIL && qdot_pool_check(s->pool) != QDOT_EDOMAIN)
        (void)qdot_pool_fail(s->pool);
    return there == QDOT_NIL ? end : there;
}

qdot_window
qdot_simultaneous_window(const qdot_simultaneous *s, qdot_expr u, bool angle)
{
    qdot_window w = qdot_solve_window(s->pool, u, false);

    w.lo = bound_with_values(s, w.lo);
    w.hi = bound_with_values(s, w.hi);
    return angle ? qdot_window_turn(s->pool, w) : w;
}

size_t
qdot_simultaneous_unknowns_in(const qdot_simultaneous *s, qdot_expr e)
{
    size_t n = 0;

    for (size_t i = 0; i < s->unknowns.n; i++)
        n += qdot_expr_contains(s->pool, e, s->unknowns.at[i]);
    return n;
}

/* Record that solutions may differ where d = 0, if d contains parameters only. */
qdot_status
qdot_simultaneous_add_special(qdot_simultaneous *s, qdot_expr d)
{
    if (!qdot_is_generic(s->pool, d) || qdot_expr_is_constant(s->pool, d) ||
        (qdot_expr_node(s->pool, d)->sign & QDOT_NE0) != 0 ||
        qdot_expr_place(s->special.n, s->special.at, d) < s->special.n)
        return QDOT_OK;
    return qdot_vec_push(&s->special, d);
}

/* --- one step of a branch ------------------------------------------------------------ */

/* Whether e contains unknowns other than coordinates: Lagrange multipliers, or symbols that stand for signs. */
static bool
contains_other_unknowns(const qdot_simultaneous *s, qdot_expr e)
{
    bool holds = false;

    for (size_t i = s->places; i < s->unknowns.n && !holds; i++)
        holds = qdot_expr_contains(s->pool, e, s->unknowns.at[i]);
    return holds;
}

/* Whether e contains unknowns in [-1, 1] that stand for undetermined signs, such as the direction of friction at rest. */
static bool
has_bounded_unknowns(const qdot_simultaneous *s, qdot_expr e)
{
    bool holds = false;

    for (size_t i = s->places; i < s->unknowns.n && !holds; i++) {
        const qdot_symbol *share = qdot_expr_symbol(s->pool, s->unknowns.at[i]);

        holds = share->lo != QDOT_NIL && share->hi != QDOT_NIL && qdot_expr_contains(s->pool, e, s->unknowns.at[i]);
    }
    return holds;
}

/* Whether e jumps or has a kink as a function of u: its derivative then does not tell whether e is linear. */
static bool
has_kink_in(const qdot_simultaneous *s, qdot_expr e, qdot_expr u)
{
    static const qdot_fun_id kinks[] = {QDOT_SIGN, QDOT_ABS, QDOT_FLOOR, QDOT_MOD, QDOT_MIN, QDOT_MAX, QDOT_IF};

    return qdot_expr_find_function(s->pool, e, sizeof kinks / sizeof *kinks, kinks, u) != QDOT_NIL;
}

/* How hard it is to solve a factor for an unknown: 0 the only one in it; 1 linear, never
 * divided by anything unknown; 2 linear, or so in pieces; 3 else; 9 not there. */
static int
effort_to_solve(const qdot_simultaneous *s, qdot_expr factor, qdot_expr u)
{
    qdot_expr slope;

    if (!qdot_expr_contains(s->pool, factor, u))
        return NOT_THERE;
    if (qdot_simultaneous_unknowns_in(s, factor) == 1)
        return ALONE;
    slope = qdot_diff(s->pool, factor, u);
    if (slope == QDOT_NIL || qdot_expr_contains(s->pool, slope, u))
        return NOT_LINEAR;
    if (slope != QDOT_ZERO && contains_other_unknowns(s, factor) && has_kink_in(s, factor, u)) /* after what is linear everywhere */
        return LINEAR_BY_UNKNOWNS;
    if (has_bounded_unknowns(s, factor) && !has_bounded_unknowns(s, u)) /* a sign symbol: its bounds limit equilibria */
        return LINEAR_BY_UNKNOWNS;
    if (has_bounded_unknowns(s, u) && (qdot_expr_node(s->pool, slope)->sign & QDOT_NE0) != 0)
        return LINEAR;
    return qdot_simultaneous_unknowns_in(s, slope) == 0 ? LINEAR : LINEAR_BY_UNKNOWNS;
}

/* The index of the unknown for which a factor is solved most easily; of equally easy ones the last. */
static int
find_easiest_unknown(const qdot_simultaneous *s, qdot_expr factor, size_t *which)
{
    int least = NOT_THERE;

    for (size_t i = s->unknowns.n; i-- > 0;) {
        int one = effort_to_solve(s, factor, s->unknowns.at[i]);

        if (one < least) {
            least = one;
            *which = i;
        }
    }
    return least;
}

/* Continue a branch of the search with u = value inserted in all equations. */
static qdot_status
continue_with_value(qdot_simultaneous *s, const qdot_simultaneous_branch *b, qdot_expr equations, qdot_expr u,
                    qdot_expr value, qdot_expr conditions)
{
    qdot_pool *pool = s->pool;
    qdot_expr equation = qdot_rel(pool, QDOT_EQ, u, value);
    qdot_simultaneous_branch next = {.equations = qdot_subs(pool, equations, 1, &u, &value),
                             .known = qdot_subs(pool, b->known, 1, &u, &value),
                             .conditions = qdot_conditions_all(pool, b->conditions, conditions),
                             .whole = b->whole};

    if (qdot_solve_integers(pool, value) > 0) { /* the integers of a family occur in the value */
        next.equations = qdot_solve_without_turns(pool, next.equations);
        next.known = qdot_solve_without_turns(pool, next.known);
        if (next.conditions != QDOT_NIL && next.conditions != QDOT_FALSE)
            next.conditions = qdot_solve_without_turns(pool, qdot_subs(pool, next.conditions, 1, &u, &value));
    }
    if (qdot_pool_failed(pool)) { /* a denominator is 0 at this value: no solution */
        qdot_status status = qdot_pool_check(pool);

        return status == QDOT_EDOMAIN ? QDOT_OK : status;
    }
    if (next.conditions != QDOT_NIL && next.conditions != QDOT_FALSE)
        next.conditions = qdot_conditions_at(pool, next.conditions, 1, &u, &value, &s->facts);
    QDOT_TRY(qdot_pool_check(pool));
    if (next.conditions == QDOT_FALSE)
        return QDOT_OK;
    /* the left sides of the equations u = value are unknowns and stay as they are */
    next.known = qdot_list_appended(pool, next.known, 1, &equation);
    QDOT_TRY(qdot_pool_check(pool));
    return qdot_vec_push(&s->todo, next);
}

/* How many members u = base + k period, k = 0, 1 ..., the circular functions of u in the equations take for
 * different: *members; 0: without end, or more than MOST_MEMBERS. */
static qdot_status
count_different_members(qdot_simultaneous *s, qdot_expr u, qdot_expr period, int64_t *members)
{
    qdot_pool *pool = s->pool;
    qdot_expr two_pi = qdot_mul(pool, qdot_expr_int(pool, 2), QDOT_PI);
    qdot_walk w;

    *members = 1;
    QDOT_TRY(qdot_walk_begin(pool, s->equations, &w));
    for (size_t i = 0; i < w.n && *members > 0; i++) {
        qdot_expr turns;
        const fmpq *q;

        if (qdot_expr_kind(pool, w.at[i]) != QDOT_FUN ||
            qdot_expr_node(pool, w.at[i])->op > QDOT_COT ||
            !qdot_expr_contains(pool, w.at[i], u))
            continue;
        turns = qdot_mul(pool, period, qdot_diff(pool, qdot_expr_arg(pool, w.at[i], 0), u));
        turns = qdot_simplify(pool, qdot_div(pool, turns, two_pi), &s->facts);
        q = turns == QDOT_NIL ? NULL : qdot_expr_rational(pool, turns);
        if (q == NULL || fmpz_cmp_si(fmpq_denref(q), MOST_MEMBERS) > 0) {
            *members = 0;
        } else { /* take the least common multiple of the periods */
            int64_t d = fmpz_get_si(fmpq_denref(q)), k = *members;

            while (k % d != 0)
                k += *members;
            *members = k > MOST_MEMBERS ? 0 : k;
        }
    }
    qdot_walk_end(&w);
    return qdot_pool_check(pool);
}

/* A family of u in which the equations are not periodic, as u stands in them beside its sines: a branch
 * u = base + (k + members n) period for each value of the sines; they lose their whole turns, and the integer n stays.
 * *done: false where there is no such number. */
static qdot_status
continue_with_integer(qdot_simultaneous *s, const qdot_simultaneous_branch *b, qdot_expr equations, qdot_expr u,
                      const qdot_root *root, bool *done)
{
    qdot_pool *pool = s->pool;
    qdot_expr n = qdot_solve_integer(pool, qdot_solve_integers(pool, b->known));
    int64_t members = 0;
    qdot_status status = QDOT_OK;

    *done = false;
    if (qdot_expr_place(s->places, s->unknowns.at, u) == s->places ||
        root->members != QDOT_NIL)
        return QDOT_OK;
    QDOT_TRY(count_different_members(s, u, root->period, &members));
    for (int64_t k = members; k-- > 0 && status == QDOT_OK;) {
        qdot_expr count = qdot_add(pool, qdot_expr_int(pool, k),
                                   qdot_mul(pool, qdot_expr_int(pool, members), n));

        status = continue_with_value(s, b, equations, u,
                                     qdot_add(pool, root->value, qdot_mul(pool, count, root->period)),
                                     root->condition);
    }
    *done = members > 0;
    return status;
}

/* Continue with one branch of the search for each member of a family of u within the common period of all equations. */
static qdot_status
continue_with_members(qdot_simultaneous *s, const qdot_simultaneous_branch *b, qdot_expr equations, qdot_expr u,
                      const qdot_root *root)
{
    qdot_pool *pool = s->pool;
    qdot_window window = qdot_solve_tighten(pool, u, root->members,
                                            qdot_simultaneous_window(s, u, false), &s->facts);
    qdot_expr period, ratio;
    int64_t members = 0;
    bool done;
    qdot_status status = qdot_simultaneous_period(s, u, &period);

    if (status == QDOT_OK && period != QDOT_NIL) {
        ratio = qdot_simplify(pool, qdot_div(pool, period, root->period), &s->facts);
        QDOT_TRY(qdot_pool_check(pool));
        if (!qdot_expr_to_int(pool, ratio, &members) || members > MOST_MEMBERS)
            members = 0;
    }
    for (int64_t k = members; k-- > 0 && status == QDOT_OK;)
        status = continue_with_value(s, b, equations, u,
                                     qdot_add(pool, root->value,
                                              qdot_mul(pool, qdot_expr_int(pool, k), root->period)),
                                     qdot_conditions_all(pool, root->condition, root->members));
    if (status != QDOT_OK || members > 0)
        return status;
    if (window.lo != QDOT_NIL && window.hi != QDOT_NIL) {
        qdot_solutions inside = {.complete = true};

        status = qdot_solve_members(pool, u, root, &window, &s->facts, &inside);
        s->complete = s->complete && inside.complete;
        for (size_t i = inside.root.n; i-- > 0 && status == QDOT_OK;)
            status = continue_with_value(s, b, equations, u, inside.root.at[i].value,
                                         inside.root.at[i].condition);
        qdot_solutions_clear(&inside);
        return status;
    }
    QDOT_TRY(continue_with_integer(s, b, equations, u, root, &done));
    if (done)
        return QDOT_OK;
    s->complete = false; /* incomplete, since the other equations differ for every member of an infinite family */
    return continue_with_value(s, b, equations, u, root->value,
                               qdot_conditions_all(pool, root->condition, root->members));
}

/* Continue the search with a branch on which a divisor is 0 (for a LIST: all its members are). */
static qdot_status
continue_with_zero_divisor(qdot_simultaneous *s, const qdot_simultaneous_branch *b, qdot_expr equations, qdot_expr factor,
                           qdot_expr divisor)
{
    qdot_pool *pool = s->pool;
    bool many = qdot_expr_kind(pool, divisor) == QDOT_LIST;
    uint32_t n = many ? qdot_expr_count(pool, divisor) : 0;
    qdot_simultaneous_branch next = *b;

    next.first = many ? qdot_expr_arg(pool, divisor, 0) : divisor;
    next.equations = qdot_list_appended(pool, equations, 1, &factor);
    for (uint32_t i = 1; i < n; i++) {
        qdot_expr one = qdot_expr_arg(pool, divisor, i);

        next.equations = qdot_list_appended(pool, next.equations, 1, &one);
    }
    QDOT_TRY(qdot_pool_check(pool));
    return qdot_vec_push(&s->todo, next);
}

static qdot_status
continue_with_root(qdot_simultaneous *s, const qdot_simultaneous_branch *b, qdot_expr others, qdot_expr u,
                   const qdot_root *root)
{
    qdot_simultaneous_branch free;

    if (root->period != QDOT_NIL)
        return continue_with_members(s, b, others, u, root);
    if (root->value != u)
        return continue_with_value(s, b, others, u, root->value, root->condition);
    free = *b; /* every u is a solution, under a condition: u stays free on this branch */
    free.equations = others;
    free.first = QDOT_NIL;
    free.conditions = qdot_conditions_all(s->pool, b->conditions, root->condition);
    return free.conditions == QDOT_FALSE ? QDOT_OK : qdot_vec_push(&s->todo, free);
}

/* Represent each family with constant values by its first member in the declared domain, in ascending order. */
static qdot_status
normalise_families(qdot_simultaneous *s, qdot_expr u, qdot_solutions *found)
{
    qdot_window window = qdot_simultaneous_window(s, u, true);
    bool any = false;

    for (size_t i = 0; i < found->root.n && !window.turn; i++) {
        qdot_root *root = &found->root.at[i];
        qdot_solutions members = {.complete = true};

        if (root->period == QDOT_NIL || !qdot_expr_is_constant(s->pool, root->value) ||
            !qdot_expr_is_constant(s->pool, root->period))
            continue;
        QDOT_TRY(qdot_solve_members(s->pool, u, root, &window, &s->facts, &members));
        if (members.root.n > 0 && qdot_expr_is_constant(s->pool, members.root.at[0].value)) /* a single value, not a family */
            root->value = members.root.at[0].value;
        qdot_solutions_clear(&members);
        any = true;
    }
    return any ? qdot_solve_sort(s->pool, found->root.n, found->root.at) : QDOT_OK;
}

/* Keep the branch on which factor = 0 (nil: none) and the LIST `others` holds: no formula gives all its solutions. */
static qdot_status
leave_branch(qdot_simultaneous *s, const qdot_simultaneous_branch *b, qdot_expr others, qdot_expr factor)
{
    qdot_simultaneous_branch one = *b;

    one.equations = factor == QDOT_NIL ? others : qdot_list_appended(s->pool, others, 1, &factor);
    one.first = QDOT_NIL;
    QDOT_TRY(qdot_pool_check(s->pool));
    return qdot_vec_push(&s->left, one);
}

/* Solve factor = 0 for the unknown in it for which that is easiest, and continue a branch for each root. */
static qdot_status
solve_factor(qdot_simultaneous *s, const qdot_simultaneous_branch *b, qdot_expr others, qdot_expr factor)
{
    qdot_solutions found;
    size_t which = 0;
    qdot_expr u;
    qdot_status status;

    if (find_easiest_unknown(s, factor, &which) == NOT_THERE) /* a factor without unknowns is not 0, because parameters are generic */
        return qdot_simultaneous_add_special(s, factor);
    u = s->unknowns.at[which];
    status = qdot_solve(s->pool, factor, u, &s->facts, &found);
    if (status == QDOT_OK && !found.complete)
        status = leave_branch(s, b, others, factor);
    for (size_t i = 0; i < found.special.n && status == QDOT_OK; i++)
        status = qdot_simultaneous_add_special(s, found.special.at[i]);
    if (status == QDOT_OK)
        status = normalise_families(s, u, &found);
    for (size_t i = found.root.n; i-- > 0 && status == QDOT_OK;)
        status = continue_with_root(s, b, others, u, &found.root.at[i]);
    for (size_t i = 0; i < found.divisor.n && status == QDOT_OK; i++)
        status = continue_with_zero_divisor(s, b, others, factor, found.divisor.at[i]);
    qdot_solutions_clear(&found);
    return status;
}

/* --- choosing the next equation -------------------------------------------------------- */

/* Note whether e, without unknowns and not proved 0, is proved to be non-zero; otherwise the set
 * may be incomplete. */
static qdot_status
is_never_zero(qdot_simultaneous *s, qdot_expr e, const qdot_facts *facts)
{
    qdot_decision d;

    QDOT_TRY(qdot_decide_equal(s->pool, e, QDOT_ZERO, facts, &d));
    s->complete = s->complete && d.verdict == QDOT_REFUTED;
    return qdot_simultaneous_add_special(s, e);
}

/* e = 0 without unknowns, with integers that count members of families: the branch for each integer that solves it. A
 * root with parameters is no integer for generic ones. */
static qdot_status
continue_with_solved_integers(qdot_simultaneous *s, const qdot_simultaneous_branch *b, qdot_expr e)
{
    qdot_pool *pool = s->pool;
    qdot_expr n = qdot_solve_integer(pool, qdot_solve_integers(pool, e) - 1);
    qdot_solutions found;
    qdot_status status = qdot_solve(pool, e, n, &s->facts, &found);

    s->complete = s->complete && found.complete;
    for (size_t i = 0; i < found.root.n && status == QDOT_OK; i++) {
        qdot_expr value = found.root.at[i].value, k;
        qdot_simultaneous_branch next = *b;
        double x;

        if (found.root.at[i].period != QDOT_NIL || value == n ||
            qdot_solve_integers(pool, value) > 0) {
            s->complete = false;
            continue;
        }
        if (!qdot_expr_is_constant(pool, value))
            continue;
        if (!qdot_ball_double(pool, value, NULL, NULL, &x) || fabs(x) > 1e9) {
            s->complete = false;
            continue;
        }
        k = qdot_expr_int(pool, llround(x));
        if (fabs(x - (double)llround(x)) > 1e-6)
            continue;
        if (!qdot_is_zero(pool, qdot_sub(pool, value, k), &s->facts)) {
            s->complete = false;
            continue;
        }
        next.equations = qdot_subs(pool, b->equations, 1, &n, &k);
        next.known = qdot_subs(pool, b->known, 1, &n, &k);
        next.first = QDOT_NIL;
        next.conditions = qdot_conditions_at(pool, b->conditions, 1, &n, &k, &s->facts);
        status = qdot_pool_check(pool);
        if (status == QDOT_EDOMAIN)
            status = QDOT_OK;
        else if (status == QDOT_OK && next.conditions != QDOT_FALSE)
            status = qdot_vec_push(&s->todo, next);
    }
    qdot_solutions_clear(&found);
    return status;
}

/* The equation that is solved next, and the remaining equations. */
typedef struct {
    qdot_expr equation, factors; /* the equation, and its factors; nil if nothing is left to solve */
    qdot_expr others;            /* a LIST of the other equations */
    qdot_expr dead; /* an equation without unknowns that is not proved to hold; nil: none */
    bool hard;      /* every equation has a factor that is linear in none of several unknowns */
} next_equation;

/* Factor every equation, and choose the one whose hardest factor is easiest to solve. */
static qdot_status
choose_next_equation(qdot_simultaneous *s, qdot_expr equations, const qdot_facts *facts, next_equation *next)
{
    qdot_pool *pool = s->pool;
    uint32_t n = qdot_expr_count(pool, equations), best = 0, count = 0;
    qdot_expr *left = qdot_calloc(n + 1, sizeof *left);
    int least = NOT_THERE + 1;
    size_t which;

    if (left == NULL)
        return QDOT_ENOMEM;
    for (uint32_t i = 0; i < n && next->dead == QDOT_NIL; i++) {
        qdot_expr e = qdot_simplify(pool, qdot_expr_arg(pool, equations, i), &s->facts),
                  list;
        int hardest = 0;

        if (e == QDOT_ZERO || e == QDOT_NIL || qdot_is_zero(pool, e, &s->facts))
            continue;
        if (qdot_simultaneous_unknowns_in(s, e) == 0 && qdot_is_zero(pool, e, facts))
            continue;
        list = qdot_solve_factors(pool, e);
        if (list == QDOT_NIL)
            break;
        if (qdot_simultaneous_unknowns_in(s, e) == 0)
            next->dead = e;
        for (uint32_t k = 0; k < qdot_expr_count(pool, list); k++) {
            int one = find_easiest_unknown(s, qdot_expr_arg(pool, list, k), &which);

            if (one < NOT_THERE && one > hardest)
                hardest = one;
        }
        left[count++] = e;
        if (hardest < least) {
            least = hardest;
            best = count - 1;
            next->factors = list;
        }
    }
    if (count > 0) {
        next->equation = left[best];
        left[best] = left[count - 1];
    }
    next->hard = count > 0 && least == NOT_LINEAR;
    next->others = qdot_list(pool, count == 0 ? 0 : count - 1, left);
    qdot_free(left);
    return qdot_pool_check(pool);
}

/* Of an equation u v = 0, u an unknown, with v proved to be positive or negative leave u alone: z (a/r1^3 + b/r2^3) = 0. The
 * factors as polynomials in their roots do not show the sign. */
static qdot_status
leave_out_definite_factor(qdot_simultaneous *s, const qdot_facts *facts, next_equation *next)
{
    qdot_pool *pool = s->pool;

    for (uint32_t k = 0; k < 2 && qdot_expr_count(pool, next->factors) == 2; k++) {
        const qdot_expr u = qdot_expr_arg(pool, next->factors, k);
        qdot_expr v;

        if (qdot_expr_symbol(pool, u) == NULL)
            continue;
        v = qdot_simplify(pool, qdot_expand(pool, qdot_div(pool, next->equation, u)), facts);
        QDOT_TRY(qdot_pool_check(pool));
        if (qdot_condition(pool, v, true, facts) == QDOT_TRUE ||
            qdot_condition(pool, qdot_neg(pool, v), true, facts) == QDOT_TRUE)
            next->factors = qdot_list(pool, 1, &u);
    }
    return qdot_pool_check(pool);
}

/* Take a divisor that is to be 0 as the next equation, with its factors; nil if it is 0 already. */
static qdot_status
choose_divisor(qdot_simultaneous *s, qdot_expr divisor, next_equation *next)
{
    qdot_pool *pool = s->pool;
    qdot_expr e = qdot_simplify(pool, divisor, &s->facts);

    if (e == QDOT_NIL || e == QDOT_ZERO || qdot_is_zero(pool, e, &s->facts))
        return qdot_pool_check(pool);
    next->equation = e;
    next->factors = qdot_solve_factors(pool, e);
    if (qdot_simultaneous_unknowns_in(s, e) == 0)
        next->dead = e;
    return qdot_pool_check(pool);
}

/* An equation e = 0 without unknowns. Integers that count members of families may solve it, or one side of a switch of
 * parameters; else it never holds. */
static qdot_status
test_known_equation(qdot_simultaneous *s, const qdot_simultaneous_branch *b, const next_equation *next, const qdot_facts *facts)
{
    qdot_expr choice = qdot_vanishes_in_regions(s->pool, next->dead)
                           ? qdot_sides_choice(s->pool, next->dead, QDOT_NIL)
                           : QDOT_NIL;
    qdot_simultaneous_branch simple = *b;

    if (qdot_solve_integers(s->pool, next->dead) > 0) {
        if (b->first == QDOT_NIL)
            return continue_with_solved_integers(s, b, next->dead);
        s->complete = false; /* incomplete, since integers for which a divisor is 0 are not determined */
        return QDOT_OK;
    }
    if (choice == QDOT_NIL)
        return is_never_zero(s, next->dead, facts);
    simple.equations = qdot_list_appended(s->pool, b->equations, 1, &next->dead);
    return qdot_simultaneous_on_all_sides(s, &simple, choice);
}

/* The factors of the next equation, each solved where no choice is in it; else a branch with that factor alone, or, if it
 * is the only one, for each side. */
static qdot_status
continue_with_factors(qdot_simultaneous *s, const qdot_simultaneous_branch *b, const next_equation *next)
{
    uint32_t n = qdot_expr_count(s->pool, next->factors);

    for (uint32_t k = n; k-- > 0;) {
        qdot_expr one = qdot_expr_arg(s->pool, next->factors, k), choice = qdot_simultaneous_common_switch(s, one, next->others);
        qdot_simultaneous_branch with = *b;
        qdot_expr *at = b->first == QDOT_NIL ? &with.equations : &with.first;

        if (choice == QDOT_NIL) {
            QDOT_TRY(solve_factor(s, b, next->others, one));
            continue;
        }
        *at = b->first == QDOT_NIL ? qdot_list_appended(s->pool, next->others, 1, &one) : one;
        QDOT_TRY(qdot_pool_check(s->pool));
        QDOT_TRY(n == 1 ? qdot_simultaneous_on_all_sides(s, &with, choice) : qdot_vec_push(&s->todo, with));
    }
    return QDOT_OK;
}

static qdot_status
step(qdot_simultaneous *s, const qdot_simultaneous_branch *b)
{
    next_equation next = {.others = b->equations};
    qdot_simultaneous_branch left = *b;
    qdot_expr room[QDOT_CONDITIONS_MOST];
    const qdot_facts facts = qdot_facts_and(s->pool, &s->facts, b->conditions, room);
    bool done = false;

    QDOT_TRY(qdot_interrupt_check());
    if (b->first != QDOT_NIL)
        QDOT_TRY(choose_divisor(s, b->first, &next));
    if (next.factors == QDOT_NIL) { /* the divisor is 0: no solution on this branch */
        left.first = QDOT_NIL;
        QDOT_TRY(choose_next_equation(s, b->equations, &facts, &next));
    }
    if (next.dead != QDOT_NIL)
        return test_known_equation(s, &left, &next, &facts);
    if (next.hard)
        QDOT_TRY(leave_out_definite_factor(s, &facts, &next));
    if (next.hard)
        QDOT_TRY(qdot_simultaneous_by_powers(s, b, qdot_list_appended(s->pool, next.others, 1, &next.equation), &done));
    if (done)
        return QDOT_OK;
    return next.factors == QDOT_NIL ? qdot_simultaneous_emit(s, b) : continue_with_factors(s, &left, &next);
}

/* Charge a step on these equations, whose factors and forms take more than their length; false if
 * it is more than what is left of the budget, which is then spent. */
static bool
charge_work(qdot_simultaneous *s, qdot_expr equations)
{
    uint64_t size = qdot_expr_size(s->pool, equations), work;

    work = size > s->work ? UINT64_MAX : 1 + size + size * size / 10;
    if (work > s->work) {
        s->work = 0;
        return false;
    }
    s->work -= work;
    return true;
}

qdot_status
qdot_simultaneous_solve(qdot_simultaneous *s)
{
    qdot_status status = QDOT_OK;

    while (status == QDOT_OK && s->todo.n > 0) {
        qdot_simultaneous_branch b = s->todo.at[--s->todo.n];

        status = charge_work(s, b.equations) ? step(s, &b) : leave_branch(s, &b, b.equations, b.first);
    }
    s->narrowed = s->complete && s->left.n > 0;
    s->complete = s->complete && s->left.n == 0;
    return status;
}

void
qdot_simultaneous_clear(qdot_simultaneous *s)
{
    qdot_free(s->unknowns.at);
    qdot_free(s->period.at);
    qdot_free(s->todo.at);
    qdot_free(s->left.at);
    qdot_free(s->found.at);
    qdot_free(s->special.at);
    *s = (qdot_simultaneous){0};
}
