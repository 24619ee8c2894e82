/* gravity.c -- the statement `gravity`: declares a uniform field. */
#include "lang/answer/answer.h"
#include "lang/declare/objects.h"
#include "mech/scene/scene.h"

static qdot_status declare_gravity(qdot_record *r);

QDOT_STATEMENT(gravity) = {
    .word = "gravity",
    .group = QDOT_DECLARING,
    .usage = "gravity [NAME:] VECTOR",
    .summary = "a uniform field that acts on every particle and body; a second statement replaces "
               "the first, fields with labels add up",
    .example = "gravity (0, -g)",
    .handler = declare_gravity,
};

/* Print the gravity field without a label, if there is one, to which another field is added. */
static qdot_status
print_unlabelled_gravity(const qdot_scene *scene, qdot_text *out)
{
    for (size_t i = 0; i < scene->gravities.n; i++)
        if (scene->gravities.at[i].name == NULL)
            QDOT_TRY(qdot_scene_print_at(scene, QDOT_GRAVITY, i, out));
    return qdot_text_status(out);
}

static qdot_status
declare_gravity(qdot_record *r)
{
    qdot_session *session = r->cursor.session;
    qdot_text before = {0};
    const char *label;
    qdot_expr field;
    qdot_status status = QDOT_OK;

    QDOT_TRY(qdot_object_label(r, &label));
    QDOT_TRY(qdot_record_point(r, qdot_record_hole(r, NULL, "VECTOR"), &field));
    r->cursor.error_at = r->start->start;
    if (label == NULL)
        status = print_unlabelled_gravity(session->scene, &before);
    if (status == QDOT_OK)
        status = qdot_scene_term(session->scene, QDOT_GRAVITY, label, field);
    if (status == QDOT_OK && before.n > 0)
        status = qdot_answer_notice(session,
                                    "this takes the place of `%.*s`; fields with labels add up: "
                                    "`gravity NAME: ...`",
                                    (int)before.n - 1, qdot_text_str(&before));
    qdot_text_clear(&before);
    return status;
}
