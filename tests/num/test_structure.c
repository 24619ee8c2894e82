#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "base/memory.h"
#include "num/structure.h"

static void
no_coupling_is_diagonal(void **state)
{
    bool pattern[25] = {0};
    qdot_structure s;

    (void)state;
    for (int i = 0; i < 5; i++)
        pattern[6 * i] = true;
    assert_int_equal(qdot_structure_find(pattern, 5, &s), QDOT_OK);
    assert_true(s.blocks == s.n);
    assert_false(qdot_structure_is_full(&s));
    for (size_t i = 0; i < 5; i++) {
        assert_int_equal(s.start[i], i);
        assert_int_equal(s.index[i], i);
    }
    qdot_structure_clear(&s);
}

static void
one_triangle_joins_through_others(void **state)
{
    /* 0-3, 3-1 (upper), 4-2 (lower): blocks {0 1 3} {2 4} {5} */
    bool pattern[36] = {0};
    const size_t index[] = {0, 1, 3, 2, 4, 5}, start[] = {0, 3, 5, 6};
    qdot_structure s;

    (void)state;
    pattern[0 * 6 + 3] = pattern[1 * 6 + 3] = pattern[4 * 6 + 2] = true;
    assert_int_equal(qdot_structure_find(pattern, 6, &s), QDOT_OK);
    assert_int_equal(s.blocks, 3);
    assert_memory_equal(s.index, index, sizeof index);
    assert_memory_equal(s.start, start, sizeof start);
    qdot_structure_clear(&s);
}

/* Against the transitive closure (Warshall). */
static void
random_patterns_match_their_closure(void **state)
{
    (void)state;
    srand(7);
    for (int trial = 0; trial < 300; trial++) {
        size_t n = 1 + rand() % 12;
        bool p[144], c[144];
        size_t block[12] = {0};
        qdot_structure s;

        for (size_t i = 0; i < n * n; i++)
            p[i] = rand() % 10 == 0;
        for (size_t i = 0; i < n; i++)
            for (size_t j = 0; j < n; j++)
                c[i * n + j] = i == j || p[i * n + j] || p[j * n + i];
        for (size_t k = 0; k < n; k++)
            for (size_t i = 0; i < n; i++)
                for (size_t j = 0; j < n; j++)
                    c[i * n + j] |= c[i * n + k] && c[k * n + j];
        assert_int_equal(qdot_structure_find(p, n, &s), QDOT_OK);
        assert_int_equal(s.start[s.blocks], n);
        for (size_t b = 0; b < s.blocks; b++)
            for (size_t k = s.start[b]; k < s.start[b + 1]; k++)
                block[s.index[k]] = b;
        for (size_t i = 0; i < n; i++)
            for (size_t j = 0; j < n; j++)
                assert_int_equal(block[i] == block[j], c[i * n + j]);
        qdot_structure_clear(&s);
    }
}

static void
every_failed_allocation_is_told(void **state)
{
    bool pattern[4] = {true, true, true, true};
    qdot_structure s;
    int failures = 0;

    (void)state;
    for (int64_t k = 0;; k++) {
        qdot_status status;

        qdot_memory_fail_at(k);
        status = qdot_structure_find(pattern, 2, &s);
        qdot_memory_fail_at(-1);
        if (status == QDOT_OK)
            break;
        assert_int_equal(status, QDOT_ENOMEM);
        assert_null(s.index);
        failures++;
    }
    qdot_structure_clear(&s);
    assert_int_equal(failures, 4);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_coupling_is_diagonal),
        cmocka_unit_test(one_triangle_joins_through_others),
        cmocka_unit_test(random_patterns_match_their_closure),
        cmocka_unit_test(every_failed_allocation_is_told),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
