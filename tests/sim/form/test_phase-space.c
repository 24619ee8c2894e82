/* test_phase-space.c -- canonical momenta of a particle in polar coordinates, in a magnetic field. */
#include "expr/build.h"
#include "expr/function.h"
#include "sim/scenes.h"

#include <math.h>

#include "ode/method.h"
#include "sim/bind/bind.h"
#include "sim/plan/plan.h"

/* x = (r cos th, r sin th), V = r^2/2 + r th'/3 */
static void
polar(fixture *f)
{
    qdot_expr r, theta;

    begin(f);
    r = coordinate(f, "r");
    theta = coordinate(f, "theta");
    must(qdot_scene_particle(f->scene, "p", number(f, "1.3"),
                             pair(f, times(f, r, qdot_fun1(f->pool, QDOT_COS, theta)),
                                  times(f, r, qdot_fun1(f->pool, QDOT_SIN, theta)))));
    must(qdot_scene_potential(
        f->scene, qdot_add(f->pool, times(f, number(f, "0.5"), times(f, r, r)),
                           times(f, number(f, "0.25"), times(f, r, velocity(f, theta))))));
    f->q0[0] = QDOT_ONE;
    f->v0[1] = number(f, "0.9");
    f->request.method = "gauss8";
}

static void
momenta_and_their_rates_are_right(void **state)
{
    const double y[] = {1.25, 0.5, 0.375, -0.75}, h = 1e-5;
    double p[2], v[2], F[2], rates[4];
    qdot_ode_system system;
    qdot_plan *plan;
    qdot_bind *bind;
    fixture f;

    (void)state;
    polar(&f);
    must(qdot_plan_new(f.scene, &f.request, &plan));
    assert_non_null(plan->phase_space);
    assert_false(plan->halves);
    must(qdot_bind_new(plan, false, &bind));
    system = qdot_bind_system(bind);
    assert_non_null(system.phase);
    must(system.phase->momenta(0, y, y + 2, p, system.phase->user));
    assert_true(fabs(p[0] - 1.3 * 0.375) < 1e-15);
    assert_true(fabs(p[1] - (1.3 * 1.25 * 1.25 * -0.75 - 0.25 * 1.25)) < 1e-15);
    must(system.phase->velocity(0, y, p, v, system.phase->user));
    assert_true(fabs(v[0] - y[2]) < 1e-15 && fabs(v[1] - y[3]) < 1e-15);
    /* p' is the slope of p along the motion */
    must(system.phase->force(0, y, y + 2, F, system.phase->user));
    must(system.rhs(0, y, rates, system.user));
    for (int i = 0; i < 2; i++) {
        double slope = 0;

        for (int side = -1; side <= 1; side += 2) {
            double at[4];

            for (int k = 0; k < 4; k++)
                at[k] = y[k] + side * h * rates[k];
            must(system.phase->momenta(0, at, at + 2, p, system.phase->user));
            slope += side * p[i] / (2 * h);
        }
        assert_true(fabs(F[i] - slope) < 1e-9);
        assert_true(i == 0 || fabs(F[i]) < 1e-14); /* theta is cyclic */
    }
    qdot_bind_free(bind);
    qdot_plan_free(plan);
    end(&f);
}

static void
constant_masses_need_no_momenta(void **state)
{
    qdot_plan *plan;
    fixture f;

    (void)state;
    pendulum(&f);
    f.request.method = "gauss8";
    must(qdot_plan_new(f.scene, &f.request, &plan));
    assert_null(plan->phase_space);
    assert_true(plan->halves);
    qdot_plan_free(plan);
    end(&f);
}

static void
failed_allocations_are_told(void **state)
{
    fixture f;

    (void)state;
    polar(&f);
    survives_failed_allocations(&f);
    end(&f);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(momenta_and_their_rates_are_right),
        cmocka_unit_test(constant_masses_need_no_momenta),
        cmocka_unit_test(failed_allocations_are_told),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
