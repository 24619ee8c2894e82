/* chart-run.c -- angles continued along a run, and the end state in the coordinates given. */
#include "sim/run/chart-run.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/interrupt.h"
#include "sim/course/reader.h"

/* An angle is followed in steps below `sure`; a stretch ends where it is `far` from its quarters.
 * Each step of the run is looked at in `parts`. */
static const double sure = 0.8, far = 2.0, turn = 6.283185307179586;

/* As near a singular place, of the largest distance so far, rounding decides the direction. */
static const double no_direction = 1e-13;
enum { parts = 16 };

void
qdot_run_chart_free(qdot_run_chart *x)
{
    if (!x)
        return;
    qdot_chart_clear(&x->chart);
    qdot_collision_clear(&x->collision);
    qdot_free(x->coordinates);
    qdot_free(x->angles);
    qdot_free(x->end);
    qdot_free(x->stretches.at);
    qdot_free(x->quarters.at);
    qdot_free(x);
}

qdot_expr
qdot_run_chart_express(const qdot_run_chart *x, qdot_expr e, const long *quarters,
                       bool *turns)
{
    if (e == x->energy && e != QDOT_NIL) {
        if (turns)
            *turns = false;
        return x->collision.energy;
    }
    e = qdot_chart_express(&x->chart, e, quarters, turns);
    return x->collision.scene ? qdot_collision_express(&x->collision, e) : e;
}

/* --- following the angles ------------------------------------------------------------------ */

typedef struct {
    qdot_run_chart *x;
    qdot_reader reader;
    size_t m;     /* moved coordinates */
    double *xy;   /* [2 m] */
    double *now;  /* [m] the angles at `t`, continued, */
    double *next; /* [m] and those read */
    double *most; /* [m] the largest distance so far */
    double t;
} following;

/* Read the angles at t, each continued from those now; the largest change. */
static qdot_status
look(following *f, double t, double *change)
{
    QDOT_TRY(qdot_reader_at(&f->reader, SIZE_MAX, t, f->xy));
    *change = 0;
    for (size_t i = 0; i < f->m; i++) {
        const double x = f->xy[2 * i], y = f->xy[2 * i + 1];

        f->next[i] = f->now[i];
        if (!f->x->chart.moved.at[i].angle || !isfinite(x) || !isfinite(y))
            continue;
        f->most[i] = fmax(f->most[i], hypot(x, y));
        if (!(hypot(x, y) > no_direction * f->most[i]))
            continue;
        f->next[i] += remainder(atan2(y, x) - f->now[i], turn);
        *change = fmax(*change, fabs(f->next[i] - f->now[i]));
    }
    return QDOT_OK;
}

static qdot_status
begin_stretch(following *f, double t, const double *angles)
{
    const qdot_chart_stretch s = {t, f->x->quarters.n};

    for (size_t i = 0; i < f->m; i++)
        QDOT_TRY(qdot_vec_push(&f->x->quarters, lround(4 * angles[i] / turn)));
    return qdot_vec_push(&f->x->stretches, s);
}

/* Go to t with the angles read there. They jump where a singular place is passed exactly. */
static qdot_status
go(following *f, double t, bool jumps)
{
    const qdot_chart_stretch *s = &f->x->stretches.at[f->x->stretches.n - 1];
    const long *quarters = f->x->quarters.at + s->quarters;
    bool beyond = false;

    for (size_t i = 0; i < f->m; i++)
        beyond = beyond || fabs(f->next[i] - quarters[i] * turn / 4) > far;
    if (beyond)
        QDOT_TRY(begin_stretch(f, jumps ? t : f->t, f->next));
    f->t = t;
    memcpy(f->now, f->next, f->m * sizeof *f->now);
    return QDOT_OK;
}

/* Where a singular place is passed exactly angles jump by half a turn: upward, whatever rounding
 * says. */
static void
half_turns(following *f)
{
    for (size_t i = 0; i < f->m; i++)
        if (f->next[i] - f->now[i] < -turn / 2 * (1 - 1e-3))
            f->next[i] += turn;
}

/* Follow to t, in as many parts as it takes. */
static qdot_status
follow_to(following *f, double end)
{
    double t = end;

    while (f->t != end) {
        const double least = 4 * DBL_EPSILON * fmax(fabs(f->t), DBL_MIN);
        double change;
        bool jumps;

        QDOT_TRY(look(f, t, &change));
        jumps = change > sure;
        if (jumps && fabs(t - f->t) > least) {
            t = f->t + 0.5 * (t - f->t);
            continue;
        }
        if (jumps)
            half_turns(f);
        QDOT_TRY(go(f, t, jumps));
        t = end;
    }
    return QDOT_OK;
}

static qdot_status
follow_run(following *f, const qdot_trajectory *tr)
{
    double change;

    f->t = tr->t[0];
    memcpy(f->now, f->x->angles, f->m * sizeof *f->now);
    QDOT_TRY(look(f, f->t, &change));
    memcpy(f->now, f->next, f->m * sizeof *f->now);
    QDOT_TRY(begin_stretch(f, f->t, f->now));
    for (size_t k = 1; k < tr->count; k++)
        for (int j = 1; j <= parts; j++) {
            const double h = tr->t[k] - tr->t[k - 1];

            QDOT_TRY(qdot_interrupt_check());
            QDOT_TRY(follow_to(f, j == parts ? tr->t[k] : tr->t[k - 1] + h * j / parts));
        }
    return QDOT_OK;
}

static qdot_status
follow(qdot_run *run)
{
    qdot_run_chart *x = run->chart;
    following f = {.x = x, .m = x->chart.moved.n};
    qdot_expr *xy = qdot_calloc(2 * f.m + 1, sizeof *xy);
    qdot_reading of = {0};
    qdot_status status;

    f.xy = qdot_calloc(5 * f.m + 1, sizeof *f.xy);
    status = f.xy && xy ? QDOT_OK : QDOT_ENOMEM;
    for (size_t i = 0; i < f.m && status == QDOT_OK; i++) {
        const qdot_chart_moved *moved = x->chart.moved.at + i;

        xy[2 * i] =
            moved->angle ? qdot_run_chart_express(x, moved->x, NULL, NULL) : QDOT_ONE;
        xy[2 * i + 1] =
            moved->angle ? qdot_run_chart_express(x, moved->y, NULL, NULL) : QDOT_ZERO;
        status = qdot_pool_check(x->chart.pool);
    }
    if (status == QDOT_OK)
        status = qdot_reader_lower(run->plan, 2 * f.m, xy, &of);
    if (status == QDOT_OK)
        status = qdot_reader_init(&f.reader, &of, &run->course);
    if (status == QDOT_OK) {
        f.now = f.xy + 2 * f.m;
        f.next = f.now + f.m;
        f.most = f.next + f.m;
        status = follow_run(&f, &run->course.tr);
    }
    qdot_reader_clear(&f.reader);
    qdot_tape_free(of.tape);
    qdot_free(f.xy);
    qdot_free(xy);
    x->followed = status == QDOT_OK;
    return status;
}

/* The first time at which the coordinates given have values. */
static double
first_time(const qdot_run *run)
{
    const qdot_trajectory *tr = &run->course.tr;

    return run->chart->at_place ? nextafter(tr->t[0], tr->t[tr->count - 1]) : tr->t[0];
}

void
qdot_run_chart_limit(qdot_run *run)
{
    run->limited = run->chart->at_place;
    run->within[0] = first_time(run);
    run->within[1] = run->course.tr.t[run->course.tr.count - 1];
}

qdot_status
qdot_run_chart_quarters(qdot_run *run, double t, const long **quarters)
{
    qdot_run_chart *x = run->chart;
    const bool back = qdot_trajectory_is_backward(&run->course.tr);
    size_t low = 0, high;

    if (!x->followed) {
        x->stretches.n = x->quarters.n = 0;
        QDOT_TRY(follow(run));
    }
    for (high = x->stretches.n; high - low > 1;) {
        const size_t middle = low + (high - low) / 2;

        if (back ? x->stretches.at[middle].t >= t : x->stretches.at[middle].t <= t)
            low = middle;
        else
            high = middle;
    }
    *quarters = x->quarters.at + x->stretches.at[low].quarters;
    run->limited = true;
    run->within[0] = low == 0 ? first_time(run) : x->stretches.at[low].t;
    run->within[1] = low + 1 < x->stretches.n
                         ? x->stretches.at[low + 1].t
                         : run->course.tr.t[run->course.tr.count - 1];
    return QDOT_OK;
}

/* --- the report ---------------------------------------------------------------------------- */

/* A velocity may be undefined at a singular place. */
static qdot_status
read_end(qdot_run *run, const qdot_run_maker *by, size_t i, double *error)
{
    qdot_run_chart *x = run->chart;
    const qdot_expr q = x->coordinates[i % x->n];
    const qdot_expr e = i < x->n ? q : qdot_symbol_jet(run->plan->pool, q, 1);
    const qdot_status status =
        by->values(run, 1, &e, 1, &run->report.t1, x->end + i, error);

    if (status != QDOT_EDOMAIN)
        return status;
    x->end[i] = *error = NAN;
    return QDOT_OK;
}

qdot_status
qdot_run_chart_report(qdot_run *run, const qdot_run_maker *by)
{
    qdot_run_chart *x = run->chart;
    qdot_run_report *r = &run->report;
    double largest = 0;

    x->end = qdot_calloc(2 * x->n + 1, sizeof *x->end);
    if (!x->end)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < 2 * x->n; i++) {
        double error = NAN;

        QDOT_TRY(read_end(run, by, i, &error));
        error /= fmax(1, fabs(x->end[i]));
        largest = isnan(error) || isnan(largest) ? NAN : fmax(largest, error);
    }
    if (!isnan(r->error))
        r->error = largest;
    r->scaled_error = r->error;
    r->scales = NULL; /* those of the chart */
    r->n = x->n;
    r->coordinates = x->coordinates;
    r->q = x->end;
    r->v = x->end + x->n;
    r->drifts = run->drifts.at;
    r->n_drifts = run->drifts.energy ? 1 : 0;
    r->energy_drift = run->drifts.energy ? run->drifts.at[0].drift : NAN;
    r->m = r->independent = 0; /* those of the chart alone */
    r->constraint_drift = r->velocity_drift = NAN;
    return QDOT_OK;
}
