/* constant.c -- a constant in balls (Arb) of growing precision until one double is
 * left. */
#include "expr/constant.h"

#include <mpfr.h>
#include <math.h>

#include "base/interrupt.h"
#include "base/memory.h"
#include "base/text.h"
#include "expr/elementary.h"
#include "expr/elliptic-ball.h"
#include "expr/exact.h"
#include "expr/function-ball.h"
#include "expr/integral-pieces.h"
#include "expr/integral.h"
#include "expr/integral-value.h"
#include "expr/node.h"
#include "expr/pool.h"
#include "expr/print.h"
#include "expr/rational.h"
#include "expr/walk.h"

enum { FIRST_BITS = 256, MOST_BITS = 4096 };

/* x^e for a rational e. At the highest precision a ball around 0 counts as touching it: a
 * square root of what is 0 in exact arithmetic is 0. */
static void
ball_power(arb_t y, const arb_t x, const fmpq_t e, slong bits)
{
    if (fmpz_is_one(fmpq_denref(e)))
        arb_pow_fmpz(y, x, fmpq_numref(e), bits);
    else if (fmpz_equal_ui(fmpq_denref(e), 2) && fmpq_sgn(e) > 0) {
        if (bits == MOST_BITS && arb_contains_zero(x)
            && mag_cmp_2exp_si(arb_radref(x), -MOST_BITS / 2) < 0)
            arb_sqrtpos(y, x, bits);
        else
            arb_sqrt(y, x, bits);
        arb_pow_fmpz(y, y, fmpq_numref(e), bits);
    } else
        arb_pow_fmpq(y, x, e, bits);
}

/* Set y = 1 or 0 if the relation is true or false; the ball that contains both if the balls do not
 * decide it. */
static void
ball_relation(arb_t y, qdot_rel_op op, const arb_t a, const arb_t b)
{
    bool yes = false, no = false;

    switch (op) {
    case QDOT_EQ:
        yes = arb_is_exact(a) && arb_equal(a, b);
        no = !arb_overlaps(a, b);
        break;
    case QDOT_LT:
        yes = arb_lt(a, b);
        no = arb_ge(a, b);
        break;
    case QDOT_LE:
        yes = arb_le(a, b);
        no = arb_gt(a, b);
        break;
    }
    if (yes || no)
        arb_set_si(y, yes);
    else
        arb_unit_interval(y);
}

static void
ball_logic(arb_t y, qdot_logic_op op, uint32_t n, const arb_struct *const *x)
{
    bool open = false, decided = false;

    if (op == QDOT_NOT) {
        arb_sub_ui(y, x[0], 1, MOST_BITS);
        arb_neg(y, y);
        return;
    }
    for (uint32_t i = 0; i < n; i++) {
        if (!arb_is_exact(x[i]))
            open = true;
        else if (arb_is_zero(x[i]) == (op == QDOT_AND))
            decided = true; /* one operand decides the result: a false one in `and`, a true one in `or` */
    }
    if (decided)
        arb_set_si(y, op == QDOT_OR);
    else if (open)
        arb_unit_interval(y);
    else
        arb_set_si(y, op == QDOT_AND);
}

static void
ball_if(arb_t y, const arb_struct *const *x, slong bits)
{
    if (arb_is_exact(x[0]))
        arb_set(y, arb_is_zero(x[0]) ? x[2] : x[1]);
    else
        arb_union(y, x[1], x[2], bits);
}

/* Compute y = f(x[0] ... x[n-1]) in ball (interval) arithmetic; false if f is not available there. */
static bool
ball_apply_function(arb_t y, qdot_fun_id f, uint32_t n, const arb_struct *const *x, slong bits)
{
    qdot_fun_ball *ball = qdot_fun_ball_of(f);

    if (ball) {
        ball(y, x[0], bits);
        return true;
    }
    switch ((int)f) {
    case QDOT_ELLIPTIC_K:
    case QDOT_ELLIPTIC_E:
    case QDOT_ELLIPTIC_F:
    case QDOT_ELLIPTIC_PI:
    case QDOT_JACOBI_AM:
    case QDOT_JACOBI_DN:
        qdot_elliptic_ball(y, f, n, x, bits);
        return true;
    case QDOT_ATAN2:
        arb_atan2(y, x[0], x[1], bits);
        return true;
    case QDOT_MIN:
    case QDOT_MAX:
        arb_set(y, x[0]);
        for (uint32_t i = 1; i < n; i++)
            (f == QDOT_MIN ? arb_min : arb_max)(y, y, x[i], bits);
        return true;
    case QDOT_MOD: /* x - y floor(x/y) */
        arb_div(y, x[0], x[1], bits);
        arb_floor(y, y, bits);
        arb_mul(y, y, x[1], bits);
        arb_sub(y, x[0], y, bits);
        return true;
    case QDOT_IF:
        ball_if(y, x, bits);
        return true;
    default:
        return false;
    }
}

typedef struct {
    const qdot_pool *pool;
    qdot_walk walk;
    arb_struct *ball;          /* [walk.n] the value of each subexpression as a ball (an interval) */
    const arb_struct **args;   /* scratch: the balls of one node's arguments */
    bool estimated;            /* the error of an integral is an estimate */
    slong wanted;              /* of an integral: bits beyond half the bits of the other operations */
    size_t args_capacity;
} evaluation;

static const arb_struct *
ball_of_node(const evaluation *v, qdot_expr e)
{
    return v->ball + qdot_walk_index(&v->walk, e);
}

/* Fail with a list of all symbols in the expression that have no value. */
static qdot_status
report_unset_symbols(const evaluation *v)
{
    qdot_vec(qdot_expr) unset = {0};
    qdot_status status = QDOT_OK;

    for (size_t i = 0; i < v->walk.n && status == QDOT_OK; i++) {
        qdot_expr e = v->walk.at[i];
        qdot_kind kind = qdot_expr_kind(v->pool, e);

        if (kind == QDOT_UFUN || (kind == QDOT_SYM && !qdot_expr_is_constant(v->pool, e) && e != QDOT_INFINITY &&
                                  !qdot_expr_is_class(v->pool, e, QDOT_BOUND)))
            status = qdot_vec_push(&unset, e);
    }
    if (status == QDOT_OK)
        status = qdot_constant_unset_all(v->pool, unset.n, unset.at);
    qdot_free(unset.at);
    return status;
}

/* Fail with the reason why the expression `e`, whose computed interval is not finite, has no value. */
static qdot_status
report_no_value(const qdot_pool *pool, qdot_expr e, const char *why)
{
    qdot_text text = {0};
    qdot_status status = qdot_print(pool, e, QDOT_PLAIN, &text);

    if (status == QDOT_OK)
        status = qdot_fail(QDOT_EDOMAIN, "%.120s%s %s", qdot_text_str(&text),
                           text.n > 120 ? "..." : "", why);
    qdot_text_clear(&text);
    return status;
}

/* An end of an integral with more bits, where it is a rational multiple of 1 or pi: an integrand that is singular there
 * must tell places near it from it. */
static void
sharpen_end(const qdot_pool *pool, qdot_expr e, arb_t end, slong bits)
{
    const bool product = qdot_expr_kind(pool, e) == QDOT_PROD && qdot_expr_count(pool, e) == 3 &&
                         qdot_expr_arg(pool, e, 1) == QDOT_PI && qdot_expr_arg(pool, e, 2) == QDOT_ONE;
    const fmpq *c = qdot_expr_rational(pool, product ? qdot_expr_arg(pool, e, 0) : e);

    if (product || e == QDOT_PI)
        arb_const_pi(end, bits);
    if (product)
        arb_mul_fmpz(end, end, fmpq_numref(c), bits);
    if (product)
        arb_div_fmpz(end, end, fmpq_denref(c), bits);
    else if (c != NULL)
        arb_set_fmpq(end, c, bits);
}

/* The value of an integral of what reads tables of data. */
static qdot_status
integral_of_data(evaluation *v, arb_t y, qdot_expr e, slong bits)
{
    qdot_expr sum;
    mpfr_t x;
    qdot_status status = qdot_integral_in_pieces((qdot_pool *)v->pool, e, qdot_constant_double, &sum);

    if (status != QDOT_OK)
        return status;
    mpfr_init2(x, bits + 16);
    status = qdot_constant_real((qdot_pool *)v->pool, sum, x);
    arf_set_mpfr(arb_midref(y), x);
    mag_zero(arb_radref(y));
    mag_set_d(arb_radref(y), ldexp(fabs(mpfr_get_d(x, MPFR_RNDA)), (int)(-bits)));
    mpfr_clear(x);
    return status;
}

/* The value of a definite integral, whose integrand must hold nothing without a value. */
static qdot_status
integral_of_node(evaluation *v, arb_t y, qdot_expr e, slong bits)
{
    const slong precise = 8 * bits;
    qdot_status status;
    bool proved;
    arb_t a, b;

    if ((qdot_expr_node(v->pool, e)->holds & ~(uint32_t)QDOT_HAS_FUN) != 0)
        return report_unset_symbols(v);
    if (qdot_expr_find_function((qdot_pool *)v->pool, e, 1, (qdot_fun_id[]){QDOT_LOOKUP}, QDOT_NIL) != QDOT_NIL)
        return integral_of_data(v, y, e, bits);
    if (v->estimated && bits > 2 * (FIRST_BITS + v->wanted))
        return QDOT_OK; /* y stays: no number of bits makes an estimate a bound, that it is 0, say */
    arb_init(a);
    arb_init(b);
    arb_set(a, v->args[1]);
    arb_set(b, v->args[2]);
    sharpen_end(v->pool, qdot_expr_arg(v->pool, e, 1), a, precise);
    sharpen_end(v->pool, qdot_expr_arg(v->pool, e, 2), b, precise);
    status = qdot_integral_value(y, v->pool, qdot_expr_arg(v->pool, e, 0), a, b, bits / 2 + v->wanted, &proved);
    arb_clear(a);
    arb_clear(b);
    QDOT_TRY(status);
    v->estimated = v->estimated || !proved;
    return arb_is_finite(y) ? QDOT_OK : report_no_value(v->pool, e, "diverges, or its number was not found");
}

static qdot_status
evaluate_node(evaluation *v, size_t i, slong bits)
{
    const qdot_pool *pool = v->pool;
    qdot_expr e = v->walk.at[i];
    const qdot_node *node = qdot_expr_node(pool, e);
    uint32_t n = qdot_expr_count(pool, e);
    arb_struct *y = v->ball + i;
    arb_t x;

    if (node->holds & QDOT_HAS_BOUND) { /* within an integrand, which is evaluated as a whole */
        arb_indeterminate(y);
        return QDOT_OK;
    }
    QDOT_TRY(qdot_grow(&v->args, &v->args_capacity, n, sizeof *v->args));
    for (uint32_t k = 0; k < n && node->kind != QDOT_NUM && node->kind != QDOT_SYM; k++)
        v->args[k] = ball_of_node(v, qdot_expr_arg(pool, e, k));
    switch ((qdot_kind)node->kind) {
    case QDOT_NUM:
        arb_set_fmpq(y, qdot_expr_rational(pool, e), bits);
        return QDOT_OK;
    case QDOT_SYM:
        if (e == QDOT_PI)
            arb_const_pi(y, bits);
        else if (e == QDOT_TRUE || e == QDOT_FALSE)
            arb_set_si(y, e == QDOT_TRUE);
        else if (e == QDOT_INFINITY)
            arb_pos_inf(y);
        else
            return report_unset_symbols(v);
        return QDOT_OK;
    case QDOT_SUM:
        arb_set(y, v->args[0]);
        for (uint32_t k = 1; k + 1 < n; k += 2)
            arb_addmul(y, v->args[k], v->args[k + 1], bits);
        return QDOT_OK;
    case QDOT_PROD:
        arb_init(x);
        arb_set(y, v->args[0]);
        for (uint32_t k = 1; k + 1 < n; k += 2) {
            const fmpq *p = qdot_expr_rational(pool, qdot_expr_arg(pool, e, k + 1));

            if (p)
                ball_power(x, v->args[k], p, bits);
            else
                arb_pow(x, v->args[k], v->args[k + 1], bits);
            arb_mul(y, y, x, bits);
        }
        arb_clear(x);
        return QDOT_OK;
    case QDOT_FUN:
        if (node->op == QDOT_LOOKUP)
            return qdot_lookup_value(y, v->args[0], v->args[1]);
        if (!ball_apply_function(y, (qdot_fun_id)node->op, n, v->args, bits))
            return qdot_fail(QDOT_ENOTBUILT, "not built yet: the value of %s",
                             qdot_fun_name((qdot_fun_id)node->op));
        return QDOT_OK;
    case QDOT_REL:
        ball_relation(y, (qdot_rel_op)node->op, v->args[0], v->args[1]);
        return QDOT_OK;
    case QDOT_LOGIC:
        ball_logic(y, (qdot_logic_op)node->op, n, v->args);
        return QDOT_OK;
    case QDOT_INTEGRAL:
        if (!qdot_integral_is_definite(pool, e))
            return qdot_fail(QDOT_EDOMAIN, "an integral without ends has no value at a place");
        return integral_of_node(v, y, e, bits);
    case QDOT_UFUN:
        return report_unset_symbols(v);
    case QDOT_VEC:
    case QDOT_MAT:
    case QDOT_LIST:
        break;
    }
    return qdot_fail(QDOT_ETYPE, "a number belongs here, not a vector, matrix or list");
}

/* The side of `value` on which the ball (an interval) lies, -1 or 1; 0 if the ball contains `value`. */
static int
side_of_value(const arb_t ball, double value)
{
    arb_t x;
    int side = 0;

    arb_init(x);
    arb_set_d(x, value);
    if (arb_gt(ball, x))
        side = 1;
    else if (arb_lt(ball, x))
        side = -1;
    arb_clear(x);
    return side;
}

/* Whether all numbers in the ball (an interval) round to the same double, *value. */
static bool
rounds_to_one_double(const arb_t ball, double *value)
{
    arf_t lo, hi;
    double a, b;

    if (!arb_is_finite(ball))
        return false;
    arf_init(lo);
    arf_init(hi);
    arb_get_interval_arf(lo, hi, ball, 2 * MOST_BITS);
    a = arf_get_d(lo, ARF_RND_NEAR);
    b = arf_get_d(hi, ARF_RND_NEAR);
    arf_clear(lo);
    arf_clear(hi);
    *value = a + 0.0; /* turns -0 into 0 */
    return a == b;
}

/* The midpoint of the ball (an interval) minus `value`. */
static double
midpoint_minus_value(const arb_t ball, double value)
{
    arf_t x;
    double rest;

    arf_init(x);
    arf_set_d(x, value);
    arf_sub(x, arb_midref(ball), x, 64, ARF_RND_NEAR);
    rest = arf_get_d(x, ARF_RND_NEAR) + 0.0;
    arf_clear(x);
    return rest;
}

static qdot_status
evaluate_to_double(evaluation *v, qdot_expr e, double *value, int *side, double *low)
{
    const arb_struct *y;

    for (slong bits = FIRST_BITS; bits <= MOST_BITS; bits *= 2) {
        for (size_t i = 0; i < v->walk.n; i++) {
            QDOT_TRY(qdot_interrupt_check());
            QDOT_TRY(evaluate_node(v, i, bits));
        }
        if (rounds_to_one_double(ball_of_node(v, e), value)) {
            if (!isfinite(*value))
                return report_no_value(v->pool, e, "is beyond what a double holds");
            *side = side_of_value(ball_of_node(v, e), *value);
            *low = *side ? midpoint_minus_value(ball_of_node(v, e), *value) : 0;
            return QDOT_OK;
        }
    }
    y = ball_of_node(v, e);
    if (!arb_is_finite(y))
        return report_no_value(v->pool, e, "is undefined or not real");
    /* even to 4096 bits it is not decided to which double the value rounds, or the value lies exactly at a jump */
    *value = arf_get_d(arb_midref(y), ARF_RND_NEAR) + 0.0;
    if (arb_rel_accuracy_bits(y) < 60)
        return report_no_value(v->pool, e, "could not be decided in 4096 bits");
    return QDOT_OK;
}

/* Prepare to evaluate e: list its nodes and allocate a ball (an interval) for each; free_evaluation() frees them. */
static qdot_status
prepare_evaluation(evaluation *v, qdot_pool *pool, qdot_expr e)
{
    *v = (evaluation){.pool = pool};
    if (e == QDOT_NIL) {
        QDOT_TRY(qdot_pool_check(pool));
        return qdot_fail(QDOT_EINVAL, "no expression to evaluate");
    }
    QDOT_TRY(qdot_walk_begin(pool, e, &v->walk));
    v->ball = qdot_malloc(v->walk.n * sizeof *v->ball);
    if (!v->ball) {
        qdot_walk_end(&v->walk);
        return QDOT_ENOMEM;
    }
    for (size_t i = 0; i < v->walk.n; i++)
        arb_init(v->ball + i);
    return QDOT_OK;
}

static void
free_evaluation(evaluation *v)
{
    for (size_t i = 0; i < v->walk.n; i++)
        arb_clear(v->ball + i);
    qdot_free(v->ball);
    qdot_free(v->args);
    qdot_walk_end(&v->walk);
}

/* Whether an integer is at most 2^53 in magnitude, so that a double holds it exactly. */
static bool
is_exact_double(const fmpz x)
{
    const int64_t n = x;

    return !COEFF_IS_MPZ(x) && n <= INT64_C(1) << 53 && n >= -(INT64_C(1) << 53);
}

/* n/d of integers that are doubles, as most numbers of a scene and all tolerances are: the remainder
 * n - value d is a double. FLINT is not asked, which would load it (src/late.c). */
static void
split_small_quotient(double n, double d, double *value, int *side, double *low)
{
    const double left = fma(-(*value = n / d), d, n);

    *side = (left > 0) - (left < 0);
    *low = left / d;
}

qdot_status
qdot_constant_split(qdot_pool *pool, qdot_expr e, double *value, int *side, double *low)
{
    evaluation v;
    qdot_status status;
    const fmpq *rational = e == QDOT_NIL ? NULL : qdot_expr_rational(pool, e);

    *value = NAN;
    *side = 0;
    *low = 0;
    if (rational && is_exact_double(rational->num) && is_exact_double(rational->den)) {
        split_small_quotient((double)rational->num, (double)rational->den, value, side, low);
        return QDOT_OK;
    }
    QDOT_TRY(prepare_evaluation(&v, pool, e));
    status = evaluate_to_double(&v, e, value, side, low);
    pool->estimated = pool->estimated || v.estimated;
    free_evaluation(&v);
    return status;
}

/* Whether the ball (an interval) is accurate to `bits` relative to its value, or is 0 to many more bits. */
static bool
ball_is_accurate(const arb_t ball, slong bits)
{
    return arb_is_exact(ball) || arb_rel_accuracy_bits(ball) >= bits + 2
           || (arb_contains_zero(ball) && mag_cmp_2exp_si(arb_radref(ball), -8 * bits) < 0);
}

static qdot_status
evaluate_to_mpfr(evaluation *v, qdot_expr e, mpfr_ptr x)
{
    const slong bits = (slong)mpfr_get_prec(x);
    const arb_struct *y = ball_of_node(v, e);

    v->wanted = bits / 2;

    for (slong b = bits + 64; b <= 64 * bits + FIRST_BITS; b *= 2) {
        for (size_t i = 0; i < v->walk.n; i++) {
            QDOT_TRY(qdot_interrupt_check());
            QDOT_TRY(evaluate_node(v, i, b));
        }
        if (!arb_is_finite(y) || !ball_is_accurate(y, bits))
            continue;
        if (arb_contains_zero(y))
            mpfr_set_zero(x, 1);
        else
            arf_get_mpfr(x, arb_midref(y), MPFR_RNDN);
        return mpfr_number_p(x) ? QDOT_OK
                                : report_no_value(v->pool, e, "is beyond what can be held");
    }
    if (!arb_is_finite(y))
        return report_no_value(v->pool, e, "is undefined or not real");
    return report_no_value(v->pool, e, "could not be decided");
}

qdot_status
qdot_constant_real(qdot_pool *pool, qdot_expr e, mpfr_ptr x)
{
    evaluation v;
    qdot_status status;

    QDOT_TRY(prepare_evaluation(&v, pool, e));
    status = evaluate_to_mpfr(&v, e, x);
    pool->estimated = pool->estimated || v.estimated;
    free_evaluation(&v);
    return status;
}

bool
qdot_constant_estimated_taken(qdot_pool *pool)
{
    const bool was = pool->estimated;

    pool->estimated = false;
    return was;
}

qdot_expr
qdot_constant_of_real(qdot_pool *pool, mpfr_srcptr x)
{
    qdot_expr e;
    mpq_t m;
    fmpq_t q;

    if (!mpfr_number_p(x)) {
        (void)qdot_fail(QDOT_EDOMAIN, "a number of the run is not finite");
        return qdot_pool_fail(pool);
    }
    mpq_init(m);
    fmpq_init(q);
    mpfr_get_q(m, x);
    fmpq_set_mpq(q, m);
    e = qdot_expr_fmpq(pool, q);
    mpq_clear(m);
    fmpq_clear(q);
    return e;
}

qdot_status
qdot_constant_round(qdot_pool *pool, qdot_expr e, double *value, int *side)
{
    double low;

    return qdot_constant_split(pool, e, value, side, &low);
}

qdot_status
qdot_constant_double(qdot_pool *pool, qdot_expr e, double *value)
{
    int side;

    return qdot_constant_round(pool, e, value, &side);
}
