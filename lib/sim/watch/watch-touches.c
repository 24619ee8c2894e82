/* watch-touches.c -- finds extrema at which a watched function touches 0, and roots from which it stays 0. */
#include "sim/watch/watch-parts.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* At an extremum below this fraction of its size, a function may be 0. */
static const double small_of_size = 1e-3;

/* What rounding of the operations of function i hides of it at t, with the state there in w->z; 0 if its roots are not
 * located in many digits. */
static qdot_status
find_hidden_by_operations(qdot_watch *w, size_t i, double t, double *noise)
{
    *noise = 0;
    if (!w->may_be_flat[i])
        return QDOT_OK;
    memcpy(w->in, w->z, 2 * w->n * sizeof *w->in);
    return qdot_watch_operations(w, t, false, i, noise);
}

qdot_status
qdot_watch_is_touch(qdot_watch *w, const qdot_watch_part *p, size_t i, double x, double v, bool *touch,
                    double *within)
{
    const double rounding = 0x1p-50, by = fmax(w->tol, rounding);
    double size = qdot_chebyshev_size(p->n, p->c), noise = 0;
    double t = qdot_watch_time(p, x);

    *within = 0;
    *touch = fabs(v) <= 0x1p-48 * size;
    if (!*touch && (p->from_zero || fabs(v) > small_of_size * size))
        return QDOT_OK;
    QDOT_TRY(qdot_watch_value_at(w, t, w->g));
    /* value and polynomial differ, so a jump or pole is near */
    if (!p->from_zero && fabs(w->g[i] - v) > small_of_size * size) {
        *touch = false;
        return QDOT_OK;
    }
    if (w->g[i] != 0 && fabs(w->g[i]) <= DBL_MIN) { /* an underflow: only the sign of g is reliable */
        *touch = false;
        return QDOT_OK;
    }
    v = fmin(fabs(v), fabs(w->g[i])); /* near a root of even order the polynomial's value v is rounding */
    *touch |= v <= 0x1p-48 * size;
    if (*touch)
        return QDOT_OK;
    QDOT_TRY(w->reader.read(t, w->z, w->reader.user));
    QDOT_TRY(qdot_watch_noise(w, t, w->z, by, 0, i, &noise));
    *touch = v <= noise;
    if (*touch && v * by > noise * rounding)
        *within = v / noise * by;
    if (!*touch) {
        QDOT_TRY(find_hidden_by_operations(w, i, t, &noise));
        *touch = v <= noise;
    }
    return QDOT_OK;
}

/* The second derivative g'' at x, where d is the derivative of the interval's polynomial. */
static double
second_derivative_at(const qdot_watch_part *p, const double *d, double x)
{
    double second[QDOT_WATCH_NODES];
    const double slope = 2 / (p->b - p->a);

    qdot_chebyshev_derivative(p->n - 1, d, second);
    return qdot_chebyshev_at(p->n - 2, second, x) * slope * slope * (p->from_zero ? (x + 1) / 2 : 1);
}

/* How far from an extremum of value v at t two crossings may lie that cannot be told from a touch there: as far as
 * rounding of g makes two of it. *hidden: that of its operations is all that is seen of v. */
static qdot_status
find_largest_difference(qdot_watch *w, size_t i, double t, double v, double bend, double *apart, bool *hidden)
{
    double noise, operations;

    QDOT_TRY(w->reader.read(t, w->z, w->reader.user));
    QDOT_TRY(qdot_watch_noise(w, t, w->z, 4 * DBL_EPSILON, 0, i, &noise));
    QDOT_TRY(find_hidden_by_operations(w, i, t, &operations));
    *hidden = noise < fabs(v) && fabs(v) <= operations;
    *apart = bend != 0 ? sqrt(2 * (fabs(v) + noise + (*hidden ? operations : 0)) / fabs(bend)) : 0;
    return QDOT_OK;
}

/* Whether the derivative d [n - 1] at x exceeds its rounding error, or x is outside the interval. */
static bool
has_reliable_slope(const qdot_watch_part *p, const double *d, double x)
{
    return fabs(x) > 1
           || fabs(qdot_chebyshev_at(p->n - 1, d, x)) > 0x1p-49 * qdot_chebyshev_size(p->n - 1, d);
}

/* The distance from an extremum at x within which the function changes only by rounding. */
static double
flat_width(const qdot_watch_part *p, const double *d, double x)
{
    double width = DBL_EPSILON;

    while (!has_reliable_slope(p, d, x - width) || !has_reliable_slope(p, d, x + width))
        width *= 2;
    return width * fabs(p->b - p->a) / 2;
}

qdot_status
qdot_watch_touch(qdot_watch *w, const qdot_watch_part *p, size_t i, double x, double v, double within,
                 qdot_root *root, bool *is)
{
    const double t = qdot_watch_time(p, x);
    double d[QDOT_WATCH_NODES], bend, apart;
    bool hidden;

    qdot_chebyshev_derivative(p->n, p->c, d);
    bend = second_derivative_at(p, d, x);
    QDOT_TRY(find_largest_difference(w, i, t, v, bend, &apart, &hidden));
    *root = (qdot_root){.function = i,
                        .t = t,
                        .residual = fabs(v),
                        .blur = fmax(flat_width(p, d, x), apart),
                        .within = within,
                        .bend = within > 0 ? bend : 0};
    return qdot_watch_settle_touch(w, p, bend, hidden, root, is);
}

/* How long before t |g_i| was 4 times `least`, within rounding of which it is 0 at t; at most since the start of the
 * step: *by. Where g is flat it is 0 at a time known to that. */
static qdot_status
find_time_to_zero(qdot_watch *w, size_t i, double t, double least, double *by)
{
    const double whole = t - w->t;
    double part = DBL_EPSILON;

    for (; part < 1; part *= 2) {
        QDOT_TRY(qdot_watch_value_at(w, t - part * whole, w->g));
        if (fabs(w->g[i]) > 4 * least)
            break;
    }
    *by = part * fabs(whole);
    return QDOT_OK;
}

qdot_status
qdot_watch_stay(qdot_watch *w, size_t i, double from, double to, double least)
{
    double blur = 0;

    for (;;) {
        const double middle = from + 0.5 * (to - from);

        if (middle == from || middle == to)
            break;
        QDOT_TRY(qdot_watch_value_at(w, middle, w->g));
        *(fabs(w->g[i]) <= least ? &to : &from) = middle;
    }
    if (least > 0)
        QDOT_TRY(find_time_to_zero(w, i, to, least, &blur));
    QDOT_TRY(qdot_watch_push(w, (qdot_root){.function = i,
                                            .t = to,
                                            .way = -w->now.sign[i],
                                            .residual = least,
                                            .exact = least == 0,
                                            .blur = blur,
                                            .stays = true}));
    w->now.sign[i] = 0;
    return QDOT_OK;
}
