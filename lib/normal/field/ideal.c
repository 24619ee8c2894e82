/* ideal.c -- Buchberger's algorithm within a budget. */
#include "normal/field/ideal.h"

#include <string.h>

#include "base/memory.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "normal/field/factor.h"

enum { MOST_PAIRS = 400, MOST_POLYS = 48, MOST_TERMS = 400 };

static bool
polynomial_never_zero(qdot_field *f, const fmpz_mpoly_t p, bool generic)
{
    qdot_expr e = qdot_field_expr(f, p);
    const qdot_node *node;

    if (e == QDOT_NIL)
        return false;
    node = qdot_expr_node(f->pool, e);
    return (node->sign & QDOT_NE0) ||
           (generic && !(node->holds & ~(uint32_t)QDOT_HAS_PARAM));
}

/* Remove from p all powers and factors that are never 0; if nothing else is left p stays as it is. */
static qdot_status
polynomial_strip(qdot_field *f, fmpz_mpoly_t p, bool generic)
{
    qdot_factors factors;
    fmpz_mpoly_t rest;
    qdot_status status = qdot_factor(f, &factors, p);

    fmpz_mpoly_init(rest, f->ctx);
    fmpz_mpoly_one(rest, f->ctx);
    for (slong i = 0; i < factors.n && status == QDOT_OK; i++)
        if (!polynomial_never_zero(f, factors.poly + i, generic))
            qdot_field_mul(f, rest, rest, factors.poly + i);
    if (status == QDOT_OK && !fmpz_mpoly_is_fmpz(rest, f->ctx))
        fmpz_mpoly_swap(p, rest, f->ctx);
    fmpz_mpoly_clear(rest, f->ctx);
    qdot_factor_clear(f, &factors);
    return status;
}

static qdot_status
ideal_add(qdot_ideal *ideal, qdot_field *f, const fmpz_mpoly_t p)
{
    fmpz_mpoly_struct *copy = qdot_malloc(sizeof *copy);

    if (copy == NULL || qdot_grow(&ideal->poly, &ideal->capacity, ideal->n + 1,
                                  sizeof *ideal->poly) != QDOT_OK) {
        qdot_free(copy);
        return QDOT_ENOMEM;
    }
    fmpz_mpoly_init(copy, f->ctx);
    fmpz_mpoly_set(copy, p, f->ctx);
    ideal->poly[ideal->n++] = copy;
    return QDOT_OK;
}

void
qdot_ideal_reduce(const qdot_ideal *ideal, qdot_field *f, fmpz_t s, fmpz_mpoly_t p)
{
    fmpz_mpoly_struct **q;
    slong length = 0;

    fmpz_one(s);
    if (ideal->n == 0 || fmpz_mpoly_is_zero(p, f->ctx))
        return;
    for (size_t i = 0; i < ideal->n; i++)
        length += fmpz_mpoly_length(ideal->poly[i], f->ctx);
    if (!qdot_field_charge(f, 4 * fmpz_mpoly_length(p, f->ctx), length))
        return;
    q = qdot_malloc(ideal->n * sizeof *q);
    for (size_t i = 0; q != NULL && i < ideal->n; i++) {
        q[i] = qdot_malloc(sizeof **q);
        if (q[i] != NULL) {
            fmpz_mpoly_init(q[i], f->ctx);
            continue;
        }
        while (i-- > 0) {
            fmpz_mpoly_clear(q[i], f->ctx);
            qdot_free(q[i]);
        }
        qdot_free(q);
        q = NULL;
    }
    if (q == NULL) {
        f->state = QDOT_FIELD_FAILED;
        f->status = QDOT_ENOMEM;
        return;
    }
    fmpz_mpoly_quasidivrem_ideal(s, q, p, p, ideal->poly, (slong)ideal->n, f->ctx);
    for (size_t i = 0; i < ideal->n; i++) {
        fmpz_mpoly_clear(q[i], f->ctx);
        qdot_free(q[i]);
    }
    qdot_free(q);
}

/* r = the S-polynomial of a and b; false if their leading monomials are coprime (it then
 * reduces to zero). */
static bool
s_polynomial(qdot_field *f, fmpz_mpoly_t r, const fmpz_mpoly_t a, const fmpz_mpoly_t b)
{
    ulong *ea = qdot_malloc(((size_t)f->n + 1) * 2 * sizeof *ea), *eb = ea + f->n;
    fmpz_mpoly_t ma, mb, x;
    fmpz_t ca, cb, g;
    bool common = false;

    if (ea == NULL)
        return false;
    fmpz_mpoly_get_term_exp_ui(ea, a, 0, f->ctx);
    fmpz_mpoly_get_term_exp_ui(eb, b, 0, f->ctx);
    for (slong v = 0; v < f->n; v++) {
        ulong least = ea[v] < eb[v] ? ea[v] : eb[v];

        common |= least > 0;
        ea[v] -= least;
        eb[v] -= least;
    }
    fmpz_init(ca);
    fmpz_init(cb);
    fmpz_init(g);
    fmpz_mpoly_init(ma, f->ctx);
    fmpz_mpoly_init(mb, f->ctx);
    fmpz_mpoly_init(x, f->ctx);
    fmpz_mpoly_get_term_coeff_fmpz(ca, a, 0, f->ctx);
    fmpz_mpoly_get_term_coeff_fmpz(cb, b, 0, f->ctx);
    fmpz_gcd(g, ca, cb);
    fmpz_divexact(ca, ca, g);
    fmpz_divexact(cb, cb, g);
    if (common && qdot_field_charge(f, fmpz_mpoly_length(a, f->ctx) + 1,
                                    fmpz_mpoly_length(b, f->ctx) + 1)) {
        fmpz_mpoly_push_term_fmpz_ui(ma, cb, eb, f->ctx);
        fmpz_mpoly_push_term_fmpz_ui(mb, ca, ea, f->ctx);
        fmpz_mpoly_mul(r, a, ma, f->ctx);
        fmpz_mpoly_mul(x, b, mb, f->ctx);
        fmpz_mpoly_sub(r, r, x, f->ctx);
    }
    fmpz_clear(ca);
    fmpz_clear(cb);
    fmpz_clear(g);
    fmpz_mpoly_clear(ma, f->ctx);
    fmpz_mpoly_clear(mb, f->ctx);
    fmpz_mpoly_clear(x, f->ctx);
    qdot_free(ea);
    return common;
}

/* Add S-polynomials (Buchberger) as long as the budget lasts. */
static qdot_status
ideal_complete(qdot_ideal *ideal, qdot_field *f)
{
    qdot_status status = QDOT_OK;
    int pairs = 0;
    fmpz_mpoly_t s;
    fmpz_t scale;

    fmpz_mpoly_init(s, f->ctx);
    fmpz_init(scale);
    for (size_t j = 1; j < ideal->n && status == QDOT_OK; j++)
        for (size_t i = 0; i < j && status == QDOT_OK && qdot_field_goes(f); i++) {
            if (pairs >= MOST_PAIRS || ideal->n >= MOST_POLYS)
                break;
            if (!s_polynomial(f, s, ideal->poly[i], ideal->poly[j]))
                continue;
            pairs++;
            qdot_ideal_reduce(ideal, f, scale, s);
            if (fmpz_mpoly_is_zero(s, f->ctx) ||
                fmpz_mpoly_length(s, f->ctx) > MOST_TERMS)
                continue;
            status = polynomial_strip(f, s, ideal->generic);
            if (status == QDOT_OK && fmpz_mpoly_is_fmpz(s, f->ctx))
                /* the relations contradict each other: nothing may be concluded from them */
                continue;
            if (status == QDOT_OK)
                status = ideal_add(ideal, f, s);
        }
    fmpz_mpoly_clear(s, f->ctx);
    fmpz_clear(scale);
    return status;
}

qdot_status
qdot_ideal_make(qdot_ideal *ideal, qdot_field *f, size_t n, const qdot_expr *relation)
{
    qdot_status status = QDOT_OK;
    fmpz_mpoly_t p;

    /* parameters are generic unless a relation binds them: an expression in them alone is
     * not zero then */
    ideal->generic = true;
    for (size_t i = 0; i < n; i++)
        if (!(qdot_expr_node(f->pool, relation[i])->holds & ~(uint32_t)QDOT_HAS_PARAM))
            ideal->generic = false;
    fmpz_mpoly_init(p, f->ctx);
    for (size_t i = 0; i < n && status == QDOT_OK; i++) {
        const qdot_ratio *r = qdot_field_value(f, relation[i]);

        if (r == NULL || fmpz_mpoly_is_zero(r->n, f->ctx))
            continue;
        fmpz_mpoly_set(p, r->n, f->ctx);
        status = polynomial_strip(f, p, ideal->generic);
        if (status == QDOT_OK && !fmpz_mpoly_is_fmpz(p, f->ctx) && qdot_field_goes(f))
            status = ideal_add(ideal, f, p);
    }
    if (ideal->n > 0)
        for (size_t i = 0; i < f->n_rules && status == QDOT_OK; i++)
            if (f->rule[i].power > 0)
                status = ideal_add(ideal, f, f->rule[i].poly);
    fmpz_mpoly_clear(p, f->ctx);
    if (status == QDOT_OK)
        status = ideal_complete(ideal, f);
    return status;
}

void
qdot_ideal_clear(qdot_ideal *ideal, qdot_field *f)
{
    for (size_t i = 0; i < ideal->n; i++) {
        fmpz_mpoly_clear(ideal->poly[i], f->ctx);
        qdot_free(ideal->poly[i]);
    }
    qdot_free(ideal->poly);
    *ideal = (qdot_ideal){0};
}

qdot_status
qdot_ideal_reduce_ratio(qdot_field *f, qdot_ratio *r, size_t n, const qdot_expr *relation)
{
    qdot_ideal ideal = {0};
    qdot_status status = qdot_ideal_make(&ideal, f, n, relation);
    fmpz_t scale;

    fmpz_init(scale);
    if (status == QDOT_OK && ideal.n > 0) {
        qdot_ratio x;

        qdot_ratio_init(f, &x);
        qdot_ratio_set(f, &x, r);
        qdot_ideal_reduce(&ideal, f, scale, x.n);
        fmpz_mpoly_scalar_mul_fmpz(x.d, x.d, scale, f->ctx);
        qdot_ideal_reduce(&ideal, f, scale, x.d);
        fmpz_mpoly_scalar_mul_fmpz(x.n, x.n, scale, f->ctx);
        if (qdot_field_goes(f) && !fmpz_mpoly_is_zero(x.d, f->ctx)) {
            qdot_ratio_cancel(f, &x);
            qdot_ratio_set(f, r, &x);
        }
        qdot_ratio_clear(f, &x);
    }
    fmpz_clear(scale);
    qdot_ideal_clear(&ideal, f);
    return status;
}
