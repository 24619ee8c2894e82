/* variation-parts.h -- what variation.c and variation-scene.c share. */
#ifndef QDOT_SIM_VARIATION_PARTS_H
#define QDOT_SIM_VARIATION_PARTS_H

#include "sim/study/variation.h"

/* q, q', q'' of coordinate i of the scene given, and of its slope in direction k: order 0, 1, 2. */
qdot_expr qdot_variation_jet(const qdot_variation *v, size_t i, uint32_t order);
qdot_expr qdot_variation_slope_jet(const qdot_variation *v, size_t k, size_t i,
                                   uint32_t order);
/* e with the numbers of the request; with q'' as it is along the motion. Nil: the pool failed. */
qdot_expr qdot_variation_with_numbers(const qdot_variation *v, qdot_expr e);
qdot_expr qdot_variation_with_motion(const qdot_variation *v, qdot_expr e);

/* Write the scene and its start, y'' = b [k x n]. */
QDOT_MUST_CHECK qdot_status qdot_variation_write(qdot_variation *v, const qdot_expr *b);

#endif
