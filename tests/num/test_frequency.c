/* Magnitude and phase by zeros and poles against complex arithmetic, and without wrapping. */
#include <complex.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "num/frequency.h"

static double complex
by_factors(const qdot_frequency *G, double w)
{
    double complex product = G->gain;

    for (size_t k = 0; k < G->zero.n; k++)
        product *= I * w - (G->zero.re[k] + I * G->zero.im[k]);
    for (size_t k = 0; k < G->pole.n; k++)
        product /= I * w - (G->pole.re[k] + I * G->pole.im[k]);
    return product;
}

static const double zero_re[] = {-0.7, 2.3, 0.4, 0.4}, zero_im[] = {0, 0, 1.9, -1.9},
                    pole_re[] = {0, -3.1, -0.2, -0.2, 1.3, 1.3}, pole_im[] = {0, 0, 2.6, -2.6, 0.8, -0.8};
static const qdot_frequency mixed = {-2.4, {4, zero_re, zero_im}, {6, pole_re, pole_im}};

static void
agrees_with_complex_arithmetic(void **state)
{
    (void)state;
    for (double w = 0.013; w < 90; w *= 1.37) {
        const double complex G = by_factors(&mixed, w);
        const double turns = (qdot_frequency_degrees(&mixed, w) - carg(G) * 180 / M_PI) / 360;

        assert_true(fabs(qdot_frequency_decibels(&mixed, w) - 20 * log10(cabs(G))) < 1e-12 * 100);
        assert_true(fabs(turns - round(turns)) < 1e-13);
    }
}

/* Between near frequencies the phase changes little: it does not wrap. */
static void
phase_is_continuous(void **state)
{
    double before = qdot_frequency_degrees(&mixed, 0.01);

    (void)state;
    for (double w = 0.01; w < 100; w *= 1.001) {
        const double now = qdot_frequency_degrees(&mixed, w);

        assert_true(fabs(now - before) < 1.5);
        before = now;
    }
}

/* A pair on the axis: nothing below, half a turn back above for a pole; 1/s^2 is -180 everywhere, and infinite at its pole. */
static void
phase_jumps_at_roots_on_the_axis(void **state)
{
    const double re[] = {0, 0}, im[] = {2.5, -2.5}, none[] = {0, 0};
    const qdot_frequency pair = {3.2, {0, none, none}, {2, re, im}}, twice = {3.2, {0, none, none}, {2, none, none}};

    (void)state;
    assert_true(qdot_frequency_degrees(&pair, 2.4) == 0);
    assert_true(fabs(qdot_frequency_degrees(&pair, 2.6) + 180) < 1e-12);
    assert_true(fabs(qdot_frequency_degrees(&twice, 0.3) + 180) < 1e-12);
    assert_true(isinf(qdot_frequency_decibels(&pair, 2.5)) && qdot_frequency_decibels(&pair, 2.5) > 0);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(agrees_with_complex_arithmetic),
        cmocka_unit_test(phase_is_continuous),
        cmocka_unit_test(phase_jumps_at_roots_on_the_axis),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
