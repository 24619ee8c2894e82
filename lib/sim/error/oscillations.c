/* oscillations.c -- finds oscillations of the linearised motion that are faster than the steps of the run. */
#include "sim/error/oscillations.h"

#include <complex.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

#include "base/memory.h"
#include "num/eigenmodes.h"
#include "ode/scale.h"

static const double period = 6.283185307179586;

/* How many points are compared: early in the run; before and after the end of the first step that is too long. */
enum { early = 2, before = 2, behind = 2 };

/* If the fast oscillation was resolved for more steps than this, the companion runs show its error. */
enum { soon = 50 };

/* Velocities of more than this many tolerances appear in the integrator's error estimate of a step. */
static const double unseen = 100;

/* Safety factor: amplitudes change along the run as frequencies change. */
static const double at_most = 2;

struct qdot_oscillations {
    const qdot_course *course;
    double longest; /* length of the longest step */
    double lost;    /* amplitude (max A - min A) lost at the first points of the run */
    double damping; /* smallest damping rate |Re lambda| at the start of the run */
    double *J, *f;  /* Jacobian [n x n]; scratch [2n] */
    double complex *lambda, *v, *c; /* eigenvalues [n]; eigenvectors [n x n]; coefficients [n] */
};

void
qdot_oscillations_free(qdot_oscillations *o)
{
    if (!o)
        return;
    qdot_free(o->J);
    qdot_free(o->f);
    qdot_free(o->lambda);
    qdot_free(o->v);
    qdot_free(o->c);
    qdot_free(o);
}

static double
longest_step(const qdot_trajectory *tr)
{
    double h = 0;

    for (size_t k = 0; k + 1 < tr->count && tr->n_tracks == 0; k++)
        h = fmax(h, fabs(tr->t[k + 1] - tr->t[k]));
    for (size_t k = 0; k < tr->n_tracks; k++)
        h = fmax(h, longest_step(tr->tracks + k));
    return h;
}

/* Whether mode k oscillates too fast for steps of length h; of a conjugate pair, true for one mode only. */
static bool
is_unresolved_mode(const qdot_oscillations *o, size_t k, double h)
{
    const double complex l = o->lambda[k];

    return cimag(l) > fabs(creal(l)) && cabs(l) * h > period;
}

/* The modes of the linearised motion at a state, scaled so that the largest velocity is 1; *there:
 * they were found. */
static qdot_status
find_linear_modes(qdot_oscillations *o, size_t mode, double t, const double *y, bool *there)
{
    const qdot_ode_system *system = qdot_course_systems(o->course) + mode;
    const size_t n = system->n;
    double *second = o->f + n; /* second derivative y'' = df/dt + J f */
    qdot_status status = system->rhs(t, y, o->f, system->user);

    if (status == QDOT_OK)
        status = system->jacobian(t, y, o->J, second, system->user);
    for (size_t i = 0; i < n * n && status == QDOT_OK; i++)
        second[i / n] += o->J[i] * o->f[i % n];
    if (status == QDOT_OK)
        status = qdot_eigenmodes(n, o->J, second, o->lambda, o->v, o->c);
    *there = status == QDOT_OK;
    for (size_t k = 0; k < n && *there; k++) {
        double most = 0;

        for (size_t i = n / 2; i < n; i++)
            most = fmax(most, cabs(o->v[k * n + i]));
        for (size_t i = 0; i < n; i++)
            o->v[k * n + i] /= most;
        o->c[k] *= most / o->lambda[k];
    }
    return status == QDOT_ENOMEM || status == QDOT_EINTR ? status : QDOT_OK;
}

/* Find the amplitude A of unresolved oscillations at stored point j, the fastest rate and the least damping. */
static qdot_status
measure_oscillations(qdot_oscillations *o, size_t j, double *A, double *fastest, double *damping)
{
    const qdot_trajectory *tr = &o->course->tr;
    const size_t mode = tr->pieces.at[qdot_trajectory_piece_of(tr, j)].mode;
    double sum = 0;
    bool there;

    *fastest = 0;
    *damping = INFINITY;
    QDOT_TRY(find_linear_modes(o, mode, tr->t[j], tr->y + j * tr->n, &there));
    for (size_t k = 0; k < tr->n && there; k++)
        if (is_unresolved_mode(o, k, o->longest)) {
            sum += 4 * creal(o->c[k] * conj(o->c[k]));
            *fastest = fmax(*fastest, cabs(o->lambda[k]));
            *damping = fmin(*damping, fabs(creal(o->lambda[k])));
        }
    *A = sqrt(sum);
    return QDOT_OK;
}

/* The first stored point after a step that is too long for an oscillation of the given rate. */
static size_t
first_point_after_long_step(const qdot_trajectory *tr, double rate)
{
    size_t k = 1;

    while (k + 1 < tr->count && fabs(tr->t[k] - tr->t[k - 1]) * rate <= period)
        k++;
    return k;
}

static qdot_status
find_lost_amplitude(qdot_oscillations *o)
{
    const qdot_trajectory *tr = &o->course->tr;
    double A, fastest, unused, low, high;
    size_t from, to;

    QDOT_TRY(measure_oscillations(o, 0, &A, &fastest, &o->damping));
    from = fastest > 0 ? first_point_after_long_step(tr, fastest) : SIZE_MAX;
    if (from > soon)
        return QDOT_OK;
    low = high = A;
    to = from + behind < tr->count ? from + behind : tr->count - 1;
    from = from > early + before ? from - before : early + 1;
    for (size_t j = 1; j <= to; j = j == early && from > early ? from : j + 1) {
        QDOT_TRY(measure_oscillations(o, j, &A, &fastest, &unused));
        low = fmin(low, A);
        high = fmax(high, A);
    }
    o->lost = high - low;
    return QDOT_OK;
}

qdot_status
qdot_oscillations_new(const qdot_course *course, qdot_oscillations **out)
{
    const qdot_trajectory *tr = &course->tr;
    const size_t n = tr->n;
    qdot_oscillations *o;
    qdot_status status;

    *out = NULL;
    if (!tr->method || !tr->method->stiff || tr->s || tr->count < 2
        || !qdot_course_systems(course)[0].jacobian)
        return QDOT_OK;
    o = qdot_calloc(1, sizeof *o);
    if (!o)
        return QDOT_ENOMEM;
    o->course = course;
    o->longest = longest_step(tr);
    o->J = qdot_calloc(n * n, sizeof *o->J);
    o->f = qdot_calloc(2 * n, sizeof *o->f);
    o->lambda = qdot_calloc(n, sizeof *o->lambda);
    o->v = qdot_calloc(n * n, sizeof *o->v);
    o->c = qdot_calloc(n, sizeof *o->c);
    status = o->J && o->f && o->lambda && o->v && o->c ? find_lost_amplitude(o) : QDOT_ENOMEM;
    if (status == QDOT_OK && o->lost > 0) {
        *out = o;
        return QDOT_OK;
    }
    qdot_oscillations_free(o);
    return status;
}

/* Add |g(y + `by` times mode v_k) - g(y)|^2 to sums [m]; the reader holds the state y [n]. */
static qdot_status
add_change_by_mode(qdot_oscillations *o, qdot_reader *r, double t, const double *y, size_t k, double by,
                   const double *values, double *g, double *sums)
{
    const size_t n = o->course->tr.n;
    double *in = r->courses[0].in;

    for (int imaginary = 0; imaginary < 2; imaginary++) {
        for (size_t i = 0; i < n; i++)
            in[i] = y[i] + by * (imaginary ? cimag(o->v[k * n + i]) : creal(o->v[k * n + i]));
        QDOT_TRY(qdot_reader_evaluate(r, t, g));
        for (size_t j = 0; j < r->of.m; j++)
            sums[j] += (g[j] - values[j]) * (g[j] - values[j]);
    }
    return QDOT_OK;
}

qdot_status
qdot_oscillations_add(qdot_oscillations *o, qdot_reader *r, double t, const double *values,
                      double *errors)
{
    const qdot_trajectory *tr = &o->course->tr;
    const size_t n = tr->n, m = r->of.m;
    const double a = at_most * o->lost * exp(-o->damping * fabs(t - tr->t[0]));
    const double *scales = qdot_course_systems(o->course)->scales;
    double most = 0; /* largest velocity in a mode that a step's error estimate misses */
    double *y = qdot_malloc((n + 2 * m) * sizeof *y), *g = y + n, *sums = g + m;
    qdot_status status;
    bool there;

    if (!y)
        return QDOT_ENOMEM;
    memcpy(y, r->courses[0].in, n * sizeof *y);
    for (size_t i = n / 2; i < n; i++)
        most = fmax(most, unseen * tr->tol * qdot_ode_size(scales, i, y[i]));
    status = find_linear_modes(o, qdot_trajectory_mode_read(r->courses[0].cursor), t, y, &there);
    for (size_t k = 0; k < n && status == QDOT_OK && there; k++) {
        if (!is_unresolved_mode(o, k, o->longest))
            continue;
        memset(sums, 0, m * sizeof *sums);
        status = add_change_by_mode(o, r, t, y, k, fmin(a / cabs(o->lambda[k]), most), values, g, sums);
        for (size_t j = 0; j < m && status == QDOT_OK; j++)
            errors[j] += sqrt(sums[j]);
    }
    memcpy(r->courses[0].in, y, n * sizeof *y);
    qdot_free(y);
    return status == QDOT_ENOMEM ? status : QDOT_OK;
}
