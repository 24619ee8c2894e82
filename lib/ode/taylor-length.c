/* taylor-length.c -- expands the solution in a Taylor series at a point, and finds how long a step that allows. */
#include "ode/taylor.h"

#include <float.h>
#include <math.h>

#include "ode/step-decisions.h"
#include "ode/taylor-run.h"

typedef qdot_ode_taylor_run run;

/* For a place that a step should not end upon: how far beyond it the step goes, and the noise
 * from which on it does so in any case. */
static const double over = 1.3, near_noise = 2e-12, least_worth = 1e-7;

/* The smallest relative defect that limits a step: below, a stiff force has too few correct digits in doubles. */
static const double least_held = 1e-14;

/* log2 of the step in units: that of the radius which the upper half of the coefficients
 * shows, and what order p leaves of it under tol; kept so short that the rounding of no
 * term counts. INFINITY where the upper half holds nothing; NaN where it is not finite. */
static double
log2_of_step(run *r)
{
    qdot_series_reach reach;
    double l;

    reach = r->kernels->reach(r->n, r->series->x, r->series->stride, &r->weights,
                              r->scale);
    if (isinf(reach.upper))
        return reach.upper > 0 ? INFINITY : NAN;
    l = reach.upper + r->log_aim * r->weights.inverse[r->p];
    return qdot_smaller(l, reach.lower);
}

/* The log2 of the step that all coefficients allow, not only the last ones; INFINITY if all are 0. */
static double
log2_of_step_by_all_orders(run *r)
{
    double least = INFINITY;

    r->kernels->peaks(r->n, r->series->x, r->series->stride, r->p, r->scale, r->peaks);
    for (int k = 1; k <= r->p; k++)
        if (r->peaks[k] > 0)
            least = fmin(least, -log2(r->peaks[k]) / k);
    return least + r->log_aim * r->weights.inverse[r->p];
}

qdot_status
qdot_ode_taylor_run_expand(run *r)
{
    if (!r->extended) {
        r->result->stats.evaluations++;
        QDOT_TRY(r->series->extend(r->p, r->series->user));
        r->extended = true;
    }
    return QDOT_OK;
}

qdot_status
qdot_ode_taylor_run_begin(run *r, double t, const double *y)
{
    r->extended = false;
    QDOT_TRY(r->series->begin(t, y, r->unit, r->series->user));
    r->cut = r->p;
    r->held = r->options->leading ? qdot_larger(r->tol, least_held) : r->tol;
    r->log_aim = r->log_wanted;
    if (r->series->noise) {
        r->held = qdot_smaller(1, qdot_larger(r->tol, r->series->noise(r->series->user)));
        if (r->held > r->tol)
            r->log_aim = fmax(r->log_aim, log2(r->held));
    }
    return QDOT_OK;
}

/* Across such a place the terms of a series first fall and then grow, because their rounding
 * errors do: it is summed up to its least term, as an asymptotic series, which is about its
 * error. */
static void
cut_series_at_least_term(run *r, double h)
{
    const double least = qdot_ode_taylor_least_term(r->series, r->n, r->p,
                                                    h / fabs(r->unit), r->scale, &r->cut);

    r->held = fmax(r->held, fmin(least_worth, 100 * least));
}

/* A step that would end just before or upon a place near which the coefficients are inaccurate
 * goes beyond it, if that is not far and was not rejected before, or stays well before it. */
static void
avoid_ending_near_singularity(run *r, double *h, double most)
{
    const qdot_ode_series *series = r->series;
    const double noise = series->noise ? series->noise(series->user) : 0;
    double ahead;

    r->place = NAN;
    if (!(noise > 0) || !series->ahead)
        return;
    ahead = series->ahead(series->user);
    if (!(ahead > 0 && ahead < 4 * *h))
        return;
    if ((*h >= .8 * ahead || noise > near_noise) && over * ahead <= most) {
        *h = qdot_smaller(most, fmax(*h, over * ahead));
        r->place = r->t + r->direction * ahead;
        cut_series_at_least_term(r, *h);
    } else if (*h > 0.5 * ahead) {
        *h = 0.5 * ahead;
    }
}

/* As much of a step as no part of f is stepped over in. */
static double
step_before_hidden_parts(const run *r, double h)
{
    const double unit = fabs(r->unit);

    return unit * r->series->near(r->p, h / unit, qdot_step_narrowest * fabs(r->t) / unit, r->series->user);
}

/* *h positive, `most` what a step tried before allows; INFINITY where the series ends. The unit of
 * the series is brought near the step where it is far from it. */
static qdot_status
find_step_length(run *r, double most, double *h)
{
    double ends = 0; /* a unit of time in which the series ends (upper half 0), so that any step is allowed; 0: none yet */

    for (int tries = 0;; tries++) {
        double l, far;

        QDOT_TRY(qdot_ode_taylor_run_expand(r));
        l = log2_of_step(r);
        /* NaN because coefficients underflow to 0 after a change of the unit of time: go back to the unit before */
        if (isnan(l) && ends != 0) {
            qdot_ode_taylor_run_set_unit(r, ends);
            QDOT_TRY(qdot_ode_taylor_run_begin(r, r->t, r->y));
            tries = QDOT_STEP_UNITS;
            continue;
        }
        if (isnan(l)) { /* coefficients overflow, provided that the first orders are finite */
            far = qdot_step_overflow(tries);
        } else {
            ends = l < INFINITY ? 0 : r->unit;
            *h = fabs(r->unit) * qdot_rough_exp2(l);
            if (r->series->near)
                *h = step_before_hidden_parts(r, *h);
            avoid_ending_near_singularity(r, h, most);
            /* use the other coefficients if the last ones underflow; a polynomial allows any step */
            far = l < INFINITY ? l : fmax(0, log2_of_step_by_all_orders(r));
            if (r->system->until) /* a step ends there at the latest: no unit of time above that length is of use */
                far = fmin(far, 1 + log2(fabs(r->until - r->t)) - log2(fabs(r->unit)));
            if (!(fabs(far) > QDOT_STEP_UNIT_FAR) || isinf(far))
                return QDOT_OK;
        }
        if (tries >= QDOT_STEP_UNITS) {
            if (isnan(l))
                return qdot_fail(QDOT_EDOMAIN, "the solution is not finite beyond it");
            return QDOT_OK;
        }
        qdot_ode_taylor_run_set_unit(r, qdot_step_other_unit(r->unit, far));
        if (fabs(r->unit) < DBL_MIN || !isfinite(r->unit))
            return qdot_fail(QDOT_EDOMAIN, "the solution is not finite beyond it");
        QDOT_TRY(qdot_ode_taylor_run_begin(r, r->t, r->y));
    }
}

/* --- orders of steps that end where f is not smooth --------------------------------- */

/* Steps from one point of a table of data to the next are often much shorter than the order of the run allows. The order is
 * lowered from step to step as long as it allows the same length; after it allowed less it is lowered more rarely. */

/* The lowest such order; log2 of the factor by which steps could be longer. */
enum { least_of_short = 8 };
static const double room = 1;

void
qdot_ode_taylor_run_set_order(run *r, int p)
{
    r->p = r->cut = p;
    qdot_series_weights_set(&r->weights, p, r->log_term, qdot_step_fall(r->log_wanted, p));
}

/* Whether the order may change from step to step: machine code has one, and so have first orders in two doubles. */
static bool
may_change_order(const run *r, double most)
{
    const qdot_ode_code *code = &r->series->code;

    return r->system->until && !r->options->leading && isinf(most) && !(code->there && code->there(r->most, code->user));
}

/* Whether one order less would allow the step to `until`, too; with so many more as a companion has. */
static bool
one_order_less_would_do(const run *r, double rest)
{
    const int p = r->p - 1 - r->options->order_more;
    const qdot_series_reach reach = r->kernels->reach(r->n, r->series->x, r->series->stride, &r->weights, r->scale);

    return p >= least_of_short && reach.upper + r->log_aim * r->weights.inverse[p] > log2(rest / fabs(r->unit)) + room;
}

/* Where the order does not allow the step to `until`, expand to the order of the run; then choose the order of the next step. */
static qdot_status
adapt_order(run *r, double most, double *h)
{
    const double rest = fabs(r->until - r->t);

    if (*h < rest && r->p < r->most) {
        r->next_p = r->p + 2 < r->most ? r->p + 2 : r->most;
        r->cautious = r->patience = 2 * r->patience + 1;
        qdot_ode_taylor_run_set_order(r, r->most);
        QDOT_TRY(qdot_ode_taylor_run_begin(r, r->t, r->y));
        return find_step_length(r, most, h);
    }
    r->cautious -= r->cautious > 0;
    r->next_p = *h < rest ? r->most : r->p - (r->cautious == 0 && one_order_less_would_do(r, rest));
    return QDOT_OK;
}

qdot_status
qdot_ode_taylor_run_length(run *r, double most, double *h)
{
    const bool fixed = r->options->h_fixed > 0, changes = !fixed && may_change_order(r, most);
    const int p = changes ? r->next_p : r->most;

    if (p != r->p)
        qdot_ode_taylor_run_set_order(r, p);
    if (fixed) {
        *h = r->options->h_fixed;
        return qdot_ode_taylor_run_expand(r);
    }
    QDOT_TRY(find_step_length(r, most, h));
    return changes ? adapt_order(r, most, h) : QDOT_OK;
}
