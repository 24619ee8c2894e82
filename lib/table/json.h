/* json.h -- a table as JSON: rows as answers, a whole table as a file.
 *
 *     {"kind":"columns","name":"curve","columns":["omega","theta"]}
 *     {"kind":"row","name":"curve","values":[0.5,1.25],"errors":[0,3e-13],"status":"done","reason":null}
 *
 *     {"program":"qdot 0.1.0","method":"taylor",...,"parameters":{"m":1},
 *      "columns":["t","theta"],"rows":[[0,1.25],...]}
 *
 * Numbers have as many digits as a double needs, null where they are not finite. Errors stand in rows of which a column is
 * measured.
 *
 * Tests  tests/table/test_json.c
 */
#ifndef QDOT_TABLE_JSON_H
#define QDOT_TABLE_JSON_H

#include "table/table.h"

/* Append a line before rows that are answers: the names of their `values`; `name` is for unnamed rows. */
void qdot_table_json_columns(const qdot_dataset *t, const char *name, qdot_text *out);
/* Append a row as an answer, with its line's end; columns that are fields of their own stand before `values` or
 * behind, as in the table. */
void qdot_table_json_row(const qdot_dataset *t, size_t row, qdot_text *out);

/* Write a table as JSON to a file; path "-": standard output. Errors as in table/file.h. */
QDOT_MUST_CHECK qdot_status qdot_table_json(const qdot_dataset *t, const char *path);

#endif
