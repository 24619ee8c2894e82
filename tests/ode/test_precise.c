/* test_precise.c -- Taylor steps in MPFR: exponentials, ways and ends, failures. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
#include <string.h>

#include "ode/precise.h"

enum { MOST = 120, BITS = 256 };

/* y' = y, or y' = 1 + y^2, whose tangent has a pole. */
typedef struct {
    qdot_reals x, w;
    mp_limb_t work[64];
    bool tangent;
    qdot_precise_system system;
} problem;

static void
derive(problem *p, int k)
{
    mpfr_t *x = p->x.at;

    if (p->tangent) {
        qdot_real_dot(x[k + 1], (const mpfr_t *)x, (const mpfr_t *)x + k, (size_t)k + 1,
                      p->work);
        if (k == 0)
            mpfr_add_ui(x[1], x[1], 1, MPFR_RNDN);
    } else
        mpfr_set(x[k + 1], x[k], MPFR_RNDN);
    mpfr_div_ui(x[k + 1], x[k + 1], (uint64_t)k + 1, MPFR_RNDN);
}

static qdot_status
begin(mpfr_srcptr t, const mpfr_t *y, void *user)
{
    problem *p = user;

    (void)t;
    mpfr_set(p->x.at[0], y[0], MPFR_RNDN);
    derive(p, 0);
    return QDOT_OK;
}

static qdot_status
extend(int order, void *user)
{
    for (int k = 1; k < order; k++)
        derive(user, k);
    return QDOT_OK;
}

static void
open_problem(problem *p, bool tangent)
{
    memset(p, 0, sizeof *p);
    p->tangent = tangent;
    assert_int_equal(qdot_reals_init(&p->x, MOST + 1, BITS), QDOT_OK);
    assert_int_equal(qdot_reals_init(&p->w, 4, BITS), QDOT_OK);
    p->system = (qdot_precise_system){.n = 1,
                                      .bits = BITS,
                                      .most = MOST,
                                      .x = (const mpfr_t *)p->x.at,
                                      .stride = MOST + 1,
                                      .begin = begin,
                                      .extend = extend,
                                      .user = p};
}

static void
close_problem(problem *p)
{
    qdot_reals_clear(&p->x);
    qdot_reals_clear(&p->w);
}

/* log2 of the error at time t of a run of y' = y from 1 at 0 to t1. */
static double
exponential_error(double t1, double t, int order, double log2_tol)
{
    problem p;
    qdot_precise_run run = {0};
    qdot_precise_options options = {.log2_tol = log2_tol, .order = order};
    mpfr_t *w;
    size_t near = SIZE_MAX;
    double error;

    open_problem(&p, false);
    w = p.w.at;
    mpfr_set_d(w[1], t1, MPFR_RNDN);
    mpfr_set_ui(w[2], 1, MPFR_RNDN);
    assert_int_equal(qdot_precise_integrate(&p.system, &options, w[0], w[1],
                                            (const mpfr_t *)w + 2, &run),
                     QDOT_OK);
    assert_true(mpfr_equal_p(qdot_precise_point(&run, run.count - 1)[0], w[1]));
    mpfr_set_d(w[0], t, MPFR_RNDN);
    assert_int_equal(qdot_precise_at(&run, &p.system, w[0], &near, w + 3), QDOT_OK);
    mpfr_exp(w[1], w[0], MPFR_RNDN);
    mpfr_sub(w[1], w[1], w[3], MPFR_RNDN);
    error = qdot_real_log2(w[1]) - fmax(0, qdot_real_log2(w[3]));
    for (size_t k = 0; k + 1 < run.count; k++) { /* doubles inside the steps */
        const double *row = qdot_precise_inside(&run, k);

        for (int i = 0; i < QDOT_PRECISE_INSIDE; i++, row += 2)
            assert_true(fabs(row[1] - exp(row[0])) <= 4e-15 * exp(row[0]));
    }
    mpfr_set_d(w[0], 2 * t1, MPFR_RNDN);
    assert_int_equal(qdot_precise_at(&run, &p.system, w[0], &near, w + 3), QDOT_EDOMAIN);
    qdot_precise_run_clear(&run);
    close_problem(&p);
    return error;
}

static void
the_tolerance_is_kept(void **state)
{
    (void)state;
    for (int order = 20; order <= MOST; order += 25)
        for (double tol = -60; tol >= -220; tol -= 40) {
            assert_true(exponential_error(5, 5, order, tol) < tol + 8);
            assert_true(exponential_error(5, 2.3, order, tol) < tol + 8);
            assert_true(exponential_error(-3, -1.1, order, tol) < tol + 8);
        }
}

/* From y = 0 the pole is at pi/2. */
static void
a_pole_is_not_crossed(void **state)
{
    problem p;
    qdot_precise_run run = {0};
    qdot_precise_options options = {.log2_tol = -100, .order = 40};

    (void)state;
    open_problem(&p, true);
    mpfr_set_ui(p.w.at[1], 2, MPFR_RNDN);
    assert_int_equal(qdot_precise_integrate(&p.system, &options, p.w.at[0], p.w.at[1],
                                            (const mpfr_t *)p.w.at + 2, &run),
                     QDOT_EFAILED);
    assert_int_equal(run.result.outcome, QDOT_ODE_FAILED);
    assert_true(run.result.t > 1.57 && run.result.t <= 1.5707963267948968);
    assert_non_null(strstr(run.result.reason, "stopped at t = 1.57"));
    assert_true(run.count > 2);
    qdot_precise_run_clear(&run);
    close_problem(&p);
}

static void
limits_of_work_are_told(void **state)
{
    problem p;
    qdot_precise_run run = {0};
    qdot_precise_options options = {.log2_tol = -100, .order = 40, .max_steps = 3};

    (void)state;
    open_problem(&p, false);
    mpfr_set_ui(p.w.at[1], 2000, MPFR_RNDN);
    mpfr_set_ui(p.w.at[2], 1, MPFR_RNDN);
    assert_int_equal(qdot_precise_integrate(&p.system, &options, p.w.at[0], p.w.at[1],
                                            (const mpfr_t *)p.w.at + 2, &run),
                     QDOT_ELIMIT);
    assert_int_equal(run.count, 4);
    options.max_steps = 0;
    options.max_bytes = 10;
    assert_int_equal(qdot_precise_integrate(&p.system, &options, p.w.at[0], p.w.at[1],
                                            (const mpfr_t *)p.w.at + 2, &run),
                     QDOT_ELIMIT);
    options = (qdot_precise_options){.log2_tol = -100, .order = MOST + 1};
    assert_int_equal(qdot_precise_integrate(&p.system, &options, p.w.at[0], p.w.at[1],
                                            (const mpfr_t *)p.w.at + 2, &run),
                     QDOT_EINVAL);
    qdot_precise_run_clear(&run);
    close_problem(&p);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_tolerance_is_kept),
        cmocka_unit_test(a_pole_is_not_crossed),
        cmocka_unit_test(limits_of_work_are_told),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
