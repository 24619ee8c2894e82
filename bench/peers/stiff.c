/* stiff -- a stiff scene by CVODE's BDF, over a ladder of tolerances.
 *
 *   stiff SCENE FROM TO STEPS BESIDE
 *
 * FROM, TO: exponents of the first and last tolerance, STEPS a decade; relative ones; absolute ones
 * are BESIDE times as large.
 * A line a tolerance: `tol seconds y...`, or `tol failed`; the least of several runs' times. A run that
 * takes longer than 3 s is given up, and ends the ladder. The
 * Jacobian is written by hand where there are two coordinates at most, else by CVODE's differences.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

typedef struct {
    const char *name;
    int n; /* of y */
    double end;
    void (*start)(double *y);
    void (*f)(double t, const double *y, double *d);
    void (*slopes)(double t, const double *y, double *J); /* [n x n] by rows; NULL */
} scene;

/* x'' = force(x, x', t), by its slopes */
#define ONE(name, x0, v0, force, by_x, by_v)                                             \
    static void name##_start(double *y)                                                  \
    {                                                                                    \
        y[0] = x0;                                                                       \
        y[1] = v0;                                                                       \
    }                                                                                    \
    static void name##_f(double t, const double *y, double *d)                           \
    {                                                                                    \
        const double x = y[0], v = y[1];                                                 \
        (void)t;                                                                         \
        (void)x;                                                                         \
        d[0] = v;                                                                        \
        d[1] = force;                                                                    \
    }                                                                                    \
    static void name##_slopes(double t, const double *y, double *J)                      \
    {                                                                                    \
        const double x = y[0], v = y[1];                                                 \
        (void)t;                                                                         \
        (void)x;                                                                         \
        (void)v;                                                                         \
        J[0] = 0;                                                                        \
        J[1] = 1;                                                                        \
        J[2] = by_x;                                                                     \
        J[3] = by_v;                                                                     \
    }
ONE(relaxation, 1, 0, -x - 1e6 * v, -1, -1e6)
ONE(sinking, 0, 0, -9.81 - 1e8 * v, 0, -1e8)
ONE(well, 0.1, 0, x - x * x * x - 1e5 * v, 1 - 3 * x * x, -1e5)
ONE(pendulum, 2, 0, -9.81 * sin(x) - 1e6 * v, -9.81 * cos(x), -1e6)
ONE(vanderpol, 2, 0, 1000 * (1 - x * x) * v - x, -2000 * x * v - 1, 1000 * (1 - x * x))
ONE(friction, 1, 0, -x - 0.5 * tanh(1e6 * v) + sin(0.7 * t), -1,
    -0.5e6 * (1 - tanh(1e6 * v) * tanh(1e6 * v)))

static void
scales_start(double *y)
{
    y[0] = 1;
    y[1] = y[2] = y[3] = 0;
}

static void
scales_f(double t, const double *y, double *d)
{
    (void)t;
    d[0] = y[2];
    d[1] = y[3];
    d[2] = -2 * y[0] + y[1];
    d[3] = 1e8 * (y[0] - y[1]) - 1e4 * y[3];
}

static void
scales_slopes(double t, const double *y, double *J)
{
    static const double all[16] = {0,  0, 1, 0, 0,   0,    0, 1,
                                   -2, 1, 0, 0, 1e8, -1e8, 0, -1e4};

    (void)t;
    (void)y;
    memcpy(J, all, sizeof all);
}

/* x, y, x', y' on a spring of length 1, at rest at its natural length */
static void
spring_start(double *y)
{
    y[0] = 1;
    y[1] = y[2] = y[3] = 0;
}

static void
spring_f(double t, const double *y, double *d)
{
    const double r = sqrt(y[0] * y[0] + y[1] * y[1]), pull = -1e8 * (r - 1) / r;

    (void)t;
    d[0] = y[2];
    d[1] = y[3];
    d[2] = pull * y[0];
    d[3] = pull * y[1] - 9.81;
}

static void
spring_slopes(double t, const double *y, double *J)
{
    const double r2 = y[0] * y[0] + y[1] * y[1], r = sqrt(r2), k = 1e8;
    const double even = -k * (r - 1) / r, odd = -k / (r2 * r);

    (void)t;
    memset(J, 0, 16 * sizeof *J);
    J[2] = J[7] = 1;
    J[8] = even + odd * y[0] * y[0];
    J[9] = J[12] = odd * y[0] * y[1];
    J[13] = even + odd * y[1] * y[1];
}

enum { LINKS = 20 };

static void
chain_start(double *y)
{
    memset(y, 0, 4 * LINKS * sizeof *y);
    for (int k = 0; k < LINKS; k++)
        y[k] = 0.05 * (k + 1);
}

/* x[k], y[k], x'[k], y'[k]: springs of 1e6 with dampers of 500 */
static void
chain_f(double t, const double *y, double *d)
{
    enum { N = LINKS };

    (void)t;
    memcpy(d, y + 2 * N, 2 * N * sizeof *d);
    for (int k = 0; k < N; k++) {
        d[2 * N + k] = 0;
        d[3 * N + k] = -9.81;
    }
    for (int k = 0; k < N; k++) {
        const double x = y[k] - (k ? y[k - 1] : 0), z = y[N + k] - (k ? y[N + k - 1] : 0);
        const double u = y[2 * N + k] - (k ? y[2 * N + k - 1] : 0);
        const double w = y[3 * N + k] - (k ? y[3 * N + k - 1] : 0),
                     r = sqrt(x * x + z * z);
        const double pull = (1e6 * (r - 0.05) + 500 * (x * u + z * w) / r) / r / 0.05;

        d[2 * N + k] -= pull * x;
        d[3 * N + k] -= pull * z;
        if (k) {
            d[2 * N + k - 1] += pull * x;
            d[3 * N + k - 1] += pull * z;
        }
    }
}

static const scene scenes[] = {
#define ROW(name, n, end)                                                                \
    {                                                                                    \
#name, n, end, name##_start, name##_f, name##_slopes                             \
    }
    ROW(relaxation, 2, 10),
    ROW(sinking, 2, 100),
    ROW(well, 2, 2e5),
    ROW(pendulum, 2, 1e5),
    ROW(vanderpol, 2, 2000),
    ROW(friction, 2, 20),
    ROW(scales, 4, 50),
    ROW(spring, 4, 10),
    {"chain", 4 * LINKS, 1, chain_start, chain_f, NULL},
};

static double
seconds(void)
{
    struct timespec now;

    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* The end of the time of a run; looked at in every 1024th call, which costs nothing. */
static const double longest = 3;
static double latest;
static int calls, late;

static int
call_f(realtype t, N_Vector y, N_Vector d, void *of)
{
    ((const scene *)of)->f(t, N_VGetArrayPointer(y), N_VGetArrayPointer(d));
    if (++calls % 1024 == 0)
        late = seconds() > latest;
    return late ? -1 : 0;
}

static int
call_slopes(realtype t, N_Vector y, N_Vector d, SUNMatrix J, void *of, N_Vector a,
            N_Vector b, N_Vector c)
{
    const scene *s = of;
    double rows[16];

    (void)d;
    (void)a;
    (void)b;
    (void)c;
    s->slopes(t, N_VGetArrayPointer(y), rows);
    for (int i = 0; i < s->n; i++)
        for (int j = 0; j < s->n; j++)
            SM_ELEMENT_D(J, i, j) = rows[i * s->n + j];
    return 0;
}

static void
silent(int code, const char *module, const char *function, char *message, void *user)
{
    (void)code;
    (void)module;
    (void)function;
    (void)message;
    (void)user;
}

/* One run into y; its time, negative if it failed. */
static double
run(const scene *s, double tol, double beside, double *y)
{
    SUNContext context;
    double t, from;
    int status;

    SUNContext_Create(NULL, &context);
    N_Vector x = N_VNew_Serial(s->n, context);
    SUNMatrix J = SUNDenseMatrix(s->n, s->n, context);
    SUNLinearSolver solver = SUNLinSol_Dense(x, J, context);
    void *memory = CVodeCreate(CV_BDF, context);

    from = seconds();
    latest = from + longest;
    s->start(N_VGetArrayPointer(x));
    CVodeSetErrHandlerFn(memory, silent, NULL);
    CVodeInit(memory, call_f, 0, x);
    CVodeSStolerances(memory, tol, tol * beside);
    CVodeSetUserData(memory, (void *)s);
    CVodeSetMaxNumSteps(memory, 20000000);
    CVodeSetLinearSolver(memory, solver, J);
    if (s->slopes)
        CVodeSetJacFn(memory, call_slopes);
    CVodeSetStopTime(memory, s->end);
    status = CVode(memory, s->end, x, &t, CV_NORMAL);
    from = seconds() - from;
    memcpy(y, N_VGetArrayPointer(x), (size_t)s->n * sizeof *y);
    CVodeFree(&memory);
    SUNLinSolFree(solver);
    SUNMatDestroy(J);
    N_VDestroy(x);
    SUNContext_Free(&context);
    return status < 0 ? -1 : from;
}

int
main(int count, char **words)
{
    const scene *s = NULL;
    double y[4 * LINKS];

    for (size_t k = 0; count == 6 && k < sizeof scenes / sizeof *scenes; k++)
        if (strcmp(scenes[k].name, words[1]) == 0)
            s = scenes + k;
    if (!s)
        return 2;
    for (double e = atof(words[2]); e >= atof(words[3]) - 1e-9; e -= 1 / atof(words[4])) {
        double best = INFINITY, sum = 0;

        for (int tries = 0; tries < 200 && (tries < 3 ? sum < 1 : sum < 0.1) && best > 0;
             tries++) {
            const double took = run(s, pow(10, e), atof(words[5]), y);

            best = took < 0 ? -1 : fmin(best, took);
            sum += took;
        }
        printf("%.3g", pow(10, e));
        if (best < 0)
            printf(" failed");
        else
            printf(" %.4g", best);
        for (int i = 0; i < s->n && best >= 0; i++)
            printf(" %.17g", y[i]);
        printf("\n");
        fflush(stdout);
        if (late)
            break;
    }
    return 0;
}
