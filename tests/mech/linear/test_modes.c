/* Normal modes of chains, rings and symmetric networks: each is substituted into H a = w^2 M a, with numbers. */
#include "mech/kit.h"

#include <math.h>
#include <string.h>

#include "mech/dynamics/generic.h"
#include "mech/linear/modes.h"
#include "mech/scene/scene.h"

enum { MOST = 14 };

static qdot_expr
same_expression(void *user, qdot_expr e)
{
    (void)user;
    return e;
}

static const double stiffness = 1.37, mass = 0.83;

/* M and H [n x n] in units of m1 and g, and the modes that are found: all of them, ascending, orthogonal in M. */
static void
check_modes(kit *k, size_t n, const double *M, const double *H)
{
    const qdot_expr symbols[2] = {E(k, "m1"), E(k, "g")};
    const double values[2] = {mass, stiffness};
    const qdot_generic_point point = {2, symbols, values, 1};
    qdot_modes modes;
    double w[MOST], a[MOST * MOST];
    qdot_expr rest[MOST];

    for (size_t i = 0; i < n; i++)
        rest[i] = qdot_rel(k->pool, QDOT_EQ, k->scene->coordinates.at[i], QDOT_ZERO);
    must(qdot_modes_about(k->scene, qdot_list(k->pool, (uint32_t)n, rest), false, same_expression, NULL, &modes));
    assert_int_equal(modes.n, n);
    assert_false(modes.numeric);
    assert_false(modes.unordered);
    must(qdot_generic_evaluate(k->pool, n, modes.frequency, &point, w));
    must(qdot_generic_evaluate(k->pool, n * n, modes.amplitude, &point, a));
    for (size_t i = 0; i < n; i++) {
        assert_true(i == 0 || w[i] >= w[i - 1] - 1e-12);
        for (size_t r = 0; r < n; r++) {
            double left = 0;

            for (size_t c = 0; c < n; c++)
                left += (stiffness * H[r * n + c] - w[i] * w[i] * mass * M[r * n + c]) * a[i * n + c];
            assert_true(fabs(left) < 1e-10);
        }
        for (size_t other = 0; other < i; other++) {
            double product = 0;

            for (size_t c = 0; c < n * n; c++)
                product += a[i * n + c / n] * M[c] * a[other * n + c % n];
            assert_true(fabs(product) < 1e-9);
        }
    }
    qdot_modes_clear(&modes);
}

/* The scene with these matrices, whose entries are multiples of 1/8. */
static void
declare_motion(kit *k, size_t n, const double *M, const double *H)
{
    char names[4 * MOST + 1] = "";
    qdot_expr L = QDOT_ZERO;

    for (size_t i = 0; i < n; i++)
        snprintf(names + strlen(names), 4, " q%c", (char)('a' + i));
    coords(k, names);
    for (size_t i = 0; i < n; i++)
        for (size_t c = 0; c < n; c++) {
            const int a = 'a' + (int)i, b = 'a' + (int)c;

            L = qdot_add(k->pool, L, E(k, "%g/16*m1*q%c'*q%c'", 8 * M[i * n + c], a, b));
            L = qdot_sub(k->pool, L, E(k, "(%g)/16*g*q%c*q%c", 8 * H[i * n + c], a, b));
        }
    must(qdot_scene_lagrangian(k->scene, L));
}

/* A uniform chain with two ends: fixed, free, held half a spring away, half a mass; `by` adds to the stiffness of each. */
static void
check_chain(kit *k, size_t n, int first, int last, double by)
{
    double M[MOST * MOST] = {0}, H[MOST * MOST] = {0};
    const int ends[2] = {first, last};

    for (size_t i = 0; i < n; i++) {
        M[i * n + i] = 1;
        H[i * n + i] = 2 + by;
        if (i + 1 < n)
            H[i * n + i + 1] = H[(i + 1) * n + i] = -1;
    }
    for (int e = 0; e < 2; e++) {
        const size_t i = e == 0 ? 0 : n * n - 1;

        H[i] += ends[e] == 1 ? -1 : ends[e] == 2 ? 1 : 0;
        H[i] /= ends[e] == 3 ? 2 : 1;
        M[i] /= ends[e] == 3 ? 2 : 1;
    }
    declare_motion(k, n, M, H);
    check_modes(k, n, M, H);
}

static void
chains_with_all_ends_body(kit *k)
{
    (void)k;
    for (int first = 0; first < 4; first++)
        for (int last = 0; last < 4; last++) {
            kit own;

            kit_open(&own);
            check_chain(&own, 7 + (size_t)((first + 2 * last) % 3), first, last, (first + last) % 2 == 0 ? 0 : 0.25);
            kit_close(&own);
        }
}
TEST(chains_with_all_ends)

/* n masses on a ring with springs to the next and to the one after that, and to the places of rest. */
static void
check_ring(size_t n, double next, double after, double own)
{
    double M[MOST * MOST] = {0}, H[MOST * MOST] = {0};
    kit k;

    for (size_t i = 0; i < n; i++) {
        M[i * n + i] = 1;
        H[i * n + i] += 2 * (next + after) + own;
        for (size_t step = 1; step <= 2; step++) {
            const double spring = step == 1 ? next : after;

            H[i * n + (i + step) % n] -= spring;
            H[(i + step) % n * n + i] -= spring;
        }
    }
    kit_open(&k);
    declare_motion(&k, n, M, H);
    check_modes(&k, n, M, H);
    kit_close(&k);
}

static void
rings_body(kit *k)
{
    (void)k;
    for (size_t n = 5; n <= 12; n++)
        check_ring(n, 1, n % 2 == 0 ? 0.5 : 0, n % 3 == 0 ? 0.25 : 0);
}
TEST(rings)

/* Masses that all others pull alike: n - 1 modes of one frequency. */
static void
equal_frequencies_are_orthogonal_body(kit *k)
{
    (void)k;
    for (size_t n = 3; n <= 6; n++) {
        double M[MOST * MOST] = {0}, H[MOST * MOST] = {0};
        kit own;

        for (size_t i = 0; i < n * n; i++) {
            H[i] = i % (n + 1) == 0 ? (double)n - 1 : -1;
            M[i] = i % (n + 1) == 0 ? 1 : 0;
        }
        kit_open(&own);
        declare_motion(&own, n, M, H);
        check_modes(&own, n, M, H);
        kit_close(&own);
    }
}
TEST(equal_frequencies_are_orthogonal)

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(chains_with_all_ends),
        cmocka_unit_test(rings),
        cmocka_unit_test(equal_frequencies_are_orthogonal),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
