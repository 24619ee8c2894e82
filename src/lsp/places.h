/* places.h -- places of a text as an editor counts them: lines from 0, and units of UTF-16 (or bytes) within a line.
 *
 * Lines end with \n, \r\n or \r. A place beyond the end of a line is that end, as the protocol says; one within a character is
 * its beginning.
 *
 * Where a place is in a long text is counted from a mark near it. Marks are kept from one place to the next, while the text is the same:
 * call qdot_places_forget before a text can have changed.
 *
 * Tests  tests/meta/lsp.test
 */
#ifndef QDOT_LSP_PLACES_H
#define QDOT_LSP_PLACES_H

#include "parts.h"

/* The byte of the text [length] at the place {"line":, "character":}; false: it is no place. */
bool qdot_place_read(const qdot_server *server, const char *text, size_t length, const json_t *place, size_t *at);
/* Line and character of bytes that are asked for in ascending order, in one pass. Begin with {0}. */
typedef struct {
    size_t at, line, character;
} qdot_place_walk;
/* Line and character of byte `at`, or of the beginning of the character that is there. */
qdot_place_walk qdot_place_at(const qdot_server *server, const char *text, size_t length, size_t at);

void qdot_places_forget(qdot_server *server);
/* The marks; NULL if memory runs out. */
qdot_place_marks *qdot_places_new(void);
void qdot_places_free(qdot_place_marks *marks);
/* A range; NULL if memory runs out. */
json_t *qdot_place_range(const qdot_server *server, const char *text, size_t length, qdot_stretch at);
/* Read a range {"start":, "end":}; false: it is none. */
bool qdot_place_read_range(const qdot_server *server, const char *text, size_t length, const json_t *range, qdot_stretch *at);

void qdot_place_walk_to(const qdot_server *server, const char *text, size_t length, size_t at, qdot_place_walk *walk);
/* The units of the bytes [from, to) of one line. */
size_t qdot_place_units(const qdot_server *server, const char *text, qdot_stretch at);

#endif
