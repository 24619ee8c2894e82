/* table-answer.h -- tables as answers: columns under each other, or a line of JSON for each row.
 *
 * Tests  tests/script/sweeps/sweep.sh
 */
#ifndef QDOT_LANG_TABLE_ANSWER_H
#define QDOT_LANG_TABLE_ANSWER_H

#include "lang/session/parts.h"
#include "table/table.h"

/* Write the column heads, one row, or heads and all rows; `name` is for tables without a name of
 * their own. JSON only. */
QDOT_MUST_CHECK qdot_status qdot_answer_columns(qdot_session *session, const char *name, const qdot_dataset *t);
QDOT_MUST_CHECK qdot_status qdot_answer_row(qdot_session *session, const qdot_dataset *t, size_t row);
QDOT_MUST_CHECK qdot_status qdot_answer_rows(qdot_session *session, const char *name, const qdot_dataset *t);

/* Append a table in readable columns, with marks at which a terminal may break it (base/wrap.h). */
QDOT_MUST_CHECK qdot_status qdot_answer_add_table(const qdot_dataset *t, qdot_text *out);

/* Answer {"kind":"row"} for each row in JSON; as text, the table under that name. */
QDOT_MUST_CHECK qdot_status qdot_answer_table(qdot_session *session, const char *name, const qdot_dataset *t);

#endif
