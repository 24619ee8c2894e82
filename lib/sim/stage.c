/* stage.c -- events, domains and surfaces with numbers in place; the modes. */
#include "sim/stage.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "expr/print.h"
#include "sim/substitute.h"
#include "tape/constant.h"

static void
clear_event(qdot_staged_event *e)
{
    qdot_free(e->name);
    qdot_free(e->targets);
    qdot_tape_free(e->then);
}

void
qdot_stage_clear(qdot_stage *s)
{
    for (size_t i = 0; i < s->events.n; i++)
        clear_event(&s->events.at[i]);
    qdot_free(s->events.at);
    for (size_t i = 0; i < s->modes.n; i++) {
        qdot_plan_free(s->modes.at[i]->plan);
        qdot_free(s->modes.at[i]->side);
        qdot_tape_free(s->modes.at[i]->level);
        qdot_free(s->modes.at[i]->functions);
        qdot_free(s->modes.at[i]->watched);
        qdot_free(s->modes.at[i]);
    }
    qdot_free(s->modes.at);
    qdot_switches_clear(&s->switches);
    qdot_domains_clear(&s->domains);
    qdot_tape_free(s->sides);
    *s = (qdot_stage){0};
}

/* --- sides of surfaces --------------------------------------------------------------- */

/* u, and where it is a step its distance to the next integer too. */
static qdot_status
lower_sides(qdot_stage *s)
{
    qdot_pool *pool = s->scene->pool;
    size_t n = s->scene->coordinates.n;
    qdot_vec(qdot_expr) u = {0}, in = {0};
    qdot_status status = QDOT_OK;

    for (size_t order = 0; order < 2; order++)
        for (size_t i = 0; i < n && status == QDOT_OK; i++)
            status = qdot_vec_push(&in, qdot_symbol_jet(pool, s->scene->coordinates.at[i],
                                                        (uint32_t)order));
    if (status == QDOT_OK)
        status = qdot_vec_push(&in, QDOT_T);
    for (size_t i = 0; i < s->switches.surfaces.n && status == QDOT_OK; i++)
        status = qdot_vec_push(&u, s->switches.surfaces.at[i].u);
    if (status == QDOT_OK && u.n > 0)
        status = qdot_tape_new(pool, in.n, in.at, u.n, u.at, &s->sides);
    qdot_free(u.at);
    qdot_free(in.at);
    return status;
}

/* u [surfaces] where component k of the state is moved by the part `by` of itself. */
static void
evaluate_sides(const qdot_stage *s, double t, const double *y, size_t k, double by,
               double *in, double *u, double *work)
{
    size_t n = 2 * (s->modes.n > 0 ? s->modes.at[0]->plan->n : s->scene->coordinates.n);

    memcpy(in, y, n * sizeof *y);
    in[n] = t;
    if (k <= n)
        in[k] *= 1 + by;
    qdot_tape_eval(s->sides, in, u, work);
}

qdot_status
qdot_stage_sides(const qdot_stage *s, double t, const double *y, long *side, bool *on)
{
    size_t m = s->switches.surfaces.n, n = 2 * s->modes.at[0]->plan->n;
    double *u, *moved, *noise, *in, *work;

    if (m == 0)
        return QDOT_OK;
    u = qdot_calloc(3 * m + n + 1 + qdot_tape_work(s->sides) + 1, sizeof *u);
    if (!u)
        return QDOT_ENOMEM;
    moved = u + m;
    noise = moved + m;
    in = noise + m;
    work = in + n + 1;
    evaluate_sides(s, t, y, n + 1, 0, in, u, work);
    for (size_t k = 0; k <= n; k++) {
        evaluate_sides(s, t, y, k, 2 * DBL_EPSILON, in, moved, work);
        for (size_t i = 0; i < m; i++)
            noise[i] += isfinite(moved[i]) ? fabs(moved[i] - u[i]) : 0;
    }
    for (size_t i = 0; i < m; i++) {
        bool steps = s->switches.surfaces.at[i].steps;
        double near = steps ? round(u[i]) : 0;

        on[i] = fabs(u[i] - near) <= noise[i];
        if (steps)
            side[i] = (long)(on[i] ? near : floor(u[i]));
        else
            side[i] = on[i] || u[i] > 0 ? 1 : -1;
    }
    qdot_free(u);
    return QDOT_OK;
}

qdot_status
qdot_stage_describe(const qdot_stage *s, size_t surface, long side, qdot_text *out)
{
    const qdot_surface *x = &s->switches.surfaces.at[surface];

    QDOT_TRY(qdot_print(s->switches.pool, x->u, QDOT_PLAIN, out));
    qdot_text_format(out, " = %ld", x->steps ? side : 0);
    return qdot_text_status(out);
}

/* --- events -------------------------------------------------------------------------- */

static size_t
place_of(const qdot_plan *p, qdot_expr target)
{
    size_t k = 0;

    while (k < 2 * p->n && p->inputs[k] != target)
        k++;
    return k;
}

static qdot_status
stage_changes(const qdot_plan *p, const qdot_event *event, qdot_staged_event *e)
{
    qdot_vec(qdot_expr) values = {0};
    qdot_status status = QDOT_OK;

    e->changes = event->targets.n;
    e->targets = qdot_calloc(e->changes + 1, sizeof *e->targets);
    if (!e->targets)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < e->changes && status == QDOT_OK; i++) {
        qdot_expr value = qdot_plan_substitute(p, event->values.at[i]);

        status = qdot_pool_check(p->pool);
        if (status != QDOT_OK)
            break;
        e->targets[i] = place_of(p, event->targets.at[i]);
        e->accelerations |=
            (qdot_expr_node(p->pool, value)->holds
             & (QDOT_HAS_ACCELERATION | QDOT_HAS_MULTIPLIER))
            != 0;
        status = qdot_vec_push(&values, value);
    }
    if (status == QDOT_OK && e->changes > 0)
        status = qdot_tape_new(p->pool, qdot_plan_inputs(p), p->inputs, values.n, values.at,
                               &e->then);
    qdot_free(values.at);
    return status;
}

static qdot_status
stage_events(qdot_stage *s, const qdot_plan *p)
{
    for (size_t i = 0; i < s->scene->events.n; i++) {
        const qdot_event *event = &s->scene->events.at[i];
        qdot_staged_event e = {.way = event->way, .stop = event->stop};
        qdot_status status;

        e.function =
            qdot_plan_substitute(p, qdot_sub(p->pool, event->left, event->right));
        QDOT_TRY(qdot_pool_check(p->pool));
        e.name = qdot_strdup(event->name);
        status = e.name ? stage_changes(p, event, &e) : QDOT_ENOMEM;
        if (status == QDOT_OK)
            status = qdot_vec_push(&s->events, e);
        if (status != QDOT_OK) {
            clear_event(&e);
            return status;
        }
    }
    return QDOT_OK;
}

/* --- modes --------------------------------------------------------------------------- */

static void
watch_function(qdot_mode *m, qdot_expr g, qdot_watched watched)
{
    m->functions[m->m] = g;
    m->watched[m->m++] = watched;
}

static qdot_status
watch_domains(const qdot_stage *s, qdot_mode *m)
{
    const qdot_plan *p = m->plan;

    for (size_t i = 0; i < s->domains.n; i++) {
        const qdot_domain *d = s->domains.at + i;
        qdot_expr q = p->inputs[d->coordinate];
        qdot_expr ends[] = {qdot_expr_symbol(p->pool, q)->lo,
                            qdot_expr_symbol(p->pool, q)->hi};

        for (int k = 0; k < 2; k++) {
            double bound = k ? d->hi : d->lo;

            if (ends[k] == QDOT_NIL)
                continue;
            watch_function(m, qdot_sub(p->pool, q, qdot_plan_substitute(p, ends[k])),
                           (qdot_watched){.kind = QDOT_WATCH_DOMAIN,
                                          .index = i,
                                          .inside = k ? -1 : 1,
                                          .coordinate = d->coordinate,
                                          .bound = bound});
        }
    }
    return qdot_pool_check(p->pool);
}

static qdot_status
watch_surfaces(const qdot_stage *s, qdot_mode *m)
{
    for (size_t i = 0; i < s->switches.surfaces.n; i++) {
        const qdot_surface *x = &s->switches.surfaces.at[i];
        qdot_pool *pool = s->switches.pool;
        qdot_expr u;

        QDOT_TRY(qdot_switches_freeze(&s->switches, m->side, 1, &x->u, &u));
        if (!x->steps) {
            watch_function(m, u,
                           (qdot_watched){.kind = QDOT_WATCH_SURFACE,
                                          .index = i,
                                          .inside = (int)m->side[i],
                                          .beyond = -m->side[i]});
            continue;
        }
        for (int k = 0; k < 2; k++)
            watch_function(m, qdot_sub(pool, u, qdot_expr_int(pool, m->side[i] + k)),
                           (qdot_watched){.kind = QDOT_WATCH_SURFACE,
                                          .index = i,
                                          .inside = k ? -1 : 1,
                                          .beyond = m->side[i] + (k ? 1 : -1)});
    }
    return qdot_pool_check(s->switches.pool);
}

static qdot_status
lower_level(const qdot_stage *s, qdot_mode *m)
{
    qdot_expr level;

    if (s->switches.level == QDOT_NIL)
        return QDOT_OK;
    QDOT_TRY(qdot_switches_freeze(&s->switches, m->side, 1, &s->switches.level, &level));
    return qdot_tape_new(m->plan->pool, 2 * m->plan->n + 1, m->plan->inputs, 1, &level,
                         &m->level);
}

static qdot_status
make_mode(qdot_stage *s, const long *side, qdot_mode *m)
{
    size_t surfaces = s->switches.surfaces.n;
    size_t most;

    m->side = qdot_calloc(surfaces + 1, sizeof *m->side);
    if (!m->side)
        return QDOT_ENOMEM;
    if (surfaces > 0)
        memcpy(m->side, side, surfaces * sizeof *side);
    QDOT_TRY(qdot_plan_in_mode(s->scene, s->request, &s->switches, m->side, &m->plan));
    if (s->modes.n == 0) {
        QDOT_TRY(qdot_domains_find(m->plan, &s->domains));
        QDOT_TRY(stage_events(s, m->plan));
    }
    most = s->events.n + 2 * s->domains.n + 2 * surfaces;
    m->functions = qdot_calloc(most + 1, sizeof *m->functions);
    m->watched = qdot_calloc(most + 1, sizeof *m->watched);
    if (!m->functions || !m->watched)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < s->events.n; i++)
        watch_function(m, s->events.at[i].function,
                       (qdot_watched){.kind = QDOT_WATCH_EVENT, .index = i});
    QDOT_TRY(watch_domains(s, m));
    QDOT_TRY(lower_level(s, m));
    return watch_surfaces(s, m);
}

qdot_status
qdot_stage_mode(qdot_stage *s, const long *side, size_t *mode)
{
    size_t surfaces = s->switches.surfaces.n;
    qdot_mode *m;
    qdot_status status;

    for (size_t i = 0; i < s->modes.n; i++)
        if (surfaces == 0
            || memcmp(s->modes.at[i]->side, side, surfaces * sizeof *side) == 0) {
            *mode = i;
            return QDOT_OK;
        }
    if (!s->scene)
        return qdot_fail(QDOT_EFAILED, "it goes on by equations that the run did not meet");
    m = qdot_calloc(1, sizeof *m);
    if (!m)
        return QDOT_ENOMEM;
    *mode = s->modes.n;
    status = qdot_vec_push(&s->modes, m);
    if (status != QDOT_OK) {
        qdot_free(m);
        return status;
    }
    s->modes.n--; /* it counts once it is whole */
    status = make_mode(s, side, m);
    s->modes.n++;
    return status;
}

/* --- the start ----------------------------------------------------------------------- */

/* The request's start as doubles, y [2n]. */
static qdot_status
start_numbers(const qdot_stage *s, double *t, double *y)
{
    const qdot_run_request *r = s->request;
    qdot_pool *pool = s->scene->pool;
    size_t n = s->scene->coordinates.n;

    for (size_t k = 0; k <= 2 * n; k++) {
        qdot_expr e = k == 2 * n ? r->t0 : k < n ? r->q0[k] : r->v0[k - n];

        e = qdot_substitute(pool, e, r->n_values, r->symbols, r->values);
        QDOT_TRY(qdot_pool_check(pool));
        QDOT_TRY(qdot_tape_constant(pool, e, k == 2 * n ? t : &y[k]));
    }
    return QDOT_OK;
}

/* The sides at y, or at the start before there is a mode: side [surfaces]. */
static qdot_status
start_sides(const qdot_stage *s, const double *settled, long *side)
{
    size_t n = s->scene->coordinates.n, m = s->switches.surfaces.n;
    double *y = qdot_calloc(2 * n + 1, sizeof *y), t = 0;
    double *in = qdot_calloc(2 * n + 1 + m + qdot_tape_work(s->sides) + 1, sizeof *in);
    qdot_status status = y && in ? start_numbers(s, &t, y) : QDOT_ENOMEM;

    if (status == QDOT_OK && settled)
        memcpy(y, settled, 2 * n * sizeof *y);
    if (status == QDOT_OK) {
        double *u = in + 2 * n + 1;

        evaluate_sides(s, t, y, 2 * n + 1, 0, in, u, u + m);
        for (size_t i = 0; i < m; i++)
            side[i] = s->switches.surfaces.at[i].steps ? (long)floor(u[i])
                      : u[i] < 0                       ? -1
                                                       : 1;
    }
    qdot_free(y);
    qdot_free(in);
    return status;
}

static qdot_status
begin(qdot_stage *s, qdot_scene *scene, const qdot_run_request *request,
      const double *settled)
{
    size_t mode;
    long *side;
    qdot_status status = QDOT_OK;

    s->scene = scene;
    s->request = request;
    QDOT_TRY(qdot_plan_check(scene));
    QDOT_TRY(qdot_switches_find(scene, request, &s->switches));
    side = qdot_calloc(s->switches.surfaces.n + 1, sizeof *side);
    if (!side)
        return QDOT_ENOMEM;
    if (s->switches.surfaces.n > 0)
        status = lower_sides(s);
    if (s->switches.surfaces.n > 0 && status == QDOT_OK)
        status = start_sides(s, settled, side);
    if (status == QDOT_OK)
        status = qdot_stage_mode(s, side, &mode);
    qdot_free(side);
    return status;
}

qdot_status
qdot_stage_begin(qdot_stage *s, qdot_scene *scene, const qdot_run_request *request)
{
    return begin(s, scene, request, NULL);
}

qdot_status
qdot_stage_settle(qdot_stage *s, const double *y, bool *anew)
{
    qdot_scene *scene = s->scene;
    const qdot_run_request *request = s->request;
    size_t m = s->switches.surfaces.n;
    qdot_status status;
    long *side;

    *anew = false;
    if (m == 0)
        return QDOT_OK;
    side = qdot_calloc(m, sizeof *side);
    if (!side)
        return QDOT_ENOMEM;
    status = start_sides(s, y, side);
    *anew = status == QDOT_OK &&
            memcmp(side, s->modes.at[0]->side, m * sizeof *side) != 0;
    qdot_free(side);
    if (!*anew)
        return status;
    qdot_stage_clear(s);
    return begin(s, scene, request, y);
}
