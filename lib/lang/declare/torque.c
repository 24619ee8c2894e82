/* torque.c -- the statement `torque`: declares a generalized force on a coordinate, or a torque on a body. */
#include "expr/node.h"
#include "lang/commands/warnings.h"
#include "lang/declare/objects.h"
#include "mech/scene/scene.h"

static qdot_status declare_torque(qdot_record *r);

QDOT_STATEMENT(torque) = {
    .word = "torque",
    .group = QDOT_DECLARING,
    .usage = "torque [NAME:] TAU on COORDINATE | on BODY",
    .summary = "a generalized force on a coordinate, or a torque on a body through its spin",
    .example = "torque tau on theta",
    .handler = declare_torque,
};

static qdot_status
declare_torque(qdot_record *r)
{
    qdot_session *session = r->cursor.session;
    const qdot_filled *target = qdot_record_hole(r, "on", NULL);
    qdot_torque torque = {.body = -1};
    const char *label, *on;

    QDOT_TRY(qdot_object_label(r, &label));
    torque.name = (char *)label;
    QDOT_TRY(qdot_record_point(r, qdot_record_hole(r, NULL, "TAU"), &torque.torque));
    QDOT_TRY(qdot_object_target(r, target,
                                qdot_expr_kind(session->pool, torque.torque) == QDOT_VEC,
                                &torque.coordinate, &on));
    if (on != NULL) {
        const qdot_body *body = qdot_scene_find_body(session->scene, on);

        if (body == NULL) {
            qdot_record_blame(r, target);
            (void)qdot_fail(QDOT_ETYPE, "`%s` is a particle: no torque acts on it", on);
            return qdot_hint("force F on %s", on);
        }
        torque.body = (int)(body - session->scene->bodies.at);
    }
    r->cursor.error_at = r->start->start;
    QDOT_TRY(qdot_scene_torque(session->scene, &torque));
    return qdot_warnings_twice(session, QDOT_TORQUE);
}
