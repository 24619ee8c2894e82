/* export-data.h -- what a file of source text holds of tables of data (export-tables.h).
 *
 * Tests  tests/meta/exports.test
 */
#ifndef QDOT_SHOW_EXPORT_DATA_H
#define QDOT_SHOW_EXPORT_DATA_H

#include "show/export-writer.h"

/* Find the tables that the file's tapes read, and where a motion reads them at a + b t. */
QDOT_MUST_CHECK qdot_status qdot_export_find_tables(qdot_export_writer *w);
/* Write their arrays, and the functions that read them. */
QDOT_MUST_CHECK qdot_status qdot_export_write_tables(qdot_export_writer *w);
/* Write `next = knot_after(...)` for each a + b t. */
QDOT_MUST_CHECK qdot_status qdot_export_write_knots(qdot_export_writer *w, const char *indent);

#endif
