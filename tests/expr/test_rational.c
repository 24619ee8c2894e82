/* test_rational.c -- arithmetic in place against FLINT's. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <flint/fmpq.h>

#include "expr/rational.h"

/* Around every place where the way changes: 0, 1, 2^30, 2^62, and beyond a word. */
static void
make(fmpq_t x, unsigned *seed)
{
    static const int bits[] = {0, 1, 3, 29, 30, 31, 32, 61, 62, 63, 64, 90};
    fmpz_t n, d;

    fmpz_init(n);
    fmpz_init(d);
    for (int k = 0; k < 2; k++) {
        fmpz *at = k == 0 ? n : d;

        *seed = *seed * 1103515245u + 12345u;
        fmpz_set_ui(at, 1);
        fmpz_mul_2exp(at, at, (ulong)bits[(*seed >> 16) % 12]);
        *seed = *seed * 1103515245u + 12345u;
        fmpz_add_si(at, at, (slong)((*seed >> 16) % 7) - 3);
        if (*seed >> 30 & 1)
            fmpz_neg(at, at);
    }
    if (fmpz_is_zero(d))
        fmpz_one(d);
    fmpq_set_fmpz_frac(x, n, d);
    fmpz_clear(n);
    fmpz_clear(d);
}

static int
sign(int x)
{
    return (x > 0) - (x < 0);
}

static void
they_are_those_of_flint(void **state)
{
    unsigned seed = 1;

    (void)state;
    for (int turn = 0; turn < 20000; turn++) {
        fmpq_t a, b, y, is, was;

        fmpq_init(a);
        fmpq_init(b);
        fmpq_init(y);
        fmpq_init(is);
        fmpq_init(was);
        make(a, &seed);
        make(b, &seed);
        make(y, &seed);

        qdot_rational_mul(is, a, b);
        fmpq_mul(was, a, b);
        assert_true(fmpq_equal(is, was));
        qdot_rational_add(is, a, b);
        fmpq_add(was, a, b);
        assert_true(fmpq_equal(is, was));
        qdot_rational_set(is, y);
        fmpq_set(was, y);
        qdot_rational_addmul(is, a, b);
        fmpq_addmul(was, a, b);
        assert_true(fmpq_equal(is, was) && fmpq_is_canonical(is));
        assert_int_equal(qdot_rational_sgn(a), fmpq_sgn(a));
        assert_int_equal(sign(qdot_rational_cmp(a, b)), sign(fmpq_cmp(a, b)));
        assert_int_equal(qdot_rational_equal(a, b), fmpq_equal(a, b) != 0);
        assert_true(qdot_rational_equal(is, was));

        qdot_rational_set(is, a); /* in place */
        qdot_rational_mul(is, is, is);
        fmpq_mul(was, a, a);
        assert_true(fmpq_equal(is, was));
        qdot_rational_add(is, is, b);
        fmpq_add(was, was, b);
        assert_true(fmpq_equal(is, was));

        fmpq_clear(a);
        fmpq_clear(b);
        fmpq_clear(y);
        fmpq_clear(is);
        fmpq_clear(was);
    }
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(they_are_those_of_flint),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
