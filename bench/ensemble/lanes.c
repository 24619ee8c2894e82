/* lanes.c -- an ensemble in lanes against its members one after another, in one process:
 * see `run`.
 *
 *     lanes SCENE LINKS MEMBERS TOL ROUNDS KIND
 *
 * KIND: of vectors and machine code, in lanes and alone: 0 portable, 1 AVX2, 2 AVX-512, where
 * the processor has them.
 *
 * Prints: scene, members, tol, seconds one after another and in lanes (medians of the
 * rounds, interleaved), their ratio (median of the ratios), steps of both, the largest
 * difference of the end states over max(1, |y|).
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "expr/build.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/symbol.h"
#include "num/batch.h"
#include "num/kinds.h"
#include "ode/integrate.h"
#include "sim/bind/bind.h"
#include "sim/ensemble/ensemble.h"
#include "sim/plan/plan.h"

enum { MOST = 16, MOST_ROUNDS = 99 };

static void
must(qdot_status status)
{
    if (status == QDOT_OK)
        return;
    fprintf(stderr, "lanes: %s\n", qdot_last_error()->message);
    exit(1);
}

static double
now(void)
{
    struct timespec t;

    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static qdot_expr
coordinate(qdot_pool *pool, qdot_scene *scene, const char *name)
{
    qdot_expr q = qdot_symbol_get(pool, QDOT_COORD, name);

    must(qdot_scene_coordinate(scene, q));
    return q;
}

/* A chain of bobs, m = l = 1, g = 9.81. */
static qdot_scene *
chain(qdot_pool *pool, int links)
{
    qdot_scene *scene = qdot_scene_new(pool);
    qdot_expr r[2] = {QDOT_ZERO, QDOT_ZERO}, g;

    for (int k = 1; k <= links; k++) {
        char name[32];
        qdot_expr q;

        snprintf(name, sizeof name, "theta[%d]", k);
        q = coordinate(pool, scene, name);
        r[0] = qdot_add(pool, r[0], qdot_fun1(pool, QDOT_SIN, q));
        r[1] = qdot_sub(pool, r[1], qdot_fun1(pool, QDOT_COS, q));
        snprintf(name, sizeof name, "bob[%d]", k);
        must(qdot_scene_particle(scene, name, QDOT_ONE, qdot_vector(pool, 2, r)));
    }
    g = qdot_expr_ratio(pool, -981, 100);
    must(qdot_scene_gravity(scene, qdot_vector(pool, 2, (qdot_expr[]){QDOT_ZERO, g})));
    return scene;
}

/* Henon and Heiles' potential. */
static qdot_scene *
henon_heiles(qdot_pool *pool)
{
    qdot_scene *scene = qdot_scene_new(pool);
    qdot_expr x = coordinate(pool, scene, "x"), y = coordinate(pool, scene, "y"), V;

    must(qdot_scene_particle(scene, "p", QDOT_ONE,
                             qdot_vector(pool, 2, (qdot_expr[]){x, y})));
    V = qdot_add(pool, qdot_pow_int(pool, x, 2), qdot_pow_int(pool, y, 2));
    V = qdot_mul(pool, QDOT_HALF, V);
    V = qdot_add(pool, V, qdot_mul(pool, qdot_pow_int(pool, x, 2), y));
    V = qdot_sub(pool, V, qdot_mul(pool, qdot_expr_ratio(pool, 1, 3),
                                   qdot_pow_int(pool, y, 3)));
    must(qdot_scene_potential(scene, V));
    return scene;
}

/* Kepler's problem in polar coordinates, G M = 1. */
static qdot_scene *
kepler(qdot_pool *pool)
{
    qdot_scene *scene = qdot_scene_new(pool);
    qdot_expr r = coordinate(pool, scene, "r"), phi = coordinate(pool, scene, "phi");
    qdot_expr at[] = {qdot_mul(pool, r, qdot_fun1(pool, QDOT_COS, phi)),
                      qdot_mul(pool, r, qdot_fun1(pool, QDOT_SIN, phi))};

    must(qdot_scene_particle(scene, "p", QDOT_ONE, qdot_vector(pool, 2, at)));
    must(qdot_scene_potential(scene, qdot_neg(pool, qdot_pow_int(pool, r, -1))));
    return scene;
}

/* A pendulum of length 1 in space, g = 9.81. */
static qdot_scene *
spherical(qdot_pool *pool)
{
    qdot_scene *scene = qdot_scene_new(pool);
    qdot_expr theta = coordinate(pool, scene, "theta"), phi = coordinate(pool, scene, "phi");
    qdot_expr s = qdot_fun1(pool, QDOT_SIN, theta);
    qdot_expr at[] = {qdot_mul(pool, s, qdot_fun1(pool, QDOT_COS, phi)),
                      qdot_mul(pool, s, qdot_fun1(pool, QDOT_SIN, phi)),
                      qdot_neg(pool, qdot_fun1(pool, QDOT_COS, theta))};
    qdot_expr g[] = {QDOT_ZERO, QDOT_ZERO, qdot_expr_ratio(pool, -981, 100)};

    must(qdot_scene_particle(scene, "p", QDOT_ONE, qdot_vector(pool, 3, at)));
    must(qdot_scene_gravity(scene, qdot_vector(pool, 3, g)));
    return scene;
}

/* A pendulum whose rod is a spring of length 1 and k/m = 1e6. */
static qdot_scene *
spring(qdot_pool *pool)
{
    qdot_scene *scene = qdot_scene_new(pool);
    qdot_expr r = coordinate(pool, scene, "r"), theta = coordinate(pool, scene, "theta");
    qdot_expr at[] = {qdot_mul(pool, r, qdot_fun1(pool, QDOT_SIN, theta)),
                      qdot_neg(pool, qdot_mul(pool, r, qdot_fun1(pool, QDOT_COS, theta)))};
    qdot_expr g[] = {QDOT_ZERO, qdot_expr_ratio(pool, -981, 100)};
    qdot_expr V = qdot_pow_int(pool, qdot_sub(pool, r, QDOT_ONE), 2);

    must(qdot_scene_particle(scene, "p", QDOT_ONE, qdot_vector(pool, 2, at)));
    must(qdot_scene_gravity(scene, qdot_vector(pool, 2, g)));
    must(qdot_scene_potential(scene, qdot_mul(pool, qdot_expr_int(pool, 500000), V)));
    return scene;
}

/* Two bobs on rods of length 1, in Cartesian coordinates with constraints. */
static qdot_scene *
rods(qdot_pool *pool)
{
    static const char *const names[] = {"x[1]", "y[1]", "x[2]", "y[2]"};
    qdot_scene *scene = qdot_scene_new(pool);
    qdot_expr from[2] = {QDOT_ZERO, QDOT_ZERO};
    qdot_expr g[] = {QDOT_ZERO, qdot_expr_ratio(pool, -981, 100)};

    for (int i = 0; i < 2; i++) {
        qdot_expr r[2], length = QDOT_ZERO;

        for (int k = 0; k < 2; k++) {
            r[k] = coordinate(pool, scene, names[2 * i + k]);
            length = qdot_add(pool, length,
                              qdot_pow_int(pool, qdot_sub(pool, r[k], from[k]), 2));
            from[k] = r[k];
        }
        must(qdot_scene_particle(scene, i ? "b" : "a", QDOT_ONE, qdot_vector(pool, 2, r)));
        must(qdot_scene_constraint(scene, i ? "lower" : "upper", length, QDOT_ONE));
    }
    must(qdot_scene_gravity(scene, qdot_vector(pool, 2, g)));
    return scene;
}

/* q and q' of a member, u and w between 0 and 1: angles 1 ... 1.5 of a chain at rest; orbits of
 * e = 0.9 from their pericentres. */
static void
start_kepler(double u, double w, double *y)
{
    (void)w;
    y[0] = 0.1 * (1 + 0.2 * u);
    y[1] = y[2] = 0;
    y[3] = sqrt(1.9 / (y[0] * y[0] * y[0]));
}

static void
start_spherical(double u, double w, double *y)
{
    y[0] = 1 + 0.5 * u;
    y[1] = y[2] = 0;
    y[3] = 0.01 * (1 + w);
}

static void
start_spring(double u, double w, double *y)
{
    (void)w;
    y[0] = 1.00000981;
    y[1] = 1 + 0.5 * u;
    y[2] = y[3] = 0;
}

static void
start_rods(double u, double w, double *y)
{
    const double a = 1 + 0.5 * u, b = 1 + 0.5 * w;

    y[0] = sin(a);
    y[1] = -cos(a);
    y[2] = y[0] + sin(b);
    y[3] = y[1] - cos(b);
    for (int i = 4; i < 8; i++)
        y[i] = 0;
}

static const struct {
    const char *name;
    qdot_scene *(*make)(qdot_pool *pool);
    void (*start)(double u, double w, double *y);
} scenes[] = {
    {"henon", henon_heiles, NULL},
    {"kepler", kepler, start_kepler},
    {"spherical", spherical, start_spherical},
    {"spring", spring, start_spring},
    {"rods", rods, start_rods},
};

enum { SCENES = sizeof scenes / sizeof *scenes };

/* Its row; SCENES: a chain. */
static size_t
scene_of(const char *name)
{
    size_t i = 0;

    while (i < SCENES && strcmp(scenes[i].name, name) != 0)
        i++;
    return i;
}

/* Starts near each other. */
static void
starts(const char *name, size_t n, size_t members, double *y)
{
    const size_t scene = scene_of(name);

    for (size_t m = 0; m < members; m++)
        for (size_t i = 0; i < 2 * n; i++) {
            double u = (double)((m * 7919 + i * 104729) % 1000) / 1000;
            double w = (double)((m * 7919 + 104729) % 1000) / 1000;

            if (scene < SCENES && scenes[scene].start) {
                scenes[scene].start(u, w, y + m * 2 * n);
                break;
            }
            if (scene == SCENES)
                y[m * 2 * n + i] = i < n ? 1 + 0.5 * u : 0;
            else
                y[m * 2 * n + i] = 0.1 + 0.15 * u;
        }
}

static int
by_size(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;

    return x < y ? -1 : x > y;
}

static double
median(double *x, int n)
{
    qsort(x, (size_t)n, sizeof *x, by_size);
    return n % 2 ? x[n / 2] : 0.5 * (x[n / 2 - 1] + x[n / 2]);
}

int
main(int argc, char **argv)
{
    double single[MOST_ROUNDS], lanes[MOST_ROUNDS], ratio[MOST_ROUNDS], difference = 0;
    double *y0, *y1, *y2;
    int links, rounds;
    size_t members, n, steps = 0, lane_steps = 0;
    qdot_pool *pool = qdot_pool_new();
    qdot_run_request request = {.method = "taylor"};
    qdot_ensemble_result *results;
    qdot_ensemble *ensemble;
    qdot_ode_system system;
    qdot_scene *scene;
    qdot_bind *bind;
    qdot_plan *plan;

    if (argc != 7 || !pool) {
        fprintf(stderr, "usage: lanes chain|henon|kepler|spherical|spring|rods LINKS MEMBERS TOL "
                        "ROUNDS KIND\n");
        return 2;
    }
    qdot_kind_limit((size_t)atoi(argv[6]));
    links = atoi(argv[2]);
    members = (size_t)atol(argv[3]);
    request.tol = atof(argv[4]);
    rounds = atoi(argv[5]) < MOST_ROUNDS ? atoi(argv[5]) : MOST_ROUNDS;
    scene = scene_of(argv[1]) < SCENES ? scenes[scene_of(argv[1])].make(pool)
                                       : chain(pool, links);
    n = scene->coordinates.n;
    request.t0 = QDOT_ZERO;
    request.t1 = qdot_expr_int(pool, 10);
    must(qdot_plan_new(scene, &request, &plan));
    must(qdot_bind_new(plan, false, &bind));
    system = qdot_bind_system(bind);
    must(qdot_ensemble_new(scene, &request, 0, NULL, &ensemble));
    y0 = calloc(3 * members * 2 * n, sizeof *y0);
    results = calloc(members, sizeof *results);
    y1 = y0 + members * 2 * n;
    y2 = y1 + members * 2 * n;
    starts(argv[1], n, members, y0);
    for (int round = -1; round < rounds; round++) { /* the first warms up */
        double start = now(), middle, end;

        memcpy(y1, y0, members * 2 * n * sizeof *y0);
        memcpy(y2, y0, members * 2 * n * sizeof *y0);
        steps = 0;
        for (size_t m = 0; m < members; m++) {
            qdot_ode_options options = {.tol = request.tol};
            qdot_ode_result result;

            must(qdot_ode_integrate(&system, qdot_ode_method_find("taylor"), &options, 0,
                                    10, y1 + m * 2 * n, &result));
            steps += result.stats.steps;
        }
        middle = now();
        must(qdot_ensemble_run(ensemble, members, y2, NULL, false, results));
        end = now();
        if (round < 0)
            continue;
        single[round] = middle - start;
        lanes[round] = end - middle;
        ratio[round] = single[round] / lanes[round];
    }
    for (size_t m = 0; m < members; m++)
        lane_steps += results[m].steps;
    for (size_t i = 0; i < members * 2 * n; i++)
        difference = fmax(difference, fabs(y1[i] - y2[i]) / fmax(1, fabs(y1[i])));
    printf("%-9s %2d %4zu %8.0e %10.3e %10.3e %6.2f %7zu %7zu %9.1e  %s\n", argv[1], links,
           members, request.tol, median(single, rounds), median(lanes, rounds),
           median(ratio, rounds), steps, lane_steps, difference,
           qdot_batch_kernels_get()->name);
    return 0;
}
