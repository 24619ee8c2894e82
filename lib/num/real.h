/* real.h -- numbers of any precision (MPFR): many in one block, sums of products, linear
 * equations.
 *
 * MPFR rounds each operation; in a long sum its functions spend most of the time on rounding.
 * qdot_real_dot adds whole products in fixed point and rounds once. Time a term, compared with
 * mpfr_mul and mpfr_add (with arb_approx_dot of Arb 2.23): 16 : 37 (8) ns
 * at 128 bits, 19 : 48 (26) at 192, 24 : 50 (29) at 256, 60 : 89 (62) at 512.
 *
 * Tests  tests/num/test_real.c
 */
#ifndef QDOT_NUM_REAL_H
#define QDOT_NUM_REAL_H

#include <stdbool.h>
#include <stddef.h>

#include <mpfr.h>

#include "base/status.h"

/* An array of numbers of one precision in one block of memory: functions of MPFR that change a
 * precision must not be used on them. Start from {0}. */
typedef struct {
    size_t n;
    mpfr_prec_t bits; /* precision in bits, a multiple of the bits of a machine word (limb) */
    mpfr_t *at;       /* [n] the numbers, 0 at first */
    mp_limb_t *limbs;
} qdot_reals;

/* Make n numbers of `bits` bits, rounded up to whole machine words. Errors: QDOT_ENOMEM; QDOT_EINVAL (bits). */
QDOT_MUST_CHECK qdot_status qdot_reals_init(qdot_reals *v, size_t n, mpfr_prec_t bits);
void qdot_reals_clear(qdot_reals *v);

/* The memory in bytes of n numbers with `bits` bits. */
double qdot_reals_size(size_t n, mpfr_prec_t bits);

/* The logarithm log2 |x|; -INFINITY for 0, NaN if x is not finite. */
double qdot_real_log2(mpfr_srcptr x);

/* The number of machine words (limbs) that qdot_real_dot needs as work space for a precision of `bits`. */
size_t qdot_real_dot_work(mpfr_prec_t bits);

/* sum = sum_{j=0..n-1} a[j] b[-j], to within 2^(3 - bits) of n times its largest term. All
 * of one qdot_reals precision; `sum` may not be one of them. If a term is not finite, neither is
 * the sum: NaN.
 *   work  [qdot_real_dot_work] */
void qdot_real_dot(mpfr_ptr sum, const mpfr_t *a, const mpfr_t *b, size_t n,
                   mp_limb_t *work);

/* A = P L U by partial pivoting, rows compared by their largest entries; A [n x n
 * row-major], its factors in place.
 *   order   [n] out
 *   scale   [n] scratch
 *   failed  out: the column without a pivot
 *   w       [2] scratch
 * Returns QDOT_OK, or QDOT_ESINGULAR: a pivot is 0 or below 2^-(bits - 16) of its row's
 * largest entry, or not finite. */
QDOT_MUST_CHECK qdot_status qdot_real_lu(size_t n, mpfr_t *a, size_t *order,
                                         double *scale, size_t *failed, mpfr_t *w);

/* Solve A x = b with the factors of qdot_real_lu; b [n] is replaced by x; y [n], w [1]: work space. */
void qdot_real_solve(size_t n, const mpfr_t *a, const size_t *order, mpfr_t *b, mpfr_t *y,
                     mpfr_t *w);

#endif
