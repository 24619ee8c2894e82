/* table-answer.c -- gives tables as answers, as text or JSON. */
#include "lang/answer/table-answer.h"

#include <math.h>
#include <string.h>

#include "base/number-text.h"
#include "base/wrap.h"
#include "lang/answer/shown-text.h"
#include "lang/answer/typed-name.h"
#include "lang/answer/write.h"
#include "lang/session/output.h"
#include "table/json.h"
#include "table/text.h"

/* --- rows that are displayed ----------------------------------------------------------------- */

/* The field with the reason of a row that failed: the prompt tells it below the table, a page in the row. */
static const char reason[] = "reason";

static bool
is_reason(const qdot_table_column *c)
{
    return c->field != NULL && strcmp(c->field, reason) == 0;
}

/* Append the cell, a number with its error where that is known: 1.25 ± 3e-13. */
static void
print_cell_with_error(const qdot_dataset *t, size_t row, size_t column, qdot_text *out)
{
    const qdot_table_column *c = &t->columns[column];
    const qdot_table_cell cell = qdot_table_at(t, row, column);
    const bool number = c->measured && c->kind == QDOT_CELL_NUMBER && cell.text == NULL && isfinite(cell.value) &&
                        qdot_number_is_known(cell.value, cell.error);

    if (number)
        qdot_number_text_with_error(out, cell.value, cell.error);
    else
        qdot_table_print_cell(t, row, column, 0, "\u2013", out);
}

/* Append what a person reads of a row, or of the heads for row == t->rows, before the end of its object. */
static qdot_status
append_shown_row(qdot_session *session, const qdot_dataset *t, size_t row, qdot_text *object)
{
    const bool heads = row == t->rows;
    qdot_status status = qdot_text_status(object);
    qdot_shown_row shown;

    QDOT_TRY(status);
    shown = qdot_shown_row_begin(heads);
    qdot_text_truncate(object, object->n - strlen("}\n"));
    for (size_t j = 0; j < t->n && status == QDOT_OK; j++) {
        const qdot_table_column *c = &t->columns[j];
        const bool in_table = qdot_table_shows(t, j, QDOT_IN_TERMINAL);
        qdot_text cell = {0};

        if (!in_table && (!is_reason(c) || heads || qdot_table_at(t, row, j).text == NULL))
            continue;
        if (heads) {
            status = qdot_typed_name_print(session, c->head != NULL ? c->head : c->name, QDOT_UNICODE, &cell);
            if (c->unit != NULL)
                qdot_text_format(&cell, " [%s]", c->unit);
        } else {
            print_cell_with_error(t, row, j, &cell);
        }
        qdot_shown_cell(&shown, qdot_text_str(&cell), c->left);
        object->failed = object->failed || cell.failed;
        qdot_text_clear(&cell);
    }
    qdot_shown_row_end(&shown, object);
    qdot_text_add(object, "}\n");
    return status;
}

/* --- answers of tables ------------------------------------------------------------------------ */

qdot_status
qdot_answer_columns(qdot_session *session, const char *name, const qdot_dataset *t)
{
    qdot_status status = QDOT_OK;
    qdot_text line = {0};

    qdot_table_json_columns(t, name, &line);
    if (qdot_write_displays(session))
        status = append_shown_row(session, t, t->rows, &line);
    return qdot_write_answer(session, status, &line);
}

qdot_status
qdot_answer_row(qdot_session *session, const qdot_dataset *t, size_t row)
{
    qdot_status status = QDOT_OK;
    qdot_text line = {0};

    qdot_table_json_row(t, row, &line);
    if (qdot_write_displays(session))
        status = append_shown_row(session, t, row, &line);
    return qdot_write_answer(session, status, &line);
}

qdot_status
qdot_answer_rows(qdot_session *session, const char *name, const qdot_dataset *t)
{
    QDOT_TRY(qdot_table_status(t));
    if (t->rows > 0)
        QDOT_TRY(qdot_answer_columns(session, name, t));
    for (size_t k = 0; k < t->rows; k++)
        QDOT_TRY(qdot_answer_row(session, t, k));
    return QDOT_OK;
}

qdot_status
qdot_answer_add_table(const qdot_dataset *t, qdot_text *out)
{
    static const qdot_table_text_options options = {QDOT_IN_TERMINAL, 0, QDOT_WRAP_CELL};

    return qdot_table_text(t, &options, out);
}

qdot_status
qdot_answer_table(qdot_session *session, const char *name, const qdot_dataset *t)
{
    qdot_text text = {0};
    qdot_status status;

    if (session->output->json)
        return qdot_answer_rows(session, name, t);
    status = qdot_answer_add_table(t, &text);
    return qdot_answer_written(session, name, status, &text);
}
