/* test_response.c -- values and slopes at given times, against closed forms and differences of runs. */
#include "expr/build.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "sim/scenes.h"

#include <math.h>

#include "expr/calculus.h"
#include "num/least-squares.h"
#include "sim/study/response.h"

enum { MOST = 64 };

static void
same(double is, double truth, double within)
{
    if (!(fabs(is - truth) <= within * fmax(1, fabs(truth))))
        fail_msg("%.17g for %.17g", is, truth);
}

/* m x'' = -k x from x = a, x' = m/2: x = a cos w t + m/2 sin(w t)/w, w^2 = k/m. */
static void
of_an_oscillator(void **state)
{
    static const double u[][3] = {{1, 4, 1}, {2, 3, -0.5}, {1, 4, 1}, {0.7, 9, 0.25}};
    const double t[] = {0, 0.5, 0.5, 2, 3};
    const char *names[] = {"m", "k", "x"};
    double values[MOST], slopes[MOST];
    qdot_response *r;
    qdot_expr x;
    fixture f;

    (void)state;
    begin(&f);
    x = coordinate(&f, "x");
    must(qdot_scene_particle(f.scene, "a", parameter(&f, "m"), x));
    must(qdot_scene_potential(
        f.scene,
        times(&f, number(&f, "0.5"), times(&f, parameter(&f, "k"), times(&f, x, x)))));
    set_free(&f, "m");
    set_free(&f, "k");
    f.q0[0] = x;
    f.v0[0] = times(&f, QDOT_HALF, f.symbols[0]);
    f.request.t1 = qdot_expr_int(f.pool, 3);
    f.request.tol = 1e-14;
    const qdot_expr unknowns[] = {f.symbols[0], f.symbols[1], x},
                    exprs[] = {x, times(&f, f.symbols[1], velocity(&f, x))};

    must(qdot_response_new(&(qdot_response_of){f.scene, &f.request, 3, unknowns, names, false, 2, exprs,
                                               5, t},
                           &r));
    for (size_t j = 0; j < sizeof u / sizeof *u; j++) {
        const double m = u[j][0], k = u[j][1], a = u[j][2], w = sqrt(k / m);

        must(qdot_response_at(r, u[j], values, slopes));
        for (size_t i = 0; i < 5; i++) {
            const double s = sin(w * t[i]), c = cos(w * t[i]), v = m / 2;
            const double by_w = -a * t[i] * s + v * (t[i] * c / w - s / (w * w));

            same(values[2 * i], a * c + v * s / w, 1e-13);
            same(values[2 * i + 1], k * (v * c - a * w * s), 1e-12);
            same(slopes[6 * i], -by_w * w / (2 * m) + s / w / 2, 1e-12);
            same(slopes[6 * i + 1], by_w * w / (2 * k), 1e-12);
            same(slopes[6 * i + 2], c, 1e-12);
            same(slopes[6 * i + 5], -k * w * s, 1e-12);
        }
    }
    qdot_response_free(r);
    end(&f);
}

/* A ball falls from y = h and bounces with e: y = 0 at tau = (2 h/g)^1/2, then
 * y = e g tau (t - tau) - g (t - tau)^2/2. */
static void
through_a_bounce(void **state)
{
    static const double u[][2] = {{0.5, 1}, {0.8, 0.7}, {0.5, 1}};
    const double t[] = {0.2, 0.6}, g = 10;
    const char *names[] = {"e", "y"};
    qdot_event bounce = {.name = (char *)"bounce", .way = -1};
    double values[MOST], slopes[MOST];
    qdot_response *r;
    qdot_expr y, v_y;
    fixture f;

    (void)state;
    begin(&f);
    y = coordinate(&f, "y");
    v_y = velocity(&f, y);
    must(qdot_scene_particle(f.scene, "a", QDOT_ONE, y));
    must(qdot_scene_potential(f.scene, times(&f, number(&f, "10"), y)));
    set_free(&f, "e");
    bounce.left = y;
    bounce.right = QDOT_ZERO;
    must(qdot_vec_push(&bounce.targets, v_y));
    must(qdot_vec_push(&bounce.values, qdot_neg(f.pool, times(&f, parameter(&f, "e"), v_y))));
    must(qdot_scene_event(f.scene, &bounce));
    f.q0[0] = y;
    f.request.t1 = number(&f, "0.6");
    const qdot_expr unknowns[] = {f.symbols[0], y};

    must(qdot_response_new(&(qdot_response_of){f.scene, &f.request, 2, unknowns, names, false, 1, &y, 2, t},
                           &r));
    for (size_t j = 0; j < sizeof u / sizeof *u; j++) {
        const double e = u[j][0], h = u[j][1], tau = sqrt(2 * h / g), s = t[1] - tau;

        must(qdot_response_at(r, u[j], values, slopes));
        same(values[0], h - g * t[0] * t[0] / 2, 1e-12);
        same(slopes[1], 1, 1e-12);
        same(values[1], e * g * tau * s - g * s * s / 2, 1e-12);
        same(slopes[2], g * tau * s, 1e-12);
        same(slopes[3], (e * g * (s - tau) + g * s) / (g * tau), 1e-12);
    }
    qdot_response_free(r);
    qdot_free(bounce.targets.at);
    qdot_free(bounce.values.at);
    end(&f);
}

/* x^2 + y^2 = L^2, from (0, L) with x' = v: x = L sin(v t/L). */
static void
along_a_circle(void **state)
{
    static const double u[][2] = {{1, 1}, {2, 0.5}};
    const double t[] = {0.3, 0.7};
    const bool open[] = {true, false};
    const char *names[] = {"L", "x'"};
    double values[MOST], slopes[MOST];
    qdot_response *r;
    qdot_expr x, y;
    fixture f;

    (void)state;
    begin(&f);
    x = coordinate(&f, "x");
    y = coordinate(&f, "y");
    must(qdot_scene_particle(f.scene, "a", QDOT_ONE, pair(&f, x, y)));
    must(qdot_scene_constraint(f.scene, "rod",
                               qdot_add(f.pool, times(&f, x, x), times(&f, y, y)),
                               times(&f, parameter(&f, "L"), parameter(&f, "L"))));
    set_free(&f, "L");
    f.q0[1] = f.symbols[0];
    f.v0[0] = velocity(&f, x);
    f.request.q_named = f.request.v_named = open;
    f.request.t1 = number(&f, "0.7");
    const qdot_expr unknowns[] = {f.symbols[0], velocity(&f, x)};

    must(qdot_response_new(&(qdot_response_of){f.scene, &f.request, 2, unknowns, names, false, 1, &x, 2, t},
                           &r));
    for (size_t j = 0; j < sizeof u / sizeof *u; j++) {
        must(qdot_response_at(r, u[j], values, slopes));
        for (size_t i = 0; i < 2; i++) {
            const double L = u[j][0], v = u[j][1], phi = v * t[i] / L;

            same(values[i], L * sin(phi), 1e-12);
            same(slopes[2 * i], sin(phi) - phi * cos(phi), 1e-12);
            same(slopes[2 * i + 1], t[i] * cos(phi), 1e-12);
        }
    }
    qdot_response_free(r);
    end(&f);
}

/* A double pendulum's slopes are the differences of its values. */
static void
of_a_double_pendulum(void **state)
{
    const double t[] = {0.5, 1, 2};
    const char *names[] = {"l", "g", "theta[1]", "theta[2]'"};
    double u[] = {1, 9.81, 1, 0}, values[MOST], slopes[MOST], moved[2][MOST], other[MOST];
    qdot_response *r;
    fixture f;

    (void)state;
    chain(&f, 2);
    const qdot_expr a = f.scene->coordinates.at[0], b = f.scene->coordinates.at[1];
    const qdot_expr unknowns[] = {parameter(&f, "l"), parameter(&f, "g"), a, velocity(&f, b)};

    f.values[1] = f.symbols[1];
    f.values[2] = f.symbols[2];
    f.q0[0] = a;
    f.q0[1] = times(&f, QDOT_HALF, unknowns[0]);
    f.v0[1] = unknowns[3];
    f.request.t1 = qdot_expr_int(f.pool, 2);
    must(qdot_response_new(&(qdot_response_of){f.scene, &f.request, 4, unknowns, names, false, 1, &b, 3, t},
                           &r));
    must(qdot_response_at(r, u, values, slopes));
    for (size_t k = 0; k < 4; k++) {
        const double kept = u[k], h = 1e-5;

        for (size_t side = 0; side < 2; side++) {
            u[k] = kept + (side ? -h : h);
            must(qdot_response_at(r, u, moved[side], other));
        }
        u[k] = kept;
        for (size_t i = 0; i < 3; i++)
            same((moved[0][i] - moved[1][i]) / (2 * h), slopes[4 * i + k], 1e-7);
    }
    qdot_response_free(r);
    end(&f);
}

/* --- standard errors -------------------------------------------------------------------------------- */

enum { POINTS = 40, REPEATED = 1000, UNKNOWNS = 3 };

/* Normal numbers by Box and Muller from a linear congruential generator. */
static double
normal(uint64_t *seed)
{
    double u[2];

    for (int i = 0; i < 2; i++) {
        *seed = *seed * 6364136223846793005u + 1442695040888963407u;
        u[i] = ((double)(*seed >> 11) + 0.5) / 9007199254740992.0;
    }
    return sqrt(-2 * log(u[0])) * cos(2 * M_PI * u[1]);
}

typedef struct {
    qdot_response *r;
    double y[POINTS], sigma;
} sample;

static qdot_status
misfit(const double *u, double *f, double *J, void *user)
{
    const sample *s = user;

    QDOT_TRY(qdot_response_at(s->r, u, f, J));
    for (size_t i = 0; i < POINTS; i++)
        f[i] = (f[i] - s->y[i]) / s->sigma;
    for (size_t i = 0; i < POINTS * UNKNOWNS; i++)
        J[i] /= s->sigma;
    return QDOT_OK;
}

/* Of 1,000 fits to a damped pendulum, with noise of seed 1, 95 % of the intervals hold the truth: 1.96 standard errors
 * where sigma is known, 2.026 (Student's t of 37 degrees of freedom) where it is that of the residuals. */
static void
intervals_hold_the_truth(void **state)
{
    static const double truth[UNKNOWNS] = {9.81, 0.2, 1.2};
    const char *names[] = {"g", "c", "theta"};
    size_t held[2][UNKNOWNS] = {{0}};
    double t[POINTS], exact[POINTS], slopes[POINTS * UNKNOWNS], mean[UNKNOWNS] = {0};
    sample s = {.sigma = 0.03};
    uint64_t seed = 1;
    qdot_expr theta;
    fixture f;

    (void)state;
    begin(&f);
    theta = coordinate(&f, "theta");
    must(qdot_scene_particle(f.scene, "a", QDOT_ONE, theta));
    must(qdot_scene_potential(f.scene, qdot_neg(f.pool, times(&f, parameter(&f, "g"),
                                                              qdot_fun1(f.pool, QDOT_COS, theta)))));
    must(qdot_scene_dissipation(f.scene,
                                times(&f, parameter(&f, "c"),
                                      times(&f, QDOT_HALF, times(&f, velocity(&f, theta),
                                                                 velocity(&f, theta))))));
    set_free(&f, "g");
    set_free(&f, "c");
    f.q0[0] = theta;
    f.request.t1 = qdot_expr_int(f.pool, 6);
    f.request.tol = 1e-9;
    for (size_t i = 0; i < POINTS; i++)
        t[i] = 6.0 * (double)(i + 1) / POINTS;
    const qdot_expr unknowns[] = {f.symbols[0], f.symbols[1], theta};

    must(qdot_response_new(&(qdot_response_of){f.scene, &f.request, UNKNOWNS, unknowns, names, false, 1,
                                               &theta, POINTS, t},
                           &s.r));
    must(qdot_response_at(s.r, truth, exact, slopes));
    for (size_t k = 0; k < REPEATED; k++) {
        double u[UNKNOWNS] = {9, 0.1, 1};
        qdot_least_squares x = {
            .n = POINTS, .p = UNKNOWNS, .model = misfit, .user = &s, .u = u};

        for (size_t i = 0; i < POINTS; i++)
            s.y[i] = exact[i] + s.sigma * normal(&seed);
        must(qdot_least_squares_find(&x));
        assert_true(x.converged);
        for (size_t j = 0; j < UNKNOWNS; j++) {
            const double error = sqrt(x.covariance[j * UNKNOWNS + j]),
                         off = fabs(u[j] - truth[j]);

            mean[j] += (u[j] - truth[j]) / error / REPEATED;
            held[0][j] += off <= 1.95996 * error;
            held[1][j] += off <= 2.02619 * error * sqrt(x.chi2 / (POINTS - UNKNOWNS));
        }
        qdot_least_squares_clear(&x);
    }
    for (size_t j = 0; j < 2 * UNKNOWNS; j++) {
        const size_t of = held[j / UNKNOWNS][j % UNKNOWNS];

        print_message("%s: %zu of %d intervals, mean %.3f\n", names[j % UNKNOWNS], of, REPEATED,
                      mean[j % UNKNOWNS]);
        assert_in_range(of, 930, 970);
        assert_true(fabs(mean[j % UNKNOWNS]) < 0.15);
    }
    qdot_response_free(s.r);
    end(&f);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(of_an_oscillator),
        cmocka_unit_test(through_a_bounce),
        cmocka_unit_test(along_a_circle),
        cmocka_unit_test(of_a_double_pendulum),
        cmocka_unit_test(intervals_hold_the_truth),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
