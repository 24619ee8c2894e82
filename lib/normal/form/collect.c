/* collect.c -- polynomials collected in velocities and accelerations, common factors
 * out. */
#include "base/memory.h"
#include "expr/build.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "normal/field/factor.h"
#include "normal/form/form.h"
#include "normal/form/items.h"

static qdot_expr
scaled_by(qdot_pool *pool, const fmpq_t c, qdot_expr e)
{
    return qdot_mul(pool, qdot_expr_fmpq(pool, c), e);
}

/* Set g to the greatest common divisor of the coefficients. */
static void
common_divisor_of_groups(qdot_field *f, fmpz_mpoly_t g, const qdot_groups *groups)
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
write_scaled(qdot_form *form, const fmpq_t c, const fmpz_mpoly_t p)
{
    qdot_field *f = form->f;
    fmpz_mpoly_t whole;
    qdot_expr e, out;
    fmpz_t content;
    fmpq_t k;

    fmpz_init(content);
    fmpq_init(k);
    fmpz_mpoly_init(whole, f->ctx);
    qdot_field_primitive(f, content, whole, p, false);
    fmpq_mul_fmpz(k, c, content);
    out = fmpz_is_pm1(fmpq_numref(k))
              ? QDOT_NIL
              : scaled_by(f->pool, k, qdot_form_coefficient(form, whole));
    fmpz_mpoly_scalar_mul_fmpz(whole, whole, fmpq_numref(k), f->ctx);
    fmpz_one(fmpq_numref(k));
    e = scaled_by(f->pool, k, qdot_form_coefficient(form, whole));
    if (out != QDOT_NIL &&
        /* if not longer, write the number in front: 2*(1 - x)*v' */
        qdot_expr_size(f->pool, out) <= qdot_expr_size(f->pool, e))
        e = out;
    fmpz_clear(content);
    fmpq_clear(k);
    fmpz_mpoly_clear(whole, f->ctx);
    return e;
}

/* c * coefficient * (sum of monomials in velocities), the sum primitive and not
 * negative. */
static qdot_expr
write_merged(qdot_form *form, const qdot_item *item, const fmpq_t c)
{
    qdot_field *f = form->f;
    fmpz_mpoly_t primitive;
    qdot_expr e;
    fmpz_t content;
    fmpq_t k;

    fmpz_init(content);
    fmpq_init(k);
    fmpz_mpoly_init(primitive, f->ctx);
    qdot_field_primitive(f, content, primitive, item->sum, true);
    fmpq_mul_fmpz(k, c, content);
    e = qdot_mul(f->pool, write_scaled(form, k, item->key),
                 fmpz_mpoly_length(primitive, f->ctx) == 1
                     ? qdot_field_expr(f, primitive)
                     : qdot_form_plain(form, primitive));
    fmpz_clear(content);
    fmpq_clear(k);
    fmpz_mpoly_clear(primitive, f->ctx);
    return e;
}

/* c times the sum of coefficient * monomial, coefficients divided by g; like coefficients
 * together: (u^2 + v^2)*(du^2 + dv^2). */
static qdot_expr
write_collected(qdot_form *form, const qdot_groups *groups, const fmpz_mpoly_t g,
                const fmpq_t c, bool merged)
{
    qdot_field *f = form->f;
    qdot_items items = {0};
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
            status = qdot_items_add(f, &items, value, key);
        } else {
            sum = qdot_add(f->pool, sum,
                           qdot_mul(f->pool, write_scaled(form, c, value),
                                    qdot_form_monomial(f, one, groups->key + i * f->n)));
        }
    }
    for (size_t i = 0; i < items.n && status == QDOT_OK; i++)
        sum = qdot_add(f->pool, sum, write_merged(form, &items.at[i], c));
    qdot_items_clear(f, &items);
    fmpz_mpoly_clear(key, f->ctx);
    fmpz_mpoly_clear(value, f->ctx);
    fmpq_clear(one);
    return status == QDOT_OK ? sum : qdot_pool_fail(f->pool);
}

/* Whether every monomial contains a velocity, an acceleration or the like. */
static bool
all_contain_velocities(qdot_field *f, const qdot_groups *groups)
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

/* Whether the factor depends on time, such as exp(c*t/m) in front of both kinetic and potential energy. */
static bool
factor_contains_time(const qdot_form *form, const fmpz_mpoly_t g)
{
    qdot_field *f = form->f;

    for (slong v = 0; v < f->n; v++)
        if (fmpz_mpoly_degree_si(g, v, f->ctx) > 0 &&
            (qdot_expr_node(f->pool, f->gen[v].expr)->holds & QDOT_HAS_TIME))
            return true;
    return false;
}

/* Whether the expression is of first degree in velocities, such as m*(x*y' - y*x' + w*x). */
static bool
is_linear_in_velocities(const qdot_form *form, const qdot_groups *groups)
{
    qdot_field *f = form->f;

    for (slong i = 0; i < groups->n; i++) {
        ulong degree = 0;

        for (slong v = 0; v < f->n; v++) {
            degree += groups->key[i * f->n + v];
            if (groups->key[i * f->n + v] > 0 &&
                !(qdot_expr_node(f->pool, f->gen[v].expr)->holds & QDOT_HAS_VELOCITY))
                return false;
        }
        if (degree > 1)
            return false;
    }
    return true;
}

/* Whether the sum is one thing, not a kinetic and a potential part: every term moves, or it stands
 * over a denominator, or it is of first degree in velocities. */
static bool
is_not_energy_sum(const qdot_form *form, const fmpz_mpoly_t g, const qdot_groups *groups)
{
    qdot_field *f = form->f;

    if (form->quotient || all_contain_velocities(f, groups))
        return true;
    return factor_contains_time(form, g) || is_linear_in_velocities(form, groups);
}

/* Whether g comes out as in a book: nothing of it is left in the quotients (m*L^2 comes
 * out of m*L^2*q'' + m*L^2*..., but L1 stays in (m1 + m2)*L1^2*q1'' + m2*L1*L2*..., if
 * not above a denominator), and it is not taken out of a sum of a kinetic and a potential part. */
static bool
factor_comes_out_whole(qdot_form *form, const fmpz_mpoly_t g, const qdot_groups *groups)
{
    qdot_field *f = form->f;

    for (slong v = 0; v < f->n && !form->quotient; v++) {
        slong degree = fmpz_mpoly_degree_si(g, v, f->ctx);

        for (slong i = 0; i < groups->n && degree > 0; i++)
            if (fmpz_mpoly_degree_si(groups->poly + i, v, f->ctx) > degree)
                return false;
    }
    return !fmpz_mpoly_is_fmpz(g, f->ctx) && is_not_energy_sum(form, g, groups);
}

/* Whether a factor is a single generator that also occurs in another factor. */
static bool
has_repeated_variable(qdot_field *f, const qdot_factors *factors)
{
    for (slong i = 0; i < factors->n; i++) {
        slong v = 0;

        if (fmpz_mpoly_length(factors->poly + i, f->ctx) > 1)
            continue;
        while (v < f->n && fmpz_mpoly_degree_si(factors->poly + i, v, f->ctx) == 0)
            v++;
        for (slong k = 0; k < factors->n; k++)
            if (k != i && v < f->n &&
                fmpz_mpoly_degree_si(factors->poly + k, v, f->ctx) > 0)
                return false;
    }
    return true;
}

static qdot_expr
write_product(qdot_form *form, const fmpz_mpoly_t p, const fmpq_t c)
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
    if ((factors.n > 1 || (factors.n == 1 && factors.exp[0] > 1)) &&
        (form->quotient || has_repeated_variable(f, &factors))) {
        e = scaled_by(f->pool, c, qdot_form_integer(f->pool, factors.content));
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

/* Write the terms with velocities and those without separately: m*(x*y' - y*x') + 1/2*q*B*(x^2 + y^2). */
static qdot_expr
write_moving_terms_apart(qdot_form *form, const qdot_groups *groups, const fmpq_t c)
{
    qdot_field *f = form->f;
    qdot_expr still = QDOT_ZERO, e = QDOT_NIL;
    fmpz_mpoly_t moving, monomial;
    slong count = 0;

    fmpz_mpoly_init(moving, f->ctx);
    fmpz_mpoly_init(monomial, f->ctx);
    for (slong i = 0; i < groups->n; i++) {
        fmpz_mpoly_zero(monomial, f->ctx);
        fmpz_mpoly_push_term_si_ui(monomial, 1, groups->key + i * f->n, f->ctx);
        if (fmpz_mpoly_is_one(monomial, f->ctx)) {
            still = write_scaled(form, c, groups->poly + i);
            continue;
        }
        fmpz_mpoly_mul(monomial, monomial, groups->poly + i, f->ctx);
        fmpz_mpoly_add(moving, moving, monomial, f->ctx);
        count++;
    }
    if (count > 1)
        e = qdot_add(f->pool, qdot_form_say(form, moving, c), still);
    fmpz_mpoly_clear(moving, f->ctx);
    fmpz_mpoly_clear(monomial, f->ctx);
    return e;
}

static ulong
degree_in_velocities(const qdot_groups *groups, slong i, slong n)
{
    ulong degree = 0;

    for (slong v = 0; v < n; v++)
        degree += groups->key[i * n + v];
    return degree;
}

static bool
all_have_degree(const qdot_groups *groups, slong n, ulong degree)
{
    for (slong i = 0; i < groups->n; i++)
        if (degree_in_velocities(groups, i, n) != degree)
            return false;
    return true;
}

/* What is of second degree in velocities, of first, of none, each by itself:
 * m*(x'^2 + y'^2)/2 + m*w*(x*y' - y*x') + m*w^2*(x^2 + y^2)/2. Nil: it is of one degree. */
static qdot_expr
write_by_degree(qdot_form *form, const qdot_groups *groups, const fmpq_t c)
{
    enum { MOST_DEGREE = 8 };
    qdot_field *f = form->f;
    qdot_expr sum = QDOT_ZERO;
    fmpz_mpoly_t part, monomial;
    int parts = 0;

    for (slong i = 0; i < groups->n; i++) {
        if (degree_in_velocities(groups, i, f->n) > MOST_DEGREE)
            return QDOT_NIL;
        /* group by degree only polynomials in velocities alone, which are energies, not equations of motion */
        for (slong v = 0; v < f->n; v++)
            if (groups->key[i * f->n + v] > 0 &&
                !(qdot_expr_node(f->pool, f->gen[v].expr)->holds & QDOT_HAS_VELOCITY))
                return QDOT_NIL;
    }
    fmpz_mpoly_init(part, f->ctx);
    fmpz_mpoly_init(monomial, f->ctx);
    for (ulong degree = 0; degree <= MOST_DEGREE; degree++) {
        fmpz_mpoly_zero(part, f->ctx);
        for (slong i = 0; i < groups->n; i++) {
            if (degree_in_velocities(groups, i, f->n) != degree)
                continue;
            fmpz_mpoly_zero(monomial, f->ctx);
            fmpz_mpoly_push_term_si_ui(monomial, 1, groups->key + i * f->n, f->ctx);
            fmpz_mpoly_mul(monomial, monomial, groups->poly + i, f->ctx);
            fmpz_mpoly_add(part, part, monomial, f->ctx);
        }
        if (fmpz_mpoly_is_zero(part, f->ctx))
            continue;
        if (all_have_degree(groups, f->n, degree))
            break;
        parts++;
        sum = qdot_add(f->pool, sum, qdot_form_say(form, part, c));
    }
    fmpz_mpoly_clear(part, f->ctx);
    fmpz_mpoly_clear(monomial, f->ctx);
    return parts > 1 ? sum : QDOT_NIL;
}

/* Write the terms grouped by their parameters: m1*(x1*y1' - y1*x1') + m2*(x2*y2' - y2*x2'). */
static qdot_expr
write_by_parameters(qdot_form *form, const fmpz_mpoly_t p, const fmpq_t c)
{
    qdot_field *f = form->f;
    bool *by = qdot_calloc((size_t)f->n + 1, sizeof *by);
    qdot_expr sum = QDOT_ZERO;
    qdot_groups groups;
    fmpq_t one;

    if (by == NULL)
        return qdot_pool_fail(f->pool);
    for (slong v = 0; v < f->n; v++)
        by[v] = qdot_expr_node(f->pool, f->gen[v].expr)->holds == QDOT_HAS_PARAM;
    fmpq_init(one);
    fmpq_one(one);
    if (qdot_factor_group(f, &groups, p, by) != QDOT_OK)
        sum = qdot_pool_fail(f->pool);
    for (slong i = 0; i < groups.n && sum != QDOT_NIL; i++) {
        qdot_expr front = qdot_form_monomial(f, one, groups.key + i * f->n);

        sum = qdot_add(
            f->pool, sum,
            qdot_mul(f->pool, front,
                     scaled_by(f->pool, c, qdot_form_plain(form, groups.poly + i))));
    }
    qdot_factor_ungroup(f, &groups);
    fmpq_clear(one);
    qdot_free(by);
    return sum;
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
    qdot_form_keep(pool, &best, write_collected(form, &groups, unit, c, false));
    if (groups.n > 1) {
        qdot_expr out;

        if (form->quotient && fmpz_is_one(fmpq_denref(c))) /* keep an integer factor: 2*(u*u' + v*v')/d */
            qdot_form_keep(
                pool, &best,
                scaled_by(pool, c, write_collected(form, &groups, unit, one, false)));
        qdot_form_keep(pool, &best, write_collected(form, &groups, unit, c, true));
        common_divisor_of_groups(f, g, &groups);
        out = qdot_form_coefficient(form, g);
        for (int merged = 0; merged < 2 && factor_comes_out_whole(form, g, &groups); merged++) {
            qdot_expr inner = write_collected(form, &groups, g, one, merged);

            qdot_form_keep(pool, &best, qdot_mul(pool, scaled_by(pool, c, out), inner));
            if (!all_contain_velocities(f, &groups)) /* try a common factor in front: r^2*(m*phi' + 1/2*q*B) */
                qdot_form_keep(
                    pool, &best,
                    qdot_mul(pool, out, write_collected(form, &groups, g, c, merged)));
        }
        if (is_not_energy_sum(form, g, &groups))
            qdot_form_keep(pool, &best, write_product(form, p, c));
        if (!all_contain_velocities(f, &groups) && (form->quotient || is_linear_in_velocities(form, &groups)))
            qdot_form_keep(pool, &best, write_moving_terms_apart(form, &groups, c));
        if (form->depth == 0 && !form->quotient)
            qdot_form_keep(pool, &best, write_by_degree(form, &groups, c));
        if (!qdot_form_has_trig(form, p)) {
            if (is_linear_in_velocities(form, &groups))
                qdot_form_keep(pool, &best, write_by_parameters(form, p, c));
            qdot_form_keep(pool, &best, qdot_form_squares(form, p, c));
        }
    }
    fmpz_mpoly_clear(g, f->ctx);
    fmpz_mpoly_clear(unit, f->ctx);
    fmpq_clear(one);
    qdot_factor_ungroup(f, &groups);
    return best;
}
