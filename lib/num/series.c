/* series.c -- the kernels of series.def for each kind of processor, and the choice. */
#include "num/series.h"

#include <math.h>
#include <stdbool.h>
#include <stdint.h>

#include "num/kinds.h"
#include "num/sum.h"

void
qdot_series_weights_set(qdot_series_weights *w, int p, double term)
{
    w->p = p;
    for (int k = 0; k < QDOT_SERIES_MOST + 8; k++) {
        w->inverse[k] = k > 0 ? 1.0 / k : 1;
        w->upper[k] = k > p / 2 && k <= p ? 0 : INFINITY;
        w->lower[k] = k >= 2 && k <= p / 2 ? term : INFINITY;
    }
}

#define NAME(x) portable_##x
#define LABEL "portable"
#define LANES 2
#define MA(a, b, c) ((a) * (b) + (c))
#define VECTOR_MA(a, b, c) ((a) * (b) + (c))
#include "num/series.def"
#undef NAME
#undef LABEL
#undef LANES
#undef MA
#undef VECTOR_MA

#ifdef QDOT_X86_KINDS
#define MA(a, b, c) __builtin_fma(a, b, c)

#pragma GCC push_options
#pragma GCC target("avx2,fma")
#include <immintrin.h>
#define NAME(x) avx2_##x
#define LABEL "avx2"
#define LANES 4
#define VECTOR_MA(a, b, c)                                                               \
    ((avx2_vector)_mm256_fmadd_pd((__m256d)(a), (__m256d)(b), (__m256d)(c)))
#include "num/series.def"
#undef NAME
#undef LABEL
#undef LANES
#undef VECTOR_MA
#pragma GCC pop_options

#pragma GCC push_options
#pragma GCC target("avx512f,avx2,fma")
#define NAME(x) avx512_##x
#define LABEL "avx512"
#define LANES 8
#define VECTOR_MA(a, b, c)                                                               \
    ((avx512_vector)_mm512_fmadd_pd((__m512d)(a), (__m512d)(b), (__m512d)(c)))
#include "num/series.def"
#undef NAME
#undef LABEL
#undef LANES
#undef VECTOR_MA
#pragma GCC pop_options
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
