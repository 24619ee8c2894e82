/* first-order.h -- the motion near a state, to first order, with inputs: x' = A x + B u, y = C x + D u.
 *
 * The equations M(q, t) q'' = f(q, q', t, u) + G^T lambda and the constraints, each differentiated as often as its kind
 * asks,
 *
 *     phi(q, t) = 0,   g(q, q', t) = 0,   G q'' + gamma(q, q', t) = 0,
 *
 * are linearised about a state (q0, q0') that fulfils the constraints; q0'' and lambda0 follow from them. Gauss's
 * elimination divides the displacements of positions, velocities and accelerations into dependent and independent
 * ones, each level with the constraints that act on it:
 *
 *     dq = Nq y,   dq' = Cv y + Nv z,   dq'' = Ca (y, z) + Na w,      G Na = 0,
 *
 * and w follows from Na^T (M dq'' - df) = 0, without multipliers. The state is x = (y, z): the independent coordinates,
 * then the independent velocities; a velocity constraint binds a velocity and leaves its coordinate. Constraints that
 * repeat others are left out, after a check that they hold to first order along the others.
 *
 * A first-order unknown z' = g (mech/scene/state.c) is beside the motion one more input; then it is a state behind the
 * others, x = (y, z, unknowns), with the change of g as its row.
 *
 * Speeds u = E(q, q', t) may take the place of z: du = S z + P (others) is solved for z, and the row of u is the change of
 * dE/dt.
 *
 * Source  Peterson, Gede & Hubbard, "Symbolic linearization of equations of motion of constrained multibody systems",
 *         Multibody System Dynamics 33 (2015) 143.
 * Tests   tests/mech/linear/test_first_order.c
 */
#ifndef QDOT_MECH_FIRST_ORDER_H
#define QDOT_MECH_FIRST_ORDER_H

#include "mech/dynamics/speeds.h"
#include "mech/linear/rest.h"
#include "mech/scene/things.h"

typedef struct {
    qdot_expr place; /* a LIST of equations q = value, q' = value; velocities that are not named are 0, other coordinates
                      * keep their symbols */
    bool numbers;     /* compute with the values of `bind`, and round to 30 digits */
    qdot_binder bind; /* used only with `numbers` */
    void *user;
    const qdot_speeds *speeds; /* states in place of the independent velocities, which the place may name too; NULL: none */
} qdot_first_order_request;

typedef struct qdot_first_order {
    size_t states, inputs;
    qdot_expr *state;   /* [states] the symbols of the independent coordinates, then of the independent velocities or speeds,
                       * then the first-order unknowns */
    size_t n;           /* number of symbols that move with state and inputs */
    qdot_expr *symbol;  /* [n] q, q', q'', lambda, inputs, speeds and unknowns with their rates: */
    qdot_expr *value;   /* [n] their values at the state */
    qdot_expr *change;  /* [n x (states + inputs)] their changes, by rows */
    bool moves;         /* some q'' or q' of a coordinate in the equations is not 0 there: no rest */
} qdot_first_order;

/* QDOT_EINVAL: the state does not fulfil a constraint; QDOT_ESINGULAR: M or the constraints are singular there;
 * QDOT_ELIMIT: the expressions grow too long, or a constraint holds
 * for some values of the parameters only: numbers are needed; QDOT_EUNSET: a parameter has no value. */
QDOT_MUST_CHECK qdot_status qdot_first_order_about(qdot_scene *s, const qdot_first_order_request *request,
                                                   qdot_first_order *out);
void qdot_first_order_clear(qdot_first_order *x);

#endif
