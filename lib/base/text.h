/* text.h -- a growing string. A failed append marks the string, and the caller asks for its status once, at the end. */
#ifndef QDOT_BASE_TEXT_H
#define QDOT_BASE_TEXT_H

#include <stddef.h>
#include <stdio.h>

#include "base/status.h"

/* A growing string. Start with `qdot_text s = {0};`; free with qdot_text_clear. */
typedef struct {
    char *at; /* NUL-terminated once anything was appended; else NULL */
    size_t n, capacity;
    bool failed;
} qdot_text;

void qdot_text_add(qdot_text *s, const char *text);
void qdot_text_add_n(qdot_text *s, const char *text, size_t length);
void qdot_text_char(qdot_text *s, char c);
void qdot_text_format(qdot_text *s, const char *format, ...) QDOT_PRINTF(2, 3);
/* Append the rest of a file, or one block more than `most` bytes; false if it cannot be read. */
bool qdot_text_add_stream(qdot_text *s, FILE *from, size_t most);
/* Append all that a file still has, as _add_stream; errors name `path`: QDOT_EIO, also of a directory;
 * QDOT_ELIMIT: it is larger than `most`; QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_text_read(qdot_text *s, FILE *from, const char *path,
                                           size_t most);
void qdot_text_truncate(qdot_text *s, size_t length);
void qdot_text_clear(qdot_text *s);

/* The characters of the string, or "" if nothing was appended. */
const char *qdot_text_str(const qdot_text *s);

/* The status of all appends: QDOT_ENOMEM if any failed. */
QDOT_MUST_CHECK qdot_status qdot_text_status(const qdot_text *s);

/* Append a double in the C locale, with `digits` significant digits; "inf" or "nan" if it is not finite. */
void qdot_text_double(qdot_text *s, double x, int digits);

/* The fewest digits, at least `least`, with which %g writes a double that reads back as x; 17 for NaN. */
int qdot_double_digits(double x, int least);

/* Whether text ends in `ending` and is longer: "a.csv" for ".csv". */
bool qdot_ends_in(const char *text, const char *ending);

/* Whether name is a member FAMILY[...]: "theta[2]" of "theta". */
bool qdot_is_member_of(const char *name, const char *family);

/* Whether text contains the word with no letter or _ next to it. */
bool qdot_has_word(const char *text, const char *word);

/* Append n bytes of text to HTML, with & < > as entities; `quotes` (inside an attribute): with " as one, too. */
void qdot_text_html(qdot_text *s, const char *text, size_t n, bool quotes);

/* Append `text` as a quoted JSON string; bytes that are not UTF-8 become U+FFFD. */
void qdot_text_json(qdot_text *s, const char *text);

#endif
