#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <math.h>
#include <stdlib.h>
#include <cmocka.h>

#include "num/chebyshev.h"

static void
fit(int n, double (*f)(double), double *c)
{
    double values[QDOT_CHEBYSHEV_MOST];

    for (int j = 0; j < n; j++)
        values[j] = f(qdot_chebyshev_node(n, j));
    qdot_chebyshev_fit(n, values, c);
}

static double
wave(double x)
{
    return sin(7 * x + 0.3) * exp(0.4 * x);
}

static double
wave_slope(double x)
{
    return (7 * cos(7 * x + 0.3) + 0.4 * sin(7 * x + 0.3)) * exp(0.4 * x);
}

static void
fits_a_function_its_slope_and_its_integral(void **state)
{
    double c[64], d[64], left[64], right[64], sum = 0;

    (void)state;
    fit(64, wave, c);
    qdot_chebyshev_derivative(64, c, d);
    qdot_chebyshev_halves(64, c, left, right);
    for (double x = -1; x <= 1; x += 0.0625) {
        assert_float_equal(qdot_chebyshev_at(64, c, x), wave(x), 1e-14);
        assert_float_equal(qdot_chebyshev_at(63, d, x), wave_slope(x), 1e-11);
        assert_float_equal(qdot_chebyshev_at(64, left, x), wave(0.5 * (x - 1)), 1e-14);
        assert_float_equal(qdot_chebyshev_at(64, right, x), wave(0.5 * (x + 1)), 1e-14);
    }
    for (int k = 0; k < 200000; k++) /* midpoints */
        sum += wave(-1 + (k + 0.5) * 1e-5) * 1e-5;
    assert_float_equal(qdot_chebyshev_integral(64, c), sum, 1e-9);
}

/* Random roots, some near one another, none lost, none twice. */
static double at[9];
static int degree;

static double
product(double x)
{
    double p = 1;

    for (int i = 0; i < degree; i++)
        p *= x - at[i];
    return p;
}

static void
every_root_is_found_once(void **state)
{
    double c[64], roots[64];

    (void)state;
    srand(3);
    for (int trial = 0; trial < 500; trial++) {
        int inside = 0, found;

        degree = 1 + rand() % 6;
        for (int i = 0; i < degree; i++) {
            at[i] = 2.4 * rand() / RAND_MAX - 1.2;
            if (i % 3 == 1 && rand() % 2 == 0)
                at[i] = at[i - 1] + 1e-4;
        }
        for (int i = 0; i < degree; i++)
            inside += fabs(at[i]) < 1;
        fit(16, product, c);
        found = qdot_chebyshev_crossings(16, c, roots);
        assert_int_equal(found, inside);
        for (int k = 0; k < found; k++) {
            double nearest = 1;

            for (int i = 0; i < degree; i++)
                nearest = fmin(nearest, fabs(at[i] - roots[k]));
            assert_true(nearest < 1e-6);
            assert_true(k == 0 || roots[k] > roots[k - 1]);
        }
    }
}

static double
touching(double x)
{
    return (x - 0.3) * (x - 0.3);
}

static void
a_root_without_change_of_sign_is_none(void **state)
{
    double c[64], roots[64];

    (void)state;
    fit(8, touching, c);
    assert_true(qdot_chebyshev_crossings(8, c, roots) % 2 == 0);
}

static double
offset(double x)
{
    return x + 1.5;
}

static void
the_bound_shows_a_sign(void **state)
{
    double c[64];

    (void)state;
    fit(8, offset, c);
    assert_int_equal(qdot_chebyshev_sign(8, c), 1);
    fit(8, touching, c);
    assert_int_equal(qdot_chebyshev_sign(8, c), 0);
}

static double
steep(double x)
{
    return 3 + 1 / (1.3 - x);
}

/* The bound holds on the ellipse, is near the truth, and is none where nothing is known. */
static void
an_ellipse_bounds_what_lies_around(void **state)
{
    const double rho = 1.7, far = 0.5 * (rho + 1 / rho);
    double c[64], bound;

    (void)state;
    fit(64, steep, c);
    bound = qdot_chebyshev_ellipse(64, c, 1e-15, rho);
    assert_true(bound >= 0.999 * (steep(far) - c[0])); /* where it is largest */
    assert_true(bound <= 1.001 * (steep(far) - c[0]));
    fit(8, steep, c);
    assert_true(isinf(qdot_chebyshev_ellipse(8, c, 1e-15, rho)));
    fit(16, touching, c);
    for (int k = 0; k < 16; k++) /* rounding stays rounding */
        c[k] += 1e-16;
    assert_true(qdot_chebyshev_ellipse(16, c, 4e-16, 14) < 1e5);
}

/* Coefficients that are no numbers have no roots, and take no time; nor do those of overflowing values. */
static void
what_is_not_finite_is_not_searched(void **state)
{
    double c[QDOT_CHEBYSHEV_MOST] = {1, 2, 3}, roots[QDOT_CHEBYSHEV_MOST];
    const double odd[] = {NAN, INFINITY, 1e308};

    (void)state;
    for (int k = 0; k < 3; k++) {
        c[1] = c[2] = odd[k];
        assert_int_equal(qdot_chebyshev_crossings(64, c, roots), -1);
    }
    c[1] = c[2] = 3;
    c[0] = NAN;
    assert_int_equal(qdot_chebyshev_crossings(64, c, roots), -1);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fits_a_function_its_slope_and_its_integral),
        cmocka_unit_test(every_root_is_found_once),
        cmocka_unit_test(a_root_without_change_of_sign_is_none),
        cmocka_unit_test(what_is_not_finite_is_not_searched),
        cmocka_unit_test(the_bound_shows_a_sign),
        cmocka_unit_test(an_ellipse_bounds_what_lies_around),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
