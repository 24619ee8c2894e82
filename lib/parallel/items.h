/* items.h -- which items of some work are left, for those who hand them out (parallel/workers.c).
 *
 * Tests  tests/parallel/test_items.c
 */
#ifndef QDOT_PARALLEL_ITEMS_H
#define QDOT_PARALLEL_ITEMS_H

#include "base/memory.h"

/* Consecutive items of work: first ... first + count - 1. */
typedef struct {
    size_t first, count;
} qdot_items_chunk;

typedef struct {
    size_t first, end;                /* all items are first ... end - 1 */
    size_t next;                      /* the first item that has not been handed out */
    const bool *skip; /* [end] items that are not to be done; NULL: all are to be done */
    size_t left;                      /* number of items that have no answer yet */
    qdot_vec(qdot_items_chunk) again; /* chunks of items to be handed out again, or that were given at the start */
    unsigned char *state; /* [end - first] two bits for each item: it is answered; a worker died of it */
} qdot_items;

/* Start with all items of first ... end - 1 that are not skipped; if not `fresh`, with none until
 * some are given. */
QDOT_MUST_CHECK qdot_status qdot_items_new(qdot_items *items, size_t first, size_t end,
                                           const bool *skip, bool fresh);
void qdot_items_free(qdot_items *items);

/* Take the next chunk of at most `most` (at least 1) items; count 0 if no item is free now. */
qdot_items_chunk qdot_items_take(qdot_items *items, double most);
/* Hand out again the items of the chunk that have no answer. */
QDOT_MUST_CHECK qdot_status qdot_items_give(qdot_items *items, qdot_items_chunk chunk);
/* Mark the items of the chunk as not answered, and hand them out again. */
QDOT_MUST_CHECK qdot_status qdot_items_begin(qdot_items *items, qdot_items_chunk chunk);
/* Record that item k has an answer; returns false if it already had one. */
bool qdot_items_answer(qdot_items *items, size_t k);
/* Record that a worker died during item k; returns false the second time this happens. */
bool qdot_items_survives(qdot_items *items, size_t k);

#endif
