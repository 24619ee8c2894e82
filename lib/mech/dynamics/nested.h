/* nested.h -- sums over many sets of the same items, built from sums over smaller sets. Internal to mech/. */
#ifndef QDOT_MECH_NESTED_H
#define QDOT_MECH_NESTED_H

#include "mech/scene/scene.h"

/* Sets of items that have values; in the bits of a set, those beyond the number of items are 0. */
typedef struct {
    size_t items, sets, words; /* numbers of items and of sets; 64-bit words in a set */
    const qdot_expr *value;    /* [items] value of each item */
    const uint64_t *bits;      /* [sets * words] bit i of a set is 1 if item i belongs to it */
} qdot_family;

/* sum [sets]: the sum of the values of each set, held (qdot_hold), built from the sums of its
 * subsets. Work sets^2 words. False on failure. */
bool qdot_nested_sums(qdot_scene *s, const qdot_family *family, qdot_expr *sum);

#endif
