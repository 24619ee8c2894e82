/* between.c -- the state inside a step, by a polynomial through values and derivatives at three times. */
#include "ode/between.h"

#include <math.h>

#include "base/memory.h"
#include "ode/scale.h"

/* The polynomial of degree 5 errs by a small part of what that of degree 4 does, which is so many
 * tolerances at most. */
static const double most = 4;

/* The largest |x^2 (1 - x)^2 (x - 1/2)| in 0 ... 1, divided by the derivative of this in the middle, 1/16. */
static const double largest = 0.1432;

static void
evaluate_polynomial(size_t n, const double *P, const double *y0, double x, double *y)
{
    for (size_t i = 0; i < n; i++) {
        double sum = 0;

        for (size_t j = QDOT_BETWEEN_DEGREE; j-- > 0;)
            sum = x * (P[j * n + i] + sum);
        y[i] = y0[i] + sum;
    }
}

static qdot_status
find_polynomial(qdot_ode_stepper *s, double t0, double h, const double *y1, double *P, bool *good)
{
    const size_t n = s->system->n;
    double *room = P + QDOT_BETWEEN_DEGREE * n;
    double ratio;
    qdot_status status = qdot_ode_stepper_try(s, t0, 0.5 * h, &ratio);

    *good = status == QDOT_OK && ratio <= 1;
    if (*good) {
        status = qdot_ode_stepper_rhs(s, t0 + h, y1, room);
        *good = status == QDOT_OK;
    }
    for (size_t i = 0; i < n && *good; i++) {
        const double D = y1[i] - s->y[i], E = s->trial[i] - s->y[i];
        const double a = h * s->dydt[i], b = h * room[i], middle = h * s->trial_dydt[i];
        const double q = 16 * (E - 0.5 * D - 0.125 * (a - b)); /* the polynomial's coefficient of x^2 (1 - x)^2 */
        const double r = 16 * (middle - 1.5 * D + 0.25 * (a + b)); /* the polynomial's coefficient of x^2 (1 - x)^2 (x - 1/2) */
        const double size = qdot_ode_size(s->system->scales, i, s->y[i]);

        P[i] = a;
        P[n + i] = 3 * D - 2 * a - b + q - 0.5 * r;
        P[2 * n + i] = a + b - 2 * D - 2 * q + 2 * r;
        P[3 * n + i] = q - 2.5 * r;
        P[4 * n + i] = r;
        *good = largest / 16 * fabs(r) <= most * s->tol * size;
    }
    return qdot_grave(status);
}

qdot_status
qdot_between_read(qdot_between *b, qdot_ode_stepper *s, double t0, double h, const double *y1,
                  double x, double *y, bool *done)
{
    const size_t n = s->system->n;

    if (!b->P)
        b->P = qdot_malloc((QDOT_BETWEEN_DEGREE + 1) * n * sizeof *b->P);
    if (!b->P)
        return QDOT_ENOMEM;
    if (!b->known)
        QDOT_TRY(find_polynomial(s, t0, h, y1, b->P, &b->good));
    b->known = true;
    *done = b->good;
    if (b->good)
        evaluate_polynomial(n, b->P, s->y, x, y);
    return QDOT_OK;
}
