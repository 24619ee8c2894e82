/* written.h -- decides when machine code is generated for the Taylor expansions of a run.
 *
 * Generating the code takes as long as is saved by worth/p expansions of order p (ode/system.h), so
 * it pays if more steps than that will follow. Their number is estimated from the steps so far. If
 * the length of the first step alone promises two thirds of the steps that are needed, the code is
 * generated before that step is taken, and its expansion is repeated by the code. If an earlier run
 * left code that fits, the first step is expanded by it, and the length of that step decides by the
 * same rule whether the code stays in use. So the last bits of a run do not depend on whether
 * another run came before it, but where its caller counts the steps of those (ode/run.h, past):
 * what these would have saved is no cost any more.
 *
 * Tests  tests/ode/test_written.c
 */
#ifndef QDOT_ODE_WRITTEN_H
#define QDOT_ODE_WRITTEN_H

#include "ode/system.h"

typedef struct {
    const qdot_ode_code *code; /* the system's generator of machine code; borrowed */
    double worth; /* cost of generating code, with the meaning of `worth` in qdot_ode_cost */
    int p;
    int most;      /* highest order of this run and its companion runs, which share the code */
    bool done;     /* whether it has been decided if code is generated */
    bool on_trial; /* code of an earlier run is used for now: the first step shows whether it fits */
    bool first;    /* whether the decision after the first step is still to be made */
} qdot_ode_written;

/* Begin a run whose expansions have order p; `most`: as in qdot_ode_written; past: steps of earlier
 * such runs. */
qdot_ode_written qdot_ode_written_begin(const qdot_ode_series *series, int p, int most, double past);

/* Generate the machine code now, whatever it costs. */
QDOT_MUST_CHECK qdot_status qdot_ode_written_now(qdot_ode_written *written);

/* Decide by the first step, which will be 1/(1 + left) of the span. *again: expand it once more,
 * from the unit of time that the run began with. */
QDOT_MUST_CHECK qdot_status qdot_ode_written_first(qdot_ode_written *written, double left,
                                                   bool *again);

/* Decide after `steps` steps, with about `left` more to follow; call before the next expansion begins. */
QDOT_MUST_CHECK qdot_status qdot_ode_written_next(qdot_ode_written *written, double steps,
                                                  double left);

#endif
