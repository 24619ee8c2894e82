/* workers.h -- numbered items of work, divided among processes.
 *
 * Each worker is a copy of this process as it is when the work begins, so an item finds in it all that
 * it needs, and leaves nothing behind but its answer: some bytes. Items are handed out in chunks that
 * take about a fiftieth of a second, as the chunks before tell. A worker that dies costs the items of its
 * chunk that it had not answered yet; another does them, once.
 *
 * Beyond one machine (parallel/ranks.h) all ranks begin the same work, each with workers of its own, and
 * rank 0 hands out chunks to all, of a quarter of a second or more. What a rank that is lost has not
 * answered is done by others.
 *
 * Tests  tests/parallel/test_workers.c, tests/script/sweeps/sweep-threads.sh, tests/meta/ranks.test
 */
#ifndef QDOT_PARALLEL_WORKERS_H
#define QDOT_PARALLEL_WORKERS_H

#include "base/text.h"

typedef struct qdot_workers_job {
    size_t first, end; /* the items of work are first ... end - 1 */
    const bool *skip;  /* [end] items that are not to be done; NULL: all are */
    size_t workers;    /* number of worker processes, at least 1 */
    double seconds;    /* a first estimate of the seconds that an item takes; 0: unknown */
    void *user;
    size_t least;      /* smallest number of items handed out together, as long as enough are left; 0: 1 */
    /* Called in a worker: the items first ... first + count - 1 come next; NULL if not needed. */
    void (*begin)(size_t first, size_t count, void *user);
    /* Called in a worker: compute item k and append its answer. */
    void (*work)(size_t k, qdot_text *answer, void *user);
    /* Here: item k is answered, in whatever order; bytes NULL: two workers died of it. An error ends
     * the work. */
    qdot_status (*done)(size_t k, const char *bytes, size_t n, void *user);
} qdot_workers_job;

/* The number of processors that this process may use; 1 where it may start no processes (base/process.h). */
size_t qdot_workers_processors(void);

/* Do all items. With several ranks: in rank 0; in the others do what rank 0 hands out, until it shares
 * something; `done` is not called there. QDOT_EINTR: interrupted; QDOT_EIO: no worker can be started; QDOT_ENOMEM; or as
 * `done` returns. All workers have ended when it returns. */
QDOT_MUST_CHECK qdot_status qdot_workers_run(const qdot_workers_job *job);

#endif
