/* sweep-file.c -- the rows of a sweep that are done, in a file. */
#include "lang/runs/sweep-file.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "show/data.h"
#include "show/hdf5-read.h"

static const char fact[] = "sweep";

/* How many columns the file has, and the place of those that are not just the table's. */
static size_t
count(const qdot_row_table *t)
{
    return 1 + t->n + (t->n - t->n_swept) + 1;
}

/* --- written -------------------------------------------------------------------------- */

typedef struct {
    double *numbers; /* [columns - 1][rows] */
    char **reasons;  /* [rows] */
    char *const **texts; /* [columns] */
    qdot_column *columns;
    qdot_text *labels;
    size_t n, rows;
} sheet;

static void
free_sheet(sheet *x)
{
    for (size_t i = 0; x->labels && i < x->n; i++)
        qdot_text_clear(&x->labels[i]);
    qdot_free(x->labels);
    qdot_free(x->columns);
    qdot_free(x->texts);
    qdot_free(x->reasons);
    qdot_free(x->numbers);
}

static qdot_status
fill(const qdot_row_table *t, const bool *done, sheet *x)
{
    static char none[] = "";
    size_t at = 0;

    for (size_t k = 0; k < t->rows; k++)
        x->rows += done[k];
    x->n = count(t);
    x->numbers = qdot_calloc(x->n * x->rows + 1, sizeof *x->numbers);
    x->reasons = qdot_calloc(x->rows + 1, sizeof *x->reasons);
    x->texts = qdot_calloc(x->n, sizeof *x->texts);
    x->columns = qdot_calloc(x->n, sizeof *x->columns);
    x->labels = qdot_calloc(x->n, sizeof *x->labels);
    if (!x->numbers || !x->reasons || !x->texts || !x->columns || !x->labels)
        return QDOT_ENOMEM;
    for (size_t k = 0; k < t->rows; k++) {
        if (!done[k])
            continue;
        x->numbers[at] = (double)k;
        for (size_t i = 0; i < t->n; i++)
            x->numbers[(1 + i) * x->rows + at] = t->values[k * t->n + i];
        for (size_t i = t->n_swept; i < t->n; i++)
            x->numbers[(1 + t->n + i - t->n_swept) * x->rows + at] = t->errors[k * t->n + i];
        x->reasons[at++] = t->reasons[k] != NULL ? t->reasons[k] : none;
    }
    x->texts[x->n - 1] = x->reasons;
    for (size_t i = 0; i < x->n; i++) {
        qdot_text_add(&x->labels[i], i == 0            ? "row"
                                     : i <= t->n       ? t->labels[i - 1]
                                     : i + 1 == x->n   ? "reason"
                                                       : "error of ");
        if (i > t->n && i + 1 < x->n)
            qdot_text_add(&x->labels[i], t->labels[i - 1 - t->n + t->n_swept]);
        QDOT_TRY(qdot_text_status(&x->labels[i]));
        x->columns[i] = (qdot_column){qdot_text_str(&x->labels[i]), x->numbers + i * x->rows};
    }
    return QDOT_OK;
}

qdot_status
qdot_sweep_file_keep(const qdot_row_table *t, const bool *done, const char *said,
                     const char *path)
{
    const qdot_data_fact facts[] = {{"program", PACKAGE_STRING, 0}, {fact, said, 0}};
    qdot_text beside = {0};
    sheet x = {0};
    qdot_status status = fill(t, done, &x);

    qdot_text_format(&beside, "%s.part", path);
    if (status == QDOT_OK)
        status = qdot_text_status(&beside);
    if (status == QDOT_OK) {
        const qdot_data data = {.title = t->name, .columns = x.n, .rows = x.rows,
                                .column = x.columns, .texts = (char *const *const *)x.texts,
                                .n_facts = 2, .facts = facts};

        status = qdot_data_hdf5(&data, beside.at);
    }
    if (status == QDOT_OK && rename(beside.at, path) != 0)
        status = qdot_fail(QDOT_EIO, "%.200s cannot be written: %s", path, strerror(errno));
    free_sheet(&x);
    qdot_text_clear(&beside);
    return status;
}

/* --- read ----------------------------------------------------------------------------- */

static qdot_status
take_rows(const qdot_data_columns *from, const char *path, qdot_row_table *t, bool *done)
{
    const qdot_data_read_column *c = from->at.at;
    const qdot_data_read_column *reasons = &c[count(t) - 1];

    for (size_t at = 0; at < from->rows; at++) {
        const double row = qdot_data_read_number(&c[0], at);
        const char *reason = reasons->bytes + at * reasons->size;
        size_t k;

        if (!(row >= 0 && row < (double)t->rows && row == floor(row)))
            return qdot_fail(QDOT_EINVAL, "%.200s has a row %g that the sweep has not", path, row);
        k = (size_t)row;
        for (size_t i = 0; i < t->n; i++) {
            t->values[k * t->n + i] = qdot_data_read_number(&c[1 + i], at);
            t->errors[k * t->n + i] =
                i < t->n_swept
                    ? 0
                    : qdot_data_read_number(&c[1 + t->n + i - t->n_swept], at);
        }
        if (*reason != '\0' && t->reasons[k] == NULL) {
            t->reasons[k] = qdot_strdup(reason);
            if (t->reasons[k] == NULL)
                return QDOT_ENOMEM;
        }
        done[k] = true;
    }
    return QDOT_OK;
}

static qdot_status
check(const qdot_data_columns *from, const char *path, const char *said, const qdot_row_table *t)
{
    const size_t n = count(t);
    bool good = from->at.n == n && strcmp(qdot_text_str(&from->text), said) == 0;

    for (size_t i = 0; i < n && good; i++)
        good = (from->at.at[i].size > 0) == (i + 1 == n);
    if (good)
        return QDOT_OK;
    (void)qdot_fail(QDOT_EINVAL, "%.200s holds the rows of another sweep, or of another scene", path);
    return qdot_hint("give another name, or remove the file");
}

qdot_status
qdot_sweep_file_take(const char *path, const char *said, qdot_row_table *t, bool *done)
{
    qdot_data_columns from = {0};
    qdot_status status;

    if (access(path, F_OK) != 0 && errno == ENOENT)
        return QDOT_OK;
    status = qdot_data_read_hdf5(path, fact, &from);
    if (status == QDOT_OK)
        status = check(&from, path, said, t);
    if (status == QDOT_OK)
        status = take_rows(&from, path, t, done);
    qdot_data_columns_clear(&from);
    return status;
}
