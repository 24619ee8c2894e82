/* test_memory.c -- allocation, its failing hook, growing arrays, the arena. */
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <string.h>
#include <cmocka.h>
#include <inttypes.h>

#include "base/memory-failure.h"
#include "base/memory.h"

static void
size_0_gives_a_block(void **state)
{
    void *a = qdot_malloc(0), *b = qdot_calloc(0, 8), *c = qdot_calloc(8, 0);

    (void)state;
    assert_non_null(a);
    assert_non_null(b);
    assert_non_null(c);
    a = qdot_realloc(a, 0);
    assert_non_null(a);
    qdot_free(a);
    qdot_free(b);
    qdot_free(c);
    qdot_free(NULL);
}

static void
copies_of_text_end_where_told(void **state)
{
    char *whole = qdot_strdup("theta"), *part = qdot_strndup("theta", 2);

    (void)state;
    assert_string_equal(whole, "theta");
    assert_string_equal(part, "th");
    qdot_free(whole);
    qdot_free(part);
}

static int visits;

static void
visit(void)
{
    if (++visits == 1)
        qdot_memory_visit_at(1, visit); /* not of the next, of the one after it */
    else
        (void)qdot_memory_fail_once_at(0); /* of this one */
}

static void
an_allocation_is_visited_before_it_is_made(void **state)
{
    (void)state;
    visits = 0;
    qdot_memory_visit_at(2, visit);
    for (int n = 0; n < 7; n++) {
        char *block = qdot_malloc(1);

        assert_int_equal(visits, n < 2 ? 0 : n < 4 ? 1 : 2);
        assert_int_equal(block == NULL, n == 4);
        qdot_free(block);
    }
    qdot_memory_visit_at(-1, NULL);
}

/* Each way to allocate, with the failure put before, at and after it. */
static void
the_nth_allocation_and_all_after_it_fail(void **state)
{
    (void)state;
    for (int64_t n = 0; n < 6; n++) {
        void *got[6], *old = qdot_malloc(4);

        qdot_memory_fail_at(n);
        got[0] = qdot_malloc(10);
        got[1] = qdot_calloc(2, 5);
        got[2] = qdot_strdup("q");
        got[3] = qdot_strndup("qdot", 3);
        got[4] = qdot_realloc(old, 100);
        got[5] = qdot_malloc(1);
        qdot_memory_fail_at(-1);
        for (int64_t i = 0; i < 6; i++) {
            if ((got[i] != NULL) != (i < n))
                fail_msg("fail_at(%" PRId64 "): allocation %" PRId64 " is %p", n, i, got[i]);
            if (i != 4)
                qdot_free(got[i]);
        }
        qdot_free(got[4] != NULL ? got[4] : old);
        assert_int_equal(qdot_last_error()->status, QDOT_ENOMEM);
        assert_non_null(strstr(qdot_last_error()->message, "out of memory"));
    }
}

static void
a_vector_keeps_what_was_pushed(void **state)
{
    qdot_vec(double) v = {0};

    (void)state;
    for (int i = 0; i < 10000; i++)
        assert_int_equal(qdot_vec_push(&v, 0.5 * i), QDOT_OK);
    assert_int_equal(v.n, 10000);
    assert_true(v.capacity >= v.n && v.capacity < 4 * v.n);
    for (int i = 0; i < 10000; i++)
        assert_true(v.at[i] == 0.5 * i);
    qdot_free(v.at);
}

static void
a_failed_push_changes_nothing(void **state)
{
    qdot_vec(int) v = {0};
    int *at;
    size_t capacity;

    (void)state;
    for (int i = 0; v.n == 0 || v.n < v.capacity; i++)
        assert_int_equal(qdot_vec_push(&v, i), QDOT_OK);
    at = v.at;
    capacity = v.capacity;
    qdot_memory_fail_at(0);
    assert_int_equal(qdot_vec_push(&v, 7), QDOT_ENOMEM);
    qdot_memory_fail_at(-1);
    assert_ptr_equal(v.at, at);
    assert_int_equal(v.n, capacity);
    assert_int_equal(v.capacity, capacity);
    for (size_t i = 0; i < v.n; i++)
        assert_int_equal(v.at[i], i);
    assert_int_equal(qdot_vec_push(&v, 7), QDOT_OK);
    assert_int_equal(v.at[v.n - 1], 7);
    qdot_free(v.at);
}

static void
an_array_beyond_the_address_space_is_refused(void **state)
{
    int *at = NULL;
    size_t capacity = 0;

    (void)state;
    assert_int_equal(qdot_grow(&at, &capacity, SIZE_MAX / 2, sizeof *at), QDOT_ENOMEM);
    assert_null(at);
    assert_int_equal(capacity, 0);
    assert_int_equal(qdot_grow(&at, &capacity, SIZE_MAX, 1), QDOT_ENOMEM);
    assert_null(at);
}

/* Blocks of many sizes, each filled with its number: aligned, and none over another. */
static void
blocks_of_an_arena_are_aligned_and_apart(void **state)
{
    enum { COUNT = 3000 };
    static unsigned char *block[COUNT];
    qdot_arena *arena = qdot_arena_new();

    (void)state;
    assert_non_null(arena);
    for (size_t i = 0; i < COUNT; i++) {
        size_t size = i % 500 == 499 ? 100000 : i * 37 % 211;

        block[i] = qdot_arena_take(arena, size);
        assert_non_null(block[i]);
        assert_int_equal((uintptr_t)block[i] % _Alignof(max_align_t), 0);
        memset(block[i], (int)(i % 251), size);
    }
    for (size_t i = 0; i < COUNT; i++) {
        size_t size = i % 500 == 499 ? 100000 : i * 37 % 211;

        for (size_t k = 0; k < size; k++)
            if (block[i][k] != i % 251)
                fail_msg("block %zu was overwritten at byte %zu", i, k);
    }
    qdot_arena_free(arena);
    qdot_arena_free(NULL);
}

static void
an_arena_copies_text(void **state)
{
    qdot_arena *arena = qdot_arena_new();

    (void)state;
    assert_string_equal(qdot_arena_strndup(arena, "lambda[rod]", 6), "lambda");
    assert_string_equal(qdot_arena_strndup(arena, "", 0), "");
    qdot_arena_free(arena);
}

static void
an_arena_without_memory_says_so(void **state)
{
    qdot_arena *arena;

    (void)state;
    qdot_memory_fail_at(0);
    assert_null(qdot_arena_new());
    qdot_memory_fail_at(-1);

    arena = qdot_arena_new();
    assert_non_null(arena);
    qdot_memory_fail_at(0);
    assert_null(qdot_arena_take(arena, 10));
    assert_null(qdot_arena_strndup(arena, "q", 1));
    qdot_memory_fail_at(-1);
    assert_non_null(qdot_arena_take(arena, 10));
    qdot_arena_free(arena);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(size_0_gives_a_block),
        cmocka_unit_test(copies_of_text_end_where_told),
        cmocka_unit_test(an_allocation_is_visited_before_it_is_made),
        cmocka_unit_test(the_nth_allocation_and_all_after_it_fail),
        cmocka_unit_test(a_vector_keeps_what_was_pushed),
        cmocka_unit_test(a_failed_push_changes_nothing),
        cmocka_unit_test(an_array_beyond_the_address_space_is_refused),
        cmocka_unit_test(blocks_of_an_arena_are_aligned_and_apart),
        cmocka_unit_test(an_arena_copies_text),
        cmocka_unit_test(an_arena_without_memory_says_so),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
