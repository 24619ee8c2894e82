/* watch-rough.c -- roots of a function beside its jump or kink, by its values.
 *
 * Its signs at the nodes of the part and at its end, where |g| within rounding counts as 0, are gone
 * through in order. Where they do not change, the least |g| is sought: there may be two roots beside a
 * kink, a kink at 0, or a jump to it.
 */
#include "sim/watch/watch-parts.h"

#include <float.h>
#include <math.h>

/* How far rounding of the states shifts a kink in time, relative to t. */
static const double few_doubles = 32 * DBL_EPSILON;

/* The state of a scan of one function through the interval, up to the time `at`. */
typedef struct {
    qdot_watch *w;
    const qdot_watch_part *p;
    size_t i;
    double least; /* magnitude below which g counts as 0 */
    double at;
    double zero; /* time since which g = 0; NaN: g is not 0 at present */
    double from; /* the previous time of evaluation */
    int *sign;   /* sign of g when it was last different from 0 */
} walk;

/* Locate the root between two times; g has the sign `way` at the second of them. */
static qdot_status
locate_crossing(walk *x, double from, double to, int way)
{
    qdot_watch_end ends[2] = {{from, 0}, {to, 0}};
    qdot_root root;
    bool found;

    *x->sign = way;
    QDOT_TRY(qdot_watch_cross(x->w, x->p, x->i, way, from + 0.5 * (to - from), ends, &root,
                              &found));
    return found ? qdot_watch_push(x->w, root) : QDOT_OK;
}

/* Record that g has become 0 between x->from and x->zero; `touches`: g returns to its former sign. */
static qdot_status
record_zero(walk *x, bool touches)
{
    const int sign = *x->sign;

    QDOT_TRY(qdot_watch_stay(x->w, x->i, x->from, x->zero, x->least));
    if (!touches)
        return QDOT_OK;
    *x->sign = sign;
    x->w->roots.at[x->w->roots.n - 1].way = 0;
    x->w->roots.at[x->w->roots.n - 1].stays = false;
    return QDOT_OK;
}

/* Continue the scan of the function to the time t, where it has the value g. */
static qdot_status
scan_to(walk *x, double t, double g)
{
    const int s = fabs(g) <= x->least ? 0 : qdot_watch_sign(g), before = *x->sign;
    const double last = x->at;

    x->at = t;
    if (s == 0) {
        if (isnan(x->zero)) {
            x->zero = t;
            x->from = last;
        }
        return QDOT_OK;
    }
    if (before == 0)
        *x->sign = s;
    else if (s != before)
        QDOT_TRY(locate_crossing(x, isnan(x->zero) ? last : x->from, t, s));
    else if (!isnan(x->zero))
        QDOT_TRY(record_zero(x, true));
    x->zero = NAN;
    return QDOT_OK;
}

/* Evaluate g at t times its earlier sign: a positive value if g has not crossed 0. */
static qdot_status
evaluate_with_sign(const walk *x, double t, double *g)
{
    QDOT_TRY(qdot_watch_value_at(x->w, t, x->w->g));
    *g = *x->sign * x->w->g[x->i];
    return QDOT_OK;
}

/* Whether the least g, at t, is 0 but for rounding of t: on one side it changes by as much within a few
 * doubles. */
static qdot_status
is_at_zero(const walk *x, double t, double g, bool *is)
{
    const double by = few_doubles * fabs(t);
    double change = INFINITY;

    for (int side = -1; side <= 1; side += 2) {
        const double there = t + side * by;
        double beside;

        if (there < fmin(x->p->a, x->p->b) || there > fmax(x->p->a, x->p->b))
            continue;
        QDOT_TRY(evaluate_with_sign(x, there, &beside));
        change = fmin(change, fabs(beside - g));
    }
    *is = g <= x->least || (isfinite(change) && g <= 2 * change);
    return QDOT_OK;
}

/* Find the minimum of |g| near t[1], where its value is g, between t[0] and t[2]. */
static qdot_status
minimise_magnitude(walk *x, double *t, double g)
{
    const qdot_watch_part *p = x->p;
    bool touches;

    while (g > 0) {
        const bool left = fabs(t[1] - t[0]) > fabs(t[2] - t[1]);
        const double middle = t[1] + 0.5 * ((left ? t[0] : t[2]) - t[1]);
        double there;

        if (middle == t[1] || middle == (left ? t[0] : t[2]))
            break;
        QDOT_TRY(evaluate_with_sign(x, middle, &there));
        if (there < g) {
            t[left ? 2 : 0] = t[1];
            t[1] = middle;
            g = there;
        } else {
            t[left ? 0 : 2] = middle;
        }
    }
    if (g < 0) {
        const int sign = *x->sign;

        QDOT_TRY(locate_crossing(x, p->a, t[1], -sign));
        return locate_crossing(x, t[1], p->b, sign);
    }
    if (fabs(t[1] - p->a) <= few_doubles * fabs(t[1]))
        return QDOT_OK; /* g is 0 at the start already: no new root */
    QDOT_TRY(is_at_zero(x, t[1], g, &touches));
    if (!touches)
        return QDOT_OK;
    if (fabs(t[1] - p->b) <= few_doubles * fabs(t[1])) { /* a zero at the interval's end belongs to the next interval */
        x->w->now.on[x->i] = true;
        return QDOT_OK;
    }
    return qdot_watch_push(x->w, (qdot_root){.function = x->i,
                                             .t = t[1],
                                             .residual = g,
                                             .blur = DBL_EPSILON * fabs(t[1])});
}

/* Find the change *by of g_i if the state in w->z changes by `roundings` rounding errors in either
 * direction. */
static qdot_status
change(qdot_watch *w, double t, size_t i, double roundings, double *by)
{
    double up, down;

    QDOT_TRY(qdot_watch_noise(w, t, w->z, roundings * DBL_EPSILON, 0, i, &up));
    QDOT_TRY(qdot_watch_noise(w, t, w->z, -roundings * DBL_EPSILON, 0, i, &down));
    *by = fmax(up, down);
    return QDOT_OK;
}

static qdot_status
begin_scan(qdot_watch *w, const qdot_watch_part *p, size_t i, int nodes, walk *x)
{
    const double *g = w->samples + i * QDOT_WATCH_NODES;
    double noise, more, t;
    int k = 0;

    *x = (walk){w, p, i, w->noise[i] > 0 ? w->noise[i] : 0, p->a, NAN, p->a, &w->now.sign[i]};
    for (int j = 1; j < nodes; j++)
        k = fabs(g[j]) > fabs(g[k]) ? j : k;
    t = qdot_watch_time(p, qdot_chebyshev_node(nodes, k));
    QDOT_TRY(w->reader.read(t, w->z, w->reader.user));
    QDOT_TRY(change(w, t, i, 1, &noise));
    QDOT_TRY(change(w, t, i, 1024, &more));
    /* a function that stays 0 has no noise; one that jumps changes as much by one rounding error as
     * by several */
    if (fabs(g[k]) <= QDOT_WATCH_ROUNDINGS * noise && more > 256 * noise)
        x->least = fmax(x->least, fabs(g[k]));
    return QDOT_OK;
}

qdot_status
qdot_watch_seek_least(qdot_watch *w, const qdot_watch_part *p, size_t i, int nodes)
{
    const double *g = w->samples + i * QDOT_WATCH_NODES;
    const int sign = w->now.sign[i];
    walk x;
    int k = 0;
    double t[3];

    QDOT_TRY(begin_scan(w, p, i, nodes, &x));
    for (int j = 1; j < nodes; j++)
        k = sign * g[j] < sign * g[k] ? j : k;
    for (int j = -1; j <= 1; j++)
        t[j + 1] = k - j >= nodes ? p->a
                   : k - j < 0    ? p->b
                                  : qdot_watch_time(p, qdot_chebyshev_node(nodes, k - j));
    return minimise_magnitude(&x, t, sign * g[k]);
}

/* The sign just after the start of the part. A smooth function is 0 throughout or nowhere about a zero, however flat
 * it is there: what is 0 beside the start is too small for its rounding. */
static int
first_nonzero_sign(const qdot_watch *w, size_t i, int nodes)
{
    const double *g = w->samples + i * QDOT_WATCH_NODES;
    int j = nodes - 1;

    while (w->smooth[i] && j > 0 && g[j] == 0)
        j--;
    return qdot_watch_sign(g[j]);
}

qdot_status
qdot_watch_rough_roots(qdot_watch *w, const qdot_watch_part *p, size_t i, int nodes)
{
    const double *g = w->samples + i * QDOT_WATCH_NODES;
    const int before = w->now.sign[i];
    const bool off = !w->now.on[i] && before != 0;
    const size_t roots = w->roots.n;
    walk x;

    QDOT_TRY(begin_scan(w, p, i, nodes, &x));
    if (w->now.on[i]) {
        x.zero = p->a;
        x.least = fmax(QDOT_WATCH_ROUNDINGS * x.least, fabs(w->now.g0[i]));
    }
    for (int j = nodes - 1; j >= 0; j--)
        QDOT_TRY(scan_to(&x, qdot_watch_time(p, qdot_chebyshev_node(nodes, j)), g[j]));
    w->now.on[i] = false;
    if (!isnan(x.zero) && fabs(p->at_end) <= x.least) { /* g stays 0 to the interval's end, without a jump there */
        if (*x.sign != 0)
            QDOT_TRY(record_zero(&x, false));
        w->now.on[i] = true;
    } else if (p->at_end == 0) { /* a zero exactly at the interval's end belongs to the next interval */
        w->now.on[i] = true;
    } else {
        QDOT_TRY(scan_to(&x, p->b, p->at_end));
        if (off && roots == w->roots.n && before == *x.sign)
            QDOT_TRY(qdot_watch_seek_least(w, p, i, nodes));
    }
    if (w->fresh[i]) {
        w->first[i] = first_nonzero_sign(w, i, nodes);
        w->fresh[i] = false;
    }
    w->now.g0[i] = p->at_end;
    return QDOT_OK;
}
