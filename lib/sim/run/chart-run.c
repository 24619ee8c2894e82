/* chart-run.c -- follows angles continuously along a run in other coordinates; converts its end state back. */
#include "sim/run/chart-run.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/interrupt.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/symbol.h"
#include "sim/course/reader.h"

/* An angle is followed in steps below `sure`; a stretch ends where it is `far` from its quarters.
 * Each step of the run is looked at in `parts`. */
static const double sure = 0.8, far = 2.0, turn = 6.283185307179586;

/* If a singularity is nearer than this, relative to the largest distance so far, rounding decides
 * the direction. */
static const double no_direction = 1e-13;

/* The gradient of P is 0 if its square is below this part of its largest value: w^2 = P crosses
 * itself there. */
static const double no_slope = 1e-12;
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
qdot_run_chart_express(const qdot_run_chart *x, qdot_expr e, const int64_t *quarters, bool *turns)
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
    size_t m, n;  /* number of replaced coordinates; number of signs (of distances and of square roots) */
    double *xy;   /* [4 m + 2 n] x, y of the angles with all signs 1, -1; then the roots w, and
                     the squares of their slopes */
    double *now;  /* [m] the angles at time t, continued without jumps */
    double *next; /* [m] the angles at the next point that is inspected */
    double *most; /* [m + n] largest distance from a singular place so far; largest squared gradient of each root */
    int64_t *signs;  /* [n] the signs of distances and square roots at time t */
    uint64_t passed; /* bits: signs whose singular place is passed exactly at the next point */
    double t;
} following;

/* Whether the replaced coordinate m is an angle, which has to be followed along the run. */
static bool
turns(const qdot_chart_moved *m)
{
    return m->bare != QDOT_NIL;
}

/* Compute angle i of the point from the values x and y that were read along the run. */
static void
compute_angle(following *f, size_t i)
{
    const qdot_chart_moved *m = f->x->chart.moved.at + i;
    const bool minus = m->sign > 0 && f->signs[m->sign - 1] < 0;
    const double x = f->xy[4 * i + 2 * minus], size = f->xy[4 * i + 2 * minus + 1];
    const double y = m->factor == QDOT_NIL ? size : size * sin(0.5 * f->next[m->half]);

    f->next[i] = f->now[i];
    if (!turns(m) || !isfinite(x) || !isfinite(y))
        return;
    f->most[i] = fmax(f->most[i], hypot(x, y));
    if (!(hypot(x, y) > no_direction * f->most[i]))
        return;
    if (m->cut)
        f->next[i] = m->middle * turn / 2 + remainder(atan2(y, x) - m->middle * turn / 2, turn);
    else
        f->next[i] += remainder(atan2(y, x) - f->now[i], turn);
}

/* Whether the sign of a square root at t differs from its sign before t. */
static bool
has_root_changed_sign(const following *f)
{
    for (size_t i = 0; i < f->n; i++)
        if (f->x->chart.signs.at[i].branch && f->xy[4 * f->m + i] * (double)f->signs[i] < 0)
            return true;
    return false;
}

/* Continue each angle without a jump from its last value to the one just read; returns the largest change. */
static double
continue_angles(following *f)
{
    double change = 0;

    for (size_t i = 0; i < f->m; i++) {
        compute_angle(f, i);
        change = fmax(change, fabs(f->next[i] - f->now[i]));
    }
    return change;
}

static qdot_status
read_angles(following *f, double t, double *change)
{
    QDOT_TRY(qdot_reader_at(&f->reader, SIZE_MAX, t, f->xy));
    *change = continue_angles(f);
    for (size_t i = 0; i < f->n; i++)
        f->most[f->m + i] = fmax(f->most[f->m + i], f->xy[4 * f->m + f->n + i]);
    return QDOT_OK;
}

static qdot_status
begin_stretch(following *f, double t, const double *angles)
{
    const qdot_chart_stretch s = {t, f->passed, f->x->quarters.n};

    for (size_t i = 0; i < f->m; i++)
        QDOT_TRY(qdot_vec_push(&f->x->quarters, llround(4 * angles[i] / turn)));
    for (size_t i = 0; i < f->n; i++)
        QDOT_TRY(qdot_vec_push(&f->x->quarters, f->signs[i]));
    return qdot_vec_push(&f->x->stretches, s);
}

/* Go to t with the angles read there. They, or signs, jump where a singular place is passed
 * exactly. */
static qdot_status
advance_angles(following *f, double t, bool jumps)
{
    const qdot_chart_stretch *s = &f->x->stretches.at[f->x->stretches.n - 1];
    const int64_t *quarters = f->x->quarters.at + s->quarters;
    bool beyond = f->passed != 0;

    for (size_t i = 0; i < f->m; i++)
        beyond = beyond || (turns(f->x->chart.moved.at + i)
                            && fabs(f->next[i] - quarters[i] * turn / 4) > far);
    for (size_t i = 0; i < f->n; i++)
        beyond = beyond || f->signs[i] != quarters[f->m + i];
    if (beyond)
        QDOT_TRY(begin_stretch(f, jumps ? t : f->t, f->next));
    f->t = t;
    memcpy(f->now, f->next, f->m * sizeof *f->now);
    return QDOT_OK;
}

/* Where a singular place is passed exactly the sign of the distance changes, and angles go on: r
 * becomes -r. In a domain the sign stays, and angles jump by half a turn. Rounding beside the motion
 * turns that by up to 10^-16 over no_direction and more: what is nearer to half a turn than to none is
 * one. */
static void
change_passed_signs(following *f)
{
    const qdot_chart *c = &f->x->chart;

    for (size_t i = 0; i < f->m; i++) {
        const size_t k = c->moved.at[i].sign;

        if (k == 0 || !(fabs(f->next[i] - f->now[i]) > turn / 4))
            continue;
        if (k <= 64)
            f->passed |= (uint64_t)1 << (k - 1);
        if (c->signs.at[k - 1].fixed)
            continue;
        f->signs[k - 1] = -f->signs[k - 1];
        f->x->changes = true;
        (void)continue_angles(f);
    }
}

static void
change_root_signs(following *f)
{
    for (size_t i = 0; i < f->n; i++) {
        const int now = f->xy[4 * f->m + i] < 0 ? -1 : 1;

        if (!f->x->chart.signs.at[i].branch || now == f->signs[i])
            continue;
        f->signs[i] = now;
        if (!(f->xy[4 * f->m + f->n + i] > no_slope * f->most[f->m + i]))
            f->x->crosses = true;
    }
}

/* Turn those angles upwards that jump by about half a turn, so that rounding does not decide the direction. */
static void
resolve_half_turns(following *f)
{
    for (size_t i = 0; i < f->m; i++)
        if (!f->x->chart.moved.at[i].cut && f->next[i] - f->now[i] < -turn / 4)
            f->next[i] += turn;
}

/* Follow the angles up to the time `end`, in as many intervals as are needed for small changes. */
static qdot_status
follow_angles_to(following *f, double end)
{
    double t = end;

    while (f->t != end) {
        const double least = 4 * DBL_EPSILON * fmax(fabs(f->t), DBL_MIN);
        double change;
        bool jumps;

        QDOT_TRY(read_angles(f, t, &change));
        jumps = change > sure || has_root_changed_sign(f);
        if (jumps && fabs(t - f->t) > least) {
            t = f->t + 0.5 * (t - f->t);
            continue;
        }
        if (jumps) {
            change_root_signs(f);
            change_passed_signs(f);
            resolve_half_turns(f);
        }
        QDOT_TRY(advance_angles(f, t, jumps));
        f->passed = 0;
        t = end;
    }
    return QDOT_OK;
}

static qdot_status
follow_angles_along(following *f, const qdot_trajectory *tr)
{
    double change;

    f->t = tr->t[0];
    memcpy(f->now, f->x->angles, f->m * sizeof *f->now);
    QDOT_TRY(read_angles(f, f->t, &change));
    memcpy(f->now, f->next, f->m * sizeof *f->now);
    QDOT_TRY(begin_stretch(f, f->t, f->now));
    for (size_t k = 1; k < tr->count; k++)
        for (int j = 1; j <= parts; j++) {
            const double h = tr->t[k] - tr->t[k - 1];

            QDOT_TRY(qdot_interrupt_check());
            QDOT_TRY(follow_angles_to(f, j == parts ? tr->t[k] : tr->t[k - 1] + h * j / parts));
        }
    return QDOT_OK;
}

/* Write the expressions of angle i for signs +1 and -1: x and y, or the factor of the sine of half the angle. */
static void
write_angle_expressions(const qdot_run_chart *x, size_t i, const int64_t *quarters, qdot_expr *xy)
{
    const qdot_chart_moved *m = x->chart.moved.at + i;

    xy[0] = turns(m) ? qdot_run_chart_express(x, m->x, quarters, NULL) : QDOT_ONE;
    xy[1] = !turns(m) ? QDOT_ZERO
                      : qdot_run_chart_express(x, m->factor != QDOT_NIL ? m->factor : m->y,
                                               quarters, NULL);
}

/* The squared gradient of P, where the square root w has w^2 = P. */
static qdot_expr
squared_gradient(const qdot_chart *c, const qdot_chart_sign *s)
{
    qdot_expr sum = QDOT_ZERO;

    for (size_t i = 0; i < c->scene->coordinates.n; i++)
        sum = qdot_add(
            c->pool, sum,
            qdot_pow_int(c->pool, qdot_diff(c->pool, s->square, c->scene->coordinates.at[i]), 2));
    return sum;
}

/* Write the expressions read along the run, exprs [4 m + 2 n], in the order of the array following.xy. */
static qdot_status
write_all_expressions(const qdot_run_chart *x, qdot_expr *exprs)
{
    const qdot_chart *c = &x->chart;
    const size_t m = c->moved.n, n = c->signs.n;
    int64_t *quarters = qdot_calloc(m + n + 1, sizeof *quarters);

    if (!quarters)
        return QDOT_ENOMEM;
    for (int minus = 0; minus < 2; minus++) {
        for (size_t i = 0; i < n; i++)
            quarters[m + i] = minus ? -1 : 1;
        for (size_t i = 0; i < m; i++)
            write_angle_expressions(x, i, quarters, exprs + 4 * i + 2 * minus);
    }
    for (size_t i = 0; i < n; i++) {
        const qdot_chart_sign *s = c->signs.at + i;

        exprs[4 * m + i] = s->branch ? s->symbol : QDOT_ONE;
        exprs[4 * m + n + i] = s->branch ? squared_gradient(c, s) : QDOT_ONE;
    }
    qdot_free(quarters);
    return qdot_pool_check(c->pool);
}

static qdot_status
follow_all_angles(qdot_run *run)
{
    qdot_run_chart *x = run->chart;
    following f = {.x = x, .m = x->chart.moved.n, .n = x->chart.signs.n};
    const size_t size = 4 * f.m + 2 * f.n;
    qdot_expr *exprs = qdot_calloc(size + 1, sizeof *exprs);
    qdot_reading of = {0};
    qdot_status status;

    f.xy = qdot_calloc(size + 3 * f.m + f.n + 1, sizeof *f.xy);
    f.signs = qdot_calloc(f.n + 1, sizeof *f.signs);
    status = f.xy && f.signs && exprs ? write_all_expressions(x, exprs) : QDOT_ENOMEM;
    if (status == QDOT_OK)
        status = qdot_reader_lower(run->plan, size, exprs, &of);
    if (status == QDOT_OK)
        status = qdot_reader_init(&f.reader, &of, &run->course);
    if (status == QDOT_OK) {
        f.now = f.xy + size;
        f.next = f.now + f.m;
        f.most = f.next + f.m;
        for (size_t i = 0; i < f.n; i++)
            f.signs[i] = x->chart.signs.at[i].start;
        status = follow_angles_along(&f, &run->course.tr);
    }
    qdot_reader_clear(&f.reader);
    qdot_tape_free(of.tape);
    qdot_free(f.xy);
    qdot_free(f.signs);
    qdot_free(exprs);
    x->followed = status == QDOT_OK;
    return status;
}

/* The first time of the run at which the given coordinates have values. */
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
qdot_run_chart_follow(qdot_run *run)
{
    qdot_run_chart *x = run->chart;

    if (x->followed)
        return QDOT_OK;
    x->stretches.n = x->quarters.n = 0;
    return follow_all_angles(run);
}

qdot_status
qdot_run_chart_quarters(qdot_run *run, double t, const int64_t **quarters)
{
    qdot_run_chart *x = run->chart;
    const bool back = qdot_trajectory_is_backward(&run->course.tr);
    size_t low = 0, high;

    QDOT_TRY(qdot_run_chart_follow(run));
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

/* --- the end state in the report ----------------------------------------------------------- */

/* Read component i of the end state (q or q') with its error; velocities may be undefined at a singularity. */
static qdot_status
read_end_value(qdot_run *run, const qdot_run_maker *by, size_t i, double *error)
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

        QDOT_TRY(read_end_value(run, by, i, &error));
        error /= fmax(1, fabs(x->end[i]));
        largest = isnan(error) || isnan(largest) ? NAN : fmax(largest, error);
    }
    if (!isnan(r->error))
        r->error = largest;
    r->scaled_error = r->error;
    r->scales = NULL; /* no scales: they belong to the coordinates of the chart */
    r->n = x->n;
    r->coordinates = x->coordinates;
    r->q = x->end;
    r->v = x->end + x->n;
    r->drifts = run->drifts.at;
    r->n_drifts = run->drifts.energy ? 1 : 0;
    r->energy_drift = run->drifts.energy ? run->drifts.at[0].drift : NAN;
    r->m = r->independent = 0; /* no multipliers: the constraints exist only in the chart */
    r->constraint_drift = r->velocity_drift = NAN;
    return QDOT_OK;
}
