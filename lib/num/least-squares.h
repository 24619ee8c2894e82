/* least-squares.h -- sums of squares made least by Levenberg and Marquardt's method, and what they say.
 *
 *     chi2(u) = sum f_i(u)^2,     J = df/du,     C = (J^T J)^-1
 *
 * The steps are those of GSL (gsl_multifit_nlinear: trust regions, columns scaled as by More). They end
 * where the part of f within the columns of J is small against f (Bates and Watts' relative offset), or
 * where no step of u makes a difference that doubles hold.
 *
 * With the columns of J made of length 1, J = U S V^T; where the least singular value is below `least` of the
 * largest, the sum does not depend on u along its column of V.
 *
 * Source  Bates and Watts, Technometrics 23 (1981) 179; More, LNM 630 (1978) 105.
 * Tests   tests/num/test_least-squares.c
 */
#ifndef QDOT_NUM_LEAST_SQUARES_H
#define QDOT_NUM_LEAST_SQUARES_H

#include <stdbool.h>
#include <stddef.h>

#include "base/status.h"

typedef struct {
    size_t n, p; /* number of residuals; number of unknowns; n >= p */
    /* f [n] and J [n x p] at u [p]. QDOT_EDOMAIN, QDOT_EFAILED, QDOT_ESINGULAR, QDOT_EINVAL, QDOT_ELIMIT: there is
     * nothing at u, which ends the search only if it is the first. */
    qdot_status (*model)(const double *u, double *f, double *J, void *user);
    void *user;
    double least;      /* smallest relative singular value that counts as non-zero; 0: 1e-10 */
    size_t most_steps; /* largest number of steps; 0: 200 */

    double *u;              /* [p] the unknowns. Input: the start; output: the minimum */
    size_t steps, models;   /* steps of the search; number of model evaluations */
    bool converged;
    double chi2;            /* sum of squares |f|^2 at u */
    double *f, *J;          /* residuals f [n] and J = df/du [n x p] at u */
    double *covariance;     /* [p x p] covariance C of u; NaN where it is not determined */
    double *left;           /* [p] the Gauss-Newton step C J^T f that remains at u */
    double *undetermined; /* [p] direction of scaled u that f does not determine, length 1, largest entry > 0; 0: none */
} qdot_least_squares;

/* Find u; the arrays behind `chi2` are allocated here. Clear it in any case. Errors: those of the model; QDOT_EINVAL:
 * n < p; QDOT_EFAILED: chi2 is not finite where it begins. */
QDOT_MUST_CHECK qdot_status qdot_least_squares_find(qdot_least_squares *x);
void qdot_least_squares_clear(qdot_least_squares *x);

#endif
