/* vars.c -- the statement `vars`: lists every declared name. */
#include "lang/answer/answer.h"
#include "lang/ask/declared.h"
#include "lang/syntax/record.h"

static qdot_status carry_out_vars(qdot_record *r);

QDOT_STATEMENT(vars) = {
    .word = "vars",
    .group = QDOT_WORKBENCH,
    .usage = "vars",
    .summary = "every declared name",
    .example = "vars",
    .alone = true,
    .handler = carry_out_vars,
};

static qdot_status
carry_out_vars(qdot_record *r)
{
    qdot_session *session = r->cursor.session;
    qdot_text text = {0};
    qdot_status status = QDOT_OK;

    for (size_t i = 0; qdot_names_at(session->names, i) != NULL && status == QDOT_OK;
         i++) {
        qdot_text_add(&text, i > 0 ? "\n" : "");
        status = qdot_declared_print(session, qdot_names_at(session->names, i), &text);
    }
    if (status == QDOT_OK && text.n == 0)
        qdot_text_add(&text, "nothing is declared");
    return qdot_answer_written(session, "vars", status, &text);
}
