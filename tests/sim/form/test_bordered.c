/* test_bordered.c -- multipliers solved for by machine code against those of the kernels; when it
 * is not asked. Where there is no such code all of them are the kernels'. */
#include "expr/build.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/symbol.h"
#include "sim/scenes.h"

#include "expr/calculus.h"
#include "sim/bind/bind.h"
#include "sim/form/guarded.h"
#include "sim/form/motion-series.h"
#include "sim/form/derived.h"
#include "sim/model/power-quotient.h"
#include "sim/model/rates.h"
#include "sim/plan/plan.h"
#include "tape/tape.h"
#include "series/taylor.h"

#include <math.h>

enum { order = 20 };

static qdot_expr
square(fixture *f, qdot_expr x)
{
    return times(f, x, x);
}

static qdot_expr
squares(fixture *f, qdot_expr x, qdot_expr y)
{
    return qdot_add(f->pool, square(f, x), square(f, y));
}

static void
gravity(fixture *f)
{
    must(qdot_scene_gravity(
        f->scene, pair(f, QDOT_ZERO, qdot_neg(f->pool, parameter(f, "g")))));
    set(f, "g", "9.81");
    f->request.tol = 1e-5;
}

/* Two rods. */
static void
rods(fixture *f)
{
    qdot_expr q[4];

    begin(f);
    for (int i = 0; i < 4; i++)
        q[i] = coordinate(f, (const char *[]){"x[1]", "y[1]", "x[2]", "y[2]"}[i]);
    must(qdot_scene_particle(f->scene, "a", QDOT_ONE, pair(f, q[0], q[1])));
    must(qdot_scene_particle(f->scene, "b", qdot_expr_int(f->pool, 2), pair(f, q[2], q[3])));
    must(qdot_scene_constraint(f->scene, "one", squares(f, q[0], q[1]), QDOT_ONE));
    must(qdot_scene_constraint(
        f->scene, "two",
        squares(f, qdot_sub(f->pool, q[2], q[0]), qdot_sub(f->pool, q[3], q[1])), QDOT_ONE));
    gravity(f);
}

/* The same with one of them said twice. */
static void
rods_twice(fixture *f)
{
    rods(f);
    must(qdot_scene_constraint(f->scene, "again",
                               squares(f, qdot_symbol_get(f->pool, QDOT_COORD, "x[1]"),
                                       qdot_symbol_get(f->pool, QDOT_COORD, "y[1]")),
                               QDOT_ONE));
}

/* A bob on a blade that lies on a sphere: its velocities are tied too. */
static void
blade(fixture *f)
{
    qdot_expr q[3], r2 = QDOT_ZERO;

    begin(f);
    for (int i = 0; i < 3; i++) {
        q[i] = coordinate(f, (const char *[]){"x", "y", "z"}[i]);
        r2 = qdot_add(f->pool, r2, square(f, q[i]));
    }
    must(qdot_scene_particle(f->scene, "bob", QDOT_ONE, qdot_vector(f->pool, 3, q)));
    must(qdot_scene_constraint(f->scene, "sphere", r2, QDOT_ONE));
    must(qdot_scene_constraint(f->scene, "blade", velocity(f, q[0]),
                               times(f, q[2], velocity(f, q[1]))));
    f->request.tol = 1e-5;
}

/* A bob held at right angles to a direction that moves, by a root that has no symbol. */
static void
road(fixture *f)
{
    qdot_expr x, y, s, c;

    begin(f);
    x = coordinate(f, "x");
    y = coordinate(f, "y");
    s = qdot_div(f->pool, qdot_fun1(f->pool, QDOT_SIN, times(f, qdot_expr_int(f->pool, 3), QDOT_T)),
                 qdot_expr_int(f->pool, 4));
    c = qdot_sqrt(f->pool, qdot_sub(f->pool, QDOT_ONE, square(f, s)));
    must(qdot_scene_particle(f->scene, "bob", QDOT_ONE, pair(f, x, y)));
    must(qdot_scene_constraint(f->scene, "upright",
                               qdot_add(f->pool, times(f, x, c), times(f, y, s)), QDOT_ZERO));
    gravity(f);
}

/* Two angles whose M is coupled and moves; the tip stays above a point. */
static void
angles(fixture *f)
{
    qdot_expr a, b;

    chain(f, 2);
    a = qdot_symbol_get(f->pool, QDOT_COORD, "theta[1]");
    b = qdot_symbol_get(f->pool, QDOT_COORD, "theta[2]");
    must(qdot_scene_constraint(f->scene, "tip",
                               qdot_add(f->pool, qdot_fun1(f->pool, QDOT_SIN, a),
                                        qdot_fun1(f->pool, QDOT_SIN, b)),
                               QDOT_HALF));
    f->request.tol = 1e-5;
}

/* --- both series ---------------------------------------------------------------------- */

typedef struct {
    qdot_plan *plan;
    qdot_motion_series *whole;
    qdot_guarded *bordered;
    const qdot_ode_series *series[2]; /* by code; of the kernels */
} both;

static void
both_begin(both *b, fixture *f)
{
    must(qdot_plan_new(f->scene, &f->request, &b->plan));
    if (!b->plan->motion) /* another form is taken */
        must(qdot_plan_make_motion(b->plan));
    must(qdot_motion_series_of_constraints(b->plan, false, &b->whole));
    b->series[1] = qdot_motion_series_get(b->whole);
    must(qdot_guarded_new(b->plan, b->plan, false, b->series[1], &b->bordered));
    b->series[0] = qdot_guarded_series(b->bordered);
    must(b->series[0]->prepare(order, b->series[0]->user));
}

static void
expand(const qdot_ode_series *s, double t, const double *y)
{
    must(s->begin(t, y, 0.125, s->user));
    must(s->extend(order, s->user));
}

static qdot_status
write_code(const both *b)
{
    const qdot_ode_code *code = &b->series[0]->code;

    return code->write(order, order, code->user);
}

static void
both_end(both *b)
{
    qdot_guarded_free(b->bordered);
    qdot_motion_series_free(b->whole);
    qdot_plan_free(b->plan);
}

/* The largest distance of coefficients, each relative to the largest of its order. */
static double
distance(const both *b)
{
    const qdot_ode_series *const *s = b->series;
    double worst = 0;

    for (size_t k = 0; k <= order; k++) {
        double size = 0, apart = 0;

        for (size_t i = 0; i < 2 * b->plan->n; i++) {
            const double own = s[0]->x[i * s[0]->stride + k];
            const double other = s[1]->x[i * s[1]->stride + k];

            if (k == order && i < b->plan->n)
                continue;
            size = fmax(size, fabs(other));
            apart = fmax(apart, fabs(own - other));
        }
        worst = fmax(worst, apart / size);
    }
    return worst;
}

static void
code_agrees_with_the_kernels(void **state)
{
    static const struct {
        void (*make)(fixture *f);
        double y[8];
    } scenes[] = {
        {rods, {0.6, -0.8, 1.2, -1.6, 0.8, 0.6, 0.1, 1.125}},
        {blade, {0.48, 0.6, 0.64, 0.32, 0.5, -0.70875}},
        {road, {-0.1, 0.7, 0.3, 0.2}},
        {angles, {0.1, 0.4, 0.7, -0.75}},
    };

    (void)state;
    for (size_t k = 0; k < sizeof scenes / sizeof *scenes; k++) {
        fixture f;
        both b;

        scenes[k].make(&f);
        both_begin(&b, &f);
        expand(b.series[1], 0.3, scenes[k].y);
        expand(b.series[0], 0.3, scenes[k].y);
        assert_ptr_equal(b.series[0]->x, b.series[1]->x); /* nothing is written yet */
        must(write_code(&b));
        expand(b.series[0], 0.3, scenes[k].y);
        assert_true((b.series[0]->x != b.series[1]->x) == qdot_taylor_may_be_code());
        assert_true(distance(&b) < 1e-12);
        both_end(&b);
        end(&f);
    }
}

/* Rows that repeat others, or nearly, are left to the form that knows of it. */
static void
dependent_rows_are_left_to_the_other(void **state)
{
    double y[] = {0, 0, 0.1, 0, 0, 0};
    const char *why;
    fixture f;
    both b;

    (void)state;
    blade(&f);
    both_begin(&b, &f);
    must(write_code(&b));
    /* the sphere's normal (x, y, z) beside the blade's (1, -z, 0) */
    y[0] = sqrt((1 - y[2] * y[2]) / (1 + y[2] * y[2]));
    y[1] = -y[2] * y[0];
    expand(b.series[0], 0, y);
    assert_ptr_equal(b.series[0]->x, b.series[1]->x);
    both_end(&b);
    end(&f);
    /* for a run that begins so no code is made */
    rods_twice(&f);
    both_begin(&b, &f);
    expand(b.series[0], 0, (const double[]){0.6, -0.8, 1.2, -1.6, 0.8, 0.6, 0.1, 1.125});
    must(write_code(&b));
    assert_int_equal(qdot_guarded_code(b.bordered, &why), 0);
    both_end(&b);
    end(&f);
}

/* Under tight tolerances, of many coordinates, with damping: another form. */
static void
it_is_for_few_unknowns_and_loose_tolerances(void **state)
{
    qdot_plan *plan;
    fixture f;

    (void)state;
    road(&f);
    must(qdot_plan_new(f.scene, &f.request, &plan));
    if (qdot_taylor_may_be_code())
        assert_true(plan->bordered || plan->eliminated);
    else
        assert_false(plan->bordered);
    qdot_plan_free(plan);
    f.request.tol = 1e-12;
    must(qdot_plan_new(f.scene, &f.request, &plan));
    assert_false(plan->bordered);
    qdot_plan_free(plan);
    f.request.tol = 1e-5;
    f.request.treatment = QDOT_RUN_BAUMGARTE;
    must(qdot_plan_new(f.scene, &f.request, &plan));
    assert_false(plan->bordered);
    qdot_plan_free(plan);
    end(&f);
}

/* --- rates ---------------------------------------------------------------------------- */

static void
second_rates_are_those_of_the_whole(void **state)
{
    static const double in[] = {0.3, 0.7, -0.4, 0.9, 1.1}; /* x, y, x', y', t */
    fixture f;
    qdot_expr x, y, e[4], root, cube;

    (void)state;
    begin(&f);
    x = coordinate(&f, "x");
    y = coordinate(&f, "y");
    root = qdot_sqrt(f.pool, qdot_sub(f.pool, QDOT_ONE,
                                      qdot_div(f.pool, square(&f, qdot_fun1(f.pool, QDOT_SIN, QDOT_T)),
                                               qdot_expr_int(f.pool, 2))));
    cube = qdot_pow_int(f.pool, qdot_add(f.pool, QDOT_ONE, squares(&f, x, y)), -3);
    e[0] = qdot_add(f.pool, times(&f, x, root), times(&f, y, square(&f, root)));
    e[1] = times(&f, qdot_pow(f.pool, squares(&f, x, y), qdot_expr_ratio(f.pool, 3, 2)), QDOT_T);
    e[2] = qdot_sub(f.pool, times(&f, cube, qdot_fun1(f.pool, QDOT_COS, times(&f, x, QDOT_T))), y);
    e[3] = qdot_div(f.pool, qdot_pow_int(f.pool, y, 3), qdot_hold(f.pool, qdot_add(f.pool, x, QDOT_T)));
    for (size_t k = 0; k < 4; k++) {
        const qdot_expr inputs[] = {x, y, velocity(&f, x), velocity(&f, y), QDOT_T};
        const qdot_expr rates[] = {qdot_symbol_jet(f.pool, x, 2), qdot_symbol_jet(f.pool, y, 2)};
        const qdot_expr zeros[] = {QDOT_ZERO, QDOT_ZERO};
        qdot_expr both[2];
        qdot_tape *tape;
        double out[2], work[256];

        must(qdot_rates_second(f.pool, e[k], &both[0]));
        assert_int_not_equal(both[0], QDOT_NIL);
        both[1] = qdot_subs(f.pool, qdot_ddt(f.pool, qdot_ddt(f.pool, e[k])), 2, rates, zeros);
        must(qdot_tape_new(f.pool, 5, inputs, 2, both, &tape));
        assert_true(qdot_tape_work(tape) <= 256);
        qdot_tape_eval(tape, in, out, work);
        assert_true(fabs(out[0] - out[1]) < 1e-13 * fmax(1, fabs(out[1])));
        qdot_tape_free(tape);
    }
    /* nothing to gain, nothing known */
    must(qdot_rates_second(f.pool, squares(&f, x, y), &e[0]));
    assert_int_equal(e[0], QDOT_NIL);
    must(qdot_rates_second(f.pool, qdot_fun1(f.pool, QDOT_TANH, qdot_sqrt(f.pool, x)), &e[0]));
    assert_int_equal(e[0], QDOT_NIL);
    end(&f);
}

/* The pull of a spring along x and y: the same numbers by fewer operations. */
static void
springs_divide_once(void **state)
{
    static const double in[] = {0.3, 0.7};
    fixture f;
    qdot_expr q[2], r, pull, e[4];
    qdot_tape *tapes[2];
    double out[4], work[256];

    (void)state;
    begin(&f);
    q[0] = coordinate(&f, "x");
    q[1] = coordinate(&f, "y");
    r = qdot_sqrt(f.pool, squares(&f, q[0], q[1]));
    pull = qdot_sub(f.pool, times(&f, qdot_expr_int(f.pool, 3), r), QDOT_HALF);
    for (int i = 0; i < 2; i++) {
        e[i] = qdot_div(f.pool, qdot_product(f.pool, 3, (qdot_expr[]){QDOT_HALF, pull, q[i]}), r);
        e[2 + i] = qdot_power_quotient(f.pool, e[i]);
        assert_true(e[2 + i] != e[i]);
    }
    for (int k = 0; k < 2; k++) {
        must(qdot_tape_new(f.pool, 2, q, 2, e + 2 * k, &tapes[k]));
        assert_true(qdot_tape_work(tapes[k]) <= 256);
        qdot_tape_eval(tapes[k], in, out + 2 * k, work);
    }
    for (int i = 0; i < 2; i++)
        assert_true(fabs(out[i] - out[2 + i]) < 1e-15);
    assert_true(qdot_tape_operations(tapes[1]) < qdot_tape_operations(tapes[0]));
    /* another root, a power of the sum, nothing of the kind */
    e[0] = qdot_div(f.pool, pull, qdot_sqrt(f.pool, q[0]));
    e[1] = qdot_div(f.pool, square(&f, pull), r);
    e[2] = times(&f, pull, r);
    for (int i = 0; i < 3; i++)
        assert_int_equal(qdot_power_quotient(f.pool, e[i]), e[i]);
    qdot_tape_free(tapes[0]);
    qdot_tape_free(tapes[1]);
    end(&f);
}

static void
every_failed_allocation_is_survived(void **state)
{
    fixture f;

    (void)state;
    road(&f);
    f.q0[1] = QDOT_ONE;
    survives_failed_allocations(&f);
    end(&f);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(code_agrees_with_the_kernels),
        cmocka_unit_test(dependent_rows_are_left_to_the_other),
        cmocka_unit_test(it_is_for_few_unknowns_and_loose_tolerances),
        cmocka_unit_test(second_rates_are_those_of_the_whole),
        cmocka_unit_test(springs_divide_once),
        cmocka_unit_test(every_failed_allocation_is_survived),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
