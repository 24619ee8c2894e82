/* test_screen.c -- what is shown on a terminal: its width, its colours. */
#include "src/terminal.h"

#include "base/utf8.h"

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

/* What is typed is shown in its colours, which end before anything is answered. */
static void
input_is_coloured_while_it_is_typed(void **state)
{
    static const char *const terms[] = {"xterm", "xterm", "dumb"}, *const no[] = {"", "1", ""};

    (void)state;
    setenv("LC_ALL", "C.UTF-8", 1);
    for (int i = 0; i < 3; i++) {
        setenv("TERM", terms[i], 1);
        setenv("NO_COLOR", no[i], 1);
        start("-q");
        ready();
        type("print 40 + 2 # why");
        if (i == 0)
            expect("\033[1mprint\033[0m \033[35m40\033[0m + \033[35m2\033[0m "
                   "\033[90m# why\033[0m\0338");
        else
            expect("print 40 + 2 # why");
        type("\r");
        expect("\n42\r\n");
        ready();
        type("print (\"θ\" +\r");
        expect("...> ");
        type(CTRL_C);
        leave_by_ctrl_d();
        assert_true((strstr(seen, "\033[32m\"θ\"\033[0m") != NULL) == (i == 0));
        assert_true((strstr(seen, "\0338") != NULL) == (i == 0));
    }
    setenv("TERM", "dumb", 1);
    setenv("LC_ALL", "C", 1);
    unsetenv("NO_COLOR");
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

/* Ask, and see that no line of the answer is wider than `most`. */
static void
ask_within(size_t n, const char *const *statements, unsigned short most)
{
    for (size_t i = 0; i < n; i++) {
        size_t begin;

        type(statements[i]);
        type("\r");
        expect(statements[i]);
        expect("\n");
        begin = n_read;
        ready();
        is_within(begin, n_read, most);
    }
}

static void
start_narrow(void)
{
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
}

static void
what_is_shown_fits_a_narrow_terminal(void **state)
{
    static const char *const statements[] = {
        "T", "eom", "accel[a]", "inverse(mass_matrix)", "derive", "plot a", "plot p"};

    (void)state;
    if (system("gnuplot --version >/dev/null 2>&1") != 0)
        skip();
    setenv("LC_ALL", "C.UTF-8", 1);
    start_narrow();
    ask_within(sizeof statements / sizeof *statements, statements, 40);
    assert_int_equal(access("qdot-2.svg", R_OK), 0);
    type(CTRL_D);
    finish();
    setenv("LC_ALL", "C", 1);
}

/* Also where TERM is dumb and no letter but ASCII is shown. */
static void
texts_are_broken_at_blanks(void **state)
{
    static const char *const statements[] = {"help",
                                             "help particle",
                                             "help search energy",
                                             "T",
                                             "eom",
                                             "run 0..2",
                                             "table a, b, energy every 1",
                                             "plan",
                                             "V = 3",
                                             "include \"long.lag\"",
                                             "nobody knows",
                                             "scene",
                                             "vars",
                                             "print r, s, r + s, T",
                                             "dof",
                                             "check conserved energy",
                                             "event e: a = 0",
                                             "run 0..3",
                                             "events"};

    (void)state;
    write_file("long.lag", "print \"a word before the place\", a*a*a*a*a*b*b*b*b*nobody + a*b\n");
    start_narrow();
    ask_within(sizeof statements / sizeof *statements, statements, 40);
    type(CTRL_D);
    finish();
    assert_non_null(strstr(seen, "*nobody"));
}

/* A table in two blocks, each with the time. */
static void
wide_tables_are_folded(void **state)
{
    (void)state;
    start_narrow();
    type("table a, a', b every 1\r");
    expect("every 1\r\n");
    expect("a'\r\n");
    expect("\r\n\r\nt  ");
    expect(" b\r\n");
    type(CTRL_D);
    finish();
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

/* The name of an answer, as it was typed, is broken as its value is. */
static void
long_names_are_broken(void **state)
{
    (void)state;
    setenv("LC_ALL", "C.UTF-8", 1);
    columns = 40;
    start("-ecoord a, b; simplify(sin(a)^2 + cos(a)^2 + sqrt(a^2 + b^2) + a - b + sin(b) + 1)");
    columns = 120;
    assert_int_equal(finish(), 0);
    assert_non_null(strstr(seen, "simplify(sin(a)² + cos(a)²"));
    is_within(0, n_seen, 40);
    setenv("LC_ALL", "C", 1);
}

/* Long names and numbers have no blanks: they are cut. The value of a name that is broken has its own line. */
static void
every_width_from_30_is_kept(void **state)
{
    static const char script[] =
        "param the_stiffness_of_the_first_spring > 0, m > 0, J > 0\n"
        "coord the_angle_of_the_pendulum_on_the_left, b\n"
        "lagrangian m*the_angle_of_the_pendulum_on_the_left'^2/2 + J*b'^2/2 - "
        "the_stiffness_of_the_first_spring*the_angle_of_the_pendulum_on_the_left*b\n"
        "3^200\n"
        "sqrt(the_stiffness_of_the_first_spring/m + sqrt((m*the_stiffness_of_the_first_spring - J*m)^2 + m*J))\n"
        "lagrange_function; eom\n"
        "[m, 1/(m*the_stiffness_of_the_first_spring + 1); 3, m*J^(the_stiffness_of_the_first_spring)]\n"
        "set m = 1, J = 2, the_stiffness_of_the_first_spring = 3; start b = 0.1\n"
        "run 0..2\n"
        "value(the_angle_of_the_pendulum_on_the_left*the_angle_of_the_pendulum_on_the_left+b*b*b*b*b,1)\n"
        "table the_angle_of_the_pendulum_on_the_left, the_angle_of_the_pendulum_on_the_left*b every 1\n"
        "vars; scene; derive\n"
        "nobodyhasthisname_nobodyhasthisname_nobodyhasthisname\n";

    (void)state;
    setenv("LC_ALL", "C.UTF-8", 1);
    write_file("long-names.lag", script);
    for (columns = 30; columns <= 100; columns += columns < 60 ? 1 : 7) {
        start("long-names.lag");
        finish();
        assert_non_null(strstr(seen, "nobodyhasthisname"));
        is_within(0, n_seen, columns);
        assert_true(columns < 34 || columns > 60 || strstr(seen, "\n    = 0.023") != NULL);
    }
    columns = 120;
    setenv("LC_ALL", "C", 1);
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
        cmocka_unit_test(colours_are_shown_where_they_may),
        cmocka_unit_test(input_is_coloured_while_it_is_typed),
        cmocka_unit_test(formulas_are_drawn_to_the_width_of_the_terminal),
        cmocka_unit_test(what_is_shown_fits_a_narrow_terminal),
        cmocka_unit_test(texts_are_broken_at_blanks),
        cmocka_unit_test(wide_tables_are_folded),
        cmocka_unit_test(long_names_are_broken),
        cmocka_unit_test(every_width_from_30_is_kept),
        cmocka_unit_test(readme_shows_what_is_seen),
    };

    return cmocka_run_group_tests(tests, enter, leave);
}
