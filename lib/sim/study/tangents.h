/* tangents.h -- states z = (q, q') on the constraints of a scene, and directions along these, in numbers.
 *
 *     F(z; p) = 0:   f and df/dt of holonomic constraints, f of those of velocities; the equations of coordinates without
 *                    mass likewise (sim/model/massless.h)
 *     z <- z - F_z^+ F        until F = 0: the state of least change
 *     s <- s - F_z^+ (F_z s + F_p)       a slope of z by p, or by what moves the start (without F_p)
 *
 * A velocity constraint that is holonomic in disguise leaves the motion on a surface in space, its leaf: directions that
 * end on another leaf stay there, and are none of the tangents. F_z^+ by singular values. Without constraints nothing changes, and every direction is a tangent.
 *
 * Source  Golub & Van Loan, Matrix Computations, 5.5.2.
 * Tests   tests/sim/study/test_tangents.c
 */
#ifndef QDOT_SIM_TANGENTS_H
#define QDOT_SIM_TANGENTS_H

#include <gsl/gsl_matrix.h>

#include "sim/model/request.h"
#include "tape/tape.h"

typedef struct {
    size_t z, p, rows, rank; /* 2n; number of parameters; number of conditions F; rank of dF/dz at the latest state */
    size_t leaves; /* number of velocity constraints with known integral, whose value stays constant */
    qdot_tape *tape;         /* from z, p, t: F [rows], then F_z and F_p [rows x (z + p)], and those of the leaves
                              * [leaves x (z + p)]; NULL: no constraints */
    double *in, *out, *work;
    gsl_matrix *U, *V;       /* singular vectors of dF/dz at the latest state */
    gsl_vector *S, *room;
} qdot_tangents;

/* Begin with the request's values, parameters [p] being free. From {0}; must be ended in any case. */
QDOT_MUST_CHECK qdot_status qdot_tangents_begin(qdot_tangents *x, qdot_scene *scene, const qdot_run_request *request,
                                                size_t p, const qdot_expr *parameters);
void qdot_tangents_end(qdot_tangents *x);

/* Project the state [2n] onto the constraints at time t. QDOT_EFAILED: that is not possible. */
QDOT_MUST_CHECK qdot_status qdot_tangents_settle(qdot_tangents *x, double t, const double *parameters, double *state);
/* At the last projected state: project the derivative slope [2n] onto the constraints; it is taken
 * by parameter `by`, or SIZE_MAX: by none. */
void qdot_tangents_project(const qdot_tangents *x, size_t by, double *slope);
/* At the last projected state: orthonormal tangents [count x 2n] to constraints and integrals; returns count. */
size_t qdot_tangents_basis(qdot_tangents *x, double *basis);

#endif
