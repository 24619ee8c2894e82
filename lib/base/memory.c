/* memory.c -- all allocations of the library, each of which tests can make fail. */
#include "base/memory.h"

#include <stdatomic.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "base/interrupt.h"
#include "base/memory-failure.h"
#include "base/scope.h"

static atomic_bool ran_out; /* whether any thread ran out of memory */
static int64_t fail_after = -1, fail_once_after = -1, visit_after = -1;
static void (*visit)(void);

static void *
check_allocation(void *block, size_t size)
{
    if (block == NULL) {
        atomic_store(&ran_out, true);
        (void)qdot_fail(QDOT_ENOMEM, "out of memory (%zu bytes wanted)", size);
    }
    return block;
}

bool
qdot_memory_ran_out(void)
{
    return atomic_exchange(&ran_out, false);
}

static bool
allocation_must_fail(void)
{
    if (visit_after >= 0 && visit_after-- == 0)
        visit();
    if (fail_once_after >= 0 && fail_once_after-- == 0)
        return true;
    if (fail_after < 0)
        return false;
    if (fail_after > 0) {
        fail_after--;
        return false;
    }
    return true;
}

void
qdot_memory_fail_at(int64_t n)
{
    fail_after = n;
}

int64_t
qdot_memory_fail_once_at(int64_t n)
{
    const int64_t left = fail_once_after;

    fail_once_after = n;
    return left;
}

void
qdot_memory_visit_at(int64_t n, void (*who)(void))
{
    visit = who;
    visit_after = n;
}

void
qdot_memory_press_at(int64_t n)
{
    qdot_memory_visit_at(n, qdot_interrupt_set);
}

/* Record an allocated block in the thread's scope (scope.h) and return it; if that fails, free it
 * and return NULL. */
static void *
record_block(void *block, size_t size)
{
    if (qdot_scope_now != NULL && block != NULL && !qdot_scope_note(block, size)) {
        free(block);
        block = NULL;
    }
    return check_allocation(block, size);
}

void *
qdot_malloc(size_t size)
{
    return record_block(allocation_must_fail() ? NULL : malloc(size ? size : 1), size);
}

void *
qdot_malloc_aligned(size_t alignment, size_t size)
{
    return record_block(allocation_must_fail() ? NULL : aligned_alloc(alignment, size), size);
}

void *
qdot_calloc(size_t count, size_t size)
{
    return record_block(allocation_must_fail() ? NULL : calloc(count ? count : 1, size ? size : 1),
                        count * size);
}

void *
qdot_realloc(void *block, size_t size)
{
    bool inside = block == NULL || qdot_scope_has(block);
    void *bigger;

    if (allocation_must_fail())
        return check_allocation(NULL, size);
    if (inside && block != NULL)
        qdot_scope_release(block);
    bigger = realloc(block, size ? size : 1);
    if (bigger == NULL && inside && block != NULL)
        (void)qdot_scope_note(block, 0); /* cannot fail: the scope already had an entry for this block */
    return inside ? record_block(bigger, size) : check_allocation(bigger, size);
}

qdot_status
qdot_calloc_parts(double **block, size_t count, const qdot_part *parts)
{
    size_t all = 0;

    for (size_t i = 0; i < count; i++)
        all += parts[i].n;
    *block = qdot_calloc(all, sizeof **block);
    if (!*block)
        return QDOT_ENOMEM;
    all = 0;
    for (size_t i = 0; i < count; all += parts[i++].n)
        *parts[i].place = *block + all;
    return QDOT_OK;
}

char *
qdot_strndup(const char *text, size_t length)
{
    char *copy = qdot_malloc(length + 1);

    if (copy != NULL) {
        memcpy(copy, text, length);
        copy[length] = '\0';
    }
    return copy;
}

char *
qdot_strdup(const char *text)
{
    return qdot_strndup(text, strlen(text));
}

void
qdot_free(void *block)
{
    if (qdot_scope_now != NULL)
        qdot_scope_release(block);
    free(block);
}

qdot_status
qdot_grow(void *block, size_t *capacity, size_t wanted, size_t size)
{
    void **slot = block, *bigger;
    size_t enough = *capacity;

    if (wanted <= *capacity)
        return QDOT_OK;
    if (enough < 8)
        enough = 8;
    while (enough < wanted) {
        if (enough > SIZE_MAX / 2 / size)
            return qdot_fail(QDOT_ENOMEM, "out of memory (an array of %zu items)", wanted);
        enough *= 2;
    }
    bigger = qdot_realloc(*slot, enough * size);
    if (bigger == NULL)
        return QDOT_ENOMEM;
    *slot = bigger;
    *capacity = enough;
    return QDOT_OK;
}

/* --- arenas: blocks freed as a whole ------------------------------------------------- */

struct chunk {
    struct chunk *next;
    size_t used, size;
    max_align_t bytes[];
};

struct qdot_arena {
    struct chunk *chunks;
};

qdot_arena *
qdot_arena_new(void)
{
    return qdot_calloc(1, sizeof(qdot_arena));
}

void
qdot_arena_free(qdot_arena *arena)
{
    if (arena == NULL)
        return;
    for (struct chunk *c = arena->chunks, *next; c != NULL; c = next) {
        next = c->next;
        qdot_free(c);
    }
    qdot_free(arena);
}

void *
qdot_arena_take(qdot_arena *arena, size_t size)
{
    const size_t unit = sizeof(max_align_t);
    struct chunk *c = arena->chunks;

    size = (size + unit - 1) / unit * unit;
    if (c == NULL || c->size - c->used < size) {
        size_t room = size > 65536 ? size : 65536;

        c = qdot_malloc(sizeof *c + room);
        if (c == NULL)
            return NULL;
        c->used = 0;
        c->size = room;
        c->next = arena->chunks;
        arena->chunks = c;
    }
    c->used += size;
    return (char *)c->bytes + c->used - size;
}

char *
qdot_arena_strndup(qdot_arena *arena, const char *text, size_t length)
{
    char *copy = qdot_arena_take(arena, length + 1);

    if (copy != NULL) {
        memcpy(copy, text, length);
        copy[length] = '\0';
    }
    return copy;
}
