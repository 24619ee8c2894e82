/* test_parameter-states.c -- runs whose events set parameters, against closed forms, against the
 * same run cut by hand, by every method. */
#include "expr/build.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/symbol.h"
#include "sim/scenes.h"

#include <math.h>

#include "ode/method.h"

/* --- an oscillator m x'' = -k x ------------------------------------------------------- */

static qdot_expr
oscillator(fixture *f)
{
    qdot_expr x, k;

    begin(f);
    k = parameter(f, "k");
    x = coordinate(f, "x");
    must(qdot_scene_particle(f->scene, "p", parameter(f, "m"), pair(f, x, QDOT_ZERO)));
    must(qdot_scene_potential(f->scene,
                              qdot_div(f->pool, times(f, k, times(f, x, x)),
                                       qdot_expr_int(f->pool, 2))));
    set(f, "m", "1");
    set(f, "k", "1");
    f->q0[0] = QDOT_ONE;
    f->request.t1 = qdot_expr_int(f->pool, 5);
    return x;
}

/* event NAME: left = 0 then target = value, and so on. */
static void
event(fixture *f, const char *name, qdot_expr left, size_t n, const qdot_expr *targets,
      const qdot_expr *values)
{
    qdot_event e = {.name = (char *)name, .left = left, .right = QDOT_ZERO};

    for (size_t i = 0; i < n; i++) {
        must(qdot_vec_push(&e.targets, targets[i]));
        must(qdot_vec_push(&e.values, values[i]));
    }
    must(qdot_scene_event(f->scene, &e));
    qdot_free(e.targets.at);
    qdot_free(e.values.at);
}

static void
sets(fixture *f, const char *name, qdot_expr left, const char *target, qdot_expr value)
{
    qdot_expr p = parameter(f, target);

    event(f, name, left, 1, &p, &value);
}

static double
value_of(qdot_run *r, qdot_expr e, double t, double *error)
{
    double value, none;

    must(qdot_run_values(r, 1, &e, 1, &t, &value, error ? error : &none));
    return value;
}

static void
holds_within(const char *what, double value, double exact, double error)
{
    if (!(fabs(value - exact) <= error))
        fail_msg("%s: %.17g, not %.17g: off by %.3g, stated %.3g", what, value, exact,
                 fabs(value - exact), error);
}

/* k becomes 2 k wherever x is 0: cos t, then frequencies sqrt 2 and 2. */
static double
doubled(double t)
{
    const double t1 = M_PI / 2, t2 = t1 + M_PI / sqrt(2);

    return t < t1   ? cos(t)
           : t < t2 ? -sin(sqrt(2) * (t - t1)) / sqrt(2)
                    : sin(2 * (t - t2)) / 2;
}

static void
every_method_takes_the_new_value(void **state)
{
    int done = 0;

    (void)state;
    for (size_t i = 0; i < qdot_ode_method_count(); i++)
        for (int loose = 0; loose < 2; loose++) {
            qdot_run *r;
            double error;
            fixture f;
            qdot_expr x = oscillator(&f), k = parameter(&f, "k");

            f.request.method = qdot_ode_method_at(i)->name;
            f.request.tol = loose ? 1e-5 : 1e-10;
            sets(&f, "cross", x, "k", times(&f, qdot_expr_int(f.pool, 2), k));
            r = run(&f);
            assert_int_equal(qdot_run_get_report(r)->status, QDOT_RUN_DONE);
            error = qdot_run_get_report(r)->error;
            holds_within(f.request.method, qdot_run_get_report(r)->q[0], doubled(5),
                         error + 1e-15);
            assert_true(error < (loose ? 1e-1 : 1e-5));
            assert_int_equal(qdot_run_get_report(r)->n, 2);
            assert_int_equal(qdot_run_get_report(r)->n_states, 1);
            assert_true(qdot_run_get_report(r)->q[1] == 4);
            for (double t = 0.3; t < 5; t += 0.7) {
                const double now = t < M_PI / 2 ? 1 : t < M_PI / 2 + M_PI / sqrt(2) ? 2 : 4;

                assert_true(value_of(r, k, t, NULL) == now);
                value_of(r, x, t, &error);
                holds_within("x", value_of(r, x, t, NULL), doubled(t), error + 1e-15);
            }
            qdot_run_free(r);
            end(&f);
            done++;
        }
    assert_true(done > 10);
}

/* --- values that depend on the state ---------------------------------------------------- */

/* At x = 1/2, which cos t has at pi/3 with the velocity -sqrt(3)/2, k = 1 + x'^2: what the time
 * of the event is off by is in k, and in what follows. */
static void
errors_cover_a_value_of_the_state(void **state)
{
    const double w = sqrt(1.75), u = -sqrt(3) / 2;

    (void)state;
    for (int digits = 3; digits <= 14; digits++) {
        static const char *const methods[] = {"taylor", "dop853", "rk8pd"};
        qdot_run *r;
        double error, exact, later = 3 - M_PI / 3;
        fixture f;
        qdot_expr x = oscillator(&f), k = parameter(&f, "k"), v = velocity(&f, x), value;
        qdot_event e = {.name = (char *)"half", .right = QDOT_ZERO, .way = -1};

        f.request.tol = pow(10, -digits);
        f.request.method = methods[digits % 3];
        f.request.t1 = qdot_expr_int(f.pool, 3);
        value = qdot_add(f.pool, QDOT_ONE, times(&f, v, v));
        e.left = qdot_sub(f.pool, x, QDOT_HALF);
        must(qdot_vec_push(&e.targets, k));
        must(qdot_vec_push(&e.values, value));
        must(qdot_scene_event(f.scene, &e));
        qdot_free(e.targets.at);
        qdot_free(e.values.at);
        r = run(&f);
        exact = 0.5 * cos(w * later) + u / w * sin(w * later);
        holds_within("the end", qdot_run_get_report(r)->q[0], exact,
                     qdot_run_get_report(r)->error);
        value_of(r, k, 3, &error);
        holds_within("k", value_of(r, k, 3, NULL), 1.75, error);
        assert_true(error < 1e4 * f.request.tol);
        qdot_run_free(r);
        end(&f);
    }
}

static void
right_sides_are_read_first(void **state)
{
    fixture f;
    qdot_expr x, k, m, v;
    qdot_run *r;

    (void)state;
    x = oscillator(&f);
    k = parameter(&f, "k");
    m = parameter(&f, "m");
    v = velocity(&f, x);
    f.request.t1 = qdot_expr_int(f.pool, 2);
    /* x' = -1 there: m = 2, k = m + 2 = 3, x' = -(k) = -1 */
    event(&f, "all", x, 3, (qdot_expr[]){m, k, v},
          (qdot_expr[]){qdot_sub(f.pool, QDOT_ONE, v),
                        qdot_add(f.pool, m, qdot_expr_int(f.pool, 2)),
                        qdot_neg(f.pool, k)});
    r = run(&f);
    holds_within("m", value_of(r, m, 2, NULL), 2, 1e-14);
    holds_within("k", value_of(r, k, 2, NULL), 3, 1e-14);
    holds_within("x", value_of(r, x, 2, NULL),
                 -sin(sqrt(1.5) * (2 - M_PI / 2)) / sqrt(1.5), 1e-13);
    qdot_run_free(r);
    end(&f);
}

/* k high towards the middle, low away from it: each half swing is longer by sqrt(high/low). */
static void
pumping_grows_as_it_should(void **state)
{
    const int half_swings = 12;
    fixture f;
    qdot_expr x;
    qdot_run *r;
    double end_at = 0, amplitude = pow(1.21, half_swings / 2.0), error;

    (void)state;
    x = oscillator(&f);
    f.values[1] = number(&f, "1.21");
    sets(&f, "middle", x, "k", QDOT_ONE);
    sets(&f, "turn", velocity(&f, x), "k", number(&f, "1.21"));
    for (int i = 0; i < half_swings; i++)
        end_at += M_PI / 2 + M_PI / 2 / 1.1;
    f.request.t1 = number(&f, "35.991");
    r = run(&f);
    assert_int_equal(qdot_run_get_report(r)->status, QDOT_RUN_DONE);
    assert_true(end_at < 35.991);
    value_of(r, x, end_at, &error);
    holds_within("amplitude", value_of(r, x, end_at, NULL), amplitude, error);
    assert_true(error < 1e-10);
    qdot_run_free(r);
    end(&f);
}

/* --- what follows a parameter ----------------------------------------------------------- */

static void
other_values_follow(void **state)
{
    fixture f;
    qdot_expr x, al;
    qdot_run *r;

    (void)state;
    x = oscillator(&f); /* k = al^2, with al from 1 to 3 */
    al = parameter(&f, "al");
    set(&f, "al", "1");
    f.values[1] = times(&f, al, al);
    sets(&f, "cross", x, "al", qdot_expr_int(f.pool, 3));
    f.request.t1 = qdot_expr_int(f.pool, 2);
    r = run(&f);
    assert_true(value_of(r, parameter(&f, "k"), 1, NULL) == 1);
    assert_true(value_of(r, parameter(&f, "k"), 2, NULL) == 9);
    holds_within("x", value_of(r, x, 2, NULL), -sin(3 * (2 - M_PI / 2)) / 3, 1e-13);
    qdot_run_free(r);
    end(&f);
}

/* Force sign(k - 1) on a free particle: k 1, then 2, then 0. */
static void
switches_follow(void **state)
{
    fixture f;
    qdot_expr x, k, u;
    qdot_run *r;

    (void)state;
    begin(&f);
    k = parameter(&f, "k");
    x = coordinate(&f, "x");
    must(qdot_scene_particle(f.scene, "p", QDOT_ONE, pair(&f, x, QDOT_ZERO)));
    u = qdot_fun1(f.pool, QDOT_SIGN, qdot_sub(f.pool, k, QDOT_ONE));
    must(qdot_scene_torque(f.scene, &(qdot_torque){.coordinate = x, .torque = u}));
    set(&f, "k", "1");
    sets(&f, "one", qdot_sub(f.pool, QDOT_T, QDOT_ONE), "k", qdot_expr_int(f.pool, 2));
    sets(&f, "two", qdot_sub(f.pool, QDOT_T, qdot_expr_int(f.pool, 2)), "k", QDOT_ZERO);
    f.request.t1 = qdot_expr_int(f.pool, 3);
    r = run(&f);
    holds_within("x'", value_of(r, velocity(&f, x), 1, NULL), 0, 1e-15);
    holds_within("x'", value_of(r, velocity(&f, x), 2, NULL), 1, 1e-15);
    holds_within("x'", value_of(r, velocity(&f, x), 3, NULL), 0, 1e-14);
    qdot_run_free(r);
    end(&f);
}

/* A bob on a rod whose length an event sets goes to where it is fulfilled, along the rod. */
static void
constraints_follow(void **state)
{
    fixture f;
    qdot_expr x, y, l, left;
    qdot_run *r;

    (void)state;
    begin(&f);
    l = parameter(&f, "l");
    x = coordinate(&f, "x");
    y = coordinate(&f, "y");
    must(qdot_scene_particle(f.scene, "p", QDOT_ONE, pair(&f, x, y)));
    left = qdot_add(f.pool, times(&f, x, x), times(&f, y, y));
    must(qdot_scene_constraint(f.scene, "rod", left, times(&f, l, l)));
    set(&f, "l", "1");
    f.q0[1] = QDOT_MINUS_ONE;
    f.v0[0] = QDOT_ONE;
    sets(&f, "grow", qdot_sub(f.pool, QDOT_T, QDOT_ONE), "l", qdot_expr_int(f.pool, 2));
    f.request.t1 = qdot_expr_int(f.pool, 3);
    r = run(&f); /* free on a circle: the speed stays, the angle goes half as fast */
    holds_within("x", value_of(r, x, 1, NULL), 2 * sin(1), 1e-14);
    holds_within("x", value_of(r, x, 3, NULL), 2 * sin(2), 1e-13);
    holds_within("y", value_of(r, y, 3, NULL), -2 * cos(2), 1e-13);
    assert_true(qdot_run_get_report(r)->constraint_drift < 1e-14);
    qdot_run_free(r);
    end(&f);
}

/* --- the same run cut by hand ------------------------------------------------------------- */

static double
draw(uint32_t *random)
{
    *random = *random * 1664525u + 1013904223u;
    return (*random >> 8) * 0x1p-24;
}

static qdot_expr
exact(fixture *f, double x)
{
    int64_t e;
    int power;
    double m = frexp(x, &power);
    qdot_expr r = qdot_expr_int(f->pool, (int64_t)ldexp(m, 53));

    for (e = power - 53; e != 0; e += e < 0 ? 1 : -1)
        r = times(f, r, e < 0 ? QDOT_HALF : qdot_expr_int(f->pool, 2));
    return r;
}

/* A chain of two pendulums; at t = 1 g, m and a velocity change. */
static void
goes_on_as_when_cut_by_hand(void **state)
{
    uint32_t random = 7;

    (void)state;
    for (int k = 0; k < 12; k++) {
        const double g1 = 5 + 10 * draw(&random), l1 = 0.5 + draw(&random), at = draw(&random);
        double q[2] = {0}, v[2] = {0}, end_q[2] = {0}, error = 0;
        const qdot_run_report *report;
        qdot_expr v0;
        qdot_run *r;
        fixture f;

        for (int cut = 0; cut < 3; cut++) { /* whole; up to the event; behind it */
            chain(&f, 2);
            f.request.tol = 1e-11;
            f.request.method = k % 2 ? "auto" : "dop853";
            f.q0[0] = exact(&f, 1 + at);
            f.v0[1] = exact(&f, at);
            f.request.t1 = cut == 1 ? QDOT_ONE : qdot_expr_int(f.pool, 2);
            v0 = velocity(&f, f.scene->coordinates.at[0]);
            if (cut == 0) {
                event(&f, "change", qdot_sub(f.pool, QDOT_T, QDOT_ONE), 3,
                      (qdot_expr[]){parameter(&f, "g"), parameter(&f, "l"), v0},
                      (qdot_expr[]){exact(&f, g1), exact(&f, l1),
                                    times(&f, v0, QDOT_HALF)});
            } else if (cut == 2) {
                f.request.t0 = QDOT_ONE;
                f.values[1] = exact(&f, l1);
                f.values[2] = exact(&f, g1);
                for (int i = 0; i < 2; i++) {
                    f.q0[i] = exact(&f, q[i]);
                    f.v0[i] = exact(&f, i == 0 ? v[i] / 2 : v[i]);
                }
            }
            r = run(&f);
            report = qdot_run_get_report(r);
            assert_int_equal(report->status, QDOT_RUN_DONE);
            if (cut == 0) {
                error = report->error;
                memcpy(end_q, report->q, sizeof end_q);
            } else {
                memcpy(q, report->q, sizeof q);
                memcpy(v, report->v, sizeof v);
                error += report->error;
            }
            qdot_run_free(r);
            end(&f);
        }
        for (int i = 0; i < 2; i++)
            holds_within("angle", end_q[i], q[i], 20 * error);
        assert_true(error < 1e-8);
    }
}

/* --- in digits ------------------------------------------------------------------------------ */

static void
digits_go_on_with_the_new_value(void **state)
{
    fixture f;
    qdot_expr x;
    qdot_run *r;

    (void)state;
    x = oscillator(&f);
    sets(&f, "cross", x, "k",
         times(&f, qdot_expr_int(f.pool, 2), parameter(&f, "k")));
    f.request.digits = 30;
    r = run(&f);
    assert_true(qdot_run_get_report(r)->error < 1e-30);
    holds_within("x", qdot_run_get_report(r)->q[0], doubled(5), 1e-15);
    assert_true(qdot_run_get_report(r)->q[1] == 4);
    assert_true(qdot_run_get_report(r)->exact[1] == qdot_expr_int(f.pool, 4));
    qdot_run_free(r);
    end(&f);
}

/* --- what must not be -------------------------------------------------------------------- */

static void
ends_by(fixture *f, const char *why)
{
    qdot_run *r = run(f);
    const qdot_run_report *report = qdot_run_get_report(r);

    assert_int_equal(report->status, QDOT_RUN_FAILED);
    if (!strstr(report->reason, why))
        fail_msg("%s: not %s", report->reason, why);
    assert_true(fabs(report->t1 - M_PI / 2) < 1e-12); /* what there was is kept */
    qdot_run_free(r);
    end(f);
}

static void
values_against_what_is_declared_end_the_run(void **state)
{
    fixture f;
    qdot_expr x;

    (void)state;
    x = oscillator(&f);
    sets(&f, "cross", x, "k", number(&f, "-2"));
    qdot_symbol_domain(f.pool, parameter(&f, "k"), QDOT_ZERO, true, QDOT_NIL, false);
    ends_by(&f, "k > 0 is declared, and -2 > 0 does not hold");

    x = oscillator(&f);
    set(&f, "c", "3");
    must(qdot_scene_assume(
        f.scene, qdot_rel(f.pool, QDOT_LT, parameter(&f, "k"), parameter(&f, "c")), true));
    sets(&f, "cross", x, "k", number(&f, "3"));
    ends_by(&f, "c > k is assumed, and 3 > 3 does not hold");

    x = oscillator(&f); /* beyond all doubles */
    sets(&f, "cross", x, "k",
         qdot_fun1(f.pool, QDOT_EXP,
                   times(&f, qdot_expr_int(f.pool, 1000), parameter(&f, "k"))));
    ends_by(&f, "gives k no value");
}

static void
needs_a_value_to_begin_with(void **state)
{
    qdot_run *r = NULL;
    fixture f;
    qdot_expr x;

    (void)state;
    x = oscillator(&f);
    sets(&f, "cross", x, "k", QDOT_ONE);
    f.request.n_values = 1;
    assert_int_equal(qdot_run_new(f.scene, &f.request, &r), QDOT_EUNSET);
    assert_non_null(strstr(qdot_last_error()->message, "parameter k has no value"));
    end(&f);
}

static void
a_domain_that_moved_is_refused(void **state)
{
    qdot_run *r = NULL;
    fixture f;
    qdot_expr x;

    (void)state;
    begin(&f);
    x = qdot_symbol_get(f.pool, QDOT_COORD, "x");
    qdot_symbol_domain(f.pool, x, QDOT_NIL, false, parameter(&f, "k"), true);
    must(qdot_scene_coordinate(f.scene, x));
    must(qdot_scene_particle(f.scene, "p", QDOT_ONE, pair(&f, x, QDOT_ZERO)));
    set(&f, "k", "1");
    sets(&f, "cross", x, "k", qdot_expr_int(f.pool, 2));
    assert_int_equal(qdot_run_new(f.scene, &f.request, &r), QDOT_EINVAL);
    assert_non_null(strstr(qdot_last_error()->message, "the domain of x"));
    end(&f);
}

static void
memory_may_end_anywhere(void **state)
{
    fixture f;
    qdot_expr x;

    (void)state;
    x = oscillator(&f);
    must(qdot_scene_assume(
        f.scene, qdot_rel(f.pool, QDOT_LT, QDOT_ZERO, parameter(&f, "k")), false));
    sets(&f, "cross", x, "k", qdot_expr_int(f.pool, 2));
    survives_failed_allocations(&f);
    end(&f);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_method_takes_the_new_value),
        cmocka_unit_test(errors_cover_a_value_of_the_state),
        cmocka_unit_test(right_sides_are_read_first),
        cmocka_unit_test(pumping_grows_as_it_should),
        cmocka_unit_test(other_values_follow),
        cmocka_unit_test(switches_follow),
        cmocka_unit_test(constraints_follow),
        cmocka_unit_test(goes_on_as_when_cut_by_hand),
        cmocka_unit_test(digits_go_on_with_the_new_value),
        cmocka_unit_test(values_against_what_is_declared_end_the_run),
        cmocka_unit_test(needs_a_value_to_begin_with),
        cmocka_unit_test(a_domain_that_moved_is_refused),
        cmocka_unit_test(memory_may_end_anywhere),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
