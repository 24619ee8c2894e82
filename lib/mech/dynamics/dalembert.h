/* dalembert.h -- the terms of d'Alembert's principle, without second derivatives.
 *
 * d'Alembert's principle over the scalar functions x, y of (q, t) that make the kinetic
 * energy 1/2 sum w x' y' (a particle: m and each of its components; a body: its centre
 * and its axes, weighted by second moments):
 *
 *     sum w dy/dq_i x'' = Q_i
 *
 * For numerical runs only: the series of x'' is that of x, shifted (sim/form/residual.h).
 *
 * Tests  tests/sim/form/test_taylor.c: against M q'' = f
 */
#ifndef QDOT_MECH_DALEMBERT_H
#define QDOT_MECH_DALEMBERT_H

#include "mech/scene/scene.h"

typedef struct {
    qdot_expr w, x, y;
    int axis; /* the axis along which x = y is a position of the mass w; -1: it is no position */
} qdot_dalembert_term;

/* The terms [*n], owned by the caller, and Q_i, a VEC (a LIST for one coordinate), which
 * contains all applied forces, -dV/dq included. *n is 0 if this form does not apply: a stated
 * Lagrangian, potentials with velocities, masses that vary.
 * Errors: those of deriving. */
QDOT_MUST_CHECK qdot_status qdot_mech_dalembert(qdot_scene *s,
                                                qdot_dalembert_term **terms, size_t *n,
                                                qdot_expr *Q);

/* The same terms without derivatives by the coordinates, of which there are n for each term; and Q_i, a LIST, without what
 * has a potential, to which _potential gives the rest. */
QDOT_MUST_CHECK qdot_status qdot_mech_dalembert_terms(qdot_scene *s, qdot_dalembert_term **terms, size_t *n);
qdot_expr qdot_mech_dalembert_applied(qdot_scene *s);

/* V of this scene with given positions: sum -w g x of the terms with an axis, with x replaced by
 * places [n], plus the declared potentials. Nil: the pool keeps the failure. */
qdot_expr qdot_mech_dalembert_potential(qdot_scene *s, size_t n,
                                        const qdot_dalembert_term *terms,
                                        const qdot_expr *places);

#endif
