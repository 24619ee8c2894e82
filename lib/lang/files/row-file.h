/* row-file.h -- rows of many runs in a file.
 *
 * Columns: what was swept, what was asked for, then the errors of the latter; in .json, .html and .h5
 * why rows failed as well ("" where they did not); what the rows are, as the type of a bifurcation, in .csv too.
 *
 * Tests  tests/script/sweeps/sweep.sh
 */
#ifndef QDOT_LANG_ROW_FILE_H
#define QDOT_LANG_ROW_FILE_H

#include "lang/session/row-tables.h"
#include "lang/syntax/record.h"

/* Print the table of rows, or write it to the file named after `to`. */
QDOT_MUST_CHECK qdot_status qdot_row_file_answer(qdot_record *r, const qdot_row_table *table);

#endif
