/* keymap.h -- a hash table from four words to one, without removal.
 *
 * For lowering: values by operation and operands, constants by their expression, angles by their
 * parts.
 */
#ifndef QDOT_TAPE_KEYMAP_H
#define QDOT_TAPE_KEYMAP_H

#include <stddef.h>
#include <stdint.h>

#include "base/status.h"

#define QDOT_KEYMAP_NONE UINT32_MAX

/* A hash table with keys of four numbers. Start from {0}. */
typedef struct {
    uint32_t *entries; /* [size][5] four words of key, one of value; value QDOT_KEYMAP_NONE: free */
    size_t size, used;
} qdot_keymap;

void qdot_keymap_clear(qdot_keymap *map);

/* The value of key (a, b, c, d), QDOT_KEYMAP_NONE if there is none. */
uint32_t qdot_keymap_get(const qdot_keymap *map, uint32_t a, uint32_t b, uint32_t c,
                         uint32_t d);

/* Set the value of (a, b, c, d). Errors: QDOT_ENOMEM, the table unchanged. */
QDOT_MUST_CHECK qdot_status qdot_keymap_set(qdot_keymap *map, uint32_t a, uint32_t b,
                                            uint32_t c, uint32_t d, uint32_t value);

#endif
