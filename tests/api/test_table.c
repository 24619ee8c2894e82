/* test_table.c -- the tables of a system, column by column. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "qdot.h"

static const char scene[] = "param w = 2\n"
                            "coord x\n"
                            "lagrangian x'^2/2 - w^2*x^2/2\n"
                            "start x = 1\n";

static int
begin(void **state)
{
    qdot_system *s;

    if (qdot_system_new(&s) != QDOT_RESULT_OK)
        return 1;
    *state = s;
    return qdot_system_declare(s, scene) != QDOT_RESULT_OK;
}

static int
end(void **state)
{
    qdot_system_free(*state);
    return 0;
}

static qdot_table *
table_of(qdot_system *s, const char *name)
{
    qdot_table *t;

    if (qdot_system_table(s, name, &t) != QDOT_RESULT_OK)
        fail_msg("%s", qdot_system_error(s));
    return t;
}

static void
columns_have_numbers_and_errors(void **state)
{
    qdot_system *s = *state;
    qdot_table *t;

    assert_int_equal(qdot_system_declare(s, "sweep w = 1..3 count 5 run 0..2 : value(x, 2), value(x', 1)"), QDOT_RESULT_OK);
    assert_int_equal(qdot_system_declare(s, "sweep w = [1, 2] run 0..2 : value(x, 1) as other"), QDOT_RESULT_OK);
    t = table_of(s, "sweep1");
    assert_int_equal(qdot_table_rows(t), 5);
    assert_int_equal(qdot_table_columns(t), 3);
    assert_string_equal(qdot_table_column_name(t, 0), "w");
    assert_string_equal(qdot_table_column_name(t, 1), "value(x, 2)");
    assert_string_equal(qdot_table_column_unit(t, 1), "");
    for (int k = 0; k < 5; k++) {
        const double w = 1 + k * 0.5;

        assert_true(qdot_table_numbers(t, 0)[k] == w && qdot_table_errors(t, 0)[k] == 0);
        assert_true(fabs(qdot_table_numbers(t, 1)[k] - cos(2 * w)) <= qdot_table_errors(t, 1)[k] + 1e-15);
        assert_true(fabs(qdot_table_numbers(t, 2)[k] + w * sin(w)) <= qdot_table_errors(t, 2)[k] + 1e-15);
        assert_true(qdot_table_errors(t, 1)[k] > 0 && qdot_table_errors(t, 1)[k] < 1e-9);
    }
    assert_null(qdot_table_cell(t, 0, 0));
    assert_null(qdot_table_column_name(t, 3));
    assert_null(qdot_table_numbers(t, 3));
    qdot_table_free(t);
    t = table_of(s, NULL); /* the latest */
    assert_int_equal(qdot_table_rows(t), 2);
    qdot_table_free(t);
}

/* A table is a copy: it outlives the system, and says why rows failed. */
static void
rows_that_fail_say_why(void **state)
{
    qdot_system *s;
    qdot_table *t;

    (void)state;
    assert_int_equal(qdot_system_new(&s), QDOT_RESULT_OK);
    assert_int_equal(qdot_system_declare(s, "coord x\nparam k = 1\nlagrangian x'^2/2 + k*x^4\nstart x = 1\n"
                                            "sweep k = [-1, 1] run 0..5 : value(x, 5)"),
                     QDOT_RESULT_OK);
    t = table_of(s, NULL);
    qdot_system_free(s);
    assert_int_equal(qdot_table_columns(t), 3);
    assert_string_equal(qdot_table_column_name(t, 2), "reason");
    assert_null(qdot_table_numbers(t, 2));
    assert_string_equal(qdot_table_cell(t, 2, 0), "");
    assert_true(strlen(qdot_table_cell(t, 2, 1)) > 10);
    assert_null(qdot_table_cell(t, 2, 2));
    assert_true(isfinite(qdot_table_numbers(t, 1)[0]) && isnan(qdot_table_numbers(t, 1)[1]));
    qdot_table_free(t);
}

static void
what_is_missing_is_an_error(void **state)
{
    qdot_system *s = *state;
    qdot_table *t;

    assert_int_equal(qdot_system_table(s, NULL, &t), QDOT_RESULT_NAME);
    assert_string_equal(qdot_system_error(s), "table: no table has been made");
    assert_null(t);
    assert_int_equal(qdot_system_table(s, "sweep1", &t), QDOT_RESULT_NAME);
    assert_string_equal(qdot_system_error(s), "table:1:1: error: there is no table `sweep1`\n  sweep1\n  ^\n");
    assert_int_equal(qdot_system_table(s, "a b", &t), QDOT_RESULT_SYNTAX);
    assert_int_equal(qdot_system_table(s, NULL, NULL), QDOT_RESULT_INVALID);
    assert_int_equal(qdot_system_table(NULL, NULL, &t), QDOT_RESULT_INVALID);
    qdot_table_free(NULL);
    assert_int_equal(qdot_table_rows(NULL) + qdot_table_columns(NULL), 0);
    assert_int_equal(qdot_system_declare(s, "sweep w = [1, 2] run 0..1 : value(x, 1)"), QDOT_RESULT_OK);
    for (long n = 0;; n++) {
        qdot_result result;

        qdot_memory_fail_at(n);
        result = qdot_system_table(s, NULL, &t);
        qdot_memory_fail_at(-1);
        if (result == QDOT_RESULT_OK)
            break;
        assert_int_equal(result, QDOT_RESULT_NO_MEMORY);
        assert_null(t);
    }
    qdot_table_free(t);
}

int
main(void)
{
#define IN_A_SCENE(test) cmocka_unit_test_setup_teardown(test, begin, end)
    const struct CMUnitTest tests[] = {
        IN_A_SCENE(columns_have_numbers_and_errors),
        cmocka_unit_test(rows_that_fail_say_why),
        IN_A_SCENE(what_is_missing_is_an_error),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
