/* test_orbits.c -- branches of periodic orbits, against published numbers and closed forms. */
#include "expr/build.h"
#include "sim/scenes.h"

#include <math.h>

#include "base/interrupt.h"
#include "expr/calculus.h"
#include "sim/branches/orbit-continuation.h"
#include "sim/branches/orbit-period.h"

static void
near(double is, double truth, double within)
{
    if (!(fabs(is - truth) <= within))
        fail_msg("%.17g for %.17g", is, truth);
}

static qdot_expr
half_square(fixture *f, qdot_expr x)
{
    return times(f, QDOT_HALF, times(f, x, x));
}

/* x'' = -x + mu (1 - x^2) x' */
static qdot_expr
van_der_pol(fixture *f)
{
    qdot_expr x, mu;

    begin(f);
    x = coordinate(f, "x");
    mu = set_free(f, "mu");
    must(qdot_scene_particle(f->scene, "a", QDOT_ONE, x));
    must(qdot_scene_potential(f->scene, half_square(f, x)));
    must(qdot_scene_dissipation(
        f->scene, times(f, half_square(f, velocity(f, x)),
                        times(f, mu, qdot_sub(f->pool, times(f, x, x), QDOT_ONE)))));
    return mu;
}

/* The period at mu = 1 is 6.6632868593231301896996820305 */
static void
a_limit_cycle(void **state)
{
    const double z[] = {2.0086, 0};
    qdot_continuation x = {0};
    const qdot_branch *b;
    fixture f;
    qdot_expr mu;

    (void)state;
    mu = van_der_pol(&f);
    must(qdot_orbit_continuation_find(&(qdot_orbit_of){f.scene, &f.request, QDOT_ORBIT_PARAMETER, mu,
                                                       1, 6.66, z, 0.5, 2, 0},
                                      &x));
    assert_int_equal(x.branches.n, 1);
    assert_int_equal(x.bifurcations.n, 0);
    b = &x.branches.at[0];
    assert_true(b->end[0] == QDOT_END_RANGE && b->end[1] == QDOT_END_RANGE && b->n > 20);
    for (size_t k = 0; k < b->n; k++) {
        const double *y = b->y + k * x.width; /* x, x', T, mu, max(x), multipliers */

        assert_int_equal(b->stability[k], QDOT_STABLE);
        assert_true(y[1] == 0);
        near(y[4], y[0], 1e-12);
        near(y[5], 1, 0);
        if (y[3] == 1)
            near(y[2], 6.6632868593231302, 1e-13);
    }
    qdot_continuation_clear(&x);
    end(&f);
}

/* The same cycle in three segments, whose states are further unknowns behind the period. */
static void
a_cycle_in_segments(void **state)
{
    const double z[] = {2.0086, 0};
    qdot_continuation x = {0};
    bool met = false;
    fixture f;
    qdot_expr mu;

    (void)state;
    mu = van_der_pol(&f);
    must(qdot_orbit_continuation_find(&(qdot_orbit_of){f.scene, &f.request, QDOT_ORBIT_PARAMETER, mu,
                                                       1, 6.66, z, 0.9, 1.1, 3},
                                      &x));
    assert_int_equal(x.branches.n, 1);
    assert_int_equal(x.n, 3 + 2 * 2);
    for (size_t k = 0; k < x.branches.at[0].n; k++) {
        const double *y = x.branches.at[0].y + k * x.width;

        near(y[x.n + 1], y[0], 1e-12);
        if (y[x.n] == 1) {
            met = true;
            near(y[2], 6.6632868593231302, 1e-13);
            near(y[x.n + 3], 8.596950636e-4, 1e-12); /* exp of the mean of mu (1 - x^2), by SciPy */
        }
    }
    assert_true(met);
    qdot_continuation_clear(&x);
    end(&f);
}

static qdot_status
follow_cycle(fixture *f, qdot_expr mu, qdot_continuation *x)
{
    const double z[] = {2.0086, 0};

    return qdot_orbit_continuation_find(&(qdot_orbit_of){f->scene, &f->request, QDOT_ORBIT_PARAMETER,
                                                         mu, 1, 6.66, z, 0.9, 1.1, 0},
                                        x);
}

/* Ctrl-C at any moment: points that are known stay. */
static void
keeps_what_is_known(void **state)
{
    bool some = false, whole = false;
    fixture f;
    qdot_expr mu;

    (void)state;
    mu = van_der_pol(&f);
    for (int64_t n = 0; !whole; n += 1 + n / 5) {
        qdot_continuation x = {0};
        qdot_status status;

        f.scene->version++; /* derive again */
        qdot_memory_press_at(n);
        status = follow_cycle(&f, mu, &x);
        qdot_memory_press_at(-1);
        qdot_interrupt_clear();
        assert_true(status == QDOT_OK || status == QDOT_EINTR);
        whole = status == QDOT_OK && !x.interrupted;
        some = some || (x.interrupted && x.branches.n > 0);
        qdot_continuation_clear(&x);
    }
    assert_true(some);
    end(&f);
}

static void
survives_failed_allocations_too(void **state)
{
    qdot_status status = QDOT_ENOMEM;
    fixture f;
    qdot_expr mu;
    int64_t n = 0;

    (void)state;
    mu = van_der_pol(&f);
    for (; status != QDOT_OK && n < 400000; n += 1 + n / 8) {
        qdot_continuation x = {0};

        f.scene->version++;
        qdot_memory_fail_at(n);
        status = follow_cycle(&f, mu, &x);
        qdot_memory_fail_at(-1);
        assert_true(status == QDOT_OK || status == QDOT_ENOMEM);
        qdot_continuation_clear(&x);
    }
    assert_true(status == QDOT_OK && n > 20);
    end(&f);
}

static double
pendulum_period(double amplitude) /* 2 pi over the mean of 1 and cos(theta/2) */
{
    double a = 1, b = cos(amplitude / 2);

    for (int k = 0; k < 40; k++) {
        const double mean = (a + b) / 2;

        b = sqrt(a * b);
        a = mean;
    }
    return 2 * M_PI / a;
}

/* The pendulum's orbits over their amplitude, and over the energy. */
static void
a_family(void **state)
{
    const double z[] = {1, 0}, range[2][2] = {{0.5, 2.5}, {-0.9, 0.9}};

    (void)state;
    for (int by_energy = 0; by_energy < 2; by_energy++) {
        qdot_continuation x = {0};
        fixture f;
        qdot_expr q;

        begin(&f);
        q = coordinate(&f, "theta");
        must(qdot_scene_lagrangian(f.scene, qdot_add(f.pool, half_square(&f, velocity(&f, q)),
                                                     qdot_fun1(f.pool, QDOT_COS, q))));
        must(qdot_orbit_continuation_find(
            &(qdot_orbit_of){f.scene, &f.request, by_energy ? QDOT_ORBIT_ENERGY : QDOT_ORBIT_START,
                             by_energy ? QDOT_NIL : q, 1, 6.7, z, range[by_energy][0],
                             range[by_energy][1], 0},
            &x));
        assert_int_equal(x.branches.n, 1);
        for (size_t k = 0; k < x.branches.at[0].n; k++) {
            const double *y = x.branches.at[0].y + k * x.width; /* theta, theta', T, lambda, p ... */

            assert_int_equal(x.branches.at[0].stability[k], QDOT_STABLE_TO_FIRST_ORDER);
            near(y[2], pendulum_period(y[0]), 2e-12 * y[2]);
            near(y[3], 0, 1e-11);
            near(y[4], by_energy ? -cos(y[0]) : y[0], 1e-13);
        }
        qdot_continuation_clear(&x);
        end(&f);
    }
}

/* theta'' = -(1 + a cos 2t) sin theta - theta'/10: rest is an orbit, whose multiplier passes -1 at a of Mathieu's equation,
 * by SciPy 0.20010934214887. From there the orbits of period 2 pi: at a = 1 (SciPy) it goes to 1.66042842625753. */
static void
a_period_doubling(void **state)
{
    const double z[] = {0, 0};
    qdot_continuation x = {0};
    const qdot_bifurcation *b;
    qdot_expr q, a, drive;
    fixture f;

    (void)state;
    begin(&f);
    q = coordinate(&f, "theta");
    a = set_free(&f, "a");
    drive = qdot_add(f.pool, QDOT_ONE,
                     times(&f, a, qdot_fun1(f.pool, QDOT_COS, times(&f, number(&f, "2"), QDOT_T))));
    must(qdot_scene_lagrangian(f.scene, qdot_add(f.pool, half_square(&f, velocity(&f, q)),
                                                 times(&f, drive, qdot_fun1(f.pool, QDOT_COS, q)))));
    must(qdot_scene_dissipation(f.scene,
                                times(&f, number(&f, "0.1"), half_square(&f, velocity(&f, q)))));
    must(qdot_orbit_continuation_find(&(qdot_orbit_of){f.scene, &f.request, QDOT_ORBIT_PARAMETER, a,
                                                       0.1, M_PI, z, 0, 1, 0},
                                      &x));
    assert_int_equal(x.bifurcations.n, 1);
    b = &x.bifurcations.at[0];
    assert_int_equal(b->kind, QDOT_DOUBLING);
    near(b->y[3], 0.20010934214887, 1e-13);
    assert_true(b->error[3] < 1e-12);
    near(b->y[2], M_PI, 1e-15);
    near(b->y[5], 1, 1e-11); /* the modulus of its multipliers */
    assert_int_equal(x.branches.n, 2);
    for (size_t k = 0; k < x.branches.at[1].n; k++) {
        const double *y = x.branches.at[1].y + k * x.width;

        near(y[2], 2 * M_PI, 1e-15);
        assert_int_equal(x.branches.at[1].mark[k], y[3] == b->y[3]);
        if (y[3] == 1)
            near(y[4], 1.66042842625753, 1e-11);
    }
    qdot_continuation_clear(&x);
    end(&f);
}

/* x'' = x - x^3 - x'/4 + F cos t: between two period doublings of an orbit lies one branch of twice its period, and
 * between two of that one of four times: each is found once, and ends at both. */
static void
doubled_orbits_end_where_they_become_one(void **state)
{
    const double z[] = {1.207002813, 2.36979258};
    qdot_continuation x = {0};
    qdot_expr q, F, square;
    fixture f;

    (void)state;
    begin(&f);
    q = coordinate(&f, "x");
    F = set_free(&f, "F");
    square = times(&f, q, q);
    must(qdot_scene_particle(f.scene, "a", QDOT_ONE, q));
    must(qdot_scene_potential(f.scene, qdot_sub(f.pool, times(&f, number(&f, "0.25"), times(&f, square, square)),
                                                half_square(&f, q))));
    must(qdot_scene_potential(f.scene,
                              qdot_neg(f.pool, times(&f, F, times(&f, q, qdot_fun1(f.pool, QDOT_COS, QDOT_T))))));
    must(qdot_scene_dissipation(f.scene, times(&f, number(&f, "0.25"), half_square(&f, velocity(&f, q)))));
    must(qdot_orbit_continuation_find(
        &(qdot_orbit_of){f.scene, &f.request, QDOT_ORBIT_PARAMETER, F, 2.5, 2 * M_PI, z, 2.3, 3.6, 0}, &x));
    assert_int_equal(x.branches.n, 3);
    for (size_t k = 1; k < 3; k++) {
        const qdot_branch *const b = &x.branches.at[k];
        const size_t from = b->mark[0] - 1, to = b->mark[b->n - 1] - 1;

        assert_int_equal(x.bifurcations.at[from].kind, QDOT_DOUBLING);
        assert_int_equal(x.bifurcations.at[to].kind, QDOT_DOUBLING);
        near(b->y[2], 2 * x.bifurcations.at[to].y[2], 1e-12);
        near(fabs(x.bifurcations.at[to].y[3] - x.bifurcations.at[from].y[3]), k == 1 ? 0.8844750378234 : 0.7069784989292,
             1e-11);
    }
    for (size_t i = 0; i < x.bifurcations.n; i++)
        assert_true(x.bifurcations.at[i].reached == (x.bifurcations.at[i].y[2] < 7 * M_PI));
    qdot_continuation_clear(&x);
    end(&f);
}

/* F cos(w t): the period follows w; beside cos(t) it does not. */
static void
a_drives_period(void **state)
{
    qdot_expr q, w, period, drive;
    bool driven;
    fixture f;

    (void)state;
    begin(&f);
    q = coordinate(&f, "x");
    w = set_free(&f, "w");
    drive = qdot_fun1(f.pool, QDOT_COS, times(&f, w, QDOT_T));
    must(qdot_scene_particle(f.scene, "a", QDOT_ONE, q));
    must(qdot_scene_potential(f.scene, half_square(&f, q)));
    must(qdot_orbit_is_driven(f.scene, &f.request, &driven));
    assert_false(driven);
    must(qdot_scene_potential(f.scene, times(&f, q, drive)));
    must(qdot_orbit_is_driven(f.scene, &f.request, &driven));
    assert_true(driven);
    must(qdot_orbit_period(f.scene, &f.request, w, 2, 2 * M_PI, 1, 3, &period));
    assert_true(period == qdot_div(f.pool, times(&f, number(&f, "4"), QDOT_PI), w));
    assert_int_equal(qdot_orbit_period(f.scene, &f.request, w, 2, 3, 1, 3, &period), QDOT_EINVAL);
    must(qdot_scene_potential(f.scene, times(&f, q, qdot_fun1(f.pool, QDOT_COS, QDOT_T))));
    assert_int_equal(qdot_orbit_period(f.scene, &f.request, w, 2, 2 * M_PI, 1, 3, &period),
                     QDOT_EINVAL);
    end(&f);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_limit_cycle), cmocka_unit_test(a_cycle_in_segments),     cmocka_unit_test(keeps_what_is_known),
        cmocka_unit_test(a_family),          cmocka_unit_test(a_period_doubling),
        cmocka_unit_test(doubled_orbits_end_where_they_become_one),
        cmocka_unit_test(a_drives_period),   cmocka_unit_test(survives_failed_allocations_too),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
