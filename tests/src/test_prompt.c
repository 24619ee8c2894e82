/* test_prompt.c -- the prompt, through a pseudo-terminal, as a person meets it.
 *
 * QDOT is the program.
 */
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <cmocka.h>

#include <poll.h>
#include <pty.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/utf8.h"

enum { MOST = 1 << 16, PATIENCE = 20000 /* ms */ };

#define CTRL_C "\x03"
#define CTRL_D "\x04"

static char folder[] = "qdot-prompt-XXXXXX", home[4200], config[4200];
static unsigned short columns = 120;
static int terminal;
static pid_t child;
static char seen[MOST];       /* what the program has written since it was started */
static size_t n_seen, n_read; /* and how far the test has read it */

/* --- a program at a terminal ------------------------------------------------------------ */

static int
enter(void **state)
{
    char here[4096];

    (void)state;
    if (getenv("QDOT") == NULL) {
        fputs("QDOT must say where the program is\n", stderr);
        return -1;
    }
    if (mkdtemp(folder) == NULL || chdir(folder) != 0 ||
        getcwd(here, sizeof here) == NULL)
        return -1;
    snprintf(home, sizeof home, "%s/state", here);
    snprintf(config, sizeof config, "%s/config", here);
    setenv("XDG_STATE_HOME", home, 1);
    setenv("XDG_CONFIG_HOME", config, 1);
    setenv("TERM", "dumb", 1);
    setenv("LC_ALL", "C", 1);
    setenv("PAGER", "cat", 1);
    unsetenv("NO_COLOR");
    unsetenv("INPUTRC");
    return 0;
}

static int
leave(void **state)
{
    (void)state;
    return chdir("..") == 0 && system("rm -r qdot-prompt-??????") == 0 ? 0 : -1;
}

static void
start(const char *option)
{
    struct winsize size = {.ws_row = 40, .ws_col = columns};

    n_seen = n_read = 0;
    seen[0] = '\0';
    child = forkpty(&terminal, NULL, NULL, &size);
    assert_true(child >= 0);
    if (child == 0) {
        execl(getenv("QDOT"), "qdot", option, (char *)NULL);
        _exit(127);
    }
}

static void
type(const char *text)
{
    assert_int_equal(write(terminal, text, strlen(text)), (ssize_t)strlen(text));
}

/* Wait until `text` comes behind what was read before, and read on to its end. */
static void
expect(const char *text)
{
    struct pollfd input = {.fd = terminal, .events = POLLIN};
    char *found;

    while ((found = strstr(seen + n_read, text)) == NULL) {
        ssize_t n = -1;

        if (poll(&input, 1, PATIENCE) > 0)
            n = read(terminal, seen + n_seen, MOST - 1 - n_seen);
        if (n <= 0)
            fail_msg("`%s` did not come; what came: %s", text, seen + n_read);
        n_seen += (size_t)n;
        seen[n_seen] = '\0';
    }
    n_read = (size_t)(found - seen) + strlen(text);
}

/* Wait for the prompt. */
static void
ready(void)
{
    expect("qdot ");
    expect("> ");
}

/* Read to the end of the program; its raw status. */
static int
finish(void)
{
    int status;

    for (;;) {
        struct pollfd input = {.fd = terminal, .events = POLLIN};
        ssize_t n = -1;

        if (poll(&input, 1, PATIENCE) > 0)
            n = read(terminal, seen + n_seen, MOST - 1 - n_seen);
        if (n <= 0)
            break;
        n_seen += (size_t)n;
        seen[n_seen] = '\0';
    }
    close(terminal);
    assert_int_equal(waitpid(child, &status, 0), child);
    return status;
}

static void
leave_by_ctrl_d(void)
{
    int status;

    ready();
    type(CTRL_D);
    status = finish();
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
        fail_msg("status %d; what came: %s", status, seen);
}

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
        type("run 0..10^8\r");
        expect("10^8");
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
write_file(const char *name, const char *text)
{
    FILE *f = fopen(name, "w");

    assert_non_null(f);
    fputs(text, f);
    assert_int_equal(fclose(f), 0);
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

static void
colours_are_shown_where_they_may(void **state)
{
    static const char *const terms[] = {"xterm", "xterm", "dumb"}, *const no[] = {"", "1", ""};

    (void)state;
    for (int i = 0; i < 3; i++) {
        setenv("TERM", terms[i], 1);
        setenv("NO_COLOR", no[i], 1);
        start("-q");
        ready();
        type("nobody\r");
        expect("error:");
        ready();
        type("check 2 == 2\r");
        expect("proved");
        leave_by_ctrl_d();
        assert_true((strstr(seen, "\033[31merror:\033[0m") != NULL) == (i == 0));
        assert_true((strstr(seen, "\033[32mproved\033[0m") != NULL) == (i == 0));
        assert_true((strstr(seen, "\033[34mqdot 1> ") != NULL) == (i == 0));
        assert_true(i == 0 || strstr(seen, "[3") == NULL);
    }
    setenv("TERM", "dumb", 1);
    unsetenv("NO_COLOR");
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
    type("run 0..10^8\r");
    expect("run: t = ");
    expect("of 1e+08, ");
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
    type("run 0..10^8\r");
    expect("10^8");
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

/* Line ends are those of the terminal. */
static void
formulas_are_drawn_to_the_width_of_the_terminal(void **state)
{
    (void)state;
    setenv("LC_ALL", "C.UTF-8", 1);
    start("-q");
    ready();
    type("param a, b, c\r");
    ready();
    type("(a + b)/c\r");
    expect("a + b\r\n");
    expect("─────\r\n");
    expect("  c\r\n");
    type("style flat\r");
    ready();
    type("1/(b + a)\r");
    expect("1/(a + b)\r\n");
    type("style unicode; expand((a + b + c)^30)\r");
    expect("... 20 of ");
    expect("to \"all.txt\"` writes all of it");
    leave_by_ctrl_d();
    setenv("LC_ALL", "C", 1);
}

/* --- a narrow terminal ------------------------------------------------------------------ */

/* No line of what was said between two places is wider than the terminal; formulas and sketches. */
static void
is_within(size_t begin, size_t end, unsigned short most)
{
    for (const char *at = seen + begin; at < seen + end;) {
        const size_t n = strcspn(at, "\r\n");

        if (qdot_utf8_columns(at, n) > most)
            fail_msg("wider than %d: %.*s", most, (int)n, at);
        at += n + strspn(at + n, "\r\n");
    }
}

static void
what_is_shown_fits_a_narrow_terminal(void **state)
{
    static const char *const statements[] = {
        "T", "eom", "accel[a]", "inverse(mass_matrix)", "derive", "plot a", "plot p"};
    size_t begin;

    (void)state;
    if (system("gnuplot --version >/dev/null 2>&1") != 0)
        skip();
    setenv("LC_ALL", "C.UTF-8", 1);
    columns = 40;
    start("-q");
    columns = 120;
    ready();
    type("coord a, b; r = (sin(a), -cos(a))\r");
    ready();
    type("particle p mass 1 at r\r");
    ready();
    type("s = (sin(b), -cos(b))\r");
    ready();
    type("particle q mass 2 at r + s\r");
    ready();
    type("gravity (0, -9.81); start a = 2\r");
    ready();
    type("run 0..2\r");
    ready();
    for (size_t i = 0; i < sizeof statements / sizeof *statements; i++) {
        type(statements[i]);
        type("\r");
        expect(statements[i]);
        expect("\n");
        begin = n_read;
        ready();
        is_within(begin, n_read, 40);
    }
    assert_int_equal(access("qdot-2.svg", R_OK), 0);
    type(CTRL_D);
    finish();
    setenv("LC_ALL", "C", 1);
}

/* --- README's session ------------------------------------------------------------------- */

/* Numbers become N, since the last digits, the steps and the times depend on the machine, and so does
 * whether an error is 0 and told; a line's trailing blanks go. */
static void
level(char *text)
{
    static const char velocities[] = ", of velocities ", steps[] = "steps";
    char *to = text;

    for (const char *c = text; *c != '\0';) {
        const bool minus = *c == '-' && c[1] >= '0' && c[1] <= '9';

        if (strncmp(c, velocities, strlen(velocities)) == 0) {
            c += strcspn(c, ";\n");
        } else if (strncmp(c, steps, strlen(steps)) == 0) {
            to = stpcpy(to, "step");
            c += strlen(steps);
        } else if (minus || (*c >= '0' && *c <= '9')) {
            c += minus ? 1 : 0;
            c += strspn(c, "0123456789.");
            if (c[0] == 'e' && c[1] == '-')
                c += 2 + strspn(c + 2, "0123456789");
            *to++ = 'N';
        } else if (*c == '\r') {
            c++;
        } else {
            if (*c == '\n')
                while (to > text && to[-1] == ' ')
                    to--;
            *to++ = *c++;
        }
    }
    *to = '\0';
}

/* The lines of README from *at on that are indented and no prompt, without the indent. */
static void
take_answer(const char **at, char *answer, size_t size)
{
    size_t n = 0;

    while (strncmp(*at, "    ", 4) == 0 && strncmp(*at, "    qdot ", 9) != 0) {
        const size_t length = strcspn(*at, "\n");

        assert_true(n + length < size);
        n += (size_t)sprintf(answer + n, "%.*s\n", (int)(length - 4), *at + 4);
        *at += length + ((*at)[length] == '\n');
    }
    answer[n] = '\0';
}

/* Type what stands behind a prompt of README, and compare what comes with what README shows. */
static void
follow_readme(const char *at)
{
    static char answer[4096], said[MOST];
    char prompt[32], statement[256];
    int asked = 0;

    while ((at = strstr(at, "\n    qdot ")) != NULL) {
        at += 5;
        assert_int_equal(sscanf(at, "%31[^>]> %255[^\n]", prompt, statement), 2);
        strcat(prompt, "> ");
        expect(prompt);
        at += strcspn(at, "\n") + 1;
        take_answer(&at, answer, sizeof answer);
        at--;
        type(statement);
        type("\r");
        expect(statement);
        expect("\n");
        const size_t begin = n_read;

        expect("qdot ");
        n_read -= strlen("qdot ");
        snprintf(said, sizeof said, "%.*s", (int)(n_read - begin), seen + begin);
        level(said);
        level(answer);
        assert_string_equal(said, answer);
        asked++;
    }
    assert_true(asked > 20);
}

static void
readme_shows_what_is_seen(void **state)
{
    const char *top = getenv("top_srcdir");
    static char text[MOST], path[4200];
    FILE *file;

    (void)state;
    if (top == NULL || system("gnuplot --version >/dev/null 2>&1") != 0)
        skip();
    snprintf(path, sizeof path, top[0] == '/' ? "%s/README.md" : "../%s/README.md", top);
    file = fopen(path, "r");
    assert_non_null(file);
    text[fread(text, 1, sizeof text - 1, file)] = '\0';
    fclose(file);
    setenv("LC_ALL", "C.UTF-8", 1);
    start("-q");
    follow_readme(text);
    leave_by_ctrl_d();
    setenv("LC_ALL", "C", 1);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(banner_is_shown_unless_quiet),
        cmocka_unit_test(statements_are_answered_and_errors_go_on),
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
        cmocka_unit_test(colours_are_shown_where_they_may),
        cmocka_unit_test(long_work_says_how_far_it_is),
        cmocka_unit_test(interrupted_work_keeps_its_rows),
        cmocka_unit_test(formulas_are_drawn_to_the_width_of_the_terminal),
        cmocka_unit_test(what_is_shown_fits_a_narrow_terminal),
        cmocka_unit_test(readme_shows_what_is_seen),
    };

    return cmocka_run_group_tests(tests, enter, leave);
}
