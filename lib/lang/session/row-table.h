/* row-table.h -- rows of numbers of many runs.
 *
 * A row has what was swept, then what was asked for, each number with its error.
 *
 * Tests  tests/script/sweep.sh
 */
#ifndef QDOT_LANG_ROW_TABLE_H
#define QDOT_LANG_ROW_TABLE_H

#include <stdbool.h>
#include <stddef.h>

typedef struct qdot_row_table {
    char *name;
    size_t n, n_swept;       /* columns, those swept first */
    bool drawn;              /* what was swept is random */
    char **labels;           /* [n] */
    size_t rows;
    double *values, *errors; /* [rows x n]; NaN: there is no number; its error is unknown */
    char **reasons;          /* [rows] why a row failed; NULL: it did not */
    unsigned uses;
} qdot_row_table;

/* A table without rows, with room for `most`; labels are copied. NULL: no memory. */
qdot_row_table *qdot_row_table_new(const char *name, size_t n_swept, size_t n,
                                   const char *const *labels, size_t most);
/* One use less; the last frees it. NULL is nothing. */
void qdot_row_table_release(qdot_row_table *table);

#endif
