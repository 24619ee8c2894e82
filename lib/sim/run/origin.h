/* origin.h -- a run far from t = 0 beside its length, from t0 to t1, as one from 0 on of the scene in s = t - origin.
 *
 * The origin is the double at t0. The scene is written in s where t stands in it, and put back at the end. With
 * `digits` numbers are as long as they have to be: nothing is done.
 *
 * Tests  tests/sim/run/test_far.c, tests/script/events/far.lag
 */
#ifndef QDOT_SIM_ORIGIN_H
#define QDOT_SIM_ORIGIN_H

#include "mech/scene/saved.h"
#include "sim/model/request.h"

/* A request that counts time as s = t - origin, from near the start. Start from {0}. */
typedef struct {
    qdot_run_request request; /* the request with times s; it borrows from the given one */
    double origin;            /* the time at s = 0; 0: nothing was changed */
    qdot_scene *scene;        /* the scene in terms of s; NULL: t does not occur in the scene */
    qdot_scene_saved saved;
    qdot_expr *values; /* the values of parameters in terms of s; then the original ones that events assign */
} qdot_origin;

/* Rewrite scene and request in s; call qdot_origin_end in any case. Errors: those of constants, QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_origin_begin(qdot_origin *o, qdot_scene *scene, const qdot_run_request *asked);
void qdot_origin_end(qdot_origin *o);

#endif
