/* polynomial-bounds.c -- bounds expressions on a time interval by discs in the complex plane. */
#include "sim/bind/polynomial-bounds.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "num/past.h"
#include "tape/disc.h"

enum { MOST = QDOT_CHEBYSHEV_MOST, ELLIPSES = 3 };

/* The ellipses that are tried, by the number of Chebyshev nodes; a large ellipse gives a small
 * error if it holds no singularity. */
static const struct {
    int nodes;
    double rho[ELLIPSES];
} ellipses[] = {{16, {14, 10, 7}}, {32, {4, 3.2, 2.6}}, {64, {2.2, 1.9, 1.7}}};

/* In a part this small of a step a singularity of the formula is ignored if the values show none.
 *  */
static const double hollow = 0x1p-36;

void
qdot_polynomial_bounds_clear(qdot_polynomial_bounds *h)
{
    qdot_free(h->used);
    qdot_free(h->values);
    qdot_free(h->span);
    *h = (qdot_polynomial_bounds){0};
}

static qdot_status
find_inputs_read(qdot_polynomial_bounds *h, size_t inputs)
{
    bool *reads = qdot_calloc(inputs + 1, sizeof *reads);
    qdot_status status = reads ? qdot_disc_reads(h->tape, reads) : QDOT_ENOMEM;

    h->used = qdot_malloc((inputs + 1) * sizeof *h->used);
    if (!h->used)
        status = QDOT_ENOMEM;
    h->reads_time = reads && reads[h->time];
    for (size_t i = 0; i < inputs && status == QDOT_OK; i++)
        if (reads[i] && i != h->time)
            h->used[h->n_used++] = i;
    qdot_free(reads);
    return status;
}

qdot_status
qdot_polynomial_bounds_init(qdot_polynomial_bounds *h, const qdot_tape *tape, size_t time)
{
    const size_t inputs = qdot_tape_inputs(tape), m = qdot_tape_outputs(tape);

    *h = (qdot_polynomial_bounds){.tape = tape, .time = time};
    QDOT_TRY(find_inputs_read(h, inputs));
    h->values = qdot_calloc((2 * MOST + 1) * h->n_used + 2 * inputs + 3 * m
                                + qdot_disc_work(tape) + 1,
                            sizeof *h->values);
    h->span = qdot_calloc(inputs + m + qdot_interval_work(tape) + 1, sizeof *h->span);
    if (!h->values || !h->span)
        return QDOT_ENOMEM;
    h->box = h->span + inputs;
    h->span_work = h->box + m;
    h->fits = h->values + h->n_used * MOST;
    h->scale = h->fits + h->n_used * MOST;
    h->centre = h->scale + h->n_used;
    h->radius = h->centre + inputs;
    h->out = h->radius + inputs;
    h->out_radius = h->out + m;
    h->miss = h->out_radius + m;
    h->work = h->miss + m;
    return QDOT_OK;
}

void
qdot_polynomial_bounds_begin(qdot_polynomial_bounds *h, const double *least)
{
    for (size_t k = 0; k < h->n_used; k++)
        h->scale[k] = least ? least[h->used[k]] : 0;
}

void
qdot_polynomial_bounds_sample(qdot_polynomial_bounds *h, int j, const double *in)
{
    for (size_t k = 0; k < h->n_used; k++) {
        h->values[k * MOST + (size_t)j] = in[h->used[k]];
        h->scale[k] = fmax(h->scale[k], fabs(in[h->used[k]]));
    }
}

/* The rounding error of the Chebyshev coefficients of input k on the interval [a, b]. */
static double
chebyshev_rounding_error(const qdot_polynomial_bounds *h, size_t k, double a, double b)
{
    const double blur = DBL_EPSILON * fmax(fabs(a), fabs(b)) / fabs(b - a);
    const double *c = h->fits + k * MOST;

    return 4 * (DBL_EPSILON * h->scale[k] + blur * fabs(c[1]));
}

static void
evaluate_on_discs(qdot_polynomial_bounds *h)
{
    qdot_disc_eval(h->tape, h->centre, h->radius, h->out, h->out_radius, h->work);
}

void
qdot_polynomial_bounds_span(qdot_polynomial_bounds *h, double a, double b)
{
    h->centre[h->time] = 0.5 * (a + b);
    h->radius[h->time] = 0.5 * fabs(b - a);
    evaluate_on_discs(h);
}

void
qdot_polynomial_bounds_series(qdot_polynomial_bounds *h, const qdot_ode_series *series,
                              const qdot_ode_expanded *step)
{
    const double s = (step->t_end - step->t) / step->unit;

    for (size_t k = 0; k < h->n_used; k++) {
        const double *x = series->x + h->used[k] * series->stride;
        double power = 1, centre = x[0], radius = 0;

        for (int j = 1; j <= step->order; j++) {
            power *= s;
            centre += 0.5 * x[j] * power;
            radius += 0.5 * fabs(x[j] * power);
        }
        h->centre[h->used[k]] = centre;
        h->radius[h->used[k]] = radius + 4 * DBL_EPSILON * fabs(centre);
    }
    qdot_polynomial_bounds_span(h, step->t, step->t_end);
}

void
qdot_polynomial_bounds_box(qdot_polynomial_bounds *h)
{
    for (size_t k = 0; k <= h->n_used; k++) {
        const size_t i = k < h->n_used ? h->used[k] : h->time;

        h->span[i] = (qdot_interval){h->centre[i] - h->radius[i], h->centre[i] + h->radius[i]};
    }
    qdot_interval_eval(h->tape, h->span, h->box, h->span_work);
}

/* Evaluate the outputs on the ellipse of parameter rho about the interval a ... b; false if an
 * input is not known there. */
static bool
bound_on_ellipse(qdot_polynomial_bounds *h, double a, double b, int nodes, double rho)
{
    bool known = true;

    h->resting = !h->reads_time;
    for (size_t k = 0; k < h->n_used; k++) {
        const double *c = h->fits + k * MOST;

        h->centre[h->used[k]] = c[0];
        h->radius[h->used[k]] =
            qdot_chebyshev_ellipse(nodes, c, chebyshev_rounding_error(h, k, a, b), rho);
        known = known && isfinite(h->radius[h->used[k]]);
        h->resting = h->resting && h->radius[h->used[k]] == 0;
    }
    h->centre[h->time] = 0.5 * (a + b);
    h->radius[h->time] = 0.25 * fabs(b - a) * (rho + 1 / rho);
    qdot_past_ask_within(0.5 * fabs(b - a));
    if (known)
        evaluate_on_discs(h);
    qdot_past_ask_within(INFINITY);
    return known;
}

static void
fit_inputs(qdot_polynomial_bounds *h, int nodes)
{
    for (size_t k = 0; k < h->n_used; k++)
        qdot_chebyshev_fit(nodes, h->values + k * MOST, h->fits + k * MOST);
}

void
qdot_polynomial_bounds_look(qdot_polynomial_bounds *h, double a, double b, int nodes,
                            const bool *quotients, const double *base)
{
    const size_t m = qdot_tape_outputs(h->tape);
    size_t row = 0;

    while (ellipses[row].nodes < nodes)
        row++;
    fit_inputs(h, nodes);
    for (size_t i = 0; i < m; i++)
        h->miss[i] = NAN;
    for (int e = 0; e < ELLIPSES; e++) {
        const double rho = ellipses[row].rho[e];

        if (!bound_on_ellipse(h, a, b, nodes, rho)) {
            for (size_t i = 0; i < m; i++)
                h->miss[i] = fmin(h->miss[i], INFINITY);
            continue;
        }
        for (size_t i = 0; i < m; i++) {
            double most = h->out_radius[i];

            /* for t on the Bernstein ellipse of the time interval, |t - a| is smallest at an end of the major axis */
            if (quotients && quotients[i])
                most = 2 * (most + fabs(h->out[i] - base[i])) / (0.5 * (rho + 1 / rho) - 1);
            h->miss[i] = fmin(h->miss[i], 4 * most * pow(rho, 1 - nodes) / (rho - 1));
        }
    }
}

bool
qdot_polynomial_bounds_within(qdot_polynomial_bounds *h, double a, double b, int nodes)
{
    return bound_on_ellipse(h, a, b, nodes, 1);
}

void
qdot_polynomial_bounds_enclose(qdot_polynomial_bounds *h, double a, double b, int nodes)
{
    fit_inputs(h, nodes);
    for (size_t k = 0; k < h->n_used; k++) {
        const double *c = h->fits + k * MOST;
        const double r = qdot_chebyshev_ellipse(nodes, c, chebyshev_rounding_error(h, k, a, b), 1);

        h->span[h->used[k]] = (qdot_interval){nextafter(c[0] - r, -INFINITY),
                                              nextafter(c[0] + r, INFINITY)};
    }
    h->span[h->time] = (qdot_interval){fmin(a, b), fmax(a, b)};
    qdot_interval_eval(h->tape, h->span, h->box, h->span_work);
}

bool
qdot_polynomial_bounds_is_hollow(const qdot_polynomial_bounds *h, size_t i, double part)
{
    return isnan(h->miss[i]) && (part <= hollow || h->resting);
}

double
qdot_polynomial_bounds_rounding(qdot_polynomial_bounds *h, double a, double b)
{
    for (size_t k = 0; k < h->n_used; k++) {
        h->centre[h->used[k]] = h->fits[k * MOST];
        h->radius[h->used[k]] = DBL_EPSILON * h->scale[k];
    }
    h->centre[h->time] = 0.5 * (a + b);
    h->radius[h->time] = DBL_EPSILON * fabs(h->centre[h->time]);
    evaluate_on_discs(h);
    return isfinite(h->out_radius[0]) ? h->out_radius[0] : 0;
}
