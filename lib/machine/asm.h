/* asm.h -- machine code for series: numbers and vectors of them in registers or in memory,
 * and some twenty operations on them. Writers above name neither a register nor an instruction
 * of a processor: memory is addressed by what it holds, registers are numbers that they divide
 * among themselves.
 *
 * Operations are of the form
 *
 *     reg <- f(reg, first, b),   b a register or a place in memory,
 *
 * of ONE number or of ALL lanes of a vector. There are three kinds of code (num/kinds.h): AVX-512
 * (vectors of 8 doubles, 32 registers), AVX2 and FMA (4, 16), and the SSE2 that every x86-64 has (2,
 * 15; it rounds a product before it is added). The same calls do the same in each, but for these
 * roundings. Code of any kind can be written on any processor. Writing never fails at once: a buffer
 * that could not grow says so at the end (`status`).
 *
 * Tests   tests/machine/test_x86.c, test_vector.c
 */
#ifndef QDOT_ASM_MACHINE_H
#define QDOT_ASM_MACHINE_H

#include <stdint.h>

#include "base/memory.h"

enum { QDOT_ASM_REGISTERS = 32 }; /* largest number of registers of one kind */

typedef enum {
    QDOT_ASM_LOAD,  /* reg = b */
    QDOT_ASM_STORE, /* b = reg */
    QDOT_ASM_ADD,   /* reg = first + b */
    QDOT_ASM_SUB,
    QDOT_ASM_MUL,
    QDOT_ASM_DIV,
    QDOT_ASM_ROOT,      /* reg = sqrt(b) */
    QDOT_ASM_MADD,      /* reg = first b + reg */
    QDOT_ASM_MSUB, /* reg = first b - reg */
    QDOT_ASM_NMADD,     /* reg = reg - first b */
    QDOT_ASM_NMSUB,     /* reg = -first b - reg */
    QDOT_ASM_MADD_OVER, /* reg = first reg + b; the next three with the signs of MSUB, NMADD, NMSUB */
    QDOT_ASM_MSUB_OVER,
    QDOT_ASM_NMADD_OVER,
    QDOT_ASM_NMSUB_OVER,
    QDOT_ASM_SPREAD, /* reg = the double b in every lane */
    QDOT_ASM_OPERATIONS
} qdot_asm_operation;

typedef enum { QDOT_ASM_ONE, QDOT_ASM_ALL } qdot_asm_width;

/* One of MADD ... NMSUB_OVER: over: reg is multiplied; whether the product, and what is added to
 * it, change their sign. */
static inline qdot_asm_operation
qdot_asm_fused(bool over, bool minus_product, bool minus_other)
{
    return (qdot_asm_operation)(QDOT_ASM_MADD + 4 * over + 2 * minus_product +
                                minus_other);
}

/* What holds an address. The code is a function of the first three; a function that it calls gets
 * its first arguments there. Those after WORK_NOW belong to the caller of the code (_save). */
typedef enum {
    QDOT_ASM_ROWS,      /* address of the coefficients: row by row, in each row by order */
    QDOT_ASM_CONSTANTS, /* address of numbers that are the same at every order */
    QDOT_ASM_WORK,
    QDOT_ASM_ROWS_NOW, /* the address of ROWS moved on to the present order */
    QDOT_ASM_WORK_NOW,
    QDOT_ASM_FACTOR, /* for a sum of products: the first row, and (PARTNER) the row multiplied by it */
    QDOT_ASM_PARTNER,
    QDOT_ASM_TERMS,     /* code address where the terms of a sum begin */
    QDOT_ASM_ROWS_HALF, /* the address of ROWS moved on to half of the present order */
    QDOT_ASM_CONSTANTS_NOW,
    QDOT_ASM_SECOND_PARTNER,
    QDOT_ASM_TERMS_OF_PAIRS, /* code addresses of the terms of two sums at once (PAIRS), and of a sum of squares (SQUARES) */
    QDOT_ASM_TERMS_OF_SQUARES,
    QDOT_ASM_TERMS_LEFT, /* code address of the terms when fewer are left; never holds the address of an operand */
    QDOT_ASM_BASES
} qdot_asm_base;

/* A register or a memory address; with `spread` one double in memory stands for all lanes (AVX-512 only). */
typedef struct {
    bool memory, spread;
    int reg; /* number of the register, or for memory a qdot_asm_base */
    int32_t offset;
} qdot_operand;

typedef struct {
    qdot_vec(unsigned char) bytes;
    qdot_status status;
    size_t kind;  /* kind of processor: 0 SSE2, 1 AVX2 and FMA, 2 AVX-512 */
    bool far; /* encode every offset in four bytes, so that equal operations have equal length */
    int mask;     /* AVX-512: the mask register of the next instructions; 0: none */
    bool zeroing; /* lanes outside the mask become 0; otherwise they stay unchanged */
    unsigned char nowhere[16]; /* bytes are written here after a failure */
    /* For each register: when it was used last, and whether it is reserved. */
    unsigned clock, used[QDOT_ASM_REGISTERS];
    bool taken[QDOT_ASM_REGISTERS];
} qdot_asm;

/* Whether code runs here at all; the best kind that this processor has, within the limit of
 * num/kinds.h. */
bool qdot_asm_is_here(void);
size_t qdot_asm_kind(void);
/* _lanes: the number of doubles in a vector register; the other: the number of registers, counted from 0. */
int qdot_asm_lanes(const qdot_asm *m);
int qdot_asm_registers(const qdot_asm *m);

static inline qdot_operand
qdot_asm_in(int reg)
{
    return (qdot_operand){.reg = reg};
}

/* An operand in memory, at an offset in bytes. */
static inline qdot_operand
qdot_asm_at(qdot_asm_base base, int32_t offset)
{
    return (qdot_operand){.memory = true, .reg = base, .offset = offset};
}

/* --- arithmetic operations ------------------------------------------------------------ */

void qdot_asm_do(qdot_asm *m, qdot_asm_operation op, qdot_asm_width width, int reg,
                 int first, qdot_operand b);
/* Append an instruction that sets all lanes of register reg to 0. */
void qdot_asm_clear(qdot_asm *m, int reg);

/* --- vectors whose lanes are orders, one after another (vector.c) --------------------- *
 *
 * An order enters a vector lane by lane: `newest` is the lane of the order at hand, `older` are
 * those below it, `known` both. AVX-512 has these sets in mask registers, the others in two
 * vectors. */

/* The number of the first register that is free where the code for the vector lanes begins. */
int qdot_asm_first_free(const qdot_asm *m);

typedef enum {
    QDOT_ASM_ALL_LANES,
    QDOT_ASM_OLDER_LANES,
    QDOT_ASM_KNOWN_LANES
} qdot_asm_lane_set;

/* Before anything else here. The newest lane becomes the first; `ones` is a double in memory whose
 * bits are all 1. The newest becomes the next; behind the last there is none. */
void qdot_asm_begin_lanes(qdot_asm *m);
void qdot_asm_first_lane(qdot_asm *m, qdot_operand ones);
void qdot_asm_next_lane(qdot_asm *m);
/* The newest lane of reg = a double in memory. AVX-512 only: the others read such vectors from
 * memory. */
void qdot_asm_insert(qdot_asm *m, int reg, qdot_operand one);
/* Multiply and add: to += factor * b in these lanes; b must be in memory if they are not all.
 * `spare` is overwritten. */
void qdot_asm_add_product(qdot_asm *m, int to, int factor, qdot_operand b,
                          qdot_asm_lane_set lanes, int spare);
/* to = the lanes of low from the second on, then the first of high, NULL: then 0. `to` may be the
 * register of low, `spare` is overwritten. */
void qdot_asm_slide(qdot_asm *m, int to, qdot_operand low, const qdot_operand *high,
                    int spare);

/* --- addresses, loops, calls ---------------------------------------------------------- */

/* _set: set base register `to` to from + offset; _set_code: to the address of a position in the code. */
void qdot_asm_set(qdot_asm *m, qdot_asm_base to, qdot_asm_base from, int32_t offset);
void qdot_asm_set_code(qdot_asm *m, qdot_asm_base to, size_t place);
/* What stands between the two is run `times`, at least once; returns its place. Not one in
 * another. _repeat_as: as often as the 32 bits at that place say, when it is run. */
size_t qdot_asm_repeat(qdot_asm *m, int times);
size_t qdot_asm_repeat_as(qdot_asm *m, qdot_operand times);
/* Directly after _repeat_as: append code that returns if the number of repetitions is 0; then the loop begins. */
void qdot_asm_return_if_none(qdot_asm *m);
void qdot_asm_again(qdot_asm *m, size_t from);
/* Append a call of the code at this position, or at an address; _leave: append its return. */
void qdot_asm_enter(qdot_asm *m, size_t place);
void qdot_asm_enter_at(qdot_asm *m, qdot_asm_base at);
void qdot_asm_leave(qdot_asm *m);
/* Append the return to the caller of the generated code. */
void qdot_asm_return(qdot_asm *m);
/* A C function is called; what the code was run with is there again after it, registers are not.
 * Between _frame and _unframe, the latter before the return. */
void qdot_asm_frame(qdot_asm *m);
void qdot_asm_call(qdot_asm *m, void (*function)(void));
void qdot_asm_unframe(qdot_asm *m);
/* Append code that saves the caller's address registers, or restores them before the return. */
void qdot_asm_save(qdot_asm *m);
void qdot_asm_restore(qdot_asm *m);

/* --- choosing a register -------------------------------------------------------------- */

static inline void
qdot_asm_use(qdot_asm *m, int reg)
{
    m->used[reg] = ++m->clock;
}

/* The register among from ... end - 1, not reserved, whose last use was earliest; marks it as used. */
int qdot_asm_fresh(qdot_asm *m, int from, int end);

#endif
