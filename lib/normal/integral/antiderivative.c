/* antiderivative.c -- antiderivatives: found by the methods of integrate.c, proved by differentiation, case by case. */
#include "normal/integral/antiderivative.h"

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/function.h"
#include "expr/integral.h"
#include "expr/node.h"
#include "expr/polynomial/flint.h"
#include "expr/walk.h"
#include "normal/calculus/elliptic-forms.h"
#include "normal/calculus/switch.h"
#include "normal/field/budget.h"
#include "normal/integral/elliptic-algebraic.h"
#include "normal/integral/methods.h"
#include "normal/integral/piecewise.h"
#include "normal/prove/decide.h"
#include "normal/simplify/simplify.h"

/* Steps of one antiderivative, and constructor calls; both far beyond what an integral of a table needs. */
enum { EFFORT = 20000, MOST_FACTS = 16 };
#define CONSTRUCTIONS 4000000

struct search {
    qdot_pool *pool;
    qdot_expr e, x, F;
    const qdot_facts *facts;
    bool by_cases;
};

/* Whether dF/dx = e is proved under the conditions assumed. */
static bool
is_proved(qdot_pool *pool, qdot_expr F, qdot_expr e, qdot_expr x, const qdot_facts *facts)
{
    qdot_expr slope = qdot_diff(pool, F, x);
    qdot_decision d;

    if (slope == QDOT_NIL)
        return false;
    return slope == e || (qdot_decide_equal(pool, slope, e, facts, &d) == QDOT_OK && d.verdict == QDOT_PROVED);
}

/* The facts and the conditions assumed so far; the arrays hold as many as there is room for. */
static qdot_facts
with_conditions(const struct search *s, const qdot_integral_task *t, qdot_expr *conditions)
{
    qdot_facts facts = s->facts == NULL ? (qdot_facts){0} : *s->facts;
    size_t n = 0;

    for (; n < facts.n_conditions && n < MOST_FACTS; n++)
        conditions[n] = facts.conditions[n];
    for (size_t i = 0; i < t->asked; i++) {
        qdot_expr c = t->condition[i];

        conditions[n++] = t->holds[i] ? c
                                      : qdot_rel(s->pool, QDOT_LT, qdot_expr_arg(s->pool, c, 1), qdot_expr_arg(s->pool, c, 0));
    }
    facts.conditions = conditions;
    facts.n_conditions = n;
    return facts;
}

/* F without terms free of x. */
static qdot_expr
without_constants(qdot_pool *pool, qdot_expr F, qdot_expr x)
{
    qdot_expr sum = QDOT_ZERO, factor = QDOT_ONE, rest = F;

    if (qdot_expr_kind(pool, F) == QDOT_PROD)
        qdot_integral_split(pool, F, x, &factor, &rest);
    if (qdot_expr_kind(pool, rest) != QDOT_SUM)
        return F;
    for (uint32_t i = 1; i < qdot_expr_count(pool, rest); i += 2) {
        qdot_expr term = qdot_expr_arg(pool, rest, i);

        if (qdot_expr_contains(pool, term, x))
            sum = qdot_add(pool, sum, qdot_mul(pool, without_constants(pool, term, x), qdot_expr_arg(pool, rest, i + 1)));
    }
    return qdot_mul(pool, factor, sum);
}

/* The antiderivative with the signs as in t->holds; t->condition [t->asked]: the conditions on which its form depends. */
static qdot_expr
find_case(const struct search *s, qdot_integral_task *t)
{
    qdot_expr conditions[MOST_FACTS + QDOT_INTEGRAL_SIGNS], F;
    qdot_facts facts;

    t->asked = 0;
    t->failed = false;
    t->fresh = 0;
    F = qdot_integral_any(t, s->e, s->x, 0);
    if (F == QDOT_NIL || qdot_pool_failed(s->pool))
        return QDOT_NIL;
    facts = with_conditions(s, t, conditions);
    if (!is_proved(s->pool, F, s->e, s->x, &facts))
        return QDOT_NIL;
    if (s->by_cases) {
        qdot_expr shorter = qdot_simplify(s->pool, without_constants(s->pool, F, s->x), &facts);

        if (shorter != QDOT_NIL && shorter != F && is_proved(s->pool, shorter, s->e, s->x, &facts))
            F = shorter;
    }
    return F;
}

static qdot_expr find_cases(const struct search *s, qdot_integral_task *t, size_t depth);

/* All cases from the sign number `depth` on, as if(CONDITION, F, G); F is that in which all of them are positive, just
 * found. */
static qdot_expr
add_other_cases(const struct search *s, qdot_integral_task *t, size_t depth, qdot_expr F)
{
    qdot_expr G, condition;

    if (t->asked <= depth || F == QDOT_NIL)
        return F;
    condition = t->condition[depth];
    F = add_other_cases(s, t, depth + 1, F);
    if (F == QDOT_NIL)
        return F;
    t->holds[depth] = false;
    G = find_cases(s, t, depth + 1);
    t->holds[depth] = true;
    if (G == QDOT_NIL)
        return G;
    return F == G ? F : qdot_fun(s->pool, QDOT_IF, 3, (qdot_expr[]){condition, F, G});
}

/* All cases from the sign number `depth` on, those before as in t->holds. */
static qdot_expr
find_cases(const struct search *s, qdot_integral_task *t, size_t depth)
{
    for (size_t i = depth; i < QDOT_INTEGRAL_SIGNS; i++)
        t->holds[i] = true;
    return add_other_cases(s, t, depth, find_case(s, t));
}

static void
search_antiderivative(void *user)
{
    struct search *s = user;
    qdot_integral_task t = {.pool = s->pool, .facts = s->facts, .may_assume = s->by_cases, .effort = EFFORT};

    s->F = find_cases(s, &t, 0);
}

static qdot_expr
find_antiderivative(qdot_pool *pool, qdot_expr e, qdot_expr x, const qdot_facts *facts, bool by_cases)
{
    struct search s = {pool, e, x, QDOT_NIL, facts, by_cases};
    qdot_budget budget;
    qdot_status status;

    if (e == QDOT_NIL || qdot_pool_failed(pool))
        return QDOT_NIL;
    budget = qdot_budget_begin(pool, CONSTRUCTIONS);
    status = qdot_flint_run(pool, search_antiderivative, &s);
    qdot_budget_end(pool, &budget);
    if (qdot_grave(status) != QDOT_OK)
        return qdot_pool_fail(pool);
    if (status != QDOT_OK || qdot_pool_failed(pool)) {
        status = qdot_pool_check(pool);
        if (qdot_grave(status) != QDOT_OK)
            return qdot_pool_fail(pool);
        return QDOT_NIL;
    }
    return s.F;
}

/* The same by the method that fits; what has kinks or steps may be smooth as a whole, and is integrated piece by piece
 * where it is not. A piece is found by `find`. */
static qdot_expr
find_pieces(qdot_pool *pool, qdot_expr e, qdot_expr x, const qdot_facts *facts, qdot_piece_find *find, bool by_cases)
{
    qdot_expr F = QDOT_NIL;

    if (e == QDOT_NIL || qdot_pool_failed(pool))
        return QDOT_NIL;
    if (!qdot_piecewise_kinks(pool, e, x) && !qdot_piecewise_steps(pool, e, x))
        return find_antiderivative(pool, e, x, facts, by_cases);
    if (!qdot_piecewise_steps(pool, e, x))
        F = find_antiderivative(pool, e, x, facts, by_cases);
    if (F != QDOT_NIL && qdot_has_steps(pool, F, x)) /* it may jump */
        F = QDOT_NIL;
    if (F == QDOT_NIL && !qdot_pool_failed(pool))
        e = qdot_piecewise_waves(pool, e, x);
    if (F == QDOT_NIL && qdot_piecewise_kinks(pool, e, x))
        F = qdot_kinks_antiderivative(pool, e, x, facts, find);
    if (F == QDOT_NIL && qdot_piecewise_steps(pool, e, x))
        F = qdot_steps_antiderivative(pool, e, x, facts, find);
    if (qdot_grave(qdot_pool_check(pool)) != QDOT_OK)
        return qdot_pool_fail(pool);
    return F;
}

qdot_expr
qdot_antiderivative(qdot_pool *pool, qdot_expr e, qdot_expr x, const qdot_facts *facts)
{
    return find_pieces(pool, e, x, facts, qdot_antiderivative, false);
}

qdot_expr
qdot_antiderivative_by_cases(qdot_pool *pool, qdot_expr e, qdot_expr x, const qdot_facts *facts)
{
    qdot_expr F = find_pieces(pool, e, x, facts, qdot_antiderivative_by_cases, true);

    if (F == QDOT_NIL && !qdot_pool_failed(pool))
        F = qdot_elliptic_antiderivative(pool, e, x, facts);
    return F == QDOT_NIL && !qdot_pool_failed(pool) ? qdot_elliptic_algebraic(pool, e, x, facts) : F;
}

qdot_expr
qdot_antiderivative_or_integral(qdot_pool *pool, qdot_expr e, qdot_expr x, const qdot_facts *facts)
{
    qdot_expr F = qdot_antiderivative_by_cases(pool, e, x, facts), left = QDOT_ZERO, free, rest;
    bool sum;

    if (F != QDOT_NIL || qdot_pool_failed(pool))
        return F;
    rest = qdot_expand(pool, e);
    sum = rest != QDOT_NIL && qdot_expr_kind(pool, rest) == QDOT_SUM;
    F = QDOT_ZERO;
    for (uint32_t i = 0; sum && i < qdot_expr_count(pool, rest); i += i == 0 ? 1 : 2) {
        qdot_expr term = qdot_expr_arg(pool, rest, i), part;

        if (i > 0)
            term = qdot_mul(pool, term, qdot_expr_arg(pool, rest, i + 1));
        part = qdot_antiderivative_by_cases(pool, term, x, facts);
        *(part == QDOT_NIL ? &left : &F) = qdot_add(pool, part == QDOT_NIL ? left : F, part == QDOT_NIL ? term : part);
    }
    if (!sum || F == QDOT_ZERO)
        left = e;
    qdot_integral_split(pool, left, x, &free, &rest);
    return qdot_add(pool, F, qdot_mul(pool, free, qdot_integral_unfound(pool, rest, x)));
}

qdot_expr
qdot_potential_of(qdot_pool *pool, size_t n, const qdot_expr *x, const qdot_expr *a,
                  const qdot_facts *facts)
{
    qdot_expr F = QDOT_ZERO;

    for (size_t i = 0; i < n && F != QDOT_NIL; i++) {
        qdot_expr rest = qdot_sub(pool, a[i], qdot_diff(pool, F, x[i])), part;

        rest = qdot_simplify(pool, rest, facts);
        if (rest == QDOT_ZERO)
            continue;
        part = qdot_antiderivative(pool, rest, x[i], facts);
        F = part == QDOT_NIL ? QDOT_NIL : qdot_add(pool, F, part);
    }
    if (F == QDOT_NIL)
        return F;
    F = qdot_simplify(pool, F, facts);
    for (size_t i = 0; i < n && F != QDOT_NIL; i++)
        if (!qdot_is_zero(pool, qdot_sub(pool, a[i], qdot_diff(pool, F, x[i])), facts))
            return QDOT_NIL;
    return F;
}
