/* test_prompt.c -- the prompt, through a pseudo-terminal, as a person meets it. */
#include "src/terminal.h"

/* --- facts ------------------------------------------------------------------------------ */

static void
banner_is_shown_unless_quiet(void **state)
{
    (void)state;
    start("-i");
    expect("`help`");
    leave_by_ctrl_d();
    start("-q");
    leave_by_ctrl_d();
    assert_null(strstr(seen, "`help`"));
}

static void
statements_are_answered_and_errors_go_on(void **state)
{
    (void)state;
    start("-q");
    ready();
    type("a = 40\r");
    ready();
    type("nobody\r");
    expect("error: ");
    ready();
    type("print \"is\", a + 2\r");
    expect("is 42");
    ready();
    type("quit\r");
    assert_int_equal(finish(), 0);
}

/* Where the locale is C the bytes of a letter are still that letter. */
static void
greek_letters_are_typed_in_any_locale(void **state)
{
    (void)state;
    start("-q");
    ready();
    type("print \"θ\", 40 + 2\r");
    expect("\nθ 42");
    leave_by_ctrl_d();
}

static void
an_open_bracket_continues(void **state)
{
    (void)state;
    start("-q");
    ready();
    type("print (40 +\r");
    expect("...> ");
    type("2)\r");
    expect("42");
    leave_by_ctrl_d();
}

static void
ctrl_c_clears_the_line(void **state)
{
    (void)state;
    start("-q");
    ready();
    type("nonsense +");
    expect("nonsense +");
    type(CTRL_C);
    ready();
    type("print 40 + 2\r");
    expect("42");
    ready();
    type("print (1 +\r");
    expect("...> ");
    type(CTRL_C);
    ready();
    type("print 7*6 + 1\r");
    expect("43");
    leave_by_ctrl_d();
    assert_null(strstr(seen, "error"));
}

static void
ctrl_c_stops_a_computation_and_keeps_the_session(void **state)
{
    (void)state;
    start("-q");
    ready();
    type("param g = 9.81; coord theta\r");
    ready();
    type("particle bob mass 1 at (sin(theta), -cos(theta)); gravity (0, -g)\r");
    ready();
    type("start theta = 2\r");
    ready();
    type("run 0..10^7\r");
    expect("10^7");
    usleep(300000);
    type(CTRL_C);
    expect("interrupted");
    ready();
    type("check value(theta, 0) == 2 within 1e-9\r"); /* the run so far is kept */
    expect("proved");
    ready();
    type("print \"still\", T\r");
    expect("still");
    expect("theta'^2");
    leave_by_ctrl_d();
}

static void
tab_completes_words_and_names(void **state)
{
    (void)state;
    start("-q");
    ready();
    type("coord wobble\r");
    ready();
    type("print wob\t");
    expect("wobble");
    type(" + 1\r");
    ready();
    type("virtu\t");
    expect("virtual_work");
    type(CTRL_C);
    leave_by_ctrl_d();
    assert_null(strstr(seen, "error"));
}

/* The history file as a string; the caller frees it. */
static char *
history(void)
{
    char path[4300], *text = calloc(1, MOST);
    FILE *f;

    snprintf(path, sizeof path, "%s/qdot/history", home);
    f = fopen(path, "r");
    assert_non_null(f);
    assert_non_null(text);
    assert_true(fread(text, 1, MOST - 1, f) > 0);
    fclose(f);
    return text;
}

static void
history_is_kept_across_sessions(void **state)
{
    char *text;

    (void)state;
    start("-q");
    ready();
    type("print 17 + 4\r");
    expect("21");
    leave_by_ctrl_d();
    text = history();
    assert_non_null(strstr(text, "print 17 + 4\n"));
    free(text);

    start("-q");
    ready();
    type("\x10"); /* Ctrl-P: the line before */
    expect("print 17 + 4");
    type("0\r");
    expect("57");
    leave_by_ctrl_d();
}

static void
a_statement_of_several_lines_is_recalled_whole(void **state)
{
    char *text;

    (void)state;
    start("-q");
    ready();
    type("print (100 +\r");
    expect("...> ");
    type("23)\r");
    expect("123");
    leave_by_ctrl_d();
    text = history();
    assert_non_null(strstr(text, "print (100 +\x1e" "23)\n"));
    free(text);

    start("-q");
    ready();
    type("\x10"); /* Ctrl-P */
    expect("23)");
    type("*2\r");
    expect("246");
    leave_by_ctrl_d();
}

/* qdot 3> is where %3 will be; pasted, it is stepped over. */
static void
the_prompt_counts_values(void **state)
{
    (void)state;
    start("-q");
    expect("qdot 1> ");
    type("param m\r");
    expect("qdot 1> ");
    type("1 + m\r");
    expect("qdot 2> ");
    type("m^2; m^3\r");
    expect("qdot 4> ");
    type("qdot 2> print \"third\", %3\r");
    expect("third m^3");
    leave_by_ctrl_d();
}

static void
a_question_mark_asks_for_help(void **state)
{
    (void)state;
    start("-q");
    ready();
    type("?gravity\r");
    expect("gravity [NAME:] VECTOR");
    ready();
    type(" ??Rayleigh\r");
    expect("dissipation");
    leave_by_ctrl_d();
}

/* Write the startup file. */
static void
write_startup(const char *text)
{
    char path[4300];
    FILE *f;

    snprintf(path, sizeof path, "mkdir -p %s/qdot", config);
    assert_int_equal(system(path), 0);
    snprintf(path, sizeof path, "%s/qdot/init.lag", config);
    f = fopen(path, "w");
    assert_non_null(f);
    fputs(text, f);
    assert_int_equal(fclose(f), 0);
}

static void
the_startup_file_is_read(void **state)
{
    (void)state;
    write_startup("square(x) = x^2\nnobody\nprint \"never\"\n");
    start("-q");
    expect("init.lag:2:1: error: ");
    ready();
    type("print square(12)\r");
    expect("144");
    leave_by_ctrl_d();
    assert_null(strstr(seen, "never"));

    start("--no-init");
    ready();
    type("print square(12)\r");
    expect("error: ");
    leave_by_ctrl_d();
    assert_null(strstr(seen, "init.lag"));
    assert_int_equal(remove("config/qdot/init.lag"), 0);
}

static void
ctrl_c_twice_keeps_the_session(void **state)
{
    (void)state;
    start("-q");
    ready();
    type("a = 40\r");
    ready();
    type(CTRL_C CTRL_C);
    ready();
    type("coord x; lagrangian x'^2/2 - x^4/4; start x = 1\r");
    ready();
    for (int i = 0; i < 3; i++) {
        type("run 0..10^7\r");
        expect("10^7");
        usleep(200000);
        type(CTRL_C);
        type(CTRL_C);
        type(CTRL_C);
        ready();
    }
    type("print \"kept\", a + 2\r");
    expect("kept 42");
    leave_by_ctrl_d();
}

static void
tab_completes_by_what_may_stand(void **state)
{
    (void)state;
    start("-q");
    ready();
    type("coord theta; param theory\r");
    ready();
    type("lagrangian theta'^2/2; p[th\t] + 0\r"); /* a coordinate, no parameter */
    expect("p[theta] + 0\r\n");
    ready();
    type("run 0..1 met\t tay\t tol\t 1e-3");
    expect("run 0..1 method taylor tol 1e-3");
    type(CTRL_C);
    ready();
    type("check (\\thet\t +\r");
    expect("...> ");
    type("theo\t) == theory + theta\r");
    expect("proved");
    leave_by_ctrl_d();
}

static void
tab_completes_names_of_files(void **state)
{
    (void)state;
    assert_int_equal(system("mkdir -p deep"), 0);
    write_file("letter.lag", "print 40 + 2\n");
    write_file("deep/inner.lag", "print 40 + 4\n");
    start("-q");
    ready();
    type("include \"lett\t\r");
    expect("\"letter.lag\"\r\n");
    expect("42");
    ready();
    type("include \"de\tin\t\r");
    expect("\"deep/inner.lag\"\r\n");
    expect("44");
    ready();
    type("include \"./lett\t\r");
    expect("\"./letter.lag\"\r\n");
    expect("42");
    leave_by_ctrl_d();
    assert_null(strstr(seen, "error"));
}

/* A pager of its own: each line begins with PAGE. */
static void
what_is_longer_than_the_screen_is_paged(void **state)
{
    (void)state;
    setenv("TERM", "xterm", 1);
    setenv("PAGER", "sed s/^/PAGE:/", 1);
    start("-q");
    ready();
    type("help\r");
    expect("PAGE:");
    expect("PAGE:  particle");
    ready();
    type("print 40 + 2\r");
    expect("\n42");
    ready();
    type("{ print k; k + } for k = 1..60\r"); /* an error stays behind what was before it */
    expect("error:");
    ready();
    type("print k for k = 1..60\r");
    expect("PAGE:60");
    leave_by_ctrl_d();

    setenv("PAGER", "no-such-command-of-any-machine", 1);
    start("-q");
    ready();
    type("print k for k = 1..60\r");
    expect("\n60");
    leave_by_ctrl_d();
    setenv("PAGER", "cat", 1);
    setenv("TERM", "dumb", 1);
}

/* A pendulum. */
static void
declare_scene(void)
{
    ready();
    type("coord x; lagrangian x'^2/2 + cos(x); start x = 2\r");
    ready();
}

static void
long_work_says_how_far_it_is(void **state)
{
    (void)state;
    start("-q");
    declare_scene();
    type("run 0..10^7\r");
    expect("run: t = ");
    expect("of 1e+07, ");
    expect(" steps/s, ");
    expect(" left");
    type(CTRL_C);
    expect("\rrun1: "); /* where the line of progress began, which is taken away first */
    expect("interrupted");
    ready();
    type("run 0..10\r");
    leave_by_ctrl_d();

    start("--json");
    declare_scene();
    type("run 0..10^7\r");
    expect("10^7");
    usleep(900000);
    type(CTRL_C);
    expect("\"interrupted");
    leave_by_ctrl_d();
    assert_null(strstr(seen, " left"));
}

static void
interrupted_work_keeps_its_rows(void **state)
{
    static const struct {
        const char *statement, *second, *head; /* the second row; the head of the table */
    } cases[] = {{"workprecision 0..5000\r", ", tol 1e-04", "energy err"},
                 {"race 0..10^6\r", ", tol 1e-06", "formulation"}};

    (void)state;
    for (size_t i = 0; i < 2; i++) {
        start("-q");
        declare_scene();
        type(cases[i].statement);
        expect(cases[i].second);
        type(CTRL_C);
        expect(cases[i].head);
        expect("interrupted: ");
        leave_by_ctrl_d();
    }
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(banner_is_shown_unless_quiet),
        cmocka_unit_test(statements_are_answered_and_errors_go_on),
        cmocka_unit_test(greek_letters_are_typed_in_any_locale),
        cmocka_unit_test(an_open_bracket_continues),
        cmocka_unit_test(ctrl_c_clears_the_line),
        cmocka_unit_test(ctrl_c_stops_a_computation_and_keeps_the_session),
        cmocka_unit_test(tab_completes_words_and_names),
        cmocka_unit_test(history_is_kept_across_sessions),
        cmocka_unit_test(a_statement_of_several_lines_is_recalled_whole),
        cmocka_unit_test(the_prompt_counts_values),
        cmocka_unit_test(a_question_mark_asks_for_help),
        cmocka_unit_test(the_startup_file_is_read),
        cmocka_unit_test(ctrl_c_twice_keeps_the_session),
        cmocka_unit_test(tab_completes_by_what_may_stand),
        cmocka_unit_test(tab_completes_names_of_files),
        cmocka_unit_test(what_is_longer_than_the_screen_is_paged),
        cmocka_unit_test(long_work_says_how_far_it_is),
        cmocka_unit_test(interrupted_work_keeps_its_rows),
    };

    return cmocka_run_group_tests(tests, enter, leave);
}
