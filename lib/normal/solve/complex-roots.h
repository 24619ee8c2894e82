/* complex-roots.h -- the complex roots of a polynomial with rational coefficients, exact in their multiplicities.
 *
 * The polynomial is written as a product of powers of polynomials without multiple roots; the roots of each are isolated
 * in balls, to more digits than a double has.
 *
 * Source  FLINT, arb_fmpz_poly_complex_roots.
 * Tests   tests/normal/solve/test_complex_roots.c, test_eigenvalues.c
 */
#ifndef QDOT_NORMAL_COMPLEX_ROOTS_H
#define QDOT_NORMAL_COMPLEX_ROOTS_H

#include <flint/fmpz_poly.h>
#include <stddef.h>

#include "expr/id.h"

/* The roots re + i im [n] of c[0] + c[1] x + ... + c[n] x^n, rational numbers, c[n] not 0; each as often as its multiplicity,
 * the two of a pair one after the other, that with im > 0 first. im is 0 exactly where the root is real, and re where it is
 * less than 2^-60 of the root. QDOT_EINVAL: a coefficient is no rational number. */
QDOT_MUST_CHECK qdot_status qdot_complex_roots(qdot_pool *pool, size_t n, const qdot_expr *c, double *re, double *im);

/* The same for a polynomial of FLINT, within a guarded computation (expr/polynomial/flint.h); re as it is found. */
void qdot_complex_roots_of(const fmpz_poly_t f, double *re, double *im);

#endif
