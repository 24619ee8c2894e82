/* system.c -- what the C library of Debian's emscripten lacks. */
#define _GNU_SOURCE
#include "system.h"

#include <errno.h>
#include <sched.h>
#include <spawn.h>
#include <stdlib.h>

static int (*order)(const void *, const void *, void *);
static void *with;

static int
compare_with_user(const void *a, const void *b)
{
    return order(a, b, with);
}

/* There is one thread; a comparison may sort itself. */
void
qsort_r(void *base, size_t n, size_t size, int (*compare)(const void *, const void *, void *), void *user)
{
    int (*outer)(const void *, const void *, void *) = order;
    void *outer_user = with;

    order = compare;
    with = user;
    qsort(base, n, size, compare_with_user);
    order = outer;
    with = outer_user;
}

/* No other program can be started, and there is one processor. */
int
posix_spawnp(pid_t *child, const char *name, const posix_spawn_file_actions_t *actions, const posix_spawnattr_t *attributes,
             char *const *arguments, char *const *environment)
{
    (void)child, (void)name, (void)actions, (void)attributes, (void)arguments, (void)environment;
    return ENOSYS;
}

int
sched_getaffinity(pid_t process, size_t size, cpu_set_t *set)
{
    (void)process, (void)size, (void)set;
    errno = ENOSYS;
    return -1;
}

int
__sched_cpucount(size_t size, const cpu_set_t *set)
{
    (void)size, (void)set;
    return 1;
}
