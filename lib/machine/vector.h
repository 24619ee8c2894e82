/* vector.h -- vectors of x86.h whose lanes are orders, one after another: the operations that
 * AVX-512, AVX2 and SSE2 do not do by the same instructions.
 *
 * An order enters a vector lane by lane: `newest` is the lane of the order at hand, `older` are
 * those below it, `known` both. AVX-512 has these sets in mask registers, the others in two
 * vectors, for which registers 4 and 5 are reserved.
 *
 * Tests   tests/machine/test_vector.c, tests/series/test_taylor-code.c
 */
#ifndef QDOT_MACHINE_VECTOR_H
#define QDOT_MACHINE_VECTOR_H

#include "machine/x86.h"

/* The first registers that are free for what the code is about: with AVX-512, with the others. */
enum { QDOT_VECTOR_FREE = 4, QDOT_VECTOR_FREE_NARROW = 6 };

typedef enum { QDOT_VECTOR_ALL, QDOT_VECTOR_OLDER, QDOT_VECTOR_KNOWN } qdot_vector_lanes;

/* Before anything else here. The newest lane becomes the first; `ones` is a double in memory whose
 * bits are all 1. The newest becomes the next; behind the last there is none. */
void qdot_vector_begin(qdot_x86 *x);
void qdot_vector_first_lane(qdot_x86 *x, qdot_x86_rm ones);
void qdot_vector_next_lane(qdot_x86 *x);

/* The newest lane of reg = a double in memory. AVX-512 only: the others read such vectors from
 * memory. */
void qdot_vector_insert(qdot_x86 *x, int reg, qdot_x86_rm one);
/* to += factor * rm, in these lanes; rm is in memory if that is not all. `spare` is overwritten. */
void qdot_vector_add_product(qdot_x86 *x, int to, int factor, qdot_x86_rm rm,
                             qdot_vector_lanes lanes, int spare);
/* to = the lanes of low from the second on, then the first of high, NULL: then 0. `to` may be the
 * register of low, `spare` is overwritten. */
void qdot_vector_slide(qdot_x86 *x, int to, qdot_x86_rm low, const qdot_x86_rm *high, int spare);

#endif
