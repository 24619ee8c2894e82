/* objects.c -- what stands in a scene: particles, bodies, springs, forces, constraints.
 *
 * Options come in any order after the name; each is read once. Nothing is added to the
 * scene before the statement is read to its end.
 */
#include "expr/tensor.h"
#include "lang/answer/answer.h"
#include "lang/declare/constraints.h"
#include "lang/commands/statement.h"
#include "lang/commands/value-check.h"
#include "lang/commands/warnings.h"
#include "lang/language/hints.h"
#include "lang/language/read.h"
#include "lang/session/labels.h"
#include "lang/session/member.h"

/* --- operands ----------------------------------------------------------------------- */

/* Whether the tokens [from, to) are a label and nothing else, not hidden by a name;
 * its text. */
static const char *
sole_label(qdot_cursor *c, const qdot_token *from, const qdot_token *to)
{
    qdot_cursor look = *c;
    const char *name;

    look.at = from;
    if (from->kind != QDOT_TOKEN_NAME || qdot_read_name(&look, &name) != QDOT_OK ||
        look.at != to)
        return NULL;
    if (qdot_names_find(c->session->names, name) != NULL)
        return NULL;
    return qdot_scene_find_particle(c->session->scene, name) != NULL ||
                   qdot_scene_find_body(c->session->scene, name) != NULL
               ? name
               : NULL;
}

/* `LABEL:` before an operand; NULL where there is none. */
static qdot_status
read_label(qdot_cursor *c, const char **label)
{
    qdot_cursor look = *c;

    *label = NULL;
    if (c->at->kind != QDOT_TOKEN_NAME || qdot_read_name(&look, label) != QDOT_OK ||
        !qdot_cursor_accept_op(&look, ":")) {
        *label = NULL;
        return QDOT_OK;
    }
    c->at = look.at;
    return QDOT_OK;
}

static qdot_status
missing(qdot_cursor *c, const qdot_token *start, const char *what, const char *option,
        const char *hint)
{
    c->error_at = start->start;
    (void)qdot_fail(QDOT_ESYNTAX, "%s needs `%s`", what, option);
    return qdot_hint("%s", hint);
}

/* --- particles and bodies ----------------------------------------------------------- */

qdot_status
qdot_object_particle(qdot_cursor *c)
{
    static const char *const hint = "particle NAME mass M at R";
    const qdot_token *start = c->at, *place = NULL;
    qdot_expr mass = QDOT_NIL, position = QDOT_NIL;
    const char *name;

    QDOT_TRY(qdot_read_name(c, &name));
    while (!qdot_cursor_is_end(c)) {
        if (qdot_cursor_accept_word(c, "mass")) {
            QDOT_TRY(qdot_cursor_once(c, "mass", mass != QDOT_NIL));
            QDOT_TRY(qdot_read_scalar(c, &mass));
        } else if (qdot_cursor_accept_word(c, "at")) {
            QDOT_TRY(qdot_cursor_once(c, "at", position != QDOT_NIL));
            place = c->at;
            QDOT_TRY(qdot_read_point(c, &position));
        } else {
            return qdot_cursor_expected(c, "`mass`, `at` or the end of the statement");
        }
    }
    if (mass == QDOT_NIL)
        return missing(c, start, "a particle", "mass", hint);
    if (position == QDOT_NIL)
        return missing(c, start, "a particle", "at", hint);
    c->error_at =
        qdot_scene_has_label(c->session->scene, name) ? start->start : place->start;
    QDOT_TRY(qdot_scene_particle(c->session->scene, name, mass, position));
    return qdot_warnings_mass(c->session, name, mass);
}

typedef struct {
    qdot_expr mass, inertia, about, position, angle, rotation;
} body;

/* euler(phi, theta, psi) */
static qdot_status
read_euler(qdot_cursor *c, qdot_expr *rotation)
{
    qdot_expr angles[3];

    QDOT_TRY(qdot_cursor_expect_op(c, "("));
    for (int i = 0; i < 3; i++) {
        if (i > 0)
            QDOT_TRY(qdot_cursor_expect_op(c, ","));
        QDOT_TRY(qdot_read_scalar(c, &angles[i]));
    }
    QDOT_TRY(qdot_cursor_expect_op(c, ")"));
    *rotation = qdot_scene_euler(c->session->pool, angles[0], angles[1], angles[2]);
    return qdot_pool_check(c->session->pool);
}

static qdot_status
read_body_option(qdot_cursor *c, body *b)
{
    if (qdot_cursor_accept_word(c, "mass")) {
        QDOT_TRY(qdot_cursor_once(c, "mass", b->mass != QDOT_NIL));
        return qdot_read_scalar(c, &b->mass);
    }
    if (qdot_cursor_accept_word(c, "inertia")) {
        QDOT_TRY(qdot_cursor_once(c, "inertia", b->inertia != QDOT_NIL));
        return qdot_read_side(c, &b->inertia);
    }
    if (qdot_cursor_accept_word(c, "about")) {
        QDOT_TRY(qdot_cursor_once(c, "about", b->about != QDOT_NIL));
        return qdot_read_point(c, &b->about);
    }
    if (qdot_cursor_accept_word(c, "at")) {
        QDOT_TRY(qdot_cursor_once(c, "at", b->position != QDOT_NIL));
        return qdot_read_point(c, &b->position);
    }
    if (qdot_cursor_accept_word(c, "angle")) {
        QDOT_TRY(qdot_cursor_once(c, "angle", b->angle != QDOT_NIL));
        return qdot_read_scalar(c, &b->angle);
    }
    if (qdot_cursor_accept_word(c, "euler")) {
        QDOT_TRY(qdot_cursor_once(c, "euler", b->rotation != QDOT_NIL));
        return read_euler(c, &b->rotation);
    }
    if (qdot_cursor_accept_word(c, "rotation")) {
        QDOT_TRY(qdot_cursor_once(c, "rotation", b->rotation != QDOT_NIL));
        return qdot_read_side(c, &b->rotation);
    }
    return qdot_cursor_expected(c,
                                "`mass`, `inertia`, `about`, `at`, `angle`, `euler` or "
                                "`rotation`");
}

qdot_status
qdot_object_body(qdot_cursor *c)
{
    static const char *const hint = "body NAME mass M inertia I at R angle THETA; in "
                                    "space `euler(...)` or `rotation M`";
    const qdot_token *start = c->at;
    const char *name;
    body b = {0};

    QDOT_TRY(qdot_read_name(c, &name));
    while (!qdot_cursor_is_end(c))
        QDOT_TRY(read_body_option(c, &b));
    if (b.mass == QDOT_NIL)
        return missing(c, start, "a body", "mass", hint);
    if (b.inertia == QDOT_NIL)
        return missing(c, start, "a body", "inertia", hint);
    if (b.position == QDOT_NIL)
        return missing(c, start, "a body", "at", hint);
    if (b.angle == QDOT_NIL && b.rotation == QDOT_NIL)
        return missing(c, start, "a body", "angle", hint);
    c->error_at = start->start;
    if (b.angle != QDOT_NIL && b.rotation != QDOT_NIL)
        return qdot_fail(QDOT_EINVAL,
                         "a body has an `angle` (plane) or a rotation (space), not both");
    QDOT_TRY(qdot_scene_body(c->session->scene, name,
                             &(qdot_body){.mass = b.mass,
                                          .inertia = b.inertia,
                                          .position = b.position,
                                          .angle = b.angle,
                                          .rotation = b.rotation},
                             b.about));
    return qdot_warnings_mass(c->session, name, b.mass);
}

/* --- fields and energies ------------------------------------------------------------ */

/* The statement of the field without label before one is added; nothing where there is none. */
static qdot_status
print_plain_gravity(const qdot_scene *scene, qdot_text *out)
{
    for (size_t i = 0; i < scene->gravities.n; i++)
        if (scene->gravities.at[i].name == NULL)
            QDOT_TRY(qdot_scene_print_at(scene, QDOT_GRAVITY, i, out));
    return qdot_text_status(out);
}

qdot_status
qdot_object_gravity(qdot_cursor *c)
{
    const qdot_token *start = c->at;
    qdot_scene *scene = c->session->scene;
    qdot_text before = {0};
    const char *label;
    qdot_expr field;
    qdot_status status = QDOT_OK;

    QDOT_TRY(read_label(c, &label));
    QDOT_TRY(qdot_read_point(c, &field));
    QDOT_TRY(qdot_cursor_expect_end(c));
    c->error_at = start->start;
    if (label == NULL)
        status = print_plain_gravity(scene, &before);
    if (status == QDOT_OK)
        status = qdot_scene_term(scene, QDOT_GRAVITY, label, field);
    if (status == QDOT_OK && before.n > 0)
        status = qdot_answer_notice(c->session,
                                    "this takes the place of `%.*s`; fields with labels add up: "
                                    "`gravity NAME: ...`",
                                    (int)before.n - 1, qdot_text_str(&before));
    qdot_text_clear(&before);
    return status;
}

static qdot_status
add_term(qdot_cursor *c, qdot_scene_kind kind)
{
    const qdot_token *start = c->at;
    const char *label;
    qdot_expr e;

    QDOT_TRY(read_label(c, &label));
    if (label == NULL || !qdot_scene_has_label(c->session->scene, label))
        start = c->at;
    QDOT_TRY(qdot_read_scalar(c, &e));
    QDOT_TRY(qdot_cursor_expect_end(c));
    c->error_at = start->start;
    QDOT_TRY(qdot_scene_term(c->session->scene, kind, label, e));
    return qdot_warnings_twice(c->session, kind);
}

qdot_status
qdot_object_potential(qdot_cursor *c)
{
    return add_term(c, QDOT_POTENTIAL);
}

qdot_status
qdot_object_dissipation(qdot_cursor *c)
{
    return add_term(c, QDOT_DISSIPATION);
}

qdot_status
qdot_object_lagrangian(qdot_cursor *c)
{
    const qdot_token *start = c->at;
    qdot_expr L;

    QDOT_TRY(qdot_read_scalar(c, &L));
    QDOT_TRY(qdot_cursor_expect_end(c));
    c->error_at = start->start;
    return qdot_scene_lagrangian(c->session->scene, L);
}

/* --- springs and dampers ------------------------------------------------------------ */

/* [NAME] between A, B and two options; the second is NULL for a damper, *second_at where its value
 * stands. */
static qdot_status
read_link(qdot_cursor *c, const char *what, const char *first, const char *second,
          const char *hint, qdot_link *link, const qdot_token **second_at)
{
    const qdot_token *start = c->at;
    const char *name = NULL;
    bool ends = false;

    if (!qdot_cursor_is_word(c, "between"))
        QDOT_TRY(qdot_read_name(c, &name));
    link->name = (char *)name;
    while (!qdot_cursor_is_end(c)) {
        if (qdot_cursor_accept_word(c, "between")) {
            QDOT_TRY(qdot_cursor_once(c, "between", ends));
            ends = true;
            for (int i = 0; i < 2; i++) {
                const qdot_token *from = c->at;

                QDOT_TRY(qdot_read_point(c, &link->at[i]));
                link->end[i] = (char *)sole_label(c, from, c->at);
                QDOT_TRY(i == 0 ? qdot_cursor_expect_op(c, ",") : QDOT_OK);
            }
        } else if (qdot_cursor_accept_word(c, first)) {
            QDOT_TRY(qdot_cursor_once(c, first, link->stiffness != QDOT_NIL));
            QDOT_TRY(qdot_read_scalar(c, &link->stiffness));
        } else if (second != NULL && qdot_cursor_accept_word(c, second)) {
            QDOT_TRY(qdot_cursor_once(c, second, link->rest != QDOT_NIL));
            *second_at = c->at;
            QDOT_TRY(qdot_read_scalar(c, &link->rest));
        } else {
            return qdot_cursor_expected(c, second != NULL
                                               ? "`between`, `stiffness` or `rest`"
                                               : "`between` or `coefficient`");
        }
    }
    if (!ends)
        return missing(c, start, what, "between", hint);
    if (link->stiffness == QDOT_NIL)
        return missing(c, start, what, first, hint);
    c->error_at = start->start;
    return QDOT_OK;
}

qdot_status
qdot_object_spring(qdot_cursor *c)
{
    const qdot_token *rest_at = NULL;
    qdot_link link = {0};
    size_t start;

    QDOT_TRY(read_link(c, "a spring", "stiffness", "rest",
                       "spring NAME between A, B stiffness K rest L", &link, &rest_at));
    if (link.rest == QDOT_NIL)
        link.rest = QDOT_ZERO;
    start = c->error_at;
    if (rest_at != NULL) {
        c->error_at = rest_at->start;
        QDOT_TRY(qdot_value_check_rest(c->session, link.name, link.rest));
        c->error_at = start;
    }
    QDOT_TRY(qdot_scene_spring(c->session->scene, &link));
    return qdot_warnings_twice(c->session, QDOT_SPRING);
}

qdot_status
qdot_object_damper(qdot_cursor *c)
{
    qdot_link link = {0};

    QDOT_TRY(read_link(c, "a damper", "coefficient", NULL,
                       "damper NAME between A, B coefficient C", &link, NULL));
    QDOT_TRY(qdot_scene_damper(c->session->scene, &link));
    return qdot_warnings_twice(c->session, QDOT_DAMPER);
}

/* --- forces and torques ------------------------------------------------------------- */

/* `on NAME`: a coordinate (unless a label is wanted and there), or a label. */
static qdot_status
read_target(qdot_cursor *c, bool label_first, qdot_expr *coordinate, const char **label)
{
    const qdot_token *start = c->at;
    const qdot_name *known;
    const char *name, *nearest;
    qdot_words words = {0};
    bool labelled;

    *coordinate = QDOT_NIL;
    *label = NULL;
    QDOT_TRY(qdot_read_name(c, &name));
    known = qdot_names_find(c->session->names, name);
    labelled = qdot_scene_find_particle(c->session->scene, name) != NULL ||
               qdot_scene_find_body(c->session->scene, name) != NULL;
    if (known != NULL && known->kind == QDOT_NAME_COORD && !(labelled && label_first)) {
        *coordinate = known->value;
        return QDOT_OK;
    }
    if (labelled) {
        *label = name;
        return QDOT_OK;
    }
    c->error_at = start->start;
    (void)qdot_fail(QDOT_ENAME, "there is no coordinate, particle or body `%s`", name);
    qdot_labels_add(c->session->scene, &words);
    nearest = qdot_names_nearest(c->session->names, name, words.n, words.at);
    qdot_free(words.at);
    return nearest != NULL ? qdot_hint("did you mean `%s`?", nearest)
                           : qdot_hint("`coord %.60s` declares a coordinate, "
                                       "`particle %.60s mass m at (x, y)` a particle",
                                       name, name);
}

/* The body of a place that is written point(BODY, P), and nothing else; NULL: it is not. */
static const char *
body_of_point(qdot_cursor *c, const qdot_token *from, const qdot_token *to)
{
    qdot_cursor look = *c;
    const char *name;
    qdot_expr P;

    look.at = from;
    if (!qdot_cursor_accept_word(&look, "point") || !qdot_cursor_accept_op(&look, "(") ||
        look.at->kind != QDOT_TOKEN_NAME || qdot_read_name(&look, &name) != QDOT_OK ||
        !qdot_cursor_accept_op(&look, ",") || qdot_read_point(&look, &P) != QDOT_OK ||
        !qdot_cursor_accept_op(&look, ")") || look.at != to)
        return NULL;
    return qdot_scene_find_body(c->session->scene, name) != NULL ? name : NULL;
}

/* action: the first token of the force. */
static qdot_status
force_at(qdot_cursor *c, const qdot_token *start, const qdot_token *action, const char *label,
         qdot_expr force)
{
    qdot_force f = {.name = (char *)label, .force = force};
    const qdot_token *from = c->at;
    const char *body;

    QDOT_TRY(qdot_read_point(c, &f.point));
    f.on = (char *)sole_label(c, from, c->at);
    body = f.on == NULL ? body_of_point(c, from, c->at) : NULL;
    QDOT_TRY(qdot_cursor_expect_end(c));
    c->error_at = start->start;
    QDOT_TRY(qdot_scene_force(c->session->scene, &f));
    QDOT_TRY(qdot_warnings_twice(c->session, QDOT_FORCE));
    return f.on == NULL ? qdot_warnings_place(c, f.point, body, action, from - 1)
                        : QDOT_OK;
}

/* `on BODY at material P`, or `on NAME`: at its centre. */
static qdot_status
force_on(qdot_cursor *c, const qdot_token *start, const char *label, qdot_expr force,
         const char *on)
{
    qdot_force f = {.name = (char *)label, .force = force, .on = (char *)on};
    const qdot_token *place = c->at;

    f.material = qdot_cursor_accept_word(c, "at");
    if (f.material && !qdot_cursor_accept_word(c, "material")) {
        (void)qdot_cursor_expected(c, "`material`");
        return qdot_hint("force F at R acts at a place, force F on BODY at material R on what is "
                         "there of the body");
    }
    if (f.material)
        QDOT_TRY(qdot_read_point(c, &f.point));
    else
        f.point = qdot_scene_position(c->session->scene, on);
    QDOT_TRY(qdot_pool_check(c->session->pool));
    QDOT_TRY(qdot_cursor_expect_end(c));
    c->error_at = f.material && qdot_scene_find_body(c->session->scene, on) == NULL
                      ? place->start
                      : start->start;
    QDOT_TRY(qdot_scene_force(c->session->scene, &f));
    return qdot_warnings_twice(c->session, QDOT_FORCE);
}

qdot_status
qdot_object_force(qdot_cursor *c)
{
    const qdot_token *start = c->at, *action;
    const char *label, *on;
    qdot_expr force, coordinate;
    qdot_torque torque;
    bool vector;

    QDOT_TRY(read_label(c, &label));
    action = c->at;
    QDOT_TRY(qdot_read_point(c, &force));
    if (qdot_cursor_accept_word(c, "at"))
        return force_at(c, start, action, label, force);
    if (!qdot_cursor_accept_word(c, "on"))
        return qdot_cursor_expected(c, "`on` or `at`");
    vector = qdot_expr_kind(c->session->pool, force) == QDOT_VEC;
    QDOT_TRY(read_target(c, vector, &coordinate, &on));
    if (on != NULL)
        return force_on(c, start, label, force, on);
    QDOT_TRY(qdot_cursor_expect_end(c));
    c->error_at = start->start;
    if (vector)
        return qdot_fail(QDOT_ETYPE, "a generalized force is a number, not a vector");
    torque = (qdot_torque){.name = (char *)label,
                           .torque = force,
                           .coordinate = coordinate,
                           .force = true,
                           .body = -1};
    QDOT_TRY(qdot_scene_torque(c->session->scene, &torque));
    return qdot_warnings_twice(c->session, QDOT_TORQUE);
}

qdot_status
qdot_object_torque(qdot_cursor *c)
{
    qdot_scene *scene = c->session->scene;
    const qdot_token *start = c->at, *target;
    qdot_torque torque = {.body = -1};
    const char *label, *on;

    QDOT_TRY(read_label(c, &label));
    torque.name = (char *)label;
    QDOT_TRY(qdot_read_point(c, &torque.torque));
    if (!qdot_cursor_accept_word(c, "on"))
        return qdot_cursor_expected(c, "`on` and a coordinate or a body");
    target = c->at;
    QDOT_TRY(read_target(c, qdot_expr_kind(c->session->pool, torque.torque) == QDOT_VEC,
                         &torque.coordinate, &on));
    QDOT_TRY(qdot_cursor_expect_end(c));
    c->error_at = target->start;
    if (on != NULL) {
        const qdot_body *body = qdot_scene_find_body(scene, on);

        if (body == NULL) {
            (void)qdot_fail(QDOT_ETYPE, "`%s` is a particle: no torque acts on it", on);
            return qdot_hint("force F on %s", on);
        }
        torque.body = (int)(body - scene->bodies.at);
    }
    c->error_at = start->start;
    QDOT_TRY(qdot_scene_torque(scene, &torque));
    return qdot_warnings_twice(c->session, QDOT_TORQUE);
}

/* --- constraints -------------------------------------------------------------------- */

/* A component that says 0 = 0 is no constraint: `kept` is what there is of the others. */
static qdot_status
tell_dropped(qdot_session *session, const char *label, qdot_expr left, size_t kept)
{
    size_t given = qdot_expr_kind(session->pool, left) == QDOT_VEC
                       ? qdot_expr_count(session->pool, left)
                       : 1;

    if (kept >= given)
        return QDOT_OK;
    if (given == 1)
        return qdot_answer_notice(session, "the constraint%s%s says 0 = 0 and is left out",
                                  label != NULL ? " " : "", label != NULL ? label : "");
    return qdot_answer_notice(session,
                              "%zu of the %zu components of the constraint%s%s "
                              "say 0 = 0 and are left out",
                              given - kept, given, label != NULL ? " " : "",
                              label != NULL ? label : "");
}

/* A notice where all constraints from `before` on are there already; whether it is so. */
static bool
tell_same(qdot_session *session, size_t before, qdot_status *status)
{
    const qdot_scene *scene = session->scene;

    for (size_t k = before; k < scene->constraints.n; k++) {
        size_t i = 0;

        while (i < before && scene->constraints.at[i].f != scene->constraints.at[k].f)
            i++;
        if (i == before)
            return false;
    }
    if (before == scene->constraints.n)
        return false;
    *status = qdot_answer_notice(session, "the scene has this constraint already: beside the "
                                          "first it is redundant");
    return true;
}

qdot_status
qdot_object_constraint(qdot_cursor *c)
{
    qdot_pool *pool = c->session->pool;
    const qdot_token *start;
    const char *label;
    qdot_expr left, right;
    qdot_status status;
    size_t before;

    QDOT_TRY(read_label(c, &label));
    start = c->at;
    QDOT_TRY(qdot_read_side(c, &left));
    if (qdot_cursor_accept_op(c, "=") || qdot_cursor_accept_op(c, "==")) {
        QDOT_TRY(qdot_read_side(c, &right));
    } else if (qdot_cursor_is_end(c) && qdot_expr_kind(pool, left) == QDOT_REL &&
               qdot_expr_node(pool, left)->op == QDOT_EQ) {
        right = qdot_expr_arg(pool, left, 1); /* a named equation */
        left = qdot_expr_arg(pool, left, 0);
    } else {
        return qdot_cursor_expected(c, "`=` and the other side");
    }
    QDOT_TRY(qdot_cursor_expect_end(c));
    c->error_at = start->start;
    QDOT_TRY(qdot_member_refuse(c->session, left));
    QDOT_TRY(qdot_member_refuse(c->session, right));
    before = c->session->scene->constraints.n;
    QDOT_TRY(qdot_scene_constraint(c->session->scene, label, left, right));
    QDOT_TRY(tell_dropped(c->session, label, left,
                          c->session->scene->constraints.n - before));
    if (tell_same(c->session, before, &status))
        return status;
    return qdot_constraints_tell_disguise(c->session, before);
}
