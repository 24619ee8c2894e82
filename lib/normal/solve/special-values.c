/* special-values.c -- parameter values at which divisors of a solution vanish. */
#include "normal/solve/special-values.h"

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "normal/prove/decide.h"
#include "normal/simplify/simplify.h"
#include "normal/solve/conditions.h"
#include "normal/solve/solve.h"

typedef struct {
    qdot_pool *pool;
    const qdot_facts *facts;
    qdot_special_values *out;
    qdot_expr where; /* parameter values already inserted */
} search;

void
qdot_special_values_clear(qdot_special_values *v)
{
    qdot_free(v->at.at);
    qdot_free(v->open.at);
    *v = (qdot_special_values){0};
}

size_t
qdot_special_sides(const qdot_pool *pool, qdot_expr where, qdot_expr *from, qdot_expr *to)
{
    uint32_t n = where == QDOT_NIL ? 0 : qdot_expr_count(pool, where);

    for (uint32_t i = 0; i < n; i++) {
        from[i] = qdot_expr_arg(pool, qdot_expr_arg(pool, where, i), 0);
        to[i] = qdot_expr_arg(pool, qdot_expr_arg(pool, where, i), 1);
    }
    return n;
}

static qdot_status find_common_zeros(search *s, uint32_t n, const qdot_expr *d, qdot_expr where);

/* Whether it is proved that d is never 0, by its sign; for a constant d by its value. */
static qdot_status
is_never_zero(const search *s, qdot_expr d, bool *yes)
{
    qdot_decision zero;

    *yes = (qdot_expr_node(s->pool, d)->sign & QDOT_NE0) != 0;
    if (*yes || !qdot_expr_is_constant(s->pool, d))
        return QDOT_OK;
    QDOT_TRY(qdot_decide_equal(s->pool, d, QDOT_ZERO, s->facts, &zero));
    *yes = zero.verdict == QDOT_REFUTED;
    return QDOT_OK;
}

/* Record the equation d = 0, which is not solved, unless d is never 0. */
static qdot_status
record_open_equation(search *s, qdot_expr d)
{
    qdot_expr equation = qdot_rel(s->pool, QDOT_EQ, d, QDOT_ZERO);
    bool never;

    QDOT_TRY(qdot_pool_check(s->pool));
    QDOT_TRY(is_never_zero(s, d, &never));
    if (never)
        return QDOT_OK;
    return qdot_expr_place(s->out->open.n, s->out->open.at, equation) < s->out->open.n
               ? QDOT_OK
               : qdot_vec_push(&s->out->open, equation);
}

/* Insert p = value, and find where the other divisors d [n] are 0, too. */
static qdot_status
find_zeros_at_value(search *s, qdot_expr p, qdot_expr value, uint32_t n, const qdot_expr *d,
                    qdot_expr where)
{
    qdot_pool *pool = s->pool;
    qdot_expr there[2], equation = qdot_rel(pool, QDOT_EQ, p, value);
    uint32_t had = where == QDOT_NIL ? 0 : qdot_expr_count(pool, where);
    qdot_expr all = QDOT_NIL;

    if (had + 1 > QDOT_SPECIAL_TOGETHER)
        return record_open_equation(s, qdot_sub(pool, p, value));
    for (uint32_t i = 0; i < had; i++) { /* insert the new value into the values found for other parameters */
        qdot_expr one = qdot_expr_arg(pool, where, i);

        all = qdot_conditions_and(
            pool, all,
            qdot_rel(pool, QDOT_EQ, qdot_expr_arg(pool, one, 0),
                     qdot_simplify(pool, qdot_subs(pool, qdot_expr_arg(pool, one, 1), 1, &p, &value),
                                   s->facts)));
    }
    all = qdot_conditions_and(pool, all, equation);
    for (uint32_t i = 0; i < n; i++)
        there[i] = qdot_subs(pool, d[i], 1, &p, &value);
    if (qdot_pool_failed(pool)) {
        qdot_status status = qdot_pool_check(pool);

        return status == QDOT_EDOMAIN ? QDOT_OK : status;
    }
    return find_common_zeros(s, n, there, all);
}

/* Solve d = s p + r = 0, where the coefficient s may be 0: p = -r/s, or s = 0 and r = 0. */
static qdot_status
find_zeros_of_linear(search *s, qdot_expr p, qdot_expr slope, qdot_expr rest, uint32_t n,
                     const qdot_expr *d, qdot_expr where)
{
    QDOT_TRY(find_zeros_at_value(s, p,
                                 qdot_simplify(s->pool, qdot_neg(s->pool, qdot_div(s->pool, rest, slope)), s->facts),
                                 n, d, where));
    return n > 0 ? record_open_equation(s, slope)
                 : find_common_zeros(s, 2, (qdot_expr[]){slope, rest}, where);
}

/* Whether the zeros of d recur after a full turn of p, whose domain is not bounded on both sides:
 * one turn is listed. */
static bool
zeros_recur_after_turn(qdot_pool *pool, qdot_expr d, qdot_expr p, const qdot_facts *facts)
{
    const qdot_window w = qdot_solve_window(pool, p, false);

    return (w.lo == QDOT_NIL || w.hi == QDOT_NIL) && qdot_is_angle(pool, d, p, facts);
}

/* One irreducible factor d is 0, and the others [n]: by a parameter that stands alone in it, or with a number as its
 * slope, or in which it is linear. */
static qdot_status
find_zeros_of_factor(search *s, qdot_expr d, uint32_t n, const qdot_expr *others, qdot_expr where)
{
    qdot_pool *pool = s->pool;
    qdot_expr atoms = qdot_expr_atoms(pool, d, false), linear = QDOT_NIL, zero = QDOT_ZERO;

    QDOT_TRY(qdot_pool_check(pool));
    for (uint32_t i = 0; i < qdot_expr_count(pool, atoms); i++) {
        qdot_expr p = qdot_expr_arg(pool, atoms, i), slope;
        qdot_solutions found = {0};
        qdot_status status;

        if (!qdot_expr_is_class(pool, p, QDOT_PARAM))
            continue;
        slope = qdot_diff(pool, d, p);
        QDOT_TRY(qdot_pool_check(pool));
        if (linear == QDOT_NIL && !qdot_expr_contains(pool, slope, p))
            linear = p;
        if (qdot_expr_rational(pool, slope) == NULL && qdot_expr_count(pool, atoms) > 1)
            continue;
        status = qdot_solve_inside(pool, d, p, QDOT_NIL, s->facts, &found);
        if (status == QDOT_OK && (!found.complete || (found.root.n > 0 && (found.root.at[0].value == p ||
                                                                          zeros_recur_after_turn(pool, d, p, s->facts)))))
            status = record_open_equation(s, d);
        for (size_t k = 0; k < found.root.n && status == QDOT_OK; k++)
            if (found.root.at[k].value != p)
                status = find_zeros_at_value(s, p, found.root.at[k].value, n, others, where);
        qdot_solutions_clear(&found);
        return status;
    }
    if (linear == QDOT_NIL)
        return record_open_equation(s, d);
    return find_zeros_of_linear(s, linear, qdot_diff(pool, d, linear),
                                qdot_subs(pool, d, 1, &linear, &zero), n, others, where);
}

/* Find the parameter values at which all divisors d [n] are 0; if n = 0 record the values of `where`. */
static qdot_status
find_common_zeros(search *s, uint32_t n, const qdot_expr *d, qdot_expr where)
{
    qdot_pool *pool = s->pool;
    qdot_expr factors, first;

    if (n == 0 && where == s->where) /* the divisors are 0 at all parameter values: none is special */
        return QDOT_OK;
    if (n == 0)
        return qdot_expr_place(s->out->at.n, s->out->at.at, where) < s->out->at.n ? QDOT_OK
                                                                   : qdot_vec_push(&s->out->at, where);
    first = qdot_simplify(pool, d[0], s->facts);
    QDOT_TRY(qdot_pool_check(pool));
    if (first == QDOT_ZERO)
        return find_common_zeros(s, n - 1, d + 1, where);
    if ((qdot_expr_node(pool, first)->sign & QDOT_NE0) != 0)
        return QDOT_OK;
    if (qdot_expr_is_constant(pool, first))
        return qdot_is_zero(pool, first, s->facts) ? find_common_zeros(s, n - 1, d + 1, where)
                                                   : qdot_pool_check(pool);
    if (!qdot_expr_is_scalar(pool, first) || qdot_expr_size(pool, first) > QDOT_SPECIAL_LONGEST)
        return record_open_equation(s, first);
    factors = qdot_solve_factors(pool, first);
    QDOT_TRY(qdot_pool_check(pool));
    for (uint32_t k = 0; k < qdot_expr_count(pool, factors); k++)
        QDOT_TRY(find_zeros_of_factor(s, qdot_expr_arg(pool, factors, k), n - 1, d + 1, where));
    return QDOT_OK;
}

qdot_status
qdot_special_values_add(qdot_pool *pool, size_t n, const qdot_expr *special, qdot_expr where,
                        const qdot_facts *facts, qdot_special_values *out)
{
    search s = {.pool = pool, .facts = facts, .out = out, .where = where};

    for (size_t i = 0; i < n; i++) {
        qdot_expr d = special[i], list[2] = {d, QDOT_NIL};
        uint32_t m = qdot_expr_kind(pool, d) == QDOT_LIST ? qdot_expr_count(pool, d) : 0;

        for (uint32_t k = 0; k < m && k < 2; k++)
            list[k] = qdot_expr_arg(pool, d, k);
        if (m > 2)
            QDOT_TRY(record_open_equation(&s, list[0]));
        else
            QDOT_TRY(find_common_zeros(&s, m == 0 ? 1 : m, list, where));
    }
    return QDOT_OK;
}
