/* written.h -- when the expansions of a run become machine code.
 *
 * To write it takes as long as worth/p expansions save by it (ode/system.h). How many steps
 * follow is guessed by those there are, of which the length of the first is enough where
 * twice as many follow: it is then written before the first is taken, and what was expanded
 * by then is so again. Code that lies there from before is tried at once, and the first
 * step's length says in the same way whether it stays. So a run has the same last bits
 * whether or not another one came before it.
 *
 * Tests  tests/ode/test_written.c
 */
#ifndef QDOT_ODE_WRITTEN_H
#define QDOT_ODE_WRITTEN_H

#include "ode/system.h"

typedef struct {
    const qdot_ode_series *series; /* borrowed */
    int p;
    bool done;     /* nothing is to be asked any more */
    bool on_trial; /* code from before is at work */
    bool first;    /* the first step has not been judged */
} qdot_ode_written;

/* Of a run by expansions to order p. */
qdot_ode_written qdot_ode_written_begin(const qdot_ode_series *series, int p);

/* The first step is going to be a part of 1/(1 + left) of what is to be gone. *again: it is to be
 * expanded once more, from the unit that the run began with. */
QDOT_MUST_CHECK qdot_status qdot_ode_written_first(qdot_ode_written *written, double left,
                                                   bool *again);

/* So many steps are there, and about so many will follow; before a `begin`. */
QDOT_MUST_CHECK qdot_status qdot_ode_written_next(qdot_ode_written *written, double steps,
                                                  double left);

#endif
