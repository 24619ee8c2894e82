/* batch.c -- the kernels for each kind of processor, and the choice. */
#include "num/batch.h"

#include <math.h>
#include <string.h>

#define ROWS(X)                                                                          \
    X(0)                                                                                 \
    X(1) X(2) X(3) X(4) X(5) X(6) X(7) X(8) X(9) X(10) X(11) X(12) X(13) X(14) X(15)     \
        X(16) X(17) X(18) X(19) X(20) X(21) X(22) X(23) X(24) X(25) X(26) X(27) X(28)    \
            X(29) X(30) X(31) X(32) X(33) X(34) X(35) X(36) X(37) X(38) X(39) X(40)      \
                X(41) X(42) X(43) X(44) X(45) X(46) X(47) X(48) X(49)

#define BATCH_BODY "num/batch.def"
#include "num/batch-kinds.def"

const qdot_batch_kernels *
qdot_batch_kernels_at(size_t i)
{
    if (i == 0)
        return &portable_kernels;
#ifdef BATCH_X86
    if (i == 1 && __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
        return &avx2_kernels;
    if (i == 2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("fma"))
        return &avx512_kernels;
#endif
    return NULL;
}

static _Atomic size_t highest = 2;

void
qdot_batch_limit(size_t kind)
{
    highest = kind < 2 ? kind : 2;
}

size_t
qdot_batch_kind(void)
{
    size_t best = highest;

    while (!qdot_batch_kernels_at(best))
        best--;
    return best;
}

const qdot_batch_kernels *
qdot_batch_kernels_get(void)
{
    return qdot_batch_kernels_at(qdot_batch_kind());
}
