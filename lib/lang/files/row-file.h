/* row-file.h -- rows of many runs in a file.
 *
 * Columns: what was swept, what was asked for, then the errors of the latter; in .json, .html and .h5
 * why rows failed as well ("" where they did not); what the rows are, as the type of a bifurcation, in .csv too.
 *
 * Tests  tests/script/sweeps/sweep.sh
 */
#ifndef QDOT_LANG_ROW_FILE_H
#define QDOT_LANG_ROW_FILE_H

#include "lang/language/cursor.h"
#include "lang/session/row-tables.h"

/* The table of rows that the token names, if `to` or the end of the statement follows; else NULL. */
qdot_row_table *qdot_row_file_named(const qdot_cursor *c);
/* The statement `NAME [to "FILE"]` at the cursor, NAME a table of rows: print it or write it. */
QDOT_MUST_CHECK qdot_status qdot_row_file_statement(qdot_cursor *c, const qdot_row_table *table);

#endif
