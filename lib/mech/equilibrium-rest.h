/* equilibrium-rest.h -- a search for equilibria as its files see it. Internal to mech/. */
#ifndef QDOT_MECH_EQUILIBRIUM_REST_H
#define QDOT_MECH_EQUILIBRIUM_REST_H

#include "base/memory.h"
#include "mech/derived.h"
#include "mech/equilibrium.h"

/* What is left to solve, and what is known: LISTs. */
typedef struct {
    qdot_expr equations, known, conditions;
} qdot_rest_branch;

typedef struct {
    qdot_scene *s;
    qdot_pool *pool;
    qdot_facts facts;
    qdot_vec(qdot_expr) unknowns; /* coordinates, then multipliers */
    size_t coordinates;           /* of them */
    qdot_vec(qdot_rest_branch) todo;
    qdot_vec(qdot_equilibrium) found;
    bool complete;
} qdot_rest;

/* Conditions at what is known: QDOT_FALSE if one fails; else those that say something. */
qdot_expr qdot_rest_conditions_left(const qdot_rest *r, qdot_expr conditions);

/* e with the values of equations u = value put in, all at once. */
qdot_expr qdot_rest_put(const qdot_rest *r, qdot_expr e, qdot_expr values);

/* Whether a full turn of u changes no equation. */
bool qdot_rest_is_angle(const qdot_rest *r, qdot_expr u, qdot_expr equations);

/* Places in a family that is listed too, or full turns from one listed before, are left out.
 * (equilibrium-twice.c) */
QDOT_MUST_CHECK qdot_status qdot_rest_leave_out_twice(qdot_rest *r, qdot_expr equations);

#endif
