/* One process has the lock; of a dead one it holds nobody up. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/file-lock.h"
#include "own-folder.h"

/* What another process gets; `dies` with the lock. */
static qdot_status
elsewhere(bool dies)
{
    int ended = 0;
    const pid_t child = fork();

    if (child == 0) {
        qdot_file_lock lock;
        const qdot_status status = qdot_file_lock_acquire("a", &lock);

        if (!dies && status == QDOT_OK)
            qdot_file_lock_release(&lock);
        _exit((int)status);
    }
    assert_int_equal(waitpid(child, &ended, 0), child);
    assert_true(WIFEXITED(ended));
    return (qdot_status)WEXITSTATUS(ended);
}

static void
one_process_has_it(void **state)
{
    qdot_file_lock lock;

    (void)state;
    assert_int_equal(qdot_file_lock_acquire("a", &lock), QDOT_OK);
    assert_int_equal(elsewhere(false), QDOT_EIO);
    qdot_file_lock_release(&lock);
    qdot_file_lock_release(&lock);
    assert_int_equal(access("a.lock", F_OK), -1);
    assert_int_equal(elsewhere(false), QDOT_OK);
    assert_int_equal(access("a.lock", F_OK), -1);
}

static void
a_dead_process_has_it_not(void **state)
{
    (void)state;
    assert_int_equal(elsewhere(true), QDOT_OK);
    assert_int_equal(access("a.lock", F_OK), 0);
    assert_int_equal(elsewhere(false), QDOT_OK);
    assert_int_equal(access("a.lock", F_OK), -1);
}

static void
a_file_of_the_user_is_no_lock(void **state)
{
    FILE *file = fopen("a.lock", "w");
    qdot_file_lock lock;

    (void)state;
    assert_non_null(file);
    fputs("mine", file);
    fclose(file);
    assert_int_equal(qdot_file_lock_acquire("a", &lock), QDOT_EIO);
    qdot_file_lock_release(&lock);
    assert_int_equal(unlink("a.lock"), 0);
    assert_int_equal(qdot_file_lock_acquire("none/a", &lock), QDOT_EIO);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_process_has_it),
        cmocka_unit_test(a_dead_process_has_it_not),
        cmocka_unit_test(a_file_of_the_user_is_no_lock),
    };

    return cmocka_run_group_tests(tests, own_folder_enter, own_folder_leave);
}
