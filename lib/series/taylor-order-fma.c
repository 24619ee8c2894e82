/* taylor-order-fma.c -- the recurrences of one order, for processors with FMA. */
#include "series/taylor-order.h"

#ifdef QDOT_X86_KINDS
QDOT_KIND_AVX2
#define NAME(x) fma_##x
#define MA(a, b, c) __builtin_fma(a, b, c)
#include "series/taylor-order.def"
QDOT_KIND_END

qdot_taylor_function *const qdot_taylor_order_fma[QDOT_SERIES_MOST + 1][QDOT_T_COUNT] = {
    FUNCTIONS};
#endif
