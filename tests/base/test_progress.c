/* test_progress.c -- how far long work is. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include <math.h>
#include <pthread.h>
#include <string.h>
#include <time.h>

#include "base/progress.h"

static int shown, cleared;
static qdot_progress last;

static void
show(const qdot_progress *p)
{
    shown++;
    last = *p;
}

static void
clear(void)
{
    cleared++;
}

/* Steps of a millisecond from 0 towards 10, until a line was shown so often. */
static void
work(int times)
{
    const struct timespec step = {.tv_nsec = 1000000};

    for (int i = 0; i < 10000 && shown < times; i++) {
        nanosleep(&step, NULL);
        qdot_progress_at(i * 1e-3);
    }
}

static void
long_work_is_shown_and_short_is_not(void **state)
{
    qdot_progress progress = {.show = show, .clear = clear};

    (void)state;
    qdot_progress_begin(0, 10, "nobody waits");
    qdot_progress_at(1);
    qdot_progress_open = &progress;
    qdot_progress_begin(0, 10, "run %d", 7);
    for (int i = 0; i < 1000; i++)
        qdot_progress_at(i);
    qdot_progress_clear();
    assert_int_equal(shown, 0);
    assert_int_equal(cleared, 0);

    qdot_progress_begin(0, 10, "run %d", 8);
    work(3);
    assert_int_equal(shown, 3);
    assert_string_equal(last.text, "run 8");
    assert_true(last.t > 0 && last.t < 10);
    assert_true(last.speed > 1 && last.speed < 1001);
    /* the rest takes as long as the part done, in proportion */
    assert_true(fabs(last.left - (10 - last.t) * 1000 / last.speed) < 0.05 * last.left);
    qdot_progress_clear();
    qdot_progress_clear();
    assert_int_equal(cleared, 1);
    qdot_progress_open = NULL;
}

static void
parts_are_called_by_the_whole(void **state)
{
    qdot_progress progress = {.show = show, .clear = clear};

    (void)state;
    qdot_progress_open = &progress;
    qdot_progress_within("formulation %d", 2);
    qdot_progress_begin(0, 1, "run");
    assert_string_equal(progress.what, "formulation 2");
    qdot_progress_clear();
    qdot_progress_begin(0, 1, "run");
    assert_string_equal(progress.what, "run");
    qdot_progress_open = NULL;
}

static void *
in_a_thread(void *arg)
{
    (void)arg;
    qdot_progress_begin(0, 1, "companion");
    qdot_progress_at(0.5);
    return NULL;
}

static void
other_threads_tell_nothing(void **state)
{
    qdot_progress progress = {.show = show, .clear = clear};
    pthread_t thread;

    (void)state;
    qdot_progress_open = &progress;
    qdot_progress_begin(0, 1, "run");
    assert_int_equal(pthread_create(&thread, NULL, in_a_thread, NULL), 0);
    pthread_join(thread, NULL);
    assert_string_equal(progress.what, "run");
    assert_true(progress.steps == 0);
    qdot_progress_open = NULL;
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(long_work_is_shown_and_short_is_not),
        cmocka_unit_test(parts_are_called_by_the_whole),
        cmocka_unit_test(other_threads_tell_nothing),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
