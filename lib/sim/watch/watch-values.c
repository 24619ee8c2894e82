/* watch-values.c -- the watched functions: their tapes, values and rounding errors. */
#include "sim/watch/watch-parts.h"

#include <fenv.h>
#include <float.h>
#include <math.h>
#include <string.h>

#include "sim/bind/bind.h"
#include "sim/model/term-magnitude.h"
#include "tape/rounding.h"
#include "tape/shake.h"

/* --- their tapes --------------------------------------------------------------------- */

qdot_status
qdot_watch_lower(qdot_watch *w, const qdot_expr *g, bool shaken)
{
    const qdot_plan *p = w->plan;
    qdot_expr *e = qdot_malloc((w->m + 1) * sizeof *e);
    qdot_tape *tape = NULL;
    qdot_status status = e ? QDOT_OK : QDOT_ENOMEM;

    for (size_t i = 0; i < w->m && status == QDOT_OK; i++) {
        e[i] = qdot_plan_substitute(p, g[i]);
        status = qdot_pool_check(p->pool);
        if (status == QDOT_OK)
            w->accelerations |= (qdot_expr_node(p->pool, e[i])->holds &
                                 (QDOT_HAS_ACCELERATION | QDOT_HAS_MULTIPLIER)) != 0;
    }
    if (status == QDOT_OK)
        status = qdot_tape_new(p->pool, qdot_plan_inputs(p), p->inputs, w->m, e, &tape);
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
        qdot_tape_free(tape);
    } else {
        w->tape = tape;
    }
    return status;
}

/* The largest |g|, also at a pole: it can be added up, multiplied by the square of a number of nodes, divided
 * by the distance of nodes. */
static const double most = 0x1p900;

/* --- values -------------------------------------------------------------------------- */

/* Below this an interval about 0 is one that underflows. */
static const double nothing = 0x1p-900;

/* Whether g_i, which is 0 at the state in w->in, is a number too small for a double: an operation underflows, and
 * within rounding of the state g_i is nothing but such numbers. */
static bool
underflows(qdot_watch *w, size_t i)
{
#ifdef FE_UNDERFLOW
    const size_t inputs = qdot_tape_inputs(w->tape);
    const qdot_interval *box = w->bounds.box + i;

    if (fetestexcept(FE_UNDERFLOW) == 0)
        return false;
    feclearexcept(FE_UNDERFLOW); /* it may be of anything since it was cleared */
    qdot_tape_eval(w->tape, w->in, w->raw, w->work);
    if (fetestexcept(FE_UNDERFLOW) == 0)
        return false;
    for (size_t k = 0; k < inputs; k++) {
        const double by = fmax(DBL_EPSILON * fabs(w->in[k]), DBL_MIN); /* of points the result is one, too */

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

/* A function is not a number at the state in w->in. */
static qdot_status
refuse_value(qdot_watch *w, double t)
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
            return refuse_value(w, t);
        else if (fabs(g[i]) > most)
            g[i] = copysign(most, g[i]);
        else if (fabs(g[i]) < DBL_MIN && (g[i] != 0 || underflows(w, i)))
            g[i] = copysign(DBL_MIN, g[i]); /* also of a 0: it keeps its sign */
    return QDOT_OK;
}

qdot_status
qdot_watch_value_at(qdot_watch *w, double t, double *g)
{
    QDOT_TRY(w->reader.read(t, w->in, w->reader.user));
    return qdot_watch_value(w, t, g);
}

qdot_status
qdot_watch_noise(qdot_watch *w, double t, const double *y, double by, double least, size_t i,
                 double *noise)
{
    double g;

    *noise = 0;
    memcpy(w->in, y, 2 * w->n * sizeof *y);
    QDOT_TRY(qdot_watch_value(w, t, w->moved));
    g = w->moved[i];
    for (size_t k = 0; k <= 2 * w->n; k++) {
        double at = k < 2 * w->n ? y[k] : t,
               to = at + by * copysign(fmax(least, fabs(at)), at);
        qdot_status status;

        if (to == at)
            continue;
        memcpy(w->in, y, 2 * w->n * sizeof *y);
        if (k < 2 * w->n)
            w->in[k] = to;
        status = qdot_watch_value(w, k < 2 * w->n ? t : to, w->moved);
        if (status == QDOT_EDOMAIN || status == QDOT_ESINGULAR)
            continue;
        QDOT_TRY(status);
        *noise += fabs(w->moved[i] - g);
    }
    return QDOT_OK;
}

qdot_status
qdot_watch_rounding(qdot_watch *w, double t, const double *y, size_t i, double *noise)
{
    double up, down;

    QDOT_TRY(qdot_watch_noise(w, t, y, 4 * DBL_EPSILON, 0, i, &up)); /* they differ beside a kink */
    QDOT_TRY(qdot_watch_noise(w, t, y, -4 * DBL_EPSILON, 0, i, &down));
    memcpy(w->in, y, 2 * w->n * sizeof *y);
    QDOT_TRY(qdot_watch_value(w, t, w->moved)); /* q'' too */
    qdot_tape_eval(w->sizes, w->in, w->raw, w->work);
    *noise = fmax(up, down) + 4 * DBL_EPSILON * fmin(w->raw[i], most);
    qdot_rounding_bounds(w->tape, w->in, NULL, w->raw, w->work);
    if (4 * w->raw[i] > *noise && w->raw[i] < most)
        *noise = 4 * w->raw[i];
    return QDOT_OK;
}
