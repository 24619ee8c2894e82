/* test_residual-adjoint.c -- arms in space by sweeps back through their functions: the accelerations are those of M q'' = f,
 * and work grows with the text. */
#include "expr/build.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/tensor.h"
#include "sim/scenes.h"

#include <math.h>

#include "sim/bind/bind.h"
#include "sim/course/stage.h"
#include "sim/form/residual.h"
#include "sim/plan/plan.h"

enum { LONGEST = 48 };

typedef struct {
    fixture f;
    size_t n;
    qdot_expr q[LONGEST], q0[LONGEST], v0[LONGEST];
} arm;

static qdot_expr
turned(fixture *f, qdot_expr angle, int axis)
{
    const int i = (axis + 1) % 3, j = (axis + 2) % 3;
    const qdot_expr c = qdot_fun1(f->pool, QDOT_COS, angle), s = qdot_fun1(f->pool, QDOT_SIN, angle);
    qdot_expr e[9];

    for (int k = 0; k < 9; k++)
        e[k] = QDOT_ZERO;
    e[4 * axis] = QDOT_ONE;
    e[4 * i] = e[4 * j] = c;
    e[3 * i + j] = qdot_neg(f->pool, s);
    e[3 * j + i] = s;
    return qdot_matrix(f->pool, 3, 3, e);
}

/* An arm of n links that turn about x, y, z in turn, and a force that depends on a velocity. */
static void
make_arm(arm *a, size_t n)
{
    fixture *f = &a->f;
    qdot_expr R = QDOT_NIL, place, third, step;

    begin(f);
    third = qdot_expr_ratio(f->pool, 1, 3);
    step = qdot_vector(f->pool, 3, (qdot_expr[]){third, QDOT_ZERO, QDOT_ONE});
    place = qdot_vector(f->pool, 3, (qdot_expr[]){QDOT_ZERO, QDOT_ZERO, QDOT_ZERO});
    a->n = n;
    for (size_t k = 0; k < n; k++) {
        char name[32];
        qdot_body body = {.mass = parameter(f, "m")};
        qdot_expr turn;

        snprintf(name, sizeof name, "q[%zu]", k + 1);
        a->q[k] = coordinate(f, name);
        a->q0[k] = qdot_expr_int(f->pool, (int64_t)(k % 3));
        a->v0[k] = QDOT_ZERO;
        turn = turned(f, a->q[k], (int)(k % 3));
        R = k ? qdot_value_mul(f->pool, R, turn) : turn;
        place = qdot_value_add(f->pool, place, qdot_value_mul(f->pool, R, step));
        body.position = place;
        body.rotation = R;
        body.inertia = qdot_vector(f->pool, 3, (qdot_expr[]){third, QDOT_HALF, third});
        snprintf(name, sizeof name, "link[%zu]", k + 1);
        must(qdot_scene_body(f->scene, name, &body, QDOT_NIL));
    }
    must(qdot_scene_gravity(f->scene, qdot_vector(f->pool, 3, (qdot_expr[]){QDOT_ZERO, QDOT_ZERO, number(f, "-9.81")})));
    must(qdot_scene_dissipation(f->scene, qdot_pow_int(f->pool, qdot_symbol_jet(f->pool, a->q[2], 1), 2)));
    set(f, "m", "1");
    f->request.q0 = a->q0;
    f->request.v0 = a->v0;
    f->request.t1 = number(f, "0.01");
    f->request.tol = 1e-9;
}

static void
accelerations_are_those_of_the_derived_form(void **state)
{
    enum { N = 13 };
    arm c;
    double y[2 * N], a[N], b[N], size = 0;
    qdot_bind *back, *whole;
    qdot_ode_system system;
    qdot_plan *derived;
    qdot_stage s = {0};

    (void)state;
    make_arm(&c, N);
    must(qdot_stage_begin(&s, c.f.scene, &c.f.request));
    assert_null(s.modes.at[0]->plan->M);
    assert_non_null(s.modes.at[0]->plan->residual->adjoint);
    must(qdot_plan_new(c.f.scene, &c.f.request, &derived));
    assert_non_null(derived->M);
    must(qdot_bind_new(s.modes.at[0]->plan, false, &back));
    must(qdot_bind_new(derived, false, &whole));
    for (size_t i = 0; i < 2 * N; i++)
        y[i] = 1.3 * sin(7.0 * (double)i + 1);
    system = qdot_bind_system(back);
    must(qdot_bind_accelerations(&system, 0, y, a));
    system = qdot_bind_system(whole);
    must(qdot_bind_accelerations(&system, 0, y, b));
    for (size_t i = 0; i < N; i++)
        size = fmax(size, fabs(b[i]));
    for (size_t i = 0; i < N; i++)
        assert_true(fabs(a[i] - b[i]) <= 1e-11 * size);
    qdot_bind_free(back);
    qdot_bind_free(whole);
    qdot_plan_free(derived);
    qdot_stage_clear(&s);
    end(&c.f);
}

/* Nodes that a run of an arm makes beside its places. */
static size_t
nodes_of_run(size_t n)
{
    arm c;
    qdot_run *r;
    size_t before, made;

    make_arm(&c, n);
    before = qdot_pool_count(c.f.pool);
    must(qdot_run_new(c.f.scene, &c.f.request, &r));
    assert_int_equal(qdot_run_get_report(r)->status, QDOT_RUN_DONE);
    qdot_run_free(r);
    made = qdot_pool_count(c.f.pool) - before;
    end(&c.f);
    return made;
}

static void
work_grows_with_the_arm(void **state)
{
    const size_t once = nodes_of_run(LONGEST / 2), twice = nodes_of_run(LONGEST);

    (void)state;
    assert_true(once > 0);
    if (twice > 2.1 * (double)once)
        fail_msg("%zu nodes for %d links, %zu for %d", once, LONGEST / 2, twice, LONGEST);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(accelerations_are_those_of_the_derived_form),
        cmocka_unit_test(work_grows_with_the_arm),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
