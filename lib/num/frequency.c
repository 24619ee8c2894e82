/* frequency.c -- magnitude and phase of a quotient of polynomials on the imaginary axis. */
#include "num/frequency.h"

#include <math.h>

static double
roots_decibels(const qdot_frequency_roots *r, double w)
{
    double sum = 0;

    for (size_t k = 0; k < r->n; k++)
        sum += 20 * log10(hypot(r->re[k], w - r->im[k]));
    return sum;
}

/* The argument of the factors of a pair; on the axis it is that of a root a little to the left. */
static double
pair_argument(double re, double im, double w)
{
    const double real = re * re + (im - w) * (im + w);

    if (re == 0)
        return real >= 0 ? 0 : M_PI;
    return atan2(-2 * re * w, real);
}

static double
roots_argument(const qdot_frequency_roots *r, double w)
{
    double sum = 0;

    for (size_t k = 0; k < r->n; k++)
        if (r->im[k] == 0)
            sum += atan2(w, -r->re[k]);
        else if (r->im[k] > 0)
            sum += pair_argument(r->re[k], r->im[k], w);
    return sum;
}

double
qdot_frequency_decibels(const qdot_frequency *G, double w)
{
    return 20 * log10(fabs(G->gain)) + roots_decibels(&G->zero, w) - roots_decibels(&G->pole, w);
}

double
qdot_frequency_degrees(const qdot_frequency *G, double w)
{
    const double turn = roots_argument(&G->zero, w) - roots_argument(&G->pole, w);

    return (turn + (G->gain < 0 ? M_PI : 0)) * (180 / M_PI);
}
