#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <cmocka.h>
#include <math.h>

#include "ode/companion.h"
#include "ode/integrate.h"
#include "ode/scale.h"

static const double A = 3e-10;

/* x'' = -x, of any size */
static qdot_status
oscillate(double t, const double *y, double *dydt, void *user)
{
    (void)t;
    (void)user;
    dydt[0] = y[1];
    dydt[1] = -y[0];
    return QDOT_OK;
}

static qdot_status
oscillate_jacobian(double t, const double *y, double *dfdy, double *dfdt, void *user)
{
    (void)t;
    (void)y;
    (void)user;
    dfdy[0] = dfdy[3] = dfdt[0] = dfdt[1] = 0;
    dfdy[1] = 1;
    dfdy[2] = -1;
    return QDOT_OK;
}

/* Its Taylor coefficients. */
static double coefficients[2 * 64];

static qdot_status
begin(double t, const double *y, double unit, void *user)
{
    (void)t;
    *(double *)user = unit;
    for (int i = 0; i < 2; i++)
        coefficients[64 * i] = y[i];
    coefficients[1] = unit * y[1];
    coefficients[64 + 1] = -unit * y[0];
    return QDOT_OK;
}

static qdot_status
extend(int p, void *user)
{
    const double unit = *(double *)user;

    for (int k = 1; k < p; k++) {
        coefficients[k + 1] = unit * coefficients[64 + k] / (k + 1);
        coefficients[64 + k + 1] = -unit * coefficients[k] / (k + 1);
    }
    return QDOT_OK;
}

static double unit;
static const qdot_ode_series series = {.most = 40,
                                       .x = coefficients,
                                       .stride = 64,
                                       .checked = 1,
                                       .cost = {.kernels = {1, 1, 1}},
                                       .begin = begin,
                                       .extend = extend,
                                       .user = &unit};

/* The error at t = 10 of a run under tol, over A. */
static double
error_of(const qdot_ode_method *method, double tol, const double *scales, double start)
{
    const qdot_ode_system system = {.n = 2,
                                    .rhs = oscillate,
                                    .jacobian = oscillate_jacobian,
                                    .series = &series,
                                    .scales = scales};
    const qdot_ode_options options = {.tol = tol};
    qdot_ode_result r;
    double y[2] = {start, 0};

    assert_int_equal(qdot_ode_integrate(&system, method, &options, 0, 10, y, &r), QDOT_OK);
    assert_int_equal(r.outcome, QDOT_ODE_DONE);
    return hypot(y[0] - start * cos(10), y[1] + start * sin(10)) / start;
}

static void
size_is_at_least_the_scale(void **state)
{
    const double scales[] = {1e-3, 1e5};

    (void)state;
    assert_true(qdot_ode_size(NULL, 0, -0.5) == 1 && qdot_ode_size(NULL, 1, -7) == 7);
    assert_true(qdot_ode_size(scales, 0, -1e-4) == 1e-3 && qdot_ode_size(scales, 0, 2) == 2);
    assert_true(qdot_ode_size(scales, 1, 7) == 1e5 && qdot_ode_size(scales, 1, NAN) == 1e5);
}

/* A motion of size 3e-10 has in its own unit the accuracy that one of size 1 has; without it
 * tol 1e-8 is met by anything. */
static void
small_motions_are_as_accurate_as_others(void **state)
{
    const double scales[] = {1e-10, 1e-10};
    const double tol = 1e-8;
    static const char *const names[] = {"rk8pd",  "rkf45",  "msadams", "msbdf",
                                        "bsimp",  "dop853", "taylor"};

    (void)state;
    for (size_t m = 0; m < sizeof names / sizeof *names; m++) {
        const qdot_ode_method *method = qdot_ode_method_find(names[m]);
        const double small = error_of(method, tol, scales, A);
        const double about_1 = error_of(method, tol, NULL, 3);

        if (!(small < 30 * fmax(about_1, 1e-12)))
            fail_msg("%s: error %g in units of the motion, %g of one about 1", method->name,
                     small, about_1);
        if (!method->series && !(error_of(method, tol, NULL, A) > 10 * small))
            fail_msg("%s takes no note of scales", method->name);
    }
}

/* A zero is moved by a rounding of its scale, and both errors are stated. */
static void
companions_start_in_the_scale(void **state)
{
    const double scales[] = {1e-10, 1e-10}, y0[] = {0, A};
    const qdot_ode_system system = {.n = 2, .rhs = oscillate, .series = &series, .scales = scales};
    qdot_companion_request request = {.system = &system,
                                      .method = qdot_ode_method_find("taylor"),
                                      .tol = 1e-10,
                                      .t1 = 10,
                                      .y0 = y0};
    const qdot_ode_options options = {.tol = 1e-10};
    qdot_companion_estimate e;
    qdot_companion *c;
    qdot_ode_result r;
    double y[] = {0, A}, difference[2];

    (void)state;
    assert_true(QDOT_COMPANION_FAR * qdot_companion_moved(0, 1e-10, 0, 0) == -qdot_companion_moved(0, 1e-10, 0, 1));
    assert_true(fabs(qdot_companion_moved(0, 1e-10, 0, 0)) == 1e-10 * 0x1p-53);
    assert_int_equal(qdot_ode_integrate(&system, request.method, &options, 0, 10, y, &r), QDOT_OK);
    assert_int_equal(qdot_companion_start(&request, &c), QDOT_OK);
    qdot_companion_limit(c, r.stats.steps);
    qdot_companion_finish(c, 10, y, difference, &e);
    assert_true(e.known);
    assert_true(fabs(y[0] - A * sin(10)) <= difference[0] + 1e-25);
    assert_true(difference[0] < 1e-18 && difference[1] < 1e-18);
    assert_true(e.error < 1e-8 && e.plain <= e.error && e.plain < 1e-14);
}

/* What starts at rest at 1e-8 is moved as what is 1e-8; where nothing is known, by its scale. */
static void
zeros_are_moved_by_what_stands_beside_them(void **state)
{
    const double y[] = {1e-8, 1e-17, 3, 0, /* q' */ 0, 0, 0, -1e-3}, scales[] = {1, 1, 1, 1, 1, 2, 1, 1};

    (void)state;
    assert_true(qdot_companion_unit(NULL, 8, y, 4) == 1e-8);
    assert_true(qdot_companion_unit(NULL, 8, y, 5) == 1 && qdot_companion_unit(scales, 8, y, 5) == 2);
    assert_true(qdot_companion_unit(NULL, 8, y, 6) == 1 && qdot_companion_unit(NULL, 8, y, 2) == 1);
    assert_true(qdot_companion_unit(NULL, 8, y, 3) == 1e-3);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(size_is_at_least_the_scale),
        cmocka_unit_test(small_motions_are_as_accurate_as_others),
        cmocka_unit_test(companions_start_in_the_scale),
        cmocka_unit_test(zeros_are_moved_by_what_stands_beside_them),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
