/* range.c -- the extrema, the mean and the drift of an expression over a range of a run.
 *
 * Step by step the expression becomes Chebyshev polynomials (num/chebyshev.h), on parts
 * small enough for their last coefficients to vanish, and for nothing to hide between their
 * nodes (sim/course/polynomial-bounds.h): extrema are where the derivative changes its sign, the mean is the sum
 * of their integrals.
 */
#include <float.h>
#include <math.h>
#include <string.h>

#include "base/interrupt.h"
#include "expr/print.h"
#include "ode/companion.h"
#include "sim/error/companion.h"
#include "sim/error/horizon.h"
#include "sim/error/noise.h"
#include "sim/read/range-parts.h"

enum { MOST_NODES = QDOT_CHEBYSHEV_MOST, DEEPEST = 60, LEAST_PARTS = 64, MOST_PARTS = 8192 };

/* Number of parts of a step from which intervals search its extrema, and from which the rest is
 * possibly rounding. */
enum { SEEKING = 16, MANY_PARTS = 512 };

/* Size of the last coefficients relative to the largest, if rounding of times is negligible. */
static const double tight = 0x1p-44;

/* If the last coefficients keep this fraction of those with half as many nodes, the fit has not
 * converged. */
static const double no_progress = 0.25;

/* A part so short, relative to its step, or so blurred is extrapolated from both sides. */
static const double deep = 0x1p-24, blurred = 0x1p-14;

/* An end of the range where the limit from within is another value. */
static const double jump = 0x1p-30;

typedef qdot_range_scan scan;
typedef qdot_range_part part;

/* The result of the values at the nodes of a part. */
typedef enum {
    ROUGH,     /* they fit no polynomial */
    UNSURE,    /* one, but something may hide between them */
    SINGULAR,  /* one, and something in its formula may be singular */
    HOLLOW,    /* likewise, on a part so small that it is maybe none */
    SURE,
    SURPASSED, /* it holds nothing beyond what was met elsewhere */
} verdict;

static qdot_status
value_at(scan *s, double t, double *x)
{
    QDOT_TRY(qdot_reader_at(&s->reader, s->piece, t, x));
    return isfinite(*x) ? QDOT_OK
                        : qdot_fail(QDOT_EDOMAIN, "it is undefined at t = %.15g", t);
}

/* Count values between low and high at unknown times. */
static void
meet_roughly(scan *s, double low, double high)
{
    s->largest = fmax(s->largest, high);
    s->smallest = fmin(s->smallest, low);
    s->sure[0] = fmax(s->sure[0], low);
    s->sure[1] = fmin(s->sure[1], high);
}

static qdot_status
fit(scan *s, part *p, int nodes, bool *good)
{
    const double before = p->tail;
    double tail;

    p->n = nodes;
    for (int j = 0; j < nodes; j++) {
        QDOT_TRY(value_at(s, qdot_range_time(p, qdot_chebyshev_node(nodes, j)), &p->values[j]));
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

/* Judge a part by its polynomial through the values at the nodes. */
static verdict
judge_fit(scan *s, const part *p, bool *good)
{
    const double spread = qdot_chebyshev_spread(p->n, p->c);
    double miss, rounded;

    qdot_polynomial_bounds_look(&s->bounds, p->a, p->b, p->n, NULL, NULL);
    miss = s->bounds.miss[0];
    if ((s->kind == QDOT_RANGE_MAX && p->c[0] + spread + miss <= s->largest)
        || (s->kind == QDOT_RANGE_MIN && p->c[0] - spread - miss >= s->smallest))
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
    return miss <= fmax((tight + 8 * qdot_range_blur(p)) * qdot_chebyshev_size(p->n, p->c),
                        fmax(QDOT_RANGE_NOISES * s->noise, rounded))
               ? SURE
               : UNSURE;
}

static verdict
judge(scan *s, const part *p, bool *good)
{
    const verdict v = judge_fit(s, p, good);

    if (v == SURE || v == SURPASSED)
        return v;
    if (qdot_range_is_beneath(s, p))
        return s->kind == QDOT_RANGE_MEAN ? SURE : SURPASSED;
    /* where values have bounds for sure, the polynomial of an edge is not taken for it */
    if (v == HOLLOW)
        return s->kind == QDOT_RANGE_MEAN || s->bounds.resting ||
                       qdot_range_is_beside_switch(s, p) || isinf(s->bounds.box->lo) ||
                       isinf(s->bounds.box->hi)
                   ? SURE
                   : SINGULAR;
    return v;
}

/* The value x at an end of a part, or where that is a point by itself the limit. */
static double
from_within(scan *s, const part *p, int end, double x)
{
    double limit = qdot_chebyshev_at(p->n, p->c, end == 0 ? -1 : 1);
    double size = qdot_chebyshev_size(p->n, p->c);

    if (fabs(x - limit) <= (jump + 8 * qdot_range_blur(p)) * size)
        return x;
    s->rough = fmax(s->rough, 16 * DBL_EPSILON * size);
    return limit;
}

/* Ends, extrema, integral of a part. */
static qdot_status
take_part(scan *s, const part *p, bool good, bool sure)
{
    double x, d[MOST_NODES], at[MOST_NODES], low = INFINITY, high = -INFINITY;
    int n = 0;

    for (int end = 0; end < 2; end++) {
        double t = end == 0 ? p->a : p->b;

        if (s->odd[end] && t == s->ends[end]) {
            x = qdot_chebyshev_at(p->n, p->c, end == 0 ? -1 : 1);
            s->rough = fmax(s->rough, 16 * DBL_EPSILON * qdot_chebyshev_size(p->n, p->c));
        } else {
            QDOT_TRY(value_at(s, t, &x));
            if (good)
                x = from_within(s, p, end, x);
        }
        low = fmin(low, x);
        high = fmax(high, x);
        qdot_range_meet(s, x);
        if (!s->begun)
            s->first = x;
        s->begun = true;
    }
    if (good) {
        qdot_chebyshev_derivative(p->n, p->c, d);
        if (qdot_chebyshev_size(p->n - 1, d) > 0)
            n = qdot_chebyshev_crossings(p->n - 1, d, at);
        for (int k = 0; k < n; k++) {
            QDOT_TRY(value_at(s, qdot_range_time(p, at[k]), &x));
            low = fmin(low, x);
            high = fmax(high, x);
            qdot_range_meet(s, x);
        }
        if (sure && 8 * qdot_range_blur(p) > tight)
            qdot_range_bound_blurred(s, p, low, high);
    } else {
        low = INFINITY;
        high = -INFINITY;
        for (int j = 0; j < p->n; j++) {
            low = fmin(low, p->values[j]);
            high = fmax(high, p->values[j]);
        }
        meet_roughly(s, low, high);
        s->left += (high - low) * fabs(p->b - p->a);
    }
    s->integral += 0.5L * (p->b - p->a) * qdot_chebyshev_integral(p->n, p->c);
    return QDOT_OK;
}

static qdot_status
find_blur(scan *s, double t)
{
    qdot_reader *r = &s->reader;
    double value, other;

    QDOT_TRY(value_at(s, t, &value));
    for (size_t i = 0; i < 2 * r->of.plan->n; i++)
        r->in[i] += (i % 2 ? -0x1p-53 : 0x1p-53) * fmax(1, fabs(r->in[i]));
    QDOT_TRY(qdot_reader_evaluate(r, t, &other));
    s->blur = fabs(other - value);
    return QDOT_OK;
}

/* Noise and blur in the step; 0 where they are not known. */
static qdot_status
find_noise(scan *s, double a, double b)
{
    const double middle = 0.5 * (a + b);
    qdot_status status = qdot_noise_at(&s->reader, s->piece, middle, &s->noise);

    s->parts = 0;
    if (status == QDOT_OK)
        status = find_blur(s, middle);
    if (status != QDOT_OK || !isfinite(s->noise))
        s->noise = 0;
    if (status != QDOT_OK || !isfinite(s->blur))
        s->blur = 0;
    return status == QDOT_ENOMEM || status == QDOT_EINTR ? status : QDOT_OK;
}

/* The mean of the sizes of the values but for the largest. */
static double
middling(const part *p)
{
    double sum = 0, largest = 0;

    for (int j = 0; j < p->n; j++) {
        sum += fabs(p->values[j]);
        largest = fmax(largest, fabs(p->values[j]));
    }
    return (sum - largest) / (p->n - 1);
}

static qdot_status
scan_step(scan *s, double a, double b)
{
    double ends[DEEPEST + 2], from = a;
    int depth = 1;

    ends[0] = b;
    s->ends[0] = a;
    s->ends[1] = b;
    s->length = fabs(b - a);
    s->sought = false;
    QDOT_TRY(find_noise(s, a, b));
    qdot_polynomial_bounds_begin(&s->bounds);
    while (depth > 0) {
        part p = {.a = from, .b = ends[depth - 1], .tail = INFINITY};
        bool good = false, short_one = qdot_range_is_short(s, &p);
        verdict v = ROUGH;
        int nodes = s->nodes;

        QDOT_TRY(qdot_interrupt_check());
        for (;; nodes *= 2) {
            QDOT_TRY(fit(s, &p, nodes, &good));
            if (good || nodes == MOST_NODES || short_one)
                break;
        }
        if (!short_one)
            v = judge(s, &p, &good);
        /* what it jumps between while its inputs rest is their rounding */
        short_one = short_one || (v == ROUGH && s->bounds.resting);
        if (s->parts == 0 && depth == 1)
            s->typical = middling(&p);
        if (good)
            s->nodes = p.rough ? nodes / 2 : nodes;
        if (v == SURPASSED) {
            if (!s->begun)
                QDOT_TRY(take_part(s, &p, good, false));
            from = p.b;
            depth--;
            continue;
        }
        if (v == SURE || short_one || depth == DEEPEST || ++s->parts > s->most_parts) {
            QDOT_TRY(take_part(s, &p, good, v == SURE));
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
        /* beside where it may be undefined, as sin(x)/x is */
        ends[depth++] =
            p.a + (v == SINGULAR ? QDOT_POLYNOMIAL_BOUNDS_BESIDE : 0.5) * (p.b - p.a);
    }
    return QDOT_OK;
}

/* All of the course that lies between from and to, in its direction. */
static qdot_status
scan_course(scan *s, double from, double to)
{
    const qdot_trajectory *tr = &s->reader.course->tr;
    double direction = tr->t[tr->count - 1] < tr->t[0] ? -1 : 1;

    s->nodes = 16;
    s->largest = -INFINITY;
    s->smallest = INFINITY;
    s->highest = s->sure[0] = -INFINITY;
    s->lowest = s->sure[1] = INFINITY;
    for (s->piece = 0; s->piece < tr->pieces.n; s->piece++) {
        size_t k = tr->pieces.at[s->piece].first, first = k;
        bool more = s->piece + 1 < tr->pieces.n;
        size_t end = more ? tr->pieces.at[s->piece + 1].first : tr->count;
        bool enters = s->piece > 0 && !tr->pieces.at[s->piece].jumped;
        bool leaves = more && !tr->pieces.at[s->piece + 1].jumped;

        for (; k < end; k++) {
            double a = tr->t[k], b = k + 1 < end ? tr->t[k + 1] : a, x;

            a = direction > 0 ? fmax(a, from) : fmin(a, from);
            b = direction > 0 ? fmin(b, to) : fmax(b, to);
            if (direction * (b - a) < 0)
                continue;
            s->odd[0] = enters && a == tr->t[first];
            s->odd[1] = leaves && b == tr->t[end - 1];
            if (a != b) {
                QDOT_TRY(scan_step(s, a, b));
                continue;
            }
            if (from != to) /* a point by itself, which its steps have met */
                continue;
            QDOT_TRY(value_at(s, a, &x));
            qdot_range_meet(s, x);
            if (!s->begun)
                s->first = x;
            s->begun = true;
        }
    }
    return QDOT_OK;
}

static double
result(const scan *s, qdot_range_kind kind, double from, double to)
{
    switch (kind) {
    case QDOT_RANGE_MAX: return s->largest;
    case QDOT_RANGE_MIN: return s->smallest;
    case QDOT_RANGE_MEAN:
        return from == to ? s->first : (double)(s->integral / (to - from));
    default:
        return fmax(s->largest - s->first, s->first - s->smallest)
               / fmax(1, fabs(s->first));
    }
}

/* The open part of a result: limits may lie beyond the values found, rough parts may not reach
 * theirs. */
static double
open_of(const scan *s, qdot_range_kind kind, double from, double to)
{
    double above = fmax(0, s->highest - s->largest) + (s->largest - s->sure[0]);
    double below = fmax(0, s->smallest - s->lowest) + (s->sure[1] - s->smallest);

    if (s->open)
        return NAN;
    switch (kind) {
    case QDOT_RANGE_MAX: return above;
    case QDOT_RANGE_MIN: return below;
    case QDOT_RANGE_MEAN: return from == to ? 0 : s->left / fabs(to - from);
    default: return fmax(above, below) / fmax(1, fabs(s->first));
    }
}

static qdot_status
check_bounds(const scan *s, qdot_range_kind kind)
{
    if (kind == QDOT_RANGE_MEAN ? !s->diverges
        : kind == QDOT_RANGE_MAX ? !s->above
        : kind == QDOT_RANGE_MIN ? !s->below
                                 : !s->above && !s->below)
        return QDOT_OK;
    return qdot_fail(QDOT_EDOMAIN,
                     kind == QDOT_RANGE_MEAN  ? "it has no mean: its integral diverges at t = %.9g"
                     : kind == QDOT_RANGE_MIN ? "it has no bound: it falls below all towards t = %.9g"
                                              : "it has no bound: it grows beyond all towards t = %.9g",
                     s->pole);
}

/* The arguments of qdot_run_range. */
typedef struct {
    qdot_run *run;
    qdot_range_kind kind;
    double from, to;
    qdot_reading of; /* one expression */
} question;

static qdot_status
over_course(const question *q, const qdot_course *course, double *value, double *rough)
{
    scan s = {.kind = q->kind, .most_parts = MOST_PARTS};
    qdot_status status = qdot_reader_init(&s.reader, &q->of, course);

    if (status == QDOT_OK)
        status = qdot_polynomial_bounds_init(&s.bounds, q->of.tape, 2 * q->of.plan->n);
    if (status == QDOT_OK)
        status = scan_course(&s, q->from, q->to);
    if (status == QDOT_OK && !s.begun)
        status = qdot_fail(QDOT_EDOMAIN, "the range holds nothing of the run");
    if (status == QDOT_OK)
        status = check_bounds(&s, q->kind);
    if (status == QDOT_OK) {
        *value = result(&s, q->kind, q->from, q->to);
        *rough = s.rough + open_of(&s, q->kind, q->from, q->to);
    }
    qdot_polynomial_bounds_clear(&s.bounds);
    qdot_reader_clear(&s.reader);
    return status;
}

static qdot_status
check_range(const qdot_run *run, double from, double to)
{
    const qdot_trajectory *tr = &run->course.tr;
    double a = fmin(tr->t[0], tr->t[tr->count - 1]);
    double b = fmax(tr->t[0], tr->t[tr->count - 1]);

    if (a <= fmin(from, to) && fmax(from, to) <= b)
        return QDOT_OK;
    return qdot_fail(QDOT_EDOMAIN,
                     "the range %.15g..%.15g is outside the run, which covers %.15g to "
                     "%.15g",
                     from, to, tr->t[0], tr->t[tr->count - 1]);
}

/* The rounding of e, taken at the ends of the range. */
static qdot_status
rounding(const question *q, double *error)
{
    double ends[] = {q->from, q->to}, values[2], errors[2];
    bool drift = q->kind == QDOT_RANGE_DRIFT;

    QDOT_TRY(qdot_run_values(q->run, 1, q->of.exprs, 2, ends, values, NULL));
    QDOT_TRY(qdot_noise_roundings(&q->of, &q->run->course, 2, ends, values, errors));
    *error = (drift ? 2 : 1) * fmax(errors[0], errors[1])
             / (drift ? fmax(1, fabs(values[0])) : 1);
    return QDOT_OK;
}

/* The error stated for x, the value of the run, from those of the companions. */
static qdot_status
compare(const question *q, double x, double *distance)
{
    const qdot_course *courses[] = {&q->run->companion, &q->run->twin};
    const size_t companions = q->run->has_twin ? 2 : 1;
    double theirs[2], rough;

    if (!qdot_run_covered(q->run, q->to))
        return qdot_fail(QDOT_EDOMAIN, "a second run does not come so far");
    for (size_t k = 0; k < companions; k++)
        QDOT_TRY(over_course(q, courses[k], &theirs[k], &rough));
    *distance = qdot_companion_bound_of(x, companions, theirs, 1);
    return QDOT_OK;
}

qdot_status
qdot_run_range(qdot_run *run, qdot_range_kind kind, qdot_expr e, double from, double to,
               double *value, double *error)
{
    const qdot_trajectory *tr = &run->course.tr;
    const bool swap = tr->t[tr->count - 1] < tr->t[0] ? from < to : from > to;
    question q = {.run = run,
                  .kind = kind,
                  .from = swap ? to : from, /* in the direction of the run */
                  .to = swap ? from : to};
    double rough, distance = 0, spread = 0;
    qdot_status status;

    *error = NAN;
    QDOT_TRY(check_range(run, from, to));
    QDOT_TRY(qdot_reader_lower(run->plan, 1, &e, &q.of));
    status = over_course(&q, &run->course, value, &rough);
    if (status == QDOT_OK)
        status = qdot_run_twin(run);
    if (status == QDOT_OK && qdot_run_comparable(run)) {
        status = compare(&q, *value, &distance);
        if (status == QDOT_OK && qdot_horizon_passed(run, q.to))
            status = qdot_horizon_spread(run, &q.of, &spread);
        if (status == QDOT_OK)
            status = rounding(&q, error);
        if (status == QDOT_OK)
            *error += fmax(distance, spread) + rough + DBL_EPSILON * fabs(*value);
        if (qdot_reader_has_nothing(status))
            status = QDOT_OK;
    }
    qdot_tape_free(q.of.tape);
    return status;
}
