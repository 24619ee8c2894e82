/* file-lock.c -- locks a file by a POSIX record lock on a second file next to it. */
#include "base/file-lock.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/memory.h"
#include "base/text.h"

static qdot_status
report_lock_failure(const char *path, int reason)
{
    if (reason == EACCES || reason == EAGAIN) {
        qdot_fail(QDOT_EIO, "another process is using `%.200s`", path);
        return qdot_hint("wait for it, or give another name");
    }
    return qdot_fail(QDOT_EIO, "cannot lock `%.200s`: %s", path, strerror(reason));
}

/* Lock the open file fd; *gone: the file was removed after it was opened. Returns errno on failure. */
static int
lock_open_file(const char *path, int fd, bool *gone)
{
    struct flock all = {.l_type = F_WRLCK, .l_whence = SEEK_SET};
    struct stat held, now;

    if (fcntl(fd, F_SETLK, &all) != 0 || fstat(fd, &held) != 0)
        return errno;
    *gone = stat(path, &now) != 0 || now.st_ino != held.st_ino || now.st_dev != held.st_dev;
    if (held.st_size > 0) /* a lock file is empty: a file with content of that name is not ours */
        return EEXIST;
    return 0;
}

qdot_status
qdot_file_lock_acquire(const char *path, qdot_file_lock *lock)
{
    char *behind = realpath(path, NULL); /* with symbolic links resolved, so that all paths to one file share one lock */
    qdot_text name = {0};
    int failed = 0;
    bool gone = true;

    *lock = (qdot_file_lock){.fd = -1};
    qdot_text_format(&name, "%s.lock", behind != NULL ? behind : path);
    free(behind);
    if (qdot_text_status(&name) != QDOT_OK) {
        qdot_text_clear(&name);
        return QDOT_ENOMEM;
    }
    while (gone && failed == 0) {
        const int fd = open(name.at, O_RDWR | O_CREAT | O_CLOEXEC, 0666);

        gone = false;
        failed = fd < 0 ? (errno == EACCES ? EPERM : errno) : lock_open_file(name.at, fd, &gone);
        if (failed == 0 && !gone)
            *lock = (qdot_file_lock){name.at, fd};
        else if (fd >= 0)
            (void)close(fd);
    }
    if (lock->path != NULL)
        return QDOT_OK;
    qdot_text_clear(&name);
    return report_lock_failure(path, failed);
}

void
qdot_file_lock_release(qdot_file_lock *lock)
{
    if (lock->path == NULL)
        return;
    (void)unlink(lock->path); /* remove the file while the lock is still held */
    (void)close(lock->fd);
    qdot_free(lock->path);
    *lock = (qdot_file_lock){0};
}
