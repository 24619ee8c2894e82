/* report.h -- the report of a run: status, costs, error, end state, drifts, events. */
#ifndef QDOT_SIM_REPORT_H
#define QDOT_SIM_REPORT_H

#include "sim/model/request.h"

typedef enum { QDOT_RUN_DONE, QDOT_RUN_STOPPED, QDOT_RUN_FAILED } qdot_run_status;

typedef struct {
    qdot_expr quantity;  /* the conserved quantity (energy, a cyclic momentum) */
    const char *name;    /* "energy", "p[phi]" */
    double start, drift; /* drift = max |c - c0| / max(1, |c0|) over the run */
    bool changed;        /* an event changed its value, which is not counted as drift */
    bool kept;           /* the integration keeps it exactly (sim/plan/routh.h): drift is 0 */
} qdot_drift;

/* A group of coordinates that was integrated separately because it is decoupled. */
typedef struct {
    const char *coordinates; /* "x, y" */
    size_t steps, rejected;
} qdot_run_part;

typedef struct qdot_run qdot_run;

typedef struct {
    const char *method;
    double tol, t0, t1;            /* t1: where the run ended */
    size_t steps, rejected, evals, jacobians, factorizations;
    double cpu;                    /* s, the integration itself */
    double cpu_total;              /* s, with derivation, lowering, error estimate */
    double work, estimate_work;    /* counted (ode/meter.h), of the integration, and of all that tells
                                      its error */
    double error;                  /* estimate of the end state's error, max over components relative
                                      to max(1, |value|); NaN: unknown */
    double scaled_error;           /* the same relative to max(scale, |value|) */
    const double *scales;          /* [2n] of q, then q' (ode/scale.h); NULL: all are 1 */
    double horizon;                /* time beyond which no digit is left (sim/error/horizon.h); NaN: none */
    double standstill;             /* time about which the motion nearly came to rest, on a horizon
                                      that is there because of that; NaN */
    double energy_drift;           /* NaN unless h is proved conserved */
    size_t n_drifts;
    const qdot_drift *drifts;      /* every conserved quantity known, energy first */
    qdot_run_status status;
    const char *reason;            /* NULL when done */
    bool interrupted;              /* by Ctrl-C: only the states are known */
    size_t n;                      /* coordinates, including at the end */
    size_t n_states;               /* parameters that events set, whose v is 0 */
    const qdot_expr *coordinates;  /* [n] symbols */
    const double *q, *v;           /* [n] state at t1 */
    size_t operations;             /* of the tape, one evaluation of M and f */
    int digits;                    /* as requested; 0: a run in doubles */
    const qdot_expr *exact;        /* [2n + m] with `digits`: q, v, multipliers (nil: unknown) at
                                      t1 as rational numbers; else NULL */
    const char *notice;            /* notices about the start, a line each; NULL: none */
    /* Fields for scenes with constraints: */
    size_t m;                      /* multipliers; 0: no constraints */
    const qdot_expr *multipliers;  /* [m] symbols */
    const double *lambda;          /* [m] at t1; NaN where there are none */
    const double *lambda_error;    /* [m] estimates of their errors, absolute; NaN: unknown */
    double constraint_drift;       /* the largest |f| of holonomic constraints, or of velocity
                                      constraints if there are no others; NaN: neither */
    double velocity_drift;         /* the largest |df/dt|, |f| of velocity constraints; NaN */
    size_t independent;            /* rank of the constraints */
    size_t projections;            /* steps after which the state was moved */
    qdot_run_treatment treatment;
    size_t pieces, modes;          /* of a run divided by events or switches; else 1 */
    size_t n_parts;                /* decoupled groups; 0: integrated together */
    const qdot_run_part *parts;
    const char *doubt;             /* why the error is unknown; NULL: it is known, or no reason is
                                       */
} qdot_run_report;

/* Whether t lies beyond the time after which no digit is known, in the direction of the run. False
 * for runs without such a time. */
static inline bool
qdot_run_report_is_beyond(const qdot_run_report *r, double t)
{
    return (r->t1 < r->t0 ? -1 : 1) * (t - r->horizon) > 0; /* of a NaN: false */
}

/* A stretch of time in which the function of an event, having decayed, is not known to differ from 0: whether the event
 * occurs there is not known. `touched`: it touches 0 there, and rises or falls as far as rounding can tell, or neither. */
typedef struct {
    const char *event;
    double from, to;
    bool touched;
} qdot_run_faded;

/* An event that occurred. */
typedef struct {
    const char *event;
    double t, error; /* NaN: unknown */
    int way;         /* 1: rising, -1: falling, 0: it touched 0 */
    qdot_expr exact; /* with `digits`: the time as a rational; else nil */
} qdot_run_occurrence;

#endif
