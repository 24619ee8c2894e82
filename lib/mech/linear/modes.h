/* modes.h -- finds normal modes of small oscillations about an equilibrium.
 *
 *     M y'' + Gamma y' + H y = 0,   y = Re(a e^(i w t)),   (H - w^2 M + i w Gamma) a = 0,
 *
 * y in the tangent space of the constraints, of velocities too. Without Gamma the amplitudes are real, and those of different
 * modes orthogonal in M; modes of one frequency are even or odd under the symmetries of M and H (modes-symmetry.c). They are
 * exact if the characteristic polynomial of each part factors into linear and quadratic ones in w^2, or M and H are
 * those of a uniform chain or ring (modes-chain.c); else numbers. With an antisymmetric Gamma (rotation, magnetic fields) amplitudes
 * are complex (modes-gyroscopic.c).
 *
 * Source  Goldstein, Poole, Safko, Classical Mechanics, chapter 6; Wigner, Group Theory, chapter 12.
 * Tests   tests/mech/linear/test_modes.c
 */
#ifndef QDOT_MECH_MODES_H
#define QDOT_MECH_MODES_H

#include "mech/scene/things.h"
#include "mech/linear/rest.h"

/* About `equations`: frequencies w [n] ascending (unordered: the order of some pairs is not proved; they are ordered as at
 * one set of parameter values), amplitudes a [n * coordinates], a row each, scaled so that the
 * first component that is not 0 is 1; a complex one is a LIST [re, im]. Exact, or (at once, if `numbers`) numbers, which
 * need every parameter's value. QDOT_ETYPE with damping, QDOT_EDOMAIN where a frequency is not real. */
typedef struct {
    size_t n;
    qdot_expr *frequency, *amplitude;
    bool numeric, unordered;
} qdot_modes;
QDOT_MUST_CHECK qdot_status qdot_modes_about(qdot_scene *s, qdot_expr equations,
                                             bool numbers, qdot_binder bind, void *user,
                                             qdot_modes *out);
void qdot_modes_clear(qdot_modes *m);

/* Append to *place, a LIST of equations, those multipliers that it does not give and that the equations of motion determine
 * at rest there. */
QDOT_MUST_CHECK qdot_status qdot_rest_multipliers(qdot_scene *s, qdot_expr *place);

#endif
