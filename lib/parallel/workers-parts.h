/* workers-parts.h -- the work of parallel/workers.h between the processes of this machine (workers.c) and
 * those of other ranks (mates.c).
 */
#ifndef QDOT_PARALLEL_WORKERS_PARTS_H
#define QDOT_PARALLEL_WORKERS_PARTS_H

#include <stdint.h>

#include "base/text.h"
#include "parallel/items.h"

/* The head of each answer; n bytes follow. n QDOT_NO_ANSWER: two workers died while computing the item. */
typedef struct {
    uint64_t item, n;
} qdot_answer_head;

#define QDOT_NO_ANSWER UINT64_MAX

/* A worker process, or another rank, to which chunks of items are given. */
typedef struct {
    size_t n;
    qdot_items_chunk has[2]; /* chunks of items on which it works, [n] */
    size_t left[2];          /* number of answers that are still missing from each of these chunks */
    double since;            /* time at which it began the first of these chunks */
    double seconds;          /* seconds that it takes for an item; 0: not known yet */
    qdot_text come;          /* received bytes of an answer that is not complete yet */
} qdot_hand;

typedef struct qdot_mate qdot_mate;

typedef struct qdot_crew {
    const struct qdot_workers_job *job; /* the items and the functions that compute them (parallel/workers.h) */
    struct qdot_worker *workers;        /* [job->workers] the worker processes */
    qdot_items items;
    qdot_mate *mates; /* [ranks] on rank 0: the other ranks */
    size_t ready;     /* number of ranks in `mates` that have asked for work */
    uint64_t number;  /* number of this job, the same in all ranks */
    double looked;    /* time of the last check for ranks that no longer answer */
    qdot_text out;    /* on other ranks than 0: answers to be sent to rank 0 */
} qdot_crew;

/* Take a chunk of items that will keep the worker busy for about `seconds`; count 0 if none is left. */
qdot_items_chunk qdot_hand_out(qdot_crew *c, qdot_hand *h, double seconds, size_t most);
/* Read bytes from a worker; complete answers are passed to `done`, or on to rank 0. */
QDOT_MUST_CHECK qdot_status qdot_hand_take(qdot_crew *c, qdot_hand *h, const char *bytes,
                                           size_t n);
/* Treat the end of a worker: hand out again the items that it has not answered. */
QDOT_MUST_CHECK qdot_status qdot_hand_drop(qdot_crew *c, qdot_hand *h);
/* Record the answer of item k; bytes NULL: no answer can be computed. */
QDOT_MUST_CHECK qdot_status qdot_crew_answer(qdot_crew *c, size_t k, const char *bytes,
                                             size_t n);

/* On rank 0 (mates.c): receive from all other ranks, give them chunks of items, drop those that are lost. */
QDOT_MUST_CHECK qdot_status qdot_mates_new(qdot_crew *c);
void qdot_mates_free(qdot_crew *c);
QDOT_MUST_CHECK qdot_status qdot_mates_serve(qdot_crew *c);
/* On other ranks than 0 (mates.c): take chunks from rank 0; *over: rank 0 has no more items. */
void qdot_mates_report(const qdot_crew *c);
QDOT_MUST_CHECK qdot_status qdot_mates_take(qdot_crew *c, bool *over);
/* Send the answers collected so far to rank 0, if there are enough of them or `all` is true. */
QDOT_MUST_CHECK qdot_status qdot_mates_send(qdot_crew *c, bool all);

#endif
