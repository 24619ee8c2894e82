/* constrained -- a scene with constraints by SUNDIALS' IDA, over a ladder of tolerances.
 *
 *   constrained SCENE FROM TO STEPS BESIDE FORM
 *
 * FROM, TO: exponents of the first and last tolerance, STEPS a decade; relative ones; absolute ones
 * are BESIDE times as large.
 * FORM: 1: y = (q, v, lambda), q' = v, M v' = f - G^T lambda, G v' = -G_q(v, v) (index 1);
 * 2: y = (q, v, lambda, mu), q' = v - G^T mu, M v' = f - G^T lambda, g = 0, G v = 0 (Gear, Gupta and
 * Leimkuhler's index 2), the error of lambda and mu not tested. Jacobians by IDA's differences.
 * A line a tolerance: `tol seconds q...`, or `tol failed`; the least of several runs' times.
 *
 * Source  squeezer, car axis: Test Set for IVP Solvers (Mazzia & Magherini 2008), II.8 and II.7.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <ida/ida.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

enum { MOST = 26 };

/* M, f, g and G at (t, q, v); bend = d(G v + g_t)/dt - G v'. G_t v is part of both. */
typedef struct {
    double M[7][7], f[7], g[6], G[6][7], rate[6], bend[6];
} parts;

typedef struct {
    const char *name;
    int n, m;
    double end;
    void (*start)(double *q, double *v);
    void (*at)(double t, const double *q, const double *v, parts *p);
} scene;

/* --- Andrews' squeezer ------------------------------------------------------------------- */

static void
squeezer_start(double *q, double *v)
{
    static const double at[] = {-0.0617138900142764496358948458001, 0,
                                0.455279819163070380255912382449, 0.222668390165885884674473185609,
                                0.487364979543842550225598953530,
                                -0.222668390165885884674473185609,
                                1.23054744454982119249735015568};

    memcpy(q, at, sizeof at);
    memset(v, 0, sizeof at);
}

/* g_k += c cos(a) or c sin(a), a = q_i + q_j (j < 0: q_i), with slopes and second rates. */
static void
add(parts *p, int k, double c, int sine, int i, int j, const double *q, const double *v)
{
    const double a = q[i] + (j < 0 ? 0 : q[j]), w = v[i] + (j < 0 ? 0 : v[j]);
    const double slope = sine ? c * cos(a) : -c * sin(a), value = sine ? c * sin(a) : c * cos(a);

    p->g[k] += value;
    p->G[k][i] += slope;
    if (j >= 0)
        p->G[k][j] += slope;
    p->bend[k] -= value * w * w;
}

static void
squeezer_at(double t, const double *q, const double *v, parts *p)
{
    const double m1 = .04325, m2 = .00365, m3 = .02373, m4 = .00706, m5 = .07050, m6 = .00706,
                 m7 = .05498, i1 = 2.194e-6, i2 = 4.410e-7, i3 = 5.255e-6, i4 = 5.667e-7,
                 i5 = 1.169e-5, i6 = 5.667e-7, i7 = 1.912e-5;
    const double xa = -.06934, ya = -.00227, xb = -.03635, yb = .03273, xc = .014, yc = .072,
                 c0 = 4530, l0 = .07785, d = .028, da = .0115, e = .02, ea = .01421, rr = .007,
                 ra = .00092, ss = .035, sa = .01874, sb = .01043, sc = .018, sd = .02,
                 ta = .02308, tb = .00916, u = .04, ua = .01228, ub = .00449, zf = .02, zt = .04,
                 fa = .01421, mom = .033;
    const double sTh = sin(q[1]), cTh = cos(q[1]), sGa = sin(q[2]), cGa = cos(q[2]),
                 sPh = sin(q[3]), cPh = cos(q[3]), sOm = sin(q[5]), cOm = cos(q[5]);
    const double xd = sd * cGa + sc * sGa + xb, yd = sd * sGa - sc * cGa + yb;
    const double length = hypot(xd - xc, yd - yc), force = -c0 * (length - l0) / length;
    const double fx = force * (xd - xc), fy = force * (yd - yc);

    (void)t;
    memset(p, 0, sizeof *p);
    p->M[0][0] = m1 * ra * ra + m2 * (rr * rr - 2 * da * rr * cTh + da * da) + i1 + i2;
    p->M[0][1] = p->M[1][0] = m2 * (da * da - da * rr * cTh) + i2;
    p->M[1][1] = m2 * da * da + i2;
    p->M[2][2] = m3 * (sa * sa + sb * sb) + i3;
    p->M[3][3] = m4 * (e - ea) * (e - ea) + i4;
    p->M[3][4] = p->M[4][3] = m4 * ((e - ea) * (e - ea) + zt * (e - ea) * sPh) + i4;
    p->M[4][4] = m4 * (zt * zt + 2 * zt * (e - ea) * sPh + (e - ea) * (e - ea)) +
                 m5 * (ta * ta + tb * tb) + i4 + i5;
    p->M[5][5] = m6 * (zf - fa) * (zf - fa) + i6;
    p->M[5][6] = p->M[6][5] = m6 * ((zf - fa) * (zf - fa) - u * (zf - fa) * sOm) + i6;
    p->M[6][6] = m6 * ((zf - fa) * (zf - fa) - 2 * u * (zf - fa) * sOm + u * u) +
                 m7 * (ua * ua + ub * ub) + i6 + i7;
    p->f[0] = mom - m2 * da * rr * v[1] * (v[1] + 2 * v[0]) * sTh;
    p->f[1] = m2 * da * rr * v[0] * v[0] * sTh;
    p->f[2] = fx * (sc * cGa - sd * sGa) + fy * (sd * cGa + sc * sGa);
    p->f[3] = m4 * zt * (e - ea) * v[4] * v[4] * cPh;
    p->f[4] = -m4 * zt * (e - ea) * v[3] * (v[3] + 2 * v[4]) * cPh;
    p->f[5] = -m6 * u * (zf - fa) * v[6] * v[6] * cOm;
    p->f[6] = m6 * u * (zf - fa) * v[5] * (v[5] + 2 * v[6]) * cOm;
    for (int k = 0; k < 6; k++) {
        add(p, k, rr, k % 2, 0, -1, q, v);
        add(p, k, -d, k % 2, 0, 1, q, v);
        p->g[k] -= k % 2 ? (k == 1 ? yb : ya) : k == 0 ? xb : xa;
    }
    add(p, 0, -ss, 1, 2, -1, q, v);
    add(p, 1, ss, 0, 2, -1, q, v);
    add(p, 2, -e, 1, 3, 4, q, v);
    add(p, 2, -zt, 0, 4, -1, q, v);
    add(p, 3, e, 0, 3, 4, q, v);
    add(p, 3, -zt, 1, 4, -1, q, v);
    add(p, 4, -zf, 0, 5, 6, q, v);
    add(p, 4, -u, 1, 6, -1, q, v);
    add(p, 5, -zf, 1, 5, 6, q, v);
    add(p, 5, u, 0, 6, -1, q, v);
    for (int k = 0; k < 6; k++)
        for (int i = 0; i < 7; i++)
            p->rate[k] += p->G[k][i] * v[i];
}

/* --- the car axis ------------------------------------------------------------------------ */

static void
axis_start(double *q, double *v)
{
    q[0] = 0, q[1] = .5, q[2] = 1, q[3] = .5;
    v[0] = -.5, v[1] = 0, v[2] = -.5, v[3] = 0;
}

static void
axis_at(double t, const double *q, const double *v, parts *p)
{
    const double eps = 1e-2, M = 10, l0 = .5, l = 1, r = .1, w = 10, half = eps * eps * M / 2;
    const double yb = r * sin(w * t), yb1 = r * w * cos(w * t), yb2 = -w * w * yb;
    const double xb = sqrt(l * l - yb * yb), xb1 = -yb * yb1 / xb,
                 xb2 = -(yb1 * yb1 + yb * yb2 + xb1 * xb1) / xb;
    const double left = hypot(q[0], q[1]), right = hypot(q[2] - xb, q[3] - yb);
    const double dx = q[0] - q[2], dy = q[1] - q[3], ux = v[0] - v[2], uy = v[1] - v[3];

    memset(p, 0, sizeof *p);
    for (int i = 0; i < 4; i++)
        p->M[i][i] = half;
    p->f[0] = (l0 - left) * q[0] / left;
    p->f[1] = (l0 - left) * q[1] / left - half;
    p->f[2] = (l0 - right) * (q[2] - xb) / right;
    p->f[3] = (l0 - right) * (q[3] - yb) / right - half;
    p->g[0] = q[0] * xb + q[1] * yb;
    p->g[1] = dx * dx + dy * dy - l * l;
    p->G[0][0] = xb, p->G[0][1] = yb;
    p->G[1][0] = 2 * dx, p->G[1][1] = 2 * dy, p->G[1][2] = -2 * dx, p->G[1][3] = -2 * dy;
    p->rate[0] = v[0] * xb + v[1] * yb + q[0] * xb1 + q[1] * yb1;
    p->rate[1] = 2 * (dx * ux + dy * uy);
    p->bend[0] = 2 * (v[0] * xb1 + v[1] * yb1) + q[0] * xb2 + q[1] * yb2;
    p->bend[1] = 2 * (ux * ux + uy * uy);
}

static const scene scenes[] = {{"squeezer", 7, 6, 0.03, squeezer_start, squeezer_at},
                               {"car-axis", 4, 2, 3, axis_start, axis_at}};

/* --- IDA --------------------------------------------------------------------------------- */

typedef struct {
    const scene *s;
    int form;
} problem;

static int
residual(realtype t, N_Vector Y, N_Vector D, N_Vector R, void *user)
{
    const problem *x = user;
    const scene *s = x->s;
    const int n = s->n, m = s->m;
    const double *y = N_VGetArrayPointer(Y), *d = N_VGetArrayPointer(D);
    const double *lambda = y + 2 * n, *mu = lambda + m;
    double *r = N_VGetArrayPointer(R);
    parts p;

    s->at(t, y, y + n, &p);
    for (int i = 0; i < n; i++) {
        r[i] = d[i] - y[n + i];
        r[n + i] = -p.f[i];
        for (int j = 0; j < n; j++)
            r[n + i] += p.M[i][j] * d[n + j];
        for (int k = 0; k < m; k++) {
            r[n + i] += p.G[k][i] * lambda[k];
            if (x->form == 2)
                r[i] += p.G[k][i] * mu[k];
        }
    }
    for (int k = 0; k < m; k++) {
        r[2 * n + k] = x->form == 2 ? p.g[k] : p.bend[k];
        for (int i = 0; i < n && x->form == 1; i++)
            r[2 * n + k] += p.G[k][i] * d[n + i];
        if (x->form == 2)
            r[2 * n + m + k] = p.rate[k];
    }
    return 0;
}

/* v' and lambda at the start, by elimination. */
static void
solve_start(const scene *s, const double *y, double *a, double *lambda)
{
    const int n = s->n, m = s->m, size = n + m;
    double K[13][14] = {{0}};
    parts p;

    s->at(0, y, y + n, &p);
    for (int i = 0; i < n; i++) {
        for (int j = 0; j < n; j++)
            K[i][j] = p.M[i][j];
        for (int k = 0; k < m; k++)
            K[i][n + k] = K[n + k][i] = p.G[k][i];
        K[i][size] = p.f[i];
    }
    for (int k = 0; k < m; k++)
        K[n + k][size] = -p.bend[k];
    for (int c = 0; c < size; c++) {
        int best = c;

        for (int i = c; i < size; i++)
            best = fabs(K[i][c]) > fabs(K[best][c]) ? i : best;
        for (int j = 0; j <= size; j++) {
            const double kept = K[c][j];

            K[c][j] = K[best][j];
            K[best][j] = kept;
        }
        for (int i = 0; i < size; i++)
            for (int j = size; j >= c && i != c; j--)
                K[i][j] -= K[i][c] / K[c][c] * K[c][j];
    }
    for (int i = 0; i < n; i++)
        a[i] = K[i][size] / K[i][i];
    for (int k = 0; k < m; k++)
        lambda[k] = K[n + k][size] / K[n + k][n + k];
}

static double
now(void)
{
    struct timespec at;

    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &at);
    return (double)at.tv_sec + 1e-9 * (double)at.tv_nsec;
}

/* Seconds; below 0: failed. */
static double
run(problem *x, double tol, double beside, double *q)
{
    const scene *s = x->s;
    const int n = s->n, m = s->m, size = 2 * n + m * x->form;
    SUNContext context;
    N_Vector y, d, id;
    SUNMatrix J;
    SUNLinearSolver solver;
    void *ida;
    realtype t;
    double begun, took = -1;

    SUNContext_Create(NULL, &context);
    y = N_VNew_Serial(size, context);
    d = N_VClone(y);
    id = N_VClone(y);
    N_VConst(0, y);
    N_VConst(0, d);
    N_VConst(0, id);
    s->start(N_VGetArrayPointer(y), N_VGetArrayPointer(y) + n);
    memcpy(N_VGetArrayPointer(d), N_VGetArrayPointer(y) + n, (size_t)n * sizeof(double));
    solve_start(s, N_VGetArrayPointer(y), N_VGetArrayPointer(d) + n,
                N_VGetArrayPointer(y) + 2 * n);
    for (int i = 0; i < 2 * n; i++)
        N_VGetArrayPointer(id)[i] = 1;
    begun = now();
    ida = IDACreate(context);
    IDAInit(ida, residual, 0, y, d);
    IDASetUserData(ida, x);
    IDASStolerances(ida, tol, tol * beside);
    IDASetId(ida, id);
    IDASetSuppressAlg(ida, 1);
    IDASetMaxNumSteps(ida, 2000000);
    J = SUNDenseMatrix(size, size, context);
    solver = SUNLinSol_Dense(y, J, context);
    IDASetLinearSolver(ida, solver, J);
    IDASetStopTime(ida, s->end);
    if (IDASolve(ida, s->end, &t, y, d, IDA_NORMAL) >= 0)
        took = now() - begun;
    memcpy(q, N_VGetArrayPointer(y), (size_t)n * sizeof(double));
    IDAFree(&ida);
    SUNLinSolFree(solver);
    SUNMatDestroy(J);
    N_VDestroy(y);
    N_VDestroy(d);
    N_VDestroy(id);
    SUNContext_Free(&context);
    return took;
}

int
main(int count, char **words)
{
    const scene *s = NULL;
    double q[7];

    for (size_t i = 0; count == 7 && i < sizeof scenes / sizeof *scenes; i++)
        if (strcmp(words[1], scenes[i].name) == 0)
            s = scenes + i;
    if (!s) {
        fprintf(stderr, "constrained SCENE FROM TO STEPS BESIDE FORM\n");
        return 2;
    }
    if (!freopen("/dev/null", "w", stderr)) /* IDA says there what it cannot do */
        return 1;
    for (double x = atof(words[2]); x >= atof(words[3]) - 1e-9; x -= 1 / atof(words[4])) {
        problem p = {s, atoi(words[6])};
        double least = INFINITY;

        for (int k = 0; k < 5 && least > 0; k++)
            least = fmin(least, run(&p, pow(10, x), atof(words[5]), q));
        printf("%.4g ", pow(10, x));
        if (!(least > 0)) {
            printf("failed\n");
            continue;
        }
        printf("%.6g", least);
        for (int i = 0; i < s->n; i++)
            printf(" %.17g", q[i]);
        printf("\n");
    }
    return 0;
}
