/* joint.h -- an expression along several runs as one of the coordinates of all.
 *
 * The first run keeps its symbols q, q', t, q'', lambda. Those of each further run are replaced by
 * symbols of its own, except t: so (a.x - b.x) becomes (x - x_b), one tape whose inputs are those
 * of a, then those of b. One run is the special case without further symbols.
 *
 * Tests  tests/script/sweeps/several-ranges.lag, ranges.lag
 */
#ifndef QDOT_SIM_JOINT_H
#define QDOT_SIM_JOINT_H

#include "sim/course/reader.h"
#include "sim/run/run.h"

typedef struct {
    qdot_expr e;
    const qdot_plan **plans;    /* [n] plans of the runs; borrowed */
    const qdot_course **courses; /* [n] courses of the runs; borrowed */
    qdot_expr *inputs;          /* inputs, over all runs, of the tape that evaluates the expression e */
    qdot_reading of;            /* evaluates the expression along the runs */
} qdot_joint;

/* Combine the runs of an expression. Errors: QDOT_ENOMEM, those of qdot_reader_lower. Clear j in any case. */
QDOT_MUST_CHECK qdot_status qdot_joint_init(qdot_joint *j, const qdot_run_expression *x);
void qdot_joint_clear(qdot_joint *j);

#endif
