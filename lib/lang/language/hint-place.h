/* hint-place.h -- which tokens of a statement the text of a hint `write TEXT` is to replace.
 *
 * The text stands in place of what it is made of: the tokens from the one at fault, or from the beginning of the statement, whose
 * names and numbers it keeps, all but the first. Tokens before the one at fault with which the text begins, too, are a part of
 * it, as 2 in 2x, `write 2*x`.
 *
 * Tests  tests/lang/analysis/test_fix.c, tests/lang/language/test_hints.c
 */
#ifndef QDOT_LANG_HINT_PLACE_H
#define QDOT_LANG_HINT_PLACE_H

#include "lang/source/token.h"

/* What hints that name a line or a part of it begin with. */
#define QDOT_HINT_WRITE "write "

/* The tokens from ... to - 1. */
typedef struct {
    const qdot_token *from, *to;
} qdot_hint_place;

/* Find the places in the statement [first, end) that the text, as the tokens of a source, may replace for a fault at token `at`:
 * the likelier first. Returns their number, 1 or 2. */
size_t qdot_hint_places(const qdot_token *first, const qdot_token *end, const qdot_token *at, const qdot_source *text,
                        qdot_hint_place places[2]);

#endif
