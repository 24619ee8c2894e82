/* test_evaluate.c -- what words mean: primes, functions, sums, values of a scene. */
#include "expr/exact.h"
#include "expr/symbol.h"
#include "lang/language/compiled.h"
#include "lang/reading.h"
#include "lang/session/history.h"
#include "lang/session/runs.h"

static void
primes_are_time_derivatives(void **state)
{
    reading r;
    qdot_expr e;

    (void)state;
    reading_open(&r);
    assert_same(&r, "ddt(theta)", "theta'");
    assert_same(&r, "ddt(theta')", "theta''");
    assert_same(&r, "diff(theta'^2, theta')", "2*theta'");
    assert_same(&r, "ddt(q[1]*m)", "q[1]'*m");
    assert_int_equal(reading_value(&r, "theta^2", &e), QDOT_OK);
    declare(&r, QDOT_NAME_VALUE, "R", e);
    assert_same(&r, "R'", "2*theta*theta'");
    assert_same(&r, "R''", "2*theta*theta'' + 2*theta'^2");
    assert_int_equal(reading_value(&r, "(theta^2, m)", &e), QDOT_OK);
    declare(&r, QDOT_NAME_VALUE, "u", e);
    assert_same(&r, "u'", "(2*theta*theta', 0)");
    assert_same(&r, "u[1]'", "u'[1]");
    assert_int_equal(reading_value(&r, "theta", &e), QDOT_OK);
    declare(&r, QDOT_NAME_VALUE, "alias", e);
    assert_same(&r, "alias'", "theta'");
    assert_fails(&r, "m + t'", QDOT_ETYPE, 4, "`t`", "ddt(...)");
    reading_close(&r);
}

static void
undefined_functions_apply(void **state)
{
    reading r;

    (void)state;
    reading_open(&r);
    assert_same(&r, "x", "x(s)");
    assert_same(&r, "y", "y(s, t)");
    assert_same(&r, "x'(s)", "diff(x(s), s)");
    assert_same(&r, "x'", "diff(x, s)");
    assert_same(&r, "x''(s)", "diff(x(s), s, 2)");
    assert_same(&r, "x'(2*m)", "subs(diff(x(s), s), s = 2*m)");
    assert_same(&r, "diff(y(s, t), s, 1)", "diff(y, s)");
    assert_fails(&r, "y'(s, t)", QDOT_ETYPE, 0, "2 arguments", "diff(y");
    assert_fails(&r, "x(s, t)", QDOT_ETYPE, 0, "`x` takes 1 argument, not 2", "");
    assert_fails(&r, "x((1, 2))", QDOT_ETYPE, 0, "not of a vector", "");
    reading_close(&r);
}

/* f(u) = u^2/2 + m, evaluated with its formal. */
static void
user_functions_replace_their_formals(void **state)
{
    static const char text[] = "f(u) = u^2/2 + m; D(u) = diff(u, theta)";
    reading r;

    (void)state;
    reading_open(&r);
    assert_int_equal(qdot_script_run_text(r.session, "a", text, sizeof text - 1), 0);
    assert_same(&r, "f(3)", "9/2 + m");
    assert_same(&r, "f(f(2))", "(2 + m)^2/2 + m");
    assert_same(&r, "f'(theta)", "theta");
    assert_same(&r, "f((1, 2))", "(1/2 + m, 2 + m)");
    assert_same(&r, "D(theta^2)", "2*theta");
    assert_fails(&r, "D'(theta)", QDOT_ETYPE, 0, "no function of a number alone", "diff(D(");
    assert_fails(&r, "f(1, 2)", QDOT_ETYPE, 0, "`f` takes 1 argument, not 2", "");
    assert_fails(&r, "f", QDOT_ETYPE, 0, "`f` is a function", "f(...)");
    reading_close(&r);
}

static void
sums_bind_their_index(void **state)
{
    reading r;

    (void)state;
    reading_open(&r);
    assert_same(&r, "sum(k^2, k, 1, 3)", "14");
    assert_same(&r, "sum(k, k, 3, 1)", "0");
    assert_same(&r, "sum(m^k, k, -1, 1)", "1/m + 1 + m");
    assert_same(&r, "sum(q[k]', k, 1, 2)", "q[1]' + q[2]'");
    assert_same(&r, "sum(sum(j*k, j, 1, k), k, 1, 3)", "1 + 2*3 + 3*6");
    assert_same(&r, "sum((k, m), k, 1, 2)", "(3, 2*m)");
    assert_same(&r, "sum(m, m, 1, 2)", "3"); /* the index hides the parameter */
    assert_same(&r, "2*sum(k, k, 1, 2) + m", "6 + m");
    assert_fails(&r, "sum(q[k], k, 1, 3)", QDOT_ENAME, 4, "`q[3]`", "");
    assert_fails(&r, "sum(k, k, 1, 3/2)", QDOT_ETYPE, 0, "", "");
    assert_fails(&r, "k", QDOT_ENAME, 0, "unknown name", ""); /* unbound again */
    reading_close(&r);
}

static void
choices_look_only_where_they_must(void **state)
{
    reading r;

    (void)state;
    reading_open(&r);
    assert_same(&r, "if(1 < 2, m, 1/0)", "m");
    assert_same(&r, "if(2 < 1, nonsense, g)", "g");
    assert_same(&r, "sum(if(k = 2, m, k), k, 1, 3)", "4 + m");
    assert_same(&r, "if(not (1 = 1) or 3 > 2, 5, 6)", "5");
    assert_same(&r, "if(m < g, (1, 2), (3, 4))[2]", "if(m < g, 2, 4)");
    assert_same(&r, "subs(if(m < 1, 2, 3), m = 0)", "2");
    reading_close(&r);
}

static void
functions_map_over_what_holds_numbers(void **state)
{
    reading r;

    (void)state;
    reading_open(&r);
    assert_same(&r, "sin([m, g])", "[sin(m), sin(g)]");
    assert_same(&r, "sqrt((4, 9))", "(2, 3)");
    assert_same(&r, "diff((m^2, m*g), m)", "(2*m, g)");
    assert_same(&r, "expand((m + 1)^2 = (g + 1)^2)", "m^2 + 2*m + 1 = g^2 + 2*g + 1");
    assert_same(&r, "max([1, 3, 2])", "3");
    assert_same(&r, "min(3, 2)", "2");
    assert_same(&r, "lhs(m = g) - rhs(m = g)", "residual(m = g)");
    assert_same(&r, "rhs([m = g, s = 2])", "[g, 2]");
    assert_same(&r, "subs(m*g, m = g, g = m)", "m*g");
    assert_same(&r, "subs(m + g, [m = 1, g = 2])", "3");
    assert_same(&r, "subs(m + g, (m, g) = (1, 2))", "3");
    assert_same(&r, "size(m*g + 1)", "2");
    assert_same(&r, "dot((1, 2), (3, 4)) + cross((1, 0), (0, 1)) + norm((3, 4))", "17");
    assert_same(&r, "det([1, 2; 3, 4]) + trace([1, 2; 3, 4])", "3");
    assert_same(&r, "transpose([1, 2; 3, 4])[1, 2]", "3");
    assert_fails(&r, "subs(m, g)", QDOT_ETYPE, 0, "equations, not a number", "x = a");
    assert_fails(&r, "subs(m, 2 = g)", QDOT_ETYPE, 0, "replace a number", "");
    assert_fails(&r, "lhs(m)", QDOT_ETYPE, 0, "takes an equation, not a number", "");
    assert_fails(&r, "diff(m, 2)", QDOT_ETYPE, 0, "takes a symbol", "");
    assert_fails(&r, "atan2((1, 2), 1)", QDOT_ETYPE, 0, "not a vector", "");
    assert_fails(&r, "m[1]", QDOT_ETYPE, 0, "no entries", "");
    assert_fails(&r, "(1, 2)[3]", QDOT_EDOMAIN, 6, "", "");
    assert_fails(&r, "[1, 2; 3, 4][1]", QDOT_ETYPE, 12, "two indices", "its row, then its column");
    reading_close(&r);
}

static void
reserved_names_mean_themselves(void **state)
{
    reading r;

    (void)state;
    reading_open(&r);
    assert_same(&r, "sin(pi/6)", "1/2");
    assert_same(&r, "diff(t^2, t)", "2*t");
    assert_same(&r, "dq[1]", "dq[3 - 2]");
    assert_string_equal(reading_plain(&r, "dtheta"), "dtheta");
    assert_string_equal(reading_plain(&r, "dt"), "dt");
    assert_same(&r, "δθ", "delta[theta]");
    assert_fails(&r, "dm", QDOT_ENAME, 0, "unknown name `dm`", "");
    assert_fails(&r, "p", QDOT_ENAME, 0, "unknown name `p`", "write p[theta]");
    reading_close(&r);
}

static void
history_is_counted(void **state)
{
    reading r;

    (void)state;
    reading_open(&r);
    assert_fails(&r, "%", QDOT_EINVAL, 0, "no value yet", "");
    assert_int_equal(
        qdot_vec_push(&r.session->history->values, qdot_expr_int(r.session->pool, 5)), QDOT_OK);
    assert_int_equal(
        qdot_vec_push(&r.session->history->values, qdot_expr_int(r.session->pool, 7)), QDOT_OK);
    assert_same(&r, "%", "7");
    assert_same(&r, "%1*%", "35");
    assert_fails(&r, "%3", QDOT_EINVAL, 0, "only 2", "");
    reading_close(&r);
}

/* A bob of mass m on a straight wire of slope g/s, and one free in the plane. */
static void
two_bobs(reading *r)
{
    qdot_expr m, at;

    reading_open(r);
    m = qdot_symbol_get(r->session->pool, QDOT_PARAM, "m");
    assert_int_equal(reading_value(r, "(s*theta, g*theta)", &at), QDOT_OK);
    assert_int_equal(qdot_scene_particle(r->session->scene, "bob", m, at), QDOT_OK);
    assert_int_equal(reading_value(r, "(q[1], q[2])", &at), QDOT_OK);
    assert_int_equal(qdot_scene_particle(r->session->scene, "b[2]", m, at), QDOT_OK);
}

static void
labels_are_positions(void **state)
{
    reading r;

    (void)state;
    two_bobs(&r);
    assert_same(&r, "bob", "(s*theta, g*theta)");
    assert_same(&r, "bob'", "ddt(bob)");
    assert_same(&r, "bob[2]", "g*theta");
    assert_same(&r, "b[1 + 1]", "(q[1], q[2])");
    assert_same(&r, "b[2]'", "(q[1]', q[2]')");
    assert_same(&r, "norm(b[2] - bob)^2", "(q[1] - s*theta)^2 + (q[2] - g*theta)^2");
    assert_same(&r, "point(bob)", "bob");
    assert_fails(&r, "spin(bob)", QDOT_ETYPE, 0, "is a particle", "");
    assert_fails(&r, "spin(bab)", QDOT_ENAME, 0, "no body `bab`", "`bob`");
    assert_fails(&r, "point(bob, (1, 2))", QDOT_ETYPE, 0, "", "");
    assert_fails(&r, "lambda[rod]", QDOT_ENAME, 0, "no constraint `rod`", "");
    /* a name of another kind goes first */
    declare_param(&r, "bob");
    assert_fails(&r, "bob'", QDOT_ETYPE, 0, "parameter", "");
    reading_close(&r);
}

static void
multipliers_are_found_by_label(void **state)
{
    reading r;
    qdot_expr a, b;

    (void)state;
    two_bobs(&r);
    assert_int_equal(reading_value(&r, "b[2]", &a), QDOT_OK);
    assert_int_equal(reading_value(&r, "bob", &b), QDOT_OK);
    assert_int_equal(qdot_scene_constraint(r.session->scene, "pin", a, b), QDOT_OK);
    assert_int_equal(reading_value(&r, "q[1]", &a), QDOT_OK);
    assert_int_equal(qdot_scene_constraint(r.session->scene, "rod", a, QDOT_ONE),
                     QDOT_OK);
    assert_string_equal(reading_plain(&r, "lambda[rod]"), "lambda[rod]");
    assert_string_equal(reading_plain(&r, "2*lambda[pin, 2]"), "2*lambda[pin, 2]");
    assert_same(&r, "λ[rod]", "lambda[rod]");
    assert_fails(&r, "lambda[pin]", QDOT_ENAME, 0, "each component", "lambda[pin, 1]");
    assert_fails(&r, "lambda[pin, 3]", QDOT_ENAME, 0, "has 2 components", "");
    reading_close(&r);
}

static void
values_of_the_scene_are_words(void **state)
{
    reading r;

    (void)state;
    reading_open(&r);
    assert_fails(&r, "1 + T", QDOT_EINVAL, 4, "nothing that moves", "particle");
    assert_fails(&r, "eom[theta]", QDOT_EINVAL, 0, "nothing that moves", "");
    reading_close(&r);

    two_bobs(&r);
    assert_same(&r, "expand(T)",
                "expand(m*(s^2 + g^2)*theta'^2/2 + m*q[1]'^2/2 + m*q[2]'^2/2)");
    assert_same(&r, "T", "kinetic");
    assert_same(&r, "p[theta]", "momenta[theta]");
    assert_same(&r, "expand(p[theta])", "expand(m*(s^2 + g^2)*theta')");
    assert_same(&r, "mass_matrix[theta, theta]", "mass_matrix[1, 1]");
    assert_same(&r, "expand(mass_matrix[q[1], q[1]])", "m");
    assert_same(&r, "expand(metric(bob)[theta, theta])", "s^2 + g^2");
    assert_same(&r, "metric((q[1], q[2]))[q[1], q[2]]", "0");
    assert_fails(&r, "metric(bob)[q[1], q[1]]", QDOT_ETYPE, 11, "none of its coordinates",
                 "");
    assert_fails(&r, "eom[m]", QDOT_ETYPE, 0, "", "");
    /* a plain p beside p[theta] */
    declare_param(&r, "p");
    assert_same(&r, "expand(p*p[theta])", "expand(p*m*(s^2 + g^2)*theta')");
    /* the user's own T */
    declare_param(&r, "T");
    assert_string_equal(reading_plain(&r, "T"), "T");
    reading_close(&r);
}

/* The next expression, and the run along which it is. */
static qdot_status
member_read(qdot_cursor *c, qdot_expr *value, const char **run)
{
    qdot_compiled program;
    qdot_status status = qdot_compiled_parse(c, QDOT_PARSE_SIDE, &program);

    *run = NULL;
    if (status == QDOT_OK)
        status = qdot_compiled_member(c, &program, value, run);
    qdot_compiled_free(&program);
    return status;
}

/* Step over the end of the statement. */
static void
statement_end_pass(qdot_cursor *c)
{
    while (!qdot_cursor_is_end(c))
        c->at++;
    c->at++;
}

static void
members_of_runs_are_kept_apart(void **state)
{
    reading r;
    qdot_source *source;
    qdot_cursor c;
    qdot_expr e;
    const char *run;
    size_t at;
    static const char text[] = "a.theta'; a.(theta + m)[1]; a.(q[1])*2; m";

    (void)state;
    reading_open(&r);
    assert_fails(&r, "a.theta", QDOT_ENAME, 0, "no run `a`", "");
    qdot_named_run a = {.name = (char *)"a"};

    assert_int_equal(qdot_vec_push(r.session->runs, a), QDOT_OK);
    assert_int_equal(qdot_source_new("a", text, sizeof text - 1, &source, &at), QDOT_OK);
    c = (qdot_cursor){.session = r.session, .source = source, .at = source->tokens.at};
    assert_int_equal(member_read(&c, &e, &run), QDOT_OK);
    assert_string_equal(run, "a");
    assert_string_equal(qdot_expr_symbol(r.session->pool, e)->name, "theta'");
    c.at++;
    assert_int_not_equal(member_read(&c, &e, &run), QDOT_OK);
    statement_end_pass(&c);
    /* in a product it is a symbol: of no one run */
    assert_int_equal(member_read(&c, &e, &run), QDOT_OK);
    assert_null(run);
    statement_end_pass(&c);
    assert_int_equal(member_read(&c, &e, &run), QDOT_OK);
    assert_null(run);
    qdot_source_free(source);
    qdot_free(r.session->runs->at);
    memset(r.session->runs, 0, sizeof *r.session->runs);
    reading_close(&r);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(primes_are_time_derivatives),
        cmocka_unit_test(undefined_functions_apply),
        cmocka_unit_test(user_functions_replace_their_formals),
        cmocka_unit_test(sums_bind_their_index),
        cmocka_unit_test(choices_look_only_where_they_must),
        cmocka_unit_test(functions_map_over_what_holds_numbers),
        cmocka_unit_test(reserved_names_mean_themselves),
        cmocka_unit_test(history_is_counted),
        cmocka_unit_test(labels_are_positions),
        cmocka_unit_test(multipliers_are_found_by_label),
        cmocka_unit_test(values_of_the_scene_are_words),
        cmocka_unit_test(members_of_runs_are_kept_apart),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
