/* transport.c -- messages of JSON-RPC with their headers. */
#include "transport.h"

#include <errno.h>
#include <poll.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

enum { HEADER_MOST = 4096, BLOCK = 65536 };

/* The length that a header [n] states; SIZE_MAX: none that can be. */
static size_t
read_header(const char *header, size_t n)
{
    static const char name[] = "Content-Length:";
    size_t found = SIZE_MAX;

    for (const char *line = header; line < header + n;) {
        const char *end = memchr(line, '\n', (size_t)(header + n - line));

        if (strncasecmp(line, name, sizeof name - 1) == 0) {
            char *rest;
            uintmax_t value;

            line += sizeof name - 1;
            line += strspn(line, " \t");
            if (*line < '0' || *line > '9')
                return SIZE_MAX;
            value = strtoumax(line, &rest, 10);
            if (value > QDOT_TRANSPORT_MOST || strspn(rest, " \t\r\n") == 0)
                return SIZE_MAX;
            found = value;
        }
        line = end != NULL ? end + 1 : header + n;
    }
    return found;
}

/* The bytes up to behind the blank line that ends the header; 0: there is no end yet. */
static size_t
length_of_header(const char *text, size_t n)
{
    for (size_t i = 0; i + 1 < n; i++) {
        if (text[i] != '\n')
            continue;
        if (text[i + 1] == '\n')
            return i + 2;
        if (text[i + 1] == '\r' && i + 2 < n && text[i + 2] == '\n')
            return i + 3;
    }
    return 0;
}

/* Skip what is no message, up to the next word with which a header may begin. */
static qdot_transport_found
skip(qdot_transport *t)
{
    static const char name[] = "content-length:";
    const char *text = t->pending.at;
    size_t i = t->at + 1;

    while (i < t->pending.n && strncasecmp(text + i, name, t->pending.n - i < sizeof name - 1 ? t->pending.n - i : sizeof name - 1) != 0)
        i++;
    t->at = i;
    return QDOT_TRANSPORT_WRONG;
}

qdot_transport_found
qdot_transport_take(qdot_transport *t, const char **message, size_t *length)
{
    const size_t left = t->pending.n - t->at;
    const char *text = t->pending.at + t->at;
    size_t header, body;

    if (left == 0)
        return QDOT_TRANSPORT_NONE;
    header = length_of_header(text, left < HEADER_MOST ? left : HEADER_MOST);
    if (header == 0)
        return left >= HEADER_MOST ? skip(t) : QDOT_TRANSPORT_NONE;
    body = read_header(text, header);
    if (body == SIZE_MAX)
        return skip(t);
    if (left - header < body)
        return QDOT_TRANSPORT_NONE;
    *message = text + header;
    *length = body;
    t->at += header + body;
    return QDOT_TRANSPORT_MESSAGE;
}

qdot_status
qdot_transport_read(qdot_transport *t)
{
    char block[BLOCK];
    ssize_t n;

    if (t->at > 0) { /* what has been taken is not kept */
        memmove(t->pending.at, t->pending.at + t->at, t->pending.n - t->at);
        qdot_text_truncate(&t->pending, t->pending.n - t->at);
        t->at = 0;
    }
    do
        n = read(t->in, block, sizeof block);
    while (n < 0 && errno == EINTR);
    if (n < 0)
        return qdot_fail(QDOT_EIO, "the input cannot be read: %s", strerror(errno));
    t->ended = n == 0;
    qdot_text_add_n(&t->pending, block, (size_t)n);
    return qdot_text_status(&t->pending);
}

bool
qdot_transport_waits(const qdot_transport *t)
{
    struct pollfd poll_in = {.fd = t->in, .events = POLLIN};

    return t->at < t->pending.n || (!t->ended && poll(&poll_in, 1, 0) > 0);
}

static void
write_bytes(qdot_transport *t, const char *text, size_t n)
{
    while (n > 0 && !t->broken) {
        const ssize_t written = write(t->out, text, n);

        if (written > 0) {
            text += written;
            n -= (size_t)written;
        } else if (errno == EAGAIN) {
            struct pollfd poll_out = {.fd = t->out, .events = POLLOUT};

            (void)poll(&poll_out, 1, -1);
        } else if (errno != EINTR) {
            t->broken = true;
        }
    }
}

void
qdot_transport_write(qdot_transport *t, const char *message, size_t length)
{
    char header[64];
    const int n = snprintf(header, sizeof header, "Content-Length: %zu\r\n\r\n", length);

    write_bytes(t, header, (size_t)n);
    write_bytes(t, message, length);
}
