/* body.c -- rigid bodies: R e_a are the body's axes in space, r the place of its centre.
 *
 *     r(P) = r + R P,    omega x = R' R^T,    v(X) = r' + omega x (X - r)
 */
#include "mech/scene/body.h"

#include <string.h>

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/function.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/tensor.h"
#include "mech/scene/access.h"
#include "mech/scene/rotation.h"
#include "normal/simplify/simplify.h"

static qdot_expr
rotation_about_axis(qdot_pool *pool, qdot_expr angle, uint32_t axis)
{
    qdot_expr c = qdot_fun1(pool, QDOT_COS, angle), s = qdot_fun1(pool, QDOT_SIN, angle);
    qdot_expr minus = qdot_neg(pool, s), e[9];
    uint32_t i = (axis + 1) % 3, j = (axis + 2) % 3;

    for (int k = 0; k < 9; k++)
        e[k] = QDOT_ZERO;
    e[4 * axis] = QDOT_ONE;
    e[3 * i + i] = e[3 * j + j] = c;
    e[3 * i + j] = minus;
    e[3 * j + i] = s;
    return qdot_matrix(pool, 3, 3, e);
}

qdot_expr
qdot_scene_euler(qdot_pool *pool, qdot_expr phi, qdot_expr theta, qdot_expr psi)
{
    qdot_expr R = qdot_value_mul(pool, rotation_about_axis(pool, phi, 2), rotation_about_axis(pool, theta, 0));

    return qdot_value_mul(pool, R, rotation_about_axis(pool, psi, 2));
}

qdot_expr
qdot_body_rotation_in_plane(qdot_pool *pool, qdot_expr angle)
{
    qdot_expr c = qdot_fun1(pool, QDOT_COS, angle), s = qdot_fun1(pool, QDOT_SIN, angle);
    qdot_expr e[4] = {c, qdot_neg(pool, s), s, c};

    return qdot_matrix(pool, 2, 2, e);
}

qdot_expr
qdot_body_steiner(qdot_pool *pool, qdot_expr mass, qdot_expr d)
{
    const qdot_expr square = qdot_dot(pool, d, d);
    qdot_expr e[9];

    if (qdot_mech_dimension(pool, d) == 2)
        return qdot_mul(pool, mass, square);
    for (uint32_t i = 0; i < 3; i++)
        for (uint32_t j = 0; j < 3; j++) {
            const qdot_expr product = qdot_mul(pool, qdot_expr_arg(pool, d, i), qdot_expr_arg(pool, d, j));

            e[3 * i + j] = qdot_mul(pool, mass, qdot_sub(pool, i == j ? square : QDOT_ZERO, product));
        }
    return qdot_matrix(pool, 3, 3, e);
}

/* Find a body's inertia as it is stored: a scalar, or a symmetric 3x3 MAT, about the centre of mass. */
static qdot_status
convert_inertia(qdot_scene *s, qdot_expr mass, qdot_expr given, qdot_expr about, bool plane,
                qdot_expr *inertia)
{
    qdot_pool *pool = s->pool;
    uint32_t dim = plane ? 2 : 3;
    qdot_expr I = given;

    if (about != QDOT_NIL && qdot_mech_dimension(pool, about) != dim)
        return qdot_fail(QDOT_ETYPE, "`about` takes a point of the body, %u components", dim);
    if (plane && !qdot_expr_is_scalar(pool, I))
        return qdot_fail(QDOT_ETYPE, "the inertia of a plane body is a number");
    if (!plane && qdot_expr_kind(pool, I) == QDOT_VEC && qdot_expr_count(pool, I) == 3) {
        qdot_expr e[9];

        for (uint32_t k = 0; k < 9; k++)
            e[k] = k % 4 ? QDOT_ZERO : qdot_expr_arg(pool, given, k / 4);
        I = qdot_matrix(pool, 3, 3, e);
    }
    QDOT_TRY(qdot_pool_check(pool));
    if (!plane && (qdot_expr_kind(pool, I) != QDOT_MAT || qdot_expr_count(pool, I) != 9 ||
                   qdot_expr_node(pool, I)->op != 3))
        return qdot_fail(QDOT_ETYPE,
                         "inertia is three moments or a symmetric 3x3 matrix");
    for (uint32_t i = 0; i < 3 && !plane; i++)
        for (uint32_t j = i + 1; j < 3; j++)
            if (qdot_expr_arg(pool, I, 3 * i + j) != qdot_expr_arg(pool, I, 3 * j + i))
                return qdot_fail(QDOT_ETYPE, "an inertia matrix must be symmetric");
    *inertia = about == QDOT_NIL ? I : qdot_value_sub(pool, I, qdot_body_steiner(pool, mass, about));
    return qdot_pool_check(pool);
}

/* Refuse an inertia of which a moment about the centre of mass is known to be negative. */
static qdot_status
check_moments(qdot_scene *s, qdot_expr inertia, bool moved)
{
    bool scalar = qdot_expr_is_scalar(s->pool, inertia);

    for (uint32_t k = 0; k < (scalar ? 1 : 9); k += 4) {
        qdot_expr moment = scalar ? inertia : qdot_expr_arg(s->pool, inertia, k);

        if ((qdot_expr_node(s->pool, moment)->sign & QDOT_NEG) != QDOT_NEG)
            continue;
        qdot_fail(QDOT_EDOMAIN, "a moment of inertia cannot be negative");
        return moved ? qdot_hint("about P it is at least m |P|^2") : QDOT_EDOMAIN;
    }
    return QDOT_OK;
}

qdot_status
qdot_scene_body(qdot_scene *s, const char *name, const qdot_body *body, qdot_expr about)
{
    const qdot_expr mass = body->mass, inertia = body->inertia, position = body->position;
    const qdot_expr angle = body->angle, rotation = body->rotation;
    qdot_pool *pool = s->pool;
    bool plane = rotation == QDOT_NIL || angle != QDOT_NIL;
    uint32_t space = qdot_scene_dimension(s), dim = qdot_mech_dimension(pool, position);
    uint32_t moves = QDOT_HAS_VELOCITY | QDOT_HAS_ACCELERATION | QDOT_HAS_MULTIPLIER |
                     QDOT_HAS_MOMENTUM | QDOT_HAS_DIFFERENTIAL | QDOT_HAS_DELTA;
    qdot_body b = {.mass = mass,
                   .position = position,
                   .rotation = rotation,
                   .inertia = QDOT_NIL,
                   .angle = plane ? angle : QDOT_NIL};

    qdot_scene_forget_dropped(s);
    QDOT_TRY(qdot_pool_check(pool));
    if (qdot_mech_stated(s))
        return qdot_fail(QDOT_EINVAL, "the scene states its Lagrangian: a body beside it "
                                      "would not count");
    QDOT_TRY(qdot_scene_need_new_label(s, name));
    if (mass == QDOT_NIL || inertia == QDOT_NIL || position == QDOT_NIL ||
        (plane && angle == QDOT_NIL))
        return qdot_fail(QDOT_EINVAL, "a body needs its mass, inertia, position and %s",
                         dim == 3 ? "rotation" : "angle");
    if (!qdot_expr_is_scalar(pool, mass) || (plane && !qdot_expr_is_scalar(pool, angle)))
        return qdot_fail(QDOT_ETYPE, "mass and angle of a body are numbers");
    if (dim != (plane ? 2u : 3u))
        return qdot_fail(QDOT_ETYPE, plane ? "a body with an angle is at (x, y)"
                                           : "a body with a rotation is at (x, y, z)");
    if (space && space != dim)
        return qdot_fail(QDOT_ETYPE, "a body in %u dimensions in a scene of %u", dim,
                         space);
    if (!plane &&
        (qdot_expr_kind(pool, rotation) != QDOT_MAT ||
         qdot_expr_count(pool, rotation) != 9 || qdot_expr_node(pool, rotation)->op != 3))
        return qdot_fail(QDOT_ETYPE, "a rotation in space is a 3x3 matrix");
    if ((qdot_mech_holds(s, mass) | qdot_mech_holds(s, position) |
         qdot_mech_holds(s, plane ? angle : rotation) | qdot_mech_holds(s, inertia) |
         qdot_mech_holds(s, about)) &
        moves)
        return qdot_fail(QDOT_EINVAL, "a body is placed by coordinates and t only");
    if ((qdot_mech_holds(s, inertia) | qdot_mech_holds(s, about)) & QDOT_HAS_COORD)
        return qdot_fail(QDOT_EINVAL, "inertia is fixed in the body: it cannot contain "
                                      "coordinates");
    QDOT_TRY(qdot_scene_refuse_delays(s, mass, "a mass"));
    QDOT_TRY(qdot_scene_refuse_delays(s, position, "a position"));
    QDOT_TRY(qdot_scene_refuse_delays(s, plane ? angle : rotation, plane ? "an angle" : "a rotation"));
    QDOT_TRY(qdot_scene_refuse_delays(s, inertia, "an inertia"));
    QDOT_TRY(qdot_scene_refuse_states(s, position, "a position", 0));
    QDOT_TRY(qdot_scene_refuse_states(s, plane ? angle : rotation, plane ? "an angle" : "a rotation", 0));
    QDOT_TRY(convert_inertia(s, mass, inertia, about, plane, &b.inertia));
    QDOT_TRY(check_moments(s, b.inertia, about != QDOT_NIL));
    if (plane)
        b.rotation = qdot_body_rotation_in_plane(pool, angle);
    QDOT_TRY(qdot_pool_check(pool));
    if (!plane)
        QDOT_TRY(qdot_rotation_check(s, rotation));
    QDOT_TRY(qdot_scene_copy_text(s, name, &b.name));
    QDOT_TRY(qdot_vec_push(&s->bodies, b));
    qdot_scene_changed(s);
    return QDOT_OK;
}

qdot_expr
qdot_scene_point(qdot_scene *s, const char *label, qdot_expr P)
{
    const qdot_body *b = qdot_scene_find_body(s, label);
    uint32_t dim;

    if (P == QDOT_NIL)
        return qdot_scene_position(s, label);
    if (!b && qdot_scene_find_particle(s, label))
        return qdot_mech_fail(s, QDOT_ETYPE,
                              "%s is a particle: it has no points of its own", label);
    if (!b)
        return qdot_mech_fail(s, QDOT_ENAME, "there is no body %s", label);
    dim = qdot_mech_dimension(s->pool, b->position);
    if (qdot_mech_dimension(s->pool, P) != dim)
        return qdot_mech_fail(s, QDOT_ETYPE, "a point of %s has %u components", label,
                              dim);
    return qdot_value_add(s->pool, b->position, qdot_value_mul(s->pool, b->rotation, P));
}

/* The axial vector of A R^T, where A is a derivative of R; in the plane A is the derivative of the angle. */
static qdot_expr
axial_vector(qdot_scene *s, const qdot_body *b, qdot_expr A)
{
    qdot_pool *pool = s->pool;
    qdot_facts facts = qdot_scene_facts(s);
    qdot_expr W = qdot_value_mul(pool, A, qdot_transpose(pool, b->rotation)), w[3];

    if (W == QDOT_NIL)
        return QDOT_NIL;
    w[0] = qdot_simplify(pool, qdot_expr_arg(pool, W, 3 * 2 + 1), &facts);
    w[1] = qdot_simplify(pool, qdot_expr_arg(pool, W, 3 * 0 + 2), &facts);
    w[2] = qdot_simplify(pool, qdot_expr_arg(pool, W, 3 * 1 + 0), &facts);
    return qdot_vector(pool, 3, w);
}

qdot_expr
qdot_body_partial_spin(qdot_scene *s, const qdot_body *b, qdot_expr q)
{
    if (b->angle != QDOT_NIL)
        return qdot_diff(s->pool, b->angle, q);
    return axial_vector(s, b, qdot_diff(s->pool, b->rotation, q));
}

qdot_expr
qdot_body_spin(qdot_scene *s, const qdot_body *b)
{
    if (b->angle != QDOT_NIL)
        return qdot_ddt(s->pool, b->angle);
    return axial_vector(s, b, qdot_ddt(s->pool, b->rotation));
}

qdot_expr
qdot_scene_spin(qdot_scene *s, const char *label)
{
    const qdot_body *b = qdot_scene_find_body(s, label);

    if (!b)
        return qdot_mech_fail(s, QDOT_ENAME, "there is no body %s", label);
    return qdot_body_spin(s, b);
}

/* The velocity of a point of a body: v + w x (place - r), with w a scalar in the plane. */
static qdot_expr
velocity_of_point(qdot_scene *s, const qdot_body *b, qdot_expr place, qdot_expr v, qdot_expr w)
{
    qdot_pool *pool = s->pool;
    qdot_expr arm = qdot_value_sub(pool, place, b->position), e[2];

    if (v == QDOT_NIL || w == QDOT_NIL || arm == QDOT_NIL)
        return QDOT_NIL;
    if (b->angle == QDOT_NIL)
        return qdot_value_add(pool, v, qdot_cross(pool, w, arm));
    e[0] = qdot_neg(pool, qdot_mul(pool, w, qdot_expr_arg(pool, arm, 1)));
    e[1] = qdot_mul(pool, w, qdot_expr_arg(pool, arm, 0));
    return qdot_value_add(pool, v, qdot_vector(pool, 2, e));
}

qdot_expr
qdot_body_partial_velocity(qdot_scene *s, const qdot_body *b, qdot_expr place, qdot_expr q)
{
    return velocity_of_point(s, b, place, qdot_diff(s->pool, b->position, q),
                             qdot_body_partial_spin(s, b, q));
}

qdot_expr
qdot_scene_velocity(qdot_scene *s, const char *label, qdot_expr place)
{
    qdot_pool *pool = s->pool;
    const qdot_body *b = qdot_scene_find_body(s, label);

    if (!b)
        return qdot_mech_fail(s, QDOT_ENAME, "there is no body %s", label);
    if (place == QDOT_NIL)
        return qdot_ddt(pool, b->position);
    if (qdot_mech_dimension(pool, place) != qdot_mech_dimension(pool, b->position))
        return qdot_mech_fail(s, QDOT_ETYPE,
                              "a place in the space of %s has %u components", label,
                              qdot_mech_dimension(pool, b->position));
    return velocity_of_point(s, b, place, qdot_ddt(pool, b->position), qdot_body_spin(s, b));
}
