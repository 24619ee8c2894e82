/* csv.h -- a table as comma-separated values, the names first.
 *
 * Fields are quoted where RFC 4180 asks for it; numbers have 17 digits, what is no number is nan or nothing.
 *
 * Tests  tests/table/test_csv.c
 */
#ifndef QDOT_TABLE_CSV_H
#define QDOT_TABLE_CSV_H

#include "table/table.h"

/* Write a table as CSV to a file; path "-": standard output. Errors as in table/file.h. */
QDOT_MUST_CHECK qdot_status qdot_table_csv(const qdot_dataset *t, const char *path);

#endif
