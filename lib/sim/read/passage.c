/* passage.c -- finds extrema of an expression near a coordinate singularity that the motion passes exactly. */
#include "sim/read/passage.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "num/chebyshev.h"

enum { NODES = 16, TRIES = 4 };

/* Half the length of the first interval about a singularity, as a fraction of the integration step there. */
static const double part = 0.1;

/* A function is smooth if its last Chebyshev coefficients are below this fraction of the largest. */
static const double smooth = 1e-13;

size_t
qdot_passage_at(const qdot_run *run, double t)
{
    const qdot_run_chart *x = run->chart;

    for (size_t k = 1; x->followed && k < x->stretches.n; k++)
        if (x->stretches.at[k].t == t && x->stretches.at[k].passed != 0)
            return k;
    return SIZE_MAX;
}

/* The expression e as valid on one side of the singularity, to be evaluated on the side `before` or
 * after it. */
static qdot_expr
expression_beside_singularity(const qdot_run_chart *x, qdot_expr e, size_t k, bool own, bool before)
{
    const qdot_chart *c = &x->chart;
    const size_t n = c->moved.n + c->signs.n;
    const int64_t *quarters = x->quarters.at + x->stretches.at[before ? k - 1 : k].quarters;
    int64_t *signed_ones = qdot_calloc(n + 1, sizeof *signed_ones);
    qdot_expr now;

    if (!signed_ones)
        return qdot_pool_fail(c->pool);
    memcpy(signed_ones, quarters, n * sizeof *signed_ones);
    for (size_t i = 0; i < c->signs.n && !own; i++)
        if (x->stretches.at[k].passed >> i & 1)
            signed_ones[c->moved.n + i] *= -1;
    now = qdot_run_chart_express(x, e, signed_ones, NULL);
    qdot_free(signed_ones);
    return now;
}

/* Evaluate e at Chebyshev nodes on one side of the singularity at t: before it (sign -1) or after it. */
static qdot_status
evaluate_on_side(qdot_run *run, qdot_expr e, double t, double h, int sign, double *values, double *error)
{
    double times[NODES], errors[NODES], read[NODES];
    const int64_t *quarters;
    int at[NODES];
    size_t n = 0;

    for (int j = 0; j < NODES; j++)
        if (qdot_chebyshev_node(NODES, j) * sign > 0) {
            at[n] = j;
            times[n++] = qdot_chebyshev_place(t - h, t + h, qdot_chebyshev_node(NODES, j));
        }
    /* number of quarter turns of the chart's angles on this side of the singularity */
    QDOT_TRY(qdot_run_chart_quarters(run, times[0], &quarters));
    QDOT_TRY(qdot_in_chart_values(run, 1, &e, &(qdot_exact_times){n, times, NULL}, read, errors));
    for (size_t i = 0; i < n; i++) {
        values[at[i]] = read[i];
        *error = isnan(errors[i]) || isnan(*error) ? NAN : fmax(*error, errors[i]);
    }
    return QDOT_OK;
}

/* Find the extrema, between x = middle and x = sign, of the polynomial with Chebyshev coefficients c. */
static void
find_extrema(const double *c, double middle, int sign, qdot_passage *p)
{
    double slope[NODES], roots[NODES], ends[] = {middle, sign};
    int n;

    qdot_chebyshev_derivative(NODES, c, slope);
    n = qdot_chebyshev_crossings(NODES - 1, slope, roots);
    n = n > 0 ? n : 0; /* no roots if a value is not finite */
    p->most = -INFINITY;
    p->least = INFINITY;
    for (int i = 0; i < n + 2; i++) {
        const double x = i < 2 ? ends[i] : roots[i - 2];
        const double value = qdot_chebyshev_at(NODES, c, x);

        if ((x - middle) * sign < 0)
            continue;
        p->most = fmax(p->most, value);
        p->least = fmin(p->least, value);
    }
}

/* Evaluate e on both sides of the singularity, and fit one polynomial through the values of both. */
static qdot_status
fit_both_sides(qdot_run *run, qdot_expr e, size_t k, bool before, double h, double *c, double *error)
{
    const qdot_run_chart *x = run->chart;
    const double place = x->stretches.at[k].t;
    const int own = before == qdot_trajectory_is_backward(&run->course.tr) ? 1 : -1;
    const qdot_expr here = expression_beside_singularity(x, e, k, true, before),
                    there = expression_beside_singularity(x, e, k, false, before);
    double values[NODES];

    *error = 0;
    QDOT_TRY(qdot_pool_check(x->chart.pool));
    QDOT_TRY(evaluate_on_side(run, here, place, h, own, values, error));
    QDOT_TRY(evaluate_on_side(run, there, place, h, -own, values, error));
    qdot_chebyshev_fit(NODES, values, c);
    return QDOT_OK;
}

/* Find where in the interval the distance from the singularity is 0: a new stretch of angles begins just after. */
static qdot_status
find_time_of_passage(qdot_run *run, size_t k, bool before, double h, double *middle)
{
    const qdot_run_chart *x = run->chart;
    double c[NODES], roots[NODES], error;
    size_t i = 0;

    *middle = 0;
    while (i < x->chart.signs.n && !(x->stretches.at[k].passed >> i & 1))
        i++;
    if (i == x->chart.signs.n)
        return QDOT_OK;
    QDOT_TRY(fit_both_sides(run, x->chart.signs.at[i].distance, k, before, h, c, &error));
    if (qdot_chebyshev_crossings(NODES, c, roots) == 1)
        *middle = roots[0];
    return QDOT_OK;
}

/* Find how far the interval may extend: neither to neighbouring changes of the chart's angles, nor to t. */
static double
largest_half_length(const qdot_run *run, size_t k, double t)
{
    const qdot_run_chart *x = run->chart;
    const qdot_trajectory *tr = &run->course.tr;
    const double place = x->stretches.at[k].t;
    const size_t i = qdot_trajectory_locate(tr, place, 0);
    const double after = k + 1 < x->stretches.n ? x->stretches.at[k + 1].t : tr->t[tr->count - 1];
    double h = part * fabs(tr->t[i + 1 < tr->count ? i + 1 : i] - tr->t[i]);

    h = fmin(h, 0.5 * fabs(after - place));
    h = fmin(h, 0.5 * fabs(place - x->stretches.at[k - 1].t));
    return fmin(h, 0.5 * fabs(t - place));
}

qdot_status
qdot_passage_extrema(qdot_run *run, qdot_expr e, size_t k, bool before, double t, qdot_passage *p,
                     bool *found)
{
    const double place = run->chart->stretches.at[k].t;
    const int own = before == qdot_trajectory_is_backward(&run->course.tr) ? 1 : -1;
    double h = largest_half_length(run, k, t);

    *found = false;
    for (int i = 0; i < TRIES && !*found && h > 0; i++, h /= 4) {
        double c[NODES], tail, middle;

        QDOT_TRY(fit_both_sides(run, e, k, before, h, c, &p->error));
        tail = qdot_chebyshev_tail(NODES, c);
        if (!(tail <= fmax(smooth * qdot_chebyshev_size(NODES, c), p->error)))
            continue;
        *found = true;
        QDOT_TRY(find_time_of_passage(run, k, before, h, &middle));
        p->beyond = place + own * h;
        p->error = 2 * p->error + NODES * tail;
        find_extrema(c, middle, own, p);
    }
    return QDOT_OK;
}
