/* body.c -- the statement `body`: declares a rigid body, in the plane or in space. */
#include "lang/commands/warnings.h"
#include "lang/syntax/record.h"
#include "mech/scene/scene.h"

static qdot_status declare_body(qdot_record *r);

QDOT_STATEMENT(body) = {
    .word = "body",
    .group = QDOT_DECLARING,
    .usage = "body NAME mass M inertia I [about P] at R angle A | euler(PHI, THETA, PSI) | "
             "rotation MATRIX",
    .form = "body NAME mass M inertia I at R angle THETA; in space `euler(...)` or `rotation M`",
    .summary = "a rigid body, planar (angle) or spatial (euler, rotation); R is its centre of mass",
    .example = "body plate mass m inertia I at (x, y) angle theta",
    .handler = declare_body,
};

/* Read euler(phi, theta, psi) or `rotation MATRIX` into *rotation. */
static qdot_status
read_rotation(qdot_record *r, qdot_expr *rotation)
{
    const qdot_filled *euler = qdot_record_hole(r, "euler", NULL);
    const qdot_filled *matrix = qdot_record_hole(r, "rotation", NULL);
    qdot_pool *pool = r->cursor.session->pool;
    qdot_expr angle[3];

    if (euler != NULL && matrix != NULL) {
        const qdot_filled *second = euler < matrix ? matrix : euler;

        qdot_record_blame(r, second - 1);
        return qdot_fail(QDOT_EINVAL, "a body has `euler` or `rotation`, not both");
    }
    if (matrix != NULL)
        return qdot_record_value(r, matrix, rotation);
    if (euler == NULL)
        return QDOT_OK;
    for (size_t k = 0; k < 3; k++)
        QDOT_TRY(qdot_record_item(r, euler, k, &angle[k]));
    *rotation = qdot_scene_euler(pool, angle[0], angle[1], angle[2]);
    return qdot_pool_check(pool);
}

static qdot_status
read_rigid_body(qdot_record *r, qdot_body *body, qdot_expr *about)
{
    const qdot_filled *pivot = qdot_record_hole(r, "about", NULL);
    const qdot_filled *angle = qdot_record_hole(r, "angle", NULL);

    QDOT_TRY(qdot_record_scalar(r, qdot_record_hole(r, "mass", NULL), &body->mass));
    QDOT_TRY(qdot_record_value(r, qdot_record_hole(r, "inertia", NULL), &body->inertia));
    if (pivot != NULL)
        QDOT_TRY(qdot_record_point(r, pivot, about));
    QDOT_TRY(qdot_record_point(r, qdot_record_hole(r, "at", NULL), &body->position));
    if (angle != NULL)
        QDOT_TRY(qdot_record_scalar(r, angle, &body->angle));
    return read_rotation(r, &body->rotation);
}

static qdot_status
declare_body(qdot_record *r)
{
    qdot_session *session = r->cursor.session;
    qdot_body body = {0};
    qdot_expr about = QDOT_NIL;
    const char *name;

    QDOT_TRY(qdot_record_name(r, qdot_record_hole(r, NULL, "NAME"), &name));
    QDOT_TRY(read_rigid_body(r, &body, &about));
    r->cursor.error_at = r->start->start;
    if (body.angle != QDOT_NIL && body.rotation != QDOT_NIL)
        return qdot_fail(QDOT_EINVAL,
                         "a body has an `angle` (plane) or a rotation (space), not both");
    QDOT_TRY(qdot_scene_body(session->scene, name, &body, about));
    return qdot_warnings_mass(session, name, body.mass);
}
