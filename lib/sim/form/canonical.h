/* canonical.h -- Hamilton's equations for numbers of many digits.
 *
 *     q_i' = dH/dp_i,   p_i' = -dH/dq_i + Q_i(q, q', t)
 *
 * with H(q, p, t) of mech/hamilton/hamilton.h, the values put in, and Q what is applied beside the
 * potentials. No matrix is solved, no product of velocities formed, and the momentum of a cyclic
 * coordinate is a number: Kepler's problem in the plane takes 2.5 convolutions an order where
 * M q'' = f takes 5, a spherical pendulum 5.5 and 7.5. The state stays q, q': momenta are found
 * where an expansion begins.
 *
 * Source  Goldstein, Poole, Safko, Classical Mechanics, 8.1.
 * Tests   tests/sim/form/test_motion.c
 */
#ifndef QDOT_SIM_CANONICAL_H
#define QDOT_SIM_CANONICAL_H

#include "mech/scene/scene.h"
#include "series/motion.h"
#include "sim/model/equations.h"

struct qdot_canonical {
    size_t n, moving;   /* number of coordinates; how many of their momenta are not constant */
    size_t *place;      /* [n] coordinates in the order of momenta: first those whose p varies */
    qdot_tape *momenta; /* tape from q, q', t to the momenta p [n], in this order */
    qdot_tape *rates; /* tape from q, t, p (in this order) to dH/dp [n], then -dH/dq of the varying momenta */
    qdot_tape *forces;  /* tape from q, q', t to the forces Q on the varying momenta; NULL: none */
    qdot_motion motion; /* series program with the inputs q, q', t, p in this order */
};

/* Of a plan with M and f and without constraints, switches or further states, where M's blocks are
 * of one or two coordinates and not all numbers; *canonical NULL elsewhere, and where H has no
 * form that can be had. Errors: those of the pool, QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_canonical_new(qdot_scene *scene, const qdot_plan *plan,
                                               qdot_canonical **canonical);
void qdot_canonical_free(qdot_canonical *canonical);

#endif
