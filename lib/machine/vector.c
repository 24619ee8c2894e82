/* vector.c -- instructions on some lanes of a vector register, chosen by AVX-512 masks or, without these, by vectors. */
#include "machine/x86.h"

enum {
    /* numbers of registers that select lanes: AVX-512 masks, or AVX2 registers */
    older = 4,
    known = 5,
    newest = 1, /* used with AVX-512 masks only */
    all_but_last = 3
};

int
qdot_asm_first_free(const qdot_asm *m)
{
    return m->kind > 1 ? 4 : known + 1;
}

void
qdot_asm_begin_lanes(qdot_asm *m)
{
    if (m->kind > 1)
        qdot_x86_set_mask(m, all_but_last, 0x7f);
}

void
qdot_asm_first_lane(qdot_asm *m, qdot_operand ones)
{
    if (m->kind < 2) {
        qdot_asm_clear(m, older);
        qdot_x86_emit(m, QDOT_ASM_LOAD, false, known, 0, ones);
        return;
    }
    qdot_x86_set_mask(m, newest, 1);
    qdot_x86_set_mask(m, older, 0);
    qdot_x86_set_mask(m, known, 1);
}

void
qdot_asm_next_lane(qdot_asm *m)
{
    /* Permutation codes: the first gives lanes 0, 0, 1, 2; the second, lanes 0, 0 of each half. */
    enum { first_twice = 0x90, first_in_both = 0 };

    if (m->kind < 2)
        qdot_x86_emit(m, QDOT_ASM_LOAD, true, older, 0, qdot_asm_in(known));
    if (m->kind < 1)
        qdot_x86_move_lanes(m, QDOT_X86_PAIRS, known, known, qdot_asm_in(known),
                            first_in_both);
    else if (m->kind < 2)
        qdot_x86_move_lanes(m, QDOT_X86_PERMUTE, known, 0, qdot_asm_in(known),
                            first_twice);
    if (m->kind < 2)
        return;
    qdot_x86_join_masks(m, older, newest);
    qdot_x86_raise_mask(m, newest);
    qdot_x86_join_masks(m, known, newest);
}

void
qdot_asm_insert(qdot_asm *m, int reg, qdot_operand one)
{
    m->mask = newest;
    qdot_x86_emit(m, QDOT_ASM_SPREAD, true, reg, 0, one);
    m->mask = 0;
}

void
qdot_asm_add_product(qdot_asm *m, int to, int factor, qdot_operand b,
                     qdot_asm_lane_set lanes, int spare)
{
    const int set = lanes == QDOT_ASM_OLDER_LANES ? older : known;

    if (lanes != QDOT_ASM_ALL_LANES && m->kind < 2) {
        qdot_x86_emit(m, QDOT_X86_AND, true, spare, set, b);
        b = qdot_asm_in(spare);
    } else if (lanes != QDOT_ASM_ALL_LANES) {
        m->mask = set;
    }
    qdot_x86_emit(m, QDOT_ASM_MADD, true, to, factor, b);
    m->mask = 0;
}

/* Load the operand b into the register `reg` if it is in memory; returns the register that holds it. */
static int
load_into_register(qdot_asm *m, qdot_operand b, int reg)
{
    if (!b.memory)
        return b.reg;
    qdot_x86_emit(m, QDOT_ASM_LOAD, true, reg, 0, b);
    return reg;
}

/* From low = (a, b, c, d) and high = (e, ...) make spare = (c, d, e, ...) and to = (b, c, d, e). */
static void
shift_lanes_by_halves(qdot_asm *m, int to, qdot_operand low, const qdot_operand *high,
                      int spare)
{
    enum { upper_then_lower = 0x21, upper_then_0 = 0x81, second_then_first = 5 };
    const int from = load_into_register(m, low, to);

    qdot_x86_move_lanes(m, QDOT_X86_HALVES, spare, from, high ? *high : qdot_asm_in(from),
                        high ? upper_then_lower : upper_then_0);
    qdot_x86_move_lanes(m, QDOT_X86_PAIRS, to, from, qdot_asm_in(spare),
                        second_then_first);
}

/* From low = (a, b) and high = (c, d) make to = (b, c). */
static void
shift_lanes_by_pairs(qdot_asm *m, int to, qdot_operand low, const qdot_operand *high, int spare)
{
    enum { second_then_first = 1 };

    if (!high)
        qdot_asm_clear(m, spare);
    qdot_x86_move_lanes(m, QDOT_X86_PAIRS, to, load_into_register(m, low, to),
                        high ? *high : qdot_asm_in(spare), second_then_first);
}

void
qdot_asm_slide(qdot_asm *m, int to, qdot_operand low, const qdot_operand *high, int spare)
{
    if (m->kind < 1) {
        shift_lanes_by_pairs(m, to, low, high, spare);
    } else if (m->kind < 2) {
        shift_lanes_by_halves(m, to, low, high, spare);
    } else if (high) {
        qdot_x86_move_lanes(m, QDOT_X86_ALIGN, to, load_into_register(m, *high, spare), low, 1);
    } else {
        const int from = load_into_register(m, low, to);

        m->mask = all_but_last;
        m->zeroing = true;
        qdot_x86_move_lanes(m, QDOT_X86_ALIGN, to, from, qdot_asm_in(from), 1);
        m->mask = 0;
        m->zeroing = false;
    }
}
