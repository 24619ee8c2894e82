/* scope.c -- records the blocks of memory allocated within a scope in a hash table, which is itself not recorded. */
#include "base/scope.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

_Thread_local qdot_scope *qdot_scope_now = NULL;

enum { FIRST = 1024 };

static size_t
hash_of_block(const qdot_scope *s, const void *block)
{
    return (size_t)(((uintptr_t)block >> 4) * 0x9e3779b97f4a7c15u >> 20) & s->mask;
}

static size_t
find_slot_of_block(const qdot_scope *s, const void *block)
{
    size_t i = hash_of_block(s, block);

    while (s->slot[i].block != NULL && s->slot[i].block != block)
        i = (i + 1) & s->mask;
    return i;
}

static bool
enlarge_table_of_blocks(qdot_scope *s)
{
    qdot_scope bigger = {.mask = 2 * (s->mask + 1) - 1};

    bigger.slot = calloc(bigger.mask + 1, sizeof *bigger.slot);
    if (bigger.slot == NULL)
        return false;
    for (size_t i = 0; i <= s->mask; i++)
        if (s->slot[i].block != NULL)
            bigger.slot[find_slot_of_block(&bigger, s->slot[i].block)] = s->slot[i];
    free(s->slot);
    s->slot = bigger.slot;
    s->mask = bigger.mask;
    return true;
}

qdot_status
qdot_scope_begin(qdot_scope *s)
{
    *s = (qdot_scope){.mask = FIRST - 1};
    s->slot = calloc(FIRST, sizeof *s->slot);
    if (s->slot == NULL)
        return qdot_fail(QDOT_ENOMEM, "out of memory");
    qdot_scope_now = s;
    return QDOT_OK;
}

void
qdot_scope_end(qdot_scope *s)
{
    qdot_scope_now = NULL;
    free(s->slot);
    *s = (qdot_scope){0};
}

void
qdot_scope_discard(qdot_scope *s)
{
    for (size_t i = 0; i <= s->mask; i++)
        free(s->slot[i].block);
    qdot_scope_end(s);
}

qdot_scope *
qdot_scope_pause(void)
{
    qdot_scope *s = qdot_scope_now;

    qdot_scope_now = NULL;
    return s;
}

void
qdot_scope_resume(qdot_scope *s)
{
    qdot_scope_now = s;
}

bool
qdot_scope_note(void *block, size_t size)
{
    qdot_scope *s = qdot_scope_now;

    if (s == NULL)
        return true;
    if (2 * (s->n + 1) > s->mask && !enlarge_table_of_blocks(s))
        return false;
    s->slot[find_slot_of_block(s, block)] = (struct qdot_noted){block, size};
    s->n++;
    s->bytes += size;
    return true;
}

bool
qdot_scope_has(const void *block)
{
    const qdot_scope *s = qdot_scope_now;

    return s != NULL && block != NULL && s->slot[find_slot_of_block(s, block)].block != NULL;
}

bool
qdot_scope_release(void *block)
{
    qdot_scope *s = qdot_scope_now;
    size_t i, gap;

    if (!qdot_scope_has(block))
        return false;
    gap = find_slot_of_block(s, block);
    s->n--;
    s->bytes -= s->slot[gap].size;
    /* move back the entries after the slot just emptied that a search, ending at that slot, would no longer find */
    for (i = (gap + 1) & s->mask; s->slot[i].block != NULL; i = (i + 1) & s->mask) {
        size_t from = hash_of_block(s, s->slot[i].block);

        if (((i - from) & s->mask) >= ((i - gap) & s->mask)) {
            s->slot[gap] = s->slot[i];
            gap = i;
        }
    }
    s->slot[gap].block = NULL;
    return true;
}
