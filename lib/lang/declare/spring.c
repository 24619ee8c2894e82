/* spring.c -- the statement `spring`: the potential K/2 (d - L)^2 of two points at the distance d. */
#include "lang/commands/value-check.h"
#include "lang/commands/warnings.h"
#include "lang/declare/objects.h"
#include "mech/scene/scene.h"

static qdot_status declare_spring(qdot_record *r);

QDOT_STATEMENT(spring) = {
    .word = "spring",
    .group = QDOT_DECLARING,
    .usage = "spring [NAME] between A, B stiffness K [rest L]",
    .form = "spring NAME between A, B stiffness K rest L",
    .summary = "V = K/2 (d - L)^2, d the distance of A and B (particles, points, vectors)",
    .example = "spring s1 between bob, (0, 0) stiffness k rest L0",
    .handler = declare_spring,
};

static qdot_status
declare_spring(qdot_record *r)
{
    qdot_session *session = r->cursor.session;
    const qdot_filled *rest = qdot_record_hole(r, "rest", NULL);
    qdot_link link = {.rest = QDOT_ZERO};

    QDOT_TRY(qdot_object_ends(r, &link));
    QDOT_TRY(qdot_record_scalar(r, qdot_record_hole(r, "stiffness", NULL), &link.stiffness));
    if (rest != NULL) {
        QDOT_TRY(qdot_record_scalar(r, rest, &link.rest));
        QDOT_TRY(qdot_value_check_rest(session, link.name, link.rest));
    }
    r->cursor.error_at = r->start->start;
    QDOT_TRY(qdot_scene_spring(session->scene, &link));
    return qdot_warnings_twice(session, QDOT_SPRING);
}
