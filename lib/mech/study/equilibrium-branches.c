/* equilibrium-branches.c -- the equations at rest, solved one unknown at a time, factor by
 * factor. */
#include <math.h>

#include "base/interrupt.h"
#include "mech/dynamics/generic.h"
#include "mech/scene/access.h"
#include "mech/study/equilibrium-search.h"
#include "normal/prove/decide.h"
#include "normal/simplify/positive.h"
#include "normal/simplify/simplify.h"
#include "normal/solve/solve.h"

enum { MOST_SOLUTIONS = 1024 };

/* --- lists ----------------------------------------------------------------------- */

qdot_expr
qdot_rest_appended(qdot_pool *pool, qdot_expr list, size_t n, const qdot_expr *more)
{
    uint32_t old = list == QDOT_NIL ? 0 : qdot_expr_count(pool, list);
    qdot_expr *all = qdot_malloc((old + n + 1) * sizeof *all);

    if (all == NULL)
        return qdot_pool_fail(pool);
    for (uint32_t i = 0; i < old; i++)
        all[i] = qdot_expr_arg(pool, list, i);
    for (size_t i = 0; i < n; i++)
        all[old + i] = more[i];
    list = qdot_list(pool, (uint32_t)(old + n), all);
    qdot_free(all);
    return list;
}

static size_t
holds_unknowns(const qdot_rest *r, qdot_expr e)
{
    size_t n = 0;

    for (size_t i = 0; i < r->unknowns.n; i++)
        n += qdot_expr_contains(r->pool, e, r->unknowns.at[i]);
    return n;
}

/* --- one step of a branch ------------------------------------------------------------ */

/* How hard it is to solve a factor for an unknown: 0 the only one in it; 1 linear, never
 * divided by anything unknown; 2 linear; 3 else; 9 not there. */
static int
effort(const qdot_rest *r, qdot_expr factor, qdot_expr u)
{
    qdot_expr slope;

    if (!qdot_expr_contains(r->pool, factor, u))
        return 9;
    if (holds_unknowns(r, factor) == 1)
        return 0;
    slope = qdot_diff(r->pool, factor, u);
    if (slope == QDOT_NIL || qdot_expr_contains(r->pool, slope, u))
        return 3;
    return holds_unknowns(r, slope) == 0 ? 1 : 2;
}

/* The easiest unknown of a factor, multipliers before coordinates. */
static int
easiest(const qdot_rest *r, qdot_expr factor, size_t *which)
{
    int least = 9;

    for (size_t i = r->unknowns.n; i-- > 0;) {
        int one = effort(r, factor, r->unknowns.at[i]);

        if (one < least) {
            least = one;
            *which = i;
        }
    }
    return least;
}

/* The branch with u = value put in everywhere. */
static qdot_status
with_value(qdot_rest *r, const qdot_rest_branch *b, qdot_expr equations, qdot_expr u,
           const qdot_root *root)
{
    qdot_pool *pool = r->pool;
    qdot_expr equation = qdot_rel(pool, QDOT_EQ, u, root->value);
    qdot_rest_branch next = {qdot_subs(pool, equations, 1, &u, &root->value),
                             qdot_subs(pool, b->known, 1, &u, &root->value),
                             qdot_subs(pool, b->conditions, 1, &u, &root->value)};
    uint32_t n = qdot_expr_count(pool, b->known);
    qdot_expr *known;

    if (qdot_pool_failed(pool)) { /* a denominator is 0 there: no solution */
        qdot_status status = qdot_pool_check(pool);

        return status == QDOT_EDOMAIN ? QDOT_OK : status;
    }
    /* unknowns stand on the left of `known`, so they stay */
    known = qdot_malloc((n + 1) * sizeof *known);
    if (known == NULL)
        return QDOT_ENOMEM;
    for (uint32_t i = 0; i < n; i++)
        known[i] = qdot_expr_arg(pool, next.known, i);
    known[n] = equation;
    next.known = qdot_list(pool, n + 1, known);
    qdot_free(known);
    for (uint32_t i = 0;
         root->condition != QDOT_NIL && i < qdot_expr_count(pool, root->condition); i++) {
        qdot_expr one = qdot_expr_arg(pool, root->condition, i);

        next.conditions = qdot_rest_appended(pool, next.conditions, 1, &one);
    }
    QDOT_TRY(qdot_pool_check(pool));
    return qdot_vec_push(&r->todo, next);
}

/* factor = 0 for its easiest unknown; where it is a u + b with unknowns in a, also a = b = 0. */
static qdot_status
split(qdot_rest *r, const qdot_rest_branch *b, qdot_expr others, qdot_expr factor)
{
    qdot_pool *pool = r->pool;
    qdot_root *roots = NULL;
    size_t n = 0, which = 0;
    bool complete = true;
    int how = easiest(r, factor, &which);
    qdot_expr u = r->unknowns.at[which], zero = QDOT_ZERO;
    qdot_status status;

    if (how == 9) /* a factor without unknowns: generic parameters, not 0 */
        return QDOT_OK;
    status = qdot_solve(pool, factor, u, &r->facts, &roots, &n, &complete);
    r->complete = r->complete && complete;
    for (size_t i = n; i-- > 0 && status == QDOT_OK;)
        status = with_value(r, b, others, u, &roots[i]);
    qdot_free(roots);
    if (status == QDOT_OK && how == 2) {
        qdot_expr both[2] = {qdot_diff(pool, factor, u),
                             qdot_subs(pool, factor, 1, &u, &zero)};
        qdot_rest_branch next = *b;

        next.equations = qdot_rest_appended(pool, others, 2, both);
        status = qdot_pool_check(pool);
        if (status == QDOT_OK)
            status = qdot_vec_push(&r->todo, next);
    }
    return status;
}

qdot_expr
qdot_rest_conditions_left(const qdot_rest *r, qdot_expr conditions)
{
    qdot_pool *pool = r->pool;
    qdot_expr left = QDOT_NIL;

    for (uint32_t i = 0; i < qdot_expr_count(pool, conditions); i++) {
        qdot_expr one = qdot_expr_arg(pool, conditions, i);
        bool there = false;

        if (one == QDOT_TRUE)
            continue;
        if (one == QDOT_FALSE)
            return QDOT_FALSE;
        one = qdot_positive(pool, qdot_positive_of(pool, one), &r->facts, 0, NULL);
        if (one == QDOT_FALSE || one == QDOT_NIL)
            return one;
        for (uint32_t k = 0; left != QDOT_NIL && k < qdot_expr_count(pool, left); k++)
            there |= qdot_expr_arg(pool, left, k) == one;
        if (one != QDOT_TRUE && !there)
            left = qdot_rest_appended(pool, left, 1, &one);
    }
    return left;
}

bool
qdot_rest_is_angle(const qdot_rest *r, qdot_expr u, qdot_expr equations)
{
    qdot_pool *pool = r->pool;
    qdot_expr turn = qdot_mul(pool, qdot_expr_int(pool, 2), QDOT_PI),
              shifted = qdot_add(pool, u, turn);

    shifted = qdot_subs(pool, equations, 1, &u, &shifted);
    for (uint32_t i = 0; shifted != QDOT_NIL && i < qdot_expr_count(pool, equations); i++)
        if (!qdot_is_zero(pool,
                          qdot_sub(pool, qdot_expr_arg(pool, shifted, i),
                                   qdot_expr_arg(pool, equations, i)),
                          &r->facts))
            return false;
    return shifted != QDOT_NIL;
}

/* An angle beyond -pi < q <= pi that came of others: turned back where the equations allow it. */
static qdot_expr
turned(const qdot_rest *r, qdot_expr u, qdot_expr value, qdot_expr equations)
{
    qdot_pool *pool = r->pool;
    const qdot_symbol *x = qdot_expr_symbol(pool, u);
    qdot_expr turn = qdot_mul(pool, qdot_expr_int(pool, 2), QDOT_PI);
    double v;

    if (x->class != QDOT_COORD || x->lo != QDOT_NIL || x->hi != QDOT_NIL ||
        qdot_mech_holds(r->s, value) & ~(uint32_t)QDOT_HAS_FUN ||
        !qdot_expr_contains(pool, value, QDOT_PI) ||
        qdot_generic_evaluate(pool, 1, &value, NULL, &v) != QDOT_OK ||
        !isfinite(v) || !qdot_rest_is_angle(r, u, equations))
        return value;
    for (; v > M_PI + 1e-9; v -= 2 * M_PI)
        value = qdot_sub(pool, value, turn);
    for (; v <= -M_PI + 1e-9; v += 2 * M_PI)
        value = qdot_add(pool, value, turn);
    return value;
}

/* The conditions of a branch, and that each value lies within the domain of its coordinate: a
 * rational one of the parameters, an angle does. */
static qdot_expr
with_domains(const qdot_rest *r, const qdot_rest_branch *b)
{
    qdot_pool *pool = r->pool;
    qdot_expr all = b->conditions;

    for (uint32_t k = 0; k < qdot_expr_count(pool, b->known); k++) {
        qdot_expr u = qdot_expr_arg(pool, qdot_expr_arg(pool, b->known, k), 0),
                  value = qdot_expr_arg(pool, qdot_expr_arg(pool, b->known, k), 1);
        const qdot_symbol *x = qdot_expr_symbol(pool, u);
        qdot_expr side[2] = {QDOT_NIL, QDOT_NIL};

        if (x->class != QDOT_COORD ||
            (qdot_mech_holds(r->s, value) & ~(uint32_t)QDOT_HAS_PARAM) != 0)
            continue;
        if (x->lo != QDOT_NIL)
            side[0] = qdot_rel(pool, x->lo_open ? QDOT_LT : QDOT_LE, x->lo, value);
        if (x->hi != QDOT_NIL)
            side[1] = qdot_rel(pool, x->hi_open ? QDOT_LT : QDOT_LE, value, x->hi);
        for (int i = 0; i < 2; i++)
            if (side[i] != QDOT_NIL)
                all = qdot_rest_appended(pool, all, 1, &side[i]);
    }
    return all;
}

qdot_expr
qdot_rest_put(const qdot_rest *r, qdot_expr e, qdot_expr values)
{
    uint32_t n = qdot_expr_count(r->pool, values);
    qdot_expr *from = qdot_malloc((2 * (size_t)n + 1) * sizeof *from);

    if (from == NULL)
        return qdot_pool_fail(r->pool);
    for (uint32_t i = 0; i < n; i++) {
        from[i] = qdot_expr_arg(r->pool, qdot_expr_arg(r->pool, values, i), 0);
        from[n + i] = qdot_expr_arg(r->pool, qdot_expr_arg(r->pool, values, i), 1);
    }
    e = qdot_subs(r->pool, e, n, from, from + n);
    qdot_free(from);
    return e;
}

/* Whether the equations have values there: that a numerator vanishes is not enough. */
static qdot_status
are_defined(const qdot_rest *r, qdot_expr equations, qdot_expr values, bool *yes)
{
    qdot_status status;

    (void)qdot_rest_put(r, equations, values);
    status = qdot_pool_check(r->pool);
    *yes = status == QDOT_OK;
    return status == QDOT_EDOMAIN ? QDOT_OK : status;
}

/* The known values in the order of the unknowns. */
static qdot_status
emit(qdot_rest *r, const qdot_rest_branch *b)
{
    qdot_pool *pool = r->pool;
    qdot_equilibrium e = {.exists = QDOT_NIL};
    qdot_expr *list;
    bool yes = true;
    size_t n = 0;

    e.exists = qdot_rest_conditions_left(r, with_domains(r, b));
    QDOT_TRY(qdot_pool_check(pool));
    if (e.exists == QDOT_FALSE)
        return QDOT_OK;
    list = qdot_malloc((r->unknowns.n + 1) * sizeof *list);
    if (list == NULL)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < r->unknowns.n; i++)
        for (uint32_t k = 0; k < qdot_expr_count(pool, b->known); k++) {
            qdot_expr one = qdot_expr_arg(pool, b->known, k),
                      u = qdot_expr_arg(pool, one, 0);

            if (u != r->unknowns.at[i])
                continue;
            list[n++] = qdot_rel(
                pool, QDOT_EQ, u,
                turned(r, u, qdot_simplify(pool, qdot_expr_arg(pool, one, 1), &r->facts),
                       r->equations));
        }
    e.equations = qdot_list(pool, (uint32_t)n, list);
    qdot_free(list);
    QDOT_TRY(qdot_pool_check(pool));
    QDOT_TRY(are_defined(r, r->equations, e.equations, &yes));
    for (size_t i = 0; yes && i < r->found.n; i++)
        yes = r->found.at[i].equations != e.equations;
    if (!yes)
        return QDOT_OK;
    if (r->found.n >= MOST_SOLUTIONS)
        return qdot_fail(QDOT_ELIMIT, "the scene has more than %d equilibria",
                         MOST_SOLUTIONS);
    return qdot_vec_push(&r->found, e);
}

/* The factors of every equation; the one whose hardest factor is easiest. *dead: one of them is
 * never 0. */
static qdot_status
choose(qdot_rest *r, qdot_expr equations, qdot_expr *factors, qdot_expr *others,
       bool *dead)
{
    qdot_pool *pool = r->pool;
    uint32_t n = qdot_expr_count(pool, equations), best = 0, count = 0;
    qdot_expr *left = qdot_calloc(n + 1, sizeof *left), chosen = QDOT_NIL;
    int least = 10;
    size_t which;

    *dead = false;
    if (left == NULL)
        return QDOT_ENOMEM;
    for (uint32_t i = 0; i < n && !*dead; i++) {
        qdot_expr e = qdot_simplify(pool, qdot_expr_arg(pool, equations, i), &r->facts),
                  list;
        int hardest = 0;

        if (e == QDOT_ZERO || e == QDOT_NIL || qdot_is_zero(pool, e, &r->facts))
            continue;
        list = qdot_solve_factors(pool, e);
        if (list == QDOT_NIL)
            break;
        *dead = holds_unknowns(r, e) == 0;
        for (uint32_t k = 0; k < qdot_expr_count(pool, list); k++) {
            int one = easiest(r, qdot_expr_arg(pool, list, k), &which);

            if (one < 9 && one > hardest)
                hardest = one;
        }
        left[count++] = e;
        if (hardest < least) {
            least = hardest;
            best = count - 1;
            chosen = list;
        }
    }
    *factors = count == 0 ? QDOT_NIL : chosen;
    if (count > 0)
        left[best] = left[count - 1];
    *others = qdot_list(pool, count == 0 ? 0 : count - 1, left);
    qdot_free(left);
    return qdot_pool_check(pool);
}

static qdot_status
step(qdot_rest *r, const qdot_rest_branch *b)
{
    qdot_expr factors, others;
    bool dead;

    QDOT_TRY(qdot_interrupt_check());
    QDOT_TRY(choose(r, b->equations, &factors, &others, &dead));
    if (dead)
        return QDOT_OK;
    if (factors == QDOT_NIL)
        return emit(r, b);
    for (uint32_t k = qdot_expr_count(r->pool, factors); k-- > 0;)
        QDOT_TRY(split(r, b, others, qdot_expr_arg(r->pool, factors, k)));
    return QDOT_OK;
}

/* Charge a step on these equations, whose factors and forms take more than their length; false when
 * the budget is spent. */
static bool
charge(qdot_rest *r, qdot_expr equations)
{
    uint64_t size = qdot_expr_size(r->pool, equations), work;

    if (size > r->work)
        return false;
    work = 1 + size + size * size / 10;
    if (work > r->work)
        return false;
    r->work -= work;
    return true;
}

qdot_status
qdot_rest_solve(qdot_rest *r)
{
    qdot_status status = QDOT_OK;

    while (status == QDOT_OK && r->todo.n > 0) {
        qdot_rest_branch b = r->todo.at[--r->todo.n];

        if (!charge(r, b.equations)) {
            r->complete = false;
            r->todo.n = 0;
            break;
        }
        status = step(r, &b);
    }
    return status;
}
