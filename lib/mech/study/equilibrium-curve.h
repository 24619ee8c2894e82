/* equilibrium-curve.h -- the equilibria of a scene as they depend on one parameter p.
 *
 *     F(u, p) = 0,   u: the coordinates that occur, then the multipliers
 *
 * are the equations at rest (mech/study/equilibrium.h) with values for all other parameters: as many
 * as unknowns, so that their solutions are curves. Beside them stands the motion about such a place,
 *
 *     M x'' + Gamma x' + H x + A^T mu = 0,   A x = 0,
 *
 * over all coordinates, functions of u and p at rest.
 *
 * Tests  tests/sim/branches/test_continuation.c
 */
#ifndef QDOT_MECH_EQUILIBRIUM_CURVE_H
#define QDOT_MECH_EQUILIBRIUM_CURVE_H

#include "base/memory.h"
#include "mech/study/equilibrium-search.h"
#include "mech/study/stability.h"

typedef struct {
    qdot_scene *s;
    qdot_pool *pool;
    qdot_expr parameter;
    qdot_binder bind; /* gives the values of all parameters except the free one */
    void *user;
    size_t n, coordinates; /* number of unknowns; how many of these are coordinates, which come first */
    qdot_expr *unknown;    /* [n + 1] the unknowns, then the parameter p */
    qdot_expr *F;          /* [n] equations of equilibrium, F = 0 */
    bool *angle;           /* [n] whether the unknown is an angle with period 2 pi */
    double *lo, *hi; /* [n + 1] bounds of the domains; infinite if a bound depends on p */
    qdot_expr *end;        /* [2 n] lower and upper bounds that depend on p; nil: constant bound */
    bool moving;           /* whether some bound of a domain depends on p */
    size_t all;            /* number of coordinates of the scene plus constraints */
    qdot_expr *K, *Gamma, *M; /* [all x all] stiffness H with constraint Jacobian A, A^T beside it; Gamma, M padded with 0 */
    bool damped;           /* Gamma is defined at rest, unlike for a damping force |v| v */
    qdot_rest rest;
    qdot_judge *judge;
    qdot_linear_roots roots; /* characteristic roots of the linearised motion; working memory */
} qdot_equilibrium_curve;

/* c is from {0}, and ended in any case. bind leaves p free. Errors: QDOT_EINVAL if p has no
 * influence, QDOT_ETYPE with constraints on velocities or a dependence on time, QDOT_EFAILED where
 * there are not as many equations as unknowns. */
QDOT_MUST_CHECK qdot_status qdot_equilibrium_curve_begin(qdot_equilibrium_curve *c, qdot_scene *s,
                                                         qdot_expr parameter, qdot_binder bind,
                                                         void *user);
void qdot_equilibrium_curve_end(qdot_equilibrium_curve *c);

/* A bound of the domain of unknown i at the parameter value p; NaN if undefined. */
double qdot_equilibrium_curve_end_of(const qdot_equilibrium_curve *c, size_t i, bool upper, double p);

/* Find the equilibria at the parameter value p: *at [count * (n + 1)] gets u, p of each; owned by
 * the caller. */
QDOT_MUST_CHECK qdot_status qdot_equilibrium_curve_starts(qdot_equilibrium_curve *c, double p,
                                                          double **at, size_t *count);

/* Judge the stability at y [n + 1], the unknowns and p; c->roots gets the roots of the linearised motion there. */
QDOT_MUST_CHECK qdot_status qdot_equilibrium_curve_judge(qdot_equilibrium_curve *c,
                                                         const double *y, qdot_stability *verdict);

#endif
