/* ratio.c -- calculates with quotients in a field: calls FLINT within a budget and applies the
 * field's rules. */
#include "normal/field/ratio.h"

#include "base/interrupt.h"
#include "base/memory.h"
#include "expr/build.h"
#include "expr/exact.h"

/* A gcd that would cost more than this is not computed; the quotient then stays uncancelled, which
 * is correct. */
#define GCD_COST 60000
#define GCD_COST_PATIENT 4000000
#define GCD_VARIABLES 40

bool
qdot_field_goes(const qdot_field *f)
{
    return f->state == QDOT_FIELD_GOES;
}

bool
qdot_field_charge(qdot_field *f, int64_t a, int64_t b)
{
    if (f->state != QDOT_FIELD_GOES)
        return false;
    if (qdot_interrupt_is_set()) {
        f->state = QDOT_FIELD_FAILED;
        f->status = qdot_interrupt_check();
        return false;
    }
    if (a > 1000000000 || b > 1000000000 ||
        (f->work -= (a + 1) * (b + 1) * (1 + f->n / 8)) < 0) {
        f->state = QDOT_FIELD_OVER;
        return false;
    }
    return true;
}

void
qdot_field_reduce(qdot_field *f, fmpz_mpoly_t p)
{
    fmpz_mpoly_t q;

    fmpz_mpoly_init(q, f->ctx);
    for (size_t i = 0; i < f->n_rules; i++) {
        const qdot_rule *rule = &f->rule[i];
        slong degree;

        if (rule->power == 0)
            continue;
        degree = fmpz_mpoly_degree_si(p, rule->var, f->ctx);
        if (degree < rule->power)
            continue;
        if (!qdot_field_charge(f, (int64_t)fmpz_mpoly_length(p, f->ctx) * (degree / rule->power),
                               fmpz_mpoly_length(rule->poly, f->ctx)))
            break;
        fmpz_mpoly_divrem(q, p, p, rule->poly, f->ctx);
    }
    fmpz_mpoly_clear(q, f->ctx);
}

void
qdot_field_mul(qdot_field *f, fmpz_mpoly_t a, const fmpz_mpoly_t b, const fmpz_mpoly_t c)
{
    if (!qdot_field_charge(f, fmpz_mpoly_length(b, f->ctx), fmpz_mpoly_length(c, f->ctx)))
        return;
    fmpz_mpoly_mul(a, b, c, f->ctx);
    qdot_field_reduce(f, a);
}

void
qdot_field_gcd(qdot_field *f, fmpz_mpoly_t g, const fmpz_mpoly_t a, const fmpz_mpoly_t b)
{
    slong la = fmpz_mpoly_length(a, f->ctx), lb = fmpz_mpoly_length(b, f->ctx);

    if (!qdot_field_charge(f, la, lb) || la == 0 || lb == 0 || (int64_t)la * lb > (f->patient ? GCD_COST_PATIENT : GCD_COST) ||
        f->n > GCD_VARIABLES || !fmpz_mpoly_gcd(g, a, b, f->ctx))
        fmpz_mpoly_one(g, f->ctx);
}

/* --- arithmetic of quotients ------------------------------------------------------- */

void
qdot_ratio_init(qdot_field *f, qdot_ratio *r)
{
    fmpz_mpoly_init(r->n, f->ctx);
    fmpz_mpoly_init(r->d, f->ctx);
    fmpz_mpoly_one(r->d, f->ctx);
}

void
qdot_ratio_clear(qdot_field *f, qdot_ratio *r)
{
    fmpz_mpoly_clear(r->n, f->ctx);
    fmpz_mpoly_clear(r->d, f->ctx);
}

void
qdot_ratio_set(qdot_field *f, qdot_ratio *r, const qdot_ratio *a)
{
    fmpz_mpoly_set(r->n, a->n, f->ctx);
    fmpz_mpoly_set(r->d, a->d, f->ctx);
}

/* If the denominator of r is zero, set the field's state to undefined, and the denominator to 1. */
static void
check_denominator(qdot_field *f, qdot_ratio *r)
{
    if (!fmpz_mpoly_is_zero(r->d, f->ctx))
        return;
    fmpz_mpoly_one(r->d, f->ctx);
    if (f->state == QDOT_FIELD_GOES)
        f->state = QDOT_FIELD_UNDEFINED;
}

void
qdot_ratio_add(qdot_field *f, qdot_ratio *r, const qdot_ratio *a, const qdot_ratio *b)
{
    fmpz_mpoly_t g, u, v, x, y;

    if (!qdot_field_goes(f))
        return;
    if (fmpz_mpoly_equal(a->d, b->d, f->ctx)) {
        fmpz_mpoly_add(r->n, a->n, b->n, f->ctx);
        fmpz_mpoly_set(r->d, a->d, f->ctx);
        return;
    }
    fmpz_mpoly_init(g, f->ctx);
    fmpz_mpoly_init(u, f->ctx);
    fmpz_mpoly_init(v, f->ctx);
    fmpz_mpoly_init(x, f->ctx);
    fmpz_mpoly_init(y, f->ctx);
    qdot_field_gcd(f, g, a->d, b->d);
    fmpz_mpoly_divides(u, a->d, g, f->ctx);
    fmpz_mpoly_divides(v, b->d, g, f->ctx);
    qdot_field_mul(f, x, a->n, v);
    qdot_field_mul(f, y, b->n, u);
    fmpz_mpoly_add(r->n, x, y, f->ctx);
    qdot_field_mul(f, r->d, a->d, v);
    check_denominator(f, r);
    fmpz_mpoly_clear(g, f->ctx);
    fmpz_mpoly_clear(u, f->ctx);
    fmpz_mpoly_clear(v, f->ctx);
    fmpz_mpoly_clear(x, f->ctx);
    fmpz_mpoly_clear(y, f->ctx);
}

void
qdot_ratio_sub(qdot_field *f, qdot_ratio *r, const qdot_ratio *a, const qdot_ratio *b)
{
    qdot_ratio minus;

    qdot_ratio_init(f, &minus);
    qdot_ratio_set(f, &minus, b);
    fmpz_mpoly_neg(minus.n, minus.n, f->ctx);
    qdot_ratio_add(f, r, a, &minus);
    qdot_ratio_clear(f, &minus);
}

void
qdot_ratio_mul(qdot_field *f, qdot_ratio *r, const qdot_ratio *a, const qdot_ratio *b)
{
    bool several;

    if (!qdot_field_goes(f))
        return;
    qdot_field_mul(f, r->n, a->n, b->n);
    qdot_field_mul(f, r->d, a->d, b->d);
    check_denominator(f, r);
    several = fmpz_mpoly_length(r->n, f->ctx) > 1 && fmpz_mpoly_length(r->d, f->ctx) > 1;
    if (several &&
        fmpz_mpoly_length(r->n, f->ctx) * fmpz_mpoly_length(r->d, f->ctx) < 2500)
        qdot_ratio_cancel(f, r);
}

void
qdot_ratio_div(qdot_field *f, qdot_ratio *r, const qdot_ratio *a, const qdot_ratio *b)
{
    qdot_ratio inverse;

    if (!qdot_field_goes(f))
        return;
    if (fmpz_mpoly_is_zero(b->n, f->ctx)) {
        f->state = QDOT_FIELD_UNDEFINED;
        return;
    }
    qdot_ratio_init(f, &inverse);
    fmpz_mpoly_set(inverse.n, b->d, f->ctx);
    fmpz_mpoly_set(inverse.d, b->n, f->ctx);
    qdot_ratio_mul(f, r, a, &inverse);
    qdot_ratio_clear(f, &inverse);
}

/* An upper bound of the number of terms of the n-th power of a polynomial with `length` terms. */
static int64_t
bound_terms_of_power(int64_t length, int64_t n)
{
    double terms = 1;

    if (length <= 1)
        return length;
    for (int64_t k = 1; k < length && terms < 1e9; k++)
        terms = terms * (double)(n + k) / (double)k;
    return (int64_t)terms;
}

static void
poly_pow(qdot_field *f, fmpz_mpoly_t r, const fmpz_mpoly_t a, int64_t n)
{
    slong length = fmpz_mpoly_length(a, f->ctx);

    if (n == 1) {
        fmpz_mpoly_set(r, a, f->ctx);
        return;
    }
    /* limit n apart from the budget, which counts only terms: the number 2^n alone has n bits */
    if (n > 100000) {
        if (f->state == QDOT_FIELD_GOES && !fmpz_mpoly_is_one(a, f->ctx))
            f->state = QDOT_FIELD_OVER;
        return;
    }
    if (!qdot_field_charge(f, bound_terms_of_power(length, n), length > 1 ? length : 0))
        return;
    fmpz_mpoly_pow_ui(r, a, (ulong)n, f->ctx);
    qdot_field_reduce(f, r);
}

void
qdot_ratio_pow(qdot_field *f, qdot_ratio *r, const qdot_ratio *a, int64_t n)
{
    if (!qdot_field_goes(f))
        return;
    if (n < 0 && fmpz_mpoly_is_zero(a->n, f->ctx)) {
        f->state = QDOT_FIELD_UNDEFINED;
        return;
    }
    poly_pow(f, r->n, a->n, n < 0 ? -n : n);
    poly_pow(f, r->d, a->d, n < 0 ? -n : n);
    if (n < 0)
        fmpz_mpoly_swap(r->n, r->d, f->ctx);
    check_denominator(f, r);
}

void
qdot_ratio_scale(qdot_field *f, qdot_ratio *r, const fmpq_t c)
{
    if (!qdot_field_goes(f))
        return;
    fmpz_mpoly_scalar_mul_fmpz(r->n, r->n, fmpq_numref(c), f->ctx);
    fmpz_mpoly_scalar_mul_fmpz(r->d, r->d, fmpq_denref(c), f->ctx);
}

void
qdot_ratio_cancel(qdot_field *f, qdot_ratio *r)
{
    fmpz_mpoly_t g;

    if (!qdot_field_goes(f))
        return;
    if (fmpz_mpoly_is_zero(r->n, f->ctx)) {
        fmpz_mpoly_one(r->d, f->ctx);
        return;
    }
    if (fmpz_mpoly_is_one(r->d, f->ctx))
        return;
    fmpz_mpoly_init(g, f->ctx);
    qdot_field_gcd(f, g, r->n, r->d);
    if (!fmpz_mpoly_is_one(g, f->ctx)) {
        fmpz_mpoly_divides(r->n, r->n, g, f->ctx);
        fmpz_mpoly_divides(r->d, r->d, g, f->ctx);
    }
    if (fmpz_sgn(fmpz_mpoly_leadcoeff(r->d)) < 0) {
        fmpz_mpoly_neg(r->n, r->n, f->ctx);
        fmpz_mpoly_neg(r->d, r->d, f->ctx);
    }
    fmpz_mpoly_clear(g, f->ctx);
}

/* --- back to expressions ----------------------------------------------------------- */

qdot_expr
qdot_field_expr(qdot_field *f, const fmpz_mpoly_t p)
{
    slong length = fmpz_mpoly_length(p, f->ctx);
    qdot_expr *term = qdot_malloc(((size_t)length + 1) * sizeof *term);
    qdot_expr *factor = qdot_malloc(((size_t)f->n + 1) * sizeof *factor), e = QDOT_NIL;
    ulong *exp = qdot_malloc(((size_t)f->n + 1) * sizeof *exp);
    fmpq_t c;

    fmpq_init(c);
    if (term == NULL || factor == NULL || exp == NULL) {
        qdot_pool_fail(f->pool);
        length = -1;
    }
    for (slong i = 0; i < length && !qdot_pool_failed(f->pool); i++) {
        size_t n = 0;

        fmpz_mpoly_get_term_coeff_fmpz(fmpq_numref(c), p, i, f->ctx);
        fmpz_mpoly_get_term_exp_ui(exp, p, i, f->ctx);
        factor[n++] = qdot_expr_fmpq(f->pool, c);
        for (slong v = 0; v < f->n; v++)
            if (exp[v] != 0)
                factor[n++] = qdot_pow_int(f->pool, f->gen[v].expr, (int64_t)exp[v]);
        term[i] = qdot_product(f->pool, n, factor);
    }
    if (length >= 0 && !qdot_pool_failed(f->pool))
        e = qdot_sum(f->pool, (size_t)length, term);
    fmpq_clear(c);
    qdot_free(term);
    qdot_free(factor);
    qdot_free(exp);
    return e;
}

qdot_expr
qdot_field_ratio_expr(qdot_field *f, const qdot_ratio *r)
{
    qdot_expr n = qdot_field_expr(f, r->n);

    if (fmpz_mpoly_is_one(r->d, f->ctx))
        return n;
    return qdot_div(f->pool, n, qdot_field_expr(f, r->d));
}

void
qdot_ratio_content(qdot_field *f, fmpq_t k, qdot_ratio *r)
{
    fmpz_t n, d;

    fmpz_init(n);
    fmpz_init(d);
    qdot_field_primitive(f, n, r->n, r->n, false);
    qdot_field_primitive(f, d, r->d, r->d, true);
    fmpq_set_fmpz_frac(k, n, d);
    fmpz_clear(n);
    fmpz_clear(d);
}

slong
qdot_field_var(const qdot_field *f, qdot_expr e)
{
    uint32_t v;

    return qdot_map_get(&f->vars, e, &v) ? (slong)v : -1;
}

qdot_rule *
qdot_field_rule(const qdot_field *f, slong v)
{
    for (size_t i = 0; i < f->n_rules; i++)
        if (f->rule[i].var == v && f->rule[i].power > 0)
            return &f->rule[i];
    return NULL;
}

void
qdot_field_primitive(qdot_field *f, fmpz_t c, fmpz_mpoly_t primitive, const fmpz_mpoly_t p,
                     bool positive)
{
    _fmpz_vec_content(c, p->coeffs, fmpz_mpoly_length(p, f->ctx));
    if (positive && fmpz_sgn(fmpz_mpoly_leadcoeff(p)) < 0)
        fmpz_neg(c, c);
    fmpz_mpoly_scalar_divexact_fmpz(primitive, p, c, f->ctx);
}
