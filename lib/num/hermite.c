/* hermite.c -- the polynomial of degree five through two points of a motion. */
#include "num/hermite.h"

#include <stddef.h>

double
qdot_hermite_at(const qdot_hermite_end *from, const qdot_hermite_end *to, double h, double s,
                double *v)
{
    const double v0 = h * from->v, a0 = h * h * from->a;
    const double d = to->y - from->y - v0 - 0.5 * a0; /* what the powers s^3 to s^5 must add at the end */
    const double e = h * to->v - v0 - a0, f = h * h * to->a - a0;
    const double c3 = 10 * d - 4 * e + 0.5 * f, c4 = -15 * d + 7 * e - f;
    const double c5 = 6 * d - 3 * e + 0.5 * f;

    if (v)
        *v = (v0 + s * (a0 + s * (3 * c3 + s * (4 * c4 + s * 5 * c5)))) / h;
    return from->y + s * (v0 + s * (0.5 * a0 + s * (c3 + s * (c4 + s * c5))));
}

void
qdot_hermite_cubic_ends(qdot_hermite_end *from, qdot_hermite_end *to, double h)
{
    const double slope = (to->y - from->y) / h;

    from->a = (6 * slope - 4 * from->v - 2 * to->v) / h;
    to->a = (2 * from->v + 4 * to->v - 6 * slope) / h;
}
