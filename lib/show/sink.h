/* sink.h -- a file being written, with no failure overlooked. */
#ifndef QDOT_SHOW_SINK_H
#define QDOT_SHOW_SINK_H

#include <stdio.h>

#include "base/status.h"

typedef struct {
    FILE *file;
    const char *path; /* borrowed; "-" is standard output */
} qdot_sink;

/* Create or empty the file. QDOT_EIO with the system's reason; QDOT_EINVAL for an
 * empty path. */
QDOT_MUST_CHECK qdot_status qdot_sink_open(qdot_sink *sink, const char *path);

/* Append `length` bytes. On QDOT_EIO the sink is still to be closed. */
QDOT_MUST_CHECK qdot_status qdot_sink_put(qdot_sink *sink, const char *bytes,
                                          size_t length);

/* Write out what is buffered and close; QDOT_EIO if anything was lost (a full disk). */
QDOT_MUST_CHECK qdot_status qdot_sink_close(qdot_sink *sink);

/* Close after another failure, which stays the last error. */
void qdot_sink_abandon(qdot_sink *sink);

/* A whole file of `length` bytes: opened, put, closed. Errors as theirs. */
QDOT_MUST_CHECK qdot_status qdot_sink_write(const char *path, const char *bytes,
                                            size_t length);

#endif
