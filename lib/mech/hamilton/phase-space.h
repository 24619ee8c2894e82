/* phase-space.h -- a scene that states H alone, as the Lagrangian scene of its phase space.
 *
 *     L(q, p, q', t) = sum p_i q_i' - H(q, p, t),    Q_i applied along q_i
 *
 * with q and p as coordinates has Hamilton's equations q' = dH/dp, p' = -dH/dq + Q for its Lagrange equations, whatever H
 * is: no velocity is solved for p. So everything numerical goes on with a scene from whose H no Lagrangian of q
 * alone was found. The coordinate that is p[q] has that name; elsewhere p[q] is the symbol of the momentum.
 *
 * Source  Landau, Lifshitz, Mechanics, 43 (the principle of least action in p and q).
 * Tests   tests/mech/hamilton/test_phase_space.c, tests/script/derive/hamiltonian-runs.lag
 */
#ifndef QDOT_MECH_PHASE_SPACE_H
#define QDOT_MECH_PHASE_SPACE_H

#include "mech/scene/scene.h"
#include "mech/hamilton/phase-symbols.h"

/* What was in the scene before its phase space was entered, and what was found when it was entered first. All 0 at first. */
typedef struct {
    bool entered;
    qdot_scene before;
    uint64_t of, version[2]; /* versions of the scene and of its phase space, by L and by states, as long as the scene has
                                version `of` */
    qdot_expr L;
    qdot_vec(qdot_torque) torques; /* what acts along q, with q' = dH/dp: forces, and reactions of constraints */
    qdot_vec(qdot_eliminated) eliminated; /* [constraints] the multipliers in these reactions */
} qdot_phase_space;

/* Turn the scene into that of its phase space, until _leave; this does nothing if it was not turned. With `states` q and p
 * are first-order unknowns (qdot_scene_state) in place of the coordinates of L, for what is linear in them. Errors:
 * QDOT_ENOTBUILT, the scene has constraints beside `states` or events that change the state, or states of its own beside
 * `states`; those of the multipliers (phase-constraints.h). */
QDOT_MUST_CHECK qdot_status qdot_phase_space_enter(qdot_scene *s, bool states, qdot_phase_space *x);
void qdot_phase_space_leave(qdot_scene *s, qdot_phase_space *x);
void qdot_phase_space_clear(qdot_phase_space *x);

#endif
