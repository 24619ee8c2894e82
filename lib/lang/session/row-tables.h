/* row-tables.h -- the tables of rows that a session keeps by name.
 *
 * Tests  tests/script/sweeps/sweep.sh
 */
#ifndef QDOT_LANG_ROW_TABLES_H
#define QDOT_LANG_ROW_TABLES_H

#include "lang/session/session.h"

/* Keep it, for its use; an older one of that name goes. Takes the table in any case. */
QDOT_MUST_CHECK qdot_status qdot_row_tables_keep(qdot_session *session, qdot_row_table *table);
/* The table of that name; NULL: there is none. */
qdot_row_table *qdot_row_tables_find(const qdot_session *session, const char *name);
/* sweep1, sweep2, ...: the first that is free. */
void qdot_row_tables_next_name(const qdot_session *session, char *name, size_t size);

/* Note the parameters with the values that are in force, but those that `open` [n], symbols, change. */
QDOT_MUST_CHECK qdot_status qdot_row_tables_note_parameters(qdot_session *session,
                                                            qdot_row_table *table, size_t n,
                                                            const qdot_expr *open);

#endif
