/* digits-table.c -- tables of runs that were made with the option `digits`, with many digits in each cell. */
#include "lang/files/digits-table.h"

#include "base/interrupt.h"
#include "base/number-text.h"
#include "lang/answer/digits.h"
#include "lang/answer/table-answer.h"
#include "lang/runs/data-file.h"
#include "lang/session/bind.h"

/* TIMES: the number of columns of time, one to be read and one for files. */
enum { TIMES = 2 };

typedef struct {
    qdot_dataset table;
    size_t n;
    qdot_text *names; /* [n] names of the columns after the time */
} digits_table;

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

/* Append the names of the components of all operands. */
static qdot_status
append_component_names(digits_table *d, const qdot_operands *list)
{
    size_t n = 0;

    for (size_t i = 0; i < list->n; i++)
        n += list->at[i].columns.n;
    d->names = qdot_calloc(n + 1, sizeof *d->names);
    if (d->names == NULL)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < list->n; i++)
        for (size_t k = 0; k < list->at[i].columns.n; k++) {
            qdot_text *name = &d->names[d->n++];

            qdot_text_add(name, list->at[i].label);
            if (list->at[i].columns.n > 1)
                qdot_text_format(name, "[%zu]", k + 1);
            QDOT_TRY(qdot_text_status(name));
        }
    return QDOT_OK;
}

static qdot_status
begin_digits_table(digits_table *d, const qdot_operands *list)
{
    qdot_table_column *columns;
    qdot_status status;

    QDOT_TRY(append_component_names(d, list));
    columns = qdot_calloc(TIMES + d->n, sizeof *columns);
    if (columns == NULL)
        return QDOT_ENOMEM;
    columns[0] = (qdot_table_column){.name = "t", .in = ~(unsigned)QDOT_IN_FILES};
    columns[1] = (qdot_table_column){.name = "t", .in = QDOT_IN_FILES};
    for (size_t j = 0; j < d->n; j++)
        columns[TIMES + j] =
            (qdot_table_column){.name = qdot_text_str(&d->names[j]), .kind = QDOT_CELL_TEXT, .gap = 2};
    status = qdot_table_begin(&d->table, TIMES + d->n, columns);
    qdot_free(columns);
    return status;
}

static void
free_digits_table(digits_table *d)
{
    qdot_table_clear(&d->table);
    for (size_t j = 0; j < d->n; j++)
        qdot_text_clear(&d->names[j]);
    qdot_free(d->names);
}

/* Where a row of the table is evaluated: a time, or the point of the run just before or after an event. */
typedef struct {
    qdot_expr time;
    bool beside;
    size_t point;
} place;

/* Add to a row the values of one operand at the time `at`. */
static qdot_status
add_values(qdot_session *session, qdot_dataset *t, const qdot_operand *o, const place *at, int digits)
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
        qdot_table_add_written(t, &text);
    }
    qdot_free(errors);
    qdot_free(values);
    return status;
}

static qdot_status
add_row(qdot_session *session, qdot_dataset *t, const qdot_operands *list, const place *at, int digits)
{
    qdot_text text = {0};
    double x = qdot_run_get_report(list->at[0].run)->t1;
    qdot_status status =
        at->time != QDOT_NIL ? qdot_session_number(session, at->time, &x, NULL) : QDOT_OK;

    if (status == QDOT_OK) {
        qdot_number_text(&text, x, 0);
        qdot_table_add_written(t, &text);
        qdot_table_add_number(t, x + 0.0, 0); /* adding 0.0 changes -0 into 0 */
    }
    for (size_t i = 0; i < list->n && status == QDOT_OK; i++)
        status = add_values(session, t, &list->at[i], at, digits);
    return status;
}

qdot_status
qdot_digits_table(qdot_session *session, const qdot_operands *list, qdot_run *run, size_t rows,
                  const qdot_expr *times, const bool *beside, const char *path)
{
    const int digits = qdot_digits_table_of(list);
    digits_table d = {0};
    qdot_status status = begin_digits_table(&d, list);

    for (size_t k = 0; k < rows && status == QDOT_OK; k++) {
        const place at = {times[k], beside != NULL && beside[k], k};

        status = qdot_interrupt_check();
        if (status == QDOT_OK)
            status = add_row(session, &d.table, list, &at, digits);
    }
    if (status == QDOT_OK)
        status = qdot_table_status(&d.table);
    if (status == QDOT_OK)
        status = path != NULL ? qdot_data_file_write(session, run, &d.table, path)
                              : qdot_answer_table(session, "table", &d.table);
    free_digits_table(&d);
    return status;
}
