/* trig-form.c -- the shortest way to say a polynomial in sines and cosines: Pythagoras
 * either way, as a product, or by multiple angles and sums of angles.
 */
#include "expr/build.h"
#include "expr/elementary.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/node.h"
#include "normal/form/form.h"

#include <string.h>

#include "base/memory.h"
#include "expr/calculus.h"
#include "expr/walk.h"
#include "normal/field/factor.h"

enum { MOST_ANGLES = 4, MOST_HARMONICS = 40, MOST_DEGREE = 8, MOST_FLIPS = 3 };

/* Whether a product has a denominator. */
static bool
has_denominator(const qdot_pool *pool, qdot_expr e)
{
    for (uint32_t i = 2;
         qdot_expr_kind(pool, e) == QDOT_PROD && i < qdot_expr_count(pool, e); i += 2)
        if (qdot_expr_is_negative(pool, qdot_expr_arg(pool, e, i)))
            return true;
    return false;
}

/* What a person would rather not read in e, its sum factors and those of its terms: a minus in
 * front of a sum, a difference, a fraction within a product. */
static int
count_awkward(const qdot_pool *pool, qdot_expr e, bool inner)
{
    uint32_t n = qdot_expr_count(pool, e);
    int count = 0;

    if (qdot_expr_kind(pool, e) == QDOT_PROD) {
        for (uint32_t i = 1; i < n; i += 2) {
            qdot_expr b = qdot_expr_arg(pool, e, i);

            if (qdot_expr_kind(pool, b) == QDOT_SUM)
                count += 2 +
                         8 * (qdot_expr_is_negative(pool, b) ||
                              (qdot_expr_node(pool, b)->sign & QDOT_LE0)) +
                         count_awkward(pool, b, true);
        }
    } else if (qdot_expr_kind(pool, e) == QDOT_SUM) {
        for (uint32_t i = 0; i < n; i += i == 0 ? 1 : 2) {
            qdot_expr x = qdot_expr_arg(pool, e, i),
                      c = i == 0 ? x : qdot_expr_arg(pool, e, i + 1);

            count += fmpq_sgn(qdot_expr_rational(pool, c)) < 0;
            if (inner)
                count += !fmpz_is_one(fmpq_denref(qdot_expr_rational(pool, c))) +
                         (i > 0 && has_denominator(pool, x));
            if (i > 0 && !inner && qdot_expr_kind(pool, x) == QDOT_PROD)
                count += count_awkward(pool, x, true);
        }
    }
    return count;
}

void
qdot_form_keep(qdot_pool *pool, qdot_expr *best, qdot_expr e)
{
    uint64_t now, before;

    if (e == QDOT_NIL || e == *best)
        return;
    now = qdot_expr_size(pool, e);
    before = *best == QDOT_NIL ? UINT64_MAX : qdot_expr_size(pool, *best);
    if (now < before || *best == QDOT_NIL ||
        (now == before && count_awkward(pool, e, false) < count_awkward(pool, *best, false)))
        *best = e;
}

qdot_expr
qdot_form_monomial(qdot_field *f, const fmpq_t c, const ulong *exp)
{
    qdot_expr few[24],
        *factor = f->n > 20 ? qdot_malloc(((size_t)f->n + 1) * sizeof *factor) : few;
    qdot_expr e;
    size_t n = 0;

    if (factor == NULL)
        return qdot_pool_fail(f->pool);
    factor[n++] = qdot_expr_fmpq(f->pool, c);
    for (slong v = 0; v < f->n; v++)
        if (exp[v] != 0)
            factor[n++] = qdot_pow_int(f->pool, f->gen[v].expr, (int64_t)exp[v]);
    e = qdot_product(f->pool, n, factor);
    if (factor != few)
        qdot_free(factor);
    return e;
}

/* --- Fourier series: sums of sin and cos of combinations of the angles ------------- */

struct harmonic {
    int k[MOST_ANGLES];
    fmpq s, c;
};

struct fourier {
    struct harmonic at[MOST_HARMONICS];
    size_t n;
    bool full;
};

static struct harmonic *
find_harmonic(struct fourier *x, const int *k)
{
    for (size_t i = 0; i < x->n; i++)
        if (memcmp(x->at[i].k, k, sizeof x->at[i].k) == 0)
            return &x->at[i];
    if (x->n == MOST_HARMONICS) {
        x->full = true;
        return NULL;
    }
    memcpy(x->at[x->n].k, k, sizeof x->at[x->n].k);
    fmpq_init(&x->at[x->n].s);
    fmpq_init(&x->at[x->n].c);
    return &x->at[x->n++];
}

static void
fourier_clear(struct fourier *x)
{
    for (size_t i = 0; i < x->n; i++) {
        fmpq_clear(&x->at[i].s);
        fmpq_clear(&x->at[i].c);
    }
    x->n = 0;
}

/* Add the harmonic a sin(k) + b cos(k), where k are multiples of the angles, the first non-zero made positive. */
static void
fourier_add(struct fourier *x, const int *k, const fmpq *a, const fmpq *b)
{
    int plus[MOST_ANGLES], sign = 0;
    struct harmonic *h;

    for (int i = 0; i < MOST_ANGLES; i++) {
        if (sign == 0)
            sign = k[i] > 0 ? 1 : k[i] < 0 ? -1 : 0;
        plus[i] = sign < 0 ? -k[i] : k[i];
    }
    h = find_harmonic(x, plus);
    if (h == NULL)
        return;
    fmpq_add(&h->c, &h->c, b);
    if (sign > 0)
        fmpq_add(&h->s, &h->s, a);
    else if (sign < 0)
        fmpq_sub(&h->s, &h->s, a);
}

/* y = x times sin (or cos) of the j-th angle; the signs of the product formulas are
 *   circular    s s' = (c- - c+)/2   hyperbolic  S S' = (C+ - C-)/2, all others alike. */
static void
fourier_multiply(struct fourier *y, const struct fourier *x, int j, bool sine, bool circular)
{
    fmpq_t zero, s, c, minus;

    fmpq_init(zero);
    fmpq_init(s);
    fmpq_init(c);
    fmpq_init(minus);
    for (size_t i = 0; i < x->n; i++) {
        int up[MOST_ANGLES], down[MOST_ANGLES];

        memcpy(up, x->at[i].k, sizeof up);
        memcpy(down, x->at[i].k, sizeof down);
        up[j]++;
        down[j]--;
        fmpq_div_2exp(s, &x->at[i].s, 1);
        fmpq_div_2exp(c, &x->at[i].c, 1);
        /* with s, c sine and cosine, s+, c+ of the sum of angles: s c' = (s+ + s-)/2, c c' = (c+ + c-)/2 */
        if (!sine) {
            fourier_add(y, up, s, c);
            fourier_add(y, down, s, c);
            continue;
        }
        /* c s' = (s+ - s-)/2 */
        fmpq_neg(minus, c);
        fourier_add(y, up, c, zero);
        fourier_add(y, down, minus, zero);
        fmpq_neg(minus, s);
        fourier_add(y, circular ? down : up, zero, s);
        fourier_add(y, circular ? up : down, zero, minus);
    }
    fmpq_clear(zero);
    fmpq_clear(s);
    fmpq_clear(c);
    fmpq_clear(minus);
}

/* Find the sine variables of the angles in p; -1 if there are too many, or both circular and hyperbolic ones, or Jacobi's
 * sn and cn, which people write as powers and products. */
static int
find_angles(qdot_field *f, const slong *degree, slong *sine, bool *circular)
{
    int n = 0, kinds = 0;
    slong total = 0;

    for (slong v = 0; v < f->n; v++) {
        bool s = f->gen[v].kind == QDOT_GEN_SIN || f->gen[v].kind == QDOT_GEN_SINH;

        total += degree[v];
        if (!s || (degree[v] == 0 && degree[f->gen[v].pair] == 0))
            continue;
        if (n == MOST_ANGLES || qdot_expr_is_function(f->pool, f->gen[v].of, QDOT_JACOBI_AM))
            return -1;
        kinds |= f->gen[v].kind == QDOT_GEN_SIN ? 1 : 2;
        sine[n++] = v;
    }
    *circular = kinds == 1;
    return kinds == 3 || total > MOST_DEGREE ? -1 : n;
}

/* The argument of a harmonic, a combination of angles with the denominator `parts`. */
static qdot_expr
harmonic_argument(qdot_field *f, const struct harmonic *h, int n, const slong *sine, int parts)
{
    qdot_pool *pool = f->pool;
    qdot_expr angle = QDOT_ZERO;

    for (int j = 0; j < n; j++)
        angle = qdot_add(
            pool, angle,
            qdot_expand(pool, qdot_mul(pool, qdot_expr_int(pool, h->k[j] / parts),
                                       f->gen[sine[j]].of)));
    return angle;
}

static qdot_expr
write_harmonics(qdot_field *f, const struct fourier *x, int n, const slong *sine,
                bool circular)
{
    qdot_pool *pool = f->pool;
    qdot_expr sum = QDOT_ZERO;

    for (size_t i = 0; i < x->n; i++) {
        qdot_expr angle;

        if (fmpq_is_zero(&x->at[i].s) && fmpq_is_zero(&x->at[i].c))
            continue;
        angle = harmonic_argument(f, &x->at[i], n, sine, 1);
        sum = qdot_add(pool, sum,
                       qdot_mul(pool, qdot_expr_fmpq(pool, &x->at[i].s),
                                qdot_fun1(pool, circular ? QDOT_SIN : QDOT_SINH, angle)));
        sum = qdot_add(pool, sum,
                       qdot_mul(pool, qdot_expr_fmpq(pool, &x->at[i].c),
                                qdot_fun1(pool, circular ? QDOT_COS : QDOT_COSH, angle)));
    }
    return sum;
}

/* With b cos(2 k) as b - 2 b sin(k)^2 or 2 b cos(k)^2 - b (hyperbolic: b + 2 b sinh(k)^2, 2 b
 * cosh(k)^2 - b), of the harmonics the one that makes it shortest. */
static qdot_expr
write_one_harmonic_as_square(qdot_field *f, struct fourier *x, int n, const slong *sine, bool circular)
{
    static const int origin[MOST_ANGLES];
    struct harmonic *zero = find_harmonic(x, origin);
    qdot_pool *pool = f->pool;
    qdot_expr best = QDOT_NIL;
    fmpq_t b, constant, rest;

    if (zero == NULL || fmpq_is_zero(&zero->c))
        return QDOT_NIL;
    fmpq_init(b);
    fmpq_init(constant);
    fmpq_init(rest);
    fmpq_set(constant, &zero->c);
    for (size_t i = 0; i < x->n; i++) {
        struct harmonic *h = &x->at[i];
        bool even = h != zero && !fmpq_is_zero(&h->c);

        for (int j = 0; j < MOST_ANGLES; j++)
            even &= h->k[j] % 2 == 0;
        for (int cosine = 0; cosine < 2 && even; cosine++) {
            qdot_expr square = harmonic_argument(f, h, n, sine, 2);

            fmpq_set(b, &h->c);
            if (cosine)
                fmpq_sub(rest, constant, b);
            else
                fmpq_add(rest, constant, b);
            fmpq_set(&zero->c, rest);
            square = qdot_fun1(pool,
                               circular ? cosine ? QDOT_COS : QDOT_SIN
                               : cosine ? QDOT_COSH
                                        : QDOT_SINH,
                               square);
            fmpq_zero(&h->c);
            if (circular && !cosine)
                fmpq_neg(b, b);
            fmpq_mul_2exp(b, b, 1);
            square =
                qdot_mul(pool, qdot_expr_fmpq(pool, b), qdot_pow_int(pool, square, 2));
            qdot_form_keep(
                pool, &best,
                qdot_add(pool, square, write_harmonics(f, x, n, sine, circular)));
            fmpq_div_2exp(&h->c, b, 1);
            if (circular && !cosine)
                fmpq_neg(&h->c, &h->c);
            fmpq_set(&zero->c, constant);
        }
    }
    fmpq_clear(b);
    fmpq_clear(constant);
    fmpq_clear(rest);
    return best;
}

/* Write p in terms of sines and cosines of multiple angles; nil if that is too long. */
static qdot_expr
write_by_harmonics(qdot_field *f, const fmpz_mpoly_t p)
{
    static const int origin[MOST_ANGLES];
    slong sine[MOST_ANGLES],
        *degree = qdot_malloc(((size_t)f->n + 1) * 2 * sizeof *degree);
    ulong *exp = (ulong *)(degree + f->n);
    struct fourier *x, *y, *sum;
    qdot_expr e = QDOT_NIL;
    bool circular;
    int n;
    fmpq_t c, zero;

    if (degree == NULL)
        return qdot_pool_fail(f->pool);
    x = qdot_calloc(3, sizeof *x);
    if (x == NULL) {
        qdot_free(degree);
        return qdot_pool_fail(f->pool);
    }
    y = x + 1;
    sum = x + 2;
    fmpz_mpoly_degrees_si(degree, p, f->ctx);
    n = find_angles(f, degree, sine, &circular);
    fmpq_init(c);
    fmpq_init(zero);
    for (slong i = 0; n > 0 && i < fmpz_mpoly_length(p, f->ctx) && !sum->full; i++) {
        fmpz_mpoly_get_term_coeff_fmpz(fmpq_numref(c), p, i, f->ctx);
        fmpz_mpoly_get_term_exp_ui(exp, p, i, f->ctx);
        fourier_add(x, origin, zero, c);
        for (int j = 0; j < n; j++)
            for (int sin_or_cos = 0; sin_or_cos < 2; sin_or_cos++) {
                ulong k = exp[sin_or_cos == 0 ? sine[j] : (slong)f->gen[sine[j]].pair];

                while (k-- > 0) {
                    struct fourier *swap = x;

                    fourier_multiply(y, x, j, sin_or_cos == 0, circular);
                    fourier_clear(x);
                    sum->full |= y->full;
                    x = y;
                    y = swap;
                }
            }
        for (size_t h = 0; h < x->n; h++)
            fourier_add(sum, x->at[h].k, &x->at[h].s, &x->at[h].c);
        fourier_clear(x);
    }
    if (n > 0 && !sum->full) {
        e = write_harmonics(f, sum, n, sine, circular);
        qdot_form_keep(f->pool, &e, write_one_harmonic_as_square(f, sum, n, sine, circular));
    }
    fourier_clear(sum);
    fmpq_clear(c);
    fmpq_clear(zero);
    qdot_free(x < y ? x : y);
    qdot_free(degree);
    return e;
}

/* --- sin^2 + cos^2 = 1 used either way, in sums and products ----------------------- */

static qdot_expr
write_factors_separately(qdot_form *form, const fmpz_mpoly_t p)
{
    qdot_field *f = form->f;
    qdot_factors factors;
    qdot_expr e = QDOT_NIL;
    fmpq_t c;

    if (qdot_factor(f, &factors, p) == QDOT_OK) {
        fmpq_init(c);
        fmpq_set_fmpz(c, factors.content);
        e = qdot_expr_fmpq(f->pool, c);
        fmpq_clear(c);
        for (slong i = 0; i < factors.n; i++) {
            /* if p has several factors, each has a smaller degree: sin(a - b)*cos(b) */
            bool part = factors.n > 1 || factors.exp[i] > 1;
            qdot_expr one = part ? qdot_form_trig(form, factors.poly + i)
                                 : qdot_field_expr(f, factors.poly + i);

            e = qdot_mul(f->pool, e, qdot_pow_int(f->pool, one, factors.exp[i]));
        }
    }
    qdot_factor_clear(f, &factors);
    return e;
}

/* Replace *best by e if e is shorter; of two equally long ones prefer a product of functions to a sum. */
static void
keep_shorter_or_product(qdot_pool *pool, qdot_expr *best, qdot_expr e)
{
    if (e != QDOT_NIL && *best != QDOT_NIL && qdot_expr_kind(pool, *best) == QDOT_SUM &&
        qdot_expr_kind(pool, e) == QDOT_PROD &&
        qdot_expr_size(pool, e) == qdot_expr_size(pool, *best) &&
        count_awkward(pool, e, false) <= count_awkward(pool, *best, false))
        *best = e;
    qdot_form_keep(pool, best, e);
}

qdot_expr
qdot_form_trig(qdot_form *form, const fmpz_mpoly_t p)
{
    qdot_field *f = form->f;
    slong flip[MOST_FLIPS];
    unsigned flips = 0;
    qdot_expr best = qdot_form_recall(form, p);
    fmpz_mpoly_t q;

    if (best != QDOT_NIL)
        return best;

    if (fmpz_mpoly_length(p, f->ctx) == 1 && fmpz_mpoly_total_degree_si(p, f->ctx) <= 1)
        return qdot_field_expr(f, p);
    for (slong v = 0; v < f->n && flips < MOST_FLIPS; v++)
        if ((f->gen[v].kind == QDOT_GEN_COS || f->gen[v].kind == QDOT_GEN_COSH) &&
            fmpz_mpoly_degree_si(p, v, f->ctx) >= 2)
            flip[flips++] = v;
    fmpz_mpoly_init(q, f->ctx);
    for (unsigned set = 0; set < 1u << flips; set++) {
        bool done = true;

        fmpz_mpoly_set(q, p, f->ctx);
        for (unsigned i = 0; i < flips && done; i++)
            if (set >> i & 1)
                done = qdot_factor_flip(f, q, q, flip[i]) == QDOT_OK;
        if (!done || !qdot_field_goes(f))
            break;
        qdot_form_keep(f->pool, &best, qdot_field_expr(f, q));
        if (fmpz_mpoly_length(q, f->ctx) > 1)
            keep_shorter_or_product(f->pool, &best, write_factors_separately(form, q));
    }
    fmpz_mpoly_clear(q, f->ctx);
    qdot_form_keep(f->pool, &best, write_by_harmonics(f, p));
    return qdot_form_remember(form, p, best);
}
