/* row-answer.c -- rows of many runs as answers. */
#include "lang/answer/row-answer.h"

#include <math.h>

#include "base/interrupt.h"
#include "base/number-text.h"
#include "base/utf8.h"
#include "base/wrap.h"
#include "lang/answer/write.h"

/* Failed rows that are told one by one. */
enum { FEW = 5 };

qdot_status
qdot_row_answer_json(qdot_session *session, const qdot_row_table *table, size_t k)
{
    const double *const values = table->values + k * table->n;
    const double *const errors = table->errors + k * table->n;
    qdot_text line = {0};

    qdot_write_field(&line, "{\"kind\":\"row\",\"name\":", table->name);
    for (size_t i = 0; i < table->n; i++) {
        qdot_text_add(&line, i == 0 ? ",\"values\":[" : ",");
        qdot_number_text_json(&line, values[i]);
    }
    for (size_t i = 0; i < table->n; i++) {
        qdot_text_add(&line, i == 0 ? "],\"errors\":[" : ",");
        qdot_number_text_json(&line, errors[i]);
    }
    qdot_write_field(&line, "],\"status\":",
                     table->reasons[k] == NULL || table->note != NULL ? "done" : "failed");
    if (table->note != NULL && table->reasons[k] != NULL) {
        qdot_text_format(&line, ",\"%s\":", table->note);
        qdot_write_field(&line, "", table->reasons[k]);
    } else if (table->reasons[k] == NULL)
        qdot_text_add(&line, ",\"reason\":null");
    else
        qdot_write_field(&line, ",\"reason\":", table->reasons[k]);
    qdot_text_add(&line, "}\n");
    return qdot_write(session, session->out, &line);
}

/* Which row it is: "omega = 0.5, theta = 1". */
static void
name_row(const qdot_row_table *table, size_t k, qdot_text *text)
{
    for (size_t i = 0; i < table->n_swept; i++) {
        const double x = table->values[k * table->n + i];

        if (isnan(x)) /* there is no time where a run has failed */
            continue;
        qdot_text_format(text, "%s%s = ", i > 0 ? ", " : "", table->labels[i]);
        qdot_number_text(text, x, 0);
    }
}

static void
say_failed(const qdot_row_table *table, qdot_text *text)
{
    size_t failed = 0;

    for (size_t k = 0; table->note == NULL && k < table->rows; k++) {
        if (table->reasons[k] == NULL || ++failed > FEW)
            continue;
        name_row(table, k, text);
        qdot_text_format(text, ": %s\n", table->reasons[k]);
    }
    if (failed > FEW)
        qdot_text_format(text, "and %zu more rows failed\n", failed - FEW);
}

/* The cell of column i in row k, or of its head for k == rows: its columns on a terminal. */
static size_t
write_cell(const qdot_row_table *table, size_t k, size_t i, qdot_text *cell)
{
    const size_t at = k * table->n + i;

    qdot_text_truncate(cell, 0);
    if (k == table->rows)
        qdot_text_add(cell, table->labels[i]);
    else if (isnan(table->values[at])
             || !qdot_number_is_known(table->values[at], table->errors[at]))
        qdot_text_char(cell, '-');
    else
        qdot_number_text(cell, table->values[at], table->errors[at]);
    return qdot_utf8_columns(qdot_text_str(cell), cell->n);
}

/* The numbers in columns, each with the digits that its error leaves. */
static qdot_status
write_table(const qdot_row_table *table, qdot_text *out)
{
    size_t *width = qdot_calloc(table->n, sizeof *width);
    qdot_text cell = {0};
    qdot_status status = width ? QDOT_OK : QDOT_ENOMEM;

    for (size_t k = 0; k <= table->rows && status == QDOT_OK; k++) {
        for (size_t i = 0; i < table->n; i++) {
            const size_t own = write_cell(table, k, i, &cell);

            width[i] = own > width[i] ? own : width[i];
        }
        status = qdot_interrupt_check();
    }
    for (size_t k = 0; k <= table->rows && status == QDOT_OK; k++) {
        for (size_t i = 0; i < table->n; i++) {
            const size_t own = write_cell(table, k == 0 ? table->rows : k - 1, i, &cell);

            qdot_text_format(out, "%s%*s%s", i > 0 ? QDOT_WRAP_CELL "  " : "",
                             (int)(width[i] - own), "", qdot_text_str(&cell));
        }
        if (table->note != NULL)
            qdot_text_format(out, QDOT_WRAP_CELL "  %s",
                             k == 0                          ? table->note
                             : table->reasons[k - 1] != NULL ? table->reasons[k - 1]
                                                             : "");
        qdot_text_char(out, '\n');
    }
    if (status == QDOT_OK)
        status = qdot_text_status(&cell);
    qdot_text_clear(&cell);
    qdot_free(width);
    return status;
}

qdot_status
qdot_row_answer(qdot_session *session, const qdot_row_table *table)
{
    qdot_text text = {0};
    qdot_status status;

    for (size_t k = 0; session->json && k < table->rows; k++)
        QDOT_TRY(qdot_row_answer_json(session, table, k));
    if (session->json)
        return QDOT_OK;
    status = write_table(table, &text);
    if (status == QDOT_OK)
        say_failed(table, &text);
    return qdot_answer_written(session, table->name, status, &text);
}
