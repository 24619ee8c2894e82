/* search.h -- the words of the language whose name, summary or example holds a text.
 *
 * Tests  tests/script/language/help-search.lag
 */
#ifndef QDOT_LANG_SEARCH_H
#define QDOT_LANG_SEARCH_H

#include "base/text.h"

/* Append a line for each statement, value, function and method that holds every word of `text`,
 * whatever the case of letters: first those whose name does, then the others. Returns their
 * number. */
size_t qdot_search(const char *text, qdot_text *out);

#endif
