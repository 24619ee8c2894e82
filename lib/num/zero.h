/* zero.h -- unknowns u [n] for which functions F [m] vanish, by Newton's method with given slopes J.
 *
 *     step = -(J^T J + mu)^-1 J^T F      by singular values of J in units of u and F
 *
 * Where unknowns are more than independent equations, this is the least step (a solution near the guess, one of a
 * family); where equations are more, that of least squares, and F must vanish. mu = 0.01 |F|^2 |J|^2 keeps
 * steps short while J is nearly singular and F is not yet small, and leaves the convergence quadratic. From a guess in
 * units of its own, mu is larger while a singular value of J is small beside the largest seen, and the step longer than
 * 0.1 units at first, and than 4 times the longest whole step before later on: near a family, or an extremum of F, J
 * nearly lets u go any far. A step
 * is halved until it makes |F| smaller, or the step that would follow with the same J.
 * A search in vain is begun again from places around the guess; so is one that finds a zero which is not wanted.
 *
 * One unknown of one equation between bounds with a change of sign between them: Newton and bisection.
 *
 * The error of an unknown is r times the last step w for mu = 0 and what the errors of F make of it, |J^+| |dF|. At a
 * zero of multiplicity r, as far as F can be told from 0, the steps lead 1/r of the way: 1/r = du.dw/du.du of the last two.
 *
 * Directions of u in which J says nothing are those of a family if from places beside the zero steps lead to other zeros
 * beside it; else the zero is an isolated one of higher order.
 *
 * Source  Fan, Yuan, Computing 74 (2005) 23 (mu); Deuflhard, Newton Methods (2004), 3.3 (the step that would follow); Press et al., Numerical Recipes, 9.4 (rtsafe).
 * Tests   tests/num/test_zero.c
 */
#ifndef QDOT_NUM_ZERO_H
#define QDOT_NUM_ZERO_H

#include <stdbool.h>
#include <stddef.h>

#include "base/status.h"

typedef struct {
    size_t n, m; /* number of unknowns, and number of functions F */
    /* F [m] at u [n] with its errors [m] (NaN: unknown), and, unless slope is NULL, J [m x n]. F[0] = NaN: it
     * cannot be had there. */
    qdot_status (*at)(const double *u, double *f, double *error, double *slope,
                      void *user);
    void *user;
    const double *low, *high; /* [n] bounds of u; NULL or infinite: unbounded */
    const double *unit; /* [n] scale of each unknown, given with a guess near a zero; NULL: |u| at the guess, 1 if u is 0 */
    /* Set by the callback `at`; may be NULL: errors of the Jacobian [m x n]; size of the terms whose differences give F [m]. */
    const double *slope_error, *size;
    bool once;                /* make only one search: do not start again from other points if it fails */
    bool verify;              /* test whether the unknowns that the Jacobian leaves undetermined form a family of zeros */
    /* Whether a zero, with u and rank, is acceptable; otherwise the search goes on from other
     * points. NULL: always. */
    qdot_status (*wanted)(const double *u, size_t rank, bool *is, void *user);
} qdot_zero_problem;

typedef enum {
    QDOT_ZERO_FOUND,
    QDOT_ZERO_NONE, /* |F| has a least value that is not 0, or no sign changes between the bounds */
    QDOT_ZERO_FLAT,    /* no unknown changes F at the guess */
    QDOT_ZERO_NOWHERE, /* F cannot be evaluated at the guess */
    QDOT_ZERO_JUMP,    /* F changes sign by a jump, without a zero */
    QDOT_ZERO_VAGUE, /* F is 0 within its errors, which leave some unknowns uncertain by a tenth or more */
    QDOT_ZERO_SLOW     /* no convergence after many steps */
} qdot_zero_answer;

typedef struct {
    qdot_zero_answer answer;
    double *u, *error; /* [n] input: the guess; output: the best point and its error; owned by the caller */
    double *f, *f_error; /* [m] the function values F at u, and their errors */
    size_t rank;         /* how many directions of u F fixes: that of J at the end, and more at a zero of higher
                            order */
    bool vague_rank; /* `verify` could not decide whether the undetermined directions belong to a family of zeros */
    size_t steps;        /* number of evaluations of J */
} qdot_zero_result;

/* Search for a zero of F. Errors: those of the callback `at`, QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_zero_find(const qdot_zero_problem *p,
                                           qdot_zero_result *r);

#endif
