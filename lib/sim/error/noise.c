/* noise.c -- estimates rounding errors of expressions from third differences along a short line of states. */
#include "sim/error/noise.h"

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

#include "base/interrupt.h"

/* Rounding errors rarely exceed this multiple of the estimated noise. */
static const double levels = 4;

enum { POINTS = 7, ORDER = 3 };
static const double spacing = 0x1p-38;

/* (ORDER!)^2 / (2 ORDER)!: converts the variance of a difference of that order into that of a single value. */
static const double factor = 1.0 / 20;

/* A pseudo-random sign, +1 or -1, for component i. */
static double
pseudo_random_sign(size_t i)
{
    return (uint32_t)(i + 1) * UINT32_C(2654435769) >> 31 ? 1 : -1;
}

static double
noise_level(const double *g, size_t m)
{
    double d[POINTS], sum = 0;

    for (int s = 0; s < POINTS; s++)
        d[s] = g[(size_t)s * m];
    for (int order = 0; order < ORDER; order++)
        for (int s = 0; s + 1 + order < POINTS; s++)
            d[s] = d[s + 1] - d[s];
    for (int s = 0; s + ORDER < POINTS; s++)
        sum += d[s] * d[s];
    return sqrt(factor * sum / (POINTS - ORDER));
}

/* Shift each state from the inputs y to point s of a short line of states. */
static void
shift_states(qdot_reader *r, const double *y, int s)
{
    size_t count = 0;

    for (size_t k = 0; k < r->n_courses; k++) {
        double *in = r->courses[k].in;
        const double *from = y + (in - r->in);

        for (size_t i = 0; i < 2 * r->courses[k].n; i++, count++)
            in[i] = from[i] + s * spacing * pseudo_random_sign(count) * from[i];
    }
}

/* Estimate the noise [m] of expressions, and their slopes dg/dh [m] along the line (NULL: not wanted). */
static qdot_status
estimate_along_line(qdot_reader *r, const size_t *pieces, double t, double *noise, double *slopes)
{
    const size_t n = qdot_tape_inputs(r->of.tape), m = r->of.m;
    double *y = qdot_malloc((n + POINTS * m + 1) * sizeof *y), *g = y + n;
    qdot_status status = y ? qdot_reader_read(r, pieces, t, g) : QDOT_ENOMEM;

    if (status == QDOT_OK)
        memcpy(y, r->in, n * sizeof *y);
    for (int s = 1; s < POINTS && status == QDOT_OK; s++) {
        shift_states(r, y, s);
        status = qdot_reader_evaluate(r, t, g + (size_t)s * m);
    }
    for (size_t j = 0; j < m && status == QDOT_OK; j++) {
        noise[j] = noise_level(g + j, m);
        if (slopes)
            slopes[j] = (g[(POINTS - 1) * m + j] - g[j]) / ((POINTS - 1) * spacing);
    }
    qdot_free(y);
    return status;
}

qdot_status
qdot_noise_at(qdot_reader *r, const size_t *pieces, double t, double *noise)
{
    return estimate_along_line(r, pieces, t, noise, NULL);
}

/* Estimate rounding errors [m] of expressions at time t; noise [2 m] is work space. */
static qdot_status
estimate_rounding_errors(qdot_reader *r, double t, double *noise, double *roundings)
{
    double *slopes = noise + r->of.m;
    qdot_status status;

    QDOT_TRY(qdot_reader_read(r, NULL, t, roundings));
    QDOT_TRY(qdot_reader_roundings(r, t, roundings));
    status = estimate_along_line(r, NULL, t, noise, slopes);
    for (size_t j = 0; j < r->of.m && status == QDOT_OK; j++)
        if (isfinite(noise[j]))
            roundings[j] = fmax(roundings[j], fmax(levels * noise[j],
                                                   DBL_EPSILON / 2 * fabs(slopes[j])));
    return qdot_grave(status);
}

qdot_status
qdot_noise_roundings(const qdot_reading *of, const qdot_course *const *courses, size_t k,
                     const double *times, double *roundings)
{
    size_t m = of->m;
    double *noise = qdot_malloc((2 * m + 1) * sizeof *noise);
    qdot_reader r = {0};
    qdot_status status = noise ? QDOT_OK : QDOT_ENOMEM;

    if (status == QDOT_OK)
        status = qdot_reader_init_along(&r, of, courses);
    for (size_t i = 0; i < k && status == QDOT_OK; i++)
        status = estimate_rounding_errors(&r, times[i], noise, roundings + i * m);
    qdot_reader_clear(&r);
    qdot_free(noise);
    return status;
}
