/* test_motion.c -- M q'' = f, d'Alembert's residual and Hamilton's equations as programs: the same
 * series in MPFR, and of the first two in two doubles as far as these hold. */
#include "expr/build.h"
#include "expr/function.h"
#include "sim/scenes.h"

#include <math.h>

#include "sim/form/canonical.h"
#include "sim/form/motion-series.h"
#include "sim/form/leading.h"
#include "sim/form/motion-of-residual.h"
#include "sim/form/precise-bind.h"
#include "sim/form/residual.h"
#include "sim/plan/plan.h"

enum { P = 12, BITS = 256, MOST = 2 * MOST_COORDINATES };

typedef struct {
    qdot_plan *plan;
    qdot_residual *residual;
    const double *y;
    double t;
} place;

static void
put(mpfr_t x, double value)
{
    mpfr_init2(x, BITS);
    mpfr_set_d(x, value, MPFR_RNDN);
}

static qdot_precise_bind *
expand_precise(const place *at)
{
    const size_t n = 2 * at->plan->n;
    const qdot_precise_system *s;
    qdot_precise_bind *bind;
    mpfr_t y[MOST], t;

    must(qdot_precise_bind_new(at->plan, P, BITS, &bind));
    s = qdot_precise_bind_system(bind);
    put(t, at->t);
    for (size_t i = 0; i < n; i++)
        put(y[i], at->y[i]);
    must(s->begin(t, (const mpfr_t *)y, s->user));
    must(s->extend(P, s->user));
    for (size_t i = 0; i < n; i++)
        mpfr_clear(y[i]);
    mpfr_clear(t);
    return bind;
}

static void
precise_agree(const qdot_precise_bind *a, const qdot_precise_bind *b)
{
    const qdot_precise_system *x = qdot_precise_bind_system(a), *y = qdot_precise_bind_system(b);
    mpfr_t d;

    mpfr_init2(d, BITS);
    for (size_t i = 0; i < x->n; i++)
        for (size_t k = 0; k <= P; k++) {
            mpfr_srcptr u = x->x[i * x->stride + k], v = y->x[i * y->stride + k];

            mpfr_sub(d, u, v, MPFR_RNDN);
            if (!(fabs(mpfr_get_d(d, MPFR_RNDN))
                  <= 0x1p-225 * (1 + fabs(mpfr_get_d(u, MPFR_RNDN)))))
                fail_msg("component %zu, order %zu: %g apart", i, k, mpfr_get_d(d, MPFR_RNDN));
        }
    mpfr_clear(d);
}

/* First orders in units of 1/8, against those in units of 1. */
static void
leading_agrees(const place *at, const qdot_ode_series *series, const qdot_precise_bind *bind)
{
    const qdot_precise_system *s = qdot_precise_bind_system(bind);
    const qdot_ode_place from = {at->t, 0, at->y, NULL};
    const qdot_ode_leading *leading;
    qdot_leading *l;
    mpfr_t d;

    mpfr_init2(d, BITS);
    must(qdot_leading_new(at->plan, series, &l));
    leading = qdot_leading_get(l);
    must(leading->begin(&from, 0.125, leading->user));
    for (int k = 1; k <= QDOT_ODE_LEADING_MOST; k++)
        must(leading->next(k, leading->user));
    for (size_t i = 0; i < s->n; i++)
        for (size_t k = 0; k <= P; k++) {
            const qdot_two x = leading->x[i * leading->stride + k];
            double size;

            mpfr_div_2ui(d, s->x[i * s->stride + k], 3 * k, MPFR_RNDN);
            size = fabs(mpfr_get_d(d, MPFR_RNDN));
            mpfr_sub_d(d, d, x.hi, MPFR_RNDN);
            mpfr_sub_d(d, d, x.lo, MPFR_RNDN);
            if (!(fabs(mpfr_get_d(d, MPFR_RNDN)) <= 1e-22 * (1e-2 + size)))
                fail_msg("component %zu, order %zu: off by %g of %g", i, k,
                         mpfr_get_d(d, MPFR_RNDN), size);
        }
    qdot_leading_free(l);
    mpfr_clear(d);
}

static void
agree(fixture *f, const double *y, double t)
{
    place at = {.y = y, .t = t};
    qdot_precise_bind *derived, *shifted;
    qdot_motion_series *direct;
    const qdot_ode_series *series;

    f->request.method = "taylor";
    must(qdot_plan_new(f->scene, &f->request, &at.plan));
    qdot_residual_free(at.plan->residual);
    at.plan->residual = NULL;
    must(qdot_residual_new(f->scene, at.plan, &at.residual));
    assert_non_null(at.residual);
    must(qdot_motion_of_residual(at.plan, at.residual, &at.residual->motion));
    derived = expand_precise(&at);
    at.plan->residual = at.residual;
    shifted = expand_precise(&at);
    precise_agree(derived, shifted);
    must(qdot_motion_series_new(at.plan, false, &direct));
    series = qdot_motion_series_get(direct);
    must(series->begin(t, y, 0.125, series->user));
    must(series->extend(QDOT_ODE_LEADING_MOST + 1, series->user));
    leading_agrees(&at, series, derived);
    at.plan->residual = NULL;
    leading_agrees(&at, series, derived);
    qdot_residual_free(at.residual);
    qdot_precise_bind_free(derived);
    qdot_precise_bind_free(shifted);
    qdot_motion_series_free(direct);
    qdot_plan_free(at.plan);
}

static void
chains_agree(void **state)
{
    const double y[] = {0.3, -1.2, 2, 0.7, 1.1, 0.4, -0.3, 0.9, -1.4, 0.2};
    fixture f;

    (void)state;
    chain(&f, 5);
    agree(&f, y, 0);
    end(&f);
}

/* Friction and a force of time: Q with velocities has a tape of its own. */
static void
forces_with_velocities_agree(void **state)
{
    const double y[] = {0.3, -1.2, 2, 0.4, -0.3, 0.9};
    qdot_torque torque = {.body = -1};
    qdot_expr v;
    fixture f;

    (void)state;
    chain(&f, 3);
    v = velocity(&f, f.scene->coordinates.at[0]);
    must(qdot_scene_dissipation(f.scene, times(&f, number(&f, "0.2"), times(&f, v, v))));
    torque.torque = qdot_fun1(f.pool, QDOT_SIN, times(&f, number(&f, "1.7"), QDOT_T));
    torque.coordinate = f.scene->coordinates.at[2];
    must(qdot_scene_torque(f.scene, &torque));
    agree(&f, y, 0.8);
    end(&f);
}

/* Two chains that know nothing of each other: two blocks. */
static void
blocks_agree(void **state)
{
    const double y[] = {0.3, -1.2, 0.1, 0.7, 0.4, -0.3, 0.9, 0.2};
    qdot_expr m, x;
    fixture f;

    (void)state;
    chain(&f, 3);
    m = parameter(&f, "m");
    x = coordinate(&f, "x");
    must(qdot_scene_particle(f.scene, "alone", m, pair(&f, x, times(&f, x, x))));
    agree(&f, y, 0);
    end(&f);
}

/* Hamilton's equations, from the same state. */
static void
canonical_agrees(fixture *f, const double *y, double t, size_t moving)
{
    place at = {.y = y, .t = t};
    qdot_precise_bind *derived, *canonical;

    f->request.method = "taylor";
    must(qdot_plan_new(f->scene, &f->request, &at.plan));
    qdot_residual_free(at.plan->residual);
    at.plan->residual = NULL;
    derived = expand_precise(&at);
    must(qdot_canonical_new(f->scene, at.plan, &at.plan->canonical));
    assert_non_null(at.plan->canonical);
    assert_int_equal(at.plan->canonical->moving, moving);
    canonical = expand_precise(&at);
    precise_agree(derived, canonical);
    qdot_precise_bind_free(derived);
    qdot_precise_bind_free(canonical);
    qdot_plan_free(at.plan);
}

/* Two links, coupled, with friction and a torque of time. */
static void
coupled_momenta_agree(void **state)
{
    const double y[] = {0.3, -1.2, 0.4, -0.3};
    qdot_torque torque = {.body = -1};
    qdot_expr v;
    fixture f;

    (void)state;
    chain(&f, 2);
    canonical_agrees(&f, y, 0, 2);
    v = velocity(&f, f.scene->coordinates.at[0]);
    must(qdot_scene_dissipation(f.scene, times(&f, number(&f, "0.2"), times(&f, v, v))));
    torque.torque = qdot_fun1(f.pool, QDOT_SIN, times(&f, number(&f, "1.7"), QDOT_T));
    torque.coordinate = f.scene->coordinates.at[1];
    must(qdot_scene_torque(f.scene, &torque));
    canonical_agrees(&f, y, 0.8, 2);
    end(&f);
}

/* Of a planet the momentum of its angle is a number. */
static void
momenta_of_cyclic_angles_are_numbers(void **state)
{
    const double y[] = {1.1, 0.3, -0.2, 0.9};
    qdot_expr r, phi;
    fixture f;

    (void)state;
    begin(&f);
    r = coordinate(&f, "r");
    phi = coordinate(&f, "phi");
    must(qdot_scene_particle(f.scene, "planet", QDOT_ONE,
                             pair(&f, times(&f, r, qdot_fun1(f.pool, QDOT_COS, phi)),
                                  times(&f, r, qdot_fun1(f.pool, QDOT_SIN, phi)))));
    must(qdot_scene_potential(f.scene, qdot_neg(f.pool, qdot_pow_int(f.pool, r, -1))));
    canonical_agrees(&f, y, 0, 1);
    end(&f);
}

/* The inverse of M of three coupled coordinates is not cheap. */
static void
larger_blocks_have_none(void **state)
{
    qdot_canonical *canonical;
    qdot_plan *plan;
    fixture f;

    (void)state;
    chain(&f, 3);
    must(qdot_plan_new(f.scene, &f.request, &plan));
    must(qdot_canonical_new(f.scene, plan, &canonical));
    assert_null(canonical);
    qdot_plan_free(plan);
    end(&f);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(chains_agree),
        cmocka_unit_test(forces_with_velocities_agree),
        cmocka_unit_test(blocks_agree),
        cmocka_unit_test(coupled_momenta_agree),
        cmocka_unit_test(momenta_of_cyclic_angles_are_numbers),
        cmocka_unit_test(larger_blocks_have_none),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
