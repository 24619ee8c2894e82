/* damper.c -- the statement `damper`: a force -C d' between two points whose distance is d. */
#include "lang/commands/warnings.h"
#include "lang/declare/objects.h"
#include "mech/scene/scene.h"

static qdot_status declare_damper(qdot_record *r);

QDOT_STATEMENT(damper) = {
    .word = "damper",
    .group = QDOT_DECLARING,
    .usage = "damper [NAME] between A, B coefficient C",
    .form = "damper NAME between A, B coefficient C",
    .summary = "pulls with -C d' along the line from A to B",
    .example = "damper d1 between bob, (0, 0) coefficient c",
    .handler = declare_damper,
};

static qdot_status
declare_damper(qdot_record *r)
{
    qdot_scene *scene = r->cursor.session->scene;
    qdot_link link = {0};

    QDOT_TRY(qdot_object_ends(r, &link));
    QDOT_TRY(qdot_record_scalar(r, qdot_record_hole(r, "coefficient", NULL), &link.stiffness));
    r->cursor.error_at = r->start->start;
    QDOT_TRY(qdot_scene_damper(scene, &link));
    return qdot_warnings_twice(r->cursor.session, QDOT_DAMPER);
}
