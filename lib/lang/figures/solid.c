/* solid.c -- finds the solid of uniform density that has the mass and the moments of inertia of a body. */
#include "lang/figures/solid.h"

#include <math.h>
#include <string.h>

/* The square root of x, or 0 if x is negative by rounding, or not finite for a body without mass. */
static double
safe_square_root(double x)
{
    return x > 0 && isfinite(x) ? sqrt(x) : 0;
}

void
qdot_solid_plane(double mass, double inertia, const double (*arms)[2], size_t n,
                 qdot_animation_body *b)
{
    const double square = inertia / mass; /* square of the radius of gyration */
    double farthest = 0;

    b->disc = true;
    b->half[0] = safe_square_root(2 * square);
    b->half[1] = b->half[0];
    b->turn[0] = 1;
    b->turn[1] = 0;
    for (size_t i = 0; i < n; i++) {
        double length = hypot(arms[i][0], arms[i][1]);

        if (!(length > farthest))
            continue;
        farthest = length;
        b->turn[0] = arms[i][0] / length;
        b->turn[1] = arms[i][1] / length;
    }
    if (farthest == 0 || fabs(farthest - b->half[0]) <= 1e-6 * farthest)
        return;
    b->disc = false;
    b->half[0] = fmin(farthest, safe_square_root(3 * square));
    b->half[1] = safe_square_root(3 * square - b->half[0] * b->half[0]);
}

/* Apply one Jacobi rotation in the plane of axes i, j that makes a[i][j] 0; v: the principal axes
 * so far, as rows. */
static void
jacobi_rotation(double a[3][3], double v[3][3], int i, int j)
{
    const double angle = 0.5 * atan2(2 * a[i][j], a[i][i] - a[j][j]);
    const double c = cos(angle), s = sin(angle);

    for (int k = 0; k < 3; k++) {
        const double x = a[i][k], y = a[j][k];

        a[i][k] = c * x + s * y;
        a[j][k] = c * y - s * x;
    }
    for (int k = 0; k < 3; k++) {
        const double x = a[k][i], y = a[k][j], p = v[i][k], q = v[j][k];

        a[k][i] = c * x + s * y;
        a[k][j] = c * y - s * x;
        v[i][k] = c * p + s * q;
        v[j][k] = c * q - s * p;
    }
}

void
qdot_solid_space(double mass, const double inertia[9], qdot_animation_body *b)
{
    double a[3][3], v[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, trace;

    memcpy(a, inertia, sizeof a);
    for (int sweep = 0; sweep < 12; sweep++)
        for (int i = 0; i < 3; i++) {
            int j = (i + 1) % 3;

            if (fabs(a[i][j]) > 1e-15 * (fabs(a[i][i]) + fabs(a[j][j])))
                jacobi_rotation(a, v, i, j);
        }
    trace = a[0][0] + a[1][1] + a[2][2];
    for (int k = 0; k < 3; k++) {
        b->half[k] = safe_square_root(2.5 * (trace - 2 * a[k][k]) / mass);
        memcpy(b->principal + 3 * k, v[k], sizeof v[k]);
    }
}
