/* test_options.c -- the program's options, its exit statuses, scripts in their order.
 *
 * QDOT is the program.
 */
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <cmocka.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

enum { MOST = 1 << 16 };

static char folder[] = "qdot-options-XXXXXX";
static char said[MOST]; /* what the latest command wrote, both streams */

static int
enter(void **state)
{
    (void)state;
    if (getenv("QDOT") == NULL) {
        fputs("QDOT must say where the program is\n", stderr);
        return -1;
    }
    return mkdtemp(folder) != NULL && chdir(folder) == 0 ? 0 : -1;
}

static int
leave(void **state)
{
    (void)state;
    remove("a.lag");
    remove("b.lag");
    return chdir("..") == 0 && rmdir(folder) == 0 ? 0 : -1;
}

/* Run `"$QDOT" arguments` by the shell; its exit status. */
static int
run(const char *arguments)
{
    char command[4096];
    size_t n;
    FILE *pipe;
    int status;

    snprintf(command, sizeof command, "exec 2>&1 </dev/null; \"$QDOT\" %s", arguments);
    pipe = popen(command, "r");
    assert_non_null(pipe);
    n = fread(said, 1, MOST - 1, pipe);
    said[n] = '\0';
    status = pclose(pipe);
    assert_true(WIFEXITED(status));
    return WEXITSTATUS(status);
}

static void
write_file(const char *path, const char *text)
{
    FILE *f = fopen(path, "w");

    assert_non_null(f);
    fputs(text, f);
    fclose(f);
}

static void
version_and_help_are_printed(void **state)
{
    static const char *const options[] = {"-e",          "-i",     "--json",   "-q",
                                          "--processor", "--help", "--version"};

    (void)state;
    assert_int_equal(run("--version"), 0);
    assert_memory_equal(said, "qdot ", 5);
    assert_non_null(strstr(said, "GPL"));
    assert_int_equal(run("--help"), 0);
    assert_memory_equal(said, "Usage: qdot ", 12);
    for (size_t i = 0; i < sizeof options / sizeof *options; i++)
        assert_non_null(strstr(said, options[i]));
    assert_int_equal(run("-V"), 0);
    assert_memory_equal(said, "qdot ", 5);
    assert_int_equal(run("-h"), 0);
    assert_memory_equal(said, "Usage: qdot ", 12);
    /* whatever else there is */
    assert_int_equal(run("--version -e '1/0'"), 0);
}

static void
bad_usage_is_status_2(void **state)
{
    (void)state;
    assert_int_equal(run("--nonsense"), 2);
    assert_non_null(strstr(said, "nonsense"));
    assert_non_null(strstr(said, "--help"));
    assert_int_equal(run("-e"), 2);
    assert_int_equal(run("-q -x"), 2);
    assert_int_equal(run("--processor"), 2);
    assert_int_equal(run("--processor=sse"), 2);
    assert_non_null(strstr(said, "any, avx2 or avx512"));
    assert_non_null(strstr(said, "--help"));
}

static void
exit_status_says_what_happened(void **state)
{
    static const struct {
        const char *statements;
        int status;
    } all[] = {
        {"1 + 1", 0},
        {"check 1 == 1", 0},
        {"check not 1 == 2", 0},
        {"", 0},
        {"# nothing", 0},
        {"1/0", 1},
        {"nobody", 1},
        {"check 1 == 2", 1},
        {"check not 1 == 1", 1},
        {"(1 +", 2},
        {"1 +* 2", 2},
        {"quit", 0},
        {"check 1 == 2; quit", 1},
    };
    char arguments[200];

    (void)state;
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        snprintf(arguments, sizeof arguments, "-q -e '%s'", all[i].statements);
        if (run(arguments) != all[i].status)
            fail_msg("`%s` does not exit with %d", all[i].statements, all[i].status);
    }
    assert_int_equal(run("-q nowhere.lag"), 1);
    assert_int_equal(run("-q ."), 1);
}

static void
tasks_share_a_session_in_their_order(void **state)
{
    const char *first, *second, *third;

    (void)state;
    write_file("a.lag", "print \"second\", a + 1\na = 20\n");
    write_file("b.lag", "print \"third\", a + 2\n");
    assert_int_equal(run("-q -e 'a = 10; print \"first\"' a.lag b.lag"), 0);
    first = strstr(said, "first");
    second = strstr(said, "second");
    third = strstr(said, "third");
    assert_non_null(first);
    assert_true(second > first && third > second);
    assert_non_null(strstr(second, "11"));
    assert_non_null(strstr(third, "22"));
    /* options may stand between, and names that look like options behind -- */
    assert_int_equal(run("a.lag -q -e 'a = 1'"), 1);
    assert_int_equal(run("-e 'a = 1' -q -- a.lag"), 0);
}

static void
the_first_failure_ends_it(void **state)
{
    (void)state;
    assert_int_equal(run("-q -e '1/0' -e 'print \"second\"'"), 1);
    assert_null(strstr(said, "second"));
    assert_int_equal(run("-q -e 'check 1 == 2; print \"on\"' -e 'print \"second\"'"), 1);
    /* a refuted check only makes the exit status 1 */
    assert_non_null(strstr(said, "on"));
    assert_non_null(strstr(said, "second"));
    assert_int_equal(run("-q -e 'quit' -e 'print \"second\"'"), 0);
    assert_null(strstr(said, "second"));
}

static void
standard_input_is_a_script(void **state)
{
    (void)state;
    assert_int_equal(run("<<'END'\nprint \"piped\", 6*7\nEND\n"), 0);
    assert_non_null(strstr(said, "42"));
    assert_null(strstr(said, "qdot>"));
    assert_int_equal(run("-e 'a = 6' - <<'END'\nprint a*7\nEND\n"), 0);
    assert_non_null(strstr(said, "42"));
    assert_int_equal(run("-i -e 'a = 6' <<'END'\nprint a*7\nEND\n"), 0);
    assert_non_null(strstr(said, "42"));
    assert_int_equal(run("<<'END'\n1/0\nEND\n"), 1);
}

/* A line that begins with { and ends with }, the kind it has, and nothing else. */
static void
json_is_one_object_a_line(void **state)
{
    size_t lines = 0;

    (void)state;
    assert_int_equal(
        run("--json -e 'param m > 0; coord x; particle b mass m at x; T; eom; "
            "check T == m*x_; ' 2>/dev/null"),
        1);
    for (char *line = strtok(said, "\n"); line != NULL;
         line = strtok(NULL, "\n"), lines++) {
        assert_memory_equal(line, "{\"kind\":\"", 9);
        assert_int_equal(line[strlen(line) - 1], '}');
    }
    assert_int_equal(lines, 3);
}

static void
lost_output_is_a_failure(void **state)
{
    (void)state;
    if (access("/dev/full", W_OK) != 0)
        skip();
    assert_int_equal(run("-q -e '1 + 1' >/dev/full"), 1);
    assert_int_equal(run("--help >/dev/full"), 1);
    assert_non_null(strstr(said, "No space left"));
}

/* Numbers are written with a point whatever the locale; no terminal: plain. */
static void
output_off_a_terminal_is_plain(void **state)
{
    (void)state;
    assert_int_equal(run("-q -e 'coord θ; print θ^2/2'"), 0);
    assert_string_equal(said, "1/2*theta^2\n");
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(version_and_help_are_printed),
        cmocka_unit_test(bad_usage_is_status_2),
        cmocka_unit_test(exit_status_says_what_happened),
        cmocka_unit_test(tasks_share_a_session_in_their_order),
        cmocka_unit_test(the_first_failure_ends_it),
        cmocka_unit_test(standard_input_is_a_script),
        cmocka_unit_test(json_is_one_object_a_line),
        cmocka_unit_test(lost_output_is_a_failure),
        cmocka_unit_test(output_off_a_terminal_is_plain),
    };

    return cmocka_run_group_tests(tests, enter, leave);
}
