/* taylor-run.h -- a run by Taylor series from inside. Internal to ode/: for taylor.c, which takes
 * steps, and taylor-length.c, which finds their lengths.
 */
#ifndef QDOT_ODE_TAYLOR_RUN_H
#define QDOT_ODE_TAYLOR_RUN_H

#include "num/series.h"
#include "ode/crawl.h"
#include "ode/run.h"
#include "ode/stiffness.h"
#include "ode/written.h"

typedef struct {
    const qdot_ode_system *system;
    const qdot_ode_series *series;
    const qdot_series_kernels *kernels;
    const qdot_ode_options *options;
    qdot_ode_result *result;
    size_t n;
    double tol, t, t1, direction;
    double place; /* that the step at hand goes over; NaN: none */
    double noise; /* of the slopes, over sizes and a unit of time: what the defect is at least */
    double defect; /* of the step tried, likewise; 0: it was not looked at */
    double held; /* tol, or what the coefficients are worth if that is more */
    uint64_t max_steps;
    double work;      /* of an expansion (meter.h) */
    uint64_t counted; /* expansions whose work has been counted */
    int p;
    int highest;   /* the highest order among the run and its companions */
    int cut;       /* the order that the step at hand is summed to: p, or less */
    double log_wanted, log_aim, log_term; /* log2 of what a step should err, of what it
                                             may at the point at hand, of a term */
    double unit;   /* of the series: t' = t + unit s; a power of two, signed */
    double per_unit; /* its inverse */
    bool extended; /* the series is there to order p */
    qdot_ode_written written;
    double t0, first_unit;

    /* [n], with the work space that qdot_series_step needs */
    double *y, *carry;           /* the state now */
    double *least;               /* the scales of the system (scale.h) */
    double *scale;               /* 1/max(least, |y|) */
    double *next, *next_carry;   /* at the end of the step tried */
    double *next_size, *next_scale;
    double *slope, *terms;       /* of the polynomial there */
    size_t *confirmed;           /* [n_confirmed] what the defect is looked at of */
    size_t n_confirmed;
    qdot_series_step step;       /* of those */
    double peaks[QDOT_SERIES_MOST + 8]; /* [p + 1] and what fills a vector */
    qdot_series_weights weights;
    qdot_error undefined;      /* the last error of f */
    double undefined_at;       /* the end of the step that met it; NaN before any */
    qdot_ode_crawl crawl;
    qdot_ode_stiffness stiffness;
} qdot_ode_taylor_run;

static inline void
qdot_ode_taylor_run_set_unit(qdot_ode_taylor_run *r, double unit)
{
    r->unit = unit;
    r->per_unit = 1 / unit;
}

/* Begin the series at y, in the unit at hand; take it to order p, if it is not. Errors: those of
 * the system. */
QDOT_MUST_CHECK qdot_status qdot_ode_taylor_run_begin(qdot_ode_taylor_run *r, double t,
                                                  const double *y);
QDOT_MUST_CHECK qdot_status qdot_ode_taylor_run_expand(qdot_ode_taylor_run *r);

/* The length that a step should have, *h > 0, `most` being what a step tried before allows;
 * INFINITY where the series ends. The unit of the series is brought near it where it is far from
 * it. Errors: QDOT_EDOMAIN if the series is not finite in any unit; those of the system. */
QDOT_MUST_CHECK qdot_status qdot_ode_taylor_run_length(qdot_ode_taylor_run *r, double most,
                                                   double *h);

#endif
