/* test_hdf5.c -- a table as HDF5: what stands in the file, read back, and failures. */
#include "table/kit.h"

#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/interrupt.h"
#include "table/hdf5-read.h"
#include "table/hdf5.h"

static const char path[] = "test_hdf5.out"; /* in the folder of the run */

static uint64_t
number(const char *at, int bytes)
{
    uint64_t sum = 0;

    for (int i = bytes; i-- > 0;)
        sum = sum << 8 | (unsigned char)at[i];
    return sum;
}

static void
hdf5_ends_where_it_says(void **state)
{
    const char name[] = "a\u2215b < c";
    size_t n;
    char *bytes;
    double last;

    (void)state;
    assert_int_equal(qdot_table_hdf5(&data, path), QDOT_OK);
    bytes = read_back(path, &n);
    assert_memory_equal(bytes, "\211HDF\r\n\032\n\2\10\10", 11);
    assert_int_equal(number(bytes + 28, 8), n);
    assert_int_equal(number(bytes + 36, 8), 48);
    assert_memory_equal(bytes + 48, "OHDR", 4);
    assert_non_null(memmem(bytes, n, name, sizeof name - 1));
    assert_non_null(memmem(bytes, n, "t (3)", 5));
    memcpy(&last, bytes + n - 8, 8);
    assert_true(last == -1e-300);
    free(bytes);
}

static qdot_status
read_columns(qdot_hdf5_columns *c)
{
    *c = (qdot_hdf5_columns){0};
    return qdot_hdf5_read(path, "program", c);
}

static void
put(const char *bytes, size_t n)
{
    FILE *f = fopen(path, "wb");

    assert_non_null(f);
    assert_int_equal(fwrite(bytes, 1, n, f), n);
    fclose(f);
}

static void
hdf5_is_read_back(void **state)
{
    qdot_hdf5_columns c;
    size_t n;
    char *bytes;

    (void)state;
    assert_int_equal(qdot_table_hdf5(&data, path), QDOT_OK);
    assert_int_equal(read_columns(&c), QDOT_OK);
    assert_int_equal(c.at.n, 3);
    assert_int_equal(c.rows, data.rows);
    for (size_t j = 0; j < c.at.n; j++)
        for (size_t i = 0; i < c.rows; i++) {
            const double x = qdot_hdf5_number(&c.at.at[j], i), y = qdot_table_at(&data, i, j < 2 ? j : 3).value;

            assert_memory_equal(&x, &y, sizeof x);
        }
    assert_string_equal(qdot_text_str(&c.text), facts[0].text);
    qdot_hdf5_columns_clear(&c);

    /* cut anywhere it is refused; with any byte changed it is read or refused */
    bytes = read_back(path, &n);
    for (size_t k = 0; k < n; k++) {
        put(bytes, k);
        assert_int_equal(read_columns(&c), QDOT_EINVAL);
        qdot_hdf5_columns_clear(&c);
    }
    for (size_t k = 0; k < n; k++)
        for (int bit = 0; bit < 8; bit += 7) {
            qdot_status status;

            bytes[k] ^= (char)(1 << bit);
            put(bytes, n);
            status = read_columns(&c);
            assert_true(status == QDOT_OK || status == QDOT_EINVAL || status == QDOT_ENOMEM);
            qdot_hdf5_columns_clear(&c);
            bytes[k] ^= (char)(1 << bit);
        }
    free(bytes);
}

/* Texts are as long as the longest of their column, none is empty. */
static void
texts_are_read_back(void **state)
{
    char fold[] = "fold", saddle[] = "saddle-node", *types[] = {fold, NULL, saddle};
    qdot_table_column all[] = {{.name = "t", .values = t}, {.name = "type", .kind = QDOT_CELL_TEXT, .texts = types}};
    const qdot_dataset some = {.n = 2, .rows = 3, .columns = all, .n_facts = 2, .facts = facts};
    qdot_hdf5_columns c;

    (void)state;
    assert_int_equal(qdot_table_hdf5(&some, path), QDOT_OK);
    assert_int_equal(read_columns(&c), QDOT_OK);
    assert_int_equal(c.at.n, 2);
    assert_int_equal(c.at.at[0].size, 0);
    assert_int_equal(c.at.at[1].size, sizeof "saddle-node");
    for (size_t i = 0; i < 3; i++)
        assert_string_equal(c.at.at[1].bytes + i * c.at.at[1].size, types[i] != NULL ? types[i] : "");
    qdot_hdf5_columns_clear(&c);
}

/* A device without an end and a pipe that nobody writes are refused; Ctrl-C is heard. */
static void
only_regular_files_are_read(void **state)
{
    qdot_hdf5_columns c = {0};

    (void)state;
    assert_int_equal(qdot_hdf5_read("/dev/zero", "program", &c), QDOT_EIO);
    (void)unlink(path);
    assert_int_equal(mkfifo(path, 0600), 0);
    assert_int_equal(read_columns(&c), QDOT_EIO);
    (void)unlink(path);
    assert_int_equal(qdot_table_hdf5(&data, path), QDOT_OK);
    qdot_interrupt_set_at(0);
    assert_int_equal(read_columns(&c), QDOT_EINTR);
    qdot_interrupt_clear();
    qdot_hdf5_columns_clear(&c);
}

static void
failing_memory_is_told(void **state)
{
    (void)state;
    failing_memory_is_told_by(qdot_table_hdf5, path);
}

static void
files_that_cannot_be_written_are_told(void **state)
{
    (void)state;
    what_cannot_be_written_is_told_by(qdot_table_hdf5, path);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(hdf5_ends_where_it_says),
        cmocka_unit_test(hdf5_is_read_back),
        cmocka_unit_test(texts_are_read_back),
        cmocka_unit_test(only_regular_files_are_read),
        cmocka_unit_test(failing_memory_is_told),
        cmocka_unit_test(files_that_cannot_be_written_are_told),
    };
    int failed = cmocka_run_group_tests(tests, NULL, NULL);

    unlink(path);
    return failed;
}
