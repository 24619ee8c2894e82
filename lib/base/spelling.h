/* spelling.h -- finds the word with the least edit distance: letters inserted, deleted, changed,
 * swapped.
 *
 * Tests  tests/lang/session/test_names.c
 */
#ifndef QDOT_BASE_SPELLING_H
#define QDOT_BASE_SPELLING_H

#include <stddef.h>

/* A search: begin, offer one word after another; `best` is then the nearest, borrowed, or NULL where
 * none is near. */
typedef struct {
    const char *name, *best;
    size_t length;
    int least;
} qdot_spelling;

void qdot_spelling_begin(qdot_spelling *s, const char *name);
void qdot_spelling_offer(qdot_spelling *s, const char *candidate);

/* The nearest word in list [n]; NULL if none is near. */
const char *qdot_spelling_nearest(const char *name, size_t n, const char *const *list);

#endif
