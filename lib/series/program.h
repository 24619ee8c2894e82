/* program.h -- a series program: what an expansion into a power series does, order by order.
 *
 * A program knows rows, each the coefficients of one series, and steps, each of which computes
 * one order of one row or more from rows that come before it. It holds no coefficient: those
 * belong to whoever carries it out (an executor: taylor.h, lanes.h, two.h, precise.h), in the
 * arithmetic that it has. The recurrences are rows of recurrence.def.
 *
 * Tests  tests/series/test_program.c; test_taylor-wide.c, test_two.c, test_precise.c (every
 *        recurrence by one executor against another)
 */
#ifndef QDOT_SERIES_PROGRAM_H
#define QDOT_SERIES_PROGRAM_H

#include "base/memory.h"
#include "tape/code.h"
#include "tape/tape.h"

/* Up to this order of q'' an integral divides by k + 1 and k + 2, exactly but for the last
 * bit; beyond it multiplies by inverses. The rounding of an inverse is the same in every
 * step, and made the energy of an oscillator drift as t. Series up to less than so many
 * orders err by more than that. */
enum { QDOT_TAYLOR_EXACT = 6, QDOT_TAYLOR_EXACT_FROM = 26 };

/* The recurrences for Taylor coefficients, by their names in recurrence.def. */
typedef enum {
    QDOT_T_END,
    QDOT_T_VALUE, /* only order 0: an operation that switches, such as abs or a comparison */
#define RECURRENCE(ID, cost, body) QDOT_T_##ID,
#include "series/recurrence.def"
    QDOT_T_LINK, /* integrals: to' = unit x, second' = unit to (second no row: only one) */
    QDOT_T_RATE, /* time derivative: to = x'/unit, so that order k of `to` is computed from order k + 1 of x (motion.h) */
    QDOT_T_COUNT
} qdot_recurrence;

/* Ways to compute order 0 of a row that are not operations of operation.def. */
enum {
    QDOT_ZERO_SINHCOSH = QDOT_OP_COUNT, /* order 0 of `to` and `second` is sinh x, cosh x */
    QDOT_ZERO_POWER,                    /* order 0 of `to` is y^z; x is the row of its logarithm */
    QDOT_ZERO_RATE,
    QDOT_ZERO_COUNT
};

typedef uint32_t qdot_program_row; /* index of a row, the Taylor coefficients of one intermediate result */

#define QDOT_NO_ROW UINT32_MAX

/* Where the coefficient of order 0 of a row comes from. */
typedef enum {
    QDOT_ROW_INPUT,    /* the caller gives it: input number `at` */
    QDOT_ROW_CONSTANT, /* constant number `at` of the program */
    QDOT_ROW_WHOLE,    /* the integer `at` */
    QDOT_ROW_COMPUTED, /* a step of the program computes it */
    QDOT_ROW_UNKNOWN   /* it is an unknown, solved for from equations (motion.h) */
} qdot_program_source;

typedef struct {
    qdot_program_source source;
    bool still; /* the row is constant in time: only its coefficient of order 0 is not 0 */
    int at;
    int lead; /* at stage k of a motion the row is computed at order k + lead (motion.h) */
} qdot_program_row_info;

/* A constant, as a tape stores it (expr/constant.h). */
typedef struct {
    double value, low; /* the nearest double; the exact constant minus that double, rounded */
    signed char side;
    qdot_expr exact;
} qdot_program_constant;

/* The bits of qdot_program_step.newest. */
enum { QDOT_X_NEWEST = 1, QDOT_Y_NEWEST = 2, QDOT_Z_NEWEST = 4 };

/* A step computes rows from rows. Rows that it does not write are QDOT_NO_ROW; operands it does not read are x. */
typedef struct {
    uint16_t op, zero; /* its recurrence; how order 0 is computed: an operation of a tape or one of the ways above */
    int sign;          /* +1 or -1: the sign in f(x)' = sign x'/u, for op QDOT_T_RATIO (logarithms, inverse functions) */
    bool still;        /* the result is constant in time: only order 0 is computed */
    /* bits for those operands x, y, z whose newest coefficient depends on unknowns (motion.h) */
    unsigned char newest;
    bool kept;            /* later orders read the result of the step */
    signed char lead;  /* by how many orders the rows that the step writes are ahead (motion.h) */
    qdot_program_row to, second, third, d, x, y, z;
} qdot_program_step;

typedef struct {
    size_t inputs, moving; /* number of inputs; how many of these vary in time, which come first */
    qdot_vec(qdot_program_constant) constants;
    qdot_vec(qdot_program_row_info) rows; /* inputs first, then constants, then results of steps */
    qdot_vec(qdot_program_step) steps;    /* steps whose rows are constant come first; the last step is QDOT_T_END */
    size_t length, still; /* number of steps; number of the constant steps among them */
    qdot_vec(qdot_program_row) outputs;
    double convolutions; /* number of products of two series to be summed at each order; a square counts half */
    int lead;            /* the largest lead of a step: by how many orders its rows are ahead (motion.h) */
} qdot_program;

/* The program of a tape, which is not kept, whose inputs from `moving` on are numbers. With
 * `values_only` it has order 0 alone, and operations that switch are allowed. Errors:
 * QDOT_ENOTBUILT (an operation that switches), QDOT_ENOMEM; `program` is then empty. */
QDOT_MUST_CHECK qdot_status qdot_program_init(const qdot_tape *tape, size_t moving,
                                                     bool values_only,
                                                     qdot_program *program);
void qdot_program_clear(qdot_program *program);

/* --- one program of several tapes ----------------------------------------------------- */

typedef struct qdot_program_builder qdot_program_builder;

/* An empty program with `inputs`, the first `moving` of which have more than order 0. What is
 * added to it fails at _end. Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_program_begin(size_t inputs, size_t moving, bool values_only,
                                               qdot_program *program,
                                               qdot_program_builder **builder);
/* Steps of the tape behind those that are there, its inputs being rows `in`; the rows of its outputs
 * go to `out`. */
void qdot_program_append(qdot_program_builder *b, const qdot_tape *tape,
                         const qdot_program_row *in, qdot_program_row *out);
/* A number; a row that nobody computes; op (NEG, ADD, SUB, MUL, MADD, MSUB, NMADD) of rows; the rate
 * of a row. */
qdot_program_row qdot_program_number(qdot_program_builder *b, qdot_program_constant number);
qdot_program_row qdot_program_unknown(qdot_program_builder *b);
qdot_program_row qdot_program_operation(qdot_program_builder *b, qdot_op op,
                                        qdot_program_row x, qdot_program_row y,
                                        qdot_program_row z);
qdot_program_row qdot_program_rate(qdot_program_builder *b, qdot_program_row x);
/* The builder is freed. Errors: QDOT_ENOTBUILT (an operation that switches), QDOT_ENOMEM; the
 * program is then empty. */
QDOT_MUST_CHECK qdot_status qdot_program_end(qdot_program_builder *b);

/* The number of programs that this process has made; used by tests. */
size_t qdot_program_made(void);

/* NULL if all operations of a tape have a Taylor series; else the name of one that has none. */
const char *qdot_program_hindrance(const qdot_tape *tape);

/* Whether the recurrence sums products of coefficients of lower orders. */
static inline bool
qdot_recurrence_looks_back(int op)
{
    return op >= QDOT_T_MUL && op < QDOT_T_LINK;
}

/* The number of convolution sums that one order of a recurrence costs; a square counts half. */
double qdot_recurrence_cost(int op);

/* A factor: the recurrence gives the exponential of its argument times this; 0: it is no exponential. */
static inline double
qdot_recurrence_exponential(int op)
{
    switch (op) {
    case QDOT_T_EXP:
    case QDOT_T_SINHCOSH: return 1;
    case QDOT_T_TANH: return 2;
    default: return 0;
    }
}

/* Which operand a recurrence divides by, or takes a root, a power or a logarithm of: 'x', 'y', 'z';
 * 0: none. */
static inline char
qdot_recurrence_divisor(int op)
{
    switch (op) {
    case QDOT_T_SQRT:
    case QDOT_T_POW: return 'x';
    case QDOT_T_DIV:
    case QDOT_T_RATIO: return 'y';
    case QDOT_T_ATAN2: return 'z';
    default: return 0;
    }
}

#endif
