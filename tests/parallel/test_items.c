/* test_items.c -- items are handed out once, and again if they come back without an answer. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "parallel/items.h"

enum { ITEMS = 100 };

static void
expect(qdot_items_chunk chunk, size_t first, size_t count)
{
    assert_int_equal(chunk.count, count);
    if (count > 0)
        assert_int_equal(chunk.first, first);
}

static void
all_are_handed_out_but_those_skipped(void **state)
{
    bool skip[ITEMS] = {[3] = true, [4] = true, [ITEMS - 1] = true};
    qdot_items items;

    (void)state;
    assert_int_equal(qdot_items_new(&items, 1, ITEMS, skip, true), QDOT_OK);
    assert_int_equal(items.left, ITEMS - 4);
    expect(qdot_items_take(&items, 10), 1, 2);
    expect(qdot_items_take(&items, 0.5), 5, 1);
    expect(qdot_items_take(&items, 10), 6, 10);
    expect(qdot_items_take(&items, 1000), 16, ITEMS - 17);
    expect(qdot_items_take(&items, 1000), 0, 0);
    qdot_items_free(&items);
}

static void
what_has_no_answer_comes_again(void **state)
{
    qdot_items items;

    (void)state;
    assert_int_equal(qdot_items_new(&items, 0, ITEMS, NULL, true), QDOT_OK);
    expect(qdot_items_take(&items, ITEMS), 0, ITEMS);
    assert_true(qdot_items_answer(&items, 11));
    assert_true(qdot_items_answer(&items, 12));
    assert_false(qdot_items_answer(&items, 12));
    assert_false(qdot_items_answer(&items, ITEMS));
    assert_int_equal(items.left, ITEMS - 2);
    assert_int_equal(qdot_items_give(&items, (qdot_items_chunk){10, 5}), QDOT_OK);
    expect(qdot_items_take(&items, 1), 13, 1);
    expect(qdot_items_take(&items, 9), 14, 1);
    expect(qdot_items_take(&items, 9), 10, 1);
    expect(qdot_items_take(&items, 9), 0, 0);
    assert_true(qdot_items_survives(&items, 13));
    assert_false(qdot_items_survives(&items, 13));
    qdot_items_free(&items);
}

static void
others_begin_with_what_they_are_given(void **state)
{
    qdot_items items;

    (void)state;
    assert_int_equal(qdot_items_new(&items, 0, ITEMS, NULL, false), QDOT_OK);
    assert_int_equal(items.left, 0);
    expect(qdot_items_take(&items, 9), 0, 0);
    for (int times = 0; times < 2;
         times++) { /* the second after the first was thought lost */
        assert_int_equal(qdot_items_begin(&items, (qdot_items_chunk){20, 2}), QDOT_OK);
        assert_int_equal(items.left, 2);
        expect(qdot_items_take(&items, 9), 20, 2);
        assert_true(qdot_items_answer(&items, 20));
        assert_true(qdot_items_answer(&items, 21));
    }
    assert_int_equal(qdot_items_begin(&items, (qdot_items_chunk){ITEMS - 1, 2}), QDOT_OK);
    assert_int_equal(qdot_items_begin(&items, (qdot_items_chunk){5, SIZE_MAX}), QDOT_OK);
    expect(qdot_items_take(&items, 9), 0, 0);
    qdot_items_free(&items);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(all_are_handed_out_but_those_skipped),
        cmocka_unit_test(what_has_no_answer_comes_again),
        cmocka_unit_test(others_begin_with_what_they_are_given),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
