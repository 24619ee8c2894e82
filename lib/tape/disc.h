/* disc.h -- a tape over discs of the complex plane about real centres.
 *
 *     |x_j - c_j| <= r_j for every input   =>   |f_i(x) - C_i| <= R_i for every output
 *
 * for complex x as well, so that a function that is given as a tape is bounded throughout
 * an interval and around it. By Cauchy's estimate that bounds what a polynomial through its
 * values at a few points does not know (sim/course/polynomial-bounds.h). C_i is f_i(c). A radius is NaN
 * where an operation has a singularity in its disc, or switches there, and infinite where the bound
 * is too large for a double.
 *
 * Each operation has a bound of its own (disc.def): |f(c + w) - f(c)| for |w| <= r, exact
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

/* Doubles of work space wanted. */
size_t qdot_disc_work(const qdot_tape *tape);

/* C, R [outputs] of c, r [inputs]; work [qdot_disc_work]. Never fails. */
void qdot_disc_eval(const qdot_tape *tape, const double *c, const double *r, double *C,
                    double *R, double *work);

/* Which inputs the tape reads at all, into used [inputs]; QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_disc_reads(const qdot_tape *tape, bool *used);

/* Whether it has operations that fall off like an exponential, so that what is large somewhere
 * may be nothing at a distance, all derivatives included. */
bool qdot_disc_may_hide(const qdot_tape *tape);

/* How far at most the arguments of these go over the discs c, r [inputs], that of a power by its
 * logarithm: what is large by e^reach more somewhere than in the middle. Work as above. */
double qdot_disc_reach(const qdot_tape *tape, const double *c, const double *r, double *work);

#endif
