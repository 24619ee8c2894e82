/* inequality.c -- tries cases, then symbols in place of functions, then cells; last, the sign
 * of the slope. */
#include "normal/inequality/inequality.h"

#include <stdio.h>

#include "base/memory.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/elementary.h"
#include "expr/exact.h"
#include "expr/list.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "normal/field/prepare.h"
#include "normal/form/shortest.h"
#include "normal/inequality/linear-rows.h"
#include "normal/inequality/question.h"
#include "normal/prove/decide.h"
#include "normal/prove/domain.h"
#include "normal/refute/constant.h"

enum { MOST_CASES = 64, MOST_SLOPES = 3, MOST_MARGINS = 12, SMALLEST_PART = 128, MOST_SAID = 8 };
#define WORK 20000
#define ALL_WORK 30000000

/* --- the facts of a question ------------------------------------------------------------ */

/* Add the declared bounds of all symbols in the question, including symbols in those bounds. */
static void
add_declared_bounds(qdot_pool *pool, qdot_question *q)
{
    qdot_expr seen = qdot_list(pool, 0, NULL);

    for (int round = 0; round < 3; round++) {
        qdot_expr all[1 + QDOT_QUESTION_CONDITIONS] = {q->e}, atoms;

        for (size_t i = 0; i < q->n; i++)
            all[1 + i] = q->condition[i].gap;
        atoms = qdot_expr_atoms(pool, qdot_list(pool, (uint32_t)(1 + q->n), all), false);
        for (uint32_t i = 0; atoms != QDOT_NIL && i < qdot_expr_count(pool, atoms); i++) {
            qdot_expr x = qdot_expr_arg(pool, atoms, i);
            qdot_symbol s = *qdot_expr_symbol(pool, x);

            if (qdot_list_has(pool, seen, x))
                continue;
            if (s.lo != QDOT_NIL)
                qdot_question_demand(q, qdot_sub(pool, x, s.lo), !s.lo_open);
            if (s.hi != QDOT_NIL)
                qdot_question_demand(q, qdot_sub(pool, s.hi, x), !s.hi_open);
        }
        seen = atoms;
        if (seen == QDOT_NIL) {
            q->too_much = true;
            return;
        }
    }
}

static void
question_begin(qdot_pool *pool, qdot_question *q, qdot_expr e, const qdot_facts *facts)
{
    *q = (qdot_question){.e = e, .exact = true, .too_much = e == QDOT_NIL};
    for (size_t i = 0; facts != NULL && i < facts->n_conditions; i++) {
        qdot_expr c = facts->conditions[i];

        if (qdot_expr_kind(pool, c) != QDOT_REL || qdot_expr_node(pool, c)->op == QDOT_EQ)
            q->exact = false;
        else
            qdot_question_demand(
                q, qdot_sub(pool, qdot_expr_arg(pool, c, 1), qdot_expr_arg(pool, c, 0)),
                qdot_expr_node(pool, c)->op == QDOT_LE);
    }
    if (facts != NULL && facts->n_relations > 0)
        q->exact = false;
    if (!q->too_much)
        add_declared_bounds(pool, q);
}

/* --- case distinctions ------------------------------------------------------------------ */

/* The innermost absolute value or if(...) in e, which needs a case distinction; nil: none. */
static qdot_expr
first_choice(qdot_pool *pool, qdot_expr e)
{
    return qdot_expr_find_function(pool, e, 2, (qdot_fun_id[]){QDOT_ABS, QDOT_IF}, QDOT_NIL);
}

static void
substitute_in_question(qdot_pool *pool, qdot_question *q, qdot_expr x, qdot_expr to)
{
    q->e = qdot_subs(pool, q->e, 1, &x, &to);
    for (size_t i = 0; i < q->n; i++)
        q->condition[i].gap = qdot_subs(pool, q->condition[i].gap, 1, &x, &to);
    q->too_much |= q->e == QDOT_NIL;
}

/* Replace a question that needs a case distinction by two questions; `a` gets the first case, `b` the second. */
static void
split_question(qdot_pool *pool, qdot_expr choice, qdot_question *a, qdot_question *b)
{
    qdot_expr u = qdot_expr_arg(pool, choice, 0), gap;
    bool strict;

    if (qdot_expr_node(pool, choice)->op == QDOT_ABS) {
        qdot_question_demand(a, u, true);
        qdot_question_demand(b, qdot_neg(pool, u), true);
        substitute_in_question(pool, a, choice, u);
        substitute_in_question(pool, b, choice, qdot_neg(pool, u));
        return;
    }
    if (qdot_expr_kind(pool, u) != QDOT_REL || qdot_expr_node(pool, u)->op == QDOT_EQ) {
        a->too_much = true;
        return;
    }
    a->chosen = b->chosen = true;
    gap = qdot_sub(pool, qdot_expr_arg(pool, u, 1), qdot_expr_arg(pool, u, 0));
    strict = qdot_expr_node(pool, u)->op == QDOT_LT;
    qdot_question_demand(a, gap, !strict);
    qdot_question_demand(b, qdot_neg(pool, gap), strict);
    substitute_in_question(pool, a, choice, qdot_expr_arg(pool, choice, 1));
    substitute_in_question(pool, b, choice, qdot_expr_arg(pool, choice, 2));
}

/* Drop conditions whose symbols are not connected with e, directly or through other conditions. */
static void
drop_unconnected(qdot_pool *pool, qdot_question *q)
{
    qdot_expr all = q->e;
    size_t kept = 0;
    bool in[QDOT_QUESTION_CONDITIONS] = {false}, more = true;

    while (more && all != QDOT_NIL) {
        qdot_expr atoms = qdot_expr_atoms(pool, all, false);

        more = false;
        for (size_t i = 0; i < q->n && atoms != QDOT_NIL; i++)
            for (uint32_t k = 0; k < qdot_expr_count(pool, atoms) && !in[i]; k++)
                if (qdot_expr_contains(pool, q->condition[i].gap,
                                       qdot_expr_arg(pool, atoms, k))) {
                    qdot_expr two[2] = {all, q->condition[i].gap};

                    in[i] = more = true;
                    all = qdot_list(pool, 2, two);
                }
    }
    for (size_t i = 0; i < q->n; i++)
        if (in[i])
            q->condition[kept++] = q->condition[i];
        else
            q->exact = false;
    q->n = kept;
}

/* --- answering one question --------------------------------------------------------------- */

/* Prove e > 0 from e - c m >= 0 for some c > 0 and m > 0; if refuted for a small c it is for every
 * larger one. */
static qdot_status
prove_with_margin(qdot_pool *pool, const qdot_question *q, bool *proved)
{
    qdot_expr margin[MOST_MARGINS] = {QDOT_ONE}, at;
    size_t n = 1, singles;
    qdot_cells result;

    for (size_t i = 0; i < q->n && n < MOST_MARGINS; i++)
        if (!q->condition[i].weak)
            margin[n++] = q->condition[i].gap;
    singles = n;
    for (size_t i = 1; i < singles; i++)
        for (size_t j = i; j < singles && n < MOST_MARGINS; j++)
            margin[n++] = qdot_mul(pool, margin[i], margin[j]);
    for (size_t i = 0; i < n && !*proved; i++) {
        qdot_expr less = qdot_sub(pool, q->e, qdot_mul(pool, qdot_expr_ratio(pool, 1, SMALLEST_PART), margin[i]));

        QDOT_TRY(qdot_cells_decide(pool, less, q->n, q->condition, q->work, &result, &at));
        *proved = result == QDOT_CELLS_POSITIVE || result == QDOT_CELLS_NOT_NEGATIVE || result == QDOT_CELLS_ZERO;
    }
    return QDOT_OK;
}

/* Whether e is a positive number times g. */
static bool
is_multiple(qdot_pool *pool, qdot_expr e, qdot_expr g)
{
    qdot_expr ratio = qdot_prepare_flat(pool, qdot_div(pool, e, g), WORK);

    return ratio != QDOT_NIL && qdot_expr_kind(pool, ratio) == QDOT_NUM &&
           fmpq_sgn(qdot_expr_rational(pool, ratio)) > 0;
}

/* Whether a condition, or the sum of two conditions, is literally the inequality to be proved. */
static bool
is_given_by_conditions(qdot_pool *pool, const qdot_question *q, bool strict)
{
    bool said = false;

    for (size_t i = 0; i < q->n && !said; i++) {
        const qdot_cells_condition *a = &q->condition[i];

        if (a->gap == QDOT_ZERO)
            continue;
        said = !(strict && a->weak) && is_multiple(pool, q->e, a->gap);
        for (size_t j = 0; j < i && !said; j++) {
            const qdot_cells_condition *b = &q->condition[j];
            qdot_expr sum = qdot_add(pool, a->gap, b->gap);

            said = !(strict && a->weak && b->weak) && sum != QDOT_ZERO &&
                   is_multiple(pool, q->e, sum);
        }
    }
    return said;
}

/* Without choices in it. *any: there are points inside. Where there are none the question is settled by
 * the other sides of absolute values: their points come as near as one likes. */
static qdot_status
answer_question(qdot_pool *pool, qdot_question *q, bool strict, bool *proved, bool *any,
                qdot_expr *at)
{
    qdot_cells result = QDOT_CELLS_UNKNOWN;
    qdot_expr point = QDOT_NIL;
    bool by_rows; /* decided by elimination of linear inequalities, which distinguishes > and >= */

    *proved = false;
    if (!q->too_much && q->e != QDOT_NIL && qdot_expr_is_constant(pool, q->e)) {
        qdot_constant_sign sign;

        QDOT_TRY(qdot_constant_decide(pool, q->e, &sign));
        *proved =
            sign == QDOT_CONSTANT_POSITIVE || (sign == QDOT_CONSTANT_ZERO && !strict);
        *any = true;
        return QDOT_OK;
    }
    if (!q->too_much && q->n <= MOST_SAID && is_given_by_conditions(pool, q, strict)) {
        *proved = *any = true;
        return QDOT_OK;
    }
    qdot_question_reduce(pool, q);
    if (!q->too_much)
        drop_unconnected(pool, q);
    if (q->too_much || qdot_pool_failed(pool))
        return qdot_grave(qdot_pool_check(pool));
    QDOT_TRY(qdot_linear_decide(pool, q->e, q->n, q->condition, &result));
    /* if elimination finds that e > 0 or e >= 0 fails, and q is exact, the cell decomposition finds a point where it fails */
    by_rows = result != QDOT_CELLS_UNKNOWN && !(q->exact && result >= QDOT_CELLS_NOT_NEGATIVE);
    if (!by_rows)
        QDOT_TRY(qdot_cells_decide(pool, q->e, q->n, q->condition, q->work, &result, &point));
    *any |= result > QDOT_CELLS_EMPTY;
    switch (result) {
    case QDOT_CELLS_EMPTY: *proved = !q->chosen; break;
    case QDOT_CELLS_POSITIVE: *proved = true; break;
    case QDOT_CELLS_NOT_NEGATIVE:
        *proved = !strict;
        if (strict && !by_rows)
            QDOT_TRY(prove_with_margin(pool, q, proved));
        break;
    case QDOT_CELLS_ZERO:
        *proved = !strict;
        if (strict && q->exact)
            *at = point;
        break;
    case QDOT_CELLS_NEGATIVE:
        if (q->exact)
            *at = point;
        break;
    default: break;
    }
    return qdot_grave(qdot_pool_check(pool));
}

static qdot_status
prove_by_cases(qdot_pool *pool, qdot_expr e, bool strict, const qdot_facts *facts,
               int64_t *work, bool *proved, qdot_expr *at)
{
    qdot_question *q = qdot_malloc(MOST_CASES * sizeof *q);
    size_t n = 1, done = 0;
    qdot_status status = q == NULL ? QDOT_ENOMEM : QDOT_OK;
    bool any = false;

    *proved = status == QDOT_OK;
    if (status != QDOT_OK)
        return status;
    question_begin(pool, &q[0], e, facts);
    q[0].work = work;
    qdot_question_whole_parts(pool, &q[0]);
    while (n > 0 && *proved && status == QDOT_OK) {
        qdot_question *last = &q[n - 1];
        qdot_expr choice = last->too_much || last->e == QDOT_NIL || qdot_pool_failed(pool)
                               ? QDOT_NIL
                               : first_choice(pool, last->e);

        if (choice != QDOT_NIL && n < MOST_CASES && done + n < MOST_CASES) {
            q[n] = *last;
            split_question(pool, choice, last, &q[n]);
            n++;
            continue;
        }
        n--;
        done++;
        last->too_much |= choice != QDOT_NIL || last->e == QDOT_NIL;
        status = answer_question(pool, last, strict, proved, &any, at);
        *proved &= !last->too_much;
    }
    *proved &= any;
    qdot_free(q);
    if (status == QDOT_OK)
        status = qdot_grave(qdot_pool_check(pool));
    return status;
}

/* --- by derivatives ------------------------------------------------------------------------- */

/* Whether e is defined and smooth on the whole domain of its only symbol. */
static bool
is_smooth_on_domain(qdot_pool *pool, qdot_expr e)
{
    bool good = true;
    qdot_walk w;

    if (qdot_walk_begin(pool, e, &w) != QDOT_OK)
        return false;
    for (size_t i = 0; i < w.n && good; i++) {
        qdot_expr at = w.at[i];
        int64_t k;

        switch (qdot_expr_kind(pool, at)) {
        case QDOT_NUM:
        case QDOT_SYM:
        case QDOT_SUM: break;
        case QDOT_PROD:
            for (uint32_t j = 1; j < qdot_expr_count(pool, at) && good; j += 2)
                good = (qdot_expr_to_int(pool, qdot_expr_arg(pool, at, j + 1), &k) &&
                        k >= 0) ||
                       (qdot_expr_node(pool, qdot_expr_arg(pool, at, j))->sign &
                        QDOT_POS) == QDOT_POS;
            break;
        case QDOT_FUN:
            good = qdot_expr_is_function_that(pool, at, QDOT_FUN_ENTIRE) ||
                   (qdot_expr_is_function(pool, at, QDOT_LOG) &&
                    (qdot_expr_node(pool, qdot_expr_arg(pool, at, 0))->sign & QDOT_POS) == QDOT_POS);
            break;
        default: good = false;
        }
    }
    qdot_walk_end(&w);
    return good;
}

static qdot_status prove_by_cases_or_derivatives(qdot_pool *pool, qdot_expr e, bool strict, int slopes,
                                                 int64_t *work, bool *proved);

/* Whether e >= 0 at x = a is known; *above: e > 0 there. */
static bool
is_nonnegative_at(qdot_pool *pool, qdot_expr e, qdot_expr x, qdot_expr a, bool *above)
{
    qdot_expr there = qdot_subs(pool, e, 1, &x, &a);
    qdot_constant_sign sign = QDOT_CONSTANT_UNKNOWN;

    if (there == QDOT_NIL) {
        if (qdot_grave(qdot_pool_check(pool)) != QDOT_OK)
            qdot_pool_fail(pool);
        return false;
    }
    if (!qdot_expr_is_constant(pool, there) ||
        qdot_constant_decide(pool, there, &sign) != QDOT_OK)
        return false;
    *above = sign == QDOT_CONSTANT_POSITIVE;
    return *above || sign == QDOT_CONSTANT_ZERO;
}

/* How far the domain of x goes from a: *end nil without end. False: not at all, or not known;
 * *nothing: a is its end. */
static bool
domain_extends(qdot_pool *pool, qdot_expr bound, qdot_expr a, bool up, qdot_expr *end,
               bool *nothing)
{
    qdot_constant_sign sign = QDOT_CONSTANT_UNKNOWN;

    *end = QDOT_NIL;
    *nothing = false;
    if (bound == QDOT_NIL)
        return true;
    *end = up ? qdot_sub(pool, bound, a) : qdot_sub(pool, a, bound);
    if (*end == QDOT_NIL || !qdot_expr_is_constant(pool, *end) ||
        qdot_constant_decide(pool, *end, &sign) != QDOT_OK)
        return false;
    *nothing = sign == QDOT_CONSTANT_ZERO;
    return *nothing || sign == QDOT_CONSTANT_POSITIVE;
}

/* An expression e of one symbol: its derivative, and how many more derivatives may be used. */
struct line {
    qdot_pool *pool;
    qdot_expr x, slope;
    int slopes;
    int64_t *work;
};

/* On one side of a, where e(a) >= 0: the slope of e leads away from 0. As it does not vanish along a
 * stretch, e > e(a) there. */
static qdot_status
prove_on_one_side(const struct line *e, qdot_expr a, bool up, bool *proved)
{
    qdot_pool *pool = e->pool;
    qdot_symbol s = *qdot_expr_symbol(pool, e->x);
    qdot_expr end, y, to, slope;
    char name[80];

    *proved = false;
    if (!domain_extends(pool, up ? s.hi : s.lo, a, up, &end, proved) || *proved)
        return QDOT_OK;
    snprintf(name, sizeof name, "(%u from %u to %u%d)", e->x, a, end,
             up ? s.hi_open : s.lo_open);
    y = qdot_symbol_get(pool, QDOT_FORMAL, name);
    if (y == QDOT_NIL)
        return qdot_pool_check(pool);
    qdot_symbol_domain(pool, y, QDOT_ZERO, true, end, up ? s.hi_open : s.lo_open);
    to = up ? qdot_add(pool, a, y) : qdot_sub(pool, a, y);
    slope = qdot_subs(pool, up ? e->slope : qdot_neg(pool, e->slope), 1, &e->x, &to);
    if (slope == QDOT_NIL)
        return qdot_grave(qdot_pool_check(pool));
    return prove_by_cases_or_derivatives(pool, slope, false, e->slopes - 1, e->work, proved);
}

static qdot_status
prove_by_derivatives(qdot_pool *pool, qdot_expr e, bool strict, int slopes, int64_t *work,
                     bool *proved)
{
    qdot_expr atoms = qdot_expr_atoms(pool, e, true), points[3] = {QDOT_ZERO, QDOT_ONE},
              x;
    struct line line = {.pool = pool, .slopes = slopes, .work = work};
    qdot_decision vanishes;

    *proved = false;
    if (slopes == 0 || atoms == QDOT_NIL || qdot_expr_count(pool, atoms) != 1 ||
        qdot_expr_kind(pool, qdot_expr_arg(pool, atoms, 0)) != QDOT_SYM ||
        !is_smooth_on_domain(pool, e))
        return QDOT_OK;
    line.x = x = qdot_expr_arg(pool, atoms, 0);
    points[2] = qdot_expr_symbol(pool, x)->lo;
    line.slope = qdot_shortest(pool, qdot_diff(pool, e, x), NULL);
    if (line.slope == QDOT_NIL)
        return qdot_grave(qdot_pool_check(pool));
    QDOT_TRY(qdot_decide_equal(pool, line.slope, QDOT_ZERO, NULL, &vanishes));
    if (vanishes.verdict != QDOT_REFUTED)
        return QDOT_OK;
    for (int i = 0; i < 3 && !*proved; i++) {
        qdot_symbol s = *qdot_expr_symbol(pool, x);
        qdot_expr a = points[i];
        bool above = false, up = false, down = false;

        if (a == QDOT_NIL || !is_nonnegative_at(pool, e, x, a, &above))
            continue;
        if (strict && !above && !(a == s.lo && s.lo_open) && !(a == s.hi && s.hi_open))
            continue;
        QDOT_TRY(prove_on_one_side(&line, a, true, &up));
        if (up)
            QDOT_TRY(prove_on_one_side(&line, a, false, &down));
        *proved = up && down;
    }
    return qdot_pool_failed(pool) ? qdot_grave(qdot_pool_check(pool)) : QDOT_OK;
}

/* Prove that e is positive or not negative by cases, then by derivatives; the work is bounded by
 * MOST_SLOPES. */
static qdot_status
prove_by_cases_or_derivatives(qdot_pool *pool, qdot_expr e, bool strict, int slopes, int64_t *work,
                              bool *proved)
{
    qdot_expr at = QDOT_NIL;

    QDOT_TRY(prove_by_cases(pool, e, strict, NULL, work, proved, &at));
    if (*proved || at != QDOT_NIL)
        return QDOT_OK;
    return prove_by_derivatives(pool, e, strict, slopes, work, proved);
}

/* --- the whole decision ----------------------------------------------------------------------- */

/* Conditions, and relations that can be solved, put into the symbols; what is left of them. Slopes
 * too. */
static qdot_status
prove_after_substitutions(qdot_pool *pool, qdot_expr e, bool strict, const qdot_facts *facts,
                          int64_t *work, bool *proved)
{
    size_t nr = facts->n_relations;
    qdot_expr *all = qdot_malloc((nr + 1) * sizeof *all), at = QDOT_NIL;
    qdot_domain_rest rest;
    qdot_facts known = {0};
    qdot_status status;

    if (all == NULL)
        return QDOT_ENOMEM;
    all[0] = e;
    for (size_t i = 0; i < nr; i++)
        all[1 + i] = facts->relations[i];
    status = qdot_domain_unfold(pool, facts, 1 + nr, all, nr, false, &rest);
    for (size_t i = 0; i < rest.positive.n && !qdot_pool_failed(pool); i++)
        rest.positive.at[i] = qdot_rel(pool, QDOT_LT, QDOT_ZERO, rest.positive.at[i]);
    known.n_conditions = rest.positive.n;
    known.conditions = rest.positive.at;
    if (status == QDOT_OK && !qdot_pool_failed(pool) && !rest.empty && nr > 0)
        status = prove_by_cases(pool, all[0], strict, &known, work, proved, &at);
    if (status == QDOT_OK && !qdot_pool_failed(pool) && !rest.empty && !*proved)
        status = prove_by_derivatives(pool, all[0], strict, MOST_SLOPES, work, proved);
    qdot_free(rest.positive.at);
    qdot_free(all);
    return status == QDOT_OK ? qdot_grave(qdot_pool_check(pool)) : status;
}

qdot_status
qdot_inequality(qdot_pool *pool, qdot_expr e, bool strict, const qdot_facts *facts,
                bool *proved, qdot_expr *at)
{
    static const qdot_facts nothing = {0};
    int64_t work = ALL_WORK;

    *proved = false;
    *at = QDOT_NIL;
    if (e == QDOT_NIL || qdot_pool_failed(pool))
        return qdot_grave(qdot_pool_check(pool));
    if (facts == NULL)
        facts = &nothing;
    if (facts->n_relations == 0)
        QDOT_TRY(prove_by_cases(pool, e, strict, facts, &work, proved, at));
    if (*proved || *at != QDOT_NIL)
        return QDOT_OK;
    return prove_after_substitutions(pool, e, strict, facts, &work, proved);
}
