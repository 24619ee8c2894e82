#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <math.h>
#include <stdlib.h>
#include <cmocka.h>

#include "num/kit.h"

#include "num/hermite.h"

/* A polynomial of degree five and its slopes. */
static qdot_hermite_end
motion(const double *c, double t)
{
    qdot_hermite_end e = {0};

    for (int k = 5; k >= 0; k--) {
        e.a = e.a * t + 2 * e.v;
        e.v = e.v * t + e.y;
        e.y = e.y * t + c[k];
    }
    return e;
}

static void
degree_five_is_met_exactly(void **state)
{
    (void)state;
    for (int tries = 0; tries < 100; tries++) {
        double c[6], v;
        const double t0 = uniform(), h = 0.3 * uniform() + 0.5, s = uniform();
        qdot_hermite_end from, to, between;

        for (size_t k = 0; k < 6; k++)
            c[k] = uniform();
        from = motion(c, t0);
        to = motion(c, t0 + h);
        between = motion(c, t0 + s * h);
        assert_true(fabs(qdot_hermite_at(&from, &to, h, s, &v) - between.y) <= 1e-13);
        assert_true(fabs(v - between.v) <= 1e-12);
        assert_true(fabs(qdot_hermite_at(&from, &to, h, s, NULL) - between.y) <= 1e-13);
    }
}

static void
ends_of_a_cubic_make_it(void **state)
{
    const double c[6] = {0.3, -1.2, 0.7, 2.1, 0, 0}, h = -0.4; /* backwards, too */
    qdot_hermite_end from = motion(c, 0.2), to = motion(c, 0.2 + h);
    const double a0 = from.a, a1 = to.a;

    (void)state;
    from.a = to.a = NAN;
    qdot_hermite_cubic_ends(&from, &to, h);
    assert_true(fabs(from.a - a0) <= 1e-13);
    assert_true(fabs(to.a - a1) <= 1e-13);
}

static void
error_falls_as_the_sixth_power(void **state)
{
    double worst[2] = {0};

    (void)state;
    for (int k = 0; k < 2; k++) {
        const double h = k ? 0.2 : 0.4;
        const qdot_hermite_end from = {sin(1), cos(1), -sin(1)};
        const qdot_hermite_end to = {sin(1 + h), cos(1 + h), -sin(1 + h)};

        for (double s = 0.1; s < 1; s += 0.1)
            worst[k] = fmax(worst[k],
                            fabs(qdot_hermite_at(&from, &to, h, s, NULL) - sin(1 + s * h)));
        assert_true(worst[k] <= pow(h, 6) / 46080);
    }
    assert_true(worst[0] / worst[1] > 50 && worst[0] / worst[1] < 80);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(degree_five_is_met_exactly),
        cmocka_unit_test(ends_of_a_cubic_make_it),
        cmocka_unit_test(error_falls_as_the_sixth_power),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
