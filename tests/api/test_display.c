/* test_display.c -- answers for a program that shows them: objects with figures and pages in them, no files. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/memory.h"
#include "qdot.h"

static const char scene[] = "coord theta\n"
                            "particle bob mass 1 at (sin(theta), -cos(theta))\n"
                            "gravity (0, -9.81)\n"
                            "start theta = 2\n"
                            "run 0..10\n";

static int
begin(void **state)
{
    qdot_system *s;

    if (qdot_system_new(&s) != QDOT_RESULT_OK)
        return 1;
    *state = s;
    return qdot_system_declare(s, scene) != QDOT_RESULT_OK;
}

static int
end(void **state)
{
    qdot_system_free(*state);
    return 0;
}

/* The objects with which the system answers, one a line; the caller's. */
static char *
display(qdot_system *s, const char *text, qdot_result wanted)
{
    char *answers;

    assert_int_equal(qdot_system_ask(s, text, QDOT_NOTATION_DISPLAY, &answers), wanted);
    assert_non_null(answers);
    assert_string_equal(qdot_system_notices(s), "");
    return answers;
}

static size_t
count(const char *text, const char *part)
{
    size_t n = 0;

    for (; (text = strstr(text, part)) != NULL; text++)
        n++;
    return n;
}

/* The place of the part in the text, which has it. */
static const char *
find(const char *text, const char *part)
{
    const char *at = strstr(text, part);

    if (at == NULL)
        fail_msg("no `%s` in `%.300s`", part, text);
    return at;
}

static bool
has_gnuplot(void)
{
    return system("gnuplot --version >/dev/null 2>&1") == 0;
}

static void
formulas_are_typeset(void **state)
{
    char *text = display(*state, "T", QDOT_RESULT_OK);

    find(text, "{\"kind\":\"expr\",\"name\":\"T\",\"plain\":\"1/2*theta'^2\",\"latex\":\"\\\\frac{1}{2} \\\\dot{\\\\theta}^{2}\"");
    find(text, ",\"mathml\":\"<mfrac>");
    find(text, ",\"text\":\"T = ½ θ̇²\",\"html\":\"<math xmlns=");
    find(text, ",\"typeset\":{\"latex\":\"T = \\\\frac{1}{2}");
    find(find(text, ",\"mathml\":\"<math xmlns"), ",\"unicode\":\"T = ½ θ̇²\"}");
    find(text, ",\"statement\":6,\"line\":1}\n");
    qdot_string_free(text);
}

/* Lines of text with formulas in them come as the part of a page, too, the same that goes to a file. */
static void
texts_are_typeset(void **state)
{
    char *text = display(*state, "derive; print \"T is\", T; help run; derive to \"test_display-d.html\"", QDOT_RESULT_OK);
    char *page = calloc(1, 100000);
    FILE *file = fopen("test_display-d.html", "r");
    const char *at = find(text, "{\"kind\":\"text\",\"name\":\"derive\",\"text\":\"1. Positions: r(q, t)\\u000a    r[bob] = ");

    find(at, ",\"html\":\"<h2>1. Positions: <math xmlns=");
    find(at, "<msub><mrow><mi>r</mi></mrow><mrow><mtext>bob</mtext></mrow></msub></mtd><mtd class=");
    at = find(at, "\"name\":\"print\",\"text\":\"T is ½ θ̇²\",\"html\":\"<p>T is <math");
    at = find(at, "\"name\":\"help\",\"text\":\"run ");
    find(at, ",\"html\":\"<pre class=\\\"text\\\">run T0..T1 [");
    assert_non_null(file);
    assert_true(fread(page, 1, 99999, file) > 1000);
    fclose(file);
    (void)unlink("test_display-d.html");
    find(page, "<msub><mrow><mi>r</mi></mrow><mrow><mtext>bob</mtext></mrow></msub></mtd><mtd class=");
    free(page);
    qdot_string_free(text);
}

/* Numbers have only the digits that their errors leave, powers of ten drawn, units upright. */
static void
numbers_are_typeset(void **state)
{
    qdot_system *s = *state;
    char *text = display(s, "value(theta, 5); [value(theta, 0), value(theta', 5)]; run 0..1 digits 30; value(theta, 1)", QDOT_RESULT_OK);
    const char *at = find(text, "\"text\":\"value(θ, 5) = 1.49");

    at = find(find(at, " ± "), "\"latex\":\"\\\\operatorname{value}\\\\left(\\\\theta, 5\\\\right) = 1.49");
    at = find(at, " \\\\pm ");
    at = find(find(at, " \\\\cdot 10^{-"), "<mo>⋅</mo><msup><mrow><mn>10</mn></mrow><mrow><mo>−</mo><mn>1");
    at = find(at, "\"kind\":\"numbers\"");
    at = find(at, "\"text\":\"[value(θ, 0), value(θ̇, 5)] = 2");
    at = find(at, "\"value\":\"");
    find(find(at, "\"text\":\"value(θ, 1) = "), " ± ");
    find(find(at, " \\\\pm "), " \\\\cdot 10^{-");
    qdot_string_free(text);
}

/* Units are upright in LaTeX; `units` answers with rows of a table. */
static void
units_are_typeset(void **state)
{
    const char *at;
    qdot_system *s;
    char *text;

    (void)state;
    assert_int_equal(qdot_system_new(&s), QDOT_RESULT_OK);
    text = display(s, "param c = 2 [m/s^2], k [N*m]; c; k^2; units", QDOT_RESULT_OK);
    at = find(text, "\"text\":\"c [m/s^2]\"");
    at = find(at, "\"latex\":\"c\\\\ [\\\\mathrm{m/s^{2}}]\"");
    at = find(at, "\"text\":\"k² [");
    find(at, "\"cells\":[\"c\",\"an acceleration\",\"m/s^2\"]");
    qdot_string_free(text);
    text = display(s, "coord s [m]; particle p mass 1 [kg] at (s, 0); potential 2 [N/m]*s^2; modes", QDOT_RESULT_OK);
    find(text, "\"text\":\"modes[1] = 2 [1/s]\"");
    qdot_string_free(text);
    qdot_system_free(s);
}

/* A check has the colour of what was wanted: with `not` that is a refutation. */
static void
checks_are_worded(void **state)
{
    char *text = display(*state, "check T == theta'^2/2; check theta == 2; check not theta == 2; check conserved (T + V)^2", QDOT_RESULT_OK);
    const char *at = find(text, "\"text\":\"proved\",\"html\":\"<div class=\\\"check holds\\\"><p>✓ proved</p>");

    find(at, "<code>T == theta'^2/2</code></div>");
    at = find(at, "\"text\":\"refuted at θ = 1: left = 1, right = 2\",\"html\":\"<div class=\\\"check fails\\\"><p>✗ refuted at <math");
    at = find(at, "<div class=\\\"check holds\\\"><p>✓ refuted at <math");
    find(at, "\"claim\":\"conserved (T + V)^2\"");
    qdot_string_free(text);
}

/* The report of a run is that of the prompt; as a table every number of the end state has its error. */
static void
runs_are_worded(void **state)
{
    char *text = display(*state, "run 0..10 tol 1e-9; run 0..2000", QDOT_RESULT_OK);
    const char *at = find(text, "\"text\":\"run2: t = 0..10, method taylor, tol 1e-9, done\\u000a  ");
    const char *html = find(at, "\"html\":\"<table class=\\\"run\\\">");

    assert_true(find(at, "  end state:\\u000a    θ = 0.0") < html);
    assert_true(find(at, "  drift: energy ") < html);
    html = find(html, "<mi>θ</mi></math></th><td>0.0");
    html = find(find(html, " ± "), "<tr><th>work</th><td>");
    find(html, "<tr><th>error of the end state</th><td>at most ");
    qdot_string_free(text);
}

/* Rows have their cells as texts, with errors; a row that failed has the reason, too. */
static void
rows_of_tables_are_worded(void **state)
{
    char *text = display(*state, "table theta every 5; param m > 0 = 1; force (-m, 0) on bob; "
                                 "sweep m = [1, -1] run 0..1 : max(theta, 0..1)", QDOT_RESULT_OK);
    const char *at = find(text, "\"cells\":[\"t\",\"θ\"]");

    find(at, "\"errors\":[0,");
    find(at, "\"cells\":[\"5\",\"1.49475111181");
    at = find(text, "\"cells\":[\"m\",\"max(θ, 0..1)\"],\"text\":\"m  max(θ, 0..1)\",\"html\":\"<tr><th>m</th><th>max(θ, 0..1)</th></tr>");

    at = find(at, "\"cells\":[\"1\",\"2 ± ");
    at = find(at, "\"cells\":[\"-1\",\"–\",\"m = -1 is outside its domain: m > 0\"]");
    find(at, "<td class=\\\"words\\\">m = -1 is outside its domain: m &gt; 0</td></tr>");
    qdot_string_free(text);
}

static void
figures_are_answers_in_their_order(void **state)
{
    char *text;
    const char *first, *number, *second;

    if (!has_gnuplot())
        skip();
    text = display(*state, "plot theta\n1 + 1\nplot theta' title \"speed\"", QDOT_RESULT_OK);
    first = find(text, "{\"kind\":\"figure\",\"mime\":\"image/svg+xml\",\"name\":\"theta\",\"data\":\"<svg");
    number = find(first, "\"plain\":\"2\"");
    second = find(number, "{\"kind\":\"figure\",\"mime\":\"image/svg+xml\",\"name\":\"speed\",\"data\":\"<svg");
    find(find(first, "</svg>"), "\",\"statement\":6,\"line\":1}\n");
    find(second, ",\"statement\":8,\"line\":3}\n");
    assert_int_equal(count(text, "\"kind\":\"file\""), 0);
    qdot_string_free(text);
    text = display(*state, "plot theta keep", QDOT_RESULT_OK);
    find(find(text, "{\"kind\":\"figure\""), "\"kind\":\"notice\",\"message\":\"`keep` keeps");
    qdot_string_free(text);
    assert_int_not_equal(access("qdot-1.svg", F_OK), 0);
    assert_int_not_equal(access("qdot-1.gp", F_OK), 0);
}

static void
pages_are_answers(void **state)
{
    char *text = display(*state, "animate from 0 to 5 title \"swing\"; animate; report", QDOT_RESULT_OK);

    assert_int_equal(count(text, "{\"kind\":\"page\",\"mime\":\"text/html\",\"name\":"), 3);
    assert_int_equal(count(text, "\"data\":\"<!DOCTYPE html>"), 3);
    find(find(find(text, "\"name\":\"swing\""), "\"name\":\"run1\""), "\"name\":\"report\"");
    qdot_string_free(text);
}

/* What names a file is a file; elsewhere animations and reports need one. */
static void
named_files_stay_files(void **state)
{
    qdot_system *s = *state;
    char *text = display(s, "animate to \"test_display-a.html\"; T to \"test_display-b.json\"", QDOT_RESULT_OK);
    char written[300] = "";
    FILE *file = fopen("test_display-b.json", "r");

    find(find(text, "{\"kind\":\"file\",\"path\":\"test_display-a.html\""), "{\"kind\":\"file\",\"path\":\"test_display-b.json\"");
    qdot_string_free(text);
    assert_non_null(file);
    assert_non_null(fgets(written, sizeof written, file));
    assert_null(strstr(written, "typeset"));
    fclose(file);
    (void)unlink("test_display-a.html");
    (void)unlink("test_display-b.json");
    assert_int_equal(qdot_system_ask(s, "animate", QDOT_NOTATION_JSON, &text), QDOT_RESULT_SYNTAX);
    qdot_string_free(text);
    assert_int_equal(qdot_system_declare(s, "report"), QDOT_RESULT_SYNTAX);
}

static void
notices_and_errors_stand_among_the_answers(void **state)
{
    qdot_system *s;
    char *text;

    (void)state;
    assert_int_equal(qdot_system_new(&s), QDOT_RESULT_OK);
    text = display(s, "coord x; particle p mass 1 at (x, 0)\nrun 0..1\nplot x for", QDOT_RESULT_SYNTAX);
    find(find(text, "{\"kind\":\"notice\",\"message\":"), ",\"text\":\"notice: ");
    find(text, ",\"text\":\"ask:3:11: error: ");
    find(text, "\\u000a  plot x for\\u000a            ^");
    find(text, ",\"html\":\"<pre class=\\\"error\\\">ask:3:11: error: ");
    find(find(text, "{\"kind\":\"run\""), "{\"kind\":\"error\",\"file\":\"ask\",\"line\":3,\"column\":");
    assert_non_null(strstr(qdot_system_error(s), "ask:3:"));
    qdot_string_free(text);
    assert_int_equal(qdot_system_ask(s, "1", QDOT_NOTATION_PLAIN, &text), QDOT_RESULT_OK);
    assert_string_equal(text, "1\n");
    qdot_string_free(text);
    qdot_system_free(s);
}

static void
numbers_are_written(void **state)
{
    static const struct {
        double value, error;
        const char *text;
    } known[] = {{1.25, 0, "1.25"},
                 {9.804964259856616, 0.002592760210505143, "9.805 ± 0.003"},
                 {0.5, NAN, "0.5 (error unknown)"}};

    (void)state;
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        char *text;

        assert_int_equal(qdot_number_write(known[i].value, known[i].error, &text), QDOT_RESULT_OK);
        assert_string_equal(text, known[i].text);
        qdot_string_free(text);
    }
    assert_int_equal(qdot_number_write(1, 0, NULL), QDOT_RESULT_INVALID);
    find(qdot_display_style(), ".qdot .check.fails p {");
}

static void
failing_memory_is_reported(void **state)
{
    qdot_system *s = *state;

    for (long n = 0;; n += 1 + n / 20) {
        qdot_result result;
        char *text;

        qdot_memory_fail_at(n);
        result = qdot_system_ask(s, "derive; print \"T is\", T; run 0..1; value(theta, 1); check T == 2; table theta every 1", QDOT_NOTATION_DISPLAY, &text);
        qdot_memory_fail_at(-1);
        qdot_string_free(text);
        if (result == QDOT_RESULT_OK) {
            assert_true(n > 100);
            return;
        }
        assert_int_equal(result, QDOT_RESULT_NO_MEMORY);
    }
}

/* What a text says no further object says again: the rows of `race`, the momenta of `cyclic`, the forces of `reactions`. */
static void
nothing_is_shown_twice(void **state)
{
    qdot_system *s = *state;
    char *answers = display(s, "race 0..1", QDOT_RESULT_OK);

    assert_int_equal(count(answers, "\"kind\":\"columns\""), 1);
    assert_null(strstr(answers, "formulation   ")); /* a table in characters */
    qdot_string_free(answers);
    answers = display(s, "reset; coord x; param m > 0; particle p mass m at (x, 0); cyclic", QDOT_RESULT_OK);
    assert_int_equal(count(answers, "\"kind\":\"expr\""), 0);
    assert_int_equal(count(answers, "is conserved\""), 1);
    qdot_string_free(answers);
    answers = display(s, "coord y; constraint rail: y = x; reactions", QDOT_RESULT_OK);
    assert_int_equal(count(answers, "\"kind\":\"expr\""), 0);
    assert_int_equal(count(answers, "\"name\":\"reactions\""), 1);
    qdot_string_free(answers);
}

int
main(void)
{
#define IN_A_SCENE(test) cmocka_unit_test_setup_teardown(test, begin, end)
    const struct CMUnitTest tests[] = {
        IN_A_SCENE(formulas_are_typeset),
        IN_A_SCENE(texts_are_typeset),
        IN_A_SCENE(numbers_are_typeset),
        IN_A_SCENE(nothing_is_shown_twice),
        cmocka_unit_test(units_are_typeset),
        IN_A_SCENE(checks_are_worded),
        IN_A_SCENE(runs_are_worded),
        IN_A_SCENE(rows_of_tables_are_worded),
        IN_A_SCENE(figures_are_answers_in_their_order),
        IN_A_SCENE(pages_are_answers),
        IN_A_SCENE(named_files_stay_files),
        IN_A_SCENE(failing_memory_is_reported),
        cmocka_unit_test(numbers_are_written),
        cmocka_unit_test(notices_and_errors_stand_among_the_answers),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
