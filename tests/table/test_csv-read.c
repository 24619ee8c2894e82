/* test_csv-read.c -- rows of numbers, however they are written; what is none has its place told. */
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "table/csv-read.h"

static void
reads(const char *text, size_t columns, size_t rows, const double *numbers)
{
    qdot_csv csv = {0};

    if (qdot_csv_read_text("x", text, strlen(text), &csv) != QDOT_OK)
        fail_msg("%s: %s", text, qdot_last_error()->message);
    assert_int_equal(csv.columns, columns);
    assert_int_equal(csv.rows, rows);
    for (size_t i = 0; i < columns * rows; i++)
        assert_true(csv.at[i] == numbers[i]);
    qdot_csv_clear(&csv);
}

/* Those of the first line of words, with their places; of the first row there are none. */
static void
names_are_kept(void **state)
{
    const char *text = "# measured\n t , \"theta'\"\ns, 1/s\n0, 1\n";
    qdot_csv csv = {0};

    (void)state;
    assert_int_equal(qdot_csv_read_text("x", text, strlen(text), &csv), QDOT_OK);
    assert_int_equal(csv.names.n, 2);
    assert_string_equal(csv.names.at[0].word, "t");
    assert_string_equal(csv.names.at[1].word, "theta'");
    assert_int_equal(csv.names.at[1].place.line, 2);
    assert_int_equal(csv.names.at[1].place.column, 7);
    qdot_csv_clear(&csv);
    assert_int_equal(qdot_csv_read_text("x", "0 1\n", 4, &csv), QDOT_OK);
    assert_int_equal(csv.names.n, 0);
    qdot_csv_clear(&csv);
}

/* Where the caller takes gaps, empty cells and words for missing numbers are NaN; else they are errors. */
static void
gaps_are_nan(void **state)
{
    static const char *const texts[] = {"t,x,y\n1,2,\n3,nan,4\n", "1;n/a;NaN\n;2;3\n"};

    (void)state;
    for (size_t i = 0; i < 2; i++) {
        qdot_csv csv = {.gaps = true};
        size_t missing = 0;

        assert_int_equal(qdot_csv_read_text("x", texts[i], strlen(texts[i]), &csv), QDOT_OK);
        assert_int_equal(csv.columns * csv.rows, 6);
        for (size_t k = 0; k < 6; k++)
            missing += csv.at[k] != csv.at[k];
        assert_int_equal(missing, i == 0 ? 2 : 3);
        qdot_csv_clear(&csv);
        assert_int_equal(qdot_csv_read_text("x", texts[i], strlen(texts[i]), &csv), QDOT_EINVAL);
        qdot_csv_clear(&csv);
    }
}

static void
tables(void **state)
{
    static const double n[] = {0, 1.5, 2, -3e-2};

    (void)state;
    reads("0,1.5\n2,-3e-2\n", 2, 2, n);
    reads("0,1.5\n2,-3e-2", 2, 2, n);
    reads("\xef\xbb\xbft,\"x, in m\"\r\ns,m\r\n\r\n0,1.5\r\n2,-3e-2\r\n", 2, 2, n);
    reads("t;x\n0;1.5\n2;-3E-2\n", 2, 2, n);
    reads("# t x\n  0 \t 1.5  # first\n% none\n\n2 -0.03\n", 2, 2, n);
    reads("0\t1.5\r2\t-.03\r", 2, 2, n);
    reads("\"0\", \"+1.5\"\n'2' , -3e-02\n", 2, 2, n);
    reads("0,1.5,\n2,-3e-2,\n", 2, 2, n); /* a comma ends each line */
    reads("0\n1.5\n2\n-.03\n", 1, 4, n);
    reads("theta_1 2nd\n0 1.5\n2 -.03\n", 2, 2, n); /* names may hold digits */
    reads("t [s];x\n0;1,5\n2;-3,0E-2\n", 2, 2, n); /* decimal commas */
    reads("0,0\t1,5\n2\t-,03\n", 2, 2, n);
    reads("0 1,5\n2 -0,03\n", 2, 2, n);
    reads("\"0\",\"1,5\"\n\"2\",\"-0,03\"\n", 2, 2, n);
    reads("0D0 1.5D+00\n2d0 -3D-2\n", 2, 2, n); /* Fortran */
}

static void
fails(const char *text, const char *message)
{
    qdot_csv csv = {0};

    assert_int_equal(qdot_csv_read_text("x", text, strlen(text), &csv), QDOT_EINVAL);
    if (strncmp(qdot_last_error()->message, message, strlen(message)) != 0)
        fail_msg("%s: %s", text, qdot_last_error()->message);
    qdot_csv_clear(&csv);
}

static void
places_of_errors(void **state)
{
    qdot_csv csv = {0};

    (void)state;
    fails("t,x\n0,1\n1,\n", "x:3:3: a number is missing");
    fails("t,x\n0,1\n,2\n", "x:3:1: a number is missing");
    fails("0,1\n1,2,3\n", "x:2:5: the row has more than the 2");
    fails("0,1,2\n1,2\n", "x:2:4: the row has 2 numbers, the first has 3");
    fails("0 1\n1 one\n", "x:2:3: `one` is not a number");
    fails("0,1\n1,nan\n", "x:2:3: `nan` is not a number");
    fails("0,inf\n", "x:1:3: `inf` is not a number");
    fails("0;1,5\n0.5;1\n", "x:2:1: `0.5` has a decimal point, numbers before it a decimal comma");
    fails("0;1.000,5\n", "x:1:3: `1.000,5` is not a number");
    fails("\xff\xfet", "x is a text in UTF-16");
    fails("0,0x10\n", "x:1:3: `0x10` is not a number");
    fails("0,1e999\n", "x:1:3: `1e999` is too large");
    fails("0,1\n\xce\xb8,1e\n", "x:2:1: `\xce\xb8` is not a number");
    fails("0,1\n2, 1e\n", "x:2:4: `1e` is not a number");
    fails("", "x has no row of numbers");
    fails("a,b\n# 1,2\n", "x has no row of numbers");
    assert_int_equal(qdot_csv_read_text("x", "1,2\n3,\0004\n", 9, &csv), QDOT_EINVAL);
    assert_string_equal(qdot_last_error()->message, "x:2:3: a byte 0: this is no text file");
    qdot_csv_clear(&csv);
    assert_int_equal(qdot_csv_read("/nonexistent/x.csv", &csv), QDOT_EIO);
    assert_int_equal(qdot_csv_read("/", &csv), QDOT_EIO);
    qdot_csv_clear(&csv);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tables),
        cmocka_unit_test(gaps_are_nan),
        cmocka_unit_test(places_of_errors),
        cmocka_unit_test(names_are_kept),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
