/* row-table.h -- rows of numbers of many runs, or of one run at many times.
 *
 * A row has what was swept, then what was asked for, each number with its error. That of a section
 * (poincare) counts its time among what was swept.
 *
 * Tests  tests/script/sweeps/sweep.sh, poincare.sh
 */
#ifndef QDOT_LANG_ROW_TABLE_H
#define QDOT_LANG_ROW_TABLE_H

#include <stdbool.h>
#include <stddef.h>

#include "lang/session/function-body.h"

typedef struct qdot_row_table {
    char *name;
    size_t n, n_swept;       /* number of columns; how many of them, the first ones, hold swept parameters */
    bool scattered;          /* rows are independent points: random draws or a Poincaré section */
    bool measured;           /* rows are measured data, drawn as points over the first column */
    qdot_function_body *members; /* for a sweep: the text of its statement up to the colon, with variables and run */
    char **labels;           /* [n] labels of the columns */
    char **units;            /* [n] their units; NULL: none, or not known yet */
    size_t n_parameters;     /* parameters that had the same value in all rows */
    char **parameters;       /* [n_parameters] names of these parameters */
    double *parameter_values; /* [n_parameters] values of these parameters */
    size_t rows, room;
    double *values, *errors; /* [rows x n] values (NaN: none) and their errors (NaN: unknown) */
    char **reasons;          /* [rows] the reason why a row failed; NULL: it did not fail */
    const char *note;        /* the texts in `reasons` are no failures, but this of the rows: "type"; or
                                NULL */
    size_t drawn;            /* for branches: how many columns after the parameter are drawn */
    struct qdot_row_table *marks; /* the rows are branches (unknowns/branches), these the points marked on
                                     them, one use of which is held; NULL: they are none */
    unsigned uses;
} qdot_row_table;

/* Make a table without rows; labels are copied. NULL: no memory. */
qdot_row_table *qdot_row_table_new(const char *name, size_t n_swept, size_t n,
                                   const char *const *labels);
/* The numbers of column i are in this unit, a copy of which is made; "": they have none. QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_row_table_set_unit(qdot_row_table *table, size_t i, const char *unit);
/* Append one row filled with NaN. QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_row_table_add(qdot_row_table *table);
/* Append `rows` rows, with no spare capacity. QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_row_table_add_all(qdot_row_table *table, size_t rows);
/* The memory of one row of the table in bytes. */
size_t qdot_row_table_row_bytes(const qdot_row_table *table);
/* Drop one reference; the last one frees the table. NULL is allowed. */
void qdot_row_table_release(qdot_row_table *table);

#endif
