/* prepare.c -- normalises arguments and evaluates functions of inverse functions, in one pass,
 * children first. */
#include "normal/field/prepare.h"

#include "base/memory.h"
#include "expr/build.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/jacobi.h"
#include "expr/node.h"
#include "expr/walk.h"
#include "normal/field/field.h"
#include "normal/field/split.h"

#define WORK 400000     /* budget of operations for one argument */
#define ALL_WORK 20000000 /* budget of operations for all arguments of one expression */
#define MOST_MULTIPLE 12
#define MOST_PARTS 16

/* --- flat normal form -------------------------------------------------------------- */

static bool
is_monomial(const qdot_pool *pool, qdot_expr e)
{
    uint32_t n = qdot_expr_count(pool, e);
    int64_t k;

    if (qdot_expr_kind(pool, e) == QDOT_SYM || qdot_expr_kind(pool, e) == QDOT_NUM)
        return true;
    if (qdot_expr_kind(pool, e) != QDOT_PROD)
        return false;
    for (uint32_t i = 1; i < n; i += 2)
        if (qdot_expr_kind(pool, qdot_expr_arg(pool, e, i)) != QDOT_SYM ||
            !qdot_expr_to_int(pool, qdot_expr_arg(pool, e, i + 1), &k))
            return false;
    return true;
}

/* A sum of monomials in symbols: normal as it stands, unless `whole` and a power is
 * negative. */
static bool
is_flat_sum(const qdot_pool *pool, qdot_expr e, bool polynomial)
{
    uint32_t n = qdot_expr_count(pool, e);

    if (qdot_expr_kind(pool, e) != QDOT_SUM)
        return is_monomial(pool, e);
    for (uint32_t i = 1; i < n; i += 2) {
        qdot_expr term = qdot_expr_arg(pool, e, i);
        int64_t k;

        if (!is_monomial(pool, term))
            return false;
        if (polynomial && qdot_expr_kind(pool, term) == QDOT_PROD)
            for (uint32_t j = 2; j < qdot_expr_count(pool, term); j += 2)
                if (!qdot_expr_to_int(pool, qdot_expr_arg(pool, term, j), &k) || k < 0)
                    return false;
    }
    return true;
}

qdot_expr
qdot_prepare_flat(qdot_pool *pool, qdot_expr e, int64_t work)
{
    qdot_expr flat = e;
    qdot_field f;

    if (e == QDOT_NIL || !qdot_expr_is_scalar(pool, e) || is_flat_sum(pool, e, true))
        return e;
    qdot_field_begin(&f, pool, 1, &e, work);
    if (qdot_field_goes(&f)) {
        qdot_ratio r;

        qdot_field_cancelled(&f, &r, e);
        if (qdot_field_goes(&f))
            flat = qdot_field_ratio_expr(&f, &r);
        qdot_ratio_clear(&f, &r);
    }
    qdot_field_end(&f);
    return flat;
}

/* The terms of the polynomial p times c, as separate expressions. */
static qdot_expr
term_by_term(qdot_field *f, const fmpz_mpoly_t p, qdot_expr c)
{
    qdot_expr sum = QDOT_ZERO;
    fmpz_mpoly_t term;

    fmpz_mpoly_init(term, f->ctx);
    for (slong i = 0; i < fmpz_mpoly_length(p, f->ctx); i++) {
        fmpz_mpoly_get_term(term, p, i, f->ctx);
        sum = qdot_add(f->pool, sum, qdot_mul(f->pool, qdot_field_expr(f, term), c));
    }
    fmpz_mpoly_clear(term, f->ctx);
    return sum;
}

/* Write n/d as q + r/d, where no term of r is divisible by the leading term of d; d is irreducible. */
static qdot_expr
quotient_and_remainder(qdot_field *f, const qdot_ratio *x)
{
    qdot_expr over, sum = QDOT_NIL;
    fmpz_mpoly_t q, r, d;
    fmpq_t c;

    fmpq_init(c);
    fmpz_mpoly_init(q, f->ctx);
    fmpz_mpoly_init(r, f->ctx);
    fmpz_mpoly_init(d, f->ctx);
    qdot_field_primitive(f, fmpq_denref(c), d, x->d, false);
    if (qdot_field_charge(f, 4 * fmpz_mpoly_length(x->n, f->ctx),
                          fmpz_mpoly_length(d, f->ctx))) {
        fmpz_mpoly_quasidivrem(fmpq_numref(c), q, r, x->n, d, f->ctx);
        /* s n = q d + r, so the integer part is divided by s */
        fmpz_mul(fmpq_denref(c), fmpq_denref(c), fmpq_numref(c));
        fmpz_one(fmpq_numref(c));
        fmpq_canonicalise(c);
        over = qdot_expr_fmpq(f->pool, c);
        sum = term_by_term(f, q, over);
        over = qdot_div(f->pool, over, qdot_field_expr(f, d));
        sum = qdot_add(f->pool, sum, term_by_term(f, r, over));
    }
    fmpz_mpoly_clear(q, f->ctx);
    fmpz_mpoly_clear(r, f->ctx);
    fmpz_mpoly_clear(d, f->ctx);
    fmpq_clear(c);
    return sum;
}

/* An angle as a sum of terms: a polynomial, and the remainder over the denominator. */
static qdot_expr
expand_angle(qdot_pool *pool, qdot_expr e, int64_t work)
{
    qdot_expr sum = e;
    qdot_field f;

    if (is_flat_sum(pool, e, false))
        return e;
    qdot_field_begin(&f, pool, 1, &e, work);
    if (qdot_field_goes(&f)) {
        qdot_ratio r;

        qdot_field_cancelled(&f, &r, e);
        if (qdot_field_goes(&f))
            sum = quotient_and_remainder(&f, &r);
        if (!qdot_field_goes(&f))
            sum = e;
        qdot_ratio_clear(&f, &r);
    }
    qdot_field_end(&f);
    return sum;
}

/* --- functions of inverse functions ------------------------------------------------ */

static qdot_expr
one_plus(qdot_pool *pool, qdot_expr u, int64_t sign)
{
    return qdot_add(pool, QDOT_ONE,
                    qdot_mul(pool, qdot_expr_int(pool, sign), qdot_pow_int(pool, u, 2)));
}

static qdot_expr
prepare_root(qdot_pool *pool, qdot_expr e)
{
    return e == QDOT_NIL ? e : qdot_split_power(pool, e, QDOT_HALF);
}

/* s, c: sin and cos of an inverse circular function, sinh and cosh of an inverse
 * hyperbolic. */
static bool
sine_cosine_of_inverse(qdot_pool *pool, qdot_expr e, bool circular, qdot_expr *s, qdot_expr *c)
{
    qdot_expr u, v, r;

    if (qdot_expr_kind(pool, e) != QDOT_FUN)
        return false;
    u = qdot_expr_arg(pool, e, 0);
    switch (qdot_expr_node(pool, e)->op) {
    case QDOT_ASIN:
        *s = u;
        *c = prepare_root(pool, one_plus(pool, u, -1));
        return circular;
    case QDOT_ACOS:
        *c = u;
        *s = prepare_root(pool, one_plus(pool, u, -1));
        return circular;
    case QDOT_ATAN:
        *c = qdot_div(pool, QDOT_ONE, prepare_root(pool, one_plus(pool, u, 1)));
        *s = qdot_mul(pool, u, *c);
        return circular;
    case QDOT_ATAN2:
        v = qdot_expr_arg(pool, e, 1);
        r = prepare_root(pool, qdot_prepare_flat(pool,
                                                 qdot_add(pool, qdot_pow_int(pool, u, 2),
                                                          qdot_pow_int(pool, v, 2)),
                                                 WORK));
        *s = qdot_div(pool, u, r);
        *c = qdot_div(pool, v, r);
        return circular;
    case QDOT_ASINH:
        *s = u;
        *c = prepare_root(pool, one_plus(pool, u, 1));
        return !circular;
    case QDOT_ACOSH:
        *c = u;
        *s = prepare_root(pool, qdot_sub(pool, qdot_pow_int(pool, u, 2), QDOT_ONE));
        return !circular;
    case QDOT_ATANH:
        *c = qdot_div(pool, QDOT_ONE, prepare_root(pool, one_plus(pool, u, -1)));
        *s = qdot_mul(pool, u, *c);
        return !circular;
    default: return false;
    }
}

/* s, c of half the angle, where that is known to lie in [0, pi/2] (`first`) or between -pi/2 and pi/2:
 * c = sqrt((1 + c)/2), s = sqrt((1 - c)/2) or s/(2 c); of areas alike. */
static void
halve_angle(qdot_pool *pool, bool circular, bool first, qdot_expr *s, qdot_expr *c)
{
    qdot_expr half = qdot_prepare_flat(
        pool, qdot_mul(pool, QDOT_HALF, qdot_add(pool, QDOT_ONE, *c)), WORK);
    qdot_expr rest = qdot_prepare_flat(
        pool,
        qdot_mul(pool, QDOT_HALF,
                 circular ? qdot_sub(pool, QDOT_ONE, *c) : qdot_sub(pool, *c, QDOT_ONE)),
        WORK);

    *c = prepare_root(pool, half);
    *s = first ? prepare_root(pool, rest)
               : qdot_div(pool, *s, qdot_mul(pool, qdot_expr_int(pool, 2), *c));
}

/* Sine s and cosine c of n/d times an inverse function, d a power of 2; false for other arguments. */
static bool
sine_cosine_of_part(qdot_pool *pool, qdot_expr e, const fmpq *factor, bool circular, int64_t *n,
                    qdot_expr *s, qdot_expr *c)
{
    unsigned op = qdot_expr_kind(pool, e) == QDOT_FUN ? qdot_expr_node(pool, e)->op : 0;
    int64_t d;
    bool first;

    if (fmpz_cmp_ui(fmpq_denref(factor), MOST_PARTS) > 0 ||
        fmpz_cmpabs(fmpq_numref(factor), (fmpz[]){MOST_MULTIPLE}) > 0)
        return false;
    d = fmpz_get_si(fmpq_denref(factor));
    *n = fmpz_get_si(fmpq_numref(factor));
    if ((d & (d - 1)) != 0 || (d > 1 && op == QDOT_ATAN2) ||
        !sine_cosine_of_inverse(pool, e, circular, s, c))
        return false;
    first = op == QDOT_ACOS || op == QDOT_ACOSH;
    for (; d > 1; d /= 2) {
        halve_angle(pool, circular, first, s, c);
        first = false;
    }
    return true;
}

/* tan(atan2(y, x)/2) as y/(x + r), valid where the tangent is defined. Nil for other arguments. */
static qdot_expr
tangent_of_half(qdot_pool *pool, qdot_expr arg)
{
    qdot_expr s, c;

    if (qdot_expr_kind(pool, arg) != QDOT_PROD || qdot_expr_count(pool, arg) != 3 ||
        qdot_expr_arg(pool, arg, 0) != QDOT_HALF || qdot_expr_arg(pool, arg, 2) != QDOT_ONE ||
        qdot_expr_kind(pool, qdot_expr_arg(pool, arg, 1)) != QDOT_FUN ||
        qdot_expr_node(pool, qdot_expr_arg(pool, arg, 1))->op != QDOT_ATAN2 ||
        !sine_cosine_of_inverse(pool, qdot_expr_arg(pool, arg, 1), true, &s, &c))
        return QDOT_NIL;
    return qdot_div(pool, s, qdot_add(pool, QDOT_ONE, c));
}

/* The number of terms of a function's argument; the next function gives the i-th term: coefficient and rest. */
static uint32_t
count_argument_terms(const qdot_pool *pool, qdot_expr e)
{
    return qdot_expr_kind(pool, e) == QDOT_SUM ? (qdot_expr_count(pool, e) - 1) / 2 : 1;
}

static void
argument_term_at(qdot_pool *pool, qdot_expr e, uint32_t i, qdot_expr *c, qdot_expr *rest)
{
    if (qdot_expr_kind(pool, e) == QDOT_SUM) {
        *rest = qdot_expr_arg(pool, e, 1 + 2 * i);
        *c = qdot_expr_arg(pool, e, 2 + 2 * i);
    } else if (qdot_expr_kind(pool, e) == QDOT_PROD) {
        *c = qdot_expr_arg(pool, e, 0);
        *rest = qdot_div(pool, e, *c);
    } else {
        *c = QDOT_ONE;
        *rest = e;
    }
}

/* A function of an argument that holds inverse functions, by the addition theorems; nil
 * if it holds none. */
static qdot_expr
resolve_inverse_functions(qdot_pool *pool, uint32_t op, qdot_expr arg)
{
    bool circular = op != QDOT_SINH && op != QDOT_COSH && op != QDOT_TANH, any = false;
    qdot_expr left = arg, s = QDOT_ZERO, c = QDOT_ONE, s1, c1, s2, c2;
    int64_t n;

    if (op == QDOT_TAN && (s1 = tangent_of_half(pool, arg)) != QDOT_NIL)
        return s1;

    for (uint32_t i = 0; i < count_argument_terms(pool, arg); i++) {
        qdot_expr factor, rest;

        argument_term_at(pool, arg, i, &factor, &rest);
        if (!sine_cosine_of_part(pool, rest, qdot_expr_rational(pool, factor), circular, &n,
                                 &s1, &c1))
            continue;
        any = true;
        left = qdot_sub(pool, left, qdot_mul(pool, factor, rest));
        if (n < 0)
            s1 = qdot_neg(pool, s1);
        for (int64_t k = 0; k < (n < 0 ? -n : n); k++) {
            s2 = qdot_add(pool, qdot_mul(pool, s, c1), qdot_mul(pool, c, s1));
            c2 = qdot_add(pool, qdot_mul(pool, c, c1),
                          qdot_mul(pool, qdot_expr_int(pool, circular ? -1 : 1),
                                   qdot_mul(pool, s, s1)));
            s = s2;
            c = c2;
        }
    }
    if (!any)
        return QDOT_NIL;
    s1 = qdot_fun1(pool, circular ? QDOT_SIN : QDOT_SINH, left);
    c1 = qdot_fun1(pool, circular ? QDOT_COS : QDOT_COSH, left);
    s2 = qdot_add(pool, qdot_mul(pool, s, c1), qdot_mul(pool, c, s1));
    c2 = qdot_add(
        pool, qdot_mul(pool, c, c1),
        qdot_mul(pool, qdot_expr_int(pool, circular ? -1 : 1), qdot_mul(pool, s, s1)));
    switch (op) {
    case QDOT_SIN:
    case QDOT_SINH: return s2;
    case QDOT_COS:
    case QDOT_COSH: return c2;
    case QDOT_SEC: return qdot_div(pool, QDOT_ONE, c2);
    case QDOT_CSC: return qdot_div(pool, QDOT_ONE, s2);
    case QDOT_COT: return qdot_div(pool, c2, s2);
    default: return qdot_div(pool, s2, c2);
    }
}

/* Rewrite exp(c log(u) + rest) as u^c exp(rest). */
static qdot_expr
prepare_exponential(qdot_pool *pool, qdot_expr arg)
{
    qdot_expr left = arg, product = QDOT_ONE;

    for (uint32_t i = 0; i < count_argument_terms(pool, arg); i++) {
        qdot_expr factor, rest, u;

        argument_term_at(pool, arg, i, &factor, &rest);
        if (qdot_expr_kind(pool, rest) != QDOT_FUN ||
            qdot_expr_node(pool, rest)->op != QDOT_LOG)
            continue;
        u = qdot_expr_arg(pool, rest, 0);
        left = qdot_sub(pool, left, qdot_mul(pool, factor, rest));
        product = qdot_mul(pool, product,
                           fmpz_is_one(fmpq_denref(qdot_expr_rational(pool, factor)))
                               ? qdot_pow(pool, u, factor)
                               : qdot_split_power(pool, u, factor));
    }
    return qdot_mul(pool, product, qdot_fun1(pool, QDOT_EXP, left));
}

/* --- preparing all nodes ----------------------------------------------------------- */

static qdot_expr
prepare_function(qdot_pool *pool, qdot_expr e, int64_t work)
{
    uint32_t op = qdot_expr_node(pool, e)->op, n = qdot_expr_count(pool, e);
    qdot_expr arg = qdot_expr_arg(pool, e, 0), args[4], resolved;

    switch (op) {
    case QDOT_SIN:
    case QDOT_COS:
    case QDOT_TAN:
    case QDOT_SEC:
    case QDOT_CSC:
    case QDOT_COT:
    case QDOT_SINH:
    case QDOT_COSH:
    case QDOT_TANH:
        arg = expand_angle(pool, arg, work);
        if (arg == QDOT_NIL)
            return arg;
        resolved = resolve_inverse_functions(pool, op, arg);
        return resolved != QDOT_NIL || qdot_pool_failed(pool) ? resolved
                                                              : qdot_fun1(pool, op, arg);
    case QDOT_EXP:
        arg = expand_angle(pool, arg, work);
        return arg == QDOT_NIL ? arg : prepare_exponential(pool, arg);
    case QDOT_ABS: return qdot_split_abs(pool, arg);
    case QDOT_LOG: return qdot_split_log(pool, arg);
    case QDOT_JACOBI_DN:
        for (uint32_t i = 0; i < n; i++)
            args[i] = qdot_prepare_flat(pool, qdot_expr_arg(pool, e, i), work);
        return prepare_root(pool, qdot_jacobi_dn_squared(pool, args[0], args[1]));
    default:
        if (n > 4)
            return e;
        for (uint32_t i = 0; i < n; i++)
            args[i] = qdot_prepare_flat(pool, qdot_expr_arg(pool, e, i), work);
        return qdot_rebuild(pool, e, args);
    }
}

/* Remember that `now` stands where `before` stood; what cannot be kept is only
 * longer. */
static void
record_origin(qdot_pool *pool, qdot_map *origins, qdot_expr now, qdot_expr before)
{
    if (origins != NULL && now != QDOT_NIL && now != before &&
        !qdot_map_get(origins, now, NULL) &&
        qdot_map_set(origins, now, before) != QDOT_OK)
        qdot_pool_fail(pool);
}

/* The base of a power x made of b, if b is left as a whole under the root, or the product of the
 * sums that it came apart into: (cosh(u) - cos(v))*(cosh(u) + cos(v)). */
static void
record_origin_of_base(qdot_pool *pool, qdot_map *origins, qdot_expr power, qdot_expr x,
                      qdot_expr b)
{
    qdot_expr bases = QDOT_ONE;

    if (origins == NULL || power == QDOT_NIL ||
        qdot_expr_kind(pool, power) != QDOT_PROD ||
        qdot_expr_arg(pool, power, 0) != QDOT_ONE)
        return;
    for (uint32_t i = 1; i < qdot_expr_count(pool, power); i += 2) {
        qdot_expr base = qdot_expr_arg(pool, power, i);

        if (qdot_expr_arg(pool, power, i + 1) != x ||
            (i > 1 && qdot_expr_kind(pool, base) != QDOT_SUM))
            return;
        bases = qdot_mul(pool, bases, base);
    }
    record_origin(pool, origins, bases, b);
}

/* Split powers with fractional exponents; normalise base and exponent of other powers. */
static qdot_expr
prepare_product(qdot_pool *pool, qdot_expr e, qdot_map *origins, int64_t work)
{
    uint32_t n = qdot_expr_count(pool, e);
    qdot_expr result;
    bool special = false;
    int64_t k;

    for (uint32_t i = 2; i < n && !special; i += 2)
        special = !qdot_expr_to_int(pool, qdot_expr_arg(pool, e, i), &k);
    if (!special)
        return e;
    result = qdot_expr_arg(pool, e, 0);
    for (uint32_t i = 1; i < n && !qdot_pool_failed(pool); i += 2) {
        qdot_expr b = qdot_expr_arg(pool, e, i), x = qdot_expr_arg(pool, e, i + 1), power;

        if (qdot_expr_to_int(pool, x, &k))
            power = qdot_pow(pool, b, x);
        else if (qdot_expr_kind(pool, x) == QDOT_NUM)
            record_origin_of_base(pool, origins, power = qdot_split_power(pool, b, x), x, b);
        else
            power = qdot_pow(pool, qdot_prepare_flat(pool, b, work),
                             qdot_prepare_flat(pool, x, work));
        result = qdot_mul(pool, result, power);
    }
    return result;
}

static qdot_expr
expand_arguments(qdot_pool *pool, qdot_expr e, uint32_t count, int64_t work)
{
    uint32_t n = qdot_expr_count(pool, e);
    qdot_expr *args = qdot_malloc((n + 1) * sizeof *args), result;

    if (args == NULL)
        return qdot_pool_fail(pool);
    for (uint32_t i = 0; i < n; i++) {
        args[i] = qdot_expr_arg(pool, e, i);
        if (i < count)
            args[i] = qdot_prepare_flat(pool, args[i], work);
    }
    result = qdot_rebuild(pool, e, args);
    qdot_free(args);
    return result;
}

static qdot_expr
prepare_node(qdot_pool *pool, const qdot_walk *w, qdot_expr e, qdot_map *origins, int64_t work)
{
    qdot_expr before = e, now;

    e = qdot_walk_rebuild(pool, w, e);
    if (e == QDOT_NIL)
        return e;
    switch (qdot_expr_kind(pool, e)) {
    case QDOT_FUN: now = prepare_function(pool, e, work); break;
    case QDOT_PROD: return prepare_product(pool, e, origins, work);
    case QDOT_UFUN: now = expand_arguments(pool, e, qdot_expr_count(pool, e) / 2, work); break;
    case QDOT_REL: return expand_arguments(pool, e, 2, work);
    case QDOT_INTEGRAL: now = e; break;
    default: return e;
    }
    if (now != QDOT_NIL &&
        (qdot_expr_kind(pool, now) == QDOT_FUN || qdot_expr_kind(pool, now) == QDOT_INTEGRAL || qdot_expr_kind(pool, now) == QDOT_UFUN))
        record_origin(pool, origins, now, before);
    return now;
}

/* A failure that is only a wrong turn (a zero denominator found on the way) is
 * forgotten. */
static bool
clear_harmless_failure(qdot_pool *pool)
{
    qdot_status status = qdot_pool_check(pool);

    if (status == QDOT_OK)
        return false;
    if (qdot_grave(status) != QDOT_OK)
        qdot_pool_fail(pool);
    return true;
}

qdot_expr
qdot_prepare(qdot_pool *pool, qdot_expr e)
{
    return qdot_prepare_from(pool, e, NULL);
}

qdot_expr
qdot_prepare_from(qdot_pool *pool, qdot_expr e, qdot_map *origins)
{
    qdot_expr result = e;
    int64_t work, functions = 1;
    qdot_walk w;

    if (e == QDOT_NIL || qdot_pool_failed(pool))
        return QDOT_NIL;
    if (is_flat_sum(pool, e, false))
        return e;
    if (qdot_walk_begin(pool, e, &w) != QDOT_OK)
        return qdot_pool_fail(pool);
    for (size_t i = 0; i < w.n; i++)
        functions += qdot_expr_kind(pool, w.at[i]) >= QDOT_PROD;
    work = ALL_WORK / functions < WORK ? ALL_WORK / functions : WORK;
    for (size_t i = 0; i < w.n && !qdot_pool_failed(pool); i++) {
        qdot_expr at = w.at[i];
        qdot_kind kind = qdot_expr_kind(pool, at);

        result = kind == QDOT_NUM || kind == QDOT_SYM ? at : prepare_node(pool, &w, at, origins, work);
        qdot_walk_set(&w, at, result);
    }
    qdot_walk_end(&w);
    if (clear_harmless_failure(pool))
        return qdot_pool_failed(pool) ? QDOT_NIL : e;
    return result;
}
