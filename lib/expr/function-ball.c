/* function-ball.c -- the elementary functions of one argument in ball (interval) arithmetic, for the table function.def. */
#include "expr/function-ball.h"

#include "expr/elliptic-ball.h"

/* Set y to sign(x), as the table needs it; the function of the Arb library takes no precision argument. */
static void
ball_sign(arb_t y, const arb_t x, slong bits)
{
    (void)bits;
    arb_sgn(y, x);
}

static void
ball_abs(arb_t y, const arb_t x, slong bits)
{
    (void)bits;
    arb_abs(y, x);
}

static void
ball_elliptic_K(arb_t y, const arb_t x, slong bits)
{
    qdot_elliptic_ball(y, QDOT_ELLIPTIC_K, 1, (const arb_struct *[]){x}, bits);
}

static qdot_fun_ball *const table[QDOT_FUNCTION_KINDS] = {
#define X(ID, name, least, most, traits, lo, hi, inverse, operation, value, ball, ...) [QDOT_##ID] = ball,
#include "expr/function.def"
#undef X
    [QDOT_HOLD] = arb_set_round,
};

qdot_fun_ball *
qdot_fun_ball_of(qdot_fun_id id)
{
    return table[id];
}
