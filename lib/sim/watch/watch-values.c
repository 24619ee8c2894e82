/* watch-values.c -- the watched functions: their tapes, values and rounding errors. */
#include "expr/node.h"
#include "expr/symbol.h"
#include "sim/watch/watch-parts.h"

#include <fenv.h>
#include <float.h>
#include <math.h>
#include <string.h>

#include "sim/bind/bind.h"
#include "sim/model/simple-zeros.h"
#include "sim/model/term-magnitude.h"
#include "tape/shake.h"

/* --- the tapes of the functions ------------------------------------------------------ */

/* The kinds of symbols that do not occur in a function of t only. */
enum {
    OF_STATE = QDOT_HAS_COORD | QDOT_HAS_VELOCITY | QDOT_HAS_ACCELERATION | QDOT_HAS_MOMENTUM | QDOT_HAS_MULTIPLIER
};

/* Find which watched functions contain no switching functions, and which depend on t only, and which read tables. */
static qdot_status
find_function_kinds(qdot_watch *w, const qdot_expr *e)
{
    const qdot_plan *p = w->plan;

    w->smooth = qdot_calloc(3 * w->m + 1, sizeof *w->smooth);
    if (!w->smooth)
        return QDOT_ENOMEM;
    w->clock = w->smooth + w->m;
    w->reads_tables = w->clock + w->m;
    for (size_t i = 0; i < w->m; i++) {
        qdot_tape *one = NULL;

        QDOT_TRY(qdot_tape_new(p->pool, qdot_plan_inputs(p), p->inputs, 1, e + i, &one));
        w->smooth[i] = qdot_program_hindrance(one) == NULL;
        w->clock[i] = (qdot_expr_node(p->pool, e[i])->holds & OF_STATE) == 0;
        w->reads_tables[i] = qdot_knots_any(one);
        qdot_tape_free(one);
    }
    return QDOT_OK;
}

qdot_status
qdot_watch_lower(qdot_watch *w, const qdot_expr *g, bool shaken)
{
    const qdot_plan *p = w->plan;
    qdot_expr *e = qdot_malloc((w->m + 1) * sizeof *e);
    qdot_tape *tape = NULL;
    qdot_status status = e ? QDOT_OK : QDOT_ENOMEM;

    for (size_t i = 0; i < w->m && status == QDOT_OK; i++) {
        e[i] = qdot_simple_zeros(p->pool, qdot_plan_substitute(p, g[i]));
        status = qdot_pool_check(p->pool);
        if (status == QDOT_OK)
            w->accelerations |= (qdot_expr_node(p->pool, e[i])->holds &
                                 (QDOT_HAS_ACCELERATION | QDOT_HAS_MULTIPLIER)) != 0;
    }
    if (status == QDOT_OK)
        status = qdot_tape_new(p->pool, qdot_plan_inputs(p), p->inputs, w->m, e, &tape);
    if (status == QDOT_OK)
        status = find_function_kinds(w, e);
    for (size_t i = 0; i < w->m && status == QDOT_OK; i++)
        e[i] = qdot_term_magnitude(p->pool, e[i]);
    if (status == QDOT_OK)
        status = qdot_pool_check(p->pool);
    if (status == QDOT_OK)
        status =
            qdot_tape_new(p->pool, qdot_plan_inputs(p), p->inputs, w->m, e, &w->sizes);
    qdot_free(e);
    if (status == QDOT_OK && shaken) {
        status = qdot_tape_shake(tape, &w->tape);
        w->plain = tape;
    } else {
        w->tape = tape;
    }
    return status;
}

/* --- evaluating the functions -------------------------------------------------------- */

/* An interval of values about 0 that is narrower than this may be due to underflow. */
static const double nothing = 0x1p-900;

/* Whether g_i, which is 0 at the state in w->in, is a number too small for a double: an operation underflows, and
 * within rounding of the state g_i is nothing but such numbers. */
static bool
may_underflow(qdot_watch *w, size_t i)
{
#ifdef FE_UNDERFLOW
    const size_t inputs = qdot_tape_inputs(w->tape);
    const qdot_interval *box = w->bounds.box + i;

    if (fetestexcept(FE_UNDERFLOW) == 0)
        return false;
    feclearexcept(FE_UNDERFLOW); /* clear the flag, which earlier operations may have set */
    qdot_tape_eval(w->tape, w->in, w->raw, w->work);
    if (fetestexcept(FE_UNDERFLOW) == 0)
        return false;
    for (size_t k = 0; k < inputs; k++) {
        /* change each input by its rounding error, at least by DBL_MIN */
        const double by = fmax(DBL_EPSILON * fabs(w->in[k]), DBL_MIN);

        w->bounds.span[k] = (qdot_interval){w->in[k] - by, w->in[k] + by};
    }
    qdot_interval_eval(w->tape, w->bounds.span, w->bounds.box, w->bounds.span_work);
    return box->lo > -nothing && box->hi < nothing && box->lo < box->hi;
#else
    (void)w;
    (void)i;
    return false;
#endif
}

/* Fail because a watched function is not a number at the state in w->in. */
static qdot_status
fail_not_a_number(qdot_watch *w, double t)
{
#ifdef FE_OVERFLOW
    feclearexcept(FE_OVERFLOW);
    qdot_tape_eval(w->tape, w->in, w->raw, w->work);
    if (fetestexcept(FE_OVERFLOW) != 0)
        return qdot_fail(QDOT_EDOMAIN,
                         "an event is undefined at t = %.15g, where a part of it overflows", t);
#endif
    return qdot_fail(QDOT_EDOMAIN, "an event is undefined at t = %.15g", t);
}

qdot_status
qdot_watch_value(qdot_watch *w, double t, double *g)
{
    w->in[2 * w->n] = t;
    if (w->accelerations)
        QDOT_TRY(
            qdot_bind_accelerations(w->reader.system, t, w->in, w->in + 2 * w->n + 1));
    qdot_tape_eval(w->tape, w->in, g, w->work);
    for (size_t i = 0; i < w->m; i++)
        if (isnan(g[i]))
            return fail_not_a_number(w, t);
        else if (fabs(g[i]) > QDOT_WATCH_MOST)
            g[i] = copysign(QDOT_WATCH_MOST, g[i]);
        else if (fabs(g[i]) < DBL_MIN && (g[i] != 0 || may_underflow(w, i)))
            g[i] = copysign(DBL_MIN, g[i]); /* keep the sign of values that underflow, by +-DBL_MIN */
    return QDOT_OK;
}

qdot_status
qdot_watch_value_at(qdot_watch *w, double t, double *g)
{
    if (w->fine) {
        QDOT_TRY(qdot_watch_value_two(w, t, g));
    } else {
        QDOT_TRY(w->reader.read(t, w->in, w->reader.user));
        QDOT_TRY(qdot_watch_value(w, t, g));
    }
    return w->any_deep ? qdot_watch_value_deep(w, t, g) : QDOT_OK;
}
