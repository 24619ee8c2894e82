/* hdf5-read.h -- reads back the columns of an HDF5 file that data.h has written.
 *
 * Tests  tests/show/test_data.c, tests/script/sweeps/sweep-resume.sh
 */
#ifndef QDOT_SHOW_HDF5_READ_H
#define QDOT_SHOW_HDF5_READ_H

#include "base/memory.h"
#include "base/text.h"

typedef struct {
    char *label;
    size_t size; /* bytes of a text, its NUL with it; 0: numbers */
    char *bytes; /* [rows x size], or of numbers [rows x 8], least byte first */
} qdot_data_read_column;

typedef struct {
    qdot_vec(qdot_data_read_column) at;
    size_t rows;
    const char *fact; /* the name of an attribute of the root, a text, */
    qdot_text text;   /* and what it says; empty: there is none */
} qdot_data_columns;

/* Read a file and one fact of it. Start from {0}; clear it in any case. QDOT_EIO: it cannot be read;
 * QDOT_EINVAL: it is another file. */
QDOT_MUST_CHECK qdot_status qdot_data_read_hdf5(const char *path, const char *fact,
                                                qdot_data_columns *out);
void qdot_data_columns_clear(qdot_data_columns *c);

double qdot_data_read_number(const qdot_data_read_column *c, size_t row);

#endif
