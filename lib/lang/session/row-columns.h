/* row-columns.h -- the rows of a table column by column, as files hold them.
 *
 * What was swept, the numbers, their errors, and why rows failed ("" where they did not).
 *
 * Tests  tests/script/sweeps/sweep.sh, sweep-resume.sh
 */
#ifndef QDOT_LANG_ROW_COLUMNS_H
#define QDOT_LANG_ROW_COLUMNS_H

#include "lang/session/row-table.h"
#include "show/data.h"

typedef struct {
    size_t n;    /* columns of numbers; the one behind them are the reasons */
    size_t rows;
    qdot_column *columns;         /* [n + 1] */
    char *const **texts;          /* [n + 1] NULL, but for the reasons */
    double *values;               /* [n x rows] */
    qdot_text *labels;            /* [n] */
    char **reasons;               /* [rows] of the table */
} qdot_row_columns;

/* Columns of numbers that a table has, without that of the rows' numbers. */
static inline size_t
qdot_row_columns_count(const qdot_row_table *t)
{
    return 2 * t->n - t->n_swept;
}

/* All rows; or those that are done [t->rows], behind a column "row" that says which each is, from 0.
 * From {0}; free it in any case. QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_row_columns_fill(const qdot_row_table *t, const bool *done,
                                                  qdot_row_columns *x);
void qdot_row_columns_free(qdot_row_columns *x);

/* The parameters noted with the table, [t->n_parameters] as facts of a file; owned by the caller, names
 * borrowed. NULL: no memory. */
qdot_data_fact *qdot_row_columns_parameters(const qdot_row_table *t);

#endif
