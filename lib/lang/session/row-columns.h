/* row-columns.h -- the rows of many runs as a table: what was swept, the numbers with their errors, why rows failed.
 *
 * In files the errors are columns of their own, behind the numbers.
 *
 * Tests  tests/script/sweeps/sweep.sh, sweep-resume.sh
 */
#ifndef QDOT_LANG_ROW_COLUMNS_H
#define QDOT_LANG_ROW_COLUMNS_H

#include "lang/session/row-table.h"
#include "table/table.h"

typedef struct {
    qdot_dataset table; /* its cells are borrowed from the row table; parameters are its facts */
    qdot_text *labels; /* [n_labels] labels of the error columns */
    size_t n_labels;
    qdot_table_fact *parameters;
    double *numbers; /* row numbers, from 0 */
    size_t *order;   /* indices of the rows that are complete */
} qdot_row_columns;

/* The number of number columns in files, without the row number. */
static inline size_t
qdot_row_columns_count(const qdot_row_table *t)
{
    return 2 * t->n - t->n_swept;
}

/* All rows; or those that are done [t->rows], in files behind a column "row" that says which each is, from 0.
 * From {0}; free it in any case. QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_row_columns_of(const qdot_row_table *t, const bool *done, qdot_row_columns *x);
void qdot_row_columns_free(qdot_row_columns *x);

#endif
