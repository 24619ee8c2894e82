/* function-ball.c -- the elementary functions of one argument in ball arithmetic, a column of function.def. */
#include "expr/function-ball.h"

/* Set y to sign(x), for the table; Arb's function takes no precision. */
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
