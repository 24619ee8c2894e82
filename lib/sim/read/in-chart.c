/* in-chart.c -- writes expressions in the coordinates of a run's chart, one stretch of its angles
 * after another. */
#include "sim/read/in-chart.h"

#include <math.h>

#include "expr/print.h"
#include "expr/symbol.h"

void
qdot_in_chart_clear(qdot_in_chart *in)
{
    qdot_free(in->exprs);
    *in = (qdot_in_chart){0};
}

/* Refuse expressions with a square root, if the motion left the region in which the root's sign is valid. */
static qdot_status
check_branches(const qdot_in_chart *in, const qdot_expr *exprs)
{
    const qdot_chart *c = &in->run->chart->chart;

    for (size_t j = 0; j < in->m; j++) {
        const qdot_chart_sign *s = qdot_chart_beyond(c, in->exprs[j], in->quarters);
        qdot_text text = {0};
        qdot_status status;

        if (!s)
            continue;
        status = qdot_print(c->pool, exprs[j], QDOT_PLAIN, &text);
        if (status == QDOT_OK)
            status = qdot_fail(QDOT_EDOMAIN,
                               "%.120s is undefined at t = %.15g: there the motion is beyond "
                               "what %.100s can write",
                               qdot_text_str(&text), in->t,
                               qdot_expr_symbol(c->pool, s->symbol)->name);
        qdot_text_clear(&text);
        return status;
    }
    return QDOT_OK;
}

/* Express them in the coordinates of the run; `quarters` counts turns of the angles, 0 if no angle
 * occurs by itself. */
static qdot_status
express_in_chart(qdot_in_chart *in, const qdot_expr *exprs, const int64_t *quarters)
{
    const qdot_run_chart *x = in->run->chart;

    in->turns = false;
    for (size_t j = 0; j < in->m; j++) {
        bool turns;

        in->exprs[j] = qdot_run_chart_express(x, exprs[j], quarters, &turns);
        in->turns = in->turns || turns;
    }
    return qdot_pool_check(x->chart.pool);
}

qdot_status
qdot_in_chart_express(qdot_in_chart *in, qdot_run *run, size_t m, const qdot_expr *exprs,
                      double t)
{
    qdot_in_chart_clear(in);
    in->run = run;
    in->m = m;
    in->t = t;
    in->exprs = qdot_calloc(m + 1, sizeof *in->exprs);
    if (!in->exprs)
        return QDOT_ENOMEM;
    QDOT_TRY(express_in_chart(in, exprs, NULL));
    qdot_run_chart_limit(run);
    if (!in->turns)
        return QDOT_OK;
    QDOT_TRY(qdot_run_chart_quarters(run, t, &in->quarters));
    QDOT_TRY(express_in_chart(in, exprs, in->quarters));
    return check_branches(in, exprs);
}

bool
qdot_in_chart_holds(const qdot_in_chart *in, double t)
{
    const int64_t *quarters;

    if (!in->turns)
        return true;
    if (qdot_run_chart_quarters(in->run, t, &quarters) == QDOT_OK &&
        quarters == in->quarters)
        return true;
    (void)!qdot_run_chart_quarters(in->run, in->t, &quarters);
    return false;
}

double
qdot_in_chart_end(const qdot_in_chart *in, double from, double to)
{
    const qdot_run_chart *x = in->run->chart;
    double end = to;

    for (size_t i = 0; in->turns && i < x->stretches.n; i++) {
        const double t = x->stretches.at[i].t;

        if (fabs(t - from) < fabs(end - from) && (t - from) * (to - from) > 0)
            end = t;
    }
    return end;
}
