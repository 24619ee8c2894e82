/* test_api.c -- the public interface: what it derives, decides, runs; its errors; failing memory. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/memory.h"
#include "qdot.h"

static const char pendulum[] = "param m, l, g > 0\n"
                               "coord theta\n"
                               "particle bob mass m at (l*sin(theta), -l*cos(theta))\n"
                               "gravity (0, -g)\n"
                               "set m = 1, l = 1, g = 9.81\n"
                               "start theta = 2\n";

static int
begin(void **state)
{
    qdot_system *s;

    if (qdot_system_new(&s) != QDOT_RESULT_OK)
        return 1;
    *state = s;
    return qdot_system_declare(s, pendulum) != QDOT_RESULT_OK;
}

static int
end(void **state)
{
    qdot_system_free(*state);
    return 0;
}

static void
expect_formula(qdot_system *s, const char *expression, qdot_notation notation, const char *wanted)
{
    char *text;

    assert_int_equal(qdot_system_derive(s, expression, notation, &text), QDOT_RESULT_OK);
    assert_string_equal(text, wanted);
    qdot_string_free(text);
}

static void
expect_error(qdot_system *s, qdot_result result, qdot_result wanted, const char *begins)
{
    assert_int_equal(result, wanted);
    if (strncmp(qdot_system_error(s), begins, strlen(begins)) != 0)
        fail_msg("the error is `%s`", qdot_system_error(s));
}

static void
formulas_come_in_every_notation(void **state)
{
    qdot_system *s = *state;

    expect_formula(s, "T", QDOT_NOTATION_PLAIN, "1/2*m*l^2*theta'^2");
    expect_formula(s, "T", QDOT_NOTATION_LATEX, "\\frac{1}{2} m l^{2} \\dot{\\theta}^{2}");
    expect_formula(s, "T", QDOT_NOTATION_UNICODE, "½ m l² θ̇²");
    expect_formula(s, "eom", QDOT_NOTATION_PLAIN, "m*l^2*theta'' = -m*l*g*sin(theta)");
    expect_formula(s, "[1, theta, 2*3]", QDOT_NOTATION_PLAIN, "1\ntheta\n6");
    expect_formula(s, "[T, theta]", QDOT_NOTATION_TREE,
                   "[\"list\",[\"*\",[\"/\",\"1\",\"2\"],\"m\",[\"^\",\"l\",\"2\"],[\"^\",[\"'\",\"theta\",1],\"2\"]],\"theta\"]");
}

static void
claims_are_proved_refuted_or_left_open(void **state)
{
    static const struct {
        const char *claim;
        qdot_truth truth;
    } claims[] = {
        {"T == 1/2*m*l^2*theta'^2", QDOT_TRUTH_PROVED},
        {"conserved energy", QDOT_TRUTH_PROVED},
        {"T == m*l^2*theta'^2", QDOT_TRUTH_REFUTED},
        {"conserved theta", QDOT_TRUTH_REFUTED},
        {"sin(theta) == 0 when theta = 0", QDOT_TRUTH_PROVED},
    };
    qdot_system *s = *state;

    for (size_t i = 0; i < sizeof claims / sizeof *claims; i++) {
        qdot_truth truth = QDOT_TRUTH_UNDECIDED;

        assert_int_equal(qdot_system_decide(s, claims[i].claim, &truth), QDOT_RESULT_OK);
        assert_int_equal(truth, claims[i].truth);
    }
}

/* theta after 10 s: an integration by another program's method agrees. */
static void
values_have_their_errors(void **state)
{
    static const double times[] = {10, 0, 2.5};
    double rows[3][2], errors[3][2], other[1], q, v;
    qdot_system *s = *state;
    qdot_motion *a, *b;
    qdot_motion_summary summary;

    assert_int_equal(qdot_system_run(s, "0..10 tol 1e-12", &a), QDOT_RESULT_OK);
    assert_int_equal(qdot_system_run(s, "0..10 tol 1e-10 method dop853", &b), QDOT_RESULT_OK);
    assert_int_equal(qdot_motion_values(a, "[theta, theta']", 3, times, 2, rows[0], errors[0]),
                     QDOT_RESULT_OK);
    assert_int_equal(qdot_motion_values(b, "theta", 1, times, 1, other, NULL), QDOT_RESULT_OK);
    assert_true(fabs(rows[0][0] - other[0]) < 1e-8);
    assert_true(rows[1][0] == 2 && rows[1][1] == 0);
    for (size_t i = 0; i < 3; i++)
        assert_true(errors[i][0] < 1e-10 && errors[i][1] < 1e-10);
    assert_true(fabs(2 * 9.81 * (cos(rows[2][0]) - cos(2)) - rows[2][1] * rows[2][1]) < 1e-10);

    assert_int_equal(qdot_motion_end(a, 1, &q, &v), QDOT_RESULT_OK);
    assert_true(q == rows[0][0] && v == rows[0][1]);
    assert_int_equal(qdot_motion_coordinates(a), 1);
    assert_string_equal(qdot_motion_coordinate(a, 0), "theta");
    assert_null(qdot_motion_coordinate(a, 1));
    assert_int_equal(qdot_motion_summarize(a, &summary, sizeof summary), QDOT_RESULT_OK);
    assert_true(summary.start == 0 && summary.end == 10 && summary.tolerance == 1e-12);
    assert_true(summary.error < 1e-10 && summary.energy_drift < 1e-11 && summary.steps > 10);
    assert_string_equal(summary.method, "taylor");
    assert_null(summary.reason);
    qdot_motion_free(a);
    qdot_motion_free(b);
}

static void
extrema_and_conserved_quantities_are_known(void **state)
{
    qdot_system *s = *state;
    qdot_motion *m;
    double value, error;
    const char *name;
    size_t n;

    assert_int_equal(qdot_system_run(s, "0..10", &m), QDOT_RESULT_OK);
    assert_int_equal(qdot_motion_over(m, QDOT_OVER_MIN, "theta", 0, 10, &value, &error),
                     QDOT_RESULT_OK);
    assert_true(fabs(value + 2) < 1e-10 && error < 1e-9);
    assert_int_equal(qdot_motion_over(m, QDOT_OVER_DRIFT, "energy", 0, 10, &value, NULL),
                     QDOT_RESULT_OK);
    assert_true(value < 1e-11);
    assert_int_equal(qdot_motion_conserved(m), 1);
    assert_int_equal(qdot_motion_drift(m, 0, &name, &value, &error), QDOT_RESULT_OK);
    assert_string_equal(name, "energy");
    assert_true(fabs(value + 9.81 * cos(2)) < 1e-13 && error < 1e-11);
    assert_non_null(qdot_motion_steps(m, &n));
    assert_true(n > 10);
    expect_error(s, qdot_motion_drift(m, 1, &name, NULL, NULL), QDOT_RESULT_INVALID, "drift: ");
    qdot_motion_free(m);
}

/* In whatever order times are given, each has its value and error, to the last bit. */
static void
times_are_given_in_any_order(void **state)
{
    enum { N = 200 };
    double times[N], values[N][2], errors[N][2], one[2], its_error[2];
    qdot_system *s = *state;
    qdot_motion *m;
    unsigned random = 1;

    for (size_t i = 0; i < N; i++) {
        random = random * 1103515245u + 12345u;
        times[i] = i % 17 == 3 ? times[i - 1] : (double)(random >> 8) / (1 << 24) * 10;
    }
    for (int backward = 0; backward < 2; backward++) {
        assert_int_equal(qdot_system_run(s, backward ? "10..0" : "0..10", &m), QDOT_RESULT_OK);
        assert_int_equal(qdot_motion_values(m, "[theta, theta']", N, times, 2, values[0], errors[0]), QDOT_RESULT_OK);
        for (size_t i = 0; i < N; i++) {
            assert_int_equal(qdot_motion_values(m, "[theta, theta']", 1, &times[i], 2, one, its_error), QDOT_RESULT_OK);
            assert_true(one[0] == values[i][0] && one[1] == values[i][1]);
            assert_true(its_error[0] == errors[i][0] && its_error[1] == errors[i][1]);
        }
        times[5] = NAN;
        expect_error(s, qdot_motion_values(m, "theta", N, times, 1, values[0], NULL), QDOT_RESULT_DOMAIN, "values:1:1: ");
        times[5] = 11;
        expect_error(s, qdot_motion_values(m, "theta", N, times, 1, values[0], NULL), QDOT_RESULT_DOMAIN,
                     "values:1:1: error: t = 11 is outside");
        times[5] = 1;
        qdot_motion_free(m);
    }
}

static void
a_range_that_is_no_range_is_refused(void **state)
{
    static const double ranges[][2] = {{0, NAN}, {NAN, 10}, {NAN, NAN}, {0, INFINITY}, {-1, 5}};
    qdot_system *s = *state;
    double value, back, error;
    qdot_motion *m;

    assert_int_equal(qdot_system_run(s, "0..10", &m), QDOT_RESULT_OK);
    for (size_t i = 0; i < sizeof ranges / sizeof *ranges; i++)
        expect_error(s, qdot_motion_over(m, QDOT_OVER_MAX, "theta", ranges[i][0], ranges[i][1], &value, &error),
                     QDOT_RESULT_DOMAIN, "over:1:1: error: the range ");
    for (int what = QDOT_OVER_MAX; what <= QDOT_OVER_DRIFT; what++) { /* ends in any order */
        assert_int_equal(qdot_motion_over(m, (qdot_over)what, "theta", 2, 8, &value, &error), QDOT_RESULT_OK);
        assert_int_equal(qdot_motion_over(m, (qdot_over)what, "theta", 8, 2, &back, &error), QDOT_RESULT_OK);
        assert_true(value == back);
    }
    qdot_motion_free(m);
}

static void
runs_of_statements_are_motions(void **state)
{
    static const double one = 1;
    qdot_system *s = *state;
    qdot_motion *a, *again, *latest, *own;
    double x, y;

    expect_error(s, qdot_system_motion(s, NULL, &a), QDOT_RESULT_NAME, "motion: there is no run yet");
    assert_null(a);
    expect_error(s, qdot_system_motion(s, NULL, NULL), QDOT_RESULT_INVALID, "motion: the motion is NULL");
    assert_int_equal(qdot_system_motion(NULL, NULL, &a), QDOT_RESULT_INVALID);
    assert_int_equal(qdot_system_declare(s, "run 0..10 as a; run 0..3"), QDOT_RESULT_OK);
    expect_error(s, qdot_system_motion(s, "b", &a), QDOT_RESULT_NAME,
                 "motion:1:1: error: there is no run `b`");
    expect_error(s, qdot_system_motion(s, "a b", &a), QDOT_RESULT_SYNTAX, "motion:1:3: error: ");
    expect_error(s, qdot_system_motion(s, "", &a), QDOT_RESULT_SYNTAX, "motion:1:1: error: ");
    assert_null(a);
    assert_int_equal(qdot_system_motion(s, "a", &a), QDOT_RESULT_OK);
    assert_int_equal(qdot_motion_values(a, "theta", 1, &one, 1, &x, NULL), QDOT_RESULT_OK);
    assert_int_equal(qdot_system_motion(s, NULL, &latest), QDOT_RESULT_OK);
    assert_int_equal(qdot_motion_values(latest, "theta", 1, &one, 1, &y, NULL), QDOT_RESULT_OK);
    assert_true(fabs(x - y) < 1e-10);
    qdot_motion_free(latest);
    qdot_motion_free(a); /* the run stays */
    assert_int_equal(qdot_system_motion(s, "a", &again), QDOT_RESULT_OK);
    assert_int_equal(qdot_system_motion(s, "run2", &latest), QDOT_RESULT_OK);
    qdot_motion_free(latest);
    assert_int_equal(qdot_system_declare(s, "run 0..1 as phi; run 0..k as f[k] for k = 1..3"), QDOT_RESULT_OK);
    assert_int_equal(qdot_system_motion(s, "φ", &latest), QDOT_RESULT_OK);
    qdot_motion_free(latest);
    assert_int_equal(qdot_system_motion(s, "f[1 + 1]", &latest), QDOT_RESULT_OK);
    qdot_motion_free(latest);
    /* a run that goes with its motion goes, whoever else looks at it */
    assert_int_equal(qdot_system_run(s, "0..2", &own), QDOT_RESULT_OK);
    assert_int_equal(qdot_system_motion(s, NULL, &latest), QDOT_RESULT_OK);
    qdot_motion_free(own);
    assert_int_equal(qdot_motion_coordinates(latest), 1);
    assert_int_equal(qdot_motion_values(latest, "theta", 1, &one, 1, &x, NULL), QDOT_RESULT_NAME);
    qdot_motion_free(latest);
    assert_int_equal(qdot_system_declare(s, "reset"), QDOT_RESULT_OK);
    assert_int_equal(qdot_motion_values(again, "theta", 1, &one, 1, &x, NULL), QDOT_RESULT_NAME);
    qdot_motion_free(again);
}

static void
events_are_listed(void **state)
{
    qdot_system *s = *state;
    qdot_motion *m;
    const char *name;
    double t, error;
    size_t n;
    int way;

    assert_int_equal(qdot_system_declare(s, "event low: theta = 0 falling"), QDOT_RESULT_OK);
    assert_int_equal(qdot_system_run(s, "0..1", &m), QDOT_RESULT_OK);
    assert_int_equal(qdot_motion_events(m, &n), QDOT_RESULT_OK);
    assert_int_equal(n, 1);
    assert_int_equal(qdot_motion_event(m, 0, &name, &t, &error, &way), QDOT_RESULT_OK);
    assert_string_equal(name, "low");
    /* a quarter of the period, sqrt(l/g) K(sin(theta/2)), by the arithmetic-geometric mean */
    assert_true(fabs(t - 0.6664677357087313) < 1e-11 && error < 1e-9 && way == -1);
    expect_error(s, qdot_motion_event(m, 1, NULL, NULL, NULL, NULL), QDOT_RESULT_INVALID, "event: ");
    qdot_motion_free(m);
}

static void
errors_name_the_place(void **state)
{
    qdot_system *s = *state;
    char *text = "";
    double x;
    qdot_truth truth;
    qdot_motion *m;

    expect_error(s, qdot_system_declare(s, "param k\ncoord y, k"), QDOT_RESULT_NAME,
                 "declare:2:10: error: ");
    expect_error(s, qdot_system_declare(s, "spring ("), QDOT_RESULT_SYNTAX, "declare:1:8: error: ");
    expect_error(s, qdot_system_derive(s, "T + omg", QDOT_NOTATION_PLAIN, &text), QDOT_RESULT_NAME,
                 "derive:1:5: error: unknown name `omg`\n  T + omg\n      ^\n");
    assert_null(text);
    expect_error(s, qdot_system_derive(s, "T; L", QDOT_NOTATION_PLAIN, &text), QDOT_RESULT_SYNTAX,
                 "derive:1:4: error: ");
    expect_error(s, qdot_system_derive(s, "", QDOT_NOTATION_PLAIN, &text), QDOT_RESULT_SYNTAX,
                 "derive:1:1: error: ");
    expect_error(s, qdot_system_decide(s, "T", &truth), QDOT_RESULT_SYNTAX, "decide:1:2: error: ");
    expect_error(s, qdot_system_number(s, "theta", &x, NULL), QDOT_RESULT_UNSET,
                 "number:1:1: error: ");
    expect_error(s, qdot_system_run(s, "0..1 tolerance 3", &m), QDOT_RESULT_SYNTAX,
                 "run:1:6: error: ");
    assert_null(m);
    assert_int_equal(qdot_system_number(s, "g/l", &x, NULL), QDOT_RESULT_OK);
    assert_string_equal(qdot_system_error(s), "");
    assert_true(x == 9.81);
    expect_error(s, qdot_system_declare(s, "undo"), QDOT_RESULT_INVALID, "declare:1:1: error: ");
}

/* A name that was declared in another cell of a notebook is found there. */
static void
errors_name_the_source_of_a_text(void **state)
{
    qdot_system *s = *state;
    char name[] = "In[3]", *answers;

    assert_int_equal(qdot_system_source(NULL, name), QDOT_RESULT_INVALID);
    assert_int_equal(qdot_system_source(s, name), QDOT_RESULT_OK);
    name[3] = '4'; /* it was copied */
    assert_int_equal(qdot_system_ask(s, "1\nparam fresh", QDOT_NOTATION_PLAIN, &answers), QDOT_RESULT_OK);
    qdot_string_free(answers);
    assert_int_equal(qdot_system_source(s, "In[7]"), QDOT_RESULT_OK);
    expect_error(s, qdot_system_ask(s, "\ncoord fresh", QDOT_NOTATION_PLAIN, &answers), QDOT_RESULT_NAME, "In[7]:2:7: error: ");
    qdot_string_free(answers);
    assert_non_null(strstr(qdot_system_error(s), "at In[3]:2\n"));
    assert_int_equal(qdot_system_source(s, NULL), QDOT_RESULT_OK);
    expect_error(s, qdot_system_ask(s, "coord fresh", QDOT_NOTATION_PLAIN, &answers), QDOT_RESULT_NAME, "ask:1:7: error: ");
    qdot_string_free(answers);
    assert_int_equal(qdot_system_declare(s, "undo"), QDOT_RESULT_INVALID);
}

/* energy along a motion made before the scene changed is not what it was. */
static void
a_changed_scene_is_noticed_along_a_motion(void **state)
{
    static const double one = 1;
    qdot_system *s = *state;
    qdot_motion *m;
    double x;

    assert_int_equal(qdot_system_run(s, "0..2", &m), QDOT_RESULT_OK);
    assert_int_equal(qdot_motion_values(m, "energy", 1, &one, 1, &x, NULL), QDOT_RESULT_OK);
    assert_string_equal(qdot_system_notices(s), "");
    assert_int_equal(qdot_system_declare(s, "potential theta^2"), QDOT_RESULT_OK);
    assert_int_equal(qdot_motion_values(m, "theta", 1, &one, 1, &x, NULL), QDOT_RESULT_OK);
    assert_string_equal(qdot_system_notices(s), "");
    assert_int_equal(qdot_motion_values(m, "energy", 1, &one, 1, &x, NULL), QDOT_RESULT_OK);
    assert_non_null(strstr(qdot_system_notices(s), "energy is that of the scene as it is now"));
    assert_int_equal(qdot_motion_over(m, QDOT_OVER_DRIFT, "energy", 0, 1, &x, NULL), QDOT_RESULT_OK);
    assert_non_null(strstr(qdot_system_notices(s), "energy is that of the scene as it is now"));
    qdot_motion_free(m);
}

static void
undo_reaches_back_over_calls_where_it_is_kept(void **state)
{
    static const double one = 1;
    qdot_system *s = *state;
    qdot_motion *m;
    double x;

    qdot_system_keep_undo(NULL, 1);
    qdot_system_keep_undo(s, 1);
    assert_int_equal(qdot_system_declare(s, "set g = 2"), QDOT_RESULT_OK);
    assert_int_equal(qdot_system_declare(s, "set g = 3; nonsense +"), QDOT_RESULT_SYNTAX);
    assert_int_equal(qdot_system_number(s, "g", &x, NULL), QDOT_RESULT_OK);
    assert_true(x == 3);
    assert_int_equal(qdot_system_declare(s, "undo"), QDOT_RESULT_OK);
    assert_int_equal(qdot_system_number(s, "g", &x, NULL), QDOT_RESULT_OK);
    assert_true(x == 2);
    assert_int_equal(qdot_system_declare(s, "redo; undo 2"), QDOT_RESULT_OK);
    assert_int_equal(qdot_system_number(s, "g", &x, NULL), QDOT_RESULT_OK);
    assert_true(x == 9.81);
    /* a run by its own call is none of the statements, and parts them */
    assert_int_equal(qdot_system_declare(s, "set g = 2"), QDOT_RESULT_OK);
    assert_int_equal(qdot_system_run(s, "0..1 as a", &m), QDOT_RESULT_OK);
    expect_error(s, qdot_system_declare(s, "undo"), QDOT_RESULT_INVALID, "declare:1:1: error: ");
    assert_int_equal(qdot_system_declare(s, "set g = 3"), QDOT_RESULT_OK);
    assert_int_equal(qdot_system_declare(s, "undo"), QDOT_RESULT_OK);
    assert_int_equal(qdot_motion_values(m, "theta", 1, &one, 1, &x, NULL), QDOT_RESULT_OK);
    qdot_motion_free(m);
    assert_int_equal(qdot_system_run(s, "0..1", &m), QDOT_RESULT_OK);
    assert_int_equal(qdot_system_declare(s, "run 0..1 as b"), QDOT_RESULT_OK);
    qdot_motion_free(m);
    expect_error(s, qdot_system_declare(s, "undo"), QDOT_RESULT_INVALID, "declare:1:1: error: ");
    qdot_system_keep_undo(s, 0);
    assert_int_equal(qdot_system_declare(s, "set g = 4"), QDOT_RESULT_OK);
    expect_error(s, qdot_system_declare(s, "undo"), QDOT_RESULT_INVALID, "declare:1:1: error: ");
}

static void
values_refuse_what_does_not_fit(void **state)
{
    static const double times[] = {0, 11};
    qdot_system *s = *state;
    qdot_motion *m;
    double x[4];
    size_t n;

    assert_int_equal(qdot_system_run(s, "0..10", &m), QDOT_RESULT_OK);
    assert_ptr_equal(qdot_motion_system(m), s);
    expect_error(s, qdot_motion_values(m, "theta", 2, times, 1, x, NULL), QDOT_RESULT_DOMAIN,
                 "values:1:1: error: ");
    expect_error(s, qdot_motion_values(m, "theta", 1, times, 2, x, NULL), QDOT_RESULT_TYPE,
                 "values:1:1: error: the expression has 1 components, not 2");
    expect_error(s, qdot_motion_values(m, "phi", 1, times, 1, x, NULL), QDOT_RESULT_NAME,
                 "values:1:1: error: ");
    expect_error(s, qdot_motion_end(m, 2, x, x), QDOT_RESULT_INVALID, "end: ");
    assert_int_equal(qdot_system_declare(s, "reset"), QDOT_RESULT_OK);
    expect_error(s, qdot_motion_values(m, "1", 1, times, 1, x, NULL), QDOT_RESULT_NAME,
                 "the run `run1` is no longer in the system");
    assert_int_equal(qdot_motion_end(m, 1, x, NULL), QDOT_RESULT_OK);
    assert_string_equal(qdot_system_error(s), "");
    assert_string_equal(qdot_motion_coordinate(m, 0), "theta");
    expect_error(s, qdot_motion_events(m, &n), QDOT_RESULT_NAME, "the run `run1` is");
    qdot_motion_free(m);
}

static void
null_is_refused(void **state)
{
    qdot_system *s = *state;
    qdot_motion *m;
    char *text;
    double x;
    qdot_truth truth;

    assert_int_equal(qdot_system_new(NULL), QDOT_RESULT_INVALID);
    assert_int_equal(qdot_system_declare(NULL, ""), QDOT_RESULT_INVALID);
    assert_int_equal(qdot_system_run(NULL, "0..1", &m), QDOT_RESULT_INVALID);
    assert_int_equal(qdot_motion_values(NULL, "1", 0, NULL, 1, NULL, NULL), QDOT_RESULT_INVALID);
    assert_string_equal(qdot_system_error(NULL), "");
    qdot_system_free(NULL);
    qdot_motion_free(NULL);
    qdot_string_free(NULL);
    expect_error(s, qdot_system_declare(s, NULL), QDOT_RESULT_INVALID, "declare: the text is NULL");
    expect_error(s, qdot_system_ask(s, "T", QDOT_NOTATION_PLAIN, NULL), QDOT_RESULT_INVALID, "ask: ");
    expect_error(s, qdot_system_ask(s, "T", (qdot_notation)9, &text), QDOT_RESULT_INVALID, "ask: ");
    expect_error(s, qdot_system_derive(s, "T", QDOT_NOTATION_JSON, &text), QDOT_RESULT_INVALID,
                 "derive: ");
    expect_error(s, qdot_system_decide(s, NULL, &truth), QDOT_RESULT_INVALID, "decide: ");
    expect_error(s, qdot_system_number(s, NULL, &x, NULL), QDOT_RESULT_INVALID, "number: ");
    expect_error(s, qdot_system_run(s, "0..1", NULL), QDOT_RESULT_INVALID, "run: ");
    assert_string_equal(qdot_result_text(QDOT_RESULT_INTERRUPTED), "interrupted");
    assert_string_equal(qdot_result_text((qdot_result)99), "unknown result");
}

/* A run that ends early is handed over; an unnamed run goes with its motion, a named one stays. */
static void
runs_live_as_long_as_said(void **state)
{
    qdot_system *s = *state;
    qdot_motion *m;
    qdot_motion_summary summary;
    char *text;
    double x;

    assert_int_equal(qdot_system_run(s, "0..1", &m), QDOT_RESULT_OK);
    qdot_motion_free(m);
    assert_int_not_equal(qdot_system_number(s, "max(theta, 0..1)", &x, NULL), QDOT_RESULT_OK);
    assert_int_equal(qdot_system_run(s, "0..1 as a", &m), QDOT_RESULT_OK);
    qdot_motion_free(m);
    assert_int_equal(qdot_system_number(s, "max(theta, 0..1)", &x, NULL), QDOT_RESULT_OK);
    assert_true(fabs(x - 2) < 1e-12);
    expect_error(s, qdot_system_derive(s, "max(theta, 0..1)", QDOT_NOTATION_PLAIN, &text), QDOT_RESULT_TYPE,
                 "derive:1:1: error: ");
    assert_int_equal(qdot_system_declare(s, "coord y; particle p mass 1 at (0, y)\n"
                                            "potential -y^4; start y = 1"),
                     QDOT_RESULT_OK);
    assert_int_equal(qdot_system_run(s, "0..10", &m), QDOT_RESULT_FAILED);
    assert_non_null(m);
    assert_int_equal(qdot_motion_summarize(m, &summary, sizeof summary), QDOT_RESULT_OK);
    assert_true(summary.end < 10 && summary.reason != NULL);
    qdot_motion_free(m);
}

static void
answers_and_notices_are_apart(void **state)
{
    qdot_system *s = *state, *fresh;
    qdot_motion *m;
    char *text;

    assert_int_equal(qdot_system_ask(s, "check 1 == 2\nT", QDOT_NOTATION_PLAIN, &text),
                     QDOT_RESULT_OK);
    assert_string_equal(text, "refuted: left = 1, right = 2\nT = 1/2*m*l^2*theta'^2\n");
    qdot_string_free(text);
    assert_int_equal(qdot_system_ask(s, "1 + 1; nonsense", QDOT_NOTATION_JSON, &text),
                     QDOT_RESULT_NAME);
    assert_non_null(strstr(text, "\"plain\":\"2\""));
    assert_non_null(strstr(text, "{\"kind\":\"error\""));
    qdot_string_free(text);
    assert_int_equal(qdot_system_new(&fresh), QDOT_RESULT_OK);
    assert_int_equal(qdot_system_declare(fresh, "coord x; particle p mass 1 at (x, 0)"),
                     QDOT_RESULT_OK);
    assert_string_equal(qdot_system_notices(fresh), "");
    assert_int_equal(qdot_system_ask(fresh, "x to \"test_api-answer.txt\"\nrun 0..1",
                                     QDOT_NOTATION_PLAIN, &text),
                     QDOT_RESULT_OK);
    (void)unlink("test_api-answer.txt");
    assert_int_equal(strncmp(text, "wrote test_api-answer.txt\nrun1: ", 32), 0);
    qdot_string_free(text);
    assert_int_equal(strncmp(qdot_system_notices(fresh), "notice: ", 8), 0); /* no start */
    assert_int_equal(qdot_system_run(fresh, "0..1", &m), QDOT_RESULT_OK);
    assert_string_equal(qdot_system_notices(fresh), ""); /* said once */
    qdot_system_free(fresh);
    assert_int_equal(qdot_motion_coordinates(m), 1); /* the motion keeps what it needs */
    qdot_motion_free(m);
}

static void
interrupted_work_says_so(void **state)
{
    qdot_system *s = *state;
    char *text;

    qdot_interrupt_set();
    assert_int_equal(qdot_system_derive(s, "eom", QDOT_NOTATION_PLAIN, &text),
                     QDOT_RESULT_INTERRUPTED);
    assert_int_equal(qdot_system_derive(s, "eom", QDOT_NOTATION_PLAIN, &text), QDOT_RESULT_OK);
    qdot_string_free(text);
}

/* Whatever allocation fails, the call says so and the system can be used again. */
static void
failing_memory_is_reported(void **state)
{
    static const double t[] = {0.5, 1, 0};
    int64_t n = 0;

    (void)state;
    for (bool done = false; !done; n += 1 + n / 50) {
        qdot_system *s = NULL;
        qdot_motion *m = NULL, *again = NULL;
        char *text = NULL;
        double x[3];
        qdot_result result;

        qdot_memory_fail_at(n);
        result = qdot_system_new(&s);
        if (result == QDOT_RESULT_OK)
            result = qdot_system_declare(s, pendulum);
        if (result == QDOT_RESULT_OK)
            result = qdot_system_derive(s, "eom", QDOT_NOTATION_PLAIN, &text);
        if (result == QDOT_RESULT_OK)
            result = qdot_system_run(s, "0..1", &m);
        if (result == QDOT_RESULT_OK)
            result = qdot_motion_values(m, "theta", 3, t, 1, x, NULL);
        if (result == QDOT_RESULT_OK)
            result = qdot_system_motion(s, NULL, &again);
        qdot_memory_fail_at(-1);
        done = result == QDOT_RESULT_OK;
        if (!done)
            assert_int_equal(result, QDOT_RESULT_NO_MEMORY);
        if (!done && s != NULL)
            assert_non_null(strstr(qdot_system_error(s), "memory"));
        if (s != NULL)
            assert_int_equal(qdot_system_declare(s, "param spare"), QDOT_RESULT_OK);
        qdot_string_free(text);
        qdot_motion_free(again);
        qdot_motion_free(m);
        qdot_system_free(s);
    }
    assert_true(n > 100);
}

static void *
swing(void *data)
{
    for (int i = 0; i < 20; i++) {
        qdot_system *s;
        qdot_motion *m;

        if (qdot_system_new(&s) != QDOT_RESULT_OK ||
            qdot_system_declare(s, pendulum) != QDOT_RESULT_OK ||
            qdot_system_run(s, "0..10", &m) != QDOT_RESULT_OK ||
            qdot_motion_end(m, 1, data, NULL) != QDOT_RESULT_OK)
            return NULL;
        qdot_motion_free(m);
        qdot_system_free(s);
    }
    return data;
}

static void
systems_of_two_threads_do_not_meet(void **state)
{
    pthread_t thread[2];
    double end[2] = {1, 2};
    void *done[2];

    (void)state;
    for (int i = 0; i < 2; i++)
        assert_int_equal(pthread_create(&thread[i], NULL, swing, &end[i]), 0);
    for (int i = 0; i < 2; i++)
        assert_int_equal(pthread_join(thread[i], &done[i]), 0);
    assert_true(done[0] != NULL && done[1] != NULL && end[0] == end[1]);
}

int
main(void)
{
#define IN_A_SCENE(test) cmocka_unit_test_setup_teardown(test, begin, end)
    const struct CMUnitTest tests[] = {
        IN_A_SCENE(formulas_come_in_every_notation),
        IN_A_SCENE(claims_are_proved_refuted_or_left_open),
        IN_A_SCENE(values_have_their_errors),
        IN_A_SCENE(extrema_and_conserved_quantities_are_known),
        IN_A_SCENE(times_are_given_in_any_order),
        IN_A_SCENE(a_range_that_is_no_range_is_refused),
        IN_A_SCENE(runs_of_statements_are_motions),
        IN_A_SCENE(events_are_listed),
        IN_A_SCENE(errors_name_the_place),
        IN_A_SCENE(values_refuse_what_does_not_fit),
        IN_A_SCENE(null_is_refused),
        IN_A_SCENE(runs_live_as_long_as_said),
        IN_A_SCENE(answers_and_notices_are_apart),
        IN_A_SCENE(interrupted_work_says_so),
        IN_A_SCENE(errors_name_the_source_of_a_text),
        IN_A_SCENE(a_changed_scene_is_noticed_along_a_motion),
        IN_A_SCENE(undo_reaches_back_over_calls_where_it_is_kept),
        cmocka_unit_test(failing_memory_is_reported),
        cmocka_unit_test(systems_of_two_threads_do_not_meet),
    };
#undef IN_A_SCENE

    return cmocka_run_group_tests(tests, NULL, NULL);
}
