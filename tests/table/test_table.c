/* test_table.c -- cells where they are: in arrays of others, and in rows of a table's own. */
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <cmocka.h>

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "table/table.h"

/* A matrix row by row and fields of structs are columns by their strides; `order` picks rows. */
static void
cells_are_read_where_they_are(void **state)
{
    const double matrix[] = {1, 2, 3, 4, 5, 6};
    char a[] = "a", b[] = "b", *texts[] = {a, NULL, b, NULL};
    const size_t order[] = {1};
    qdot_table_column columns[] = {
        {.name = "second", .values = matrix + 1, .errors = matrix + 2, .stride = 3},
        {.name = "even", .kind = QDOT_CELL_TEXT, .texts = texts, .text_stride = 2, .absent = "none"},
        {.name = "is", .kind = QDOT_CELL_TEXT, .texts = texts, .text_stride = 1, .present = "yes", .absent = "no"}};
    qdot_dataset t = {.n = 3, .rows = 2, .columns = columns};

    (void)state;
    assert_true(qdot_table_at(&t, 0, 0).value == 2);
    assert_true(qdot_table_at(&t, 1, 0).value == 5);
    assert_true(qdot_table_at(&t, 1, 0).error == 6);
    assert_null(qdot_table_at(&t, 0, 0).text);
    assert_string_equal(qdot_table_at(&t, 1, 1).text, "b");
    assert_true(isnan(qdot_table_at(&t, 1, 1).value));
    assert_string_equal(qdot_table_at(&t, 0, 2).text, "yes");
    assert_string_equal(qdot_table_at(&t, 1, 2).text, "no");
    t.order = order;
    t.rows = 1;
    assert_true(qdot_table_at(&t, 0, 0).value == 5);
    assert_string_equal(qdot_table_at(&t, 0, 1).text, "b");
}

static const qdot_table_column own[] = {{.name = "x"}, {.name = "why", .kind = QDOT_CELL_TEXT, .absent = "-"}};

static void
add_rows(qdot_dataset *t, size_t n)
{
    for (size_t k = 0; k < n; k++) {
        qdot_text text = {0};

        qdot_table_add_number(t, (double)k, 0.5);
        qdot_text_format(&text, "row %zu", k);
        if (k % 2 == 0)
            qdot_table_add_written(t, &text);
        else
            qdot_table_add_text(t, NULL);
        qdot_text_clear(&text);
    }
}

static void
rows_of_its_own_are_added(void **state)
{
    enum { N = 1000 };
    qdot_dataset t = {.name = "own"};

    (void)state;
    assert_int_equal(qdot_table_begin(&t, 2, own), QDOT_OK);
    assert_int_equal(t.rows, 0);
    qdot_table_add_number(&t, 1, 0);
    assert_int_equal(t.rows, 0); /* a row is one when it is whole */
    qdot_table_add_text(&t, "x");
    assert_int_equal(t.rows, 1);
    add_rows(&t, N);
    assert_int_equal(t.rows, N + 1);
    for (size_t k = 0; k < N; k++) {
        const qdot_table_cell x = qdot_table_at(&t, k + 1, 0), why = qdot_table_at(&t, k + 1, 1);

        assert_true(x.value == (double)k && x.error == 0.5);
        assert_true(strncmp(why.text, k % 2 == 0 ? "row " : "-", 4) == 0);
    }
    assert_int_equal(qdot_table_status(&t), QDOT_OK);
    qdot_table_clear(&t);
    assert_null(t.columns);
}

static void
failing_memory_is_told_once(void **state)
{
    int64_t n = 0;

    (void)state;
    for (qdot_status status = QDOT_ENOMEM; status != QDOT_OK; n++) {
        qdot_dataset t = {0};

        qdot_memory_fail_at(n);
        status = qdot_table_begin(&t, 2, own);
        if (status == QDOT_OK) {
            add_rows(&t, 40);
            status = qdot_table_status(&t);
        }
        qdot_memory_fail_at(-1);
        assert_true(status == QDOT_OK || status == QDOT_ENOMEM);
        qdot_table_clear(&t);
    }
    assert_true(n > 4);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cells_are_read_where_they_are),
        cmocka_unit_test(rows_of_its_own_are_added),
        cmocka_unit_test(failing_memory_is_told_once),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
