/* file-lock.h -- one process at a time works with a file.
 *
 * The lock is FILE.lock, FILE being that behind symbolic links, an empty file that is there while it is held; of a
 * process that dies it stays, and holds nobody up. Processes that it forks do not hold it.
 *
 * Tests  tests/base/test_file-lock.c, tests/script/sweep-resume.sh
 */
#ifndef QDOT_BASE_FILE_LOCK_H
#define QDOT_BASE_FILE_LOCK_H

#include "base/status.h"

typedef struct {
    char *path; /* of the lock; NULL: none is held */
    int fd;
} qdot_file_lock;

/* QDOT_EIO: another process has it, or it cannot be made; QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_file_lock_acquire(const char *path, qdot_file_lock *lock);
/* Also of {0}. */
void qdot_file_lock_release(qdot_file_lock *lock);

#endif
