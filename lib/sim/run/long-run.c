/* long-run.c -- predicts the number of steps of a run from its first steps. */
#include "sim/run/long-run.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "ode/integrate.h"

/* The default tolerance of a run, if the request gives none. */
static const double tol_unsaid = 1e-12;

/* The number of steps from which the length of a run is predicted: `few_steps`, or more if it seems long. */
enum { few_steps = 2, first_steps = 64 };
static const double unlikely = QDOT_LONG_STEPS / 50;

/* Stored points may take 2 GB: half for the points, half for their low parts and the companion runs' points. */
static const double most_bytes = 1e9;

static qdot_status
count_step(double t, const double *y, bool *stop, void *user)
{
    int *left = user;

    (void)t;
    (void)y;
    *stop = --*left == 0;
    return QDOT_OK;
}

/* Predict the number of steps of the whole run from its first `looked` steps; 0 if that is not possible. */
static qdot_status
predict_steps(const qdot_long_run *run, int looked, double *steps)
{
    int left = looked;
    qdot_ode_options options = {
        .tol = run->tol, .carry = run->low, .accepted = count_step, .user = &left};
    double *y = qdot_malloc(run->system->n * sizeof *y);
    qdot_ode_result result;
    qdot_status status;

    *steps = 0;
    if (!y)
        return QDOT_ENOMEM;
    memcpy(y, run->start, run->system->n * sizeof *y);
    status = qdot_ode_integrate(run->system, run->plan->method, &options, run->t0, run->t1, y,
                                &result);
    qdot_free(y);
    if (status == QDOT_EINTR || status == QDOT_ENOMEM)
        return status;
    if (result.outcome == QDOT_ODE_STOPPED)
        *steps = looked * ((run->t1 - run->t0) / (result.t - run->t0));
    return QDOT_OK;
}

qdot_status
qdot_long_run_tolerance(const qdot_long_run *run, double *tol)
{
    const qdot_plan *p = run->plan;
    const double bytes = (double)(1 + 2 * run->system->n) * sizeof(double);
    double steps;

    *tol = run->tol;
    if (!p->chosen || !p->method->series || !p->smooth || p->constraints || p->n_states > 0
        || fabs(run->tol / tol_unsaid - 1) > 1e-9)
        return QDOT_OK;
    QDOT_TRY(predict_steps(run, few_steps, &steps));
    if (!(steps > unlikely))
        return QDOT_OK;
    QDOT_TRY(predict_steps(run, first_steps, &steps));
    if (steps > QDOT_LONG_STEPS && steps * bytes < most_bytes)
        *tol = QDOT_LONG_TOL;
    return QDOT_OK;
}
