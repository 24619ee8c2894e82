/* taylor-products.h -- sums of products of K with unknowns, all of an order at once.
 *
 * Of explicit equations (motion.h) stage k needs sum_{j=1..k} K_j u_{k-j} for every entry of K that
 * moves. Coefficients are kept by order, so that like members of many sums are a vector. An entry
 * that is another one negated has its sum. Internal to series/.
 *
 * Tests  tests/series/test_motion.c
 */
#ifndef QDOT_SERIES_TAYLOR_PRODUCTS_H
#define QDOT_SERIES_TAYLOR_PRODUCTS_H

#include "series/taylor-steps.h"

typedef struct qdot_taylor_products qdot_taylor_products;

/* For the couplings of all blocks of t, whose `negated` must be set, for orders below `most`.
 * Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_taylor_products_new(const qdot_taylor *t, int most,
                                                     qdot_taylor_products **products);
/* The number of convolution sums of products. */
size_t qdot_taylor_products_count(const qdot_taylor_products *p);
void qdot_taylor_products_free(qdot_taylor_products *p);

/* Off x, of all unknowns, what lower orders of these give to order k; then order k of them. Orders
 * one after another from 0. */
void qdot_taylor_products_take_off(qdot_taylor_products *p, const qdot_series_kernels *kernels,
                                   int k, double *x);
void qdot_taylor_products_note(qdot_taylor_products *p, int k);

#endif
