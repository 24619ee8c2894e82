// constrained.cc -- mechanisms with constraints, by hand, for bench/constraints.
//
//   constrained ida|arkode SCENE FROM TO STEP REPEAT
//
// IDA        the stabilised index-2 form of Gear, Gupta and Leimkuhler,
//              M q' = M v - G^T mu,  M v' = f + G^T lambda,  g = 0,  G v + g_t = 0,
//            multipliers left out of the error test, dense Jacobians by differences;
// ARKODE     Fehlberg's order 8 on M v' = f + G^T lambda, G v' = gamma (index 1, the 2 x 2
//            system solved by hand), each step projected back: g = 0 by Newton's method, then
//            G v + g_t = 0.
//
// For tolerances 10^FROM ... 10^TO by 10^STEP (relative and absolute): `tol seconds q... v...`, the
// processor's time of the integration, the least of REPEAT, or `tol failed`.
#include <arkode/arkode_erkstep.h>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <ida/ida.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

enum { MOST_N = 4, MOST_M = 2 };

// M diagonal; G [m][n]; gamma = G q'' as g'' = 0 asks.
struct scene {
    const char *name;
    int n, m;
    double end;
    double start[2 * MOST_N], mass[MOST_N];
    void (*force)(double t, const double *q, const double *v, double *f);
    void (*bonds)(double t, const double *q, const double *v, double *g, double *gt,
                  double (*G)[MOST_N], double *gamma);
};

static const double gravity = 9.81;

static void pendulum_force(double, const double *, const double *, double *f)
{
    f[0] = 0;
    f[1] = -gravity;
}

static void pendulum_bonds(double, const double *q, const double *v, double *g, double *gt,
                           double (*G)[MOST_N], double *gamma)
{
    g[0] = q[0] * q[0] + q[1] * q[1] - 1;
    gt[0] = 0;
    G[0][0] = 2 * q[0];
    G[0][1] = 2 * q[1];
    gamma[0] = -2 * (v[0] * v[0] + v[1] * v[1]);
}

static void double_force(double, const double *, const double *, double *f)
{
    f[0] = f[2] = 0;
    f[1] = f[3] = -gravity;
}

static void double_bonds(double, const double *q, const double *v, double *g, double *gt,
                         double (*G)[MOST_N], double *gamma)
{
    double dx = q[2] - q[0], dy = q[3] - q[1], u = v[2] - v[0], w = v[3] - v[1];

    g[0] = q[0] * q[0] + q[1] * q[1] - 1;
    g[1] = dx * dx + dy * dy - 1;
    gt[0] = gt[1] = 0;
    G[0][0] = 2 * q[0];
    G[0][1] = 2 * q[1];
    G[0][2] = G[0][3] = 0;
    G[1][0] = -2 * dx;
    G[1][1] = -2 * dy;
    G[1][2] = 2 * dx;
    G[1][3] = 2 * dy;
    gamma[0] = -2 * (v[0] * v[0] + v[1] * v[1]);
    gamma[1] = -2 * (u * u + w * w);
}

// yb = r sin wt, xb = sqrt(l^2 - yb^2) with two derivatives
static void road(double t, double *x, double *y)
{
    double s = 0.1 * sin(10 * t), c = cos(10 * t), z = sqrt(1 - s * s);

    y[0] = s;
    y[1] = c;
    y[2] = -100 * s;
    x[0] = z;
    x[1] = -y[0] * y[1] / z;
    x[2] = -(y[1] * y[1] + y[0] * y[2] + x[1] * x[1]) / z;
}

static void car_force(double t, const double *q, const double *, double *f)
{
    double x[3], y[3], ll, lr, rx, ry, m = 1e-4 * 10 / 2;

    road(t, x, y);
    rx = q[2] - x[0];
    ry = q[3] - y[0];
    ll = sqrt(q[0] * q[0] + q[1] * q[1]);
    lr = sqrt(rx * rx + ry * ry);
    f[0] = (0.5 - ll) * q[0] / ll;
    f[1] = (0.5 - ll) * q[1] / ll - m;
    f[2] = (0.5 - lr) * rx / lr;
    f[3] = (0.5 - lr) * ry / lr - m;
}

static void car_bonds(double t, const double *q, const double *v, double *g, double *gt,
                      double (*G)[MOST_N], double *gamma)
{
    double x[3], y[3], dx = q[0] - q[2], dy = q[1] - q[3], u = v[0] - v[2], w = v[1] - v[3];

    road(t, x, y);
    g[0] = q[0] * x[0] + q[1] * y[0];
    gt[0] = q[0] * x[1] + q[1] * y[1];
    G[0][0] = x[0];
    G[0][1] = y[0];
    G[0][2] = G[0][3] = 0;
    gamma[0] = -(2 * v[0] * x[1] + 2 * v[1] * y[1] + q[0] * x[2] + q[1] * y[2]);
    g[1] = dx * dx + dy * dy - 1;
    gt[1] = 0;
    G[1][0] = 2 * dx;
    G[1][1] = 2 * dy;
    G[1][2] = -2 * dx;
    G[1][3] = -2 * dy;
    gamma[1] = -2 * (u * u + w * w);
}

static const double S = 0.9092974268256817, C = 0.4161468365471424; // sin 2, -cos 2

static const scene scenes[] = {
    {"pendulum", 2, 1, 100, {S, C, 0, 0}, {1, 1}, pendulum_force, pendulum_bonds},
    {"double", 4, 2, 5, {S, C, 2 * S, 2 * C, 0, 0, 0, 0}, {1, 1, 1, 1}, double_force,
     double_bonds},
    {"car_axis", 4, 2, 3, {0, 0.5, 1, 0.5, -0.5, 0, -0.5, 0}, {5e-4, 5e-4, 5e-4, 5e-4},
     car_force, car_bonds},
};

// G M^-1 G^T x = b
static void solve(const scene *s, double (*G)[MOST_N], const double *b, double *x)
{
    double A[MOST_M][MOST_M], det;

    for (int i = 0; i < s->m; i++)
        for (int j = 0; j < s->m; j++) {
            A[i][j] = 0;
            for (int k = 0; k < s->n; k++)
                A[i][j] += G[i][k] * G[j][k] / s->mass[k];
        }
    if (s->m == 1) {
        x[0] = b[0] / A[0][0];
        return;
    }
    det = A[0][0] * A[1][1] - A[0][1] * A[1][0];
    x[0] = (b[0] * A[1][1] - b[1] * A[0][1]) / det;
    x[1] = (b[1] * A[0][0] - b[0] * A[1][0]) / det;
}

// q'' and lambda of the index-1 equations.
static void accelerate(const scene *s, double t, const double *q, const double *v, double *a,
                       double *lambda)
{
    double f[MOST_N], g[MOST_M], gt[MOST_M], G[MOST_M][MOST_N], gamma[MOST_M], b[MOST_M];

    s->force(t, q, v, f);
    s->bonds(t, q, v, g, gt, G, gamma);
    for (int i = 0; i < s->m; i++) {
        b[i] = gamma[i];
        for (int k = 0; k < s->n; k++)
            b[i] -= G[i][k] * f[k] / s->mass[k];
    }
    solve(s, G, b, lambda);
    for (int k = 0; k < s->n; k++) {
        a[k] = f[k];
        for (int i = 0; i < s->m; i++)
            a[k] += G[i][k] * lambda[i];
        a[k] /= s->mass[k];
    }
}

// --- ARKODE -------------------------------------------------------------------------------

static int index1(realtype t, N_Vector y, N_Vector dy, void *user)
{
    const scene *s = (const scene *)user;
    const double *q = N_VGetArrayPointer(y);
    double *d = N_VGetArrayPointer(dy), lambda[MOST_M];

    memcpy(d, q + s->n, s->n * sizeof *d);
    accelerate(s, t, q, q + s->n, d + s->n, lambda);
    return 0;
}

static int project(realtype t, N_Vector y, void *user)
{
    const scene *s = (const scene *)user;
    double *q = N_VGetArrayPointer(y), *v = q + s->n;
    double g[MOST_M], gt[MOST_M], G[MOST_M][MOST_N], gamma[MOST_M], x[MOST_M];

    for (int k = 0; k < 3; k++) {
        double most = 0;

        s->bonds(t, q, v, g, gt, G, gamma);
        for (int i = 0; i < s->m; i++)
            most = fmax(most, fabs(g[i]));
        if (most < 4e-16)
            break;
        solve(s, G, g, x);
        for (int j = 0; j < s->n; j++)
            for (int i = 0; i < s->m; i++)
                q[j] -= G[i][j] * x[i] / s->mass[j];
    }
    s->bonds(t, q, v, g, gt, G, gamma);
    for (int i = 0; i < s->m; i++) {
        g[i] = gt[i];
        for (int j = 0; j < s->n; j++)
            g[i] += G[i][j] * v[j];
    }
    solve(s, G, g, x);
    for (int j = 0; j < s->n; j++)
        for (int i = 0; i < s->m; i++)
            v[j] -= G[i][j] * x[i] / s->mass[j];
    return 0;
}

static bool by_arkode(const scene *s, double tol, double *end, SUNContext context)
{
    N_Vector y = N_VNew_Serial(2 * s->n, context);
    void *mem;
    double t;
    int flag;

    memcpy(N_VGetArrayPointer(y), s->start, 2 * s->n * sizeof *end);
    mem = ERKStepCreate(index1, 0, y, context);
    ERKStepSetUserData(mem, (void *)s);
    ERKStepSStolerances(mem, tol, tol);
    ERKStepSetTableNum(mem, ARKODE_FEHLBERG_13_7_8);
    ERKStepSetMaxNumSteps(mem, 100000000);
    ERKStepSetPostprocessStepFn(mem, project);
    ERKStepSetStopTime(mem, s->end);
    flag = ERKStepEvolve(mem, s->end, y, &t, ARK_NORMAL);
    memcpy(end, N_VGetArrayPointer(y), 2 * s->n * sizeof *end);
    ERKStepFree(&mem);
    N_VDestroy(y);
    return flag >= 0;
}

// --- IDA ----------------------------------------------------------------------------------

static int stabilised(realtype t, N_Vector y, N_Vector dy, N_Vector r, void *user)
{
    const scene *s = (const scene *)user;
    int n = s->n, m = s->m;
    const double *q = N_VGetArrayPointer(y), *v = q + n, *lambda = v + n, *mu = lambda + m;
    const double *dq = N_VGetArrayPointer(dy), *dv = dq + n;
    double *R = N_VGetArrayPointer(r), f[MOST_N];
    double g[MOST_M], gt[MOST_M], G[MOST_M][MOST_N], gamma[MOST_M];

    s->force(t, q, v, f);
    s->bonds(t, q, v, g, gt, G, gamma);
    for (int j = 0; j < n; j++) {
        R[j] = s->mass[j] * (dq[j] - v[j]);
        R[n + j] = s->mass[j] * dv[j] - f[j];
        for (int i = 0; i < m; i++) {
            R[j] += G[i][j] * mu[i];
            R[n + j] -= G[i][j] * lambda[i];
        }
    }
    for (int i = 0; i < m; i++) {
        R[2 * n + i] = g[i];
        R[2 * n + m + i] = gt[i];
        for (int j = 0; j < n; j++)
            R[2 * n + m + i] += G[i][j] * v[j];
    }
    return 0;
}

static bool by_ida(const scene *s, double tol, double *end, SUNContext context)
{
    int n = s->n, size = 2 * (s->n + s->m), flag;
    N_Vector y = N_VNew_Serial(size, context), dy = N_VNew_Serial(size, context);
    N_Vector id = N_VNew_Serial(size, context);
    SUNMatrix J = SUNDenseMatrix(size, size, context);
    SUNLinearSolver solver = SUNLinSol_Dense(y, J, context);
    double *Y = N_VGetArrayPointer(y), *D = N_VGetArrayPointer(dy), t = 0;
    void *mem = IDACreate(context);

    N_VConst(0, y);
    N_VConst(0, dy);
    memcpy(Y, s->start, 2 * n * sizeof *Y);
    memcpy(D, Y + n, n * sizeof *D);
    accelerate(s, 0, Y, Y + n, D + n, Y + 2 * n);
    for (int i = 0; i < size; i++)
        N_VGetArrayPointer(id)[i] = i < 2 * n;
    IDAInit(mem, stabilised, 0, y, dy);
    IDASetUserData(mem, (void *)s);
    IDASStolerances(mem, tol, tol);
    IDASetId(mem, id);
    IDASetSuppressAlg(mem, SUNTRUE);
    IDASetLinearSolver(mem, solver, J);
    IDASetMaxNumSteps(mem, 100000000);
    IDASetStopTime(mem, s->end);
    flag = IDASolve(mem, s->end, &t, y, dy, IDA_NORMAL);
    memcpy(end, Y, 2 * n * sizeof *end);
    IDAFree(&mem);
    SUNLinSolFree(solver);
    SUNMatDestroy(J);
    N_VDestroy(y);
    N_VDestroy(dy);
    N_VDestroy(id);
    return flag >= 0;
}

static double now()
{
    timespec t;

    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void quiet(int, const char *, const char *, char *, void *)
{
}

int main(int argc, char **argv)
{
    const scene *s = nullptr;
    SUNContext context;

    if (argc != 7 || SUNContext_Create(nullptr, &context))
        return 2;
    (void)quiet;
    for (const scene &one : scenes)
        if (!strcmp(one.name, argv[2]))
            s = &one;
    if (!s)
        return 2;
    for (double e = atof(argv[3]); e >= atof(argv[4]) - 1e-9; e -= atof(argv[5])) {
        double tol = pow(10, e), best = INFINITY, end[2 * MOST_N];
        bool ok = true;

        for (int k = 0; ok && k < atoi(argv[6]); k++) {
            double from = now();

            ok = (!strcmp(argv[1], "ida") ? by_ida : by_arkode)(s, tol, end, context);
            best = fmin(best, now() - from);
        }
        if (!ok) {
            printf("%.3g failed\n", tol);
            continue;
        }
        printf("%.3g %.9f", tol, best);
        for (int i = 0; i < 2 * s->n; i++)
            printf(" %.17g", end[i]);
        puts("");
        fflush(stdout);
    }
    SUNContext_Free(&context);
    return 0;
}
