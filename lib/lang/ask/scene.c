/* scene.c -- the statement `scene`: lists the declarations. */
#include "lang/answer/answer.h"
#include "lang/ask/declared.h"
#include "lang/declare/scene-file.h"
#include "lang/session/names.h"
#include "lang/syntax/record.h"
#include "mech/scene/scene.h"

static qdot_status carry_out_scene(qdot_record *r);

QDOT_STATEMENT(scene) = {
    .word = "scene",
    .group = QDOT_ASKING,
    .usage = "scene [to \"FILE.lag\"]",
    .summary = "print what is declared; to a .lag file: the statements that give the same scene again, with "
               "definitions, values, start and events",
    .example = "scene to \"x.lag\"",
    .alone = true,
    .handler = carry_out_scene,
};

static qdot_status
carry_out_scene(qdot_record *r)
{
    qdot_session *session = r->cursor.session;
    const qdot_filled *file = qdot_record_hole(r, "to", NULL);
    const qdot_name *name;
    qdot_text text = {0};
    qdot_status status;

    if (file != NULL)
        return qdot_scene_file_write(&r->cursor, file->from, QDOT_FILE_SCENE);
    status = qdot_scene_file_list(session, &text);
    for (size_t i = 0; status == QDOT_OK && (name = qdot_names_at(session->names, i)) != NULL; i++)
        if (name->kind == QDOT_NAME_SPEED) {
            status = qdot_declared_print(session, name, &text);
            qdot_text_char(&text, '\n');
        }
    if (status == QDOT_OK && text.n == 0)
        qdot_text_add(&text, "the scene is empty");
    return qdot_answer_written(session, "scene", status, &text);
}
