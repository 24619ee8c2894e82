/* body-joint-place.c -- the second body of a joint that names its coordinates is placed by these. */
#include "expr/build.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/tensor.h"
#include "mech/scene/access.h"
#include "mech/scene/body-joint.h"
#include "mech/scene/body.h"

/* The rotation by an angle about u: 1 cos a + [u] sin a + u u^T (1 - cos a), u of length 1. */
static qdot_expr
rotation_about(qdot_pool *pool, qdot_expr u, qdot_expr angle)
{
    const qdot_expr c = qdot_fun1(pool, QDOT_COS, angle), s = qdot_fun1(pool, QDOT_SIN, angle);
    const qdot_expr rest = qdot_sub(pool, QDOT_ONE, c);
    qdot_expr e[9];

    if (u == QDOT_NIL || qdot_pool_check(pool) != QDOT_OK)
        return QDOT_NIL;
    for (uint32_t i = 0; i < 3; i++)
        for (uint32_t j = 0; j < 3; j++) {
            const uint32_t k = 3 - i - j; /* the third axis, where i and j differ */
            const qdot_expr product = qdot_mul(pool, qdot_expr_arg(pool, u, i), qdot_expr_arg(pool, u, j));
            const qdot_expr turned = i == j ? c : qdot_mul(pool, qdot_expr_arg(pool, u, k), s);

            e[3 * i + j] = qdot_add(pool, qdot_mul(pool, product, rest),
                                    i == j || (i + 1) % 3 != j ? turned : qdot_neg(pool, turned));
        }
    return qdot_matrix(pool, 3, 3, e);
}

static qdot_expr
unit_along(qdot_scene *s, qdot_expr u)
{
    return qdot_value_div(s->pool, u, qdot_mech_tidy(s, qdot_norm(s->pool, u)));
}

/* What of the scene acts on the body by its label, or is fastened to it by a place that was taken before. */
static bool
is_used(const qdot_scene *s, const char *label)
{
    bool used = false;

    for (size_t i = 0; i < s->springs.n; i++)
        used |= qdot_label_is(s->springs.at[i].end[0], label) || qdot_label_is(s->springs.at[i].end[1], label);
    for (size_t i = 0; i < s->dampers.n; i++)
        used |= qdot_label_is(s->dampers.at[i].end[0], label) || qdot_label_is(s->dampers.at[i].end[1], label);
    for (size_t i = 0; i < s->forces.n; i++)
        used |= qdot_label_is(s->forces.at[i].on, label);
    for (size_t i = 0; i < s->joints.n; i++)
        used |= qdot_label_is(s->joints.at[i].end[0], label) || qdot_label_is(s->joints.at[i].end[1], label);
    return used;
}

static qdot_status
check_second_body(qdot_scene *s, const qdot_body_joint *j, const qdot_body *b)
{
    if (!b) {
        qdot_fail(QDOT_EINVAL, "the coordinate of joint %s places the second body, and that is the ground", j->name);
        return qdot_hint("between ground, %.60s", j->end[0]);
    }
    if (qdot_body_joint_moves(s, b->name)) {
        qdot_fail(QDOT_EINVAL, "%s moves by coordinates already, so joint %s cannot place it", b->name, j->name);
        return qdot_hint("without its coordinate the joint becomes constraints");
    }
    for (int k = 0; k < 3 && j->coordinate[k] != QDOT_NIL; k++)
        QDOT_TRY(qdot_scene_refuse_states(s, j->coordinate[k], "the coordinate of a joint", 0));
    if (!is_used(s, b->name))
        return QDOT_OK;
    qdot_fail(QDOT_EINVAL, "what was declared before stands where %s is now, but joint %s moves it", b->name, j->name);
    return qdot_hint("`joint` first, then what acts on %.60s", b->name);
}

/* The rotation of B against A and the slide of the joint's place, in the axes of A. */
static void
find_motion(qdot_scene *s, const qdot_body_joint *j, const qdot_joint_frames *x, qdot_expr *turn, qdot_expr *slide)
{
    const qdot_joint_kind *kind = &qdot_joint_kinds[j->kind];
    qdot_pool *pool = s->pool;
    const qdot_expr axes[] = {x->u[0], x->v[0], x->w[0]};

    *turn = *slide = QDOT_NIL;
    for (unsigned k = 0; k < kind->turns && x->dim == 3; k++) {
        const qdot_expr R = rotation_about(pool, unit_along(s, axes[k]), j->coordinate[k]);

        *turn = k == 0 ? R : qdot_value_mul(pool, *turn, R);
    }
    if (x->dim == 2 && kind->turns)
        *turn = qdot_body_rotation_in_plane(pool, j->coordinate[0]);
    for (unsigned k = 0; k < kind->slides; k++) { /* along u; two in the plane at right angles to u */
        const qdot_expr along = kind->slides == 1 ? axes[0] : axes[k + 1];
        const qdot_expr part = qdot_value_mul(pool, j->coordinate[kind->turns + k], unit_along(s, along));

        *slide = k == 0 ? part : qdot_value_add(pool, *slide, part);
    }
    if (j->pitch != QDOT_NIL) {
        const qdot_expr turns = qdot_div(pool, j->coordinate[0], qdot_mul(pool, qdot_expr_int(pool, 2), QDOT_PI));

        *slide = qdot_value_mul(pool, qdot_mul(pool, j->pitch, turns), unit_along(s, axes[0]));
    }
}

qdot_status
qdot_body_joint_place(qdot_scene *s, const qdot_body_joint *j)
{
    const qdot_body *a = qdot_scene_find_body(s, j->end[0] ? j->end[0] : ""), *b = qdot_scene_find_body(s, j->end[1] ? j->end[1] : "");
    qdot_pool *pool = s->pool;
    qdot_joint_frames x;
    qdot_body placed;
    qdot_expr turn, slide, at;

    QDOT_TRY(check_second_body(s, j, b));
    QDOT_TRY(qdot_body_joint_frames(s, j, &x));
    find_motion(s, j, &x, &turn, &slide);
    placed = *b;
    at = slide == QDOT_NIL ? x.place[0] : qdot_value_add(pool, x.place[0], slide);
    if (x.dim == 2) {
        if (turn != QDOT_NIL)
            placed.angle = qdot_add(pool, placed.angle, j->coordinate[0]);
        if (a)
            placed.angle = qdot_add(pool, placed.angle, qdot_sub(pool, a->angle, qdot_body_joint_reference(s, a->angle)));
        placed.rotation = qdot_body_rotation_in_plane(pool, placed.angle);
    } else {
        placed.rotation = turn == QDOT_NIL ? x.attitude : qdot_value_mul(pool, turn, x.attitude);
        if (a)
            placed.rotation = qdot_value_mul(pool, a->rotation, placed.rotation);
    }
    if (a)
        at = qdot_value_add(pool, a->position, qdot_value_mul(pool, a->rotation, at));
    placed.position = qdot_value_sub(pool, at, qdot_value_mul(pool, placed.rotation, x.place[1]));
    QDOT_TRY(qdot_pool_check(pool));
    s->bodies.at[b - s->bodies.at] = placed;
    return QDOT_OK;
}
