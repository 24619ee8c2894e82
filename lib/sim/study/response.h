/* response.h -- expressions along a run at given times, and their slopes by what the run starts from.
 *
 *     e_j(t_i; u),     d e_j(t_i; u)/d u_k
 *
 * The unknowns u are parameters and values of the start. One run of the variational equations
 * (variation.h) gives all of it; no companion runs beside it. Its scene is made once, with
 * the parameters among u as further coordinates (parameter-states.h), so that the equations are derived and
 * lowered once for all u. With constraints that is so where the whole state is unknown, which is brought onto them
 * (tangents.h); else it is made anew for every u, since its start follows from them.
 *
 * Tests  tests/sim/study/test_response.c
 */
#ifndef QDOT_SIM_RESPONSE_H
#define QDOT_SIM_RESPONSE_H

#include "sim/study/variation.h"

typedef struct {
    qdot_scene *scene;
    /* Values and start in the unknowns: a parameter among them has itself as its value, a coordinate or velocity
     * among them itself as its start. t1 is the last time that is needed; t0 the time of the start. */
    const qdot_run_request *request;
    size_t k; /* number of unknowns (symbols of parameters, coordinates, velocities); the symbols and their names follow */
    const qdot_expr *unknowns;
    const char *const *names;
    bool whole; /* the first unknowns are q, q' and are themselves the start values */
    size_t m; /* number of expressions of the scene, which may contain parameters */
    const qdot_expr *exprs;
    size_t n_times; /* number of times within t0 ... t1, in the order of the run */
    const double *times;
} qdot_response_of;

typedef struct qdot_response qdot_response;

/* *of is copied; what it points to is borrowed. Free it in any case. Errors: those of qdot_variation_make and
 * of a plan. */
QDOT_MUST_CHECK qdot_status qdot_response_new(const qdot_response_of *of, qdot_response **r);
void qdot_response_free(qdot_response *r);

/* values [n_times x m], slopes [n_times x m x k] at u [k]. Errors: those of a run, QDOT_EFAILED where it
 * ends before the last of the times, QDOT_EDOMAIN where an expression is undefined. */
QDOT_MUST_CHECK qdot_status qdot_response_at(qdot_response *r, const double *u, double *values,
                                             double *slopes);

/* The same in parts: the run at u from t0 to t1, times of its own; then values [n_times x m] and slopes
 * [n_times x m x k] (NULL: not wanted) at any times of the latest run. */
QDOT_MUST_CHECK qdot_status qdot_response_run(qdot_response *r, const double *u, double t0,
                                              double t1);
QDOT_MUST_CHECK qdot_status qdot_response_read(qdot_response *r, size_t n_times, const double *times,
                                               double *values, double *slopes);
/* The variational scene, if it is the same for all values of the unknowns; valid after the first run. */
const qdot_variation *qdot_response_variation(const qdot_response *r);
/* For unknowns that are a whole state: orthonormal tangents [count x 2n] of the constraints at the
 * start for u, t. */
QDOT_MUST_CHECK qdot_status qdot_response_tangents(qdot_response *r, const double *u, double t, size_t *count,
                                                   double *basis);

#endif
