/* test_undo.c -- statements taken back: what is left is what was there before. */
#include "lang/session/history.h"
#include "lang/session/names.h"
#include "lang/talk.h"
#include "mech/scene/things.h"

#include <glob.h>

#include "base/interrupt.h"
#include "base/memory.h"
#include "expr/print.h"
#include "lang/declare/scene-file.h"
#include "lang/source/source.h"
#include "lang/syntax/statement.h"

/* All that a session file says, and every name. */
static char *
state_of(talk *k)
{
    qdot_text text = {0};
    char *copy;

    assert_int_equal(qdot_scene_file_text(k->session, true, &text), QDOT_OK);
    for (size_t i = 0; qdot_names_at(k->session->names, i) != NULL; i++)
        qdot_text_format(&text, "%s ", qdot_names_at(k->session->names, i)->name);
    copy = strdup(qdot_text_str(&text));
    assert_non_null(copy);
    qdot_text_clear(&text);
    (void)heard(k);
    return copy;
}

/* `word` leads to this state. */
static void
leads_to(talk *k, const char *word, const char *expected)
{
    char *seen;

    assert_int_equal(say(k, word), 0);
    seen = state_of(k);
    assert_string_equal(seen, expected);
    free(seen);
}

/* The statement undone is the state before, done again the state behind it. */
static void
back_and_forth(talk *k, const char *text)
{
    char *before = state_of(k), *behind;

    assert_int_equal(say(k, text), 0);
    behind = state_of(k);
    leads_to(k, "undo", before);
    leads_to(k, "redo", behind);
    free(before);
    free(behind);
}

/* --- kinds of statements --------------------------------------------------------------- */

static void
every_kind_of_change_is_undone(void **state)
{
    static const char *const statements[] = {
        "param m, k > 0, g = 9.81",
        "coord x > 0, y",
        "function f(s), h(x, t)",
        "param s",
        "assume k > m",
        "R = (x, y)",
        "R = (y, x)",
        "u(a) = a^2 + k",
        "c[i] = i*m for i = 1..3",
        "{ d[i] = i; e[i] = 2*i } for i = 1..2",
        "particle bob mass m at (x, y)",
        "particle rim mass 2*m at (x + 1, y)",
        "gravity (0, -g)",
        "gravity (0, g)",
        "potential well: k*x^2/2",
        "spring s1 between bob, (0, 1) stiffness k rest 1",
        "damper d1 between bob, rim coefficient k",
        "dissipation k*x'^2",
        "force (0, m) on bob",
        "torque m on x",
        "constraint rod: x^2 + y^2 = 1",
        "event up: y = 0 rising stop",
        "event jump: y = 1 falling then y' = -y', x' = 2*x'",
        "remove up",
        "remove dissipation",
        "remove rim",
        "set m = 2/3, k = 3e5",
        "set m = 2",
        "set f(u) = u^2",
        "start x = 3/5, y = 4/5",
        "start x' = 0 exactly",
        "reset start",
        "style latex",
        "timing on",
        "timing off; style plain",
        "reset scene",
        "coord q",
        "lagrangian m*q'^2/2 - k*q^2/2",
        "run 0..1",
        "run 0..2 as run1",
        "start run1",
        "reset",
    };
    talk *k = *state;

    for (size_t i = 0; i < sizeof statements / sizeof *statements; i++)
        if (strchr(statements[i], ';') == NULL || statements[i][0] == '{')
            back_and_forth(k, statements[i]);
        else
            assert_int_equal(say(k, statements[i]), 0);
    while (k->session->undo != NULL && say(k, "undo") == 0)
        ;
    free(state_of(k));
    assert_null(qdot_names_at(k->session->names, 0));
    assert_int_equal(k->session->scene->coordinates.n, 0);
}

static void
what_only_asks_is_not_undone(void **state)
{
    talk *k = *state;

    assert_int_equal(say(k, "a = 2; a + 1; print a; vars; help undo; a = 2*3"), 0);
    (void)heard(k);
    assert_int_equal(say(k, "a*7; undo"), 0);
    assert_string_equal(heard(k), "a*7 = 42\nundone: a = 2*3\n");
    assert_int_equal(say(k, "undo"), 0);
    assert_string_equal(heard(k), "undone: a = 2\n");
    assert_int_equal(say(k, "undo"), 1);
    assert_int_equal(say(k, "redo 2; a"), 0);
    assert_string_equal(heard(k), "done again: a = 2\ndone again: a = 2*3\na = 6\n");
    assert_int_equal(say(k, "redo"), 1);
    assert_int_equal(say(k, "undo; b = 1; redo"), 1);
    assert_int_equal(say(k, "undo 3"), 1);
    assert_int_equal(say(k, "undo 0"), 1);
    assert_int_equal(say(k, "undo for k = 1..2"), 1);
    assert_int_equal(say(k, "undo nonsense"), 1);
    assert_int_equal(say(k, "undo 2; undo"), 1);
}

/* `%` is what it was, too. */
static void
answers_are_counted_back(void **state)
{
    talk *k = *state;

    assert_int_equal(say(k, "1 + 1; param m; m + 1; m + 2; undo; % + 1"), 0);
    assert_non_null(strstr(heard(k), "undone: param m\n% + 1 = 3\n"));
    assert_int_equal(k->session->history->values.n, 2);
    assert_int_equal(say(k, "redo; %1 + 1"), 0);
    assert_non_null(strstr(heard(k), "%1 + 1 = 3\n"));
}

/* A statement that fails leaves nothing to undo; a loop that fails in its middle is one. */
static void
failures_leave_what_they_did(void **state)
{
    talk *k = *state;
    char *before, *seen, path[] = "test_undo-XXXXXX", include[64];
    FILE *file;

    assert_int_equal(say(k, "param m; a = 1"), 0);
    before = state_of(k);
    assert_int_not_equal(say(k, "b = nonsense"), 0);
    assert_int_not_equal(say(k, "set m = 1, m2 = 2"), 0);
    assert_int_not_equal(say(k, "c[i] = 1/(2 - i) for i = 1..3"), 0);
    assert_int_equal(say(k, "undo"), 0);
    assert_non_null(strstr(heard(k), "undone: c[i] = 1/(2 - i) for i = 1..3\n"));
    seen = state_of(k);
    assert_string_equal(seen, before);
    free(seen);
    free(before);
    /* an included script that fails, too */
    file = fdopen(mkstemp(path), "w");
    snprintf(include, sizeof include, "include \"%s\"", path);
    assert_true(fputs("z = 1; y = 2\nnonsense\n", file) >= 0 && fclose(file) == 0);
    assert_int_not_equal(say(k, include), 0);
    assert_int_equal(say(k, "z + y; undo"), 0);
    assert_non_null(strstr(heard(k), "undone: include"));
    remove(path);
    assert_int_not_equal(say(k, "z"), 0);
    assert_int_equal(say(k, "undo"), 0);
    assert_string_equal(heard(k), "undone: a = 1\n");
}

/* The value that a loop gives to a parameter or coordinate ends with the loop, also by a failure, and is not kept for undo. */
static void
values_of_failed_loops_are_not_kept(void **state)
{
    talk *k = *state;
    char *before, *with_set;

    assert_int_equal(say(k, "param m, n\ncoord x"), 0);
    before = state_of(k);
    assert_int_equal(say(k, "{ a = m; b = 1/(m - 2) } for m = 1..3"), 1);
    leads_to(k, "undo", before);
    assert_int_equal(say(k, "set n = 5"), 0);
    with_set = state_of(k);
    assert_int_equal(say(k, "{ { a = m*x; b = 1/(x - 2) } for x = 1..3 } for m = 1..3"), 1);
    leads_to(k, "undo", with_set);
    leads_to(k, "undo", before);
    leads_to(k, "redo", with_set);
    free(before);
    free(with_set);
}

static void
a_name_declared_anew_has_no_past(void **state)
{
    talk *k = *state;

    assert_int_equal(say(k, "param m > 0, g; (m*g)^2; sqrt((m*m)^2)"), 0);
    (void)heard(k);
    assert_int_equal(say(k, "undo; param m, g; sqrt(m^2)"), 0);
    assert_non_null(strstr(heard(k), "sqrt(m^2) = abs(m)\n"));
    assert_int_equal(say(k, "undo; param m < 0; sqrt(m^2)"), 0);
    assert_non_null(strstr(heard(k), "sqrt(m^2) = -m\n"));
    assert_int_equal(say(k, "undo; redo; sqrt(m^2)"), 0);
    assert_non_null(strstr(heard(k), "sqrt(m^2) = -m\n"));
    /* nor has what was made of it */
    assert_int_equal(say(k, "param u, w > 0; abs(u + w); undo; param u, w; abs(u + w)"), 0);
    assert_non_null(strstr(heard(k), "w > 0\nabs(u + w)\n"));
    assert_int_equal(say(k, "undo"), 0);
    /* what a function is of, too */
    assert_int_equal(say(k, "function y(w); param w > 0; diff(y(w), w); undo; y"), 0);
    assert_int_equal(say(k, "param w; sqrt(w^2); y"), 0);
    assert_non_null(strstr(heard(k), "sqrt(w^2) = abs(w)\n"));
}

/* Numbers do not depend on what was done and undone before. */
static void
runs_come_back(void **state)
{
    talk *k = *state;

    assert_int_equal(say(k, "param k = 2; coord x; lagrangian x'^2/2 - k*x^2/2; start x = 1; "
                            "run 0..1 as a; v = value(x, 1)"),
                     0);
    (void)heard(k);
    assert_int_equal(say(k, "run 0..2 as a; check value(x, 2) == cos(2*sqrt(2)) within 1e-9; "
                            "undo; check value(a.x, 1) == cos(sqrt(2)) within 1e-9; undo 2"),
                     0);
    assert_int_equal(say(k, "value(a.x, 1)"), 1);
    assert_int_equal(say(k, "redo 3; check value(a.x, 2) == cos(2*sqrt(2)) within 1e-9"), 0);
}

/* A session file writes the runs of the scene that is declared now: after `undo` those of the scene before. */
static void
runs_belong_to_their_scene(void **state)
{
    talk *k = *state;
    char *one, *two, *other;

    assert_int_equal(say(k, "param k = 2; coord x; particle b mass 1 at x; potential k*x^2/2; start x = 1; "
                            "run 0..1 as a"), 0);
    one = state_of(k);
    assert_non_null(strstr(one, "run 0..1 as a\n"));
    back_and_forth(k, "potential x^4");
    assert_int_equal(say(k, "run 0..1 as b"), 0);
    two = state_of(k);
    assert_null(strstr(two, "as a\n"));
    assert_non_null(strstr(two, "run 0..1 as b\n"));
    leads_to(k, "undo 2", one);
    leads_to(k, "redo 2", two);
    /* another scene instead of that one is none of the two */
    leads_to(k, "undo 2", one);
    assert_int_equal(say(k, "potential x^6"), 0);
    other = state_of(k);
    assert_null(strstr(other, "\nrun 0..1"));
    leads_to(k, "undo", one);
    /* what is held in a loop changes nothing for good */
    leads_to(k, "print diff(V, x) for k = 1..2", one);
    free(one);
    free(two);
    free(other);
}

/* Whatever fails, what can still be undone can also be done again. */
static void
left_whole(void (*arm)(int64_t n))
{
    static const char text[] = "param a > 0; b = a^2; coord x; undo 2; redo; reset scene; undo";
    int status = 1;

    for (int64_t n = 0; status != 0; n++) {
        char *before, *seen;
        talk *k;
        int64_t back = 0;

        assert_int_equal(begin((void **)&k), 0);
        assert_int_equal(say(k, "param m; coord y; R = m*y"), 0);
        arm(n);
        status = say(k, text);
        arm(-1);
        qdot_interrupt_clear();
        before = state_of(k);
        while (say(k, "undo") == 0)
            back++;
        for (; back > 0; back--)
            assert_int_equal(say(k, "redo"), 0);
        seen = state_of(k);
        assert_string_equal(seen, before);
        free(seen);
        free(before);
        back_and_forth(k, "c = 2");
        end((void **)&k);
    }
}

static void
failures_of_memory_leave_it_whole(void **state)
{
    (void)state;
    left_whole(qdot_memory_fail_at);
}

static void
ctrl_c_leaves_it_whole(void **state)
{
    (void)state;
    left_whole(qdot_memory_press_at);
}

/* --- the scripts of this tree ----------------------------------------------------------- */

static bool
is_op(const qdot_token *token, const char *op)
{
    return token->kind == QDOT_TOKEN_OPERATOR && strcmp(token->text, op) == 0;
}

/* The END behind the statement or block at i. */
static size_t
statement_end(const qdot_source *source, size_t i)
{
    const qdot_token *tokens = source->tokens.at;
    int depth = 0;

    for (;; i++) {
        depth += is_op(&tokens[i], "{") - is_op(&tokens[i], "}");
        if (tokens[i].kind == QDOT_TOKEN_END && depth == 0)
            return i;
    }
}

/* Whether the statement changes what is kept and takes no time. */
static bool
is_tried(const qdot_source *source, size_t from, size_t to)
{
    const qdot_token *first = &source->tokens.at[from];
    const qdot_statement *row =
        first->kind == QDOT_TOKEN_NAME ? qdot_statement_find(first->text) : NULL;

    if (row != NULL && !is_op(first + 1, "="))
        return qdot_statement_declares(row) || strcmp(row->word, "set") == 0 ||
               strcmp(row->word, "start") == 0 || strcmp(row->word, "style") == 0;
    for (size_t i = from; i < to; i++)
        if (is_op(&source->tokens.at[i], "="))
            return true;
    return false;
}

static size_t
try_script(talk *k, const char *path)
{
    qdot_source *source;
    char *text = calloc(1, 1 << 20), *first = state_of(k), *last, *seen;
    FILE *file = fopen(path, "r");
    size_t n = fread(text, 1, (1 << 20) - 1, file), at, tried = 0;

    fclose(file);
    if (qdot_source_new(path, text, n, &source, &at) == QDOT_OK)
        for (size_t i = 0, next; i < source->tokens.n; i = next + 1) {
            const qdot_token *tokens = source->tokens.at;
            char *statement, *before, *behind;

            next = statement_end(source, i);
            if (next == i || !is_tried(source, i, next))
                continue;
            statement = strndup(text + tokens[i].start,
                                tokens[next - 1].start + tokens[next - 1].length +
                                    (tokens[next - 1].kind == QDOT_TOKEN_STRING) -
                                    tokens[i].start);
            before = state_of(k);
            (void)say(k, statement);
            behind = state_of(k);
            if (strcmp(before, behind) != 0) {
                leads_to(k, "undo", before);
                leads_to(k, "redo", behind);
                tried++;
            }
            free(statement);
            free(before);
            free(behind);
        }
    qdot_source_free(source);
    last = state_of(k);
    n = 0;
    while (say(k, "undo") == 0)
        n++;
    seen = state_of(k);
    assert_string_equal(seen, first);
    free(seen);
    for (; n > 0; n--)
        assert_int_equal(say(k, "redo"), 0);
    seen = state_of(k);
    assert_string_equal(seen, last);
    free(seen);
    free(last);
    free(first);
    free(text);
    return tried;
}

static void
scripts_are_undone_statement_by_statement(void **state)
{
    const char *top = getenv("top_srcdir");
    char pattern[4096];
    glob_t found;
    size_t tried = 0;

    (void)state;
    snprintf(pattern, sizeof pattern, "%s/tests/script/*/*.lag", top != NULL ? top : ".");
    assert_int_equal(glob(pattern, 0, NULL, &found), 0);
    for (size_t i = 0; i < found.gl_pathc; i++) {
        talk *k;

        assert_int_equal(begin((void **)&k), 0);
        tried += try_script(k, found.gl_pathv[i]);
        end((void **)&k);
    }
    globfree(&found);
    print_message("# %zu statements\n", tried);
    assert_true(tried > 500);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(every_kind_of_change_is_undone, begin, end),
        cmocka_unit_test_setup_teardown(what_only_asks_is_not_undone, begin, end),
        cmocka_unit_test_setup_teardown(answers_are_counted_back, begin, end),
        cmocka_unit_test_setup_teardown(failures_leave_what_they_did, begin, end),
        cmocka_unit_test_setup_teardown(values_of_failed_loops_are_not_kept, begin, end),
        cmocka_unit_test_setup_teardown(a_name_declared_anew_has_no_past, begin, end),
        cmocka_unit_test_setup_teardown(runs_come_back, begin, end),
        cmocka_unit_test_setup_teardown(runs_belong_to_their_scene, begin, end),
        cmocka_unit_test(failures_of_memory_leave_it_whole),
        cmocka_unit_test(ctrl_c_leaves_it_whole),
        cmocka_unit_test(scripts_are_undone_statement_by_statement),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
