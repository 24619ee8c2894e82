/* fuzz.h -- what both targets need: an answer that goes nowhere, no harm, a limit of time.
 *
 * A script can open no file and start no program: in the library fopen and posix_spawnp are what
 * stands here (tests/fuzz/run renames them).
 *
 * After LIMIT of processor time Ctrl-C is pressed, so that a long computation is no finding, but
 * one that does not listen is: libFuzzer's -timeout sees it. One input of eight, by its bytes,
 * hears it at any time before EARLY, so that what is left in the middle is met often.
 */
#ifndef QDOT_TESTS_FUZZ_FUZZ_H
#define QDOT_TESTS_FUZZ_FUZZ_H

#include <errno.h>
#include <signal.h>
#include <spawn.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "base/interrupt.h"
#include "lang/workbench/script.h"

enum { LIMIT = 2000, EARLY = 64 }; /* milliseconds */

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

FILE *fuzz_fopen(const char *path, const char *mode);
int fuzz_posix_spawnp(pid_t *pid, const char *file,
                      const posix_spawn_file_actions_t *actions,
                      const posix_spawnattr_t *attributes, char *const argv[],
                      char *const envp[]);

static FILE *fuzz_nowhere;
static timer_t fuzz_timer;
static volatile sig_atomic_t fuzz_pressed; /* a session forgets it when it has said so */

FILE *
fuzz_fopen(const char *path, const char *mode)
{
    (void)path;
    (void)mode;
    errno = EACCES;
    return NULL;
}

int
fuzz_posix_spawnp(pid_t *pid, const char *file, const posix_spawn_file_actions_t *actions,
                  const posix_spawnattr_t *attributes, char *const argv[],
                  char *const envp[])
{
    (void)pid;
    (void)file;
    (void)actions;
    (void)attributes;
    (void)argv;
    (void)envp;
    return EACCES;
}

static void
fuzz_press(int signal)
{
    (void)signal;
    fuzz_pressed = 1;
    qdot_interrupt_set();
}

/* After so long, and every LIMIT from then on. */
static void
fuzz_limit(int64_t milliseconds)
{
    struct itimerspec when = {
        .it_value = {milliseconds / 1000, milliseconds % 1000 * 1000000},
        .it_interval = {LIMIT / 1000, LIMIT % 1000 * 1000000},
    };

    timer_settime(fuzz_timer, 0, &when, NULL);
    qdot_interrupt_clear();
    fuzz_pressed = 0;
}

/* A number from the bytes of an input. */
static uint32_t
fuzz_hash(const uint8_t *data, size_t size)
{
    uint32_t h = 2166136261u;

    for (size_t i = 0; i < size; i++)
        h = (h ^ data[i]) * 16777619u;
    return h ^ h >> 15;
}

/* Before the first session. */
static void
fuzz_ready(void)
{
    struct sigevent event = {.sigev_notify = SIGEV_SIGNAL, .sigev_signo = SIGUSR2};
    struct sigaction action = {.sa_handler = fuzz_press, .sa_flags = SA_RESTART};

    if (fuzz_nowhere != NULL)
        return;
    fuzz_nowhere = fopen("/dev/null", "w");
    if (fuzz_nowhere == NULL || sigaction(SIGUSR2, &action, NULL) != 0 ||
        timer_create(CLOCK_PROCESS_CPUTIME_ID, &event, &fuzz_timer) != 0)
        abort();
}

/* From here on time counts. */
static void
fuzz_begin(const uint8_t *data, size_t size)
{
    uint32_t h = fuzz_hash(data, size);

    fuzz_limit(h % 8 == 0 ? 1 + h / 8 % EARLY : LIMIT);
}

static void
fuzz_end(void)
{
    fuzz_limit(0);
}

#endif
