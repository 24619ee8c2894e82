/* sweep-file.h -- the rows of a sweep that are done, kept in a file while it goes on.
 *
 * An HDF5 file (table/hdf5.h) with the columns: row, from 0; what was swept; the numbers; their errors;
 * why a row failed. Its attribute "sweep" is what the sweep said, with a checksum of it and of the rows. It is
 * written beside its place and then moved there (base/sink.h), so that it is whole at any moment; the sweep
 * holds a lock on it (base/file-lock.h).
 *
 * Tests  tests/script/sweeps/sweep-resume.sh
 */
#ifndef QDOT_LANG_SWEEP_FILE_H
#define QDOT_LANG_SWEEP_FILE_H

#include <stdbool.h>

#include "base/status.h"
#include "lang/session/row-table.h"

/* Write those rows of the table to the file that are marked in done [t->rows]. Errors: those of writing. */
QDOT_MUST_CHECK qdot_status qdot_sweep_file_keep(const qdot_row_table *t, const bool *done,
                                                 const char *said, const char *path);
/* Take the rows of the file into the table, and set done for them; without a file nothing is done.
 * QDOT_EINVAL: it is of another sweep, damaged, or no such file. */
QDOT_MUST_CHECK qdot_status qdot_sweep_file_take(const char *path, const char *said,
                                                 qdot_row_table *t, bool *done);

#endif
