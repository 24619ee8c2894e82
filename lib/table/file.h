/* file.h -- writes a table to a file in pieces, in any format. Internal to table/. */
#ifndef QDOT_TABLE_FILE_H
#define QDOT_TABLE_FILE_H

#include "table/table.h"

/* The functions by which a format writes the head, each row, and the end of a file; NULL: nothing. */
typedef struct {
    void (*head)(const qdot_dataset *t, qdot_text *out);
    void (*row)(const qdot_dataset *t, size_t row, qdot_text *out);
    void (*foot)(const qdot_dataset *t, qdot_text *out);
} qdot_table_format;

/* Write a file of the columns that stand there; path "-": standard output. Errors: those of qdot_table_select, of
 * base/sink.h; QDOT_EINTR. */
QDOT_MUST_CHECK qdot_status qdot_table_file(const qdot_dataset *t, unsigned where, const qdot_table_format *format,
                                            const char *path);

#endif
