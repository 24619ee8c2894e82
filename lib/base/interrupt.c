/* interrupt.c -- the flag that Ctrl-C sets, and the function that tests it. */
#include "base/interrupt.h"

#include <stdatomic.h>

volatile sig_atomic_t qdot_interrupt_flag = 0;

/* interrupt checks left until the simulated Ctrl-C; atomic, because other threads make checks, too */
static atomic_long checks_left = -1;

void
qdot_interrupt_set(void)
{
    qdot_interrupt_flag = 1;
}

void
qdot_interrupt_clear(void)
{
    qdot_interrupt_flag = 0;
}

void
qdot_interrupt_set_at(long n)
{
    atomic_store(&checks_left, n);
}

qdot_status
qdot_interrupt_check(void)
{
    if (atomic_load_explicit(&checks_left, memory_order_relaxed) >= 0
        && atomic_fetch_sub(&checks_left, 1) == 0)
        qdot_interrupt_set();
    return qdot_interrupt_flag ? qdot_fail(QDOT_EINTR, "interrupted") : QDOT_OK;
}
