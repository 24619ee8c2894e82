/* input.c -- the statement `input`: declares symbols that drive the scene. */
#include "lang/declare/new-names.h"
#include "lang/session/names.h"
#include "mech/scene/scene.h"

static qdot_status declare_inputs(qdot_record *r);

QDOT_STATEMENT(input) = {
    .word = "input",
    .group = QDOT_DECLARING,
    .usage = "input NAME, ...",
    .summary = "symbols that drive the scene: 0 at rest; in runs a value by `set`, or a function of t and the state",
    .example = "input F, tau",
    .nameable = true,
    .handler = declare_inputs,
};

static qdot_status
declare_inputs(qdot_record *r)
{
    qdot_session *session = r->cursor.session;
    qdot_new_names list = {0};
    qdot_status status = qdot_new_names_read(r, true, &list);

    if (status == QDOT_OK)
        status = qdot_new_names_declare(&r->cursor, QDOT_NAME_PARAM, &list);
    for (size_t i = 0; i < list.n && status == QDOT_OK; i++)
        status = qdot_scene_input(session->scene, qdot_names_find(session->names, list.at[i].name)->value);
    qdot_free(list.at);
    return status;
}
