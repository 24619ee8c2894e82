/* interrupt.h -- a flag asks a long computation to stop; it tests the flag and returns QDOT_EINTR.
 *
 * There is one flag for the whole process, which Ctrl-C sets, and one for each system of the library. A thread that
 * computes for a system knows its flag and looks at both. Whoever starts a helper thread hands the flag on:
 *
 *     job->interrupt = qdot_interrupt_own;     in the thread that starts it
 *     qdot_interrupt_own = job->interrupt;     first in the helper thread
 *
 * Processes started by fork are ended by the one that started them.
 *
 * Tests  tests/api/test_interrupt.c, tests/normal/field/test_flint.c
 */
#ifndef QDOT_BASE_INTERRUPT_H
#define QDOT_BASE_INTERRUPT_H

#include <signal.h>
#include <stdatomic.h>
#include <stdbool.h>

#include "base/status.h"

/* The flag of a system: whether a call is under way, and whether it shall stop. Zero-initialized: idle. */
typedef struct {
    atomic_int state;
} qdot_interrupt;

/* The flag of the process. */
extern volatile sig_atomic_t qdot_interrupt_flag;
/* The flag of the system for which this thread computes; NULL: only that of the process counts. */
extern _Thread_local qdot_interrupt *qdot_interrupt_own;

/* Set the flag of the process; safe in a signal handler. */
void qdot_interrupt_set(void);

/* _begin and _end enclose a call on a system; between them _ask sets its flag, otherwise it does nothing. _ask may be
 * called by any thread and in a signal handler. */
void qdot_interrupt_begin(qdot_interrupt *interrupt);
void qdot_interrupt_end(qdot_interrupt *interrupt);
void qdot_interrupt_ask(qdot_interrupt *interrupt);

/* Clear the flag of the process and that of this thread's system: the interruption has been handled. */
void qdot_interrupt_clear(void);

/* Whether this thread's computation shall stop. */
bool qdot_interrupt_is_set(void);

/* Return QDOT_EINTR, recorded as a failure, if this thread's computation shall stop. */
qdot_status qdot_interrupt_check(void);

/* Simulate Ctrl-C at the n-th check from now (n = 0: the next); n < 0: never. For tests, and for work with a budget. */
void qdot_interrupt_set_at(int n);
/* How many checks are left of those; negative: none. */
int qdot_interrupt_checks_left(void);

#endif
