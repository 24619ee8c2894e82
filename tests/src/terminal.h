/* terminal.h -- a program at a pseudo-terminal, as a person meets it. For one test program each.
 *
 * QDOT is the program.
 */
#ifndef QDOT_TESTS_TERMINAL_H
#define QDOT_TESTS_TERMINAL_H

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

/* For cmocka_run_group_tests: a folder of its own; TERM, LC_ALL and PAGER are plain. */
static inline int
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

static inline int
leave(void **state)
{
    char command[64];

    (void)state;
    snprintf(command, sizeof command, "rm -r %s", folder);
    return chdir("..") == 0 && system(command) == 0 ? 0 : -1;
}

/* Start the program with an option, as wide as `columns`. */
static inline void
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

/* As if typed; \r is the key that ends a line. */
static inline void
type(const char *text)
{
    assert_int_equal(write(terminal, text, strlen(text)), (ssize_t)strlen(text));
}

/* Wait until `text` comes behind what was read before, and read on to its end. */
static inline void
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

/* A file in the folder of the test. */
static inline void
write_file(const char *name, const char *text)
{
    FILE *f = fopen(name, "w");

    assert_non_null(f);
    fputs(text, f);
    assert_int_equal(fclose(f), 0);
}

/* Wait for the prompt. */
static inline void
ready(void)
{
    expect("qdot ");
    expect("> ");
}

/* Read to the end of the program; its raw status. */
static inline int
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

static inline void
leave_by_ctrl_d(void)
{
    int status;

    ready();
    type(CTRL_D);
    status = finish();
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
        fail_msg("status %d; what came: %s", status, seen);
}

#endif
