/* watch-roots.c -- fits one watched function on one interval of a step by a polynomial, and finds its roots. */
#include "sim/watch/watch-parts.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* Negligible relative to the largest coefficient: for a fit, and for a function divided by the
 * time since it was 0. */
static const double resolved = 0x1p-44, resolved_start = 1e-9;

/* A value is not small if it is at least this fraction of the function's largest magnitude. */
static const double least_of_size = 1e-3;

/* Near a root a function falls below this fraction of its size; near a jump or a pole it does not. */
static const double rest_of_size = 1e-6;

/* Factor from a function's rounding error to that of its slope at an end, where nodes lie densely. */
static const double noise_of_slope = 1e4;

/* --- the polynomial of a function ---------------------------------------------------- */

/* The rounding error of the nodes' times, relative to the length of the interval. */
static double
rounding_of_nodes(const qdot_watch_part *p)
{
    return DBL_EPSILON * fmax(fabs(p->a), fabs(p->b)) / fabs(p->b - p->a);
}

/* The fraction of its size below which the slope of a function at a zero cannot be told from 0.
 *  */
static double
least_reliable_slope(const qdot_watch_part *p)
{
    return fmax(resolved_start, 64 * rounding_of_nodes(p));
}

double
qdot_watch_time(const qdot_watch_part *p, double x)
{
    return qdot_chebyshev_place(p->a, p->b, x);
}

/* The largest difference between values of function i on the interval and its zero at the interval's start. */
static double
largest_difference_from_zero(const qdot_watch *w, const qdot_watch_part *p, size_t i)
{
    double most = 0;

    for (int j = 0; j < p->n; j++)
        most = fmax(most, fabs(w->samples[i * QDOT_WATCH_NODES + (size_t)j] - qdot_watch_zero(w, i)));
    return most;
}

bool
qdot_watch_vanishes(const qdot_watch *w, const qdot_watch_part *p, size_t i)
{
    const double size = qdot_chebyshev_size(p->n, p->c);

    /* take this into account: dividing by the time since the zero amplifies rounding near the start */
    return size == 0 || (p->from_zero ? largest_difference_from_zero(w, p, i) : size) <= QDOT_WATCH_ROUNDINGS * w->noise[i];
}

/* Of a function that vanishes on the part: whether it is 0, not just so flat at a root that rounding is all
 * that is seen there. */
static bool
stays_zero_in_interval(const qdot_watch *w, const qdot_watch_part *p)
{
    return qdot_chebyshev_size(p->n, p->c) == 0 || fabs(p->b - p->a) >= 0.0625 * w->length;
}

double
qdot_watch_least(const qdot_watch *w, const qdot_watch_part *p, size_t i)
{
    const double part = (w->now.on[i] ? 1e-11 : resolved) + 8 * rounding_of_nodes(p);

    return fmax(fmax(part * w->size[i], 16 * DBL_MIN),
                isnan(w->noise[i]) ? 0 : (w->now.on[i] ? noise_of_slope : 8) * w->noise[i]);
}

bool
qdot_watch_is_noisy(const qdot_watch *w, const qdot_watch_part *p, size_t i)
{
    return qdot_chebyshev_tail(p->n, p->c) > resolved * w->size[i];
}

static void
record_sizes(qdot_watch *w, const qdot_watch_part *p, size_t i)
{
    w->size[i] = qdot_chebyshev_size(p->n, p->c);
    w->clear[i] = fabs(p->c[0]) - qdot_chebyshev_spread(p->n, p->c);
}

/* Find the Chebyshev coefficients c [p->n] of function i, or of its quotient by the time since its zero. */
static void
fit_polynomial(const qdot_watch *w, const qdot_watch_part *p, size_t i, double *c)
{
    const double *g = w->samples + i * QDOT_WATCH_NODES;
    double values[QDOT_WATCH_NODES];

    for (int j = 0; j < p->n; j++) {
        values[j] = g[j];
        if (p->from_zero) {
            double t = qdot_watch_time(p, qdot_chebyshev_node(p->n, j));

            /* if a node rounds to the start of the interval, use the value at the previous node */
            values[j] = t != p->a
                            ? (g[j] - qdot_watch_zero(w, i)) * ((p->b - p->a) / (t - p->a))
                        : j > 0 ? values[j - 1]
                                : 0;
        }
    }
    qdot_chebyshev_fit(p->n, values, c);
}

qdot_watch_verdict
qdot_watch_fit(qdot_watch *w, qdot_watch_part *p, size_t i, int nodes)
{
    double *fitted = w->fitted + i * QDOT_WATCH_NODES, size;

    p->n = nodes;
    p->from_zero = w->now.on[i];
    if (w->n_fitted[i] != nodes) {
        fit_polynomial(w, p, i, fitted);
        w->n_fitted[i] = nodes;
    }
    memcpy(p->c, fitted, (size_t)nodes * sizeof *fitted);
    size = qdot_chebyshev_size(nodes, p->c);
    record_sizes(w, p, i);
    if (!qdot_watch_vanishes(w, p, i) &&
        qdot_chebyshev_tail(nodes, p->c) >
            qdot_watch_least(w, p, i))
        return QDOT_PART_MORE_NODES;
    if (p->from_zero && !w->deep[i] && !qdot_watch_vanishes(w, p, i) &&
        fabs(qdot_chebyshev_at(nodes, p->c, -1)) <= least_reliable_slope(p) * size)
        return QDOT_PART_START_CUT;
    return QDOT_PART_GOOD;
}

/* --- locating a root between doubles of t -------------------------------------------- */

/* Evaluate g_i at t, which becomes ends[*over]; *over: whether g_i has changed its sign to `way`.
 *  */
static qdot_status
narrow_bracket(qdot_watch *w, size_t i, int way, double t, qdot_watch_end *ends, bool *over)
{
    QDOT_TRY(qdot_watch_value_at(w, t, w->g));
    *over = w->g[i] == 0 || qdot_watch_sign(w->g[i]) == way;
    ends[*over] = (qdot_watch_end){t, w->g[i]};
    return QDOT_OK;
}

/* Narrow the bracket ends [2] of a root to neighbouring doubles, as qdot_watch_cross does. */
static qdot_status
locate_root(qdot_watch *w, size_t i, int way, qdot_watch_end *ends, double guess, bool *found)
{
    const double lo = ends[0].t, hi = ends[1].t;
    double step = 4 * (nextafter(fabs(guess), INFINITY) - fabs(guess));
    bool over;

    guess = w->direction > 0 ? fmin(fmax(guess, lo), hi) : fmax(fmin(guess, lo), hi);
    QDOT_TRY(narrow_bracket(w, i, way, guess, ends, &over));
    for (const bool back = over; over == back; step *= 8) { /* search outward from the guess until the sign changes */
        const double t = guess + (back ? -1 : 1) * w->direction * step;

        if (w->direction * (back ? t - ends[0].t : ends[1].t - t) <= 0)
            break;
        guess = t;
        QDOT_TRY(narrow_bracket(w, i, way, guess, ends, &over));
    }
    for (;;) {
        const double middle = ends[0].t + 0.5 * (ends[1].t - ends[0].t);

        if (middle == ends[0].t || middle == ends[1].t)
            break;
        QDOT_TRY(narrow_bracket(w, i, way, middle, ends, &over));
    }
    *found = true;
    if (ends[1].t == hi)
        return narrow_bracket(w, i, way, hi, ends, found);
    if (ends[0].t == lo) {
        QDOT_TRY(narrow_bracket(w, i, way, lo, ends, &over));
        *found = !over || w->g[i] == 0;
    }
    return QDOT_OK;
}

/* The slope of the function at t, from its polynomial on the interval. */
static double
slope_of_polynomial(const qdot_watch_part *p, double t)
{
    double d[QDOT_WATCH_NODES];
    const double length = p->b - p->a, x = 2 * (t - p->a) / length - 1;

    qdot_chebyshev_derivative(p->n, p->c, d);
    return qdot_chebyshev_at(p->n - 1, d, x) * (2 / length) * (p->from_zero ? (t - p->a) / length : 1);
}

/* Values in two doubles are less what g was at the start of the step, or of a root in it: the motion may have been
 * behind its zero there by the time that a change came late (qdot_piece_make_up). The root is where g itself is 0: at a
 * later double of t than that found, if need be. */
static void
subtract_offset(const qdot_watch *w, const qdot_watch_part *p, double slope, double step, qdot_root *root)
{
    const double late = root->late + root->way * w->now.offset[root->function] / slope;

    if (!qdot_watch_is_fine(w, root->function) || slope == 0 || fabs(late) > 16 * step)
        return;
    root->late = late;
    while (root->late < -qdot_watch_negligible_rounding(root, step) && root->t != p->b) {
        root->t += w->direction * step;
        root->late += step;
    }
    root->late = fmax(0, root->late);
}

/* Where between two neighbouring doubles the root is; the first may not have been evaluated. Where g moves less from
 * one double of t to the next than the rounding of the state moves it, it is as far from there as that takes. */
static qdot_status
refine_in_double_double(qdot_watch *w, const qdot_watch_part *p, qdot_watch_end *ends, qdot_root *root)
{
    const double step = fabs(ends[1].t - ends[0].t);
    const double slope = w->coarse ? 0 : fabs(slope_of_polynomial(p, root->t));
    double noise, rise;

    if (ends[0].g == 0) {
        QDOT_TRY(qdot_watch_value_at(w, ends[0].t, w->g));
        ends[0].g = w->g[root->function];
        root->residual = fmax(root->residual, fabs(ends[0].g));
    }
    rise = fabs(ends[1].g) + fabs(ends[0].g);
    QDOT_TRY(w->reader.read(root->t, w->z, w->reader.user));
    QDOT_TRY(qdot_watch_noise(w, root->t, w->z, DBL_EPSILON, 0, root->function, &noise));
    root->late = step * (fabs(ends[1].g) / rise);
    subtract_offset(w, p, slope, step, root);
    qdot_watch_put_on_double(w, p, root);
    root->blur = noise < rise ? step * (noise / rise) : step;
    if (!qdot_watch_is_fine(w, root->function) && noise > root->blur * slope && slope > 0)
        root->blur = fmin(noise / slope, fabs(p->b - p->a));
    return QDOT_OK;
}

/* Whether g changes its sign through infinity between neighbouring doubles: away from there it is
 * much smaller. Only asked where its values are not small beside those of the part. */
static qdot_status
is_sign_change_by_pole(qdot_watch *w, const qdot_watch_part *p, const qdot_watch_end *ends, const qdot_root *root, bool *pole)
{
    const double away = 4096 * (ends[1].t - ends[0].t), low = fmin(p->a, p->b),
                 high = fmax(p->a, p->b);
    bool any = false;

    *pole = false;
    if (root->residual <= least_of_size * qdot_chebyshev_size(p->n, p->c))
        return QDOT_OK;
    for (int side = 0; side < 2; side++) {
        const double t = ends[side].t + (side == 0 ? -away : away);

        if (t < low || t > high)
            continue;
        QDOT_TRY(qdot_watch_value_at(w, t, w->g));
        if (fabs(w->g[root->function]) >= root->residual / 4)
            return QDOT_OK;
        any = true;
    }
    *pole = any;
    return QDOT_OK;
}

/* Make a root from the sign change between two neighbouring doubles of t. */
static qdot_status
make_root_between_doubles(qdot_watch *w, const qdot_watch_part *p, size_t i, int way, qdot_watch_end *ends,
                          qdot_root *root)
{
    *root = (qdot_root){.function = i,
                        .t = ends[1].t,
                        .way = way,
                        .residual = fmax(fabs(ends[0].g), fabs(ends[1].g)),
                        .exact = ends[1].g == 0};
    QDOT_TRY(qdot_watch_clock_rounding(w, root, w->coarse ? 0 : fabs(slope_of_polynomial(p, root->t))));
    if (root->exact && qdot_watch_is_fine(w, i) && w->now.offset[i] == 0)
        return QDOT_OK;
    QDOT_TRY(refine_in_double_double(w, p, ends, root));
    return root->exact ? QDOT_OK : is_sign_change_by_pole(w, p, ends, root, &root->pole);
}

/* Like qdot_watch_cross, but with functions evaluated in the present precision only. */
static qdot_status
find_crossing(qdot_watch *w, const qdot_watch_part *p, size_t i, int way, double guess, qdot_watch_end *ends,
              qdot_root *root, bool *found)
{
    QDOT_TRY(locate_root(w, i, way, ends, guess, found));
    return *found ? make_root_between_doubles(w, p, i, way, ends, root) : QDOT_OK;
}

/* As qdot_watch_cross, by values in two doubles: the guess is good, so the root is beside the next step of
 * Newton's method. *found false: it is not. */
static qdot_status
find_crossing_near(qdot_watch *w, const qdot_watch_part *p, size_t i, int way, double guess,
                   qdot_watch_end *ends, qdot_root *root, bool *found)
{
    const double rest = rest_of_size * qdot_chebyshev_size(p->n, p->c);
    qdot_watch_end at[2];
    double t = guess;

    *found = false;
    for (int k = 0; k < 3 && w->direction * (t - ends[0].t) > 0 && w->direction * (ends[1].t - t) > 0; k++) {
        bool over, other;
        double next;

        QDOT_TRY(narrow_bracket(w, i, way, t, at, &over));
        if (at[over].g != 0 && fabs(at[over].g) > rest)
            return QDOT_OK;
        next = nextafter(t, over ? -w->direction * INFINITY : w->direction * INFINITY);
        if (fabs(at[over].g) <= 2 * fabs(slope_of_polynomial(p, t) * (next - t))) {
            QDOT_TRY(narrow_bracket(w, i, way, next, at, &other));
            if (other == over)
                t = next;
            *found = other != over;
            if (*found)
                break;
        }
        t -= at[over].g / slope_of_polynomial(p, t);
    }
    if (!*found || at[0].t == ends[0].t || at[1].t == ends[1].t) {
        *found = false;
        return QDOT_OK;
    }
    ends[0] = at[0];
    ends[1] = at[1];
    return make_root_between_doubles(w, p, i, way, ends, root);
}

/* Switch the double-double evaluation of function i on or off. */
static void
set_double_double(qdot_watch *w, size_t i, bool fine, bool others)
{
    w->wants[i] = fine;
    w->fine = fine || others;
}

qdot_status
qdot_watch_cross(qdot_watch *w, const qdot_watch_part *p, size_t i, int way, double guess,
                 qdot_watch_end *ends, qdot_root *root, bool *found)
{
    const bool others = w->fine; /* whether the other functions are evaluated in double-double precision here */
    const bool two = !qdot_watch_is_fine(w, i) && !w->coarse && qdot_watch_can_two(w, i);
    const double from = ends[0].t;
    qdot_watch_end near[2] = {ends[0], ends[1]};
    qdot_root again;
    bool also = false;
    double beside; /* |g| next to the root, or at the end of the interval if the root lies beyond it */
    qdot_status status = QDOT_OK;

    if (two) {
        set_double_double(w, i, true, others);
        status = find_crossing_near(w, p, i, way, guess, ends, root, found);
        set_double_double(w, i, false, others);
        if (status != QDOT_OK || *found)
            return status;
    }
    QDOT_TRY(find_crossing(w, p, i, way, guess, ends, root, found));
    beside = *found ? root->residual : fabs(ends[ends[1].t == from].g);
    if (!two || (*found && root->pole) || beside > rest_of_size * qdot_chebyshev_size(p->n, p->c))
        return QDOT_OK;
    set_double_double(w, i, true, others); /* find the same root in double-double precision, as doubles cannot locate it */
    status = find_crossing(w, p, i, way, *found ? root->t : guess, near, &again, &also);
    set_double_double(w, i, false, others);
    if (status == QDOT_OK && also && !again.pole) {
        *root = again;
        *found = true;
        ends[0] = near[0];
        ends[1] = near[1];
    }
    return status;
}

/* --- roots of the polynomial --------------------------------------------------------- */

/* The root between x0 and x1 of the polynomial, which is monotonic there. */
static double
polynomial_root_between(const qdot_watch_part *p, double x0, double x1, int way)
{
    if (qdot_watch_sign(qdot_chebyshev_at(p->n, p->c, x0)) == way)
        return x0;
    return qdot_watch_sign(qdot_chebyshev_at(p->n, p->c, x1)) == way
               ? qdot_chebyshev_root(p->n, p->c, x0, x1)
               : x1;
}

/* Whether the slope at the zero at the interval's start is negligible compared to the function. */
static bool
is_flat_at_start(const qdot_watch_part *p)
{
    return fabs(qdot_chebyshev_at(p->n, p->c, -1))
           <= least_reliable_slope(p) * qdot_chebyshev_size(p->n, p->c);
}

/* Whether the slope of g, at its zero at the interval's start, is 0 within rounding. */
static bool
has_no_slope_at_start(const qdot_watch *w, const qdot_watch_part *p, size_t i)
{
    return is_flat_at_start(p) /* the comparison is false for a NaN */
           || fabs(qdot_chebyshev_at(p->n, p->c, -1)) <= noise_of_slope * w->noise[i];
}

/* The sign of a function just after its zero at the start of the interval. */
static int
sign_after_start_zero(const qdot_watch *w, const qdot_watch_part *p, size_t i)
{
    return w->deep[i] && p->a == w->t
               ? w->leaves[i]
               : qdot_watch_sign(qdot_chebyshev_at(p->n, p->c, has_no_slope_at_start(w, p, i) ? 1 : -1));
}

/* How far from the start of the part the extremum is that makes the zero there: a touch of a part
 * that ended on it to 2^-20 of its length. The polynomial is that of (g - g_0)/(t - t_0). */
static double
error_of_extremum(const qdot_watch_part *p)
{
    double d[QDOT_WATCH_NODES];
    double slope, bend;

    qdot_chebyshev_derivative(p->n, p->c, d);
    slope = fabs(qdot_chebyshev_at(p->n, p->c, -1));
    bend = fabs(qdot_chebyshev_at(p->n - 1, d, -1)) * 4 / fabs(p->b - p->a);
    return slope < bend * fabs(p->b - p->a) ? slope / bend : 0;
}

/* The time from the start of the interval until the function has changed by the amount g. */
static double
time_of_change(const qdot_watch_part *p, double g)
{
    const double length = fabs(p->b - p->a);
    double part = DBL_EPSILON;

    while (part < 1 && fabs(qdot_chebyshev_at(p->n, p->c, 2 * part - 1)) * part < g)
        part *= 2;
    return part * length;
}

/* Handle a sign change near the start of the interval, where the function is 0 within rounding. */
static qdot_status
cross_near_start(qdot_watch *w, const qdot_watch_part *p, size_t i, int sign)
{
    qdot_watch_end ends[2] = {{w->part_before, 0}, {p->b, 0}};
    qdot_root root;
    bool found = false;

    if (qdot_watch_zero(w, i) != 0)
        QDOT_TRY(qdot_watch_cross(w, p, i, sign, p->a, ends, &root, &found));
    if (!found) /* no root is found, so it lies before this step */
        root = (qdot_root){.function = i,
                           .t = p->a,
                           .way = sign,
                           .residual = fabs(w->now.g0[i]) / QDOT_WATCH_NEGLIGIBLE,
                           .blur = qdot_watch_zero(w, i) != 0
                                       ? time_of_change(p, fabs(qdot_watch_zero(w, i)))
                                       : 0,
                           .exact = true};
    return qdot_watch_push(w, root);
}

/* Record a crossing of 0, unless evaluation in multiple precision shows that rounding caused it. */
static qdot_status
record_crossing(qdot_watch *w, const qdot_watch_part *p, qdot_root root)
{
    bool is;

    QDOT_TRY(qdot_watch_settle_flat(w, p, fabs(slope_of_polynomial(p, root.t)), &root, &is));
    return is ? qdot_watch_push(w, root) : QDOT_OK;
}

/* Treat the zero at the start of the part: count it as a root if the sign before differs, or as a touch if
 * it does not. */
static qdot_status
record_sign_at_start(qdot_watch *w, const qdot_watch_part *p, size_t i, int sign)
{
    const int before = w->now.sign[i];

    if (before != 0 && sign == before)
        QDOT_TRY(qdot_watch_push(w, (qdot_root){.function = i,
                                                .t = p->a,
                                                .blur = error_of_extremum(p),
                                                .exact = true}));
    else if (before != 0 && sign != 0)
        QDOT_TRY(cross_near_start(w, p, i, sign));
    w->now.sign[i] = sign != 0 ? sign : before;
    return QDOT_OK;
}

/* Function i has the sign `way` where the part starts already, though the step before, whose states are rounded by
 * themselves, ended with the other sign: the root is there. */
static qdot_status
record_crossing_between_steps(qdot_watch *w, const qdot_watch_part *p, size_t i, int way, double g)
{
    const double slope = fabs(slope_of_polynomial(p, p->a));

    return qdot_watch_push(w, (qdot_root){.function = i,
                                          .t = p->a,
                                          .way = way,
                                          .residual = fmax(fabs(g), fabs(w->now.g0[i])),
                                          .blur = slope > 0 ? fmin(fabs(g) / slope, fabs(p->b - p->a)) : 0,
                                          .exact = true});
}

/* Whether a root at t is the zero at the interval's start, found a second time because of rounding. */
static bool
is_start_zero_again(const qdot_watch_part *p, double t)
{
    return p->from_zero && fabs(t - p->a) <= 0x1p-40 * fabs(p->b - p->a);
}

/* Whether the part ends on an extremum that is 0, or so near to one that rounding would make two
 * crossings of it; not where function i is known in many digits. */
static bool
touches_at_end(const qdot_watch *w, const qdot_watch_part *p, size_t i)
{
    double d[QDOT_WATCH_NODES], size = qdot_chebyshev_size(p->n, p->c);

    if (fabs(p->at_end) > 0x1p-46 * size || (w->deep[i] && p->at_end != 0))
        return false;
    qdot_chebyshev_derivative(p->n, p->c, d);
    return fabs(qdot_chebyshev_at(p->n - 1, d, 1)) <= 0x1p-20 * size;
}

/* Whether the function jumps to 0 at the end of the interval. */
static bool
jumps_to_zero_at_end(const qdot_watch_part *p)
{
    const double size = qdot_chebyshev_size(p->n, p->c);

    return fabs(p->at_end) <= 0x1p-46 * size
           && fabs(qdot_chebyshev_at(p->n, p->c, 1) - p->at_end) > least_of_size * size;
}

/* The root that was found last if it is a touch of function i; otherwise NULL. */
static const qdot_root *
last_touch_of(const qdot_watch *w, size_t i)
{
    const qdot_root *last = w->roots.n > 0 ? &w->roots.at[w->roots.n - 1] : NULL;

    return last && last->function == i && last->way == 0 ? last : NULL;
}

/* Remove touches so near to the interval's end that they are the same as the zero at the end. */
static void
remove_touch_at_end(qdot_watch *w, const qdot_watch_part *p, size_t i)
{
    const qdot_root *last;

    while ((last = last_touch_of(w, i)) && fabs(last->t - p->b) <= 0x1p-18 * fabs(p->b - p->a))
        w->roots.n--;
}

/* Touches that rounding makes, found since `from` between which and here g is nothing else, are no
 * roots beside the one that comes now. */
static void
remove_rounding_touches(qdot_watch *w, size_t i, double from)
{
    const qdot_root *last;

    while ((last = last_touch_of(w, i)) && last->within == 0 && !last->exact &&
           w->direction * (last->t - from) > 0)
        w->roots.n--;
}

/* Handle a function that is 0 within rounding on the whole interval, and may jump at its end. */
static qdot_status
handle_vanishing_function(qdot_watch *w, const qdot_watch_part *p, size_t i)
{
    const double noise = w->noise[i] > 0 ? QDOT_WATCH_ROUNDINGS * w->noise[i] : 0,
                 start = p->from_zero ? fabs(qdot_watch_zero(w, i)) : 0;
    const bool leaves = fabs(p->at_end) > fmax(noise, start)
                        && fabs(p->at_end - qdot_chebyshev_at(p->n, p->c, 1)) > noise;

    if (w->now.sign[i] != 0 && (leaves || stays_zero_in_interval(w, p)))
        QDOT_TRY(qdot_watch_stay(w, i, p->a,
                                 p->from_zero
                                     ? p->a
                                     : qdot_watch_time(p, qdot_chebyshev_node(p->n, p->n - 1)),
                                 noise));
    if (leaves)
        w->now.sign[i] = qdot_watch_sign(p->at_end);
    if (leaves && w->fresh[i]) {
        w->first[i] = w->now.sign[i];
        w->slow[i] = p->from_zero;
        w->fresh[i] = false;
    }
    w->now.on[i] = !leaves;
    w->now.g0[i] = p->at_end;
    return QDOT_OK;
}

qdot_status
qdot_watch_roots(qdot_watch *w, qdot_watch_part *p, size_t i)
{
    const double *extrema;
    double x[QDOT_WATCH_NODES + 2], from = p->a, x_from = -1;
    double sure = p->a; /* latest time at which g certainly has the sign `sign` */
    int n, sign = w->now.sign[i];
    bool grazes;

    if (w->fresh[i] && p->from_zero && is_flat_at_start(p))
        w->slow[i] = true;
    if (qdot_watch_vanishes(w, p, i))
        return handle_vanishing_function(w, p, i);
    grazes = touches_at_end(w, p, i);
    if (!grazes)
        QDOT_TRY(qdot_watch_sharpen_end(w, p, i));
    if (p->from_zero) {
        sign = sign_after_start_zero(w, p, i);
        QDOT_TRY(record_sign_at_start(w, p, i, sign));
    }
    n = qdot_watch_extrema(w, p, i, &extrema);
    if (n > 0)
        memcpy(x, extrema, (size_t)n * sizeof *x);
    x[n++] = 1;
    for (int e = 0; e < n; e++) {
        double v = qdot_chebyshev_at(p->n, p->c, x[e]);
        int there = e + 1 < n ? qdot_watch_sign(v) : grazes ? 0 : qdot_watch_sign(p->at_end);
        double to = e + 1 < n ? qdot_watch_time(p, x[e]) : p->b;
        bool touch = false, found;
        double within = 0;

        if (e + 1 < n && there != 0)
            QDOT_TRY(qdot_watch_is_touch(w, p, i, x[e], v, &touch, &within));
        if (touch || (e + 1 < n && there == 0)) {
            qdot_root root;

            if (within == 0)
                remove_rounding_touches(w, i, from);
            if (sign != 0 && !is_start_zero_again(p, to)) {
                QDOT_TRY(qdot_watch_touch(w, p, i, x[e], v, within, &root, &found));
                if (found)
                    QDOT_TRY(qdot_watch_push(w, root));
            }
            continue;
        }
        if (there != 0 && sign != 0 && there != sign) {
            double guess = qdot_watch_time(p, polynomial_root_between(p, x_from, x[e], there));
            qdot_watch_end ends[2] = {{sure, 0}, {to, 0}};
            qdot_root root;

            QDOT_TRY(qdot_watch_cross(w, p, i, there, guess, ends, &root, &found));
            if (found && !is_start_zero_again(p, root.t)) {
                remove_rounding_touches(w, i, from);
                QDOT_TRY(record_crossing(w, p, root));
            } else if (!found && ends[1].t == p->a && ends[1].g != 0 && !p->from_zero) {
                QDOT_TRY(record_crossing_between_steps(w, p, i, there, ends[1].g));
            }
            sure = ends[found ? 1 : 0].t;
            there = found || ends[1].g != 0 ? there : sign;
        }
        sign = there != 0 ? there : sign;
        from = to;
        x_from = x[e];
    }
    w->now.sign[i] = sign;
    if (w->fresh[i]) {
        w->first[i] = p->from_zero ? sign_after_start_zero(w, p, i) : qdot_watch_sign(w->now.g0[i]);
        w->slow[i] |= p->from_zero && has_no_slope_at_start(w, p, i);
        w->fresh[i] = false;
    }
    if (grazes)
        remove_touch_at_end(w, p, i);
    w->grazed[i] = grazes && sign != 0;
    w->now.on[i] = grazes || p->at_end == 0 || jumps_to_zero_at_end(p);
    w->now.g0[i] = p->at_end;
    return QDOT_OK;
}
