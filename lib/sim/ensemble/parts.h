/* parts.h -- an ensemble between its runs (runs.c) and what is read of them (seen.c).
 */
#ifndef QDOT_SIM_ENSEMBLE_PARTS_H
#define QDOT_SIM_ENSEMBLE_PARTS_H

#include "base/interrupt.h"
#include "sim/form/ensemble-series.h"
#include "sim/plan/plan.h"
#include "sim/ensemble/momenta.h"
#include "sim/ensemble/ensemble.h"

/* One pass over all members of an ensemble: the runs themselves, or the companion runs of all members. */
typedef struct {
    qdot_ensemble_series *series; /* Taylor series of the members; for companion runs made at first use */
    qdot_ensemble_steps *steps;   /* inspects each step for events; NULL: nothing is watched */
    size_t number;                /* 0: the runs; 1, 2: the first, the second companion run of each */
    qdot_batch_run run;
    double *memory;
    double *t1;       /* [members] end times */
    double *momenta;  /* [n_kept] conserved momenta of one member */
    double *replaced; /* [members x n_kept] velocities that momenta replace in the state */
    qdot_status status;
    qdot_interrupt *interrupt; /* flag of the thread that runs the ensemble (base/interrupt.h) */
    qdot_error error; /* failure of a pass that runs on another thread */
} qdot_ensemble_pass;

struct qdot_ensemble {
    qdot_plan *plan;                /* plan in which parameters that vary are further coordinates */
    qdot_ensemble_momenta *momenta; /* conversion between velocities and conserved momenta if the plan is reduced; NULL: none */
    size_t n, varied; /* number of coordinates, of varied parameters: a state is q [n], q' [n], parameters */
    char **reasons;                 /* [n_reasons] why a member cannot start; NULL: it can */
    size_t n_reasons;
    size_t companions; /* number of companion runs for each run: 1 or 2 */
    qdot_ensemble_pass passes[QDOT_ENSEMBLE_PASSES];
    const qdot_ensemble_watching *watching; /* events and times to watch; NULL: none */
    double *times; /* [n_times] times at which states are stored */
    size_t n_times;
    uint64_t most_steps;
    double t0, t1, t1_low, tol;
    int t1_side;
    int order;
};

/* The plan that is integrated: the reduced one if there are ignorable coordinates. */
static inline const qdot_plan *
qdot_ensemble_equations(const qdot_ensemble *e)
{
    return e->plan->reduced ? e->plan->reduced : e->plan;
}

/* The size of a state with the varied parameters; _kept: the number of conserved momenta. */
static inline size_t
qdot_ensemble_width(const qdot_ensemble *e)
{
    return 2 * e->n + e->varied;
}

static inline size_t
qdot_ensemble_kept(const qdot_ensemble *e)
{
    return qdot_ensemble_equations(e)->n_kept;
}

#endif
