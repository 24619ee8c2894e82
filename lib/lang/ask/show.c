/* show.c -- the statement `show`: tells what a name means and where it was declared. */
#include <string.h>

#include "lang/answer/answer.h"
#include "lang/ask/declared.h"
#include "lang/functions/builtin.h"
#include "lang/functions/quantity.h"
#include "lang/syntax/record.h"
#include "lang/syntax/statement.h"
#include "mech/scene/scene.h"

static qdot_status show_meaning_of_name(qdot_record *r);

QDOT_STATEMENT(show) = {
    .word = "show",
    .group = QDOT_WORKBENCH,
    .usage = "show NAME",
    .summary = "what a name means and where it was declared",
    .example = "show m",
    .handler = show_meaning_of_name,
};

static qdot_status
show_meaning_of_name(qdot_record *r)
{
    qdot_session *session = r->cursor.session;
    qdot_text text = {0};
    qdot_status status = QDOT_OK;
    const qdot_quantity *quantity;
    const qdot_builtin *builtin;
    const qdot_name *known;
    const char *name;

    QDOT_TRY(qdot_record_name(r, qdot_record_hole(r, NULL, "NAME"), &name));
    r->cursor.error_at = r->start->start;
    known = qdot_names_find(session->names, name);
    quantity = qdot_quantity_find(name);
    builtin = qdot_builtin_find(name);
    if (known != NULL) {
        status = qdot_declared_print(session, known, &text);
        if (status == QDOT_OK && known->file != NULL)
            qdot_text_format(&text, "    # %s:%u", known->file, known->line);
    } else if (qdot_scene_has_label(session->scene, name)) {
        status = qdot_declared_label(session, name, &text);
    } else if (qdot_declared_run(session, name, &text)) {
        status = qdot_text_status(&text);
    } else if (quantity != NULL) {
        qdot_text_format(&text, "%s: %s", quantity->usage, quantity->summary);
    } else if (strcmp(name, "pi") == 0 || strcmp(name, "t") == 0) {
        qdot_text_add(&text, name[0] == 't' ? "t: the time" : "pi: the number 3.14159...");
    } else if (builtin != NULL) {
        qdot_text_format(&text, "%s: %s", builtin->usage, builtin->summary);
    } else if (qdot_statement_find(name) != NULL) {
        qdot_text_format(&text, "%s: %s", qdot_statement_find(name)->usage,
                         qdot_statement_find(name)->summary);
    } else {
        const char *near = qdot_names_nearest(session->names, name, 0, NULL);

        (void)qdot_fail(QDOT_ENAME, "`%s` is not declared", name);
        return near != NULL ? qdot_hint("did you mean `%s`?", near)
                            : qdot_hint("`vars` lists what is declared");
    }
    return qdot_answer_written(session, name, status, &text);
}
