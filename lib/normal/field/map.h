/* map.h -- a small hash map from expression ids to words. */
#ifndef QDOT_NORMAL_MAP_H
#define QDOT_NORMAL_MAP_H

#include "base/status.h"
#include "expr/id.h"

/* Start with `qdot_map m = {0};`. */
typedef struct {
    struct {
        qdot_expr key; /* id of the expression; nil: this slot is free */
        uint32_t value;
    } * at;
    uint32_t n, mask;
} qdot_map;

/* Set key -> value. Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_map_set(qdot_map *m, qdot_expr key, uint32_t value);
/* Whether the key is in the map; *value (may be NULL) is its value. */
bool qdot_map_get(const qdot_map *m, qdot_expr key, uint32_t *value);
void qdot_map_clear(qdot_map *m);

#endif
