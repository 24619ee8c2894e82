/* problems.h -- systems with references of more than double precision, for the tests.
 *
 * Each takes the double start state as exact. Pendulum and Henon-Heiles by Taylor series
 * of order 30 in long double, Kepler's ellipse in closed form.
 */
#ifndef QDOT_TESTS_ODE_PROBLEMS_H
#define QDOT_TESTS_ODE_PROBLEMS_H

#include <math.h>
#include <string.h>

#include "base/interrupt.h"
#include "ode/integrate.h"

/* The methods that a right-hand side is enough for. */
#define for_each_method(m)                                                               \
    for (size_t m = 0; m < qdot_ode_method_count(); m++)                                 \
        if (!qdot_ode_method_at(m)->series && !qdot_ode_method_at(m)->geometric)

enum { series = 30 };

static qdot_status
pendulum_rhs(double t, const double *y, double *dydt, void *user)
{
    (void)t;
    (void)user;
    dydt[0] = y[1];
    dydt[1] = -9.81 * sin(y[0]);
    return QDOT_OK;
}

static qdot_status
pendulum_jacobian(double t, const double *y, double *dfdy, double *dfdt, void *user)
{
    (void)t;
    (void)user;
    dfdy[0] = 0;
    dfdy[1] = 1;
    dfdy[2] = -9.81 * cos(y[0]);
    dfdy[3] = dfdt[0] = dfdt[1] = 0;
    return QDOT_OK;
}

static inline void
pendulum_at(const double *y0, double t, long double *y)
{
    int64_t n = (int64_t)ceil(fabs(t) / 0.05);
    long double h = (long double)t / n, a[series + 2], s[series], c[series];

    y[0] = y0[0];
    y[1] = y0[1];
    for (int64_t step = 0; step < n; step++) {
        a[0] = y[0];
        a[1] = y[1];
        s[0] = sinl(a[0]);
        c[0] = cosl(a[0]);
        for (int k = 0; k < series; k++) {
            if (k > 0) {
                s[k] = c[k] = 0;
                for (int j = 1; j <= k; j++) {
                    s[k] += j * a[j] * c[k - j] / k;
                    c[k] -= j * a[j] * s[k - j] / k;
                }
            }
            a[k + 2] = -(long double)9.81 * s[k] / ((k + 1) * (k + 2));
        }
        y[0] = y[1] = 0;
        for (int k = series + 1; k > 0; k--) {
            y[0] = y[0] * h + a[k];
            y[1] = y[1] * h + k * a[k];
        }
        y[0] = y[0] * h + a[0];
    }
}

static qdot_status
henon_rhs(double t, const double *y, double *dydt, void *user)
{
    (void)t;
    (void)user;
    dydt[0] = y[2];
    dydt[1] = y[3];
    dydt[2] = -y[0] - 2 * y[0] * y[1];
    dydt[3] = -y[1] - y[0] * y[0] + y[1] * y[1];
    return QDOT_OK;
}

static qdot_status
henon_jacobian(double t, const double *y, double *dfdy, double *dfdt, void *user)
{
    (void)t;
    (void)user;
    memset(dfdy, 0, 16 * sizeof *dfdy);
    memset(dfdt, 0, 4 * sizeof *dfdt);
    dfdy[2] = dfdy[7] = 1;
    dfdy[8] = -1 - 2 * y[1];
    dfdy[9] = dfdy[12] = -2 * y[0];
    dfdy[13] = -1 + 2 * y[1];
    return QDOT_OK;
}

static inline void
henon_at(const double *y0, double t, long double *y)
{
    int64_t n = (int64_t)ceil(fabs(t) / 0.1);
    long double h = (long double)t / n, a[series + 2], b[series + 2];

    for (int i = 0; i < 4; i++)
        y[i] = y0[i];
    for (int64_t step = 0; step < n; step++) {
        a[0] = y[0];
        b[0] = y[1];
        a[1] = y[2];
        b[1] = y[3];
        for (int k = 0; k < series; k++) {
            long double ab = 0, aa = 0, bb = 0;

            for (int j = 0; j <= k; j++) {
                ab += a[j] * b[k - j];
                aa += a[j] * a[k - j];
                bb += b[j] * b[k - j];
            }
            a[k + 2] = (-a[k] - 2 * ab) / ((k + 1) * (k + 2));
            b[k + 2] = (-b[k] - aa + bb) / ((k + 1) * (k + 2));
        }
        memset(y, 0, 4 * sizeof *y);
        for (int k = series + 1; k > 0; k--) {
            y[0] = y[0] * h + a[k];
            y[1] = y[1] * h + b[k];
            y[2] = y[2] * h + k * a[k];
            y[3] = y[3] * h + k * b[k];
        }
        y[0] = y[0] * h + a[0];
        y[1] = y[1] * h + b[0];
    }
}

/* GM = 1 */
static qdot_status
kepler_rhs(double t, const double *y, double *dydt, void *user)
{
    double r2 = y[0] * y[0] + y[1] * y[1], w = -1 / (r2 * sqrt(r2));

    (void)t;
    (void)user;
    dydt[0] = y[2];
    dydt[1] = y[3];
    dydt[2] = w * y[0];
    dydt[3] = w * y[1];
    return QDOT_OK;
}

static qdot_status
kepler_jacobian(double t, const double *y, double *dfdy, double *dfdt, void *user)
{
    double r2 = y[0] * y[0] + y[1] * y[1], w = -1 / (r2 * sqrt(r2)), v = -3 * w / r2;

    (void)t;
    (void)user;
    memset(dfdy, 0, 16 * sizeof *dfdy);
    memset(dfdt, 0, 4 * sizeof *dfdt);
    dfdy[2] = dfdy[7] = 1;
    dfdy[8] = w + v * y[0] * y[0];
    dfdy[9] = dfdy[12] = v * y[0] * y[1];
    dfdy[13] = w + v * y[1] * y[1];
    return QDOT_OK;
}

/* From pericentre: y0 = (r, 0, 0, v). */
static inline void
kepler_at(const double *y0, double t, long double *y)
{
    long double r = y0[0], v = y0[3], a = 1 / (2 / r - v * v), e = 1 - r / a;
    long double n = 1 / sqrtl(a * a * a), E, q = sqrtl(1 - e * e);
    long double M = remainderl(n * t, 2 * acosl(-1));

    E = M + e * sinl(M) * (e > 0.8L ? 0.85L : 1);
    for (int i = 0; i < 60; i++)
        E -= (E - e * sinl(E) - M) / (1 - e * cosl(E));
    y[0] = a * (cosl(E) - e);
    y[1] = a * q * sinl(E);
    y[2] = -a * n * sinl(E) / (1 - e * cosl(E));
    y[3] = a * n * q * cosl(E) / (1 - e * cosl(E));
}

/* Rows of a table of problems. */
typedef struct {
    const char *name;
    qdot_ode_system system;
    double y0[4];
    void (*at)(const double *y0, double t, long double *y);
} problem;

static const problem pendulum = {
    "pendulum", {.n = 2, .rhs = pendulum_rhs, .jacobian = pendulum_jacobian}, {2, 0}, pendulum_at};
static const problem henon = {"Henon-Heiles",
                              {.n = 4, .rhs = henon_rhs, .jacobian = henon_jacobian},
                              {0, 0, 1.0 / 3, 0.23570226039551584},
                              henon_at};
static const problem kepler = {"Kepler e = 0.5",
                               {.n = 4, .rhs = kepler_rhs, .jacobian = kepler_jacobian},
                               {0.5, 0, 0, 1.7320508075688772},
                               kepler_at};

/* max_i |y_i - ref_i| / max(1, |ref_i|) at t. */
static inline double
true_error(const problem *p, double t, const double *y)
{
    long double ref[4];
    double worst = 0;

    p->at(p->y0, t, ref);
    for (size_t i = 0; i < p->system.n; i++)
        worst = fmax(worst, (double)(fabsl(y[i] - ref[i]) / fmaxl(1, fabsl(ref[i]))));
    return worst;
}

/* y' = y^2 from 1: a pole at t = 1. */
static inline qdot_status
square(double t, const double *y, double *dydt, void *user)
{
    (void)t;
    (void)user;
    dydt[0] = y[0] * y[0];
    return QDOT_OK;
}

/* y' = -1e6 (y - cos t) - sin t: y = cos t, reached from anywhere within microseconds. */
static inline qdot_status
stiff(double t, const double *y, double *dydt, void *user)
{
    (void)user;
    dydt[0] = -1e6 * (y[0] - cos(t)) - sin(t);
    return QDOT_OK;
}

static inline qdot_status
stiff_jacobian(double t, const double *y, double *dfdy, double *dfdt, void *user)
{
    (void)y;
    (void)user;
    dfdy[0] = -1e6;
    dfdt[0] = -1e6 * sin(t) - cos(t);
    return QDOT_OK;
}

/* --- runs of them -------------------------------------------------------------------- */

static inline const qdot_ode_method *
method(const char *name)
{
    return qdot_ode_method_find(name);
}

static inline qdot_status
interrupt_beyond_two(double t, const double *y, bool *stop, void *user)
{
    (void)y;
    (void)stop;
    (void)user;
    if (t > 2)
        qdot_interrupt_set();
    return QDOT_OK;
}

#endif
