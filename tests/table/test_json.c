/* test_json.c -- a table as rows of JSON and as a file of JSON. */
#include "table/kit.h"

#include <string.h>
#include <unistd.h>

#include "table/json.h"

static const char path[] = "test_json.out"; /* in the folder of the run */

static void
json_has_facts_and_rows(void **state)
{
    size_t n;
    char *text;

    (void)state;
    assert_int_equal(qdot_table_json(&data, path), QDOT_OK);
    text = read_back(path, &n);
    assert_string_equal(text, "{\"program\":\"q & \\\"p\\\"\",\"tol\":0.25,\n"
                              "\"parameters\":{\"m[1]\":2.5},\n"
                              "\"columns\":[\"t\",\"a/b < c\",\"t\"],\n\"rows\":[\n"
                              "[0,2.385,2.385],\n"
                              "[0.5,null,null],\n"
                              "[1,-1e-300,-1e-300]]}\n");
    free(text);
}

/* Rows as answers: fields before and behind the values; errors where a column is measured. */
static void
rows_are_answers(void **state)
{
    const double values[] = {0.5, 1.25}, errors[] = {0, 3e-13}, stable[] = {1, NAN};
    char fold[] = "fold", failed[] = "no \"end\"", long_digits[] = "0.1234567890123456789";
    char *types[] = {fold, NULL}, *reasons[] = {NULL, failed}, *digits[] = {long_digits, NULL};
    qdot_table_column all[] = {
        {.name = "type", .kind = QDOT_CELL_TEXT, .field = "type", .texts = types},
        {.name = "x", .values = values, .errors = errors, .measured = true},
        {.name = "in files alone", .in = QDOT_IN_DATA, .values = values},
        {.name = "y", .values = values, .texts = digits},
        {.name = "z", .kind = QDOT_CELL_TEXT, .texts = digits},
        {.name = "stable", .kind = QDOT_CELL_FLAG, .field = "stable", .values = stable},
        {.name = "status", .kind = QDOT_CELL_TEXT, .field = "status", .texts = reasons,
         .present = "failed", .absent = "done"},
        {.name = "reason", .kind = QDOT_CELL_TEXT, .field = "reason", .texts = reasons}};
    const size_t order[] = {1, 0};
    qdot_dataset rows = {.name = "curve", .n = 8, .rows = 2, .columns = all};
    qdot_text out = {0};

    (void)state;
    qdot_table_json_columns(&rows, "table", &out);
    assert_string_equal(qdot_text_str(&out),
                        "{\"kind\":\"columns\",\"name\":\"curve\",\"columns\":[\"x\",\"y\",\"z\"]}\n");
    qdot_text_truncate(&out, 0);
    all[3].unit = "m/s";
    qdot_table_json_columns(&rows, "table", &out);
    assert_string_equal(qdot_text_str(&out), "{\"kind\":\"columns\",\"name\":\"curve\",\"columns\":[\"x\",\"y\",\"z\"],"
                                             "\"units\":[null,\"m/s\",null]}\n");
    qdot_text_truncate(&out, 0);
    qdot_table_json_row(&rows, 0, &out);
    qdot_table_json_row(&rows, 1, &out);
    assert_string_equal(qdot_text_str(&out),
                        "{\"kind\":\"row\",\"name\":\"curve\",\"type\":\"fold\",\"values\":[0.5,0.1234567890123456789,"
                        "\"0.1234567890123456789\"],\"errors\":[0,null,null],\"stable\":true,\"status\":\"done\","
                        "\"reason\":null}\n"
                        "{\"kind\":\"row\",\"name\":\"curve\",\"type\":null,\"values\":[1.25,1.25,null],"
                        "\"errors\":[3e-13,null,null],\"stable\":null,\"status\":\"failed\","
                        "\"reason\":\"no \\\"end\\\"\"}\n");
    qdot_text_truncate(&out, 0);
    rows = (qdot_dataset){.n = 1, .rows = 2, .columns = columns, .order = order};
    qdot_table_json_row(&rows, 0, &out);
    assert_string_equal(qdot_text_str(&out), "{\"kind\":\"row\",\"values\":[0.5]}\n");
    qdot_text_clear(&out);
}

static void
failing_memory_is_told(void **state)
{
    (void)state;
    failing_memory_is_told_by(qdot_table_json, path);
}

static void
files_that_cannot_be_written_are_told(void **state)
{
    (void)state;
    what_cannot_be_written_is_told_by(qdot_table_json, path);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(json_has_facts_and_rows),
        cmocka_unit_test(rows_are_answers),
        cmocka_unit_test(failing_memory_is_told),
        cmocka_unit_test(files_that_cannot_be_written_are_told),
    };
    int failed = cmocka_run_group_tests(tests, NULL, NULL);

    unlink(path);
    return failed;
}
