/* code.h -- the straight line while it is being written, and as it is evaluated.
 *
 * While written, every value is new and the same operation on the same values is the same
 * value (value numbering). qdot_code_finish() then keeps what the outputs need, fuses
 * multiplications into sums, lets values that are dead give their places to others, and
 * packs it all into a qdot_tape.
 *
 * Places of a finished tape: the inputs, the constants, then what is computed.
 */
#ifndef QDOT_TAPE_CODE_H
#define QDOT_TAPE_CODE_H

#include "base/memory.h"
#include "tape/keymap.h"
#include "tape/tape.h"

typedef enum {
#define X(ID, name, operands, operations, calls, statement, slopes) QDOT_OP_##ID,
#include "tape/operation.def"
#undef X
    QDOT_OP_COUNT,
    /* Only while written: */
    QDOT_OP_INPUT = QDOT_OP_COUNT, /* a: which */
    QDOT_OP_CONSTANT,              /* a: which */
    QDOT_OP_SECOND                 /* a: the SINCOS whose second result this is */
} qdot_op;

typedef struct {
    const char *name;
    int operands, operations, calls;
} qdot_operation;

extern const qdot_operation qdot_operations[QDOT_OP_COUNT];

/* Powers above are left to pow(). */
#define QDOT_CODE_MOST_POWER 64

typedef uint32_t qdot_value; /* a value of the code: an index */

typedef struct {
    qdot_op op;
    qdot_value a, b, c;
} qdot_code_value;

/* Start with qdot_code_init. A failure is kept in `status` and makes all later values
 * 0: ask once, at the end. */
typedef struct {
    size_t inputs;
    qdot_vec(qdot_code_value) values; /* first the inputs */
    qdot_vec(double) constants;
    qdot_vec(signed char) sides; /* where the exact constants lie, see constant.h */
    qdot_vec(double) lows;       /* what they are beyond the rounded ones */
    qdot_vec(qdot_expr) exact;   /* the expressions that they are */
    qdot_keymap seen;          /* operation -> value */
    qdot_keymap by_expr;       /* constant expression -> value */
    unsigned char chain[QDOT_CODE_MOST_POWER + 1]; /* see power_chain() */
    qdot_pool *pool;
    qdot_status status;
} qdot_code;

void qdot_code_init(qdot_code *code, qdot_pool *pool, size_t inputs);
void qdot_code_clear(qdot_code *code);

/* One operation; operands it does not have are 0. ADD, MUL and their like in either
 * order of a and b are one. */
qdot_value qdot_code_op(qdot_code *code, qdot_op op, qdot_value a, qdot_value b,
                        qdot_value c);
/* A constant expression, evaluated exactly and rounded once. */
qdot_value qdot_code_constant(qdot_code *code, qdot_expr e);
/* Sine and cosine of a value. */
void qdot_code_sincos(qdot_code *code, qdot_value a, qdot_value *sine,
                      qdot_value *cosine);
/* a^n, n != 0, by the fewest multiplications a factor method finds; inverse powers by
 * 1/a. */
qdot_value qdot_code_power(qdot_code *code, qdot_value a, long n);

/* An instruction of the finished tape: places. For SINCOS y is the second result. */
typedef struct {
    uint32_t op, to, x, y, z;
} qdot_instruction;

struct qdot_tape {
    size_t inputs, constants, outputs, length, places, operations, calls;
    double *constant;       /* [constants] */
    signed char *side;      /* [constants] where the exact value lies beside it */
    double *low;            /* [constants] how far; 0 once shaken */
    qdot_expr *exact;       /* [constants] what is evaluated to any precision */
    uint32_t *output;       /* [outputs] places */
    qdot_instruction *code; /* [length] */
};

/* The tape of code with these outputs [m]. */
QDOT_MUST_CHECK qdot_status qdot_code_finish(qdot_code *code, size_t m,
                                             const qdot_value *outputs, qdot_tape **tape);

#endif
