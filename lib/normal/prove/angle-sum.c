/* angle-sum.c -- sums of angles that inverse functions give, and multiples of pi, that are zero.
 *
 * S = k1 atan u1 + k2 asin u2 + ... + q pi is the argument of a product Z of complex numbers,
 * (1 + i u1)^k1 (sqrt(1 - u2^2) + i u2)^k2 ..., each of that argument and not 0. Where the ranges
 * of the functions leave |S| < pi, S is 0 if Im Z is; where they leave |S| < 2 pi, if Re Z = |Z|.
 */
#include "base/memory.h"
#include "expr/build.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "normal/field/factor.h"
#include "normal/prove/zero.h"
#include "normal/refute/constant.h"

enum { MOST_GROUPS = 30, MOST_POWER = 24 };

static bool
is_angle_variable(const qdot_field *f, slong v)
{
    qdot_expr e = f->gen[v].expr;
    unsigned op;

    if (f->gen[v].kind != QDOT_GEN_PLAIN || qdot_expr_kind(f->pool, e) != QDOT_FUN)
        return false;
    op = qdot_expr_node(f->pool, e)->op;
    return op == QDOT_ATAN || op == QDOT_ASIN || op == QDOT_ACOS || op == QDOT_ATAN2;
}

/* What is known of a sum of angles: bounds; a complex number Z whose argument is the sum; |Z|. */
struct sum {
    qdot_pool *pool;
    qdot_expr lo, hi;
    bool lo_open, hi_open;
    qdot_expr re, im, modulus;
};

static qdot_expr
times_pi(qdot_pool *pool, int64_t n, int64_t d)
{
    return qdot_mul(pool, qdot_expr_ratio(pool, n, d), QDOT_PI);
}

/* --- bounds of angles ---------------------------------------------------------------------- */

static void
add_interval_of_angle(struct sum *s, int64_t k, qdot_expr lo, bool lo_open, qdot_expr hi, bool hi_open)
{
    qdot_pool *pool = s->pool;
    qdot_expr by = qdot_expr_int(pool, k);

    s->lo = qdot_add(pool, s->lo, qdot_mul(pool, by, k > 0 ? lo : hi));
    s->hi = qdot_add(pool, s->hi, qdot_mul(pool, by, k > 0 ? hi : lo));
    s->lo_open |= k > 0 ? lo_open : hi_open;
    s->hi_open |= k > 0 ? hi_open : lo_open;
}

/* Add to the sum the bounds of k times the angle e, in quarter turns, narrowed by the known signs of its arguments. */
static void
add_bounds_of_angle(struct sum *s, int64_t k, qdot_expr e)
{
    qdot_pool *pool = s->pool;
    unsigned op = qdot_expr_node(pool, e)->op;
    uint8_t u = qdot_expr_node(pool, qdot_expr_arg(pool, e, 0))->sign, right = 0;
    int64_t lo = op == QDOT_ACOS ? 0 : op == QDOT_ATAN2 ? -2 : -1;
    int64_t hi = op == QDOT_ACOS || op == QDOT_ATAN2 ? 2 : 1;
    bool open = op == QDOT_ATAN, lo_open = open || op == QDOT_ATAN2, hi_open = open;

    if (qdot_expr_is_constant(pool, e)) {
        add_interval_of_angle(s, k, e, false, e, false);
        return;
    }
    if (op == QDOT_ATAN2) {
        right = qdot_expr_node(pool, qdot_expr_arg(pool, e, 1))->sign;
        if ((right & QDOT_POS) == QDOT_POS)
            lo = -1, hi = 1, lo_open = hi_open = true;
    }
    if (op == QDOT_ACOS) {
        if (u & QDOT_GE0)
            hi = 1, hi_open = u & QDOT_NE0;
        if (u & QDOT_LE0)
            lo = 1, lo_open = u & QDOT_NE0;
    } else {
        if (u & QDOT_GE0) {
            lo = 0, lo_open = u & QDOT_NE0;
            hi_open |= op == QDOT_ATAN2 && (u & QDOT_NE0);
        }
        if ((u & QDOT_LE0) && (op != QDOT_ATAN2 || (u & QDOT_NE0)))
            hi = 0, hi_open = u & QDOT_NE0;
    }
    add_interval_of_angle(s, k, times_pi(pool, lo, 2), lo_open, times_pi(pool, hi, 2), hi_open);
}

/* Whether the sum of angles lies strictly between -n pi and n pi. */
static bool
lies_within_turns(const struct sum *s, int64_t n)
{
    qdot_pool *pool = s->pool;
    qdot_expr gap[2] = {qdot_add(pool, s->lo, times_pi(pool, n, 1)),
                        qdot_sub(pool, times_pi(pool, n, 1), s->hi)};
    bool open[2] = {s->lo_open, s->hi_open}, inside = true;

    for (int i = 0; i < 2 && inside; i++) {
        qdot_constant_sign sign;

        inside =
            gap[i] != QDOT_NIL && qdot_constant_decide(pool, gap[i], &sign) == QDOT_OK &&
            (sign == QDOT_CONSTANT_POSITIVE || (sign == QDOT_CONSTANT_ZERO && open[i]));
    }
    return inside;
}

/* --- the complex number whose argument is the sum ------------------------------------------- */

static qdot_expr
square_root(qdot_pool *pool, qdot_expr e)
{
    return qdot_pow(pool, e, QDOT_HALF);
}

static qdot_expr
square(qdot_pool *pool, qdot_expr e)
{
    return qdot_pow_int(pool, e, 2);
}

/* Multiply Z by (re + i im)^k; for k < 0 by powers of the complex conjugate. */
static void
sum_multiply(struct sum *s, int64_t k, qdot_expr re, qdot_expr im, qdot_expr modulus)
{
    qdot_pool *pool = s->pool;
    int64_t n = k < 0 ? -k : k;

    if (k < 0)
        im = qdot_neg(pool, im);
    for (int64_t i = 0; i < n; i++) {
        qdot_expr a = s->re, b = s->im;

        s->re = qdot_sub(pool, qdot_mul(pool, a, re), qdot_mul(pool, b, im));
        s->im = qdot_add(pool, qdot_mul(pool, a, im), qdot_mul(pool, b, re));
    }
    s->modulus = qdot_mul(pool, s->modulus, qdot_pow_int(pool, modulus, n));
}

static void
add_angle(struct sum *s, int64_t k, qdot_expr e)
{
    qdot_pool *pool = s->pool;
    qdot_expr u = qdot_expr_arg(pool, e, 0), other;

    add_bounds_of_angle(s, k, e);
    switch (qdot_expr_node(pool, e)->op) {
    case QDOT_ATAN:
        other = square_root(pool, qdot_add(pool, QDOT_ONE, square(pool, u)));
        sum_multiply(s, k, QDOT_ONE, u, other);
        return;
    case QDOT_ATAN2: /* arguments are y, x */
        other = qdot_expr_arg(pool, e, 1);
        sum_multiply(s, k, other, u,
                     square_root(pool, qdot_add(pool, square(pool, other), square(pool, u))));
        return;
    default:
        other = square_root(pool, qdot_sub(pool, QDOT_ONE, square(pool, u)));
        if (qdot_expr_node(pool, e)->op == QDOT_ASIN)
            sum_multiply(s, k, other, u, QDOT_ONE);
        else
            sum_multiply(s, k, u, other, QDOT_ONE);
    }
}

static void
add_multiple_of_pi(struct sum *s, qdot_expr q)
{
    qdot_expr turn = qdot_mul(s->pool, q, QDOT_PI);

    add_interval_of_angle(s, 1, turn, false, turn, false);
    sum_multiply(s, 1, qdot_fun1(s->pool, QDOT_COS, turn), qdot_fun1(s->pool, QDOT_SIN, turn),
                 QDOT_ONE);
}

/* --- sums of angles in a polynomial --------------------------------------------------------- */

/* The variable (generator) v if term i of p is a number times v; -1 otherwise. */
static slong
only_variable_of_term(qdot_field *f, const fmpz_mpoly_t p, slong i, ulong *exp)
{
    slong at = -1;

    fmpz_mpoly_get_term_exp_ui(exp, p, i, f->ctx);
    for (slong v = 0; v < f->n; v++)
        if (exp[v] != 0) {
            if (at >= 0 || exp[v] != 1)
                return -1;
            at = v;
        }
    return at;
}

/* The greatest common divisor of the coefficients of angles; 0: p is not a sum of angles and
 * multiples of pi, or of too large ones. */
static bool
find_common_divisor(qdot_field *f, const fmpz_mpoly_t p, fmpz_t g, ulong *exp)
{
    slong n = fmpz_mpoly_length(p, f->ctx);
    bool good = true;
    fmpz_t k, sum;

    fmpz_init(k);
    fmpz_init(sum);
    fmpz_zero(g);
    for (slong i = 0; i < n && good; i++) {
        slong v = only_variable_of_term(f, p, i, exp);

        good = v >= 0 && (is_angle_variable(f, v) || f->gen[v].expr == QDOT_PI);
        if (!good || f->gen[v].expr == QDOT_PI)
            continue;
        fmpz_mpoly_get_term_coeff_fmpz(k, p, i, f->ctx);
        fmpz_gcd(g, g, k);
        fmpz_abs(k, k);
        fmpz_add(sum, sum, k);
    }
    good = good && !fmpz_is_zero(g);
    if (good) {
        fmpz_divexact(sum, sum, g);
        good = fmpz_cmp_si(sum, MOST_POWER) <= 0;
    }
    fmpz_clear(k);
    fmpz_clear(sum);
    return good;
}

/* Collect the bounds and the complex factors of Z of all terms of the sum of angles p/g. */
static void
collect_sum(qdot_field *f, struct sum *s, const fmpz_mpoly_t p, const fmpz_t g,
            ulong *exp)
{
    fmpq_t k;

    fmpq_init(k);
    for (slong i = 0; i < fmpz_mpoly_length(p, f->ctx); i++) {
        slong v = only_variable_of_term(f, p, i, exp);

        fmpz_mpoly_get_term_coeff_fmpz(fmpq_numref(k), p, i, f->ctx);
        fmpz_set(fmpq_denref(k), g);
        fmpq_canonicalise(k);
        if (f->gen[v].expr == QDOT_PI)
            add_multiple_of_pi(s, qdot_expr_fmpq(f->pool, k));
        else
            add_angle(s, fmpz_get_si(fmpq_numref(k)), f->gen[v].expr);
    }
    fmpq_clear(k);
}

static qdot_status
prove_angle_sum_zero(const qdot_zero *z, const fmpz_mpoly_t p, ulong *exp, bool *zero)
{
    qdot_field *f = z->f;
    qdot_pool *pool = f->pool;
    struct sum s = {pool,  QDOT_ZERO, QDOT_ZERO, false,
                    false, QDOT_ONE,  QDOT_ZERO, QDOT_ONE};
    qdot_status status = QDOT_OK;
    fmpz_t g;

    *zero = false;
    fmpz_init(g);
    if (find_common_divisor(f, p, g, exp)) {
        collect_sum(f, &s, p, g, exp);
        if (qdot_pool_failed(pool)) { /* the expression is undefined: nothing can be proved */
            status = qdot_grave(qdot_pool_check(pool));
        } else if (lies_within_turns(&s, 1))
            status = z->prove(pool, s.im, QDOT_ZERO, z->n_positive, z->positive,
                                      z->sure, zero);
        else if (lies_within_turns(&s, 2))
            status = z->prove(pool, s.re, s.modulus, z->n_positive, z->positive,
                                      z->sure, zero);
    }
    fmpz_clear(g);
    return status;
}

qdot_status
qdot_zero_angles(qdot_zero *z, const fmpz_mpoly_t p, bool *zero)
{
    qdot_field *f = z->f;
    size_t n = (size_t)f->n + 1;
    bool *by = qdot_malloc(n * sizeof *by), any = false;
    ulong *exp = qdot_malloc(n * sizeof *exp);
    qdot_status status = by == NULL || exp == NULL ? QDOT_ENOMEM : QDOT_OK;
    qdot_groups groups;

    *zero = false;
    for (slong v = 0; v < f->n && status == QDOT_OK; v++) {
        bool angle = is_angle_variable(f, v);

        by[v] = !angle && f->gen[v].expr != QDOT_PI;
        any |= angle && fmpz_mpoly_degree_si(p, v, f->ctx) > 0;
    }
    if (any) {
        status = qdot_factor_group(f, &groups, p, by);
        *zero = status == QDOT_OK && groups.n <= MOST_GROUPS;
        for (slong i = 0; i < groups.n && status == QDOT_OK && *zero; i++)
            status = prove_angle_sum_zero(z, groups.poly + i, exp, zero);
        qdot_factor_ungroup(f, &groups);
    }
    qdot_free(by);
    qdot_free(exp);
    return status;
}
