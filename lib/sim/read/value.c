/* value.c -- evaluates any expression along a run, with an estimate of its error. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "base/interrupt.h"
#include "expr/print.h"
#include "sim/course/reader.h"
#include "sim/course/run-time.h"
#include "sim/digits/precise.h"
#include "sim/error/companion.h"
#include "sim/error/distance.h"
#include "sim/error/horizon.h"
#include "sim/error/noise.h"
#include "sim/read/in-chart.h"
#include "sim/run/run.h"

/* Time difference for numerical derivatives, relative to t. */
static const double slope_over = 0x1p-28;

/* --- evaluation at times ------------------------------------------------------------ */

static qdot_status
fail_undefined(const qdot_run *run, qdot_expr e, double t)
{
    qdot_text text = {0};
    qdot_status status = qdot_print(run->plan->pool, e, QDOT_PLAIN, &text);

    if (status == QDOT_OK)
        status = qdot_fail(QDOT_EDOMAIN, "%.200s is undefined at t = %.15g",
                           qdot_text_str(&text), t);
    qdot_text_clear(&text);
    return status;
}

static qdot_status
find_errors_of_values(qdot_run *run, const qdot_reading *of, size_t k, const double *times,
                      const double *values, double *errors)
{
    const qdot_course *const course = &run->course;
    size_t m = of->m;
    bool whole;
    qdot_distance *distance = NULL;
    double *spread, *roundings;
    qdot_status status;

    for (size_t i = 0; i < k * m; i++)
        errors[i] = NAN;
    QDOT_TRY(qdot_run_twin(run));
    whole = qdot_run_comparable(run);
    if (!whole && isnan(run->report.horizon))
        return QDOT_OK;
    spread = qdot_calloc(m + k * m + 1, sizeof *spread);
    if (!spread)
        return QDOT_ENOMEM;
    roundings = spread + m;
    status = qdot_horizon_spread(run, of, &course, 0, spread);
    if (status == QDOT_OK)
        status = qdot_noise_roundings(of, &course, k, times, roundings);
    if (status == QDOT_OK)
        status = qdot_distance_new(run, of, &distance);
    for (size_t i = 0; i < k && status == QDOT_OK; i++) {
        bool beyond = qdot_horizon_passed(run, times[i]);
        double *e = errors + i * m;

        if (beyond && !whole)
            continue;
        status = qdot_distance_at(distance, times[i], values + i * m, e);
        for (size_t j = 0; j < m && status == QDOT_OK; j++)
            if (!isnan(e[j]))
                e[j] = fmax(e[j], beyond ? spread[j] : 0) + roundings[i * m + j];
    }
    qdot_distance_free(distance);
    qdot_free(spread);
    return status;
}

static qdot_status
evaluate_at_times(qdot_run *run, const qdot_reading *of, size_t k, const double *times,
                  double *values)
{
    size_t m = of->m;
    qdot_reader r = {0};
    qdot_status status = qdot_reader_init(&r, of, &run->course);

    for (size_t i = 0; i < k && status == QDOT_OK; i++) {
        status = qdot_interrupt_check();
        if (status == QDOT_OK)
            status = qdot_reader_at(&r, SIZE_MAX, times[i], values + i * m);
        for (size_t j = 0; j < m && status == QDOT_OK; j++)
            if (!isfinite(values[i * m + j]))
                status = fail_undefined(run, of->exprs[j], times[i]);
    }
    qdot_reader_clear(&r);
    return status;
}

/* The piece of the run that contains t; at a time between two pieces the later one. */
static size_t
piece_at_time(const qdot_trajectory *tr, double t)
{
    return qdot_trajectory_piece_of(tr, qdot_trajectory_locate(tr, t, 0));
}

/* Add the change of the values from t to t + low, by slopes over h within the piece. The ends of
 * a run are its exact limits already. */
static qdot_status
shift_state_beyond_end(const qdot_run *run, qdot_reader *r, double t, double low, double *more,
                       double *values)
{
    const qdot_trajectory *tr = &run->course.tr;
    const double end = tr->t[tr->count - 1], h = (end > t ? slope_over : -slope_over) * fabs(t);

    if (low == 0 || t == tr->t[0] || (t == end && t == run->t1)
        || !(fmin(tr->t[0], end) <= t + h && t + h <= fmax(tr->t[0], end))
        || piece_at_time(tr, t) != piece_at_time(tr, t + h))
        return QDOT_OK;
    return qdot_reader_go_on(r, SIZE_MAX, t, h, low, more, values);
}

static qdot_status
add_effect_of_low_parts(qdot_run *run, const qdot_reading *of, size_t k, const double *times,
                        const double *lows, double *values)
{
    size_t m = of->m;
    double *more = qdot_malloc((m + 1) * sizeof *more);
    qdot_reader r = {0};
    qdot_status status = more ? QDOT_OK : QDOT_ENOMEM;

    if (status == QDOT_OK)
        status = qdot_reader_init(&r, of, &run->course);
    for (size_t i = 0; i < k && status == QDOT_OK; i++)
        status = shift_state_beyond_end(run, &r, times[i], lows[i], more, values + i * m);
    qdot_reader_clear(&r);
    qdot_free(more);
    return status;
}

qdot_status
qdot_run_values(qdot_run *run, size_t m, const qdot_expr *exprs, size_t k,
                const double *times, double *values, double *errors)
{
    const qdot_exact_times all = {k, times, NULL};

    return qdot_run_values_beyond(run, m, exprs, &all, values, errors);
}

qdot_status
qdot_in_chart_values(qdot_run *run, size_t m, const qdot_expr *exprs, const qdot_exact_times *times,
              double *values, double *errors)
{
    const size_t k = times->n;
    qdot_reading of;
    qdot_status status;

    QDOT_TRY(qdot_reader_lower(run->plan, m, exprs, &of));
    status = evaluate_at_times(run, &of, k, times->at, values);
    if (status == QDOT_OK && errors)
        status = find_errors_of_values(run, &of, k, times->at, values, errors);
    if (status == QDOT_OK && times->low)
        status = add_effect_of_low_parts(run, &of, k, times->at, times->low, values);
    qdot_tape_free(of.tape);
    return status;
}

/* Evaluate expressions group by group, each at times in one interval of constant chart. */
static qdot_status
evaluate_in_chart(qdot_run *run, size_t m, const qdot_expr *exprs, const qdot_exact_times *times,
                  double *values, double *errors)
{
    qdot_in_chart in = {0};
    qdot_status status = QDOT_OK;

    for (size_t i = 0, n; i < times->n && status == QDOT_OK; i += n) {
        status = qdot_in_chart_express(&in, run, m, exprs, times->at[i]);
        n = 1;
        while (status == QDOT_OK && i + n < times->n && qdot_in_chart_holds(&in, times->at[i + n]))
            n++;
        if (status == QDOT_OK)
            status = qdot_in_chart_values(run, m, in.exprs,
                                   &(qdot_exact_times){n, times->at + i,
                                                       times->low ? times->low + i : NULL},
                                   values + i * m, errors ? errors + i * m : NULL);
    }
    qdot_in_chart_clear(&in);
    return status;
}

static qdot_status
evaluate_along_run(qdot_run *run, size_t m, const qdot_expr *exprs, const qdot_exact_times *times, double *values,
                   double *errors)
{
    return (run->chart ? evaluate_in_chart : qdot_in_chart_values)(run, m, exprs, times, values, errors);
}

/* Evaluate expressions along a run that counts its times from an origin. */
static qdot_status
evaluate_from_origin(qdot_run *run, size_t m, const qdot_expr *exprs, const qdot_exact_times *times,
                     double *values, double *errors)
{
    double *at = qdot_malloc(2 * (times->n + 1) * sizeof *at), *low = at + times->n + 1;
    const qdot_expr *own;
    qdot_expr *made = NULL;
    qdot_status status = at ? qdot_run_time_express(run, m, exprs, &own, &made) : QDOT_ENOMEM;

    for (size_t i = 0; i < times->n && status == QDOT_OK; i++)
        qdot_run_time_own(run, times->at[i], times->low ? times->low[i] : 0, &at[i], &low[i]);
    if (status == QDOT_OK)
        status = evaluate_along_run(run, m, own, &(qdot_exact_times){times->n, at, low}, values, errors);
    qdot_free(made);
    qdot_free(at);
    return status;
}

qdot_status
qdot_run_values_beyond(qdot_run *run, size_t m, const qdot_expr *exprs,
                       const qdot_exact_times *times, double *values, double *errors)
{
    if (run->precise)
        return qdot_precise_pair_sample_values(run->precise, m, exprs, times->n, times->at, values,
                                               errors);
    if (run->origin != 0)
        return qdot_run_time_fail(run->origin, evaluate_from_origin(run, m, exprs, times, values, errors));
    return evaluate_along_run(run, m, exprs, times, values, errors);
}

bool
qdot_run_is_before_event(const qdot_run *run, size_t k)
{
    const qdot_trajectory *tr = &run->course.tr;

    return k + 1 < tr->count && tr->t[k] == tr->t[k + 1];
}

static qdot_status
evaluate_at_stored_point(qdot_run *run, size_t m, const qdot_expr *exprs, size_t k, double *values)
{
    const qdot_trajectory *tr = &run->course.tr;
    qdot_reading of;
    qdot_reader r = {0};
    qdot_status status;

    QDOT_TRY(qdot_reader_lower(run->plan, m, exprs, &of));
    status = qdot_reader_init(&r, &of, &run->course);
    if (status == QDOT_OK)
        status = qdot_reader_at(&r, qdot_trajectory_piece_of(tr, k), tr->t[k], values);
    for (size_t j = 0; j < m && status == QDOT_OK; j++)
        if (!isfinite(values[j]))
            status = fail_undefined(run, exprs[j], tr->t[k]);
    qdot_reader_clear(&r);
    qdot_tape_free(of.tape);
    return status;
}

qdot_status
qdot_run_point_values(qdot_run *run, size_t m, const qdot_expr *exprs, size_t k, double *values)
{
    qdot_in_chart in = {0};
    const qdot_expr *own;
    qdot_expr *made;
    qdot_status status = qdot_run_time_express(run, m, exprs, &own, &made);

    if (run->chart && status == QDOT_OK)
        status = qdot_in_chart_express(&in, run, m, own, run->course.tr.t[k]);
    if (status == QDOT_OK)
        status = evaluate_at_stored_point(run, m, run->chart ? in.exprs : own, k, values);
    qdot_in_chart_clear(&in);
    qdot_free(made);
    return qdot_run_time_fail(run->origin, status);
}

qdot_status
qdot_run_exact_values(qdot_run *run, size_t m, const qdot_expr *exprs, qdot_expr time,
                      qdot_expr *values, double *errors)
{
    if (!run->precise)
        return qdot_fail(QDOT_EINVAL, "the run was made in doubles");
    return qdot_precise_pair_values(run->precise, m, exprs, time, values, errors);
}

qdot_status
qdot_run_exact_point_values(qdot_run *run, size_t m, const qdot_expr *exprs, size_t k,
                            qdot_expr *values, double *errors)
{
    if (!run->precise)
        return qdot_fail(QDOT_EINVAL, "the run was made in doubles");
    return qdot_precise_pair_end_values(run->precise, m, exprs,
                                        qdot_trajectory_piece_of(&run->course.tr, k),
                                        qdot_run_is_before_event(run, k), values, errors);
}

double
qdot_run_requested_end(const qdot_run *run)
{
    return qdot_run_time_told(run, run->t1);
}

const qdot_run_report *
qdot_run_get_report(const qdot_run *run)
{
    return qdot_run_time_report(run);
}

const double *
qdot_run_times(const qdot_run *run, size_t *n)
{
    return qdot_run_time_points(run, n);
}
