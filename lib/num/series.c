/* series.c -- the functions of series.def compiled for each kind of processor, and their selection. */
#include "num/series.h"

#include <math.h>
#include <stdbool.h>
#include <stdint.h>

#include "num/kinds.h"
#include "num/sum.h"

/* Vectors read the larger half of a double without a sign, made from its bits >> 20, as
 * the double `read` + those in units of 2^-52: what its logarithm is, to 0.09, after this. */
static const double read = 0x1p52, unit_of_log = 0x1p-32, bias = 1023;

void
qdot_series_weights_set(qdot_series_weights *w, int p, double term, double fall)
{
    const int half = p / 2;

    w->p = p;
    w->term = term;
    w->fall = fall;
    for (int k = 0; k < QDOT_SERIES_MOST + 8; k++) {
        const bool upper = k > half && k <= p, lower = k >= 2 && k <= half;
        const double from = bias + read * unit_of_log;

        w->inverse[k] = k > 0 ? 1.0 / k : 1;
        w->share[k] = upper || lower ? -unit_of_log / k : 0;
        w->upper[k] = upper ? (from + fall * (p - k)) / k : INFINITY;
        w->lower[k] = lower ? (from + term) / k : INFINITY;
    }
    /* read 0 as 2^-bias, and infinity or NaN as 2^(bias + 1) */
    w->upper_most = (bias - 1) / p;
    w->lower_most = half >= 2 ? (bias - 1 + term) / half : INFINITY;
    w->lower_least = half >= 2 ? (term - bias) / half : -INFINITY;
}

/* The logarithm log2 of the largest coefficient of order k; -inf if all are 0, inf if one is not finite. */
static double
log_largest(size_t n, const double *x, size_t stride, const double *scale, int k)
{
    double most = 0;

    for (size_t i = 0; i < n; i++) {
        const double c = fabs(x[i * stride + (size_t)k]) * scale[i];

        if (!(c < INFINITY))
            return INFINITY;
        most = c > most ? c : most;
    }
    return log2(most);
}

/* How far a Taylor series can be used (its reach), for any coefficients, also 0 and not finite ones. */
static qdot_series_reach
reach_of_any(size_t n, const double *x, size_t stride, const qdot_series_weights *w,
             const double *scale)
{
    qdot_series_reach r = {INFINITY, INFINITY};

    for (int k = 2; k <= w->p; k++) {
        const double log = log_largest(n, x, stride, scale, k);

        if (k > w->p / 2)
            r.upper = fmin(r.upper, (w->fall * (w->p - k) - log) / k);
        else
            r.lower = fmin(r.lower, (w->term - log) / k);
    }
    return r;
}

/* What a product p = a b, rounded, lacks: of halves of 26 bits by sums that are exact, whether or
 * not the machine fuses (Dekker, Numer. Math. 18 (1971) 224). */
typedef double four_doubles __attribute__((vector_size(32), aligned(8)));

INLINE four_doubles
upper_half(four_doubles a)
{
    typedef int64_t bits __attribute__((vector_size(32), aligned(8)));

    return (four_doubles)(((bits)a + (1 << 26)) & ~(int64_t)((1 << 27) - 1));
}

INLINE four_doubles
rest_of_product(four_doubles a, four_doubles b, four_doubles p)
{
    const four_doubles a1 = upper_half(a), a2 = a - a1, b1 = upper_half(b), b2 = b - b1;

    return ((a1 * b1 - p) + a1 * b2 + a2 * b1) + a2 * b2;
}

/* Of integers without a sign VECTOR_LARGER compares the halves by themselves: the lower one is then
 * that of any, 2^-20 of the number. */
#define LANES 2
#define NAME(x) portable_##x
#define LABEL "portable"
#define MA(a, b, c) QDOT_MA(a, b, c)
#define VECTOR_MA(a, b, c) QDOT_VECTOR_MA(portable_vector, a, b, c)
#define VECTOR_LARGER(a, b)                                                              \
    ((portable_integers)PORTABLE_PICK(portable_halves, (portable_halves)(a),             \
                                      (portable_halves)(b), >))
#define VECTOR_LESS(a, b) ((portable_vector)PORTABLE_PICK(portable_integers, a, b, <))
#define FOUR_MORE(a, b) ((portable_four)PORTABLE_PICK(portable_wide, a, b, >))
#define FOUR_REST(a, b, p) rest_of_product(a, b, p)
#define FOUR_SUMS(a, b, c, d)                                                            \
    ((portable_four){(a)[0] + (a)[1], (b)[0] + (b)[1], (c)[0] + (c)[1], (d)[0] + (d)[1]})
/* Take a in those lanes in which the comparison holds, else b. */
#define PORTABLE_PICK(bits, a, b, compared)                                              \
    (((bits)(a) & (bits)((a)compared(b))) | ((bits)(b) & ~(bits)((a)compared(b))))
typedef int32_t portable_halves __attribute__((vector_size(16), aligned(8)));
typedef int64_t portable_wide __attribute__((vector_size(32), aligned(8)));
#include "num/series.def"
#undef NAME
#undef LABEL
#undef LANES
#undef MA
#undef VECTOR_MA
#undef VECTOR_LARGER
#undef VECTOR_LESS
#undef FOUR_MORE
#undef FOUR_REST
#undef FOUR_SUMS

#ifdef QDOT_X86_KINDS
#include <immintrin.h>

#define MA(a, b, c) __builtin_fma(a, b, c)

QDOT_KIND_AVX2
#define NAME(x) avx2_##x
#define LABEL "avx2"
#define LANES 4
#define VECTOR_MA(a, b, c)                                                               \
    ((avx2_vector)_mm256_fmadd_pd((__m256d)(a), (__m256d)(b), (__m256d)(c)))
#define VECTOR_LARGER(a, b)                                                              \
    ((avx2_integers)_mm256_blendv_pd((__m256d)(b), (__m256d)(a), (__m256d)((a) > (b))))
#define VECTOR_LESS(a, b) ((avx2_vector)_mm256_min_pd((__m256d)(a), (__m256d)(b)))
#define FOUR_MORE(a, b) ((NAME(four))_mm256_max_pd((__m256d)(a), (__m256d)(b)))
#define FOUR_REST(a, b, p)                                                               \
    ((NAME(four))_mm256_fmsub_pd((__m256d)(a), (__m256d)(b), (__m256d)(p)))
#define FOUR_SUMS(a, b, c, d)                                                            \
    ((NAME(four))fours_summed((__m256d)(a), (__m256d)(b), (__m256d)(c), (__m256d)(d)))

INLINE __m256d
fours_summed(__m256d a, __m256d b, __m256d c, __m256d d)
{
    const __m256d ab = _mm256_hadd_pd(a, b), cd = _mm256_hadd_pd(c, d);

    return _mm256_add_pd(_mm256_permute2f128_pd(ab, cd, 0x20),
                         _mm256_permute2f128_pd(ab, cd, 0x31));
}

#include "num/series.def"
#undef NAME
#undef LABEL
#undef LANES
#undef VECTOR_MA
#undef VECTOR_LARGER
#undef VECTOR_LESS
#undef FOUR_SUMS
QDOT_KIND_END

QDOT_KIND_AVX512
#define NAME(x) avx512_##x
#define LABEL "avx512"
#define LANES 8
#define VECTOR_MA(a, b, c)                                                               \
    ((avx512_vector)_mm512_fmadd_pd((__m512d)(a), (__m512d)(b), (__m512d)(c)))
#define VECTOR_LARGER(a, b)                                                              \
    ((avx512_integers)_mm512_max_epi64((__m512i)(a), (__m512i)(b)))
#define VECTOR_LESS(a, b) ((avx512_vector)_mm512_min_pd((__m512d)(a), (__m512d)(b)))
#define FOUR_SUMS(a, b, c, d)                                                            \
    ((NAME(four))fours_summed(folded((__m512d)(a)), folded((__m512d)(b)),                \
                              folded((__m512d)(c)), folded((__m512d)(d))))

INLINE __m256d
folded(__m512d a)
{
    return _mm256_add_pd(_mm512_castpd512_pd256(a), _mm512_extractf64x4_pd(a, 1));
}

#include "num/series.def"
#undef NAME
#undef LABEL
#undef LANES
#undef VECTOR_MA
QDOT_KIND_END
#endif

const qdot_series_kernels *
qdot_series_kernels_at(size_t i)
{
    if (i == 0)
        return &portable_kernels;
#ifdef QDOT_X86_KINDS
    if (i == 1 && qdot_kind_is_here(1))
        return &avx2_kernels;
    if (i == 2 && qdot_kind_is_here(2))
        return &avx512_kernels;
#endif
    return NULL;
}

const qdot_series_kernels *
qdot_series_kernels_get(void)
{
    const qdot_series_kernels *best = qdot_series_kernels_at(2);

    if (!best)
        best = qdot_series_kernels_at(1);
    return best ? best : qdot_series_kernels_at(0);
}
