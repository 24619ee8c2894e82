/* utf8.h -- the functions on UTF-8 that names and error messages need. */
#ifndef QDOT_BASE_UTF8_H
#define QDOT_BASE_UTF8_H

#include <stddef.h>
#include <stdint.h>

/* Bytes of the well-formed sequence at `text` (NUL-terminated), 0 if it is not one (or NUL). */
size_t qdot_utf8_length(const char *text);

/* The code point of the sequence at `text`, and its *length in bytes; 0 if it is not well-formed. */
uint32_t qdot_utf8_decode(const char *text, size_t *length);

/* Columns that the first `bytes` bytes take on a terminal: one a code point, none for a mark that
 * stands over the letter before it. */
size_t qdot_utf8_columns(const char *text, size_t bytes);

#endif
