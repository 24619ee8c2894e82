/* structure.h -- the blocks of coupled unknowns of a symmetric matrix.
 *
 * Two indices belong to one block if a chain of entries that may be nonzero joins them.
 * After reordering by blocks the matrix is block-diagonal; n blocks of one: diagonal;
 * one block: full.
 *
 * Tests  tests/num/test_structure.c
 */
#ifndef QDOT_NUM_STRUCTURE_H
#define QDOT_NUM_STRUCTURE_H

#include <stdbool.h>
#include <stddef.h>

#include "base/status.h"

typedef struct {
    size_t n;      /* number of unknowns */
    size_t blocks; /* number of blocks of connected unknowns */
    size_t *start; /* [blocks + 1] block b is index[start[b]] .. index[start[b + 1] - 1] */
    size_t *index; /* [n] unknowns: ascending within a block, blocks by their first unknown */
} qdot_structure;

/* The blocks of `pattern` (n x n row-major, true where an entry may be nonzero; either
 * triangle is enough, the diagonal is ignored). n may be 0.
 * `out` is filled; release it with qdot_structure_clear. Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_structure_find(const bool *pattern, size_t n,
                                                qdot_structure *out);

void qdot_structure_clear(qdot_structure *s);

static inline bool
qdot_structure_is_full(const qdot_structure *s)
{
    return s->blocks <= 1;
}

#endif
