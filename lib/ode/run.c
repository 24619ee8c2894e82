/* run.c -- checks options at the beginning of an integration, and sets its result at the end. */
#include "ode/run.h"

#include <math.h>
#include <string.h>

qdot_status
qdot_ode_check_tolerance(double tol)
{
    if (tol >= 1e-16 && tol <= 1)
        return QDOT_OK;
    qdot_fail(QDOT_EINVAL, "tolerance %g is out of range", tol);
    return qdot_hint("doubles have a relative precision of 1e-16; take 1e-16 to 1");
}

qdot_status
qdot_ode_check_limits(const qdot_ode_system *system, double t0, double t1, const double *y)
{
    if (!isfinite(t0) || !isfinite(t1) || !isfinite(t1 - t0))
        return qdot_fail(QDOT_EINVAL, "the limits of the run are not finite");
    for (size_t i = 0; i < system->n; i++)
        if (!isfinite(y[i]))
            return qdot_fail(QDOT_EINVAL, "initial value %zu is not finite", i + 1);
    return QDOT_OK;
}

qdot_status
qdot_ode_check_pace(double t0, double t, double t1, size_t steps, double most, const char *hint)
{
    const double all = (double)steps * ((t1 - t0) / (t - t0));

    if (!(all > most))
        return QDOT_OK;
    qdot_fail(QDOT_ELIMIT, "stopped at t = %.6g after %zu steps: at this rate t = %.3g is %.2g steps away", t, steps,
              t1, all - (double)steps);
    return qdot_hint("%s", hint);
}

void
qdot_ode_end(qdot_ode_result *result, double t, qdot_status status)
{
    result->t = t;
    if (status == QDOT_OK)
        return;
    result->outcome = QDOT_ODE_FAILED;
    memcpy(result->reason, qdot_last_error()->message, sizeof result->reason);
}

qdot_status
qdot_ode_enter(const qdot_ode_system *system, const qdot_ode_options *options, double t,
               const double *y)
{
    const qdot_ode_following *f = system->following;
    qdot_status status;

    if (!f || options->goes_on)
        return QDOT_OK;
    status = f->enter(t, y, options->carry, f->user);
    if (qdot_ode_may_be_undefined(status)) {
        const qdot_error why = *qdot_last_error();

        return qdot_fail(QDOT_EFAILED, "stopped at t = %.17g: %s", t, why.message);
    }
    return status;
}
