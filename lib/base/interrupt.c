/* interrupt.c -- the flag. */
#include "base/interrupt.h"

volatile sig_atomic_t qdot_interrupt_flag = 0;

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

qdot_status
qdot_interrupt_check(void)
{
    return qdot_interrupt_flag ? qdot_fail(QDOT_EINTR, "interrupted") : QDOT_OK;
}
