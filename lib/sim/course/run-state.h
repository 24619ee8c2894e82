/* run-state.h -- the fields of a qdot_run. */
#ifndef QDOT_SIM_RUN_STATE_H
#define QDOT_SIM_RUN_STATE_H

#include "ode/companion.h"
#include "sim/course/course.h"
#include "sim/course/drift.h"
#include "sim/course/multipliers.h"

struct qdot_run {
    qdot_stage stage;
    qdot_plan *plan;      /* of the first mode; owned by the stage */
    qdot_course course;   /* the run, and what its states are read with */
    qdot_drifts drifts;
    qdot_multipliers multipliers;
    double *start;        /* [2n] y at t0 */
    double *start_low;    /* [2n] the exact start less y */
    double *units;        /* [2n] by which companions are moved (sim/model/still.h) */
    double *apart;        /* [2 x 2n] that of the request, with states; NULL: the start is exact */
    double *difference;   /* [2n] estimates of the errors of the end state; NaN: unknown */
    size_t factored;      /* number of matrices factored by the integration */
    double t0, t1;        /* as requested */
    double t0_low, t1_low; /* the exact limits less t0, t1 */
    /* For a run far from t = 0 (sim/course/run-time.h): the times here are t - origin; otherwise
     * origin is 0. */
    double origin;
    double *times;            /* [points] t at the points of the course */
    qdot_run_report *told;    /* the report with times in t, not in s = t - origin */
    bool turns;           /* of the request */
    bool leading;         /* first orders are sums of two doubles (ode/leading.h) */
    int t0_side, t1_side; /* sign of the exact limit less t0, t1 */
    char *reason;
    qdot_text notice;     /* notices of the run, a line each; the report takes them over */
    qdot_text part_names;               /* for report.parts, each ended by a 0 */
    qdot_vec(qdot_run_part) parts;
    qdot_run_report report;
    qdot_vec(qdot_run_occurrence) occurrences;
    qdot_vec(qdot_run_faded) faded;
    bool occurrence_errors; /* `occurrences` and `faded` have their errors */
    bool by_clock, no_drifts; /* of the request */
    bool hidden;            /* the run has passed over something: no error is known */
    bool singular;          /* no step was small enough at its end, for a singularity there */
    char *doubt;            /* why the error is unknown; NULL */

    qdot_ode_meter meter;   /* of the run's work, which that of companions is compared with */
    double of_point;        /* the work of reading both companions at one time */
    qdot_companion_way way; /* by which a companion has arrived before */

    /* The run whose distance from this one is the error along the way: made together with it if
     * the run has pieces, else when errors are first needed. */
    bool has_companion;
    qdot_course companion;
    bool has_twin; /* a second companion, for times at which the first is near by chance */
    qdot_course twin;

    struct qdot_run_chart *chart; /* of a run made in other coordinates (sim/run/chart-run.h) */
    bool limited;     /* companions are compared between the times `within` alone: angles of the */
    double within[2]; /* chart jump beyond them */
    struct qdot_precise_pair *precise; /* with `digits`: the run itself; course.tr holds its
                                          points as doubles */
    qdot_expr *exact;                  /* [2n] the exact end state of a run with digits */
};

/* The text run->notice, with a line break if another line is to follow. */
qdot_text *qdot_run_next_notice(struct qdot_run *run);

/* Set why the run has failed; the text is copied. Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_run_say_why(struct qdot_run *run, const char *reason);

/* Set why the error is unknown; the text is copied. Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_run_say_doubt(struct qdot_run *run, const char *doubt);

/* Set the reason of the run from that of its course, if an event, a bound or a switch ended the run. */
QDOT_MUST_CHECK qdot_status qdot_run_say_course(struct qdot_run *run);

#endif
