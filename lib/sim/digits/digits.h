/* digits.h -- a qdot_run made by sim/digits/precise.h, with all that a run in doubles has.
 *
 * Tests  tests/sim/test_precise.c
 */
#ifndef QDOT_SIM_DIGITS_H
#define QDOT_SIM_DIGITS_H

#include "sim/course/run-state.h"
#include "sim/model/domain.h"

/* Both runs; then the trajectory in doubles that figures are drawn of, the drifts and the
 * rational end state. QDOT_OK whenever there is a run to keep. */
QDOT_MUST_CHECK qdot_status qdot_digits_carry_out(qdot_run *run, qdot_scene *scene,
                                                  const qdot_run_request *request,
                                                  qdot_domains *domains,
                                                  bool *interrupted);

/* What the report of a run in doubles has otherwise. */
void qdot_digits_fill_report(qdot_run *run);

/* run->occurrences of such a run. Errors: QDOT_ENOMEM, those of the pool. */
QDOT_MUST_CHECK qdot_status qdot_digits_occurrences(struct qdot_run *run);

#endif
