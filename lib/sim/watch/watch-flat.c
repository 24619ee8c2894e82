/* watch-flat.c -- roots at which a function is so flat that rounding of its own operations hides them.
 *
 *     g = c (t - t*)^m + r   hides the root within   |t - t*| <= (r/c)^(1/m):
 *
 * 5e-6 in doubles for m = 3. The state is known far better than that, and with g = F(u(state)), F flat, so is t*. Where
 * the polynomial of g has hardly any slope at a root, g is evaluated in so many digits that its operations round nothing
 * that counts. Rounding of the state is left:
 *
 *     noise = sum over k of |g(y + eps max|y_k| e_k) - g(y)|
 *
 * A sign counts where |g| is more than that. Between the next signs on both sides of a crossing the root is bisected; where
 * there is none on one side rounding has made the crossing, or two of a touch.
 *
 * Tests  tests/script/events/flat-events.lag
 */
#include <float.h>
#include <math.h>

#include "sim/watch/watch-parts.h"

#include "series/precise.h"

#define RN MPFR_RNDN

/* More than enough for multiplicities that occur: a state in two doubles leaves u = 2^-106 at a root, and u^m is told from
 * rounding for m < 6. */
enum { BITS = 640 };

/* A flat root is looked for if the slope, times the interval's length, is below this fraction of |g|. */
static const double hardly_any = 1e-3;

/* Growth of g from distance h to 2h that shows an odd power m > 1 (factor 2^m); a bounce grows by 4. */
static const double growth_of_cube = 6;

void
qdot_watch_clear_flat(qdot_watch *w)
{
    qdot_precise_free(w->many);
}

static double
spacing_of_doubles(double t)
{
    return nextafter(fabs(t), INFINITY) - fabs(t);
}

/* --- values in many digits ------------------------------------------------------------- */

/* The value of function i at the state w->state_two, with component k (SIZE_MAX: none) changed by `by`. */
static double
value_of_state(qdot_watch *w, size_t i, double t, size_t k, double by)
{
    const size_t stride = qdot_precise_stride(w->many);
    mpfr_t *in = qdot_precise_input(w->many, 0);
    const mpfr_t *out = qdot_precise_output(w->many, i);
    double g;

    for (size_t j = 0; j < 2 * w->n; j++) {
        mpfr_set_d(in[j * stride], w->state_two[j].hi, RN);
        mpfr_add_d(in[j * stride], in[j * stride], w->state_two[j].lo, RN);
        if (j == k)
            mpfr_add_d(in[j * stride], in[j * stride], by, RN);
    }
    mpfr_set_d(in[2 * w->n * stride], t, RN);
    qdot_precise_order(w->many, 0);
    if (!mpfr_number_p(out[0]))
        return NAN;
    g = mpfr_get_d(out[0], RN);
    return mpfr_sgn(out[0]) * fmin(fmax(fabs(g), DBL_MIN), QDOT_WATCH_MOST); /* keeps the sign: only a zero becomes 0 */
}

static qdot_status
evaluate_in_multiple_precision(qdot_watch *w, size_t i, double t, double *g)
{
    QDOT_TRY(qdot_watch_read_two(w, t));
    *g = value_of_state(w, i, t, SIZE_MAX, 0);
    return QDOT_OK;
}

/* Find how much rounding of the state at t changes function i. */
static qdot_status
find_state_rounding_effect(qdot_watch *w, size_t i, double t, double *noise)
{
    double g;

    QDOT_TRY(evaluate_in_multiple_precision(w, i, t, &g));
    *noise = 0;
    for (size_t k = 0; k < 2 * w->n && !w->clock[i]; k++) {
        const double size = fmax(fabs(w->state_two[k].hi), w->largest ? w->largest[k] : 0),
                     change = fabs(value_of_state(w, i, t, k, DBL_EPSILON * size) - g);

        *noise += isnan(change) ? 0 : change;
    }
    return QDOT_OK;
}

qdot_status
qdot_watch_noise_deep(qdot_watch *w, const qdot_watch_part *p, size_t i, double *noise)
{
    double end;

    QDOT_TRY(find_state_rounding_effect(w, i, p->a, noise));
    QDOT_TRY(find_state_rounding_effect(w, i, p->b, &end));
    *noise = fmax(*noise, end);
    return QDOT_OK;
}

void
qdot_watch_may_be_flat(qdot_watch *w, size_t i)
{
    w->may_be_flat[i] = true;
}

static bool
may_use_multiple_precision(const qdot_watch *w, size_t i)
{
    return w->may_be_flat[i] && w->reader.alone && !w->accelerations && w->coordinate[i] == SIZE_MAX;
}

static qdot_status
make_multiple_precision_program(qdot_watch *w)
{
    QDOT_TRY(qdot_watch_make_two(w));
    return w->many ? QDOT_OK
                   : qdot_precise_new(w->plan->pool, w->plain ? w->plain : w->tape, 0, BITS, &w->many);
}

qdot_status
qdot_watch_begin_deep(qdot_watch *w, const double *low)
{
    const double near = 4 * DBL_EPSILON * fabs(w->t);

    w->any_deep = false;
    for (size_t k = 0; k < w->roots.n; k++) /* the root need not be the last one of the step that ended here */
        if (w->roots.at[k].deep && fabs(w->t - w->roots.at[k].t) <= near)
            w->settled[w->roots.at[k].function] = w->roots.at[k].t;
    for (size_t i = 0; i < w->m; i++) {
        w->deep[i] = fabs(w->t - w->settled[i]) <= near;
        w->any_deep = w->any_deep || w->deep[i];
    }
    for (size_t k = 0; k < 2 * w->n && w->any_deep; k++)
        w->state_two[k] = qdot_two_add_double((qdot_two){w->y[k], 0}, low ? low[k] : 0);
    for (size_t i = 0; i < w->m && w->any_deep; i++) {
        const double g = w->deep[i] ? value_of_state(w, i, w->t, SIZE_MAX, 0) : NAN;

        w->deep[i] = !isnan(g);
        if (w->deep[i]) {
            w->start.g0[i] = g;
            w->start.sharp[i] = true;
        }
    }
    return QDOT_OK;
}

qdot_status
qdot_watch_value_deep(qdot_watch *w, double t, double *g)
{
    QDOT_TRY(qdot_watch_read_two(w, t));
    for (size_t i = 0; i < w->m; i++) {
        const double value = w->deep[i] ? value_of_state(w, i, t, SIZE_MAX, 0) : NAN;

        if (!isnan(value))
            g[i] = value - w->now.offset[i];
    }
    return QDOT_OK;
}

/* Number of doubles of t beyond a root after which rounding of the state no longer hides the sign. */
static const double clearly = 0x1p12;

qdot_status
qdot_watch_leave_deep(qdot_watch *w, double t)
{
    const double by = fmin(clearly * spacing_of_doubles(w->t), 0.5 * w->length);

    QDOT_TRY(qdot_watch_read_two(w, w->t + w->direction * by));
    for (size_t i = 0; i < w->m; i++)
        w->leaves[i] =
            w->deep[i] ? qdot_watch_sign(value_of_state(w, i, w->t + w->direction * by, SIZE_MAX, 0)) : 0;
    return qdot_watch_value_deep(w, t, w->final);
}

void
qdot_watch_end_deep(qdot_watch *w)
{
    for (size_t i = 0; i < w->m && w->any_deep; i++)
        w->deep[i] = false;
    w->any_deep = false;
}

/* --- a crossing ------------------------------------------------------------------------ */

/* From t to `end`, in doubling steps, find where function i has the sign `sign` (0: any) and exceeds `noise`. */
static qdot_status
search_clear_sign(qdot_watch *w, size_t i, double t, double end, int sign, double noise, double *at, bool *found)
{
    const double way = end < t ? -1 : 1;
    double by = spacing_of_doubles(t);

    *found = false;
    for (*at = t; !*found; by *= 2) {
        double g;

        QDOT_TRY(evaluate_in_multiple_precision(w, i, *at, &g));
        *found = (sign == 0 ? fabs(g) : g * sign) > noise;
        if (*found || *at == end)
            break;
        *at = way * (t + way * by - end) < 0 ? t + way * by : end;
    }
    return QDOT_OK;
}

/* Bisect for the root between lo, where function i has the sign -way, and hi, in the run's time direction. */
static qdot_status
bisect_root(qdot_watch *w, size_t i, int way, double lo, double hi, qdot_root *root)
{
    double ends[2];

    for (;;) {
        const double middle = lo + 0.5 * (hi - lo);
        double g;

        if (middle == lo || middle == hi)
            break;
        QDOT_TRY(evaluate_in_multiple_precision(w, i, middle, &g));
        *(g * way >= 0 ? &hi : &lo) = middle;
    }
    QDOT_TRY(evaluate_in_multiple_precision(w, i, lo, ends));
    QDOT_TRY(evaluate_in_multiple_precision(w, i, hi, ends + 1));
    root->t = hi;
    root->exact = ends[1] == 0;
    root->late = root->exact ? 0 : fabs(hi - lo) * (fabs(ends[1]) / (fabs(ends[0]) + fabs(ends[1])));
    root->blur = root->exact ? 0 : fabs(hi - lo);
    return QDOT_OK;
}

/* Whether function i crosses 0 at t like an odd power (t - root)^m with m > 1. */
static qdot_status
crosses_like_odd_power(qdot_watch *w, size_t i, double t, double h, bool *is)
{
    double odd[2], even[2];

    for (int k = 0; k < 2; k++) {
        double before, behind;

        QDOT_TRY(evaluate_in_multiple_precision(w, i, t - (k + 1) * h, &before));
        QDOT_TRY(evaluate_in_multiple_precision(w, i, t + (k + 1) * h, &behind));
        odd[k] = fabs(behind - before);
        even[k] = fabs(behind + before);
    }
    *is = odd[0] > 2 * even[0] && odd[1] > 2 * even[1] && odd[1] > growth_of_cube * odd[0];
    return QDOT_OK;
}

/* Whether the root was found already, or is where the piece started: rounding splits a flat root into several. */
static bool
is_found_already(const qdot_watch *w, const qdot_root *root)
{
    const double near = 16 * DBL_EPSILON * fabs(root->t);

    if (w->deep[root->function] && fabs(root->t - w->t) <= near)
        return true;
    for (size_t k = w->roots.n; k-- > 0;)
        if (w->roots.at[k].function == root->function && w->roots.at[k].way == root->way)
            return fabs(w->roots.at[k].t - root->t) <= near;
    return false;
}

/* Record a root located in multiple precision, and set its residual: the |g| that doubles may show beside it. */
static qdot_status
record_with_residual(qdot_watch *w, double noise, qdot_root *root)
{
    double operations;

    root->deep = true;
    QDOT_TRY(w->reader.read(root->t, w->in, w->reader.user));
    QDOT_TRY(qdot_watch_operations(w, root->t, false, root->function, &operations));
    root->residual = fmax(root->residual, noise + operations);
    return QDOT_OK;
}

/* The time interval that is examined around a flat root, within the step. */
typedef struct {
    double from, to, ulp;
} flat_range;

/* Find the smallest value of sign * g_i between lo and hi, at the time *t. */
static qdot_status
minimise_between(qdot_watch *w, size_t i, int sign, double lo, double hi, double *t)
{
    while (fabs(hi - lo) > 4 * spacing_of_doubles(fmax(fabs(lo), fabs(hi)))) {
        const double third = (hi - lo) / 3;
        double a, b;

        QDOT_TRY(evaluate_in_multiple_precision(w, i, lo + third, &a));
        QDOT_TRY(evaluate_in_multiple_precision(w, i, hi - third, &b));
        if (sign * a < sign * b)
            hi -= third;
        else
            lo += third;
    }
    *t = lo + 0.5 * (hi - lo);
    return QDOT_OK;
}

/* Find the change of function i if t changes by a few doubles about `t`. */
static qdot_status
find_change_over_doubles(qdot_watch *w, size_t i, double t, double *change)
{
    const double by = 4 * spacing_of_doubles(t);
    double at, before, behind;

    QDOT_TRY(evaluate_in_multiple_precision(w, i, t, &at));
    QDOT_TRY(evaluate_in_multiple_precision(w, i, t - by, &before));
    QDOT_TRY(evaluate_in_multiple_precision(w, i, t + by, &behind));
    *change = fmax(fabs(before - at), fabs(behind - at));
    return QDOT_OK;
}

/* The extremum of function i, of that sign on both sides, to which it falls from root->t. If that is 0 but for rounding of
 * the state the root becomes a touch there; *is. */
static qdot_status
make_touching_root(qdot_watch *w, const flat_range *of, int sign, qdot_root *root, bool *is)
{
    const size_t i = root->function;
    double ends[2], g, noise, change;
    bool found;

    QDOT_TRY(evaluate_in_multiple_precision(w, i, root->t, &g));
    /* on both sides: search the nearest point with a clear sign, and a point twice as far */
    for (int side = 0; side < 2; side++) {
        const double end = side == 0 ? of->from : of->to, way = end < root->t ? -1 : 1;
        double there = g, last = g;

        ends[side] = root->t;
        for (double by = of->ulp; ends[side] != end && sign * there <= sign * last; by *= 2) {
            last = there;
            ends[side] = way * (root->t + way * by - end) < 0 ? root->t + way * by : end;
            QDOT_TRY(evaluate_in_multiple_precision(w, i, ends[side], &there));
        }
    }
    QDOT_TRY(minimise_between(w, i, sign, ends[0], ends[1], &root->t));
    QDOT_TRY(find_state_rounding_effect(w, i, root->t, &noise));
    QDOT_TRY(find_change_over_doubles(w, i, root->t, &change));
    noise += change;
    QDOT_TRY(evaluate_in_multiple_precision(w, i, root->t, &g));
    *is = fabs(g) <= 4 * noise;
    if (!*is)
        return QDOT_OK;
    QDOT_TRY(search_clear_sign(w, i, root->t, of->from, sign, 4 * noise, ends, &found));
    QDOT_TRY(search_clear_sign(w, i, root->t, of->to, sign, 4 * noise, ends + 1, &found));
    root->way = 0;
    root->exact = false;
    root->late = root->flat = 0;
    root->blur = fabs(ends[1] - ends[0]);
    root->residual = 0;
    return record_with_residual(w, noise, root);
}

/* How far around the crossing `root` rounding of the state hides function i: root->flat, unless it is a few doubles of t;
 * *noise: what that makes of it. */
static qdot_status
find_hidden_width(qdot_watch *w, const flat_range *of, qdot_root *root, double *noise)
{
    double lo, hi;
    bool found;

    QDOT_TRY(find_state_rounding_effect(w, root->function, root->t, noise));
    QDOT_TRY(search_clear_sign(w, root->function, root->t, of->from, -root->way, *noise, &lo, &found));
    QDOT_TRY(search_clear_sign(w, root->function, root->t, of->to, root->way, *noise, &hi, &found));
    root->flat = fabs(hi - lo) > 16 * of->ulp ? fabs(hi - lo) : 0;
    return QDOT_OK;
}

/* Take note of a crossing beside which the function has the other sign somewhere, as far as its operations in doubles round
 * by `hidden`: it is one of several that doubles do not tell apart. */
static qdot_status
search_several_crossings(qdot_watch *w, const flat_range *of, double noise, double hidden, qdot_root *root)
{
    for (int side = 0; side < 2 && !root->several; side++) {
        const double end = side == 0 ? of->from : of->to, way = end < root->t ? -1 : 1;
        const int sign = side == 0 ? -root->way : root->way;
        double at = root->t, g = 0;

        for (double by = of->ulp; at != end && !root->several && sign * g <= 64 * hidden; by *= 1.5) {
            at = way * (root->t + way * by - end) < 0 ? root->t + way * by : end;
            QDOT_TRY(evaluate_in_multiple_precision(w, root->function, at, &g));
            root->several = sign * g < -noise;
        }
        if (root->several)
            root->blur = fmax(root->blur, fabs(at - root->t));
    }
    return QDOT_OK;
}

static flat_range
range_around_root(const qdot_watch *w, const qdot_watch_part *p, double t)
{
    const double length = fabs(p->b - p->a), end = w->t + w->direction * w->length;

    return (flat_range){.from = fabs(p->a - w->t) < length ? w->t : p->a - w->direction * length,
                        .to = fabs(end - p->b) < length ? end : p->b + w->direction * length,
                        .ulp = spacing_of_doubles(t)};
}

/* From the crossing at t to `end`, in doubling steps: where function i has the sign `sign` and exceeds `noise`, or `end`. */
static qdot_status
search_sign_beyond_noise(qdot_watch *w, size_t i, double t, double end, int sign, double noise, double *at)
{
    const double way = end < t ? -1 : 1;
    double by = spacing_of_doubles(t);

    for (*at = t; *at != end; by *= 2) {
        *at = way * (t + way * by - end) < 0 ? t + way * by : end;
        QDOT_TRY(qdot_watch_value_at(w, *at, w->g));
        if (sign * w->g[i] > noise)
            return QDOT_OK;
    }
    return QDOT_OK;
}

/* Make root->blur at least as wide as the time within which rounding of its operations hides function i, in the precision in
 * which the crossing was found. */
static qdot_status
widen_by_operations(qdot_watch *w, const qdot_watch_part *p, qdot_root *root)
{
    const size_t i = root->function;
    const bool others = w->fine, wanted = w->wants[i];
    double noise, before, behind;
    qdot_status status;

    w->wants[i] = wanted || qdot_watch_can_two(w, i);
    w->fine = others || w->wants[i];
    status = w->reader.read(root->t, w->in, w->reader.user);
    if (status == QDOT_OK)
        status = qdot_watch_operations(w, root->t, qdot_watch_is_fine(w, i), i, &noise);
    if (status == QDOT_OK)
        status = search_sign_beyond_noise(w, i, root->t, p->a, -root->way, noise, &before);
    if (status == QDOT_OK)
        status = search_sign_beyond_noise(w, i, root->t, p->b, root->way, noise, &behind);
    w->wants[i] = wanted;
    w->fine = others;
    if (status == QDOT_OK && fabs(behind - before) > 16 * spacing_of_doubles(root->t))
        root->blur = fmax(root->blur, fabs(behind - before));
    return qdot_grave(status);
}

qdot_status
qdot_watch_settle_flat(qdot_watch *w, const qdot_watch_part *p, double slope, qdot_root *root, bool *is)
{
    const size_t i = root->function;
    const double length = fabs(p->b - p->a);
    const flat_range of = range_around_root(w, p, root->t);
    double noise, hidden, lo, hi, room, h;
    bool before, behind;

    *is = true;
    if (w->coarse || root->pole || slope * length > hardly_any * qdot_chebyshev_size(p->n, p->c))
        return QDOT_OK;
    if (!may_use_multiple_precision(w, i))
        return widen_by_operations(w, p, root);
    QDOT_TRY(make_multiple_precision_program(w));
    QDOT_TRY(find_state_rounding_effect(w, i, root->t, &noise));
    QDOT_TRY(search_clear_sign(w, i, root->t, of.from, -root->way, noise, &lo, &before));
    QDOT_TRY(search_clear_sign(w, i, root->t, of.to, root->way, noise, &hi, &behind));
    room = fmin(w->deep[i] ? INFINITY : fabs(root->t - of.from), fabs(of.to - root->t));
    if (before != behind) {
        if (room > 0x1p-10 * length) {
            QDOT_TRY(make_touching_root(w, &of, before ? -root->way : root->way, root, is));
            *is = *is && !is_found_already(w, root);
        } else { /* the flat root lies at an end of the step */
            root->flat = 16 * room;
        }
        return QDOT_OK;
    }
    *is = before;
    if (!*is)
        return QDOT_OK;
    if (fabs(hi - lo) > 4 * of.ulp)
        QDOT_TRY(bisect_root(w, i, root->way, lo, hi, root));
    QDOT_TRY(w->reader.read(root->t, w->in, w->reader.user));
    QDOT_TRY(qdot_watch_operations(w, root->t, false, i, &hidden));
    QDOT_TRY(search_several_crossings(w, &of, noise, hidden, root));
    if (root->several)
        return QDOT_OK;
    QDOT_TRY(find_hidden_width(w, &of, root, &noise));
    h = fmax(64 * of.ulp, 16 * root->flat);
    if (fmin(fabs(root->t - of.from), fabs(of.to - root->t)) > 2 * h)
        QDOT_TRY(crosses_like_odd_power(w, i, root->t, h, &root->cubic));
    *is = !is_found_already(w, root);
    return root->cubic || root->flat > 0 ? record_with_residual(w, noise, root) : QDOT_OK;
}

qdot_status
qdot_watch_settle_touch(qdot_watch *w, const qdot_watch_part *p, double bend, bool hidden, qdot_root *root, bool *is)
{
    const size_t i = root->function;
    const double length = fabs(p->b - p->a);
    const flat_range of = range_around_root(w, p, root->t);
    const qdot_root seen = *root;
    double noise, at;
    int sign[2] = {0, 0};

    *is = true;
    if (w->coarse || !may_use_multiple_precision(w, i)
        || (!hidden && fabs(bend) * length * length > hardly_any * qdot_chebyshev_size(p->n, p->c)))
        return QDOT_OK;
    QDOT_TRY(make_multiple_precision_program(w));
    QDOT_TRY(find_state_rounding_effect(w, i, root->t, &noise));
    for (int side = 0; side < 2; side++) {
        double g;
        bool found;

        QDOT_TRY(search_clear_sign(w, i, root->t, side == 0 ? of.from : of.to, 0, 4 * noise, &at, &found));
        QDOT_TRY(evaluate_in_multiple_precision(w, i, at, &g));
        sign[side] = found ? qdot_watch_sign(g) : 0;
    }
    *is = sign[0] != 0 || !w->deep[i] || of.from != w->t; /* otherwise it is the zero on which the piece starts */
    if (sign[0] == 0 || sign[1] == 0)                     /* the root is at an end of the step, or g stays 0 */
        return QDOT_OK;
    *is = sign[0] == sign[1];
    if (*is)
        QDOT_TRY(make_touching_root(w, &of, sign[0], root, is));
    if (!*is && sign[0] == sign[1]) {
        QDOT_TRY(evaluate_in_multiple_precision(w, i, root->t, &at));
        if (sign[0] * at < 0) { /* the sign in between differs from that on both sides: there are two crossings */
            *root = seen;
            root->several = *is = true;
        }
    }
    *is = *is && !is_found_already(w, root);
    return QDOT_OK;
}
