/* solve-inverse.c -- elementary functions inverted: g(u(x)) = v becomes u(x) = w. */
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/elementary.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/walk.h"
#include "normal/solve/powers.h"
#include "normal/solve/solver.h"

/* --- equations for angles -------------------------------------------------------------- */

/* Solve u(x) = w + 2 pi k for every integer k, where u is linear in x. */
static qdot_status
solve_up_to_turns(qdot_solver *s, qdot_expr u, qdot_expr w, qdot_expr when)
{
    qdot_pool *pool = s->pool;
    qdot_expr c = qdot_solver_tidy(s, qdot_diff(pool, u, s->x)), zero = QDOT_ZERO, base, period;

    QDOT_TRY(qdot_pool_check(pool));
    if (c == QDOT_ZERO || qdot_expr_contains(pool, c, s->x)) {
        s->out->complete = false;
        return QDOT_OK;
    }
    QDOT_TRY(qdot_solver_divide(s, c));
    base = qdot_div(pool, qdot_sub(pool, w, qdot_subs(pool, u, 1, &s->x, &zero)), c);
    period = qdot_div(pool, qdot_mul(pool, qdot_expr_int(pool, 2), QDOT_PI), c);
    if (period != QDOT_NIL && qdot_expr_is_negative(pool, period))
        period = qdot_neg(pool, period);
    return qdot_solver_add(s, base, period, when);
}

qdot_status
qdot_solver_turns(qdot_solver *s, qdot_expr u, size_t n, const qdot_expr *w, qdot_expr when)
{
    for (size_t i = 0; i < n; i++)
        QDOT_TRY(solve_up_to_turns(s, u, w[i], when));
    return QDOT_OK;
}

/* Solve sin u = v or cos u = v. */
static qdot_status
solve_sine_or_cosine(qdot_solver *s, bool sine, qdot_expr u, qdot_expr v, qdot_expr when)
{
    qdot_pool *pool = s->pool;
    qdot_expr angle = qdot_fun1(pool, sine ? QDOT_ASIN : QDOT_ACOS, v);

    if (angle == QDOT_NIL) { /* the inverse function is undefined: |v| > 1 */
        qdot_status status = qdot_pool_check(pool);

        return status == QDOT_EDOMAIN ? QDOT_OK : status;
    }
    if (v == QDOT_ONE || v == QDOT_MINUS_ONE)
        return solve_up_to_turns(s, u, angle, when);
    when = qdot_conditions_and(pool, when,
                               qdot_solver_positive(s, qdot_sub(pool, QDOT_ONE, v)));
    when = qdot_conditions_and(pool, when,
                               qdot_solver_positive(s, qdot_add(pool, QDOT_ONE, v)));
    if (when == QDOT_FALSE)
        return qdot_pool_check(pool);
    return qdot_solver_turns(
        s, u, 2,
        (qdot_expr[]){angle, sine ? qdot_sub(pool, QDOT_PI, angle) : qdot_neg(pool, angle)},
        when);
}

/* The solution u of tan(u/2) = a/b, by the function atan2. */
static qdot_expr
double_arc_tangent(qdot_pool *pool, qdot_expr a, qdot_expr b)
{
    qdot_expr two = qdot_expr_int(pool, 2);

    if ((qdot_expr_node(pool, b)->sign & QDOT_NE0) != 0)
        return qdot_mul(pool, two, qdot_fun1(pool, QDOT_ATAN, qdot_div(pool, a, b)));
    if ((qdot_expr_node(pool, a)->sign & QDOT_NE0) != 0)
        return qdot_sub(pool, QDOT_PI, qdot_mul(pool, two, qdot_fun1(pool, QDOT_ATAN, qdot_div(pool, b, a))));
    return qdot_mul(pool, two, qdot_fun(pool, QDOT_ATAN2, 2, (qdot_expr[]){a, b}));
}

/* a sin u + b cos u + d = 0 where one of the coefficients is d or -d: a quarter of the circle solves it whatever the
 * other one is, and beside it one angle by its half: a sin u = b (1 - cos u) for sin(u/2) = 0 and for tan(u/2) = a/b.
 * *at: the first; nil: it is not so. The sum of arc functions of the general form would hide a root at an end of a
 * domain. */
static qdot_status
solve_with_quarter_turn(const qdot_solver *s, qdot_expr a, qdot_expr b, qdot_expr d, qdot_expr *at, qdot_expr *beside)
{
    qdot_pool *pool = s->pool;
    qdot_expr quarter = qdot_mul(pool, QDOT_HALF, QDOT_PI), minus_b = qdot_neg(pool, b);
    struct {
        qdot_expr zero, at, over, below;
    } cases[] = {{qdot_add(pool, b, d), QDOT_ZERO, a, b},
                 {qdot_sub(pool, b, d), QDOT_PI, a, b},
                 {qdot_add(pool, a, d), quarter, minus_b, a},
                 {qdot_sub(pool, a, d), qdot_neg(pool, quarter), minus_b, a}};

    *at = QDOT_NIL;
    for (size_t i = 0; i < sizeof cases / sizeof *cases && *at == QDOT_NIL; i++) {
        if (qdot_solver_tidy(s, cases[i].zero) != QDOT_ZERO)
            continue;
        *at = cases[i].at;
        *beside = qdot_add(
            pool, cases[i].at,
            double_arc_tangent(pool, qdot_solver_tidy(s, cases[i].over), qdot_solver_tidy(s, cases[i].below)));
    }
    return qdot_pool_check(pool);
}

/* Solve a sin u + b cos u + d = 0: R cos(u - atan2(a, b)) = -d with R = sqrt(a^2 + b^2). */
qdot_status
qdot_solver_mixed(qdot_solver *s, qdot_expr u, qdot_expr a, qdot_expr b, qdot_expr d,
                  qdot_expr when)
{
    qdot_pool *pool = s->pool;
    qdot_expr R, shift, v, at, beside;

    if (d == QDOT_ZERO) {
        qdot_expr w = qdot_fun1(pool, QDOT_ATAN,
                                qdot_solver_tidy(s, qdot_neg(pool, qdot_div(pool, b, a))));

        QDOT_TRY(qdot_solver_divide(s, a));
        return qdot_solver_turns(s, u, 2, (qdot_expr[]){w, qdot_add(pool, w, QDOT_PI)}, when);
    }
    QDOT_TRY(qdot_solver_divide(s, qdot_list(pool, 2, (qdot_expr[]){a, b})));
    QDOT_TRY(solve_with_quarter_turn(s, a, b, d, &at, &beside));
    if (at != QDOT_NIL)
        return qdot_solver_turns(s, u, 2, (qdot_expr[]){at, beside}, when);
    R = qdot_add(pool, qdot_mul(pool, a, a), qdot_mul(pool, b, b));
    when = qdot_conditions_and(
        pool, when,
        qdot_solver_positive(s, qdot_solver_tidy(s, qdot_sub(pool, R, qdot_mul(pool, d, d)))));
    if (when == QDOT_FALSE)
        return qdot_pool_check(pool);
    v = qdot_solver_tidy(s, qdot_div(pool, qdot_neg(pool, d), qdot_sqrt(pool, R)));
    shift = qdot_fun(pool, QDOT_ATAN2, 2, (qdot_expr[]){a, b});
    v = qdot_fun1(pool, QDOT_ACOS, v);
    QDOT_TRY(qdot_pool_check(pool));
    return qdot_solver_turns(
        s, u, 2, (qdot_expr[]){qdot_add(pool, shift, v), qdot_sub(pool, shift, v)}, when);
}

/* --- equations for other functions ----------------------------------------------------- */

/* The set of conditions with lo < v < hi (<= at an end that is not open); a nil end adds nothing. */
static qdot_expr
add_range_conditions(qdot_solver *s, qdot_expr when, qdot_expr v, qdot_expr lo, qdot_expr hi, bool lo_open, bool hi_open)
{
    qdot_pool *pool = s->pool;

    if (lo != QDOT_NIL)
        when = qdot_conditions_and(
            pool, when, qdot_condition(pool, qdot_sub(pool, v, lo), lo_open, s->facts));
    if (hi != QDOT_NIL)
        when = qdot_conditions_and(
            pool, when, qdot_condition(pool, qdot_sub(pool, hi, v), hi_open, s->facts));
    return when;
}

/* An end of the range of values of a function; nil if there is none. */
static qdot_expr
range_end(qdot_pool *pool, const qdot_fun_end *end)
{
    if (!end->known)
        return QDOT_NIL;
    return end->angle ? qdot_mul(pool, qdot_expr_ratio(pool, end->number, 2), QDOT_PI)
                      : qdot_expr_int(pool, end->number);
}

/* The set of conditions with the conditions under which v lies in the range of the function h. */
static qdot_expr
add_function_range(qdot_solver *s, qdot_fun_id h, qdot_expr when, qdot_expr v)
{
    const qdot_fun_facts *f = qdot_fun_facts_of(h);

    return add_range_conditions(s, when, v, range_end(s->pool, &f->lo), range_end(s->pool, &f->hi),
                                f->lo.open, f->hi.open);
}

/* Solve floor(u) = v: v <= u < v + 1 for an integer v. */
static qdot_status
solve_floor(qdot_solver *s, qdot_expr u, qdot_expr v, qdot_expr when)
{
    qdot_pool *pool = s->pool;
    const fmpq *number = qdot_expr_rational(pool, v);

    if (number == NULL) {
        s->out->complete = false;
        return QDOT_OK;
    }
    if (!fmpz_is_one(fmpq_denref(number)))
        return QDOT_OK;
    when = qdot_conditions_and(pool, when, qdot_rel(pool, QDOT_LE, v, u));
    when = qdot_conditions_and(pool, when,
                               qdot_rel(pool, QDOT_LT, u, qdot_add(pool, v, QDOT_ONE)));
    return qdot_solver_add(s, s->x, QDOT_NIL, when);
}

qdot_status
qdot_solver_invert(qdot_solver *s, qdot_expr g, qdot_expr v, qdot_expr when)
{
    qdot_pool *pool = s->pool;
    qdot_fun_id h = qdot_expr_node(pool, g)->op;
    qdot_expr u = qdot_expr_arg(pool, g, 0), w;

    if (h == QDOT_SIN || h == QDOT_COS)
        return solve_sine_or_cosine(s, h == QDOT_SIN, u, v, when);
    if (h == QDOT_FLOOR)
        return solve_floor(s, u, v, when);
    when = add_function_range(s, h, when, v);
    QDOT_TRY(qdot_pool_check(pool));
    if (when == QDOT_FALSE)
        return QDOT_OK;
    if (qdot_fun_facts_of(h)->inverse == QDOT_FUNCTION_KINDS) {
        s->out->complete = false;
        return QDOT_OK;
    }
    w = qdot_fun1(pool, qdot_fun_facts_of(h)->inverse, v);
    QDOT_TRY(qdot_solver_equation(s, qdot_sub(pool, u, w), when));
    return qdot_fun_is(h, QDOT_FUN_EVEN) ? qdot_solver_equation(s, qdot_add(pool, u, w), when) : QDOT_OK;
}

/* --- powers -------------------------------------------------------------------------------- */

qdot_status
qdot_solver_power(qdot_solver *s, qdot_expr e, qdot_expr when, bool *done)
{
    qdot_pool *pool = s->pool;
    qdot_powers p = {.unknowns = 1, .unknown = &s->x};
    const qdot_expr with = qdot_powers_replace(pool, &p, e);
    const fmpq *exponent = p.n == 1 ? qdot_expr_rational(pool, p.exponent[0]) : NULL;
    qdot_expr a, b, v, condition;

    *done = exponent != NULL && !fmpz_is_pm1(fmpq_numref(exponent)) && !qdot_expr_contains(pool, with, s->x) &&
            qdot_is_linear_in(pool, with, 1, p.symbol, &a, &b);
    if (!*done)
        return qdot_pool_check(pool);
    v = qdot_solver_tidy(s, qdot_neg(pool, qdot_div(pool, b, a)));
    QDOT_TRY(qdot_pool_check(pool));
    *done = qdot_powers_invert(pool, &p, 0, v, s->facts, &e, &condition);
    if (!*done)
        return QDOT_OK;
    QDOT_TRY(qdot_solver_divide(s, a));
    return qdot_solver_equation(s, e, qdot_conditions_and(pool, when, condition));
}
