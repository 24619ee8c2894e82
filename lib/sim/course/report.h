/* report.h -- the report of a run: status, costs, error, end state, drifts, events. */
#ifndef QDOT_SIM_REPORT_H
#define QDOT_SIM_REPORT_H

#include <stdint.h>

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
    const char *coordinates; /* names of the coordinates: "x, y" */
    uint64_t steps, rejected;
} qdot_run_part;

typedef struct qdot_run qdot_run;

typedef struct {
    const char *method;
    double tol, t0, t1;            /* tolerance; start time; time at which the run ended */
    uint64_t steps, rejected, evals, jacobians, factorizations;
    double cpu;                    /* CPU seconds of the integration itself */
    double cpu_total; /* CPU seconds including derivation of the equations, compilation and error estimate */
    double work, estimate_work;    /* counted (ode/meter.h), of the integration, and of all that tells
                                      its error */
    double error;                  /* estimate of the end state's error, max over components relative
                                      to max(1, |value|); NaN: unknown */
    double scaled_error;           /* error relative to max(scale, |value|) */
    const double *scales;          /* [2n] scales of q, then q' (ode/scale.h); NULL: all are 1 */
    double horizon; /* time after which no digit is reliable (sim/error/horizon.h); NaN: none */
    double standstill;             /* time about which the motion nearly came to rest, on a horizon
                                      that is there because of that; NaN */
    double energy_drift; /* max |h - h0| / max(1, |h0|); NaN: h is not proved to be conserved */
    size_t n_drifts;
    const qdot_drift *drifts; /* [n_drifts] drift of each known conserved quantity, energy first */
    qdot_run_status status;
    const char *reason;            /* why the run ended early; NULL when done */
    bool interrupted;              /* interrupted by Ctrl-C: only the states are known */
    size_t n;                      /* number of coordinates, including parameters at the end */
    size_t n_states;               /* number of parameters that events set; their velocity is 0 */
    const qdot_expr *coordinates;  /* [n] symbols of the coordinates */
    const double *q, *v;           /* [n] coordinates and velocities at t1 */
    size_t operations;             /* operations of the tape for one evaluation of M and f */
    int digits;                    /* requested number of digits; 0: a run in doubles */
    const qdot_expr *exact;        /* [2n + m] with `digits`: q, v, multipliers (nil: unknown) at
                                      t1 as rational numbers; else NULL */
    const char *notice;            /* notices about the start of the run, one a line; NULL: none */
    /* Fields for scenes with constraints: */
    size_t m;                      /* number of multipliers; 0: no constraints */
    const qdot_expr *multipliers;  /* [m] symbols of the multipliers */
    const double *lambda;          /* [m] multipliers at t1; NaN: undefined */
    const double *lambda_error;    /* [m] estimated absolute errors of lambda; NaN: unknown */
    double constraint_drift;       /* the largest |f| of holonomic constraints, or of velocity
                                      constraints if there are no others; NaN: neither */
    double velocity_drift; /* largest |df/dt| of holonomic and |f| of velocity constraints; NaN: none */
    size_t independent;            /* rank of the constraint Jacobian */
    uint64_t projections;          /* number of steps after which the state was projected */
    qdot_run_treatment treatment;
    size_t pieces, modes; /* numbers of pieces and modes, 1 if events and switches do not divide the run */
    size_t n_parts;                /* number of decoupled groups; 0: integrated together */
    const qdot_run_part *parts;
    const char *doubt;             /* why the error is unknown; NULL: it is known, or no reason is
                                       */
} qdot_run_report;

/* Whether t lies beyond the time after which no digit is known, in the direction of the run. False
 * for runs without such a time. */
static inline bool
qdot_run_report_is_beyond(const qdot_run_report *r, double t)
{
    return (r->t1 < r->t0 ? -1 : 1) * (t - r->horizon) > 0; /* the comparison is false if horizon is NaN */
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
    double t, error; /* time of the event and its error; NaN: unknown */
    int way;         /* 1: rising, -1: falling, 0: only touched 0 */
    qdot_expr exact; /* with `digits`: the time as a rational number; else nil */
} qdot_run_occurrence;

#endif
