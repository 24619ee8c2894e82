/* test_adjoint.c -- all derivatives of a sum at once are those of qdot_diff, and as large as the functions. */
#include "expr/kit.h"

#include "expr/adjoint.h"
#include "expr/calculus.h"

enum { LINKS = 40 };

static qdot_expr
angle(int k)
{
    char name[16];

    (void)snprintf(name, sizeof name, "angle%d", k);
    return qdot_symbol_get(p.pool, QDOT_COORD, name);
}

static void
derivatives_are_those_of_diff(void **state)
{
    const qdot_expr x = angle(0), y = angle(1), z = angle(2), two = qdot_expr_int(p.pool, 2);
    const qdot_expr sum = qdot_add(p.pool, qdot_mul(p.pool, two, qdot_fun1(p.pool, QDOT_COS, x)), qdot_mul(p.pool, y, y));
    const qdot_expr f[3] = {qdot_mul(p.pool, sum, qdot_fun1(p.pool, QDOT_EXP, qdot_mul(p.pool, x, y))),
                            qdot_sqrt(p.pool, qdot_add(p.pool, sum, two)), qdot_div(p.pool, x, qdot_add(p.pool, sum, two))};
    const qdot_expr w[3] = {p.symbol[0], p.symbol[1], two}, by[3] = {x, y, z};
    qdot_expr out[3], at[5] = {x, y, p.symbol[0], p.symbol[1], z};
    const qdot_expr value[5] = {number(3, 10), number(7, 5), qdot_expr_int(p.pool, 3),
                                 qdot_expr_int(p.pool, -5), QDOT_ONE};
    bool possible;

    (void)state;
    assert_int_equal(qdot_adjoint(p.pool, 3, f, w, 3, by, out, &possible), QDOT_OK);
    assert_true(possible);
    assert_int_equal(out[2], QDOT_ZERO);
    for (int i = 0; i < 2; i++) {
        qdot_expr want = QDOT_ZERO;

        for (int r = 0; r < 3; r++)
            want = qdot_add(p.pool, want, qdot_mul(p.pool, w[r], qdot_diff(p.pool, f[r], by[i])));
        assert_float_equal((double)node_value(&p, qdot_subs(p.pool, out[i], 5, at, value), NULL),
                           (double)node_value(&p, qdot_subs(p.pool, want, 5, at, value), NULL), 1e-13);
    }
}

/* A product of N plane rotations: N derivatives take work N. */
static size_t
nodes_of_chain(int links)
{
    qdot_expr c = QDOT_ONE, s = QDOT_ZERO, by[2 * LINKS], out[2 * LINKS];
    bool possible;
    size_t before;

    for (int k = 0; k < links; k++) {
        const qdot_expr cos = qdot_fun1(p.pool, QDOT_COS, angle(k)), sin = qdot_fun1(p.pool, QDOT_SIN, angle(k));
        const qdot_expr next = qdot_sub(p.pool, qdot_mul(p.pool, c, cos), qdot_mul(p.pool, s, sin));

        s = qdot_add(p.pool, qdot_mul(p.pool, s, cos), qdot_mul(p.pool, c, sin));
        c = next;
        by[k] = angle(k);
    }
    before = qdot_pool_count(p.pool);
    assert_int_equal(qdot_adjoint(p.pool, 2, (qdot_expr[]){c, s}, p.symbol, (size_t)links, by, out, &possible), QDOT_OK);
    assert_true(possible);
    return qdot_pool_count(p.pool) - before;
}

static void
work_grows_as_the_functions(void **state)
{
    const size_t few = nodes_of_chain(LINKS);

    (void)state;
    assert_in_range(nodes_of_chain(2 * LINKS), few, 2 * few + few / 4);
}

static void
what_is_not_differentiated_is_told(void **state)
{
    const qdot_expr x = angle(0);
    const qdot_expr f = qdot_fun(p.pool, QDOT_MAX, 2, (qdot_expr[]){x, angle(1)});
    qdot_expr out;
    bool possible;

    (void)state;
    assert_int_equal(qdot_adjoint(p.pool, 1, &f, p.symbol, 1, &x, &out, &possible), QDOT_OK);
    assert_false(possible);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(derivatives_are_those_of_diff),
        TEST(work_grows_as_the_functions),
        TEST(what_is_not_differentiated_is_told),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
