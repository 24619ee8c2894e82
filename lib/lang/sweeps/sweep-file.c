/* sweep-file.c -- the rows of a sweep that are done, in a file. */
#include "lang/sweeps/sweep-file.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "lang/session/row-columns.h"
#include "show/hdf5-read.h"

static const char fact[] = "sweep";

/* --- written -------------------------------------------------------------------------- */

qdot_status
qdot_sweep_file_keep(const qdot_row_table *t, const bool *done, const char *said,
                     const char *path)
{
    const qdot_data_fact facts[] = {{"program", PACKAGE_STRING, 0}, {fact, said, 0}};
    qdot_text beside = {0};
    qdot_row_columns x = {0};
    qdot_status status = qdot_row_columns_fill(t, done, &x);

    qdot_text_format(&beside, "%s.part", path);
    if (status == QDOT_OK)
        status = qdot_text_status(&beside);
    if (status == QDOT_OK) {
        const qdot_data data = {.title = t->name, .columns = x.n + 1, .rows = x.rows,
                                .column = x.columns, .texts = (char *const *const *)x.texts,
                                .n_facts = 2, .facts = facts};

        status = qdot_data_hdf5(&data, beside.at);
    }
    if (status == QDOT_OK && rename(beside.at, path) != 0)
        status = qdot_fail(QDOT_EIO, "%.200s cannot be written: %s", path, strerror(errno));
    qdot_row_columns_free(&x);
    qdot_text_clear(&beside);
    return status;
}

/* --- read ----------------------------------------------------------------------------- */

static qdot_status
take_rows(const qdot_data_columns *from, const char *path, qdot_row_table *t, bool *done)
{
    const qdot_data_read_column *c = from->at.at;
    const qdot_data_read_column *reasons = &c[1 + qdot_row_columns_count(t)];

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
    const size_t n = 1 + qdot_row_columns_count(t) + 1; /* rows, numbers, reasons */
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
