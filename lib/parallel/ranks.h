/* ranks.h -- the processes that mpirun started, of which this is one, and their messages.
 *
 * Each rank carries out the same script. Rank 0 alone is seen: it reads and writes files and prints;
 * what it reads it shares. It does not depend on another rank: one that is silent is soon waited for
 * no more. The others end when rank 0 tells them to. A program that mpirun has not started has one
 * rank, pays nothing for that, and does not load MPI.
 *
 * Messages of one rank to another come in their order. Those to rank 0 are short (QDOT_RANKS_SHORT): a
 * long one needs its sender until all of it has come, and a sender may die.
 *
 * Tests  tests/meta/ranks.test
 */
#ifndef QDOT_PARALLEL_RANKS_H
#define QDOT_PARALLEL_RANKS_H

#include "base/process.h"
#include "base/text.h"

enum { QDOT_RANKS_SHORT = 4000 };

/* The kinds of messages between ranks; those from QDOT_RANK_ALIVE on are internal to this module. */
typedef enum {
    QDOT_RANK_READY = 1, /* to rank 0: this rank is free and asks for work */
    QDOT_RANK_CHUNK,     /* from rank 0: a chunk of work */
    QDOT_RANK_ANSWER,    /* to rank 0: a part of the answers */
    QDOT_RANK_ALIVE,
    QDOT_RANK_SHARED,
    QDOT_RANK_END,
    QDOT_RANK_GOODBYE
} qdot_rank_what;

typedef struct {
    size_t from;
    qdot_rank_what what;
    qdot_text bytes;
} qdot_rank_message;

/* Join the others, if mpirun has started this process: before anything is read or computed. *kind, what
 * this processor can, becomes the least of all; a rank whose C library gives other digits than rank 0's
 * takes no part and says so. QDOT_ENOTBUILT: this program has no MPI; QDOT_EIO: it cannot be loaded. */
QDOT_MUST_CHECK qdot_status qdot_ranks_begin(size_t *kind);

/* Send a copy of bytes [n] to the rank `to`. */
void qdot_ranks_send(size_t to, qdot_rank_what what, const void *bytes, size_t n);
/* The next message that has come, if there is one; m->bytes is emptied or filled. Not rank 0: ends
 * this process if rank 0 has said so. */
bool qdot_ranks_next(qdot_rank_message *m);
/* Whether the next message is one that rank 0 shares with all ranks. */
bool qdot_ranks_has_shared(void);
/* A rank that has work says so again and again: it sends a sign of life if it has sent nothing for a
 * second. */
void qdot_ranks_beat(void);
/* Rank 0: whether that rank is dead, as this machine knows, or has been silent for some seconds; these
 * begin when it is given work, if not later. */
bool qdot_ranks_is_lost(size_t rank);
void qdot_ranks_expect(size_t rank);

/* What rank 0 has read, or found out: there `text` is sent to all others, which wait for it and have
 * then the same text and the same failure. Returns the status of rank 0. */
QDOT_MUST_CHECK qdot_status qdot_ranks_share(qdot_status status, qdot_text *text);

/* What rank 0 reads of an open file (base/text.h: qdot_text_read), shared. NULL: errno says why it could not
 * be opened. */
QDOT_MUST_CHECK qdot_status qdot_ranks_read(qdot_text *text, FILE *from, const char *path,
                                            size_t most);

/* The end. Rank 0: that of all others, with notice on standard error of those that were lost; returns
 * the exit status. The others wait for it, and do not return. */
int qdot_ranks_end(int status);

#endif
