/* orbit-bifurcation.c -- finds bifurcations of periodic orbits as zeros of test functions along a curve. */
#include "sim/branches/orbit-bifurcation.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "num/eigenvalues.h"

/* Of the step that a crossing lies in: half the distances of places for its polynomial. Of a length of 1: the step of second
 * derivatives. A direction with less along p has none. */
static const double wide = 0.1, narrower = 0.3, difference = 1e-4, upright = 1e-4;
/* A crossing whose position polynomials determine no better than this, in units of the curve, is none: two curves
 * come near each other. */
static const double apart = 1e-10;
/* A relative rounding error common to the fine and the coarse run, which their difference does not show. */
static const double rounding = 4e-15;
/* Multipliers mu are a pair on the unit circle if ||mu| - 1| < on_circle and |sin(arg mu)| > off_axis. */
static const double on_circle = 1e-6, off_axis = 1e-3;
/* The smallest error assumed for the arclength of a crossing. */
static const double least_off = 5e-14;
/* If the states half a period apart differ by less than this (in scaled length), the period is half as long. */
static const double half = 1e-9;
enum { STEPS = 60, HALVINGS = 36, PLACES = 6, SHIFTS = 4, NARROWINGS = 6 };

typedef struct {
    qdot_orbit_path *x;
    const qdot_path_point *a; /* point from which the arclength s is counted */
    qdot_path_point point;    /* the latest point computed */
    qdot_bifurcation_kind kind;
    bool krein;
    bool apart, rests; /* two curves come close without crossing; the orbit has shrunk to an equilibrium */
    double *re, *im, *off; /* [c] multipliers re + i im, and their errors */
    double *none;          /* [K x c x c] zeros, passed where no errors of the segments' matrices are known */
    double angle, beside; /* of the multiplier pair nearest to the unit circle: its angle, its distance from the circle */
} search;

/* --- test functions of bifurcations -------------------------------------------------------------- */

static double
pair_test_function(search *f, size_t z)
{
    double product = 1, nearest = INFINITY;
    size_t trivial = f->x->driven ? 0 : 1;

    f->angle = 0;
    for (size_t i = 0; i < z; i++) {
        const double off = fabs(hypot(f->re[i], f->im[i]) - 1);

        if (f->im[i] > 0 && off < nearest) {
            f->beside = nearest = off;
            f->angle = atan2(f->im[i], f->re[i]);
        }
    }
    for (size_t k = 0; k < trivial; k++) { /* multipliers nearest to 1 are trivial and not counted */
        size_t best = 0;

        for (size_t i = 1; i < z; i++)
            if (hypot(f->re[i] - 1, f->im[i]) < hypot(f->re[best] - 1, f->im[best]))
                best = i;
        f->re[best] = NAN;
    }
    for (size_t i = 0; i < z; i++)
        for (size_t j = i + 1; j < z; j++) {
            const double re = f->re[i] * f->re[j] - f->im[i] * f->im[j] - 1,
                         im = f->re[i] * f->im[j] + f->im[i] * f->re[j];

            if (isnan(re))
                continue;
            if (f->im[i] == -f->im[j] || (f->im[i] == 0 && f->im[j] == 0))
                product *= re;
            else
                product *= hypot(re, im); /* a complex multiplier times its conjugate */
        }
    return product;
}

/* The test function of the bifurcation sought, at the point f->point; NaN if it is not known. */
static double
evaluate_test_function(search *f)
{
    const size_t z = f->x->c;
    double product = 1;

    if (f->kind == QDOT_FOLD)
        return f->point.t[f->x->path.n];
    if (f->kind == QDOT_PITCHFORK)
        return f->point.det;
    if (f->kind == QDOT_HALVING) /* the usual test function is 0 all along the other curve */
        return qdot_path_halves(&f->x->path, f->point.y, f->point.y) > half * half
                   ? qdot_path_halves(&f->x->path, f->a->y, f->point.y)
                   : NAN;
    if (!qdot_orbit_path_monodromy(f->x, f->point.y) ||
        qdot_eigenvalues_of_product(f->x->K, z, f->x->B, f->none, f->re, f->im, f->off) != QDOT_OK)
        return NAN;
    if (f->kind == QDOT_DOUBLING) {
        for (size_t k = 0; k < z; k++)
            product *= f->im[k] == 0 ? f->re[k] + 1 : hypot(f->re[k] + 1, f->im[k]);
        return product;
    }
    return pair_test_function(f, z);
}

/* The test function of the bifurcation at arclength s from f->a; NaN if no point was found there. */
static double
test_function_at(search *f, double s)
{
    int steps;

    return qdot_path_go(&f->x->path, f->a, s, &f->point, &steps) ? evaluate_test_function(f) : NAN;
}

/* --- zeros of test functions ------------------------------------------------------------------ */

/* The zero between *lo and *hi, whose values are known, to `fine`, by regula falsi with halved values (Illinois). False:
 * the values do not differ in sign, or one is not known. */
static bool
narrow_bracket(search *f, double *lo, double *hi, double fine)
{
    double *const end[2] = {lo, hi};
    double value[2] = {test_function_at(f, *lo), test_function_at(f, *hi)};
    size_t last = 2; /* the end of the interval moved by the last step; 2: none yet */

    if (!(value[0] * value[1] <= 0))
        return false;
    for (int step = 0; step < STEPS && *hi - *lo > fine; step++) {
        const double guess = (*lo * value[1] - *hi * value[0]) / (value[1] - value[0]);
        const double s = guess > *lo && guess < *hi ? guess : (*lo + *hi) / 2;
        const double here = test_function_at(f, s);
        const size_t k = here * value[0] > 0 ? 0 : 1; /* the end of the interval that this step moves */

        if (isnan(here))
            return false;
        if (here == 0 || s == *lo || s == *hi) {
            *lo = *hi = s;
            return true;
        }
        if (fabs(s - *end[k]) < fine / 4) { /* the same end has moved each time: step past the zero, to move the other end */
            const double over = k == 0 ? fmin(s + fine / 2, *hi) : fmax(s - fine / 2, *lo);
            const double there = test_function_at(f, over);

            if (!isnan(there) && there * here <= 0) {
                *end[k] = s;
                *end[!k] = over;
                return true;
            }
        }
        *end[k] = s;
        value[k] = here;
        if (last == k)
            value[!k] /= 2;
        last = k;
    }
    return true;
}

/* The polynomial through (x, f) [n] at s, by Neville's scheme. */
static double
interpolate_neville(size_t n, const double *x, const double *f, double s)
{
    double p[PLACES];

    memcpy(p, f, n * sizeof *p);
    for (size_t k = 1; k < n; k++)
        for (size_t i = 0; i + k < n; i++)
            p[i] = ((s - x[i + k]) * p[i] + (x[i] - s) * p[i + 1]) / (x[i] - x[i + k]);
    return p[0];
}

/* The zero near s of the polynomial through the points (x, f), by the secant method. */
static double
zero_of_interpolant(size_t n, const double *x, const double *f, double s, double step)
{
    double a = s - step, b = s + step, at_a = interpolate_neville(n, x, f, a),
           at_b = interpolate_neville(n, x, f, b);

    for (int k = 0; k < STEPS && at_a != at_b; k++) {
        const double c = b - at_b * (b - a) / (at_b - at_a);

        a = b;
        at_a = at_b;
        b = c;
        at_b = interpolate_neville(n, x, f, b);
        if (fabs(b - a) < 1e-16)
            break;
    }
    return b;
}

/* Fit a polynomial through points near *s: finds its zero *s, y [n + 1] there, and the error *off of s. */
static bool
fit_crossing(search *f, double *s, double step, double *y, double *off)
{
    const size_t m = f->x->path.n + 1;
    double at[PLACES], value[PLACES], *all = qdot_malloc(PLACES * m * sizeof *all), zero = NAN;
    bool good = all != NULL;

    for (size_t k = 0; k < PLACES && good; k++) { /* nodes at -5, -3, -1, 1, 3, 5 steps from the crossing */
        at[k] = *s + step * ((double)(2 * k) - (PLACES - 1));
        value[k] = test_function_at(f, at[k]);
        good = isfinite(value[k]);
        memcpy(all + k * m, f->point.y, m * sizeof *all);
    }
    if (good) {
        zero = zero_of_interpolant(PLACES, at, value, *s, step);
        *off = fabs(zero - zero_of_interpolant(PLACES - 2, at + 1, value + 1, *s, step));
        good = fabs(zero - *s) < 5 * step;
    }
    for (size_t i = 0; i < m && good; i++) {
        double own[PLACES];

        for (size_t k = 0; k < PLACES; k++)
            own[k] = all[k * m + i];
        y[i] = interpolate_neville(PLACES, at, own, zero);
    }
    *s = zero;
    qdot_free(all);
    return good;
}

/* Fit a polynomial through places next to *s; if a place lies at the crossing and has no solution, through others
 * beside them. */
static bool
fit_crossing_with_shifts(search *f, double *s, double step, double *y, double *off)
{
    const double from = *s;

    for (int k = 0; k < SHIFTS && f->x->path.failure == QDOT_OK; k++) {
        *s = from + 0.37 * step * (k % 2 == 0 ? k : -k);
        if (fit_crossing(f, s, step, y, off))
            return true;
    }
    return false;
}

/* A crossing between lo and hi, from where a line through both ends says: places nearer and nearer to it, as long as that
 * makes it more certain. To f->point. */
static bool
find_crossing_by_fits(search *f, double lo, double hi, double *off)
{
    const size_t m = f->x->path.n + 1;
    const double at_lo = test_function_at(f, lo), at_hi = test_function_at(f, hi);
    double s = lo + (hi - lo) * at_lo / (at_lo - at_hi), step = wide * (hi - lo), now;
    double *best = qdot_malloc(2 * m * sizeof *best), *const y = best + m;
    bool found = best != NULL && at_lo * at_hi <= 0 && fit_crossing_with_shifts(f, &s, step, best, off);

    for (int k = 0; k < NARROWINGS && found; k++) {
        step *= narrower;
        if (!fit_crossing_with_shifts(f, &s, step, y, &now) || !(now < *off))
            break;
        memcpy(best, y, m * sizeof *y);
        *off = now;
    }
    *off = fmax(*off, least_off); /* assume at least this error, as two polynomials may agree by chance */
    if (found)
        memcpy(f->point.y, best, m * sizeof *best);
    qdot_free(best);
    return found;
}

/* Bisect lo .. hi, between which the number of multipliers outside the unit circle changes. */
static qdot_status
bisect_by_multiplier_count(search *f, double *lo, double *hi, bool *found)
{
    qdot_path *path = &f->x->path;

    *found = true;
    for (int k = 0; k < HALVINGS; k++) {
        const double s = (*lo + *hi) / 2;
        int steps;

        if (!qdot_path_go(path, f->a, s, &f->point, &steps)) {
            *found = false;
            return path->failure;
        }
        QDOT_TRY(path->judge(path, &f->point));
        if (f->point.growing == f->a->growing)
            *lo = s;
        else
            *hi = s;
    }
    (void)evaluate_test_function(f);
    return QDOT_OK;
}

/* Widen lo .. hi: as multipliers count as growing beyond 1 + 1e-6 only, the circle may lie outside
 * by as much. */
static void
widen_bracket(search *f, double *lo, double *hi)
{
    for (double by = 1e-9; by < 1e-3 && !(test_function_at(f, *lo) * test_function_at(f, *hi) <= 0); by *= 10) {
        *lo -= by;
        *hi += by;
    }
}

/* Whether two curves cross at the bifurcation, where orbits can be computed only next to it. */
static bool
is_curve_crossing(const search *f)
{
    return f->kind == QDOT_PITCHFORK || f->kind == QDOT_HALVING;
}

/* Locate the bifurcation between arclengths lo and hi: y [width] there, and the error *off of its arclength. */
static qdot_status
locate_orbit_bifurcation(search *f, double lo, double hi, double *y, double *off, bool *found)
{
    qdot_path *path = &f->x->path;

    *found = false;
    if (f->kind == QDOT_TORUS && f->krein) {
        QDOT_TRY(bisect_by_multiplier_count(f, &lo, &hi, found));
        *off = 1e-10 + hi - lo;
    } else if (is_curve_crossing(f)) {
        *found = find_crossing_by_fits(f, lo, hi, off);
    } else {
        if (f->kind == QDOT_TORUS)
            widen_bracket(f, &lo, &hi);
        *found = narrow_bracket(f, &lo, &hi, 1e-13);
        *off = hi - lo;
    }
    if (path->failure != QDOT_OK)
        return path->failure;
    if (*found && !is_curve_crossing(f))
        *found = !isnan(test_function_at(f, (lo + hi) / 2));
    if (*found) {
        QDOT_TRY(path->judge(path, &f->point));
        memcpy(y, f->point.y, path->width * sizeof *y);
    }
    return path->failure;
}

/* --- the other branch at a crossing --------------------------------------------------------------- */

/* Find the gradient of psi.F with respect to y, at the shifted point y + h v: out [n + 1]. */
static bool
shifted_gradient(qdot_path *x, const double *y, const double *v, double h, const double *psi,
                 double *room, double *out)
{
    const size_t m = x->n + 1;

    for (size_t i = 0; i < m; i++)
        room[i] = y[i] + h * v[i];
    x->at(x, room);
    if (!isfinite(x->F[0]))
        return false;
    for (size_t j = 0; j < m; j++) {
        out[j] = 0;
        for (size_t i = 0; i < x->n; i++)
            out[j] += psi[i] * x->J[i * m + j];
    }
    return true;
}

/* Find the coefficients v_i.(psi.F)_yy v_j of the quadratic form that determines the crossing curves' tangents. */
static bool
find_quadratic_form(qdot_path *x, const double *y, const double *v, const double *psi, double *room, double *c)
{
    const size_t m = x->n + 1;
    double *const up = room + m, *const down = up + m;

    memset(c, 0, 3 * sizeof *c);
    for (size_t k = 0; k < 2; k++) {
        const double *const along = v + k * m;

        if (!shifted_gradient(x, y, along, difference, psi, room, up) ||
            !shifted_gradient(x, y, along, -difference, psi, room, down))
            return false;
        for (size_t j = 0; j < m; j++) {
            const double second = (up[j] - down[j]) / (2 * difference);

            if (k == 0)
                c[0] += second * v[j];
            c[k + 1] += second * v[m + j]; /* coefficients c12, then c22 */
        }
    }
    return true;
}

/* Find null vectors v of F_y and psi of its transpose, of unit length in the scaled norm. */
static qdot_status
find_null_vectors(qdot_path *x, const double *y, double *v, double *psi)
{
    const size_t n = x->n, m = n + 1;

    x->at(x, y);
    if (!isfinite(x->F[0]))
        return x->failure != QDOT_OK ? x->failure : qdot_fail(QDOT_EFAILED, "no orbit is there");
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < m; j++)
            x->A[i * m + j] = x->J[i * m + j] / sqrt(x->weight[j]);
    memset(x->A + n * m, 0, m * sizeof *x->A);
    QDOT_TRY(qdot_null_vectors(m, m, x->A, 2, v));
    for (size_t k = 0; k < 2; k++)
        for (size_t j = 0; j < m; j++)
            v[k * m + j] /= sqrt(x->weight[j]);
    for (size_t j = 0; j < m; j++)
        for (size_t i = 0; i < n; i++)
            x->A[j * n + i] = x->J[i * m + j] / sqrt(x->weight[j]);
    return qdot_null_vectors(m, n, x->A, 1, psi);
}

/* Choose the sign of the direction t so that its largest scaled component is positive. */
static void
make_largest_component_positive(const qdot_path *x, double *t)
{
    size_t most = 0;

    for (size_t i = 1; i <= x->n; i++)
        if (fabs(t[i]) * sqrt(x->weight[i]) > fabs(t[most]) * sqrt(x->weight[most]))
            most = i;
    for (size_t i = 0; t[most] < 0 && i <= x->n; i++)
        t[i] = i == most ? t[i] : -t[i];
    t[most] = fabs(t[most]);
}

/* Find the tangent, at y, of the branch of doubled period; along the tangent p is constant to first order. */
qdot_status
qdot_orbit_bifurcation_double(qdot_orbit_path *orbit, const double *y, double *t)
{
    qdot_path *x = &orbit->path;
    const size_t m = x->n + 1;
    double *v = qdot_calloc(4 * m, sizeof *v), size;
    qdot_status status = v ? find_null_vectors(x, y, v, v + 2 * m) : QDOT_ENOMEM;

    for (size_t i = 0; i < m && status == QDOT_OK; i++)
        t[i] = v[2 * m - 1] * v[i] - v[m - 1] * v[m + i];
    size = status == QDOT_OK ? sqrt(qdot_path_product(x, t, t)) : 1;
    for (size_t i = 0; i < m && status == QDOT_OK; i++)
        t[i] /= size;
    if (status == QDOT_OK)
        make_largest_component_positive(x, t);
    qdot_free(v);
    return status;
}

static qdot_status
classify_orbit_bifurcation(search *f, const double *y, qdot_bifurcation_kind *kind, double *other, bool *found)
{
    qdot_path *x = &f->x->path;
    const size_t m = x->n + 1;
    double *v = qdot_calloc(8 * m, sizeof *v), *psi = v + 4 * m, c[3];
    qdot_status status = v ? find_null_vectors(x, y, v, psi) : QDOT_ENOMEM;

    if (status == QDOT_OK) {
        *found = find_quadratic_form(x, y, v, psi, psi + m, c) &&
                 qdot_bifurcation_cross(x, c, v, f->a->t, upright, 1e-12, kind, other);
        status = x->failure;
        if (*found)
            make_largest_component_positive(x, other);
    }
    qdot_free(v);
    return qdot_grave(status);
}

/* --- locating a bifurcation of any kind ----------------------------------------------------------- */

/* Recompute the point a of the curve by the run with the coarse tolerance. */
static bool
recompute_coarsely(qdot_orbit_path *x, const qdot_path_point *a, qdot_path_point *to)
{
    qdot_path *path = &x->path;
    int steps;

    qdot_path_point_copy(path, a, to);
    return qdot_path_go(path, a, 0, to, &steps);
}

/* Find the bifurcation again by runs with the coarse tolerance; the difference gives the errors of y. */
static qdot_status
orbit_find_errors(search *f, double lo, double hi, const double *y, const double *t, double off,
                  double *error, bool *found)
{
    qdot_orbit_path *x = f->x;
    qdot_path *path = &x->path;
    const qdot_path_point *const a = f->a;
    double *other = qdot_calloc(path->width, sizeof *other), coarse_off = 0;
    qdot_path_point start = {0};
    qdot_status status = other ? qdot_path_point_begin(path, &start) : QDOT_ENOMEM;

    *found = false;
    qdot_orbit_path_ask(x, 1);
    if (status == QDOT_OK && recompute_coarsely(x, a, &start)) {
        start.growing = a->growing;
        f->a = &start;
        status = locate_orbit_bifurcation(f, lo, hi, other, &coarse_off, found);
        f->a = a;
    }
    qdot_orbit_path_ask(x, 0);
    for (size_t i = 0; i < path->width && *found; i++) {
        error[i] = fabs(other[i] - y[i]) + rounding * fabs(y[i]);
        if (i <= path->n)
            error[i] += off * (fabs(t[i]) + off / sqrt(path->weight[i]));
        else
            error[i] += off * fabs(y[i]);
    }
    qdot_path_point_end(&start);
    qdot_free(other);
    return status == QDOT_OK ? path->failure : status;
}

static qdot_status
find_orbit_bifurcation(search *f, const qdot_bifurcation_bracket *in, qdot_bifurcation *out, double *other,
                       bool *found)
{
    const size_t w = f->x->path.width, m = f->x->path.n + 1;
    double *y = qdot_calloc(w + m, sizeof *y), *const t = y + w, off = 0;
    qdot_status status = y ? locate_orbit_bifurcation(f, in->from, in->to, y, &off, found) : QDOT_ENOMEM;
    const double angle = f->angle;
    /* otherwise several real multipliers pass 1 or -1 at once */
    const bool pair = fabs(sin(angle)) > off_axis && (f->krein || f->beside < on_circle);

    if (status == QDOT_OK)
        memcpy(t, is_curve_crossing(f) ? in->a->t : f->point.t, m * sizeof *t);
    if (*found && f->kind == QDOT_PITCHFORK) {
        f->rests = f->point.rests;
        f->apart = !f->rests && off > apart;
        *found = !f->apart && !f->rests;
        if (f->rests)
            memcpy(out->y, y, w * sizeof *out->y);
    }
    if (status == QDOT_OK && *found && f->kind == QDOT_PITCHFORK)
        status = classify_orbit_bifurcation(f, y, &f->kind, other, found);
    if (status == QDOT_OK && *found) {
        const qdot_bifurcation_kind kind = f->kind;

        out->kind = kind != QDOT_TORUS ? kind
                    : !pair            ? QDOT_NOT_SIMPLE
                    : f->krein         ? QDOT_KREIN
                                       : kind;
        f->kind = kind == QDOT_TRANSCRITICAL ? QDOT_PITCHFORK : kind;
        status = orbit_find_errors(f, in->from, in->to, y, t, off, out->error, found);
    }
    if (status == QDOT_OK && *found) {
        memcpy(out->y, y, w * sizeof *y);
        if (f->kind == QDOT_TORUS && pair) {
            out->frequency = angle;
            out->frequency_error = fabs(angle - f->angle) + 1e-15;
        }
    }
    qdot_free(y);
    return status;
}

qdot_status
qdot_orbit_bifurcation_find(void *user, const qdot_bifurcation_bracket *in, qdot_bifurcation *out,
                            double *other, qdot_bifurcation_answer *answer)
{
    qdot_orbit_path *x = user;
    const size_t z = x->c;
    search f = {.x = x, .a = in->a, .kind = out->kind == QDOT_HOPF ? QDOT_TORUS : out->kind, .krein = !x->asymptotic};
    bool found = false;
    qdot_status status = qdot_path_point_begin(&x->path, &f.point);

    *answer = QDOT_BIFURCATION_NONE;
    f.re = qdot_calloc(3 * z + x->K * z * z, sizeof *f.re);
    if (f.re == NULL)
        status = QDOT_ENOMEM;
    if (status == QDOT_OK) {
        f.im = f.re + z;
        f.off = f.im + z;
        f.none = f.off + z;
        status = find_orbit_bifurcation(&f, in, out, other, &found);
    }
    if (status == QDOT_OK && found)
        *answer = QDOT_BIFURCATION_FOUND;
    else if (f.apart || f.rests)
        *answer = f.rests ? QDOT_BIFURCATION_REST : QDOT_BIFURCATION_APART;
    qdot_free(f.re);
    qdot_path_point_end(&f.point);
    return status;
}
