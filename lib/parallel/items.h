/* items.h -- which items of some work are left, for those who hand them out (parallel/workers.c).
 *
 * Tests  tests/parallel/test_items.c
 */
#ifndef QDOT_PARALLEL_ITEMS_H
#define QDOT_PARALLEL_ITEMS_H

#include "base/memory.h"

/* Consecutive items: first ... first + count - 1. */
typedef struct {
    size_t first, count;
} qdot_items_chunk;

typedef struct {
    size_t first, end;                /* the range of all items: first ... end - 1 */
    size_t next;                      /* the first item that has not been handed out */
    const bool *skip; /* [end] items that are not to be done; NULL: all are to be done */
    size_t left;                      /* number of items without an answer */
    qdot_vec(qdot_items_chunk) again; /* chunks to be handed out again, or given at the start */
    unsigned char *state; /* [end - first] two bits for each item: answered; a worker died of it */
} qdot_items;

/* Start with all items of first ... end - 1 that are not skipped; if not `fresh`, with none until
 * some are given. */
QDOT_MUST_CHECK qdot_status qdot_items_new(qdot_items *items, size_t first, size_t end,
                                           const bool *skip, bool fresh);
void qdot_items_free(qdot_items *items);

/* Take the next chunk, of at most `most` items (at least 1); count 0 if there is none now. */
qdot_items_chunk qdot_items_take(qdot_items *items, double most);
/* Hand out again the items of the chunk that have no answer. */
QDOT_MUST_CHECK qdot_status qdot_items_give(qdot_items *items, qdot_items_chunk chunk);
/* Mark the items of the chunk as not answered, and hand them out again. */
QDOT_MUST_CHECK qdot_status qdot_items_begin(qdot_items *items, qdot_items_chunk chunk);
/* Record that item k has an answer; false if it already had one. */
bool qdot_items_answer(qdot_items *items, size_t k);
/* Record that a worker died during item k; false the second time. */
bool qdot_items_survives(qdot_items *items, size_t k);

#endif
