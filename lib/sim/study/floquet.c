/* floquet.c -- the monodromy matrix of a periodic orbit, its eigenvalues, and the stability that follows. */
#include "sim/study/floquet.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "mech/dynamics/integrated.h"
#include "num/balance.h"
#include "num/eigenvalues.h"
#include "ode/scale.h"
#include "sim/study/shooting.h"
#include "sim/study/sizes.h"

/* A run that is so near to its start at its end is followed all round by the states between segments; how far the start of an
 * orbit may be from that of the run, relative to max(1, |z|). */
static const double followed = 1e-3, near_start = 1e-6;

/* A state is at rest if its initial rate times the duration of the run is below this, relative to
 * max(1, |value|). */
static const double resting = 1e-9;

/* A multiplier counts as outside the unit circle if its distance exceeds this many times its error. */
static const double surely = 2;

/* Accelerations are periodic if they differ by less than this, relative to their largest value;
 * ASKED: times at which that is tested. */
static const double same = 1e-7;
enum { ASKED = 8 };

/* A multiplier that is 1 in theory may be computed with this distance from 1, in addition to its error. */
static const double near_one = 1e-2;

typedef struct {
    qdot_scene *scene;
    qdot_run *run;
    const qdot_run_request *request;
    qdot_run_request scaled; /* `request` with scales: the sizes of the states along the orbit */
    size_t n, K, c;   /* number of coordinates, of segments of the orbit, of multipliers */
    double t0, T;
    double *states;   /* [most K x 2n] states at the starts of the segments */
    double *ends;     /* [most K x 2n x 2n] derivatives of each segment's end state by its start state */
    double *B, *E; /* [most K x 2n x 2n] the same matrices in a basis that keeps the constraints [K x c x c]; their errors */
    double *size;     /* [2n] size of each component along the orbit */
    qdot_flow flow;
    const qdot_variation *v; /* the variational equations, whose solutions are the derivatives; owned by `flow` */
} orbit;

void
qdot_floquet_clear(qdot_floquet *x)
{
    qdot_free(x->re);
    *x = (qdot_floquet){0};
}

static qdot_expr
state_symbol(const qdot_scene *s, size_t i)
{
    const size_t n = s->coordinates.n;

    return qdot_symbol_jet(s->pool, s->coordinates.at[i % n], i >= n);
}

/* The scale of component i of the state (q, q'), relative to which differences are judged. */
static double
scale_of_component(const qdot_run_report *report, size_t n, size_t i, double value)
{
    return qdot_ode_size(report->scales, i < n ? i : report->n + i - n, value);
}

/* Find the change by [2n] of each of q, q' if its initial rate lasted for the whole run, and the
 * scales of q, q'. */
static qdot_status
find_changes_over_run(qdot_scene *scene, qdot_run *run, double *by, double *size)
{
    const size_t n = scene->coordinates.n;
    const qdot_run_report *report = qdot_run_get_report(run);

    for (size_t i = 0; i < 2 * n; i++) {
        const qdot_expr e[2] = {
            state_symbol(scene, i), qdot_symbol_jet(scene->pool, scene->coordinates.at[i % n], i < n ? 1 : 2)};
        double value[2];

        QDOT_TRY(qdot_run_values(run, 2, e, 1, &report->t0, value, NULL));
        by[i] = fabs(value[1] * (report->t1 - report->t0));
        size[i] = scale_of_component(report, n, i, value[0]);
    }
    return QDOT_OK;
}

static qdot_status
find_reach_of_rates(qdot_scene *scene, qdot_run *run, bool relative, double *reach)
{
    const size_t z = 2 * scene->coordinates.n;
    double *by = qdot_calloc(2 * z, sizeof *by);
    const qdot_status status = by ? find_changes_over_run(scene, run, by, by + z) : QDOT_ENOMEM;

    *reach = 0;
    for (size_t i = 0; i < z && status == QDOT_OK; i++)
        *reach = fmax(*reach, by[i] / (relative ? by[z + i] : 1));
    qdot_free(by);
    return status;
}

qdot_status
qdot_floquet_reach(qdot_scene *scene, qdot_run *run, double *reach)
{
    return find_reach_of_rates(scene, run, false, reach);
}

qdot_status
qdot_floquet_rests(qdot_scene *scene, qdot_run *run, bool *rests)
{
    double reach;

    QDOT_TRY(find_reach_of_rates(scene, run, true, &reach));
    *rests = !(reach > resting);
    return QDOT_OK;
}

qdot_status
qdot_floquet_return(qdot_scene *scene, qdot_run *run, double *off, qdot_expr *where)
{
    const qdot_run_report *report = qdot_run_get_report(run);
    const double t[2] = {report->t0, report->t1};

    *off = 0;
    for (size_t i = 0; i < 2 * scene->coordinates.n; i++) {
        const qdot_expr e = state_symbol(scene, i);
        double value[2], one;

        QDOT_TRY(qdot_run_values(run, 1, &e, 2, t, value, NULL));
        one = fabs(value[1] - value[0]) / scale_of_component(report, scene->coordinates.n, i, value[0]);
        if (one > *off || isnan(one)) {
            *off = one;
            *where = e;
        }
    }
    return QDOT_OK;
}

/* --- period of the equations ------------------------------------------------------------------- */

static bool
contains_time_explicitly(const orbit *o, qdot_expr e)
{
    return (qdot_expr_node(o->scene->pool, e)->holds & QDOT_HAS_TIME) != 0;
}

/* Whether accelerations, or what events set, depend explicitly on time. */
static bool
is_driven_by_time(const orbit *o)
{
    for (size_t i = 0; i < o->n; i++)
        if (contains_time_explicitly(o, o->v->a[i]))
            return true;
    for (size_t k = 0; k < o->scene->events.n; k++) {
        const qdot_event *e = &o->scene->events.at[k];

        for (size_t i = 0; i < e->targets.n; i++)
            if (contains_time_explicitly(o, e->left) || contains_time_explicitly(o, e->right) || contains_time_explicitly(o, e->values.at[i]))
                return true;
    }
    return false;
}

/* The value of e with all coordinates and velocities shifted a little, so that symmetry of the
 * orbit hides nothing. */
static qdot_expr
moved(const orbit *o, qdot_expr e)
{
    qdot_pool *pool = o->scene->pool;

    for (size_t i = 0; i < 2 * o->n && e != QDOT_NIL; i++) {
        const qdot_expr z = state_symbol(o->scene, i),
                        by = qdot_div(pool, qdot_expr_int(pool, (int64_t)i + 3),
                                      qdot_expr_int(pool, 256)),
                        to = qdot_add(pool, z, by);

        e = qdot_subs(pool, e, 1, &z, &to);
    }
    return e;
}

/* Check that an expression, at a given state, has the same value one period later. */
static qdot_status
check_same_after_period(orbit *o, qdot_expr of)
{
    qdot_pool *pool = o->scene->pool;
    const qdot_run_report *report = qdot_run_get_report(o->run);
    const double T = report->t1 - report->t0;
    const qdot_expr t = QDOT_T, later = qdot_add(pool, t, qdot_expr_of_double(pool, T)),
                    now = moved(o, of), after = qdot_subs(pool, now, 1, &t, &later),
                    e[2] = {now, qdot_sub(pool, after, now)};
    double most = 0, off = 0;

    QDOT_TRY(qdot_pool_check(pool));
    for (size_t k = 0; k < ASKED && after != now; k++) {
        const double at = report->t0 + T * (double)k / (ASKED + 0.385);
        double value[2];

        QDOT_TRY(qdot_run_values(o->run, 2, e, 1, &at, value, NULL));
        most = fmax(most, fabs(value[0]));
        off = isnan(value[1]) ? INFINITY : fmax(off, fabs(value[1]));
    }
    if (!(off <= same * most))
        return qdot_fail(QDOT_EINVAL,
                         "the equations do not have the period %.10g: they change with time", T);
    return QDOT_OK;
}

/* Check that accelerations and events have the period. An event without direction occurs where its
 * squared function is 0. */
static qdot_status
check_period(orbit *o)
{
    qdot_pool *pool = o->scene->pool;

    for (size_t i = 0; i < o->n; i++)
        QDOT_TRY(check_same_after_period(o, o->v->a[i]));
    for (size_t k = 0; k < o->scene->events.n; k++) {
        const qdot_event *e = &o->scene->events.at[k];
        qdot_expr g = qdot_sub(pool, e->left, e->right);

        if (e->targets.n == 0)
            continue;
        g = e->way == 0 ? qdot_mul(pool, g, g) : g;
        QDOT_TRY(check_same_after_period(o, qdot_variation_with_numbers(o->v, g)));
        for (size_t i = 0; i < e->targets.n; i++)
            QDOT_TRY(check_same_after_period(o, qdot_variation_with_numbers(o->v, e->values.at[i])));
    }
    return QDOT_OK;
}

qdot_status
qdot_floquet_is_lagrangian(qdot_scene *s, bool *yes)
{
    bool plain = true;

    *yes = s->dampers.n + s->dissipations.n + s->forces.n + s->torques.n + s->states.n == 0;
    for (size_t e = 0; e < s->events.n; e++)
        *yes = *yes && s->events.at[e].targets.n == 0;
    for (size_t c = 0; c < s->constraints.n; c++)
        plain = plain && s->constraints.at[c].kind == QDOT_HOLONOMIC;
    return *yes && !plain ? qdot_mech_is_holonomic(s, yes) : QDOT_OK;
}

/* --- multipliers and stability --------------------------------------------------------------- */

/* Make a multiplier real if its conjugate partner was made real: its imaginary part is within its error. */
static void
make_partners_real(qdot_floquet *x)
{
    for (size_t k = 0; k < x->n; k++) {
        size_t j = 0;

        while (j < x->n && (x->re[j] != x->re[k] || x->im[j] != -x->im[k]))
            j++;
        if (j < x->n)
            continue;
        x->error[k] += fabs(x->im[k]);
        x->im[k] = 0;
    }
}

/* Set to exactly 1 the `count` multipliers nearest to 1, which are 1 in theory. */
static void
set_trivial_multipliers(qdot_floquet *x, size_t count)
{
    for (x->trivial = 0; x->trivial < count && x->trivial < x->n; x->trivial++) {
        size_t best = x->n;
        double least = INFINITY;

        for (size_t k = 0; k < x->n; k++) {
            const double off = hypot(x->re[k] - 1, x->im[k]);

            if (x->error[k] != 0 && off < least) {
                least = off;
                best = k;
            }
        }
        if (best == x->n || least > fmax(near_one, 2 * x->error[best]))
            return; /* leave all unchanged: no multiplier is near 1 */
        x->re[best] = 1;
        x->im[best] = x->error[best] = 0;
    }
}

/* Whether multiplier k differs from all others by more than their errors. */
static bool
differs_from_others(const qdot_floquet *x, size_t k)
{
    for (size_t j = 0; j < x->n; j++)
        if (j != k && !(hypot(x->re[j] - x->re[k], x->im[j] - x->im[k]) >
                        2 * (x->error[j] + x->error[k])))
            return false;
    return true;
}

static void
floquet_judge(qdot_floquet *x)
{
    bool stable = true, inside = x->trivial == 0;

    x->verdict = QDOT_FLOQUET_UNDECIDED;
    for (size_t k = 0; k < x->n; k++)
        inside = inside && hypot(x->re[k], x->im[k]) + x->error[k] < 1;
    x->asymptotic = x->asymptotic || inside; /* a Lagrangian exp(c*t)*(T - V) also has damping */
    for (size_t k = 0; k < x->n; k++) {
        const double size = hypot(x->re[k], x->im[k]), error = x->error[k];

        if (error == 0)
            continue; /* this multiplier is exactly 1 for every orbit */
        if (size - surely * error > 1) {
            x->verdict = QDOT_FLOQUET_UNSTABLE;
            return;
        }
        stable =
            stable && (x->asymptotic ? size + error < 1
                                     : fabs(size - 1) <= 2 * error && differs_from_others(x, k));
    }
    if (stable)
        x->verdict = QDOT_FLOQUET_STABLE;
}

/* The multipliers: eigenvalues of the product of the matrices B, scaled so that the factors have
 * similar sizes. */
static qdot_status
find_eigenvalues(size_t K, size_t k, const double *B, const double *E, qdot_floquet *x)
{
    const size_t kk = k * k;
    double *sum = qdot_calloc(kk + k + 2 * K * kk + 1, sizeof *sum), *unit = sum + kk, *own = unit + k;
    qdot_status status;

    if (sum == NULL)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < K * kk; i++)
        sum[i % kk] += fabs(B[i]) + E[i]; /* sizes set the unit: an entry smaller than its error must not */
    qdot_balance(k, sum, unit);
    for (size_t i = 0; i < K * kk; i++) {
        const double by = unit[i % k] / unit[i % kk / k];

        own[i] = B[i] * by;
        own[K * kk + i] = E[i] * by;
    }
    status = qdot_eigenvalues_of_product(K, k, own, own + K * kk, x->re, x->im, x->error);
    qdot_free(sum);
    return status;
}

qdot_status
qdot_floquet_of(size_t K, size_t k, const double *B, const double *E, size_t trivial, bool asymptotic,
                qdot_floquet *x)
{
    x->n = k;
    x->asymptotic = asymptotic;
    x->re = qdot_calloc(3 * k + 1, sizeof *x->re);
    if (x->re == NULL)
        return QDOT_ENOMEM;
    x->im = x->re + k;
    x->error = x->im + k;
    QDOT_TRY(find_eigenvalues(K, k, B, E, x));
    set_trivial_multipliers(x, trivial);
    make_partners_real(x);
    qdot_eigenvalues_arrange(k, x->re, x->im, x->error);
    floquet_judge(x);
    return QDOT_OK;
}

/* Compute B, the segments' factors of the monodromy matrix, by the flow map with tolerance tol. */
static qdot_status
fill_transfer_matrices(orbit *o, double tol, double *B)
{
    const size_t z = 2 * o->n;
    const qdot_flow_orbit of = {.K = o->K, .t0 = o->t0, .T = o->T, .first = o->states, .others = o->states + z};

    qdot_flow_end(&o->flow);
    QDOT_TRY(qdot_flow_begin(&o->flow, o->scene, o->request, 0, NULL, QDOT_NIL, tol, o->T));
    for (size_t k = 0; k < o->K; k++) {
        QDOT_TRY(qdot_flow_go(&o->flow, o->states + k * z, NULL, qdot_flow_time(&of, k), qdot_flow_time(&of, k + 1), 1));
        memcpy(o->ends + k * z * z, o->flow.by, z * z * sizeof *o->ends);
    }
    return qdot_flow_factors(&o->flow, &of, o->ends, z * z, &o->c, B);
}

static qdot_status
find_multipliers(orbit *o, qdot_floquet *x)
{
    const size_t z = 2 * o->n;
    const qdot_flow_orbit of = {.K = o->K, .t0 = o->t0, .T = o->T, .first = o->states, .others = o->states + z};
    bool driven, rests, free;

    QDOT_TRY(qdot_floquet_is_lagrangian(o->scene, &free));
    QDOT_TRY(fill_transfer_matrices(o, qdot_flow_tolerance[1], o->E));
    QDOT_TRY(fill_transfer_matrices(o, qdot_flow_tolerance[0], o->B));
    qdot_flow_errors(o->K * o->c * o->c, o->B, o->E);
    o->v = qdot_response_variation(o->flow.response);
    driven = is_driven_by_time(o);
    QDOT_TRY(qdot_floquet_rests(o->scene, o->run, &rests));
    if (!rests) /* an orbit at rest has no sizes of states from which scales could be taken */
        QDOT_TRY(qdot_flow_rounding(&o->flow, &of, o->ends, z * z, o->size, o->E));
    return qdot_floquet_of(o->K, o->c, o->B, o->E, driven || rests ? 0 : free ? 2 : 1, !free, x);
}

/* --- closing the orbit --------------------------------------------------------------------------- */

/* Use the sizes of the states along the orbit as scales, if they differ much from each other or from 1. */
static qdot_status
scale_flow_by_states(orbit *o)
{
    if (!qdot_sizes_are_apart(2 * o->n, o->size) || o->request->scales != NULL)
        return QDOT_OK;
    o->scaled = *o->request;
    o->scaled.scales = o->size;
    o->request = &o->scaled;
    qdot_flow_end(&o->flow);
    QDOT_TRY(qdot_flow_begin(&o->flow, o->scene, o->request, 0, NULL, QDOT_NIL, qdot_flow_tolerance[0], o->T));
    return qdot_flow_segments_of_orbit(&o->flow, o->states, NULL, o->t0, o->T, o->size, &o->K);
}

/* Read the start and the period from the run, and choose the number of segments by how fast
 * neighbouring motions separate. */
static qdot_status
begin_orbit(orbit *o)
{
    const qdot_run_report *report = qdot_run_get_report(o->run);
    const size_t n = o->n, z = 2 * n, most = QDOT_FLOW_MOST_SEGMENTS;

    o->t0 = report->t0;
    o->T = report->t1 - report->t0;
    o->states = qdot_calloc(most * z * (1 + 3 * z) + z + 1, sizeof *o->states);
    if (o->states == NULL)
        return QDOT_ENOMEM;
    o->ends = o->states + most * z;
    o->B = o->ends + most * z * z;
    o->E = o->B + most * z * z;
    o->size = o->E + most * z * z;
    for (size_t i = 0; i < z; i++) {
        const qdot_expr e = state_symbol(o->scene, i);

        QDOT_TRY(qdot_run_values(o->run, 1, &e, 1, &report->t0, &o->states[i], NULL));
    }
    QDOT_TRY(qdot_flow_begin(&o->flow, o->scene, o->request, 0, NULL, QDOT_NIL, qdot_flow_tolerance[0], o->T));
    QDOT_TRY(qdot_flow_segments_of_orbit(&o->flow, o->states, NULL, o->t0, o->T, o->size, &o->K));
    QDOT_TRY(scale_flow_by_states(o));
    o->v = qdot_response_variation(o->flow.response);
    return QDOT_OK;
}

/* The states between segments, with start and period where all of it closes (shooting.h): of one segment whose run comes
 * back, the run's. off: how far it does not. */
static qdot_status
close_orbit(orbit *o, double off)
{
    const size_t z = 2 * o->n, k = z + !is_driven_by_time(o);
    qdot_pool *pool = o->scene->pool;
    qdot_expr *u = qdot_calloc(z + 1, sizeof *u);
    double *at = qdot_calloc(4 * (z + 1), sizeof *at), *const low = at + 2 * (z + 1), *const high = low + z + 1;
    qdot_shooting_of of = {.scene = o->scene, .request = o->request, .k = k, .unknowns = u, .start = u,
                           .low = low, .high = high, .segments = o->K, .followed = off < followed};
    qdot_shooting_result r = {.u = at, .error = at + z + 1, .states = o->states};
    qdot_status status = u && at ? QDOT_OK : QDOT_ENOMEM;
    double moved = 0;

    for (size_t i = 0; i < k && status == QDOT_OK; i++) {
        u[i] = i < z ? state_symbol(o->scene, i) : qdot_symbol_get(pool, QDOT_FORMAL, "T");
        at[i] = i < z ? o->states[i] : o->T;
        low[i] = -INFINITY;
        high[i] = INFINITY;
    }
    if (status == QDOT_OK) {
        of.period = k > z ? u[z] : qdot_expr_of_double(pool, o->T);
        status = qdot_pool_check(pool);
    }
    memcpy(o->ends, o->states, z * sizeof *o->ends);
    if (status == QDOT_OK)
        status = qdot_shooting_find(&of, &r);
    for (size_t i = 0; i < z && status == QDOT_OK; i++)
        moved = fmax(moved, fabs(at[i] - o->ends[i]) / fmax(fmin(1, o->size[i]), fabs(at[i])));
    if (status == QDOT_OK && !(r.found && moved < near_start))
        status = qdot_fail(QDOT_EFAILED, "the run ends %.2g off its start, and no orbit was found so near to it", off);
    if (status == QDOT_OK && k > z)
        o->T = at[z];
    qdot_free(u);
    qdot_free(at);
    return status;
}

/* --- the whole computation ----------------------------------------------------------------------- */

static qdot_status
follow_orbit(orbit *o, qdot_floquet *x)
{
    qdot_expr where;
    double off;

    QDOT_TRY(qdot_floquet_return(o->scene, o->run, &off, &where));
    QDOT_TRY(begin_orbit(o));
    QDOT_TRY(check_period(o));
    if (o->K > 1 || off > QDOT_FLOQUET_CLOSED)
        QDOT_TRY(close_orbit(o, off));
    return find_multipliers(o, x);
}

qdot_status
qdot_floquet_find(qdot_scene *scene, qdot_run *run, const qdot_run_request *request,
                  qdot_floquet *x)
{
    orbit o = {.scene = scene, .run = run, .request = request, .n = scene->coordinates.n};
    const qdot_status status = follow_orbit(&o, x);

    qdot_flow_end(&o.flow);
    qdot_free(o.states);
    return status;
}
