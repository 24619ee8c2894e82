/* test_batch.c -- the kernels over lanes against sums in long double, every kind. */
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>

#include "num/batch.h"
#include "num/kinds.h"

enum { L = QDOT_LANES, ORDERS = 24, N = 5 };

static uint64_t seed = 3;

static double
uniform(void)
{
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(seed >> 11) * 0x1p-53 * 2 - 1;
}

static void
fill(double *x, size_t n)
{
    for (size_t i = 0; i < n; i++)
        x[i] = uniform();
}

static void
near(double seen, long double want, const char *what)
{
    if (!(fabsl(seen - want) <= 1e-13L * (1 + fabsl(want))))
        fail_msg("%s: %.17g, not %.17Lg", what, seen, want);
}

static void
sums_of_products(void **state)
{
    const qdot_batch_kernels *kernels;
    double a[50 * L], b[50 * L], c[50 * L], seen[L], other[L];

    (void)state;
    fill(a, 50 * L);
    fill(b, 50 * L);
    fill(c, 50 * L);
    for (size_t kind = 0; (kernels = qdot_batch_kernels_at(kind)); kind++)
        for (size_t n = 0; n <= QDOT_SERIES_MOST + 1; n++) {
            const size_t end = n ? (n - 1) * L : 0;

            for (int turn = 0; turn < 2; turn++) {
                if (turn == 0)
                    kernels->dot[n](a, b + end, seen);
                else
                    kernels->pair[n](a, c + end, b + end, other, seen);
                for (size_t l = 0; l < L; l++) {
                    long double want = 0, too = 0;

                    for (size_t j = 0; j < n; j++) {
                        want += (long double)a[j * L + l] * b[end + l - j * L];
                        too += (long double)a[j * L + l] * c[end + l - j * L];
                    }
                    near(seen[l], want, kernels->name);
                    if (turn == 1)
                        near(other[l], too, kernels->name);
                }
            }
        }
}

static void
series_are_summed_and_advanced(void **state)
{
    const size_t stride = ORDERS + 3;
    const qdot_batch_kernels *kernels;
    double x[N * (ORDERS + 3) * L], s[L], unit[L], y[N * L], carry[N * L];
    double value[N * L], slope[N * L], next[N * L], next_carry[N * L];

    (void)state;
    fill(x, sizeof x / sizeof *x);
    fill(s, L);
    fill(unit, L);
    fill(y, N * L);
    for (size_t i = 0; i < N * L; i++)
        carry[i] = uniform() * 0x1p-54;
    for (size_t kind = 0; (kernels = qdot_batch_kernels_at(kind)); kind++) {
        kernels->tails(&(qdot_batch_series){N, 1, stride, x}, ORDERS, s, value, slope);
        kernels->advance(&(qdot_batch_series){N, 2, stride, x}, s, unit, value,
                         (qdot_batch_sum){y, carry}, (qdot_batch_sum){next, next_carry});
        for (size_t i = 0; i < N; i++)
            for (size_t l = 0; l < L; l++) {
                long double v = 0, d = 0, total, low;

                for (size_t k = ORDERS; k > 0; k--) {
                    v = v * s[l] + (k > 1 ? x[(i * stride + k) * L + l] : 0);
                    d = d * s[l] + k * (long double)x[(i * stride + k) * L + l];
                }
                near(value[i * L + l], v, "tail");
                if (i >= 1)
                    near(slope[i * L + l], d, "slope");
                low = i < 2 ? (long double)unit[l] * carry[(i + 2) * L + l] : 0;
                total = y[i * L + l] + (long double)carry[i * L + l] +
                        s[l] * ((long double)x[(i * stride + 1) * L + l] +
                                value[i * L + l] + low);
                low = (long double)next[i * L + l] + next_carry[i * L + l];
                if (!(fabsl(low - total) < 0x1p-62L))
                    fail_msg("%s: %.20Lg, not %.20Lg", kernels->name, low, total);
                assert_true(fabs(next_carry[i * L + l]) <= 0x1p-53 * 4);
            }
    }
}

/* Error in last places of the largest doubles below 1. */
static double
places(double seen, long double want)
{
    int e;

    (void)frexpl(want, &e);
    return (double)(fabsl(seen - want) / ldexpl(1, e - 53));
}

static void
sines_are_within_a_last_place(void **state)
{
    static const double odd[L] = {0, -0.0, 1e5, -3e7, INFINITY, NAN, 0x1.921fb54442d18p+0,
                                  0x1.6ac5b262ca1ffp+9};
    const qdot_batch_kernels *kernels;
    double x[L], s[L], c[L];

    (void)state;
    for (size_t kind = 0; (kernels = qdot_batch_kernels_at(kind)); kind++) {
        double worst = 0;

        for (int k = 0; k < 20000; k++) {
            for (size_t l = 0; l < L; l++)
                x[l] = uniform() * (k % 4 == 0 ? 0.8 : k % 4 == 1 ? 10 : k % 4 == 2 ? 1e3 : 1e5);
            kernels->sincos(x, s, c);
            for (size_t l = 0; l < L; l++)
                worst = fmax(worst, fmax(places(s[l], sinl(x[l])), places(c[l], cosl(x[l]))));
        }
        assert_true(worst < 0.9 && worst > 0.4);
        kernels->sincos(odd, s, c);
        assert_true(s[0] == 0 && !signbit(s[0]) && s[1] == 0 && signbit(s[1]) && c[1] == 1);
        assert_true(s[2] == sin(1e5) && c[3] == cos(-3e7));
        assert_true(isnan(s[4]) && isnan(c[4]) && isnan(s[5]));
        for (size_t l = 6; l < L; l++)
            assert_true(places(s[l], sinl(odd[l])) < 0.9 && places(c[l], cosl(odd[l])) < 0.9);
    }
}

/* Slopes that agree, or not, a series that is not finite; the lanes that are set. */
static void
ends_of_steps_are_judged(void **state)
{
    enum { STRIDE = 2, STATE = 4, CHECKED = 2 };
    const qdot_batch_kernels *kernels;

    (void)state;
    for (size_t kind = 0; (kernels = qdot_batch_kernels_at(kind)); kind++) {
        double x[STATE * STRIDE * L], slope[STATE * L], first[STATE * L], next[STATE * L];
        double steps[L], now[L], weight[STATE * L];
        int64_t good[L], finite[L];

        for (size_t i = 0; i < STATE; i++)
            for (size_t l = 0; l < L; l++) {
                x[(i * STRIDE + 1) * L + l] = 0.5 + (double)i;
                x[i * STRIDE * L + l] = NAN;
                slope[i * L + l] = 2 * (0.5 + (double)i);
                first[i * L + l] = 1;
                next[i * L + l] = l % 2 ? 0.5 : -4;
            }
        for (size_t l = 0; l < L; l++) {
            steps[l] = 0.25;
            now[l] = 0.5;
        }
        slope[2 * L + 1] += 0.5e-3; /* within */
        slope[2 * L + 2] += 1e-2;   /* not; */
        slope[3 * L + 3] -= 1e-2;
        slope[1 * L + 4] -= 1;      /* not looked at */
        slope[3 * L + 5] = NAN;
        x[(0 * STRIDE + 1) * L + 6] = INFINITY;
        x[(3 * STRIDE + 1) * L + 7] = NAN;
        kernels->confirm(&(qdot_batch_series){STATE, CHECKED, STRIDE, x},
                         &(qdot_batch_defect){slope, first, next, steps, now, 2e-4, 1e-16}, good,
                         finite);
        for (size_t l = 0; l < L; l++) {
            assert_int_equal(good[l], l < 2 || l == 4 ? -1 : 0);
            assert_int_equal(finite[l], l < 6 ? -1 : 0);
        }
        kernels->weights(STATE, next, weight);
        for (size_t i = 0; i < STATE * L; i++)
            assert_true(weight[i] == (i % 2 ? 1 : 0.25));
        kernels->blend(STATE, good, slope, weight);
        for (size_t i = 0; i < STATE * L; i++)
            assert_true(weight[i] == (good[i % L] ? slope[i] : i % 2 ? 1 : 0.25));
    }
}

static void
length_of_a_step_is_the_least(void **state)
{
    const size_t stride = ORDERS + 1;
    const qdot_batch_kernels *kernels;
    double x[N * (ORDERS + 1) * L], weight[N * L], seen[L];
    double inverse[ORDERS + 1], most[ORDERS + 1];

    (void)state;
    for (int k = 1; k <= ORDERS; k++) {
        inverse[k] = 1.0 / k;
        most[k] = -40 + 0.5 * (ORDERS - k);
    }
    for (size_t kind = 0; (kernels = qdot_batch_kernels_at(kind)); kind++) {
        fill(x, sizeof x / sizeof *x);
        for (size_t i = 0; i < N * L; i++)
            weight[i] = 0.5 + 0.4 * uniform();
        for (size_t i = 0; i < N; i++)
            for (size_t k = 0; k <= ORDERS; k++) {
                x[(i * stride + k) * L + 1] = 0;
                if (k > 14)
                    x[(i * stride + k) * L + 4] = 0;
            }
        x[(2 * stride + 15) * L + 2] = NAN;
        x[(3 * stride + 20) * L + 3] = -INFINITY;
        kernels->log_steps(&(qdot_batch_series){N, 0, stride, x}, 13, ORDERS, weight, inverse,
                           most, seen);
        assert_true(isinf(seen[1]) && seen[1] > 0);
        assert_true(isnan(seen[2]) && isnan(seen[3]));
        for (size_t l = 0; l < L; l++) {
            double want = INFINITY;

            for (size_t k = 13; k <= ORDERS; k++) {
                double size = 0;

                for (size_t i = 0; i < N; i++)
                    size = fmax(size,
                                fabs(x[(i * stride + k) * L + l]) * weight[i * L + l]);
                if (size > 0)
                    want = fmin(want, (most[k] - log2(size)) / (double)k);
            }
            if (l != 1 && l != 2 && l != 3)
                assert_true(fabs(seen[l] - want) < 0.1);
        }
    }
}

/* Of which the first rows are positive definite, the others what constraints leave. */
static void
solves(size_t positive)
{
    const qdot_batch_kernels *kernels;
    double A[N * N * L], F[N * N * L], inverse[N * N * L], b[N * L], x[N * L], y[N * L];

    for (size_t i = 0; i < N; i++)
        for (size_t j = 0; j <= i; j++)
            for (size_t l = 0; l < L; l++)
                A[(i * N + j) * L + l] = A[(j * N + i) * L + l] =
                    j >= positive          ? 0
                    : i == j               ? 3 + uniform()
                    : i == j + N - positive ? 1.5
                                           : 0.6 * uniform();
    for (size_t j = 0; j < N; j++) /* lane 5 has no mass there; lane 3 two constraints in one */
        A[(2 * N + j) * L + 5] = A[(j * N + 2) * L + 5] = 0;
    for (size_t j = 0; j < positive && positive < N; j++)
        A[((N - 1) * N + j) * L + 3] = A[(j * N + N - 1) * L + 3] = 0.7 * A[((N - 2) * N + j) * L + 3];
    fill(b, N * L);
    for (size_t kind = 0; (kernels = qdot_batch_kernels_at(kind)); kind++) {
        for (size_t i = 0; i < N * N * L; i++)
            F[i] = A[i];
        for (size_t i = 0; i < N * L; i++)
            x[i] = b[i];
        kernels->factor(N, positive, F);
        kernels->solve(N, positive, F, x);
        kernels->invert(N, positive, F, inverse);
        kernels->multiply(N, inverse, b, y);
        for (size_t l = 0; l < L; l++)
            for (size_t i = 0; i < N; i++) {
                long double sum = 0;

                if (l == 5 || (l == 3 && positive < N)) {
                    assert_false(isfinite(x[2 * L + l]));
                    continue;
                }
                for (size_t j = 0; j < N; j++)
                    sum += (long double)A[(i * N + j) * L + l] * x[j * L + l];
                near(b[i * L + l], sum, "solve");
                near(y[i * L + l], x[i * L + l], "inverse");
            }
    }
}

static void
systems_are_solved(void **state)
{
    (void)state;
    solves(N);
    solves(N - 2);
}

/* Of two rows; lanes without a positive determinant, or entry, get no number. */
static void
two_rows_have_an_inverse(void **state)
{
    const qdot_batch_kernels *kernels;
    double A[4 * L], inverse[4 * L];

    (void)state;
    for (size_t l = 0; l < L; l++) {
        A[l] = 2 + 0.3 * (double)l;
        A[L + l] = NAN; /* not read */
        A[2 * L + l] = 0.7 - 0.2 * (double)l;
        A[3 * L + l] = 1.5;
    }
    A[2 * L + 3] = 8;
    A[4] = A[3 * L + 4] = -1;
    for (size_t kind = 0; (kernels = qdot_batch_kernels_at(kind)); kind++) {
        kernels->invert_two(A, inverse);
        for (size_t l = 0; l < L; l++) {
            const long double a = A[l], c = A[2 * L + l], b = A[3 * L + l], d = a * b - c * c;

            for (size_t i = 0; i < 4; i++)
                if (l == 3 || l == 4)
                    assert_true(isnan(inverse[i * L + l]));
                else
                    near(inverse[i * L + l], (i == 0 ? b : i == 3 ? a : -c) / d, "inverse");
        }
    }
}

static void
a_limit_is_kept(void **state)
{
    (void)state;
    qdot_kind_limit(0);
    assert_string_equal(qdot_batch_kernels_get()->name, "portable");
    qdot_kind_limit(9);
    assert_non_null(qdot_batch_kernels_get());
    assert_null(qdot_batch_kernels_at(3));
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sums_of_products),
        cmocka_unit_test(series_are_summed_and_advanced),
        cmocka_unit_test(sines_are_within_a_last_place),
        cmocka_unit_test(ends_of_steps_are_judged),
        cmocka_unit_test(length_of_a_step_is_the_least),
        cmocka_unit_test(systems_are_solved),
        cmocka_unit_test(two_rows_have_an_inverse),
        cmocka_unit_test(a_limit_is_kept),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
