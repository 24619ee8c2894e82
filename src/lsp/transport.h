/* transport.h -- messages of JSON-RPC with their headers, read from one file descriptor and written to another.
 *
 *   Content-Length: 52\r\n\r\n{"jsonrpc":"2.0",...}
 *
 * What is no message is skipped up to the next header that is one, so that one mistake of a client does not end the server.
 *
 * Tests  tests/meta/lsp.test
 */
#ifndef QDOT_LSP_TRANSPORT_H
#define QDOT_LSP_TRANSPORT_H

#include "base/text.h"

enum { QDOT_TRANSPORT_MOST = 1 << 28 }; /* largest message in bytes */

typedef struct {
    int in, out;
    qdot_text pending; /* bytes that have been read */
    size_t at;         /* how many of them have been taken */
    bool ended;        /* the input has ended */
    bool broken;       /* the output cannot be written any more */
} qdot_transport;

typedef enum {
    QDOT_TRANSPORT_MESSAGE, /* there is a message */
    QDOT_TRANSPORT_NONE,    /* there is none yet */
    QDOT_TRANSPORT_WRONG    /* something was skipped that was no message */
} qdot_transport_found;

/* Take the next message out of what has been read: its bytes [*length], borrowed until the next call of _read. */
qdot_transport_found qdot_transport_take(qdot_transport *t, const char **message, size_t *length);
/* Read what is there, at least one byte unless the input ends; waits if nothing is there. QDOT_ENOMEM, QDOT_EIO. */
QDOT_MUST_CHECK qdot_status qdot_transport_read(qdot_transport *t);
/* Whether there is input that has not been taken. */
bool qdot_transport_waits(const qdot_transport *t);
/* Write a message; nothing happens if the output is broken. */
void qdot_transport_write(qdot_transport *t, const char *message, size_t length);

#endif
