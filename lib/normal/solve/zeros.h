/* zeros.h -- all real zeros of n equations in n unknowns within a box, in numbers and proved.
 *
 *     F_i(x_1 .. x_n) = 0,   lo_j < x_j < hi_j
 *
 * Boxes are halved until each is excluded or holds one zero. A box is excluded if the bounds of an F_i
 * do not hold 0: those of its value, or of F_i(m) + F_i'(X) (X - m) about the middle m; or if
 * Krawczyk's K(X) (normal/solve/isolate.h) misses it. It holds at most one if |1 - C F'(X)| < 1, and one if
 * isolate.h proves the zero to which Newton's steps lead. Before that, the equations are written as products:
 * each combination of factors is a system of its own, so multiple zeros become simple and
 * denominators do not count.
 *
 * Unbounded unknowns: outside |x| <= R the charts x_j = +-1/s, x_i = y_i/s, |y_i| <= 1, 0 < s <= 1/R are
 * searched like boxes, with the equations multiplied by the power of s that clears them. So polynomials, and whatever
 * else has bounds at s -> 0, have no zero out there that is missed. Unknowns that grow apart (coordinates
 * and multipliers) are in groups with an s each.
 *
 * One unknown: where charts do not exclude zeros far away - exponentials, logarithms, waves beside what grows - the
 * growth of the terms does (zeros-far.c), and the box is searched as far as that.
 *
 * Whether a zero lies at an end, and whether F is defined at a zero of its numerator, is decided exactly, by
 * candidates: ends, rational numbers, parts of pi. One unknown: they, and the roots
 * that formulas give, also serve where no proof of a simple zero is possible; if the k-th derivative does not vanish
 * nearby and the lower ones do at the candidate, it is the only zero. Then more bits are tried.
 *
 * Where neither is possible - a multiple zero, a kink, a whole curve of zeros - a place stays in doubt.
 *
 * Source  Neumaier, Interval Methods for Systems of Equations (1990), 5.1-5.2; Hansen & Walster, Global Optimization
 *         Using Interval Analysis (2004), 11; Krawczyk, Computing 4 (1969) 187.
 * Tests   tests/normal/solve/test_zeros.c
 */
#ifndef QDOT_NORMAL_ZEROS_H
#define QDOT_NORMAL_ZEROS_H

#include "expr/id.h"
#include "num/interval.h"

enum { QDOT_ZEROS_MOST_UNKNOWNS = 6 };

/* The range in which zeros are searched for one unknown. */
typedef struct {
    qdot_expr lo, hi;      /* constants; nil: unbounded */
    bool lo_open, hi_open; /* the bound itself is excluded */
    bool turn;             /* proved: F has period 2 pi in this unknown, which is searched in -pi < x <= pi */
    unsigned group;        /* unbounded unknowns with the same group number become large together */
    qdot_expr held;        /* of one unknown: known ranges of zeros, which are not searched: LISTs of relations
                              that hold there, in a LIST; nil: none */
} qdot_zeros_range;

typedef struct {
    size_t n; /* number of unknowns */
    double *at,
        *radius; /* [count x n] proved zeros and error bounds, ascending by the first unknown, then the next */
    bool *simple; /* [count] the Jacobian is regular; false: multiple zero, or unknown */
    size_t count;
    double *doubt, *reach; /* [doubts x n] centre and half width of undecided boxes */
    size_t doubts;
    bool beyond;    /* zeros at large |x|, where an unknown is unbounded, are not excluded */
    bool complete;  /* proved: there are no other zeros in the search box */
    bool exhausted; /* the budget of operations was used up */
    bool single;    /* a power is real only at isolated points of the box, which are not searched */
    uint64_t evaluations;
} qdot_zeros;

/* The zeros of F [n] that contain only the symbols x [n] and pi. budget: in evaluations of F, those of
 * long F count more; 0: a usual one for n. *out is cleared by the caller. Errors: QDOT_ENOMEM, QDOT_EINTR, QDOT_ETYPE (something else in F, n too
 * large), QDOT_EDOMAIN (an F_i is 0 identically). */
QDOT_MUST_CHECK qdot_status qdot_zeros_find(qdot_pool *pool, size_t n, const qdot_expr *F,
                                            const qdot_expr *x,
                                            const qdot_zeros_range *range,
                                            uint64_t budget, qdot_zeros *out);
void qdot_zeros_clear(qdot_zeros *z);

/* The zero that Newton's steps reach from guess [n]: out->count is 1, or 0 where none is proved there. Never
 * complete. Of one unknown also a multiple one. */
QDOT_MUST_CHECK qdot_status qdot_zeros_near(qdot_pool *pool, size_t n, const qdot_expr *F,
                                            const qdot_expr *x, const double *guess,
                                            qdot_zeros *out);

#endif
