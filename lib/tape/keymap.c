/* keymap.c -- a hash table with open addressing, at most half full. */
#include "tape/keymap.h"

#include "base/memory.h"

enum { WIDTH = 5 };

/* The index of the entry with that key, or of the free entry for it. */
static size_t
keymap_find_entry(const uint32_t *entries, size_t size, const uint32_t key[4])
{
    uint64_t h = 0x9e3779b97f4a7c15u;

    for (int i = 0; i < 4; i++) {
        h = (h ^ key[i]) * 0xff51afd7ed558ccdu;
        h ^= h >> 32;
    }
    for (size_t at = (size_t)h & (size - 1);; at = (at + 1) & (size - 1)) {
        const uint32_t *e = entries + WIDTH * at;

        if (e[4] == QDOT_KEYMAP_NONE || (e[0] == key[0] && e[1] == key[1]
                                         && e[2] == key[2] && e[3] == key[3]))
            return at;
    }
}

static void
keymap_write_entry(uint32_t *e, const uint32_t key[4], uint32_t value)
{
    for (int i = 0; i < 4; i++)
        e[i] = key[i];
    e[4] = value;
}

static qdot_status
keymap_grow(qdot_keymap *map)
{
    size_t size = map->size ? 2 * map->size : 64;
    uint32_t *entries = qdot_malloc(size * WIDTH * sizeof *entries);

    if (!entries)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < size; i++)
        entries[WIDTH * i + 4] = QDOT_KEYMAP_NONE;
    for (size_t i = 0; i < map->size; i++) {
        const uint32_t *e = map->entries + WIDTH * i;

        if (e[4] != QDOT_KEYMAP_NONE)
            keymap_write_entry(entries + WIDTH * keymap_find_entry(entries, size, e), e, e[4]);
    }
    qdot_free(map->entries);
    map->entries = entries;
    map->size = size;
    return QDOT_OK;
}

void
qdot_keymap_clear(qdot_keymap *map)
{
    qdot_free(map->entries);
    *map = (qdot_keymap){0};
}

uint32_t
qdot_keymap_get(const qdot_keymap *map, uint32_t a, uint32_t b, uint32_t c, uint32_t d)
{
    const uint32_t key[4] = {a, b, c, d};

    if (map->size == 0)
        return QDOT_KEYMAP_NONE;
    return map->entries[WIDTH * keymap_find_entry(map->entries, map->size, key) + 4];
}

qdot_status
qdot_keymap_set(qdot_keymap *map, uint32_t a, uint32_t b, uint32_t c, uint32_t d,
                uint32_t value)
{
    const uint32_t key[4] = {a, b, c, d};
    uint32_t *e;

    if (2 * (map->used + 1) > map->size)
        QDOT_TRY(keymap_grow(map));
    e = map->entries + WIDTH * keymap_find_entry(map->entries, map->size, key);
    map->used += e[4] == QDOT_KEYMAP_NONE;
    keymap_write_entry(e, key, value);
    return QDOT_OK;
}
