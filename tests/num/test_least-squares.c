/* Data sets of NIST's "Statistical Reference Datasets: Nonlinear Regression" with their certified results, and
 * what a sum of squares does not say. */
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "num/least-squares.h"

/* y = b1 (1 - exp(-b2 x)) */
typedef struct {
    size_t n;
    const double *x, *y;
} saturation;

static qdot_status
saturate(const double *b, double *f, double *J, void *user)
{
    const saturation *s = user;

    for (size_t i = 0; i < s->n; i++) {
        const double e = exp(-b[1] * s->x[i]);

        f[i] = b[0] * (1 - e) - s->y[i];
        J[2 * i] = 1 - e;
        J[2 * i + 1] = b[0] * s->x[i] * e;
    }
    return QDOT_OK;
}

static void
near(double is, double certified, double within)
{
    if (!(fabs(is - certified) <= within * fabs(certified)))
        fail_msg("%.12g for %.12g", is, certified);
}

static void
find(const saturation *s, double b1, double b2, const double *certified)
{
    double u[] = {b1, b2};
    qdot_least_squares x = {.n = s->n, .p = 2, .model = saturate, .user = (void *)s, .u = u};

    assert_int_equal(qdot_least_squares_find(&x), QDOT_OK);
    assert_true(x.converged);
    near(u[0], certified[0], 2e-10);
    near(u[1], certified[1], 2e-10);
    near(x.chi2, certified[4], 1e-10);
    for (size_t k = 0; k < 2; k++) {
        near(sqrt(x.covariance[3 * k] * x.chi2 / (double)(s->n - 2)), certified[2 + k], 1e-9);
        assert_true(fabs(x.left[k]) < 1e-7 * certified[2 + k]);
        assert_true(x.undetermined[k] == 0);
    }
    qdot_least_squares_clear(&x);
}

static void
misra1a(void **state)
{
    static const double x[] = {77.6,  114.9, 141.1, 190.8, 239.9, 289.0, 332.8,
                               378.4, 434.8, 477.3, 536.8, 593.1, 689.1, 760.0},
                        y[] = {10.07, 14.73, 17.94, 23.93, 29.61, 35.18, 40.02,
                               44.82, 50.76, 55.05, 61.01, 66.40, 75.47, 81.78},
                        certified[] = {2.3894212918e+02, 5.5015643181e-04, 2.7070075241e+00,
                                       7.2668688436e-06, 1.2455138894e-01};
    const saturation s = {14, x, y};

    (void)state;
    find(&s, 500, 0.0001, certified);
    find(&s, 250, 0.0005, certified);
}

static void
boxbod(void **state)
{
    static const double x[] = {1, 2, 3, 5, 7, 10}, y[] = {109, 149, 149, 191, 213, 224},
                        certified[] = {2.1380940889e+02, 5.4723748542e-01, 1.2354515176e+01,
                                       1.0455993237e-01, 1.1680088766e+03};
    const saturation s = {6, x, y};

    (void)state;
    find(&s, 100, 0.75, certified);
    find(&s, 300, 0.2, certified);
}

/* Numbers that are fitted to the last bit: there the part of f in the columns of J never becomes small. */
static void
exact_data(void **state)
{
    double x[8], y[8], u[] = {1, 1};
    const saturation s = {8, x, y};
    qdot_least_squares q = {.n = 8, .p = 2, .model = saturate, .user = (void *)&s, .u = u};

    (void)state;
    for (size_t i = 0; i < 8; i++) {
        x[i] = (double)i / 4;
        y[i] = 2.385 * (1 - exp(-0.77 * x[i]));
    }
    assert_int_equal(qdot_least_squares_find(&q), QDOT_OK);
    assert_true(q.converged);
    near(u[0], 2.385, 1e-13);
    near(u[1], 0.77, 1e-13);
    qdot_least_squares_clear(&q);
}

/* f = u0 u1 x - x, and nothing for u0 > 3. */
static qdot_status
product(const double *u, double *f, double *J, void *user)
{
    if (u[0] > 3)
        return qdot_fail(*(qdot_status *)user, "there is nothing beyond 3");
    for (size_t i = 0; i < 4; i++) {
        const double x = (double)i + 1;

        f[i] = u[0] * u[1] * x - 2.5 * x;
        J[2 * i] = u[1] * x;
        J[2 * i + 1] = u[0] * x;
    }
    return QDOT_OK;
}

static void
a_product_does_not_determine_its_factors(void **state)
{
    double u[] = {0.5, 1};
    qdot_status beyond = QDOT_EDOMAIN;
    qdot_least_squares q = {.n = 4, .p = 2, .model = product, .user = &beyond, .u = u};

    (void)state;
    assert_int_equal(qdot_least_squares_find(&q), QDOT_OK);
    near(u[0] * u[1], 2.5, 1e-9);
    assert_true(u[0] <= 3);
    near(q.undetermined[0], sqrt(0.5), 1e-6);
    near(q.undetermined[1], -sqrt(0.5), 1e-6);
    assert_true(isnan(q.covariance[0]));
    qdot_least_squares_clear(&q);
}

static void
failures(void **state)
{
    double u[] = {4, 1};
    qdot_status beyond = QDOT_EDOMAIN;
    qdot_least_squares q = {.n = 4, .p = 2, .model = product, .user = &beyond, .u = u};

    (void)state;
    assert_int_equal(qdot_least_squares_find(&q), QDOT_EDOMAIN); /* where it begins */
    qdot_least_squares_clear(&q);
    u[0] = 2.9, u[1] = 0.01; /* steps end at 3, where there is no least sum */
    assert_int_equal(qdot_least_squares_find(&q), QDOT_OK);
    assert_false(q.converged);
    qdot_least_squares_clear(&q);
    u[0] = 2.9, u[1] = 0.01;
    beyond = QDOT_EINTR; /* met on the way */
    assert_int_equal(qdot_least_squares_find(&q), QDOT_EINTR);
    qdot_least_squares_clear(&q);
    q.n = 1;
    assert_int_equal(qdot_least_squares_find(&q), QDOT_EINVAL);
    qdot_least_squares_clear(&q);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(misra1a),
        cmocka_unit_test(boxbod),
        cmocka_unit_test(exact_data),
        cmocka_unit_test(a_product_does_not_determine_its_factors),
        cmocka_unit_test(failures),
    };

    return cmocka_run_group_tests_name("num/least-squares", tests, NULL, NULL);
}
