/* lanes-writer.h -- the writer of lanes-code.h from inside: rows, registers. Internal to
 * series/.
 *
 * The code is run with three addresses: of the program's coefficients, of scalars, of work
 * space: numbers, what the steps keep for a second time, what a sum has for later orders of its
 * block. In loops the first two are also there moved on to the first order of the block at hand,
 * the first to half of it; and where the terms of sums, of pairs of them and of squares begin.
 */
#ifndef QDOT_SERIES_LANES_WRITER_H
#define QDOT_SERIES_LANES_WRITER_H

#include "num/series.h"
#include "series/lanes-code.h"
#include "machine/asm.h"

enum {
    QDOT_WRITER_RESTS = 2,
    QDOT_WRITER_PAIRS = 32, /* largest number of products in one sum */
    QDOT_WRITER_MOST_TABLES = 16
};

/* Bits of row numbers that denote constants and tables of factors instead of rows of the program. */
enum {
    QDOT_WRITER_NUMBERS = 1 << 24,
    QDOT_WRITER_INVERSES = 2 << 24,
    QDOT_WRITER_SCALARS = 3 << 24,
    QDOT_WRITER_TABLES = 4 << 24, /* tables of factors: entry k is used at order k */
    QDOT_WRITER_TABLE = QDOT_SERIES_MOST + 8,
    /* What is written for all blocks of a loop is written as of this order or the next, odd
     * if theirs are, and those beside it; half of it is half of theirs. */
    QDOT_WRITER_ANY = 1000
};

/* What a register holds while machine code is written. */
typedef struct {
    bool holds;
    bool ahead; /* the register holds a newer value than memory; stored when the register is needed */
    qdot_lanes_at at;
} qdot_writer_register;

typedef struct {
    bool moving; /* whether the row depends on t */
    bool kept;   /* whether the coefficients of all orders of the row are kept */
    bool absent; /* the newest coefficient of the row is not computed, as it is unknown or 0 */
    bool wanted; /* whether an equation for the unknowns depends on the row */
    bool equation;
    size_t step; /* index of the step that computes the row; SIZE_MAX: none */
    int readers; /* number of steps of the program that read the row */
    int linear;  /* number of steps that only add the row, or take its time derivative */
    bool rated;  /* whether some steps read the time derivative of the row */
} qdot_writer_row;

typedef struct {
    bool folded; /* the step is not carried out by itself, but as a part of the steps that read its result */
    bool idle;   /* no equation for the unknowns depends on the step */
    bool lacks;  /* the result is incomplete only because the newest coefficient of its argument is unknown */
    int pairs;   /* number of products in the step's sum, including those of folded steps */
    bool rests[QDOT_WRITER_RESTS]; /* whether each sum of the step has a remainder to be kept at the present order */
} qdot_writer_step;

/* A row of the program, or its first or second time derivative, with a sign. */
typedef struct {
    bool minus;
    int rates;
    qdot_program_row row;
} qdot_writer_addend;

struct qdot_lanes_writer {
    qdot_asm m;
    qdot_lanes_rows at;
    const qdot_program *t;
    const qdot_motion *motion; /* the motion whose steps are written; NULL: only the steps of a program */
    int32_t bytes;             /* size of a group (one number for each lane) in bytes */
    size_t numbers;
    bool counting; /* whether this is the first pass, which only counts and writes no code */
    qdot_writer_row *rows;   /* [rows] properties of each row */
    qdot_writer_step *steps; /* [length] properties of each step */
    bool without;            /* whether newest coefficients that nothing needs may be left out */
    int k;                   /* the present order; rows are computed at order k + their lead */
    unsigned rates;          /* bits that tell which of the factors qdot_lanes_rate the written code reads */
    qdot_vec(double) scalars;
    qdot_vec(qdot_lanes_by_order *) tables;
    int registers, chains, moment, first_free; /* counts of registers and partial sums, the scratch and first free register */
    /* Orders whose sums are made together; how far that at hand is in such a block; the
     * loop's first, as written. */
    int block, phase, any;
    qdot_writer_register reg[QDOT_ASM_REGISTERS];
    /* Where n terms begin, of one product, of two with a factor in common, of a square;
     * whether those of the former keep factors in registers. */
    size_t dot[QDOT_SERIES_MOST + 2], pair[QDOT_SERIES_MOST + 2], half[QDOT_SERIES_MOST + 2];
    bool windows;
    /* Of sums in the order in which an order has them: the one that comes, how many there
     * are; of how many orders of the block there is a part. */
    size_t sum, sums;
    qdot_vec(int) ahead;
    qdot_status status;
};

static inline qdot_lanes_at
qdot_writer_inverse(size_t step)
{
    return (qdot_lanes_at){QDOT_WRITER_INVERSES + (qdot_lanes_row)step, 0};
}

/* Write an instruction, except in the first pass, which only finds which rows are needed. */
void qdot_writer_emit(qdot_lanes_writer *w, qdot_asm_operation name, int reg, int first,
                      qdot_operand rm);
qdot_operand qdot_writer_place(qdot_lanes_writer *w, qdot_lanes_at a);
/* Reserve a free register for a sum; its contents are undefined. */
int qdot_writer_take(qdot_lanes_writer *w);
/* Write code that stores those registers whose values later orders read. */
void qdot_writer_settle(qdot_lanes_writer *w);
/* Forget what registers below `end` hold, after storing values that memory does not have. */
void qdot_writer_leave(qdot_lanes_writer *w, int end);
/* Write code that stores a register at `to`; no other register then counts as holding the old value. */
void qdot_writer_put(qdot_lanes_writer *w, int reg, qdot_lanes_at to);
void qdot_writer_clear(qdot_lanes_writer *w, int reg);
/* The number of groups of numbers that the code needs as work space. */
size_t qdot_writer_groups(const qdot_lanes_writer *w);
/* The sequence of terms of one product or two; at [stride] where they begin. With windows every
 * coefficient of the other factors is loaded once, else once for each order. */
void qdot_writer_terms(qdot_lanes_writer *w, bool window, int products, size_t *at);

/* Of the steps of a motion those that their readers carry out (lanes-fold.c); what a row is, then;
 * the product that another one is added to, NULL: none. */
void qdot_writer_fold(qdot_lanes_writer *w, const qdot_motion *motion);
qdot_writer_addend qdot_writer_expand(const qdot_lanes_writer *w, qdot_program_row row);
const qdot_program_step *qdot_writer_within(const qdot_lanes_writer *w,
                                            const qdot_program_step *product);

/* Begin to write the code of order k. */
static inline void
qdot_writer_begin(qdot_lanes_writer *w, int k)
{
    qdot_writer_settle(w);
    w->k = k;
    w->sum = 0;
}

/* The length in bytes of the code of one term of a sequence of terms, for all orders of a block. */
static inline size_t
qdot_writer_term(const qdot_lanes_writer *w, const size_t *at)
{
    return at[w->block] - at[w->block + 1];
}

/* _pair: sums[0] = sum_{j=1..k-1} x_j y_{k-j}, sums[1] with z in place of y. _square: the sum with x in place of
 * y. */
void qdot_writer_pair(qdot_lanes_writer *w, qdot_lanes_row x, qdot_lanes_row y,
                      qdot_lanes_row z, int k, qdot_lanes_sum *sums);
qdot_lanes_sum qdot_writer_square(qdot_lanes_writer *w, qdot_lanes_row x, int k);

/* Write code that replaces `sum` by `sum op other`; the register of `other` becomes free. */
void qdot_writer_join(qdot_lanes_writer *w, qdot_asm_operation op, qdot_lanes_sum *sum,
                      qdot_lanes_sum other);

/* For the second time that a step is made: whether there is a sum, and if `stored` it; the sum
 * stays as it is. Its register is given back by _drop. */
void qdot_writer_keep(qdot_lanes_writer *w, size_t step, int i, qdot_lanes_sum sum,
                      bool stored);
qdot_lanes_sum qdot_writer_kept(qdot_lanes_writer *w, size_t step, int i);

static inline bool
qdot_writer_is_kept(const qdot_lanes_writer *w, size_t step, int i)
{
    return w->steps[step].rests[i];
}

static inline void
qdot_writer_drop(qdot_lanes_writer *w, qdot_lanes_sum sum)
{
    if (sum != QDOT_LANES_NOTHING)
        w->m.taken[sum] = false;
}

#endif
