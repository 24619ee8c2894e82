/* html.h -- a table of HTML: a part of a page, or a page of its own with the facts above it.
 *
 * Tests  tests/table/test_html.c, tests/script/files/data-files.sh
 */
#ifndef QDOT_TABLE_HTML_H
#define QDOT_TABLE_HTML_H

#include "table/table.h"

/* Append <table> ... </table> with the columns of answers that people read; a dash where there is no number.
 * Errors: those of qdot_table_select. */
QDOT_MUST_CHECK qdot_status qdot_table_html_part(const qdot_dataset *t, qdot_text *out);

/* Write a table as a page, numbers with 12 significant digits; path "-": standard output. Errors as
 * in table/file.h. */
QDOT_MUST_CHECK qdot_status qdot_table_html(const qdot_dataset *t, const char *path);

#endif
