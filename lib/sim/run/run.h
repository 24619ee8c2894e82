/* run.h -- a scene integrated: plan, tape and ode bound together, with the error stated.
 *
 * The one floor where mechanics, tape and ode meet. Parameters are substituted exactly before
 * anything is lowered, so terms that vanish are not computed.
 *
 *   M(q, t) q'' = f(q, q', t)      y = (q_1 ... q_n, q_1' ... q_n')
 *
 * The scene's events, the domains of its coordinates and where its equations switch are located and
 * divide it into pieces (sim/course/course.h).
 *
 * M is solved with numbers and its structure (Cholesky; LDL^T for a stated Lagrangian); a singular M is
 * an error that names the coordinate. With constraints q'' and the multipliers are found together and
 * states are kept on the constraints: sim/model/constrained.h.
 *
 * Tests  tests/sim/
 */
#ifndef QDOT_SIM_RUN_H
#define QDOT_SIM_RUN_H

#include "mech/dynamics/quantity.h"

/* What is done about drift off the constraints (sim/model/constrained.h). */
typedef enum { QDOT_RUN_PROJECT, QDOT_RUN_BAUMGARTE, QDOT_RUN_NONE } qdot_run_treatment;

typedef struct {
    size_t n_values;              /* values of parameters: symbol -> exact constant */
    const qdot_expr *symbols, *values;
    const qdot_expr *q0, *v0;     /* [n] start: exact constants, in order of the coordinates */
    const bool *q_named, *v_named; /* [n] which of them were named: the others may be solved for
                                     where constraints ask it; NULL: all */
    bool exactly;                 /* a start that breaks a constraint is refused */
    qdot_expr t0, t1;             /* limits: exact constants; t1 < t0 runs back */
    double tol;                   /* local error of each component in each step, relative to
                                     max(1, |value|) */
    const char *method;           /* "auto" or a name of ode/method.h */
    qdot_run_treatment treatment; /* of a scene with constraints */
    size_t n_states;              /* made by the run itself, leave it 0: parameters that events
                                     set, as further coordinates (sim/model/parameter-states.h); */
    const qdot_expr *states;      /* [n_states] their symbols; symbols, values, q0 ... know them */
    int digits;                   /* > 0: so many correct digits at the end (sim/digits/precise.h);
                                     tol is not looked at */
} qdot_run_request;

typedef enum { QDOT_RUN_DONE, QDOT_RUN_STOPPED, QDOT_RUN_FAILED } qdot_run_status;

typedef struct {
    qdot_expr quantity;  /* what should stay (energy, a cyclic momentum) */
    const char *name;    /* "energy", "p[phi]" */
    double start, drift; /* drift = max |c - c0| / max(1, |c0|) over the run */
    bool kept;           /* it is a constant of the integration (sim/plan/routh.h): drift is 0 */
} qdot_drift;

/* Coordinates that were integrated apart from the others. */
typedef struct {
    const char *coordinates; /* "x, y" */
    size_t steps, rejected;
} qdot_run_part;

typedef struct qdot_run qdot_run;

typedef struct {
    const char *method;
    double tol, t0, t1;            /* t1 where it ended */
    size_t steps, rejected, evals, jacobians, factorizations;
    double cpu;                    /* s, the integration itself */
    double cpu_total;              /* s, with derivation, lowering, error estimate */
    double error;                  /* estimate of the end state's error, max over components relative
                                      to max(1, |value|); NaN: unknown */
    double horizon;                /* time beyond which no digit is left (sim/error/horizon.h); NaN: none */
    double energy_drift;           /* NaN unless h is proved conserved */
    size_t n_drifts;
    const qdot_drift *drifts;      /* every conserved quantity known, energy first */
    qdot_run_status status;
    const char *reason;            /* NULL when done */
    bool interrupted;              /* by Ctrl-C: only the states are known */
    size_t n;                      /* coordinates, and behind them */
    size_t n_states;               /* parameters that events set, whose v is 0 */
    const qdot_expr *coordinates;  /* [n] symbols */
    const double *q, *v;           /* [n] state at t1 */
    size_t operations;             /* of the tape, one evaluation of M and f */
    int digits;                    /* as asked for; 0: a run in doubles */
    const qdot_expr *exact;        /* [2n + m] q, v, multipliers (nil: unknown) at t1 as the rational numbers they are, of a run
                                      with `digits`; else NULL */
    const char *notice;            /* what a person must know of the start, a line each; NULL: nothing */
    /* Of a scene with constraints: */
    size_t m;                      /* multipliers; 0: no constraints */
    const qdot_expr *multipliers;  /* [m] symbols */
    const double *lambda;          /* [m] at t1; NaN where there are none */
    const double *lambda_error;    /* [m] estimates of their errors, absolute; NaN: unknown */
    double constraint_drift;       /* the largest |f| of holonomic constraints met, of velocity
                                      constraints where there are no others; NaN: neither */
    double velocity_drift;         /* the largest |df/dt|, |f| of velocity constraints; NaN */
    size_t independent;            /* of the constraints */
    size_t projections;            /* steps after which the state was moved */
    qdot_run_treatment treatment;
    size_t pieces, modes;          /* of a run that events or switches divide; else 1 */
    size_t n_parts;                /* 0: all went together */
    const qdot_run_part *parts;
    const char *doubt;             /* why the error is unknown, where that is known; NULL */
} qdot_run_report;

/* An event that occurred. */
typedef struct {
    const char *event;
    double t, error; /* NaN: unknown */
    int way;         /* 1: rising, -1: falling, 0: it touched */
    qdot_expr exact; /* of a run with `digits` the time as a rational; else nil */
} qdot_run_occurrence;

/* Integrate. On QDOT_OK *run is owned by the caller; report->status may still be FAILED (a
 * singularity, a domain left: reason says where and when), the run so far is kept. QDOT_EINTR:
 * *run is the run so far when it is not NULL. Errors before anything was integrated: QDOT_EUNSET
 * names the parameter, QDOT_ESINGULAR the coordinate, QDOT_EINVAL, QDOT_ENOTBUILT. */
QDOT_MUST_CHECK qdot_status qdot_run_new(qdot_scene *scene, const qdot_run_request *request,
                                         qdot_run **run);
void qdot_run_free(qdot_run *run);
size_t qdot_run_bytes(const qdot_run *run); /* what its points take, about */
const qdot_run_report *qdot_run_get_report(const qdot_run *run);

/* Any expressions [m] of the scene (coordinates, velocities, accelerations, t, parameters)
 * along the run at times [k], ascending or not: values [k*m] row by row, as accurate as the run;
 * errors [k*m] (NULL: not wanted) from the companion run, NaN unknown. Constants of the run are
 * the request's. QDOT_EDOMAIN: outside the run, with its range. */
QDOT_MUST_CHECK qdot_status qdot_run_values(qdot_run *run, size_t m, const qdot_expr *exprs,
                                            size_t k, const double *times, double *values,
                                            double *errors);

/* The same at times[i] + lows[i] (lows NULL: 0), which is the exact time where times[i] is
 * its double: by the slope of the expression there. */
QDOT_MUST_CHECK qdot_status qdot_run_values_beyond(qdot_run *run, size_t m,
                                                   const qdot_expr *exprs, size_t k,
                                                   const double *times, const double *lows,
                                                   double *values, double *errors);

/* The same at one time, an exact constant, of a run with `digits`: values [m] rationals, errors [m]
 * (may be NULL) absolute, NaN unknown. */
QDOT_MUST_CHECK qdot_status qdot_run_exact_values(qdot_run *run, size_t m, const qdot_expr *exprs,
                                                  qdot_expr time, qdot_expr *values,
                                                  double *errors);

/* Over a range of a run: the largest or least value of e between its ends, extrema inside steps
 * included; its mean over time; its drift, max |e - e0| / max(1, |e0|) with e0 where the range
 * begins. The error, from the companion: NaN where unknown. QDOT_EDOMAIN: outside the run, or e is
 * undefined in it. */
typedef enum { QDOT_RANGE_MAX, QDOT_RANGE_MIN, QDOT_RANGE_MEAN, QDOT_RANGE_DRIFT } qdot_range_kind;
QDOT_MUST_CHECK qdot_status qdot_run_range(qdot_run *run, qdot_range_kind kind, qdot_expr e,
                                           double from, double to, double *value, double *error);

/* What occurred [*n], in the order of the run, with the errors of the times from the companion;
 * borrowed. */
QDOT_MUST_CHECK qdot_status qdot_run_occurrences(qdot_run *run,
                                                 const qdot_run_occurrence **list, size_t *n);
/* Whether the scene of the run had an event of that name. */
bool qdot_run_has_event(const qdot_run *run, const char *name);

/* The times of the accepted steps [*n], borrowed. */
const double *qdot_run_times(const qdot_run *run, size_t *n);

/* `plan`: what would be done and why, in words: coordinates, structure of M, operations of the tape,
 * method chosen. Parameters need values as for a run. */
QDOT_MUST_CHECK qdot_status qdot_run_plan(qdot_scene *scene, const qdot_run_request *request,
                                          qdot_text *out);
#endif
