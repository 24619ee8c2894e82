/* row-tables.h -- the tables of rows that a session keeps by name.
 *
 * Tests  tests/script/sweeps/sweep.sh
 */
#ifndef QDOT_LANG_ROW_TABLES_H
#define QDOT_LANG_ROW_TABLES_H

#include "base/memory.h"
#include "lang/session/parts.h"
#include "lang/session/row-table.h"

/* Shared by the session and the states that `undo` keeps. */
typedef struct qdot_row_table_list {
    qdot_vec(qdot_row_table *);
} qdot_row_table_list;

/* Store a table in the session, which takes over its reference, even on failure; an older table of that name is dropped. */
QDOT_MUST_CHECK qdot_status qdot_row_tables_keep(qdot_session *session, qdot_row_table *table);
/* The table with this name; NULL if there is none. */
qdot_row_table *qdot_row_tables_find(const qdot_session *session, const char *name);
/* Remove the table with this name; whether there was one. */
bool qdot_row_tables_drop(qdot_session *session, const char *name);
/* Find the first unused name among sweep1, sweep2, ... */
void qdot_row_tables_next_name(const qdot_session *session, char *name, size_t size);

/* Record the present values of parameters in the table, except those that depend on the symbols open [n]. */
QDOT_MUST_CHECK qdot_status qdot_row_tables_note_parameters(qdot_session *session,
                                                            qdot_row_table *table, size_t n,
                                                            const qdot_expr *open);

#endif
