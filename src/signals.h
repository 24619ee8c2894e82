/* signals.h -- what Ctrl-C does: interrupts a computation, clears the line at the prompt, or ends
 * the program. */
#ifndef QDOT_SIGNALS_H
#define QDOT_SIGNALS_H

#include <stdbool.h>

/* Take SIGINT over. While a computation goes on the first Ctrl-C asks it to stop
 * (base/interrupt.h), a second one ends the program, unless it is patient. */
void qdot_signals_install(void);

/* Call when a computation begins: an earlier Ctrl-C is forgotten. */
void qdot_signals_computing(void);

/* Choose whether a second Ctrl-C only tells how to end the program, as that would lose the session. */
void qdot_signals_patient(bool on);

/* Call when the prompt waits for input: then Ctrl-C is only recorded. */
void qdot_signals_waiting(void);

/* Whether Ctrl-C was pressed since the last call; the record is cleared. */
bool qdot_signals_take(void);

#endif
