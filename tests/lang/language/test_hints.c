/* test_hints.c -- forms of other systems and slips of the pen: the hint that each gets, and that
 * the line which it shows works. */
#include <unistd.h>

#include "lang/talk.h"

#define NOTHING ""
#define SWING                                                                            \
    "param m, k, g, L1; coord theta, x, y; particle bob mass m at (x, y)\n"              \
    "particle pen mass m at (L1*sin(theta), -L1*cos(theta)); potential k*x^2/2\n"
#define VALUES SWING "set m = 1, k = 2, L1 = 1, g = 9.81; start theta = 1\n"
#define RUN VALUES "run 0..20 tol 1e-6\n"

static const struct {
    const char *scene;
    unsigned column;
    const char *input, *hint, *line;
    bool runs;
} rows[] = {
#define RUNS(scene, column, input, hint, line) {scene, column, input, hint, line, true},
#define SHOWS(scene, column, input, hint, line) {scene, column, input, hint, line, false},
#define LEAVES(scene, column, input, hint) {scene, column, input, hint, NULL, false},
#include "lang/hints.def"
#include "lang/hints-calls.def"
};
enum { ROWS = sizeof rows / sizeof *rows };

/* A session in which the row's scene was declared. */
static talk *
talk_of(size_t i)
{
    void *state = NULL;

    if (begin(&state) != 0)
        fail_msg("no session");
    if (say(state, rows[i].scene) != 0)
        fail_msg("the scene of `%s` fails: %s", rows[i].input, complaint(state));
    heard(state);
    complaint(state);
    return state;
}

static void
every_input_gets_its_hint(void **state)
{
    char place[24];

    (void)state;
    for (size_t i = 0; i < ROWS; i++) {
        void *k = talk_of(i);
        const char *said, *hint;

        if (say(k, rows[i].input) == 0)
            fail_msg("`%s` is accepted", rows[i].input);
        said = complaint(k);
        snprintf(place, sizeof place, "test:1:%u: error: ", rows[i].column);
        if (strncmp(said, place, strlen(place)) != 0)
            fail_msg("`%s`: not at column %u: %s", rows[i].input, rows[i].column, said);
        hint = strstr(said, "  hint: ");
        hint = hint != NULL ? hint + strlen("  hint: ") : "";
        if (strlen(hint) != strlen(rows[i].hint) + (*hint != '\0') ||
            strncmp(hint, rows[i].hint, strlen(rows[i].hint)) != 0)
            fail_msg("`%s`: the hint is not `%s`: %s", rows[i].input, rows[i].hint, said);
        end(&k);
    }
}

static void
every_line_shown_works(void **state)
{
    (void)state;
    for (size_t i = 0; i < ROWS; i++) {
        void *k;

        if (rows[i].line == NULL)
            continue;
        if (strstr(rows[i].hint, rows[i].line) == NULL)
            fail_msg("`%s`: its hint does not show `%s`", rows[i].input, rows[i].line);
        if (!rows[i].runs)
            continue;
        k = talk_of(i);
        if (say(k, rows[i].line) != 0)
            fail_msg("`%s` leads to `%s`, which fails: %s", rows[i].input, rows[i].line,
                     complaint(k));
        end(&k);
    }
}

static void
nineteen_of_twenty_name_a_line(void **state)
{
    size_t named = 0, run = 0;

    (void)state;
    for (size_t i = 0; i < ROWS; i++) {
        named += rows[i].line != NULL;
        run += rows[i].runs;
    }
    assert_true(ROWS >= 120);
    assert_true(20 * named >= 19 * ROWS);
    assert_true(run >= 120);
}

/* Lines that are carried out write figures and tables. */
static char folder[] = "qdot-hints-XXXXXX";

static int
enter(void **state)
{
    (void)state;
    return mkdtemp(folder) != NULL && chdir(folder) == 0 ? 0 : -1;
}

static int
leave(void **state)
{
    (void)state;
    return chdir("..") == 0 && system("rm -r qdot-hints-??????") == 0 ? 0 : -1;
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_input_gets_its_hint),
        cmocka_unit_test(every_line_shown_works),
        cmocka_unit_test(nineteen_of_twenty_name_a_line),
    };

    return cmocka_run_group_tests(tests, enter, leave);
}
