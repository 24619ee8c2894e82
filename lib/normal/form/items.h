/* items.h -- sums of key * value over polynomials; terms with the same key are added. */
#ifndef QDOT_NORMAL_ITEMS_H
#define QDOT_NORMAL_ITEMS_H

#include "normal/field/field.h"

typedef struct {
    fmpz_mpoly_t key, sum; /* a summand is key * sum; key is primitive with positive leading coefficient */
} qdot_item;

/* Start with `qdot_items i = {0};`. */
typedef struct {
    qdot_item *at;
    size_t n, capacity;
} qdot_items;

/* Add key * value; the key is made primitive: key = c key', c value is added to the item of key'. Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_items_add(qdot_field *f, qdot_items *items,
                                           const fmpz_mpoly_t key,
                                           const fmpz_mpoly_t value);

/* Add trig * value, trig a trigonometric polynomial, in parts whose degrees in each
 * angle have the same parity: only these can be combined into multiple angles or by
 * Pythagoras. */
QDOT_MUST_CHECK qdot_status qdot_items_add_parts(qdot_field *f, qdot_items *items,
                                                 const fmpz_mpoly_t trig,
                                                 const fmpz_mpoly_t value);
void qdot_items_clear(qdot_field *f, qdot_items *items);

#endif
