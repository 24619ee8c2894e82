/* hdf5.h -- a table as a file of HDF5.
 *
 * A data set of doubles for each column, of texts of one length for a column of texts, named by its column (/ as
 * U+2215, a name met before with the column's number); the facts are attributes of the root, the parameters those of
 * the group "parameters". Written without the library of HDF5; version 1.8 and later read it.
 *
 * Tests  tests/table/test_hdf5.c, tests/script/files/data-files.sh
 */
#ifndef QDOT_TABLE_HDF5_H
#define QDOT_TABLE_HDF5_H

#include "table/table.h"

/* Write a table as HDF5 to a file; path "-": standard output. Errors as in table/file.h. */
QDOT_MUST_CHECK qdot_status qdot_table_hdf5(const qdot_dataset *t, const char *path);

#endif
