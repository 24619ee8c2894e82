/* joint.c -- the statement `joint`: joins two bodies, by constraints or by coordinates that place the second one. */
#include <string.h>

#include "expr/node.h"
#include "expr/symbol.h"
#include "lang/answer/answer.h"
#include "lang/declare/new-names.h"
#include "lang/declare/objects.h"
#include "lang/session/labels.h"
#include "lang/session/units.h"
#include "mech/scene/body-joint.h"

static qdot_status declare_joint(qdot_record *r);

QDOT_STATEMENT(joint) = {
    .word = "joint",
    .group = QDOT_DECLARING,
    .usage = "joint hinge|slider|ball|universal|weld|planar|screw|rolling NAME between A, B at P, ... [axis U, ...] "
             "[pitch H] [angle Q, ...] [length S, ...]",
    .form = "joint hinge NAME between A, B at P axis U; `angle THETA` declares its coordinate and places B",
    .summary = "joins the body B to A (or `ground`), by constraints, or by coordinates that it names; at P: in space where all "
               "coordinates are 0; at P, Q: in the bodies' axes; reaction(NAME) is its force",
    .example = "joint hinge J between ground, plate at (0, 0)",
    .handler = declare_joint,
};

/* --- operands ------------------------------------------------------------------------- */

static qdot_status
report_no_body(qdot_record *r, const char *name)
{
    qdot_words known = {0};
    qdot_status status;

    (void)qdot_fail(QDOT_ENAME, "there is no body `%.200s`", name);
    qdot_labels_add(r->cursor.session->scene, &known);
    if (qdot_vec_push(&known, "ground") != QDOT_OK)
        known.n = 0;
    status = qdot_labels_hint(name, &known);
    qdot_free(known.at);
    return status;
}

/* The label of a body; NULL: the ground. */
static qdot_status
read_end(qdot_record *r, const qdot_filled *end, char **label)
{
    const qdot_scene *scene = r->cursor.session->scene;
    const char *name;

    QDOT_TRY(qdot_record_bare_name(r, end, 0, &name));
    qdot_record_blame(r, end);
    if (name == NULL) {
        (void)qdot_fail(QDOT_ETYPE, "a joint is between two bodies, by their names");
        return qdot_hint("`between ground, plate at P`: P says where");
    }
    *label = (char *)name;
    if (qdot_scene_find_body(scene, name) != NULL || qdot_scene_find_particle(scene, name) != NULL)
        return QDOT_OK;
    *label = NULL;
    return strcmp(name, "ground") == 0 ? QDOT_OK : report_no_body(r, name);
}

/* The operands of a list behind `word`, one or two vectors; e[0] nil: there are none. */
static qdot_status
read_vectors(qdot_record *r, const char *word, const char *hole, qdot_expr e[2])
{
    const qdot_filled *part = qdot_record_hole(r, word, hole);
    size_t n = 0;

    e[0] = e[1] = QDOT_NIL;
    for (; part != NULL; part = qdot_record_next(r, part, hole), n++) {
        if (n == 2) {
            qdot_record_blame(r, part);
            return qdot_fail(QDOT_EINVAL, "a joint is between two bodies: `%s` takes one operand or two", word);
        }
        QDOT_TRY(qdot_record_point(r, part, &e[n]));
    }
    return QDOT_OK;
}

/* --- coordinates that it names -------------------------------------------------------------- */

/* The names behind `word`, each of a coordinate, which is declared unless it is one already. */
static qdot_status
read_coordinates(qdot_record *r, const char *word, const char *hole, size_t most, qdot_new_names *fresh, size_t *n,
                 const qdot_filled *parts[])
{
    const qdot_names *names = r->cursor.session->names;

    *n = 0;
    for (const qdot_filled *part = qdot_record_hole(r, word, hole); part != NULL; part = qdot_record_next(r, part, hole)) {
        qdot_new_name x = {.start = part->from};
        const qdot_name *old;

        qdot_record_blame(r, part);
        if (*n == most)
            return most == 0 ? qdot_fail(QDOT_EINVAL, "this joint has no %s that it could name", word)
                             : qdot_fail(QDOT_EINVAL, "this joint has %zu %s%s", most, word, most == 1 ? "" : "s");
        QDOT_TRY(qdot_record_name(r, part, &x.name));
        if (strcmp(x.name, "t") == 0)
            return qdot_fail(QDOT_ENAME, "`t` is the time: it is no coordinate of a joint");
        old = qdot_names_find(names, x.name);
        for (size_t i = 0; i < fresh->n; i++)
            if (strcmp(fresh->at[i].name, x.name) == 0)
                return qdot_fail(QDOT_ENAME, "`%s` is named twice", x.name);
        if (old != NULL && old->kind != QDOT_NAME_COORD)
            return qdot_fail(QDOT_ENAME, "`%s` was declared before, at %s:%u", x.name, old->file, old->line);
        if (old == NULL)
            QDOT_TRY(qdot_vec_push(fresh, x));
        parts[(*n)++] = part;
    }
    return QDOT_OK;
}

/* The coordinates that the joint names, as symbols; those that are new are in `fresh`. */
static qdot_status
read_coordinates_of_joint(qdot_record *r, qdot_body_joint *joint, qdot_new_names *fresh)
{
    const qdot_joint_kind *kind = &qdot_joint_kinds[joint->kind];
    qdot_pool *pool = r->cursor.session->pool;
    const qdot_filled *parts[8];
    size_t angles, lengths;

    QDOT_TRY(read_coordinates(r, "angle", "Q", kind->turns, fresh, &angles, parts));
    QDOT_TRY(read_coordinates(r, "length", "S", kind->slides, fresh, &lengths, parts + angles));
    r->cursor.error_at = r->start->start;
    if (angles + lengths > 0 && (angles < kind->turns || lengths < kind->slides)) {
        (void)qdot_fail(QDOT_EINVAL, "a %s joint that names its coordinates names all of them", kind->word);
        return qdot_hint("%u by `angle`, %u by `length`", kind->turns, kind->slides);
    }
    for (size_t k = 0; k < angles + lengths; k++) {
        const char *name;

        QDOT_TRY(qdot_record_name(r, parts[k], &name));
        joint->coordinate[k] = qdot_symbol_get(pool, QDOT_COORD, name);
    }
    return qdot_pool_check(pool);
}

/* The coordinates of the joint are angles, then lengths. */
static qdot_status
give_dimensions(qdot_session *session, const qdot_body_joint *joint)
{
    static const int length[QDOT_BASES] = {1};

    for (unsigned k = 0; k < 3 && joint->coordinate[k] != QDOT_NIL && qdot_units_on(session); k++) {
        const bool angle = k < qdot_joint_kinds[joint->kind].turns;

        QDOT_TRY(qdot_units_fix(session, joint->coordinate[k], angle ? qdot_dimension_none() : qdot_dimension_make(length),
                                "the coordinate of a joint is %s, but this is %s"));
        if (angle)
            QDOT_TRY(qdot_units_angles_in(session, joint->coordinate[k]));
    }
    return QDOT_OK;
}

/* Let an error stand at the operand that it is about. */
static void
blame(qdot_record *r, const qdot_body_joint *joint, qdot_joint_part wrong)
{
    const qdot_filled *const part[] = {
        [QDOT_JOINT_WHOLE] = NULL,
        [QDOT_JOINT_KIND] = qdot_record_word(r, qdot_joint_kinds[joint->kind].word),
        [QDOT_JOINT_A] = qdot_record_hole(r, "between", "A"),
        [QDOT_JOINT_B] = qdot_record_hole(r, "between", "B"),
        [QDOT_JOINT_PLACE] = qdot_record_hole(r, "at", "P"),
        [QDOT_JOINT_AXIS] = qdot_record_hole(r, "axis", "U"),
        [QDOT_JOINT_PITCH] = qdot_record_hole(r, "pitch", NULL),
    };

    if (part[wrong] != NULL)
        qdot_record_blame(r, part[wrong]);
}

/* Add the joint to the scene, and declare the coordinates that it names. */
static qdot_status
add_joint(qdot_record *r, qdot_body_joint *joint)
{
    qdot_session *session = r->cursor.session;
    const qdot_body *second = joint->end[1] != NULL ? qdot_scene_find_body(session->scene, joint->end[1]) : NULL;
    const qdot_body before = second != NULL ? *second : (qdot_body){0};
    qdot_new_names fresh = {0};
    qdot_joint_part wrong = QDOT_JOINT_WHOLE;
    qdot_status status = read_coordinates_of_joint(r, joint, &fresh);

    if (status == QDOT_OK) {
        status = qdot_scene_joint(session->scene, joint, &wrong);
        blame(r, joint, wrong);
    }
    if (status == QDOT_OK && fresh.n > 0) {
        status = qdot_new_names_declare(&r->cursor, QDOT_NAME_COORD, &fresh);
        if (status != QDOT_OK)
            qdot_scene_take_back_joint(session->scene, &before);
    }
    qdot_free(fresh.at);
    return status;
}

/* --- the statement --------------------------------------------------------------------------- */

static int
kind_of(const qdot_record *r)
{
    for (int k = 0; k < QDOT_JOINT_KINDS; k++)
        if (qdot_record_word(r, qdot_joint_kinds[k].word) != NULL)
            return k;
    return 0;
}

/* Say which parts the bodies fulfil by themselves; which point a place is that was given once. */
static qdot_status
give_joint_notices(qdot_session *session, const qdot_body_joint *joint)
{
    const size_t left_out = session->scene->dropped.n;

    if (left_out > 0)
        QDOT_TRY(qdot_answer_notice(session, "%zu of the conditions of joint %s hold%s by the places of its bodies and %s left out",
                                    left_out, joint->name, left_out == 1 ? "s" : "", left_out == 1 ? "is" : "are"));
    if (joint->coordinate[0] == QDOT_NIL && qdot_joint_kinds[joint->kind].turns + qdot_joint_kinds[joint->kind].slides > 0 &&
        joint->end[1] != NULL && !qdot_body_joint_moves(session->scene, joint->end[1]))
        QDOT_TRY(qdot_answer_notice(session, "%s has no coordinates, so joint %s holds %s to it as to the ground; `%s NAME` would "
                                             "place %s", joint->end[1], joint->name, joint->end[0],
                                    qdot_joint_kinds[joint->kind].turns > 0 ? "angle" : "length", joint->end[1]));
    if (joint->kind == QDOT_JOINT_OF_rolling || joint->place[1] != QDOT_NIL || !qdot_body_joint_is_at_one_place(session->scene, joint))
        return QDOT_OK;
    return qdot_answer_notice(session,
                              "%s and %s are at one place where all coordinates are 0, so `at P` of joint %s is the same point of "
                              "both; `at P, Q` gives one of each, in its own axes",
                              joint->end[0], joint->end[1], joint->name);
}

static qdot_status
declare_joint(qdot_record *r)
{
    const qdot_filled *pitch = qdot_record_hole(r, "pitch", NULL);
    qdot_session *session = r->cursor.session;
    qdot_body_joint joint = {.kind = kind_of(r), .pitch = QDOT_NIL};
    const char *name;

    for (size_t k = 0; k < 3; k++)
        joint.coordinate[k] = QDOT_NIL;
    QDOT_TRY(qdot_record_name(r, qdot_record_hole(r, NULL, "NAME"), &name));
    joint.name = (char *)name;
    QDOT_TRY(read_end(r, qdot_record_hole(r, "between", "A"), &joint.end[0]));
    QDOT_TRY(read_end(r, qdot_record_hole(r, "between", "B"), &joint.end[1]));
    QDOT_TRY(read_vectors(r, "at", "P", joint.place));
    QDOT_TRY(read_vectors(r, "axis", "U", joint.axis));
    if (pitch != NULL)
        QDOT_TRY(qdot_record_scalar(r, pitch, &joint.pitch));
    QDOT_TRY(add_joint(r, &joint));
    QDOT_TRY(give_dimensions(session, &joint));
    return give_joint_notices(session, &joint);
}
