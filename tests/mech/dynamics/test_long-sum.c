/* test_long-sum.c -- the potential of many points by coordinates: how many terms each has, and its derivatives. */
#include "mech/dynamics/long-sum.h"
#include "mech/kit.h"
#include "mech/scene/things.h"

enum { POINTS = 20 };

/* Sum over i < j of j/|x_i - x_j|^2, and t^2, which no coordinate is in. */
static qdot_expr
potential_of_points(kit *k)
{
    qdot_pool *pool = k->pool;
    qdot_expr V = E(k, "t^2");

    for (size_t j = 1; j < POINTS; j++)
        for (size_t i = 0; i < j; i++)
            V = qdot_add(pool, V,
                         qdot_mul(pool, qdot_expr_int(pool, (int64_t)j),
                                  qdot_pow_int(pool, qdot_sub(pool, k->scene->coordinates.at[i], k->scene->coordinates.at[j]), -2)));
    return V;
}

static void
make_points(kit *k)
{
    kit_open(k);
    for (int i = 0; i < POINTS; i++) {
        char name[16];

        snprintf(name, sizeof name, "x%d", i);
        coords(k, name);
    }
}

static void
each_coordinate_has_its_pairs(void **state)
{
    qdot_expr V;
    kit k;

    (void)state;
    make_points(&k);
    V = potential_of_points(&k);
    for (size_t i = 0; i < POINTS; i++) {
        const qdot_expr part = qdot_long_sum_with(k.scene, V, i), q = k.scene->coordinates.at[i];

        assert_int_equal(qdot_expr_count(k.pool, part), 1 + 2 * (POINTS - 1));
        assert_int_equal(qdot_diff(k.pool, part, q), qdot_diff(k.pool, V, q));
        assert_int_equal(qdot_long_sum_with(k.scene, V, i), part);
    }
    must(qdot_pool_check(k.pool));
    kit_close(&k);
}

static void
short_sums_stay_whole(void **state)
{
    qdot_expr V;
    kit k;

    (void)state;
    make_points(&k);
    V = qdot_add(k.pool, k.scene->coordinates.at[0], k.scene->coordinates.at[1]);
    assert_int_equal(qdot_long_sum_with(k.scene, V, 3), V);
    assert_int_equal(qdot_long_sum_with(k.scene, k.scene->coordinates.at[0], 3), k.scene->coordinates.at[0]);
    kit_close(&k);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_coordinate_has_its_pairs),
        cmocka_unit_test(short_sums_stay_whole),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
