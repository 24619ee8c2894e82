/* row-answer.h -- rows of many runs as answers.
 *
 * Tests  tests/script/sweeps/sweep.sh
 */
#ifndef QDOT_LANG_ROW_ANSWER_H
#define QDOT_LANG_ROW_ANSWER_H

#include "lang/session/row-tables.h"

/* A table with at most this many rows is printed; for longer ones only the number of rows. */
enum { QDOT_ROWS_PRINTED = 24 };

/* Write rows from ... to - 1 of a table, always as JSON. */
QDOT_MUST_CHECK qdot_status qdot_row_answer_part(qdot_session *session, const qdot_row_table *table, size_t from,
                                                 size_t to);
/* Write all rows of a table: as JSON, or as text with the reasons of the first failures below. */
QDOT_MUST_CHECK qdot_status qdot_row_answer(qdot_session *session, const qdot_row_table *table);

#endif
