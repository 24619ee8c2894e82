/* row-answer.h -- rows of many runs as answers.
 *
 * Tests  tests/script/sweeps/sweep.sh
 */
#ifndef QDOT_LANG_ROW_ANSWER_H
#define QDOT_LANG_ROW_ANSWER_H

#include "lang/session/row-tables.h"

/* A table of so many rows is printed as an answer; of more, how many there are. */
enum { QDOT_ROWS_PRINTED = 24 };

/* Rows from .. to - 1; JSON only. */
QDOT_MUST_CHECK qdot_status qdot_row_answer_part(qdot_session *session, const qdot_row_table *table, size_t from,
                                                 size_t to);
/* All rows: as JSON, or as a table with why rows failed, the first few, below. */
QDOT_MUST_CHECK qdot_status qdot_row_answer(qdot_session *session, const qdot_row_table *table);

#endif
