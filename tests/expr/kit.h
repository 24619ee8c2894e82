/* kit.h -- a pool with its symbols around every test. */
#ifndef QDOT_TESTS_EXPR_KIT_H
#define QDOT_TESTS_EXPR_KIT_H

#include "expr/spec.h"

static place p;

static inline int
open_place(void **state)
{
    (void)state;
    place_open(&p);
    return 0;
}

static inline int
open_moved_place(void **state)
{
    (void)open_place(state);
    place_move(&p);
    return 0;
}

static inline int
close_place(void **state)
{
    (void)state;
    place_close(&p);
    return 0;
}

#define TEST(f) cmocka_unit_test_setup_teardown(f, open_place, close_place)
#define MOVED_TEST(f) cmocka_unit_test_setup_teardown(f, open_moved_place, close_place)

static inline qdot_expr
number(int64_t n, int64_t d)
{
    return qdot_expr_ratio(p.pool, n, d);
}

static inline qdot_expr
times(qdot_expr a, qdot_expr b)
{
    return qdot_mul(p.pool, a, b);
}

static inline void
refuses(qdot_expr e, qdot_status status)
{
    assert_int_equal(e, QDOT_NIL);
    assert_int_equal(qdot_pool_check(p.pool), status);
}

#endif
