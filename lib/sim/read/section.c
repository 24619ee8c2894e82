/* section.c -- Poincaré sections: the times when a function of the motion crosses 0, values then, and errors. */
#include "sim/read/section.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/interrupt.h"
#include "ode/companion.h"
#include "sim/course/crossings.h"
#include "sim/course/reader.h"
#include "sim/course/run-time.h"
#include "sim/error/companion.h"
#include "sim/error/horizon.h"
#include "sim/error/noise.h"
#include "sim/error/partner.h"
#include "sim/read/in-chart.h"

/* Time difference for numerical derivatives, relative to t and to the duration of the run. */
static const double slope_over = 0x1p-28;

/* The crossings along the run, or along one of its companion runs. */
typedef struct {
    const qdot_course *course;
    qdot_crossings at;
    double *t; /* [at.n] times of the crossings */
    double lost;
    qdot_reader reader;
} side;

typedef struct {
    qdot_run *run;
    const qdot_section_of *of;
    qdot_reading reading; /* evaluates the expressions along the runs */
    side sides[3];        /* crossings along the run and along its companion runs */
    size_t n_sides;
    double *work; /* [3 m] scratch */
} section;

void
qdot_section_clear(qdot_section *s)
{
    qdot_free(s->t);
    qdot_free(s->t_errors);
    qdot_free(s->values);
    qdot_free(s->errors);
    *s = (qdot_section){.lost = NAN};
}

/* --- the crossings of one run --------------------------------------------------------- */

static qdot_status
find_crossings(section *x, side *s, const double *limits)
{
    size_t n = 0;

    QDOT_TRY(qdot_crossings_find(s->course, x->of->g, limits, &s->at, &s->lost));
    for (size_t i = 0; i < s->at.n; i++)
        if (x->of->way == 0 || s->at.at[i].way == x->of->way)
            s->at.at[n++] = s->at.at[i];
    s->at.n = n;
    s->t = qdot_calloc(n + 1, sizeof *s->t);
    if (!s->t)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < n; i++)
        s->t[i] = s->at.at[i].t;
    return qdot_reader_init(&s->reader, &x->reading, s->course);
}

/* Evaluate the expressions of the section at a crossing: out [m]. */
static qdot_status
evaluate_at_crossing(section *x, side *s, const qdot_crossing *at, double *out)
{
    const qdot_trajectory *tr = &s->course->tr;
    const double from = tr->t[tr->pieces.at[at->piece].first],
                 to = tr->t[qdot_trajectory_last_of(tr, at->piece)];
    double h = slope_over * fmax(fabs(at->t), fabs(tr->t[tr->count - 1] - tr->t[0]));

    QDOT_TRY(qdot_reader_at(&s->reader, at->piece, at->t, out));
    if (at->t + h > fmax(from, to))
        h = -h;
    if (at->low == 0 || at->t + h < fmin(from, to))
        return QDOT_OK;
    return qdot_reader_go_on(&s->reader, at->piece, at->t, h, at->low, x->work, out);
}

/* --- errors of crossings -------------------------------------------------------------- */

/* The errors of row k from those of the companions: of the time into *t_error, of the numbers into
 * errors [m]; NaN where one has not that crossing. */
static qdot_status
find_errors_of_crossing(section *x, size_t k, const double *values, double *t_error, double *errors)
{
    const size_t m = x->of->m, others = x->n_sides - 1;
    const side *own = x->sides;
    double times[2], theirs[2], *read = x->work + m;

    *t_error = NAN;
    for (size_t j = 0; j < m; j++)
        errors[j] = NAN;
    for (size_t i = 0; i < others; i++) {
        side *other = x->sides + 1 + i;
        const size_t p = qdot_partner_of(own->t, own->at.n, k, other->t, other->at.n);

        if (p == SIZE_MAX)
            return QDOT_OK;
        times[i] = other->t[p];
        QDOT_TRY(evaluate_at_crossing(x, other, &other->at.at[p], read + i * m));
    }
    if (others == 0)
        return QDOT_OK;
    *t_error = qdot_companion_bound_of(own->t[k], others, times) + DBL_EPSILON * fabs(own->t[k]);
    for (size_t j = 0; j < m; j++) {
        for (size_t i = 0; i < others; i++)
            theirs[i] = read[i * m + j];
        errors[j] = qdot_companion_bound_of(values[j], others, theirs);
    }
    return QDOT_OK;
}

/* At one crossing the companions may be near by chance: a row has the largest error of those beside
 * it, too. errors [n x m] */
static qdot_status
take_largest_neighbouring_error(size_t n, size_t m, double *errors)
{
    double *own = qdot_malloc((n * m + 1) * sizeof *own);

    if (!own)
        return QDOT_ENOMEM;
    memcpy(own, errors, n * m * sizeof *own);
    for (size_t k = 0; k < n; k++)
        for (size_t j = 0; j < m; j++) {
            double *e = &errors[k * m + j];

            if (isnan(*e))
                continue;
            if (k > 0)
                *e = fmax(*e, own[(k - 1) * m + j]);
            if (k + 1 < n)
                *e = fmax(*e, own[(k + 1) * m + j]);
        }
    qdot_free(own);
    return QDOT_OK;
}

/* Find the errors of the last n rows of the section, which are stored in s from row `first` on. */
static qdot_status
find_errors_of_rows(section *x, qdot_section *s, size_t first)
{
    const qdot_course *const course = x->sides[0].course;
    const size_t n = s->n - first, m = s->m;
    const bool whole = qdot_run_comparable(x->run);
    double *t = s->t + first, *values = s->values + first * m, *errors = s->errors + first * m;
    double *spread = qdot_calloc(m + n * m + 1, sizeof *spread), *roundings = spread + m;
    qdot_status status = spread ? QDOT_OK : QDOT_ENOMEM;

    if (status == QDOT_OK)
        status = qdot_horizon_spread(x->run, &x->reading, &course, 0, spread);
    if (status == QDOT_OK)
        status = qdot_noise_roundings(&x->reading, &course, n, t, roundings);
    for (size_t k = 0; k < n && status == QDOT_OK; k++)
        status = find_errors_of_crossing(x, k, values + k * m, &s->t_errors[first + k], errors + k * m);
    if (status == QDOT_OK)
        status = take_largest_neighbouring_error(n, m, errors);
    for (size_t k = 0; k < n && status == QDOT_OK; k++) {
        const bool beyond = qdot_horizon_passed(x->run, t[k]);

        if (!whole || beyond)
            s->t_errors[first + k] = NAN;
        for (size_t j = 0; j < m; j++) {
            double *e = &errors[k * m + j];

            *e = !whole          ? NAN
                 : beyond        ? fmax(isnan(*e) ? 0 : *e, spread[j])
                                 : *e + roundings[k * m + j];
        }
    }
    qdot_free(spread);
    return status;
}

/* --- rows of the section -------------------------------------------------------------- */

static bool
enlarge_array(double **at, size_t n)
{
    double *more = qdot_realloc(*at, (n + 1) * sizeof **at);

    if (more)
        *at = more;
    return more != NULL;
}

/* Append a row to the section for each crossing of the run. */
static qdot_status
append_rows(section *x, qdot_section *s)
{
    side *own = x->sides;
    const size_t m = s->m, first = s->n, n = first + own->at.n;

    if (!enlarge_array(&s->t, n) || !enlarge_array(&s->t_errors, n) || !enlarge_array(&s->values, n * m)
        || !enlarge_array(&s->errors, n * m))
        return QDOT_ENOMEM;
    for (size_t k = 0; k < own->at.n; k++, s->n++) {
        double *out = s->values + s->n * m;

        QDOT_TRY(qdot_interrupt_check());
        QDOT_TRY(evaluate_at_crossing(x, own, &own->at.at[k], out));
        s->t[s->n] = own->t[k];
        for (size_t j = 0; j < m; j++)
            out[j] = isfinite(out[j]) ? out[j] : NAN;
    }
    return find_errors_of_rows(x, s, first);
}

/* Find the section from limits[0] to limits[1], for expressions in the coordinates of the run. */
static qdot_status
find_section_between(qdot_run *run, const qdot_section_of *of, const double *limits, qdot_section *s)
{
    const qdot_course *courses[] = {&run->course, &run->companion, &run->twin};
    section x = {.run = run, .of = of};
    qdot_status status = QDOT_ENOMEM;

    x.work = qdot_calloc(3 * of->m + 1, sizeof *x.work);
    if (x.work)
        status = qdot_reader_lower(run->plan, of->m, of->exprs, &x.reading);
    for (size_t i = 0; i < 3 && status == QDOT_OK; i++) {
        if ((i == 1 && !run->has_companion) || (i == 2 && !run->has_twin))
            break;
        x.sides[i].course = courses[i];
        x.n_sides = i + 1;
        status = find_crossings(&x, &x.sides[i], limits);
        /* the function has no value somewhere along a companion run: errors are not estimated */
        if (i > 0 && qdot_reader_has_nothing(status)) {
            x.n_sides = 1;
            status = QDOT_OK;
            break;
        }
    }
    if (status == QDOT_OK && !isnan(x.sides[0].lost))
        s->lost = x.sides[0].lost;
    if (status == QDOT_OK)
        status = append_rows(&x, s);
    for (size_t i = 0; i < 3; i++) {
        qdot_reader_clear(&x.sides[i].reader);
        qdot_free(x.sides[i].at.at);
        qdot_free(x.sides[i].t);
    }
    qdot_tape_free(x.reading.tape);
    qdot_free(x.work);
    return status;
}

/* For a run in other coordinates: find the crossings in one interval of constant chart after the other. */
static qdot_status
find_section_in_chart(qdot_run *run, const qdot_section_of *of, const double *limits, qdot_section *s)
{
    qdot_expr *given = qdot_calloc(of->m + 1, sizeof *given);
    qdot_in_chart in = {0};
    double from = limits[0], end = from;
    qdot_status status = given ? QDOT_OK : QDOT_ENOMEM;

    if (given) {
        memcpy(given, of->exprs, of->m * sizeof *given);
        given[of->m] = of->g;
    }
    while (status == QDOT_OK) {
        status = qdot_in_chart_express(&in, run, of->m + 1, given, from);
        if (status != QDOT_OK)
            break;
        end = in.turns ? qdot_in_chart_end(&in, from, limits[1]) : limits[1];
        status = find_section_between(run, &(qdot_section_of){in.exprs[of->m], of->way, of->m, in.exprs, NULL},
                                      (double[]){from, end}, s);
        if (end == limits[1] || !isnan(s->lost))
            break;
        from = end;
    }
    qdot_in_chart_clear(&in);
    qdot_free(given);
    return status;
}

/* Find the crossings; their times are those of the run, counted from its origin. */
static qdot_status
find_section(qdot_run *run, const qdot_section_of *of, qdot_section *s)
{
    const qdot_trajectory *tr = &run->course.tr;
    double limits[2], rest;

    s->m = of->m;
    if (run->precise)
        return qdot_fail(QDOT_ENOTBUILT, "not built yet: the section of a run with `digits`");
    if (tr->count < 2)
        return QDOT_OK;
    QDOT_TRY(qdot_run_twin(run));
    limits[0] = of->limits ? fmin(of->limits[0], of->limits[1]) : -INFINITY;
    limits[1] = of->limits ? fmax(of->limits[0], of->limits[1]) : INFINITY;
    for (int i = 0; i < 2 && of->limits; i++)
        qdot_run_time_own(run, limits[i], 0, &limits[i], &rest);
    qdot_trajectory_narrow(tr, &limits[0], &limits[1]);
    if (limits[0] > limits[1])
        return QDOT_OK;
    if (qdot_trajectory_is_backward(tr)) {
        const double last = limits[0];

        limits[0] = limits[1];
        limits[1] = last;
    }
    return (run->chart ? find_section_in_chart : find_section_between)(run, of, limits, s);
}

qdot_status
qdot_section_find(qdot_run *run, const qdot_section_of *of, qdot_section *s)
{
    qdot_expr *given = qdot_calloc(of->m + 1, sizeof *given), *made = NULL;
    const qdot_expr *own = given;
    const size_t first = s->n;
    const double lost = s->lost;
    qdot_status status = given ? QDOT_OK : QDOT_ENOMEM;

    if (given) {
        memcpy(given, of->exprs, of->m * sizeof *given);
        given[of->m] = of->g;
        status = qdot_run_time_express(run, of->m + 1, given, &own, &made);
    }
    s->lost = NAN;
    if (status == QDOT_OK)
        status = find_section(run, &(qdot_section_of){own[of->m], of->way, of->m, own, of->limits}, s);
    for (size_t k = first; k < s->n && run->origin != 0; k++) {
        s->t[k] = qdot_run_time_told(run, s->t[k]);
        s->t_errors[k] += DBL_EPSILON * fabs(s->t[k]);
    }
    s->lost = isnan(s->lost) ? lost : qdot_run_time_told(run, s->lost);
    qdot_free(made);
    qdot_free(given);
    return qdot_run_time_fail(run->origin, status);
}
