/* scope.h -- records the blocks that a computation allocates, so that all can be freed if it is
 * left in the middle.
 *
 * While a scope is the current one of a thread, memory.h adds the blocks that it allocates and
 * removes those that it frees. A block from before stays outside, even if it grows. Used by
 * expr/polynomial/flint.c only.
 */
#ifndef QDOT_BASE_SCOPE_H
#define QDOT_BASE_SCOPE_H

#include <stddef.h>

#include "base/status.h"

typedef struct {
    struct qdot_noted {
        void *block; /* the allocated block; NULL: this slot is free */
        size_t size;
    } * slot;
    size_t mask, n;
    size_t bytes; /* total size of all recorded blocks */
} qdot_scope;

/* The thread's scope; NULL outside of any. */
extern _Thread_local qdot_scope *qdot_scope_now;

/* Make *s the current scope, empty. Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_scope_begin(qdot_scope *s);
/* End the scope: _end leaves its blocks allocated, _discard frees them. */
void qdot_scope_end(qdot_scope *s);
void qdot_scope_discard(qdot_scope *s);

/* Blocks allocated between _pause and _resume do not belong to the scope and outlive it. */
qdot_scope *qdot_scope_pause(void);
void qdot_scope_resume(qdot_scope *s);

/* Of the current scope, no effect outside: note a block (false: no memory), take one out
 * (whether it was in). */
bool qdot_scope_note(void *block, size_t size);
bool qdot_scope_release(void *block);
bool qdot_scope_has(const void *block);

/* As aligned_alloc; the block belongs to the scope, as those of memory.h do. */
void *qdot_malloc_aligned(size_t alignment, size_t size);

#endif
