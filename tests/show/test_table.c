/* test_table.c -- columns as aligned text. */
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
#include "show/show.h"

static void
columns_are_right_aligned_under_their_labels(void **state)
{
    const double t[] = {0, 0.1, 10}, x[] = {2, -1.25, 3.14159265358979};
    const qdot_column columns[] = {{"t", t}, {"theta", x}};
    qdot_text out = {0};

    (void)state;
    assert_int_equal(qdot_table_text(2, columns, 3, 6, "", &out), QDOT_OK);
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
    const qdot_column columns[] = {
        {"θ̇₁", x}, {"a long label of many letters that is wide", x}, {"φ", x}};
    qdot_text out = {0};
    size_t width = 0, lines = 0;

    (void)state;
    assert_int_equal(qdot_table_text(3, columns, 6, 17, "", &out), QDOT_OK);
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
    const qdot_column column = {"x", x};
    qdot_text out = {0};

    (void)state;
    assert_int_equal(qdot_table_text(1, &column, 1, 3, "", &out), QDOT_OK);
    assert_string_equal(qdot_text_str(&out), "    x\n0.667\n");
    qdot_text_clear(&out);
}

static void
a_table_without_rows_is_its_header(void **state)
{
    const qdot_column column = {"energy", NULL};
    qdot_text out = {0};

    (void)state;
    assert_int_equal(qdot_table_text(1, &column, 0, 6, "", &out), QDOT_OK);
    assert_string_equal(qdot_text_str(&out), "energy\n");
    qdot_text_clear(&out);
    assert_int_equal(qdot_table_text(0, &column, 0, 6, "", &out), QDOT_EINVAL);
}

static void
ctrl_c_stops_a_table(void **state)
{
    const double x[] = {1};
    const qdot_column column = {"x", x};
    qdot_text out = {0};

    (void)state;
    qdot_interrupt_set();
    assert_int_equal(qdot_table_text(1, &column, 1, 6, "", &out), QDOT_EINTR);
    qdot_interrupt_clear();
    qdot_text_clear(&out);
}

static void
no_memory_is_an_error(void **state)
{
    const double x[] = {1, 2};
    const qdot_column column = {"x", x};
    long n = 0;

    (void)state;
    for (qdot_status status = QDOT_ENOMEM; status != QDOT_OK; n++) {
        qdot_text out = {0};

        qdot_memory_fail_at(n);
        status = qdot_table_text(1, &column, 2, 6, "", &out);
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
        cmocka_unit_test(ctrl_c_stops_a_table),
        cmocka_unit_test(no_memory_is_an_error),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
