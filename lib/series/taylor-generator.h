/* taylor-generator.h -- what the files that write a Taylor program as machine code share
 * (taylor-code.h). Internal to series/.
 *
 * The code is run with three addresses: of the rows of coefficients, of the steps, of work
 * space that begins with tables by order and holds one number here and there (slots) and the
 * vectors that have no register. Orders beyond the first three are a few loops; in them the
 * first and the last are also there moved on to the order at hand.
 */
#ifndef QDOT_SERIES_TAYLOR_GENERATOR_H
#define QDOT_SERIES_TAYLOR_GENERATOR_H

#include <stddef.h>

#include "series/taylor-steps.h"
#include "machine/asm.h"

enum {
    /* Of any kind of processor: the widest vectors; vectors of a row, or of the sums that one
     * product has still to come; registers. */
    QDOT_CODE_LANES = 8,
    QDOT_CODE_BLOCKS = (QDOT_SERIES_MOST / 2 + 1) / 2,
    /* The work space, in doubles: tables by order k of 1/k (at 0: -1), k, the two factors of
     * a link, what these are beyond their doubles, 1/((k + 1)(k + 2)); a lane whose bits are
     * all 1; counts of loops; a number for a moment; then slots. */
    QDOT_CODE_TABLE = QDOT_SERIES_MOST + 8,
    QDOT_CODE_INVERSES = 0,
    QDOT_CODE_ORDERS = QDOT_CODE_TABLE,
    QDOT_CODE_ONCE = 2 * QDOT_CODE_TABLE,
    QDOT_CODE_TWICE = 3 * QDOT_CODE_TABLE,
    QDOT_CODE_ONCE_LOW = 4 * QDOT_CODE_TABLE,
    QDOT_CODE_TWICE_LOW = 5 * QDOT_CODE_TABLE,
    QDOT_CODE_PAIRS = 6 * QDOT_CODE_TABLE,
    QDOT_CODE_ONES = 7 * QDOT_CODE_TABLE,
    /* counts of loop repetitions, 32 bits in each double */
    QDOT_CODE_COUNTS = QDOT_CODE_ONES + QDOT_CODE_LANES,
    QDOT_CODE_PHASES = (2 * QDOT_CODE_BLOCKS + 7) / 8 * 8,
    QDOT_CODE_MOMENT = QDOT_CODE_COUNTS + QDOT_CODE_PHASES, /* place of one temporary number */
    QDOT_CODE_SLOTS = QDOT_CODE_MOMENT + 8,
    /* What is written for several orders is written as of this one, and those beside it; a
     * multiple of 4. */
    QDOT_CODE_ANY = 1000,
    /* Numbers of work space for the factors of each folded sum or product (taylor-code-fold.c). */
    QDOT_CODE_FOLDED_SLOTS = 4,
    /* places reserved per step for products of two factors computed once for all orders (qdot_code_composed) */
    QDOT_CODE_FACTORS = 8,
    /* the largest order k for which the rounding errors of 1/(k + 1) and 1/((k + 1)(k + 2)) are stored */
    QDOT_CODE_EXACT = 3 + QDOT_CODE_LANES
};

/* Lane i is coefficient i + lag of a row; of the sums that order m has been added to, order
 * m + lag + i. */
typedef struct {
    int reg[QDOT_CODE_BLOCKS]; /* the registers that hold the vectors of the row or sum; -1: the vector is in memory */
    size_t at;                 /* index of the first number of the vectors in the work space */
} qdot_code_vector;

/* A sum of products x_i y_j of coefficients with i, j >= lag, prepared for later orders. */
typedef struct {
    uint32_t x, y; /* the rows whose coefficients are the factors x and y */
    bool further;  /* the sum continues the one before it, and both share the vectors `v` of that */
    qdot_code_vector v;
} qdot_code_sum;

/* A factor that is the product of two others. */
typedef struct {
    qdot_operand a, b;
} qdot_code_composition;

typedef struct {
    qdot_asm m;
    const qdot_taylor *t;
    int lanes;              /* number of doubles in a vector register */
    /* registers of single numbers: first_scalar ... behind_scalars - 1; registers below these are temporary */
    int first_scalar, behind_scalars;
    bool as_they_stand; /* rows are read as vectors from where they are stored, without copies (taylor-code-vectors.c) */
    bool reread; /* instead of shifting a sum by an order it is read from an address one number further on */
    int n;                  /* number of orders of the expansion */
    int blocks;             /* largest number of vectors in a sum */
    int k;                  /* the order for which code is being written */
    int lag; /* 1 or 2: products with a factor of order below `lag` are added one by one */
    bool exact;             /* at this order the factors of integrals (links) are sums of two doubles */
    bool *moving;           /* [rows] whether the row varies in time, so that it has orders above 0 */
    bool *folded; /* [rows] whether the row is computed above order 0 only as terms of the sum of its single reader */
    uint32_t *maker; /* [rows] index of the step whose first result is the row; QDOT_CODE_NONE: none */
    uint32_t *row_vector;   /* [rows] index of the row's vector in `rows`; QDOT_CODE_NONE: none */
    uint32_t *step_sums; /* [length x 3] indices in `sums` of the convolutions of each step; QDOT_CODE_NONE: none */
    uint32_t *unknown_sums; /* [rows] index in `sums` of the sum for an unknown, by its row; QDOT_CODE_NONE: none */
    uint32_t *block_slots;  /* [blocks] index in the work space at which the matrices of each block begin */
    int *ready; /* [rows x 4] the time in cycles at which a coefficient becomes known, by order mod 4 */
    qdot_vec(qdot_code_vector) rows;
    qdot_vec(uint32_t) row_of; /* the row to which each vector in `rows` belongs */
    qdot_vec(qdot_code_sum) sums;
    size_t n_slots;
    qdot_vec(qdot_code_composition) compositions; /* products of two factors, kept in slots of the work space */
    size_t fold_slots;                            /* the first slot that holds such a product */

    /* which registers hold which coefficients: */
    unsigned char *where; /* [rows x 4] the register that may hold a coefficient of the row, by order mod 4 */
    uint32_t held[QDOT_ASM_REGISTERS]; /* the row whose coefficient the register holds; QDOT_CODE_NONE: none */
    int held_order[QDOT_ASM_REGISTERS];
    /* for each register, the row of which one coefficient fills all lanes of the register */
    uint32_t spread[QDOT_ASM_REGISTERS];
    int spreads, next_spread;
} qdot_generator;

#define QDOT_CODE_NONE UINT32_MAX

/* Whether there are fewer and shorter vector registers than with AVX-512. */
static inline bool
qdot_code_is_narrow(int lanes)
{
    return lanes < QDOT_CODE_LANES;
}

/* Write an instruction: do_one on single numbers, do_all on whole vectors. */
static inline void
do_one(qdot_generator *g, qdot_asm_operation op, int reg, int first, qdot_operand b)
{
    qdot_asm_do(&g->m, op, QDOT_ASM_ONE, reg, first, b);
}

static inline void
do_all(qdot_generator *g, qdot_asm_operation op, int reg, int first, qdot_operand b)
{
    qdot_asm_do(&g->m, op, QDOT_ASM_ALL, reg, first, b);
}

/* A range of orders that share the code of one loop, as all of them use the same number of vectors. */
typedef struct {
    int blocks;   /* number of vectors in each sum */
    int inserted; /* index of the vector into which the new order of a row is written; -1: none */
    int orders;
} qdot_code_phase;

/* Of the vectors of products (taylor-code-vectors.c): whether rows are read as they stand; before
 * anything; before a phase; order m and all that is made of it and those from `lag` up to it; behind that. */
bool qdot_code_rows_as_they_stand(const qdot_generator *g);
void qdot_code_begin_vectors(qdot_generator *g);
void qdot_code_begin_phase(qdot_generator *g, const qdot_code_phase *p);
void qdot_code_add_order(qdot_generator *g, const qdot_code_phase *p, int m);
void qdot_code_next_lane(qdot_generator *g, const qdot_code_phase *p);

/* Write the code of order g->k of a step; the next function: the row of a step by its name in recurrence.def. */
void qdot_code_order(qdot_generator *g, const qdot_taylor_step *s);
static inline const double *
qdot_code_named(const qdot_taylor_step *s, unsigned name)
{
    const double *const rows[] = {s->to, s->second, s->third, s->d, s->x, s->y, s->z};

    return rows[name];
}

/* Forget which registers hold coefficients, as at a jump. */
void qdot_code_forget(qdot_generator *g);

/* Write the code for order 0 of all steps and integrals, as a function of its own. */
void qdot_code_zero(qdot_generator *g);

/* Sums and products that are read once are added up where they are read: without rows, and
 * without waits of their own. Sums of products being known. Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_code_fold(qdot_generator *g);
/* The place of the product of two factors that are the same at all orders; it is computed once. */
qdot_operand qdot_code_composed(qdot_generator *g, qdot_operand a, qdot_operand b);

/* Write the code that solves for a block of unknowns at order g->k. */
void qdot_code_solve(qdot_generator *g, size_t block);

/* The estimated time, in cycles, at which coefficient k of a row becomes known. */
static inline int *
qdot_code_ready(qdot_generator *g, uint32_t row, int k)
{
    return &g->ready[4 * row + (uint32_t)(k & 3)];
}

static inline uint32_t
qdot_code_row(const qdot_generator *g, const double *row)
{
    return qdot_taylor_row(g->t, row);
}

static inline qdot_operand
qdot_code_coefficient(const qdot_generator *g, uint32_t row, int k)
{
    const int32_t at = (int32_t)(8 * (row * g->t->stride));

    if (k > QDOT_CODE_ANY / 2)
        return qdot_asm_at(QDOT_ASM_ROWS_NOW, at + 8 * (k - QDOT_CODE_ANY));
    return qdot_asm_at(QDOT_ASM_ROWS, at + 8 * k);
}

static inline qdot_operand
qdot_code_c(const qdot_generator *g, const qdot_taylor_step *s)
{
    return qdot_asm_at(
        QDOT_ASM_CONSTANTS,
        (int32_t)((size_t)(s - g->t->steps) * sizeof *s + offsetof(qdot_taylor_step, c)));
}

static inline qdot_operand
qdot_code_work(size_t i)
{
    return qdot_asm_at(QDOT_ASM_WORK, (int32_t)(8 * i));
}

/* The operand for entry k (order k) of a table of numbers. */
static inline qdot_operand
qdot_code_entry(size_t table, int k)
{
    if (k > QDOT_CODE_ANY / 2)
        return qdot_asm_at(QDOT_ASM_WORK_NOW,
                           (int32_t)(8 * table) + 8 * (k - QDOT_CODE_ANY));
    return qdot_code_work(table + (size_t)k);
}

#endif
