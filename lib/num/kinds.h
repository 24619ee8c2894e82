/* kinds.h -- the kinds of processors that kernels are compiled for: 0 any, 1 with AVX2 and
 * FMA, 2 with AVX-512 too. For files of num/ that are compiled for each.
 */
#ifndef QDOT_NUM_KINDS_H
#define QDOT_NUM_KINDS_H

#include <stdbool.h>
#include <stddef.h>

#if defined __x86_64__ && defined __GNUC__
#define QDOT_X86_KINDS
#endif

/* Functions between QDOT_KIND_AVX2, or QDOT_KIND_AVX512, and QDOT_KIND_END are compiled for that
 * kind; no header may be included there. QDOT_UNROLL(n) before a loop unrolls it n times, or
 * completely if it has fewer turns; 1: not at all. INLINE functions are inlined wherever they are called, unless nothing is
 * optimized. Under AddressSanitizer no loop is unrolled and nothing inlined: with the tests of each access in every turn and
 * every copy the compiler takes half a minute for a file. */
#define QDOT_PRAGMA(x) _Pragma(#x)
#ifdef __clang__
#define QDOT_KIND_FOR(target_)                                                           \
    QDOT_PRAGMA(clang attribute push(__attribute__((target(target_))), apply_to = function))
#define QDOT_KIND_END QDOT_PRAGMA(clang attribute pop)
#if __has_feature(address_sanitizer)
#define QDOT_UNROLL(n) QDOT_PRAGMA(clang loop unroll(disable))
#define QDOT_NOT_INLINED
#else
#define QDOT_UNROLL(n) QDOT_PRAGMA(clang loop unroll_count(n))
#endif
#else
#define QDOT_KIND_FOR(target_) QDOT_PRAGMA(GCC push_options) QDOT_PRAGMA(GCC target(target_))
#define QDOT_KIND_END QDOT_PRAGMA(GCC pop_options)
#define QDOT_UNROLL(n) QDOT_PRAGMA(GCC unroll n)
#endif
#if defined __OPTIMIZE__ && !defined QDOT_NOT_INLINED
#define INLINE static inline __attribute__((always_inline, unused))
#else
#define INLINE static __attribute__((unused))
#endif
#define QDOT_KIND_AVX2 QDOT_KIND_FOR("avx2,fma")
#define QDOT_KIND_AVX512 QDOT_KIND_FOR("avx512f,avx2,fma")

/* Limit the kind that is used, for measurements and tests; call it before anything else. The
 * limit; 2 if it was never set. */
void qdot_kind_limit(size_t kind);
size_t qdot_kind_most(void);

/* Whether this processor can run code for that kind of processor, and the limit allows it. */
bool qdot_kind_is_here(size_t kind);

/* a b + c for portable kernels, for numbers and for vectors: fused if the target always has an
 * instruction for it (ARM64), else with two roundings. */
#ifdef __FP_FAST_FMA
#define QDOT_MA(a, b, c) __builtin_fma(a, b, c)
#define QDOT_VECTOR_MA(type, a, b, c)                                                    \
    ({                                                                                   \
        const type a_ = (a), b_ = (b);                                                   \
        type c_ = (c);                                                                   \
        for (size_t i_ = 0; i_ < sizeof c_ / sizeof c_[0]; i_++)                         \
            c_[i_] = __builtin_fma(a_[i_], b_[i_], c_[i_]);                              \
        c_;                                                                              \
    })
#else
#define QDOT_MA(a, b, c) ((a) * (b) + (c))
#define QDOT_VECTOR_MA(type, a, b, c) ((a) * (b) + (c))
#endif

/* Expands X for each number of terms that has an unrolled kernel. */
#define ROWS(X)                                                                          \
    X(0)                                                                                 \
    X(1) X(2) X(3) X(4) X(5) X(6) X(7) X(8) X(9) X(10) X(11) X(12) X(13) X(14) X(15)     \
        X(16) X(17) X(18) X(19) X(20) X(21) X(22) X(23) X(24) X(25) X(26) X(27) X(28)    \
            X(29) X(30) X(31) X(32) X(33) X(34) X(35) X(36) X(37) X(38) X(39) X(40)      \
                X(41) X(42) X(43) X(44) X(45) X(46) X(47) X(48) X(49)

#endif
