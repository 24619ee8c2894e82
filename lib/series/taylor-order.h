/* taylor-order.h -- a function for each recurrence and order, of the kinds of processors.
 *
 * The functions of each kind are compiled from a file of their own, side by side: there are 1,100.
 */
#ifndef QDOT_SERIES_TAYLOR_ORDER_H
#define QDOT_SERIES_TAYLOR_ORDER_H

#include "num/kinds.h"
#include "series/taylor-steps.h"

#ifdef QDOT_X86_KINDS
/* The functions for processors with FMA, by order k (from 1) and recurrence. */
extern qdot_taylor_function *const qdot_taylor_order_fma[QDOT_SERIES_MOST + 1][QDOT_T_COUNT];
#endif

#endif
