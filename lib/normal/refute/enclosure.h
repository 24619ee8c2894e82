/* enclosure.h -- expressions over boxes: bounds of their values and of their slopes, in doubles.
 *
 *     x in X, e defined at x      =>  e(x) in E
 *     e Lipschitz on X            =>  e(y) - e(x) in D . (y - x) for x, y in X
 *
 * D is the hull of the derivatives wherever they exist, from one pass: so a kink (abs, max) has a slope,
 * that of either side. What is known of an expression over the box:
 *
 *     NOWHERE   undefined at every point
 *     PARTLY    perhaps undefined or discontinuous at some: a pole, an end of its domain, a jump
 *     WHOLE     defined and continuous everywhere; D holds
 *
 * Much faster than balls (ball.h), and unlike these bounded on one side where a function is: 1/x over 0..1
 * is in 1..infinity.
 *
 * Source  Moore, Kearfott & Cloud, Introduction to Interval Analysis (2009), chapters 5 and 6.
 * Tests   tests/normal/solve/test_zeros.c
 */
#ifndef QDOT_NORMAL_ENCLOSURE_H
#define QDOT_NORMAL_ENCLOSURE_H

#include "expr/id.h"
#include "num/interval.h"

enum { QDOT_ENCLOSURE_MOST = 6 }; /* largest number of unknowns */

typedef enum {
    QDOT_ENCLOSURE_NOWHERE,
    QDOT_ENCLOSURE_PARTLY,
    QDOT_ENCLOSURE_WHOLE
} qdot_enclosure_state;

typedef struct {
    qdot_interval y; /* bounds of the value; for a relation 1 true, 0 false, [0, 1] unknown */
    qdot_interval slope[QDOT_ENCLOSURE_MOST];
    qdot_enclosure_state state;
} qdot_enclosure_value;

typedef struct qdot_enclosure qdot_enclosure; /* a prepared list of expressions */

/* For e [m] that contain only the symbols x [n], n <= QDOT_ENCLOSURE_MOST, and pi. Freed by the caller.
 * Errors: QDOT_ENOMEM, QDOT_EINTR, QDOT_ETYPE: something else in them. */
QDOT_MUST_CHECK qdot_status qdot_enclosure_new(qdot_pool *pool, size_t m,
                                               const qdot_expr *e, size_t n,
                                               const qdot_expr *x, qdot_enclosure **out);
void qdot_enclosure_free(qdot_enclosure *s);

/* Evaluate all expressions over the box X [n] of intervals, with their derivatives if these are wanted. */
void qdot_enclosure_eval(qdot_enclosure *s, const qdot_interval *X, bool slopes);

/* The number of nodes (operations and operands) that one evaluation visits. */
size_t qdot_enclosure_size(const qdot_enclosure *s);

size_t qdot_enclosure_count(const qdot_enclosure *s); /* number m of expressions given to qdot_enclosure_new */
/* The value of the i-th expression, valid until the next evaluation. */
const qdot_enclosure_value *qdot_enclosure_get(const qdot_enclosure *s, size_t i);

#endif
