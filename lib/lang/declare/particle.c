/* particle.c -- the statement `particle`: declares a mass point at a position r(q, t). */
#include "lang/commands/warnings.h"
#include "lang/syntax/record.h"
#include "mech/scene/scene.h"

static qdot_status declare_particle(qdot_record *r);

QDOT_STATEMENT(particle) = {
    .word = "particle",
    .group = QDOT_DECLARING,
    .usage = "particle NAME mass M at R",
    .summary = "a mass point at r(q, t), in 1, 2 or 3 dimensions",
    .example = "particle bob mass m at (x, y)",
    .handler = declare_particle,
};

static qdot_status
declare_particle(qdot_record *r)
{
    qdot_session *session = r->cursor.session;
    const qdot_filled *place = qdot_record_hole(r, "at", "R");
    qdot_expr mass, position;
    const char *name;

    QDOT_TRY(qdot_record_name(r, qdot_record_hole(r, NULL, "NAME"), &name));
    QDOT_TRY(qdot_record_scalar(r, qdot_record_hole(r, "mass", "M"), &mass));
    QDOT_TRY(qdot_record_point(r, place, &position));
    r->cursor.error_at =
        qdot_scene_has_label(session->scene, name) ? r->start->start : place->from->start;
    QDOT_TRY(qdot_scene_particle(session->scene, name, mass, position));
    return qdot_warnings_mass(session, name, mass);
}
