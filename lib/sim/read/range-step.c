/* range-step.c -- the extrema and the integral of an expression in one step of a range.
 *
 * The expression becomes Chebyshev polynomials (num/chebyshev.h), on parts small enough for their
 * last coefficients to vanish, and for nothing to hide between their nodes
 * (sim/bind/polynomial-bounds.h): extrema are where the derivative changes its sign, the mean is
 * the sum of their integrals.
 */
#include <float.h>
#include <math.h>

#include "base/interrupt.h"
#include "ode/scale.h"
#include "sim/error/noise.h"
#include "sim/read/range-parts.h"

enum { MOST_NODES = QDOT_CHEBYSHEV_MOST, DEEPEST = 60, LEAST_PARTS = 64 };

/* Number of parts of a step from which intervals search its extrema, and from which the rest is
 * possibly rounding. */
enum { SEEKING = 16, MANY_PARTS = 512 };

/* Ratio of the last Chebyshev coefficients to the largest in a good fit, if rounding of times is negligible. */
static const double tight = 0x1p-44;

/* If the last coefficients keep this fraction of those with half as many nodes, the fit has not
 * converged. */
static const double no_progress = 0.25;

/* An interval is extrapolated if it is shorter than this fraction of its step, or its nodes err by this much. */
static const double deep = 0x1p-24, blurred = 0x1p-14;

/* A value at an end of the range is off its limit (a jump) if it differs from it relatively by more than this. */
static const double jump = 0x1p-30;

typedef qdot_range_scan scan;
typedef qdot_range_part part;

/* What the values at the nodes of an interval show about it. */
typedef enum {
    ROUGH,     /* no polynomial fits the values at the nodes */
    UNSURE,    /* a polynomial fits, but a peak may hide between the nodes */
    SINGULAR,  /* a polynomial fits, but some function within the expression may be singular */
    HOLLOW,    /* like SINGULAR, but the interval is so short that rounding may be the cause */
    SURE,
    SURPASSED, /* no value in the interval exceeds those found elsewhere */
} verdict;

qdot_status
qdot_range_at(scan *s, double t, double *x)
{
    QDOT_TRY(qdot_reader_read(&s->reader, s->pieces, t, x));
    return isfinite(*x) ? QDOT_OK
                        : qdot_fail(QDOT_EDOMAIN, "it is undefined at t = %.15g", t);
}

/* Include values between low and high, at unknown times, among the largest and smallest found so far. */
static void
include_value_range(scan *s, double low, double high)
{
    s->largest = fmax(s->largest, high);
    s->smallest = fmin(s->smallest, low);
    s->sure[0] = fmax(s->sure[0], low);
    s->sure[1] = fmin(s->sure[1], high);
}

static qdot_status
fit_polynomial(scan *s, part *p, int nodes, bool *good)
{
    const double before = p->tail;
    double tail;

    p->n = nodes;
    for (int j = 0; j < nodes; j++) {
        QDOT_TRY(qdot_range_at(s, qdot_range_time(p, qdot_chebyshev_node(nodes, j)), &p->values[j]));
        qdot_polynomial_bounds_sample(&s->bounds, j, s->reader.in);
    }
    qdot_chebyshev_fit(nodes, p->values, p->c);
    tail = p->tail = qdot_chebyshev_tail(nodes, p->c);
    *good = tail <= (tight + 8 * qdot_range_blur(p)) * qdot_chebyshev_size(nodes, p->c);
    if (!*good && tail <= QDOT_RANGE_NOISES * s->noise) {
        *good = true;
        s->rough = fmax(s->rough, QDOT_RANGE_NOISES * s->noise);
    }
    /* near 0 a state is off by more than its own last bit: the polynomial of its step is
     * as rough as that, and no shorter part is smoother */
    if (!*good && nodes == MOST_NODES && tail > no_progress * before
        && tail <= QDOT_RANGE_NOISES * s->blur) {
        *good = p->rough = true;
        s->rough = fmax(s->rough, QDOT_RANGE_NOISES * tail);
    }
    return QDOT_OK;
}

/* Judge an interval by the Chebyshev polynomial through the values at its nodes. */
static verdict
judge_fit(scan *s, const part *p, bool *good)
{
    const double spread = qdot_chebyshev_spread(p->n, p->c);
    double miss, rounded;

    qdot_polynomial_bounds_look(&s->bounds, p->a, p->b, p->n, NULL, NULL);
    miss = s->bounds.miss[0];
    if (s->kind != QDOT_RANGE_MEAN
        && (s->kind == QDOT_RANGE_MIN || p->c[0] + spread + miss <= s->largest + s->rough)
        && (s->kind == QDOT_RANGE_MAX || p->c[0] - spread - miss >= s->smallest - s->rough))
        return SURPASSED;
    rounded =
        s->parts < MANY_PARTS
            ? 0
            : QDOT_RANGE_NOISES * qdot_polynomial_bounds_rounding(&s->bounds, p->a, p->b);
    if (!*good && qdot_chebyshev_tail(p->n, p->c) <= rounded) {
        *good = true;
        s->rough = fmax(s->rough, rounded);
    }
    if (!*good)
        return ROUGH;
    if (qdot_polynomial_bounds_is_hollow(&s->bounds, 0, fabs(p->b - p->a) / s->length))
        return HOLLOW;
    if (isnan(miss))
        return SINGULAR;
    if (p->rough && miss <= p->tail)
        return SURE;
    return miss <= fmax((tight + 8 * qdot_range_blur(p)) * qdot_chebyshev_size(p->n, p->c),
                        fmax(QDOT_RANGE_NOISES * s->noise, rounded))
               ? SURE
               : UNSURE;
}

static verdict
judge_interval(scan *s, const part *p, bool *good)
{
    const verdict v = judge_fit(s, p, good);

    if (v == SURE || v == SURPASSED)
        return v;
    if (qdot_range_is_beneath(s, p))
        return s->kind == QDOT_RANGE_MEAN ? SURE : SURPASSED;
    /* if values are certainly bounded, do not use the polynomial of an interval near a singularity */
    if (v == HOLLOW)
        return s->kind == QDOT_RANGE_MEAN || s->bounds.resting ||
                       qdot_range_is_beside_switch(s, p) || isinf(s->bounds.box->lo) ||
                       isinf(s->bounds.box->hi)
                   ? SURE
                   : SINGULAR;
    return v;
}

/* The value at an end of an interval: x as evaluated, or the limit from inside if the expression jumps there. */
static double
value_from_inside(scan *s, const part *p, int end, double x)
{
    double limit = qdot_chebyshev_at(p->n, p->c, end == 0 ? -1 : 1);
    double size = qdot_chebyshev_size(p->n, p->c);

    if (fabs(x - limit) <= (jump + 8 * qdot_range_blur(p)) * size)
        return x;
    s->rough = fmax(s->rough, 16 * DBL_EPSILON * size);
    return limit;
}

/* Whether values from low to high, with the error `off`, may exceed the extremes found so far. */
static bool
may_exceed_extremes(const scan *s, double low, double high, double off)
{
    return (s->kind != QDOT_RANGE_MIN && high + off > s->largest) ||
           (s->kind != QDOT_RANGE_MAX && low - off < s->smallest);
}

/* Bound a part in which rounding of times shows, with values low ... high. Where the polynomial may
 * miss more than the extrema found so far, one through more nodes misses less. */
static qdot_status
bound_by_finer_fit(scan *s, const part *p, double low, double high)
{
    const double off = qdot_range_miss(s, p);
    part finer = *p;
    bool good;

    if (p->n < MOST_NODES && off > 16 * DBL_EPSILON * qdot_chebyshev_size(p->n, p->c) &&
        may_exceed_extremes(s, low, high, off)) {
        const qdot_status status = fit_polynomial(s, &finer, 2 * p->n, &good);

        if (status != QDOT_OK && !qdot_reader_has_nothing(status))
            return status;
        if (status != QDOT_OK || !good) /* no finer polynomial fits: use as many nodes as before */
            QDOT_TRY(fit_polynomial(s, &finer, p->n, &good));
        qdot_polynomial_bounds_look(&s->bounds, p->a, p->b, finer.n, NULL, NULL);
    }
    qdot_range_bound_blurred(s, &finer, low, high);
    return QDOT_OK;
}

/* Whether the values of a part differ by no more than its polynomial may be off: extrema of that say
 * nothing. */
static bool
is_constant_within_noise(const scan *s, const part *p)
{
    return s->kind != QDOT_RANGE_MEAN
           && qdot_chebyshev_spread(p->n, p->c)
                  <= fmax(QDOT_RANGE_NOISES * s->noise, tight * qdot_chebyshev_size(p->n, p->c));
}

/* Take the results of an interval: values at its ends, extrema and integral. */
static qdot_status
take_interval(scan *s, const part *p, bool good, bool sure)
{
    double x, d[MOST_NODES], at[MOST_NODES], low = INFINITY, high = -INFINITY;
    int n = 0;

    if (good && !is_constant_within_noise(s, p)) {
        qdot_chebyshev_derivative(p->n, p->c, d);
        if (qdot_chebyshev_size(p->n - 1, d) > 0)
            n = qdot_chebyshev_crossings(p->n - 1, d, at);
        good = n >= 0;
    }
    for (int end = 0; end < 2; end++) {
        double t = end == 0 ? p->a : p->b;

        if (s->odd[end] && t == s->ends[end]) {
            x = qdot_chebyshev_at(p->n, p->c, end == 0 ? -1 : 1);
            s->rough = fmax(s->rough, 16 * DBL_EPSILON * qdot_chebyshev_size(p->n, p->c));
        } else {
            QDOT_TRY(qdot_range_at(s, t, &x));
            if (good)
                x = value_from_inside(s, p, end, x);
        }
        low = fmin(low, x);
        high = fmax(high, x);
        qdot_range_meet(s, x);
        if (!s->begun)
            s->first = x;
        s->begun = true;
    }
    if (good && is_constant_within_noise(s, p)) {
        for (int j = 0; j < p->n; j++)
            qdot_range_meet(s, p->values[j]);
        s->rough = fmax(s->rough, qdot_chebyshev_spread(p->n, p->c));
    } else if (good) {
        for (int k = 0; k < n; k++) {
            QDOT_TRY(qdot_range_at(s, qdot_range_time(p, at[k]), &x));
            low = fmin(low, x);
            high = fmax(high, x);
            qdot_range_meet(s, x);
        }
        if (sure && 8 * qdot_range_blur(p) > tight)
            QDOT_TRY(bound_by_finer_fit(s, p, low, high));
    } else {
        low = INFINITY;
        high = -INFINITY;
        for (int j = 0; j < p->n; j++) {
            low = fmin(low, p->values[j]);
            high = fmax(high, p->values[j]);
        }
        include_value_range(s, low, high);
        s->left += (high - low) * fabs(p->b - p->a);
    }
    s->integral += 0.5L * (p->b - p->a) * qdot_chebyshev_integral(p->n, p->c);
    return QDOT_OK;
}

static qdot_status
find_effect_of_state_errors(scan *s, double t)
{
    qdot_reader *r = &s->reader;
    double value, other;

    QDOT_TRY(qdot_range_at(s, t, &value));
    for (size_t k = 0; k < r->n_courses; k++) {
        const qdot_reader_course *c = r->courses + k;
        const double by = qdot_range_roughness(&c->course->tr);

        for (size_t i = 0; i < 2 * c->n; i++)
            c->in[i] += ((i + k) % 2 ? -by : by) * qdot_ode_size(c->course->stage->scales, i, c->in[i]);
    }
    QDOT_TRY(qdot_reader_evaluate(r, t, &other));
    s->blur = fabs(other - value);
    return QDOT_OK;
}

/* Find the rounding noise of the expression's values in the step, and that of the nodes' times; 0 if unknown. */
static qdot_status
find_rounding_noise(scan *s, double a, double b)
{
    const double middle = 0.5 * (a + b);
    qdot_status status = qdot_noise_at(&s->reader, s->pieces, middle, &s->noise);

    s->parts = 0;
    if (status == QDOT_OK)
        status = find_effect_of_state_errors(s, middle);
    if (status != QDOT_OK || !isfinite(s->noise))
        s->noise = 0;
    if (status != QDOT_OK || !isfinite(s->blur))
        s->blur = 0;
    return qdot_grave(status);
}

/* The mean magnitude of the values in an interval, leaving out the largest one. */
static double
mean_without_largest(const part *p)
{
    double sum = 0, largest = 0;

    for (int j = 0; j < p->n; j++) {
        sum += fabs(p->values[j]);
        largest = fmax(largest, fabs(p->values[j]));
    }
    return (sum - largest) / (p->n - 1);
}

/* Whether bounds from the step's Taylor series exclude that the expression exceeds the extremes so far. */
static qdot_status
is_below_extremes(scan *s, double a, double b, bool *surpassed)
{
    const qdot_reader *r = &s->reader;
    const qdot_ode_system *system;
    qdot_ode_expanded step;
    double x, above, below;

    *surpassed = false;
    if (!s->begun || s->kind == QDOT_RANGE_MEAN || r->n_courses != 1 || r->of.accelerations
        || r->of.plan->read_side)
        return QDOT_OK;
    QDOT_TRY(qdot_grave(qdot_reader_read(&s->reader, s->pieces, 0.5 * (a + b), &x)));
    if (!qdot_trajectory_expanded(r->courses[0].cursor, &system, &step))
        return QDOT_OK;
    step.t_end = b;
    qdot_polynomial_bounds_series(&s->bounds, system->series, &step);
    above = s->bounds.out[0] + (1 + 0x1p-20) * s->bounds.out_radius[0];
    below = s->bounds.out[0] - (1 + 0x1p-20) * s->bounds.out_radius[0];
    *surpassed = (s->kind == QDOT_RANGE_MIN || above <= s->largest)
                 && (s->kind == QDOT_RANGE_MAX || below >= s->smallest);
    return QDOT_OK;
}

qdot_status
qdot_range_step(scan *s, double a, double b)
{
    double ends[DEEPEST + 2], from = a;
    int depth = 1;
    bool surpassed;

    QDOT_TRY(is_below_extremes(s, a, b, &surpassed));
    if (surpassed)
        return QDOT_OK;
    ends[0] = b;
    s->ends[0] = a;
    s->ends[1] = b;
    s->length = fabs(b - a);
    s->sought = false;
    QDOT_TRY(find_rounding_noise(s, a, b));
    qdot_polynomial_bounds_begin(&s->bounds, s->least);
    while (depth > 0) {
        part p = {.a = from, .b = ends[depth - 1], .tail = INFINITY};
        bool good = false, short_one = qdot_range_is_short(s, &p);
        verdict v = ROUGH;
        int nodes = s->nodes;

        QDOT_TRY(qdot_interrupt_check());
        for (;; nodes *= 2) {
            QDOT_TRY(fit_polynomial(s, &p, nodes, &good));
            if (good || nodes == MOST_NODES || short_one)
                break;
        }
        if (!short_one)
            v = judge_interval(s, &p, &good);
        /* with constant inputs, jumps between values are rounding */
        short_one = short_one || (v == ROUGH && s->bounds.resting);
        if (s->parts == 0 && depth == 1)
            s->typical = mean_without_largest(&p);
        if (good)
            s->nodes = p.rough ? nodes / 2 : nodes;
        if (v == SURPASSED) {
            if (!s->begun)
                QDOT_TRY(take_interval(s, &p, good, false));
            from = p.b;
            depth--;
            continue;
        }
        if (v == SURE || short_one || depth == DEEPEST || ++s->parts > s->most_parts) {
            QDOT_TRY(take_interval(s, &p, good, v == SURE));
            if (v != SURE)
                qdot_range_leave_open(s, &p, short_one);
            if (short_one)
                qdot_range_look_for_pole(s, &p);
            if (s->parts == s->most_parts + 1 && s->most_parts > LEAST_PARTS)
                s->most_parts /= 2;
            if (fabs(p.b - p.a) <= deep * s->length
                && (short_one || 8 * qdot_range_blur(&p) > blurred))
                qdot_range_look_towards(s, &p);
            from = p.b;
            depth--;
            continue;
        }
        if (s->parts >= SEEKING && !s->sought)
            QDOT_TRY(qdot_range_seek(s));
        s->sought = s->sought || s->parts >= SEEKING;
        s->nodes = 16;
        /* cut beside the middle, as the expression may be undefined exactly there, as sin(x)/x at 0 */
        ends[depth++] =
            p.a + (v == SINGULAR ? QDOT_POLYNOMIAL_BOUNDS_BESIDE : 0.5) * (p.b - p.a);
    }
    return QDOT_OK;
}
