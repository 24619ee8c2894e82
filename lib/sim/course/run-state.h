/* run-state.h -- a qdot_run from inside. */
#ifndef QDOT_SIM_RUN_STATE_H
#define QDOT_SIM_RUN_STATE_H

#include "sim/course/course.h"
#include "sim/course/drift.h"
#include "sim/course/multipliers.h"

struct qdot_run {
    qdot_stage stage;
    qdot_plan *plan;      /* of the mode of the start; the stage's */
    qdot_course course;   /* the run, and what its states are read with */
    qdot_drifts drifts;
    qdot_multipliers multipliers;
    double *start;        /* [2n] y at t0 */
    double *start_low;    /* [2n] what the exact start is beyond it */
    size_t factored;      /* matrices, by the integration */
    double t0, t1;        /* as asked for */
    double t0_low, t1_low; /* what the exact limits are beyond them */
    bool leading;         /* first orders are sums of two doubles (ode/leading.h) */
    int t0_side, t1_side; /* where the exact limits lie beside them */
    char *reason;
    qdot_text notice;     /* of the start */
    qdot_text part_names;               /* of the report, each ended by a 0 */
    qdot_vec(qdot_run_part) parts;
    qdot_run_report report;
    qdot_vec(qdot_run_occurrence) occurrences;
    bool occurrence_errors; /* they have been found */
    bool hidden;            /* a step went over a force: no error is known */
    char *doubt;            /* why the error is unknown; NULL */

    /* The run whose distance from this one is the error between points: made with it
     * where the run has pieces, else when errors are first asked for. */
    bool has_companion;
    qdot_course companion;
    bool has_twin; /* a second one: where one is near by chance */
    qdot_course twin;

    struct qdot_precise_pair *precise; /* of `digits`: the run is this; course.tr holds
                                          its points as doubles */
    qdot_expr *exact;                  /* [2n] its end state */
};

/* The run has failed, and why; the text is copied. Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_run_say_why(struct qdot_run *run, const char *reason);

/* Why the error is unknown; the text is copied. Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_run_say_doubt(struct qdot_run *run, const char *doubt);

/* The same where an event, a bound or a switch ended the run; else nothing. */
QDOT_MUST_CHECK qdot_status qdot_run_say_course(struct qdot_run *run);

#endif
