/* disc.h -- bounds of a tape over discs of the complex plane about real centres.
 *
 *     |x_j - c_j| <= r_j for every input   =>   |f_i(x) - C_i| <= R_i for every output
 *
 * for complex x as well, so that a function given as a tape is bounded throughout an interval and
 * around it. By Cauchy's estimate that bounds the error of a polynomial through its values at a
 * few points (sim/bind/polynomial-bounds.h). C_i is f_i(c). A radius is NaN if an operation has
 * a singularity in its disc, or switches there, and infinite if the bound overflows.
 *
 * Each operation has its own bound (a column of operation.def): |f(c + w) - f(c)| for |w| <= r, exact
 * for sums, products, roots, exponentials, logarithms and those inverse functions whose
 * Taylor coefficients have one sign. Rounding is added to radii that are not 0; sums of it
 * are not rounded outward.
 *
 * Source  Gargantini & Henrici, Numer. Math. 18 (1971) 305: circular arithmetic.
 * Tests   tests/tape/test_disc.c
 */
#ifndef QDOT_TAPE_DISC_H
#define QDOT_TAPE_DISC_H

#include <stdbool.h>

#include "tape/tape.h"

/* The number of doubles that evaluation over discs needs as work space. */
size_t qdot_disc_work(const qdot_tape *tape);

/* Evaluate output discs (centres C, radii R) for input discs (c, r); work [qdot_disc_work]. Never fails. */
void qdot_disc_eval(const qdot_tape *tape, const double *c, const double *r, double *C,
                    double *R, double *work);

/* Find which inputs the tape reads: used [inputs]; QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_disc_reads(const qdot_tape *tape, bool *used);

/* Operations that may be negligible at one point though large elsewhere, so that a value there does not show them. */
typedef enum {
    QDOT_HIDES_EXPONENTIALS, /* exponentials that are negligible at the start with all their derivatives */
    QDOT_HIDES_QUOTIENTS /* also quotients that are negligible at the start, as 1/x^2 at large x */
} qdot_disc_hiding;

bool qdot_disc_may_hide(const qdot_tape *tape, qdot_disc_hiding by);

/* How many of these operations reach farther than `most` over the discs c, r [inputs]; *last: the
 * instruction of the last one. The reach is how far the argument may go from the centre (of a power
 * and a quotient: its logarithm; of tanh as far as it is not 1 in doubles): values may be e^reach
 * times those in the centre. Work as above. */
size_t qdot_disc_hiders(const qdot_tape *tape, qdot_disc_hiding by, const double *c,
                        const double *r, double most, size_t *last, double *work);

/* Whether over the discs all outputs are A + B f: f the result of the instruction k, which grows or
 * falls with its argument throughout, A and B without f, and B 0 or far from it. On a way on which the
 * argument only grows the values at its ends then bound all that f does. *most: the largest |B|. Work
 * as above. */
bool qdot_disc_is_plain(const qdot_tape *tape, size_t k, const double *c, const double *r,
                        double *most, double *work);

/* Evaluate the argument of instruction k at the inputs x, and *result; work [qdot_disc_work]. */
double qdot_disc_argument(const qdot_tape *tape, size_t k, const double *x, double *result,
                          double *work);

#endif
