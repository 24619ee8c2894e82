/* test_names.c -- the table of names: meanings, clashes, order, the nearest. */
#include "lang/reading.h"

static qdot_status
put(qdot_names *names, qdot_name_kind kind, const char *name, qdot_expr value)
{
    qdot_name entry = {.name = (char *)name,
                       .kind = kind,
                       .value = value,
                       .file = (char *)"a.lag",
                       .line = 3};

    return qdot_names_declare(names, &entry);
}

static void
declared_names_are_found_in_order(void **state)
{
    qdot_names *names = qdot_names_new();
    char name[32];

    (void)state;
    for (int i = 0; i < 1000; i++) {
        snprintf(name, sizeof name, "x%d", i);
        assert_int_equal(put(names, QDOT_NAME_PARAM, name, 10 + (qdot_expr)i), QDOT_OK);
    }
    for (int i = 0; i < 1000; i++) {
        snprintf(name, sizeof name, "x%d", i);
        assert_int_equal(qdot_names_find(names, name)->value, 10 + i);
        assert_string_equal(qdot_names_at(names, (size_t)i)->name, name);
    }
    assert_null(qdot_names_find(names, "x1000"));
    assert_null(qdot_names_at(names, 1000));
    for (int i = 0; i < 1000; i += 2) {
        snprintf(name, sizeof name, "x%d", i);
        qdot_names_remove(names, name);
    }
    assert_null(qdot_names_find(names, "x10"));
    assert_string_equal(qdot_names_at(names, 7)->name, "x15");
    assert_null(qdot_names_at(names, 500));
    qdot_names_free(names);
}

static void
what_is_bound_hides(void **state)
{
    qdot_names *names = qdot_names_new();

    (void)state;
    assert_int_equal(put(names, QDOT_NAME_PARAM, "k", 20), QDOT_OK);
    assert_int_equal(qdot_names_push(names, "k", 21), QDOT_OK);
    assert_int_equal(qdot_names_push(names, "k", 22), QDOT_OK);
    assert_int_equal(qdot_names_find(names, "k")->value, 22);
    assert_int_equal(qdot_names_find(names, "k")->kind, QDOT_NAME_INDEX);
    qdot_names_pop(names);
    assert_int_equal(qdot_names_find(names, "k")->value, 21);
    qdot_names_pop(names);
    assert_int_equal(qdot_names_find(names, "k")->value, 20);
    assert_int_equal(qdot_names_push(names, "t", 21), QDOT_ENAME);
    qdot_names_free(names);
}

static void
values_replace_values_only(void **state)
{
    qdot_names *names = qdot_names_new();

    (void)state;
    assert_int_equal(put(names, QDOT_NAME_VALUE, "R", 20), QDOT_OK);
    assert_int_equal(put(names, QDOT_NAME_VALUE, "R", 21), QDOT_OK);
    assert_int_equal(qdot_names_find(names, "R")->value, 21);
    assert_int_equal(put(names, QDOT_NAME_FUNCTION, "R", 22), QDOT_OK);
    assert_int_equal(put(names, QDOT_NAME_PARAM, "R", 22), QDOT_ENAME);
    assert_non_null(strstr(qdot_last_error()->message, "a.lag:3"));

    assert_int_equal(put(names, QDOT_NAME_PARAM, "m", 20), QDOT_OK);
    assert_int_equal(put(names, QDOT_NAME_PARAM, "m", 20), QDOT_OK);
    assert_int_equal(put(names, QDOT_NAME_VALUE, "m", 20), QDOT_ENAME);
    assert_int_equal(put(names, QDOT_NAME_COORD, "r", 20), QDOT_OK);
    assert_int_equal(put(names, QDOT_NAME_COORD, "r", 20), QDOT_ENAME);
    assert_non_null(strstr(qdot_last_error()->message, "already a coordinate"));
    qdot_names_free(names);
}

static void
family_and_plain_name_exclude_each_other(void **state)
{
    qdot_names *names = qdot_names_new();

    (void)state;
    assert_int_equal(put(names, QDOT_NAME_COORD, "theta[1]", 20), QDOT_OK);
    assert_int_equal(put(names, QDOT_NAME_COORD, "theta[2]", 21), QDOT_OK);
    assert_true(qdot_names_is_family(names, "theta"));
    assert_int_equal(put(names, QDOT_NAME_PARAM, "theta", 22), QDOT_ENAME);
    assert_int_equal(put(names, QDOT_NAME_PARAM, "A", 22), QDOT_OK);
    assert_int_equal(put(names, QDOT_NAME_VALUE, "A[1,2]", 22), QDOT_ENAME);
    qdot_names_remove(names, "theta[1]");
    assert_true(qdot_names_is_family(names, "theta"));
    qdot_names_remove(names, "theta[2]");
    assert_false(qdot_names_is_family(names, "theta"));
    assert_int_equal(put(names, QDOT_NAME_PARAM, "theta", 22), QDOT_OK);
    qdot_names_free(names);
}

static void
reserved_names_are_refused(void **state)
{
    static const char *const reserved[] = {
        "pi", "t", "dt", "and", "p[1]", "Q[1]", "lambda[1]", "delta[1]", "dr", "dx[1]"};
    qdot_names *names = qdot_names_new();

    (void)state;
    assert_int_equal(put(names, QDOT_NAME_PARAM, "dz", 20), QDOT_OK);
    assert_int_equal(put(names, QDOT_NAME_COORD, "r", 20), QDOT_OK);
    assert_int_equal(put(names, QDOT_NAME_COORD, "x[1]", 21), QDOT_OK);
    for (size_t i = 0; i < sizeof reserved / sizeof *reserved; i++)
        if (put(names, QDOT_NAME_PARAM, reserved[i], 22) != QDOT_ENAME)
            fail_msg("%s may be declared", reserved[i]);
    assert_int_equal(put(names, QDOT_NAME_COORD, "z", 23), QDOT_ENAME);
    assert_int_equal(put(names, QDOT_NAME_PARAM, "p", 22), QDOT_OK);
    assert_int_equal(put(names, QDOT_NAME_PARAM, "d", 22), QDOT_OK);
    qdot_names_free(names);
}

static void
nearest_is_by_edit_distance(void **state)
{
    static const char *const extra[] = {"diff", "simplify", "sin"};
    qdot_names *names = qdot_names_new();

    (void)state;
    assert_int_equal(put(names, QDOT_NAME_COORD, "theta", 20), QDOT_OK);
    assert_int_equal(put(names, QDOT_NAME_PARAM, "g", 20), QDOT_OK);
    assert_string_equal(qdot_names_nearest(names, "thta", 3, extra), "theta");
    assert_string_equal(qdot_names_nearest(names, "thtea", 3, extra), "theta");
    assert_string_equal(qdot_names_nearest(names, "Theta", 3, extra), "theta");
    assert_string_equal(qdot_names_nearest(names, "G", 3, extra), "g");
    assert_string_equal(qdot_names_nearest(names, "simplfy", 3, extra), "simplify");
    assert_null(qdot_names_nearest(names, "h", 3, extra));
    assert_null(qdot_names_nearest(names, "omega", 3, extra));
    assert_null(qdot_names_nearest(names, "", 3, extra));
    qdot_names_free(names);
}

static void
memory_may_run_out(void **state)
{
    (void)state;
    for (int64_t n = 0;; n++) {
        qdot_status status = QDOT_ENOMEM;
        qdot_names *names;

        assert_true(n < 1000);
        qdot_memory_fail_at(n);
        names = qdot_names_new();
        if (names != NULL)
            status = put(names, QDOT_NAME_COORD, "theta[1]", 20);
        if (status == QDOT_OK)
            status = put(names, QDOT_NAME_VALUE, "R", 20);
        if (status == QDOT_OK)
            status = put(names, QDOT_NAME_VALUE, "R", 21);
        if (status == QDOT_OK)
            status = qdot_names_push(names, "k", 20);
        qdot_memory_fail_at(-1);
        qdot_names_free(names);
        if (status == QDOT_OK)
            return;
        assert_int_equal(status, QDOT_ENOMEM);
    }
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(declared_names_are_found_in_order),
        cmocka_unit_test(what_is_bound_hides),
        cmocka_unit_test(values_replace_values_only),
        cmocka_unit_test(family_and_plain_name_exclude_each_other),
        cmocka_unit_test(reserved_names_are_refused),
        cmocka_unit_test(nearest_is_by_edit_distance),
        cmocka_unit_test(memory_may_run_out),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
