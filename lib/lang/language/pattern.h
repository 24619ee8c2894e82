/* pattern.h -- forms of statements with placeholders, and lines made from what these held.
 *
 * foreign.def says what a pattern and a line are made of.
 */
#ifndef QDOT_LANG_PATTERN_H
#define QDOT_LANG_PATTERN_H

#include "base/text.h"
#include "lang/language/cursor.h"
#include "lang/source/token.h"

enum { QDOT_PATTERN_HELD = 9 };

typedef struct {
    const qdot_token *from, *to; /* the matching tokens; `to` is after the last one */
    const qdot_token *place;     /* token at which the error points */
    size_t n;                    /* number of placeholders in the pattern */
    struct {
        char kind; /* letter of the placeholder; '(' if it matches several tokens */
        const qdot_token *from, *to;
    } held[QDOT_PATTERN_HELD];
} qdot_pattern_match;

/* Whether the tokens from `from` on match; `whole`: all up to `to`, else those before it. A
 * pattern's first word must not be a declared name. */
bool qdot_pattern_matches(const qdot_session *session, const char *pattern,
                          const qdot_token *from, const qdot_token *to, bool whole,
                          qdot_pattern_match *m);

/* Append a suggested line, with the matched source texts in place of its placeholders. */
void qdot_pattern_write(const qdot_cursor *c, const char *line, const qdot_pattern_match *m,
                        qdot_text *out);

#endif
