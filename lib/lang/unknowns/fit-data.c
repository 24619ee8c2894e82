/* fit-data.c -- reads the rows of a data file as times, values and standard errors, for the statement `fit`. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "lang/answer/answer.h"
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

/* The name by which the file may call a column: that of the only coordinate or velocity in its expression, or t. */
static qdot_status
name_of_column(const qdot_fit *f, const qdot_fit_column *column, qdot_text *name)
{
    qdot_pool *pool = f->session->pool;
    const qdot_scene *s = f->session->scene;
    size_t found = 0;

    for (size_t i = 0; i < s->coordinates.n && column->kind == QDOT_FIT_VALUE; i++)
        for (uint32_t order = 0; order < 2; order++)
            if (qdot_expr_contains(pool, column->e, qdot_symbol_jet(pool, s->coordinates.at[i], order))
                && found++ == 0)
                qdot_text_format(name, "%s%s", qdot_expr_symbol(pool, s->coordinates.at[i])->name, order > 0 ? "'" : "");
    if (column->kind == QDOT_FIT_TIME)
        qdot_text_add(name, "t");
    else if (found != 1) {
        qdot_text_clear(name);
        qdot_text_add(name, column->label ? column->label : "");
    }
    return qdot_text_status(name);
}

/* Find the columns by the names in the file, in any order, if it has them all; *named: whether it does. Columns `sigma` and
 * `skip` are told by their order alone. */
static qdot_status
find_columns_by_name(qdot_fit *f, const qdot_csv *csv, bool *named)
{
    *named = csv->names.n == csv->columns;
    for (size_t i = 0; i < f->columns.n && *named; i++) {
        qdot_fit_column *column = &f->columns.at[i];
        qdot_text name = {0};
        qdot_status status = name_of_column(f, column, &name);

        if (status == QDOT_OK) {
            column->at = qdot_csv_find(csv, qdot_text_str(&name));
            *named = column->at < csv->columns && (column->kind == QDOT_FIT_TIME || column->kind == QDOT_FIT_VALUE);
            for (size_t k = 0; k < i; k++)
                *named = *named && f->columns.at[k].at != column->at;
        }
        qdot_text_clear(&name);
        QDOT_TRY(status);
    }
    return qdot_pool_check(f->session->pool);
}

/* Find which column of the file each column of the statement is. */
static qdot_status
find_columns(qdot_cursor *c, qdot_fit *f, const qdot_csv *csv)
{
    bool named;

    QDOT_TRY(find_columns_by_name(f, csv, &named));
    if (named)
        return QDOT_OK;
    for (size_t i = 0; i < f->columns.n; i++)
        f->columns.at[i].at = i;
    QDOT_TRY(check_columns(c, f, csv));
    c->error_at = f->path_at->start;
    return check_column_names(f, csv);
}

/* Read the values and standard errors from a row of the data file. */
static qdot_status
read_row(qdot_fit *f, const qdot_csv *csv, size_t row, size_t to)
{
    size_t j = 0;

    for (size_t i = 0; i < f->columns.n; i++) {
        const qdot_fit_column *column = &f->columns.at[i];
        const double x = csv->at[row * csv->columns + column->at];
        const qdot_csv_place *place = &csv->places[row * csv->columns + column->at];

        switch (column->kind) {
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

/* The column of the time, and a, b of t = a x + b with x the numbers in it. */
static qdot_status
find_time(const qdot_fit *f, const qdot_fit_column **column, double *a, double *b)
{
    qdot_pool *pool = f->session->pool;
    const qdot_expr t = QDOT_T, zero = QDOT_ZERO;

    *column = f->columns.at;
    while ((*column)->kind != QDOT_FIT_TIME)
        ++*column;
    QDOT_TRY(qdot_session_number(f->session, qdot_session_bind(f->session, qdot_diff(pool, (*column)->e, t)), a, NULL));
    return qdot_session_number(f->session, qdot_session_bind(f->session, qdot_subs(pool, (*column)->e, 1, &t, &zero)), b,
                               NULL);
}

/* Whether a number that the fit uses is missing in the row. */
static bool
has_gap(const qdot_fit *f, const qdot_csv *csv, size_t row)
{
    for (size_t i = 0; i < f->columns.n; i++)
        if (f->columns.at[i].kind != QDOT_FIT_SKIP && isnan(csv->at[row * csv->columns + f->columns.at[i].at]))
            return true;
    return false;
}

/* Find the times of the rows without gaps, into order [rows], in ascending order; f->rows is their number. A time before the
 * start of the run is an error. */
static qdot_status
find_times(qdot_fit *f, const qdot_csv *csv, sorted *order)
{
    const qdot_fit_column *column;
    double from, a, b;

    QDOT_TRY(find_time(f, &column, &a, &b));
    QDOT_TRY(qdot_session_number(f->session, f->from, &from, NULL));
    for (size_t i = 0; i < csv->rows; i++) {
        const size_t at = i * csv->columns + column->at;

        if (has_gap(f, csv, i))
            continue;
        order[f->rows++] = (sorted){a * csv->at[at] + b, i};
        if (order[f->rows - 1].t < from) {
            (void)qdot_csv_fail(f->path, &csv->places[at], "the time %.10g lies before the start at %.10g",
                                order[f->rows - 1].t, from);
            return qdot_hint("`from %.10g`: the start is that of this time", order[f->rows - 1].t);
        }
    }
    if (f->rows == 0)
        return qdot_csv_fail(f->path, &csv->places[0], "no row has all its numbers");
    qsort(order, f->rows, sizeof *order, compare_data_times);
    if (f->rows < csv->rows)
        QDOT_TRY(qdot_answer_notice(f->session, "%zu of %zu rows of %.100s are left out: numbers are missing in them",
                                    csv->rows - f->rows, csv->rows, f->path));
    return column->e == QDOT_T ? QDOT_OK
                               : qdot_answer_notice(f->session, "the time is %.100s with t from the file: %.10g to %.10g",
                                                    column->label, order[0].t, order[f->rows - 1].t);
}

static qdot_status
read_all_rows(qdot_cursor *c, qdot_fit *f, const qdot_csv *csv)
{
    sorted *order = qdot_calloc(csv->rows + 1, sizeof *order);
    qdot_status status = order ? find_columns(c, f, csv) : QDOT_ENOMEM;

    if (status == QDOT_OK) {
        c->error_at = f->path_at->start;
        status = find_times(f, csv, order);
    }
    if (status == QDOT_OK) {
        f->t = qdot_calloc(f->rows * (1 + 2 * f->m), sizeof *f->t);
        status = f->t ? QDOT_OK : QDOT_ENOMEM;
    }
    if (status == QDOT_OK) {
        f->y = f->t + f->rows;
        f->sigma = f->y + f->rows * f->m;
    }
    for (size_t i = 0; i < f->rows && status == QDOT_OK; i++) {
        f->t[i] = order[i].t;
        status = read_row(f, csv, order[i].row, i);
    }
    qdot_free(order);
    return status;
}

qdot_status
qdot_fit_read_data(qdot_cursor *c, qdot_fit *f)
{
    qdot_csv csv = {.gaps = true};
    qdot_status status;

    c->error_at = f->path_at->start;
    status = qdot_session_read_csv(f->session, f->path, &csv);
    if (status == QDOT_OK)
        status = read_all_rows(c, f, &csv);
    qdot_csv_clear(&csv);
    return status;
}
