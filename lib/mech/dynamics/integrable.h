/* integrable.h -- finds velocity constraints that can be integrated to holonomic ones
 * (Frobenius).
 *
 * A constraint linear in the velocities is a form w = sum a_i(q, t) dq_i + a_0 dt = 0. It
 * is integrable alone when
 *
 *     w ^ dw = 0,
 *
 * that is when dw(u, v) = 0 for all u, v with w(u) = w(v) = 0; then there is an
 * integrating factor mu and mu w = dF, so that F(q, t) = const. With other constraints
 * w_1 ... w_m (and the differentials of the holonomic ones) u and v are taken from the common
 * null space of all; forms whose dw does not vanish there are removed, repeatedly: the remaining
 * ones are integrable.
 *
 * Integrating factors tried: 1, 1/a_i, and functions of one coordinate z, for which
 * dw = -h'(z) dz ^ w.
 *
 * Source  Frankel, The Geometry of Physics, 3rd ed., sec. 6.1; Neimark & Fufaev, Dynamics
 *         of Nonholonomic Systems, ch. I.
 * Tests   tests/script/constraints/integrable.lag, tests/bad/constraints/integrable-*.lag
 */
#ifndef QDOT_MECH_INTEGRABLE_H
#define QDOT_MECH_INTEGRABLE_H

#include "mech/scene/things.h"
#include "normal/prove/decide.h"

typedef struct {
    /* For the worst component of dw on the null space of the constraints; refuted: it does not
     * vanish, with a point and its value there (left; right is 0). */
    qdot_decision decision;
    qdot_expr component;   /* if refuted: a component of dw that is not 0; else nil */
    qdot_expr along[2];    /* if refuted: the two coordinates (or t) of that component of dw */
    bool alone;            /* if proved: whether without using other constraints */
    qdot_expr integral;    /* if proved: the integral F; nil if none was found */
    qdot_expr factor; /* integrating factor mu, mu f = dF/dt; nil if other constraints were needed */
} qdot_integrability;

/* For constraint k of the scene. alone: without the others. Errors: QDOT_EINVAL:
 * it is no velocity constraint or not linear in the velocities; the pool's. */
QDOT_MUST_CHECK qdot_status qdot_mech_integrable(qdot_scene *s, size_t k, bool alone,
                                                 qdot_integrability *result);

/* Whether the velocity constraints of the scene, all together, are holonomic ones whose surfaces
 * do not move: each is linear in the velocities and vanishes without them, holds no t, and dw = 0
 * on the common null space of all. False also where that is not proved. */
QDOT_MUST_CHECK qdot_status qdot_mech_integrable_all(qdot_scene *s, bool *yes);

#endif
