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
#include "table/csv.h"

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

static qdot_status
csv_write(size_t n, qdot_table_column *columns, size_t rows, const char *path)
{
    const qdot_dataset t = {.n = n, .rows = rows, .columns = columns};

    return qdot_table_csv(&t, path);
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
    qdot_table_column columns[] = {{.name = "t", .unit = "s", .values = t}, {.name = "theta'", .values = x}};
    char *text;

    (void)state;
    assert_int_equal(csv_write(2, columns, 2, "a.csv"), QDOT_OK);
    text = contents("a.csv");
    assert_string_equal(text, "t [s],theta'\n0,-2.25\n0.5,0.10000000000000001\n");
    free(text);
}

static void
doubles_read_back_bit_by_bit(void **state)
{
    double x[1000];
    qdot_table_column column = {.name = "x", .values = x};
    char *text, *at;

    (void)state;
    srand(7);
    for (int i = 0; i < 1000; i++)
        x[i] = ldexp((double)rand() / 3 - rand(), rand() % 400 - 200);
    assert_int_equal(csv_write(1, &column, 1000, "a.csv"), QDOT_OK);
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
    qdot_table_column columns[] = {{.name = "mass_matrix[a, b]", .values = x},
                                   {.name = "say \"so\"", .values = x},
                                   {.name = "two\nlines", .values = x},
                                   {.name = "θ₁", .values = x},
                                   {.name = "", .values = x}};
    char *text;

    (void)state;
    assert_int_equal(csv_write(5, columns, 1, "a.csv"), QDOT_OK);
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
    qdot_table_column column = {.name = "x", .values = x};
    char *text;

    (void)state;
    assert_int_equal(csv_write(1, &column, 3, "a.csv"), QDOT_OK);
    text = contents("a.csv");
    assert_string_equal(text, "x\nnan\ninf\n-inf\n");
    free(text);
}

/* Texts are quoted like labels; what has digits of its own, or fewer, or no number, is written so. */
static void
columns_say_how_their_cells_stand(void **state)
{
    const double x[] = {1e-9, NAN}, y[] = {1.0 / 3, NAN}, z[] = {0, 1};
    char seen[] = "a, \"b\"", digits[] = "0.1234567890123456789", *texts[] = {seen, NULL}, *many[] = {digits, NULL};
    qdot_table_column columns[] = {{.name = "tol", .values = x, .exact = 1, .blank = true},
                                   {.name = "y", .values = y},
                                   {.name = "hidden", .values = y, .in = QDOT_IN_FILES | QDOT_IN_TXT},
                                   {.name = "why", .kind = QDOT_CELL_TEXT, .texts = texts},
                                   {.name = "z", .values = z, .texts = many},
                                   {.name = "is", .kind = QDOT_CELL_FLAG, .values = z}};
    char *text;

    (void)state;
    assert_int_equal(csv_write(6, columns, 2, "a.csv"), QDOT_OK);
    text = contents("a.csv");
    assert_string_equal(text, "tol,y,why,z,is\n"
                              "1e-09,0.33333333333333331,\"a, \"\"b\"\"\",0.1234567890123456789,0\n"
                              ",nan,,1,1\n");
    free(text);
}

static void
a_file_that_cannot_be_written_is_an_error(void **state)
{
    static double x[100000];
    qdot_table_column column = {.name = "x", .values = x};

    (void)state;
    assert_int_equal(csv_write(1, &column, 1, "missing/a.csv"), QDOT_EIO);
    assert_non_null(strstr(qdot_last_error()->message, "missing/a.csv"));
    assert_non_null(strstr(qdot_last_error()->message, "No such file"));
    assert_int_equal(csv_write(1, &column, 1, "."), QDOT_EIO);
    assert_int_equal(csv_write(1, &column, 1, ""), QDOT_EINVAL);
    assert_int_equal(csv_write(0, &column, 1, "a.csv"), QDOT_EINVAL);
    if (access("/dev/full", W_OK) == 0) {
        /* a few bytes fail only when they are flushed, many while they are written */
        assert_int_equal(csv_write(1, &column, 1, "/dev/full"), QDOT_EIO);
        assert_non_null(strstr(qdot_last_error()->message, "No space left"));
        assert_int_equal(csv_write(1, &column, 100000, "/dev/full"), QDOT_EIO);
    }
}

static void
ctrl_c_stops_a_long_file(void **state)
{
    static double x[100000];
    qdot_table_column column = {.name = "x", .values = x};

    (void)state;
    qdot_interrupt_set();
    assert_int_equal(csv_write(1, &column, 100000, "a.csv"), QDOT_EINTR);
    qdot_interrupt_clear();
}

static void
no_memory_is_an_error(void **state)
{
    static double x[10];
    qdot_table_column column = {.name = "x", .values = x};
    int64_t n = 0;

    (void)state;
    for (qdot_status status = QDOT_ENOMEM; status != QDOT_OK; n++) {
        qdot_memory_fail_at(n);
        status = csv_write(1, &column, 10, "a.csv");
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
        cmocka_unit_test(columns_say_how_their_cells_stand),
        cmocka_unit_test(a_file_that_cannot_be_written_is_an_error),
        cmocka_unit_test(ctrl_c_stops_a_long_file),
        cmocka_unit_test(no_memory_is_an_error),
    };

    return cmocka_run_group_tests(tests, enter, leave);
}
