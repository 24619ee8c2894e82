/* integrated.h -- a qdot_run from inside. */
#ifndef QDOT_SIM_INTEGRATED_H
#define QDOT_SIM_INTEGRATED_H

#include "ode/trajectory.h"
#include "sim/bind.h"
#include "sim/bonds.h"
#include "sim/drift.h"
#include "sim/plan.h"

struct qdot_run {
    qdot_plan *plan;
    qdot_bind *bind;      /* for the run, then for states between its points */
    qdot_trajectory tr;
    qdot_drifts drifts;
    qdot_bonds bonds;
    double *start;        /* [2n] y at t0 */
    double *start_low;    /* [2n] what the exact start is beyond it */
    double t0, t1;        /* as asked for */
    double t1_low;        /* what the exact limit is beyond it */
    int t0_side, t1_side; /* where the exact limits lie beside them */
    char *reason;
    qdot_text notice;     /* of the start */
    qdot_run_report report;

    /* The run whose distance from this one is the error between points: made when
     * errors are first asked for. */
    bool has_companion;
    qdot_bind *shaken, *twin; /* systems of the companions; twin NULL: only one */
    qdot_trajectory companion;

    struct qdot_precise_pair *precise; /* of `digits`: the run is this; tr holds its
                                          points as doubles */
    qdot_expr *exact;                  /* [2n] its end state */
};

#endif
