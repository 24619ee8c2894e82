/* test_variation.c -- slopes of motions by parameters and initial values, against closed forms. */
#include "expr/build.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "sim/scenes.h"

#include <math.h>

#include "expr/calculus.h"
#include "sim/study/variation.h"

/* The slope of e at the end in direction k, with its error. */
static double
slope(const qdot_variation *v, qdot_run *r, qdot_expr e, size_t k, double *error)
{
    const qdot_expr d = qdot_variation_of(v, e, k);
    const double t = qdot_run_get_report(r)->t1;
    double value;

    must(qdot_pool_check(v->of->pool));
    must(qdot_run_values(r, 1, &d, 1, &t, &value, error));
    return value;
}

static void
same(double value, double error, double truth)
{
    if (!(fabs(value - truth) <= error + 1e-15 * fmax(1, fabs(truth))) ||
        !(error < 1e-10))
        fail_msg("%.17g for %.17g, stated %g", value, truth, error);
}

static qdot_run *
run_of(const qdot_variation *v)
{
    const qdot_run_request request = qdot_variation_request(v);
    qdot_run *r = NULL;

    must(qdot_run_new(v->scene, &request, &r));
    must(qdot_variation_check_start(v, r));
    return r;
}

/* The values of the request with one of them free. */
static const qdot_expr *
with_free(fixture *f, qdot_expr *values, size_t i)
{
    memcpy(values, f->values, sizeof f->values);
    values[i] = f->symbols[i];
    return values;
}

/* m x'' = -k x from x = 1: x = cos w t, w^2 = k/m. */
static void
of_an_oscillator(void **state)
{
    const qdot_expr none[] = {QDOT_ZERO, QDOT_ZERO}, place[] = {QDOT_ONE, QDOT_ZERO},
                    speed[] = {QDOT_ZERO, QDOT_ONE};
    const double w = 2, t = 3;
    qdot_expr by_k[MOST_VALUES], by_m[MOST_VALUES], x;
    qdot_variation v;
    double error, is;
    fixture f;
    qdot_run *r;

    (void)state;
    begin(&f);
    x = coordinate(&f, "x");
    must(qdot_scene_particle(f.scene, "a", parameter(&f, "m"), x));
    must(qdot_scene_potential(
        f.scene,
        times(&f, number(&f, "0.5"), times(&f, parameter(&f, "k"), times(&f, x, x)))));
    set(&f, "m", "1");
    set(&f, "k", "4");
    f.q0[0] = QDOT_ONE;
    f.request.t1 = qdot_expr_int(f.pool, 3);
    const qdot_variation_by by[] = {
        {"m", f.symbols[0], with_free(&f, by_m, 0), none, 0},
        {"k", f.symbols[1], with_free(&f, by_k, 1), none, 0},
        {"x", QDOT_NIL, NULL, place, 0},
        {"x'", QDOT_NIL, NULL, speed, 0},
    };

    must(qdot_variation_make(f.scene, &f.request, 4, by, true, &v));
    r = run_of(&v);
    is = slope(&v, r, x, 0, &error);
    same(is, error, t * sin(w * t) * w / 2);
    is = slope(&v, r, x, 1, &error);
    same(is, error, -t * sin(w * t) / (2 * w));
    is = slope(&v, r, x, 2, &error);
    same(is, error, cos(w * t));
    is = slope(&v, r, velocity(&f, x), 3, &error);
    same(is, error, cos(w * t));
    /* k itself counts: d(k x^2)/dk */
    is = slope(&v, r, times(&f, f.symbols[1], times(&f, x, x)), 1, &error);
    same(is, error, cos(w * t) * cos(w * t) - 4 * cos(w * t) * t * sin(w * t) / w);
    qdot_run_free(r);
    qdot_variation_clear(&v);
    end(&f);
}

/* A ball falls from y = h and bounces with e: y = 0 at tau = (2 h/g)^1/2, then
 * y = e g tau (t - tau) - g (t - tau)^2/2. */
static void
through_a_bounce(void **state)
{
    const qdot_expr none[] = {QDOT_ZERO, QDOT_ZERO}, place[] = {QDOT_ONE, QDOT_ZERO};
    const double g = 10, e = 0.5, tau = sqrt(0.2), s = 0.6 - tau;
    qdot_expr by_e[MOST_VALUES], by_g[MOST_VALUES], y, v_y, after;
    qdot_event bounce = {.name = (char *)"bounce", .way = -1};
    qdot_variation v;
    double error, is;
    fixture f;
    qdot_run *r;

    (void)state;
    begin(&f);
    y = coordinate(&f, "y");
    v_y = velocity(&f, y);
    must(qdot_scene_particle(f.scene, "a", QDOT_ONE, y));
    must(qdot_scene_potential(f.scene, times(&f, parameter(&f, "g"), y)));
    set(&f, "e", "0.5");
    set(&f, "g", "10");
    after = qdot_neg(f.pool, times(&f, parameter(&f, "e"), v_y));
    bounce.left = y;
    bounce.right = QDOT_ZERO;
    must(qdot_vec_push(&bounce.targets, v_y));
    must(qdot_vec_push(&bounce.values, after));
    must(qdot_scene_event(f.scene, &bounce));
    f.q0[0] = QDOT_ONE;
    f.request.t1 = number(&f, "0.6");
    const qdot_variation_by by[] = {
        {"e", f.symbols[0], with_free(&f, by_e, 0), none, 0},
        {"g", f.symbols[1], with_free(&f, by_g, 1), none, 0},
        {"y", QDOT_NIL, NULL, place, 0},
    };

    must(qdot_variation_make(f.scene, &f.request, 3, by, true, &v));
    r = run_of(&v);
    is = slope(&v, r, y, 0, &error);
    same(is, error, g * tau * s);
    is = slope(&v, r, y, 1, &error); /* dtau/dg = -tau/(2 g) */
    same(is, error,
         e * tau * s - s * s / 2 - tau / (2 * g) * (e * g * s - e * g * tau + g * s));
    is = slope(&v, r, y, 2, &error); /* dtau/dh = 1/(g tau) */
    same(is, error, (e * g * s - e * g * tau + g * s) / (g * tau));
    qdot_run_free(r);
    qdot_variation_clear(&v);
    qdot_free(bounce.targets.at);
    qdot_free(bounce.values.at);
    end(&f);
}

/* x^2 + y^2 = L^2, from (0, L) with x' = 1: x = L sin(t/L). */
static void
along_a_circle(void **state)
{
    const qdot_expr zero = QDOT_ZERO, one = QDOT_ONE;
    const qdot_expr none[] = {zero, zero, zero, zero}, speed[] = {zero, zero, one, zero},
                    place[] = {zero, one, zero, zero};
    const bool open[] = {true, false}, whole[] = {true, true};
    const double t = 0.7;
    qdot_expr by_L[MOST_VALUES], x, y, L;
    qdot_variation v;
    double error, is;
    fixture f;
    qdot_run *r;

    (void)state;
    begin(&f);
    x = coordinate(&f, "x");
    y = coordinate(&f, "y");
    L = parameter(&f, "L");
    must(qdot_scene_particle(f.scene, "a", QDOT_ONE, pair(&f, x, y)));
    must(qdot_scene_constraint(f.scene, "rod",
                               qdot_add(f.pool, times(&f, x, x), times(&f, y, y)),
                               times(&f, L, L)));
    set(&f, "L", "1");
    f.q0[1] = f.v0[0] = QDOT_ONE;
    f.request.q_named = open;
    f.request.v_named = open;
    f.request.t1 = number(&f, "0.7");
    const qdot_variation_by by[] = {{"L", f.symbols[0], with_free(&f, by_L, 0), none, 0},
                                    {"x'", QDOT_NIL, NULL, speed, 0}};

    must(qdot_variation_make(f.scene, &f.request, 2, by, true, &v));
    r = run_of(&v);
    is = slope(&v, r, x, 0, &error);
    same(is, error, sin(t) - t * cos(t));
    is = slope(&v, r, y, 1, &error);
    same(is, error, -t * sin(t));
    qdot_run_free(r);
    qdot_variation_clear(&v);

    /* a start that names all cannot change alone */
    f.request.q_named = whole;
    const qdot_variation_by by_y[] = {{"y", QDOT_NIL, NULL, place, 0}};

    assert_int_equal(qdot_variation_make(f.scene, &f.request, 1, by_y, true, &v), QDOT_EINVAL);
    qdot_variation_clear(&v);
    end(&f);
}

static void
jumps_are_refused(void **state)
{
    const qdot_expr place[] = {QDOT_ONE, QDOT_ZERO};
    const qdot_variation_by by = {"x", QDOT_NIL, NULL, place, 0};
    qdot_variation v;
    qdot_expr x;
    fixture f;

    (void)state;
    begin(&f);
    x = coordinate(&f, "x");
    must(qdot_scene_particle(f.scene, "a", QDOT_ONE, x));
    must(qdot_scene_potential(f.scene, qdot_fun1(f.pool, QDOT_ABS, x)));
    assert_int_equal(qdot_variation_make(f.scene, &f.request, 1, &by, true, &v),
                     QDOT_ENOTBUILT);
    qdot_variation_clear(&v);
    end(&f);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(of_an_oscillator),
        cmocka_unit_test(through_a_bounce),
        cmocka_unit_test(along_a_circle),
        cmocka_unit_test(jumps_are_refused),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
