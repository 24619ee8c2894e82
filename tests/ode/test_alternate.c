/* test_alternate.c -- a damper that fades and comes back: by radau, by series, by radau. */
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <string.h>
#include <cmocka.h>

#include <math.h>

#include "num/series.h"
#include "ode/integrate.h"
#include "ode/trajectory.h"

enum { MOST = 40, STRIDE = 48, N = 6 };
static const double w2 = 49, rate = 0.02, c1 = 1e6, drive = 3, pull = 40;

/* x' = v, v' = -w^2 x - c v + pull d, with c = c1 a^8, (a, b)' = rate (-b, a) and (d, e)' = drive (-e, d):
 * a = cos(rate t), d = cos(drive t); y = (x, a, b, v, d, e) */
typedef struct {
    double y[N * STRIDE], a2[STRIDE], a4[STRIDE], a8[STRIDE], unit;
} motion;

static double
product(const double *a, const double *b, int k)
{
    double sum = 0;

    for (int j = 0; j <= k; j++)
        sum += a[j] * b[k - j];
    return sum;
}

static qdot_status
expand_order(motion *m, int k)
{
    double *x = m->y, *a = x + STRIDE, *b = a + STRIDE, *v = b + STRIDE, *d = v + STRIDE,
           *e = d + STRIDE;
    const double by = m->unit / (k + 1);

    m->a2[k] = product(a, a, k);
    m->a4[k] = product(m->a2, m->a2, k);
    m->a8[k] = product(m->a4, m->a4, k);
    x[k + 1] = by * v[k];
    a[k + 1] = -by * rate * b[k];
    v[k + 1] = by * (pull * d[k] - w2 * x[k] - c1 * product(m->a8, v, k));
    b[k + 1] = by * rate * a[k];
    d[k + 1] = -by * drive * e[k];
    e[k + 1] = by * drive * d[k];
    return QDOT_OK;
}

static qdot_status
begin(double t, const double *y, double unit, void *user)
{
    motion *m = user;

    (void)t;
    m->unit = unit;
    for (int i = 0; i < N; i++)
        m->y[i * STRIDE] = y[i];
    return expand_order(m, 0);
}

static qdot_status
extend(int p, void *user)
{
    for (int k = 1; k < p; k++)
        (void)expand_order(user, k);
    return QDOT_OK;
}

static qdot_status
rhs(double t, const double *y, double *dydt, void *user)
{
    (void)t;
    (void)user;
    dydt[0] = y[3];
    dydt[1] = -rate * y[2];
    dydt[2] = rate * y[1];
    dydt[3] = pull * y[4] - w2 * y[0] - c1 * pow(y[1], 8) * y[3];
    dydt[4] = -drive * y[5];
    dydt[5] = drive * y[4];
    return QDOT_OK;
}

static qdot_status
jacobian(double t, const double *y, double *dfdy, double *dfdt, void *user)
{
    (void)t;
    (void)user;
    memset(dfdy, 0, N * N * sizeof *dfdy);
    memset(dfdt, 0, N * sizeof *dfdt);
    dfdy[3] = 1;
    dfdy[1 * N + 2] = -rate;
    dfdy[2 * N + 1] = rate;
    dfdy[3 * N] = -w2;
    dfdy[3 * N + 1] = -8 * c1 * pow(y[1], 7) * y[3];
    dfdy[3 * N + 3] = -c1 * pow(y[1], 8);
    dfdy[3 * N + 4] = pull;
    dfdy[4 * N + 5] = -drive;
    dfdy[5 * N + 4] = drive;
    return QDOT_OK;
}

static const double start_of[N] = {1, 1, 0, 0, 1, 0};

typedef struct {
    motion m;
    qdot_ode_series series;
    qdot_ode_system system;
} fixture;

static void
start(fixture *f)
{
    memset(f, 0, sizeof *f);
    f->series = (qdot_ode_series){.most = MOST,
                                  .x = f->m.y,
                                  .stride = STRIDE,
                                  .cost.kernels = {50, 5, 0.3},
                                  .begin = begin,
                                  .extend = extend,
                                  .user = &f->m};
    f->system = (qdot_ode_system){.n = N,
                                  .rhs = rhs,
                                  .jacobian = jacobian,
                                  .user = &f->m,
                                  .series = &f->series};
}

static const qdot_ode_method *
radau(void)
{
    return qdot_ode_method_find("radau");
}

/* Over a full turn of a, through two places where the damper is off; read across the changes it is as
 * accurate as by radau alone under a tighter tolerance, and took a part of the steps. */
static void
one_trajectory_goes_there_and_back(void **state)
{
    const qdot_ode_options o = {.tol = 1e-9, .alternates = true}, alone = {.tol = 1e-12};
    const double t1 = 2 * acos(-1) / rate;
    qdot_trajectory tr = {0}, ref = {0};
    double y[N], z[N];
    fixture f;

    (void)state;
    start(&f);
    assert_int_equal(qdot_trajectory_run(&tr, &f.system, radau(), &o, 0, t1, start_of), QDOT_OK);
    assert_int_equal(qdot_trajectory_run(&ref, &f.system, radau(), &alone, 0, t1, start_of), QDOT_OK);
    assert_int_equal(tr.result.outcome, QDOT_ODE_DONE);
    assert_false(tr.result.stiff);
    assert_true(tr.result.t == t1 && tr.t[tr.count - 1] == t1);
    assert_int_equal(tr.count, tr.result.stats.steps + 1);
    assert_true(tr.turns.n >= 2);
    for (size_t i = 0; i < tr.turns.n; i++) {
        assert_true(tr.turns.at[i].method->series == (i % 2 == 0));
        assert_true(i == 0 || tr.turns.at[i].first > tr.turns.at[i - 1].first);
    }
    for (double t = 0.37; t < t1; t += 0.73) {
        assert_int_equal(qdot_trajectory_at(&tr, &f.system, t, y), QDOT_OK);
        assert_int_equal(qdot_trajectory_at(&ref, &f.system, t, z), QDOT_OK);
        if (!(fabs(y[0] - z[0]) < 2e-8))
            fail_msg("x off by %g at %g", y[0] - z[0], t);
    }
    assert_true(qdot_trajectory_refine(&tr, &f.system, 2) == QDOT_OK);
    assert_true(qdot_trajectory_method_of(&tr, tr.turns.at[0].first)->series);
    assert_false(qdot_trajectory_method_of(&tr, tr.turns.at[0].first - 1)->series);
    qdot_trajectory_clear(&tr);
    qdot_trajectory_clear(&ref);
}

/* A run that may not change does not, and one that another ends stays ended. */
static qdot_status
stop_there(double t, const double *y, bool *stop, void *user)
{
    (void)y;
    *stop = t > *(double *)user;
    return QDOT_OK;
}

static void
it_stops_where_it_is_told(void **state)
{
    fixture f;

    (void)state;
    start(&f);
    for (double at = 1; at < 60; at += 7) {
        const qdot_ode_options o = {
            .tol = 1e-9, .alternates = true, .accepted = stop_there, .user = &at};
        double y[N];
        qdot_ode_result r;

        memcpy(y, start_of, sizeof y);
        assert_int_equal(qdot_ode_integrate(&f.system, radau(), &o, 0, 100, y, &r), QDOT_OK);
        assert_int_equal(r.outcome, QDOT_ODE_STOPPED);
        assert_true(r.t > at && r.t < at + 20);
    }
}

/* The method with which a run begins is that of its first step. */
static void
it_begins_as_it_is_told(void **state)
{
    fixture f;

    (void)state;
    start(&f);
    for (int i = 0; i < 2; i++) {
        const qdot_ode_method *now = i ? qdot_ode_method_find("taylor") : radau();
        const qdot_ode_options o = {.tol = 1e-9, .alternates = true, .now = i ? now : NULL};
        qdot_ode_controller c;
        qdot_ode_step step;

        assert_int_equal(qdot_ode_controller_open(&c, &f.system, radau(), &o, 0, 100, start_of), QDOT_OK);
        assert_int_equal(qdot_ode_controller_offer(&c, &step), QDOT_OK);
        assert_ptr_equal(step.method, now);
        qdot_ode_controller_close(&c, QDOT_OK, true);
    }
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_trajectory_goes_there_and_back),
        cmocka_unit_test(it_stops_where_it_is_told),
        cmocka_unit_test(it_begins_as_it_is_told),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
