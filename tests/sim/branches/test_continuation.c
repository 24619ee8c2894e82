/* test_continuation.c -- branches of equilibria and their bifurcations, against closed forms. */
#include "expr/build.h"
#include "sim/scenes.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>

#include "base/interrupt.h"
#include "expr/calculus.h"
#include "sim/branches/rest-continuation.h"

static qdot_expr
bind(void *user, qdot_expr e)
{
    fixture *f = user;

    return qdot_subs(f->pool, e, f->request.n_values, f->symbols, f->values);
}

static qdot_expr
of(fixture *f, uint32_t function, qdot_expr x)
{
    return qdot_fun1(f->pool, function, x);
}

/* All curves over p. */
static void
follow(fixture *f, const char *p, double least, double most, qdot_equilibrium_curve *c,
       qdot_continuation *x)
{
    must(qdot_equilibrium_curve_begin(c, f->scene, parameter(f, p), bind, f));
    must(qdot_rest_continuation_find(c, least, most, x));
}

static void
finish(fixture *f, qdot_equilibrium_curve *c, qdot_continuation *x)
{
    qdot_continuation_clear(x);
    qdot_equilibrium_curve_end(c);
    end(f);
}

/* A bifurcation at y of one coordinate and p, to the last bits. */
static void
is(const qdot_bifurcation *b, qdot_bifurcation_kind kind, double q, double p)
{
    assert_int_equal(b->kind, kind);
    if (fabs(b->y[0] - q) > 2e-16 * fmax(1, fabs(q)) || fabs(b->y[1] - p) > 2e-16 * fmax(1, fabs(p)))
        fail_msg("at %.17g, %.17g, not %.17g, %.17g", b->y[0], b->y[1], q, p);
    assert_true(b->error[0] < 1e-15 && b->error[1] < 1e-15);
}

/* x'' = mu x - x^3 - x'/10: a pitchfork at 0; on the arms x^2 = mu. */
static void
a_pitchfork(void **state)
{
    qdot_equilibrium_curve c = {0};
    qdot_continuation x = {0};
    fixture f;
    qdot_expr q;

    (void)state;
    begin(&f);
    q = coordinate(&f, "x");
    must(qdot_scene_particle(f.scene, "a", QDOT_ONE, q));
    must(qdot_scene_potential(
        f.scene, qdot_add(f.pool, times(&f, number(&f, "-0.5"), times(&f, parameter(&f, "mu"), times(&f, q, q))),
                          times(&f, number(&f, "0.25"), qdot_pow_int(f.pool, q, 4)))));
    must(qdot_scene_dissipation(f.scene, times(&f, number(&f, "0.05"),
                                               times(&f, velocity(&f, q), velocity(&f, q)))));
    follow(&f, "mu", -1, 2, &c, &x);
    assert_int_equal(x.branches.n, 2);
    assert_int_equal(x.bifurcations.n, 1);
    is(&x.bifurcations.at[0], QDOT_PITCHFORK, 0, 0);
    for (size_t i = 0; i < 2; i++) {
        const qdot_branch *b = &x.branches.at[i];

        assert_true(b->n > 100 && b->end[0] == QDOT_END_RANGE && b->end[1] == QDOT_END_RANGE);
        for (size_t k = 0; k < b->n; k++) {
            const double *y = b->y + 2 * k;

            assert_true(fabs(y[0] * (y[1] - y[0] * y[0])) < 1e-14);
            if (b->mark[k] > 0 || fabs(y[1]) < 1e-6)
                continue;
            assert_int_equal(b->stability[k],
                             i == 1 || y[1] < 0 ? QDOT_STABLE : QDOT_UNSTABLE);
        }
    }
    finish(&f, &c, &x);
}

/* sin theta = tau: one closed curve, folds at tau = +-1. */
static void
a_closed_curve(void **state)
{
    qdot_equilibrium_curve c = {0};
    qdot_continuation x = {0};
    const qdot_branch *b;
    fixture f;
    qdot_expr q;

    (void)state;
    begin(&f);
    q = coordinate(&f, "theta");
    must(qdot_scene_particle(f.scene, "a", QDOT_ONE,
                             pair(&f, of(&f, QDOT_SIN, q), qdot_neg(f.pool, of(&f, QDOT_COS, q)))));
    must(qdot_scene_gravity(f.scene, pair(&f, QDOT_ZERO, QDOT_MINUS_ONE)));
    must(qdot_scene_potential(f.scene, qdot_neg(f.pool, times(&f, parameter(&f, "tau"), q))));
    follow(&f, "tau", -3, 2, &c, &x);
    assert_int_equal(x.branches.n, 1);
    assert_int_equal(x.bifurcations.n, 2);
    is(&x.bifurcations.at[0], QDOT_FOLD, M_PI / 2, 1);
    is(&x.bifurcations.at[1], QDOT_FOLD, -M_PI / 2, -1);
    b = &x.branches.at[0];
    assert_int_equal(b->end[0], QDOT_END_CLOSED);
    assert_true(fabs(fabs(b->y[2 * (b->n - 1)] - b->y[0]) - 2 * M_PI) < 1e-12); /* once around */
    finish(&f, &c, &x);
}

/* x'' = -(mu - 1/2)(mu - 1/2 - d) x - x^n: two crossings, however near; from 3e-8 on no sign of a
 * determinant tells them apart. */
static void
pairs_of_crossings(void **state)
{
    static const struct {
        const char *d, *half;
        unsigned n;
    } rows[] = {{"0.000001", "0.5", 3}, {"0.00000001", "0.5", 3}, {"0.0000000001", "0.5", 3},
                {"0.000001", "0.5", 2}, {"0.00000002", "0.5", 2}};

    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        qdot_equilibrium_curve c = {0};
        qdot_continuation x = {0};
        fixture f;
        qdot_expr q, square, off, well;
        double least = INFINITY, most = -INFINITY;

        begin(&f);
        q = coordinate(&f, "x");
        square = times(&f, q, q);
        off = qdot_sub(f.pool, parameter(&f, "mu"), number(&f, rows[i].half));
        off = times(&f, off, qdot_sub(f.pool, off, number(&f, rows[i].d)));
        well = rows[i].n == 3 ? times(&f, number(&f, "0.25"), times(&f, square, square))
                              : times(&f, number(&f, "0.5"), times(&f, square, q));
        must(qdot_scene_particle(f.scene, "a", QDOT_ONE, q));
        must(qdot_scene_potential(
            f.scene, qdot_add(f.pool, well, times(&f, number(&f, "0.5"), times(&f, off, square)))));
        follow(&f, "mu", -1, 1, &c, &x);
        assert_int_equal(x.bifurcations.n, 2);
        for (size_t k = 0; k < 2; k++) {
            const qdot_bifurcation *b = &x.bifurcations.at[k];

            assert_int_equal(b->kind, rows[i].n == 3 ? QDOT_PITCHFORK : QDOT_TRANSCRITICAL);
            least = fmin(least, b->y[1]);
            most = fmax(most, b->y[1]);
        }
        assert_true(fabs(least - 0.5) < 1e-15 && fabs(most - 0.5 - atof(rows[i].d)) < 1e-15);
        finish(&f, &c, &x);
    }
}

/* x'' = mu x' - 9 x: an oscillation of frequency 3 from mu = 0 on; a parameter without influence. */
static void
a_hopf_point(void **state)
{
    qdot_equilibrium_curve c = {0};
    qdot_continuation x = {0};
    fixture f;
    qdot_expr q;

    (void)state;
    begin(&f);
    q = coordinate(&f, "x");
    must(qdot_scene_particle(f.scene, "a", QDOT_ONE, q));
    must(qdot_scene_potential(f.scene, times(&f, number(&f, "4.5"), times(&f, q, q))));
    must(qdot_scene_dissipation(f.scene, times(&f, number(&f, "-0.5"),
                                               times(&f, parameter(&f, "mu"),
                                                     times(&f, velocity(&f, q), velocity(&f, q))))));
    follow(&f, "mu", -1, 2, &c, &x);
    assert_int_equal(x.branches.n, 1);
    assert_int_equal(x.bifurcations.n, 1);
    is(&x.bifurcations.at[0], QDOT_HOPF, 0, 0);
    assert_true(fabs(x.bifurcations.at[0].frequency - 3) < 1e-15);
    qdot_continuation_clear(&x);
    qdot_equilibrium_curve_end(&c);
    assert_int_equal(qdot_equilibrium_curve_begin(&c, f.scene, parameter(&f, "nu"), bind, &f),
                     QDOT_EINVAL);
    finish(&f, &c, &x);
}

/* x^3 (x^4 - c) = 0: x = 0 is at rest for every c, but the slope of the equation vanishes there: no steps follow it, the
 * formula does. */
static void
exact_equilibria_are_branches(void **state)
{
    qdot_equilibrium_curve c = {0};
    qdot_continuation x = {0};
    fixture f;
    qdot_expr q;

    (void)state;
    begin(&f);
    q = coordinate(&f, "x");
    must(qdot_scene_particle(f.scene, "a", QDOT_ONE, q));
    must(qdot_scene_potential(
        f.scene, qdot_sub(f.pool, times(&f, number(&f, "0.125"), qdot_pow_int(f.pool, q, 8)),
                          times(&f, times(&f, number(&f, "0.25"), parameter(&f, "mu")), qdot_pow_int(f.pool, q, 4)))));
    follow(&f, "mu", -1, 1, &c, &x);
    assert_int_equal(x.branches.n, 2);
    assert_int_equal(x.left.n, 0);
    assert_true(x.complete);
    for (size_t k = 0; k < x.branches.at[1].n; k++) {
        const double *y = x.branches.at[1].y + 2 * k;

        assert_true(y[0] == 0);
        if (y[1] < 0)
            assert_int_equal(x.branches.at[1].stability[k], QDOT_STABLE);
    }
    assert_true(x.branches.at[1].y[1] == -1 && x.branches.at[1].y[2 * x.branches.at[1].n - 1] == 1);
    finish(&f, &c, &x);
}

/* Out of memory at the n-th allocation, for n up to where it passes. */
static void
survives_failed_allocations_too(void **state)
{
    qdot_status status = QDOT_ENOMEM;
    fixture f;
    qdot_expr q;
    int64_t n = 0;

    (void)state;
    begin(&f);
    q = coordinate(&f, "x");
    must(qdot_scene_particle(f.scene, "a", QDOT_ONE, q));
    must(qdot_scene_potential(
        f.scene, qdot_sub(f.pool, times(&f, number(&f, "0.25"), qdot_pow_int(f.pool, q, 4)),
                          times(&f, parameter(&f, "mu"), times(&f, q, q)))));
    for (; status != QDOT_OK && n < 200000; n += 1 + n / 15) {
        qdot_equilibrium_curve c = {0};
        qdot_continuation x = {0};

        f.scene->version++; /* derive again */
        qdot_memory_fail_at(n);
        status = qdot_equilibrium_curve_begin(&c, f.scene, parameter(&f, "mu"), bind, &f);
        if (status == QDOT_OK)
            status = qdot_rest_continuation_find(&c, -1, 1, &x);
        qdot_memory_fail_at(-1);
        assert_true(status == QDOT_OK || status == QDOT_ENOMEM);
        qdot_continuation_clear(&x);
        qdot_equilibrium_curve_end(&c);
    }
    assert_true(status == QDOT_OK && n > 20);
    end(&f);
}

/* Ctrl-C at any moment: branches that are known stay. */
static void
keeps_what_is_known(void **state)
{
    bool some = false, whole = false;
    fixture f;
    qdot_expr q;

    (void)state;
    begin(&f);
    q = coordinate(&f, "x");
    must(qdot_scene_particle(f.scene, "a", QDOT_ONE, q));
    must(qdot_scene_potential(
        f.scene, qdot_sub(f.pool, times(&f, number(&f, "0.25"), qdot_pow_int(f.pool, q, 4)),
                          times(&f, parameter(&f, "mu"), times(&f, q, q)))));
    for (int64_t n = 0; !whole; n += 1 + n / 60) {
        qdot_equilibrium_curve c = {0};
        qdot_continuation x = {0};

        must(qdot_equilibrium_curve_begin(&c, f.scene, parameter(&f, "mu"), bind, &f));
        qdot_memory_press_at(n);
        must(qdot_rest_continuation_find(&c, -1, 1, &x));
        qdot_memory_press_at(-1);
        qdot_interrupt_clear();
        whole = !x.interrupted;
        some = some || (x.interrupted && x.branches.n > 0);
        if (!x.interrupted && x.branches.n != 2)
            fail_msg("%" PRId64 ": %zu branches", n, x.branches.n);
        qdot_continuation_clear(&x);
        qdot_equilibrium_curve_end(&c);
    }
    assert_true(some);
    end(&f);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_pitchfork),
        cmocka_unit_test(a_closed_curve),
        cmocka_unit_test(pairs_of_crossings),
        cmocka_unit_test(a_hopf_point),
        cmocka_unit_test(exact_equilibria_are_branches),
        cmocka_unit_test(survives_failed_allocations_too),
        cmocka_unit_test(keeps_what_is_known),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
