/* A file is written whole or not at all; what was there before stays until then. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/memory.h"
#include "base/sink.h"
#include "own-folder.h"

static int
enter(void **state)
{
    (void)state;
    (void)signal(SIGXFSZ, SIG_IGN);
    return own_folder_enter(state);
}

static void
assert_holds(const char *path, const char *text)
{
    char seen[64] = {0};
    FILE *file = fopen(path, "rb");

    assert_non_null(file);
    (void)!fread(seen, 1, sizeof seen - 1, file);
    fclose(file);
    assert_string_equal(seen, text);
}

static void
an_abandoned_file_leaves_the_old_one(void **state)
{
    qdot_sink sink;

    (void)state;
    assert_int_equal(qdot_sink_write("a", "old", 3), QDOT_OK);
    assert_int_equal(qdot_sink_open(&sink, "a"), QDOT_OK);
    assert_int_equal(qdot_sink_put(&sink, "new", 3), QDOT_OK);
    assert_holds("a", "old");
    qdot_sink_abandon(&sink);
    assert_holds("a", "old");
    assert_int_equal(own_folder_clean(NULL), 1);
}

static void
a_full_disk_leaves_the_old_one(void **state)
{
    static char much[1 << 16];
    struct rlimit before, little;

    (void)state;
    assert_int_equal(qdot_sink_write("a", "old", 3), QDOT_OK);
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &before), 0);
    little = (struct rlimit){4096, before.rlim_max};
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &little), 0);
    assert_int_equal(qdot_sink_write("a", much, sizeof much), QDOT_EIO);
    assert_int_equal(qdot_sink_write("b", much, sizeof much), QDOT_EIO);
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &before), 0);
    assert_holds("a", "old");
    assert_int_equal(own_folder_clean(NULL), 1);
}

static void
permissions_and_links_stay(void **state)
{
    struct stat st;

    (void)state;
    assert_int_equal(qdot_sink_write("a", "old", 3), QDOT_OK);
    assert_int_equal(chmod("a", 0640), 0);
    assert_int_equal(symlink("a", "link"), 0);
    assert_int_equal(qdot_sink_write("link", "new", 3), QDOT_OK);
    assert_holds("a", "new");
    assert_int_equal(lstat("link", &st), 0);
    assert_true(S_ISLNK(st.st_mode));
    assert_int_equal(stat("a", &st), 0);
    assert_int_equal(st.st_mode & 0777, 0640);
    assert_int_equal(own_folder_clean(NULL), 2);
}

static void
what_is_no_file_is_written_as_it_is(void **state)
{
    (void)state;
    assert_int_equal(qdot_sink_write("/dev/null", "x", 1), QDOT_OK);
    assert_int_equal(qdot_sink_write(".", "x", 1), QDOT_EIO);
    assert_int_equal(qdot_sink_write("none/a", "x", 1), QDOT_EIO);
    assert_int_equal(qdot_sink_write("", "x", 1), QDOT_EINVAL);
    assert_int_equal(own_folder_clean(NULL), 0);
}

static void
only_marked_files_are_free(void **state)
{
    (void)state;
    assert_true(qdot_sink_is_free("a", "# mark"));
    assert_int_equal(qdot_sink_write("a", "# mark 1", 8), QDOT_OK);
    assert_true(qdot_sink_is_free("a", "# mark"));
    assert_int_equal(qdot_sink_write("a", "# ma", 4), QDOT_OK);
    assert_false(qdot_sink_is_free("a", "# mark"));
    assert_int_equal(mkfifo("pipe", 0600), 0); /* it is not waited for */
    assert_false(qdot_sink_is_free("pipe", "# mark"));
    assert_int_equal(own_folder_clean(NULL), 2);
}

static void
failing_memory_leaves_the_old_one(void **state)
{
    qdot_status status = QDOT_ENOMEM;

    (void)state;
    assert_int_equal(qdot_sink_write("a", "old", 3), QDOT_OK);
    for (int64_t n = 0; status != QDOT_OK; n++) {
        assert_holds("a", "old");
        qdot_memory_fail_at(n);
        status = qdot_sink_write("a", "new", 3);
        qdot_memory_fail_at(-1);
        assert_true(status == QDOT_OK || status == QDOT_ENOMEM);
    }
    assert_holds("a", "new");
    assert_int_equal(own_folder_clean(NULL), 1);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_abandoned_file_leaves_the_old_one),
        cmocka_unit_test(a_full_disk_leaves_the_old_one),
        cmocka_unit_test(permissions_and_links_stay),
        cmocka_unit_test(what_is_no_file_is_written_as_it_is),
        cmocka_unit_test(only_marked_files_are_free),
        cmocka_unit_test(failing_memory_leaves_the_old_one),
    };

    return cmocka_run_group_tests(tests, enter, own_folder_leave);
}
