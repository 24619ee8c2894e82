/* test_text.c -- a table as aligned text. */
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <cmocka.h>

#include <math.h>
#include <string.h>

#include "base/interrupt.h"
#include "base/memory.h"
#include "base/utf8.h"
#include "table/text.h"

static qdot_status
text_write(size_t n, qdot_table_column *columns, size_t rows, int digits, qdot_text *out)
{
    const qdot_dataset t = {.n = n, .rows = rows, .columns = columns};
    const qdot_table_text_options options = {QDOT_IN_TXT, digits, ""};

    return qdot_table_text(&t, &options, out);
}

static void
columns_are_right_aligned_under_their_labels(void **state)
{
    const double t[] = {0, 0.1, 10}, x[] = {2, -1.25, 3.14159265358979};
    qdot_table_column columns[] = {{.name = "t", .gap = 2, .values = t}, {.name = "theta", .gap = 2, .values = x}};
    qdot_text out = {0};

    (void)state;
    assert_int_equal(text_write(2, columns, 3, 6, &out), QDOT_OK);
    assert_string_equal(qdot_text_str(&out), "  t    theta\n"
                                             "  0        2\n"
                                             "0.1    -1.25\n"
                                             " 10  3.14159\n");
    qdot_text_clear(&out);
}

/* A label of Greek letters takes as many columns as it has characters. */
static void
every_line_is_equally_wide(void **state)
{
    const double x[] = {1, 22, 333.5, -1e-300, NAN, -INFINITY};
    qdot_table_column columns[] = {
        {.name = "θ̇₁", .gap = 2, .values = x},
        {.name = "a long label of many letters that is wide", .gap = 2, .values = x},
        {.name = "φ", .gap = 2, .values = x}};
    qdot_text out = {0};
    size_t width = 0, lines = 0;

    (void)state;
    assert_int_equal(text_write(3, columns, 6, 17, &out), QDOT_OK);
    for (const char *at = out.at; *at != '\0'; lines++) {
        const char *end = strchr(at, '\n');
        size_t here;

        assert_non_null(end);
        here = qdot_utf8_columns(at, (size_t)(end - at));
        assert_true(lines == 0 || here == width);
        width = here;
        at = end + 1;
    }
    assert_int_equal(lines, 7);
    qdot_text_clear(&out);
}

static void
digits_are_those_asked_for(void **state)
{
    const double x[] = {2.0 / 3};
    qdot_table_column column = {.name = "x", .gap = 2, .values = x};
    qdot_text out = {0};

    (void)state;
    assert_int_equal(text_write(1, &column, 1, 3, &out), QDOT_OK);
    assert_string_equal(qdot_text_str(&out), "    x\n0.667\n");
    qdot_text_clear(&out);
}

static void
a_table_without_rows_is_its_header(void **state)
{
    qdot_table_column column = {.name = "energy", .gap = 2, .values = NULL};
    qdot_text out = {0};

    (void)state;
    assert_int_equal(text_write(1, &column, 0, 6, &out), QDOT_OK);
    assert_string_equal(qdot_text_str(&out), "energy\n");
    qdot_text_clear(&out);
    assert_int_equal(text_write(0, &column, 0, 6, &out), QDOT_EINVAL);
}

/* Widths, gaps, sides and forms are those of the columns; what people do not read is left out. */
static void
columns_say_how_they_look(void **state)
{
    const double tol[] = {1e-3, 1e-12}, x[] = {2.3849999, 1.5}, e[] = {2e-3, 3}, zero[] = {0, 2.5e-7}, yes[] = {1, NAN};
    char word[] = "gauss", *names[] = {word, NULL}, reason[] = "stopped", *why[] = {NULL, reason};
    qdot_table_column columns[] = {
        {.name = "method", .kind = QDOT_CELL_TEXT, .left = true, .width = 8, .texts = names, .absent = "?"},
        {.name = "tol", .form = QDOT_NUMBER_SCIENTIFIC, .width = 7, .values = tol},
        {.name = "x", .form = QDOT_NUMBER_MEASURED, .gap = 2, .values = x, .errors = e},
        {.name = "fixed", .form = QDOT_NUMBER_FIXED, .digits = 1, .gap = 2, .values = x},
        {.name = "err", .form = QDOT_NUMBER_SCIENTIFIC_OR_0, .digits = 1, .gap = 1, .values = zero},
        {.name = "bound", .head = "up to", .form = QDOT_NUMBER_BOUND, .gap = 1, .values = e},
        {.name = "hidden", .in = QDOT_IN_ANSWERS | QDOT_IN_DATA, .values = x},
        {.name = "is", .kind = QDOT_CELL_FLAG, .gap = 1, .values = yes},
        {.name = "", .kind = QDOT_CELL_TEXT, .left = true, .gap = 2, .texts = why},
    };
    const qdot_dataset t = {.n = sizeof columns / sizeof *columns, .rows = 2, .columns = columns};
    const qdot_table_text_options options = {QDOT_IN_TERMINAL, 0, "|"};
    qdot_text out = {0};

    (void)state;
    assert_int_equal(qdot_table_text(&t, &options, &out), QDOT_OK);
    assert_string_equal(qdot_text_str(&out), "method  |    tol|      x|  fixed|     err| up to|  is|  \n"
                                             "gauss   |  1e-03|  2.385|    2.4|       0| 0.002| yes|  \n"
                                             "?       |  1e-12|      -|    1.5| 2.5e-07|     3|   -|  stopped\n");
    qdot_text_clear(&out);
}

/* The lower triangle of a matrix: no blanks behind the last cell of a row. */
static void
a_row_ends_with_its_last_cell(void **state)
{
    const double x[] = {1, 2}, y[] = {NAN, 4};
    char none[] = "", *texts[] = {none, NULL};
    qdot_table_column columns[] = {{.name = "x", .values = x}, {.name = "y", .gap = 2, .values = y, .texts = texts}};
    qdot_text out = {0};

    (void)state;
    assert_int_equal(text_write(2, columns, 2, 0, &out), QDOT_OK);
    assert_string_equal(qdot_text_str(&out), "x  y\n1\n2  4\n");
    qdot_text_clear(&out);
}

static void
ctrl_c_stops_a_table(void **state)
{
    const double x[] = {1};
    qdot_table_column column = {.name = "x", .gap = 2, .values = x};
    qdot_text out = {0};

    (void)state;
    qdot_interrupt_set();
    assert_int_equal(text_write(1, &column, 1, 6, &out), QDOT_EINTR);
    qdot_interrupt_clear();
    qdot_text_clear(&out);
}

static void
no_memory_is_an_error(void **state)
{
    const double x[] = {1, 2};
    qdot_table_column column = {.name = "x", .gap = 2, .values = x};
    int64_t n = 0;

    (void)state;
    for (qdot_status status = QDOT_ENOMEM; status != QDOT_OK; n++) {
        qdot_text out = {0};

        qdot_memory_fail_at(n);
        status = text_write(1, &column, 2, 6, &out);
        qdot_memory_fail_at(-1);
        assert_true(status == QDOT_OK || status == QDOT_ENOMEM);
        qdot_text_clear(&out);
    }
    assert_true(n > 2);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(columns_are_right_aligned_under_their_labels),
        cmocka_unit_test(every_line_is_equally_wide),
        cmocka_unit_test(digits_are_those_asked_for),
        cmocka_unit_test(a_table_without_rows_is_its_header),
        cmocka_unit_test(columns_say_how_they_look),
        cmocka_unit_test(a_row_ends_with_its_last_cell),
        cmocka_unit_test(ctrl_c_stops_a_table),
        cmocka_unit_test(no_memory_is_an_error),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
