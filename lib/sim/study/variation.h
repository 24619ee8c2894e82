/* variation.h -- a scene together with its variational equations, as a scene of its own.
 *
 * Beside q it has coordinates y, the slopes of q by a number s: a parameter, or what moves the start.
 * From M q'' = f + A^T lambda and the constraints F(q'', q', q, t) = 0, A = dF/dq'',
 *
 *     M y'' - A^T mu = Df - DM q'' + DA^T lambda,     A y'' = -DF
 *
 *     D = sum y d/dq + y' d/dq' + d/ds    at fixed q'', lambda
 *
 * M (and, with constraints, A M^-1 A^T) is eliminated in symbols whose parts are held, so that the new
 * scene is q'' = a, y'' = b with M = 1: whatever integrates a scene integrates it, by Taylor series
 * too, with its error. Its constraints are f = 0 and Df = 0.
 *
 * An event whose `then` puts z = (q, q') to h(z, t) at g(z, t) = 0 puts
 *
 *     y to Dh + (dh/dt - F+) dt,   dt = -Dg/(dg/dt),   F+ = (q', q'') after it
 *
 * (saltation); velocities without mass follow from their equations (sim/model/massless-jump.h). Numbers of the request are put in exactly: the new scene has no parameters.
 *
 * Tests  tests/sim/study/test_variation.c, tests/script/studies/sensitivity.sh
 */
#ifndef QDOT_SIM_VARIATION_H
#define QDOT_SIM_VARIATION_H

#include "sim/study/variation-scene.h"

/* The scene for `request`, borrowed like `by` [k]; its start keeps the constraints, and q_named, v_named say which
 * values of it follow from them. held: its runs are projected onto the constraints; else they keep these as exactly
 * as q'' does, which is enough where a state on them is begun at again and again. Clear it in any case.
 * Errors: QDOT_ENOTBUILT: what is not carried (equations that jump, parameters set by events, ...), QDOT_ESINGULAR. */
QDOT_MUST_CHECK qdot_status qdot_variation_make(qdot_scene *scene,
                                                const qdot_run_request *request, size_t k,
                                                const qdot_variation_by *by, bool held,
                                                qdot_variation *v);
void qdot_variation_clear(qdot_variation *v);

#endif
