/* real-zeros.h -- the real zeros of a polynomial over Z, and fractions between them.
 *
 * Tests  tests/normal/inequality/test_less.c
 */
#ifndef QDOT_NORMAL_REAL_ZEROS_H
#define QDOT_NORMAL_REAL_ZEROS_H

#include <flint/fmpq.h>
#include <flint/fmpz_mpoly.h>
#include <flint/fmpz_poly.h>

#include "num/arb.h"

/* r = c p over x[0 .. k) in the variables symbol[0 .. k), a polynomial in symbol[k], c > 0; p holds no
 * others. 0 if there is no memory. */
void qdot_polynomial_over(fmpz_poly_t r, const fmpz_mpoly_struct *p, slong k,
                          const slong *symbol, const fmpq *x, const fmpz_mpoly_ctx_t ctx);

/* The real zeros of p, which has no multiple ones, ascending, in balls that are apart from each other and not wider than
 * 2^-bits of the zero. The number of them; -1: too much. *zeros: a vector of as many balls as p has degrees, NULL if none
 * was made; the caller's (_arb_vec_clear). */
slong qdot_real_zeros(const fmpz_poly_t p, slong bits, arb_ptr *zeros);

/* Set x to a fraction with few digits above all numbers of the ball a (NULL: no bound) and below all of b. */
void qdot_between_zeros(fmpq_t x, arb_srcptr a, arb_srcptr b);

#endif
