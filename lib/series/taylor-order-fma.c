/* taylor-order-fma.c -- the recurrences of one order, for processors with FMA. */
#include "series/taylor-order.h"

#ifdef QDOT_X86_KINDS
QDOT_KIND_AVX2
#define NAME(x) fma_##x
#define MA(a, b, c) __builtin_fma(a, b, c)
#define TABLE qdot_taylor_function *const qdot_taylor_order_fma
#include "series/taylor-order.def"
QDOT_KIND_END
#endif
