/* form.c -- polynomials said shortly: collected in velocities, grouped by trigonometric parts,
 * factored, common powers out.
 */
#include "normal/form.h"

#include <string.h>

#include "base/memory.h"
#include "expr/walk.h"
#include "normal/factor.h"

enum { MOST_GROUPS = 120, MOST_DEPTH = 60, MOST_HORNER = 60, MOST_FLIPS = 2 };

qdot_status
qdot_form_begin(qdot_form *form, qdot_field *f)
{
    *form = (qdot_form){.f = f};
    form->fast = qdot_calloc(2 * (size_t)f->n + 1, sizeof *form->fast);
    if (form->fast == NULL)
        return QDOT_ENOMEM;
    form->trig = form->fast + f->n;
    for (slong v = 0; v < f->n; v++) {
        form->fast[v] = f->gen[v].fast;
        form->trig[v] = f->gen[v].kind >= QDOT_GEN_SIN && f->gen[v].kind <= QDOT_GEN_COSH;
    }
    return QDOT_OK;
}

void
qdot_form_end(qdot_form *form)
{
    for (size_t i = 0; i < form->n; i++)
        fmpz_mpoly_clear(form->known + i, form->f->ctx);
    qdot_free(form->known);
    qdot_free(form->said);
    qdot_free(form->fast);
}

qdot_expr
qdot_form_recall(const qdot_form *form, const fmpz_mpoly_t p)
{
    for (size_t i = 0; i < form->n; i++)
        if (fmpz_mpoly_equal(form->known + i, p, form->f->ctx))
            return form->said[i];
    return QDOT_NIL;
}

qdot_expr
qdot_form_remember(qdot_form *form, const fmpz_mpoly_t p, qdot_expr e)
{
    if (e == QDOT_NIL || form->n >= 200 ||
        qdot_grow(&form->known, &form->known_capacity, form->n + 1, sizeof *form->known) !=
            QDOT_OK ||
        qdot_grow(&form->said, &form->said_capacity, form->n + 1, sizeof *form->said) != QDOT_OK)
        return e;
    fmpz_mpoly_init(form->known + form->n, form->f->ctx);
    fmpz_mpoly_set(form->known + form->n, p, form->f->ctx);
    form->said[form->n++] = e;
    return e;
}

static qdot_expr
integer(qdot_pool *pool, const fmpz_t n)
{
    qdot_expr e;
    fmpq_t c;

    fmpq_init(c);
    fmpq_set_fmpz(c, n);
    e = qdot_expr_fmpq(pool, c);
    fmpq_clear(c);
    return e;
}

/* p = c * monomial * rest, rest primitive with a positive leading coefficient; the expression of
 * the monomial. */
static qdot_expr
take_content(qdot_field *f, fmpz_mpoly_t rest, fmpz_t c, const fmpz_mpoly_t p)
{
    ulong *exp = qdot_malloc(((size_t)f->n + 1) * sizeof *exp);
    fmpz_mpoly_t content;
    qdot_expr e;
    fmpq_t one;

    if (exp == NULL)
        return qdot_pool_fail(f->pool);
    fmpq_init(one);
    fmpq_one(one);
    fmpz_mpoly_init(content, f->ctx);
    fmpz_mpoly_term_content(content, p, f->ctx);
    fmpz_mpoly_divides(rest, p, content, f->ctx);
    fmpz_mpoly_get_term_coeff_fmpz(c, content, 0, f->ctx);
    fmpz_mpoly_get_term_exp_ui(exp, content, 0, f->ctx);
    if (fmpz_sgn(fmpz_mpoly_leadcoeff(rest)) < 0) {
        fmpz_mpoly_neg(rest, rest, f->ctx);
        fmpz_neg(c, c);
    }
    e = qdot_form_monomial(f, one, exp);
    fmpz_mpoly_clear(content, f->ctx);
    fmpq_clear(one);
    qdot_free(exp);
    return e;
}

/* --- without trigonometric variables: common powers out --------------------------------------- */

/* The power whose taking out saves most. */
static slong
best_power(qdot_field *f, const fmpz_mpoly_t p, ulong *power)
{
    slong length = fmpz_mpoly_length(p, f->ctx), best = -1, most = 0;
    ulong *exp = qdot_malloc(((size_t)f->n + 1) * 3 * sizeof *exp);
    ulong *count = exp + f->n, *least = count + f->n;

    if (exp == NULL)
        return -1;
    memset(count, 0, 2 * (size_t)f->n * sizeof *count);
    for (slong i = 0; i < length; i++) {
        fmpz_mpoly_get_term_exp_ui(exp, p, i, f->ctx);
        for (slong v = 0; v < f->n; v++)
            if (exp[v] > 0) {
                if (count[v]++ == 0 || exp[v] < least[v])
                    least[v] = exp[v];
            }
    }
    for (slong v = 0; v < f->n; v++) {
        slong saved = ((slong)count[v] - 1) * (least[v] > 1 ? 2 : 1);

        if (count[v] >= 2 && (slong)count[v] < length && saved > most) {
            most = saved;
            best = v;
            *power = least[v];
        }
    }
    qdot_free(exp);
    return best;
}

/* q = the terms of p that v^power divides, divided; r = the others. */
static void
part(qdot_field *f, fmpz_mpoly_t q, fmpz_mpoly_t r, const fmpz_mpoly_t p, slong v, ulong power)
{
    slong length = fmpz_mpoly_length(p, f->ctx);
    fmpz_mpoly_t term, x;

    fmpz_mpoly_init(term, f->ctx);
    fmpz_mpoly_init(x, f->ctx);
    fmpz_mpoly_gen(x, v, f->ctx);
    fmpz_mpoly_pow_ui(x, x, power, f->ctx);
    for (slong i = 0; i < length; i++) {
        fmpz_mpoly_get_term(term, p, i, f->ctx);
        if (fmpz_mpoly_divides(term, term, x, f->ctx)) {
            fmpz_mpoly_add(q, q, term, f->ctx);
        } else {
            fmpz_mpoly_get_term(term, p, i, f->ctx);
            fmpz_mpoly_add(r, r, term, f->ctx);
        }
    }
    fmpz_mpoly_clear(term, f->ctx);
    fmpz_mpoly_clear(x, f->ctx);
}

/* Bounded by MOST_DEPTH levels and MOST_HORNER terms, whatever the input. */
static qdot_expr
horner(qdot_form *form, const fmpz_mpoly_t p)
{
    qdot_field *f = form->f;
    qdot_pool *pool = f->pool;
    qdot_expr best = QDOT_NIL, factor;
    fmpz_mpoly_t rest, q, r;
    ulong power = 1;
    slong v;
    fmpz_t c;

    if (fmpz_mpoly_length(p, f->ctx) <= 2 || fmpz_mpoly_length(p, f->ctx) > MOST_HORNER ||
        form->depth > MOST_DEPTH) {
        if (fmpz_mpoly_length(p, f->ctx) != 2)
            return qdot_field_expr(f, p);
    }
    fmpz_init(c);
    fmpz_mpoly_init(rest, f->ctx);
    fmpz_mpoly_init(q, f->ctx);
    fmpz_mpoly_init(r, f->ctx);
    form->depth++;
    factor = take_content(f, rest, c, p);
    factor = qdot_mul(pool, integer(pool, c), factor);
    qdot_form_keep(pool, &best, qdot_mul(pool, factor, qdot_field_expr(f, rest)));
    v = fmpz_mpoly_length(rest, f->ctx) > 2 ? best_power(f, rest, &power) : -1;
    if (v >= 0) {
        qdot_expr x = qdot_pow_int(pool, f->gen[v].expr, (long)power);

        part(f, q, r, rest, v, power);
        x = qdot_add(pool, qdot_mul(pool, x, horner(form, q)), horner(form, r));
        qdot_form_keep(pool, &best, qdot_mul(pool, factor, x));
    }
    form->depth--;
    fmpz_mpoly_clear(rest, f->ctx);
    fmpz_mpoly_clear(q, f->ctx);
    fmpz_mpoly_clear(r, f->ctx);
    fmpz_clear(c);
    return best;
}

/* A polynomial without fast and trigonometric variables. */
static qdot_expr
plain(qdot_form *form, const fmpz_mpoly_t p)
{
    qdot_field *f = form->f;
    qdot_expr best = qdot_form_recall(form, p), product;
    qdot_factors factors;

    if (best != QDOT_NIL)
        return best;
    if (fmpz_mpoly_length(p, f->ctx) <= 1)
        return qdot_field_expr(f, p);
    best = horner(form, p);
    if (fmpz_mpoly_length(p, f->ctx) > 2 || fmpz_mpoly_total_degree_si(p, f->ctx) > 1) {
        if (qdot_factor(f, &factors, p) == QDOT_OK) {
            product = integer(f->pool, factors.content);
            for (slong i = 0; i < factors.n; i++)
                product = qdot_mul(f->pool, product,
                                   qdot_pow_int(f->pool, horner(form, factors.poly + i),
                                                factors.exp[i]));
            qdot_form_keep(f->pool, &best, product);
        }
        qdot_factor_clear(f, &factors);
    }
    return qdot_form_remember(form, p, best);
}

/* --- with trigonometric variables: sum of (coefficient) * (trigonometric part) ------------------- */

struct item {
    fmpz_mpoly_t key, sum; /* key primitive, its leading coefficient positive */
};

struct items {
    struct item *at;
    size_t n, capacity;
};

/* Add key * value to the items: c key' * value, key' primitive. */
static qdot_status
add_item(qdot_field *f, struct items *items, const fmpz_mpoly_t key, const fmpz_mpoly_t value)
{
    fmpz_mpoly_t primitive, scaled;
    qdot_status status = QDOT_OK;
    size_t i = 0;
    fmpz_t c;

    fmpz_init(c);
    fmpz_mpoly_init(primitive, f->ctx);
    fmpz_mpoly_init(scaled, f->ctx);
    _fmpz_vec_content(c, key->coeffs, fmpz_mpoly_length(key, f->ctx));
    if (fmpz_sgn(fmpz_mpoly_leadcoeff(key)) < 0)
        fmpz_neg(c, c);
    fmpz_mpoly_scalar_divexact_fmpz(primitive, key, c, f->ctx);
    fmpz_mpoly_scalar_mul_fmpz(scaled, value, c, f->ctx);
    while (i < items->n && !fmpz_mpoly_equal(items->at[i].key, primitive, f->ctx))
        i++;
    if (i == items->n) {
        status = qdot_grow(&items->at, &items->capacity, items->n + 1, sizeof *items->at);
        if (status == QDOT_OK) {
            fmpz_mpoly_init(items->at[i].key, f->ctx);
            fmpz_mpoly_init(items->at[i].sum, f->ctx);
            fmpz_mpoly_swap(items->at[i].key, primitive, f->ctx);
            items->n++;
        }
    }
    if (status == QDOT_OK)
        fmpz_mpoly_add(items->at[i].sum, items->at[i].sum, scaled, f->ctx);
    fmpz_clear(c);
    fmpz_mpoly_clear(primitive, f->ctx);
    fmpz_mpoly_clear(scaled, f->ctx);
    return status;
}

static void
clear_items(qdot_field *f, struct items *items)
{
    for (size_t i = 0; i < items->n; i++) {
        fmpz_mpoly_clear(items->at[i].key, f->ctx);
        fmpz_mpoly_clear(items->at[i].sum, f->ctx);
    }
    qdot_free(items->at);
    *items = (struct items){0};
}

/* Parts of a trigonometric polynomial whose degrees in each angle have the same parity: only
 * these can be combined. Adds each part, times value, to the items. */
static qdot_status
add_by_parity(qdot_field *f, struct items *items, const fmpz_mpoly_t trig,
              const fmpz_mpoly_t value)
{
    slong length = fmpz_mpoly_length(trig, f->ctx);
    ulong *exp = qdot_malloc(((size_t)f->n + 1) * sizeof *exp);
    unsigned char *done = qdot_calloc((size_t)length + 1, 1);
    uint64_t *parity = qdot_calloc((size_t)length + 1, sizeof *parity);
    qdot_status status = QDOT_OK;
    fmpz_mpoly_t sum, term;

    if (exp == NULL || done == NULL || parity == NULL) {
        qdot_free(exp);
        qdot_free(done);
        qdot_free(parity);
        return QDOT_ENOMEM;
    }
    for (slong i = 0; i < length; i++) {
        fmpz_mpoly_get_term_exp_ui(exp, trig, i, f->ctx);
        for (slong v = 0; v < f->n; v++)
            if (exp[v] % 2 != 0) {
                slong w = (slong)f->gen[v].pair;

                parity[i] ^= (uint64_t)1 << ((v < w ? v : w) % 64);
            }
    }
    fmpz_mpoly_init(sum, f->ctx);
    fmpz_mpoly_init(term, f->ctx);
    for (slong i = 0; i < length && status == QDOT_OK; i++) {
        if (done[i])
            continue;
        fmpz_mpoly_zero(sum, f->ctx);
        for (slong j = i; j < length; j++)
            if (parity[j] == parity[i]) {
                done[j] = 1;
                fmpz_mpoly_get_term(term, trig, j, f->ctx);
                fmpz_mpoly_add(sum, sum, term, f->ctx);
            }
        status = add_item(f, items, sum, value);
    }
    fmpz_mpoly_clear(sum, f->ctx);
    fmpz_mpoly_clear(term, f->ctx);
    qdot_free(exp);
    qdot_free(done);
    qdot_free(parity);
    return status;
}

/* coefficient * trigonometric part; integers go where they shorten (2 sin a cos a). */
static qdot_expr
say_item(qdot_form *form, const fmpz_mpoly_t coefficient, const fmpz_mpoly_t trig)
{
    qdot_field *f = form->f;
    fmpz_mpoly_t primitive, scaled;
    qdot_expr e, best = QDOT_NIL;
    fmpz_t c;

    fmpz_init(c);
    fmpz_mpoly_init(primitive, f->ctx);
    fmpz_mpoly_init(scaled, f->ctx);
    _fmpz_vec_content(c, coefficient->coeffs, fmpz_mpoly_length(coefficient, f->ctx));
    if (fmpz_sgn(fmpz_mpoly_leadcoeff(coefficient)) < 0)
        fmpz_neg(c, c);
    fmpz_mpoly_scalar_divexact_fmpz(primitive, coefficient, c, f->ctx);
    fmpz_mpoly_scalar_mul_fmpz(scaled, trig, c, f->ctx);
    e = plain(form, primitive);
    qdot_form_keep(f->pool, &best, qdot_mul(f->pool, e, qdot_form_trig(form, scaled)));
    if (!fmpz_is_one(c)) {
        e = qdot_mul(f->pool, integer(f->pool, c), e);
        qdot_form_keep(f->pool, &best, qdot_mul(f->pool, e, qdot_form_trig(form, trig)));
    }
    fmpz_clear(c);
    fmpz_mpoly_clear(primitive, f->ctx);
    fmpz_mpoly_clear(scaled, f->ctx);
    return best;
}

/* Items keyed by trigonometric parts (or, `by_trig`, made by terms t first: equal coefficients
 * bring their t together). */
static qdot_expr
say_groups(qdot_form *form, const fmpz_mpoly_t p, bool by_trig)
{
    qdot_field *f = form->f;
    bool *by = qdot_malloc((size_t)f->n + 1);
    struct items items = {0};
    qdot_expr sum = QDOT_ZERO;
    qdot_groups groups;
    qdot_status status;
    fmpq_t one;

    if (by == NULL)
        return qdot_pool_fail(f->pool);
    for (slong v = 0; v < f->n; v++)
        by[v] = form->trig[v] == by_trig;
    fmpq_init(one);
    status = qdot_factor_group(f, &groups, p, by);
    for (slong i = 0; i < groups.n && status == QDOT_OK; i++) {
        fmpz_mpoly_t key;

        fmpz_mpoly_init(key, f->ctx);
        fmpz_mpoly_push_term_si_ui(key, 1, groups.key + i * f->n, f->ctx);
        status = by_trig ? add_item(f, &items, groups.poly + i, key)
                         : add_by_parity(f, &items, groups.poly + i, key);
        fmpz_mpoly_clear(key, f->ctx);
    }
    for (size_t i = 0; i < items.n && status == QDOT_OK; i++) {
        if (!by_trig) {
            sum = qdot_add(f->pool, sum, say_item(form, items.at[i].sum, items.at[i].key));
        } else { /* the trigonometric sum in parts */
            struct items parts = {0};
            fmpz_mpoly_t unit;
            qdot_expr inner = QDOT_ZERO;

            fmpz_mpoly_init(unit, f->ctx);
            fmpz_mpoly_one(unit, f->ctx);
            status = add_by_parity(f, &parts, items.at[i].sum, unit);
            for (size_t k = 0; k < parts.n && status == QDOT_OK; k++)
                inner = qdot_add(f->pool, inner, say_item(form, parts.at[k].sum, parts.at[k].key));
            sum = qdot_add(f->pool, sum, qdot_mul(f->pool, plain(form, items.at[i].key), inner));
            fmpz_mpoly_clear(unit, f->ctx);
            clear_items(f, &parts);
        }
    }
    qdot_factor_ungroup(f, &groups);
    clear_items(f, &items);
    fmpq_clear(one);
    qdot_free(by);
    return status == QDOT_OK ? sum : qdot_pool_fail(f->pool);
}

static bool
has_trig(const qdot_form *form, const fmpz_mpoly_t p)
{
    for (slong v = 0; v < form->f->n; v++)
        if (form->trig[v] && fmpz_mpoly_degree_si(p, v, form->f->ctx) > 0)
            return true;
    return false;
}

/* As a sum. */
static qdot_expr
say_sum(qdot_form *form, const fmpz_mpoly_t p)
{
    qdot_field *f = form->f;
    qdot_expr best = QDOT_NIL;

    if (!has_trig(form, p))
        return horner(form, p);
    if (fmpz_mpoly_length(p, f->ctx) > MOST_GROUPS)
        return qdot_field_expr(f, p);
    qdot_form_keep(f->pool, &best, say_groups(form, p, false));
    if (fmpz_mpoly_length(p, f->ctx) > 1)
        qdot_form_keep(f->pool, &best, say_groups(form, p, true));
    return best;
}

static qdot_expr
say_factors(qdot_form *form, const fmpz_mpoly_t p)
{
    qdot_field *f = form->f;
    qdot_expr e = QDOT_NIL;
    qdot_factors factors;

    if (qdot_factor(f, &factors, p) == QDOT_OK) {
        e = integer(f->pool, factors.content);
        for (slong i = 0; i < factors.n; i++)
            e = qdot_mul(f->pool, e,
                         qdot_pow_int(f->pool, say_sum(form, factors.poly + i), factors.exp[i]));
    }
    qdot_factor_clear(f, &factors);
    return e;
}

qdot_expr
qdot_form_coefficient(qdot_form *form, const fmpz_mpoly_t p)
{
    qdot_field *f = form->f;
    qdot_pool *pool = f->pool;
    qdot_expr best, factor;
    fmpz_mpoly_t rest, flipped;
    fmpz_t c;

    if (!has_trig(form, p))
        return plain(form, p);
    best = qdot_form_recall(form, p);
    if (best != QDOT_NIL)
        return best;
    fmpz_init(c);
    fmpz_mpoly_init(rest, f->ctx);
    fmpz_mpoly_init(flipped, f->ctx);
    qdot_form_keep(pool, &best, say_sum(form, p));
    factor = take_content(f, rest, c, p);
    factor = qdot_mul(pool, integer(pool, c), factor);
    if (factor != QDOT_ONE && fmpz_mpoly_length(rest, f->ctx) > 1)
        qdot_form_keep(pool, &best, qdot_mul(pool, factor, say_sum(form, rest)));
    if (fmpz_mpoly_length(rest, f->ctx) > 1) {
        int flips = 0;

        qdot_form_keep(pool, &best, qdot_mul(pool, factor, say_factors(form, rest)));
        for (slong v = 0; v < f->n && flips < MOST_FLIPS && qdot_field_goes(f); v++)
            if ((f->gen[v].kind == QDOT_GEN_COS || f->gen[v].kind == QDOT_GEN_COSH) &&
                fmpz_mpoly_degree_si(rest, v, f->ctx) >= 2) {
                flips++;
                if (qdot_factor_flip(f, flipped, rest, v) == QDOT_OK && qdot_field_goes(f))
                    qdot_form_keep(pool, &best,
                                   qdot_mul(pool, factor, say_factors(form, flipped)));
            }
    }
    fmpz_clear(c);
    fmpz_mpoly_clear(rest, f->ctx);
    fmpz_mpoly_clear(flipped, f->ctx);
    return qdot_form_remember(form, p, best);
}

/* --- collected in velocities and accelerations ----------------------------------------------------- */

static qdot_expr
scaled(qdot_pool *pool, const fmpq_t c, qdot_expr e)
{
    return qdot_mul(pool, qdot_expr_fmpq(pool, c), e);
}

/* The greatest common divisor of the coefficients. */
static void
common(qdot_field *f, fmpz_mpoly_t g, const qdot_groups *groups)
{
    fmpz_mpoly_set(g, groups->poly, f->ctx);
    for (slong i = 1; i < groups->n && !fmpz_mpoly_is_fmpz(g, f->ctx); i++)
        qdot_field_gcd(f, g, g, groups->poly + i);
    if (fmpz_mpoly_is_fmpz(g, f->ctx))
        fmpz_mpoly_one(g, f->ctx);
}

/* c p: the integers of both together go into the coefficient, where they may shorten it
 * (2 sin a cos a), denominators stand in front. */
static qdot_expr
say_scaled(qdot_form *form, const fmpq_t c, const fmpz_mpoly_t p)
{
    qdot_field *f = form->f;
    fmpz_mpoly_t whole;
    qdot_expr e;
    fmpz_t content;
    fmpq_t k;

    fmpz_init(content);
    fmpq_init(k);
    fmpz_mpoly_init(whole, f->ctx);
    _fmpz_vec_content(content, p->coeffs, fmpz_mpoly_length(p, f->ctx));
    fmpz_mpoly_scalar_divexact_fmpz(whole, p, content, f->ctx);
    fmpq_mul_fmpz(k, c, content);
    fmpz_mpoly_scalar_mul_fmpz(whole, whole, fmpq_numref(k), f->ctx);
    fmpz_one(fmpq_numref(k));
    e = scaled(f->pool, k, qdot_form_coefficient(form, whole));
    fmpz_clear(content);
    fmpq_clear(k);
    fmpz_mpoly_clear(whole, f->ctx);
    return e;
}

/* c * coefficient * (sum of monomials in velocities), the sum primitive and not negative. */
static qdot_expr
say_merged(qdot_form *form, const struct item *item, const fmpq_t c)
{
    qdot_field *f = form->f;
    fmpz_mpoly_t primitive;
    qdot_expr e;
    fmpz_t content;
    fmpq_t k;

    fmpz_init(content);
    fmpq_init(k);
    fmpz_mpoly_init(primitive, f->ctx);
    _fmpz_vec_content(content, item->sum->coeffs, fmpz_mpoly_length(item->sum, f->ctx));
    if (fmpz_sgn(fmpz_mpoly_leadcoeff(item->sum)) < 0)
        fmpz_neg(content, content);
    fmpz_mpoly_scalar_divexact_fmpz(primitive, item->sum, content, f->ctx);
    fmpq_mul_fmpz(k, c, content);
    e = qdot_mul(f->pool, say_scaled(form, k, item->key),
                 fmpz_mpoly_length(primitive, f->ctx) == 1 ? qdot_field_expr(f, primitive)
                                                           : plain(form, primitive));
    fmpz_clear(content);
    fmpq_clear(k);
    fmpz_mpoly_clear(primitive, f->ctx);
    return e;
}

/* c times the sum of coefficient * monomial, coefficients divided by g; like coefficients
 * together: (u^2 + v^2)*(du^2 + dv^2). */
static qdot_expr
say_collected(qdot_form *form, const qdot_groups *groups, const fmpz_mpoly_t g, const fmpq_t c,
              bool merged)
{
    qdot_field *f = form->f;
    struct items items = {0};
    qdot_status status = QDOT_OK;
    qdot_expr sum = QDOT_ZERO;
    fmpz_mpoly_t key, value;
    fmpq_t one;

    fmpq_init(one);
    fmpq_one(one);
    fmpz_mpoly_init(key, f->ctx);
    fmpz_mpoly_init(value, f->ctx);
    for (slong i = 0; i < groups->n && status == QDOT_OK; i++) {
        fmpz_mpoly_divides(value, groups->poly + i, g, f->ctx);
        if (merged) {
            fmpz_mpoly_zero(key, f->ctx);
            fmpz_mpoly_push_term_si_ui(key, 1, groups->key + i * f->n, f->ctx);
            status = add_item(f, &items, value, key);
        } else {
            sum = qdot_add(f->pool, sum,
                           qdot_mul(f->pool, say_scaled(form, c, value),
                                    qdot_form_monomial(f, one, groups->key + i * f->n)));
        }
    }
    for (size_t i = 0; i < items.n && status == QDOT_OK; i++)
        sum = qdot_add(f->pool, sum, say_merged(form, &items.at[i], c));
    clear_items(f, &items);
    fmpz_mpoly_clear(key, f->ctx);
    fmpz_mpoly_clear(value, f->ctx);
    fmpq_clear(one);
    return status == QDOT_OK ? sum : qdot_pool_fail(f->pool);
}

/* Whether every monomial holds a velocity, acceleration ... */
static bool
all_moving(qdot_field *f, const qdot_groups *groups)
{
    for (slong i = 0; i < groups->n; i++) {
        bool moving = false;

        for (slong v = 0; v < f->n; v++)
            moving |= groups->key[i * f->n + v] > 0;
        if (!moving)
            return false;
    }
    return true;
}

/* Whether g comes out as in a book: nothing of it is left in the quotients (m*L^2 comes out of
 * m*L^2*q'' + m*L^2*..., but L1 stays in (m1 + m2)*L1^2*q1'' + m2*L1*L2*...), and it is not
 * taken out of a sum of a kinetic and a potential part. */
static bool
goes_out_whole(qdot_field *f, const fmpz_mpoly_t g, const qdot_groups *groups)
{
    for (slong v = 0; v < f->n; v++) {
        slong degree = fmpz_mpoly_degree_si(g, v, f->ctx);

        for (slong i = 0; i < groups->n && degree > 0; i++)
            if (fmpz_mpoly_degree_si(groups->poly + i, v, f->ctx) > degree)
                return false;
    }
    return !fmpz_mpoly_is_fmpz(g, f->ctx) && all_moving(f, groups);
}

/* The same of factors: a bare generator that stands in another factor as well. */
static bool
comes_apart(qdot_field *f, const qdot_factors *factors)
{
    for (slong i = 0; i < factors->n; i++) {
        slong v = 0;

        if (fmpz_mpoly_length(factors->poly + i, f->ctx) > 1)
            continue;
        while (v < f->n && fmpz_mpoly_degree_si(factors->poly + i, v, f->ctx) == 0)
            v++;
        for (slong k = 0; k < factors->n; k++)
            if (k != i && v < f->n && fmpz_mpoly_degree_si(factors->poly + k, v, f->ctx) > 0)
                return false;
    }
    return true;
}

static qdot_expr
say_product(qdot_form *form, const fmpz_mpoly_t p, const fmpq_t c)
{
    qdot_field *f = form->f;
    qdot_expr e = QDOT_NIL;
    qdot_factors factors;
    fmpq_t one;

    if (form->depth > 0)
        return QDOT_NIL;
    if (qdot_factor(f, &factors, p) != QDOT_OK) {
        qdot_factor_clear(f, &factors);
        return QDOT_NIL;
    }
    fmpq_init(one);
    fmpq_one(one);
    form->depth++;
    if ((factors.n > 1 || (factors.n == 1 && factors.exp[0] > 1)) && comes_apart(f, &factors)) {
        e = scaled(f->pool, c, integer(f->pool, factors.content));
        for (slong i = 0; i < factors.n; i++)
            e = qdot_mul(f->pool, e,
                         qdot_pow_int(f->pool, qdot_form_say(form, factors.poly + i, one),
                                      factors.exp[i]));
    }
    form->depth--;
    fmpq_clear(one);
    qdot_factor_clear(f, &factors);
    return e;
}

qdot_expr
qdot_form_say(qdot_form *form, const fmpz_mpoly_t p, const fmpq_t c)
{
    qdot_field *f = form->f;
    qdot_pool *pool = f->pool;
    qdot_expr best = QDOT_NIL;
    qdot_groups groups;
    fmpz_mpoly_t g, unit;
    fmpq_t one;

    if (fmpz_mpoly_is_zero(p, f->ctx))
        return QDOT_ZERO;
    if (qdot_factor_group(f, &groups, p, form->fast) != QDOT_OK) {
        qdot_factor_ungroup(f, &groups);
        return qdot_pool_fail(pool);
    }
    fmpq_init(one);
    fmpq_one(one);
    fmpz_mpoly_init(g, f->ctx);
    fmpz_mpoly_init(unit, f->ctx);
    fmpz_mpoly_one(unit, f->ctx);
    qdot_form_keep(pool, &best, say_collected(form, &groups, unit, c, false));
    if (groups.n > 1) {
        qdot_expr out;

        qdot_form_keep(pool, &best, say_collected(form, &groups, unit, c, true));
        common(f, g, &groups);
        out = qdot_form_coefficient(form, g);
        for (int merged = 0; merged < 2 && goes_out_whole(f, g, &groups); merged++) {
            qdot_expr inner = say_collected(form, &groups, g, one, merged);

            qdot_form_keep(pool, &best, qdot_mul(pool, scaled(pool, c, out), inner));
        }
        if (all_moving(f, &groups))
            qdot_form_keep(pool, &best, say_product(form, p, c));
    }
    fmpz_mpoly_clear(g, f->ctx);
    fmpz_mpoly_clear(unit, f->ctx);
    fmpq_clear(one);
    qdot_factor_ungroup(f, &groups);
    return best;
}
