/* run-state.h -- the fields of a qdot_run, the results of one integration of a scene's motion. */
#ifndef QDOT_SIM_RUN_STATE_H
#define QDOT_SIM_RUN_STATE_H

#include "ode/companion.h"
#include "sim/course/course.h"
#include "sim/course/drift.h"
#include "sim/course/multipliers.h"

struct qdot_run {
    qdot_stage stage;
    qdot_plan *plan;      /* plan of the first mode; owned by `stage` */
    qdot_course course;   /* the stored run, and the equations from which its states are read */
    qdot_drifts drifts;
    qdot_multipliers multipliers;
    double *start;        /* [2n] start state y at t0 */
    double *start_low;    /* [2n] exact start state minus y */
    double *units; /* [2n] units in which the starts of the companion runs are shifted (sim/model/still.h) */
    double *apart; /* [2 x 2n] two shifted starts given in the request; NULL: the start is exact */
    double *difference;   /* [2n] estimated errors of the end state; NaN: unknown */
    size_t factored;      /* number of matrices factored during the integration */
    double t0, t1;        /* requested start and end time */
    double t0_low, t1_low; /* exact requested times minus t0, t1 */
    /* For a run far from t = 0 (sim/course/run-time.h): the times here are t - origin; otherwise
     * origin is 0. */
    double origin;
    double *times;            /* [points] times t at the stored points */
    qdot_run_report *told;    /* the report with the user's times t instead of s = t - origin */
    bool turns;           /* as requested, the method may change to Taylor series and back */
    bool leading;         /* first Taylor coefficients are computed in double-double precision (ode/leading.h) */
    int t0_side, t1_side; /* signs of (exact requested time - t0), (... - t1) */
    char *reason;
    qdot_text notice;     /* notices of the run, a line each; the report takes them over */
    qdot_text part_names;               /* names for report.parts, each ended by NUL */
    qdot_vec(qdot_run_part) parts;
    qdot_run_report report;
    qdot_vec(qdot_run_occurrence) occurrences;
    qdot_vec(qdot_run_faded) faded;
    bool occurrence_errors; /* the errors of `occurrences` and `faded` have been estimated */
    bool by_clock, no_drifts; /* t is a coordinate of the scene; no drifts are measured (as requested) */
    bool hidden;            /* the run may have missed something: its error is unknown */
    bool singular;          /* failed at a singularity: no step was small enough */
    char *doubt;            /* why the error is unknown; NULL: it is known */

    qdot_ode_meter meter;   /* counts the run's work, to compare it with the work of its companion runs */
    double of_point;        /* work of reading both companion runs at one time */
    qdot_companion_way way; /* method by which a companion run has succeeded before */

    /* The run whose distance from this one is the error along the way: made together with it if
     * the run has pieces, else when errors are first needed. */
    bool has_companion;
    qdot_course companion;
    bool has_twin; /* there is a second companion run, used where the first is close to the run by chance */
    qdot_course twin;

    struct qdot_run_chart *chart; /* data of a run in other coordinates (sim/run/chart-run.h); NULL: none */
    bool limited;     /* compare the companion runs with the run only between the two times `within` */
    double within[2]; /* start and end of the comparison; outside of them angles of the chart jump */
    struct qdot_precise_pair *precise; /* with `digits`: the run itself; course.tr holds its
                                          points as doubles */
    qdot_expr *exact;                  /* [2n] exact end state of a run with `digits` */
};

/* The text run->notice, with a line break if another line is to follow. */
qdot_text *qdot_run_next_notice(struct qdot_run *run);

/* Set why the run has failed; the text is copied. Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_run_say_why(struct qdot_run *run, const char *reason);

/* Set why the error is unknown; the text is copied. Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_run_say_doubt(struct qdot_run *run, const char *doubt);

/* Set the reason why the run ended, if an event, a bound or a switch ended its course early. */
QDOT_MUST_CHECK qdot_status qdot_run_say_course(struct qdot_run *run);

#endif
