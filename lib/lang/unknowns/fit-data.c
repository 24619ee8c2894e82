/* fit-data.c -- reads the rows of a data file as times, values and standard errors, for the statement `fit`. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "expr/symbol.h"
#include "lang/session/bind.h"
#include "lang/session/session.h"
#include "lang/unknowns/fit-parts.h"

/* The time in a row of the file, and the row's number; for sorting. */
typedef struct {
    double t;
    size_t row;
} sorted;

static int
compare_data_times(const void *a, const void *b)
{
    const sorted *x = a, *y = b;

    return x->t != y->t ? (x->t > y->t) - (x->t < y->t) : (x->row > y->row) - (x->row < y->row);
}

static qdot_status
check_columns(qdot_cursor *c, const qdot_fit *f, const qdot_csv *csv)
{
    const size_t n = f->columns.n;

    if (csv->columns == n)
        return QDOT_OK;
    c->error_at = f->columns.at[n > csv->columns ? csv->columns : n - 1].place->start;
    (void)qdot_csv_fail(f->path, &csv->places[0], "the file has %zu column%s, %zu %s named",
                        csv->columns, csv->columns == 1 ? "" : "s", n, n == 1 ? "is" : "are");
    return csv->columns > n
               ? qdot_hint("`skip` stands for a column that is not used, `sigma` for one of standard errors")
               : qdot_hint("one expression for each column of the file");
}

/* Whether the name is that of the time, or of a coordinate or velocity of the scene. */
static bool
is_name_of_motion(const qdot_fit *f, const char *name)
{
    const qdot_scene *s = f->session->scene;

    for (size_t i = 0; i < s->coordinates.n; i++) {
        /* compare names, not symbols of velocities, which cannot be made after Ctrl-C */
        const char *own = qdot_expr_symbol(s->pool, s->coordinates.at[i])->name;
        const size_t n = strlen(own);

        if (strncmp(name, own, n) == 0 && (name[n] == '\0' || strcmp(name + n, "'") == 0))
            return true;
    }
    return strcmp(name, "t") == 0;
}

/* Refuse a column that is to be read as one variable of the motion but has the name of another in the file. */
static qdot_status
check_column_names(const qdot_fit *f, const qdot_csv *csv)
{
    for (size_t i = 0; i < f->columns.n && csv->names.n == csv->columns; i++) {
        const qdot_csv_name *name = &csv->names.at[i];
        const qdot_fit_column *column = &f->columns.at[i];
        const char *label = column->kind == QDOT_FIT_TIME ? "t" : column->label;

        if ((column->kind != QDOT_FIT_TIME && column->kind != QDOT_FIT_VALUE) || strcmp(name->word, label) == 0 ||
            !is_name_of_motion(f, label) || !is_name_of_motion(f, name->word))
            continue;
        (void)qdot_csv_fail(f->path, &name->place, "the file calls this column `%.40s`, the statement %.40s", name->word,
                            label);
        return qdot_hint("the columns in the order of the file, or another name there");
    }
    return QDOT_OK;
}

/* Read the time, values and standard errors from a row of the data file. */
static qdot_status
read_row(qdot_fit *f, const qdot_csv *csv, size_t row, size_t to)
{
    size_t j = 0;

    for (size_t i = 0; i < f->columns.n; i++) {
        const qdot_fit_column *column = &f->columns.at[i];
        const double x = csv->at[row * csv->columns + i];
        const qdot_csv_place *place = &csv->places[row * csv->columns + i];

        switch (column->kind) {
        case QDOT_FIT_TIME: f->t[to] = x; break;
        case QDOT_FIT_VALUE:
            f->y[to * f->m + j] = x;
            f->sigma[to * f->m + j++] = column->sigma > 0 ? column->sigma : 1;
            break;
        case QDOT_FIT_SIGMA:
            if (!(x > 0)) {
                (void)qdot_csv_fail(f->path, place, "a standard error is positive");
                return qdot_hint("to ignore a number, remove its row");
            }
            f->sigma[to * f->m + j - 1] = x;
            break;
        default: break;
        }
    }
    return QDOT_OK;
}

/* Check that no time lies before the start of the run. */
static qdot_status
check_times(const qdot_fit *f, const qdot_csv *csv)
{
    double from;

    QDOT_TRY(qdot_session_number(f->session, f->from, &from, NULL));
    for (size_t i = 0; i < csv->rows; i++)
        if (csv->at[i * csv->columns] < from) {
            (void)qdot_csv_fail(f->path, &csv->places[i * csv->columns],
                                "the time %.10g lies before the start at %.10g",
                                csv->at[i * csv->columns], from);
            return qdot_hint("`from %.10g`: the start is that of this time",
                             csv->at[i * csv->columns]);
        }
    return QDOT_OK;
}

static qdot_status
read_all_rows(qdot_cursor *c, qdot_fit *f, const qdot_csv *csv)
{
    sorted *order;
    qdot_status status;

    QDOT_TRY(check_columns(c, f, csv));
    c->error_at = f->path_at->start;
    QDOT_TRY(check_column_names(f, csv));
    QDOT_TRY(check_times(f, csv));
    f->rows = csv->rows;
    f->t = qdot_calloc(csv->rows * (1 + 2 * f->m), sizeof *f->t);
    order = qdot_calloc(csv->rows, sizeof *order);
    status = f->t && order ? QDOT_OK : QDOT_ENOMEM;
    f->y = f->t + csv->rows;
    f->sigma = f->y + csv->rows * f->m;
    for (size_t i = 0; i < csv->rows && status == QDOT_OK; i++)
        order[i] = (sorted){csv->at[i * csv->columns], i};
    if (status == QDOT_OK)
        qsort(order, csv->rows, sizeof *order, compare_data_times);
    for (size_t i = 0; i < csv->rows && status == QDOT_OK; i++)
        status = read_row(f, csv, order[i].row, i);
    qdot_free(order);
    return status;
}

qdot_status
qdot_fit_read_data(qdot_cursor *c, qdot_fit *f)
{
    qdot_text path = {0};
    qdot_csv csv = {0};
    qdot_status status;

    c->error_at = f->path_at->start;
    qdot_session_path(f->session, f->path, &path);
    status = qdot_text_status(&path);
    if (status == QDOT_OK)
        status = qdot_csv_read(qdot_text_str(&path), &csv);
    if (status == QDOT_OK)
        status = read_all_rows(c, f, &csv);
    qdot_csv_clear(&csv);
    qdot_text_clear(&path);
    return status;
}
