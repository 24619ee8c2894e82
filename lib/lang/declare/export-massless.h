/* export-massless.h -- the equations of motion of a scene for other programs, also of coordinates without mass.
 *
 * Row i of M q'' = f is 0 = f_i(q, q', t) where no mass moves with coordinate i and no constraint holds it. Other programs
 * get the rate of f_i that holds q'', linear in these (sim/model/massless.h):
 *
 *     M_ij = dF/dq''_j,   f_i = -F at q'' = 0,   F = df_i/dt, or d^2 f_i/dt^2 where f_i holds no velocity of such coordinates
 *
 * which is right from a start where f_i = 0 (and its rate) is, up to where f_i jumps (or, of positions, has a kink): that is
 * refused. The rate of a first-order state may jump: other programs get it for itself, as z' = rate.
 *
 * Tests  tests/meta/exports.test, tests/bad/massless/massless-export-switch.lag
 */
#ifndef QDOT_LANG_EXPORT_MASSLESS_H
#define QDOT_LANG_EXPORT_MASSLESS_H

#include "mech/scene/scene.h"

/* Write M [n x n], f [n]; *any: there are massless coordinates beside states. QDOT_ENOTBUILT: a value determined
 * by one may jump. */
QDOT_MUST_CHECK qdot_status qdot_export_massless(qdot_scene *scene, qdot_expr *M, qdot_expr *f, bool *any);

/* What an event puts, with what follows from it by their equations (sim/model/massless-jump.h), as targets and values of
 * `own`; its lists are the caller's, to be freed in any case. */
QDOT_MUST_CHECK qdot_status qdot_export_event_with_massless(qdot_scene *scene, const qdot_event *event, qdot_event *own);

#endif
