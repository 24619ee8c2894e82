/* test_run.c -- runs against closed forms and reference values, and what may go wrong. */
#include "expr/build.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/symbol.h"
#include "sim/scenes.h"

#include <math.h>
#include <stdlib.h>

#include "base/interrupt.h"
#include "base/memory.h"

static double
worst(const qdot_run_report *r, const double *q, const double *v)
{
    double w = 0;

    for (size_t i = 0; i < r->n; i++) {
        w = fmax(w, fabs(r->q[i] - q[i]) / fmax(1, fabs(q[i])));
        w = fmax(w, fabs(r->v[i] - v[i]) / fmax(1, fabs(v[i])));
    }
    return w;
}

/* The run ends at q, v within `bound`, and says of its error no less than a third of
 * it. */
static void
ends_at(fixture *f, const double *q, const double *v, double bound)
{
    qdot_run *r = run(f);
    const qdot_run_report *report = qdot_run_get_report(r);
    double error = worst(report, q, v);

    assert_int_equal(report->status, QDOT_RUN_DONE);
    assert_null(report->reason);
    if (!(error <= bound))
        fail_msg("error %.3g, not %.3g", error, bound);
    if (!(error <= 3 * report->error))
        fail_msg("error %.3g, stated %.3g", error, report->error);
    qdot_run_free(r);
}

/* --- reference values --------------------------------------------------------------- */

static void
pendulum_agrees_with_elliptic_functions(void **state)
{
    const double q = 1.59291816569560788287, v = -2.78043267381579531037;
    fixture f;

    (void)state;
    pendulum(&f);
    f.request.t1 = qdot_expr_int(f.pool, 1000);
    ends_at(&f, &q, &v, 2.3e-8);
    end(&f);
}

static void
elastic_pendulum_agrees(void **state)
{
    const double q[] = {1.00155979661606314107, -0.49117551729166357339};
    const double v[] = {0.05636229797689562951, 2.58426041550405215425};
    qdot_link spring = {0};
    qdot_expr r, theta, x, y;
    fixture f;

    (void)state;
    begin(&f);
    r = coordinate(&f, "r");
    theta = coordinate(&f, "theta");
    x = times(&f, r, qdot_fun1(f.pool, QDOT_SIN, theta));
    y = qdot_neg(f.pool, times(&f, r, qdot_fun1(f.pool, QDOT_COS, theta)));
    must(qdot_scene_particle(f.scene, "bob", parameter(&f, "m"), pair(&f, x, y)));
    spring.at[0] = pair(&f, x, y);
    spring.at[1] = pair(&f, QDOT_ZERO, QDOT_ZERO);
    spring.stiffness = parameter(&f, "k");
    spring.rest = parameter(&f, "L0");
    must(qdot_scene_spring(f.scene, &spring));
    must(qdot_scene_gravity(f.scene, pair(&f, QDOT_ZERO, number(&f, "-9.81"))));
    set(&f, "m", "1");
    set(&f, "k", "10000");
    set(&f, "L0", "1");
    f.q0[0] = f.q0[1] = QDOT_ONE;
    f.request.t1 = qdot_expr_int(f.pool, 10);
    ends_at(&f, q, v, 1e-9);
    end(&f);
}

static void
duffing_agrees(void **state)
{
    const double q = 1.06601315495533532200, v = 0.17278108128260280119;
    qdot_torque drive = {.body = -1};
    qdot_expr x;
    fixture f;

    (void)state;
    begin(&f);
    x = coordinate(&f, "x");
    must(qdot_scene_particle(f.scene, "p", parameter(&f, "m"), x));
    must(qdot_scene_potential(
        f.scene, qdot_sub(f.pool, times(&f, qdot_pow_int(f.pool, x, 4), number(&f, "0.25")),
                          times(&f, qdot_pow_int(f.pool, x, 2), QDOT_HALF))));
    must(qdot_scene_dissipation(f.scene, times(&f, number(&f, "0.15"),
                                               qdot_pow_int(f.pool, velocity(&f, x), 2))));
    drive.torque = qdot_fun1(f.pool, QDOT_COS, times(&f, number(&f, "1.2"), QDOT_T));
    drive.torque = times(&f, QDOT_HALF, drive.torque);
    drive.coordinate = x;
    must(qdot_scene_torque(f.scene, &drive));
    set(&f, "m", "1");
    f.q0[0] = QDOT_ONE;
    f.request.t1 = qdot_expr_int(f.pool, 50);
    ends_at(&f, &q, &v, 1e-6);
    end(&f);
}

/* One hundred revolutions and a quarter, e = 0.9, by Kepler's equation. */
static void
kepler_in_polar_coordinates_agrees(void **state)
{
    const double q[] = {1.57469924847521910608, 631.24545320583449044096};
    const double v[] = {2.76360844360267714799, 1.10448908508809880402};
    qdot_expr r, theta, two_pi;
    fixture f;
    qdot_run *run_;

    (void)state;
    begin(&f);
    r = coordinate(&f, "r");
    theta = coordinate(&f, "theta");
    qdot_symbol_domain(f.pool, r, QDOT_ZERO, true, QDOT_NIL, false);
    must(qdot_scene_particle(f.scene, "p", QDOT_ONE,
                             pair(&f, times(&f, r, qdot_fun1(f.pool, QDOT_COS, theta)),
                                  times(&f, r, qdot_fun1(f.pool, QDOT_SIN, theta)))));
    two_pi = qdot_mul(f.pool, qdot_expr_int(f.pool, 2), QDOT_PI);
    must(qdot_scene_potential(
        f.scene, qdot_neg(f.pool, qdot_div(f.pool, qdot_pow_int(f.pool, two_pi, 2), r))));
    f.q0[0] = number(&f, "0.1");
    f.v0[1] = times(&f, two_pi, qdot_sqrt(f.pool, qdot_expr_int(f.pool, 1900)));
    f.request.t1 = number(&f, "100.25");
    ends_at(&f, q, v, 5e-6);
    run_ = run(&f);
    assert_int_equal(qdot_run_get_report(run_)->n_drifts, 2);
    assert_string_equal(qdot_run_get_report(run_)->drifts[0].name, "energy");
    assert_string_equal(qdot_run_get_report(run_)->drifts[1].name, "p[theta]");
    assert_true(qdot_run_get_report(run_)->drifts[1].drift < 1e-9);
    qdot_run_free(run_);
    end(&f);
}

/* Eight links, a full mass matrix, against a Taylor series in 256 bits. */
static void
chain_of_eight_agrees(void **state)
{
    const double q[] = {0.71157880230427706089, 1.69405810504427620705, 1.64738118116710186075,
                        1.37198711918571185593,  1.15682035791027159848, 1.61419804089064007958,
                        0.98233153551475913630, 0.00045043532254934753};
    const double v[] = {1.13461968922819719362,  3.34791293870763783728, -0.77077643479441584810,
                        -1.03684458400649525149, 4.99487022717182668653, 0.70886148312834045145,
                        -4.79847668750134394594, -2.46942427443796521455};
    fixture f;

    (void)state;
    chain(&f, 8);
    for (int i = 0; i < 8; i++)
        f.q0[i] = times(&f, QDOT_HALF, QDOT_PI);
    f.request.t1 = qdot_expr_int(f.pool, 5);
    ends_at(&f, q, v, 1e-9);
    end(&f);
}

static void
every_method_reaches_the_same_end(void **state)
{
    static const struct {
        const char *method;
        double tol, bound;
    } rows[] = {{"rk8pd", 1e-12, 1e-10}, {"rkf45", 1e-12, 1e-9}, {"msadams", 1e-12, 1e-7},
                {"msbdf", 1e-9, 1e-4},   {"bsimp", 1e-12, 1e-8}};
    double q[2], v[2];
    fixture f;
    qdot_run *r;

    (void)state;
    chain(&f, 2);
    f.q0[0] = f.q0[1] = QDOT_ONE;
    f.request.t1 = qdot_expr_int(f.pool, 5);
    f.request.tol = 1e-14;
    r = run(&f);
    for (int i = 0; i < 2; i++) {
        q[i] = qdot_run_get_report(r)->q[i];
        v[i] = qdot_run_get_report(r)->v[i];
    }
    qdot_run_free(r);
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        f.request.method = rows[i].method;
        f.request.tol = rows[i].tol;
        r = run(&f);
        assert_string_equal(qdot_run_get_report(r)->method, rows[i].method);
        if (!(worst(qdot_run_get_report(r), q, v) < rows[i].bound))
            fail_msg("%s: %g", rows[i].method, worst(qdot_run_get_report(r), q, v));
        assert_true(worst(qdot_run_get_report(r), q, v)
                    < 3 * qdot_run_get_report(r)->error);
        qdot_run_free(r);
    }
    end(&f);
}

/* --- what a run is ------------------------------------------------------------------ */

static void
a_run_back_returns_to_the_start(void **state)
{
    fixture f;
    qdot_run *r;

    (void)state;
    chain(&f, 2);
    f.q0[0] = number(&f, "0.7");
    f.v0[1] = number(&f, "-1.3");
    f.request.t1 = qdot_expr_int(f.pool, 3);
    r = run(&f);
    for (int i = 0; i < 2; i++) { /* exactly where it ended */
        for (int k = 0; k < 2; k++) {
            double y = k ? qdot_run_get_report(r)->v[i] : qdot_run_get_report(r)->q[i];
            int exponent;
            int64_t mantissa = (int64_t)ldexp(frexp(y, &exponent), 53);

            *(k ? &f.v0[i] : &f.q0[i]) =
                qdot_mul(f.pool, qdot_expr_int(f.pool, mantissa),
                         qdot_pow_int(f.pool, qdot_expr_int(f.pool, 2), exponent - 53));
        }
    }
    qdot_run_free(r);
    f.request.t0 = qdot_expr_int(f.pool, 3);
    f.request.t1 = QDOT_ZERO;
    ends_at(&f, (double[]){0.7, 0}, (double[]){0, -1.3}, 1e-10);
    end(&f);
}

static void
an_empty_interval_is_the_start(void **state)
{
    fixture f;
    qdot_run *r;
    const qdot_run_report *report;
    qdot_expr e[2];
    double t = 0, value[2], error[2];
    size_t n;

    (void)state;
    pendulum(&f);
    f.request.t1 = QDOT_ZERO;
    r = run(&f);
    report = qdot_run_get_report(r);
    assert_int_equal(report->status, QDOT_RUN_DONE);
    assert_int_equal(report->steps, 0);
    assert_true(report->error == 0 && report->q[0] == 2 && report->v[0] == 0);
    assert_true(qdot_run_times(r, &n)[0] == 0 && n == 1);
    e[0] = f.scene->coordinates.at[0];
    e[1] = qdot_symbol_jet(f.pool, e[0], 2);
    must(qdot_run_values(r, 2, e, 1, &t, value, error));
    assert_true(value[0] == 2 && fabs(value[1] + 9.81 * sin(2.0)) < 1e-14);
    qdot_run_free(r);
    end(&f);
}

static void
values_are_as_accurate_as_the_run(void **state)
{
    fixture f;
    qdot_run *r;
    qdot_expr e[4], x;
    double times_[5] = {3, 0.1, 2.345, 5, 0}, value[20], error[20];

    (void)state;
    begin(&f);
    x = coordinate(&f, "x");
    must(qdot_scene_particle(f.scene, "p", parameter(&f, "m"), x));
    must(qdot_scene_potential(f.scene, times(&f, times(&f, QDOT_HALF, parameter(&f, "k")),
                                             qdot_pow_int(f.pool, x, 2))));
    set(&f, "m", "2");
    set(&f, "k", "18");
    f.q0[0] = QDOT_ONE;
    f.request.t1 = qdot_expr_int(f.pool, 5);
    r = run(&f);
    e[0] = x;
    e[1] = qdot_mul(f.pool, parameter(&f, "k"), velocity(&f, x));
    e[2] = qdot_symbol_jet(f.pool, x, 2);
    e[3] = qdot_fun1(f.pool, QDOT_EXP, QDOT_T);
    must(qdot_run_values(r, 4, e, 5, times_, value, error));
    for (int i = 0; i < 5; i++) {
        double t = times_[i];
        const double want[] = {cos(3 * t), -54 * sin(3 * t), -9 * cos(3 * t), exp(t)};

        for (int j = 0; j < 4; j++) {
            double miss = fabs(value[4 * i + j] - want[j]);

            assert_true(miss <= 1e-10 * fmax(1, fabs(want[j])));
            assert_true(miss <= 3 * error[4 * i + j] + 1e-15 * fmax(1, fabs(want[j])));
        }
    }
    /* what cancels, x'^2 + 9 x^2 - 9 = 0, keeps the rounding of its terms */
    e[0] = qdot_add(f.pool, qdot_pow_int(f.pool, velocity(&f, x), 2),
                    times(&f, qdot_expr_int(f.pool, 9), qdot_pow_int(f.pool, x, 2)));
    e[0] = qdot_sub(f.pool, e[0], qdot_expr_int(f.pool, 9));
    must(qdot_run_values(r, 1, e, 5, times_, value, error));
    for (int i = 0; i < 5; i++)
        assert_true(fabs(value[i]) <= error[i] && error[i] >= 9 * 0x1p-52);
    times_[0] = 5.1;
    assert_int_equal(qdot_run_values(r, 1, e, 1, times_, value, NULL), QDOT_EDOMAIN);
    assert_non_null(strstr(qdot_last_error()->message, "outside the run"));
    e[0] = qdot_fun1(f.pool, QDOT_LOG, qdot_sub(f.pool, QDOT_MINUS_ONE, QDOT_T));
    times_[0] = 1;
    assert_int_equal(qdot_run_values(r, 1, e, 1, times_, value, NULL), QDOT_EDOMAIN);
    assert_non_null(strstr(qdot_last_error()->message, "undefined at t = 1"));
    e[0] = parameter(&f, "other");
    assert_int_equal(qdot_run_values(r, 1, e, 1, times_, value, NULL), QDOT_EUNSET);
    qdot_run_free(r);
    end(&f);
}

/* A bead on the wire (s, s^2/2) set by functions: the same as with the coordinates
 * written. */
static void
functions_may_be_set(void **state)
{
    double q[2], v[2];
    fixture f;

    (void)state;
    for (int way = 0; way < 2; way++) {
        qdot_expr s, formals[2], x, y, parabola;
        uint32_t fx, fy;
        qdot_run *r;

        begin(&f);
        s = coordinate(&f, "s");
        formals[0] = s;
        formals[1] = QDOT_T;
        parabola = times(&f, parameter(&f, "c"), qdot_pow_int(f.pool, s, 2));
        parabola = qdot_add(f.pool, parabola, times(&f, number(&f, "0.1"),
                                                    qdot_fun1(f.pool, QDOT_SIN, QDOT_T)));
        if (way == 0) {
            x = s;
            y = parabola;
        } else {
            must(qdot_ufun_declare(f.pool, "X", 1, formals, &fx));
            must(qdot_ufun_declare(f.pool, "Y", 2, formals, &fy));
            x = qdot_ufun_apply(f.pool, fx, formals, NULL);
            y = qdot_ufun_apply(f.pool, fy, formals, NULL);
        }
        must(qdot_scene_particle(f.scene, "bead", parameter(&f, "m"), pair(&f, x, y)));
        must(qdot_scene_gravity(f.scene, pair(&f, QDOT_ZERO, number(&f, "-9.81"))));
        set(&f, "m", "1");
        set(&f, "c", "0.5");
        f.q0[0] = QDOT_ONE;
        f.request.t1 = qdot_expr_int(f.pool, 3);
        if (way == 1) {
            assert_int_equal(qdot_run_new(f.scene, &f.request, &r), QDOT_EUNSET);
            assert_non_null(strstr(qdot_last_error()->message, "no value"));
            f.symbols[f.request.n_values] = x;
            f.values[f.request.n_values++] = s;
            f.symbols[f.request.n_values] = y;
            f.values[f.request.n_values++] = parabola;
        }
        r = run(&f);
        q[way] = qdot_run_get_report(r)->q[0];
        v[way] = qdot_run_get_report(r)->v[0];
        qdot_run_free(r);
        end(&f);
    }
    assert_true(fabs(q[0] - q[1]) < 1e-11 && fabs(v[0] - v[1]) < 1e-11);
}

/* L = x' y' - x y: M is indefinite; x'' = -x, y'' = -y. */
static void
a_stated_lagrangian_may_be_indefinite(void **state)
{
    qdot_expr x, y;
    fixture f;

    (void)state;
    begin(&f);
    x = coordinate(&f, "x");
    y = coordinate(&f, "y");
    must(qdot_scene_lagrangian(
        f.scene,
        qdot_sub(f.pool, times(&f, velocity(&f, x), velocity(&f, y)), times(&f, x, y))));
    f.q0[0] = QDOT_ONE;
    f.v0[1] = QDOT_ONE;
    f.request.t1 = qdot_expr_int(f.pool, 2);
    ends_at(&f, (double[]){cos(2.0), sin(2.0)}, (double[]){-sin(2.0), cos(2.0)}, 1e-11);
    end(&f);
}

static void
energy_drift_only_where_it_is_conserved(void **state)
{
    fixture f;
    qdot_run *r;

    (void)state;
    pendulum(&f);
    r = run(&f);
    assert_true(qdot_run_get_report(r)->energy_drift < 1e-11);
    assert_true(fabs(qdot_run_get_report(r)->drifts[0].start - -9.81 * cos(2.0)) < 1e-14);
    qdot_run_free(r);
    must(qdot_scene_dissipation(
        f.scene, qdot_pow_int(f.pool, velocity(&f, f.scene->coordinates.at[0]), 2)));
    r = run(&f);
    assert_true(isnan(qdot_run_get_report(r)->energy_drift));
    assert_int_equal(qdot_run_get_report(r)->n_drifts, 0);
    qdot_run_free(r);
    end(&f);
}

/* --- what may go wrong -------------------------------------------------------------- */

static void
refuse(fixture *f, qdot_status status, const char *message)
{
    qdot_run *r = (qdot_run *)1;

    assert_int_equal(qdot_run_new(f->scene, &f->request, &r), status);
    assert_null(r);
    if (!strstr(qdot_last_error()->message, message))
        fail_msg("\"%s\" does not say \"%s\"", qdot_last_error()->message, message);
}

/* An event without an action, or with one that changes nothing, leaves the run as it was: its steps, its end to
 * the last bit, and the error stated. */
static void
events_that_are_only_seen_cost_nothing(void **state)
{
    uint64_t steps = 0;
    double q = 0, v = 0, error = 0;

    (void)state;
    for (int kind = 0; kind < 3; kind++) { /* without, with one, with theta' = theta' */
        qdot_event e = {.name = (char *)"low", .right = QDOT_ZERO};
        const qdot_run_report *r;
        qdot_expr rate;
        qdot_run *made;
        fixture f;

        pendulum(&f);
        f.q0[0] = QDOT_ONE;
        f.request.tol = 1e-15;
        f.request.t1 = qdot_expr_int(f.pool, 20);
        e.left = f.scene->coordinates.at[0];
        rate = velocity(&f, e.left);
        if (kind == 2) {
            e.targets.at = e.values.at = &rate;
            e.targets.n = e.values.n = 1;
        }
        if (kind > 0)
            must(qdot_scene_event(f.scene, &e));
        made = run(&f);
        r = qdot_run_get_report(made);
        if (kind > 0) {
            assert_true(r->steps == steps && r->q[0] == q && r->v[0] == v);
            assert_true(r->error < 4 * error);
        }
        steps = r->steps;
        q = r->q[0];
        v = r->v[0];
        error = r->error;
        qdot_run_free(made);
        end(&f);
    }
    assert_true(error < 1e-14);
}

static void
requests_without_sense_are_refused(void **state)
{
    fixture f;

    (void)state;
    pendulum(&f);
    f.request.tol = 0;
    refuse(&f, QDOT_EINVAL, "tolerance must be positive");
    f.request.tol = NAN;
    refuse(&f, QDOT_EINVAL, "tolerance must be positive");
    f.request.tol = 1e-17;
    refuse(&f, QDOT_EINVAL, "below what a double can hold");
    f.request.tol = 2;
    refuse(&f, QDOT_EINVAL, "at most 1");
    f.request.tol = 1e-9;
    f.request.method = "euler";
    refuse(&f, QDOT_ENAME, "there is no method euler");
    assert_non_null(strstr(qdot_last_error()->hint, "rk8pd"));
    f.request.method = NULL;
    f.request.n_values = 1;
    refuse(&f, QDOT_EUNSET, "parameter");
    assert_non_null(strstr(qdot_last_error()->hint, "set "));
    end(&f);
}

static void
scenes_without_motion_are_refused(void **state)
{
    fixture f;
    qdot_expr x, y;

    (void)state;
    begin(&f);
    refuse(&f, QDOT_EINVAL, "no coordinates");
    x = coordinate(&f, "x");
    refuse(&f, QDOT_EINVAL, "no masses");
    y = coordinate(&f, "y");
    must(qdot_scene_particle(f.scene, "p", QDOT_ONE, pair(&f, x, QDOT_ZERO)));
    refuse(&f, QDOT_ESINGULAR, "no mass moves with y");
    must(qdot_scene_particle(f.scene, "q", QDOT_ONE, pair(&f, y, x)));
    end(&f);
}

/* A spherical pendulum at its pole, and coordinates of which only the sum moves a
 * mass. */
static void
singular_masses_name_the_coordinate(void **state)
{
    fixture f;
    qdot_expr a, b, x[3];

    (void)state;
    begin(&f);
    a = coordinate(&f, "theta");
    b = coordinate(&f, "phi");
    x[0] = a;
    x[1] = times(&f, b, b);
    x[2] = QDOT_ZERO;
    must(qdot_scene_particle(f.scene, "p", QDOT_ONE, qdot_vector(f.pool, 3, x)));
    refuse(&f, QDOT_ESINGULAR, "no mass moves with phi");
    end(&f);

    begin(&f);
    a = coordinate(&f, "a");
    b = coordinate(&f, "b");
    must(qdot_scene_particle(f.scene, "p", QDOT_ONE, qdot_add(f.pool, a, b)));
    refuse(&f, QDOT_ESINGULAR, "b moves no mass that a does not move already");
    end(&f);
}

static void
a_start_outside_its_domain_is_refused(void **state)
{
    fixture f;
    qdot_expr r;

    (void)state;
    begin(&f);
    r = qdot_symbol_get(f.pool, QDOT_COORD, "r");
    qdot_symbol_domain(f.pool, r, QDOT_ZERO, true, parameter(&f, "R"), false);
    must(qdot_scene_coordinate(f.scene, r));
    must(qdot_scene_particle(f.scene, "p", QDOT_ONE, r));
    refuse(&f, QDOT_EUNSET, "parameter R has no value");
    set(&f, "R", "3");
    refuse(&f, QDOT_EDOMAIN, "r = 0 is outside its domain 0 < r <= R");
    assert_string_equal(qdot_last_error()->hint, "start r = ...");
    end(&f);
}

/* x = 1 + t (from rest on it moves by v0): leaves x < 2 at t = 1, to the last bits. */
static void
a_run_that_leaves_its_domain_says_when(void **state)
{
    fixture f;
    qdot_expr x;
    qdot_run *r;
    const qdot_run_report *report;
    size_t n;

    (void)state;
    begin(&f);
    x = qdot_symbol_get(f.pool, QDOT_COORD, "x");
    qdot_symbol_domain(f.pool, x, QDOT_NIL, false, qdot_expr_int(f.pool, 2), true);
    must(qdot_scene_coordinate(f.scene, x));
    must(qdot_scene_particle(f.scene, "p", QDOT_ONE, x));
    f.q0[0] = QDOT_ONE;
    f.v0[0] = number(&f, "0.3");
    f.request.t1 = qdot_expr_int(f.pool, 10);
    r = run(&f);
    report = qdot_run_get_report(r);
    assert_int_equal(report->status, QDOT_RUN_FAILED);
    if (!strstr(report->reason, "x left its domain x < 2 at t = 3.3333333333333"))
        fail_msg("%s", report->reason);
    assert_true(fabs(report->t1 - 1 / 0.3) < 1e-14);
    assert_true(report->q[0] < 2 && report->q[0] > 2 - 1e-14);
    assert_true(qdot_run_times(r, &n)[n - 1] == report->t1);
    assert_true(report->error < 1e-13);
    qdot_run_free(r);
    end(&f);
}

/* x'' = -1/x^2 from 1 at rest falls into 0 at t = pi/(2 sqrt 2). */
static void
a_singularity_is_told_and_the_run_kept(void **state)
{
    fixture f;
    qdot_expr x;
    qdot_run *r;
    const qdot_run_report *report;

    (void)state;
    begin(&f);
    x = coordinate(&f, "x");
    must(qdot_scene_particle(f.scene, "p", QDOT_ONE, x));
    must(qdot_scene_potential( /* x^2 = 1 - 2 t^2 */
        f.scene, qdot_neg(f.pool, qdot_pow_int(f.pool, x, -2))));
    f.q0[0] = QDOT_ONE;
    f.request.t1 = qdot_expr_int(f.pool, 2);
    r = run(&f);
    report = qdot_run_get_report(r);
    assert_int_equal(report->status, QDOT_RUN_FAILED);
    assert_non_null(strstr(report->reason, "t = 0.7071"));
    assert_true(report->t1 > 0.7071 && report->t1 <= sqrt(0.5) + 1e-9);
    assert_true(isfinite(report->q[0]) && isfinite(report->v[0]) && report->steps > 10);
    qdot_run_free(r);
    end(&f);
}

static void
ctrl_c_keeps_the_run_so_far(void **state)
{
    fixture f;
    qdot_run *r = NULL;
    size_t n;

    (void)state;
    pendulum(&f);
    must(qdot_run_new(f.scene, &f.request, &r)); /* all is derived now */
    qdot_run_free(r);
    r = NULL;
    qdot_interrupt_set();
    assert_int_equal(qdot_run_new(f.scene, &f.request, &r), QDOT_EINTR);
    qdot_interrupt_clear();
    if (r) {
        assert_int_equal(qdot_run_get_report(r)->status, QDOT_RUN_FAILED);
        assert_true(qdot_run_times(r, &n)[0] == 0 && n >= 1);
        qdot_run_free(r);
    }
    end(&f);
}

static void
the_plan_is_told(void **state)
{
    fixture f;
    qdot_text text = {0};

    (void)state;
    chain(&f, 7);
    must(qdot_run_plan(f.scene, &f.request, &text));
    assert_non_null(strstr(text.at, "7 x 7, full; not formed"));
    assert_non_null(strstr(text.at, "7 calls of elementary functions"));
    assert_non_null(strstr(text.at, "method: taylor, chosen"));
    qdot_text_clear(&text);
    f.request.method = "bsimp";
    must(qdot_run_plan(f.scene, &f.request, &text));
    assert_non_null(strstr(text.at, "jacobian: exact"));
    qdot_text_clear(&text);
    end(&f);
}

/* Out of memory at the n-th allocation of a run, for n up to where it passes. */
static void
every_failed_allocation_is_survived(void **state)
{
    fixture f;

    (void)state;
    chain(&f, 2);
    survives_failed_allocations(&f);
    end(&f);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pendulum_agrees_with_elliptic_functions),
        cmocka_unit_test(elastic_pendulum_agrees),
        cmocka_unit_test(duffing_agrees),
        cmocka_unit_test(kepler_in_polar_coordinates_agrees),
        cmocka_unit_test(chain_of_eight_agrees),
        cmocka_unit_test(every_method_reaches_the_same_end),
        cmocka_unit_test(a_run_back_returns_to_the_start),
        cmocka_unit_test(an_empty_interval_is_the_start),
        cmocka_unit_test(values_are_as_accurate_as_the_run),
        cmocka_unit_test(functions_may_be_set),
        cmocka_unit_test(a_stated_lagrangian_may_be_indefinite),
        cmocka_unit_test(energy_drift_only_where_it_is_conserved),
        cmocka_unit_test(events_that_are_only_seen_cost_nothing),
        cmocka_unit_test(requests_without_sense_are_refused),
        cmocka_unit_test(scenes_without_motion_are_refused),
        cmocka_unit_test(singular_masses_name_the_coordinate),
        cmocka_unit_test(a_start_outside_its_domain_is_refused),
        cmocka_unit_test(a_run_that_leaves_its_domain_says_when),
        cmocka_unit_test(a_singularity_is_told_and_the_run_kept),
        cmocka_unit_test(ctrl_c_keeps_the_run_so_far),
        cmocka_unit_test(the_plan_is_told),
        cmocka_unit_test(every_failed_allocation_is_survived),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
