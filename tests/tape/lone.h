/* lone.h -- tapes of one operation, at random places, for tests of what is known of each. */
#ifndef QDOT_TESTS_TAPE_LONE_H
#define QDOT_TESTS_TAPE_LONE_H

#include <stdlib.h>

#include "expr/exact.h"
#include "num/samples.h"
#include "tape/code.h"

/* Between 0 and 1. */
static inline double
unit(void)
{
    return (double)rand() / RAND_MAX;
}

/* The handle of the pieces of a table, which lookup(a, 0, handle) finds. */
static inline int64_t
lone_table(void)
{
    static const double knots[] = {-2.385, -0.377, 1.137, 2.61}, values[] = {1, -2, 0.5, 3};
    int number;

    assert_int_equal(qdot_samples_add(&(qdot_samples_given){.axes = 1,
                                                            .n = {4, 0},
                                                            .knots = {knots, NULL},
                                                            .values = values,
                                                            .degree = 1,
                                                            .beyond = QDOT_SAMPLES_HOLD},
                                      &number),
                     QDOT_OK);
    return qdot_samples_piece(number, 0);
}

/* A tape of one operation of three inputs, of two the first twice if they are to be the `same`; its
 * second result too. */
static inline qdot_tape *
lone(qdot_pool *pool, qdot_op op, bool same)
{
    qdot_code code;
    qdot_value v[2];
    qdot_tape *tape;
    int operands = qdot_operations[op].operands;

    qdot_code_init(&code, pool, 3);
    if (op == QDOT_OP_SINCOS) {
        qdot_code_sincos(&code, 0, &v[0], &v[1]);
    } else if (op == QDOT_OP_LOOKUP) {
        v[0] = v[1] = qdot_code_op(&code, op, 0, qdot_code_constant(&code, QDOT_ZERO),
                                   qdot_code_constant(&code, qdot_expr_int(pool, lone_table())));
    } else {
        v[0] = qdot_code_op(&code, op, 0, operands > 1 && !same ? 1 : 0, operands > 2 ? 2 : 0);
        v[1] = v[0];
    }
    assert_int_equal(qdot_code_finish(&code, 2, v, &tape), QDOT_OK);
    qdot_code_clear(&code);
    return tape;
}

#endif
