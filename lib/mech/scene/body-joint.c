/* body-joint.c -- joints of a scene: what is refused, their constraints and reactions, their statement. */
#include "mech/scene/body-joint.h"

#include <string.h>

#include "expr/build.h"
#include "expr/node.h"
#include "expr/print.h"
#include "expr/symbol.h"
#include "expr/tensor.h"
#include "mech/scene/access.h"
#include "normal/prove/decide.h"

#define MEET QDOT_JOINT_MEET
#define ACROSS QDOT_JOINT_ACROSS
#define ALONG QDOT_JOINT_ALONG
#define PARALLEL QDOT_JOINT_PARALLEL
#define TURN QDOT_JOINT_TURN
#define CROSS QDOT_JOINT_CROSS
#define ADVANCE QDOT_JOINT_ADVANCE
#define CONTACT QDOT_JOINT_CONTACT
const qdot_joint_kind qdot_joint_kinds[QDOT_JOINT_KINDS] = {
#define JOINT(word, plane, space, axes, turns, slides, sentence) {#word, sentence, plane, space, axes, turns, slides},
#include "mech/scene/body-joint.def"
#undef JOINT
};

const qdot_body_joint *
qdot_scene_find_joint(const qdot_scene *s, const char *label)
{
    for (size_t i = 0; i < s->joints.n; i++)
        if (qdot_label_is(s->joints.at[i].name, label))
            return &s->joints.at[i];
    return NULL;
}

/* --- what is refused ---------------------------------------------------------------------- */

bool
qdot_body_joint_moves(const qdot_scene *s, const char *label)
{
    const qdot_body *b = label ? qdot_scene_find_body(s, label) : NULL;

    return b && ((qdot_mech_holds(s, b->position) | qdot_mech_holds(s, b->rotation)) & (QDOT_HAS_COORD | QDOT_HAS_TIME));
}

static qdot_status
check_bodies(const qdot_scene *s, const qdot_body_joint *j, qdot_joint_part *wrong)
{
    for (int i = 0; i < 2; i++) {
        if (!j->end[i] || qdot_scene_find_body(s, j->end[i]))
            continue;
        *wrong = i == 0 ? QDOT_JOINT_A : QDOT_JOINT_B;
        if (qdot_scene_find_particle(s, j->end[i])) {
            qdot_fail(QDOT_ETYPE, "%s is a particle: it has no axes that a joint could hold", j->end[i]);
            return qdot_hint("`constraint` holds a particle: constraint %.60s: %.60s = point(BODY, P)", j->name, j->end[i]);
        }
        return qdot_fail(QDOT_ENAME, "there is no body %s", j->end[i]);
    }
    *wrong = QDOT_JOINT_B;
    if (!j->end[0] && !j->end[1])
        return qdot_fail(QDOT_EINVAL, "a joint moves a body: both of %s are the ground", j->name);
    if (j->end[0] && j->end[1] && strcmp(j->end[0], j->end[1]) == 0)
        return qdot_fail(QDOT_EINVAL, "a joint is between two bodies, not %s and itself", j->end[0]);
    *wrong = QDOT_JOINT_WHOLE;
    return QDOT_OK;
}

/* A place or an axis: a vector of the scene's dimension; `fixed`: without coordinates and t. */
static qdot_status
check_vector(qdot_scene *s, qdot_expr e, uint32_t dim, const char *what, bool fixed)
{
    const uint32_t moves = QDOT_HAS_VELOCITY | QDOT_HAS_ACCELERATION | QDOT_HAS_MULTIPLIER | QDOT_HAS_MOMENTUM |
                           QDOT_HAS_DIFFERENTIAL | QDOT_HAS_DELTA | (fixed ? QDOT_HAS_COORD | QDOT_HAS_TIME : 0);

    if (e == QDOT_NIL)
        return QDOT_OK;
    if (qdot_mech_dimension(s->pool, e) != dim)
        return qdot_fail(QDOT_ETYPE, "the %s of a joint has %u components in this scene", what, dim);
    QDOT_TRY(qdot_scene_refuse_delays(s, e, what));
    QDOT_TRY(qdot_scene_refuse_states(s, e, what, 0));
    if (!(qdot_mech_holds(s, e) & moves))
        return QDOT_OK;
    if (!fixed || (qdot_mech_holds(s, e) & ~(QDOT_HAS_COORD | QDOT_HAS_TIME) & moves))
        return qdot_fail(QDOT_EINVAL, "the %s of a joint cannot contain velocities", what);
    qdot_fail(QDOT_EINVAL, "the %s of a joint is fixed in its bodies: it cannot contain coordinates or t", what);
    return qdot_hint("`at P, Q` are points of the first and of the second body, each in the body's own axes");
}

static qdot_status
check_kind(const qdot_body_joint *j, uint32_t dim)
{
    const qdot_joint_kind *kind = &qdot_joint_kinds[j->kind];

    if (dim == 3 || kind->plane)
        return QDOT_OK;
    qdot_fail(QDOT_EINVAL, "there is no %s joint in the plane", kind->word);
    return j->kind == QDOT_JOINT_OF_ball || j->kind == QDOT_JOINT_OF_universal
               ? qdot_hint("in the plane `joint hinge` turns about a point")
               : qdot_hint("a body in space has a rotation: `euler(phi, theta, psi)`");
}

static qdot_status
check_axes(qdot_scene *s, const qdot_body_joint *j, uint32_t dim)
{
    const qdot_joint_kind *kind = &qdot_joint_kinds[j->kind];
    const unsigned axes = dim == 3 ? kind->axes : j->kind == QDOT_JOINT_OF_slider;
    const unsigned given = (j->axis[0] != QDOT_NIL) + (j->axis[1] != QDOT_NIL);

    if (given != axes && axes == 0) {
        qdot_fail(QDOT_EINVAL, "a %s joint%s has no axis", kind->word, dim == 2 ? " in the plane" : "");
        return dim == 2 && kind->axes > 0 ? qdot_hint("it turns about the normal of the plane") : QDOT_EINVAL;
    }
    if (given != axes)
        return qdot_fail(QDOT_EINVAL, "a %s joint has %s", kind->word,
                         axes == 1 ? "one axis: `axis U`" : "two axes, one of each body: `axis U, V`");
    for (int i = 0; i < 2; i++) {
        QDOT_TRY(check_vector(s, j->axis[i], dim, "axis", true));
        if (j->axis[i] != QDOT_NIL && qdot_norm(s->pool, j->axis[i]) == QDOT_ZERO)
            return qdot_fail(QDOT_EDOMAIN, "an axis of length 0 has no direction");
    }
    return qdot_pool_check(s->pool);
}

static qdot_status
check_pitch(qdot_scene *s, const qdot_body_joint *j)
{
    const uint32_t moves = QDOT_HAS_COORD | QDOT_HAS_TIME | QDOT_HAS_VELOCITY | QDOT_HAS_ACCELERATION;

    if ((j->pitch != QDOT_NIL) != (j->kind == QDOT_JOINT_OF_screw))
        return qdot_fail(QDOT_EINVAL, j->pitch == QDOT_NIL ? "a screw has a pitch, its advance with each turn: `pitch H`"
                                                           : "only a screw has a pitch");
    if (j->pitch == QDOT_NIL || (qdot_expr_is_scalar(s->pool, j->pitch) && !(qdot_mech_holds(s, j->pitch) & moves)))
        return QDOT_OK;
    return qdot_fail(QDOT_ETYPE, "a pitch is a number or an expression of parameters");
}

static qdot_status
check_geometry(qdot_scene *s, const qdot_body_joint *j, uint32_t dim, qdot_joint_part *wrong)
{
    const bool rolls = j->kind == QDOT_JOINT_OF_rolling;

    *wrong = QDOT_JOINT_KIND;
    QDOT_TRY(check_kind(j, dim));
    *wrong = QDOT_JOINT_PLACE;
    for (int i = 0; i < 2; i++)
        QDOT_TRY(check_vector(s, j->place[i], dim, "place", !rolls));
    if (rolls && j->place[1] != QDOT_NIL)
        return qdot_fail(QDOT_EINVAL, "a rolling joint has one place, that of the contact in space");
    *wrong = QDOT_JOINT_AXIS;
    QDOT_TRY(check_axes(s, j, dim));
    *wrong = QDOT_JOINT_PITCH;
    QDOT_TRY(check_pitch(s, j));
    *wrong = QDOT_JOINT_WHOLE;
    return QDOT_OK;
}

/* --- the constraints ------------------------------------------------------------------------ */

/* Refuse a joint whose bodies do not move, or that cannot hold. */
static qdot_status
check_rows(qdot_scene *s, const qdot_body_joint *j, const qdot_joint_row *rows, size_t n)
{
    const uint32_t moves = QDOT_HAS_COORD | QDOT_HAS_VELOCITY;
    const qdot_facts facts = qdot_scene_facts(s);
    bool any = false;

    for (size_t k = 0; k < n; k++)
        any |= (qdot_mech_holds(s, rows[k].f) & moves) != 0;
    if (!any) {
        qdot_fail(QDOT_EINVAL, "neither side of joint %s moves by coordinates", j->name);
        if (!qdot_joint_kinds[j->kind].turns && !qdot_joint_kinds[j->kind].slides)
            return qdot_hint("place a body by coordinates: body A mass m inertia I at (x, y) angle theta");
        if (!j->end[1])
            return qdot_hint("`between ground, %.60s`, with the ground first, and `angle NAME` or `length NAME` place the body", j->end[0]);
        return qdot_hint("`%s NAME` declares the joint's coordinate and places %.60s", qdot_joint_kinds[j->kind].turns ? "angle" : "length",
                         j->end[1]);
    }
    for (size_t k = 0; k < n; k++)
        if (!(qdot_mech_holds(s, rows[k].f) & moves) && !qdot_is_zero(s->pool, rows[k].f, &facts)) {
            QDOT_TRY(qdot_pool_check(s->pool));
            return qdot_fail(QDOT_EINVAL, "joint %s cannot hold: its component %zu is the same in all configurations, and not known to be 0",
                             j->name, k + 1);
        }
    return qdot_pool_check(s->pool);
}

static qdot_status
add_joint_constraints(qdot_scene *s, const qdot_body_joint *j)
{
    qdot_joint_row rows[QDOT_JOINT_ROWS];
    qdot_expr left[QDOT_JOINT_ROWS], right[QDOT_JOINT_ROWS];
    size_t n = 0;

    QDOT_TRY(qdot_body_joint_rows(s, j, rows, &n));
    QDOT_TRY(check_rows(s, j, rows, n));
    for (size_t k = 0; k < n; k++) {
        left[k] = rows[k].f;
        right[k] = QDOT_ZERO;
    }
    return qdot_scene_constraint(s, j->name, qdot_vector(s->pool, (uint32_t)n, left), qdot_vector(s->pool, (uint32_t)n, right));
}

qdot_status
qdot_scene_joint(qdot_scene *s, const qdot_body_joint *joint, qdot_joint_part *wrong)
{
    qdot_body_joint j = *joint;
    const qdot_body *body;

    *wrong = QDOT_JOINT_WHOLE;
    qdot_scene_forget_dropped(s);
    QDOT_TRY(qdot_pool_check(s->pool));
    QDOT_TRY(qdot_scene_need_new_label(s, j.name));
    QDOT_TRY(check_bodies(s, &j, wrong));
    body = qdot_scene_find_body(s, j.end[j.end[0] ? 0 : 1]);
    QDOT_TRY(check_geometry(s, &j, qdot_mech_dimension(s->pool, body->position), wrong));
    QDOT_TRY(qdot_scene_copy_text(s, joint->name, &j.name));
    for (int i = 0; i < 2; i++)
        QDOT_TRY(qdot_scene_copy_text(s, joint->end[i], &j.end[i]));
    j.places = j.coordinate[0] != QDOT_NIL ||
               (j.kind == QDOT_JOINT_OF_weld && qdot_body_joint_moves(s, j.end[0]) && j.end[1] && !qdot_body_joint_moves(s, j.end[1]));
    QDOT_TRY(j.places ? qdot_body_joint_place(s, &j) : add_joint_constraints(s, &j));
    QDOT_TRY(qdot_vec_push(&s->joints, j));
    qdot_scene_changed(s);
    return QDOT_OK;
}

void
qdot_scene_take_back_joint(qdot_scene *s, const qdot_body *before)
{
    for (size_t i = 0; before && i < s->bodies.n; i++)
        if (qdot_label_is(s->bodies.at[i].name, before->name))
            s->bodies.at[i] = *before;
    s->joints.n--;
    qdot_scene_changed(s);
}

/* --- reactions ---------------------------------------------------------------------------- */

/* The multiplier of component k, counted from 1; nil: the scene has no such constraint. */
static qdot_status
find_multiplier(const qdot_scene *s, const char *joint, size_t k, qdot_expr *multiplier)
{
    qdot_text name = {0};
    qdot_status status;

    *multiplier = QDOT_NIL;
    qdot_text_format(&name, "%s, %zu", joint, k);
    status = qdot_text_status(&name);
    for (size_t i = 0; status == QDOT_OK && i < s->constraints.n; i++)
        if (strcmp(s->constraints.at[i].name, qdot_text_str(&name)) == 0)
            *multiplier = s->constraints.at[i].multiplier;
    qdot_text_clear(&name);
    return status;
}

qdot_status
qdot_body_joint_reaction(qdot_scene *s, const qdot_body_joint *joint, qdot_expr *force, qdot_expr *torque)
{
    qdot_joint_row rows[QDOT_JOINT_ROWS];
    size_t n = 0;

    if (joint->places) {
        qdot_fail(QDOT_EINVAL, "joint %s has placed %s: it has no multipliers that would tell its force", joint->name,
                  joint->end[1]);
        return qdot_hint("a joint without `angle` or `length`, between bodies that are placed by coordinates, has them");
    }
    QDOT_TRY(qdot_body_joint_rows(s, joint, rows, &n));
    *force = *torque = QDOT_NIL;
    for (size_t k = 0; k < n; k++) {
        qdot_expr multiplier;

        QDOT_TRY(find_multiplier(s, joint->name, k + 1, &multiplier));
        if (multiplier == QDOT_NIL) {
            qdot_fail(QDOT_EINVAL, "component %zu of joint %s holds by the places of its bodies alone: no multiplier tells its force",
                      k + 1, joint->name);
            return qdot_hint("a coordinate along which the body could leave the joint gives it one");
        }
        rows[k].force = qdot_value_mul(s->pool, multiplier, rows[k].force);
        rows[k].torque = qdot_value_mul(s->pool, multiplier, rows[k].torque);
        *force = k == 0 ? rows[k].force : qdot_value_add(s->pool, *force, rows[k].force);
        *torque = k == 0 ? rows[k].torque : qdot_value_add(s->pool, *torque, rows[k].torque);
    }
    return qdot_pool_check(s->pool);
}

/* --- the statement -------------------------------------------------------------------------- */

/* Print " WORD E" or " WORD E, F"; nothing if e[0] is nil. */
static qdot_status
print_operands(const qdot_scene *s, const char *word, const qdot_expr *e, size_t n, qdot_text *out)
{
    for (size_t k = 0; k < n && e[k] != QDOT_NIL; k++) {
        qdot_text_format(out, k ? ", " : " %s ", word);
        QDOT_TRY(qdot_print(s->pool, e[k], QDOT_PLAIN, out));
    }
    return QDOT_OK;
}

qdot_status
qdot_body_joint_print(const qdot_scene *s, const qdot_body_joint *j, qdot_text *out)
{
    qdot_text_format(out, "joint %s %s between %s, %s", qdot_joint_kinds[j->kind].word, j->name, j->end[0] ? j->end[0] : "ground",
                     j->end[1] ? j->end[1] : "ground");
    QDOT_TRY(print_operands(s, "at", j->place, 2, out));
    QDOT_TRY(print_operands(s, "axis", j->axis, 2, out));
    QDOT_TRY(print_operands(s, "pitch", &j->pitch, 1, out));
    qdot_text_char(out, '\n');
    return qdot_text_status(out);
}
