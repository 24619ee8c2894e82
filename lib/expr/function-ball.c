/* function-ball.c -- the elementary functions of one argument in ball (interval) arithmetic, for the table function.def. */
#include "expr/function-ball.h"

#include <math.h>

#include "expr/elliptic-ball.h"
#include "num/samples.h"

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

qdot_status
qdot_lookup_check(double handle, double x)
{
    double lo, hi;

    if (isnan(x) || !qdot_samples_range(handle, &lo, &hi) || !isnan(qdot_samples_lookup(handle, x)))
        return QDOT_OK;
    (void)qdot_fail(QDOT_EDOMAIN, "the data go from %.10g to %.10g: there is no value at %.10g", lo, hi, x);
    return qdot_hint("`hold` or `periodic` behind the statement `data` go on beyond the ends");
}

qdot_status
qdot_lookup_value(arb_t y, const arb_t x, const arb_t handle)
{
    const double h = arf_get_d(arb_midref(handle), ARF_RND_NEAR), at = arf_get_d(arb_midref(x), ARF_RND_NEAR);

    arb_set_d(y, qdot_samples_lookup(h, at));
    return qdot_lookup_check(h, at);
}

void
qdot_lookup_ball(arb_t y, const arb_t x, const arb_t handle)
{
    const double h = arf_get_d(arb_midref(handle), ARF_RND_NEAR), most_pieces = 64;
    double lo, hi;
    arf_t end;
    arb_t one;

    arf_init(end);
    arb_init(one);
    arb_get_lbound_arf(end, x, 64);
    lo = arf_get_d(end, ARF_RND_FLOOR);
    arb_get_ubound_arf(end, x, 64);
    hi = arf_get_d(end, ARF_RND_CEIL);
    arb_set_d(y, qdot_samples_lookup(h, lo));
    if (qdot_samples_finds(h)) {
        arb_set_d(one, qdot_samples_lookup(h, hi));
        arb_union(y, y, one, 64);
    } else if (hi - lo > most_pieces) {
        arb_indeterminate(y);
    } else {
        for (double piece = ceil(lo); piece <= hi; piece++) {
            arb_set_d(one, qdot_samples_lookup(h, piece));
            if (piece == ceil(lo))
                arb_set(y, one);
            else
                arb_union(y, y, one, 64);
        }
    }
    arb_clear(one);
    arf_clear(end);
}
