/* denominators.c -- coefficients of velocities, or of the derivatives of a function, over what is
 * left of a denominator below each, those with equal denominators together:
 *
 *     (d u'' + 2 v u' v' + u u'^2)/d = u'' + (2 v u' v' + u u'^2)/d.
 */
#include "base/memory.h"
#include "expr/build.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "normal/field/factor.h"
#include "normal/form/form.h"
#include "normal/form/products.h"

enum { MOST_PARTS = 40, MOST_TURNS = 4 };

/* One part of a sum: k n/d times a monomial, with primitive polynomials n and d. */
struct part {
    qdot_ratio r;
    fmpq_t k;
    slong key; /* index of the group of terms to which the part belongs */
    bool said;
    qdot_expr own, shared; /* k n/d as a product: with its own denominator; with a common one, of powers of sums */
};

struct parts {
    qdot_form *form;
    qdot_field *f;
    struct part at[MOST_PARTS];
    slong n;
    qdot_groups groups;
    fmpz_mpoly_t above, below; /* factors common to all numerators; factors common to all denominators */
};

static slong
quotient_length(const qdot_field *f, const qdot_ratio *r)
{
    return fmpz_mpoly_length(r->n, f->ctx) + fmpz_mpoly_length(r->d, f->ctx) +
           fmpz_mpoly_total_degree_si(r->d, f->ctx);
}

/* Cancel a quotient, also with c^2 = 1 - s^2 for one angle if that cancels more. */
static void
cancel_quotient(qdot_field *f, qdot_ratio *r)
{
    qdot_ratio x, from;
    int turns = 0;

    qdot_ratio_init(f, &from);
    qdot_ratio_set(f, &from, r);
    qdot_ratio_cancel(f, r);
    for (slong v = 0; v < f->n && turns < MOST_TURNS && qdot_field_goes(f); v++) {
        if ((f->gen[v].kind != QDOT_GEN_COS && f->gen[v].kind != QDOT_GEN_COSH) ||
            fmpz_mpoly_degree_si(from.d, v, f->ctx) < 2)
            continue;
        turns++;
        qdot_ratio_init(f, &x);
        if (qdot_factor_flip(f, x.n, from.n, v) == QDOT_OK &&
            qdot_factor_flip(f, x.d, from.d, v) == QDOT_OK && qdot_field_goes(f) &&
            !fmpz_mpoly_is_zero(x.d, f->ctx)) {
            qdot_ratio_cancel(f, &x);
            /* reduce squares of sines to cosines again, so that equal denominators are recognised */
            qdot_field_reduce(f, x.n);
            qdot_field_reduce(f, x.d);
            if (quotient_length(f, &x) < quotient_length(f, r))
                qdot_ratio_set(f, r, &x);
        }
        qdot_ratio_clear(f, &x);
    }
    qdot_ratio_clear(f, &from);
}

/* Compute the coefficients as cancelled fractions; false if there are too few or too many of them. */
static bool
fractions_begin(struct parts *p, qdot_form *form, const qdot_ratio *r, const fmpq_t c)
{
    qdot_field *f = form->f;

    *p = (struct parts){.form = form, .f = f};
    fmpz_mpoly_init(p->above, f->ctx);
    fmpz_mpoly_init(p->below, f->ctx);
    if (qdot_factor_group(f, &p->groups, r->n, form->fast) != QDOT_OK) {
        qdot_pool_fail(f->pool);
        return false;
    }
    if (p->groups.n < 2 || p->groups.n > MOST_PARTS)
        return false;
    for (slong i = 0; i < p->groups.n && qdot_field_goes(f); i++) {
        struct part *one = &p->at[p->n++];

        qdot_ratio_init(f, &one->r);
        fmpq_init(one->k);
        one->key = i;
        one->said = false;
        fmpz_mpoly_set(one->r.n, p->groups.poly + i, f->ctx);
        fmpz_mpoly_set(one->r.d, r->d, f->ctx);
        cancel_quotient(f, &one->r);
        qdot_ratio_content(f, one->k, &one->r);
        fmpq_mul(one->k, one->k, c);
        if (i == 0) {
            fmpz_mpoly_set(p->above, one->r.n, f->ctx);
            fmpz_mpoly_set(p->below, one->r.d, f->ctx);
        } else {
            qdot_field_gcd(f, p->above, p->above, one->r.n);
            qdot_field_gcd(f, p->below, p->below, one->r.d);
        }
    }
    return qdot_field_goes(f);
}

static void
fractions_end(struct parts *p)
{
    for (slong i = 0; i < p->n; i++) {
        qdot_ratio_clear(p->f, &p->at[i].r);
        fmpq_clear(p->at[i].k);
    }
    qdot_factor_ungroup(p->f, &p->groups);
    fmpz_mpoly_clear(p->above, p->f->ctx);
    fmpz_mpoly_clear(p->below, p->f->ctx);
}

/* A denominator; its sign is free: sinh(u)^2 + sin(v)^2, not -(cos(v)^2 - cosh(u)^2); what its
 * terms share stands in front. */
static qdot_expr
write_denominator(struct parts *p, const fmpz_mpoly_t d)
{
    qdot_field *f = p->f;
    qdot_expr best, e, shared;
    fmpz_mpoly_t rest, front;

    if (!qdot_form_has_trig(p->form, d))
        return qdot_form_coefficient(p->form, d);
    fmpz_mpoly_init(rest, f->ctx);
    fmpz_mpoly_init(front, f->ctx);
    fmpz_mpoly_term_content(front, d, f->ctx);
    fmpz_mpoly_divides(rest, d, front, f->ctx);
    shared = qdot_field_expr(f, front);
    e = best = qdot_form_coefficient(p->form, rest);
    fmpz_mpoly_neg(rest, rest, f->ctx);
    qdot_form_keep(f->pool, &best, qdot_form_coefficient(p->form, rest));
    fmpz_mpoly_clear(rest, f->ctx);
    fmpz_mpoly_clear(front, f->ctx);
    return qdot_mul(f->pool, shared, best == e ? e : qdot_neg(f->pool, best));
}

/* Replace cos(a)/sin(a) by cot(a) where that is shorter. */
static qdot_expr
write_cotangents(qdot_pool *pool, qdot_expr e)
{
    qdot_form_keep(pool, &e, qdot_products_tangents(pool, e));
    return e;
}

/* Write all fractions that have the same denominator as fraction i as one quotient. */
static qdot_expr
write_fraction_group(struct parts *p, slong i)
{
    qdot_field *f = p->f;
    const struct part *first = &p->at[i];
    fmpz_mpoly_t sum, term, monomial;
    qdot_expr e;
    fmpz_t lcm, k;
    fmpq_t front;

    fmpz_init_set_ui(lcm, 1);
    fmpz_init(k);
    fmpq_init(front);
    fmpz_mpoly_init(sum, f->ctx);
    fmpz_mpoly_init(term, f->ctx);
    fmpz_mpoly_init(monomial, f->ctx);
    for (slong j = i; j < p->n; j++)
        if (fmpz_mpoly_equal(p->at[j].r.d, first->r.d, f->ctx))
            fmpz_lcm(lcm, lcm, fmpq_denref(p->at[j].k));
    for (slong j = i; j < p->n; j++) {
        struct part *one = &p->at[j];

        if (!fmpz_mpoly_equal(one->r.d, first->r.d, f->ctx))
            continue;
        one->said = true;
        fmpz_mpoly_zero(monomial, f->ctx);
        fmpz_mpoly_push_term_si_ui(monomial, 1, p->groups.key + one->key * f->n, f->ctx);
        fmpz_mpoly_mul(term, one->r.n, monomial, f->ctx);
        fmpz_divexact(k, lcm, fmpq_denref(one->k));
        fmpz_mul(k, k, fmpq_numref(one->k));
        fmpz_mpoly_scalar_mul_fmpz(term, term, k, f->ctx);
        fmpz_mpoly_add(sum, sum, term, f->ctx);
    }
    qdot_field_primitive(f, k, sum, sum, false);
    fmpq_set_fmpz_frac(front, k, lcm);
    p->form->quotient = !fmpz_mpoly_is_one(first->r.d, f->ctx);
    e = qdot_div(f->pool, qdot_form_say(p->form, sum, front), write_denominator(p, first->r.d));
    e = write_cotangents(f->pool, e);
    fmpz_mpoly_clear(sum, f->ctx);
    fmpz_mpoly_clear(term, f->ctx);
    fmpz_mpoly_clear(monomial, f->ctx);
    fmpz_clear(lcm);
    fmpz_clear(k);
    fmpq_clear(front);
    return e;
}

static qdot_expr
write_all_fractions(struct parts *p)
{
    qdot_expr sum = QDOT_ZERO;

    for (slong i = 0; i < p->n; i++)
        p->at[i].said = false;
    for (slong i = 0; i < p->n; i++)
        if (!p->at[i].said)
            sum = qdot_add(p->f->pool, sum, write_fraction_group(p, i));
    return sum;
}

/* Which powers of sums form the key of a fraction: those in the numerator, in the denominator, or all. */
enum which { ABOVE = 1, BELOW = 2 };

static qdot_expr
powers_of_sums(qdot_pool *pool, qdot_expr e, unsigned which)
{
    qdot_expr sums = QDOT_ONE;

    for (uint32_t i = 1;
         qdot_expr_kind(pool, e) == QDOT_PROD && i < qdot_expr_count(pool, e); i += 2) {
        qdot_expr b = qdot_expr_arg(pool, e, i), x = qdot_expr_arg(pool, e, i + 1);

        if (qdot_expr_kind(pool, b) == QDOT_SUM &&
            (which & (qdot_expr_is_negative(pool, x) ? BELOW : ABOVE)))
            sums = qdot_mul(pool, sums, qdot_pow(pool, b, x));
    }
    return sums;
}

static void
write_fraction(struct parts *p, struct part *one, unsigned which)
{
    qdot_pool *pool = p->f->pool;
    qdot_expr e;

    p->form->quotient = !fmpz_mpoly_is_one(one->r.d, p->f->ctx);
    e = qdot_div(pool, qdot_form_say(p->form, one->r.n, one->k), write_denominator(p, one->r.d));
    e = write_cotangents(pool, e);
    one->shared = e == QDOT_NIL ? e : powers_of_sums(pool, e, which);
    one->own = qdot_div(pool, e, one->shared);
    one->said = false;
}

/* Write the factors of fraction i other than the sums, with like terms merged. */
static qdot_expr
write_other_factors(struct parts *p, slong i)
{
    qdot_pool *pool = p->f->pool;
    qdot_expr sum = QDOT_ZERO;
    fmpq_t one;

    fmpq_init(one);
    fmpq_one(one);
    for (slong j = i; j < p->n; j++) {
        qdot_expr alike = QDOT_ZERO, own = p->at[j].own, minus = qdot_neg(pool, own);

        for (slong k = j; k < p->n; k++) {
            struct part *other = &p->at[k];
            qdot_expr monomial;

            if (other->said || other->shared != p->at[i].shared ||
                (other->own != own && other->own != minus))
                continue;
            other->said = true;
            monomial =
                qdot_form_monomial(p->f, one, p->groups.key + other->key * p->f->n);
            alike = other->own == own ? qdot_add(pool, alike, monomial)
                                      : qdot_sub(pool, alike, monomial);
        }
        sum = qdot_add(pool, sum, qdot_mul(pool, p->at[j].own, alike));
    }
    fmpq_clear(one);
    return sum;
}

/* The parts with the same sums above or below together, what else there is with each:
 * (f_uu + f_u/u)/(u^2 + v^2). */
static qdot_expr
write_grouped_by_sums(struct parts *p, unsigned which)
{
    qdot_pool *pool = p->f->pool;
    qdot_expr sum = QDOT_ZERO;

    for (slong i = 0; i < p->n; i++)
        write_fraction(p, &p->at[i], which);
    for (slong i = 0; i < p->n; i++)
        if (!p->at[i].said)
            sum = qdot_add(pool, sum, qdot_mul(pool, write_other_factors(p, i), p->at[i].shared));
    return sum;
}

/* Take common factors of all numerators and denominators out; false if there are none. */
static bool
take_out_common_factors(struct parts *p)
{
    qdot_field *f = p->f;

    if (fmpz_mpoly_is_fmpz(p->above, f->ctx) && fmpz_mpoly_is_fmpz(p->below, f->ctx))
        return false;
    for (slong i = 0; i < p->n; i++) {
        qdot_ratio *r = &p->at[i].r;

        if (!fmpz_mpoly_divides(r->n, r->n, p->above, f->ctx) ||
            !fmpz_mpoly_divides(r->d, r->d, p->below, f->ctx))
            return false;
    }
    return true;
}

/* What moves: derivatives of functions or differentials. Fractions over fractions are theirs, not
 * those of velocities and momenta. */
static bool
has_moving_functions(const qdot_form *form, uint32_t differential)
{
    const qdot_field *f = form->f;

    for (slong v = 0; v < f->n; v++) {
        uint32_t holds = qdot_expr_node(f->pool, f->gen[v].expr)->holds;

        if (form->fast[v] && (!f->gen[v].fast || (holds & differential)))
            return true;
    }
    return false;
}

static void
try_all_groupings(struct parts *p, qdot_expr front, qdot_expr *best)
{
    qdot_pool *pool = p->f->pool;
    unsigned last = has_moving_functions(p->form, 0) ? (ABOVE | BELOW) : ABOVE;

    qdot_form_keep(pool, best, qdot_mul(pool, front, write_all_fractions(p)));
    for (unsigned which = ABOVE; which <= last; which++)
        qdot_form_keep(pool, best, qdot_mul(pool, front, write_grouped_by_sums(p, which)));
}

void
qdot_form_say_apart(qdot_form *form, const qdot_ratio *r, const fmpq_t c, qdot_expr *best)
{
    qdot_pool *pool = form->f->pool;
    bool quotient = form->quotient;
    struct parts p;

    if (fractions_begin(&p, form, r, c)) {
        try_all_groupings(&p, QDOT_ONE, best);
        if (has_moving_functions(form, QDOT_HAS_DIFFERENTIAL) && take_out_common_factors(&p)) {
            qdot_expr out = QDOT_NIL;

            try_all_groupings(&p,
                              qdot_div(pool, qdot_form_coefficient(form, p.above),
                                       write_denominator(&p, p.below)),
                              &out);
            if (out != QDOT_NIL && *best != QDOT_NIL &&
                qdot_expr_size(pool, out) <= qdot_expr_size(pool, *best))
                *best = out;
        }
    }
    fractions_end(&p);
    form->quotient = quotient;
}
