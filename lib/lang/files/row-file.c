/* row-file.c -- prints the rows of many runs, or writes them to a file. */
#include "lang/files/row-file.h"

#include "lang/answer/row-answer.h"
#include "lang/runs/data-file.h"
#include "lang/session/row-columns.h"

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
qdot_row_file_answer(qdot_record *r, const qdot_row_table *table)
{
    const qdot_filled *file = qdot_record_hole(r, "to", NULL);

    if (file == NULL)
        return qdot_row_answer(r->cursor.session, table);
    qdot_record_blame(r, file);
    QDOT_TRY(qdot_data_file_check(qdot_record_text(file)));
    return write_file(r->cursor.session, table, qdot_record_text(file));
}
