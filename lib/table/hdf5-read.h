/* hdf5-read.h -- reads back the columns of an HDF5 file that hdf5.h has written.
 *
 * Tests  tests/table/test_hdf5.c, tests/script/sweeps/sweep-resume.sh
 */
#ifndef QDOT_TABLE_HDF5_READ_H
#define QDOT_TABLE_HDF5_READ_H

#include "base/memory.h"
#include "base/text.h"

typedef struct {
    char *label;
    size_t size; /* bytes of a text including its NUL; 0: the column has numbers */
    char *bytes; /* [rows x size] texts, or [rows x 8] numbers, least significant byte first */
} qdot_hdf5_column;

typedef struct {
    qdot_vec(qdot_hdf5_column) at;
    size_t rows;
    const char *fact; /* name of the text attribute of the root group that is to be read */
    qdot_text text;   /* the text of that attribute; empty: it does not exist */
} qdot_hdf5_columns;

/* Read a file and one fact of it. Start from {0}; clear it in any case. QDOT_EIO: it cannot be read;
 * QDOT_EINVAL: it is another file. */
QDOT_MUST_CHECK qdot_status qdot_hdf5_read(const char *path, const char *fact,
                                                qdot_hdf5_columns *out);
void qdot_hdf5_columns_clear(qdot_hdf5_columns *c);

double qdot_hdf5_number(const qdot_hdf5_column *c, size_t row);

#endif
