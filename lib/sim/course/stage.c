/* stage.c -- inserts parameter values into events, domains and surfaces, and makes the modes of a run. */
#include "sim/course/stage.h"

#include <math.h>
#include <string.h>

#include "expr/build.h"
#include "expr/constant.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "sim/model/contact.h"
#include "sim/model/layer.h"
#include "sim/model/puck.h"
#include "sim/model/substitute.h"
#include "sim/plan/kept.h"
#include "sim/plan/plan.h"

static void
free_mode(qdot_mode *m)
{
    qdot_plan_free(m->plan);
    qdot_free(m->side);
    qdot_tape_free(m->level);
    qdot_tape_free(m->shares);
    qdot_sliding_rows_clear(&m->held);
    qdot_free(m->functions);
    qdot_free(m->watched);
    qdot_free(m);
}

void
qdot_stage_clear(qdot_stage *s)
{
    for (size_t i = 0; i < s->events.n; i++)
        qdot_staged_event_clear(&s->events.at[i]);
    qdot_free(s->events.at);
    for (size_t i = 0; i < s->modes.n; i++)
        free_mode(s->modes.at[i]);
    qdot_free(s->modes.at);
    qdot_plan_free(s->kept);
    qdot_switches_clear(&s->switches);
    qdot_domains_clear(&s->domains);
    qdot_parameter_conditions_clear(&s->conditions);
    qdot_tape_free(s->sides);
    qdot_free(s->in_pieces);
    qdot_tape_free(s->pucks);
    qdot_free(s->scales);
    *s = (qdot_stage){0};
}

/* --- functions watched in a mode ----------------------------------------------------- */

static void
append_watched_function(qdot_mode *m, qdot_expr g, qdot_watched watched)
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
            append_watched_function(m, qdot_sub(p->pool, q, qdot_plan_substitute(p, ends[k])),
                                    (qdot_watched){.kind = QDOT_WATCH_DOMAIN,
                                          .index = i,
                                          .inside = k ? -1 : 1,
                                          .coordinate = d->coordinate,
                                          .bound = bound});
        }
    }
    return qdot_pool_check(p->pool);
}

/* Whether the value u of a surface's function lies on the given side. */
static bool
is_on_side(qdot_pool *pool, const qdot_surface *x, qdot_expr u, int64_t side)
{
    qdot_expr k = qdot_expr_int(pool, side);

    if (x->steps)
        return qdot_rel(pool, QDOT_LE, k, u) == QDOT_TRUE
               && qdot_rel(pool, QDOT_LT, u, qdot_add(pool, k, QDOT_ONE)) == QDOT_TRUE;
    if (x->layer > 0 && side == 0)
        return qdot_rel(pool, QDOT_LE, qdot_fun1(pool, QDOT_ABS, u),
                        qdot_layers_rim(pool, x)) == QDOT_TRUE;
    return qdot_fun1(pool, QDOT_SIGN, u) == k;
}

/* Two functions of a surface, e less each of two values, between which e has to stay; `beyond` them
 * are the sides [2]. */
static void
watch_interval(qdot_pool *pool, qdot_mode *m, qdot_watched w, qdot_expr e, const int64_t *values,
               const int64_t *beyond)
{
    for (int k = 0; k < 2; k++) {
        w.inside = k ? -1 : 1;
        w.beyond = beyond[k];
        append_watched_function(m, qdot_sub(pool, e, qdot_expr_int(pool, values[k])), w);
    }
}

/* Watch u = layer and u = -layer, the boundaries at which the motion leaves the present side of a layer. */
static void
watch_layer(qdot_mode *m, const qdot_surface *x, qdot_expr u, qdot_watched watched)
{
    qdot_pool *pool = m->plan->pool;
    const int64_t side = m->side[watched.index];
    const qdot_expr w = qdot_layers_rim(pool, x);

    for (int rim = 1; rim >= -1; rim -= 2) {
        if (side == -rim)
            continue;
        watched.inside = side == 0 ? -rim : rim;
        watched.beyond = side == 0 ? rim : 0;
        append_watched_function(m, rim > 0 ? qdot_sub(pool, u, w) : qdot_add(pool, u, w), watched);
    }
}

/* A puck that moves: |w|^2 above its radius; at rest: s G s below 1; that creeps: between 1 and a little
 * more. */
static void
watch_disc(qdot_mode *m, const qdot_puck *puck, qdot_watched w)
{
    qdot_pool *pool = m->plan->pool;
    const int64_t side = m->side[w.index];
    const qdot_expr share = qdot_puck_is_held(side) ? m->plan->share[w.index] : QDOT_NIL;
    const qdot_expr two = qdot_expr_int(pool, 2);
    const qdot_expr creep = qdot_pow_int(pool, two, QDOT_PUCK_CREEP_EXPONENT);

    w.inside = 1;
    w.velocity = true;
    w.beyond = side == QDOT_SIDE_SLIDES ? QDOT_SIDE_CREEPS : QDOT_SIDE_SLIDES;
    if (side == QDOT_SIDE_SLIDES) {
        append_watched_function(m, qdot_sub(pool, QDOT_ONE, share), w);
    } else if (side == QDOT_SIDE_CREEPS) {
        append_watched_function(m, qdot_sub(pool, share, QDOT_ONE), w);
        w.beyond = 1;
        append_watched_function(m, qdot_sub(pool, qdot_add(pool, QDOT_ONE, creep), share), w);
    } else if (puck->radius > 0) {
        append_watched_function(m, qdot_sub(pool, puck->square,
                                            qdot_pow_int(pool, two, 2 * ilogb(puck->radius))),
                                w);
    }
}

/* A surface whose u is constant in the mode is not watched; where u is 0, it is watched to stay
 * 0; where the motion slides, its share is. */
static qdot_status
watch_surfaces(const qdot_stage *s, qdot_mode *m)
{
    static const int64_t ends[] = {-1, 1}, layer[] = {0, 0};

    for (size_t i = 0; i < s->switches.surfaces.n; i++) {
        const qdot_surface *x = &s->switches.surfaces.at[i];
        qdot_pool *pool = s->switches.pool;
        bool some, moves;
        qdot_watched w = {.kind = QDOT_WATCH_SURFACE, .index = i};
        qdot_expr u;

        if (x->puck > 0) {
            watch_disc(m, qdot_puck_of(&s->switches, i), w);
            continue;
        }
        if (m->side[i] == QDOT_SIDE_SLIDES) {
            w.velocity = true;
            if (!x->contact)
                watch_interval(pool, m, w,
                               x->layer > 0 ? qdot_layers_share(pool, m->plan->share[i])
                                           : m->plan->share[i],
                               ends, x->layer > 0 ? layer : ends);
            w.inside = 1;
            if (x->contact) /* a lasting contact ends when its reaction no longer pushes */
                append_watched_function(m, m->plan->share[i], w);
            continue;
        }
        if (x->contact || m->side[i] == QDOT_SIDE_IDLE)
            continue;
        QDOT_TRY(qdot_switches_freeze(&s->switches, m->side, m->plan->share, 1, &x->u, &u));
        if (qdot_expr_kind(pool, u) == QDOT_NUM && !is_on_side(pool, x, u, m->side[i]))
            return qdot_fail(QDOT_EFAILED, "a switch of the equations cannot be decided");
        QDOT_TRY(qdot_parameter_states_occur(m->plan, u, &some, &moves));
        if (!moves)
            continue;
        w.velocity = (qdot_expr_node(pool, u)->holds
                      & (QDOT_HAS_VELOCITY | QDOT_HAS_ACCELERATION | QDOT_HAS_MULTIPLIER))
                     != 0;
        if (x->layer > 0) {
            watch_layer(m, x, u, w);
            continue;
        }
        if (x->steps) {
            watch_interval(pool, m, w, u, (int64_t[]){m->side[i], m->side[i] + 1},
                           (int64_t[]){m->side[i] - 1, m->side[i] + 1});
            continue;
        }
        w.inside = (int)m->side[i];
        w.beyond = -m->side[i];
        append_watched_function(m, u, w);
    }
    return qdot_pool_check(s->switches.pool);
}

static qdot_status
make_level_tape(const qdot_stage *s, qdot_mode *m)
{
    qdot_expr level;

    if (s->switches.level == QDOT_NIL)
        return QDOT_OK;
    QDOT_TRY(qdot_switches_freeze(&s->switches, m->side, m->plan->share, 1, &s->switches.level,
                                  &level));
    return qdot_tape_new(m->plan->pool, 2 * m->plan->n + 1, m->plan->inputs, 1, &level,
                         &m->level);
}

/* Replace the function of a lasting contact's event by the constant 1, which has no roots: no events meanwhile. */
static void
disable_lasting_contacts(const qdot_stage *s, qdot_mode *m)
{
    for (size_t i = qdot_switches_own(&s->switches); i < s->switches.surfaces.n; i++)
        if (s->switches.surfaces.at[i].contact && m->side[i] == QDOT_SIDE_SLIDES)
            m->functions[s->switches.surfaces.at[i].event] = QDOT_ONE;
}

/* Write the values of the symbols of discs in a mode, after those of surfaces, into out. */
static void
write_disc_values(const qdot_stage *s, const qdot_mode *m, qdot_expr *out)
{
    const qdot_switches *x = &s->switches;

    for (size_t i = 0; i < x->pucks.n; i++) {
        const qdot_puck *puck = &x->pucks.at[i];
        const bool held = qdot_puck_is_held(m->side[puck->surface]);

        for (size_t c = 0; c < puck->k; c++)
            out[puck->first + c] =
                held ? m->plan->share[x->surfaces.n + puck->first + c] : QDOT_ZERO;
        out[puck->first + puck->k] =
            held ? QDOT_ZERO : qdot_pow(x->pool, puck->square, qdot_neg(x->pool, QDOT_HALF));
    }
}

static qdot_status
find_sliding_rows(const qdot_stage *s, qdot_mode *m)
{
    const size_t surfaces = s->switches.surfaces.n, all = surfaces + s->switches.n_puck_symbols;
    qdot_expr *u;
    qdot_status status = QDOT_OK;

    if (!qdot_sliding_is(&s->switches, m->side) && s->switches.pucks.n == 0)
        return QDOT_OK;
    u = qdot_calloc(all, sizeof *u);
    if (!u)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < surfaces && status == QDOT_OK; i++)
        if (m->side[i] == QDOT_SIDE_SLIDES)
            status = qdot_switches_freeze(&s->switches, m->side, m->plan->share, 1,
                                          &s->switches.surfaces.at[i].u, u + i);
    if (status == QDOT_OK)
        status = qdot_sliding_rows_make(m->plan, &s->switches, m->side, u, &m->held);
    for (size_t i = 0; i < surfaces; i++)
        u[i] = m->side[i] == QDOT_SIDE_SLIDES ? m->plan->share[i] : QDOT_ZERO;
    write_disc_values(s, m, u + surfaces);
    if (status == QDOT_OK)
        status = qdot_pool_check(s->switches.pool);
    if (status == QDOT_OK)
        status = qdot_tape_new(m->plan->pool, 2 * m->plan->n + 1, m->plan->inputs, all, u,
                               &m->shares);
    qdot_free(u);
    return status;
}

static qdot_status
make_mode(qdot_stage *s, const int64_t *side, qdot_mode *m)
{
    size_t surfaces = s->switches.surfaces.n;
    size_t most;

    m->side = qdot_calloc(surfaces + 1, sizeof *m->side);
    if (!m->side)
        return QDOT_ENOMEM;
    if (surfaces > 0)
        memcpy(m->side, side, surfaces * sizeof *side);
    m->plan = s->kept;
    s->kept = NULL;
    if (!m->plan) {
        QDOT_TRY(qdot_plan_in_mode(s->scene, s->request, &s->switches, m->side, &m->plan));
        if (s->switches.atoms.n == 0 && s->switches.level == QDOT_NIL && !m->plan->share
            && s->switches.pucks.n == 0)
            qdot_kept_add(s->scene, s->request, m->plan);
    }
    if (s->modes.n == 0) {
        QDOT_TRY(qdot_domains_find(m->plan, &s->domains));
        QDOT_TRY(qdot_stage_events(s, m->plan));
        QDOT_TRY(qdot_parameter_conditions_find(m->plan, s->scene, &s->conditions));
    }
    most = s->events.n + 2 * s->domains.n + 2 * surfaces;
    m->functions = qdot_calloc(most + 1, sizeof *m->functions);
    m->watched = qdot_calloc(most + 1, sizeof *m->watched);
    if (!m->functions || !m->watched)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < s->events.n; i++)
        append_watched_function(m, s->events.at[i].function,
                                (qdot_watched){.kind = QDOT_WATCH_EVENT, .index = i});
    QDOT_TRY(watch_domains(s, m));
    QDOT_TRY(make_level_tape(s, m));
    QDOT_TRY(find_sliding_rows(s, m));
    disable_lasting_contacts(s, m);
    return watch_surfaces(s, m);
}

qdot_status
qdot_stage_mode(qdot_stage *s, const int64_t *side, size_t *mode)
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
    status = make_mode(s, side, m);
    if (status == QDOT_OK)
        status = qdot_vec_push(&s->modes, m);
    if (status == QDOT_OK)
        *mode = s->modes.n - 1;
    else
        free_mode(m);
    return status;
}

/* --- the start of the run ------------------------------------------------------------ */

/* Whether the requested run goes backward in time. */
static qdot_status
is_backward_run(const qdot_stage *s, bool *back)
{
    const qdot_run_request *r = s->request;
    const qdot_expr ends[] = {r->t0, r->t1};
    double t[2] = {0};

    for (size_t k = 0; k < 2; k++) {
        const qdot_expr e = qdot_substitute(s->scene->pool, ends[k], r->n_values, r->symbols, r->values);

        QDOT_TRY(qdot_pool_check(s->scene->pool));
        QDOT_TRY(qdot_constant_double(s->scene->pool, e, &t[k]));
    }
    *back = t[1] < t[0];
    return QDOT_OK;
}

/* Write the start state of the request as doubles, y [2n]. */
static qdot_status
find_start_state(const qdot_stage *s, double *t, double *y)
{
    const qdot_run_request *r = s->request;
    qdot_pool *pool = s->scene->pool;
    const size_t n = s->n;

    for (size_t k = 0; k <= 2 * n; k++) {
        qdot_expr e = k == 2 * n ? r->t0 : k < n ? r->q0[k] : r->v0[k - n];

        e = qdot_substitute(pool, e, r->n_values, r->symbols, r->values);
        QDOT_TRY(qdot_pool_check(pool));
        QDOT_TRY(qdot_constant_double(pool, e, k == 2 * n ? t : &y[k]));
    }
    return QDOT_OK;
}

/* The tolerance for series in doubles, with which steps may pass their radius of convergence; 0
 * without such series. */
static double
series_tolerance(const qdot_run_request *r)
{
    const qdot_ode_method *method = qdot_ode_method_find(r->method); /* NULL for "auto" */

    return r->digits == 0 && (!method || method->series) ? r->tol : 0;
}

/* Lower expressions that decide about a power with a layer: what counts as 0 in the layer is 0 for
 * them, too. */
static qdot_status
make_side_tape_with_layers(qdot_stage *s)
{
    bool some = false;

    for (size_t i = 0; i < qdot_switches_own(&s->switches); i++)
        some |= s->switches.surfaces.at[i].layer > 0;
    if (!some)
        return QDOT_OK;
    qdot_tape_free(s->sides);
    qdot_free(s->in_pieces);
    s->sides = NULL;
    return qdot_stage_lower_sides(s);
}

/* The sides at y, or at the start before there is a mode: side [surfaces]. Layers are measured
 * first, once. */
static qdot_status
find_start_sides(qdot_stage *s, const double *settled, int64_t *side)
{
    const size_t n = s->n;
    double *y = qdot_calloc(2 * n + 1, sizeof *y), t = 0, t1 = 0;
    qdot_status status = y ? find_start_state(s, &t, y) : QDOT_ENOMEM;

    if (status == QDOT_OK && s->modes.n == 0)
        status = qdot_constant_double(s->scene->pool, s->request->t1, &t1);
    if (status == QDOT_OK && s->modes.n == 0)
        status = qdot_stage_layers(s, t, y, fmax(fabs(t), fabs(t1)), series_tolerance(s->request));
    if (status == QDOT_OK && s->modes.n == 0)
        status = make_side_tape_with_layers(s);
    if (status == QDOT_OK && settled)
        memcpy(y, settled, 2 * n * sizeof *y);
    if (status == QDOT_OK)
        status = qdot_stage_sides(s, t, y, NULL, side);
    qdot_free(y);
    return status;
}

/* Choose the regularisation radii of discs from their state at the start of the run. */
static qdot_status
choose_disc_radii(qdot_stage *s, const double *settled)
{
    double *y = qdot_calloc(2 * s->n + 1, sizeof *y), t = 0, t1 = 0;
    qdot_status status = y ? find_start_state(s, &t, y) : QDOT_ENOMEM;

    if (status == QDOT_OK)
        status = qdot_constant_double(s->scene->pool, s->request->t1, &t1);
    if (status == QDOT_OK && settled)
        memcpy(y, settled, 2 * s->n * sizeof *y);
    if (status == QDOT_OK)
        status = qdot_stage_pucks(s, t, y, fmax(fabs(t), fabs(t1)));
    qdot_free(y);
    return status;
}

/* Copy the scales of the state from the request; parameters that events set have scale 1. */
static qdot_status
copy_scales(qdot_stage *s, size_t n)
{
    const double *said = s->request->scales;

    if (!said)
        return QDOT_OK;
    s->scales = qdot_malloc((2 * s->n + 1) * sizeof *s->scales);
    if (!s->scales)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < 2 * s->n; i++) {
        const size_t k = i % s->n;

        s->scales[i] = k < n && said[k + (i < s->n ? 0 : n)] > 0 ? said[k + (i < s->n ? 0 : n)] : 1;
    }
    return QDOT_OK;
}

static qdot_status
begin_stage(qdot_stage *s, qdot_scene *scene, const qdot_run_request *request,
            const double *settled)
{
    size_t mode;
    int64_t *side;
    qdot_status status = QDOT_OK;

    s->scene = scene;
    s->request = request;
    s->n = qdot_parameter_states_coordinates(scene, request);
    s->n_states = request->n_states;
    QDOT_TRY(copy_scales(s, scene->coordinates.n));
    QDOT_TRY(qdot_plan_check(scene));
    s->kept = qdot_kept_find(scene, request);
    if (s->kept) /* plans kept from an earlier run have no switches */
        s->switches.pool = scene->pool;
    else
        QDOT_TRY(qdot_switches_find(scene, request, &s->switches));
    QDOT_TRY(is_backward_run(s, &s->back));
    if (!s->back) /* not backward in time: a motion at rest has no unique past */
        QDOT_TRY(qdot_contacts_find(scene, request, &s->switches));
    if (!s->kept)
        QDOT_TRY(qdot_pucks_find(scene, request, &s->switches));
    side = qdot_calloc(s->switches.surfaces.n + 1, sizeof *side);
    if (!side)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < s->switches.pucks.n; i++)
        side[s->switches.pucks.at[i].surface] = 1;
    if (s->switches.pucks.n > 0)
        status = choose_disc_radii(s, settled);
    if (qdot_switches_own(&s->switches) > 0 && status == QDOT_OK)
        status = qdot_stage_lower_sides(s);
    if (qdot_switches_own(&s->switches) > 0 && status == QDOT_OK)
        status = find_start_sides(s, settled, side);
    if (status == QDOT_OK)
        status = qdot_stage_mode(s, side, &mode);
    qdot_free(side);
    return status;
}

qdot_status
qdot_stage_begin(qdot_stage *s, qdot_scene *scene, const qdot_run_request *request)
{
    return begin_stage(s, scene, request, NULL);
}

qdot_status
qdot_stage_settle(qdot_stage *s, const double *y, bool *anew)
{
    qdot_scene *scene = s->scene;
    const qdot_run_request *request = s->request;
    size_t m = qdot_switches_own(&s->switches);
    qdot_status status;
    int64_t *side;

    *anew = false;
    if (m == 0)
        return QDOT_OK;
    side = qdot_calloc(s->switches.surfaces.n, sizeof *side);
    if (!side)
        return QDOT_ENOMEM;
    status = find_start_sides(s, y, side);
    *anew = status == QDOT_OK &&
            memcmp(side, s->modes.at[0]->side, m * sizeof *side) != 0;
    qdot_free(side);
    if (!*anew)
        return status;
    qdot_stage_clear(s);
    return begin_stage(s, scene, request, y);
}
