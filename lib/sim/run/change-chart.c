/* change-chart.c -- which runs are made in another chart, and the request for it. */
#include "sim/run/change-chart.h"

#include <math.h>
#include <string.h>

#include "expr/calculus.h"
#include "sim/course/reader.h"
#include "sim/run/chart-run.h"
#include "sim/run/chart-start.h"
#include "sim/run/collide.h"

/* A run came near a singular place if N falls below so much of its largest value, or of 1. */
static const double near_place = 0.05;

/* Rounding held the steps so far above their tolerance, or the error is so large, that other
 * coordinates may do better. */
static const double poor = 100, poor_error = 1000;

/* --- which groups ---------------------------------------------------------------------------- */

/* The sign of a distance at the start, and how near a run came to 0 of it. */
typedef struct {
    int sign;
    double least, most;
} nearness;

static qdot_status
measure_start(const qdot_scene *s, const qdot_run_request *request, qdot_expr distance,
              nearness *x)
{
    double value;

    QDOT_TRY(qdot_chart_sign(s, request, distance, &x->sign, &value));
    x->least = x->most = fabs(value);
    return QDOT_OK;
}

/* At the points of a run; where the sign changes it is 0 between two. */
static qdot_status
measure_run(const qdot_run *run, qdot_expr distance, nearness *x)
{
    qdot_reader r = {0};
    qdot_reading of = {0};
    double value, before = x->sign;
    qdot_status status = qdot_reader_lower(run->plan, 1, &distance, &of);

    if (status == QDOT_OK)
        status = qdot_reader_init(&r, &of, &run->course);
    for (size_t k = 0; k < run->course.tr.count && status == QDOT_OK; k++) {
        status = qdot_reader_at(&r, SIZE_MAX, run->course.tr.t[k], &value);
        x->least = value * before <= 0 ? 0 : fmin(x->least, fabs(value));
        x->most = fmax(x->most, fabs(value));
        before = value;
    }
    qdot_reader_clear(&r);
    qdot_tape_free(of.tape);
    return status;
}

/* Put the groups whose singular place was near before the others: *near of them; and the signs
 * [groups] of their distances. */
static qdot_status
choose_groups(qdot_scene *s, const qdot_run_request *request, const qdot_run *run,
              qdot_chart_groups *groups, int *sign, size_t *near)
{
    *near = 0;
    for (size_t i = 0; i < groups->n; i++) {
        const qdot_chart_group g = groups->at[i];
        nearness x;

        QDOT_TRY(measure_start(s, request, g.distance, &x));
        if (run)
            QDOT_TRY(measure_run(run, g.distance, &x));
        sign[i] = x.sign;
        if (!(x.least <= near_place * fmin(1, x.most)))
            continue;
        groups->at[i] = groups->at[*near];
        sign[i] = sign[*near];
        groups->at[*near] = g;
        sign[(*near)++] = x.sign;
    }
    return QDOT_OK;
}

/* --- the run in the chart ---------------------------------------------------------------------- */

/* The start in new coordinates: exact constants, in order of the chart's scene. */
static qdot_status
put_start(const qdot_chart *c, const qdot_run_request *request, qdot_expr *q0,
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

/* Make the run; *run NULL where it does not arrive. */
static qdot_status
run_in(qdot_run_chart *x, const qdot_run_request *request, const qdot_run_maker *by,
       qdot_run **run)
{
    qdot_run_request other = *request;
    const size_t n = x->chart.scene->coordinates.n;
    qdot_expr *q0 = qdot_calloc(2 * n + 1, sizeof *q0);
    qdot_status status = q0 ? put_start(&x->chart, request, q0, q0 + n) : QDOT_ENOMEM;

    *run = NULL;
    other.q0 = q0;
    other.v0 = q0 + n;
    other.q_named = other.v_named = NULL;
    other.scales = NULL;
    if (status == QDOT_OK)
        status = by->make(x->chart.scene, &other, run);
    qdot_free(q0);
    if (status == QDOT_OK && (*run)->report.status != QDOT_RUN_FAILED)
        return QDOT_OK;
    by->free(*run);
    *run = NULL;
    return status;
}

static qdot_status
say_chart(qdot_run *run)
{
    qdot_text_format(
        qdot_run_next_notice(run),
        "the coordinates become singular on the way: the run is in %s, and values "
        "are given in the coordinates of the scene",
        qdot_text_str(&run->chart->chart.names));
    return qdot_text_status(&run->notice);
}

/* Make the run with these groups replaced; *out NULL where it does not arrive. at_place: it begins
 * at a singular place. */
static qdot_status
run_without(qdot_scene *s, const qdot_run_request *request, const qdot_run_maker *by,
            const qdot_chart_groups *groups, const int *sign, bool at_place,
            qdot_run **out)
{
    qdot_run_chart *x = NULL;
    qdot_status status = qdot_run_chart_new(s, request, groups, sign, false, &x);

    if (status == QDOT_OK && x->chart.scene)
        status = run_in(x, request, by, out);
    if (*out) {
        x->at_place = at_place;
        (*out)->chart = x;
        x = NULL;
        status = qdot_run_chart_report(*out, by);
        if (status == QDOT_OK)
            status = say_chart(*out);
    }
    qdot_run_chart_free(x);
    return status;
}

/* Make the run in another chart, if there is one; *out NULL where there is none, or no run. The
 * groups that were not near may come to be so later: if the run without those that were fails, all
 * are replaced. */
static qdot_status
change(qdot_scene *s, const qdot_run_request *request, const qdot_run_maker *by,
       qdot_run *run, qdot_run **out)
{
    qdot_chart_groups groups = {0};
    size_t near = 0;
    int *sign = NULL;
    qdot_status status = qdot_chart_find(s, false, &groups);

    *out = NULL;
    if (status == QDOT_OK && groups.n > 0) {
        sign = qdot_calloc(groups.n, sizeof *sign);
        status =
            sign ? choose_groups(s, request, run, &groups, sign, &near) : QDOT_ENOMEM;
    }
    if (status == QDOT_OK && near > 0) {
        const qdot_chart_groups first = {.n = near, .at = groups.at};

        status = run_without(s, request, by, &first, sign, run == NULL, out);
        if (!*out && near < groups.n && status != QDOT_ENOMEM && status != QDOT_EINTR)
            status = run_without(s, request, by, &groups, sign, run == NULL, out);
    }
    qdot_free(groups.at);
    qdot_free(sign);
    return status;
}

/* Whether other coordinates may be worth while. */
static bool
is_poor(const qdot_run *run, double tol)
{
    return run->report.status == QDOT_RUN_FAILED || isnan(run->report.error) ||
           run->course.tr.result.stats.raised > poor * tol ||
           run->report.error > poor_error * tol;
}

/* Whether a run that arrived has passed through a place where the chart's reading turns: (theta, phi)
 * and (-theta, phi + pi) are one point, and its own coordinates may take the other way. */
static bool
takes_another_way(const qdot_run *other, const qdot_run *run)
{
    const qdot_trajectory *tr = &run->course.tr;
    const double *own = tr->y + (tr->count - 1) * tr->n;
    bool another = false;

    for (size_t i = 0; i < other->chart->n && i < run->plan->n; i++)
        another = another || fabs(own[i] - other->chart->end[i]) > 1;
    return another && !run->hidden;
}

static bool
is_better(const qdot_run *other, const qdot_run *run)
{
    if (!run || run->report.status == QDOT_RUN_FAILED)
        return true;
    if (takes_another_way(other, run))
        return false;
    return other->report.error < run->report.error ||
           (isnan(run->report.error) && !isnan(other->report.error));
}

/* Put `other` in the place of *run if it is better. */
static void
take_better(const qdot_run_maker *by, qdot_run *other, qdot_run **run)
{
    qdot_run *worse = other;

    if (other && is_better(other, *run)) {
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
    qdot_run *other;
    qdot_status status;

    if (request->n_states > 0 || (*run ? began != QDOT_OK || !is_poor(*run, request->tol)
                                       : began != QDOT_ESINGULAR))
        return began;
    for (int way = 0; way < 2 && (way == 0 || (*run && is_poor(*run, request->tol))); way++) {
        other = NULL;
        status = (way == 0 ? change : qdot_run_collide)(s, request, by, *run, &other);
        if (status == QDOT_OK)
            take_better(by, other, run);
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
