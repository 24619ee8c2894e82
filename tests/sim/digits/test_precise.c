/* test_precise.c -- runs with `digits`: against closed forms, and against reference
 * states of independent programs. */
#include "expr/build.h"
#include "expr/exact.h"
#include "expr/symbol.h"
#include "sim/scenes.h"

#include <math.h>
#include <mpfr.h>

#include "base/interrupt.h"
#include "base/memory.h"
#include "expr/constant.h"

static qdot_run *
run_digits(fixture *f, int digits)
{
    qdot_run *r;

    f->request.digits = digits;
    must(qdot_run_new(f->scene, &f->request, &r));
    assert_int_equal(qdot_run_get_report(r)->status, QDOT_RUN_DONE);
    assert_int_equal(qdot_run_get_report(r)->digits, digits);
    return r;
}

/* |e - expected| <= 10^-digits max(1, |expected|) / 2 */
static void
is_near(fixture *f, qdot_expr e, const char *expected, int digits, const char *what)
{
    mpfr_t x, y;

    mpfr_inits2((mpfr_prec_t)(4 * digits) + 64, x, y, (mpfr_ptr)0);
    must(qdot_constant_real(f->pool, e, x));
    assert_int_equal(mpfr_set_str(y, expected, 10, MPFR_RNDN), 0);
    mpfr_sub(x, x, y, MPFR_RNDN);
    mpfr_abs(x, x, MPFR_RNDN);
    mpfr_abs(y, y, MPFR_RNDN);
    if (mpfr_cmp_ui(y, 1) > 0)
        mpfr_div(x, x, y, MPFR_RNDN);
    mpfr_ui_pow_ui(y, 10, (unsigned)digits, MPFR_RNDN);
    mpfr_mul(x, x, y, MPFR_RNDN);
    if (mpfr_cmp_d(x, 0.5) > 0)
        fail_msg("%s is %.3g units of 10^-%d off", what, mpfr_get_d(x, MPFR_RNDN),
                 digits);
    mpfr_clears(x, y, (mpfr_ptr)0);
}

/* A mass on a line under V: x'' = -dV/dx. */
static void
line(fixture *f, qdot_expr (*potential)(fixture *f, qdot_expr x))
{
    qdot_expr x;

    begin(f);
    x = coordinate(f, "x");
    must(qdot_scene_particle(f->scene, "a", QDOT_ONE, x));
    must(qdot_scene_potential(f->scene, potential(f, x)));
    f->q0[0] = QDOT_ONE;
}

static qdot_expr
spring(fixture *f, qdot_expr x)
{
    return times(f, number(f, "0.5"), times(f, x, x));
}

static qdot_expr
free_fall(fixture *f, qdot_expr x)
{
    return times(f, number(f, "9.81"), x);
}

static qdot_expr
attraction(fixture *f, qdot_expr x)
{
    return qdot_neg(f->pool, qdot_pow_int(f->pool, x, -1));
}

static qdot_expr
sixth(fixture *f, qdot_expr x)
{
    return qdot_div(f->pool, qdot_pow_int(f->pool, x, 6), qdot_expr_int(f->pool, 6));
}

/* x = cos t to 60 digits, and to 300. */
static void
an_oscillator_is_a_cosine(void **state)
{
    static const int digits[] = {5, 60, 300};

    (void)state;
    for (size_t i = 0; i < sizeof digits / sizeof *digits; i++) {
        fixture f;
        qdot_run *r;
        mpfr_t c;
        char *text;

        line(&f, spring);
        f.request.t1 = qdot_expr_int(f.pool, 20);
        r = run_digits(&f, digits[i]);
        mpfr_init2(c, 1200);
        mpfr_set_ui(c, 20, MPFR_RNDN);
        mpfr_cos(c, c, MPFR_RNDN);
        mpfr_asprintf(&text, "%.320Rf", c);
        is_near(&f, qdot_run_get_report(r)->exact[0], text, digits[i], "x");
        assert_true(qdot_run_get_report(r)->error <= 0.5 * pow(10, -digits[i]));
        assert_true(qdot_run_get_report(r)->energy_drift <= pow(10, -digits[i]));
        mpfr_free_str(text);
        mpfr_clear(c);
        qdot_run_free(r);
        end(&f);
    }
}

/* t1 is no double, and the run goes back. */
static void
limits_are_exact(void **state)
{
    fixture f;
    qdot_run *r;
    qdot_expr x, t, value, error_free;
    double error;

    (void)state;
    line(&f, spring);
    f.request.t1 = qdot_mul(f.pool, qdot_expr_int(f.pool, -2), QDOT_PI);
    r = run_digits(&f, 40);
    is_near(&f, qdot_run_get_report(r)->exact[0], "1", 40, "x after a turn back");
    is_near(&f, qdot_run_get_report(r)->exact[1], "0", 40, "x' after a turn back");
    x = f.scene->coordinates.at[0];
    t = qdot_div(f.pool, QDOT_PI, qdot_expr_int(f.pool, -3));
    must(qdot_run_exact_values(r, 1, &x, t, &value, &error));
    is_near(&f, value, "0.5", 40, "x after a sixth");
    assert_true(error <= 1e-40);
    must(qdot_run_exact_values(r, 1, &x, f.request.t1, &value, &error));
    is_near(&f, value, "1", 40, "x at the end");
    error_free = qdot_symbol_jet(f.pool, x, 2);
    must(qdot_run_exact_values(r, 1, &error_free, QDOT_ZERO, &value, NULL));
    is_near(&f, value, "-1", 40, "x'' at the start");
    assert_int_equal(qdot_run_exact_values(r, 1, &x, QDOT_ONE, &value, &error),
                     QDOT_EDOMAIN);
    qdot_run_free(r);
    end(&f);
}

/* Few terms, and a series of which five of six vanish. */
static void
series_that_vanish_are_no_trap(void **state)
{
    fixture f;
    qdot_run *r;
    mpfr_t x;
    qdot_expr energy;

    (void)state;
    line(&f, free_fall);
    f.request.t1 = qdot_expr_int(f.pool, 3);
    r = run_digits(&f, 30);
    is_near(&f, qdot_run_get_report(r)->exact[0], "-43.145", 30, "x");
    assert_true(qdot_run_get_report(r)->steps <= 2);
    qdot_run_free(r);
    end(&f);
    line(&f, sixth);
    f.q0[0] = QDOT_ZERO;
    f.v0[0] = QDOT_ONE;
    f.request.t1 = qdot_expr_int(f.pool, 30);
    r = run_digits(&f, 30);
    energy = qdot_add(
        f.pool,
        qdot_div(f.pool,
                 qdot_pow_int(f.pool, qdot_run_get_report(r)->exact[0], 6),
                 qdot_expr_int(f.pool, 6)),
        times(&f, number(&f, "0.5"),
              qdot_pow_int(f.pool, qdot_run_get_report(r)->exact[1], 2)));
    mpfr_init2(x, 200);
    must(qdot_constant_real(f.pool, energy, x));
    is_near(&f, energy, "0.5", 29, "energy");
    mpfr_clear(x);
    qdot_run_free(r);
    end(&f);
}

/* The double pendulum, both at 2, to t = 20: amplification 3e9. The state by two ways:
 * d'Alembert's form at order 50 with 200 bits, Hamilton's equations at order 64 with 256,
 * written by other programs. */
static void
chaos_costs_digits_and_no_more(void **state)
{
    static const char *const end_state[] = {"0.133111040953328817939262694662709852",
                                            "-30.1557294122864487190611617459844257",
                                            "3.89291541526231009092919779359643687",
                                            "4.79927331658368108417393975366604120"};
    fixture f;
    qdot_run *r;

    (void)state;
    chain(&f, 2);
    f.q0[0] = f.q0[1] = qdot_expr_int(f.pool, 2);
    f.request.t1 = qdot_expr_int(f.pool, 20);
    r = run_digits(&f, 30);
    for (size_t i = 0; i < 4; i++)
        is_near(&f, qdot_run_get_report(r)->exact[i], end_state[i], 30, "a component");
    /* carried: the digits asked for and those that the motion eats */
    assert_true(qdot_run_get_report(r)->tol < 1e-39);
    qdot_run_free(r);
    end(&f);
}

/* Values as doubles, along the whole run, are those of the precise one. */
static void
doubles_are_its_rounding(void **state)
{
    const double times[] = {0, 0.1, 1.7, 3.0, 9.99, 10};
    double values[6], errors[6];
    fixture f;
    qdot_run *r;
    qdot_expr x;

    (void)state;
    line(&f, spring);
    f.request.t1 = qdot_expr_int(f.pool, 10);
    r = run_digits(&f, 25);
    x = f.scene->coordinates.at[0];
    must(qdot_run_values(r, 1, &x, 6, times, values, errors));
    for (size_t i = 0; i < 6; i++) {
        assert_true(fabs(values[i] - cos(times[i])) <= 3e-16);
        assert_true(errors[i] >= 0 && errors[i] <= 2e-16);
    }
    qdot_run_free(r);
    end(&f);
}

/* Two masses meet: where and when is said, the run so far kept. */
static void
a_singularity_is_told(void **state)
{
    fixture f;
    qdot_run *r;
    const qdot_run_report *report;

    (void)state;
    line(&f, attraction);
    f.request.t1 = qdot_expr_int(f.pool, 2);
    f.request.digits = 20;
    must(qdot_run_new(f.scene, &f.request, &r));
    report = qdot_run_get_report(r);
    assert_int_equal(report->status, QDOT_RUN_FAILED);
    /* x = 1 at rest falls into 0 in pi/(2 sqrt 2) */
    assert_true(fabs(report->t1 - 1.1107207345395915) < 1e-3);
    assert_non_null(strstr(report->reason, "t = 1.11"));
    qdot_run_free(r);
    end(&f);
}

static void
a_domain_left_is_told(void **state)
{
    fixture f;
    qdot_run *r;
    qdot_expr x;
    const qdot_run_report *report;

    (void)state;
    line(&f, spring);
    x = f.scene->coordinates.at[0];
    qdot_symbol_domain(f.pool, x, QDOT_ZERO, true, QDOT_NIL, true);
    f.request.t1 = qdot_expr_int(f.pool, 3);
    f.request.digits = 20;
    must(qdot_run_new(f.scene, &f.request, &r));
    report = qdot_run_get_report(r);
    assert_int_equal(report->status, QDOT_RUN_FAILED);
    assert_non_null(strstr(report->reason, "x left its domain"));
    assert_true(fabs(report->t1 - M_PI / 2) < 1e-15);
    assert_true(report->q[0] >= 0 && report->q[0] < 1e-15);
    assert_true(report->error < 1e-19);
    qdot_run_free(r);
    end(&f);
}

static void
what_cannot_be_is_refused(void **state)
{
    fixture f;
    qdot_run *r;

    (void)state;
    line(&f, spring);
    f.request.digits = 100000;
    assert_int_equal(qdot_run_new(f.scene, &f.request, &r), QDOT_EINVAL);
    f.request.digits = -1;
    assert_int_equal(qdot_run_new(f.scene, &f.request, &r), QDOT_EINVAL);
    f.request.digits = 20;
    f.request.method = "rk8pd";
    assert_int_equal(qdot_run_new(f.scene, &f.request, &r), QDOT_EINVAL);
    assert_non_null(strstr(qdot_last_error()->message, "rk8pd"));
    f.request.method = "auto";
    f.request.t1 = parameter(&f, "T");
    assert_int_equal(qdot_run_new(f.scene, &f.request, &r), QDOT_EUNSET);
    f.request.t1 = QDOT_ONE;
    qdot_interrupt_set();
    assert_int_equal(qdot_run_new(f.scene, &f.request, &r), QDOT_EINTR);
    qdot_interrupt_clear();
    qdot_run_free(r);
    end(&f);
}

static void
a_spring(fixture *f)
{
    line(f, spring);
}

/* The same, which turns round at 1/2. */
static void
a_rebound(fixture *f)
{
    qdot_event wall = {.name = (char *)"wall", .right = QDOT_HALF};
    qdot_expr x, v;

    line(f, spring);
    x = f->scene->coordinates.at[0];
    v = velocity(f, x);
    wall.left = x;
    must(qdot_vec_push(&wall.targets, v));
    must(qdot_vec_push(&wall.values, qdot_neg(f->pool, v)));
    must(qdot_scene_event(f->scene, &wall));
    qdot_free(wall.targets.at);
    qdot_free(wall.values.at);
}

/* Out of memory at the n-th allocation of a run, for n up to where it passes, `most` at the
 * highest; past every `thin` of them n goes on by one more. */
static void
survives(void (*scene)(fixture *), int digits, int64_t thin, int64_t most)
{
    for (int64_t n = 0;; n += 1 + n / thin) {
        fixture f;
        qdot_run *r = NULL;
        qdot_status status;

        scene(&f);
        f.request.digits = digits;
        qdot_memory_fail_at(n);
        status = qdot_run_new(f.scene, &f.request, &r);
        qdot_memory_fail_at(-1);
        if (status != QDOT_OK)
            assert_int_equal(status, QDOT_ENOMEM);
        qdot_run_free(r);
        end(&f);
        if (status == QDOT_OK)
            break;
        if (n > most)
            fail_msg("still failing");
    }
}

static void
every_failed_allocation_is_survived(void **state)
{
    (void)state;
    survives(a_spring, 10, 20000, 20000);
    survives(a_rebound, 10, 200, 20000);
}

/* A bob on a rod from (3/5, -4/5) at rest. */
static void
on_a_rod(fixture *f)
{
    qdot_expr x, y;

    begin(f);
    x = coordinate(f, "x");
    y = coordinate(f, "y");
    must(qdot_scene_particle(f->scene, "a", QDOT_ONE, pair(f, x, y)));
    must(qdot_scene_gravity(f->scene, pair(f, QDOT_ZERO, number(f, "-9.81"))));
    must(qdot_scene_constraint(f->scene, "rod",
                               qdot_add(f->pool, times(f, x, x), times(f, y, y)),
                               QDOT_ONE));
    f->q0[0] = number(f, "0.6");
    f->q0[1] = number(f, "-0.8");
    f->request.digits = 20;
}

/* The rod stays as long as it is, the energy what it was, and the multiplier is what
 * Newton's law says: m a = -m g + 2 lambda r, so 2 lambda = r . a + g y at r . r = 1. */
static void
constraints_are_kept_to_all_digits(void **state)
{
    fixture f;
    qdot_run *r;
    qdot_expr x, y, lambda, asked[3], values[3], t;
    double errors[3];

    (void)state;
    on_a_rod(&f);
    f.request.t1 = t = qdot_expr_int(f.pool, 3);
    r = run_digits(&f, 20);
    x = f.scene->coordinates.at[0];
    y = f.scene->coordinates.at[1];
    lambda = qdot_run_get_report(r)->multipliers[0];
    asked[0] = qdot_add(f.pool, times(&f, x, x), times(&f, y, y));
    asked[1] = qdot_mech_energy(f.scene);
    /* r . a = -v . v */
    asked[2] = qdot_sub(
        f.pool, times(&f, qdot_expr_int(f.pool, 2), lambda),
        qdot_sub(f.pool, times(&f, number(&f, "9.81"), y),
                 qdot_add(f.pool, qdot_pow_int(f.pool, velocity(&f, x), 2),
                          qdot_pow_int(f.pool, velocity(&f, y), 2))));
    must(qdot_run_exact_values(r, 3, asked, t, values, errors));
    is_near(&f, values[0], "1", 20, "the length of the rod");
    is_near(&f, values[1], "-7.848", 20, "the energy");
    is_near(&f, values[2], "0", 20, "the multiplier");
    for (size_t i = 0; i < 3; i++)
        assert_true(errors[i] < 1e-19);
    assert_true(qdot_run_get_report(r)->constraint_drift < 1e-20);
    assert_true(qdot_run_get_report(r)->error < 1e-20);
    qdot_run_free(r);
    /* a start beside the rod is moved onto it, in all digits */
    f.q0[1] = number(&f, "-0.81");
    r = run_digits(&f, 20);
    t = QDOT_ZERO;
    must(qdot_run_exact_values(r, 1, asked, t, values, errors));
    is_near(&f, values[0], "1", 20, "the length of the rod at a start beside it");
    qdot_run_free(r);
    f.q0[1] = number(&f, "-0.8");
    f.request.treatment = QDOT_RUN_BAUMGARTE;
    assert_int_equal(qdot_run_new(f.scene, &f.request, &r), QDOT_EINVAL);
    end(&f);
}

static void
failed_allocations_with_constraints(void **state)
{
    (void)state;
    survives(on_a_rod, 5, 40, 100000);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(constraints_are_kept_to_all_digits),
        cmocka_unit_test(failed_allocations_with_constraints),
        cmocka_unit_test(an_oscillator_is_a_cosine),
        cmocka_unit_test(limits_are_exact),
        cmocka_unit_test(series_that_vanish_are_no_trap),
        cmocka_unit_test(chaos_costs_digits_and_no_more),
        cmocka_unit_test(doubles_are_its_rounding),
        cmocka_unit_test(a_singularity_is_told),
        cmocka_unit_test(a_domain_left_is_told),
        cmocka_unit_test(what_cannot_be_is_refused),
        cmocka_unit_test(every_failed_allocation_is_survived),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
