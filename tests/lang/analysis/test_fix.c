/* test_fix.c -- what mends an error, from its hint. */
#include "lang/analysis/analysed.h"

#include "lang/analysis/fix.h"

/* All texts that mend the first error, a line each. */
static void
mended(void **state, const char *text, const char *expected)
{
    qdot_analysis *a = *state;
    qdot_edit_list fixes = {0};
    qdot_text all = {0};
    qdot_remark remark;

    analyse(a, text);
    assert_true(qdot_analysis_remark(a, 0, &remark));
    assert_int_equal(qdot_fix_find(a, &remark, &fixes), QDOT_OK);
    for (size_t i = 0; i < fixes.n; i++)
        qdot_text_format(&all, "%.*s%s%s|", (int)fixes.at[i].at.from, text, fixes.at[i].text, text + fixes.at[i].at.to);
    assert_string_equal(qdot_text_str(&all), expected);
    qdot_text_clear(&all);
    qdot_layout_clear(&fixes);
}

static void
a_near_name(void **state)
{
    mended(state, "coord theta\nprint thet + 1\n", "coord theta\nprint theta + 1\n|");
}

static void
a_text_of_the_same_names(void **state)
{
    mended(state, "coord x\ny = sin^2(x) + 3*x\n", "coord x\ny = sin(x)^2 + 3*x\n|");
    mended(state, "coord x\ny = 1 + Sin[x]*x\n", "coord x\ny = 1 + sin(x)*x\n|");
    mended(state, "coord x\ny = D[x^2, x] - 1\n", "coord x\ny = diff(x^2, x) - 1\n|");
    mended(state, "coord x\ny = 2x + 1\n", "coord x\ny = 2*x + 1\n|");
    mended(state, "coord theta\ny = thetadot*2\n", "coord theta\ny = theta'*2\n|");
}

static void
a_whole_statement(void **state)
{
    mended(state, "coord x\nx' = 2\n", "coord x\nstart x' = 2\n|");
}

static void
a_line_above(void **state)
{
    mended(state, "coord x\nprint x; print x + k\n", "coord x\nparam k\nprint x; print x + k\n|coord x\ncoord k\nprint x; print x + k\n|");
}

static void
what_mends_nothing_is_not_told(void **state)
{
    mended(state, "coord x\nparam x\n", "");
    mended(state, "coord x\nm = \"a\"\n", "");
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_near_name, begin, end),
        cmocka_unit_test_setup_teardown(a_text_of_the_same_names, begin, end),
        cmocka_unit_test_setup_teardown(a_whole_statement, begin, end),
        cmocka_unit_test_setup_teardown(a_line_above, begin, end),
        cmocka_unit_test_setup_teardown(what_mends_nothing_is_not_told, begin, end),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
