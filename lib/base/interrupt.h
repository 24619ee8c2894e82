/* interrupt.h -- Ctrl-C sets a flag; long computations test it and return QDOT_EINTR. */
#ifndef QDOT_BASE_INTERRUPT_H
#define QDOT_BASE_INTERRUPT_H

#include <signal.h>

#include "base/status.h"

extern volatile sig_atomic_t qdot_interrupt_flag;

/* Set or clear the flag; safe in a signal handler. */
void qdot_interrupt_set(void);
void qdot_interrupt_clear(void);

/* Return QDOT_EINTR, recorded as a failure, if the Ctrl-C flag is set. */
qdot_status qdot_interrupt_check(void);

/* For tests: simulate Ctrl-C at the n-th check from now (n = 0: the next); n < 0: never. */
void qdot_interrupt_set_at(long n);

#endif
