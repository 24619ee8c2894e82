/* origin.c -- rewrites the scene and the request of a run far from t = 0 in the time s = t - t0. */
#include "sim/run/origin.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/constant.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/walk.h"
#include "sim/model/delay.h"

/* A run counts times from its start if this is farther from t = 0 than this many durations of the run. */
static const double far = 1024;

typedef struct {
    qdot_pool *pool;
    qdot_expr time; /* the expression t0 + s, which replaces t */
    bool found;
} writing;

static qdot_expr
replace_time(qdot_expr e, void *user)
{
    const writing *w = user;

    return qdot_delay_replace_time(w->pool, e, w->time);
}

/* Whether the scene, or the value of a parameter, depends explicitly on t. */
static bool
is_time_dependent(qdot_scene *s, const qdot_run_request *r)
{
    bool found = qdot_scene_contains(s, QDOT_T) || qdot_expr_is_in_any(s->pool, QDOT_T, r->n_values, r->values);

    for (size_t i = 0; i < s->events.n && !found; i++) {
        const qdot_event *e = &s->events.at[i];

        found = qdot_expr_contains(s->pool, e->left, QDOT_T) || qdot_expr_contains(s->pool, e->right, QDOT_T) ||
                qdot_expr_is_in_any(s->pool, QDOT_T, e->values.n, e->values.at);
    }
    return found;
}

/* Rewrite the scene in terms of s; assignments of events are stored after the request's values. */
static qdot_status
rewrite_scene(qdot_origin *o, qdot_scene *scene, const qdot_run_request *asked)
{
    writing w = {.pool = scene->pool,
                 .time = qdot_add(scene->pool, QDOT_T, qdot_expr_of_double(scene->pool, o->origin))};
    size_t n = asked->n_values;

    for (size_t i = 0; i < scene->events.n; i++)
        n += scene->events.at[i].values.n;
    o->values = qdot_malloc((n + 1) * sizeof *o->values);
    if (!o->values)
        return QDOT_ENOMEM;
    QDOT_TRY(qdot_scene_save(scene, &o->saved));
    o->scene = scene;
    n = 0;
    for (; n < asked->n_values; n++) { /* t in the value of a function is its argument */
        const bool function = qdot_expr_kind(scene->pool, asked->symbols[n]) == QDOT_UFUN;

        o->values[n] = function ? asked->values[n] : replace_time(asked->values[n], &w);
    }
    o->request.values = o->values;
    for (size_t i = 0; i < scene->events.n; i++) {
        qdot_event *e = &scene->events.at[i];

        for (size_t k = 0; k < e->values.n; k++) {
            o->values[n++] = e->values.at[k];
            e->values.at[k] = replace_time(e->values.at[k], &w);
        }
        e->left = replace_time(e->left, &w);
        e->right = replace_time(e->right, &w);
    }
    return qdot_scene_map(scene, replace_time, &w);
}

qdot_status
qdot_origin_begin(qdot_origin *o, qdot_scene *scene, const qdot_run_request *asked)
{
    qdot_pool *pool = scene->pool;
    double t0, t1, length, low;
    qdot_expr origin;
    int side;

    o->request = *asked;
    if (asked->digits > 0 || asked->by_clock)
        return QDOT_OK;
    QDOT_TRY(qdot_constant_split(pool, asked->t0, &t0, &side, &low));
    QDOT_TRY(qdot_constant_split(pool, asked->t1, &t1, &side, &low));
    length = fabs(t1 - t0);
    if (!(length > 0) || !isfinite(length) || fmax(fabs(t0), fabs(t1)) < far * length)
        return QDOT_OK;
    o->origin = t0;
    origin = qdot_expr_of_double(pool, t0);
    o->request.t0 = qdot_sub(pool, asked->t0, origin);
    o->request.t1 = qdot_sub(pool, asked->t1, origin);
    QDOT_TRY(qdot_pool_check(pool));
    return is_time_dependent(scene, asked) ? rewrite_scene(o, scene, asked) : QDOT_OK;
}

void
qdot_origin_end(qdot_origin *o)
{
    size_t n = o->request.n_values;

    if (o->scene) {
        qdot_scene_restore(o->scene, &o->saved);
        for (size_t i = 0; i < o->scene->events.n; i++)
            for (size_t k = 0; k < o->scene->events.at[i].values.n; k++)
                o->scene->events.at[i].values.at[k] = o->values[n++];
    }
    qdot_free(o->values);
    *o = (qdot_origin){0};
}
