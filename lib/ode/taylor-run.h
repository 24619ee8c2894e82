/* taylor-run.h -- a run by Taylor series from inside. Internal to ode/: for taylor.c, which tries
 * steps, taylor-length.c, which finds their lengths, taylor-series.c, which expands, and taylor-end.c, which goes to
 * their ends.
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
    const qdot_ode_method *method; /* its name in steps that are offered; NULL: none are */
    const qdot_ode_series *series;
    const qdot_series_kernels *kernels;
    const qdot_ode_options *options;
    qdot_ode_result *result;
    size_t n;
    double tol, t, t1, direction;
    double place; /* time of a singularity that the present step passes over; NaN: none */
    double noise; /* relative noise of dy/dt per unit of time, below which the defect of a step cannot fall */
    double defect; /* defect of the step tried: its relative error per unit of time; 0: not computed */
    double held; /* the accuracy in force: tol, or the accuracy of the coefficients if that is worse */
    uint64_t max_steps;
    double work;      /* work of one Taylor expansion (unit: meter.h) */
    uint64_t counted; /* number of expansions whose work has been counted */
    int p;         /* the order of the present step */
    int most;      /* the order of the run, which steps that end at `until` need not have */
    int next_p;    /* the order of the next step */
    int cautious;  /* number of steps before the order is lowered again, and of those after it was too low the last time */
    int patience;
    double until;  /* the end of the present step at the latest: t1, or a time at which f is not smooth */
    int highest;   /* the highest order used by the run and its companion runs (companion.h) */
    int cut;       /* the order up to which the series is summed in the present step: p or less */
    double log_wanted, log_aim, log_term; /* log2 of what a step should err, of what it
                                             may at the point at hand, of a term */
    double unit;   /* unit of time of the series: t' = t + unit s; a signed power of two */
    double per_unit; /* 1/unit */
    bool extended; /* the series has been computed up to order p */
    qdot_ode_written written;
    double t0, first_unit;

    /* [n] each, with the further work space that qdot_series_step needs: */
    double *y, *carry;           /* [n] the present state as two doubles is y + carry */
    double *least;               /* [n] scales s_i of the system (scale.h) */
    double *scale;               /* [n] 1/max(least_i, |y_i|) */
    double *next, *next_carry;   /* [n] state at the end of the step tried: next + next_carry */
    double *next_size, *next_scale;
    double *slope, *terms; /* [n] derivative of the Taylor polynomial at the end of the step; magnitudes of its terms */
    size_t *confirmed; /* [n_confirmed] indices of the components whose defect is computed */
    size_t n_confirmed;
    qdot_series_step step;       /* the present step for qdot_series_step, which refers to the arrays above */
    double peaks[QDOT_SERIES_MOST + 8]; /* [p + 1] largest term of each order, padded to full vectors */
    qdot_series_weights weights;
    qdot_ode_expanded expanded;  /* the step that is offered */
    struct {
        int tries;     /* number of attempts at the present point */
        double most;   /* the longest step that an attempt there has left to try */
        double h;      /* the length of the last one, positive */
        double before; /* its defect, if it was defined but was not confirmed; else 0 */
        double moved;  /* how far a projection has moved the end of it */
    } attempt;
    qdot_error undefined;      /* the last error of the right-hand side f */
    double undefined_at;       /* end of the step at which f was undefined; NaN: none yet */
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

/* Expand series to order p from now on. */
void qdot_ode_taylor_run_set_order(qdot_ode_taylor_run *r, int p);

/* The length that a step should have, *h > 0, `most` being what a step tried before allows;
 * INFINITY where the series ends. The unit of the series is brought near it where it is far from
 * it. Errors: QDOT_EDOMAIN if the series is not finite in any unit; those of the system. */
QDOT_MUST_CHECK qdot_status qdot_ode_taylor_run_length(qdot_ode_taylor_run *r, double most,
                                                   double *h);

/* --- the end of a step (taylor-end.c) --- */

/* Set the pointers in r->step to the arrays that are in use now. */
void qdot_ode_taylor_run_set_arrays(qdot_ode_taylor_run *r);

/* Whether the series of a step of the signed length h is confirmed by the equations at two places inside it. */
QDOT_MUST_CHECK qdot_status qdot_ode_taylor_run_is_confirmed_inside(qdot_ode_taylor_run *r, double h, bool *good);

/* Go to t_end, into r->next, and begin the series there, if *good. Otherwise only the series has changed. */
QDOT_MUST_CHECK qdot_status qdot_ode_taylor_run_go(qdot_ode_taylor_run *r, double t_end, bool *good);

/* The end becomes the present state. */
void qdot_ode_taylor_run_accept(qdot_ode_taylor_run *r);

/* Behind an end that was not *good: whether its defect is the rounding of the equations, since it hardly
 * fell when the step was divided by 4, as truncation would by 4^p. Shorter steps err as much, so the longest to try may
 * have the length before again. */
bool qdot_ode_taylor_run_meets_noise(qdot_ode_taylor_run *r);

#endif
