/* written.c -- decides when it pays to generate machine code, by the estimated number of remaining steps. */
#include "ode/written.h"

#include <math.h>

/* After this many steps the estimate of those to come is trusted. Before, more of them are required
 * in proportion. */
static const double few_steps = 4;

/* Weight of the estimate from the first step. Many motions start at rest, where steps are the
 * longest, so more steps follow than that step says. */
static const double by_first = 1.5;

static bool
code_pays(const qdot_ode_written *w, double steps, double left)
{
    return left * w->p * fmin(1, (steps + 1) / few_steps) > w->worth;
}

qdot_ode_written
qdot_ode_written_begin(const qdot_ode_series *series, int p, int most, double past)
{
    const qdot_ode_code *code = &series->code;
    qdot_ode_written w = {.code = code, .worth = series->cost.worth - past * p, .p = p, .most = most};

    w.done = !code->write || code->there(p, code->user);
    w.first = !w.done;
    w.on_trial = w.first && code->take(p, w.most, code->user);
    return w;
}

qdot_status
qdot_ode_written_now(qdot_ode_written *w)
{
    w->done = true;
    return w->code->write(w->p, w->most, w->code->user);
}

qdot_status
qdot_ode_written_first(qdot_ode_written *w, double left, bool *again)
{
    const qdot_ode_code *c = w->code;
    const bool wanted = by_first * left * w->p > w->worth, there = w->on_trial;

    w->first = w->on_trial = false;
    w->done = wanted;
    *again = false;
    if (wanted && !there) {
        QDOT_TRY(qdot_ode_written_now(w));
        *again = c->there(w->p, c->user);
    } else if (there && !wanted) {
        c->drop(c->user);
        *again = true;
    }
    return QDOT_OK;
}

qdot_status
qdot_ode_written_next(qdot_ode_written *w, double steps, double left)
{
    if (w->done || !code_pays(w, steps, left))
        return QDOT_OK;
    return qdot_ode_written_now(w);
}
