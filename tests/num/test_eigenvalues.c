#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <math.h>
#include <cmocka.h>

#include "num/eigenvalues.h"

/* A rotation by 0.3, stretched by 2.385, beside -7 and 0.5, in other directions. */
static void
pairs_and_reals_in_order(void **state)
{
    const double c = 2.385 * cos(0.3), s = 2.385 * sin(0.3);
    const double A[16] = {c, -s, 1, 2, s, c, 3, -1, 0, 0, -7, 4, 0, 0, 0, 0.5};
    const double wanted[4][2] = {{-7, 0}, {c, s}, {c, -s}, {0.5, 0}};
    double E[16] = {0}, re[4], im[4], error[4];

    (void)state;
    assert_int_equal(qdot_eigenvalues(4, A, E, re, im, error), QDOT_OK);
    for (int k = 0; k < 4; k++) {
        assert_true(hypot(re[k] - wanted[k][0], im[k] - wanted[k][1]) <= error[k]);
        assert_true(error[k] < 1e-12);
    }
}

/* Errors of entries reach an eigenvalue by its vectors: little where they are apart, as a root where they meet. */
static void
errors_hold_what_entries_may_do(void **state)
{
    const double E[4] = {1e-8, 1e-8, 1e-8, 1e-8};

    (void)state;
    for (int together = 0; together < 2; together++) {
        const double A[4] = {1, 1, together ? 1e-14 : 0, together ? 1 : 3};
        const double B[4] = {A[0] + 1e-8, A[1] - 1e-8, A[2] + 1e-8, A[3] + 1e-8};
        double re[2], im[2], error[2], moved[2], moved_im[2], none[2];

        assert_int_equal(qdot_eigenvalues(2, A, E, re, im, error), QDOT_OK);
        assert_int_equal(qdot_eigenvalues(2, B, E, moved, moved_im, none), QDOT_OK);
        for (int k = 0; k < 2; k++)
            assert_true(hypot(re[k] - moved[k], im[k] - moved_im[k]) <= error[k]);
        assert_true(together || error[0] < 1e-7);
    }
}

/* Moduli that differ by less than their errors do not decide on the order. */
static void
order_holds_against_rounding(void **state)
{
    const double c = cos(1.83), s = sin(1.83);
    const double wanted[6][2] = {{-2.385, 0}, {1, 0}, {c, s}, {c, -s}, {-1, 0}, {0.5, 0}};
    const double longer[6] = {0, -1e-13, 2e-13, 2e-13, 3e-13, 0}; /* both of a pair by the same */

    (void)state;
    for (int first = 0; first < 6; first++)
        for (int way = -1; way <= 1; way++) {
            double re[6], im[6], error[6];

            for (int i = 0; i < 6; i++) {
                const int from = (5 * i + first) % 6;

                re[i] = wanted[from][0] * (1 + way * longer[from]);
                im[i] = wanted[from][1] * (1 + way * longer[from]);
                error[i] = 1e-12;
            }
            qdot_eigenvalues_arrange(6, re, im, error);
            for (int i = 0; i < 6; i++)
                assert_true(hypot(re[i] - wanted[i][0], im[i] - wanted[i][1]) < 1e-12);
        }
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pairs_and_reals_in_order),
        cmocka_unit_test(order_holds_against_rounding),
        cmocka_unit_test(errors_hold_what_entries_may_do),
    };

    return cmocka_run_group_tests_name("eigenvalues", tests, NULL, NULL);
}
