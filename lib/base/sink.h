/* sink.h -- a file being written: whole or not at all, with no failure overlooked.
 *
 * What is written goes to a file of its own beside PATH, which takes the place of PATH when it is closed with
 * all of it written: a full disk, Ctrl-C or a crash leave the file that was there. A link is followed and the
 * permissions of the file that was there are kept. What is no regular file (a pipe, a device) is written as
 * it is.
 *
 * Tests  tests/base/test_sink.c
 */
#ifndef QDOT_BASE_SINK_H
#define QDOT_BASE_SINK_H

#include <stdbool.h>
#include <stdio.h>

#include "base/status.h"

typedef struct {
    FILE *file;
    const char *path; /* path of the file, borrowed; "-" is standard output */
    char *beside;     /* name of the temporary file that is written: path.part */
    char *place; /* the file that replaces it by renaming at the end; NULL: the file is written directly */
} qdot_sink;

/* Begin to write a file. QDOT_EIO with the system's reason; QDOT_EINVAL for an empty path; QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_sink_open(qdot_sink *sink, const char *path);

/* Append `length` bytes to the file. After QDOT_EIO the caller must still close the sink. */
QDOT_MUST_CHECK qdot_status qdot_sink_put(qdot_sink *sink, const char *bytes,
                                          size_t length);

/* Write out what is buffered, close, and put the file into its place; QDOT_EIO if anything was lost (a full
 * disk): then what was there before stays. */
QDOT_MUST_CHECK qdot_status qdot_sink_close(qdot_sink *sink);

/* Close after a failure elsewhere, which stays the last error; an existing target file is left unchanged. */
void qdot_sink_abandon(qdot_sink *sink);

/* Write a whole file of `length` bytes; errors as of opening, writing and closing a sink. */
QDOT_MUST_CHECK qdot_status qdot_sink_write(const char *path, const char *bytes,
                                            size_t length);

/* Write `length` bytes to an open file at once, behind all that it holds back. A signal, as of Ctrl-C while a pipe is
 * full, does not end that: what remains is written then. False, with errno: not all was written. */
bool qdot_sink_write_to(FILE *file, const char *bytes, size_t length);

/* Whether a file that no statement named may be written: there is none, or it begins with `mark`, as all that are
 * written so do. */
bool qdot_sink_is_free(const char *path, const char *mark);

#endif
