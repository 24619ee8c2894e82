/* form.c -- polynomials said shortly: collected in velocities, grouped by trigonometric
 * parts, factored, common powers out.
 */
#include "normal/form/form.h"

#include <string.h>

#include "base/memory.h"
#include "expr/build.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "normal/field/factor.h"
#include "normal/form/items.h"

enum { MOST_GROUPS = 120, MOST_DEPTH = 60, MOST_HORNER = 60, MOST_TRIED = 12,
       MOST_FLIPS = 2 };

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
    qdot_polynomials_clear(form->f, &form->known);
    qdot_free(form->said);
    qdot_free(form->fast);
}

qdot_expr
qdot_form_recall(const qdot_form *form, const fmpz_mpoly_t p)
{
    slong i = qdot_polynomials_find(form->f, &form->known, p);

    return i < 0 ? QDOT_NIL : form->said[i];
}

qdot_expr
qdot_form_remember(qdot_form *form, const fmpz_mpoly_t p, qdot_expr e)
{
    if (e == QDOT_NIL || qdot_polynomials_find(form->f, &form->known, p) >= 0)
        return e;
    if (qdot_grow(&form->said, &form->said_capacity, form->known.n + 1, sizeof *form->said) !=
            QDOT_OK ||
        qdot_polynomials_add(form->f, &form->known, p) != QDOT_OK)
        return qdot_pool_fail(form->f->pool);
    form->said[form->known.n - 1] = e;
    return e;
}

qdot_expr
qdot_form_integer(qdot_pool *pool, const fmpz_t n)
{
    qdot_expr e;
    fmpq_t c;

    fmpq_init(c);
    fmpq_set_fmpz(c, n);
    e = qdot_expr_fmpq(pool, c);
    fmpq_clear(c);
    return e;
}

/* p = c * monomial * rest, rest primitive with a positive leading coefficient; the
 * expression of the monomial. */
static qdot_expr
split_off_content(qdot_field *f, fmpz_mpoly_t rest, fmpz_t c, const fmpz_mpoly_t p)
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

/* --- polynomials without trigonometric variables: common powers factored out ------- */

/* What taking out a power of each variable saves; the power in power[]. The one that saves most; -1:
 * there is none. */
static slong
best_power(qdot_field *f, const fmpz_mpoly_t p, ulong *power, slong *saved)
{
    slong length = fmpz_mpoly_length(p, f->ctx), best = -1;
    ulong *exp = qdot_malloc(((size_t)f->n + 1) * 2 * sizeof *exp);
    ulong *count = exp + f->n;

    if (exp == NULL)
        return -1;
    memset(count, 0, (size_t)f->n * sizeof *count);
    for (slong i = 0; i < length; i++) {
        fmpz_mpoly_get_term_exp_ui(exp, p, i, f->ctx);
        for (slong v = 0; v < f->n; v++)
            if (exp[v] > 0) {
                if (count[v]++ == 0 || exp[v] < power[v])
                    power[v] = exp[v];
            }
    }
    for (slong v = 0; v < f->n; v++) {
        saved[v] = ((slong)count[v] - 1) * (power[v] > 1 ? 2 : 1);
        if (count[v] < 2 || (slong)count[v] == length)
            saved[v] = 0;
        if (saved[v] > 0 && (best < 0 || saved[v] > saved[best]))
            best = v;
    }
    qdot_free(exp);
    return best;
}

/* Split p: q = the terms divisible by v^power, divided by it; r = the other terms. */
static void
split_by_power(qdot_field *f, fmpz_mpoly_t q, fmpz_mpoly_t r, const fmpz_mpoly_t p, slong v,
               ulong power)
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

/* Factor v^power out of the terms of `rest`; keep the result in *best if it is the shortest form so far. */
static void
try_collecting_power(qdot_form *form, const fmpz_mpoly_t rest, slong v, ulong power,
                     qdot_expr factor, qdot_expr plain, qdot_expr *best)
{
    qdot_field *f = form->f;
    qdot_pool *pool = f->pool;
    qdot_expr x = qdot_pow_int(pool, f->gen[v].expr, (int64_t)power), collected;
    fmpz_mpoly_t q, r;

    fmpz_mpoly_init(q, f->ctx);
    fmpz_mpoly_init(r, f->ctx);
    split_by_power(f, q, r, rest, v, power);
    collected = qdot_form_horner(form, q);
    /* of two equally short forms prefer the one that collects parameters: (m1 - m2)*x */
    if (collected == QDOT_NIL ||
        (qdot_expr_node(pool, collected)->holds & ~(uint32_t)QDOT_HAS_PARAM) != 0)
        qdot_form_keep(pool, best, plain);
    x = qdot_add(pool, qdot_mul(pool, x, collected), qdot_form_horner(form, r));
    qdot_form_keep(pool, best, qdot_mul(pool, factor, x));
    fmpz_mpoly_clear(q, f->ctx);
    fmpz_mpoly_clear(r, f->ctx);
}

/* Bounded by MOST_DEPTH levels and MOST_HORNER terms, whatever the input; at the top, of few terms,
 * every variable that saves most is tried. */
qdot_expr
qdot_form_horner(qdot_form *form, const fmpz_mpoly_t p)
{
    qdot_field *f = form->f;
    qdot_pool *pool = f->pool;
    qdot_expr best = QDOT_NIL, factor, plain;
    fmpz_mpoly_t rest;
    fmpz_t c;

    if (fmpz_mpoly_length(p, f->ctx) <= 2 || fmpz_mpoly_length(p, f->ctx) > MOST_HORNER ||
        form->depth > MOST_DEPTH) {
        if (fmpz_mpoly_length(p, f->ctx) != 2)
            return qdot_field_expr(f, p);
    }
    fmpz_init(c);
    fmpz_mpoly_init(rest, f->ctx);
    form->depth++;
    factor = split_off_content(f, rest, c, p);
    factor = qdot_mul(pool, qdot_form_integer(pool, c), factor);
    plain = qdot_mul(pool, factor, qdot_field_expr(f, rest));
    if (fmpz_mpoly_length(rest, f->ctx) > 2) {
        ulong *power = qdot_calloc(2 * (size_t)f->n + 1, sizeof *power);
        slong *saved = (slong *)power + f->n, v;
        bool all = form->horner == 0 && fmpz_mpoly_length(rest, f->ctx) <= MOST_TRIED;

        form->horner++;
        v = power == NULL ? -1 : best_power(f, rest, power, saved);
        if (v >= 0)
            try_collecting_power(form, rest, v, power[v], factor, plain, &best);
        for (slong w = v + 1; v >= 0 && w < f->n && all; w++)
            if (saved[w] == saved[v])
                try_collecting_power(form, rest, w, power[w], factor, plain, &best);
        form->horner--;
        qdot_free(power);
    }
    qdot_form_keep(pool, &best, plain);
    form->depth--;
    fmpz_mpoly_clear(rest, f->ctx);
    fmpz_clear(c);
    return best;
}

/* Factor out the content, then complete squares. */
static qdot_expr
complete_squares(qdot_form *form, const fmpz_mpoly_t p)
{
    qdot_field *f = form->f;
    fmpz_mpoly_t rest;
    qdot_expr factor, e;
    fmpq_t one;
    fmpz_t c;

    if (fmpz_mpoly_length(p, f->ctx) < 4)
        return QDOT_NIL;
    fmpq_init(one);
    fmpq_one(one);
    fmpz_init(c);
    fmpz_mpoly_init(rest, f->ctx);
    factor = split_off_content(f, rest, c, p);
    e = qdot_form_squares(form, rest, one);
    if (e != QDOT_NIL)
        e = qdot_mul(f->pool, qdot_mul(f->pool, qdot_form_integer(f->pool, c), factor),
                     e);
    fmpz_mpoly_clear(rest, f->ctx);
    fmpz_clear(c);
    fmpq_clear(one);
    return e;
}

static qdot_expr
shorter_sum_or_squares(qdot_form *form, const fmpz_mpoly_t p)
{
    qdot_expr best = qdot_form_horner(form, p);

    qdot_form_keep(form->f->pool, &best, complete_squares(form, p));
    return best;
}

/* Collect the coefficients of each root: (m1 + m2)*(L1 + L2) - sqrt(...). Nil if there is no root. */
static qdot_expr
collect_by_roots(qdot_form *form, const fmpz_mpoly_t p)
{
    qdot_field *f = form->f;
    bool *by = qdot_calloc((size_t)f->n + 1, sizeof *by), any = false;
    qdot_expr sum = QDOT_NIL, front;
    fmpz_mpoly_t rest;
    qdot_groups groups;
    fmpq_t one;
    fmpz_t k;

    if (by == NULL)
        return qdot_pool_fail(f->pool);
    for (slong v = 0; v < f->n; v++) {
        by[v] = f->gen[v].kind == QDOT_GEN_ROOT;
        any |= by[v] && fmpz_mpoly_degree_si(p, v, f->ctx) > 0;
    }
    if (!any) {
        qdot_free(by);
        return QDOT_NIL;
    }
    fmpz_init(k);
    fmpq_init(one);
    fmpq_one(one);
    fmpz_mpoly_init(rest, f->ctx);
    front = split_off_content(f, rest, k, p);
    front = qdot_mul(f->pool, qdot_form_integer(f->pool, k), front);
    if (qdot_factor_group(f, &groups, rest, by) == QDOT_OK) {
        for (slong i = 0; i < groups.n && groups.n > 1; i++) {
            qdot_expr root = qdot_form_monomial(f, one, groups.key + i * f->n),
                      c = qdot_form_plain(form, groups.poly + i);

            sum = i == 0 ? qdot_mul(f->pool, c, root)
                         : qdot_add(f->pool, sum, qdot_mul(f->pool, c, root));
        }
    }
    qdot_factor_ungroup(f, &groups);
    fmpz_mpoly_clear(rest, f->ctx);
    fmpq_clear(one);
    fmpz_clear(k);
    qdot_free(by);
    return sum == QDOT_NIL ? sum : qdot_mul(f->pool, front, sum);
}

static qdot_expr
write_plain_product(qdot_form *form, const qdot_factors *factors)
{
    qdot_pool *pool = form->f->pool;
    qdot_expr product = qdot_form_integer(pool, factors->content);

    for (slong i = 0; i < factors->n; i++)
        product = qdot_mul(pool, product,
                           qdot_pow_int(pool, shorter_sum_or_squares(form, factors->poly + i),
                                        factors->exp[i]));
    return product;
}

/* The shortest form of a polynomial without trigonometric variables and without velocities. */
qdot_expr
qdot_form_plain(qdot_form *form, const fmpz_mpoly_t p)
{
    qdot_field *f = form->f;
    qdot_expr best = qdot_form_recall(form, p);
    qdot_factors factors;

    if (best != QDOT_NIL)
        return best;
    if (fmpz_mpoly_length(p, f->ctx) <= 1)
        return qdot_field_expr(f, p);
    best = shorter_sum_or_squares(form, p);
    if (fmpz_mpoly_length(p, f->ctx) <= 4) { /* multiply out short products: sign(x)*(1 - abs(x)) is sign(x) - x */
        qdot_expr sum = qdot_field_expr(f, p);

        if (sum != QDOT_NIL && best != QDOT_NIL &&
            qdot_expr_size(f->pool, sum) < qdot_expr_size(f->pool, best))
            best = sum;
    }
    if (fmpz_mpoly_length(p, f->ctx) > 2)
        qdot_form_keep(f->pool, &best, collect_by_roots(form, p));
    if (fmpz_mpoly_length(p, f->ctx) > 2 || fmpz_mpoly_total_degree_si(p, f->ctx) > 1) {
        if (qdot_factor(f, &factors, p) == QDOT_OK) {
            qdot_form_keep(f->pool, &best, write_plain_product(form, &factors));
            if (qdot_factor_join(f, &factors))
                qdot_form_keep(f->pool, &best, write_plain_product(form, &factors));
        }
        qdot_factor_clear(f, &factors);
    }
    return qdot_form_remember(form, p, best);
}

/* --- polynomials with trigonometric variables: sum of (coefficient) * (trigonometric part) --- */

/* Write coefficient * trigonometric factor; integers are moved to where they shorten it (2 sin a cos a). */
static qdot_expr
write_product_with_trig(qdot_form *form, const fmpz_mpoly_t coefficient, const fmpz_mpoly_t trig)
{
    qdot_field *f = form->f;
    fmpz_mpoly_t primitive, scaled;
    qdot_expr e, best = QDOT_NIL;
    fmpz_t c;

    fmpz_init(c);
    fmpz_mpoly_init(primitive, f->ctx);
    fmpz_mpoly_init(scaled, f->ctx);
    qdot_field_primitive(f, c, primitive, coefficient, true);
    fmpz_mpoly_scalar_mul_fmpz(scaled, trig, c, f->ctx);
    e = qdot_form_plain(form, primitive);
    qdot_form_keep(f->pool, &best, qdot_mul(f->pool, e, qdot_form_trig(form, scaled)));
    if (!fmpz_is_one(c)) {
        e = qdot_mul(f->pool, qdot_form_integer(f->pool, c), e);
        qdot_form_keep(f->pool, &best, qdot_mul(f->pool, e, qdot_form_trig(form, trig)));
    }
    fmpz_clear(c);
    fmpz_mpoly_clear(primitive, f->ctx);
    fmpz_mpoly_clear(scaled, f->ctx);
    return best;
}

/* Items keyed by trigonometric parts (or, `by_trig`, made by terms t first: equal
 * coefficients bring their t together). */
static qdot_expr
write_groups(qdot_form *form, const fmpz_mpoly_t p, bool by_trig)
{
    qdot_field *f = form->f;
    bool *by = qdot_malloc((size_t)f->n + 1);
    qdot_items items = {0};
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
        status = by_trig ? qdot_items_add(f, &items, groups.poly + i, key)
                         : qdot_items_add_parts(f, &items, groups.poly + i, key);
        fmpz_mpoly_clear(key, f->ctx);
    }
    for (size_t i = 0; i < items.n && status == QDOT_OK; i++) {
        if (!by_trig) {
            sum =
                qdot_add(f->pool, sum, write_product_with_trig(form, items.at[i].sum, items.at[i].key));
        } else { /* write the trigonometric sum group by group */
            qdot_items parts = {0};
            fmpz_mpoly_t unit;
            qdot_expr inner = QDOT_ZERO;

            fmpz_mpoly_init(unit, f->ctx);
            fmpz_mpoly_one(unit, f->ctx);
            status = qdot_items_add_parts(f, &parts, items.at[i].sum, unit);
            for (size_t k = 0; k < parts.n && status == QDOT_OK; k++)
                inner = qdot_add(f->pool, inner,
                                 write_product_with_trig(form, parts.at[k].sum, parts.at[k].key));
            sum = qdot_add(
                f->pool, sum,
                qdot_mul(f->pool, qdot_form_plain(form, items.at[i].key), inner));
            fmpz_mpoly_clear(unit, f->ctx);
            qdot_items_clear(f, &parts);
        }
    }
    qdot_factor_ungroup(f, &groups);
    qdot_items_clear(f, &items);
    fmpq_clear(one);
    qdot_free(by);
    return status == QDOT_OK ? sum : qdot_pool_fail(f->pool);
}

bool
qdot_form_has_trig(const qdot_form *form, const fmpz_mpoly_t p)
{
    for (slong v = 0; v < form->f->n; v++)
        if (form->trig[v] && fmpz_mpoly_degree_si(p, v, form->f->ctx) > 0)
            return true;
    return false;
}

/* Write the polynomial p as a sum. */
static qdot_expr
write_as_sum(qdot_form *form, const fmpz_mpoly_t p)
{
    qdot_field *f = form->f;
    qdot_expr best = QDOT_NIL;

    if (!qdot_form_has_trig(form, p))
        return qdot_form_horner(form, p);
    if (fmpz_mpoly_length(p, f->ctx) > MOST_GROUPS)
        return qdot_field_expr(f, p);
    qdot_form_keep(f->pool, &best, write_groups(form, p, false));
    if (fmpz_mpoly_length(p, f->ctx) > 1)
        qdot_form_keep(f->pool, &best, write_groups(form, p, true));
    return best;
}

static qdot_expr
write_product_of_sums(qdot_form *form, const qdot_factors *factors)
{
    qdot_pool *pool = form->f->pool;
    qdot_expr e = qdot_form_integer(pool, factors->content);

    for (slong i = 0; i < factors->n; i++)
        e = qdot_mul(
            pool, e,
            qdot_pow_int(pool, write_as_sum(form, factors->poly + i), factors->exp[i]));
    return e;
}

static qdot_expr
write_as_factors(qdot_form *form, const fmpz_mpoly_t p)
{
    qdot_field *f = form->f;
    qdot_expr e = QDOT_NIL;
    qdot_factors factors;

    if (qdot_factor(f, &factors, p) == QDOT_OK) {
        e = write_product_of_sums(form, &factors);
        if (qdot_factor_join(f, &factors)) /* try whether two factors form one difference again: cosh(u)^2 - cos(v)^2 */
            qdot_form_keep(f->pool, &e, write_product_of_sums(form, &factors));
    }
    qdot_factor_clear(f, &factors);
    return e;
}

qdot_expr
qdot_form_coefficient(qdot_form *form, const fmpz_mpoly_t p)
{
    qdot_field *f = form->f;
    qdot_pool *pool = f->pool;
    qdot_expr best, factor, e;
    fmpz_mpoly_t rest, flipped;
    fmpz_t c;

    if (!qdot_form_has_trig(form, p))
        return qdot_form_plain(form, p);
    best = qdot_form_recall(form, p);
    if (best != QDOT_NIL)
        return best;
    fmpz_init(c);
    fmpz_mpoly_init(rest, f->ctx);
    fmpz_mpoly_init(flipped, f->ctx);
    qdot_form_keep(pool, &best, write_as_sum(form, p));
    factor = split_off_content(f, rest, c, p);
    factor = qdot_mul(pool, qdot_form_integer(pool, c), factor);
    if (factor != QDOT_ONE && fmpz_mpoly_length(rest, f->ctx) > 1)
        qdot_form_keep(pool, &best, qdot_mul(pool, factor, write_as_sum(form, rest)));
    if (fmpz_mpoly_length(rest, f->ctx) >= 4 && fmpz_mpoly_length(rest, f->ctx) <= 8) {
        fmpq_t one; /* try completed squares: (2 + v*cos(u/2))^2 + v^2/4 */

        fmpq_init(one);
        fmpq_one(one);
        e = qdot_form_squares(form, rest, one);
        if (e != QDOT_NIL)
            qdot_form_keep(pool, &best, qdot_mul(pool, factor, e));
        fmpq_clear(one);
    }
    if (fmpz_mpoly_length(rest, f->ctx) > 1) {
        int flips = 0;

        qdot_form_keep(pool, &best, qdot_mul(pool, factor, write_as_factors(form, rest)));
        for (slong v = 0; v < f->n && flips < MOST_FLIPS && qdot_field_goes(f); v++)
            if ((f->gen[v].kind == QDOT_GEN_COS || f->gen[v].kind == QDOT_GEN_COSH) &&
                fmpz_mpoly_degree_si(rest, v, f->ctx) >= 2) {
                flips++;
                if (qdot_factor_flip(f, flipped, rest, v) == QDOT_OK &&
                    qdot_field_goes(f))
                    qdot_form_keep(pool, &best,
                                   qdot_mul(pool, factor, write_as_factors(form, flipped)));
            }
    }
    fmpz_clear(c);
    fmpz_mpoly_clear(rest, f->ctx);
    fmpz_mpoly_clear(flipped, f->ctx);
    return qdot_form_remember(form, p, best);
}
