/* start-speeds.c -- a start that gives speeds: the velocities at the beginning of a run. */
#include <math.h>

#include "expr/calculus.h"
#include "expr/symbol.h"
#include "lang/runs/request.h"
#include "lang/session/bind.h"
#include "lang/session/start-kind.h"
#include "lang/session/start-speeds.h"
#include "mech/scene/scene.h"

/* Fail unless the coordinates keep the holonomic constraints: beside speeds, whose meaning may depend on coordinates, these are
 * not solved for. */
static qdot_status
check_positions(qdot_session *session, const qdot_request *o)
{
    const qdot_scene *scene = session->scene;
    const qdot_expr t = QDOT_T;

    for (size_t k = 0; k < scene->constraints.n; k++) {
        const qdot_constraint *c = &scene->constraints.at[k];
        qdot_expr f;
        double distance;

        if (c->kind != QDOT_HOLONOMIC)
            continue;
        f = qdot_session_bind(session, c->f);
        if (f != QDOT_NIL)
            f = qdot_subs(session->pool, f, (uint32_t)scene->coordinates.n, scene->coordinates.at, o->q0.at);
        if (f != QDOT_NIL)
            f = qdot_subs(session->pool, f, 1, &t, &o->request.t0);
        QDOT_TRY(qdot_pool_check(session->pool));
        QDOT_TRY(qdot_session_number(session, f, &distance, NULL));
        if (!(fabs(distance) > 1e-12))
            continue;
        (void)qdot_fail(QDOT_EINVAL, "the start breaks constraint %.100s: left - right is %.6g, not 0, and beside speeds no "
                        "coordinate is solved for", c->name, distance);
        return qdot_hint("give coordinates that keep it");
    }
    return QDOT_OK;
}

qdot_status
qdot_request_speeds(qdot_session *session, qdot_request *o)
{
    const qdot_scene *scene = session->scene;

    if (!qdot_session_starts_by_speeds(session))
        return QDOT_OK;
    QDOT_TRY(check_positions(session, o));
    QDOT_TRY(qdot_session_start_velocities(session, 0, NULL, o->q0.at, o->request.t0, o->v0.at));
    for (size_t i = 0; i < scene->coordinates.n; i++)
        o->v_named.at[i] = qdot_scene_state_of(scene, scene->coordinates.at[i]) == NULL;
    return QDOT_OK;
}
