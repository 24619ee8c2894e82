/* test_taylor.c -- series against derivatives: coefficient k of e(t) is e^(k)(t)/k!. */
#include "tape/reference.h"
#include "series/kit.h"
#include "tape/smooth.h"

#include <string.h>

#include "expr/calculus.h"
#include "num/series.h"
#include "series/program.h"
#include "series/taylor-motion.h"

enum { ORDERS = 7 };

/* The program of a tape of t as that of a motion: t is the integral of what is solved for. */
static qdot_taylor *
solved_for(const qdot_tape *tape, qdot_motion *motion)
{
    const qdot_program_row in = 0;
    qdot_program_builder *b;
    qdot_program_row out;
    qdot_taylor *series;

    *motion = (qdot_motion){0};
    assert_int_equal(qdot_program_begin(1, 1, false, &motion->program, &b), QDOT_OK);
    qdot_program_append(b, tape, &in, &out);
    assert_int_equal(qdot_vec_push(&motion->program.outputs, out), QDOT_OK);
    assert_int_equal(qdot_motion_solve(motion,
                                       (qdot_motion_unknown){.row = QDOT_NO_ROW,
                                                             .once = in,
                                                             .twice = QDOT_NO_ROW},
                                       qdot_program_rate(b, out)),
                     QDOT_OK);
    assert_int_equal(qdot_motion_complete(motion, b, qdot_motion_end_block(motion)), QDOT_OK);
    assert_int_equal(qdot_taylor_of_motion(motion, false, ORDERS, 0, &series), QDOT_OK);
    qdot_taylor_set_unit(series, 1);
    return series;
}

/* The series of e about t = 0.25 against its derivatives; then again with the newest
 * coefficient of t brought in late, at every order. */
static void
series_is_right(fixture *f, qdot_expr e, const char *what)
{
    const double t0 = 0.25;
    const long double at = t0;
    qdot_expr input = QDOT_T, derivative = e;
    qdot_tape *tape;
    qdot_taylor *series, *late;
    qdot_motion motion;
    long double factorial = 1;

    assert_int_equal(qdot_tape_new(f->pool, 1, &input, 1, &e, &tape), QDOT_OK);
    assert_int_equal(taylor_of_tape(tape, ORDERS, &series), QDOT_OK);
    late = solved_for(tape, &motion);
    for (int k = 0; k <= ORDERS; k++) {
        reference_value r = reference(f->pool, derivative, 1, &input, &at);
        long double expected = r.v / factorial;
        double one = k == 1, seen;

        qdot_taylor_input(series, 0)[k] = k == 0 ? t0 : one;
        qdot_taylor_order(series, k);
        seen = qdot_taylor_output(series, 0)[k];
        if (!(fabsl(seen - expected) <= 1e-13L * (1 + fabsl(expected))))
            fail_msg("%s, order %d: %.17g, not %.17Lg", what, k, seen, expected);
        if (k == 0)
            qdot_taylor_input(late, 0)[0] = t0;
        qdot_taylor_stage(late, k - 1);
        if (k > 0)
            qdot_taylor_change(late, k - 1, &one);
        if (!(fabs(seen - qdot_taylor_output(late, 0)[k]) <= 1e-13 * (1 + fabs(seen))))
            fail_msg("%s, order %d corrected: %.17g, not %.17g", what, k,
                     qdot_taylor_output(late, 0)[k], seen);
        derivative = qdot_diff(f->pool, derivative, QDOT_T);
        factorial *= k + 1;
    }
    qdot_taylor_free(series);
    qdot_taylor_free(late);
    qdot_motion_clear(&motion);
    qdot_tape_free(tape);
}

static void
every_function_has_its_series(void **state)
{
    (void)state;
    check_functions(series_is_right);
}

static void
arithmetic_has_its_series(void **state)
{
    fixture f;
    qdot_expr s, c, e, half;

    (void)state;
    begin(&f);
    s = qdot_fun1(f.pool, QDOT_SIN, f.u);
    c = qdot_fun1(f.pool, QDOT_EXP, f.x);
    half = decimal(&f, "0.5");
    series_is_right(&f, qdot_mul(f.pool, s, c), "product");
    series_is_right(&f, qdot_div(f.pool, s, c), "quotient");
    series_is_right(&f, qdot_pow_int(f.pool, s, 2), "square");
    series_is_right(&f, qdot_pow_int(f.pool, f.u, -3), "inverse cube");
    series_is_right(&f, qdot_pow(f.pool, f.u, half), "root");
    series_is_right(&f, qdot_pow(f.pool, f.u, decimal(&f, "0.3")), "power");
    series_is_right(&f, qdot_pow(f.pool, f.u, f.x), "power to a power");
    e = qdot_add(f.pool, qdot_mul(f.pool, s, c), f.x);
    series_is_right(&f, qdot_sub(f.pool, e, qdot_mul(f.pool, c, c)), "sums");
    e = qdot_sub(f.pool, f.x, qdot_mul(f.pool, s, c));
    series_is_right(&f, qdot_mul(f.pool, decimal(&f, "-0.7"), e), "difference");
    series_is_right(&f, qdot_sub(f.pool, qdot_mul(f.pool, s, c), qdot_mul(f.pool, c, c)),
                    "difference of products");
    e = qdot_fun(f.pool, QDOT_ATAN2, 2, (qdot_expr[]){s, c});
    series_is_right(&f, e, "atan2");
    e = qdot_add(f.pool, qdot_fun1(f.pool, QDOT_SINH, s),
                 qdot_fun1(f.pool, QDOT_COSH, s));
    series_is_right(&f, e, "a pair from one argument");
    qdot_pool_free(f.pool);
}

static void
what_switches_is_refused_by_name(void **state)
{
    fixture f;
    qdot_expr input = QDOT_T, e;
    qdot_tape *tape;
    qdot_taylor *series;

    (void)state;
    begin(&f);
    e = qdot_fun1(f.pool, QDOT_ABS, qdot_sub(f.pool, f.x, QDOT_ONE));
    assert_int_equal(qdot_tape_new(f.pool, 1, &input, 1, &e, &tape), QDOT_OK);
    assert_int_equal(taylor_of_tape(tape, 5, &series), QDOT_ENOTBUILT);
    assert_non_null(strstr(qdot_last_error()->message, "abs"));
    assert_string_equal(qdot_program_hindrance(tape), "abs");
    assert_int_equal(
        qdot_taylor_of_program(&(qdot_program){0}, false, QDOT_SERIES_MOST + 1, &series),
        QDOT_EINVAL);
    qdot_tape_free(tape);
    qdot_pool_free(f.pool);
}

static void
constants_cost_no_convolution(void **state)
{
    fixture f;
    qdot_expr input = QDOT_T, e[2];
    qdot_tape *tape;
    qdot_taylor *series;

    (void)state;
    begin(&f);
    e[0] = qdot_fun1(f.pool, QDOT_SIN, f.x);
    e[1] = decimal(&f, "2.5");
    assert_int_equal(qdot_tape_new(f.pool, 1, &input, 2, e, &tape), QDOT_OK);
    assert_int_equal(taylor_of_tape(tape, 5, &series), QDOT_OK);
    assert_true(qdot_taylor_convolutions(series) == 2);
    assert_false(qdot_taylor_is_constant(series, 0));
    assert_true(qdot_taylor_is_constant(series, 1));
    qdot_taylor_free(series);
    qdot_tape_free(tape);
    qdot_pool_free(f.pool);
}

/* 9.81 and pi are no doubles: drawn over many times, their mean is far closer than
 * either neighbour. */
static void
constants_between_doubles_average_out(void **state)
{
    static const long double exact[] = {9.81L, M_PIl, -0.1L};
    enum { TIMES = 20000 };
    fixture f;
    qdot_expr input = QDOT_T, e[3];
    long double sum[3] = {0};
    qdot_tape *tape;
    qdot_taylor *series;

    (void)state;
    begin(&f);
    e[0] = decimal(&f, "9.81");
    e[1] = QDOT_PI;
    e[2] = qdot_neg(f.pool, decimal(&f, "0.1"));
    assert_int_equal(qdot_tape_new(f.pool, 1, &input, 3, e, &tape), QDOT_OK);
    assert_int_equal(taylor_of_tape(tape, 1, &series), QDOT_OK);
    for (int i = 0; i < TIMES; i++) {
        qdot_taylor_draw(series, 0.01 * i);
        for (size_t k = 0; k < 3; k++)
            sum[k] += qdot_taylor_output(series, k)[0] - exact[k];
    }
    for (size_t k = 0; k < 3; k++) {
        double nearest = (double)exact[k],
               spacing = nextafter(fabs(nearest), 99) - fabs(nearest);

        if (!(fabsl(sum[k] / TIMES) < 0.02L * spacing))
            fail_msg("constant %zu: off by %Lg of a spacing in the mean", k,
                     sum[k] / TIMES / spacing);
    }
    qdot_taylor_free(series);
    qdot_tape_free(tape);
    qdot_pool_free(f.pool);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_function_has_its_series),
        cmocka_unit_test(arithmetic_has_its_series),
        cmocka_unit_test(what_switches_is_refused_by_name),
        cmocka_unit_test(constants_cost_no_convolution),
        cmocka_unit_test(constants_between_doubles_average_out),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
