#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <stdlib.h>
#include <cmocka.h>

#include "ode/dop853.h"
#include "ode/failing.h"

static const qdot_ode_method *
dop853(void)
{
    return qdot_ode_method_find("dop853");
}

static const problem *const problems[] = {&pendulum, &henon, &kepler};

/* --- the table --------------------------------------------------------------------- */

static double c[16], row[16][16], weight[16], fifth[16], third[16];

static void
read_table(void)
{
    double *b;

#define A(j, a) b[j] = (a);
#define STAGE(s, c_, terms)                                                              \
    b = row[s];                                                                          \
    terms c[s] = (c_);
#define DENSE_STAGE(s, c_, terms)                                                        \
    b = row[s];                                                                          \
    terms c[s] = (c_);
#define WEIGHTS(terms)                                                                   \
    b = weight;                                                                          \
    terms
#define ERROR5(terms)                                                                    \
    b = fifth;                                                                           \
    terms
#define THIRD(terms)                                                                     \
    b = third;                                                                           \
    terms
#include "ode/dop853.def"
    memcpy(row[12], weight, sizeof weight);
    c[12] = 1;
}

/* sum_j b_j c_j^power */
static double
moment(const double *b, int power)
{
    double sum = 0;

    for (int j = 0; j < 16; j++)
        sum += b[j] * pow(c[j], power);
    return sum;
}

static void
near(double x, double want, const char *what, int index)
{
    if (!(fabs(x - want) < 2e-14))
        fail_msg("%s %d: %.17g, not %.17g", what, index, x, want);
}

/* Every stage is consistent; weights integrate t^p up to their order. The stages of the
 * polynomial satisfy more: sum_j a_sj c_j^p = c_s^(p+1)/(p+1) for p up to 5. */
static void
the_table_satisfies_its_conditions(void **state)
{
    (void)state;
    read_table();
    for (int s = 1; s < 16; s++)
        near(moment(row[s], 0), c[s], "row sum", s);
    for (int s = 13; s < 16; s++)
        for (int p = 1; p < 6; p++)
            near(moment(row[s], p), pow(c[s], p + 1) / (p + 1), "stage", s);
    for (int p = 0; p < 8; p++)
        near(moment(weight, p), 1.0 / (p + 1), "quadrature, power", p);
    for (int p = 0; p < 5; p++)
        near(moment(fifth, p), 0, "error of order 5, power", p);
    assert_true(fabs(moment(fifth, 5)) > 1e-5);
    for (int p = 0; p < 3; p++)
        near(moment(third, p), 1.0 / (p + 1), "order 3, power", p);
    assert_true(fabs(moment(third, 3) - 0.25) > 1e-5);
}

/* --- orders ------------------------------------------------------------------------ */

/* End error of n equal steps. */
static double
error_of_steps(const problem *p, double t1, int n)
{
    qdot_ode_options o = {.tol = 1, .h_fixed = fabs(t1) / n};
    qdot_ode_result r;
    double y[4];

    memcpy(y, p->y0, sizeof y);
    assert_int_equal(qdot_ode_integrate(&p->system, dop853(), &o, 0, t1, y, &r), QDOT_OK);
    assert_int_equal(r.stats.steps, n);
    return true_error(p, t1, y);
}

static void
the_order_is_eight(void **state)
{
    (void)state;
    for (int k = 0; k < 2; k++) {
        double coarse = error_of_steps(&henon, k ? -8 : 8, 20);
        double fine = error_of_steps(&henon, k ? -8 : 8, 80);
        double seen = log2(coarse / fine) / 2;

        if (fabs(seen - 8) > 0.5)
            fail_msg("order %.2f (%g, %g)", seen, coarse, fine);
    }
}

/* One step of h from the start: its polynomial's worst error, and its ratio. */
static void
one_step(const problem *p, double h, double *worst, double *ratio)
{
    double F[7 * 4], y[4];
    qdot_ode_stepper *s;

    assert_int_equal(qdot_ode_stepper_new(&p->system, dop853(), 1e-6, &s), QDOT_OK);
    qdot_ode_stepper_start(s, p->y0);
    assert_int_equal(qdot_ode_stepper_try(s, 0, h, ratio), QDOT_OK);
    if (*ratio > 1)
        assert_int_equal(qdot_ode_stepper_rhs(s, h, s->trial, s->trial_dydt), QDOT_OK);
    assert_int_equal(qdot_dop853.dense(s, 0, h, F), QDOT_OK);
    *worst = 0;
    for (int k = 1; k < 20; k++) {
        qdot_dop853.at(p->system.n, F, p->y0, k / 20.0, y);
        *worst = fmax(*worst, true_error(p, h * k / 20, y));
    }
    qdot_dop853.at(p->system.n, F, p->y0, 0, y);
    assert_memory_equal(y, p->y0, p->system.n * sizeof *y);
    qdot_dop853.at(p->system.n, F, p->y0, 1, y);
    assert_true(true_error(p, h, y) <= *worst);
    qdot_ode_stepper_free(s);
}

static void
polynomial_and_ratio_go_as_the_eighth_power(void **state)
{
    static const double h[] = {0.16, 0.3, 0.06};

    (void)state;
    for (int p = 0; p < 3; p++) {
        double coarse, fine, ratio, smaller;

        one_step(problems[p], h[p], &coarse, &ratio);
        one_step(problems[p], h[p] / 2, &fine, &smaller);
        if (fabs(log2(coarse / fine) - 8) > 0.7)
            fail_msg("%s: polynomial %g, %g", problems[p]->name, coarse, fine);
        if (fabs(log2(ratio / smaller) - 8) > 1.5)
            fail_msg("%s: ratio %g, %g", problems[p]->name, ratio, smaller);
    }
}

/* --- runs -------------------------------------------------------------------------- */

/* Twelve evaluations a step, eleven one refused; two to begin. */
static void
the_last_stage_is_the_next_first(void **state)
{
    uint64_t rejected = 0;

    (void)state;
    for (int p = 0; p < 3; p++)
        for (double tol = 1e-4; tol > 1e-14; tol /= 10) {
            qdot_ode_options o = {.tol = tol};
            qdot_ode_result r;
            double y[4];

            memcpy(y, problems[p]->y0, sizeof y);
            assert_int_equal(
                qdot_ode_integrate(&problems[p]->system, dop853(), &o, 0, 10, y, &r),
                QDOT_OK);
            assert_int_equal(r.stats.evaluations,
                             2 + 12 * r.stats.steps + 11 * r.stats.rejected);
            rejected += r.stats.rejected;
        }
    assert_true(rejected > 0);
}

/* The evaluations that an error of 1e-9 or better takes, over tolerances. */
static double
evaluations_for(const problem *p, const char *method)
{
    for (double tol = 1e-7;; tol /= 1.3) {
        qdot_ode_options o = {.tol = tol};
        qdot_ode_result r;
        double y[4];

        memcpy(y, p->y0, sizeof y);
        assert_int_equal(qdot_ode_integrate(&p->system, qdot_ode_method_find(method), &o,
                                            0, 10, y, &r),
                         QDOT_OK);
        if (true_error(p, 10, y) < 1e-9)
            return (double)r.stats.evaluations;
        assert_true(tol > 1e-14);
    }
}

static void
it_costs_about_what_rk8pd_costs(void **state)
{
    (void)state;
    for (int p = 0; p < 3; p++) {
        double ratio = evaluations_for(problems[p], "dop853")
                       / evaluations_for(problems[p], "rk8pd");

        if (!(ratio > 0.6 && ratio < 1.5))
            fail_msg("%s: %g times the evaluations", problems[p]->name, ratio);
    }
}

static void
there_and_back_again(void **state)
{
    (void)state;
    for (int p = 0; p < 3; p++) {
        const problem *q = problems[p];
        qdot_ode_options o = {.tol = 1e-13};
        qdot_ode_result r;
        double y[4];

        memcpy(y, q->y0, sizeof y);
        assert_int_equal(qdot_ode_integrate(&q->system, dop853(), &o, 0, -7, y, &r),
                         QDOT_OK);
        assert_true(true_error(q, -7, y) < 1e-11);
        assert_int_equal(qdot_ode_integrate(&q->system, dop853(), &o, -7, 0, y, &r),
                         QDOT_OK);
        assert_true(r.t == 0);
        for (size_t i = 0; i < q->system.n; i++)
            assert_true(fabs(y[i] - q->y0[i]) < 1e-10);
    }
}

static qdot_status
until_two(double t, const double *y, double *dydt, void *user)
{
    (void)user;
    dydt[0] = y[0];
    return t <= 2 ? QDOT_OK : qdot_fail(QDOT_EDOMAIN, "nothing beyond two");
}

static void
a_failure_says_where_and_keeps_the_run(void **state)
{
    qdot_ode_system pole = {.n = 1, .rhs = square}, edge = {.n = 1, .rhs = until_two};
    qdot_trajectory tr = {0};
    double one = 1, y;

    (void)state;
    assert_int_equal(qdot_trajectory_run(&tr, &pole, dop853(), NULL, 0, 3, &one),
                     QDOT_EFAILED);
    assert_true(fabs(tr.result.t - 1) < 1e-9);
    assert_non_null(strstr(tr.result.reason, "stopped at t = "));
    assert_int_equal(qdot_trajectory_at(&tr, &pole, 0.875, &y), QDOT_OK);
    assert_true(fabs(y - 8) < 1e-9);

    assert_int_equal(qdot_trajectory_run(&tr, &edge, dop853(), NULL, 0, 3, &one),
                     QDOT_EFAILED);
    assert_true(fabs(tr.result.t - 2) < 1e-13 && tr.result.t <= 2);
    assert_non_null(strstr(tr.result.reason, "nothing beyond two"));
    assert_int_equal(qdot_trajectory_at(&tr, &edge, tr.result.t / 2, &y), QDOT_OK);
    assert_true(fabs(y - exp(tr.result.t / 2)) < 1e-10);
    qdot_trajectory_clear(&tr);
}

/* --- between the points ------------------------------------------------------------ */

/* No time in a step errs more than its ends do, by a fifth of the tolerance (and the
 * rounding of the state). */
static void
the_polynomial_is_as_accurate_as_the_run(void **state)
{
    (void)state;
    for (int p = 0; p < 3; p++)
        for (double tol = 1e-7; tol > 1e-15; tol /= 10) {
            const problem *q = problems[p];
            const size_t n = q->system.n;
            qdot_ode_options o = {.tol = tol};
            qdot_trajectory tr = {0};
            qdot_trajectory_cursor *cursor;

            assert_int_equal(qdot_trajectory_run(&tr, &q->system, dop853(), &o, 0,
                                                 p == 1 ? -9 : 9, q->y0),
                             QDOT_OK);
            assert_int_equal(qdot_trajectory_open(&tr, &q->system, &cursor), QDOT_OK);
            for (size_t k = 0; k + 1 < tr.count; k++) {
                double ends = fmax(true_error(q, tr.t[k], tr.y + n * k),
                                   true_error(q, tr.t[k + 1], tr.y + n * (k + 1)));

                for (int i = 1; i < 8; i++) {
                    double t = tr.t[k] + (tr.t[k + 1] - tr.t[k]) * i / 8, y[4], error;

                    assert_int_equal(qdot_trajectory_read(cursor, t, y), QDOT_OK);
                    error = true_error(q, t, y);
                    if (error > ends + 0.2 * tol + 4e-15)
                        fail_msg("%s, tol %g, t = %g: %g between %g", q->name, tol, t,
                                 error, ends);
                }
            }
            qdot_trajectory_close(cursor);
            qdot_trajectory_clear(&tr);
        }
}

static uint64_t calls;

static qdot_status
counted(double t, const double *y, double *dydt, void *user)
{
    calls++;
    return pendulum_rhs(t, y, dydt, user);
}

/* Sixteen evaluations for either half of a step, however much is asked in it. */
static void
many_questions_cost_what_one_does(void **state)
{
    qdot_ode_system system = {.n = 2, .rhs = counted};
    qdot_trajectory tr = {0};
    qdot_trajectory_cursor *cursor;
    double y[2];

    (void)state;
    assert_int_equal(
        qdot_trajectory_run(&tr, &system, dop853(), NULL, 0, 3, pendulum.y0), QDOT_OK);
    assert_int_equal(qdot_trajectory_open(&tr, &system, &cursor), QDOT_OK);
    calls = 0;
    for (int i = 0; i <= 30000; i++)
        assert_int_equal(qdot_trajectory_read(cursor, 3.0 * i / 30000, y), QDOT_OK);
    assert_int_equal(calls, 2 * 16 * (tr.count - 1));
    qdot_trajectory_close(cursor);
    qdot_trajectory_clear(&tr);
}

/* Whatever was asked before, and across a step of fixed size far too large. */
static void
an_answer_does_not_depend_on_the_questions(void **state)
{
    (void)state;
    srand(3);
    for (int fixed = 0; fixed < 2; fixed++) {
        qdot_ode_options o = {.tol = 1e-13, .h_fixed = fixed ? 2 : 0};
        qdot_trajectory tr = {0};
        qdot_trajectory_cursor *cursor;
        double y[2], z[2];

        assert_int_equal(qdot_trajectory_run(&tr, &pendulum.system, dop853(), &o, 0, 4,
                                             pendulum.y0),
                         QDOT_OK);
        assert_int_equal(qdot_trajectory_open(&tr, &pendulum.system, &cursor), QDOT_OK);
        for (int i = 0; i < 400; i++) {
            double t = i % 2 ? 4.0 * rand() / RAND_MAX : i * 0.01;

            assert_int_equal(qdot_trajectory_read(cursor, t, y), QDOT_OK);
            assert_int_equal(qdot_trajectory_at(&tr, &pendulum.system, t, z), QDOT_OK);
            assert_memory_equal(y, z, sizeof y);
            if (fixed && t < 2)
                assert_true(true_error(&pendulum, t, y) < 1e-12);
        }
        qdot_trajectory_close(cursor);
        qdot_trajectory_clear(&tr);
    }
}

static void
every_failed_allocation_is_told(void **state)
{
    (void)state;
    failed_allocations_are_told(dop853());
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_table_satisfies_its_conditions),
        cmocka_unit_test(the_order_is_eight),
        cmocka_unit_test(polynomial_and_ratio_go_as_the_eighth_power),
        cmocka_unit_test(the_last_stage_is_the_next_first),
        cmocka_unit_test(it_costs_about_what_rk8pd_costs),
        cmocka_unit_test(there_and_back_again),
        cmocka_unit_test(a_failure_says_where_and_keeps_the_run),
        cmocka_unit_test(the_polynomial_is_as_accurate_as_the_run),
        cmocka_unit_test(many_questions_cost_what_one_does),
        cmocka_unit_test(an_answer_does_not_depend_on_the_questions),
        cmocka_unit_test(every_failed_allocation_is_told),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
