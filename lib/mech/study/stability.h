/* stability.h -- judging places of rest, as its files see it. Internal to mech/. */
#ifndef QDOT_MECH_STABILITY_H
#define QDOT_MECH_STABILITY_H

#include "mech/study/equilibrium.h"
#include "mech/study/lyapunov.h"

typedef struct qdot_stability_numbers qdot_stability_numbers;

struct qdot_judge {
    qdot_scene *s;
    qdot_binder bind;
    void *user;
    qdot_energy_law law;
    bool holonomic;     /* every constraint is */
    bool timed;         /* the equations hold t */
    bool velocity_kink; /* |q'|, sign(q') ... stand in them: they have no linear part at rest */
    qdot_expr at_rest;  /* the equations at rest, a LIST */
    qdot_stability_numbers *numbers; /* for places in numbers, made when first needed */
};

/* |u|, sign u, floor ...: no slopes everywhere. */
bool qdot_stability_has_kink(uint32_t op);

/* A place known exactly, holonomic constraints (stability-exact.c). */
QDOT_MUST_CHECK qdot_status qdot_stability_judge_exact(qdot_judge *judge,
                                                       qdot_equilibrium *e);

/* --- places in numbers (stability-numbers.c) ----
 * The slopes of the equations, with the values of bind; freed by the caller. */
QDOT_MUST_CHECK qdot_status qdot_stability_numbers_new(const qdot_judge *judge,
                                                       qdot_stability_numbers **out);
void qdot_stability_numbers_free(qdot_stability_numbers *numbers);
/* e->stability of a place whose values are numbers. */
QDOT_MUST_CHECK qdot_status qdot_stability_judge_numbers(const qdot_judge *judge,
                                                         qdot_stability_numbers *numbers,
                                                         qdot_equilibrium *e);

#endif
