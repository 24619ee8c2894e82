/* real-zeros.c -- the real zeros of a polynomial: intervals are halved until Descartes' rule of signs says that each
 * holds one, then bisected to the wanted precision.
 *
 * Collins and Akritas, Polynomial real root isolation using Descarte's rule of signs (SYMSAC 1976) 272.
 */
#include "normal/inequality/real-zeros.h"

#include <stdbool.h>
#include <stdlib.h>

#include <flint/fmpq_poly.h>

#include "base/interrupt.h"
#include "base/memory.h"

enum { MOST_DEGREE = 160 };
/* The most machine words that one call may change when it shifts polynomials: a few seconds of work. */
#define MOST_WORK 4000000000.0

/* --- intervals that hold one zero ------------------------------------------------------- */

/* An interval of x with its polynomial p, where 0 < t < 1 stands for x = (number + t) 2^(scale - depth). */
typedef struct {
    fmpz_poly_t p;
    fmpz_t number;
    slong depth;
} part;

typedef struct {
    qdot_vec(part) stack; /* intervals still to be searched, the leftmost on top */
    slong scale;
    bool minus; /* search for negative zeros: those of p(-x) */
    double work;
    arb_ptr zero; /* [degree] zeros found: balls that cover the isolating intervals, or exact numbers */
    slong found;
} isolation;

/* The number of sign changes along the non-zero coefficients; counting stops at 2. */
static int
sign_changes(const fmpz_poly_t p)
{
    int before = 0, changes = 0;

    for (slong i = 0; i <= fmpz_poly_degree(p) && changes < 2; i++) {
        int sign = fmpz_sgn(p->coeffs + i);

        changes += sign * before < 0;
        before = sign != 0 ? sign : before;
    }
    return changes;
}

/* Replace p(t) by p(t + 1), and count the cost. */
static void
isolation_shift(isolation *s, fmpz_poly_t p)
{
    const double n = (double)fmpz_poly_degree(p);
    fmpz_t one;

    fmpz_init_set_si(one, 1);
    fmpz_poly_taylor_shift(p, p, one);
    s->work += n * n * (1 + (double)fmpz_poly_max_limbs(p));
    fmpz_clear(one);
}

/* A bound on the number of zeros of p with 0 < t < 1, by Descartes' rule for (1 + t)^n p(1/(1 + t)): 0 and 1 are the
 * number itself, 2 stands for any number. */
static int
bound_number_of_zeros(isolation *s, const fmpz_poly_t p)
{
    fmpz_poly_t q;
    int changes;

    fmpz_poly_init(q);
    fmpz_poly_reverse(q, p, fmpz_poly_degree(p) + 1);
    isolation_shift(s, q);
    changes = sign_changes(q);
    fmpz_poly_clear(q);
    return changes;
}

/* Record one zero between `from` and from + 1 in units of 2^(scale - depth); `exact`: at `from` itself. */
static void
isolation_keep(isolation *s, const fmpz_t from, slong depth, bool exact)
{
    arb_ptr to = s->zero + s->found++;

    arb_set_fmpz(to, from);
    arb_mul_2exp_si(to, to, 1);
    if (!exact) {
        arb_add_ui(to, to, 1, ARF_PREC_EXACT);
        mag_one(arb_radref(to));
    }
    arb_mul_2exp_si(to, to, s->scale - depth - 1);
    if (s->minus)
        arb_neg(to, to);
}

static bool
push_interval(isolation *s, const fmpz_poly_t p, const fmpz_t number, slong depth)
{
    part *to;

    if (qdot_vec_push(&s->stack, (part){.depth = depth}) != QDOT_OK)
        return false;
    to = &s->stack.at[s->stack.n - 1];
    fmpz_poly_init(to->p);
    fmpz_poly_set(to->p, p);
    fmpz_init_set(to->number, number);
    return true;
}

/* Replace p by p(t/2) 2^degree, divided by the common factor of its coefficients. */
static void
halve_argument(fmpz_poly_t p)
{
    slong n = fmpz_poly_degree(p);

    for (slong i = 0; i < n; i++)
        fmpz_mul_2exp(p->coeffs + i, p->coeffs + i, (ulong)(n - i));
    fmpz_poly_primitive_part(p, p);
}

/* Replace the last interval on the stack by its two halves, and record a zero at the middle. False: no memory. */
static bool
isolation_split(isolation *s)
{
    part *last = &s->stack.at[s->stack.n - 1];
    fmpz_poly_t half;
    fmpz_t number;
    bool good;

    fmpz_poly_init(half);
    fmpz_init(number);
    halve_argument(last->p);
    fmpz_poly_set(half, last->p);
    isolation_shift(s, last->p);
    fmpz_mul_2exp(number, last->number, 1);
    fmpz_add_ui(last->number, number, 1);
    last->depth++;
    if (fmpz_is_zero(last->p->coeffs)) {
        isolation_keep(s, last->number, last->depth, true);
        fmpz_poly_shift_right(last->p, last->p, 1);
    }
    good = push_interval(s, half, number, last->depth);
    fmpz_clear(number);
    fmpz_poly_clear(half);
    return good;
}

/* Record the positive zeros of p, where p(0) != 0. False: too much work, interrupted, or no memory. */
static bool
isolate_positive(isolation *s, const fmpz_poly_t p)
{
    fmpz_t bound, zero;
    bool good;

    fmpz_init(bound);
    fmpz_init(zero);
    fmpz_poly_bound_roots(bound, p);
    s->scale = (slong)fmpz_bits(bound);
    good = push_interval(s, p, zero, 0);
    for (slong i = 1; good && i <= fmpz_poly_degree(p); i++)
        fmpz_mul_2exp(s->stack.at[0].p->coeffs + i, s->stack.at[0].p->coeffs + i, (ulong)(i * s->scale));
    while (s->stack.n > 0) {
        part *last = &s->stack.at[s->stack.n - 1];
        int most = good ? bound_number_of_zeros(s, last->p) : 0;

        good = good && s->work < MOST_WORK && !qdot_interrupt_is_set();
        if (most == 2 && good) {
            good = isolation_split(s);
            continue;
        }
        if (most == 1 && good)
            isolation_keep(s, last->number, last->depth, false);
        fmpz_poly_clear(last->p);
        fmpz_clear(last->number);
        s->stack.n--;
    }
    fmpz_clear(zero);
    fmpz_clear(bound);
    return good;
}

/* --- zeros to many digits ----------------------------------------------------------------- */

/* The sign of the polynomial p at a binary fraction. */
static int
sign_at(const fmpz_poly_t p, const arf_t at)
{
    arb_t x, v;
    int sign = 2;

    arb_init(x);
    arb_init(v);
    arb_set_arf(x, at);
    for (slong prec = 64; sign == 2; prec *= 2) {
        if (prec > 4096) { /* probably 0: evaluate exactly */
            arb_fmpz_poly_evaluate_arb_horner(v, p, x, ARF_PREC_EXACT);
            sign = arf_sgn(arb_midref(v));
            break;
        }
        arb_fmpz_poly_evaluate_arb_horner(v, p, x, prec);
        if (arb_is_zero(v) || !arb_contains_zero(v))
            sign = arf_sgn(arb_midref(v));
    }
    arb_clear(x);
    arb_clear(v);
    return sign;
}

/* Bisect an interval that contains one zero of p until its width is below 2^-bits times the zero. */
static void
bisect(arb_t zero, arb_srcptr isolated, const fmpz_poly_t p, slong bits)
{
    arf_t lo, hi, middle, width;
    int left;

    if (arb_is_exact(isolated)) {
        arb_set(zero, isolated);
        return;
    }
    arf_init(lo);
    arf_init(hi);
    arf_init(middle);
    arf_init(width);
    arb_get_lbound_arf(lo, isolated, ARF_PREC_EXACT);
    arb_get_ubound_arf(hi, isolated, ARF_PREC_EXACT);
    left = sign_at(p, lo);
    if (left == 0) { /* the interval's end is another zero of p: use the sign of p just inside */
        fmpz_poly_t slope;

        fmpz_poly_init(slope);
        fmpz_poly_derivative(slope, p);
        left = sign_at(slope, lo);
        fmpz_poly_clear(slope);
    }
    for (;;) {
        int sign;

        arf_sub(width, hi, lo, 64, ARF_RND_UP);
        arf_mul_2exp_si(width, width, bits);
        if ((arf_cmpabs(width, lo) <= 0 || arf_cmpabs(width, hi) <= 0) && arf_sgn(lo) * arf_sgn(hi) > 0)
            break;
        arf_add(middle, lo, hi, ARF_PREC_EXACT, ARF_RND_DOWN);
        arf_mul_2exp_si(middle, middle, -1);
        sign = sign_at(p, middle);
        if (sign != left)
            arf_set(hi, middle);
        if (sign == left || sign == 0)
            arf_set(lo, middle);
        if (sign == 0)
            break;
    }
    arb_set_interval_arf(zero, lo, hi, arf_bits(lo) + arf_bits(hi) + bits + 64);
    arf_clear(lo);
    arf_clear(hi);
    arf_clear(middle);
    arf_clear(width);
}

/* --- isolating all real zeros ----------------------------------------------------------------- */

static int
compare_by_midpoint(const void *a, const void *b)
{
    return arf_cmp(arb_midref((arb_srcptr)a), arb_midref((arb_srcptr)b));
}

slong
qdot_real_zeros(const fmpz_poly_t p, slong bits, arb_ptr *zeros)
{
    slong degree = fmpz_poly_degree(p);
    isolation s = {0};
    bool good = true, apart = false;
    fmpz_poly_t q;

    *zeros = NULL;
    if (degree <= 0)
        return 0;
    if (degree > MOST_DEGREE)
        return -1;
    *zeros = _arb_vec_init(degree);
    s.zero = _arb_vec_init(degree);
    fmpz_poly_init(q);
    fmpz_poly_set(q, p);
    if (fmpz_is_zero(q->coeffs)) {
        fmpz_poly_shift_right(q, q, 1);
        s.found = 1; /* x = 0 is a zero */
    }
    for (int i = 0; i < 2 && good; i++) {
        s.minus = i == 1;
        if (s.minus)
            for (slong k = 1; k <= fmpz_poly_degree(q); k += 2)
                fmpz_neg(q->coeffs + k, q->coeffs + k);
        good = isolate_positive(&s, q);
    }
    qsort(s.zero, (size_t)s.found, sizeof *s.zero, compare_by_midpoint);
    for (; good && !apart && bits <= 1536; bits *= 4) {
        apart = true;
        for (slong i = 0; i < s.found; i++)
            bisect(*zeros + i, s.zero + i, p, bits);
        for (slong i = 0; i + 1 < s.found; i++)
            apart &= arb_lt(*zeros + i, *zeros + i + 1) != 0;
    }
    fmpz_poly_clear(q);
    _arb_vec_clear(s.zero, degree);
    qdot_free(s.stack.at);
    return good && apart ? s.found : -1;
}

void
qdot_between_zeros(fmpq_t x, arb_srcptr a, arb_srcptr b)
{
    arf_t lo, hi, t;
    fmpz_t n;

    arf_init(lo);
    arf_init(hi);
    arf_init(t);
    fmpz_init(n);
    if (a != NULL)
        arb_get_ubound_arf(lo, a, ARF_PREC_EXACT);
    if (b != NULL)
        arb_get_lbound_arf(hi, b, ARF_PREC_EXACT);
    for (slong k = 0;; k++) {
        if (a != NULL) {
            arf_mul_2exp_si(t, lo, k);
            arf_floor(t, t);
            arf_get_fmpz(n, t, ARF_RND_DOWN);
            fmpz_add_ui(n, n, 1);
        } else if (b != NULL) {
            arf_mul_2exp_si(t, hi, k);
            arf_ceil(t, t);
            arf_get_fmpz(n, t, ARF_RND_DOWN);
            fmpz_sub_ui(n, n, 1);
        } else {
            fmpz_zero(n);
        }
        arf_set_fmpz(t, n);
        arf_mul_2exp_si(t, t, -k);
        if (a == NULL || b == NULL || arf_cmp(t, hi) < 0)
            break;
    }
    arf_get_fmpq(x, t);
    arf_clear(lo);
    arf_clear(hi);
    arf_clear(t);
    fmpz_clear(n);
}

void
qdot_polynomial_over(fmpz_poly_t r, const fmpz_mpoly_struct *p, slong k,
                     const slong *symbol, const fmpq *x, const fmpz_mpoly_ctx_t ctx)
{
    ulong *exp = qdot_malloc(((size_t)fmpz_mpoly_ctx_nvars(ctx) + 1) * sizeof *exp);
    fmpq_poly_t sum;
    fmpq_t a, b;

    fmpz_poly_zero(r);
    if (exp == NULL)
        return;
    fmpq_poly_init(sum);
    fmpq_init(a);
    fmpq_init(b);
    for (slong i = 0; i < fmpz_mpoly_length(p, ctx); i++) {
        slong d;

        fmpz_mpoly_get_term_exp_ui(exp, p, i, ctx);
        fmpq_set_fmpz(a, p->coeffs + i);
        for (slong j = 0; j < k; j++) {
            fmpq_pow_si(b, x + j, (slong)exp[symbol[j]]);
            fmpq_mul(a, a, b);
        }
        d = (slong)exp[symbol[k]];
        fmpq_poly_get_coeff_fmpq(b, sum, d);
        fmpq_add(a, a, b);
        fmpq_poly_set_coeff_fmpq(sum, d, a);
    }
    fmpq_poly_get_numerator(r, sum);
    fmpz_poly_primitive_part(r, r);
    fmpq_clear(a);
    fmpq_clear(b);
    fmpq_poly_clear(sum);
    qdot_free(exp);
}
