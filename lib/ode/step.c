/* step.c -- chooses the kind of controller for a run, and passes the owner's calls on to it. */
#include "ode/step.h"

#include "base/clock.h"

static const qdot_ode_control *
choose_kind(const qdot_ode_system *system, const qdot_ode_method *method, const qdot_ode_options *options)
{
    if (options->alternates && method->stiff && method->kernel && system->series)
        return &qdot_ode_alternating_steps;
    return method->series      ? &qdot_ode_taylor_steps
           : method->geometric ? &qdot_ode_constant_steps
                               : &qdot_ode_adaptive_steps;
}

qdot_status
qdot_ode_controller_open(qdot_ode_controller *c, const qdot_ode_system *system, const qdot_ode_method *method,
                         const qdot_ode_options *options, double t0, double t1, const double *y)
{
    *c = (qdot_ode_controller){.kind = choose_kind(system, method, options),
                               .t = t0,
                               .t1 = t1,
                               .began = qdot_cpu_now(),
                               .result = {.outcome = QDOT_ODE_DONE, .t = t0}};
    QDOT_TRY(c->kind->open(system, method, options, t0, t1, y, &c->result, &c->run));
    c->opened = true;
    return QDOT_OK;
}

qdot_status
qdot_ode_controller_offer(qdot_ode_controller *c, qdot_ode_step *step)
{
    *step = (qdot_ode_step){0};
    return c->kind->offer(c->run, step);
}

qdot_status
qdot_ode_controller_take(qdot_ode_controller *c, qdot_ode_step *step, bool *taken)
{
    *taken = true;
    return c->kind->take ? c->kind->take(c->run, step, taken) : QDOT_OK;
}

qdot_status
qdot_ode_controller_accept(qdot_ode_controller *c, const qdot_ode_step *step)
{
    c->t = step->t_end;
    return c->kind->accept(c->run);
}

qdot_status
qdot_ode_controller_refuse(qdot_ode_controller *c, qdot_status why)
{
    return c->kind->refuse(c->run, why);
}

qdot_status
qdot_ode_controller_next(qdot_ode_controller *c, qdot_ode_step *step)
{
    bool taken;

    do {
        QDOT_TRY(qdot_ode_controller_offer(c, step));
        QDOT_TRY(qdot_ode_controller_take(c, step, &taken));
    } while (!taken);
    return QDOT_OK;
}

qdot_status
qdot_ode_controller_settle(qdot_ode_controller *c, const qdot_ode_step *step, qdot_status verdict)
{
    return verdict == QDOT_OK ? qdot_ode_controller_accept(c, step) : qdot_ode_controller_refuse(c, verdict);
}

void
qdot_ode_controller_state(const qdot_ode_controller *c, double *y, double *low)
{
    if (c->opened)
        c->kind->state(c->run, y, low);
}

void
qdot_ode_controller_close(qdot_ode_controller *c, qdot_status status, bool stopped)
{
    if (c->run)
        c->kind->close(c->run);
    c->run = NULL;
    c->result.stats.cpu = qdot_cpu_now() - c->began;
    c->result.outcome = stopped ? QDOT_ODE_STOPPED : QDOT_ODE_DONE;
    qdot_ode_end(&c->result, c->t, status);
}
