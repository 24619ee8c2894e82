/* test_real.c -- sums of products against MPFR's own, and equations whose solution is
 * known. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
#include <inttypes.h>
#include <stdlib.h>

#include "base/memory.h"
#include "num/real.h"

/* One of many: 0 at times, of either sign, over a hundred powers of ten. */
static void
some_number(mpfr_ptr x, gmp_randstate_t random)
{
    uint64_t kind = gmp_urandomm_ui(random, 10);

    mpfr_urandomb(x, random);
    if (kind == 0)
        mpfr_set_zero(x, 1);
    if (kind > 5)
        mpfr_neg(x, x, MPFR_RNDN);
    mpfr_mul_2si(x, x, (mpfr_exp_t)gmp_urandomm_ui(random, kind == 1 ? 1000 : 20) - 10,
                 MPFR_RNDN);
}

static void
dot_is_the_rounded_sum(void **state)
{
    gmp_randstate_t random;

    (void)state;
    gmp_randinit_default(random);
    for (int round = 0; round < 2000; round++) {
        const mpfr_prec_t bits = 64 * (1 + (mpfr_prec_t)gmp_urandomm_ui(random, 9));
        const size_t n = gmp_urandomm_ui(random, 12);
        qdot_reals v;
        mpfr_ptr a[12], b[12];
        mpfr_t exact, size, part;
        mp_limb_t *work = calloc(qdot_real_dot_work(bits), sizeof *work);

        assert_non_null(work);
        assert_int_equal(qdot_reals_init(&v, 2 * n + 1, bits), QDOT_OK);
        for (size_t i = 0; i < 2 * n; i++)
            some_number(v.at[i], random);
        for (size_t i = 0; i < n; i++) {
            a[i] = v.at[i];
            b[i] = v.at[2 * n - 1 - i];
        }
        qdot_real_dot(v.at[2 * n], (const mpfr_t *)v.at,
                      (const mpfr_t *)v.at + (n ? 2 * n - 1 : 0), n, work);
        mpfr_inits2(4000, exact, size, part, (mpfr_ptr)0);
        mpfr_dot(exact, a, b, n, MPFR_RNDN);
        mpfr_set_zero(size, 1);
        for (size_t i = 0; i < n; i++) {
            mpfr_mul(part, a[i], b[i], MPFR_RNDN);
            if (mpfr_cmpabs(part, size) > 0)
                mpfr_abs(size, part, MPFR_RNDN);
        }
        mpfr_sub(part, v.at[2 * n], exact, MPFR_RNDN);
        mpfr_mul_ui(size, size, n + 1, MPFR_RNDN);
        mpfr_mul_2si(size, size, 3 - (mpfr_exp_t)bits, MPFR_RNDN);
        if (mpfr_cmpabs(part, size) > 0)
            fail_msg("%zu terms of %" PRId64 " bits: off by 2^%.1f, allowed 2^%.1f", n,
                     (int64_t)bits, qdot_real_log2(part), qdot_real_log2(size));
        mpfr_clears(exact, size, part, (mpfr_ptr)0);
        qdot_reals_clear(&v);
        free(work);
    }
    gmp_randclear(random);
}

static void
what_is_not_finite_makes_the_sum_nan(void **state)
{
    mp_limb_t work[64];
    qdot_reals v;

    (void)state;
    assert_int_equal(qdot_reals_init(&v, 5, 128), QDOT_OK);
    for (size_t i = 0; i < 4; i++)
        mpfr_set_si(v.at[i], (int64_t)i - 2, MPFR_RNDN);
    mpfr_set_inf(v.at[1], 1);
    qdot_real_dot(v.at[4], (const mpfr_t *)v.at, (const mpfr_t *)v.at + 3, 2, work);
    assert_true(mpfr_nan_p(v.at[4]));
    qdot_reals_clear(&v);
}

/* A x = b with x = (1, 1/2, 1/3 ...), A a matrix that needs its rows interchanged. */
static void
equations_are_solved(void **state)
{
    enum { N = 5 };
    size_t order[N], failed;
    double scale[N];
    qdot_reals v;
    mpfr_t *a, *b, *y, *w;

    (void)state;
    assert_int_equal(qdot_reals_init(&v, N * N + 2 * N + 2, 256), QDOT_OK);
    a = v.at, b = a + N * N, y = b + N, w = y + N;
    for (size_t i = 0; i < N; i++)
        for (size_t j = 0; j < N; j++) {
            mpfr_set_si(a[i * N + j], (int64_t)((3 * i * i + 5 * j * j + i * j * j + 2) % 13) - 6,
                        MPFR_RNDN);
            if (i == 0 && j == 0)
                mpfr_set_zero(a[0], 1);
            mpfr_div_ui(w[0], a[i * N + j], j + 1, MPFR_RNDN);
            mpfr_add(b[i], b[i], w[0], MPFR_RNDN);
        }
    assert_int_equal(qdot_real_lu(N, a, order, scale, &failed, w), QDOT_OK);
    qdot_real_solve(N, (const mpfr_t *)a, order, b, y, w);
    for (size_t i = 0; i < N; i++) {
        mpfr_mul_ui(b[i], b[i], i + 1, MPFR_RNDN);
        mpfr_sub_ui(b[i], b[i], 1, MPFR_RNDN);
        assert_true(qdot_real_log2(b[i]) < -240);
    }
    /* the last row becomes the sum of the others */
    for (size_t j = 0; j < N; j++) {
        mpfr_set_zero(a[(N - 1) * N + j], 1);
        for (size_t i = 0; i + 1 < N; i++) {
            mpfr_set_si(a[i * N + j], (int64_t)((i * 3 + j * 7) % 5), MPFR_RNDN);
            mpfr_add(a[(N - 1) * N + j], a[(N - 1) * N + j], a[i * N + j], MPFR_RNDN);
        }
    }
    assert_int_equal(qdot_real_lu(N, a, order, scale, &failed, w), QDOT_ESINGULAR);
    qdot_reals_clear(&v);
}

static void
failing_allocations_are_told(void **state)
{
    qdot_reals v;

    (void)state;
    for (int64_t n = 0; n < 2; n++) {
        qdot_memory_fail_at(n);
        assert_int_equal(qdot_reals_init(&v, 5, 128), QDOT_ENOMEM);
        qdot_memory_fail_at(-1);
    }
    assert_int_equal(qdot_reals_init(&v, 5, 0), QDOT_EINVAL);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(dot_is_the_rounded_sum),
        cmocka_unit_test(what_is_not_finite_makes_the_sum_nan),
        cmocka_unit_test(equations_are_solved),
        cmocka_unit_test(failing_allocations_are_told),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
