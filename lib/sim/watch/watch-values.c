/* watch-values.c -- the watched functions: their tapes, values and rounding errors. */
#include "sim/watch/watch-parts.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "sim/bind/bind.h"
#include "sim/model/term-magnitude.h"
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

/* The value at a pole: its square root can be told from it, and it can be added up. */
static const double pole = 1e300;

/* --- values -------------------------------------------------------------------------- */

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
            return qdot_fail(QDOT_EDOMAIN, "an event is undefined at t = %.15g", t);
        else if (isinf(g[i]))
            g[i] = copysign(pole, g[i]);
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
