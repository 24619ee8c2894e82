/* series.c -- the kernels of series.def for each kind of processor, and the choice. */
#include "num/series.h"

#include <math.h>
#include <stdint.h>

#define ROWS(X)                                                                          \
    X(0)                                                                                 \
    X(1) X(2) X(3) X(4) X(5) X(6) X(7) X(8) X(9) X(10) X(11) X(12) X(13) X(14) X(15)     \
        X(16) X(17) X(18) X(19) X(20) X(21) X(22) X(23) X(24) X(25) X(26) X(27) X(28)    \
            X(29) X(30) X(31) X(32) X(33) X(34) X(35) X(36) X(37) X(38) X(39) X(40)      \
                X(41) X(42) X(43) X(44) X(45) X(46) X(47) X(48) X(49)

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

#if defined __x86_64__ && defined __GNUC__ && !defined __clang__
#define X86_KINDS

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
#ifdef X86_KINDS
    if (i == 1 && __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
        return &avx2_kernels;
    if (i == 2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("fma"))
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
