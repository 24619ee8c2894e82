/* pole.c -- finds curves that run to infinity. */
#include "show/pole.h"

#include <math.h>
#include <stdlib.h>

#include "base/memory.h"

/* CLOSER: how often the interval around a greatest value is halved: 1/sqrt(x) grows by 2^20 meanwhile. */
enum { CLOSER = 40 };

static const double part = 0.05, far_beyond = 3, much_greater = 1e4;

/* A value of y, and its weight: the length of the parameter interval that it stands for. */
typedef struct {
    double y, weight;
} weighed;

static int
compare_values(const void *a, const void *b)
{
    const double x = ((const weighed *)a)->y, y = ((const weighed *)b)->y;

    return (x > y) - (x < y);
}

/* Find quantiles of y, low and high, beyond which only a small part of the curve lies; *some: y is finite somewhere. */
static qdot_status
find_quantiles(const qdot_trace *p, double *low, double *high, bool *some)
{
    weighed *all = qdot_calloc(p->n + 1, sizeof *all);
    double sum = 0, below = 0;
    size_t n = 0;

    if (all == NULL)
        return QDOT_ENOMEM;
    for (size_t k = 0; k < p->n; k++) {
        const size_t before = k > 0 ? k - 1 : k, after = k + 1 < p->n ? k + 1 : k;

        if (isfinite(p->at[1][k]))
            all[n++] = (weighed){p->at[1][k], fabs(p->s[after] - p->s[before])};
    }
    qsort(all, n, sizeof *all, compare_values);
    for (size_t k = 0; k < n; k++)
        sum += all[k].weight;
    *some = n > 0 && sum > 0;
    for (size_t k = 0; k < n; k++) {
        if (below <= part * sum)
            *low = all[k].y;
        if (below <= (1 - part) * sum)
            *high = all[k].y;
        below += all[k].weight;
    }
    qdot_free(all);
    return QDOT_OK;
}

/* The index of the point with the greatest y (sign 1) or the least (sign -1). */
static size_t
find_extremum(const qdot_trace *p, double sign)
{
    size_t best = p->n;

    for (size_t k = 0; k < p->n; k++)
        if (isfinite(p->at[1][k]) && (best == p->n || sign * p->at[1][k] > sign * p->at[1][best]))
            best = k;
    return best;
}

/* Whether sign * y grows by a large factor beyond its value at point k as the curve is sampled ever closer there. */
static qdot_status
is_diverging(const qdot_trace_source *source, const qdot_trace *p, size_t k, double sign, bool *is)
{
    double a = p->s[k > 0 ? k - 1 : k], m = p->s[k], b = p->s[k + 1 < p->n ? k + 1 : k];
    double top = sign * p->at[1][k];
    const double enough = much_greater * fabs(top);

    *is = false;
    for (int i = 0; i < CLOSER && !*is; i++) {
        const double s[2] = {a + (m - a) / 2, m + (b - m) / 2};
        double values[4], left, right;

        QDOT_TRY(source->values(source->user, 2, s, values));
        left = isnan(values[2]) ? -INFINITY : sign * values[2];
        right = isnan(values[3]) ? -INFINITY : sign * values[3];
        if (left > top && left >= right) {
            b = m;
            m = s[0];
            top = left;
        } else if (right > top) {
            a = m;
            m = s[1];
            top = right;
        } else {
            a = s[0];
            b = s[1];
        }
        *is = top > enough;
    }
    return QDOT_OK;
}

qdot_status
qdot_pole_find(const qdot_trace_source *source, const qdot_trace *p, qdot_figure_range *shown)
{
    double low = 0, high = 0;
    bool some;

    *shown = (qdot_figure_range){0};
    QDOT_TRY(find_quantiles(p, &low, &high, &some));
    if (!some || !(high > low))
        return QDOT_OK;
    for (int i = 0; i < 2 && !shown->set; i++) {
        const double sign = i == 0 ? 1 : -1, beyond = far_beyond * (high - low);
        const size_t k = find_extremum(p, sign);

        if (sign * p->at[1][k] > (i == 0 ? high : -low) + beyond)
            QDOT_TRY(is_diverging(source, p, k, sign, &shown->set));
    }
    shown->least = low - (high - low) / 2;
    shown->most = high + (high - low) / 2;
    return QDOT_OK;
}
