/* phase-space.h -- canonical momenta of a plan, for methods that are symplectic in (q, p).
 *
 *     p = dL/dq' = M(q, t) q' + b(q, t)          so   M q' = p - b
 *     p' = M q'' + sum_j dp/dq_j q_j' + dp/dt,    M q'' = f
 *
 * Where M is a matrix of numbers and b does not depend on q, q' itself will do. Constraints g(q, t) = 0
 * add A^T lambda to p' (qdot_ode_bonds), and then p is always made.
 *
 * Source  Goldstein, Poole, Safko, Classical Mechanics, 8.1.
 * Tests   tests/sim/form/test_phase-space.c
 */
#ifndef QDOT_SIM_PHASE_SPACE_H
#define QDOT_SIM_PHASE_SPACE_H

#include "mech/scene/scene.h"
#include "ode/system.h"
#include "sim/model/equations.h"

/* Tapes of a plan from q [n], q' [n], t to canonical momenta, masses and forces. */
struct qdot_phase_space {
    size_t n;
    qdot_tape *momenta; /* outputs: momenta p [n] */
    qdot_tape *masses; /* outputs: b [n], then the lower triangle of M by rows; p = M q' + b; neither depends on q' */
    qdot_tape *forces;  /* outputs: time derivatives p' [n] of the momenta */
};

/* Of a plan with M and f; *space NULL where q' itself will do. QDOT_ENOTBUILT:
 * M depends on q'; those of the pool, QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_phase_space_new(qdot_scene *scene, const qdot_plan *plan,
                                                 qdot_phase_space **space);
void qdot_phase_space_free(qdot_phase_space *space);

/* A phase space with work space of its own, to be used by one thread. */
typedef struct qdot_phase qdot_phase;
QDOT_MUST_CHECK qdot_status qdot_phase_new(const qdot_phase_space *space, qdot_phase **phase);
void qdot_phase_free(qdot_phase *phase);
/* The callbacks for the integrator (ode); valid as long as the phase exists. */
const qdot_ode_phase *qdot_phase_get(const qdot_phase *phase);

#endif
