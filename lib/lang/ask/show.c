/* show.c -- the statement `show`: tells what a name means and where it was declared. */
#include <string.h>

#include "lang/answer/answer.h"
#include "lang/ask/declared.h"
#include "lang/functions/builtin.h"
#include "lang/functions/quantity.h"
#include "lang/session/runs.h"
#include "lang/syntax/record.h"
#include "lang/syntax/statement.h"

static qdot_status show_meaning_of_name(qdot_record *r);

QDOT_STATEMENT(show) = {
    .word = "show",
    .group = QDOT_WORKBENCH,
    .usage = "show NAME",
    .summary = "what a name means and where it was declared",
    .example = "show m",
    .handler = show_meaning_of_name,
};

/* Print the line of the scene that declares a label. */
static qdot_status
show_declaration_of_label(qdot_session *session, const char *label, qdot_text *out)
{
    qdot_text scene = {0};
    qdot_status status = qdot_scene_print(session->scene, &scene);
    size_t n = strlen(label);

    for (const char *line = qdot_text_str(&scene); status == QDOT_OK && *line != '\0';) {
        const char *end = strchrnul(line, '\n'), *word = strchr(line, ' ');

        if (word != NULL && word < end && strncmp(word + 1, label, n) == 0 &&
            strchr(" :", word[1 + n]) != NULL) {
            qdot_text_add_n(out, line, (size_t)(end - line));
            break;
        }
        line = *end == '\0' ? end : end + 1;
    }
    qdot_text_clear(&scene);
    return status;
}

/* Print the `run` statement by which the run of this name was made; false if there is no such run. */
static bool
show_statement_of_run(const qdot_session *session, const char *name, qdot_text *out)
{
    for (size_t i = 0; i < session->runs->n; i++)
        if (strcmp(session->runs->at[i].name, name) == 0) {
            qdot_text_format(out, "run %s as %s", session->runs->at[i].text, name);
            return true;
        }
    return false;
}

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
        status = show_declaration_of_label(session, name, &text);
    } else if (show_statement_of_run(session, name, &text)) {
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
