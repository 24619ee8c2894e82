/* test_workers.c -- items divided among processes, some of which die or cannot be told what to do. */
#ifndef _GNU_SOURCE
#define _GNU_SOURCE /* RTLD_NEXT */
#endif
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include <dlfcn.h>
#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/interrupt.h"
#include "parallel/workers.h"

enum { ITEMS = 300 };

/* A build of one process has no workers. */
static void
skip_without_processes(void)
{
#ifdef QDOT_ONE_THREAD
    skip();
#endif
}

static int64_t writes_left = -1; /* of this process, until one fails; negative: none does */
static pid_t writer;

/* In place of that of the C library. */
ssize_t
write(int fd, const void *bytes, size_t n)
{
    if (writes_left >= 0 && getpid() == writer && writes_left-- == 0) {
        errno = ENOSPC;
        return -1;
    }
    return ((__typeof__(&write))dlsym(RTLD_NEXT, "write"))(fd, bytes, n);
}

typedef struct {
    size_t squares[ITEMS], answers, lost;
    size_t deadly;       /* an item of which each worker dies */
    size_t once;         /* one of which the first dies */
    char mark[64];       /* a file that says that it did */
    size_t stop_after;   /* answers after which `done` fails, or is interrupted */
    bool interrupts;
} world;

static void
work(size_t k, qdot_text *answer, void *user)
{
    const world *w = user;
    const size_t square = k * k;

    if (k == w->deadly)
        raise(SIGKILL);
    if (k == w->once && access(w->mark, F_OK) != 0) {
        fclose(fopen(w->mark, "w"));
        raise(SIGKILL);
    }
    for (size_t i = 0; i < k; i++) /* answers of different lengths, some of several pipes */
        qdot_text_add_n(answer, (const char *)&square, sizeof square);
}

static qdot_status
done(size_t k, const char *bytes, size_t n, void *user)
{
    world *w = user;

    if (bytes == NULL)
        w->lost = w->lost * 1000 + k;
    else if (n > 0)
        memcpy(&w->squares[k], bytes + n - sizeof *w->squares, sizeof *w->squares);
    if (++w->answers == w->stop_after && w->interrupts)
        qdot_interrupt_set();
    return w->answers == w->stop_after && !w->interrupts ? qdot_fail(QDOT_EINVAL, "enough")
                                                         : QDOT_OK;
}

static qdot_status
run(world *w, size_t workers, double seconds)
{
    const qdot_workers_job job = {.first = 1, .end = ITEMS, .workers = workers,
                                  .seconds = seconds, .user = w, .work = work, .done = done};

    return qdot_workers_run(&job);
}

static void
all_items_are_answered_once(void **state)
{
    (void)state;
    skip_without_processes();
    for (size_t workers = 1; workers < 6; workers++) {
        world w = {.deadly = ITEMS, .once = ITEMS};

        assert_int_equal(run(&w, workers, workers % 2 ? 1 : 1e-6), QDOT_OK);
        assert_int_equal(w.answers, ITEMS - 1);
        for (size_t k = 1; k < ITEMS; k++)
            assert_int_equal(w.squares[k], k * k);
    }
}

static void
a_worker_that_dies_costs_one_item(void **state)
{
    world w = {.deadly = 17, .once = 40};

    (void)state;
    skip_without_processes();
    snprintf(w.mark, sizeof w.mark, "workers-%d", (int)getpid());
    assert_int_equal(run(&w, 3, 1e-6), QDOT_OK);
    unlink(w.mark);
    assert_int_equal(w.answers, ITEMS - 1);
    assert_int_equal(w.lost, 17);
    for (size_t k = 1; k < ITEMS; k++)
        assert_int_equal(w.squares[k], k == 17 ? 0 : k * k);
}

static void
a_worker_that_cannot_be_told_is_replaced(void **state)
{
    (void)state;
    skip_without_processes();
    writer = getpid();
    for (int64_t n = 0; n < 5; n++) {
        world w = {.deadly = ITEMS, .once = ITEMS};

        writes_left = n;
        assert_int_equal(run(&w, 2, 1), QDOT_OK);
        assert_true(writes_left < 0);
        for (size_t k = 1; k < ITEMS; k++)
            assert_int_equal(w.squares[k], k * k);
    }
    writes_left = -1;
}

static void
work_ends_early(void **state)
{
    world w = {.deadly = ITEMS, .once = ITEMS, .stop_after = 20};

    (void)state;
    skip_without_processes();
    assert_int_equal(run(&w, 2, 1), QDOT_EINVAL);
    assert_int_equal(w.answers, 20);
    w = (world){.deadly = ITEMS, .once = ITEMS, .stop_after = 20, .interrupts = true};
    assert_int_equal(run(&w, 2, 1), QDOT_EINTR);
    qdot_interrupt_clear();
    assert_true(w.answers >= 20);
}

/* It ends none then: process 0 would be all that were begun with this one. */
static void
a_build_of_one_process_refuses(void **state)
{
    (void)state;
#ifdef QDOT_ONE_THREAD
    world w = {.deadly = ITEMS, .once = ITEMS};

    assert_int_equal(run(&w, 2, 1), QDOT_EIO);
#else
    skip();
#endif
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(all_items_are_answered_once),
        cmocka_unit_test(a_worker_that_dies_costs_one_item),
        cmocka_unit_test(a_worker_that_cannot_be_told_is_replaced),
        cmocka_unit_test(work_ends_early),
        cmocka_unit_test(a_build_of_one_process_refuses),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
