/* special-values.h -- values of parameters at which divisors of a solution are 0: the solutions there are to be looked
 * for anew.
 *
 *     a b - 1:      a = 1/b
 *     [a, b - c]:   a = 0 and b = c, where both are 0
 *
 * Tests  tests/normal/solve/test_solve-special.c
 */
#ifndef QDOT_NORMAL_SPECIAL_VALUES_H
#define QDOT_NORMAL_SPECIAL_VALUES_H

#include "base/memory.h"
#include "normal/field/facts.h"

/* The most parameters with simultaneous special values; the most operations of a divisor whose
 * zeros are sought. */
enum { QDOT_SPECIAL_TOGETHER = 3, QDOT_SPECIAL_LONGEST = 60 };

typedef struct {
    qdot_vec(qdot_expr) at;   /* LISTs of equations parameter = value at which divisors are 0 */
    qdot_vec(qdot_expr) open; /* equations in parameters at which divisors are 0, and which were not solved */
} qdot_special_values;

void qdot_special_values_clear(qdot_special_values *v);

/* Add to out the places where one of `special` [n] is 0; of one that is a LIST, those where all its members are 0 together.
 * They hold parameters alone, and have the values of `where` (a LIST of equations, nil: none) put in; each place repeats
 * these equations. */
QDOT_MUST_CHECK qdot_status qdot_special_values_add(qdot_pool *pool, size_t n,
                                                    const qdot_expr *special, qdot_expr where,
                                                    const qdot_facts *facts,
                                                    qdot_special_values *out);

/* The left and right sides of the equations of a LIST (nil: none), in from and to
 * [QDOT_SPECIAL_TOGETHER]; returns their number. */
size_t qdot_special_sides(const qdot_pool *pool, qdot_expr where, qdot_expr *from, qdot_expr *to);

#endif
