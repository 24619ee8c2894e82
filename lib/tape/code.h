/* code.h -- a tape while it is being written.
 *
 * Every operation gives a new value, except that the same operation on the same values is the
 * same value (value numbering). qdot_code_finish() then keeps what the outputs need, fuses
 * multiplications into sums, reuses the places of values after their last use, and packs the
 * result into a qdot_tape.
 */
#ifndef QDOT_TAPE_CODE_H
#define QDOT_TAPE_CODE_H

#include "base/memory.h"
#include "expr/id.h"
#include "tape/instruction.h"
#include "tape/keymap.h"

/* Integer powers with a larger exponent are computed by pow(). */
#define QDOT_CODE_MOST_POWER 64

typedef uint32_t qdot_value; /* index of a value in qdot_code.values */

typedef struct {
    qdot_op op;
    qdot_value a, b, c;
} qdot_code_value;

/* Start with qdot_code_init. A failure is kept in `status` and makes all later values
 * 0: ask once, at the end. */
typedef struct {
    size_t inputs;
    qdot_vec(qdot_code_value) values; /* the values: first the inputs, then one value for each operation */
    qdot_vec(double) constants;
    qdot_vec(signed char) sides; /* sign of (exact constant - its double), see constant.h */
    qdot_vec(double) lows;       /* exact constant - its double, rounded */
    qdot_vec(qdot_expr) exact;   /* the exact constants, as expressions */
    qdot_keymap seen;          /* maps an operation to the value that it gives */
    qdot_keymap by_expr;       /* maps a constant expression to its value */
    /* [n] a factor f of n if x^n is computed as (x^f)^(n/f); 0: by one multiplication */
    unsigned char chain[QDOT_CODE_MOST_POWER + 1];
    bool approximate;          /* see qdot_tape.approximate */
    qdot_pool *pool;
    qdot_status status;
} qdot_code;

void qdot_code_init(qdot_code *code, qdot_pool *pool, size_t inputs);
void qdot_code_clear(qdot_code *code);

/* One operation; operands that it does not have are 0. Commutative operations (ADD, MUL ...) on
 * a, b and on b, a are one value. */
qdot_value qdot_code_op(qdot_code *code, qdot_op op, qdot_value a, qdot_value b,
                        qdot_value c);
/* The value of a constant expression, evaluated exactly and rounded only once. */
qdot_value qdot_code_constant(qdot_code *code, qdot_expr e);
/* Write code for both sine and cosine of a value. */
void qdot_code_sincos(qdot_code *code, qdot_value a, qdot_value *sine,
                      qdot_value *cosine);
/* a^n, n != 0, by the fewest multiplications a factor method finds; inverse powers by
 * 1/a. */
qdot_value qdot_code_power(qdot_code *code, qdot_value a, int64_t n);

/* Make the finished tape from the code, with these values as outputs [m]. */
QDOT_MUST_CHECK qdot_status qdot_code_finish(qdot_code *code, size_t m,
                                             const qdot_value *outputs,
                                             struct qdot_tape **tape);

#endif
