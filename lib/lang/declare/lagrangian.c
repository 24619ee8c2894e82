/* lagrangian.c -- the statement `lagrangian`: states the Lagrangian. */
#include "lang/syntax/record.h"
#include "mech/scene/scene.h"

static qdot_status declare_lagrangian(qdot_record *r);

QDOT_STATEMENT(lagrangian) = {
    .word = "lagrangian",
    .group = QDOT_DECLARING,
    .usage = "lagrangian L",
    .summary = "state the Lagrangian itself, in place of particles and bodies",
    .example = "lagrangian m*x'^2/2 - k*x^2/2",
    .handler = declare_lagrangian,
};

static qdot_status
declare_lagrangian(qdot_record *r)
{
    qdot_expr L;

    QDOT_TRY(qdot_record_scalar(r, qdot_record_hole(r, NULL, "L"), &L));
    r->cursor.error_at = r->start->start;
    return qdot_scene_lagrangian(r->cursor.session->scene, L);
}
