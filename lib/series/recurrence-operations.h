/* recurrence-operations.h -- the rows of recurrence.def as data, for those who write code.
 *
 * A row is a list of operations on numbers: U1, U2 and coefficients of order k of the rows of a
 * step, by the names that the table has. One of two sums of a PAIR is as any other but for
 * `paired`: the next one has the same factor a.
 *
 * Tests  tests/series/test_lanes-code.c, test_lanes-motion.c, test_taylor-code.c: what is written from it against the
 *        kernels
 */
#ifndef QDOT_SERIES_RECURRENCE_OPERATIONS_H
#define QDOT_SERIES_RECURRENCE_OPERATIONS_H

#include "series/program.h"

typedef enum {
    QDOT_OF_to,
    QDOT_OF_second,
    QDOT_OF_third,
    QDOT_OF_d,
    QDOT_OF_x,
    QDOT_OF_y,
    QDOT_OF_z,
    QDOT_OF_ROWS, /* number of names of rows; names of temporaries follow */
    QDOT_OF_U1 = QDOT_OF_ROWS,
    QDOT_OF_U2,
    QDOT_OF_COUNT
} qdot_recurrence_name;

typedef enum {
    QDOT_DO_END,
    QDOT_DO_SUM,     /* r = sum_{j=from..k-below} a_j b_{k-j}, a convolution sum */
    QDOT_DO_SQUARED, /* the same sum as for QDOT_DO_SUM with b = a: that of a square */
    QDOT_DO_ADD,
    QDOT_DO_SUB,
    QDOT_DO_NEG,
    QDOT_DO_TIMES,
    QDOT_DO_PLUS_TIMES,
    QDOT_DO_MINUS_TIMES,
    QDOT_DO_OVER,
    QDOT_DO_OVER_TWICE,
    QDOT_DO_ORDERS,
    QDOT_DO_PER_ORDER,
    QDOT_DO_SIGNED
} qdot_recurrence_verb;

/* One operation of a recurrence, with operands by name; operands that it does not use are 0. */
typedef struct {
    unsigned char verb, r, p, q, a, b, from, below;
    bool paired;
} qdot_recurrence_operation;

/* The operations of a recurrence, ended by QDOT_DO_END; none for LINK, RATE and recurrences of order 0 only. */
const qdot_recurrence_operation *qdot_recurrence_operations(int op);

/* The first operation of a recurrence with the given verb; NULL if there is none. */
const qdot_recurrence_operation *qdot_recurrence_find(int op, qdot_recurrence_verb verb);

/* The row of a step that has the given name in recurrence.def. */
static inline qdot_program_row
qdot_program_step_row(const qdot_program_step *s, unsigned name)
{
    const qdot_program_row rows[] = {s->to, s->second, s->third, s->d, s->x, s->y, s->z};

    return rows[name];
}

#endif
