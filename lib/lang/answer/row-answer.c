/* row-answer.c -- prints the rows of many runs: sweeps, ensembles. */
#include "lang/answer/row-answer.h"

#include <math.h>

#include "base/number-text.h"
#include "lang/answer/table-answer.h"
#include "lang/answer/write.h"
#include "lang/session/output.h"
#include "lang/session/row-columns.h"

/* The most failed rows that are listed individually. */
enum { FEW = 5 };

/* Append the parameter values of row k: "omega = 0.5, theta = 1". */
static void
append_row_parameters(const qdot_row_table *table, size_t k, qdot_text *text)
{
    for (size_t i = 0; i < table->n_swept; i++) {
        const double x = table->values[k * table->n + i];

        if (isnan(x)) /* a failed run has no time */
            continue;
        qdot_text_format(text, "%s%s = ", i > 0 ? ", " : "", table->labels[i]);
        qdot_number_text(text, x, 0);
    }
}

static void
append_failed_rows(const qdot_row_table *table, qdot_text *text)
{
    size_t failed = 0;

    for (size_t k = 0; table->note == NULL && k < table->rows; k++) {
        if (table->reasons[k] == NULL || ++failed > FEW)
            continue;
        append_row_parameters(table, k, text);
        qdot_text_format(text, ": %s\n", table->reasons[k]);
    }
    if (failed > FEW)
        qdot_text_format(text, "and %zu more rows failed\n", failed - FEW);
}

qdot_status
qdot_row_answer_part(qdot_session *session, const qdot_row_table *table, size_t from, size_t to)
{
    qdot_row_columns x = {0};
    qdot_status status = qdot_row_columns_of(table, NULL, &x);

    if (status == QDOT_OK && from == 0)
        status = qdot_answer_columns(session, table->name, &x.table);
    for (size_t k = from; k < to && status == QDOT_OK; k++)
        status = qdot_answer_row(session, &x.table, k);
    qdot_row_columns_free(&x);
    return status;
}

qdot_status
qdot_row_answer(qdot_session *session, const qdot_row_table *table)
{
    qdot_row_columns x = {0};
    qdot_text text = {0};
    qdot_status status = qdot_row_columns_of(table, NULL, &x);

    if (status == QDOT_OK && session->output->json) {
        status = qdot_answer_rows(session, table->name, &x.table);
    } else if (status == QDOT_OK) {
        status = qdot_answer_add_table(&x.table, &text);
        if (status == QDOT_OK)
            append_failed_rows(table, &text);
        status = qdot_answer_written(session, table->name, status, &text);
    }
    qdot_row_columns_free(&x);
    return status;
}
