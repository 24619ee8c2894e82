/* file-lock.h -- one process at a time works with a file.
 *
 * The lock is an empty file, FILE.lock, which exists while the lock is held; symbolic links to one FILE share it.
 * If the process dies FILE.lock stays, but locks nobody out. Processes that it forks do not hold the lock.
 *
 * Tests  tests/base/test_file-lock.c, tests/script/sweeps/sweep-resume.sh
 */
#ifndef QDOT_BASE_FILE_LOCK_H
#define QDOT_BASE_FILE_LOCK_H

#include "base/status.h"

typedef struct {
    char *path; /* name of the lock file, owned; NULL: no lock is held */
    int fd;
} qdot_file_lock;

/* Lock a file. QDOT_EIO: another process has locked it, or the lock cannot be made; QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_file_lock_acquire(const char *path, qdot_file_lock *lock);
/* Remove the lock file and unlock; does nothing for a lock {0}. */
void qdot_file_lock_release(qdot_file_lock *lock);

#endif
