/* watch-two.c -- evaluates watched functions in double-double precision where doubles do not decide their sign. */
#include "sim/watch/watch-parts.h"
#include "sim/watch/watch.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* A function smaller than this, relative to its terms, is evaluated in double-double precision. */
static const double small = 0x1p-20;

bool
qdot_watch_can_two(const qdot_watch *w, size_t i)
{
    return qdot_watch_has_two(w, i) && !w->accelerations && (w->clock[i] || (w->reader.read_two && w->expanded));
}

/* Whether any function can be evaluated in two doubles: the state is available so, or a function
 * depends on t only. */
static bool
can_use_double_double(const qdot_watch *w)
{
    bool any = w->reader.read_two && w->expanded;

    for (size_t i = 0; i < w->m && !any; i++)
        any = w->clock[i] && w->live[i];
    return any && !w->accelerations;
}

qdot_status
qdot_watch_read_two(qdot_watch *w, double t)
{
    if (w->reader.read_two && w->expanded)
        return w->reader.read_two(t, w->state_two, w->reader.user);
    QDOT_TRY(w->reader.read(t, w->in, w->reader.user)); /* no double-double state: functions of t alone need none */
    for (size_t k = 0; k < 2 * w->n; k++)
        w->state_two[k] = (qdot_two){w->in[k], 0};
    return QDOT_OK;
}

/* The largest |g_i| at the nodes. */
static double
sampled_size(const qdot_watch *w, size_t i, int nodes)
{
    double size = 0;

    for (int j = 0; j < nodes; j++)
        size = fmax(size, fabs(w->samples[i * QDOT_WATCH_NODES + (size_t)j]));
    return size;
}

qdot_status
qdot_watch_make_two(qdot_watch *w)
{
    if (w->two)
        return QDOT_OK;
    w->state_two = qdot_malloc((2 * w->n + 1) * sizeof *w->state_two);
    if (!w->state_two)
        return QDOT_ENOMEM;
    return qdot_tape_two_new(w->plain ? w->plain : w->tape, 0, 2 * w->n + 1, &w->two);
}

/* The range of numbers for double-double arithmetic, which overflows or underflows outside of it. */
static const double least_of_two = 1 / QDOT_WATCH_MOST, most_of_two = QDOT_WATCH_MOST;

static bool
is_in_double_double_range(const qdot_watch *w, size_t i)
{
    const double size = fabs(qdot_tape_two_output(w->two, i)[0].hi);

    return w->wants[i] && qdot_watch_has_two(w, i) && !w->now.blurred[i] && size >= least_of_two && size <= most_of_two;
}

/* Whether function i is exactly 0 in double-double precision: then its double is only rounding or underflow. */
static bool
is_exactly_zero(const qdot_watch *w, size_t i)
{
    return w->wants[i] && qdot_watch_has_two(w, i) && !w->now.blurred[i] && qdot_tape_two_output(w->two, i)[0].hi == 0;
}

static void
evaluate_in_double_double(qdot_watch *w, double t, const qdot_two *y)
{
    for (size_t k = 0; k < 2 * w->n; k++)
        *qdot_tape_two_input(w->two, k) = y[k];
    *qdot_tape_two_input(w->two, 2 * w->n) = (qdot_two){t, 0};
    qdot_tape_two_order(w->two, 0);
}

static qdot_status
find_double_double_values(qdot_watch *w, double t, const qdot_two *y, bool start, double *g)
{
    bool rest = false;

    for (size_t k = 0; k < 2 * w->n; k++)
        w->in[k] = y[k].hi;
    evaluate_in_double_double(w, t, y);
    if (start)
        w->steady = qdot_tape_two_sides(w->two) != 0;
    for (size_t i = 0; i < w->m; i++)
        rest = rest || !is_in_double_double_range(w, i);
    if (rest)
        QDOT_TRY(qdot_watch_value(w, t, g));
    for (size_t i = 0; i < w->m; i++)
        if (is_in_double_double_range(w, i))
            g[i] = qdot_tape_two_output(w->two, i)[0].hi;
        else if (is_exactly_zero(w, i) && fabs(g[i]) > DBL_MIN) /* the double value consists of rounding only */
            g[i] = 0;
    return QDOT_OK;
}

static double
difference_to_double(qdot_two a, double b)
{
    return qdot_two_add_double(a, -b).hi;
}

qdot_status
qdot_watch_value_two(qdot_watch *w, double t, double *g)
{
    QDOT_TRY(qdot_watch_make_two(w));
    QDOT_TRY(qdot_watch_read_two(w, t));
    QDOT_TRY(find_double_double_values(w, t, w->state_two, false, g));
    for (size_t i = 0; i < w->m; i++)
        if (w->now.offset[i] != 0 && is_in_double_double_range(w, i))
            g[i] = difference_to_double(qdot_tape_two_output(w->two, i)[0], w->now.offset[i]);
    return QDOT_OK;
}

qdot_status
qdot_watch_value_at_start(qdot_watch *w, double t, const double *y, const double *low, double *g)
{
    QDOT_TRY(qdot_watch_make_two(w));
    for (size_t i = 0; i < w->m; i++)
        w->wants[i] = true;
    for (size_t k = 0; k < 2 * w->n; k++)
        w->state_two[k] = qdot_two_add_double((qdot_two){y[k], 0}, low ? low[k] : 0);
    return find_double_double_values(w, t, w->state_two, true, g);
}

qdot_status
qdot_watch_value_at_begin(qdot_watch *w, const double *low)
{
    const bool all = w->reader.read_two && !w->accelerations;
    double *g = all ? w->start.g0 : w->moved;
    bool any = all;

    for (size_t i = 0; i < w->m; i++) {
        w->start.sharp[i] = all || (w->clock[i] && !w->accelerations);
        any = any || w->start.sharp[i];
    }
    memcpy(w->in, w->y, 2 * w->n * sizeof *w->y);
    if (!all)
        QDOT_TRY(qdot_watch_value(w, w->t, w->start.g0));
    if (any)
        QDOT_TRY(qdot_watch_value_at_start(w, w->t, w->y, low, g));
    for (size_t i = 0; i < w->m; i++) {
        w->start.sharp[i] = w->start.sharp[i] && qdot_watch_has_two(w, i);
        if (w->start.sharp[i])
            w->start.g0[i] = g[i];
    }
    return QDOT_OK;
}

/* Test whether all switches in the functions keep their sides on the interval; result: w->steady. */
static qdot_status
test_constant_sides(qdot_watch *w, const qdot_watch_part *p)
{
    enum { PLACES = 4 };
    uint64_t sides = 0;

    QDOT_TRY(qdot_watch_make_two(w));
    w->steady = true;
    for (int k = 0; k <= PLACES && w->steady; k++) {
        const double t = k == PLACES ? p->b : p->a + (p->b - p->a) * k / PLACES;
        uint64_t here;

        QDOT_TRY(qdot_watch_read_two(w, t));
        evaluate_in_double_double(w, t, w->state_two);
        here = qdot_tape_two_sides(w->two);
        w->steady = here != 0 && (k == 0 || here == sides);
        sides = here;
    }
    return QDOT_OK;
}

/* A polynomial through values in doubles does not show all of a function whose rounding is more than this part of its
 * size. */
static const double shown = 0x1p-44;

/* Find functions of t whose rounding error, far from t = 0, exceeds the error allowed for their polynomial. */
static qdot_status
find_imprecise_functions_of_time(qdot_watch *w, const qdot_watch_part *p, int nodes, bool *any)
{
    for (size_t i = 0; i < w->m; i++) {
        double noise;

        if (!w->live[i] || !w->clock[i] || w->wants[i] || w->now.blurred[i] || !qdot_watch_can_two(w, i))
            continue;
        QDOT_TRY(qdot_watch_operations_within(w, p, false, i, &noise));
        w->wants[i] = noise > shown * sampled_size(w, i, nodes);
        *any = *any || w->wants[i];
    }
    return QDOT_OK;
}

qdot_status
qdot_watch_wants_two(qdot_watch *w, const qdot_watch_part *p, int nodes, bool *any)
{
    bool sought = false;

    *any = false;
    if (!can_use_double_double(w))
        return QDOT_OK;
    for (int end = 0; end < 2; end++) { /* near a pole the terms are large */
        const double t = end == 0 ? p->a : p->b;

        QDOT_TRY(w->reader.read(t, w->in, w->reader.user));
        w->in[2 * w->n] = t;
        qdot_tape_eval(w->sizes, w->in, end == 0 ? w->g : w->moved, w->work);
    }
    for (size_t i = 0; i < w->m; i++) {
        if (!w->live[i] || w->coordinate[i] != SIZE_MAX || w->now.blurred[i])
            continue;
        w->moved[i] = fmin(w->moved[i], w->g[i]);
        w->wants[i] = w->now.on[i]
                      || (w->moved[i] <= most_of_two && sampled_size(w, i, nodes) < small * w->moved[i]);
        if (w->wants[i] && !w->smooth[i] && !sought) {
            QDOT_TRY(test_constant_sides(w, p));
            sought = true;
        }
        w->wants[i] = w->wants[i] && qdot_watch_can_two(w, i);
        *any = *any || w->wants[i];
    }
    return find_imprecise_functions_of_time(w, p, nodes, any);
}

qdot_status
qdot_watch_sharpen_end(qdot_watch *w, qdot_watch_part *p, size_t i)
{
    const bool others = w->fine, wanted = w->wants[i];

    if (!qdot_watch_can_two(w, i) || w->now.blurred[i] || qdot_watch_is_fine(w, i)
        || fabs(p->at_end) >= small * sampled_size(w, i, p->n))
        return QDOT_OK;
    w->fine = w->wants[i] = true;
    QDOT_TRY(qdot_watch_value_at(w, p->b, w->g));
    w->fine = others;
    w->wants[i] = wanted;
    p->at_end = w->g[i];
    p->sharp = true;
    return QDOT_OK;
}

qdot_status
qdot_watch_rate(qdot_watch *w, double t, const double *y, const double *low, const double *rates,
                const double *fast, size_t i, double *rate, double *noise)
{
    double *there = qdot_malloc((2 * w->n + 1) * sizeof *there), g = 0, h = 0x1p-20;
    bool exact = false;
    qdot_status status = there ? QDOT_OK : QDOT_ENOMEM;

    if (status == QDOT_OK) {
        memcpy(w->in, y, 2 * w->n * sizeof *y);
        status = w->accelerations ? qdot_watch_value(w, t, w->g) : qdot_watch_value_at_start(w, t, y, low, w->g);
        exact = !w->accelerations && qdot_watch_has_two(w, i);
        h = exact ? 0x1p-40 : h;
        g = w->g[i];
    }
    for (size_t k = 0; k < 2 * w->n && there; k++)
        there[k] = exact ? (low ? low[k] : 0) + h * rates[k] : y[k] + h * rates[k];
    if (status == QDOT_OK && !exact)
        memcpy(w->in, there, 2 * w->n * sizeof *there);
    if (status == QDOT_OK)
        status = exact ? qdot_watch_value_at_start(w, t + h, y, there, w->g)
                       : qdot_watch_value(w, t + h, w->g);
    *rate = status == QDOT_OK ? (w->g[i] - g) / h : 0;
    if (status == QDOT_OK)
        status = qdot_watch_noise_of(w, t, y, fast, i, noise);
    qdot_free(there);
    return status;
}
