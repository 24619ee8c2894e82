/* Where the zeros of det(M s^2 + G s + H) lie: with zeros that are known. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>
#include <stdlib.h>

#include "expr/expr.h"
#include "normal/inequality/half-plane.h"

enum { GROWS = 1, DECAYS = 2, BOUNDED = 4, MOST = 4 };

static int
answer(qdot_pool *pool, size_t n, const qdot_expr *M, const qdot_expr *G, const qdot_expr *H, bool even)
{
    qdot_half_plane p;

    assert_int_equal(qdot_half_plane_of(pool, n, M, G, H, even, &p), QDOT_OK);
    return (p.grows ? GROWS : 0) + (p.decays ? DECAYS : 0) + (p.bounded ? BOUNDED : 0);
}

/* G, H of one, times 1 or sqrt(2) and 2: the zeros are multiplied by that, their sides stay. */
static void
one(int64_t g, int64_t h, int wanted, bool even)
{
    qdot_pool *pool = qdot_pool_new();
    qdot_expr two = qdot_expr_int(pool, 2);

    for (int k = 0; k < 2; k++) {
        qdot_expr M = QDOT_ONE, G = qdot_expr_int(pool, g), H = qdot_expr_int(pool, h);

        if (k == 1) {
            G = qdot_mul(pool, G, qdot_sqrt(pool, two));
            H = qdot_mul(pool, H, qdot_add(pool, two, qdot_sqrt(pool, qdot_expr_int(pool, 3))));
        }
        assert_int_equal(answer(pool, 1, &M, &G, &H, even), wanted);
    }
    qdot_pool_free(pool);
}

static void
one_coordinate(void **state)
{
    (void)state;
    one(1, 5, DECAYS | BOUNDED, false);
    one(-1, 5, GROWS, false);
    one(0, 5, BOUNDED, false);
    one(0, 5, BOUNDED, true);
    one(0, -5, GROWS, true);
    one(3, -5, GROWS, false);
}

static void
a_zero_at_0_is_left_open(void **state)
{
    (void)state;
    one(1, 0, 0, false);
    one(0, 0, 0, true);
}

/* [n x n] of integers; times sqrt(2) where `root` is set, which multiplies p by a number. */
static void
matrices(size_t n, const int *m, const int *g, const int *h, bool even, int wanted)
{
    qdot_pool *pool = qdot_pool_new();
    qdot_expr M[MOST * MOST], G[MOST * MOST], H[MOST * MOST];

    for (int root = 0; root < 2; root++) {
        qdot_expr c = root ? qdot_sqrt(pool, qdot_expr_int(pool, 2)) : QDOT_ONE;

        for (size_t i = 0; i < n * n; i++) {
            M[i] = qdot_mul(pool, c, qdot_expr_int(pool, m[i]));
            G[i] = qdot_mul(pool, c, qdot_expr_int(pool, g[i]));
            H[i] = qdot_mul(pool, c, qdot_expr_int(pool, h[i]));
        }
        assert_int_equal(answer(pool, n, M, G, H, even), wanted);
    }
    qdot_pool_free(pool);
}

/* Ziegler's column: a follower force beyond and below its critical size. */
static void
follower_forces(void **state)
{
    (void)state;
    matrices(2, (int[]){3, 1, 1, 1}, (int[]){0, 0, 0, 0}, (int[]){-1, 2, -1, 1}, false, GROWS);
    matrices(2, (int[]){3, 1, 1, 1}, (int[]){0, 0, 0, 0}, (int[]){1, 0, -1, 1}, false, BOUNDED);
}

/* A magnetic field holds what would fall: W^2 + (g^2 - 2) W + 1. */
static void
gyroscopic_terms(void **state)
{
    (void)state;
    matrices(2, (int[]){1, 0, 0, 1}, (int[]){0, 3, -3, 0}, (int[]){-1, 0, 0, -1}, true, BOUNDED);
    matrices(2, (int[]){1, 0, 0, 1}, (int[]){0, 1, -1, 0}, (int[]){-1, 0, 0, -1}, true, GROWS);
}

/* s^4 + 4 s^3 + 6 s^2 + 4 s + 1: one zero four times; and two coordinates alike, on the axis. */
static void
multiple_zeros(void **state)
{
    qdot_pool *pool = qdot_pool_new();
    qdot_expr M[4] = {QDOT_ONE, QDOT_ZERO, QDOT_ZERO, QDOT_ONE}, two = qdot_expr_int(pool, 2),
              G[4] = {two, QDOT_ONE, QDOT_ZERO, two}, H[4] = {QDOT_ONE, QDOT_ZERO, QDOT_ZERO, QDOT_ONE};

    (void)state;
    assert_int_equal(answer(pool, 2, M, G, H, false), DECAYS | BOUNDED);
    G[0] = G[1] = G[3] = QDOT_ZERO;
    assert_int_equal(answer(pool, 2, M, G, H, true), 0);
    qdot_pool_free(pool);
}

/* (s^2 + 1)(s^2 + s/10^9 + 1): beside the axis. */
static void
beside_the_axis(void **state)
{
    qdot_pool *pool = qdot_pool_new();
    qdot_expr M[4] = {QDOT_ONE, QDOT_ZERO, QDOT_ZERO, QDOT_ONE},
              H[4] = {QDOT_ONE, QDOT_ZERO, QDOT_ZERO, QDOT_ONE},
              G[4] = {QDOT_ZERO, QDOT_ZERO, QDOT_ZERO, QDOT_ZERO};

    (void)state;
    G[3] = qdot_expr_ratio(pool, 1, 1000000000);
    assert_int_equal(answer(pool, 2, M, G, H, false), BOUNDED);
    G[3] = qdot_expr_ratio(pool, -1, 1000000000);
    assert_int_equal(answer(pool, 2, M, G, H, false), GROWS);
    qdot_pool_free(pool);
}

static void
a_singular_mass_is_left_open(void **state)
{
    (void)state;
    matrices(2, (int[]){1, 1, 1, 1}, (int[]){1, 0, 0, 1}, (int[]){1, 0, 0, 1}, false, 0);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_coordinate),   cmocka_unit_test(a_zero_at_0_is_left_open),
        cmocka_unit_test(follower_forces),  cmocka_unit_test(gyroscopic_terms),
        cmocka_unit_test(multiple_zeros),   cmocka_unit_test(beside_the_axis),
        cmocka_unit_test(a_singular_mass_is_left_open),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
