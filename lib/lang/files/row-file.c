/* row-file.c -- prints the rows of many runs, or writes them to a file. */
#include "lang/files/row-file.h"

#include "lang/answer/row-answer.h"
#include "lang/figures/figure-file.h"
#include "lang/runs/data-file.h"
#include "lang/session/row-columns.h"

qdot_row_table *
qdot_row_file_named(const qdot_cursor *c)
{
    const qdot_token *behind = c->at + 1;

    if (c->at->kind != QDOT_TOKEN_NAME)
        return NULL;
    if (behind->kind != QDOT_TOKEN_END && !qdot_token_is_word(behind, "to"))
        return NULL;
    return qdot_row_tables_find(c->session, c->at->text);
}

static qdot_status
write_file(qdot_session *session, const qdot_row_table *t, const char *path)
{
    qdot_row_columns x = {0};
    qdot_status status = qdot_row_columns_of(t, NULL, &x);

    if (status == QDOT_OK)
        status = qdot_data_file_write(session, NULL, &x.table, path);
    qdot_row_columns_free(&x);
    return status;
}

qdot_status
qdot_row_file_statement(qdot_cursor *c, const qdot_row_table *table)
{
    const qdot_token *file;
    const char *path = NULL;

    c->at++;
    if (!qdot_cursor_accept_word(c, "to"))
        return qdot_row_answer(c->session, table);
    file = c->at;
    QDOT_TRY(qdot_figure_file_read(c, &path));
    QDOT_TRY(qdot_cursor_expect_end(c));
    c->error_at = file->start;
    QDOT_TRY(qdot_data_file_check(path));
    return write_file(c->session, table, path);
}
