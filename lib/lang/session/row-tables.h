/* row-tables.h -- tables of rows that a session keeps by name: the results of many runs.
 *
 * A row has what was swept, then what was asked for, each number with its error.
 *
 * Tests  tests/script/sweep.lag
 */
#ifndef QDOT_LANG_ROW_TABLES_H
#define QDOT_LANG_ROW_TABLES_H

#include "lang/session/session.h"

struct qdot_row_table {
    char *name;
    size_t n, n_swept;       /* columns, those swept first */
    bool drawn;              /* what was swept is random */
    char **labels;           /* [n] */
    size_t rows;
    double *values, *errors; /* [rows x n]; NaN: there is no number; its error is unknown */
    char **reasons;          /* [rows] why a row failed; NULL: it did not */
    unsigned uses;
};

/* A table without rows, with room for `most`; labels are copied. NULL: no memory. */
qdot_row_table *qdot_row_table_new(const char *name, size_t n_swept, size_t n,
                                   const char *const *labels, size_t most);
/* One use less; the last frees it. NULL is nothing. */
void qdot_row_table_release(qdot_row_table *table);
/* Keep it, for its use; an older one of that name goes. Takes the table in any case. */
QDOT_MUST_CHECK qdot_status qdot_row_tables_keep(qdot_session *session, qdot_row_table *table);
/* The table of that name; NULL: there is none. */
qdot_row_table *qdot_row_tables_find(const qdot_session *session, const char *name);
/* sweep1, sweep2, ...: the first that is free. */
void qdot_row_tables_next_name(const qdot_session *session, char *name, size_t size);

#endif
