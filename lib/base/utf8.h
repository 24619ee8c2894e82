/* utf8.h -- functions on UTF-8 for names and error messages. */
#ifndef QDOT_BASE_UTF8_H
#define QDOT_BASE_UTF8_H

#include <stddef.h>
#include <stdint.h>

/* The length in bytes of the UTF-8 sequence at `text` (NUL-terminated); 0 if it is malformed or NUL. */
size_t qdot_utf8_length(const char *text);

/* The code point of the UTF-8 sequence at `text`, and its *length in bytes; 0 if it is malformed. */
uint32_t qdot_utf8_decode(const char *text, size_t *length);

/* Columns that the first `bytes` bytes take on a terminal: one a code point, none for a mark that
 * stands over the letter before it. */
size_t qdot_utf8_columns(const char *text, size_t bytes);

/* Remove the bytes of the NUL-terminated text that are no UTF-8, such as those of a character that has been cut. */
void qdot_utf8_mend(char *text);

#endif
