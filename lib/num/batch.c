/* batch.c -- the functions of batch.def compiled for each kind of processor, and their selection. */
#include "num/batch.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "num/kinds.h"

#define BATCH_BODY "num/batch.def"
#include "num/batch-kinds.def"

const qdot_batch_kernels *
qdot_batch_kernels_at(size_t i)
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

size_t
qdot_batch_kind(void)
{
    size_t best = 2;

    while (!qdot_batch_kernels_at(best))
        best--;
    return best;
}

const qdot_batch_kernels *
qdot_batch_kernels_get(void)
{
    return qdot_batch_kernels_at(qdot_batch_kind());
}
