/* vector.c -- lanes by masks, or by vectors that stand for them. */
#include "machine/vector.h"

enum {
    /* Of AVX-512 masks, of AVX2 registers. */
    older = 4,
    known = 5,
    newest = 1, /* masks only */
    all_but_last = 3
};

void
qdot_vector_begin(qdot_x86 *x)
{
    if (!x->narrow)
        qdot_x86_set_mask(x, all_but_last, 0x7f);
}

void
qdot_vector_first_lane(qdot_x86 *x, qdot_x86_rm ones)
{
    if (x->narrow) {
        qdot_x86_emit(x, QDOT_X86_XOR_ALL, older, older, qdot_x86_reg(older));
        qdot_x86_emit(x, QDOT_X86_LOAD, known, 0, ones);
        return;
    }
    qdot_x86_set_mask(x, newest, 1);
    qdot_x86_set_mask(x, older, 0);
    qdot_x86_set_mask(x, known, 1);
}

void
qdot_vector_next_lane(qdot_x86 *x)
{
    enum { first_twice = 0x90, first_in_both = 0 }; /* lanes 0, 0, 1, 2; 0, 0 */

    if (x->narrow)
        qdot_x86_emit(x, QDOT_X86_LOAD_ALL, older, 0, qdot_x86_reg(known));
    if (x->sse2)
        qdot_x86_move_lanes(x, QDOT_X86_PAIRS, known, known, qdot_x86_reg(known),
                            first_in_both);
    else if (x->narrow)
        qdot_x86_move_lanes(x, QDOT_X86_PERMUTE, known, 0, qdot_x86_reg(known), first_twice);
    if (x->narrow)
        return;
    qdot_x86_join_masks(x, older, newest);
    qdot_x86_raise_mask(x, newest);
    qdot_x86_join_masks(x, known, newest);
}

void
qdot_vector_insert(qdot_x86 *x, int reg, qdot_x86_rm one)
{
    x->mask = newest;
    qdot_x86_emit(x, QDOT_X86_SPREAD, reg, 0, one);
    x->mask = 0;
}

void
qdot_vector_add_product(qdot_x86 *x, int to, int factor, qdot_x86_rm rm, qdot_vector_lanes lanes,
                        int spare)
{
    const int set = lanes == QDOT_VECTOR_OLDER ? older : known;

    if (lanes != QDOT_VECTOR_ALL && x->narrow) {
        qdot_x86_emit(x, QDOT_X86_AND_ALL, spare, set, rm);
        rm = qdot_x86_reg(spare);
    } else if (lanes != QDOT_VECTOR_ALL) {
        x->mask = set;
    }
    qdot_x86_emit(x, QDOT_X86_MADD_ALL, to, factor, rm);
    x->mask = 0;
}

/* What is in memory is loaded. */
static int
in_register(qdot_x86 *x, qdot_x86_rm rm, int reg)
{
    if (!rm.memory)
        return rm.reg;
    qdot_x86_emit(x, QDOT_X86_LOAD_ALL, reg, 0, rm);
    return reg;
}

/* Of low (a, b, c, d) and high (e, ...): spare = (c, d, e, ...), to = (b, c, d, e). */
static void
slide_by_halves(qdot_x86 *x, int to, qdot_x86_rm low, const qdot_x86_rm *high, int spare)
{
    enum { upper_then_lower = 0x21, upper_then_0 = 0x81, second_then_first = 5 };
    const int from = in_register(x, low, to);

    qdot_x86_move_lanes(x, QDOT_X86_HALVES, spare, from, high ? *high : qdot_x86_reg(from),
                        high ? upper_then_lower : upper_then_0);
    qdot_x86_move_lanes(x, QDOT_X86_PAIRS, to, from, qdot_x86_reg(spare), second_then_first);
}

/* Of low (a, b) and high (c, d): (b, c). */
static void
slide_by_pairs(qdot_x86 *x, int to, qdot_x86_rm low, const qdot_x86_rm *high, int spare)
{
    enum { second_then_first = 1 };

    if (!high)
        qdot_x86_emit(x, QDOT_X86_XOR_ALL, spare, spare, qdot_x86_reg(spare));
    qdot_x86_move_lanes(x, QDOT_X86_PAIRS, to, in_register(x, low, to),
                        high ? *high : qdot_x86_reg(spare), second_then_first);
}

void
qdot_vector_slide(qdot_x86 *x, int to, qdot_x86_rm low, const qdot_x86_rm *high, int spare)
{
    if (x->sse2) {
        slide_by_pairs(x, to, low, high, spare);
    } else if (x->narrow) {
        slide_by_halves(x, to, low, high, spare);
    } else if (high) {
        qdot_x86_move_lanes(x, QDOT_X86_ALIGN, to, in_register(x, *high, spare), low, 1);
    } else {
        const int from = in_register(x, low, to);

        x->mask = all_but_last;
        x->zeroing = true;
        qdot_x86_move_lanes(x, QDOT_X86_ALIGN, to, from, qdot_x86_reg(from), 1);
        x->mask = 0;
        x->zeroing = false;
    }
}
