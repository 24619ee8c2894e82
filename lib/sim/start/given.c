/* given.c -- gives the start of a run as balls: from exact expressions, or as two doubles after a
 * projection. */
#include "sim/start/given.h"

#include <math.h>

#include "normal/refute/ball.h"

void
qdot_given_clear(qdot_given *g)
{
    if (g->at)
        _arb_vec_clear(g->at, (slong)g->n);
    *g = (qdot_given){0};
}

/* Set x to a ball (number with error bound) about y + low, whose radius is the double-double rounding error. */
static void
set_ball(arb_t x, double y, double low)
{
    arb_t rest;

    arb_init(rest);
    arb_set_d(x, y);
    arb_set_d(rest, low);
    arb_add(x, x, rest, QDOT_GIVEN_BITS);
    mag_set_d(arb_radref(rest), 0x1p-96 * fmax(1, fabs(y)));
    arb_add_error_mag(x, arb_radref(rest));
    arb_clear(rest);
}

/* Set x to the exact value in the request, if the start still has that value; otherwise to y + low. */
static qdot_status
set_start_value(const qdot_given *g, qdot_expr asked, double y, double low, arb_t x)
{
    qdot_expr e = qdot_plan_substitute(g->plan, asked);
    qdot_ball ball;
    double value, beyond;
    int side;

    QDOT_TRY(qdot_plan_number(g->plan, asked, &value, &side, &beyond));
    set_ball(x, y, low);
    if (value != y || beyond != low)
        return QDOT_OK;
    QDOT_TRY(qdot_ball_begin(&ball, g->plan->pool, 1, &e));
    qdot_ball_eval(&ball, QDOT_GIVEN_BITS, NULL, NULL);
    if (qdot_ball_get(&ball, e))
        arb_set(x, qdot_ball_get(&ball, e));
    qdot_ball_end(&ball);
    return QDOT_OK;
}

qdot_status
qdot_given_init(qdot_given *g, const qdot_plan *plan, const qdot_run_request *request,
                const double *y, const double *low)
{
    const size_t n = plan->n;
    qdot_status status = QDOT_OK;

    *g = (qdot_given){.n = 2 * n, .plan = plan, .at = _arb_vec_init((slong)(2 * n))};
    if (!g->at)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < 2 * n && status == QDOT_OK; i++)
        status = set_start_value(g, i < n ? request->q0[i] : request->v0[i - n], y[i], low[i], g->at + i);
    return status;
}

double
qdot_given_double(arb_srcptr b)
{
    return !b || !arb_is_finite(b) ? NAN
           : arb_contains_zero(b)  ? 0
                                   : arf_get_d(arb_midref(b), ARF_RND_NEAR);
}

static bool
given_value(void *user, qdot_expr atom, arb_t value, slong prec)
{
    const qdot_given *g = user;

    (void)prec;
    for (size_t i = 0; i < g->n; i++)
        if (g->plan->inputs[i] == atom) {
            arb_set(value, g->at + i);
            return true;
        }
    return false;
}

qdot_status
qdot_given_evaluate(const qdot_given *g, size_t m, const qdot_expr *e, double *out)
{
    qdot_given of = *g;
    qdot_ball ball;

    QDOT_TRY(qdot_ball_begin(&ball, g->plan->pool, m, e));
    qdot_ball_eval(&ball, QDOT_GIVEN_BITS, given_value, &of);
    for (size_t k = 0; k < m; k++)
        out[k] = qdot_given_double(qdot_ball_get(&ball, e[k]));
    qdot_ball_end(&ball);
    return QDOT_OK;
}
