/* quotient.c -- forms of a quotient: over one denominator, or as a sum of quotients. */
#include "base/memory.h"
#include "expr/build.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "normal/field/factor.h"
#include "normal/form/form.h"
#include "normal/form/items.h"
#include "normal/form/products.h"

enum { MOST_SPREAD = 16 };

struct saying {
    qdot_pool *pool;
    qdot_field *f;
    qdot_form *form;
    qdot_expr *best;
};

/* Write each term over the monomial denominator separately. */
static qdot_expr
write_each_term(struct saying *s, const qdot_ratio *r, const fmpq_t c)
{
    qdot_expr over =
        qdot_div(s->pool, qdot_expr_fmpq(s->pool, c), qdot_field_expr(s->f, r->d));
    qdot_expr sum = QDOT_ZERO;
    fmpz_mpoly_t term;

    fmpz_mpoly_init(term, s->f->ctx);
    for (slong i = 0; i < fmpz_mpoly_length(r->n, s->f->ctx); i++) {
        fmpz_mpoly_get_term(term, r->n, i, s->f->ctx);
        sum =
            qdot_add(s->pool, sum, qdot_mul(s->pool, qdot_field_expr(s->f, term), over));
    }
    fmpz_mpoly_clear(term, s->f->ctx);
    return sum;
}

/* The terms that share what is left of a monomial denominator together:
 * (m*r*x'^2 + m*g - c*x' + k*y)/m = r*x'^2 + g + (k*y - c*x')/m. */
static qdot_expr
write_by_denominator(struct saying *s, const qdot_ratio *r, const fmpq_t c)
{
    qdot_field *f = s->f;
    qdot_items items = {0};
    qdot_status status = QDOT_OK;
    qdot_expr sum = QDOT_ZERO;
    fmpz_mpoly_t term, g, below;
    fmpq_t over;

    fmpq_init(over);
    fmpz_mpoly_init(term, f->ctx);
    fmpz_mpoly_init(g, f->ctx);
    fmpz_mpoly_init(below, f->ctx);
    for (slong i = 0; i < fmpz_mpoly_length(r->n, f->ctx) && status == QDOT_OK; i++) {
        fmpz_mpoly_get_term(term, r->n, i, f->ctx);
        if (!fmpz_mpoly_gcd(g, term, r->d, f->ctx) ||
            !fmpz_mpoly_divides(below, r->d, g, f->ctx) ||
            !fmpz_mpoly_divides(term, term, g, f->ctx))
            status = QDOT_EFAILED;
        /* over a monomial denominator, numbers stay with the terms */
        if (status == QDOT_OK && fmpz_mpoly_length(below, f->ctx) == 1) {
            fmpz_mpoly_scalar_mul_fmpz(term, term, r->d->coeffs, f->ctx);
            fmpz_mpoly_scalar_divexact_fmpz(term, term, below->coeffs, f->ctx);
            fmpz_one(below->coeffs);
            status = qdot_items_add(f, &items, below, term);
        }
    }
    fmpq_div_fmpz(over, c, r->d->coeffs);
    if (items.n < 2)
        sum = QDOT_NIL;
    for (size_t i = 0; i < items.n && items.n > 1 && status == QDOT_OK; i++) {
        qdot_expr e;
        fmpz_t k;
        fmpq_t front;

        fmpz_init(k);
        fmpq_init(front);
        qdot_field_primitive(f, k, items.at[i].sum, items.at[i].sum, false);
        fmpq_mul_fmpz(front, over, k);
        e = qdot_form_say(s->form, items.at[i].sum, front);
        e = qdot_div(s->pool, e, qdot_field_expr(f, items.at[i].key));
        sum = qdot_add(s->pool, sum, e);
        fmpz_clear(k);
        fmpq_clear(front);
    }
    qdot_items_clear(f, &items);
    fmpz_mpoly_clear(term, f->ctx);
    fmpz_mpoly_clear(g, f->ctx);
    fmpz_mpoly_clear(below, f->ctx);
    fmpq_clear(over);
    return status == QDOT_OK ? sum : QDOT_NIL;
}

static bool
cancels(qdot_field *f, const fmpz_mpoly_t p, const fmpz_mpoly_t d)
{
    fmpz_mpoly_t g;
    bool some;

    fmpz_mpoly_init(g, f->ctx);
    some = !fmpz_mpoly_gcd(g, p, d, f->ctx) || !fmpz_mpoly_is_fmpz(g, f->ctx);
    fmpz_mpoly_clear(g, f->ctx);
    return some;
}

/* Whether a quotient with a monomial below may come apart: the coefficient of a monomial in
 * velocities cancels something of it, or a term of what does not move. */
static bool
may_split_quotient(const qdot_form *form, const qdot_ratio *r)
{
    qdot_field *f = form->f;
    bool apart = false;
    qdot_groups groups;
    fmpz_mpoly_t term;

    if (fmpz_mpoly_length(r->d, f->ctx) > 1)
        return false;
    fmpz_mpoly_init(term, f->ctx);
    if (qdot_factor_group(f, &groups, r->n, form->fast) != QDOT_OK)
        qdot_pool_fail(f->pool);
    for (slong i = 0; i < groups.n && !apart; i++) {
        const fmpz_mpoly_struct *p = groups.poly + i;
        bool still = true;

        for (slong v = 0; v < f->n; v++)
            still &= groups.key[i * f->n + v] == 0;
        apart = !still && cancels(f, p, r->d);
        for (slong k = 0; k < fmpz_mpoly_length(p, f->ctx) && still && !apart; k++) {
            fmpz_mpoly_get_term(term, p, k, f->ctx);
            apart = cancels(f, term, r->d);
        }
    }
    qdot_factor_ungroup(f, &groups);
    fmpz_mpoly_clear(term, f->ctx);
    return apart;
}

/* Write the denominator d as the shorter of d and -d; if they are equal, without a leading minus. */
static qdot_expr
write_denominator(struct saying *s, qdot_ratio *r, fmpq_t c)
{
    qdot_field *f = s->f;
    qdot_expr below = qdot_form_coefficient(s->form, r->d), best = below;

    if (below == QDOT_NIL ||
        (!qdot_form_has_trig(s->form, r->d) && !qdot_expr_is_negative(s->pool, below)))
        return below;
    fmpz_mpoly_neg(r->d, r->d, f->ctx);
    qdot_form_keep(s->pool, &best, qdot_form_coefficient(s->form, r->d));
    if (best == below && !qdot_expr_is_negative(s->pool, below))
        fmpz_mpoly_neg(r->d, r->d, f->ctx);
    else
        fmpq_neg(c, c);
    return qdot_form_coefficient(s->form, r->d);
}

/* A sum of first degree in undefined functions and their derivatives, nothing else moving, is
 * collected in them as in velocities: the Laplacian of f. */
static void
treat_derivatives_as_velocities(qdot_form *form, const qdot_ratio *r)
{
    qdot_field *f = form->f;
    bool *moves = qdot_calloc((size_t)f->n + 1, sizeof *moves), linear = moves != NULL;
    ulong *exp = qdot_malloc(((size_t)f->n + 1) * sizeof *exp);

    for (slong v = 0; v < f->n && linear; v++) {
        moves[v] = qdot_expr_kind(f->pool, f->gen[v].expr) == QDOT_UFUN;
        linear = !(moves[v] && fmpz_mpoly_degree_si(r->d, v, f->ctx) > 0);
    }
    for (slong i = 0; i < fmpz_mpoly_length(r->n, f->ctx) && linear && exp != NULL; i++) {
        ulong degree = 0;

        fmpz_mpoly_get_term_exp_ui(exp, r->n, i, f->ctx);
        for (slong v = 0; v < f->n; v++) {
            degree += moves[v] ? exp[v] : 0;
            linear &= !(f->gen[v].fast && exp[v] > 0);
        }
        linear &= degree == 1;
    }
    for (slong v = 0; v < f->n; v++)
        form->fast[v] = f->gen[v].fast || (linear && moves[v] && exp != NULL);
    qdot_free(moves);
    qdot_free(exp);
}

void
qdot_form_say_quotient(qdot_form *form, const qdot_ratio *from, qdot_expr *best)
{
    struct saying what = {form->f->pool, form->f, form, best}, *s = &what;
    qdot_field *f = form->f;
    qdot_ratio r;
    qdot_expr e;
    fmpq_t c;

    if (fmpz_mpoly_is_zero(from->n, f->ctx)) {
        *best = QDOT_ZERO;
        return;
    }
    fmpq_init(c);
    qdot_ratio_init(f, &r);
    qdot_ratio_set(f, &r, from);
    qdot_ratio_content(f, c, &r);
    form->quotient = false;
    treat_derivatives_as_velocities(form, &r);
    if (!fmpz_mpoly_is_one(r.d, f->ctx)) {
        bool apart = may_split_quotient(form, &r);

        qdot_expr below = write_denominator(s, &r, c);

        form->quotient = !apart;
        e = qdot_div(s->pool, qdot_form_say(s->form, r.n, c), below);
        qdot_form_keep(s->pool, s->best, e);
        if (qdot_form_has_trig(s->form, r.d))
            qdot_form_keep(s->pool, s->best, qdot_products_tangents(s->pool, e));
        if (fmpz_mpoly_length(r.d, f->ctx) == 1 &&
            fmpz_mpoly_length(r.n, f->ctx) <= MOST_SPREAD)
            qdot_form_keep(s->pool, s->best, write_each_term(s, &r, c));
        if (apart && fmpz_mpoly_length(r.n, f->ctx) > 1)
            qdot_form_keep(s->pool, s->best, write_by_denominator(s, &r, c));
        qdot_form_say_apart(form, &r, c, s->best);
    } else {
        qdot_form_keep(s->pool, s->best, qdot_form_say(s->form, r.n, c));
    }
    qdot_ratio_clear(f, &r);
    fmpq_clear(c);
}
