/* kinds.c -- the limit, for tests, on which kinds of processor instructions are used. */
#include "num/kinds.h"

/* The C library has asked the processor at the start of the program, if it tells: to ask again, as
 * the compiler's function does, costs a virtual machine 60 us. */
#ifdef QDOT_X86_KINDS
#if __has_include(<sys/platform/x86.h>)
#include <sys/platform/x86.h>
#endif
#ifdef CPU_FEATURE_ACTIVE
#define HAS(feature, name) CPU_FEATURE_ACTIVE(feature)
#else
#define HAS(feature, name) __builtin_cpu_supports(name)
#endif
#endif

static _Atomic size_t most = 2;

size_t
qdot_kind_most(void)
{
    return most;
}

bool
qdot_kind_is_here(size_t kind)
{
    if (kind > qdot_kind_most())
        return false;
    switch (kind) {
    case 0: return true;
#ifdef QDOT_X86_KINDS
    case 1: return HAS(AVX2, "avx2") && HAS(FMA, "fma");
    case 2: return HAS(AVX512F, "avx512f") && HAS(FMA, "fma");
#endif
    default: return false;
    }
}

void
qdot_kind_limit(size_t kind)
{
    most = kind < 2 ? kind : 2;
}
