/* zero.c -- proves expressions zero: constants by root bounds, roots by norms and signs. */
#include "normal/prove/zero.h"

#include "base/memory.h"
#include "expr/elementary.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "normal/field/factor.h"
#include "normal/refute/constant.h"
#include "normal/refute/sample.h"

enum {
    MOST_DEPTH = 10,
    MOST_NESTED = 6,
    MOST_ORDER = 12,
    MOST_GROUPS = 200,
    POINTS = 24,
    MOST_TERMS = 4000
};

qdot_status
qdot_zero_begin(qdot_zero *z, qdot_field *f, const qdot_ideal *ideal, size_t n_positive,
                const qdot_expr *positive, bool sure)
{
    *z = (qdot_zero){.f = f,
                     .ideal = ideal,
                     .n_positive = n_positive,
                     .positive = positive,
                     .sure = sure};
    z->sign = qdot_calloc((size_t)f->n + 1, sizeof *z->sign);
    if (z->sign == NULL)
        return QDOT_ENOMEM;
    for (slong v = 0; v < f->n; v++)
        z->sign[v] = qdot_range_sign(f->pool, &f->gen[v]);
    return QDOT_OK;
}

void
qdot_zero_end(qdot_zero *z)
{
    qdot_free(z->sign);
}

static void
reduce_by_ideal(qdot_zero *z, fmpz_mpoly_t p)
{
    fmpz_t scale;

    qdot_field_reduce(z->f, p);
    if (z->ideal == NULL)
        return;
    fmpz_init(scale);
    qdot_ideal_reduce(z->ideal, z->f, scale, p);
    fmpz_clear(scale);
}

/* --- constant coefficients --------------------------------------------------------- */

static bool
contains_constants(const qdot_field *f, const fmpz_mpoly_t p)
{
    for (slong v = 0; v < f->n; v++)
        if (fmpz_mpoly_degree_si(p, v, f->ctx) > 0 && f->gen[v].kind != QDOT_GEN_PLAIN &&
            qdot_expr_is_constant(f->pool, f->gen[v].expr))
            return true;
    return false;
}

/* Remove from p the groups of terms with equal monomials whose constant coefficients add up to zero. */
static qdot_status
drop_zero_coefficients(qdot_field *f, fmpz_mpoly_t p)
{
    bool *by = qdot_malloc(((size_t)f->n + 1) * sizeof *by);
    qdot_status status;
    qdot_groups groups;

    if (by == NULL)
        return QDOT_ENOMEM;
    for (slong v = 0; v < f->n; v++)
        by[v] = f->gen[v].kind == QDOT_GEN_PLAIN ||
                !qdot_expr_is_constant(f->pool, f->gen[v].expr);
    status = qdot_factor_group(f, &groups, p, by);
    for (slong i = 0; i < groups.n && groups.n <= MOST_GROUPS && status == QDOT_OK; i++) {
        qdot_expr e = qdot_field_expr(f, groups.poly + i);
        qdot_constant_sign sign;

        if (e == QDOT_NIL)
            break;
        status = qdot_constant_decide(f->pool, e, &sign);
        if (status == QDOT_OK && sign == QDOT_CONSTANT_ZERO) {
            fmpz_mpoly_t key;

            fmpz_mpoly_init(key, f->ctx);
            fmpz_mpoly_push_term_si_ui(key, 1, groups.key + i * f->n, f->ctx);
            fmpz_mpoly_mul(key, key, groups.poly + i, f->ctx);
            fmpz_mpoly_sub(p, p, key, f->ctx);
            fmpz_mpoly_clear(key, f->ctx);
        }
    }
    qdot_factor_ungroup(f, &groups);
    qdot_free(by);
    return status;
}

/* --- splitting by one root --------------------------------------------------------- */

/* A polynomial split by a root r: p = P + Q R with R = r^power and R^order = B. */
struct split {
    fmpz_mpoly_t P, Q, B;
    slong order;
};

static void
split_init(qdot_field *f, struct split *s)
{
    fmpz_mpoly_init(s->P, f->ctx);
    fmpz_mpoly_init(s->Q, f->ctx);
    fmpz_mpoly_init(s->B, f->ctx);
}

static void
root_split_clear(qdot_field *f, struct split *s)
{
    fmpz_mpoly_clear(s->P, f->ctx);
    fmpz_mpoly_clear(s->Q, f->ctx);
    fmpz_mpoly_clear(s->B, f->ctx);
}

static slong
greatest_common_divisor(slong a, slong b)
{
    while (b != 0) {
        slong rest = a % b;

        a = b;
        b = rest;
    }
    return a;
}

/* The first root or absolute value in p behind generator `after` (-1: of all), of functions; where
 * there is none of any function, of a number, if there are relations. -1: no more. */
static slong
find_next_root(const qdot_zero *z, const fmpz_mpoly_t p, slong after)
{
    const qdot_field *f = z->f;
    slong constant = -1;

    for (slong v = after + 1; v < f->n; v++) {
        if ((f->gen[v].kind != QDOT_GEN_ROOT && f->gen[v].kind != QDOT_GEN_ABS) ||
            fmpz_mpoly_degree_si(p, v, f->ctx) == 0)
            continue;
        if (!qdot_expr_is_constant(f->pool, f->gen[v].expr))
            return v;
        if (constant < 0)
            constant = v;
    }
    return z->ideal == NULL || after >= 0 ? -1 : constant;
}

/* Split p into P + Q R by the root with variable v; false if p does not have that form. */
static bool
split_at(qdot_field *f, struct split *s, const fmpz_mpoly_t p, slong v)
{
    bool *by = qdot_calloc((size_t)f->n + 1, sizeof *by), fits = by != NULL;
    qdot_rule *rule = qdot_field_rule(f, v);
    qdot_groups groups;
    slong power = 0, shared;

    if (!fits || rule == NULL) {
        qdot_free(by);
        return false;
    }
    by[v] = true;
    fits = qdot_factor_group(f, &groups, p, by) == QDOT_OK && groups.n <= 2;
    for (slong i = 0; fits && i < groups.n; i++) {
        slong k = (slong)groups.key[i * f->n + v];

        if (k == 0) {
            fmpz_mpoly_set(s->P, groups.poly + i, f->ctx);
        } else if (power == 0) {
            fmpz_mpoly_set(s->Q, groups.poly + i, f->ctx);
            power = k;
        } else {
            fits = false;
        }
    }
    qdot_factor_ungroup(f, &groups);
    qdot_free(by);
    if (!fits || power == 0)
        return false;
    shared = greatest_common_divisor(power, rule->power);
    s->order = rule->power / shared;
    if (s->order < 2 || s->order > MOST_ORDER)
        return false;
    /* r^n = B, n = rule->power: R^order = B^(power/shared) */
    fmpz_mpoly_gen(s->B, v, f->ctx);
    fmpz_mpoly_pow_ui(s->B, s->B, (ulong)rule->power, f->ctx);
    fmpz_mpoly_sub(s->B, s->B, rule->poly, f->ctx);
    if (power / shared > 1) {
        qdot_ratio b;

        qdot_ratio_init(f, &b);
        fmpz_mpoly_set(b.n, s->B, f->ctx);
        qdot_ratio_pow(f, &b, &b, power / shared);
        fmpz_mpoly_set(s->B, b.n, f->ctx);
        qdot_ratio_clear(f, &b);
    }
    return qdot_field_goes(f);
}

/* Set n to the norm P^order - (-Q)^order B of the polynomial P + Q R, where R^order = B. */
static void
compute_norm(qdot_field *f, fmpz_mpoly_t n, const struct split *s)
{
    fmpz_mpoly_t a, b;

    fmpz_mpoly_init(a, f->ctx);
    fmpz_mpoly_init(b, f->ctx);
    fmpz_mpoly_one(a, f->ctx);
    fmpz_mpoly_one(b, f->ctx);
    for (slong i = 0; i < s->order && qdot_field_goes(f); i++) {
        qdot_field_mul(f, a, a, s->P);
        qdot_field_mul(f, b, b, s->Q);
    }
    qdot_field_mul(f, b, b, s->B);
    if (s->order % 2 == 0)
        fmpz_mpoly_sub(n, a, b, f->ctx);
    else
        fmpz_mpoly_add(n, a, b, f->ctx);
    fmpz_mpoly_clear(a, f->ctx);
    fmpz_mpoly_clear(b, f->ctx);
}

static bool
have_opposite_signs(qdot_zero *z, const struct split *s)
{
    uint8_t p = qdot_zero_sign(z, s->P), q = p == 0 ? 0 : qdot_zero_sign(z, s->Q);

    return ((p & QDOT_GE0) && (q & QDOT_LE0)) || ((p & QDOT_LE0) && (q & QDOT_GE0));
}

/* --- analytic functions on a connected domain -------------------------------------- */

/* Whether the bounds of x are constants, so that the domain is a product of intervals. */
static bool
has_constant_bounds(const qdot_pool *pool, qdot_expr x)
{
    const qdot_symbol *s = qdot_expr_symbol(pool, x);

    return (s->lo == QDOT_NIL || qdot_expr_is_constant(pool, s->lo)) &&
           (s->hi == QDOT_NIL || qdot_expr_is_constant(pool, s->hi));
}

/* Whether a function is analytic wherever its arguments are analytic. */
static bool
is_analytic_function(const qdot_pool *pool, qdot_expr e)
{
    uint8_t sign = qdot_expr_node(pool, qdot_expr_arg(pool, e, 0))->sign;

    return qdot_expr_is_function_that(pool, e, QDOT_FUN_ENTIRE) ||
           (qdot_expr_is_function(pool, e, QDOT_LOG) && (sign & QDOT_POS) == QDOT_POS);
}

static bool
is_analytic_product(const qdot_pool *pool, qdot_expr e)
{
    uint32_t n = qdot_expr_count(pool, e);

    for (uint32_t i = 1; i < n; i += 2) {
        uint8_t sign = qdot_expr_node(pool, qdot_expr_arg(pool, e, i))->sign;
        const fmpq *x = qdot_expr_rational(pool, qdot_expr_arg(pool, e, i + 1));

        if (x == NULL)
            return false;
        if (!fmpz_is_one(fmpq_denref(x))) {
            if ((sign & QDOT_POS) != QDOT_POS)
                return false;
        } else if (fmpq_sgn(x) < 0 && !(sign & QDOT_NE0)) {
            return false;
        }
    }
    return true;
}

/* Whether e is analytic on its whole declared domain, which must be connected. */
static bool
is_analytic(const qdot_pool *pool, qdot_expr e)
{
    bool all = true;
    qdot_walk w;

    if (qdot_walk_begin(pool, e, &w) != QDOT_OK)
        return false;
    for (size_t i = 0; i < w.n && all; i++)
        switch (qdot_expr_kind(pool, w.at[i])) {
        case QDOT_NUM:
        case QDOT_SUM:
        case QDOT_UFUN: break; /* an undefined function is a variable of its own */
        case QDOT_SYM: all = has_constant_bounds(pool, w.at[i]); break;
        case QDOT_PROD: all = is_analytic_product(pool, w.at[i]); break;
        case QDOT_FUN: all = is_analytic_function(pool, w.at[i]); break;
        default: all = false;
        }
    qdot_walk_end(&w);
    return all;
}

/* Whether e is surely not zero at some point of the domain. */
static bool
differs_somewhere(qdot_pool *pool, qdot_expr e)
{
    bool differs = false;
    qdot_sample s;

    if (e == QDOT_NIL || qdot_sample_begin(&s, pool, 1, &e, NULL) != QDOT_OK)
        return false;
    for (int k = 0; k < POINTS && s.possible && !differs; k++) {
        arb_srcptr value;

        qdot_sample_point(&s, k);
        if (qdot_sample_eval(&s, 256)) {
            value = qdot_ball_get(&s.ball, e);
            differs = value != NULL && !arb_contains_zero(value);
        }
    }
    qdot_sample_end(&s);
    return differs;
}

/* Of a generator: a root also where its base is positive by what is known of the field. depth bounds
 * the recursion into the generators of the base. */
static bool
is_analytic_generator(qdot_zero *z, slong v, int depth)
{
    qdot_field *f = z->f;
    const qdot_gen *gen = &f->gen[v];
    const qdot_ratio *b;
    bool positive = false;
    fmpz_mpoly_t p;

    if (is_analytic(f->pool, gen->expr))
        return true;
    if (gen->kind != QDOT_GEN_ROOT || !z->sure || depth <= 0)
        return false;
    b = qdot_field_value(f, gen->of);
    if (b == NULL)
        return false;
    fmpz_mpoly_init(p, f->ctx); /* n/d > 0 is equivalent to n d > 0 */
    qdot_field_mul(f, p, b->n, b->d);
    if (qdot_field_goes(f))
        positive = (qdot_zero_sign(z, p) & QDOT_POS) == QDOT_POS;
    fmpz_mpoly_clear(p, f->ctx);
    for (slong w = 0; w < f->n && positive; w++)
        if (fmpz_mpoly_degree_si(b->n, w, f->ctx) > 0 ||
            fmpz_mpoly_degree_si(b->d, w, f->ctx) > 0)
            positive = is_analytic_generator(z, w, depth - 1);
    return positive;
}

/* Whether P - Q R is analytic, as p = P + Q R is, and not zero everywhere. */
static bool
other_branch_is_nonzero(qdot_zero *z, const fmpz_mpoly_t p, const struct split *s)
{
    qdot_field *f = z->f;
    fmpz_mpoly_t other;
    bool all = z->ideal == NULL;

    for (slong v = 0; v < f->n && all; v++)
        if (fmpz_mpoly_degree_si(p, v, f->ctx) > 0)
            all = is_analytic_generator(z, v, MOST_NESTED);
    if (!all)
        return false;
    fmpz_mpoly_init(other, f->ctx);
    fmpz_mpoly_scalar_mul_si(other, s->P, 2, f->ctx);
    fmpz_mpoly_sub(other, other, p, f->ctx);
    all = differs_somewhere(f->pool, qdot_field_expr(f, other));
    fmpz_mpoly_clear(other, f->ctx);
    return all;
}

/* --- the whole proof --------------------------------------------------------------- */

static qdot_status zero_prove(qdot_zero *z, const fmpz_mpoly_t p, int depth, bool *zero);

/* Whether p is proved to be 0 if its norm over the root v is 0. */
static bool
is_zero_if_norm_is(qdot_zero *z, const fmpz_mpoly_t p, struct split *s, slong v)
{
    return split_at(z->f, s, p, v) &&
           (s->order % 2 != 0 || have_opposite_signs(z, s) || other_branch_is_nonzero(z, p, s));
}

/* Prove that an irreducible factor is zero, by its norm over the outermost root about which enough is known. */
static qdot_status
prove_factor(qdot_zero *z, const fmpz_mpoly_t p, int depth, bool *zero)
{
    qdot_field *f = z->f;
    qdot_status status = QDOT_OK;
    bool found = false;

    for (slong v = find_next_root(z, p, -1); v >= 0 && depth > 0 && !found; v = find_next_root(z, p, v)) {
        struct split s;
        fmpz_mpoly_t n;

        split_init(f, &s);
        fmpz_mpoly_init(n, f->ctx);
        found = is_zero_if_norm_is(z, p, &s, v);
        if (found) {
            compute_norm(f, n, &s);
            if (qdot_field_goes(f))
                status = zero_prove(z, n, depth - 1, zero);
        }
        fmpz_mpoly_clear(n, f->ctx);
        root_split_clear(f, &s);
    }
    return status;
}

/* Prove p = 0; depth bounds the recursion, each level of which has one root less. */
static qdot_status
zero_prove(qdot_zero *z, const fmpz_mpoly_t p, int depth, bool *zero)
{
    qdot_field *f = z->f;
    qdot_status status = QDOT_OK;
    qdot_factors factors;
    fmpz_mpoly_t q;

    *zero = false;
    fmpz_mpoly_init(q, f->ctx);
    fmpz_mpoly_set(q, p, f->ctx);
    reduce_by_ideal(z, q);
    if (qdot_field_goes(f) && contains_constants(f, q))
        status = drop_zero_coefficients(f, q);
    if (status == QDOT_OK && qdot_field_goes(f)) {
        *zero = fmpz_mpoly_is_zero(q, f->ctx);
        if (!*zero)
            status = qdot_zero_logarithms(z, q, zero);
        if (status == QDOT_OK && !*zero)
            status = qdot_zero_angles(z, q, zero);
        if (status == QDOT_OK && !*zero && find_next_root(z, q, -1) >= 0 &&
            fmpz_mpoly_length(q, f->ctx) < MOST_TERMS) {
            status = qdot_factor(f, &factors, q);
            for (slong i = 0; i < factors.n && status == QDOT_OK && !*zero; i++)
                if (qdot_field_goes(f))
                    status = prove_factor(z, factors.poly + i, depth, zero);
            qdot_factor_clear(f, &factors);
        }
    }
    fmpz_mpoly_clear(q, f->ctx);
    *zero &= status == QDOT_OK && qdot_field_goes(f);
    return status;
}

qdot_status
qdot_zero_prove(qdot_zero *z, const fmpz_mpoly_t p, bool *zero)
{
    return zero_prove(z, p, MOST_DEPTH, zero);
}
