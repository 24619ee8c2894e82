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
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

enum { MOST = 1 << 16, PATIENCE = 20000 /* ms */ };

#define CTRL_C "\x03"
#define CTRL_D "\x04"

static char folder[] = "qdot-prompt-XXXXXX", home[4200];
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
    setenv("XDG_STATE_HOME", home, 1);
    setenv("TERM", "dumb", 1);
    setenv("LC_ALL", "C", 1);
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
    struct winsize size = {.ws_row = 40, .ws_col = 120};

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

    expect("qdot> ");
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
    expect("qdot> ");
    type("a = 40\r");
    expect("qdot> ");
    type("nobody\r");
    expect("error: ");
    expect("qdot> ");
    type("print \"is\", a + 2\r");
    expect("is 42");
    expect("qdot> ");
    type("quit\r");
    assert_int_equal(finish(), 0);
}

static void
an_open_bracket_continues(void **state)
{
    (void)state;
    start("-q");
    expect("qdot> ");
    type("print (40 +\r");
    expect(" ...> ");
    type("2)\r");
    expect("42");
    leave_by_ctrl_d();
}

static void
ctrl_c_clears_the_line(void **state)
{
    (void)state;
    start("-q");
    expect("qdot> ");
    type("nonsense +");
    expect("nonsense +");
    type(CTRL_C);
    expect("qdot> ");
    type("print 40 + 2\r");
    expect("42");
    expect("qdot> ");
    type("print (1 +\r");
    expect(" ...> ");
    type(CTRL_C);
    expect("qdot> ");
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
    expect("qdot> ");
    type("param g = 9.81; coord theta\r");
    expect("qdot> ");
    type("particle bob mass 1 at (sin(theta), -cos(theta)); gravity (0, -g)\r");
    expect("qdot> ");
    type("start theta = 2\r");
    expect("qdot> ");
    type("run 0..10^7\r");
    expect("10^7");
    usleep(300000);
    type(CTRL_C);
    expect("interrupted");
    expect("qdot> ");
    type("check value(theta, 0) == 2 within 1e-9\r"); /* the run so far is kept */
    expect("proved");
    expect("qdot> ");
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
    expect("qdot> ");
    type("coord wobble\r");
    expect("qdot> ");
    type("print wob\t");
    expect("wobble");
    type(" + 1\r");
    expect("qdot> ");
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
    expect("qdot> ");
    type("print 17 + 4\r");
    expect("21");
    leave_by_ctrl_d();
    text = history();
    assert_non_null(strstr(text, "print 17 + 4\n"));
    free(text);

    start("-q");
    expect("qdot> ");
    type("\x10"); /* Ctrl-P: the line before */
    expect("print 17 + 4");
    type("0\r");
    expect("57");
    leave_by_ctrl_d();
}

/* Line ends are those of the terminal. */
static void
formulas_are_drawn_to_the_width_of_the_terminal(void **state)
{
    (void)state;
    setenv("LC_ALL", "C.UTF-8", 1);
    start("-q");
    expect("qdot> ");
    type("param a, b, c\r");
    expect("qdot> ");
    type("(a + b)/c\r");
    expect("a + b\r\n");
    expect("─────\r\n");
    expect("  c\r\n");
    type("style flat\r");
    expect("qdot> ");
    type("1/(b + a)\r");
    expect("1/(a + b)\r\n");
    type("style unicode; expand((a + b + c)^30)\r");
    expect("... 20 of ");
    expect("to \"all.txt\"` writes all of it");
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
        cmocka_unit_test(formulas_are_drawn_to_the_width_of_the_terminal),
    };

    return cmocka_run_group_tests(tests, enter, leave);
}
