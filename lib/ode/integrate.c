/* integrate.c -- integrates a system as a whole or its decoupled parts separately. */
#include "ode/integrate.h"

#include <string.h>

#include "base/memory.h"
#include "ode/apart.h"
#include "ode/step.h"

/* Integrate all components together. */
static qdot_status
integrate_whole(const qdot_ode_system *system, const qdot_ode_method *method, const qdot_ode_options *options,
                double t0, double t1, double *y, qdot_ode_result *result)
{
    qdot_ode_controller c;
    qdot_ode_step step;
    bool stop = false;
    qdot_status status = qdot_ode_controller_open(&c, system, method, options, t0, t1, y);

    while (status == QDOT_OK && c.t != t1 && !stop) {
        status = qdot_ode_controller_next(&c, &step);
        if (status == QDOT_OK)
            status = qdot_ode_controller_settle(
                &c, &step,
                options->accepted ? options->accepted(step.t_end, step.y_end, &stop, options->user) : QDOT_OK);
    }
    qdot_ode_controller_state(&c, y, NULL);
    qdot_ode_controller_close(&c, status, stop);
    *result = c.result;
    return status;
}

/* An integration of all decoupled parts of a system from y at t0, to the time at which the first of them ends. */
typedef struct {
    const qdot_ode_system *system;
    const qdot_ode_method *method;
    const qdot_ode_options *options;
    double t0, t1;
    const double *start; /* [n] the state at t0 */
    double *y, *room;    /* [n] the end state; [2n] scratch */
    qdot_ode_result *result;
} parts;

/* Integrate part k of the system to the time that the earlier parts have reached. */
static qdot_status
integrate_part(const parts *p, size_t k, qdot_ode_result *result)
{
    const qdot_ode_part *part = p->system->parts + k;
    qdot_ode_options own = qdot_ode_part_options(part, p->options, p->room + p->system->n);
    qdot_status status;

    if (p->result->t != p->t1)
        own.t1_low = 0;
    qdot_ode_part_gather(part, p->start, p->room);
    status = integrate_whole(part->system, p->method, &own, p->t0, p->result->t,
                                      p->room, result);
    qdot_ode_part_scatter(part, p->room, p->y);
    qdot_ode_part_add(p->result, result);
    return status;
}

static qdot_status
integrate_parts(const parts *p)
{
    qdot_ode_result r;
    qdot_error failure = {0};
    qdot_status ended = QDOT_OK;

    for (size_t k = 0; k < p->system->n_parts; k++) {
        qdot_status status = integrate_part(p, k, &r);

        if (r.outcome == QDOT_ODE_DONE)
            continue;
        qdot_ode_part_end(p->result, &r);
        if (status != QDOT_OK) {
            ended = status;
            failure = *qdot_last_error();
        }
        if (ended == QDOT_EINTR || ended == QDOT_ENOMEM)
            break;
        for (size_t j = 0; j < k; j++) /* the earlier parts went further: repeat them up to the earlier end */
            if (integrate_part(p, j, &r) != QDOT_OK && ended == QDOT_OK) {
                ended = QDOT_EFAILED;
                failure = *qdot_last_error();
            }
    }
    if (ended != QDOT_OK)
        qdot_fail_again(&failure);
    return ended;
}

static qdot_status
integrate_decoupled(const qdot_ode_system *system, const qdot_ode_method *method,
                    const qdot_ode_options *options, double t0, double t1, double *y,
                    qdot_ode_result *result)
{
    double *start = qdot_malloc(3 * system->n * sizeof *start);
    parts p = {.system = system,
               .method = method,
               .options = options,
               .t0 = t0,
               .t1 = t1,
               .start = start,
               .y = y,
               .room = start ? start + system->n : NULL,
               .result = result};
    qdot_status status;

    *result = (qdot_ode_result){.outcome = QDOT_ODE_DONE, .t = t1};
    if (!start) {
        result->outcome = QDOT_ODE_FAILED;
        result->t = t0;
        memcpy(result->reason, qdot_last_error()->message, sizeof result->reason);
        return QDOT_ENOMEM;
    }
    memcpy(start, y, system->n * sizeof *y);
    status = integrate_parts(&p);
    qdot_free(start);
    return status;
}

qdot_status
qdot_ode_integrate(const qdot_ode_system *system, const qdot_ode_method *method,
                   const qdot_ode_options *options, double t0, double t1, double *y,
                   qdot_ode_result *result)
{
    static const qdot_ode_options defaults = {0};

    if (!options)
        options = &defaults;
    return (qdot_ode_is_apart(system, options) ? integrate_decoupled : integrate_whole)(
        system, method, options, t0, t1, y, result);
}
