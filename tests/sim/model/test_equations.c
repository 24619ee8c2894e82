/* test_equations.c -- accelerations and Jacobians against differences of the positions
 * alone. */
#include "expr/build.h"
#include "expr/function.h"
#include "sim/scenes.h"

#include <math.h>
#include <stdlib.h>

#include "sim/bind/bind.h"
#include "sim/plan/plan.h"
#include "tape/reference.h"

enum { N = 3, PARTICLES = 3 };

static uint64_t seed = 4711;

static double
uniform(void)
{
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(seed >> 11) * 0x1p-53 * 2 - 1;
}

/* A scene of particles in space at random smooth places r(q, t), in a random
 * potential. */
typedef struct {
    fixture f;
    qdot_expr in[N + 1], position[PARTICLES][3], potential;
    long double mass[PARTICLES];
} random_scene;

static qdot_expr
random_place(random_scene *s)
{
    static const char *const numbers[] = {"0.3", "-0.7", "1.25", "0.9", "-1.1", "0.5"};
    qdot_pool *pool = s->f.pool;
    qdot_expr sum = QDOT_ZERO;

    for (int k = 0; k < 4; k++) {
        qdot_expr a = s->in[(unsigned)(fabs(uniform()) * (N + 0.4))];
        qdot_expr b = s->in[(unsigned)(fabs(uniform()) * N)];
        qdot_expr c = number(&s->f, numbers[(unsigned)(fabs(uniform()) * 6)]);
        qdot_expr term = qdot_add(pool, times(&s->f, c, a), b);

        switch ((int)(fabs(uniform()) * 5)) {
        case 0: term = qdot_fun1(pool, QDOT_SIN, term); break;
        case 1: term = qdot_fun1(pool, QDOT_COS, qdot_sub(pool, a, b)); break;
        case 2: term = times(&s->f, a, b); break;
        case 3:
            term = qdot_sqrt(pool, qdot_add(pool, qdot_pow_int(pool, term, 2), QDOT_ONE));
            break;
        default: break;
        }
        sum = qdot_add(pool, sum, times(&s->f, c, term));
    }
    return sum;
}

static void
make(random_scene *s)
{
    static const char *const masses[] = {"1.5", "0.8", "2.25"};
    char name[16];

    begin(&s->f);
    for (int i = 0; i < N; i++) {
        snprintf(name, sizeof name, "q[%d]", i);
        s->in[i] = coordinate(&s->f, name);
    }
    s->in[N] = QDOT_T;
    for (int p = 0; p < PARTICLES; p++) {
        for (int k = 0; k < 3; k++)
            s->position[p][k] = random_place(s);
        s->mass[p] = (long double)atof(masses[p]);
        snprintf(name, sizeof name, "p%d", p);
        must(qdot_scene_particle(s->f.scene, name, number(&s->f, masses[p]),
                                 qdot_vector(s->f.pool, 3, s->position[p])));
    }
    s->potential = random_place(s);
    must(qdot_scene_potential(s->f.scene, s->potential));
}

/* --- differences, in long double ---------------------------------------------------- */

static const long double step = 0.01L;

/* Central differences of order 8. */
static const long double first[] = {4.0L / 5, -1.0L / 5, 4.0L / 105, -1.0L / 280};
static const long double second[] = {8.0L / 5, -1.0L / 5, 8.0L / 315, -1.0L / 560};

/* e at x + s*direction, x = (q, t). */
static long double
along(random_scene *s, qdot_expr e, const long double *x, const long double *direction,
      long double at)
{
    long double y[N + 1];

    for (int i = 0; i <= N; i++)
        y[i] = x[i] + at * direction[i];
    return reference(s->f.pool, e, N + 1, s->in, y).v;
}

static long double
slope(random_scene *s, qdot_expr e, const long double *x, const long double *direction)
{
    long double d = 0;

    for (int k = 1; k <= 4; k++)
        d += first[k - 1]
             * (along(s, e, x, direction, k * step)
                - along(s, e, x, direction, -k * step));
    return d / step;
}

static long double
curvature(random_scene *s, qdot_expr e, const long double *x,
          const long double *direction)
{
    long double d = -205.0L / 72 * along(s, e, x, direction, 0);

    for (int k = 1; k <= 4; k++)
        d += second[k - 1]
             * (along(s, e, x, direction, k * step)
                + along(s, e, x, direction, -k * step));
    return d / (step * step);
}

/* q'' by d'Alembert: sum m dr/dq_i . (r'' at q'' = 0 + sum_j dr/dq_j q_j'') =
 * -dV/dq_i. */
static void
accelerations(random_scene *s, const long double *x, const long double *v, long double *a)
{
    long double M[N][N + 1] = {{0}}, path[N + 1];

    for (int i = 0; i < N; i++)
        path[i] = v[i];
    path[N] = 1;
    for (int i = 0; i < N; i++) {
        long double unit[N + 1] = {0};

        unit[i] = 1;
        M[i][N] -= slope(s, s->potential, x, unit);
    }
    for (int p = 0; p < PARTICLES; p++)
        for (int k = 0; k < 3; k++) {
            long double J[N], bend = curvature(s, s->position[p][k], x, path);

            for (int i = 0; i < N; i++) {
                long double unit[N + 1] = {0};

                unit[i] = 1;
                J[i] = slope(s, s->position[p][k], x, unit);
            }
            for (int i = 0; i < N; i++) {
                M[i][N] -= s->mass[p] * J[i] * bend;
                for (int j = 0; j < N; j++)
                    M[i][j] += s->mass[p] * J[i] * J[j];
            }
        }
    for (int i = 0; i < N; i++) /* Gauss and Jordan; M is positive definite */
        for (int r = 0; r < N; r++) {
            long double factor = M[r][i] / M[i][i];

            for (int j = i; j <= N && r != i; j++)
                M[r][j] -= factor * M[i][j];
        }
    for (int i = 0; i < N; i++)
        a[i] = M[i][N] / M[i][i];
}

static void
accelerations_agree_with_differences(void **state)
{
    int compared = 0;

    (void)state;
    for (int round = 0; round < 25; round++) {
        random_scene s;
        qdot_plan *plan;
        qdot_bind *bind;
        double y[2 * N], dydt[2 * N], t = uniform();
        long double x[N + 1], v[N], a[N], scale = 1;
        qdot_ode_system system;

        make(&s);
        must(qdot_plan_new(s.f.scene, &s.f.request, &plan));
        must(qdot_bind_new(plan, false, &bind));
        system = qdot_bind_system(bind);
        for (int i = 0; i < N; i++) {
            x[i] = y[i] = uniform();
            v[i] = y[N + i] = uniform();
        }
        x[N] = t;
        if (system.rhs(t, y, dydt, system.user) == QDOT_OK) {
            accelerations(&s, x, v, a);
            for (int i = 0; i < N; i++)
                scale = fmaxl(scale, fabsl(a[i]));
            for (int i = 0; i < N && scale < 1e3L; i++) {
                compared++;
                assert_true(dydt[i] == y[N + i]);
                if (!(fabsl(dydt[N + i] - a[i]) < 1e-9L * scale))
                    fail_msg("round %d: %.15g, not %.15Lg", round, dydt[N + i], a[i]);
            }
        }
        qdot_bind_free(bind);
        qdot_plan_free(plan);
        end(&s.f);
    }
    assert_true(compared > 45);
}

/* df/dy and df/dt against differences of f. */
static void
check_jacobian(fixture *f, size_t n, double t, double *y)
{
    const double h = 1e-5;
    double J[100], Jt[10], up[10], down[10];
    qdot_plan *plan;
    qdot_bind *bind;
    qdot_ode_system system;

    f->request.method = "bsimp";
    must(qdot_plan_new(f->scene, &f->request, &plan));
    must(qdot_bind_new(plan, false, &bind));
    system = qdot_bind_system(bind);
    must(system.jacobian(t, y, J, Jt, system.user));
    for (size_t j = 0; j <= 2 * n; j++) {
        double *x = j < 2 * n ? &y[j] : &t, keep = *x;

        *x = keep + h;
        must(system.rhs(t, y, up, system.user));
        *x = keep - h;
        must(system.rhs(t, y, down, system.user));
        *x = keep;
        for (size_t i = 0; i < 2 * n; i++) {
            double want = (up[i] - down[i]) / (2 * h);
            double got = j < 2 * n ? J[i * 2 * n + j] : Jt[i];

            if (!(fabs(got - want) < 1e-5 * (1 + fabs(want))))
                fail_msg("df[%zu]/dx[%zu]: %.12g, not %.12g", i, j, got, want);
        }
    }
    qdot_bind_free(bind);
    qdot_plan_free(plan);
}

static void
jacobians_agree_with_differences(void **state)
{
    double y[2 * N];
    fixture f;

    (void)state;
    for (int round = 0; round < 10; round++) {
        random_scene s;

        make(&s);
        for (int i = 0; i < 2 * N; i++)
            y[i] = uniform();
        if (round % 2 == 0 || round == 3)
            check_jacobian(&s.f, N, 0.4, y);
        end(&s.f);
    }
    chain(&f, 3);
    check_jacobian(&f, 3, 0, y);
    end(&f);
    pendulum(&f); /* a block of one */
    check_jacobian(&f, 1, 0, y);
    end(&f);
}

/* Two particles apart, one of them on a line with a coupled pair: blocks of 1 and 2, M
 * constant. */
static void
blocks_are_found_and_constants_factored_once(void **state)
{
    fixture f;
    qdot_expr x, a, b;
    qdot_plan *plan;
    qdot_bind *bind;
    qdot_ode_system system;
    double y[6] = {0.1, 0.2, 0.3, 1, 2, 3}, dydt[6];

    (void)state;
    begin(&f);
    a = coordinate(&f, "a");
    x = coordinate(&f, "x");
    b = coordinate(&f, "b");
    must(qdot_scene_particle(f.scene, "p", number(&f, "2"), x));
    must(qdot_scene_particle(f.scene, "r", number(&f, "1"), qdot_add(f.pool, a, b)));
    must(qdot_scene_particle(f.scene, "s", number(&f, "3"), b));
    must(qdot_scene_potential(f.scene, qdot_add(f.pool, times(&f, a, x), b)));
    must(qdot_plan_new(f.scene, &f.request, &plan));
    assert_int_equal(plan->structure.blocks, 2);
    must(qdot_bind_new(plan, false, &bind));
    system = qdot_bind_system(bind);
    for (int i = 0; i < 5; i++)
        must(system.rhs(0, y, dydt, system.user));
    /* for the right-hand side and for its series */
    assert_int_equal(qdot_bind_factored(bind), 2);
    /* x: 2 x'' = -a. a, b: [1 1; 1 4] (a'', b'') = (-x, -1) */
    assert_true(fabs(dydt[4] - -0.05) < 1e-15);
    assert_true(fabs(dydt[3] + dydt[5] - -0.2) < 1e-15);
    assert_true(fabs(dydt[3] + 4 * dydt[5] - -1) < 1e-15);
    qdot_bind_free(bind);
    qdot_plan_free(plan);
    end(&f);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(accelerations_agree_with_differences),
        cmocka_unit_test(jacobians_agree_with_differences),
        cmocka_unit_test(blocks_are_found_and_constants_factored_once),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
