/* The complex roots of polynomials with rational coefficients: pairs, multiple roots, roots on the axis. */
#include <setjmp.h>
#include <math.h>

#include "normal/kit.h"

#include <cmocka.h>

#include "expr/build.h"
#include "normal/solve/complex-roots.h"

enum { MOST = 8 };

static void
find_roots(size_t n, const int64_t *c, double *re, double *im)
{
    qdot_expr e[MOST + 1];

    for (size_t k = 0; k <= n; k++)
        e[k] = qdot_expr_int(pool, c[k]);
    assert_int_equal(qdot_complex_roots(pool, n, e, re, im), QDOT_OK);
}

/* (x + 2)^3 (x^2 + 5)^2: the pairs stand together, and their real parts are 0 exactly. */
static void
multiple_pairs_stand_together(void **state)
{
    const int64_t c[] = {200, 300, 230, 145, 68, 22, 6, 1};
    double re[MOST], im[MOST];
    int real = 0;

    (void)state;
    find_roots(7, c, re, im);
    for (size_t k = 0; k < 7; k++)
        if (im[k] == 0) {
            assert_true(re[k] == -2);
            real++;
        } else {
            assert_true(re[k] == 0 && fabs(fabs(im[k]) - sqrt(5)) < 1e-15);
            assert_true(im[k] < 0 || im[k + 1] == -im[k]);
        }
    assert_int_equal(real, 3);
}

/* The roots of x^4 + x^3 + x^2 + x + 1 are on the unit circle. */
static void
roots_of_unity(void **state)
{
    const int64_t c[] = {1, 1, 1, 1, 1};
    double re[MOST], im[MOST], sum = 0;

    (void)state;
    find_roots(4, c, re, im);
    for (size_t k = 0; k < 4; k++) {
        assert_true(fabs(hypot(re[k], im[k]) - 1) < 1e-15);
        sum += re[k];
    }
    assert_true(fabs(sum + 1) < 1e-15);
}

static void
symbols_are_refused(void **state)
{
    const qdot_expr c[] = {qdot_symbol_get(pool, QDOT_PARAM, "a"), QDOT_ONE};
    double re[1], im[1];

    (void)state;
    assert_int_equal(qdot_complex_roots(pool, 1, c, re, im), QDOT_EINVAL);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(multiple_pairs_stand_together, open_pool, close_pool),
        cmocka_unit_test_setup_teardown(roots_of_unity, open_pool, close_pool),
        cmocka_unit_test_setup_teardown(symbols_are_refused, open_pool, close_pool),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
