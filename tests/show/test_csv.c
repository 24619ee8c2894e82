/* test_csv.c -- comma-separated values read back as they were. */
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/interrupt.h"
#include "base/memory.h"
#include "show/show.h"

static char folder[] = "qdot-csv-XXXXXX";

static int
enter(void **state)
{
    (void)state;
    return mkdtemp(folder) != NULL && chdir(folder) == 0 ? 0 : -1;
}

static int
leave(void **state)
{
    (void)state;
    remove("a.csv");
    return chdir("..") == 0 && rmdir(folder) == 0 ? 0 : -1;
}

/* The file as a string; the caller frees it. */
static char *
contents(const char *path)
{
    FILE *f = fopen(path, "rb");
    char *text = calloc(1, 1 << 20);

    assert_non_null(f);
    assert_non_null(text);
    assert_true(fread(text, 1, (1 << 20) - 1, f) < (1 << 20) - 1);
    fclose(f);
    return text;
}

static void
file_holds_header_and_rows(void **state)
{
    const double t[] = {0, 0.5}, x[] = {-2.25, 0.1};
    const qdot_column columns[] = {{"t", t}, {"theta'", x}};
    char *text;

    (void)state;
    assert_int_equal(qdot_table_csv(2, columns, 2, "a.csv"), QDOT_OK);
    text = contents("a.csv");
    assert_string_equal(text, "t,theta'\n0,-2.25\n0.5,0.10000000000000001\n");
    free(text);
}

static void
doubles_read_back_bit_by_bit(void **state)
{
    double x[1000];
    qdot_column column = {"x", x};
    char *text, *at;

    (void)state;
    srand(7);
    for (int i = 0; i < 1000; i++)
        x[i] = ldexp((double)rand() / 3 - rand(), rand() % 400 - 200);
    assert_int_equal(qdot_table_csv(1, &column, 1000, "a.csv"), QDOT_OK);
    text = contents("a.csv");
    at = strchr(text, '\n') + 1;
    for (int i = 0; i < 1000; i++) {
        double back = strtod(at, &at);

        assert_memory_equal(&back, &x[i], sizeof back);
        assert_int_equal(*at++, '\n');
    }
    assert_int_equal(*at, '\0');
    free(text);
}

static void
labels_are_quoted_where_rfc_4180_asks(void **state)
{
    const double x[] = {1};
    const qdot_column columns[] = {{"mass_matrix[a, b]", x},
                                   {"say \"so\"", x},
                                   {"two\nlines", x},
                                   {"θ₁", x},
                                   {"", x}};
    char *text;

    (void)state;
    assert_int_equal(qdot_table_csv(5, columns, 1, "a.csv"), QDOT_OK);
    text = contents("a.csv");
    assert_string_equal(text,
                        "\"mass_matrix[a, b]\",\"say \"\"so\"\"\",\"two\nlines\",θ₁,\n"
                        "1,1,1,1,1\n");
    free(text);
}

static void
what_is_not_finite_is_said_in_words(void **state)
{
    const double x[] = {NAN, INFINITY, -INFINITY};
    const qdot_column column = {"x", x};
    char *text;

    (void)state;
    assert_int_equal(qdot_table_csv(1, &column, 3, "a.csv"), QDOT_OK);
    text = contents("a.csv");
    assert_string_equal(text, "x\nnan\ninf\n-inf\n");
    free(text);
}

static void
a_file_that_cannot_be_written_is_an_error(void **state)
{
    static double x[100000];
    const qdot_column column = {"x", x};

    (void)state;
    assert_int_equal(qdot_table_csv(1, &column, 1, "missing/a.csv"), QDOT_EIO);
    assert_non_null(strstr(qdot_last_error()->message, "missing/a.csv"));
    assert_non_null(strstr(qdot_last_error()->message, "No such file"));
    assert_int_equal(qdot_table_csv(1, &column, 1, "."), QDOT_EIO);
    assert_int_equal(qdot_table_csv(1, &column, 1, ""), QDOT_EINVAL);
    assert_int_equal(qdot_table_csv(0, &column, 1, "a.csv"), QDOT_EINVAL);
    if (access("/dev/full", W_OK) == 0) {
        /* a few bytes fail only when they are flushed, many while they are written */
        assert_int_equal(qdot_table_csv(1, &column, 1, "/dev/full"), QDOT_EIO);
        assert_non_null(strstr(qdot_last_error()->message, "No space left"));
        assert_int_equal(qdot_table_csv(1, &column, 100000, "/dev/full"), QDOT_EIO);
    }
}

static void
ctrl_c_stops_a_long_file(void **state)
{
    static double x[100000];
    const qdot_column column = {"x", x};

    (void)state;
    qdot_interrupt_set();
    assert_int_equal(qdot_table_csv(1, &column, 100000, "a.csv"), QDOT_EINTR);
    qdot_interrupt_clear();
}

static void
no_memory_is_an_error(void **state)
{
    static double x[10];
    const qdot_column column = {"x", x};
    long n = 0;

    (void)state;
    for (qdot_status status = QDOT_ENOMEM; status != QDOT_OK; n++) {
        qdot_memory_fail_at(n);
        status = qdot_table_csv(1, &column, 10, "a.csv");
        qdot_memory_fail_at(-1);
        assert_true(status == QDOT_OK || status == QDOT_ENOMEM);
    }
    assert_true(n > 1);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(file_holds_header_and_rows),
        cmocka_unit_test(doubles_read_back_bit_by_bit),
        cmocka_unit_test(labels_are_quoted_where_rfc_4180_asks),
        cmocka_unit_test(what_is_not_finite_is_said_in_words),
        cmocka_unit_test(a_file_that_cannot_be_written_is_an_error),
        cmocka_unit_test(ctrl_c_stops_a_long_file),
        cmocka_unit_test(no_memory_is_an_error),
    };

    return cmocka_run_group_tests(tests, enter, leave);
}
