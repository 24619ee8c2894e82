/* test_function.c -- expressions compiled for many values of their variables. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "qdot.h"

static const char pendulum[] = "param m, l, g > 0\n"
                               "coord theta\n"
                               "particle bob mass m at (l*sin(theta), -l*cos(theta))\n"
                               "gravity (0, -g)\n"
                               "set m = 2, l = 3, g = 9.81\n";

static int
begin(void **state)
{
    qdot_system *s;

    if (qdot_system_new(&s) != QDOT_RESULT_OK)
        return 1;
    *state = s;
    return qdot_system_declare(s, pendulum) != QDOT_RESULT_OK;
}

static int
end(void **state)
{
    qdot_system_free(*state);
    return 0;
}

static qdot_function *
compiled(qdot_system *s, const char *expressions, const char *variables)
{
    qdot_function *f;

    if (qdot_system_compile(s, expressions, variables, &f) != QDOT_RESULT_OK)
        fail_msg("%s", qdot_system_error(s));
    return f;
}

static void
values_are_those_of_the_formulas(void **state)
{
    qdot_function *f = compiled(*state, "T, V, accel[theta], l*theta", "theta, theta', l");
    enum { N = 1000 };
    double in[N][3], out[N][4];

    assert_int_equal(qdot_function_inputs(f), 3);
    assert_int_equal(qdot_function_outputs(f), 4);
    for (int i = 0; i < N; i++)
        in[i][0] = i * 0.01 - 3, in[i][1] = 2 - i * 0.003, in[i][2] = 1 + i * 0.002;
    assert_int_equal(qdot_function_values(f, N, in[0], out[0]), QDOT_RESULT_OK);
    for (int i = 0; i < N; i++) {
        const double theta = in[i][0], w = in[i][1], l = in[i][2];
        const double wanted[] = {l * l * w * w, -2 * 9.81 * l * cos(theta), -9.81 / l * sin(theta), l * theta};

        for (int k = 0; k < 4; k++)
            assert_true(fabs(out[i][k] - wanted[k]) <= 1e-13 * (1 + fabs(wanted[k])));
    }
    qdot_function_free(f);
}

static void
momenta_are_variables_or_follow(void **state)
{
    qdot_system *s = *state;
    qdot_function *in_p = compiled(s, "H", "theta, p[theta]"), *in_v = compiled(s, "H", "theta, theta'");
    const double p[] = {0.5, 7}, v[] = {0.5, 7. / 18};
    double a, b;

    assert_int_equal(qdot_function_values(in_p, 1, p, &a), QDOT_RESULT_OK);
    assert_int_equal(qdot_function_values(in_v, 1, v, &b), QDOT_RESULT_OK);
    assert_true(fabs(a - b) < 1e-13 * fabs(a));
    assert_true(fabs(a - (49. / 36 - 2 * 9.81 * 3 * cos(0.5))) < 1e-12);
    qdot_function_free(in_p);
    qdot_function_free(in_v);
}

static void
what_is_undefined_is_no_number(void **state)
{
    qdot_function *f = compiled(*state, "[1/theta, log(theta), sqrt(theta), if(theta > 0, 1/theta, 2)]", "theta");
    const double in[] = {0, -1, 4};
    double out[12];

    assert_int_equal(qdot_function_values(f, 3, in, out), QDOT_RESULT_OK);
    assert_true(isnan(out[0]) && isnan(out[1]) && out[2] == 0 && out[3] == 2);
    assert_true(out[4] == -1 && isnan(out[5]) && isnan(out[6]) && out[7] == 2);
    assert_true(out[8] == 0.25 && out[10] == 2 && out[11] == 0.25);
    qdot_function_free(f);
    f = compiled(*state, "mass_matrix, 2*m", "");
    assert_int_equal(qdot_function_inputs(f), 0);
    assert_int_equal(qdot_function_values(f, 2, NULL, out), QDOT_RESULT_OK);
    assert_true(out[0] == 18 && out[1] == 4 && out[2] == 18 && out[3] == 4);
    assert_int_equal(qdot_function_values(f, 0, NULL, NULL), QDOT_RESULT_OK);
    assert_int_equal(qdot_function_values(f, 1, NULL, NULL), QDOT_RESULT_INVALID);
    assert_int_equal(qdot_function_values(NULL, 0, NULL, NULL), QDOT_RESULT_INVALID);
    qdot_function_free(f);
    qdot_function_free(NULL);
}

static void
expect_failure(qdot_system *s, const char *expressions, const char *variables, qdot_result wanted, const char *begins)
{
    qdot_function *f = (qdot_function *)(void *)s;

    assert_int_equal(qdot_system_compile(s, expressions, variables, &f), wanted);
    assert_null(f);
    if (strncmp(qdot_system_error(s), begins, strlen(begins)) != 0)
        fail_msg("the error is `%s`", qdot_system_error(s));
}

static void
errors_name_the_text(void **state)
{
    qdot_system *s = *state;

    assert_int_equal(qdot_system_declare(s, "param k"), QDOT_RESULT_OK);
    expect_failure(s, "T + k", "theta'", QDOT_RESULT_UNSET, "compile:1:1: error: ");
    assert_non_null(strstr(qdot_system_error(s), "parameter k has no value"));
    expect_failure(s, "T", "theta", QDOT_RESULT_UNSET, "compile:1:1: error: ");
    expect_failure(s, "T, eom", "theta'", QDOT_RESULT_TYPE, "compile:1:1: error: ");
    expect_failure(s, "T + nosuch", "theta'", QDOT_RESULT_NAME, "compile:1:5: error: ");
    expect_failure(s, "T", "theta', 2*m", QDOT_RESULT_TYPE, "variables:1:9: error: ");
    expect_failure(s, "T", "theta', theta'", QDOT_RESULT_INVALID, "variables:1:9: error: ");
    expect_failure(s, "T", "theta' l", QDOT_RESULT_SYNTAX, "variables:1:7: error: ");
    expect_failure(s, "T; V", "theta'", QDOT_RESULT_SYNTAX, "compile:1:4: error: ");
    expect_failure(s, NULL, "theta'", QDOT_RESULT_INVALID, "compile: the expressions are NULL");
    assert_int_equal(qdot_system_compile(NULL, "T", "", NULL), QDOT_RESULT_INVALID);
}

/* Whatever allocation fails, the call says so, and the system can be used again. */
static void
failing_memory_is_reported(void **state)
{
    qdot_system *s = *state;
    const double in[] = {0.5, 1};
    double out;

    for (long n = 0;; n += 1 + n / 50) {
        qdot_function *f;
        qdot_result result;

        qdot_memory_fail_at(n);
        result = qdot_system_compile(s, "T + sin(theta)/m", "theta, theta'", &f);
        qdot_memory_fail_at(-1);
        if (result == QDOT_RESULT_OK) {
            qdot_memory_fail_at(0);
            assert_int_equal(qdot_function_values(f, 1, in, &out), QDOT_RESULT_NO_MEMORY);
            qdot_memory_fail_at(-1);
            qdot_function_free(f);
            assert_true(n > 20);
            return;
        }
        assert_int_equal(result, QDOT_RESULT_NO_MEMORY);
        assert_null(f);
    }
}

static void *
evaluate(void *data)
{
    double in[200], out[100];

    for (int i = 0; i < 200; i++)
        in[i] = i;
    for (int k = 0; k < 200; k++)
        if (qdot_function_values(data, 100, in, out) != QDOT_RESULT_OK || !(fabs(out[5] - 9. * 11 * 11) < 1e-9))
            return NULL;
    return data;
}

/* A function is used by two threads, and outlives its system. */
static void
functions_are_shared(void **state)
{
    qdot_system *s;
    qdot_function *f;
    pthread_t thread[2];
    void *done[2];

    (void)state;
    assert_int_equal(qdot_system_new(&s), QDOT_RESULT_OK);
    assert_int_equal(qdot_system_declare(s, pendulum), QDOT_RESULT_OK);
    f = compiled(s, "T", "theta, theta'");
    qdot_system_free(s);
    for (int i = 0; i < 2; i++)
        assert_int_equal(pthread_create(&thread[i], NULL, evaluate, f), 0);
    for (int i = 0; i < 2; i++)
        assert_int_equal(pthread_join(thread[i], &done[i]), 0);
    assert_true(done[0] == f && done[1] == f);
    qdot_function_free(f);
}

int
main(void)
{
#define IN_A_SCENE(test) cmocka_unit_test_setup_teardown(test, begin, end)
    const struct CMUnitTest tests[] = {
        IN_A_SCENE(values_are_those_of_the_formulas),
        IN_A_SCENE(momenta_are_variables_or_follow),
        IN_A_SCENE(what_is_undefined_is_no_number),
        IN_A_SCENE(errors_name_the_text),
        IN_A_SCENE(failing_memory_is_reported),
        cmocka_unit_test(functions_are_shared),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
