/* test_interrupt.c -- a system is interrupted by itself; long work tells how far it is. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include <math.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

#include "qdot.h"

static const char double_pendulum[] =
    "coord theta, phi\n"
    "particle a mass 1 at (sin(theta), -cos(theta))\n"
    "particle b mass 1 at (sin(theta) + sin(phi), -cos(theta) - cos(phi))\n"
    "gravity (0, -9.81)\n"
    "start theta = 2, phi = 1\n";

/* Work that lasts for minutes: in the thread of the call, its helper threads and processes. */
static const char *const long_works[] = {
    "run 0..100000 tol 1e-9",                            /* one run and its companions */
    "run 0..300 digits 60",                              /* in MPFR, the companion on a thread of its own */
    "sweep theta = 0..3 count 4000 run 0..1000 : value(phi, 1000)", /* in processes, or in the lanes of vectors */
    "sweep theta = 0..3 count 4000 run 0..1000 : value(phi, 1000) threads 1",
    "check (theta + phi + k)^40 == (theta + phi + k)*(theta + phi + k)^39 for k = 1..10000000", /* on a thread for FLINT */
};

typedef struct {
    const char *text;
    qdot_system *system;
    qdot_result result;
    atomic_bool done;
} job;

static void *
carry_out(void *data)
{
    job *j = data;

    j->result = qdot_system_declare(j->system, j->text);
    atomic_store(&j->done, true);
    return NULL;
}

static void
wait_seconds(double seconds)
{
    const struct timespec time = {.tv_sec = (time_t)seconds, .tv_nsec = (long)(1e9 * fmod(seconds, 1))};

    nanosleep(&time, NULL);
}

static qdot_system *
new_system(void)
{
    qdot_system *s;

    assert_int_equal(qdot_system_new(&s), QDOT_RESULT_OK);
    assert_int_equal(qdot_system_declare(s, double_pendulum), QDOT_RESULT_OK);
    return s;
}

/* Interrupt the job until it has ended. */
static void
interrupt_job(job *j, pthread_t thread)
{
    for (int i = 0; i < 2000 && !atomic_load(&j->done); i++) {
        qdot_system_interrupt(j->system);
        wait_seconds(0.01);
    }
    assert_true(atomic_load(&j->done));
    assert_int_equal(pthread_join(thread, NULL), 0);
}

static void
one_of_two_systems_is_interrupted(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof long_works / sizeof *long_works; i++) {
        job one = {.text = long_works[i], .system = new_system()}, other = one;
        pthread_t threads[2];
        double value;

        other.system = new_system();
        assert_int_equal(pthread_create(&threads[0], NULL, carry_out, &one), 0);
        assert_int_equal(pthread_create(&threads[1], NULL, carry_out, &other), 0);
        wait_seconds(0.3);
        assert_false(atomic_load(&one.done) || atomic_load(&other.done));
        interrupt_job(&one, threads[0]);
        assert_int_equal(one.result, QDOT_RESULT_INTERRUPTED);
        wait_seconds(0.1);
        assert_false(atomic_load(&other.done));
        interrupt_job(&other, threads[1]);
        assert_int_equal(other.result, QDOT_RESULT_INTERRUPTED);
        assert_int_equal(qdot_system_number(one.system, "1 + 1", &value, NULL), QDOT_RESULT_OK);
        assert_float_equal(value, 2, 0);
        qdot_system_free(one.system);
        qdot_system_free(other.system);
    }
}

static void
a_system_that_computes_nothing_is_not_interrupted(void **state)
{
    qdot_system *s = new_system();
    double value;

    (void)state;
    qdot_system_interrupt(NULL);
    qdot_system_interrupt(s);
    assert_int_equal(qdot_system_number(s, "2 + 2", &value, NULL), QDOT_RESULT_OK);
    qdot_system_free(s);
}

/* --- progress ------------------------------------------------------------------------- */

typedef struct {
    qdot_system *system;
    int times, stop_at;
    double done, left;
    char what[40];
    qdot_result other; /* of a call on another system */
} watch;

static void
look(void *data, const char *what, double done, double left)
{
    watch *w = data;

    assert_true(done >= w->done && done <= 1);
    w->done = done;
    w->left = left;
    snprintf(w->what, sizeof w->what, "%s", what);
    if (w->times++ == 0) {
        qdot_system *other;
        double value;

        assert_int_equal(qdot_system_new(&other), QDOT_RESULT_OK);
        w->other = qdot_system_number(other, "3", &value, NULL);
        qdot_system_free(other);
    }
    if (w->times == w->stop_at)
        qdot_system_interrupt(w->system);
}

static void
progress_is_told_and_may_interrupt(void **state)
{
    watch w = {.system = new_system(), .stop_at = 3};
    qdot_motion *m;

    (void)state;
    assert_int_equal(qdot_system_progress(NULL, look, &w), QDOT_RESULT_INVALID);
    assert_int_equal(qdot_system_progress(w.system, look, &w), QDOT_RESULT_OK);
    assert_int_equal(qdot_system_run(w.system, "0..100000 tol 1e-9", &m), QDOT_RESULT_INTERRUPTED);
    assert_int_equal(w.times, 3);
    assert_string_equal(w.what, "run");
    assert_true(w.done > 0 && w.done < 1 && w.left > 0);
    assert_int_equal(w.other, QDOT_RESULT_OK);
    assert_non_null(m); /* the motion so far */
    qdot_motion_free(m);
    assert_int_equal(qdot_system_progress(w.system, NULL, NULL), QDOT_RESULT_OK);
    qdot_system_free(w.system);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_of_two_systems_is_interrupted),
        cmocka_unit_test(a_system_that_computes_nothing_is_not_interrupted),
        cmocka_unit_test(progress_is_told_and_may_interrupt),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
