/* span.h -- a range of the variable of an integral: signs of expressions over it, and the places inside where they may have
 * kinks, jumps or poles.
 *
 * Tests  tests/normal/integral/test_definite.c, tests/script/integrals/
 */
#ifndef QDOT_INTEGRAL_SPAN_H
#define QDOT_INTEGRAL_SPAN_H

#include "normal/field/facts.h"

enum { QDOT_SPAN_PLACES = 24 };

typedef struct {
    qdot_pool *pool;
    const qdot_facts *facts;
    qdot_expr x;      /* the variable; its domain is lo < x < hi where that is known to be a range */
    qdot_expr lo, hi; /* QDOT_INFINITY or its negative: no end */
    bool ordered;     /* lo < hi is known */
    qdot_expr place[QDOT_SPAN_PLACES]; /* [n] inside lo < x < hi, ascending */
    size_t n;
    qdot_status status;
} qdot_span;

/* Whether 0 < e is proved. */
bool qdot_span_is_positive(qdot_span *r, qdot_expr e);

/* The sign of g, which has no zeros inside the range: everywhere, at an end where it is continuous, or at one point
 * inside; 0: not known. */
int qdot_span_sign(qdot_span *r, qdot_expr g);

/* Add the places inside the range where e may have a kink, a jump (if `jumps`) or a pole; false: they are not all known. */
bool qdot_span_add_dangers(qdot_span *r, qdot_expr e, bool jumps);

/* The sign of the gaps that must be positive for e to be real, without zeros inside: 1 all are, -1 one is negative. */
int qdot_span_is_real(qdot_span *r, qdot_expr e);

/* e with abs, sign, max, min, floor, mod and if replaced by what they are in the range, inside which they have neither kinks
 * nor steps; one whose values are not known there stays. */
qdot_expr qdot_span_without_kinks(qdot_span *r, qdot_expr e);

#endif
