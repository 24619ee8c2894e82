/* test_solid.c -- solids of uniform density with a given mass and moments. */
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <cmocka.h>

#include <math.h>

#include "lang/figures/solid.h"

static void
near(double x, double want)
{
    if (!(fabs(x - want) <= 1e-12 * fmax(1, fabs(want))))
        fail_msg("%.17g, want %.17g", x, want);
}

/* m = 2, r = 3: I = 9. */
static void
free_body_is_a_disc(void **state)
{
    qdot_animation_body b = {0};

    (void)state;
    qdot_solid_plane(2, 9, NULL, 0, &b);
    assert_true(b.disc);
    near(b.half[0], 3);
}

/* A rod of length 2.4 and mass 0.7 that turns about its end: I = m l^2/12. */
static void
rod_has_its_length(void **state)
{
    const double arms[][2] = {{0, 0.3}, {0, 1.2}};
    qdot_animation_body b = {0};

    (void)state;
    qdot_solid_plane(0.7, 0.7 * 2.4 * 2.4 / 12, arms, 2, &b);
    assert_false(b.disc);
    near(b.half[0], 1.2);
    assert_true(b.half[1] < 1e-7);
    near(b.turn[0], 0);
    near(b.turn[1], 1);
}

/* A place far away makes it no longer than its moment allows. */
static void
moment_is_that_of_the_body(void **state)
{
    const double arms[][2] = {{-10, 0}}, at[][2] = {{0.5, 0}};
    qdot_animation_body b = {0};

    (void)state;
    qdot_solid_plane(3, 2.25, arms, 1, &b);
    near(3 * (b.half[0] * b.half[0] + b.half[1] * b.half[1]) / 3, 2.25);
    near(b.turn[0], -1);
    qdot_solid_plane(3, 2.25, at, 1, &b);
    near(b.half[0], 0.5);
    near(3 * (b.half[0] * b.half[0] + b.half[1] * b.half[1]) / 3, 2.25);
}

/* A crank pin on the rim of a wheel leaves it a wheel. */
static void
pin_on_the_rim(void **state)
{
    const double arms[][2] = {{1.5, 2}};
    qdot_animation_body b = {0};

    (void)state;
    qdot_solid_plane(4, 4 * 2.5 * 2.5 / 2, arms, 1, &b);
    assert_true(b.disc);
    near(b.half[0], 2.5);
}

static void
without_mass_it_has_no_size(void **state)
{
    qdot_animation_body b = {0};
    const double none[9] = {0};

    (void)state;
    qdot_solid_plane(0, 0, NULL, 0, &b);
    assert_true(b.half[0] == 0);
    qdot_solid_space(0, none, &b);
    assert_true(b.half[0] == 0 && b.half[2] == 0);
}

/* Half axes 3, 2, 1 turned out of the body's axes: the moments along what was found are those. */
static void
ellipsoid_has_its_moments(void **state)
{
    const double m = 1.7, half[] = {3, 2, 1}, u = 0.7, w = -0.4;
    const double axis[3][3] = {{cos(u), sin(u), 0},
                               {-sin(u) * cos(w), cos(u) * cos(w), sin(w)},
                               {sin(u) * sin(w), -cos(u) * sin(w), cos(w)}};
    double inertia[9] = {0}, found[3];
    qdot_animation_body b = {0};

    (void)state;
    for (int k = 0; k < 3; k++) {
        double other = 0;

        for (int j = 0; j < 3; j++)
            other += j != k ? half[j] * half[j] : 0;
        for (int i = 0; i < 9; i++)
            inertia[i] += m / 5 * other * axis[k][i / 3] * axis[k][i % 3];
    }
    qdot_solid_space(m, inertia, &b);
    for (int k = 0; k < 3; k++) {
        double length = 0, along = 0;

        found[k] = b.half[k];
        for (int d = 0; d < 3; d++)
            length += b.principal[3 * k + d] * b.principal[3 * k + d];
        near(length, 1);
        for (int j = 0; j < 3; j++) {
            double cosine = 0;

            for (int d = 0; d < 3; d++)
                cosine += b.principal[3 * k + d] * axis[j][d];
            if (fabs(half[j] - b.half[k]) < 1e-9)
                along = fabs(cosine);
        }
        near(along, 1);
    }
    near(found[0] + found[1] + found[2], 6);
    near(found[0] * found[1] * found[2], 6);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(free_body_is_a_disc),
        cmocka_unit_test(rod_has_its_length),
        cmocka_unit_test(moment_is_that_of_the_body),
        cmocka_unit_test(pin_on_the_rim),
        cmocka_unit_test(without_mass_it_has_no_size),
        cmocka_unit_test(ellipsoid_has_its_moments),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
