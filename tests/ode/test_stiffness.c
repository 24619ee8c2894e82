/* What lies on a line for thousands of steps is bound by stability; what turns is not. */
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <cmocka.h>

#include <math.h>

#include "ode/stiffness.h"

/* After how many steps of the motion (x, x'), the k-th of h exp(growth k), it is told, of 20,000; 0: never. */
static int
told_after_growing(double (*x)(double), double (*v)(double), double h, double growth, double t1, double work)
{
    qdot_ode_stiffness s = {0};
    const qdot_ode_options options = {.tol = 1e-9};
    bool stiff = false;
    int k = 0;

    for (; k < 20000 && !stiff; k++) {
        const double t = growth > 0 ? h * expm1(growth * k) / growth : k * h, y[] = {x(t), v(t)};
        const qdot_ode_stiff_step at = {
            .n = 2, .t = t, .t1 = t1, .y = y, .noise = 1e-9, .work = work, .most = 50000000};

        const qdot_status status = qdot_ode_stiffness_is_due(&s)
                                       ? qdot_ode_stiffness_look(&s, &at, &options, &stiff)
                                       : QDOT_OK;

        assert_int_equal(status, stiff ? QDOT_ELIMIT : QDOT_OK);
    }
    qdot_ode_stiffness_clear(&s);
    return stiff ? k : 0;
}

static int
told_after(double (*x)(double), double (*v)(double), double h, double t1, double work)
{
    return told_after_growing(x, v, h, 0, t1, work);
}

static double
sinks(double t)
{
    return -1e-3 * (t + expm1(-1e3 * t) / 1e3);
}

static double
speed(double t)
{
    return 1e-3 * expm1(-1e3 * t);
}

static double
trembles(double t)
{
    return t + 1e-6 * sin(1e3 * t);
}

static double
rate(double t)
{
    return 1 + 1e-3 * cos(1e3 * t);
}

static double
zero(double t)
{
    (void)t;
    return 0;
}

static void
a_motion_on_a_line_is_told(void **state)
{
    int steps;

    (void)state;
    steps = told_after(sinks, speed, 2e-3, 1e6, 100);
    assert_true(steps > 500 && steps < 1600);
    steps = told_after(zero, zero, 1, 1e12, 100);
    assert_true(steps > 500 && steps < 700);
}

static void
one_that_turns_is_not(void **state)
{
    (void)state;
    assert_int_equal(told_after(trembles, rate, 2e-3, 1e6, 100), 0);
    assert_int_equal(told_after(sin, cos, 1.7, 1e12, 100), 0);
    assert_int_equal(told_after(sin, cos, 6.283185307179586 / 7, 1e12, 100), 0);
    assert_int_equal(told_after(exp, exp, 1e-2, 1e12, 100), 0);
}

static void
nor_one_that_ends_soon(void **state)
{
    (void)state;
    assert_int_equal(told_after(sinks, speed, 2e-3, 1e3, 100), 0);
}

/* Steps that grow by an eighth in 250: of 1e9 at their present length about 3e4 are left. */
static void
steps_that_grow_end_sooner(void **state)
{
    (void)state;
    assert_true(told_after_growing(sinks, speed, 2e-3, 5e-4, 2e6, 1e6) > 500);
    assert_int_equal(told_after_growing(sinks, speed, 2e-3, 5e-4, 2e6, 1e4), 0);
    assert_true(told_after(sinks, speed, 2e-3, 2e6, 1e4) > 500);
}

/* Steps that turn, more than there may be: a million of them are awaited. */
static void
too_many_steps_are_told(void **state)
{
    qdot_ode_stiffness s = {0};
    const qdot_ode_options options = {.tol = 1e-9};
    bool stiff = false;
    qdot_status status = QDOT_OK;
    int k = 0;

    (void)state;
    for (; k < 2000000 && status == QDOT_OK; k++) {
        const double y = sin(k);
        const qdot_ode_stiff_step at = {.n = 1, .t = k, .t1 = 1e9, .y = &y, .noise = 1e-9,
                                        .work = 100, .most = 50000000, .implicit = true};

        if (qdot_ode_stiffness_is_due(&s))
            status = qdot_ode_stiffness_look(&s, &at, &options, &stiff);
    }
    assert_true(status == QDOT_ELIMIT && !stiff && k > 990000 && k < 1010000);
    qdot_ode_stiffness_clear(&s);
}

/* y' = -k (y - t) + 1e-7 cos(1e6 t) along a line: stability binds steps of 1e-5 where k is large only. */
static qdot_status
relax(double t, const double *y, double *f, void *user)
{
    const double *k = user;

    f[0] = -*k * (y[0] - t) + 1e-7 * cos(1e6 * t);
    return QDOT_OK;
}

static void
a_fast_force_is_not_stiff(void **state)
{
    double k[2] = {1e6, 1};

    (void)state;
    for (int fast = 0; fast < 2; fast++) {
        const qdot_ode_system system = {.n = 1, .rhs = relax, .user = &k[fast]};
        const qdot_ode_options options = {.tol = 1e-9};
        qdot_ode_stiffness s = {0};
        qdot_status status = QDOT_OK;
        bool stiff = false;

        for (int i = 0; i < 100000 && status == QDOT_OK; i++) {
            const double t = 1e-5 * i;
            const qdot_ode_stiff_step at = {.system = &system, .n = 1, .t = t, .t1 = 1e6, .y = &t, .noise = 1e-9,
                                            .work = 100, .most = 1000000000};

            if (qdot_ode_stiffness_is_due(&s))
                status = qdot_ode_stiffness_look(&s, &at, &options, &stiff);
        }
        assert_true(stiff == !fast);
        qdot_ode_stiffness_clear(&s);
    }
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_motion_on_a_line_is_told),
        cmocka_unit_test(one_that_turns_is_not),
        cmocka_unit_test(nor_one_that_ends_soon),
        cmocka_unit_test(steps_that_grow_end_sooner),
        cmocka_unit_test(too_many_steps_are_told),
        cmocka_unit_test(a_fast_force_is_not_stiff),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
