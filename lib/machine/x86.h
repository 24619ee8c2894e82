/* x86.h -- instructions of x86-64 as bytes, with AVX-512, with AVX2 and FMA or with neither: what
 * asm.h is made of. Internal to machine/.
 *
 * The kinds differ in the number and the width of registers, and in how lanes are masked. SSE2
 * writes over what it reads and has no fused operations: up to four instructions stand for one,
 * and register 15 is theirs.
 *
 * Source  Intel 64 and IA-32 Architectures Software Developer's Manual 2, 2.3 (VEX), 2.7 (EVEX).
 * Tests   tests/machine/test_x86.c
 */
#ifndef QDOT_ASM_X86_H
#define QDOT_ASM_X86_H

#include "machine/asm.h"

/* Further instructions on whole vectors, numbered after the operations. */
enum {
    QDOT_X86_XOR = QDOT_ASM_OPERATIONS,
    QDOT_X86_AND,
    QDOT_X86_ALIGN, /* AVX-512: reg = consecutive lanes of the pair (b, first), starting at a given lane */
    QDOT_X86_PERMUTE, /* reg = lanes of b, each chosen by two bits of a constant */
    QDOT_X86_HALVES,  /* AVX2: each half of reg = a half of first or of b, or 0 */
    QDOT_X86_PAIRS,   /* reg = from each pair of lanes one lane of first, then one of b */
    QDOT_X86_COUNT
};

/* Append any instruction; _move_lanes: one with an extra byte `how` that says how lanes move. */
void qdot_x86_emit(qdot_asm *m, int name, bool wide, int reg, int first, qdot_operand b);
void qdot_x86_move_lanes(qdot_asm *m, int name, int reg, int first, qdot_operand b,
                         int how);
/* Mask register r (1 ... 7) = lanes, a bit each; it takes on the lanes of `more`; it moves up by a
 * lane. */
void qdot_x86_set_mask(qdot_asm *m, int r, unsigned lanes);
void qdot_x86_join_masks(qdot_asm *m, int r, int more);
void qdot_x86_raise_mask(qdot_asm *m, int r);

#endif
