/* function-ball.h -- the elementary functions of one argument in balls, a column of function.def.
 *
 * Tests   tests/expr/test_function.c
 */
#ifndef QDOT_EXPR_FUNCTION_BALL_H
#define QDOT_EXPR_FUNCTION_BALL_H

#include "base/status.h"
#include "expr/function.h"
#include "num/arb.h"

/* y encloses f(x) for every x of the ball, rounded to `bits`; y may be x. The sign of a ball that
 * contains 0 is [-1, 1]. */
typedef void qdot_fun_ball(arb_t y, const arb_t x, slong bits);

/* The ball (interval) arithmetic version of this elementary function; NULL if it has several arguments. */
qdot_fun_ball *qdot_fun_ball_of(qdot_fun_id id);

/* y = lookup(x, handle) of a table of data (num/samples.h) at the middle of the ball x; a knot belongs to the piece
 * that begins there. QDOT_EDOMAIN: x is beyond the ends of the table. */
QDOT_MUST_CHECK qdot_status qdot_lookup_value(arb_t y, const arb_t x, const arb_t handle);
/* y encloses lookup(x, handle) of a table of data (num/samples.h) for every x of the ball; not finite where that is not known. */
void qdot_lookup_ball(arb_t y, const arb_t x, const arb_t handle);

/* QDOT_EDOMAIN if the table of a handle has no value at the place x (num/samples.h). */
QDOT_MUST_CHECK qdot_status qdot_lookup_check(double handle, double x);

#endif
