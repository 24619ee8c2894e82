/* message.h -- the JSON of a message.
 *
 * An editor in JavaScript may hold half of a pair of UTF-16, which it writes as an escape, \uD83D, that stands for no character. A
 * change of a document that is refused for it would leave the editor with another text than the server, so such a half, and bytes that
 * are no UTF-8, are read as U+FFFD, which also counts one unit.
 *
 * Tests  tests/meta/lsp.test
 */
#ifndef QDOT_LSP_MESSAGE_H
#define QDOT_LSP_MESSAGE_H

#include <jansson.h>
#include <stddef.h>

/* The message [length]; NULL: it is no JSON, or memory runs out. */
json_t *qdot_message_read(const char *text, size_t length);

#endif
