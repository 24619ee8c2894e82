/* kit.h -- the table that writers of files are tested with, and what each of them must do. */
#ifndef QDOT_TESTS_TABLE_KIT_H
#define QDOT_TESTS_TABLE_KIT_H

#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/memory.h"
#include "table/table.h"

static const double t[3] = {0, 0.5, 1}, x[3] = {2.385, NAN, -1e-300};
static qdot_table_column columns[4] = {{.name = "t", .values = t},
                                       {.name = "a/b < c", .values = x},
                                       {.name = "hidden", .in = QDOT_IN_TERMINAL | QDOT_IN_ANSWERS, .values = t},
                                       {.name = "t", .values = x}};
static const qdot_table_fact facts[2] = {{"program", "q & \"p\"", 0}, {"tol", NULL, 0.25}},
                             parameters[1] = {{"m[1]", NULL, 2.5}};
static const qdot_dataset data = {.title = "a table",
                                .n = 4,
                                .rows = 3,
                                .columns = columns,
                                .n_facts = 2,
                                .n_parameters = 1,
                                .facts = facts,
                                .parameters = parameters};

/* The bytes of the file, to be freed; *n of them. */
static inline char *
read_back(const char *path, size_t *n)
{
    FILE *file = fopen(path, "rb");
    char *bytes = calloc(1, 100000);

    assert_non_null(file);
    assert_non_null(bytes);
    *n = fread(bytes, 1, 99999, file);
    fclose(file);
    return bytes;
}

typedef qdot_status writer_of_file(const qdot_dataset *table, const char *path);

/* Let memory run out at the first, second, ... allocation until none is left to fail. */
static inline void
failing_memory_is_told_by(writer_of_file *write, const char *path)
{
    for (int64_t n = 0;; n++) {
        qdot_status status;

        qdot_memory_fail_at(n);
        status = write(&data, path);
        qdot_memory_fail_at(-1);
        if (status == QDOT_OK) {
            assert_true(n > 0);
            break;
        }
        assert_int_equal(status, QDOT_ENOMEM);
    }
}

static inline void
what_cannot_be_written_is_told_by(writer_of_file *write, const char *path)
{
    const qdot_dataset empty = {.title = ""};

    assert_int_equal(write(&data, "/nowhere/file"), QDOT_EIO);
    assert_int_equal(write(&empty, path), QDOT_EINVAL);
}

#endif
