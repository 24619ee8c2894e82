/* columns.h -- what is asked of each run, as `sweep` and `poincare` read it: EXPR, EXPR, ...
 *
 * They are kept as they were parsed, and evaluated when there is a run, with its values in force.
 *
 * Tests  tests/script/sweeps/sweep.sh, poincare.sh
 */
#ifndef QDOT_LANG_COLUMNS_H
#define QDOT_LANG_COLUMNS_H

#include "lang/session/row-table.h"
#include "lang/syntax/record.h"

typedef struct {
    qdot_vec(const qdot_compiled *) at; /* the expressions; owned by the record */
    qdot_row_table *table; /* the table of them, borrowed: their units are written there when they are read; NULL: none yet */
} qdot_columns;

/* Find all column expressions of the statement. x starts as {0}; free it in any case, before the record. */
QDOT_MUST_CHECK qdot_status qdot_columns_find(const qdot_record *r, qdot_columns *x);
void qdot_columns_free(qdot_columns *x);

/* Read column i of the sweep's table as a scalar expression. */
QDOT_MUST_CHECK qdot_status qdot_columns_read(qdot_cursor *c, const qdot_columns *x, size_t i,
                                              qdot_expr *e);
/* Evaluate column i, with its error, for the session's latest run, which ends at `end`. */
QDOT_MUST_CHECK qdot_status qdot_columns_measure(qdot_cursor *c, const qdot_columns *x, size_t i,
                                                 qdot_expr end, double *value, double *error);
/* Whether column i uses value, max, min, mean or drift, which read a run at intermediate times, but
 * none of its events. */
bool qdot_columns_read_way(const qdot_session *session, const qdot_columns *x, size_t i);
/* A column before those that are asked for: its label, and what it is; nil: its unit is not said. */
typedef struct {
    const char *label;
    qdot_expr of;
} qdot_columns_before;
/* Make a table without rows: the columns `before` [n], then these columns. It stays x->table until the table is freed. */
QDOT_MUST_CHECK qdot_status qdot_columns_table(qdot_session *session, qdot_columns *x,
                                               const char *name, size_t n,
                                               const qdot_columns_before *before,
                                               qdot_row_table **table);
/* Column i is of the dimension of e. */
QDOT_MUST_CHECK qdot_status qdot_columns_note_unit(qdot_session *session, const qdot_columns *x, size_t i, qdot_expr e);

#endif
