/* slope-numbers.c -- sensitivities (derivatives) of results of runs, and of expressions of them, by the chain rule. */
#include <float.h>
#include <math.h>

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/node.h"
#include "expr/walk.h"
#include "lang/session/measured.h"
#include "lang/session/member.h"
#include "lang/session/momenta.h"
#include "lang/session/runs.h"
#include "lang/slopes/slopes.h"
#include "sim/study/extremum.h"

/* The slope of the time of an event that changes the state is read before the event, by at most this part of the run's
 * latest time. */
static const double most_back = 1e-8;

/* --- numbers of the latest run whose slopes can be found ---------------------------------------- */

qdot_status
qdot_slopes_at_time(qdot_session *session, qdot_expr e, qdot_expr time, qdot_expr *number)
{
    qdot_measured m;

    QDOT_TRY(qdot_runs_measure_one(session, NULL, qdot_measured_as_rationals(session, e),
                                   time, &m));
    m.origin = (qdot_origin){.kind = QDOT_ORIGIN_VALUE, .e = e, .time = time};
    *number = qdot_measured_add(session, m);
    return qdot_pool_check(session->pool);
}

qdot_status
qdot_slopes_at_end(qdot_session *session, qdot_expr *e)
{
    const uint32_t moving = QDOT_HAS_COORD | QDOT_HAS_VELOCITY | QDOT_HAS_ACCELERATION |
                            QDOT_HAS_TIME | QDOT_HAS_MULTIPLIER;
    qdot_named_run *named;

    *e = qdot_momenta_to_velocities(session, *e);
    QDOT_TRY(qdot_pool_check(session->pool));
    if (!(qdot_expr_node(session->pool, *e)->holds & moving))
        return QDOT_OK;
    QDOT_TRY(qdot_runs_find(session, NULL, &named));
    if (qdot_run_get_report(named->run)->status == QDOT_RUN_STOPPED) {
        (void)qdot_fail(QDOT_EINVAL, "the run ended at an event: its end moves too");
        return qdot_hint("value(x, EVENT[1])");
    }
    return qdot_slopes_at_time(session, *e, named->conditions->t1, e);
}

/* --- their slopes ------------------------------------------------------------------------------- */

/* Evaluate, at a time, an expression of coordinates and their derivatives in the directions k, as a number. */
static qdot_status
value_at_time(qdot_slopes *s, qdot_expr e, qdot_expr time, qdot_expr *value)
{
    qdot_measured m = {0};

    QDOT_TRY(qdot_pool_check(s->session->pool));
    if (e == QDOT_ZERO) {
        *value = e;
        return QDOT_OK;
    }
    if (qdot_expr_node(s->session->pool, e)->holds & QDOT_HAS_MULTIPLIER)
        return qdot_fail(QDOT_ENOTBUILT, "not built yet: slopes of multipliers");
    QDOT_TRY(qdot_runs_measure_one(s->session, qdot_slopes_run, e, time, &m));
    *value = qdot_measured_add(s->session, m);
    return qdot_pool_check(s->session->pool);
}

/* The derivative in direction k of e, an expression of coordinates; results of runs in e are constants. */
static qdot_expr
derivative_in_direction(const qdot_slopes *s, qdot_expr e, size_t k)
{
    return qdot_variation_of(&s->variation, qdot_measured_as_rationals(s->session, e), k);
}

/* Find the derivative of value(e, time), whose time may vary, too. */
static qdot_status
differentiate_value(qdot_slopes *s, const qdot_measured *m, size_t first, size_t k,
                    qdot_expr *slope)
{
    qdot_pool *pool = s->session->pool;
    qdot_expr time, rate, sum = QDOT_ZERO;

    QDOT_TRY(value_at_time(s, derivative_in_direction(s, m->origin.e, k), m->origin.time, slope));
    QDOT_TRY(qdot_slopes_of(s, m->origin.time, first, k, &time));
    if (time != QDOT_ZERO) {
        rate = qdot_variation_rate(&s->variation,
                                   qdot_measured_as_rationals(s->session, m->origin.e));
        QDOT_TRY(value_at_time(s, rate, m->origin.time, &rate));
        sum = qdot_mul(pool, rate, time);
    }
    for (size_t i = first;
         i < s->session->measured->n && s->session->measured->at[i].symbol != m->symbol;
         i++) {
        const qdot_measured *inner = &s->session->measured->at[i];
        qdot_expr by, one;

        if (!qdot_expr_contains(pool, m->origin.e, inner->symbol))
            continue;
        by = qdot_measured_as_rationals(s->session,
                                        qdot_diff(pool, m->origin.e, inner->symbol));
        QDOT_TRY(value_at_time(s, by, m->origin.time, &by));
        QDOT_TRY(qdot_slopes_of(s, s->session->measured->at[i].symbol, first, k, &one));
        sum = qdot_add(pool, sum, qdot_mul(pool, by, one));
    }
    *slope = qdot_add(pool, *slope, sum);
    return qdot_pool_check(pool);
}

/* The time at which the sensitivity of an event's time is evaluated: just before it if the event
 * changes the state. */
static double
time_of_reading(const qdot_slopes *s, const qdot_measured *m, const qdot_event *event)
{
    const qdot_run_report *report = qdot_run_get_report(s->run);
    const double latest = fmax(fabs(report->t0), fabs(report->t1)),
                 back = fmax(latest * 4 * DBL_EPSILON, fmin(2 * m->error, latest * most_back));

    return event->targets.n == 0 ? m->value : m->value - copysign(back, report->t1 - report->t0);
}

/* To the slope -Dg/(dg/dt) of an event's time, read with up = Dg and down = dg/dt at a time near the event, add its
 * derivative by t times `way`, the time from there to the event with its error. */
static qdot_status
add_change_of_event_time(qdot_slopes *s, qdot_expr rate_up, qdot_expr rate_down, qdot_expr time, qdot_expr way,
                         qdot_expr up, qdot_expr down, qdot_expr *slope)
{
    qdot_pool *pool = s->session->pool;
    qdot_expr by_up, by_down;

    QDOT_TRY(value_at_time(s, rate_up, time, &by_up)); /* not as a quotient, which may be 0/0 at other times */
    QDOT_TRY(value_at_time(s, rate_down, time, &by_down));
    by_down = qdot_div(pool, qdot_mul(pool, up, by_down), qdot_mul(pool, down, down));
    *slope = qdot_add(pool, *slope, qdot_mul(pool, way, qdot_sub(pool, by_down, qdot_div(pool, by_up, down))));
    return qdot_pool_check(pool);
}

static qdot_status
differentiate_event_time(qdot_slopes *s, const qdot_measured *m, size_t k, qdot_expr *slope)
{
    qdot_pool *pool = s->session->pool;
    const qdot_event *event = qdot_scene_find_event(s->session->scene, m->origin.event);
    qdot_expr g, Dg, dg, time, up, down, way;

    if (event == NULL)
        return qdot_fail(QDOT_ENAME, "there is no event %.100s any more",
                         m->origin.event);
    g = qdot_sub(pool, event->left, event->right);
    Dg = qdot_variation_of(&s->variation, g, k);
    dg = qdot_variation_rate(&s->variation, g);
    time = m->digits > 0 ? m->exact : qdot_measured_rational(pool, time_of_reading(s, m, event));
    QDOT_TRY(value_at_time(s, Dg, time, &up));
    QDOT_TRY(value_at_time(s, dg, time, &down));
    *slope = qdot_neg(pool, qdot_div(pool, up, down));
    way = qdot_measured_new(s->session, m->digits > 0 ? 0 : m->value - time_of_reading(s, m, event), m->error);
    return add_change_of_event_time(s, qdot_ddt(pool, Dg), qdot_ddt(pool, dg), time, way, up, down, slope);
}

/* Find the derivative of one end of a range: as typed, or as the corresponding limit of the run was given. */
static qdot_status
differentiate_range_end(qdot_slopes *s, const qdot_measured *m, int end, size_t first, size_t k, qdot_expr *slope)
{
    const qdot_expr said = m->origin.said[end] != QDOT_NIL ? m->origin.said[end] : s->conditions->said[end];

    *slope = QDOT_ZERO;
    if (m->origin.said[end] == QDOT_NIL && end == 1 && qdot_run_get_report(s->run)->status == QDOT_RUN_STOPPED) {
        (void)qdot_fail(QDOT_ENOTBUILT, "not built yet: slopes over a range that ends where the run was stopped");
        return qdot_hint("say its ends: max(x, 0..EVENT)");
    }
    return said == QDOT_NIL ? QDOT_OK : qdot_slopes_of(s, said, first, k, slope);
}

/* The derivative of max or min: De at the extremum; if that is at an end of the range, also de/dt
 * times the shift of the end. */
static qdot_status
extremum_derivative(qdot_slopes *s, const qdot_measured *m, qdot_run *run, size_t first, size_t k,
                    qdot_expr *slope)
{
    qdot_expr time;
    qdot_extremum x = {.run = run,
                       .kind = m->origin.range,
                       .from = m->origin.ends[0],
                       .to = m->origin.ends[1]};
    double t;

    x.e = qdot_variation_with_numbers(&s->variation, m->origin.e);
    x.rate = qdot_variation_rate(&s->variation, m->origin.e);
    x.bend = qdot_variation_rate(&s->variation, x.rate);
    QDOT_TRY(qdot_pool_check(s->session->pool));
    QDOT_TRY(qdot_extremum_time(&x, &t));
    time = qdot_measured_rational(s->session->pool, t);
    QDOT_TRY(value_at_time(s, derivative_in_direction(s, m->origin.e, k), time, slope));
    for (int end = 0; end < 2; end++) {
        qdot_expr moves, rate;

        if (t != m->origin.ends[end])
            continue;
        QDOT_TRY(differentiate_range_end(s, m, end, first, k, &moves));
        QDOT_TRY(value_at_time(s, moves == QDOT_ZERO ? moves : x.rate, time, &rate));
        *slope = qdot_add(s->session->pool, *slope, qdot_mul(s->session->pool, rate, moves));
    }
    return qdot_pool_check(s->session->pool);
}

/* Find the derivative of mean(e, a..b): mean(De) + ((e(b) - mean) db/ds - (e(a) - mean) da/ds)/(b - a). */
static qdot_status
mean_derivative(qdot_slopes *s, const qdot_measured *m, qdot_run *run, size_t first, size_t k, qdot_expr *slope)
{
    qdot_pool *pool = s->session->pool;
    const double *ends = m->origin.ends;
    const qdot_expr along = derivative_in_direction(s, m->origin.e, k),
                    e = qdot_variation_with_numbers(&s->variation, m->origin.e);
    double value, error;

    QDOT_TRY(qdot_pool_check(pool));
    QDOT_TRY(qdot_run_range(run, QDOT_RANGE_MEAN, along, ends[0], ends[1], &value, &error));
    *slope = qdot_measured_new(s->session, value, error);
    for (int end = 0; end < 2; end++) {
        qdot_expr moves, there;

        QDOT_TRY(differentiate_range_end(s, m, end, first, k, &moves));
        if (moves == QDOT_ZERO)
            continue;
        QDOT_TRY(value_at_time(s, e, qdot_measured_rational(pool, ends[end]), &there));
        there = qdot_mul(pool, qdot_sub(pool, there, m->symbol), moves);
        *slope = qdot_add(pool, *slope, qdot_div(pool, there, qdot_measured_rational(pool, ends[end] - ends[!end])));
    }
    return qdot_pool_check(pool);
}

static qdot_status
differentiate_range_result(qdot_slopes *s, const qdot_measured *m, size_t first, size_t k, qdot_expr *slope)
{
    qdot_named_run *named;

    if (m->origin.range == QDOT_RANGE_DRIFT)
        return qdot_fail(QDOT_ENOTBUILT, "not built yet: slopes of drift");
    QDOT_TRY(qdot_runs_find(s->session, qdot_slopes_run, &named));
    return (m->origin.range == QDOT_RANGE_MEAN ? mean_derivative : extremum_derivative)(s, m, named->run, first, k, slope);
}

/* Find the derivative, in direction k, of the i-th result of a run. */
static qdot_status
differentiate_result(qdot_slopes *s, size_t i, size_t first, size_t k, qdot_expr *slope)
{
    const qdot_measured m = s->session->measured->at[i]; /* copied, since the list of results grows meanwhile */
    qdot_named_run *named;

    if (i < first || m.origin.kind == QDOT_ORIGIN_OTHER)
        return qdot_fail(QDOT_ENOTBUILT, "not built yet: slopes of numbers other than "
                                         "value, max, min, mean and event times");
    if (m.origin.run != NULL) {
        QDOT_TRY(qdot_runs_find(s->session, m.origin.run, &named));
        if (named->run != s->run)
            return qdot_fail(QDOT_ENOTBUILT, "not built yet: slopes of several runs");
    }
    switch (m.origin.kind) {
    case QDOT_ORIGIN_EVENT: return differentiate_event_time(s, &m, k, slope);
    case QDOT_ORIGIN_RANGE: return differentiate_range_result(s, &m, first, k, slope);
    default: return differentiate_value(s, &m, first, k, slope);
    }
}

qdot_status
qdot_slopes_of(qdot_slopes *s, qdot_expr e, size_t first, size_t k, qdot_expr *slope)
{
    qdot_pool *pool = s->session->pool;
    const size_t n = s->session->measured->n;
    qdot_expr sum;

    if (qdot_member_any(s->session, e)) {
        (void)qdot_fail(QDOT_ENOTBUILT, "not built yet: slopes of RUN.EXPR");
        return qdot_hint("value(RUN.x, T), max(RUN.x, A..B)");
    }
    sum = qdot_variation_by_parameter(&s->variation, e, k);
    for (size_t i = 0; i < n && !qdot_pool_failed(pool); i++) {
        const qdot_expr symbol = s->session->measured->at[i].symbol;
        qdot_expr one;

        if (!qdot_expr_contains(pool, e, symbol))
            continue;
        QDOT_TRY(differentiate_result(s, i, first, k, &one));
        sum = qdot_add(pool, sum, qdot_mul(pool, qdot_diff(pool, e, symbol), one));
    }
    *slope = sum;
    return qdot_pool_check(pool);
}
