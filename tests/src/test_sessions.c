/* test_sessions.c -- the conversations of README.md and of the manual's tutorial, typed at a terminal: each line
 * that they show is printed.
 *
 * top_srcdir says where they are. Times, and digits behind the sixth, may differ.
 */
#include <ctype.h>
#include <math.h>

#include "src/terminal.h"

enum { LINES = 300, WIDTH = 400 };

static const char *file;        /* the one at hand */
static char text[LINES][WIDTH]; /* its conversation, as at the terminal */
static size_t n_lines;

static bool
is_prompt(const char *line)
{
    return strncmp(line, "qdot ", 5) == 0 && isdigit((unsigned char)line[5]) &&
           strncmp(line + 5 + strspn(line + 5, "0123456789"), "> ", 2) == 0;
}

static const char *
typed(const char *line)
{
    return strstr(line, "> ") + 2;
}

static FILE *
open_text(void)
{
    char path[4096];
    FILE *f;

    n_lines = 0;
    snprintf(path, sizeof path, "%s/%s", getenv("top_srcdir") != NULL ? getenv("top_srcdir") : ".", file);
    f = fopen(path, "r");
    if (f == NULL)
        fail_msg("top_srcdir must say where %s is", file);
    return f;
}

/* Of Markdown: lines of code behind the first prompt, up to the text that follows, without their four blanks. */
static void
read_markdown(void)
{
    char line[WIDTH];
    bool inside = false;
    FILE *f = open_text();

    while (fgets(line, sizeof line, f) != NULL && n_lines < LINES) {
        line[strcspn(line, "\n")] = '\0';
        if (strncmp(line, "    ", 4) != 0) {
            inside = inside && line[0] == '\0';
            continue;
        }
        inside = inside || is_prompt(line + 4);
        if (inside)
            strcpy(text[n_lines++], line + 4);
    }
    fclose(f);
}

/* Of Texinfo: the examples behind `@c screen`. */
static void
read_texinfo(void)
{
    char line[WIDTH];
    enum { OUTSIDE, MARKED, INSIDE } place = OUTSIDE;
    FILE *f = open_text();

    while (fgets(line, sizeof line, f) != NULL && n_lines < LINES) {
        line[strcspn(line, "\n")] = '\0';
        if (strcmp(line, "@c screen") == 0) {
            place = MARKED;
        } else if (place == MARKED) {
            place = strcmp(line, "@example") == 0 ? INSIDE : OUTSIDE;
        } else if (strcmp(line, "@end example") == 0) {
            place = OUTSIDE;
        } else if (place == INSIDE) {
            char *to = text[n_lines++];

            for (const char *c = line; *c != '\0'; c++)
                if (*c != '@' || strchr("@{}", c[1]) == NULL || c[1] == '\0')
                    *to++ = *c;
                else
                    *to++ = *++c;
            *to = '\0';
        }
    }
    fclose(f);
}

/* --- comparing ---------------------------------------------------------------------------- */

/* Whether a number begins here that is no part of a word. */
static bool
is_number(const char *start, const char *s)
{
    return isdigit((unsigned char)*s) &&
           (s == start || !(isalnum((unsigned char)s[-1]) || s[-1] == '_' || s[-1] == '.'));
}

/* The same words and signs; numbers to six digits, or both as good as 0. */
static bool
same_line(const char *a, const char *b)
{
    const char *a0 = a, *b0 = b;

    if (strstr(a, "cpu ") != NULL || strstr(a, "drift: ") != NULL ||
        strstr(a, "constraints: ") != NULL || strstr(a, " steps, ") != NULL)
        return strncmp(a, b, strcspn(a, "0123456789")) == 0;
    while (*a != '\0' && *b != '\0') {
        const bool negative_zero = (*a == '-') != (*b == '-');

        if (negative_zero && isdigit((unsigned char)a[*a == '-']) &&
            fabs(strtod(a, NULL)) < 1e-12) { /* -3e-16 is 1e-16 */
            a += *a == '-';
            b += *b == '-';
        }
        if (is_number(a0, a) && is_number(b0, b)) {
            char *a1, *b1;
            const double x = strtod(a, &a1), y = strtod(b, &b1);
            const bool tiny = fabs(x) < 1e-4 && fabs(y) < 1e-4;

            if (!tiny && fabs(x - y) > 2e-5 * fabs(x))
                return false;
            a = a1;
            b = b1;
        } else if (*a++ != *b++) {
            return false;
        }
    }
    return *a == *b;
}

/* --- the sessions ------------------------------------------------------------------------- */

/* What came since the last prompt holds the lines [from, to), one after another. */
static void
compare(const char *answer, size_t from, size_t to)
{
    char line[WIDTH];

    for (size_t i = from; i < to; i++) {
        bool found = false;

        while (!found && *answer != '\0') {
            size_t n = strcspn(answer, "\r\n");

            snprintf(line, sizeof line, "%.*s", (int)n, answer);
            answer += n;
            answer += strspn(answer, "\r\n");
            found = same_line(text[i], line);
        }
        if (!found)
            fail_msg("%s says `%s`; what came: %s", file, text[i], seen);
    }
}

/* Type what is behind the prompts, and compare. */
static void
converse(void)
{
    size_t answers = 0;

    setenv("LC_ALL", "C.UTF-8", 1);
    start("-q");
    ready();
    for (size_t i = 0, next; i < n_lines; i = next) {
        size_t before;

        for (next = i + 1; next < n_lines && !is_prompt(text[next]);)
            next++;
        type(typed(text[i]));
        type("\r");
        before = n_read;
        ready();
        compare(seen + before, i + 1, next);
        answers += next - i - 1;
    }
    type(CTRL_D);
    assert_int_equal(finish(), 0);
    assert_true(n_lines > 20 && answers > 20);
}

static void
readme_is_what_the_program_says(void **state)
{
    (void)state;
    file = "README.md";
    read_markdown();
    converse();
}

static void
tutorial_is_what_the_program_says(void **state)
{
    const unsigned short usual = columns;

    (void)state;
    file = "doc/tutorial.texi";
    read_texinfo();
    columns = 80;
    converse();
    columns = usual;
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(readme_is_what_the_program_says),
        cmocka_unit_test(tutorial_is_what_the_program_says),
    };

    return cmocka_run_group_tests(tests, enter, leave);
}
