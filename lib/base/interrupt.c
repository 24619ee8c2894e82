/* interrupt.c -- the flags that Ctrl-C and the callers of the library set, and the functions that test them. */
#include "base/interrupt.h"

#include <stddef.h>

enum { IDLE, BUSY, ASKED }; /* states of a system's flag: no call under way; a call; a call that shall stop */

volatile sig_atomic_t qdot_interrupt_flag = 0;
_Thread_local qdot_interrupt *qdot_interrupt_own;

/* interrupt checks left until the simulated Ctrl-C; atomic, because other threads make checks, too */
static atomic_int checks_left = -1;

void
qdot_interrupt_set(void)
{
    qdot_interrupt_flag = 1;
}

/* --- the flag of a system --------------------------------------------------------------- */

void
qdot_interrupt_begin(qdot_interrupt *interrupt)
{
    atomic_store(&interrupt->state, BUSY);
}

void
qdot_interrupt_end(qdot_interrupt *interrupt)
{
    atomic_store(&interrupt->state, IDLE);
}

/* Change the state only if it is `from`. */
static void
change_state(qdot_interrupt *interrupt, int from, int to)
{
    (void)atomic_compare_exchange_strong(&interrupt->state, &from, to);
}

void
qdot_interrupt_ask(qdot_interrupt *interrupt)
{
    change_state(interrupt, BUSY, ASKED);
}

/* --- testing and clearing -------------------------------------------------------------- */

void
qdot_interrupt_clear(void)
{
    qdot_interrupt_flag = 0;
    if (qdot_interrupt_own != NULL)
        change_state(qdot_interrupt_own, ASKED, BUSY);
}

void
qdot_interrupt_set_at(int n)
{
    atomic_store(&checks_left, n);
}

bool
qdot_interrupt_is_set(void)
{
    const qdot_interrupt *own = qdot_interrupt_own;

    return qdot_interrupt_flag != 0 ||
           (own != NULL && atomic_load_explicit(&own->state, memory_order_relaxed) == ASKED);
}

int
qdot_interrupt_checks_left(void)
{
    return atomic_load(&checks_left);
}

qdot_status
qdot_interrupt_check(void)
{
    if (atomic_load_explicit(&checks_left, memory_order_relaxed) >= 0
        && atomic_fetch_sub(&checks_left, 1) == 0)
        qdot_interrupt_set();
    return qdot_interrupt_is_set() ? qdot_fail(QDOT_EINTR, "interrupted") : QDOT_OK;
}
