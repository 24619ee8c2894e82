/* components.h -- tensors answered by their components, named by coordinates.
 *
 *     Γ[r; θ, θ] = −r       christoffel, riemann and ricci by their letters
 *     Γ[θ; r, θ] = 1/r
 *     Γ[i; k, j] = Γ[i; j, k]; all others are 0
 *
 * In the plain and flat styles by the name that was typed, christoffel(R)[r, theta, theta], which is read back.
 *
 * Tests  tests/script/geometry/geometry.lag, tests/script/derive/components.lag
 */
#ifndef QDOT_LANG_COMPONENTS_H
#define QDOT_LANG_COMPONENTS_H

#include "lang/session/parts.h"

/* Whether the value is a tensor over these coordinates (a LIST, or nil) that is answered so: a list of
 * matrices, a list of such lists, or ricci(...). */
bool qdot_components_are(const qdot_session *session, const char *name, qdot_expr value,
                         qdot_expr over);

QDOT_MUST_CHECK qdot_status qdot_components_answer(qdot_session *session,
                                                   const char *name, qdot_expr value,
                                                   qdot_expr over);

#endif
