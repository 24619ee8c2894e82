/* data-points.h -- the points of a table of data: columns of a file, as a function of one or two arguments.
 *
 * Tests  tests/script/data/, tests/bad/data/
 */
#ifndef QDOT_LANG_DATA_POINTS_H
#define QDOT_LANG_DATA_POINTS_H

#include "base/memory.h"
#include "num/samples.h"
#include "table/csv-read.h"

/* A column that was asked for: its name in the statement, its index in the file; what is taken of the number x there:
 * a x + b. */
typedef struct {
    const char *name;
    size_t at;
    double a, b;
} qdot_data_column;

typedef struct {
    const char *path; /* as typed */
    const qdot_csv *csv;
    size_t n; /* number of columns: the arguments, then the value */
    const qdot_data_column *columns;
    int degree;
    qdot_samples_beyond beyond;
    size_t left_out; /* the number of rows in which a number is missing */
} qdot_data_points;

/* The number of the table of these points. Points of one argument ascend; those of two are a grid, in any order. Errors
 * with their place in the file: QDOT_EINVAL; QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_data_points_add(qdot_data_points *points, int *number);

#endif
