/* chart-start.c -- converts the start state of a run to other coordinates. */
#include "sim/run/chart-start.h"

#include <string.h>

#include "expr/calculus.h"
#include "expr/constant.h"
#include "expr/symbol.h"
#include "sim/model/substitute.h"

qdot_expr
qdot_chart_at_start(const qdot_scene *s, const qdot_run_request *request, qdot_expr e)
{
    qdot_pool *pool = s->pool;

    for (size_t i = 0; i < s->coordinates.n; i++) {
        const qdot_expr v = qdot_symbol_jet(pool, s->coordinates.at[i], 1);

        e = qdot_subs(pool, e, 1, &v, &request->v0[i]);
    }
    e = qdot_subs(pool, e, s->coordinates.n, s->coordinates.at, request->q0);
    return qdot_substitute(pool, e, request->n_values, request->symbols, request->values);
}

qdot_status
qdot_chart_start_sign(const qdot_scene *s, const qdot_run_request *request, qdot_expr e,
                int *sign, double *value)
{
    QDOT_TRY(qdot_constant_double(s->pool, qdot_chart_at_start(s, request, e), value));
    *sign = *value < 0 ? -1 : 1;
    return QDOT_OK;
}

static qdot_status
find_start_angles(const qdot_run_request *request, qdot_run_chart *x)
{
    const qdot_chart *c = &x->chart;

    for (size_t i = 0; i < c->moved.n; i++) {
        const qdot_status status = qdot_constant_double(
            c->of->pool, qdot_chart_at_start(c->of, request, c->moved.at[i].given), x->angles + i);

        if (status == QDOT_EDOMAIN)
            x->angles[i] = 0; /* an angle is undefined at the singular place: any value will do */
        else
            QDOT_TRY(status);
    }
    return QDOT_OK;
}

qdot_status
qdot_run_chart_new(qdot_scene *s, const qdot_run_request *request,
                   const qdot_chart_groups *groups, const int *sign, bool open,
                   qdot_run_chart **out)
{
    qdot_run_chart *x = *out = qdot_calloc(1, sizeof *x);

    if (!x)
        return QDOT_ENOMEM;
    QDOT_TRY(qdot_chart_make(s, groups, sign, open, &x->chart));
    if (!x->chart.scene && groups->n > 0)
        return QDOT_OK;
    x->n = s->coordinates.n;
    x->coordinates = qdot_calloc(x->n + 1, sizeof *x->coordinates);
    x->angles = qdot_calloc(x->chart.moved.n + 1, sizeof *x->angles);
    if (!x->coordinates || !x->angles)
        return QDOT_ENOMEM;
    memcpy(x->coordinates, s->coordinates.at, x->n * sizeof *x->coordinates);
    return find_start_angles(request, x);
}

qdot_status
qdot_run_chart_open(qdot_scene *s, const qdot_run_request *request, qdot_run_chart **out)
{
    qdot_chart_groups groups = {0};
    int *sign = NULL;
    double value;
    qdot_status status = qdot_chart_find(s, true, &groups);

    *out = NULL;
    if (status == QDOT_OK) {
        sign = qdot_calloc(groups.n + 1, sizeof *sign);
        status = sign ? QDOT_OK : QDOT_ENOMEM;
    }
    for (size_t i = 0; i < groups.n && status == QDOT_OK; i++)
        status = qdot_chart_start_sign(s, request, groups.at[i].distance, sign + i, &value);
    if (status == QDOT_OK)
        status = qdot_run_chart_new(s, request, &groups, sign, true, out);
    if (status == QDOT_OK && groups.n == 0) {
        qdot_scene_free((*out)->chart.scene);
        (*out)->chart.scene = NULL;
    }
    qdot_free(groups.at);
    qdot_free(sign);
    return status;
}
