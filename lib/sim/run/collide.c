/* collide.c -- finds the pair that nearly collided in a run, and repeats the run in regularised coordinates. */
#include "sim/run/collide.h"

#include <math.h>
#include <string.h>

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/constant.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/node.h"
#include "expr/print.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "mech/dynamics/quantity.h"
#include "mech/scene/scene.h"
#include "normal/simplify/simplify.h"
#include "normal/solve/linear.h"
#include "sim/error/horizon.h"
#include "sim/model/substitute.h"
#include "sim/run/chart-run.h"
#include "sim/run/chart-start.h"

/* A run came near if R falls below so much of its largest value; one that arrived, if it was nearly
 * a collision. */
static const double near_place = 0.05, nearly = 1e-3;

/* The tolerance in s, of series and of other methods: u and R are small where velocities are large,
 * and steps are few. */
static const double tight = 1e-15, tight_by_points = 1e-13;

/* A run that came to its end is improved by one that may take so many times its work, and an allowance (in units of
 * about 1 ns). One that failed at the collision says nothing of the work to the end: there is no limit. */
static const double most_times = 4, allowance = 1e8;

/* Steps in s are long in t: they are stored in so many parts, if they are fewer than these, so that
 * what is near in time is near among the points. */
enum { parts = 8, most_refined = 64 };

/* The name of the event that ends the regularised run at the requested time. */
static const char *const at_end = "end#";

/* Lengths of s that are tried, in units of 2 (t1 - t0)/R at the start, what a bound motion takes
 * at most. */
static const double lengths[] = {8, 1e5};

/* --- choosing the pair ------------------------------------------------------------------------- */

/* A scene without polar coordinates, in which pairs of bodies that collide are searched for. */
typedef struct {
    qdot_run_chart *x;
    qdot_scene *scene; /* x->chart.scene, or the given scene */
    const qdot_run_request *request;
    double most_work; /* limit of the work of a run in regular coordinates; 0: none */
    qdot_expr *accels;
    qdot_collision_equations of;
} ground;

typedef qdot_vec(qdot_expr) causes;

/* List the potentials and forces of a scene, with numbers in place of parameters. */
static qdot_status
list_potentials_and_forces(const ground *g, const qdot_scene *s, causes *list)
{
    const qdot_run_request *r = g->request;

    QDOT_TRY(qdot_vec_push(list, s->lagrangian));
    for (size_t i = 0; i < s->potentials.n; i++)
        QDOT_TRY(qdot_vec_push(list, s->potentials.at[i].e));
    for (size_t i = 0; i < s->forces.n; i++)
        QDOT_TRY(qdot_vec_push(list, s->forces.at[i].force));
    for (size_t i = 0; i < s->torques.n; i++)
        QDOT_TRY(qdot_vec_push(list, s->torques.at[i].torque));
    for (size_t i = 0; i < list->n; i++)
        if (list->at[i] != QDOT_NIL)
            list->at[i] =
                qdot_substitute(s->pool, list->at[i], r->n_values, r->symbols, r->values);
    return qdot_pool_check(s->pool);
}

/* Whether a potential or force divides by an expression in coordinates; if not, no collision is searched for. */
static qdot_status
may_collide(const ground *g, const qdot_scene *s, bool *may)
{
    const qdot_collision_equations of = {
        .pool = s->pool, .n = s->coordinates.n, .q = s->coordinates.at};
    causes list = {0};
    qdot_status status = list_potentials_and_forces(g, s, &list);

    *may = false;
    for (size_t i = 0; i < list.n && status == QDOT_OK && !*may; i++)
        *may = list.at[i] != QDOT_NIL && qdot_collision_may(&of, list.at[i]);
    qdot_free(list.at);
    return status;
}

static qdot_expr
insert_numbers(const ground *g, qdot_expr e)
{
    qdot_pool *pool = g->scene->pool;

    e = qdot_substitute(pool, e, g->request->n_values, g->request->symbols,
                        g->request->values);
    return qdot_released(pool, e);
}

/* Solve M q'' = f with constant M for symbols in place of f, as the expressions f may be long. */
static qdot_status
solve_for_accelerations(const ground *g, qdot_expr M, qdot_expr f)
{
    qdot_pool *pool = g->scene->pool;
    const uint32_t n = (uint32_t)g->of.n;
    qdot_expr *A = qdot_calloc((size_t)n * n + 2 * n + 1, sizeof *A);
    qdot_expr *b = A ? A + (size_t)n * n : NULL;
    uint32_t pivot;
    qdot_status status = A ? QDOT_OK : QDOT_ENOMEM;

    for (uint32_t i = 0; i < n && A; i++) {
        char name[20];

        for (uint32_t j = 0; j < n; j++)
            A[i * n + j] = qdot_expr_arg(pool, M, i * n + j);
        snprintf(name, sizeof name, "f#%u", i);
        b[i] = qdot_symbol_get(pool, QDOT_FORMAL, name);
        b[n + i] = qdot_expr_arg(pool, f, i);
    }
    if (status == QDOT_OK)
        status = qdot_solve_linear(pool, n, A, b, g->accels, &pivot, NULL);
    for (uint32_t i = 0; i < n && status == QDOT_OK; i++)
        g->accels[i] = qdot_subs(pool, g->accels[i], n, b, b + n);
    qdot_free(A);
    return status;
}

static qdot_status
find_equations(ground *g)
{
    qdot_scene *s = g->scene;
    const size_t n = s->coordinates.n;
    const qdot_expr M = insert_numbers(g, qdot_mech_numeric_mass(s));
    bool numbers = true, conserved = false;

    g->accels = qdot_calloc(n + 1, sizeof *g->accels);
    if (!g->accels)
        return QDOT_ENOMEM;
    g->of =
        (qdot_collision_equations){s->pool, n, s->coordinates.at, g->accels, QDOT_NIL};
    QDOT_TRY(qdot_pool_check(s->pool));
    QDOT_TRY(qdot_mech_energy_conserved(g->x->chart.of, &conserved));
    if (conserved)
        g->of.energy = insert_numbers(g, qdot_mech_numeric_energy(s));
    for (uint32_t i = 0; i < n * n; i++)
        numbers =
            numbers && qdot_expr_kind(s->pool, qdot_expr_arg(s->pool, M, i)) == QDOT_NUM;
    if (numbers)
        return solve_for_accelerations(g, M, insert_numbers(g, qdot_mech_numeric_forcing(s)));
    for (size_t i = 0; i < n; i++)
        g->accels[i] = insert_numbers(g, qdot_mech_accel(s, s->coordinates.at[i]));
    return qdot_pool_check(s->pool);
}

/* The least R along the run, of its largest; where no digit of the run is right, only to the end of an
 * approach that began before: that may be what took them. */
static qdot_status
measure_pair_distance(const ground *g, qdot_run *run, const qdot_run_maker *by, qdot_expr distance,
                      double *near)
{
    const qdot_trajectory *tr = &run->course.tr;
    const qdot_expr e = qdot_chart_given(&g->x->chart, distance);
    double least = INFINITY, most = 0, *values = qdot_calloc(tr->count, sizeof *values);
    bool known = true;
    qdot_status status = values ? qdot_pool_check(g->x->chart.pool) : QDOT_ENOMEM;

    if (status == QDOT_OK)
        status = by->values(run, 1, &e, tr->count, tr->t, values, NULL);
    for (size_t k = 0; k < tr->count && status == QDOT_OK; k++) {
        known = known && (!qdot_horizon_passed(run, tr->t[k])
                          || (k > 0 && fabs(values[k]) <= fabs(values[k - 1])));
        if (known)
            least = fmin(least, fabs(values[k]));
        most = fmax(most, fabs(values[k]));
    }
    qdot_free(values);
    *near = status == QDOT_EDOMAIN
                ? 0
                : least / most; /* the distance is undefined at the singular place itself */
    return status == QDOT_EDOMAIN ? QDOT_OK : status;
}

/* Choose the pair of bodies that came closest in the run, relative to its largest distance; *found: there is one. */
static qdot_status
choose_closest_pair(const ground *g, qdot_run *run, const qdot_run_maker *by,
                    qdot_collision_pair *pair, bool *found)
{
    const qdot_scene *s = g->scene;
    const qdot_collision_equations of = {
        .pool = s->pool, .n = s->coordinates.n, .q = s->coordinates.at};
    qdot_collision_pairs pairs = {0};
    causes list = {0};
    double nearest = run->report.status == QDOT_RUN_FAILED ? near_place : nearly;
    qdot_status status = list_potentials_and_forces(g, s, &list);

    if (status == QDOT_OK)
        status = qdot_collision_find(&of, list.n, list.at, &pairs);
    *found = false;
    for (size_t i = 0; i < pairs.n && status == QDOT_OK; i++) {
        double near;

        status = measure_pair_distance(g, run, by, pairs.at[i].distance, &near);
        if (status != QDOT_OK || !(near < nearest))
            continue;
        nearest = near;
        *pair = pairs.at[i];
        *found = true;
    }
    qdot_free(pairs.at);
    qdot_free(list.at);
    return status;
}

/* --- the run over the regular variable s ------------------------------------------------------- */

/* Add the end time of the run as an event of the regularised scene, whose independent variable is s. */
static qdot_status
add_end_event(const ground *g)
{
    const qdot_collision *c = &g->x->collision;
    const qdot_event end = {.name = (char *)(uintptr_t)at_end,
                            .left = c->time,
                            .right = g->request->t1,
                            .stop = true};

    return qdot_scene_event(c->scene, &end);
}

/* The value at the run's start, an exact constant, of an expression in coordinates of g->scene and t. */
static qdot_expr
value_at_start(const ground *g, qdot_expr e)
{
    const qdot_expr now = QDOT_T;

    return qdot_chart_at_start(g->x->chart.of, g->request,
                               qdot_subs(g->scene->pool,
                                         qdot_chart_given(&g->x->chart, e), 1, &now,
                                         &g->request->t0));
}

/* A run with the regularising variable s in place of time: its length, start and scales. */
typedef struct {
    size_t n;         /* number of coordinates */
    double T, R, k;   /* duration T; distance R of the pair at the start; strength k of the attraction */
    double length;    /* length of the run in the variable s */
    qdot_expr *start; /* [2n] start q, then q' */
    double *scales;   /* [2n] scales of q, then q' */
} attempt;

/* What the motion is about: u at the start and at the collision, the times, velocities and energies of
 * an orbit of size R. Coordinates that are integrals alone are as large as they become. */
static qdot_status
find_regularised_scales(const ground *g, attempt *a)
{
    const qdot_collision *c = &g->x->collision;
    const size_t n = a->n, m = c->parts;
    double *s = a->scales, fast = sqrt(a->k), speed, energy;

    for (size_t i = 0; i < 2 * n; i++) {
        QDOT_TRY(qdot_constant_double(c->pool, a->start[i], s + i));
        s[i] = fabs(s[i]);
    }
    for (size_t i = 0; i < m; i++)
        fast = fmax(fast, s[n + i]);
    speed = 2 * fast / sqrt(a->R);
    energy = speed * speed;
    for (size_t i = 0; i < m; i++) {
        s[i] = sqrt(a->R);
        s[n + i] = fast;
    }
    s[m] = fabs(a->T);
    s[n + m] = a->R;
    s[m + 1] = energy * fabs(a->length);
    s[n + m + 1] = energy;
    for (size_t i = m + 2; i + 1 < n; i += 2) {
        s[n + i + 1] = fmax(s[n + i + 1], speed);
        s[i] = fmax(s[i], a->R);
        s[n + i] = a->R * s[n + i + 1];
        s[i + 1] = s[n + i + 1] * fabs(a->length);
    }
    return QDOT_OK;
}

static qdot_status
make_regularised_run(const ground *g, const qdot_run_maker *by, attempt *a, qdot_run **out)
{
    const qdot_collision *c = &g->x->collision;
    const bool by_series = strcmp(g->request->method, "auto") == 0 ||
                           strcmp(g->request->method, "taylor") == 0;
    qdot_run_request other = *g->request;
    char text[40];

    QDOT_TRY(find_regularised_scales(g, a));
    snprintf(text, sizeof text, "%.3g", fabs(a->length));
    other.t0 = QDOT_ZERO;
    other.t1 = qdot_expr_decimal(c->pool, text, strlen(text));
    if (a->length < 0)
        other.t1 = qdot_neg(c->pool, other.t1);
    other.q0 = a->start;
    other.v0 = a->start + a->n;
    other.q_named = other.v_named = NULL;
    other.scales = a->scales;
    other.apart = NULL;
    other.tol = fmin(other.tol, by_series ? tight : tight_by_points);
    other.by_clock = other.no_drifts = true;
    other.most_work = g->most_work;
    QDOT_TRY(qdot_pool_check(c->pool));
    return by->make(c->scene, &other, out);
}

/* Whether the run over s reached its end, or was stopped by an event of the given scene. */
static bool
reaches_end(const qdot_run *run)
{
    return run->report.status == QDOT_RUN_STOPPED && run->course.stopped_by != SIZE_MAX &&
           run->has_companion && run->has_twin;
}

static qdot_status
prepare_regularised_run(const ground *g, attempt *a)
{
    const qdot_collision *c = &g->x->collision;
    double t0, t1;

    a->start = qdot_calloc(2 * a->n + 1, sizeof *a->start);
    a->scales = qdot_calloc(2 * a->n + 1, sizeof *a->scales);
    if (!a->start || !a->scales)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < a->n; i++) {
        a->start[i] = value_at_start(g, c->q0.at[i]);
        a->start[a->n + i] = value_at_start(g, c->v0.at[i]);
    }
    QDOT_TRY(qdot_constant_double(c->pool, g->request->t0, &t0));
    QDOT_TRY(qdot_constant_double(c->pool, g->request->t1, &t1));
    QDOT_TRY(qdot_constant_double(c->pool, c->strength, &a->k));
    a->T = t1 - t0;
    return qdot_constant_double(c->pool, value_at_start(g, c->pair.distance), &a->R);
}

static qdot_status
run_in_regularised_time(const ground *g, const qdot_run_maker *by, qdot_run **out)
{
    attempt a = {.n = g->x->collision.scene->coordinates.n};
    qdot_status status = prepare_regularised_run(g, &a);
    bool too_long = false;

    for (size_t k = 0; status == QDOT_OK && !*out && !too_long && k < sizeof lengths / sizeof *lengths;
         k++) {
        a.length = lengths[k] * 2 * a.T / a.R;
        status = make_regularised_run(g, by, &a, out);
        if (status == QDOT_OK && reaches_end(*out))
            break;
        too_long = *out && g->most_work > 0 && (*out)->meter.work > g->most_work;
        by->free(*out);
        *out = NULL;
    }
    qdot_free(a.start);
    qdot_free(a.scales);
    return status;
}

/* --- the run as a function of t ---------------------------------------------------------------- */

static qdot_status
convert_occurrence_times(qdot_course *c, size_t clock, size_t end)
{
    qdot_trajectory_cursor *cursor;
    size_t left = 0;
    double *y = qdot_calloc(c->tr.n + 1, sizeof *y);
    qdot_status status =
        y ? qdot_trajectory_open(&c->tr, qdot_course_systems(c), &cursor) : QDOT_ENOMEM;

    if (status != QDOT_OK) {
        qdot_free(y);
        return status;
    }
    for (size_t i = 0; i < c->occurrences.n && status == QDOT_OK; i++) {
        qdot_occurrence o = c->occurrences.at[i];

        status = qdot_trajectory_read(cursor, o.t, y);
        o.t = y[clock];
        if (o.event != end)
            c->occurrences.at[left++] = o;
    }
    c->occurrences.n = left;
    qdot_trajectory_close(cursor);
    qdot_free(y);
    return status;
}

/* Convert a run over s to times t, which are its component `clock`; `end` is the event at t1. */
static qdot_status
convert_course_times(qdot_course *c, size_t clock, size_t end, double t1)
{
    if (c->tr.count == 0)
        return QDOT_OK;
    QDOT_TRY(convert_occurrence_times(c, clock, end));
    if (c->tr.count < most_refined)
        QDOT_TRY(qdot_trajectory_refine(&c->tr, qdot_course_systems(c), parts));
    QDOT_TRY(qdot_trajectory_by_clock(&c->tr, clock));
    if (c->stopped_by == end)
        c->tr.t[c->tr.count - 1] = t1;
    return QDOT_OK;
}

/* Replace a value of s in the report, such as the horizon, by the time t that corresponds to it. */
static qdot_status
convert_to_time(const qdot_run *run, size_t clock, double *t)
{
    double *y;
    qdot_status status;

    if (isnan(*t))
        return QDOT_OK;
    y = qdot_calloc(run->course.tr.n + 1, sizeof *y);
    status =
        y ? qdot_trajectory_at(&run->course.tr, qdot_course_systems(&run->course), *t, y)
          : QDOT_ENOMEM;
    if (status == QDOT_OK)
        *t = y[clock];
    qdot_free(y);
    return status;
}

/* Set the reason that an event of the given scene stopped the run, with the time t. */
static qdot_status
record_stop(qdot_run *run, double t)
{
    const char *cause = run->reason ? qdot_course_cause(run->reason) : NULL;
    qdot_text text = {0};
    qdot_status status;

    if (!cause)
        return QDOT_OK;
    qdot_text_format(&text, "stopped at t = %.15g: %s", t, cause);
    status = qdot_text_status(&text);
    if (status == QDOT_OK)
        status = qdot_run_say_why(run, qdot_text_str(&text));
    qdot_text_clear(&text);
    return status;
}

/* Convert all times and the horizon of a run over the regularising variable s to times t. */
static qdot_status
convert_run_times(const ground *g, qdot_run *run)
{
    const qdot_collision *c = &g->x->collision;
    qdot_run_report *r = &run->report;
    size_t clock = 0, end = 0;

    while (run->plan->inputs[clock] != c->time)
        clock++;
    while (strcmp(run->stage.events.at[end].name, at_end) != 0)
        end++;
    QDOT_TRY(qdot_constant_double(c->pool, g->request->t0, &run->t0));
    QDOT_TRY(qdot_constant_double(c->pool, g->request->t1, &run->t1));
    QDOT_TRY(convert_to_time(run, clock, &r->horizon));
    QDOT_TRY(convert_to_time(run, clock, &r->standstill));
    QDOT_TRY(convert_course_times(&run->course, clock, end, run->t1));
    QDOT_TRY(convert_course_times(&run->companion, clock, end, run->t1));
    QDOT_TRY(convert_course_times(&run->twin, clock, end, run->t1));
    run->t0_low = run->t1_low = 0;
    run->t0_side = run->t1_side = 0;
    r->tol = g->request->tol;
    r->t0 = run->t0;
    r->t1 = run->course.tr.t[run->course.tr.count - 1];
    if (run->course.stopped_by != end)
        return record_stop(run, r->t1);
    r->status = QDOT_RUN_DONE;
    r->reason = NULL;
    run->course.tr.result.outcome = QDOT_ODE_DONE;
    return QDOT_OK;
}

/* Measure the drift of the energy of the given scene, if the energy is conserved. */
static qdot_status
measure_energy_drift(const ground *g, const qdot_run_maker *by, qdot_run *run)
{
    const qdot_trajectory *tr = &run->course.tr;
    qdot_drift drift = {.name = "energy", .quantity = g->x->collision.energy};
    double *values;
    qdot_status status;

    if (drift.quantity == QDOT_NIL)
        return QDOT_OK;
    values = qdot_calloc(tr->count, sizeof *values);
    if (!values)
        return QDOT_ENOMEM;
    status = by->values(run, 1, &drift.quantity, tr->count, tr->t, values, NULL);
    for (size_t k = 0; k < tr->count; k++)
        drift.drift =
            fmax(drift.drift, fabs(values[k] - values[0]) / fmax(1, fabs(values[0])));
    drift.start = values[0];
    drift.kept = drift.drift == 0;
    qdot_free(values);
    return status == QDOT_OK ? qdot_drifts_set(&run->drifts, &drift) : qdot_grave(status);
}

static qdot_status
add_notice_of_collision(const ground *g, qdot_run *run)
{
    static const char *const names[] = {"u, R = u^2", "Levi-Civita's coordinates",
                                        "Kustaanheimo and Stiefel's coordinates"};
    const qdot_collision_pair *pair = &g->x->collision.pair;
    qdot_pool *pool = g->scene->pool;
    const qdot_facts facts = qdot_scene_facts(g->x->chart.of);
    const qdot_expr R =
        qdot_simplify(pool, qdot_chart_given(&g->x->chart, pair->distance), &facts);
    qdot_text distance = {0};
    qdot_status status = qdot_print(pool, R, QDOT_PLAIN, &distance);

    if (status == QDOT_OK)
        qdot_text_format(
            qdot_run_next_notice(run),
            "two points collide, or nearly: the run passes R = %s = 0 in %s, with "
            "dt = R ds, and values are given in the coordinates of the scene",
            qdot_text_str(&distance), names[pair->d - 1]);
    qdot_text_clear(&distance);
    return status == QDOT_OK ? qdot_text_status(&run->notice) : status;
}

/* Add a notice why the collision in the failed run is not passed. Without a force like 1/R^2 there
 * is no collision. */
static qdot_status
add_notice_of_hindrance(const ground *g, qdot_run *run)
{
    if (run->report.status != QDOT_RUN_FAILED || g->x->collision.strength == QDOT_ZERO)
        return QDOT_OK;
    qdot_text_format(qdot_run_next_notice(run), "the collision is not passed: %s",
                     g->x->collision.hindrance);
    return qdot_text_status(&run->notice);
}

/* --- the whole repetition ------------------------------------------------------------------------ */

/* Make the run with the given pair regularised; *out is NULL if it does not reach its end. */
static qdot_status
try_regularised_run(ground *g, const qdot_run_maker *by, const qdot_collision_pair *pair, qdot_run *run,
                    qdot_run **out)
{
    qdot_run_chart *x = g->x;
    double first;
    int sign;

    QDOT_TRY(qdot_chart_start_sign(x->chart.of, g->request,
                             qdot_chart_given(&x->chart, pair->x[0]), &sign, &first));
    QDOT_TRY(qdot_collision_make(g->scene, &g->of, pair, sign, &x->collision));
    if (!x->collision.scene)
        return add_notice_of_hindrance(g, run);
    if (x->collision.energy != QDOT_NIL)
        x->energy = qdot_mech_energy(x->chart.of);
    QDOT_TRY(add_end_event(g));
    QDOT_TRY(run_in_regularised_time(g, by, out));
    if (!*out)
        return QDOT_OK;
    QDOT_TRY(convert_run_times(g, *out));
    (*out)->chart = x;
    QDOT_TRY(measure_energy_drift(g, by, *out));
    QDOT_TRY(qdot_run_chart_report(*out, by));
    return add_notice_of_collision(g, *out);
}

qdot_status
qdot_run_collide(qdot_scene *s, const qdot_run_request *request, const qdot_run_maker *by,
                 qdot_run *run, qdot_run **out)
{
    ground g = {.request = request};
    qdot_collision_pair pair;
    bool found = false;
    qdot_status status;

    *out = NULL;
    if (s->constraints.n > 0 || !run)
        return QDOT_OK;
    if (run->report.status != QDOT_RUN_FAILED)
        g.most_work = most_times * run->meter.work + allowance;
    QDOT_TRY(may_collide(&g, s, &found));
    if (!found)
        return QDOT_OK;
    status = qdot_run_chart_open(s, request, &g.x);
    if (status == QDOT_OK) {
        g.scene = g.x->chart.scene ? g.x->chart.scene : s;
        status = choose_closest_pair(&g, run, by, &pair, &found);
    }
    if (status == QDOT_OK && found)
        status = find_equations(&g);
    if (status == QDOT_OK && found)
        status = try_regularised_run(&g, by, &pair, run, out);
    if (!*out || (*out)->chart != g.x)
        qdot_run_chart_free(g.x);
    qdot_free(g.accels);
    return status;
}
