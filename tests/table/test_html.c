/* test_html.c -- a table as a page and as a part of one. */
#include "table/kit.h"

#include <string.h>
#include <unistd.h>

#include "table/html.h"

static const char path[] = "test_html.out"; /* in the folder of the run */

static void
html_is_escaped(void **state)
{
    size_t n;
    char *text;

    (void)state;
    assert_int_equal(qdot_table_html(&data, path), QDOT_OK);
    text = read_back(path, &n);
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
    const qdot_dataset one = {.n = 4, .rows = 1, .columns = all};
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
    failing_memory_is_told_by(qdot_table_html, path);
}

static void
files_that_cannot_be_written_are_told(void **state)
{
    (void)state;
    what_cannot_be_written_is_told_by(qdot_table_html, path);
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
