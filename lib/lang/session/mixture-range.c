/* mixture-range.c -- the extrema, the mean, the drift of an expression along several runs. */
#include "lang/session/mixture-range.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "base/interrupt.h"
#include "num/chebyshev.h"

enum {
    MOST = QDOT_CHEBYSHEV_MOST,
    DEEPEST = 50,
    PROBES = 7,
    MOST_PARTS = 4096,
    COARSE = 3
};

/* Size of the last coefficients, relative to the largest, of a polynomial that represents the
 * expression; and of the distance between its nodes. */
static const double tight = 0x1p-44, matching = 0x1p-42;

/* A contribution to the mean, relative to the largest value, that needs no better polynomial. */
static const double negligible = 0x1p-56;

/* Values on the shortest part that are larger than the others by this factor grow beyond all. */
static const double unbounded = 0x1p20;

/* Places between the nodes, and the ends, where a polynomial is compared with the expression. */
static const double probes[PROBES] = {-1, -0.9876, -0.5432, 0.0321, 0.6543, 0.9321, 1};

typedef struct {
    qdot_mixture *x;
    qdot_range_kind kind;
    double most, least;     /* of the values so far */
    double high[2], low[2]; /* the largest of x - error, x + error; likewise the least */
    double first, first_error;  /* where the range begins */
    long double integral, blur; /* of the values, of their errors */
    size_t parts;               /* between these steps */
    double typical;             /* size of the values of the first parts */
    double length;              /* of the whole range */
    bool begun;
} scan;

typedef struct {
    double a, b;
    int n;              /* nodes */
    bool good;          /* c represents the expression */
    double noise;       /* of the values; 0 while it is not known */
    double far;         /* the largest distance of c from the expression at the probes */
    double top, bottom; /* of the values at the nodes */
    double c[MOST];
} part;

/* Rounding of times, as a fraction of the length of a part. */
static double
blur(const part *p)
{
    return DBL_EPSILON * fmax(fabs(p->a), fabs(p->b)) / fabs(p->b - p->a);
}

/* The time that corresponds to x in -1 ... 1; that of an end lies within, since another value may
 * begin there. */
static double
place(const part *p, double x)
{
    return qdot_chebyshev_place(p->a, p->b, x * (1 - fmin(0.25, 4 * blur(p))));
}

static qdot_status
need_finite(const double *values, const double *times, size_t n)
{
    for (size_t j = 0; j < n; j++)
        if (!isfinite(values[j]))
            return qdot_fail(QDOT_EDOMAIN, "it is undefined at t = %.15g", times[j]);
    return QDOT_OK;
}

/* What the values on a part are off by: smaller differences mean nothing. */
static qdot_status
find_noise(scan *s, part *p)
{
    double times[PROBES], values[PROBES], errors[PROBES];

    for (int j = 0; j < PROBES; j++)
        times[j] = place(p, probes[j]);
    QDOT_TRY(
        qdot_mixture_values(s->x, &(qdot_samples){PROBES, times, NULL, values, errors}));
    p->noise = 0;
    for (int j = 0; j < PROBES; j++)
        if (isfinite(errors[j]))
            p->noise = fmax(p->noise, errors[j]);
    return QDOT_OK;
}

/* The polynomial by so many nodes, and whether it is good. */
static qdot_status
fit(scan *s, part *p, int nodes, int depth)
{
    double times[MOST + PROBES], values[MOST + PROBES], size, far = 0;
    const size_t all = (size_t)nodes + PROBES;

    p->n = nodes;
    for (int j = 0; j < nodes; j++)
        times[j] = place(p, qdot_chebyshev_node(nodes, j));
    for (int j = 0; j < PROBES; j++)
        times[nodes + j] = place(p, probes[j]);
    QDOT_TRY(qdot_mixture_values(s->x, &(qdot_samples){all, times, NULL, values, NULL}));
    QDOT_TRY(need_finite(values, times, all));
    qdot_chebyshev_fit(nodes, values, p->c);
    size = qdot_chebyshev_size(nodes, p->c);
    for (int j = 0; j < PROBES; j++)
        far = fmax(far,
                   fabs(qdot_chebyshev_at(nodes, p->c, probes[j]) - values[nodes + j]));
    if (nodes == MOST || depth >= COARSE)
        QDOT_TRY(find_noise(s, p));
    p->good = qdot_chebyshev_tail(nodes, p->c) <= fmax(tight * size, p->noise) &&
              far <= fmax((matching + 64 * blur(p)) * size, 8 * p->noise);
    p->top = -INFINITY;
    p->bottom = INFINITY;
    for (size_t j = 0; j < all; j++) {
        p->top = fmax(p->top, values[j]);
        p->bottom = fmin(p->bottom, values[j]);
    }
    return QDOT_OK;
}

static void
meet(scan *s, double value, double error)
{
    s->most = fmax(s->most, value);
    s->least = fmin(s->least, value);
    s->high[0] = fmax(s->high[0], value - error);
    s->high[1] = fmax(s->high[1], value + error);
    s->low[0] = fmin(s->low[0], value - error);
    s->low[1] = fmin(s->low[1], value + error);
}

/* A part whose values, by as much again as they differ, are within those met elsewhere. */
static bool
is_surpassed(const scan *s, const part *p)
{
    const double spread =
        p->good ? qdot_chebyshev_spread(p->n, p->c) : p->top - p->bottom;
    const double top = p->good ? p->c[0] + spread : p->top + spread;
    const double bottom = p->good ? p->c[0] - spread : p->bottom - spread;

    if (!s->begun)
        return false;
    return s->kind == QDOT_RANGE_MAX     ? top < s->most
           : s->kind == QDOT_RANGE_MIN   ? bottom > s->least
           : s->kind == QDOT_RANGE_DRIFT ? top < s->most && bottom > s->least
                                         : false;
}

/* Values and errors at the nodes, the extrema and the ends of a part. */
static qdot_status
take(scan *s, const part *p)
{
    double d[MOST], roots[MOST], times[2 * MOST], values[2 * MOST], errors[2 * MOST];
    double mean_error = 0;
    int n = p->n;

    for (int j = 0; j < n; j++)
        times[j] = place(p, qdot_chebyshev_node(p->n, j));
    if (p->good) {
        int found = 0;

        qdot_chebyshev_derivative(p->n, p->c, d);
        if (qdot_chebyshev_size(p->n - 1, d) > 0)
            found = qdot_chebyshev_crossings(p->n - 1, d, roots);
        for (int k = 0; k < found; k++)
            times[n++] = place(p, roots[k]);
    }
    QDOT_TRY(qdot_mixture_values(
        s->x, &(qdot_samples){(size_t)n, times, NULL, values, errors}));
    QDOT_TRY(need_finite(values, times, (size_t)n));
    for (int j = 0; j < n; j++)
        meet(s, values[j], errors[j]);
    for (int j = 0; j < p->n; j++)
        mean_error += errors[j] / p->n;
    for (int end = 0; p->good && end < 2;
         end++) { /* what is behind an end may be another value */
        const double x = qdot_chebyshev_at(p->n, p->c, end == 0 ? -1 : 1);
        const double error = errors[end == 0 ? p->n - 1 : 0] + p->far +
                             8 * DBL_EPSILON * qdot_chebyshev_size(p->n, p->c);

        meet(s, x, error);
        s->begun = true;
    }
    if (!p->good)
        mean_error += p->top - p->bottom;
    s->integral += 0.5L * (p->b - p->a) * qdot_chebyshev_integral(p->n, p->c);
    s->blur += fabsl((long double)(p->b - p->a)) * mean_error;
    return QDOT_OK;
}

/* The shortest part, or one that contributes nothing: its values bound what it holds. */
static qdot_status
leave(scan *s, const part *p)
{
    QDOT_TRY(take(s, p));
    s->begun = true;
    meet(s, p->top, p->top - p->bottom);
    meet(s, p->bottom, p->top - p->bottom);
    return QDOT_OK;
}

/* QDOT_EDOMAIN where a part without a good polynomial, or one of values that are hardly known, is
 * far beyond the others. */
static qdot_status
need_bound(const scan *s, const part *p)
{
    const double size = fmax(fabs(p->top), fabs(p->bottom));

    if (p->good && p->noise < 0.1 * size)
        return QDOT_OK;
    if (size <= unbounded * s->typical || p->top - p->bottom <= 0.5 * size ||
        (s->kind == QDOT_RANGE_MAX && p->top < s->most) ||
        (s->kind == QDOT_RANGE_MIN && p->bottom > s->least))
        return QDOT_OK;
    return qdot_fail(QDOT_EDOMAIN, "it grows beyond all bounds near t = %.9g", p->a);
}

static bool
is_shortest(const scan *s, const part *p, int depth)
{
    const double length = fabs(p->b - p->a);

    if (depth >= DEEPEST || s->parts > MOST_PARTS ||
        length <= 64 * DBL_EPSILON * fmax(fabs(p->a), fabs(p->b)))
        return true;
    return s->kind == QDOT_RANGE_MEAN &&
           (p->top - p->bottom) * length <= negligible * s->typical * s->length;
}

/* From a to b no run begins a step. */
static qdot_status
scan_between(scan *s, double a, double b)
{
    double ends[DEEPEST + 2];
    int depth = 0;

    ends[0] = b;
    s->parts = 0;
    while (depth >= 0) {
        part p = {.a = a, .b = ends[depth]};

        s->parts++;
        QDOT_TRY(qdot_interrupt_check());
        for (int nodes = 16; nodes <= (depth < COARSE ? MOST : 16) && !p.good; nodes *= 2)
            QDOT_TRY(fit(s, &p, nodes, depth));
        if (s->typical == 0)
            s->typical = fmax(fabs(p.top), fabs(p.bottom));
        if (!p.good && !is_surpassed(s, &p) && !is_shortest(s, &p, depth)) {
            ends[depth + 1] = 0.5 * (p.a + p.b);
            depth++;
            continue;
        }
        QDOT_TRY(need_bound(s, &p));
        if (!is_surpassed(s, &p))
            QDOT_TRY(p.good ? take(s, &p) : leave(s, &p));
        a = p.b;
        depth--;
    }
    return QDOT_OK;
}

static int
ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;

    return (x > y) - (x < y);
}

/* The value at one time, also all of a range that has no length. */
static qdot_status
begin_at(scan *s, double t)
{
    const qdot_samples at = {1, &t, NULL, &s->first, &s->first_error};

    QDOT_TRY(qdot_mixture_values(s->x, &at));
    QDOT_TRY(need_finite(&s->first, &t, 1));
    meet(s, s->first, s->first_error);
    return QDOT_OK;
}

static qdot_status
scan_range(scan *s, double from, double to)
{
    qdot_mixture_times times = {0};
    double a = from;
    qdot_status status = qdot_mixture_steps(s->x, &times);

    if (status == QDOT_OK && times.n > 0)
        qsort(times.at, times.n, sizeof *times.at, ascending);
    for (size_t i = 0; i <= times.n && status == QDOT_OK && a < to; i++) {
        const double b = i < times.n ? fmin(times.at[i], to) : to;

        if (b - a <= 16 * DBL_EPSILON * fmax(fabs(a), fabs(b)) && b != to)
            continue;
        if (b > a)
            status = scan_between(s, a, b);
        a = fmax(a, b);
    }
    qdot_free(times.at);
    return status;
}

qdot_status
qdot_mixture_range(qdot_mixture *x, qdot_range_kind kind, const double *range,
                   double *value, double *error)
{
    scan s = {.x = x,
              .kind = kind,
              .most = -INFINITY,
              .least = INFINITY,
              .high = {-INFINITY, -INFINITY},
              .low = {INFINITY, INFINITY}};
    double begin, end, from, to, up, down;

    qdot_mixture_span(x, &begin, &end);
    from = range != NULL ? fmin(range[0], range[1]) : begin;
    to = range != NULL ? fmax(range[0], range[1]) : end;
    if (begin > end)
        return qdot_fail(QDOT_EDOMAIN, "the runs have no time in common");
    if (from < begin || to > end)
        return qdot_fail(
            QDOT_EDOMAIN,
            "the range %.15g..%.15g is outside the runs, which all cover %.15g "
            "to %.15g",
            from, to, begin, end);
    s.length = to - from;
    if (from == to || kind == QDOT_RANGE_DRIFT)
        QDOT_TRY(begin_at(&s, qdot_mixture_is_backward(x) ? to : from));
    QDOT_TRY(scan_range(&s, from, to));
    switch (kind) {
    case QDOT_RANGE_MAX:
        *value = s.most;
        *error = fmax(s.high[1] - s.most, s.most - s.high[0]);
        break;
    case QDOT_RANGE_MIN:
        *value = s.least;
        *error = fmax(s.least - s.low[0], s.low[1] - s.least);
        break;
    case QDOT_RANGE_MEAN:
        *value = from == to ? s.first : (double)(s.integral / s.length);
        *error = from == to ? s.first_error : (double)(s.blur / s.length);
        break;
    case QDOT_RANGE_DRIFT:
        up = s.most - s.first;
        down = s.first - s.least;
        *value = fmax(up, down) / fmax(1, fabs(s.first));
        *error = fmax(fmax(s.high[1] - s.most, s.most - s.high[0]),
                      fmax(s.least - s.low[0], s.low[1] - s.least)) +
                 s.first_error;
        break;
    }
    return QDOT_OK;
}
