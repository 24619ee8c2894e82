/* steady-parts.h -- the equations of motion in independent velocities, as the files of reduced steady motions share them.
 *
 * Source  Neimark & Fufaev, Dynamics of Nonholonomic Systems, III.
 */
#ifndef QDOT_MECH_STEADY_PARTS_H
#define QDOT_MECH_STEADY_PARTS_H

#include "mech/linear/elimination.h"
#include "mech/linear/rest.h"
#include "mech/scene/things.h"

/* q' = N(q) u, M(q) u' + R(q, u, z) = 0 of coordinates q and of first-order unknowns z, z' = g(q, u, z). */
typedef struct {
    qdot_scene *s;
    qdot_pool *pool;
    qdot_facts facts;
    qdot_elimination x;
    size_t n, m, states;
    qdot_expr *q;       /* [n] coordinates that are no first-order unknowns */
    size_t *own;        /* [n] index of each in the scene */
    size_t *order;      /* [n] the coordinates, those that nothing holds first */
    size_t *independent; /* [m] coordinates whose velocities are u, or parts of u = q'/D(q) where N would have poles at D = 0 */
    qdot_expr *u;       /* [m] those velocities, or parameters */
    qdot_expr *N, *M, *R; /* [n x m], [m x m], [m] */
    qdot_expr *g;       /* [states] */
    bool *rests;        /* [n] the equations hold the coordinate */
    bool *kept;         /* [constraints] none that repeats others */
    size_t bound;       /* number of holonomic ones of these between coordinates that rest */
} qdot_reduced;

/* keep: a velocity that is one of u if it is independent, whatever the poles; nil: none. qdot_reduced_end also after a failure.
 * QDOT_ENOTBUILT: forces hold t or multipliers, constraints move by themselves. */
QDOT_MUST_CHECK qdot_status qdot_reduced_begin(qdot_reduced *r, qdot_scene *s, qdot_expr keep);
void qdot_reduced_end(qdot_reduced *r);

/* Whether u_a is no velocity. Whether it may be constant: it moves some coordinate that does not rest. */
bool qdot_reduced_is_scaled(const qdot_reduced *r, size_t a);
bool qdot_reduced_turns(const qdot_reduced *r, size_t a);
/* (N u)_i */
qdot_expr qdot_reduced_velocity(const qdot_reduced *r, size_t i);
/* e where the coordinates that rest do, simplified; nil stays nil. */
qdot_expr qdot_reduced_resting(const qdot_reduced *r, qdot_expr e);

/* --- stability (steady-linear.c) ----
 * By the roots s of p(s) = det [s - d(q', z')/d(q, z), -d(q', z')/du; dR/d(q, z), s M + dR/du], q those that rest. The motion
 * belongs to a family: `free` of its values are free, or there are `regular` more unknowns than equations, where these are
 * independent (they are if s = 0 is no more often a root). s = 0 is a root as often at least as the family has dimensions,
 * and once more for each holonomic constraint, which may be off by a constant. Where it is no more often, and all other roots
 * have negative real parts, the motion is stable (Lyapunov and Malkin); imaginary roots of an even p leave it stable to first
 * order.
 * values: a LIST of equations, of the coordinates that rest, first-order unknowns and u.
 * Source  Malkin, Theory of Stability of Motion, 4; Neimark & Fufaev, VI. */
QDOT_MUST_CHECK qdot_status qdot_reduced_judge(const qdot_reduced *r, qdot_expr values, size_t free, size_t regular,
                                               qdot_equilibrium *one);

#endif
