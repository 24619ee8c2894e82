/* test_html.c -- a table as a page and as a part of one. */
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/memory.h"
#include "table/html.h"

static const double t[3] = {0, 0.5, 1}, x[3] = {2.385, NAN, -1e-300};
static qdot_table_column columns[4] = {{.name = "t", .values = t},
                                       {.name = "a/b < c", .values = x},
                                       {.name = "hidden", .in = QDOT_IN_TERMINAL | QDOT_IN_ANSWERS, .values = t},
                                       {.name = "t", .values = x}};
static const qdot_table_fact facts[2] = {{"program", "q & \"p\"", 0}, {"tol", NULL, 0.25}},
                             parameters[1] = {{"m[1]", NULL, 2.5}};
static const qdot_table data = {.title = "a table",
                                .n = 4,
                                .rows = 3,
                                .columns = columns,
                                .n_facts = 2,
                                .n_parameters = 1,
                                .facts = facts,
                                .parameters = parameters};

static const char path[] = "test_html.out"; /* in the folder of the run */

/* The file's bytes, to be freed; *n of them. */
static char *
read_back(size_t *n)
{
    FILE *file = fopen(path, "rb");
    char *bytes = calloc(1, 100000);

    assert_non_null(file);
    assert_non_null(bytes);
    *n = fread(bytes, 1, 99999, file);
    fclose(file);
    return bytes;
}

static void
html_is_escaped(void **state)
{
    size_t n;
    char *text;

    (void)state;
    assert_int_equal(qdot_table_html(&data, path), QDOT_OK);
    text = read_back(&n);
    assert_non_null(strstr(text, "<dt>program</dt><dd>q &amp; \"p\"</dd>"));
    assert_non_null(strstr(text, "<th>t</th><th>a/b &lt; c</th><th>t</th>"));
    assert_non_null(strstr(text, "<tr><td>0</td><td>2.385</td><td>2.385</td></tr>"));
    free(text);
}

/* As a part of a page, with the heads and the forms that people read, and a dash where there is no number. */
static void
a_part_is_what_people_read(void **state)
{
    char word[] = "<run>", *names[] = {word};
    const double none[] = {NAN}, half[] = {0.5}, error[] = {0.25};
    qdot_table_column all[] = {{.name = "run", .kind = QDOT_CELL_TEXT, .texts = names},
                               {.name = "tol", .head = "a & b", .values = none, .form = QDOT_NUMBER_BOUND},
                               {.name = "x", .values = half, .errors = error, .form = QDOT_NUMBER_MEASURED},
                               {.name = "data", .values = half, .in = QDOT_IN_DATA}};
    const qdot_table one = {.n = 4, .rows = 1, .columns = all};
    qdot_text out = {0};

    (void)state;
    assert_int_equal(qdot_table_html_part(&one, &out), QDOT_OK);
    assert_string_equal(qdot_text_str(&out), "<table>\n<tr><th>run</th><th>a &amp; b</th><th>x</th></tr>\n"
                                             "<tr><td>&lt;run&gt;</td><td>\u2013</td><td>0.5</td></tr>\n</table>\n");
    qdot_text_clear(&out);
}

static void
failing_memory_is_told(void **state)
{
    (void)state;
    for (long n = 0;; n++) {
        qdot_status status;

        qdot_memory_fail_at(n);
        status = qdot_table_html(&data, path);
        qdot_memory_fail_at(-1);
        if (status == QDOT_OK) {
            assert_true(n > 0);
            break;
        }
        assert_int_equal(status, QDOT_ENOMEM);
    }
}

static void
files_that_cannot_be_written_are_told(void **state)
{
    const qdot_table empty = {.title = ""};

    (void)state;
    assert_int_equal(qdot_table_html(&data, "/nowhere/x.html"), QDOT_EIO);
    assert_int_equal(qdot_table_html(&empty, path), QDOT_EINVAL);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(html_is_escaped),
        cmocka_unit_test(a_part_is_what_people_read),
        cmocka_unit_test(failing_memory_is_told),
        cmocka_unit_test(files_that_cannot_be_written_are_told),
    };
    int failed = cmocka_run_group_tests(tests, NULL, NULL);

    unlink(path);
    return failed;
}
