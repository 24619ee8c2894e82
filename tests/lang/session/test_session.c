/* test_session.c -- a conversation: what is said, what is answered, what is left after
 * a failure. */
#include "expr/build.h"
#include "expr/exact.h"
#include "expr/symbol.h"
#include "lang/session/evaluation.h"
#include "lang/session/measured.h"
#include "lang/session/names.h"
#include "lang/session/output.h"
#include "lang/session/values.h"
#include "lang/talk.h"
#include "mech/scene/things.h"

#include <math.h>

#include "base/interrupt.h"
#include "base/memory.h"
#include "lang/session/bind.h"

static void
exit_status_tells_syntax_from_failure(void **state)
{
    talk *k = *state;

    assert_int_equal(say(k, "a = 2; a + 1"), 0);
    assert_string_equal(heard(k), "a + 1 = 3\n");
    assert_int_equal(say(k, "b + 1"), 1);
    assert_non_null(strstr(complaint(k), "test:1:1: error: unknown name `b`"));
    assert_int_equal(say(k, "a +"), 2);
    assert_int_equal(say(k, "a"), 0);
}

static void
a_refuted_check_is_remembered(void **state)
{
    talk *k = *state;

    assert_int_equal(say(k, "check 2 == 2"), 0);
    assert_int_equal(say(k, "check not 2 == 3"), 0);
    assert_int_equal(say(k, "check 2 == 3"), 1);
    assert_int_equal(say(k, "1"), 1);
    assert_int_equal(say(k, "check not 2 == 2"), 1);
}

static void
the_first_error_stops_a_text(void **state)
{
    talk *k = *state;

    assert_int_equal(say(k, "a = 1\nb = c\na = 2"), 1);
    assert_non_null(strstr(complaint(k), "test:2:5:"));
    say(k, "a");
    assert_string_equal(heard(k), "a = 1\n");
}

static size_t
declared(const talk *k)
{
    size_t n = 0;

    while (qdot_names_at(k->session->names, n) != NULL)
        n++;
    return n;
}

static void
a_failed_statement_declares_nothing(void **state)
{
    static const char *const wrong[] = {
        "param u, v, x",      "coord y, x",
        "param u > 0 = -1",   "coord u, u",
        "param u = w",        "function f(s), x(s)",
        "u = nothing",        "param u, v oops",
        "set m = 2, x = 1",   "particle p mass m at (x, q)",
        "start x = 1, m = 2", "f(u) = u + ",
    };
    talk *k = *state;
    size_t names;

    assert_int_equal(say(k, "param m; coord x"), 0);
    names = declared(k);
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        assert_int_not_equal(say(k, wrong[i]), 0);
        assert_int_equal(declared(k), names);
        assert_int_equal(k->session->scene->coordinates.n, 1);
        assert_int_equal(k->session->scene->particles.n, 0);
        assert_int_equal(k->session->values->set_symbols.n, 0);
        assert_int_equal(k->session->values->start_symbols.n, 0);
        assert_null(qdot_names_find(k->session->names, "k"));
    }
}

static void
a_loop_that_fails_leaves_no_index(void **state)
{
    talk *k = *state;

    assert_int_equal(say(k, "{ { print i/(j - 2) } for j = 1..3 } for i = 1..2"), 1);
    assert_non_null(strstr(complaint(k), "in the pass with"));
    assert_null(qdot_names_find(k->session->names, "i"));
    assert_null(qdot_names_find(k->session->names, "j"));
    assert_int_equal(k->session->evaluation->loops, 0);
    assert_int_equal(say(k, "reset"), 0);
}

static void
json_is_one_object_a_line(void **state)
{
    talk *k = *state;

    k->session->output->json = true;
    say(k, "param m > 0; coord x\nparticle p mass m at x\nT");
    assert_non_null(strstr(heard(k),
                           "{\"kind\":\"expr\",\"name\":\"T\",\"plain\":\"1/2*m*x'^2\","
                           "\"latex\":\"\\\\frac{1}{2} m \\\\dot{x}^{2}\",\"ops\":"));
    say(k, "check T == 0");
    assert_non_null(strstr(heard(k), "\"verdict\":\"refuted\""));
    say(k, "print \"a\\\"b\"");
    assert_non_null(strstr(heard(k), "{\"kind\":\"text\",\"name\":\"print\",\"text\":\"a\\\"b\",\"statement\":"));
    say(k, "thing");
    assert_non_null(strstr(heard(k),
                           "{\"kind\":\"error\",\"file\":\"test\",\"line\":1,\"column\":1,"
                           "\"message\":\"unknown name `thing`\",\"hint\":"
                           "\"`param thing` declares a parameter, `coord thing` a coordinate\",\"statement\":"));
    assert_non_null(strstr(complaint(k), "unknown name `thing`"));
}

static void
values_are_bound_through_one_another(void **state)
{
    talk *k = *state;
    qdot_expr a, bound;
    double x;

    say(k, "param a, b, c; set a = b + 1, b = 2*c, c = 3/4");
    a = qdot_names_find(k->session->names, "a")->value;
    bound = qdot_session_bind(k->session, a);
    assert_int_equal(bound, qdot_expr_ratio(k->session->pool, 5, 2));
    assert_int_equal(qdot_session_number(k->session, a, &x, NULL), QDOT_OK);
    assert_true(x == 2.5);
    say(k, "set c = a");
    assert_int_equal(qdot_session_bind(k->session, a), QDOT_NIL);
    assert_int_equal(qdot_pool_check(k->session->pool), QDOT_EINVAL);
}

static void
a_function_gets_its_value_with_its_derivatives(void **state)
{
    talk *k = *state;
    qdot_expr e;
    double x;

    say(k, "coord s; function f(s, t); set f(u, v) = sin(2*u)*v; e = diff(f(3, 5), t) + "
           "subs(diff(f(s, t), s), s = 1, t = 7)");
    e = qdot_names_find(k->session->names, "e")->value;
    assert_int_equal(qdot_session_number(k->session, e, &x, NULL), QDOT_OK);
    /* f(3, 5) does not hold t; D1 f (1, 7) = 2 cos(2) 7 */
    assert_true(fabs(x - 14 * cos(2)) < 1e-14);
}

static void
errors_of_measured_numbers_add_up(void **state)
{
    talk *k = *state;
    qdot_pool *pool = k->session->pool;
    qdot_measured a = {.symbol = qdot_symbol_get(pool, QDOT_FORMAL, "#a"),
                       .value = 3,
                       .error = 1e-6};
    qdot_measured b = {.symbol = qdot_symbol_get(pool, QDOT_FORMAL, "#b"),
                       .value = 4,
                       .error = 1e-7};
    double x, error;

    assert_int_equal(qdot_vec_push(k->session->measured, a), QDOT_OK);
    assert_int_equal(qdot_vec_push(k->session->measured, b), QDOT_OK);
    /* d(a^2 b) = 2 a b da + a^2 db */
    assert_int_equal(
        qdot_session_number(k->session,
                            qdot_mul(pool, qdot_pow_int(pool, a.symbol, 2), b.symbol), &x,
                            &error),
        QDOT_OK);
    assert_true(fabs(x - 36) < 1e-14);
    assert_true(fabs(error - (24e-6 + 9e-7)) < 1e-12);
}

static void
reset_scene_begins_coordinates_anew(void **state)
{
    talk *k = *state;

    say(k, "param m > 0 = 2; coord r > 0; h = 3*m; R = (r, 1)\nsqrt(r^2)");
    assert_string_equal(heard(k), "sqrt(r^2) = r\n");
    assert_int_equal(say(k, "reset scene; R"), 1);
    complaint(k);
    say(k, "coord r; sqrt(r^2); sqrt(m^2); h");
    assert_string_equal(heard(k), "sqrt(r^2) = abs(r)\nsqrt(m^2) = m\nh = 3*m\n");
    assert_int_equal(k->session->values->set_symbols.n, 1);
    say(k, "reset; vars");
    assert_string_equal(heard(k), "nothing is declared\n");
}

static void
an_open_bracket_goes_on(void **state)
{
    static const struct {
        const char *text;
        bool incomplete;
    } cases[] = {
        {"a = (1 +", true},
        {"a = (1 + 2)", false},
        {"{ a = 1", true},
        {"a = 1 \\", true},
        {"a = 1 # (", false},
        {"print \"(\"", false},
        {"a = [1, 2", true},
        {"", false},
        {"a)", false},
        {"a = 1 \\\n", true},
        {"print \"\\\"(\"", false},
    };

    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        assert_int_equal(qdot_script_is_incomplete(cases[i].text, strlen(cases[i].text)),
                         cases[i].incomplete);
}

static void
an_interrupt_ends_a_statement_and_no_more(void **state)
{
    talk *k = *state;

    say(k, "a = 5");
    qdot_interrupt_set();
    assert_int_equal(say(k, "print i for i = 1..1000000000"), 1);
    assert_non_null(strstr(complaint(k), "interrupted"));
    assert_int_equal(say(k, "a"), 0);
    assert_string_equal(heard(k), "a = 5\n");
}

static void
a_directory_or_nothing_is_no_script(void **state)
{
    talk *k = *state;

    assert_int_equal(qdot_script_run_file(k->session, "."), 1);
    assert_non_null(strstr(complaint(k), "is a directory"));
    assert_int_equal(qdot_script_run_file(k->session, "no such file"), 1);
    assert_non_null(strstr(complaint(k), "cannot be opened"));
}

/* Every allocation of a conversation fails once, alone and for good: no crash, no
 * leak. */
static void
no_memory_is_an_error_everywhere(void **state)
{
    static const char text[] =
        "param m, g > 0, c = 2\ncoord x, y\nfunction f(t)\nR = (x, y + f(t))\n"
        "particle p mass m at R\ngravity (0, -g)\nspring s between p, (0, 0) stiffness "
        "c\n"
        "A[k] = k^2 for k = 1..2\n{ print A[k] } for k = 1..2\nT\ncheck A[2] == 4\n"
        "set m = 1, f(u) = u\nstart x = 1\nscene\nvars\nreset scene";
    char *buffer = NULL;
    size_t size = 0;
    FILE *sink = open_memstream(&buffer, &size);
    int64_t n = 0;

    (void)state;
    for (int last = 1; last != 0; n += 1 + n / 40) {
        qdot_session *s;

        qdot_memory_fail_at(n);
        s = qdot_session_new(sink, sink);
        last = s == NULL ? 1 : qdot_script_run_text(s, "test", text, strlen(text));
        qdot_memory_fail_at(-1);
        qdot_session_free(s);
        assert_true(n < 10000000);
    }
    assert_true(n > 100);
    fclose(sink);
    free(buffer);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, begin, end)

/* `reset` gives back what was derived: the nodes are a new pool's. */
static void
reset_gives_memory_back(void **state)
{
    static const char chain[] =
        "N = 30\n"
        "param m[k], l[k] > 0 for k = 1..N\n"
        "coord theta[k] for k = 1..N\n"
        "r[1] = l[1]*(sin(theta[1]), -cos(theta[1]))\n"
        "r[k] = r[k-1] + l[k]*(sin(theta[k]), -cos(theta[k])) for k = 2..N\n"
        "particle bob[k] mass m[k] at r[k] for k = 1..N\n"
        "mass_matrix; eom\n";
    talk *k = *state;
    size_t empty = qdot_pool_bytes(k->session->pool), nodes = qdot_pool_count(k->session->pool);

    assert_int_equal(say(k, chain), 0);
    assert_true(qdot_pool_bytes(k->session->pool) > 10 * empty);
    assert_true(qdot_pool_bytes(k->session->pool) < 5000000);
    assert_int_equal(say(k, "reset"), 0);
    assert_int_equal(qdot_pool_bytes(k->session->pool), empty);
    assert_int_equal(qdot_pool_count(k->session->pool), nodes);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(exit_status_tells_syntax_from_failure),
        TEST(a_refuted_check_is_remembered),
        TEST(the_first_error_stops_a_text),
        TEST(a_failed_statement_declares_nothing),
        TEST(a_loop_that_fails_leaves_no_index),
        TEST(json_is_one_object_a_line),
        TEST(values_are_bound_through_one_another),
        TEST(a_function_gets_its_value_with_its_derivatives),
        TEST(errors_of_measured_numbers_add_up),
        TEST(reset_scene_begins_coordinates_anew),
        TEST(an_open_bracket_goes_on),
        TEST(an_interrupt_ends_a_statement_and_no_more),
        TEST(a_directory_or_nothing_is_no_script),
        cmocka_unit_test(no_memory_is_an_error_everywhere),
        TEST(reset_gives_memory_back),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
