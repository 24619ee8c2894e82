/* memory.h -- allocation with a hook that makes every failure testable, and growing arrays.
 *
 * A failed allocation returns NULL and has passed qdot_fail(QDOT_ENOMEM, ...).
 */
#ifndef QDOT_BASE_MEMORY_H
#define QDOT_BASE_MEMORY_H

#include <stddef.h>
#include <stdint.h>

#include "base/status.h"

/* As malloc, calloc, realloc, free, strndup; size 0 gives a block that may be freed. */
void *qdot_malloc(size_t size);
void *qdot_calloc(size_t count, size_t size);
void *qdot_realloc(void *block, size_t size);
char *qdot_strndup(const char *text, size_t length);
char *qdot_strdup(const char *text);
void qdot_free(void *block);

/* Arrays of doubles in one block, all 0: each part's place is set to its n doubles. *block is to be
 * freed; the parts are not. */
typedef struct {
    double **place;
    size_t n;
} qdot_part;
QDOT_MUST_CHECK qdot_status qdot_calloc_parts(double **block, size_t count,
                                              const qdot_part *parts);

/* For tests: make the n-th allocation from now (0: the next) and all later ones fail; n < 0: none. */
void qdot_memory_fail_at(int64_t n);
/* For tests: simulate Ctrl-C at the n-th allocation from now (n = 0: the next); n < 0: never. */
void qdot_memory_press_at(int64_t n);

/* Grow *block (items of `size` bytes, *capacity of them) until it holds `wanted` items.
 * On failure the block is unchanged. */
QDOT_MUST_CHECK qdot_status qdot_grow(void *block, size_t *capacity, size_t wanted,
                                      size_t size);

/* A typed vector: declare `qdot_vec(int) v = {0};`, push, free with qdot_free(v.at). */
#define qdot_vec(type)                                                                   \
    struct {                                                                             \
        type *at;                                                                        \
        size_t n, capacity;                                                              \
    }

/* Append `value` to a vector; returns a qdot_status. */
#define qdot_vec_push(v, value)                                                          \
    ((v)->n < (v)->capacity ||                                                           \
             qdot_grow(&(v)->at, &(v)->capacity, (v)->n + 1, sizeof *(v)->at) == QDOT_OK \
         ? ((v)->at[(v)->n] = (value), (v)->n++, QDOT_OK)                                \
         : QDOT_ENOMEM)

/* A memory block shared by many small objects and freed as a whole. */
typedef struct qdot_arena qdot_arena;

qdot_arena *qdot_arena_new(void);
void qdot_arena_free(qdot_arena *arena);
/* `size` bytes, aligned for any type, not cleared; NULL on failure. */
void *qdot_arena_take(qdot_arena *arena, size_t size);
char *qdot_arena_strndup(qdot_arena *arena, const char *text, size_t length);

#endif
