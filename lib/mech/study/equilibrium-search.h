/* equilibrium-search.h -- data and steps of the search for equilibria. Internal to mech/. */
#ifndef QDOT_MECH_EQUILIBRIUM_SEARCH_H
#define QDOT_MECH_EQUILIBRIUM_SEARCH_H

#include "base/memory.h"
#include "expr/calculus.h"
#include "expr/walk.h"
#include "mech/scene/things.h"
#include "mech/study/rest.h"
#include "normal/field/facts.h"

/* A branch of the search: equations still to solve, solutions and conditions so far; LISTs. */
typedef struct {
    qdot_expr equations, known, conditions;
} qdot_rest_branch;

typedef struct {
    qdot_scene *s;
    qdot_pool *pool;
    qdot_facts facts;
    qdot_expr equations; /* all of them, a LIST */
    qdot_vec(qdot_expr) unknowns; /* coordinates, then multipliers */
    size_t coordinates;           /* of them */
    qdot_vec(qdot_rest_branch) todo;
    qdot_vec(qdot_equilibrium) found;
    uint64_t work; /* rest of the budget of exact solution, in operations */
    bool complete;
} qdot_rest;

/* The equations at rest and their unknowns; ended in any case. Then all places of rest, to r->found, not
 * judged; *out: what is known of a search in numbers. (equilibrium.c) */
QDOT_MUST_CHECK qdot_status qdot_rest_begin(qdot_rest *r, qdot_scene *s);
QDOT_MUST_CHECK qdot_status qdot_rest_find(qdot_rest *r, qdot_binder bind, void *user,
                                           qdot_equilibria *out);
void qdot_rest_end(qdot_rest *r);

/* A LIST and n more; nil stands for the empty one. */
qdot_expr qdot_rest_appended(qdot_pool *pool, qdot_expr list, size_t n,
                             const qdot_expr *more);

/* Conditions with the known values: QDOT_FALSE if one fails; else those that are not always true.
 *  */
qdot_expr qdot_rest_conditions_left(const qdot_rest *r, qdot_expr conditions);

/* e with the values of equations u = value put in, all at once. */
qdot_expr qdot_rest_put(const qdot_rest *r, qdot_expr e, qdot_expr values);

/* Whether a full turn of u changes no equation. */
bool qdot_rest_is_angle(const qdot_rest *r, qdot_expr u, qdot_expr equations);

/* Solve all branches that are left to do, to r->found; r->complete: these are all.
 * (equilibrium-branches.c) */
QDOT_MUST_CHECK qdot_status qdot_rest_solve(qdot_rest *r);

/* The equations at rest, simplified, those that hold identically left out: a LIST.
 * (equilibrium-equations.c) */
QDOT_MUST_CHECK qdot_status qdot_rest_equations(qdot_rest *r, qdot_expr *list);
/* The equations without t that hold at a place at which those hold at all times. */
QDOT_MUST_CHECK qdot_status qdot_rest_at_all_times(qdot_rest *r, qdot_expr equations,
                                                   qdot_expr *list);

/* Remove places that belong to a listed family, or differ by full turns from one listed before.
 * (equilibrium-twice.c) */
QDOT_MUST_CHECK qdot_status qdot_rest_leave_out_twice(qdot_rest *r, qdot_expr equations);

/* --- numbers (equilibrium-numeric.c) ---- */
/* at [n * unknowns], owned: each proved. */
typedef struct {
    double *at;
    size_t n, starts;
    double reach;    /* starts lay within +-reach where no domain is declared */
    size_t unproved; /* starts that ended at an unproved zero within rounding */
} qdot_places;

/* Zeros of r [unknowns] in the unknowns, every other symbol bound. */
QDOT_MUST_CHECK qdot_status qdot_rest_search(qdot_rest *rest, const qdot_expr *r,
                                             qdot_places *out);
void qdot_places_clear(qdot_places *places);

#endif
