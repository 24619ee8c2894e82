/* real.c -- arrays of MPFR numbers (of any precision), sums of products, linear equations. */
#include "num/real.h"

#include <inttypes.h>
#include <limits.h>
#include <math.h>
#include <string.h>

#include "base/memory.h"

/* --- arrays of numbers -------------------------------------------------------------- */

/* Whole words of 64 bits, so the same precision on all machines: whole limbs, too, which have 64 or 32. */
static mpfr_prec_t
round_to_whole_limbs(mpfr_prec_t bits)
{
    return (bits + 63) / 64 * 64;
}

double
qdot_reals_size(size_t n, mpfr_prec_t bits)
{
    return (double)n * ((double)round_to_whole_limbs(bits) / CHAR_BIT + sizeof(mpfr_t));
}

qdot_status
qdot_reals_init(qdot_reals *v, size_t n, mpfr_prec_t bits)
{
    size_t per;

    *v = (qdot_reals){0};
    if (bits < MPFR_PREC_MIN || bits > 1 << 24)
        return qdot_fail(QDOT_EINVAL, "a precision of %" PRId64 " bits is out of range",
                         (int64_t)bits);
    bits = round_to_whole_limbs(bits);
    per = (size_t)bits / GMP_NUMB_BITS;
    v->at = qdot_calloc(n + 1, sizeof *v->at);
    v->limbs = qdot_calloc(n * per + 1, sizeof *v->limbs);
    if (!v->at || !v->limbs) {
        qdot_reals_clear(v);
        return QDOT_ENOMEM;
    }
    v->n = n;
    v->bits = bits;
    for (size_t i = 0; i < n; i++)
        mpfr_custom_init_set(v->at[i], MPFR_ZERO_KIND, 0, bits, v->limbs + i * per);
    return QDOT_OK;
}

void
qdot_reals_clear(qdot_reals *v)
{
    qdot_free(v->at);
    qdot_free(v->limbs);
    *v = (qdot_reals){0};
}

double
qdot_real_log2(mpfr_srcptr x)
{
    mpfr_exp_t exponent;
    double m;

    if (!mpfr_number_p(x))
        return NAN;
    if (mpfr_zero_p(x))
        return -INFINITY;
    m = mpfr_get_d_2exp(&exponent, x, MPFR_RNDN);
    return log2(fabs(m)) + (double)exponent;
}

/* --- sums of products --------------------------------------------------------------- */

size_t
qdot_real_dot_work(mpfr_prec_t bits)
{
    return 4 * ((size_t)round_to_whole_limbs(bits) / GMP_NUMB_BITS) + 8;
}

/* Find the largest exponent of the products a[i] b[i]; false if a factor is not finite. */
static bool
find_largest_exponent(const mpfr_t *a, const mpfr_t *b, size_t n, mpfr_exp_t *exponent, bool *some)
{
    *some = false;
    for (size_t j = 0; j < n; j++, b--) {
        mpfr_exp_t e;

        if (mpfr_regular_p(a[j]) && mpfr_regular_p(*b)) {
            e = mpfr_get_exp(a[j]) + mpfr_get_exp(*b);
            if (!*some || e > *exponent)
                *exponent = e;
            *some = true;
        } else if (!mpfr_number_p(a[j]) || !mpfr_number_p(*b))
            return false;
    }
    return true;
}

/* Set `sum` to +-acc 2^exponent, where acc [m] is an integer of limbs with its binary point below the highest limb. */
static void
set_sum(mpfr_ptr sum, mp_limb_t *acc, size_t m, mpfr_exp_t exponent)
{
    const size_t limbs = (size_t)mpfr_get_prec(sum) / GMP_NUMB_BITS;
    mp_limb_t *to = mpfr_custom_get_significand(sum);
    int sign = 1;
    unsigned zeros;

    if (acc[m - 1] >> (GMP_NUMB_BITS - 1)) {
        mpn_neg(acc, acc, (mp_size_t)m);
        sign = -1;
    }
    exponent += GMP_NUMB_BITS;
    while (m > 0 && acc[m - 1] == 0) {
        m--;
        exponent -= GMP_NUMB_BITS;
    }
    if (m == 0) {
        mpfr_set_zero(sum, 1);
        return;
    }
    zeros = (unsigned)__builtin_clzll(acc[m - 1]) - (64 - GMP_NUMB_BITS);
    if (zeros > 0)
        mpn_lshift(acc, acc, (mp_size_t)m, zeros);
    if (m >= limbs)
        memcpy(to, acc + m - limbs, limbs * sizeof *to);
    else {
        memset(to, 0, (limbs - m) * sizeof *to);
        memcpy(to + limbs - m, acc, m * sizeof *to);
    }
    mpfr_custom_init_set(sum, sign * MPFR_REGULAR_KIND, exponent - (mpfr_exp_t)zeros,
                         mpfr_get_prec(sum), to);
}

void
qdot_real_dot(mpfr_ptr sum, const mpfr_t *a, const mpfr_t *b, size_t n, mp_limb_t *work)
{
    const size_t limbs = (size_t)mpfr_get_prec(sum) / GMP_NUMB_BITS, m = limbs + 2;
    mp_limb_t *acc = work, *product = work + m;
    mpfr_exp_t top = 0;
    bool some;

    if (!find_largest_exponent(a, b, n, &top, &some)) {
        mpfr_set_nan(sum);
        return;
    }
    if (!some) {
        mpfr_set_zero(sum, 1);
        return;
    }
    memset(acc, 0, m * sizeof *acc);
    for (size_t j = 0; j < n; j++, b--) {
        size_t below, skipped, kept, used;
        const mp_limb_t *x, *y, *high;

        if (!mpfr_regular_p(a[j]) || !mpfr_regular_p(*b))
            continue;
        below = (size_t)(top - mpfr_get_exp(a[j]) - mpfr_get_exp(*b));
        skipped = below / GMP_NUMB_BITS;
        below %= GMP_NUMB_BITS;
        if (skipped > limbs)
            continue;
        /* only `kept` limbs of the product after the binary point matter: multiply only these */
        kept = limbs + 1 - skipped;
        used = kept < limbs ? kept : limbs;
        x = (const mp_limb_t *)mpfr_custom_get_significand(a[j]) + limbs - used;
        y = (const mp_limb_t *)mpfr_custom_get_significand(*b) + limbs - used;
        if (x == y)
            mpn_sqr(product, x, (mp_size_t)used);
        else
            mpn_mul_n(product, x, y, (mp_size_t)used);
        high = product + 2 * used - kept;
        if (below > 0)
            mpn_rshift(product + 2 * used - kept, high, (mp_size_t)kept, (unsigned)below);
        /* the highest limb of acc is before the binary point, below it are the skipped ones */
        used = m - 1 - skipped - kept;
        if (mpfr_signbit(a[j]) == mpfr_signbit(*b))
            mpn_add(acc + used, acc + used, (mp_size_t)(m - used), high,
                    (mp_size_t)kept);
        else
            mpn_sub(acc + used, acc + used, (mp_size_t)(m - used), high,
                    (mp_size_t)kept);
    }
    set_sum(sum, acc, m, top);
}

/* --- systems of linear equations ---------------------------------------------------- */

static double
largest_in_row(size_t n, const mpfr_t *row)
{
    double most = -INFINITY;

    for (size_t j = 0; j < n; j++) {
        double l = qdot_real_log2(row[j]);

        if (isnan(l))
            return l;
        most = fmax(most, l);
    }
    return most;
}

static void
swap_rows(size_t n, mpfr_t *a, mpfr_t *b)
{
    for (size_t j = 0; j < n; j++)
        mpfr_swap(a[j], b[j]);
}

qdot_status
qdot_real_lu(size_t n, mpfr_t *a, size_t *order, double *scale, size_t *failed, mpfr_t *w)
{
    const double least = -(double)(mpfr_get_prec(w[0]) - 16);

    for (size_t i = 0; i < n; i++) {
        scale[i] = largest_in_row(n, a + i * n);
        order[i] = i;
        *failed = i;
        if (!isfinite(scale[i]))
            return qdot_fail(QDOT_ESINGULAR, "a row of the matrix is 0 or undefined");
    }
    for (size_t k = 0; k < n; k++) {
        size_t best = k;
        double size = -INFINITY;

        for (size_t i = k; i < n; i++) {
            double l = qdot_real_log2(a[i * n + k]) - scale[i];

            if (l > size) {
                size = l;
                best = i;
            }
        }
        *failed = k;
        if (!(size > least))
            return qdot_fail(QDOT_ESINGULAR, "the matrix is singular");
        if (best != k) {
            size_t o = order[k];
            double was = scale[k];

            order[k] = order[best];
            order[best] = o;
            scale[k] = scale[best];
            scale[best] = was;
            swap_rows(n, a + k * n, a + best * n);
        }
        for (size_t i = k + 1; i < n; i++) {
            if (mpfr_zero_p(a[i * n + k]))
                continue;
            mpfr_div(w[0], a[i * n + k], a[k * n + k], MPFR_RNDN);
            mpfr_set(a[i * n + k], w[0], MPFR_RNDN);
            for (size_t j = k + 1; j < n; j++) {
                mpfr_mul(w[1], w[0], a[k * n + j], MPFR_RNDN);
                mpfr_sub(a[i * n + j], a[i * n + j], w[1], MPFR_RNDN);
            }
        }
    }
    return QDOT_OK;
}

void
qdot_real_solve(size_t n, const mpfr_t *a, const size_t *order, mpfr_t *b, mpfr_t *y,
                mpfr_t *w)
{
    for (size_t i = 0; i < n; i++) {
        mpfr_set(y[i], b[order[i]], MPFR_RNDN);
        for (size_t j = 0; j < i; j++) {
            mpfr_mul(w[0], a[i * n + j], y[j], MPFR_RNDN);
            mpfr_sub(y[i], y[i], w[0], MPFR_RNDN);
        }
    }
    for (size_t i = n; i-- > 0;) {
        for (size_t j = i + 1; j < n; j++) {
            mpfr_mul(w[0], a[i * n + j], b[j], MPFR_RNDN);
            mpfr_sub(y[i], y[i], w[0], MPFR_RNDN);
        }
        mpfr_div(b[i], y[i], a[i * n + i], MPFR_RNDN);
    }
}
