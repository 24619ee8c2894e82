/* frequency.h -- a quotient of polynomials on the imaginary axis, by its zeros and poles:
 *
 *     G(i w) = k prod (i w - z_j) / prod (i w - p_j),    magnitude 20 log10 |G| in decibels, phase in degrees.
 *
 * The phase is the sum of the arguments of the factors, each continuous in w > 0: of a real root r that of -r + i w, of a pair
 * r +- i v that of (r^2 + v^2 - w^2) - 2 i r w, which begins at 0; that of k is 0 or 180. So it does not wrap. It jumps where
 * a root is on the axis.
 *
 * Source  Ogata, Modern Control Engineering, 5th ed., 7-2.
 * Tests   tests/num/test_frequency.c
 */
#ifndef QDOT_NUM_FREQUENCY_H
#define QDOT_NUM_FREQUENCY_H

#include <stddef.h>

/* Roots of a real polynomial: real ones, and pairs that stand together. re, im [n] borrowed. */
typedef struct {
    size_t n;
    const double *re, *im;
} qdot_frequency_roots;

typedef struct {
    double gain; /* k */
    qdot_frequency_roots zero, pole;
} qdot_frequency;

/* w > 0. At a zero on the axis -INFINITY, at a pole INFINITY. */
double qdot_frequency_decibels(const qdot_frequency *G, double w);
double qdot_frequency_degrees(const qdot_frequency *G, double w);

#endif
