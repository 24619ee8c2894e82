#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <math.h>
#include <cmocka.h>

#include "num/kit.h"

#include "num/samples.h"

/* The function of one argument, with its derivative in *slope. */
static double
table_at(int number, double x, double *slope)
{
    const double piece = qdot_samples_lookup((double)qdot_samples_piece(number, 0), x);
    const double w = x - qdot_samples_lookup((double)qdot_samples_knot(number, 0), piece);
    double f = 0, d = 0;

    for (int k = 3; k >= 0; k--) {
        d = d * w + f;
        f = f * w + qdot_samples_lookup((double)qdot_samples_coefficient(number, k, 0), piece);
    }
    *slope = d;
    return f;
}

static int
table_of(size_t n, const double *x, const double *f, int degree, qdot_samples_beyond beyond)
{
    int number;

    assert_int_equal(qdot_samples_add(&(qdot_samples_given){.axes = 1,
                                                            .n = {n, 0},
                                                            .knots = {x, NULL},
                                                            .values = f,
                                                            .degree = degree,
                                                            .beyond = beyond},
                                      &number),
                     QDOT_OK);
    return number;
}

/* A spline through four points or more of a cubic is the cubic: no knot is where its third derivative could jump. */
static void
spline_of_a_cubic_is_it(void **state)
{
    (void)state;
    for (size_t n = 4; n < 12; n++) {
        double x[12], f[12], slope;
        int number;

        x[0] = uniform();
        for (size_t i = 0; i < n; i++) {
            x[i] = i == 0 ? x[0] : x[i - 1] + 0.7 + 0.5 * uniform();
            f[i] = 2.385 - x[i] * (0.7 + x[i] * (0.3 - 0.21 * x[i]));
        }
        number = table_of(n, x, f, 3, QDOT_SAMPLES_END);
        for (double t = x[0]; t < x[n - 1]; t += 0.13) {
            const double is = 2.385 - t * (0.7 + t * (0.3 - 0.21 * t)), slope_is = -0.7 - t * (0.6 - 0.63 * t);

            assert_true(fabs(table_at(number, t, &slope) - is) < 1e-11 * (1 + fabs(is)));
            assert_true(fabs(slope - slope_is) < 1e-10 * (1 + fabs(slope_is)));
        }
    }
}

/* Value, slope and second derivative go on over a knot, for a periodic spline also from the end to the begin. */
static void
splines_are_smooth_at_knots(void **state)
{
    static const double x[] = {0.1, 0.4, 1.1, 1.3, 2.6, 3}, f[] = {1, -0.7, 2.2, 0.4, 3.1, 1}, h = 1e-6;

    (void)state;
    for (int periodic = 0; periodic < 2; periodic++) {
        const int number = table_of(6, x, f, 3, periodic ? QDOT_SAMPLES_PERIODIC : QDOT_SAMPLES_END);

        for (size_t k = periodic ? 0 : 1; k < 5; k++) {
            double before, after, bend[2], far;
            const double left = table_at(number, x[k] - h, &before), right = table_at(number, x[k] + h, &after);

            assert_true(fabs(left - right) < 1e-4 && fabs(left - f[k]) < 1e-4);
            (void)table_at(number, x[k] - 2 * h, &far);
            bend[0] = (before - far) / h;
            (void)table_at(number, x[k] + 2 * h, &far);
            bend[1] = (far - after) / h;
            assert_true(fabs(before - after) < 1e-3);
            assert_true(fabs(bend[0] - bend[1]) < 1e-3 * (1 + fabs(bend[0])));
        }
    }
}

static void
pieces_are_found_at_every_place(void **state)
{
    enum { N = 1000 };
    static double x[N], f[N];
    double handle, lo, hi;

    (void)state;
    for (size_t i = 0; i < N; i++) {
        x[i] = i == 0 ? -3 : x[i - 1] + (i % 7 == 0 ? 5 : 0.01) + 0.009 * uniform();
        f[i] = uniform();
    }
    handle = (double)qdot_samples_piece(table_of(N, x, f, 1, QDOT_SAMPLES_HOLD), 0);
    for (size_t i = 0; i + 1 < N; i++)
        for (int k = 0; k < 3; k++) {
            const double at = x[i] + 0.4999 * k * (x[i + 1] - x[i]);

            qdot_samples_bounds(handle, at, &lo, &hi);
            assert_true(lo == x[i] && hi == x[i + 1]);
            assert_true(qdot_samples_lookup(handle, at) == (double)(i + 1));
        }
    assert_true(qdot_samples_lookup(handle, -4) == 0 && qdot_samples_lookup(handle, 1e9) == N);
}

static void
beyond_the_ends(void **state)
{
    static const double x[] = {1, 2, 4}, f[] = {3, 5, 3};
    double slope;

    (void)state;
    assert_true(isnan(table_at(table_of(3, x, f, 3, QDOT_SAMPLES_END), 4.1, &slope)));
    assert_true(isnan(table_at(table_of(3, x, f, 1, QDOT_SAMPLES_END), 0.9, &slope)));
    assert_true(table_at(table_of(3, x, f, 3, QDOT_SAMPLES_HOLD), 40, &slope) == 3 && slope == 0);
    assert_true(fabs(table_at(table_of(3, x, f, 1, QDOT_SAMPLES_PERIODIC), -30 + 1.5, &slope) - 4) < 1e-14 && slope == 2);
    assert_true(fabs(table_at(table_of(3, x, f, 1, QDOT_SAMPLES_PERIODIC), 30 + 1.5, &slope) - 4) < 1e-14 && slope == 2);
    assert_true(table_at(table_of(3, x, f, 0, QDOT_SAMPLES_END), 4, &slope) == 3);
    assert_true(table_at(table_of(3, x, f, 0, QDOT_SAMPLES_END), nextafter(2, 0), &slope) == 3);
    assert_true(table_at(table_of(3, x, f, 0, QDOT_SAMPLES_END), 2, &slope) == 5);
}

static void
equal_tables_are_one(void **state)
{
    static const double x[] = {1, 2, 4}, f[] = {3, 5, 3.5};

    (void)state;
    assert_int_equal(table_of(3, x, f, 1, QDOT_SAMPLES_END), table_of(3, x, f, 1, QDOT_SAMPLES_END));
    assert_int_not_equal(table_of(3, x, f, 1, QDOT_SAMPLES_END), table_of(3, x, f, 3, QDOT_SAMPLES_END));
}

/* What a handle reads is told as it is stored; a coefficient that is 0 in all pieces is not. */
static void
items_are_shown(void **state)
{
    static const double x[] = {1, 2, 4}, f[] = {3, 5, 3};
    const int number = table_of(3, x, f, 1, QDOT_SAMPLES_PERIODIC);
    qdot_samples_view view;

    (void)state;
    assert_true(qdot_samples_look((double)qdot_samples_piece(number, 0), &view));
    assert_true(view.item == QDOT_SAMPLES_PIECE && view.n == 3 && view.period == 2 && !view.jumps && view.at[2] == 4);
    assert_true(qdot_samples_look((double)qdot_samples_coefficient(number, 1, 0), &view));
    assert_true(view.item == QDOT_SAMPLES_COEFFICIENT && view.n == 4 && view.at[1] == 2 && view.at[2] == -1);
    assert_false(qdot_samples_look((double)qdot_samples_coefficient(number, 2, 0), &view));
    assert_false(qdot_samples_look((double)qdot_samples_piece(number, 1), &view));
    assert_false(qdot_samples_look(-1, &view));
}

/* A product of cubics is met exactly on a grid. */
static void
grid_of_a_product(void **state)
{
    static const double x[] = {-1, 0.2, 1, 1.9, 3}, y[] = {0, 0.4, 1.3, 2};
    double f[20];
    int number;

    (void)state;
    for (size_t i = 0; i < 5; i++)
        for (size_t j = 0; j < 4; j++)
            f[4 * i + j] = (1 - x[i] * x[i] * x[i]) * (2 + y[j] * y[j] - y[j] * y[j] * y[j]);
    assert_int_equal(qdot_samples_add(&(qdot_samples_given){.axes = 2, .n = {5, 4}, .knots = {x, y}, .values = f, .degree = 3},
                                      &number),
                     QDOT_OK);
    for (double u = -1; u < 3; u += 0.17)
        for (double v = 0; v < 2; v += 0.23) {
            const double p = qdot_samples_lookup((double)qdot_samples_piece(number, 0), u);
            const double q = qdot_samples_lookup((double)qdot_samples_piece(number, 1), v);
            const double a = u - qdot_samples_lookup((double)qdot_samples_knot(number, 0), p);
            const double b = v - qdot_samples_lookup((double)qdot_samples_knot(number, 1), q);
            double sum = 0;

            for (int i = 0; i < 4; i++)
                for (int j = 0; j < 4; j++)
                    sum += pow(a, i) * pow(b, j)
                           * qdot_samples_lookup((double)qdot_samples_coefficient(number, i, j),
                                                 p * (double)qdot_samples_width(number) + q);
            assert_true(fabs(sum - (1 - u * u * u) * (2 + v * v - v * v * v)) < 1e-11);
        }
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(spline_of_a_cubic_is_it),
        cmocka_unit_test(splines_are_smooth_at_knots),
        cmocka_unit_test(pieces_are_found_at_every_place),
        cmocka_unit_test(beyond_the_ends),
        cmocka_unit_test(equal_tables_are_one),
        cmocka_unit_test(items_are_shown),
        cmocka_unit_test(grid_of_a_product),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
