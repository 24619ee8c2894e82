/* test_exponents.c -- Lyapunov exponents of motions whose exponents are known. */
#include "expr/build.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "sim/scenes.h"

#include <math.h>

#include "expr/calculus.h"
#include "sim/study/exponents.h"

static void
find(fixture *f, bool spectrum, int until, qdot_exponents *x)
{
    *x = (qdot_exponents){.spectrum = spectrum};
    f->request.t1 = qdot_expr_int(f->pool, until);
    must(qdot_exponents_find(f->scene, &f->request, x));
}

static void
near(const qdot_exponents *x, size_t k, double truth, double within)
{
    if (!(fabs(x->value[k] - truth) <= within) ||
        !(fabs(x->value[k] - truth) <= x->error[k] + 1e-9))
        fail_msg("%.9g for %.9g, stated %g", x->value[k], truth, x->error[k]);
}

/* m x'' = k x - c x' */
static void
saddle(fixture *f, const char *k, const char *c)
{
    qdot_expr x, v;

    begin(f);
    x = coordinate(f, "x");
    v = velocity(f, x);
    must(qdot_scene_particle(f->scene, "a", QDOT_ONE, x));
    must(qdot_scene_potential(
        f->scene, times(f, number(f, "-0.5"), times(f, number(f, k), times(f, x, x)))));
    must(qdot_scene_dissipation(
        f->scene, times(f, number(f, "0.5"), times(f, number(f, c), times(f, v, v)))));
}

static void
of_a_saddle(void **state)
{
    qdot_exponents x;
    fixture f;

    (void)state;
    saddle(&f, "4", "0");
    find(&f, false, 50, &x);
    near(&x, 0, 2, 1e-8);
    assert_int_equal(x.n, 1);
    assert_int_equal(x.windows, QDOT_EXPONENTS_WINDOWS);
    qdot_exponents_clear(&x);
    find(&f, true, 1000, &x); /* made orthonormal several times in a window */
    assert_int_equal(x.n, 2);
    near(&x, 0, 2, 1e-8);
    near(&x, 1, -2, 1e-8);
    qdot_exponents_clear(&x);
    end(&f);
}

/* Both exponents of a damped oscillation are -c/2. */
static void
of_what_dies_out(void **state)
{
    qdot_exponents x;
    fixture f;

    (void)state;
    saddle(&f, "-4", "0.5");
    f.q0[0] = QDOT_ONE;
    find(&f, true, 400, &x);
    near(&x, 0, -0.25, 0.01);
    near(&x, 1, -0.25, 0.01);
    qdot_exponents_clear(&x);
    end(&f);
}

/* On x = y, V = -(x^2 + y^2)/2: x'' = x. */
static void
on_a_constraint(void **state)
{
    qdot_expr x, y;
    qdot_exponents e;
    fixture f;

    (void)state;
    begin(&f);
    x = coordinate(&f, "x");
    y = coordinate(&f, "y");
    must(qdot_scene_particle(f.scene, "a", QDOT_ONE, pair(&f, x, y)));
    must(qdot_scene_potential(f.scene,
                              times(&f, number(&f, "-0.5"),
                                    qdot_add(f.pool, times(&f, x, x), times(&f, y, y)))));
    must(qdot_scene_constraint(f.scene, "line", x, y));
    find(&f, true, 30, &e);
    assert_int_equal(e.n, 2);
    near(&e, 0, 1, 1e-3);
    near(&e, 1, -1, 1e-3);
    qdot_exponents_clear(&e);
    end(&f);
}

/* A free particle that is kicked by v += x each unit of time: cosh(lambda) = 3/2. */
static void
through_events(void **state)
{
    qdot_expr x, v, kicked;
    qdot_event kick = {.name = (char *)"kick"};
    qdot_exponents e;
    fixture f;

    (void)state;
    saddle(&f, "0", "0");
    x = f.scene->coordinates.at[0];
    v = velocity(&f, x);
    kicked = qdot_add(f.pool, v, x);
    kick.left = qdot_fun1(f.pool, QDOT_COS, times(&f, QDOT_PI, QDOT_T));
    kick.right = QDOT_ZERO;
    must(qdot_vec_push(&kick.targets, v));
    must(qdot_vec_push(&kick.values, kicked));
    must(qdot_scene_event(f.scene, &kick));
    find(&f, false, 100, &e);
    near(&e, 0, acosh(1.5), 1e-6);
    qdot_exponents_clear(&e);
    qdot_free(kick.targets.at);
    qdot_free(kick.values.at);
    end(&f);
}

/* The error covers the mean of numbers that remember those before them. */
static void
means_have_errors(void **state)
{
    uint64_t random = 1;
    int covered = 0;

    (void)state;
    for (int trial = 0; trial < 200; trial++) {
        double x[90], mean, error, state_now = 0;

        for (int i = 0; i < 90; i++) {
            random = random * 6364136223846793005u + 1442695040888963407u;
            state_now = 0.7 * state_now + ((double)(random >> 33) / 0x1p30 - 1);
            x[i] = 3 + state_now;
        }
        qdot_exponents_mean(90, x, &mean, &error);
        covered += fabs(mean - 3) <= error;
        assert_true(error < 2);
    }
    assert_true(covered >= 180);
}

/* A motion that sticks: growth 1 for times that are drawn, then 0 for longer ones with a heavy tail. */
static void
means_of_sticky_motion_have_errors(void **state)
{
    enum { TRIALS = 400, N = 90 };
    uint64_t random = 5;
    size_t covered = 0, seen = 0;

    (void)state;
    for (int trial = 0; trial < TRIALS; trial++) {
        double x[N], mean, error, left = 0, part = 0;
        bool sticks = trial % 2;

        for (int i = 0; i < 20 * N; i++) {
            if (left <= 0) {
                random = random * 6364136223846793005u + 1442695040888963407u;
                const double u = (double)((random >> 33) + 1) / 0x1p31;

                sticks = !sticks;
                left = 20 * (sticks ? 5 * pow(u, -1 / 1.5) : -5 * log(u)); /* means 15, 5 */
            }
            left--;
            part += sticks ? 0 : 0.05;
            if (i % 20 == 19) {
                x[i / 20] = part;
                part = 0;
            }
        }
        qdot_exponents_mean(N, x, &mean, &error);
        if (mean < 0.05 || mean > 0.95)
            continue; /* one kind of motion alone */
        seen++;
        covered += fabs(mean - 0.25) <= error;
    }
    assert_true(seen > TRIALS / 2 && covered >= seen - seen / 100);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(of_a_saddle),       cmocka_unit_test(of_what_dies_out),
        cmocka_unit_test(on_a_constraint),   cmocka_unit_test(through_events),
        cmocka_unit_test(means_have_errors),
        cmocka_unit_test(means_of_sticky_motion_have_errors),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
