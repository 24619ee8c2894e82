/* steady-momenta.h -- the stability of a steady motion at fixed momenta of its cyclic coordinates. Internal to mech/study.
 *
 * With L(q, w) at q' = 0 of the other coordinates q and at rates w of the cyclic ones, the energy at fixed momenta
 * p = dL/dw has the second derivatives
 *
 *     H = -L_qq + L_qw (L_ww)^-1 L_wq
 *
 * at the steady motion. Where H is positive definite the motion is stable, whether p is disturbed or not, as near p there is
 * another steady motion near by; of one coordinate, where it is negative, unstable.
 *
 * Source  Routh, Advanced Part of the Dynamics of a System of Rigid Bodies, 3; Salvadori, Rend. Accad. Sci. Napoli 20 (1953) 269.
 * Tests   tests/script/linear/steady.lag, steady-rates.lag
 */
#ifndef QDOT_MECH_STEADY_MOMENTA_H
#define QDOT_MECH_STEADY_MOMENTA_H

#include "mech/linear/rest.h"
#include "mech/scene/things.h"

/* Whether L and the energy tell everything: no constraints, nothing applied beside V, energy conserved. */
QDOT_MUST_CHECK qdot_status qdot_steady_is_conservative(qdot_scene *s, bool *is);
/* Judge e, whose rates are equations of velocities of the n cyclic coordinates turning, if H decides; else it stays as it is. */
QDOT_MUST_CHECK qdot_status qdot_steady_at_momenta(qdot_scene *s, size_t n, const qdot_expr *turning, qdot_equilibrium *e);

#endif
