/* map.c -- an open-addressing hash table, doubled when half full. */
#include "normal/field/map.h"

#include "base/memory.h"

static uint32_t
map_find_slot(const qdot_map *m, qdot_expr key)
{
    uint32_t i = key * 2654435761u & m->mask;

    while (m->at[i].key != QDOT_NIL && m->at[i].key != key)
        i = (i + 1) & m->mask;
    return i;
}

static qdot_status
map_enlarge(qdot_map *m)
{
    qdot_map bigger = {0};
    uint32_t size = m->at == NULL ? 32 : 2 * (m->mask + 1);

    bigger.at = qdot_calloc(size, sizeof *bigger.at);
    if (bigger.at == NULL)
        return QDOT_ENOMEM;
    bigger.mask = size - 1;
    bigger.n = m->n;
    if (m->at != NULL)
        for (uint32_t i = 0; i <= m->mask; i++)
            if (m->at[i].key != QDOT_NIL)
                bigger.at[map_find_slot(&bigger, m->at[i].key)] = m->at[i];
    qdot_free(m->at);
    *m = bigger;
    return QDOT_OK;
}

qdot_status
qdot_map_set(qdot_map *m, qdot_expr key, uint32_t value)
{
    uint32_t i;

    if (m->at == NULL || 2 * (m->n + 1) > m->mask)
        QDOT_TRY(map_enlarge(m));
    i = map_find_slot(m, key);
    if (m->at[i].key == QDOT_NIL)
        m->n++;
    m->at[i].key = key;
    m->at[i].value = value;
    return QDOT_OK;
}

bool
qdot_map_get(const qdot_map *m, qdot_expr key, uint32_t *value)
{
    uint32_t i;

    if (m->at == NULL)
        return false;
    i = map_find_slot(m, key);
    if (m->at[i].key == QDOT_NIL)
        return false;
    if (value != NULL)
        *value = m->at[i].value;
    return true;
}

void
qdot_map_clear(qdot_map *m)
{
    qdot_free(m->at);
    *m = (qdot_map){0};
}
