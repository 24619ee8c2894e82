/* body-joint-rows.c -- where a joint is in each of its bodies, and the constraints that this gives. */
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/tensor.h"
#include "mech/scene/access.h"
#include "mech/scene/body-joint.h"
#include "mech/scene/body.h"

/* --- the reference configuration ------------------------------------------------------ */

static qdot_expr
tidy_scalar(qdot_pool *pool, qdot_expr e, void *user)
{
    (void)pool;
    return qdot_mech_tidy(user, e);
}

static qdot_expr
tidy(qdot_scene *s, qdot_expr e)
{
    return e == QDOT_NIL ? e : qdot_value_map(s->pool, e, tidy_scalar, s);
}

qdot_expr
qdot_body_joint_reference(qdot_scene *s, qdot_expr e)
{
    for (size_t i = 0; i < s->coordinates.n && e != QDOT_NIL; i++)
        e = qdot_subs(s->pool, e, 1, &s->coordinates.at[i], &(qdot_expr){QDOT_ZERO});
    return e == QDOT_NIL ? e : tidy(s, qdot_subs(s->pool, e, 1, &(qdot_expr){QDOT_T}, &(qdot_expr){QDOT_ZERO}));
}

/* The place and attitude of a body, or of the ground. */
typedef struct {
    qdot_expr position, rotation;
} pose;

static qdot_expr
unit_vector(qdot_pool *pool, uint32_t dim, uint32_t axis)
{
    qdot_expr e[3];

    for (uint32_t k = 0; k < dim; k++)
        e[k] = k == axis ? QDOT_ONE : QDOT_ZERO;
    return qdot_vector(pool, dim, e);
}

static pose
pose_of(qdot_scene *s, const qdot_joint_frames *x, int i)
{
    qdot_pool *pool = s->pool;
    qdot_expr zero[3] = {QDOT_ZERO, QDOT_ZERO, QDOT_ZERO}, one[9];

    if (x->body[i])
        return (pose){x->body[i]->position, x->body[i]->rotation};
    for (uint32_t k = 0; k < x->dim * x->dim; k++)
        one[k] = k % (x->dim + 1) == 0 ? QDOT_ONE : QDOT_ZERO;
    return (pose){qdot_vector(pool, x->dim, zero), qdot_matrix(pool, x->dim, x->dim, one)};
}

/* The axis e_k of which u is known not to be a multiple; dim: none is. */
static uint32_t
axis_aside(const qdot_pool *pool, qdot_expr u, uint32_t dim)
{
    for (uint32_t k = 0; k < dim; k++)
        if (qdot_expr_arg(pool, u, k) == QDOT_ZERO)
            return k;
    for (uint32_t k = 0; k < dim; k++)
        if (qdot_expr_sign(pool, qdot_expr_arg(pool, u, (k + 1) % dim)) & QDOT_NE0)
            return k;
    return dim;
}

/* The number of the only component of u that is not 0; dim: there are more. */
static uint32_t
axis_along(const qdot_pool *pool, qdot_expr u, uint32_t dim)
{
    uint32_t found = dim, others = 0;

    for (uint32_t k = 0; k < dim; k++)
        if (qdot_expr_arg(pool, u, k) != QDOT_ZERO) {
            found = k;
            others++;
        }
    return others == 1 ? found : dim;
}

/* Two vectors v, w at right angles to u and to each other; in the plane v alone, and w nil. */
static qdot_status
complete_axes(qdot_scene *s, qdot_expr u, qdot_expr *v, qdot_expr *w)
{
    qdot_pool *pool = s->pool;
    const uint32_t dim = qdot_mech_dimension(pool, u), along = axis_along(pool, u, dim), k = axis_aside(pool, u, dim);

    if (dim == 2) {
        qdot_expr e[2] = {qdot_neg(pool, qdot_expr_arg(pool, u, 1)), qdot_expr_arg(pool, u, 0)};

        *v = qdot_vector(pool, 2, e);
        *w = QDOT_NIL;
        return qdot_pool_check(pool);
    }
    if (along < dim) {
        *v = unit_vector(pool, 3, (along + 1) % 3);
        *w = unit_vector(pool, 3, (along + 2) % 3);
        return qdot_pool_check(pool);
    }
    if (k == dim) {
        qdot_fail(QDOT_EINVAL, "no component of the axis is known to differ from 0");
        return qdot_hint("`param a > 0` or `assume a > 0` says that a is not 0");
    }
    *v = qdot_cross(pool, u, unit_vector(pool, 3, k));
    *w = qdot_cross(pool, u, *v);
    return qdot_pool_check(pool);
}

/* A vector of components in space, in the reference configuration, in a body's axes. */
static qdot_expr
in_axes(qdot_scene *s, qdot_expr rotation, qdot_expr vector)
{
    return tidy(s, qdot_value_mul(s->pool, qdot_transpose(s->pool, rotation), vector));
}

/* The place of the joint in the axes of both bodies, which have the poses `at` in the reference configuration. */
static void
find_joint_places(qdot_scene *s, const qdot_body_joint *joint, const pose at[2], qdot_joint_frames *x)
{
    qdot_pool *pool = s->pool;

    for (int i = 0; i < 2; i++)
        x->place[i] = joint->place[1] != QDOT_NIL
                          ? joint->place[i]
                          : in_axes(s, at[i].rotation, qdot_value_sub(pool, joint->place[0], at[i].position));
}

/* A vector that is given as the axes of the joint are, in the axes of body i. */
static qdot_expr
given_in_axes(qdot_scene *s, const qdot_body_joint *joint, const pose at[2], int i, qdot_expr vector)
{
    return joint->place[1] != QDOT_NIL || vector == QDOT_NIL ? vector : in_axes(s, at[i].rotation, vector);
}

static qdot_status
find_axes(qdot_scene *s, const qdot_body_joint *joint, const pose at[2], qdot_joint_frames *x)
{
    qdot_pool *pool = s->pool;
    const qdot_expr to_B = qdot_transpose(pool, x->attitude);
    const qdot_expr u = joint->axis[0] == QDOT_NIL ? unit_vector(pool, x->dim, 0) : joint->axis[0];

    x->u[0] = given_in_axes(s, joint, at, 0, u);
    if (qdot_joint_kinds[joint->kind].axes == 2) { /* u of A, and v of B, at right angles to it */
        x->v[1] = given_in_axes(s, joint, at, 1, joint->axis[1]);
        x->v[0] = tidy(s, qdot_value_mul(pool, x->attitude, x->v[1]));
        if ((joint->place[1] == QDOT_NIL || joint->coordinate[0] != QDOT_NIL) && tidy(s, qdot_dot(pool, x->u[0], x->v[0])) != QDOT_ZERO)
            return qdot_fail(QDOT_EINVAL, "the axes of a universal joint are at right angles where all coordinates are 0");
        x->w[0] = qdot_cross(pool, x->u[0], x->v[0]);
    } else {
        QDOT_TRY(complete_axes(s, u, &x->v[0], &x->w[0]));
        x->v[0] = given_in_axes(s, joint, at, 0, x->v[0]);
        x->w[0] = given_in_axes(s, joint, at, 0, x->w[0]);
        x->v[1] = tidy(s, qdot_value_mul(pool, to_B, x->v[0]));
    }
    x->u[1] = tidy(s, qdot_value_mul(pool, to_B, x->u[0]));
    x->w[1] = x->dim == 2 ? QDOT_NIL : tidy(s, qdot_value_mul(pool, to_B, x->w[0]));
    return qdot_pool_check(pool);
}

qdot_status
qdot_body_joint_frames(qdot_scene *s, const qdot_body_joint *joint, qdot_joint_frames *x)
{
    pose at[2];

    *x = (qdot_joint_frames){.place = {joint->place[0], joint->place[1]}, .dim = qdot_mech_dimension(s->pool, joint->place[0])};
    for (int i = 0; i < 2; i++)
        x->body[i] = joint->end[i] ? qdot_scene_find_body(s, joint->end[i]) : NULL;
    if (joint->kind == QDOT_JOINT_OF_rolling)
        return QDOT_OK;
    for (int i = 0; i < 2; i++) {
        at[i] = pose_of(s, x, i);
        at[i] = (pose){qdot_body_joint_reference(s, at[i].position), qdot_body_joint_reference(s, at[i].rotation)};
    }
    if (qdot_pool_check(s->pool) != QDOT_OK || at[0].position == QDOT_NIL || at[1].position == QDOT_NIL ||
        at[0].rotation == QDOT_NIL || at[1].rotation == QDOT_NIL)
        return qdot_fail(QDOT_EDOMAIN, "a body of joint %s has no place where all coordinates and t are 0", joint->name);
    x->attitude = tidy(s, qdot_value_mul(s->pool, qdot_transpose(s->pool, at[0].rotation), at[1].rotation));
    find_joint_places(s, joint, at, x);
    return find_axes(s, joint, at, x);
}

bool
qdot_body_joint_is_at_one_place(qdot_scene *s, const qdot_body_joint *joint)
{
    const qdot_body *body[2];
    pose at[2];

    for (int i = 0; i < 2; i++) {
        body[i] = joint->end[i] ? qdot_scene_find_body(s, joint->end[i]) : NULL;
        if (!body[i] || !(qdot_mech_holds(s, body[i]->position) & QDOT_HAS_COORD))
            return false;
        at[i].position = qdot_body_joint_reference(s, body[i]->position);
    }
    return at[0].position == at[1].position;
}

/* --- constraints ------------------------------------------------------------------------ */

typedef struct {
    qdot_scene *s;
    const qdot_body_joint *joint;
    qdot_joint_frames x;
    qdot_expr d; /* from the joint's place in A to that in B */
    qdot_joint_row *rows;
    size_t n;
} work;

/* A vector that is fixed in body i, in space. */
static qdot_expr
in_space(const work *w, int i, qdot_expr vector)
{
    const qdot_body *body = w->x.body[i];

    return body ? qdot_value_mul(w->s->pool, body->rotation, vector) : vector;
}

static qdot_expr
joint_place(const work *w, int i)
{
    const qdot_body *body = w->x.body[i];

    return body ? qdot_value_add(w->s->pool, body->position, in_space(w, i, w->x.place[i])) : w->x.place[i];
}

static qdot_expr
no_torque(const work *w)
{
    qdot_expr zero[3] = {QDOT_ZERO, QDOT_ZERO, QDOT_ZERO};

    return w->x.dim == 2 ? QDOT_ZERO : qdot_vector(w->s->pool, 3, zero);
}

static qdot_expr
no_force(const work *w)
{
    qdot_expr zero[3] = {QDOT_ZERO, QDOT_ZERO, QDOT_ZERO};

    return qdot_vector(w->s->pool, w->x.dim, zero);
}

static void
add_row(work *w, qdot_expr f, qdot_expr force, qdot_expr torque)
{
    w->rows[w->n++] = (qdot_joint_row){f, force, torque};
}

/* All components of a vector, each a force along an axis of space. */
static void
add_components(work *w, qdot_expr vector)
{
    for (uint32_t k = 0; k < w->x.dim; k++)
        add_row(w, qdot_mech_component(w->s->pool, vector, k), unit_vector(w->s->pool, w->x.dim, k), no_torque(w));
}

/* The component of d along an axis of A. */
static void
add_slide(work *w, qdot_expr axis)
{
    const qdot_expr x = in_space(w, 0, axis);

    add_row(w, qdot_dot(w->s->pool, x, w->d), x, no_torque(w));
}

/* An axis of A stays at right angles to one of B. */
static void
add_right_angle(work *w, qdot_expr of_A, qdot_expr of_B)
{
    const qdot_expr x = in_space(w, 0, of_A), y = in_space(w, 1, of_B);

    add_row(w, qdot_dot(w->s->pool, x, y), no_force(w), qdot_cross(w->s->pool, y, x));
}

/* In the plane: the angle between the bodies is as in the reference configuration. */
static void
add_angle_in_plane(work *w)
{
    qdot_expr f = QDOT_ZERO;

    for (int i = 0; i < 2; i++)
        if (w->x.body[i]) {
            const qdot_expr angle = w->x.body[i]->angle, turned = qdot_sub(w->s->pool, angle, qdot_body_joint_reference(w->s, angle));

            f = i == 0 ? qdot_sub(w->s->pool, f, turned) : qdot_add(w->s->pool, f, turned);
        }
    add_row(w, f, no_force(w), QDOT_ONE);
}

static void
add_advance(work *w)
{
    qdot_pool *pool = w->s->pool;
    const qdot_expr u = in_space(w, 0, w->x.u[0]), twice_pi = qdot_mul(pool, qdot_expr_int(pool, 2), QDOT_PI);
    const qdot_expr length = qdot_norm(pool, w->x.u[0]), h = qdot_div(pool, w->joint->pitch, twice_pi);
    qdot_expr turning = QDOT_ZERO;

    for (int i = 0; i < 2; i++)
        if (w->x.body[i]) {
            const qdot_expr along = qdot_dot(pool, u, qdot_body_spin(w->s, w->x.body[i]));

            turning = i == 0 ? qdot_sub(pool, turning, along) : qdot_add(pool, turning, along);
        }
    add_row(w, qdot_div(pool, qdot_sub(pool, qdot_ddt(pool, qdot_dot(pool, u, w->d)), qdot_mul(pool, h, turning)), length),
            qdot_value_div(pool, u, length), qdot_value_mul(pool, qdot_neg(pool, qdot_div(pool, h, length)), u));
}

/* The difference of the velocities of the bodies' material at the place of contact. */
static void
add_contact(work *w)
{
    qdot_pool *pool = w->s->pool;
    qdot_expr slip = no_force(w);

    for (int i = 0; i < 2; i++)
        if (w->joint->end[i]) {
            const qdot_expr v = qdot_scene_velocity(w->s, w->joint->end[i], w->joint->place[0]);

            slip = i == 0 ? qdot_value_sub(pool, slip, v) : qdot_value_add(pool, slip, v);
        }
    add_components(w, slip);
}

qdot_status
qdot_body_joint_rows(qdot_scene *s, const qdot_body_joint *joint, qdot_joint_row rows[QDOT_JOINT_ROWS], size_t *n)
{
    const qdot_joint_kind *kind = &qdot_joint_kinds[joint->kind];
    work w = {.s = s, .joint = joint, .rows = rows};
    unsigned fixes;

    QDOT_TRY(qdot_body_joint_frames(s, joint, &w.x));
    fixes = w.x.dim == 2 ? kind->plane : kind->space;
    w.d = fixes & QDOT_JOINT_CONTACT ? QDOT_NIL : qdot_value_sub(s->pool, joint_place(&w, 1), joint_place(&w, 0));
    if (fixes & QDOT_JOINT_MEET)
        add_components(&w, w.d);
    if (fixes & QDOT_JOINT_ACROSS) {
        add_slide(&w, w.x.v[0]);
        if (w.x.dim == 3)
            add_slide(&w, w.x.w[0]);
    }
    if (fixes & QDOT_JOINT_ALONG)
        add_slide(&w, w.x.u[0]);
    if (fixes & QDOT_JOINT_PARALLEL) {
        add_right_angle(&w, w.x.v[0], w.x.u[1]);
        add_right_angle(&w, w.x.w[0], w.x.u[1]);
    }
    if (fixes & QDOT_JOINT_TURN) {
        if (w.x.dim == 2)
            add_angle_in_plane(&w);
        else
            add_right_angle(&w, w.x.w[0], w.x.v[1]);
    }
    if (fixes & QDOT_JOINT_CROSS)
        add_right_angle(&w, w.x.u[0], w.x.v[1]);
    if (fixes & QDOT_JOINT_ADVANCE)
        add_advance(&w);
    if (fixes & QDOT_JOINT_CONTACT)
        add_contact(&w);
    *n = w.n;
    return qdot_pool_check(s->pool);
}
