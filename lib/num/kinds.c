/* kinds.c -- the limit of the kinds that are used. */
#include "num/kinds.h"

static _Atomic size_t most = 2;

size_t
qdot_kind_most(void)
{
    return most;
}

void
qdot_kind_limit(size_t kind)
{
    most = kind < 2 ? kind : 2;
}
