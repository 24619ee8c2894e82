/* digits-table.c -- rows of many digits. */
#include "lang/files/digits-table.h"

#include <stdlib.h>
#include <string.h>

#include "base/interrupt.h"
#include "base/number-text.h"
#include "base/wrap.h"
#include "lang/answer/answer.h"
#include "lang/answer/digits.h"
#include "lang/files/data-file.h"
#include "lang/session/bind.h"

/* All cells, row by row, the labels first. */
typedef struct {
    size_t columns;
    qdot_vec(char *) cells;
    size_t *width; /* [columns] */
} cells;

int
qdot_digits_table_of(const qdot_operands *list)
{
    int fewest = 0;

    for (size_t i = 0; i < list->n; i++) {
        int digits = qdot_run_get_report(list->at[i].run)->digits;

        if (digits == 0)
            return 0;
        fewest = fewest == 0 || digits < fewest ? digits : fewest;
    }
    return fewest;
}

static qdot_status
cells_add(cells *t, qdot_text *text)
{
    qdot_status status = qdot_text_status(text);
    char *copy;

    if (status != QDOT_OK)
        return status;
    copy = qdot_strdup(qdot_text_str(text));
    qdot_text_truncate(text, 0);
    if (copy == NULL)
        return QDOT_ENOMEM;
    if (qdot_vec_push(&t->cells, copy) != QDOT_OK) {
        qdot_free(copy);
        return QDOT_ENOMEM;
    }
    return QDOT_OK;
}

static qdot_status
add_labels(cells *t, const qdot_operands *list)
{
    qdot_text text = {0};
    qdot_status status;

    qdot_text_add(&text, "t");
    status = cells_add(t, &text);
    for (size_t i = 0; i < list->n; i++)
        for (size_t k = 0; k < list->at[i].columns.n && status == QDOT_OK; k++) {
            qdot_text_add(&text, list->at[i].label);
            if (list->at[i].columns.n > 1)
                qdot_text_format(&text, "[%zu]", k + 1);
            status = cells_add(t, &text);
        }
    qdot_text_clear(&text);
    t->columns = t->cells.n;
    return status;
}

/* Where a row is: at a time, or at a point of the run beside an event. */
typedef struct {
    qdot_expr time;
    bool beside;
    size_t point;
} place;

/* The values of one operand at a place. */
static qdot_status
add_values(qdot_session *session, cells *t, const qdot_operand *o, const place *at, int digits)
{
    const size_t n = o->columns.n;
    double *errors = qdot_calloc(n, sizeof *errors);
    qdot_expr *values = qdot_calloc(n, sizeof *values);
    qdot_status status = errors == NULL || values == NULL ? QDOT_ENOMEM : QDOT_OK;
    qdot_text text = {0};

    if (status == QDOT_OK)
        status = at->beside ? qdot_run_exact_point_values(o->run, n, o->columns.at, at->point, values,
                                                          errors)
                            : qdot_run_exact_values(o->run, n, o->columns.at, at->time, values,
                                                    errors);
    for (size_t k = 0; k < n && status == QDOT_OK; k++) {
        status = qdot_digits_text(session, values[k], digits, errors[k], &text);
        if (status == QDOT_OK)
            status = cells_add(t, &text);
    }
    qdot_text_clear(&text);
    qdot_free(errors);
    qdot_free(values);
    return status;
}

static qdot_status
add_row(qdot_session *session, cells *t, const qdot_operands *list, const place *at, int digits)
{
    qdot_text text = {0};
    double x = qdot_run_get_report(list->at[0].run)->t1;
    qdot_status status =
        at->time != QDOT_NIL ? qdot_session_number(session, at->time, &x, NULL) : QDOT_OK;

    if (status == QDOT_OK) {
        qdot_number_text(&text, x, 0);
        status = cells_add(t, &text);
    }
    for (size_t i = 0; i < list->n && status == QDOT_OK; i++)
        status = add_values(session, t, &list->at[i], at, digits);
    qdot_text_clear(&text);
    return status;
}

/* --- forms --------------------------------------------------------------------------- */

static void
write_text(const cells *t, const char *mark, qdot_text *out)
{
    for (size_t i = 0; i < t->cells.n; i++) {
        size_t n = strlen(t->cells.at[i]), j = i % t->columns;

        t->width[j] = n > t->width[j] ? n : t->width[j];
    }
    for (size_t i = 0; i < t->cells.n; i++) {
        size_t j = i % t->columns;

        qdot_text_format(out, "%s%s%*s", j > 0 ? mark : "", j > 0 ? "  " : "",
                         (int)t->width[j], t->cells.at[i]);
        if (j + 1 == t->columns)
            qdot_text_char(out, '\n');
    }
}

static void
write_csv(const cells *t, qdot_text *out)
{
    for (size_t i = 0; i < t->cells.n; i++) {
        const bool quoted = strpbrk(t->cells.at[i], ",\"") != NULL;

        qdot_text_add(out, quoted ? "\"" : "");
        for (const char *c = t->cells.at[i]; *c != '\0'; c++) {
            if (*c == '"')
                qdot_text_char(out, '"');
            qdot_text_char(out, *c);
        }
        qdot_text_add(out, quoted ? "\"" : "");
        qdot_text_char(out, (i + 1) % t->columns == 0 ? '\n' : ',');
    }
}

static qdot_status
answer_json(qdot_session *session, const cells *t)
{
    for (size_t i = t->columns; i < t->cells.n; i += t->columns) {
        qdot_text values = {0};
        qdot_status status;

        qdot_text_add(&values, t->cells.at[i]);
        for (size_t j = 1; j < t->columns; j++)
            qdot_text_format(&values, ",\"%s\"", t->cells.at[i + j]);
        status = qdot_answer_cells(session, &values);
        qdot_text_clear(&values);
        QDOT_TRY(status);
    }
    return QDOT_OK;
}

/* As columns of texts, the time as numbers. */
static qdot_status
write_file(qdot_session *session, qdot_run *run, const cells *t, const char *path)
{
    const size_t rows = t->cells.n / t->columns - 1;
    qdot_column *columns = qdot_calloc(t->columns, sizeof *columns);
    char **texts = qdot_calloc(t->columns * rows + 1, sizeof *texts);
    char *const **of = qdot_calloc(t->columns, sizeof *of);
    double *times = qdot_calloc(rows + 1, sizeof *times);
    qdot_data data = {.columns = t->columns, .rows = rows, .column = columns, .texts = of};
    qdot_status status = columns && texts && of && times ? QDOT_OK : QDOT_ENOMEM;

    for (size_t j = 0; j < t->columns && status == QDOT_OK; j++) {
        for (size_t i = 0; i < rows; i++)
            texts[j * rows + i] = t->cells.at[(i + 1) * t->columns + j];
        columns[j] = (qdot_column){t->cells.at[j], times};
        of[j] = j > 0 ? texts + j * rows : NULL;
    }
    for (size_t i = 0; i < rows && status == QDOT_OK; i++)
        times[i] = strtod(texts[i], NULL);
    if (status == QDOT_OK)
        status = qdot_data_file_write_texts(session, run, &data, path);
    qdot_free(columns);
    qdot_free(texts);
    qdot_free(of);
    qdot_free(times);
    return status;
}

static qdot_status
digits_table_tell(qdot_session *session, qdot_run *run, const cells *t, const char *path)
{
    const char *dot = path != NULL ? strrchr(path, '.') : NULL;
    const bool csv = dot != NULL && strcmp(dot, ".csv") == 0;
    qdot_text text = {0};
    qdot_status status;

    if (path != NULL && !csv && (dot == NULL || strcmp(dot, ".txt") != 0))
        return write_file(session, run, t, path);
    if (path == NULL && session->json)
        return answer_json(session, t);
    if (csv)
        write_csv(t, &text);
    else
        write_text(t, path == NULL ? QDOT_WRAP_CELL : "", &text);
    status = qdot_text_status(&text);
    if (status == QDOT_OK)
        status = path != NULL ? qdot_answer_in_file(session, path, &text)
                              : qdot_answer_text(session, "table", qdot_text_str(&text));
    qdot_text_clear(&text);
    return status;
}

qdot_status
qdot_digits_table(qdot_session *session, const qdot_operands *list, qdot_run *run, size_t rows,
                  const qdot_expr *times, const bool *beside, const char *path)
{
    const int digits = qdot_digits_table_of(list);
    cells t = {0};
    qdot_status status = add_labels(&t, list);

    for (size_t k = 0; k < rows && status == QDOT_OK; k++) {
        const place at = {times[k], beside != NULL && beside[k], k};

        status = qdot_interrupt_check();
        if (status == QDOT_OK)
            status = add_row(session, &t, list, &at, digits);
    }
    t.width = qdot_calloc(t.columns + 1, sizeof *t.width);
    if (status == QDOT_OK)
        status = t.width == NULL ? QDOT_ENOMEM : digits_table_tell(session, run, &t, path);
    for (size_t i = 0; i < t.cells.n; i++)
        qdot_free(t.cells.at[i]);
    qdot_free(t.cells.at);
    qdot_free(t.width);
    return status;
}
