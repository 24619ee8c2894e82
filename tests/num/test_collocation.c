#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <math.h>
#include <stdlib.h>
#include <cmocka.h>

#include "num/collocation.h"

static const double digits = 1e-26;

/* x^k */
static qdot_two
power(qdot_two x, int k)
{
    qdot_two p = {1, 0};

    for (; k > 0; k--)
        p = qdot_two_mul(p, x);
    return p;
}

/* |sum_j w_j c_j^k - x^(k+1)/(k+1)| */
static double
off(const qdot_collocation *m, const qdot_two *w, int k, qdot_two x)
{
    qdot_two sum = qdot_two_div_double(power(x, k + 1), -(k + 1));

    for (int j = 0; j < m->stages; j++)
        sum = qdot_two_add(sum, qdot_two_mul(w[j], power(m->c[j], k)));
    return fabs(sum.hi);
}

/* B(order), C(stages): powers are integrated exactly, and by weights anywhere. */
static void
check(const qdot_collocation *m)
{
    qdot_two w[QDOT_COLLOCATION_MOST];
    const qdot_two x = {0.3183, 0};

    for (int k = 0; k < m->order; k++)
        assert_true(off(m, m->b, k, (qdot_two){1, 0}) < digits);
    assert_true(off(m, m->b, m->order, (qdot_two){1, 0}) > 1e-12); /* and no more */
    for (int i = 0; i < m->stages; i++)
        for (int k = 0; k < m->stages; k++)
            assert_true(off(m, m->a[i], k, m->c[i]) < digits);
    qdot_collocation_weights(m, x, w);
    for (int k = 0; k < m->stages; k++)
        assert_true(off(m, w, k, x) < digits);
    for (int i = 1; i < m->stages; i++)
        assert_true(m->c[i].hi > m->c[i - 1].hi);
}

static void
orders_are_met(void **state)
{
    qdot_collocation m;

    (void)state;
    for (int s = 1; s <= QDOT_COLLOCATION_MOST; s++) {
        qdot_collocation_gauss(s, &m);
        assert_int_equal(m.order, 2 * s);
        check(&m);
        qdot_collocation_radau(s, &m);
        assert_int_equal(m.order, 2 * s - 1);
        check(&m);
        if (s < 2)
            continue;
        qdot_collocation_lobatto(s, &m);
        assert_int_equal(m.order, 2 * s - 2);
        check(&m);
        assert_true(m.c[0].hi == 0 && m.c[0].lo == 0 && m.c[s - 1].hi == 1);
    }
}

/* Hairer & Wanner II, table IV.5.6 */
static void
radau_of_three_stages_is_that_of_the_book(void **state)
{
    const double r = sqrt(6);
    const double a[3][3] = {
        {(88 - 7 * r) / 360, (296 - 169 * r) / 1800, (-2 + 3 * r) / 225},
        {(296 + 169 * r) / 1800, (88 + 7 * r) / 360, (-2 - 3 * r) / 225},
        {(16 - r) / 36, (16 + r) / 36, 1.0 / 9}};
    qdot_collocation m;

    (void)state;
    qdot_collocation_radau(3, &m);
    assert_true(fabs(m.c[0].hi - (4 - r) / 10) < 1e-15);
    assert_true(fabs(m.c[1].hi - (4 + r) / 10) < 1e-15);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            assert_true(fabs(m.a[i][j].hi - a[i][j]) < 1e-15);
    for (int j = 0; j < 3; j++)
        assert_true(m.a[2][j].hi == m.b[j].hi && m.a[2][j].lo == m.b[j].lo);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(orders_are_met),
        cmocka_unit_test(radau_of_three_stages_is_that_of_the_book),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
