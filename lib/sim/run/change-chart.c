/* change-chart.c -- decides which runs are repeated in other coordinates (charts), and makes those requests. */
#include "sim/run/change-chart.h"

#include <math.h>
#include <string.h>

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/symbol.h"
#include "sim/course/reader.h"
#include "sim/run/chart-run.h"
#include "sim/run/chart-start.h"
#include "sim/run/collide.h"

/* A run came near a coordinate singularity if the distance N falls below this part of its largest
 * value, or of 1. */
static const double near_place = 0.05;

/* The number of points within each integration step at which a distance from a singular place is computed. */
enum { parts = 8 };

/* Rounding held the steps so far above their tolerance, or the error is so large, that other
 * coordinates may do better. */
static const double poor = 100, poor_error = 1000, least_poor = 1e-9;

/* --- choosing groups of coordinates ---------------------------------------------------------- */

/* A distance from a singular place: its sign at the start, its least and largest magnitude along a run. */
typedef struct {
    int sign;
    double least, most;
} nearness;

static qdot_status
measure_at_start(const qdot_scene *s, const qdot_run_request *request, const qdot_run *run,
                 qdot_expr distance, nearness *x)
{
    double value;

    QDOT_TRY(qdot_chart_start_sign(s, request, distance, &x->sign, &value));
    x->least = fabs(value);
    x->most = run ? x->least : 1; /* without a run M was singular at the start in doubles, so the singular place is near */
    return QDOT_OK;
}

static qdot_status
measure_at_time(qdot_reader *r, double t, double *before, nearness *x)
{
    double value;
    const qdot_status status = qdot_reader_at(r, SIZE_MAX, t, &value);

    if (qdot_reader_has_nothing(status)) {
        x->least = 0; /* the distance is undefined: the run is at a place where M is singular */
        return QDOT_OK;
    }
    QDOT_TRY(status);
    x->least = !(value * *before > 0) ? 0 : fmin(x->least, fabs(value));
    x->most = fmax(x->most, fabs(value));
    *before = value;
    return QDOT_OK;
}

/* Measure the distance from a singular place along a run; if its sign changes, it is 0 between two points. */
static qdot_status
measure_along_run(const qdot_run *run, qdot_expr distance, nearness *x)
{
    const qdot_trajectory *tr = &run->course.tr;
    qdot_reader r = {0};
    qdot_reading of = {0};
    double before = x->sign;
    qdot_status status = qdot_reader_lower(run->plan, 1, &distance, &of);

    if (status == QDOT_OK)
        status = qdot_reader_init(&r, &of, &run->course);
    if (status == QDOT_OK)
        status = measure_at_time(&r, tr->t[0], &before, x);
    for (size_t k = 1; k < tr->count; k++)
        for (int j = 1; j <= parts && status == QDOT_OK; j++)
            status = measure_at_time(
                &r, j == parts ? tr->t[k] : tr->t[k - 1] + (tr->t[k] - tr->t[k - 1]) * j / parts,
                &before, x);
    qdot_reader_clear(&r);
    qdot_tape_free(of.tape);
    return status;
}

/* Put the groups whose singular place was near before the others: *near of them; and the signs
 * [groups] of their distances. *at_place: the start, of which no run could be made, is one. */
static qdot_status
choose_coordinate_groups(qdot_scene *s, const qdot_run_request *request, const qdot_run *run,
                         qdot_chart_groups *groups, int *sign, size_t *near, bool *at_place)
{
    *near = 0;
    for (size_t i = 0; i < groups->n; i++) {
        const qdot_chart_group g = groups->at[i];
        nearness x;

        QDOT_TRY(measure_at_start(s, request, run, g.distance, &x));
        if (run)
            QDOT_TRY(measure_along_run(run, g.distance, &x));
        sign[i] = x.sign;
        if (!(x.least <= near_place * fmin(1, x.most)))
            continue;
        *at_place |= !run && x.least == 0;
        groups->at[i] = groups->at[*near];
        sign[i] = sign[*near];
        groups->at[*near] = g;
        sign[(*near)++] = x.sign;
    }
    return QDOT_OK;
}

/* --- the run in the chart ---------------------------------------------------------------------- */

/* Write the start in the new coordinates: exact constants, in the order of the coordinates of the chart's scene. */
static qdot_status
write_start_in_chart(const qdot_chart *c, const qdot_run_request *request, qdot_expr *q0,
                     qdot_expr *v0)
{
    const qdot_scene *to = c->scene, *s = c->of;

    for (size_t i = 0; i < to->coordinates.n; i++) {
        qdot_expr given = to->coordinates.at[i];

        for (size_t k = 0; k < c->fresh.n; k++)
            if (c->fresh.at[k].q == given)
                given = c->fresh.at[k].given;
        q0[i] = qdot_chart_at_start(s, request, given);
        v0[i] = qdot_chart_at_start(s, request, qdot_ddt(s->pool, given));
    }
    return qdot_pool_check(s->pool);
}

/* Make the run in other coordinates; *run is NULL if that run does not reach its end. */
static qdot_status
make_run_in_chart(qdot_run_chart *x, const qdot_run_request *request, const qdot_run_maker *by,
                  qdot_run **run)
{
    qdot_run_request other = *request;
    const size_t n = x->chart.scene->coordinates.n;
    qdot_expr *q0 = qdot_calloc(2 * n + 1, sizeof *q0);
    qdot_status status = q0 ? write_start_in_chart(&x->chart, request, q0, q0 + n) : QDOT_ENOMEM;

    *run = NULL;
    other.q0 = q0;
    other.v0 = q0 + n;
    other.q_named = other.v_named = NULL;
    other.scales = other.apart = NULL;
    if (status == QDOT_OK)
        status = by->make(x->chart.scene, &other, run);
    qdot_free(q0);
    if (status == QDOT_OK && (*run)->report.status != QDOT_RUN_FAILED)
        return QDOT_OK;
    by->free(*run);
    *run = NULL;
    return status;
}

/* Add a notice of the times at which the run leaves the region where a square root's sign is valid. */
static qdot_status
add_notice_of_branches(qdot_run *run)
{
    const qdot_run_chart *x = run->chart;
    const qdot_chart *c = &x->chart;

    for (size_t i = 0; i < c->signs.n; i++) {
        size_t k = 0;

        if (!c->signs.at[i].branch)
            continue;
        while (k < x->stretches.n
               && x->quarters.at[x->stretches.at[k].quarters + c->moved.n + i] > 0)
            k++;
        if (k < x->stretches.n)
            qdot_text_format(
                qdot_run_next_notice(run),
                "at t = %.9g the motion passes the place where %.100s is 0 and continues at "
                "places that it cannot describe: expressions with it have no value there",
                x->stretches.at[k].t, qdot_expr_symbol(c->pool, c->signs.at[i].symbol)->name);
    }
    return QDOT_OK;
}

static qdot_status
add_notice_of_chart(qdot_run *run)
{
    qdot_text_format(
        qdot_run_next_notice(run),
        "the coordinates become singular on the way: the run is in %s, and values "
        "are given in the coordinates of the scene",
        qdot_text_str(&run->chart->chart.names));
    QDOT_TRY(add_notice_of_branches(run));
    return qdot_text_status(&run->notice);
}

/* Whether the run is valid only as long as signs (of square roots, of distances in events) do not change. */
static bool
depends_on_root_signs(const qdot_chart *c)
{
    bool depends = c->signed_events;

    for (size_t i = 0; i < c->signs.n; i++)
        depends = depends || c->signs.at[i].branch;
    return depends;
}

/* Whether an event used a sign that has changed, or the motion passed a point where its direction
 * is undefined. */
static bool
is_chart_invalid(const qdot_run_chart *x)
{
    return x->crosses || (x->chart.signed_events && x->changes);
}

/* Make the run with these groups replaced; *out NULL where it does not arrive. at_place: it begins
 * at a singular place. */
static qdot_status
run_with_replaced_groups(qdot_scene *s, const qdot_run_request *request, const qdot_run_maker *by,
                         const qdot_chart_groups *groups, const int *sign, bool at_place,
                         qdot_run **out)
{
    qdot_run_chart *x = NULL;
    qdot_status status = qdot_run_chart_new(s, request, groups, sign, false, &x);

    if (status == QDOT_OK && x->chart.scene)
        status = make_run_in_chart(x, request, by, out);
    if (*out) {
        x->at_place = at_place;
        (*out)->chart = x;
        x = NULL;
        status = qdot_run_chart_report(*out, by);
        if (status == QDOT_OK && depends_on_root_signs(&(*out)->chart->chart))
            status = qdot_run_chart_follow(*out);
        if (status == QDOT_OK && is_chart_invalid((*out)->chart)) {
            by->free(*out);
            *out = NULL;
        } else if (status == QDOT_OK) {
            status = add_notice_of_chart(*out);
        }
    }
    qdot_run_chart_free(x);
    return status;
}

/* Make the run in another chart, if there is one; *out NULL where there is none, or no run. The
 * groups that were not near may come to be so later: if the run without those that were fails, all
 * are replaced. */
static qdot_status
change_chart(qdot_scene *s, const qdot_run_request *request, const qdot_run_maker *by,
             const qdot_run *run, qdot_run **out)
{
    qdot_chart_groups groups = {0};
    size_t near = 0;
    int *sign = NULL;
    bool at_place = false;
    qdot_status status = qdot_chart_find(s, false, &groups);

    *out = NULL;
    if (status == QDOT_OK && groups.n > 0) {
        sign = qdot_calloc(groups.n, sizeof *sign);
        status =
            sign ? choose_coordinate_groups(s, request, run, &groups, sign, &near, &at_place) : QDOT_ENOMEM;
    }
    if (status == QDOT_OK && near > 0) {
        const qdot_chart_groups first = {.n = near, .at = groups.at};

        status = run_with_replaced_groups(s, request, by, &first, sign, at_place, out);
        if (!*out && near < groups.n && status != QDOT_ENOMEM && status != QDOT_EINTR)
            status = run_with_replaced_groups(s, request, by, &groups, sign, at_place, out);
    }
    qdot_free(groups.at);
    qdot_free(sign);
    return status;
}

/* Whether other coordinates may be worth while: too of a run that was made under a tighter tolerance than asked for
 * (tighter-run.h), and errs by 10^-6 nevertheless. */
static bool
has_poor_accuracy(const qdot_run *run, double tol)
{
    return run->report.status == QDOT_RUN_FAILED || isnan(run->report.error) ||
           run->course.tr.result.stats.raised > poor * tol ||
           run->report.error > poor_error * fmin(tol, fmax(run->report.tol, least_poor));
}

/* Whether a run that arrived has passed through a place where the chart's reading turns: (theta, phi)
 * and (-theta, phi + pi) are one point, and its own coordinates may take the other way. Where no digit
 * of its end is right, that tells nothing. */
static bool
has_other_events(const qdot_run *other, const qdot_run *run)
{
    const qdot_trajectory *tr = &run->course.tr;
    const double *own = tr->y + (tr->count - 1) * tr->n;
    bool another = false;

    for (size_t i = 0; i < other->chart->n && i < run->plan->n; i++)
        another = another || fabs(own[i] - other->chart->end[i]) > 1;
    return another && !run->hidden && isnan(run->report.horizon);
}

static bool
is_better_run(const qdot_run *other, const qdot_run *run)
{
    if (!run || run->report.status == QDOT_RUN_FAILED)
        return true;
    if (!isnan(run->report.error) && has_other_events(other, run))
        return false;
    return other->report.error < run->report.error ||
           (isnan(run->report.error) && !isnan(other->report.error));
}

/* Apply change_chart to the start that the run has projected onto the constraints, if it has such a start. */
static qdot_status
change_chart_at_projected_start(qdot_scene *s, const qdot_run_request *request, const qdot_run_maker *by,
                                qdot_run *run, qdot_run **out)
{
    const size_t n = s->coordinates.n;
    qdot_run_request settled = *request;
    qdot_expr *start;
    qdot_status status;

    if (s->constraints.n == 0 || !run || !run->start)
        return change_chart(s, request, by, run, out);
    start = qdot_calloc(2 * n + 1, sizeof *start);
    if (!start)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < 2 * n; i++)
        start[i] = qdot_add(s->pool, qdot_expr_of_double(s->pool, run->start[i]),
                            qdot_expr_of_double(s->pool, run->start_low[i]));
    settled.q0 = start;
    settled.v0 = start + n;
    status = qdot_pool_check(s->pool);
    if (status == QDOT_OK)
        status = change_chart(s, &settled, by, run, out);
    qdot_free(start);
    return status;
}

/* Replace *run by `other` if that is the better run; free the worse one. */
static void
keep_better_run(const qdot_run_maker *by, qdot_run *other, qdot_run **run)
{
    qdot_run *worse = other;

    if (other && is_better_run(other, *run)) {
        worse = *run;
        *run = other;
    }
    by->free(worse);
}

qdot_status
qdot_run_change_chart(qdot_scene *s, const qdot_run_request *request,
                      const qdot_run_maker *by, qdot_status began, qdot_run **run)
{
    const qdot_error before = *qdot_last_error();

    if (request->n_states > 0 || (*run ? began != QDOT_OK || !has_poor_accuracy(*run, request->tol)
                                       : began != QDOT_ESINGULAR))
        return began;
    for (int way = 0; way < 2 && (way == 0 || (*run && has_poor_accuracy(*run, request->tol))); way++) {
        qdot_run *other = NULL;
        const qdot_status status =
            (way == 0 ? change_chart_at_projected_start : qdot_run_collide)(s, request, by, *run, &other);

        if (status == QDOT_OK)
            keep_better_run(by, other, run);
        else
            by->free(other);
        if (status == QDOT_ENOMEM || status == QDOT_EINTR)
            return status;
    }
    if (*run && (*run)->chart)
        return QDOT_OK;
    qdot_fail_again(&before);
    return began;
}
