/* alike-parts.h -- divides a program into parts and sums. Internal to series/.
 *
 * Backwards, a linear step whose result no other kind of step reads is a sum.
 */
#ifndef QDOT_SERIES_ALIKE_PARTS_H
#define QDOT_SERIES_ALIKE_PARTS_H

#include "series/alike.h"
#include "series/motion.h"

typedef struct {
    size_t n;           /* number of parts; 0 also if some step is of a kind that parts cannot have */
    uint32_t *part_of;  /* [steps] the part of a step; UINT32_MAX: a sum, or constant */
    size_t *first;      /* [n + 1] where the steps of a part begin in `steps` */
    uint32_t *steps;    /* steps by part, in an order that is the same for parts that are alike */
    uint64_t *hash;     /* [n] equal for parts that are alike */
    uint32_t *order;    /* [n] parts by hash, then in the order of the program */
    bool *read_outside; /* [rows] whether a row is read by sums, outputs or integrals */
} qdot_alike_parts;

QDOT_MUST_CHECK qdot_status qdot_alike_parts_find(const qdot_motion *motion, qdot_alike_parts *parts);
void qdot_alike_parts_clear(qdot_alike_parts *parts);

/* How many operands a linear step reads: x, then y and z. */
static inline unsigned
qdot_alike_operands(int op)
{
    return op == QDOT_T_NEG ? 1 : op <= QDOT_T_SCALE ? 2 : 3;
}

/* Join the steps of a kind: sums of squares, products with a common factor, powers of one row; rows that are then
 * read at the order at hand alone are kept for that. Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_alike_join(qdot_alike_kind *kind);

/* Make the sums of `alike`, whose inputs and results have values. */
QDOT_MUST_CHECK qdot_status qdot_alike_sums(const qdot_motion *motion, const qdot_alike_parts *parts,
                                            qdot_alike *alike);

#endif
