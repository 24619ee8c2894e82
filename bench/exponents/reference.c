/* reference.c -- the largest Lyapunov exponent of three motions, in two ways that share nothing with qdot.
 *
 *     reference tangent|neighbour SCENE T        prints the exponent over 0..T
 *
 *   tangent    the variational equation, its Jacobian by hand, with Kutta's step of order 4
 *   neighbour  a second motion at a distance of 1e-7, put back to it after each unit of time, both by
 *              Gragg's midpoint rule extrapolated to order 8
 *
 * Source  Benettin, Galgani, Strelcyn, Phys. Rev. A 14 (1976) 2338 (neighbour); Hairer, Nørsett, Wanner,
 *         Solving Ordinary Differential Equations I, II.1, II.9 (both steps). */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST = 4 };

typedef struct {
    const char *name;
    int n;
    double start[MOST], step; /* step: of Kutta; Gragg's is ten times as long */
    void (*rate)(double t, const double *z, double *dz);
    /* dw = (df/dz) w */
    void (*tangent)(double t, const double *z, const double *w, double *dw);
} motion;

/* --- Hénon and Heiles, z = (x, y, x', y') ------------------------------------------------------- */

static void
henon_heiles(double t, const double *z, double *dz)
{
    (void)t;
    dz[0] = z[2];
    dz[1] = z[3];
    dz[2] = -z[0] - 2 * z[0] * z[1];
    dz[3] = -z[1] - z[0] * z[0] + z[1] * z[1];
}

static void
henon_heiles_tangent(double t, const double *z, const double *w, double *dw)
{
    (void)t;
    dw[0] = w[2];
    dw[1] = w[3];
    dw[2] = -w[0] - 2 * (w[0] * z[1] + z[0] * w[1]);
    dw[3] = -w[1] - 2 * z[0] * w[0] + 2 * z[1] * w[1];
}

/* --- two rods of length 1 with bobs of mass 1, z = (a, b, a', b') -------------------------------- */

/* 2 a'' + c b'' = F1, c a'' + b'' = F2 with c = cos(a - b), F1 = -s b'^2 - 2 g sin a, F2 = s a'^2 - g sin b. */
static const double gravity = 9.81;

static void
double_pendulum(double t, const double *z, double *dz)
{
    const double s = sin(z[0] - z[1]), c = cos(z[0] - z[1]), det = 2 - c * c;
    const double f1 = -s * z[3] * z[3] - 2 * gravity * sin(z[0]);
    const double f2 = s * z[2] * z[2] - gravity * sin(z[1]);

    (void)t;
    dz[0] = z[2];
    dz[1] = z[3];
    dz[2] = (f1 - c * f2) / det;
    dz[3] = (2 * f2 - c * f1) / det;
}

static void
double_pendulum_tangent(double t, const double *z, const double *w, double *dw)
{
    const double s = sin(z[0] - z[1]), c = cos(z[0] - z[1]), det = 2 - c * c;
    const double turn = w[0] - w[1], ds = c * turn, dc = -s * turn;
    double dz[MOST], g1, g2;

    double_pendulum(t, z, dz);
    /* the equations differentiated: M dw = dF - dM a */
    g1 = -ds * z[3] * z[3] - 2 * s * z[3] * w[3] - 2 * gravity * cos(z[0]) * w[0] - dc * dz[3];
    g2 = ds * z[2] * z[2] + 2 * s * z[2] * w[2] - gravity * cos(z[1]) * w[1] - dc * dz[2];
    dw[0] = w[2];
    dw[1] = w[3];
    dw[2] = (g1 - c * g2) / det;
    dw[3] = (2 * g2 - c * g1) / det;
}

/* --- a driven pendulum with friction, z = (a, a') ------------------------------------------------ */

static void
driven(double t, const double *z, double *dz)
{
    dz[0] = z[1];
    dz[1] = -sin(z[0]) - z[1] / 2 + 1.15 * cos(2 * t / 3);
}

static void
driven_tangent(double t, const double *z, const double *w, double *dw)
{
    (void)t;
    dw[0] = w[1];
    dw[1] = -cos(z[0]) * w[0] - w[1] / 2;
}

/* --- the tangent ---------------------------------------------------------------------------------- */

static void
rate_of_both(const motion *m, double t, const double *z, double *dz)
{
    m->rate(t, z, dz);
    m->tangent(t, z, z + m->n, dz + m->n);
}

static void
kutta(const motion *m, double t, double h, double *z)
{
    double k[4][2 * MOST], at[2 * MOST];
    const double part[4] = {0, 0.5, 0.5, 1};

    for (int s = 0; s < 4; s++) {
        for (int i = 0; i < 2 * m->n; i++)
            at[i] = z[i] + (s > 0 ? part[s] * h * k[s - 1][i] : 0);
        rate_of_both(m, t + part[s] * h, at, k[s]);
    }
    for (int i = 0; i < 2 * m->n; i++)
        z[i] += h / 6 * (k[0][i] + 2 * k[1][i] + 2 * k[2][i] + k[3][i]);
}

/* Make w 1 long; the logarithm of its length. */
static double
shorten(double *w, int n, double to)
{
    double sum = 0;

    for (int i = 0; i < n; i++)
        sum += w[i] * w[i];
    sum = sqrt(sum);
    for (int i = 0; i < n; i++)
        w[i] *= to / sum;
    return log(sum / to);
}

static double
by_tangent(const motion *m, long units)
{
    const long steps = lround(1 / m->step);
    double z[2 * MOST], sum = 0;

    memcpy(z, m->start, sizeof m->start);
    for (int i = 0; i < m->n; i++)
        z[m->n + i] = i == 0;
    for (long u = 0; u < units; u++) {
        for (long k = 0; k < steps; k++)
            kutta(m, (double)u + (double)k * m->step, m->step, z);
        sum += shorten(z + m->n, m->n, 1);
    }
    return sum / (double)units;
}

/* --- the neighbour ---------------------------------------------------------------------------------- */

/* Midpoint rule with 2, 4, 6, 8 parts, extrapolated in h^2. */
static void
gragg(const motion *m, double t, double h, double *z)
{
    double table[4][MOST];

    for (int row = 0; row < 4; row++) {
        const int parts = 2 * (row + 1);
        const double d = h / parts;
        double before[MOST], now[MOST], dz[MOST];

        memcpy(before, z, sizeof before);
        m->rate(t, z, dz);
        for (int i = 0; i < m->n; i++)
            now[i] = z[i] + d * dz[i];
        for (int k = 1; k < parts; k++) {
            m->rate(t + k * d, now, dz);
            for (int i = 0; i < m->n; i++) {
                const double next = before[i] + 2 * d * dz[i];

                before[i] = now[i];
                now[i] = next;
            }
        }
        memcpy(table[row], now, sizeof now);
    }
    for (int column = 1; column < 4; column++)
        for (int row = 3; row >= column; row--) {
            const double ratio = (row + 1.0) / (row + 1.0 - column);

            for (int i = 0; i < m->n; i++)
                table[row][i] += (table[row][i] - table[row - 1][i]) / (ratio * ratio - 1);
        }
    memcpy(z, table[3], m->n * sizeof *z);
}

static double
by_neighbour(const motion *m, long units)
{
    const double h = 10 * m->step, apart = 1e-7;
    const long steps = lround(1 / h);
    double z[MOST], other[MOST], w[MOST] = {0}, sum = 0;

    memcpy(z, m->start, sizeof z);
    memcpy(other, z, sizeof z);
    other[m->n - 1] += apart;
    for (long u = 0; u < units; u++) {
        for (long k = 0; k < steps; k++) {
            gragg(m, (double)u + (double)k * h, h, z);
            gragg(m, (double)u + (double)k * h, h, other);
        }
        for (int i = 0; i < m->n; i++)
            w[i] = other[i] - z[i];
        sum += shorten(w, m->n, apart);
        for (int i = 0; i < m->n; i++)
            other[i] = z[i] + w[i];
    }
    return sum / (double)units;
}

int
main(int argc, char **argv)
{
    static const motion motions[] = {
        /* x' = sqrt(2 (1/6 - V)) */
        {"henon-heiles", 4, {0, -0.15, 0.5555027752705951, 0}, 0.01, henon_heiles, henon_heiles_tangent},
        {"double", 4, {2, 2, 0, 0}, 0.001, double_pendulum, double_pendulum_tangent},
        {"driven", 2, {0.5, 0}, 0.01, driven, driven_tangent},
    };

    for (size_t k = 0; argc == 4 && k < sizeof motions / sizeof *motions; k++)
        if (strcmp(motions[k].name, argv[2]) == 0) {
            const long units = strtol(argv[3], NULL, 10);

            printf("%.5f\n", argv[1][0] == 't' ? by_tangent(&motions[k], units)
                                               : by_neighbour(&motions[k], units));
            return 0;
        }
    fprintf(stderr, "usage: reference tangent|neighbour henon-heiles|double|driven T\n");
    return 2;
}
