/* request.h -- the request of a run: parameter values, start, limits, tolerance, method.
 *
 * Tests  tests/sim/
 */
#ifndef QDOT_SIM_REQUEST_H
#define QDOT_SIM_REQUEST_H

#include "mech/dynamics/quantity.h"

/* How a drift of the state off the constraints is treated (sim/model/constrained.h). */
typedef enum { QDOT_RUN_PROJECT, QDOT_RUN_BAUMGARTE, QDOT_RUN_NONE } qdot_run_treatment;

typedef struct {
    size_t n_values; /* number of parameters with values: symbols[i] has the constant values[i] */
    const qdot_expr *symbols, *values;
    const qdot_expr *q0, *v0; /* [n] start q, q' as exact constants, in the order of coordinates */
    const bool *q_named, *v_named; /* [n] which of them were named: the others may be solved for
                                     from the constraints; NULL: all */
    bool exactly; /* refuse a start that violates a constraint, instead of moving it */
    qdot_expr t0, t1;             /* start and end time, exact constants; t1 < t0: the run goes backward */
    qdot_expr said[2]; /* the time limits as the user wrote them, with symbols that have values; nil: t0, t1 */
    double tol;                   /* local error of each component in each step, relative to
                                     max(s, |value|) */
    const double *scales;         /* [2n] s of q, then of q', in order of the coordinates; 0: found
                                     by the run (sim/run/scales.h); NULL: all are */
    const char *method;           /* "auto" or the name of a method (ode/method.h) */
    bool turns;                   /* a method for stiff scenes may change to series and back
                                     (ode/alternate.c) */
    qdot_run_treatment treatment; /* how a drift of the state off the constraints is treated */
    size_t n_states;              /* set by the run itself, leave it 0: parameters that events
                                     set, as further coordinates (sim/model/parameter-states.h); */
    const qdot_expr *states;      /* [n_states] their symbols; symbols, values, q0 ... include
                                     them */
    int digits;                   /* > 0: so many correct digits at the end (sim/digits/precise.h);
                                     tol is not used */
    bool lanes;                   /* for an ensemble, eight members at a time
                                     (sim/ensemble/ensemble.h) */
    bool by_clock;                /* t is one of the coordinates of the scene (sim/run/collide.h) */
    bool no_drifts;               /* conserved quantities are not searched for, since nobody reads the report */
    double most_work;             /* the run fails beyond so much work of its integration (ode/meter.h); 0: no limit */
    const double *apart;          /* [2 x 2n] how far the run's two companions start from it, each in q and q', where the
                                     start has an error (qdot_run_end_apart); NULL: it is exact */
} qdot_run_request;

#endif
