/* rest-path.h -- curves of equilibria: F are the equations at rest, F' the exact derivative of their tape.
 *
 * Tests  tests/sim/branches/test_continuation.c
 */
#ifndef QDOT_SIM_REST_PATH_H
#define QDOT_SIM_REST_PATH_H

#include "mech/study/equilibrium-curve.h"
#include "sim/branches/path.h"
#include "tape/tape.h"

typedef struct {
    qdot_path path; /* first member, so a pointer to it can be cast to this type */
    qdot_equilibrium_curve *c; /* equations of the equilibria; borrowed */
    qdot_tape *tape;           /* outputs: F */
    qdot_tape *energy; /* energy (no equilibrium where it is undefined); NULL: it depends on more than the unknowns and p */
    double *work;
} qdot_rest_path;

/* Begin a path of equilibria, in a struct {0}; must be ended in any case. QDOT_EUNSET: a parameter
 * has no value. */
QDOT_MUST_CHECK qdot_status qdot_rest_path_begin(qdot_rest_path *x, qdot_equilibrium_curve *c,
                                                 double least, double most);
void qdot_rest_path_end(qdot_rest_path *x);

#endif
