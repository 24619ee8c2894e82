/* digits.h -- makes a complete qdot_run from the runs in MPFR of sim/digits/precise.h.
 *
 * Tests  tests/sim/digits/test_precise.c
 */
#ifndef QDOT_SIM_DIGITS_H
#define QDOT_SIM_DIGITS_H

#include "sim/course/run-state.h"
#include "sim/model/domain.h"

/* Add to the notice which values of the start were solved for: run->start, in doubles, not 0 where
 * the request does not name them; rates of states, which are no choice, are left out. Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_digits_say_start(qdot_run *run, const qdot_scene *scene,
                                                  const qdot_run_request *request);

/* Carry out both runs; then make the trajectory in doubles for figures, the drifts and the
 * rational end state. QDOT_OK whenever there is a run to keep. */
QDOT_MUST_CHECK qdot_status qdot_digits_carry_out(qdot_run *run, qdot_scene *scene,
                                                  const qdot_run_request *request,
                                                  qdot_domains *domains,
                                                  bool *interrupted);

/* Fill the report of a run with `digits` as for a run in doubles. */
void qdot_digits_fill_report(qdot_run *run);

/* Compute the occurrences of events of a run with `digits`, into run->occurrences. Errors:
 * QDOT_ENOMEM, those of the pool. */
QDOT_MUST_CHECK qdot_status qdot_digits_occurrences(struct qdot_run *run);

#endif
