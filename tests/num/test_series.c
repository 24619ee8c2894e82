/* test_series.c -- the kernels of every kind of processor against plain sums. */
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>

#include "num/series.h"

enum { MOST = QDOT_SERIES_MOST + 1, MEMBERS = 40 };

/* A number between -1 and 1 without a pattern. */
static double
some(size_t i)
{
    return sin(12.9898 * (double)(i + 1)) * 0.937;
}

static void
close_to(double x, long double expected, long double size, const char *what, size_t n)
{
    if (!(fabsl(x - expected) <= 8 * 0x1p-53L * (size + fabsl(expected)) + 1e-300L))
        fail_msg("%s, n = %zu: %.17g, not %.17Lg", what, n, x, expected);
}

static void
products_of_series_are_sums_of_products(void **state)
{
    const qdot_series_kernels *k;
    double a[MOST], b[MOST], c[MOST];
    size_t kinds = 0;

    (void)state;
    for (size_t i = 0; i < MOST; i++) {
        a[i] = some(i);
        b[i] = some(100 + i);
        c[i] = some(200 + i);
    }
    for (; (k = qdot_series_kernels_at(kinds)); kinds++)
        for (size_t n = 0; n <= MOST; n++) {
            long double x = 0, y = 0, size = 0;
            const double *last = b + (n ? n - 1 : 0), *end = c + (n ? n - 1 : 0);
            qdot_series_two two = k->pair[n](a, last, end);

            for (size_t j = 0; j < n; j++) {
                x += (long double)a[j] * b[n - 1 - j];
                y += (long double)a[j] * c[n - 1 - j];
                size += 1;
            }
            close_to(k->dot[n](a, last), x, size, k->name, n);
            close_to(two.b, x, size, k->name, n);
            close_to(two.c, y, size, k->name, n);
        }
    assert_true(kinds >= 1 && kinds <= 3);
    assert_non_null(qdot_series_kernels_get());
}

static void
members_are_taken_one_by_one(void **state)
{
    static double a[MOST * MEMBERS], b[MOST * MEMBERS], out[MEMBERS], y[MEMBERS];
    const qdot_series_kernels *k;

    (void)state;
    for (size_t i = 0; i < MOST * MEMBERS; i++) {
        a[i] = some(i);
        b[i] = some(7 * i + 3);
    }
    for (size_t kind = 0; (k = qdot_series_kernels_at(kind)); kind++)
        for (size_t m = 8; m <= MEMBERS; m += 8)
            for (size_t n = 1; n <= 30; n += 3) {
                k->dots(m, n, a, b + (n - 1) * m, out);
                k->multiply(m, n, a, b, y);
                for (size_t i = 0; i < m; i++) {
                    long double s = 0, t = 0;

                    for (size_t j = 0; j < n; j++) {
                        s += (long double)a[j * m + i] * b[(n - 1 - j) * m + i];
                        t += (long double)a[j * m + i] * b[j];
                    }
                    close_to(out[i], s, n, "dots", m);
                    close_to(y[i], t, n, "multiply", m);
                }
                for (size_t i = 0; i < m; i++)
                    y[i] = b[i];
                k->add(m, 0.3, a, y);
                for (size_t i = 0; i < m; i++)
                    close_to(y[i], b[i] + 0.3L * a[i], 2, "add", m);
            }
}

static void
tails_are_values_and_slopes(void **state)
{
    enum { STRIDE = 40, SERIES = 7 };
    static double x[SERIES * STRIDE];
    double value[SERIES], slope[SERIES];
    const qdot_series_kernels *k;

    (void)state;
    for (size_t i = 0; i < SERIES * STRIDE; i++)
        x[i] = some(i);
    for (size_t kind = 0; (k = qdot_series_kernels_at(kind)); kind++)
        for (int p = 2; p < STRIDE; p += 5) {
            k->tails(SERIES, x, STRIDE, p, 0.7, value, slope);
            for (size_t i = 0; i < SERIES; i++) {
                long double v = 0, d = 0;

                for (int j = 1; j <= p; j++) {
                    long double term = x[i * STRIDE + (size_t)j] * powl(0.7, j - 1);

                    v += j > 1 ? term : 0;
                    d += j * term;
                }
                close_to(value[i], v, 3, "value", (size_t)p);
                close_to(slope[i], d, 10, "slope", (size_t)p);
            }
        }
}

/* A NaN and an infinity are peaks, wherever they stand. */
static void
peaks_are_the_largest_and_lose_nothing(void **state)
{
    enum { n = 3, stride = 24, p = 17 };
    double x[n * stride], scale[n] = {1, 0.25, 2}, peaks[stride];

    (void)state;
    for (size_t i = 0; i < n * stride; i++)
        x[i] = sin(7.0 * (double)i);
    x[1 * stride + 9] = INFINITY;
    x[0 * stride + 13] = NAN;
    for (size_t kind = 0; qdot_series_kernels_at(kind); kind++) {
        qdot_series_kernels_at(kind)->peaks(n, x, stride, p, scale, peaks);
        for (int k = 0; k <= p; k++) {
            double most = 0;

            for (int i = 0; i < n; i++)
                most = fmax(most, scale[i] * fabs(x[i * stride + k]));
            if (k == 13)
                assert_true(isnan(peaks[k]));
            else
                assert_true(peaks[k] == most);
        }
    }
}

/* What a step reads off a series, with zeros in a pattern, and what is not finite. */
static void
reach_is_the_least_of_its_half(void **state)
{
    enum { n = 3, stride = 24, p = 17 };
    double x[n * stride], scale[n] = {1, 0.25, 2};
    qdot_series_weights w;
    qdot_series_reach got;

    (void)state;
    qdot_series_weights_set(&w, p, -1, 0.75);
    for (size_t kind = 0; qdot_series_kernels_at(kind); kind++) {
        const qdot_series_kernels *kernels = qdot_series_kernels_at(kind);
        double upper = INFINITY, lower = INFINITY;

        for (size_t i = 0; i < n * stride; i++)
            x[i] = i % stride % 4 == 1 ? exp(20 * sin(7.0 * (double)i)) : 0;
        x[p + 1] = NAN; /* beyond what counts */
        x[0] = x[1] = 1e300;
        for (int k = 2; k <= p; k++) {
            double most = 0;

            for (int i = 0; i < n; i++)
                most = fmax(most, scale[i] * fabs(x[i * stride + k]));
            if (most > 0 && k > p / 2)
                upper = fmin(upper, (0.75 * (p - k) - log2(most)) / k);
            if (most > 0 && k <= p / 2)
                lower = fmin(lower, (-1 - log2(most)) / k);
        }
        got = kernels->reach(n, x, stride, &w, scale);
        assert_true(fabs(got.upper - upper) < 0.09 / (p / 2));
        assert_true(fabs(got.lower - lower) < 0.09 / 2);
        for (size_t i = 0; i < n; i++)
            for (int k = p / 2 + 1; k <= p; k++)
                x[i * stride + (size_t)k] = 0;
        assert_true(kernels->reach(n, x, stride, &w, scale).upper == INFINITY);
        x[stride + p] = NAN;
        assert_true(kernels->reach(n, x, stride, &w, scale).upper == -INFINITY);
        x[stride + p] = INFINITY;
        assert_true(kernels->reach(n, x, stride, &w, scale).upper == -INFINITY);
    }
}

/* A state in two doubles, advanced: to twice the precision in its first order. */
static void
states_are_advanced_in_two_doubles(void **state)
{
    enum { n = 6, room = n + 8, stride = 48 };
    double x[n * stride], y[room] = {0}, carry[room] = {0}, next[room], low[room];
    double least[room], size[room], scale[room], slope[room], terms[room];
    qdot_series_step step = {.n = n,
                             .x = x,
                             .stride = stride,
                             .s = 0.3,
                             .unit = 4,
                             .y = y,
                             .carry = carry,
                             .next = next,
                             .next_carry = low,
                             .least = least,
                             .size = size,
                             .scale = scale,
                             .slope = slope,
                             .terms = terms};

    (void)state;
    for (size_t i = 0; i < room; i++)
        least[i] = i % 2 ? 1e-3 : 1;
    for (size_t i = 0; i < n; i++) {
        y[i] = 2 * some(50 + i);
        carry[i] = 0x1p-55 * some(60 + i);
    }
    for (step.p = 3; step.p < stride; step.p += 2)
        for (size_t kind = 0; qdot_series_kernels_at(kind); kind++) {
            step.linked = (size_t)step.p / 2 % 2 ? 2 : 5;
            for (size_t i = 0; i < n * stride; i++)
                x[i] = i % stride > (size_t)step.p
                           ? NAN
                           : some(i) * pow(0.01, (double)(i % stride) - 1);
            qdot_series_kernels_at(kind)->advance(&step);
            for (size_t i = 0; i < n; i++) {
                long double sum = (long double)y[i] + carry[i], d = 0, power = 1;

                if (i < step.linked && step.linked + i < n)
                    sum += step.s * step.unit * (long double)carry[step.linked + i];
                for (int k = 1; k <= step.p; k++) {
                    power *= step.s;
                    d += (long double)k * x[i * stride + (size_t)k] * power;
                    sum += x[i * stride + (size_t)k] * power;
                }
                if (!(fabsl(next[i] - sum + low[i]) < 0x1p-60L))
                    fail_msg("%zu: off by %.3Lg", i, next[i] - sum + low[i]);
                assert_true(fabs(low[i]) <= 0x1p-53 * fabs(next[i]));
                assert_true(size[i] == fmax(least[i], fabs(next[i])));
                assert_true(scale[i] == 1 / size[i]);
                if (i < step.linked)
                    continue;
                close_to(slope[i], d, 2, "slope", i);
                close_to(terms[i], fabsl(d) + fabs(step.s * x[i * stride + 1]) + size[i],
                         2, "terms", i);
            }
        }
}

/* From its beginning no series strays further. */
static void
spans_are_sums_of_sizes(void **state)
{
    enum { stride = 48 };
    double x[stride];

    (void)state;
    for (int p = 3; p < stride; p++)
        for (size_t kind = 0; qdot_series_kernels_at(kind); kind++) {
            long double sum = 0;

            for (int k = 0; k < stride; k++)
                x[k] = k > p ? NAN : some((size_t)(p + k));
            for (int k = 1; k <= p; k++)
                sum += fabsl(x[k] * powl(0.9, k));
            close_to(qdot_series_kernels_at(kind)->span(x, p, -0.9), sum, 4, "span",
                     (size_t)p);
        }
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(peaks_are_the_largest_and_lose_nothing),
        cmocka_unit_test(reach_is_the_least_of_its_half),
        cmocka_unit_test(states_are_advanced_in_two_doubles),
        cmocka_unit_test(spans_are_sums_of_sizes),
        cmocka_unit_test(products_of_series_are_sums_of_products),
        cmocka_unit_test(members_are_taken_one_by_one),
        cmocka_unit_test(tails_are_values_and_slopes),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
