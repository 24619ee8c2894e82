/* test_layout.c -- spaces and indentation: what is changed, that it is the same text of the language, and what is folded. */
#include "lang/analysis/analysed.h"

#include "lang/analysis/layout.h"

/* The text as it is laid out; the caller's. */
static char *
laid_out(qdot_analysis *a, const char *text)
{
    qdot_edit_list edits = {0};
    qdot_text other = {0};
    size_t from = 0;

    analyse(a, text);
    assert_int_equal(qdot_layout_edits(a, &edits), QDOT_OK);
    for (size_t i = 0; i < edits.n; i++) {
        assert_true(edits.at[i].at.from >= from);
        qdot_text_add_n(&other, text + from, edits.at[i].at.from - from);
        qdot_text_add(&other, edits.at[i].text);
        from = edits.at[i].at.to;
    }
    qdot_text_add(&other, text + from);
    qdot_layout_clear(&edits);
    return other.at;
}

static void
becomes(void **state, const char *text, const char *expected)
{
    char *once = laid_out(*state, text), *twice = laid_out(*state, once);

    assert_string_equal(once, expected);
    assert_string_equal(twice, expected);
    qdot_free(once);
    qdot_free(twice);
}

static void
spaces_are_evened_out(void **state)
{
    becomes(state, "x=1\n", "x = 1\n");
    becomes(state, "f( a,b )\n", "f(a, b)\n");
    becomes(state, "a +b*c  -d\n", "a +b*c -d\n");
    becomes(state, "2 +b\n", "2 + b\n");
    becomes(state, "a* b\n", "a*b\n");
    becomes(state, "a * b + c\n", "a * b + c\n");
    becomes(state, "0 .. 2*pi\n", "0..2*pi\n");
    becomes(state, "run 0..20   tol 1e-12 ;T\n", "run 0..20 tol 1e-12; T\n");
    becomes(state, "potential -k*x\n", "potential -k*x\n");
    becomes(state, "  param m   # mass  \n", "param m   # mass\n");
    becomes(state, "r[k]=r[k-1]+s\n", "r[k] = r[k-1]+s\n");
}

static void
lines_are_indented(void **state)
{
    becomes(state, "{\nprint k\n  print k;print 2*k\n} for k=1..3\n", "{\n    print k\n    print k; print 2*k\n} for k = 1..3\n");
    becomes(state, "x = (1,\n2)\n", "x = (1,\n    2)\n");
    becomes(state, "x = 1 + \\\n        2\n", "x = 1 + \\\n        2\n");
    becomes(state, "\n   # a comment\n\n\tx\n", "\n# a comment\n\nx\n");
}

static void
what_is_shown_or_torn_stays(void **state)
{
    becomes(state, "½ m  v²\n", "½ m  v²\n");
    becomes(state, "x=(1\ny=2\n", "x=(1\ny=2\n");
}

static void
blocks_lines_and_comments_are_folded(void **state)
{
    qdot_analysis *a = *state;
    qdot_fold_list folds = {0};

    analyse(a, "# one\n# two\n{\nprint k\n} for k = 1..2\nx = (1,\n2)\n# alone\n");
    assert_int_equal(qdot_layout_folds(a, &folds), QDOT_OK);
    assert_int_equal(folds.n, 3);
    assert_int_equal(folds.at[0].at.from, 12);
    assert_int_equal(folds.at[1].at.from, 37);
    assert_true(folds.at[2].comment);
    qdot_free(folds.at);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(spaces_are_evened_out, begin, end),
        cmocka_unit_test_setup_teardown(lines_are_indented, begin, end),
        cmocka_unit_test_setup_teardown(what_is_shown_or_torn_stays, begin, end),
        cmocka_unit_test_setup_teardown(blocks_lines_and_comments_are_folded, begin, end),
    };

    return cmocka_run_group_tests_name("lang/analysis layout", tests, NULL, NULL);
}
