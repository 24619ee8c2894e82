/* data-points.c -- checks the rows of a file of data, and makes a table of them. */
#include "lang/declare/data-points.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A row without gaps: its numbers, and which row of the file it is. */
typedef struct {
    double x[3];
    size_t row;
} point;

static const qdot_csv_place *
place_of(const qdot_data_points *d, size_t row, size_t column)
{
    return &d->csv->places[row * d->csv->columns + d->columns[column].at];
}

/* Read the rows that have all their numbers. */
static qdot_status
read_points(qdot_data_points *d, point **points, size_t *n)
{
    *n = 0;
    *points = qdot_calloc(d->csv->rows + 1, sizeof **points);
    if (!*points)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < d->csv->rows; i++) {
        point p = {.row = i};
        bool gap = false;

        for (size_t k = 0; k < d->n; k++) {
            p.x[k] = d->columns[k].a * d->csv->at[i * d->csv->columns + d->columns[k].at] + d->columns[k].b;
            gap = gap || isnan(p.x[k]);
        }
        if (!gap)
            (*points)[(*n)++] = p;
    }
    d->left_out = d->csv->rows - *n;
    if (*n >= 2)
        return QDOT_OK;
    return qdot_csv_fail(d->path, &d->csv->places[0], "a table has at least two rows with all their numbers");
}

/* --- one argument ------------------------------------------------------------------------- */

static qdot_status
check_ascending(const qdot_data_points *d, const point *p, size_t n)
{
    for (size_t i = 1; i < n; i++)
        if (!(p[i].x[0] > p[i - 1].x[0])) {
            (void)qdot_csv_fail(d->path, place_of(d, p[i].row, 0), "%s = %.10g does not come after %.10g, that of the row before",
                                d->columns[0].name, p[i].x[0], p[i - 1].x[0]);
            return qdot_hint("the rows in ascending order of %s", d->columns[0].name);
        }
    if (d->beyond != QDOT_SAMPLES_PERIODIC || p[0].x[1] == p[n - 1].x[1])
        return QDOT_OK;
    (void)qdot_csv_fail(d->path, place_of(d, p[n - 1].row, 1), "a periodic table ends with the value %.10g with which it begins",
                        p[0].x[1]);
    return qdot_hint("a last row that repeats the first one, a period later");
}

static qdot_status
add_function_of_one(const qdot_data_points *d, const point *p, size_t n, int *number)
{
    double *x = qdot_calloc(2 * n, sizeof *x), *f = x ? x + n : NULL;
    qdot_status status = x ? check_ascending(d, p, n) : QDOT_ENOMEM;

    for (size_t i = 0; i < n && x; i++) {
        x[i] = p[i].x[0];
        f[i] = p[i].x[1];
    }
    if (status == QDOT_OK)
        status = qdot_samples_add(&(qdot_samples_given){.axes = 1,
                                                        .n = {n, 0},
                                                        .knots = {x, NULL},
                                                        .values = f,
                                                        .degree = d->degree,
                                                        .beyond = d->beyond},
                                  number);
    qdot_free(x);
    return status;
}

/* --- two arguments ------------------------------------------------------------------------ */

static int
compare_points(const void *a, const void *b)
{
    const point *p = a, *q = b;

    for (int k = 0; k < 2; k++)
        if (p->x[k] != q->x[k])
            return p->x[k] < q->x[k] ? -1 : 1;
    return (p->row > q->row) - (p->row < q->row);
}

/* Of sorted points: every x has the same y, each once. */
static qdot_status
check_grid(const qdot_data_points *d, const point *p, size_t n, size_t width)
{
    for (size_t i = 1; i < n; i++)
        if (p[i].x[0] == p[i - 1].x[0] && p[i].x[1] == p[i - 1].x[1])
            return qdot_csv_fail(d->path, place_of(d, p[i].row, 0), "%s = %.10g, %s = %.10g stands in line %zu, too",
                                 d->columns[0].name, p[i].x[0], d->columns[1].name, p[i].x[1],
                                 place_of(d, p[i - 1].row, 0)->line);
    for (size_t i = 0; i < n; i++) {
        const point *like = &p[i % width];
        const bool begins = i % width == 0;

        if (p[i].x[1] == like->x[1] && (begins ? i == 0 || p[i].x[0] > p[i - 1].x[0] : p[i].x[0] == p[i - 1].x[0]))
            continue;
        (void)qdot_csv_fail(d->path, place_of(d, p[i].row, 0), "the points are not those of a grid: %s = %.10g has other %s than %.10g has",
                            d->columns[0].name, p[i].x[0], d->columns[1].name, p[0].x[0]);
        return qdot_hint("every %s with the same %s; scattered points are not built", d->columns[0].name, d->columns[1].name);
    }
    if (n % width == 0 && width >= 2 && n / width >= 2)
        return QDOT_OK;
    (void)qdot_csv_fail(d->path, place_of(d, p[n - 1].row, 0), "the points are not those of a grid of two or more %s by two or more %s",
                        d->columns[0].name, d->columns[1].name);
    return qdot_hint("every %s with the same %s; scattered points are not built", d->columns[0].name, d->columns[1].name);
}

static qdot_status
add_function_of_two(const qdot_data_points *d, point *p, size_t n, int *number)
{
    double *x = qdot_calloc(3 * n, sizeof *x), *y = x ? x + n : NULL, *f = x ? y + n : NULL;
    size_t width = 0;
    qdot_status status;

    if (!x)
        return QDOT_ENOMEM;
    qsort(p, n, sizeof *p, compare_points);
    while (width < n && p[width].x[0] == p[0].x[0])
        width++;
    status = check_grid(d, p, n, width);
    for (size_t i = 0; i < n; i++) {
        x[i / width] = p[i].x[0];
        y[i % width] = p[i].x[1];
        f[i] = p[i].x[2];
    }
    if (status == QDOT_OK)
        status = qdot_samples_add(&(qdot_samples_given){.axes = 2,
                                                        .n = {n / width, width},
                                                        .knots = {x, y},
                                                        .values = f,
                                                        .degree = d->degree,
                                                        .beyond = d->beyond},
                                  number);
    qdot_free(x);
    return status;
}

qdot_status
qdot_data_points_add(qdot_data_points *d, int *number)
{
    point *points = NULL;
    size_t n;
    qdot_status status = read_points(d, &points, &n);

    if (status == QDOT_OK)
        status = d->n == 3 ? add_function_of_two(d, points, n, number) : add_function_of_one(d, points, n, number);
    qdot_free(points);
    return status;
}
