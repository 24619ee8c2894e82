/* run.c -- the common beginning of integrations. */
#include "ode/run.h"

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
