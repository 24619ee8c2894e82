/* apart.c -- converts states, options and results between a system and its decoupled parts. */
#include "ode/apart.h"

#include <string.h>

bool
qdot_ode_is_apart(const qdot_ode_system *system, const qdot_ode_options *options)
{
    return system->n_parts > 1 && (options->apart || !options->accepted);
}

void
qdot_ode_part_gather(const qdot_ode_part *part, const double *y, double *own)
{
    for (size_t i = 0; i < part->system->n; i++)
        own[i] = y[part->index[i]];
}

void
qdot_ode_part_scatter(const qdot_ode_part *part, const double *own, double *y)
{
    for (size_t i = 0; i < part->system->n; i++)
        y[part->index[i]] = own[i];
}

qdot_ode_options
qdot_ode_part_options(const qdot_ode_part *part, const qdot_ode_options *whole, double *carry)
{
    qdot_ode_options own = *whole;

    if (whole->carry) {
        qdot_ode_part_gather(part, whole->carry, carry);
        own.carry = carry;
    }
    return own;
}

void
qdot_ode_part_add(qdot_ode_result *whole, const qdot_ode_result *part)
{
    qdot_ode_stats_add(&whole->stats, &part->stats);
}

void
qdot_ode_part_end(qdot_ode_result *whole, const qdot_ode_result *part)
{
    if (part->outcome == QDOT_ODE_DONE)
        return;
    whole->outcome = part->outcome;
    whole->t = part->t;
    memcpy(whole->reason, part->reason, sizeof whole->reason);
}
