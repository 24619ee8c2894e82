/* table-answer.c -- gives tables as answers, as text or JSON. */
#include "lang/answer/table-answer.h"

#include "base/wrap.h"
#include "lang/answer/write.h"
#include "lang/session/output.h"
#include "table/json.h"
#include "table/text.h"

qdot_status
qdot_answer_columns(qdot_session *session, const char *name, const qdot_table *t)
{
    qdot_text line = {0};

    qdot_table_json_columns(t, name, &line);
    return qdot_write_object(session, session->output->out, &line);
}

qdot_status
qdot_answer_row(qdot_session *session, const qdot_table *t, size_t row)
{
    qdot_text line = {0};

    qdot_table_json_row(t, row, &line);
    return qdot_write_object(session, session->output->out, &line);
}

qdot_status
qdot_answer_rows(qdot_session *session, const char *name, const qdot_table *t)
{
    QDOT_TRY(qdot_table_status(t));
    if (t->rows > 0)
        QDOT_TRY(qdot_answer_columns(session, name, t));
    for (size_t k = 0; k < t->rows; k++)
        QDOT_TRY(qdot_answer_row(session, t, k));
    return QDOT_OK;
}

qdot_status
qdot_answer_add_table(const qdot_table *t, qdot_text *out)
{
    static const qdot_table_text_options options = {QDOT_IN_TERMINAL, 0, QDOT_WRAP_CELL};

    return qdot_table_text(t, &options, out);
}

qdot_status
qdot_answer_table(qdot_session *session, const char *name, const qdot_table *t)
{
    qdot_text text = {0};
    qdot_status status;

    if (session->output->json)
        return qdot_answer_rows(session, name, t);
    status = qdot_answer_add_table(t, &text);
    return qdot_answer_written(session, name, status, &text);
}
