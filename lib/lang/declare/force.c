/* force.c -- the statement `force`: an applied force on a particle, a body, a coordinate, or at a point. */
#include "expr/node.h"
#include "lang/commands/warnings.h"
#include "lang/declare/objects.h"
#include "mech/scene/scene.h"

static qdot_status declare_force(qdot_record *r);

QDOT_STATEMENT(force) = {
    .word = "force",
    .group = QDOT_DECLARING,
    .usage = "force [NAME:] F on PARTICLE | on COORDINATE | at POINT | on BODY at material POINT",
    .summary = "an applied force; it enters through virtual work; `at material`: on what is there of the "
               "body, as friction at a contact",
    .example = "force (0, -m*g) on bob",
    .handler = declare_force,
};

/* Read the point of `at POINT`, on which the force acts. */
static qdot_status
read_point_of_force(qdot_record *r, const qdot_filled *action, qdot_force *force)
{
    qdot_session *session = r->cursor.session;
    const qdot_filled *place = qdot_record_hole(r, "at", NULL);
    const char *body = NULL;

    QDOT_TRY(qdot_record_point(r, place, &force->point));
    QDOT_TRY(qdot_object_particle_or_body(r, place, 0, &force->on));
    if (force->on == NULL)
        QDOT_TRY(qdot_record_label_in(r, place, "point", &body));
    if (body != NULL && qdot_scene_find_body(session->scene, body) == NULL)
        body = NULL;
    r->cursor.error_at = r->start->start;
    QDOT_TRY(qdot_scene_force(session->scene, force));
    QDOT_TRY(qdot_warnings_twice(session, QDOT_FORCE));
    return force->on == NULL ? qdot_warnings_place(&r->cursor, force->point, body, action->from,
                                                   action->to)
                             : QDOT_OK;
}

/* Read `on NAME`, which acts at the centre, or `on BODY at material POINT`. */
static qdot_status
read_target_of_force(qdot_record *r, qdot_force *force)
{
    qdot_scene *scene = r->cursor.session->scene;
    const qdot_filled *place = qdot_record_hole(r, "material", NULL);

    force->material = place != NULL;
    if (place != NULL)
        QDOT_TRY(qdot_record_point(r, place, &force->point));
    else
        force->point = qdot_scene_position(scene, force->on);
    QDOT_TRY(qdot_pool_check(r->cursor.session->pool));
    if (place != NULL && qdot_scene_find_body(scene, force->on) == NULL)
        qdot_record_blame(r, qdot_record_word(r, "at"));
    else
        r->cursor.error_at = r->start->start;
    QDOT_TRY(qdot_scene_force(scene, force));
    return qdot_warnings_twice(r->cursor.session, QDOT_FORCE);
}

/* Add the force to the scene as a generalized force on a coordinate. */
static qdot_status
add_generalized_force(qdot_record *r, const qdot_force *force, bool vector, qdot_expr coordinate)
{
    const qdot_torque torque = {.name = force->name,
                                .torque = force->force,
                                .coordinate = coordinate,
                                .force = true,
                                .body = -1};
    const qdot_filled *at = qdot_record_word(r, "at");

    if (at != NULL)
        return qdot_record_expected(r, at->from, "the end of the statement");
    r->cursor.error_at = r->start->start;
    if (vector)
        return qdot_fail(QDOT_ETYPE, "a generalized force is a number, not a vector");
    QDOT_TRY(qdot_scene_torque(r->cursor.session->scene, &torque));
    return qdot_warnings_twice(r->cursor.session, QDOT_TORQUE);
}

static qdot_status
declare_force(qdot_record *r)
{
    const qdot_filled *action = qdot_record_hole(r, NULL, "F"), *on = qdot_record_hole(r, "on", NULL);
    qdot_force force = {0};
    const char *label, *target;
    qdot_expr coordinate;
    bool vector;

    QDOT_TRY(qdot_object_label(r, &label));
    force.name = (char *)label;
    QDOT_TRY(qdot_record_point(r, action, &force.force));
    if (on == NULL)
        return read_point_of_force(r, action, &force);
    vector = qdot_expr_kind(r->cursor.session->pool, force.force) == QDOT_VEC;
    QDOT_TRY(qdot_object_target(r, on, vector, &coordinate, &target));
    force.on = (char *)target;
    return target != NULL ? read_target_of_force(r, &force) : add_generalized_force(r, &force, vector, coordinate);
}
