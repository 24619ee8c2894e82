/* signals.h -- what Ctrl-C means just now. */
#ifndef QDOT_SIGNALS_H
#define QDOT_SIGNALS_H

#include <stdbool.h>

/* Take SIGINT over. While a computation goes on the first Ctrl-C asks it to stop
 * (base/interrupt.h), a second one ends the program, unless it is patient. */
void qdot_signals_install(void);

/* A computation begins: an earlier Ctrl-C is forgotten. */
void qdot_signals_computing(void);

/* Whether a second Ctrl-C only says how to end the program, which loses the session. */
void qdot_signals_patient(bool on);

/* The prompt waits: Ctrl-C is only noted. */
void qdot_signals_waiting(void);

/* Whether Ctrl-C came since the last question; forgets it. */
bool qdot_signals_take(void);

#endif
