/* workers.c -- hands out items of a computation to processes, and collects their answers. */
#define _GNU_SOURCE
#include "parallel/workers.h"

#include <errno.h>
#include <math.h>
#include <poll.h>
#include <sched.h>
#include <signal.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif
#include <sys/wait.h>
#include <unistd.h>

#include "base/clock.h"
#include "base/interrupt.h"
#include "base/memory.h"
#include "base/process.h"
#include "base/progress.h"
#include "parallel/ranks.h"
#include "parallel/workers-parts.h"

static const double chunk_seconds = 0.02;
enum { MOST_CHUNK = 4096, READ = 65536 };

typedef qdot_items_chunk request; /* what a worker is asked for: a chunk of items */

typedef struct qdot_worker {
    pid_t pid;
    int ask, answer; /* pipe ends: for what the worker is asked, for its answers; -1: the worker has ended */
    qdot_hand hand;
} worker;

size_t
qdot_workers_processors(void)
{
    int64_t n;

#ifdef CPU_COUNT
    cpu_set_t set;

    if (QDOT_MAY_THREAD && sched_getaffinity(0, sizeof set, &set) == 0)
        return (size_t)CPU_COUNT(&set);
#endif
    n = QDOT_MAY_THREAD ? sysconf(_SC_NPROCESSORS_ONLN) : 1;
    return n > 0 ? (size_t)n : 1;
}

/* --- a worker process ----------------------------------------------------------------- */

static bool
write_all(int to, const void *bytes, size_t n)
{
    for (const char *at = bytes; n > 0;) {
        const ssize_t put = write(to, at, n);

        if (put < 0 && errno == EINTR)
            continue;
        if (put <= 0)
            return false;
        at += put;
        n -= (size_t)put;
    }
    return true;
}

static bool
read_all(int from, void *bytes, size_t n)
{
    for (char *at = bytes; n > 0;) {
        const ssize_t come = read(from, at, n);

        if (come < 0 && errno == EINTR)
            continue;
        if (come <= 0)
            return false;
        at += come;
        n -= (size_t)come;
    }
    return true;
}

/* Until there is nothing more to do. Ctrl-C is for the process that began the work, which ends its
 * workers; they end with it, however it ends. */
static void
serve_requests(const qdot_workers_job *job, int ask, int answer)
{
    qdot_text text = {0};
    request r;

#ifdef __linux__
    prctl(PR_SET_PDEATHSIG, SIGKILL);
#endif
    signal(SIGINT, SIG_IGN);
    signal(SIGTERM, SIG_DFL);
    qdot_progress_open = NULL;
    qdot_threads_are_taken = qdot_ranks_are_there() || job->workers >= qdot_workers_processors();
    while (read_all(ask, &r, sizeof r)) {
        if (job->begin)
            job->begin(r.first, r.count, job->user);
        for (size_t k = r.first; k < r.first + r.count; k++) {
            qdot_answer_head h = {.item = k};

            qdot_text_truncate(&text, 0);
            job->work(k, &text, job->user);
            h.n = text.n;
            if (qdot_text_status(&text) != QDOT_OK || !write_all(answer, &h, sizeof h)
                || !write_all(answer, text.at, text.n))
                _exit(1);
        }
    }
    _exit(0);
}

static bool
start_worker(qdot_crew *c, worker *w)
{
    int ask[2], answer[2];

    *w = (worker){.ask = -1, .answer = -1, .hand.seconds = c->job->seconds};
    if (pipe(ask) != 0)
        return false;
    if (pipe(answer) != 0) {
        close(ask[0]);
        close(ask[1]);
        return false;
    }
    w->pid = fork();
    if (w->pid == 0) {
        /* close the pipes of the other workers: a pipe ends only when all its writers are closed */
        for (size_t i = 0; i < c->job->workers; i++)
            if (&c->workers[i] != w && c->workers[i].pid > 0) {
                close(c->workers[i].ask);
                close(c->workers[i].answer);
            }
        close(ask[1]);
        close(answer[0]);
        serve_requests(c->job, ask[0], answer[1]);
    }
    close(ask[0]);
    close(answer[1]);
    if (w->pid < 0) {
        close(ask[1]);
        close(answer[0]);
        return false;
    }
    w->ask = ask[1];
    w->answer = answer[0];
    return true;
}

static void
end_worker(worker *w, bool at_once)
{
    if (w->answer < 0 || w->pid <= 0) /* it was never begun, or has ended */
        return;
    if (at_once)
        kill(w->pid, SIGKILL);
    close(w->ask);
    close(w->answer);
    w->ask = w->answer = -1;
    while (waitpid(w->pid, NULL, 0) < 0 && errno == EINTR)
        ;
    w->pid = 0;
    qdot_text_clear(&w->hand.come);
}

/* --- chunks and answers ----------------------------------------------------------------- */

qdot_items_chunk
qdot_hand_out(qdot_crew *c, qdot_hand *h, double seconds, size_t most)
{
    const double hands = (double)(c->job->workers + c->ready);
    const double share = (double)(c->items.end - c->items.next) / (2 * hands);
    const double few = h->seconds > 0 ? seconds / h->seconds : 1;
    double n = fmax(few, (double)c->job->least);
    qdot_items_chunk r;

    if (c->items.again.n == 0)
        n = fmin(n, share);
    r = qdot_items_take(&c->items, fmin(n, (double)most));
    if (r.count == 0)
        return r;
    if (h->n == 0)
        h->since = qdot_wall_now();
    h->has[h->n] = r;
    h->left[h->n++] = r.count;
    return r;
}

/* Record that a worker has answered item k, and how long a chunk took when it is complete. */
static void
record_answer(qdot_hand *h, size_t k)
{
    double now, seconds;

    for (size_t i = 0; i < h->n; i++) {
        if (k < h->has[i].first || k - h->has[i].first >= h->has[i].count || --h->left[i] > 0)
            continue;
        now = qdot_wall_now();
        seconds = (now - h->since) / (double)h->has[i].count;
        h->seconds = h->seconds > 0 ? (h->seconds + seconds) / 2 : seconds;
        h->since = now;
        if (--h->n > i) {
            h->has[i] = h->has[i + 1];
            h->left[i] = h->left[i + 1];
        }
        return;
    }
}

qdot_status
qdot_crew_answer(qdot_crew *c, size_t k, const char *bytes, size_t n)
{
    const qdot_answer_head h = {.item = k, .n = bytes != NULL ? n : QDOT_NO_ANSWER};

    if (!qdot_items_answer(&c->items, k))
        return QDOT_OK; /* ignore a second answer, from a rank that was thought lost */
    if (qdot_rank() == 0)
        return c->job->done(k, bytes, n, c->job->user);
    qdot_text_add_n(&c->out, (const char *)&h, sizeof h);
    if (bytes != NULL)
        qdot_text_add_n(&c->out, bytes, n);
    return qdot_mates_send(c, false);
}

qdot_status
qdot_hand_take(qdot_crew *c, qdot_hand *hand, const char *bytes, size_t n)
{
    qdot_text *come = &hand->come;
    qdot_answer_head h;
    size_t at = 0;

    qdot_text_add_n(come, bytes, n);
    QDOT_TRY(qdot_text_status(come));
    while (come->n - at >= sizeof h) {
        memcpy(&h, come->at + at, sizeof h);
        if (h.n != QDOT_NO_ANSWER && come->n - at - sizeof h < h.n)
            break;
        at += sizeof h;
        if (h.n == QDOT_NO_ANSWER)
            QDOT_TRY(qdot_crew_answer(c, (size_t)h.item, NULL, 0));
        else
            QDOT_TRY(qdot_crew_answer(c, (size_t)h.item, come->at + at, (size_t)h.n));
        at += h.n != QDOT_NO_ANSWER ? (size_t)h.n : 0;
        record_answer(hand, (size_t)h.item);
    }
    if (at > 0) {
        memmove(come->at, come->at + at, come->n - at);
        qdot_text_truncate(come, come->n - at);
    }
    return QDOT_OK;
}

qdot_status
qdot_hand_drop(qdot_crew *c, qdot_hand *h)
{
    for (; h->n > 0; h->n--)
        QDOT_TRY(qdot_items_give(&c->items, h->has[h->n - 1]));
    return QDOT_OK;
}

/* --- the process that hands out the work ---------------------------------------------- */

/* Give a chunk to an idle worker, if any is left. A worker that has died is noticed when its answer is read; one to
 * which the chunk cannot be written is killed, because its answer would be waited for without end. */
static void
feed_worker(qdot_crew *c, worker *w)
{
    request r;

    if (w->hand.n > 0 || w->answer < 0)
        return;
    r = qdot_hand_out(c, &w->hand, chunk_seconds, MOST_CHUNK);
    if (r.count > 0 && !write_all(w->ask, &r, sizeof r))
        kill(w->pid, SIGKILL);
}

/* Replace a worker that died; the items that it has not answered are done again. */
static qdot_status
replace_worker(qdot_crew *c, worker *w)
{
    qdot_hand *h = &w->hand;
    qdot_items_chunk rest = h->has[0];
    size_t killer;

    end_worker(w, true);
    if (h->n > 0) {
        h->n = 0;
        rest.first += rest.count - h->left[0];
        rest.count = h->left[0];
        killer = rest.first;
        if (!qdot_items_survives(&c->items, killer))
            QDOT_TRY(qdot_crew_answer(c, killer, NULL, 0));
        /* hand out the items one by one: the next death shows which of them caused it */
        for (size_t k = rest.first; k < rest.first + rest.count; k++)
            QDOT_TRY(qdot_items_give(&c->items, (qdot_items_chunk){k, 1}));
    }
    if ((c->items.left > 0 || qdot_rank() > 0) && !start_worker(c, w))
        return qdot_fail(QDOT_EIO, "no process can be started: %s", strerror(errno));
    return QDOT_OK;
}

static qdot_status
read_from_worker(qdot_crew *c, worker *w)
{
    static char bytes[READ];
    const ssize_t n = read(w->answer, bytes, sizeof bytes);

    if (n < 0 && errno == EINTR)
        return QDOT_OK;
    if (n <= 0)
        return replace_worker(c, w);
    QDOT_TRY(qdot_hand_take(c, &w->hand, bytes, (size_t)n));
    if (qdot_rank() > 0)
        return qdot_mates_send(c, w->hand.n == 0);
    qdot_progress_at((double)(c->items.end - c->items.first - c->items.left));
    return QDOT_OK;
}

/* Work until all items are answered; on ranks other than 0, until rank 0 wants no more. */
static qdot_status
carry_out_work(qdot_crew *c, struct pollfd *polled)
{
    const int moment = qdot_ranks_count() > 1 ? 1 : 200;
    bool over = false;

    while (!over && (c->items.left > 0 || qdot_rank() > 0)) {
        for (size_t i = 0; i < c->job->workers; i++) {
            feed_worker(c, &c->workers[i]);
            polled[i] = (struct pollfd){.fd = c->workers[i].answer, .events = POLLIN};
        }
        QDOT_TRY(qdot_interrupt_check());
        if (poll(polled, c->job->workers, moment) < 0 && errno != EINTR)
            return qdot_fail(QDOT_EIO, "workers cannot be heard: %s", strerror(errno));
        for (size_t i = 0; i < c->job->workers; i++)
            if (polled[i].fd >= 0 && (polled[i].revents & (POLLIN | POLLHUP | POLLERR)))
                QDOT_TRY(read_from_worker(c, &c->workers[i]));
        if (qdot_rank() > 0)
            QDOT_TRY(qdot_mates_take(c, &over));
        else
            QDOT_TRY(qdot_mates_serve(c));
    }
    return QDOT_OK;
}

static qdot_status
start_all_workers(qdot_crew *c)
{
    bool over = false;

    for (size_t i = 0; i < c->job->workers; i++)
        c->workers[i] = (worker){.ask = -1, .answer = -1};
    QDOT_TRY(qdot_mates_new(c));
    if (qdot_rank() > 0) {
        qdot_mates_report(c);
        QDOT_TRY(qdot_mates_take(c, &over));
    }
    for (size_t i = 0; i < c->job->workers && !over; i++)
        if (!start_worker(c, &c->workers[i]))
            return qdot_fail(QDOT_EIO, "no process can be started: %s", strerror(errno));
    return QDOT_OK;
}

qdot_status
qdot_workers_run(const qdot_workers_job *job)
{
    static uint64_t number;
    qdot_crew c = {.job = job, .number = ++number};
    struct pollfd *polled = qdot_calloc(job->workers, sizeof *polled);
    void (*before)(int) = signal(SIGPIPE, SIG_IGN);
    qdot_status status;

    c.workers = qdot_calloc(job->workers, sizeof *c.workers);
    status = qdot_items_new(&c.items, job->first, job->end, job->skip, qdot_rank() == 0);
    if (status == QDOT_OK && !(polled && c.workers))
        status = QDOT_ENOMEM;
    fflush(NULL); /* write out buffered output, which otherwise would be written twice after fork */
    if (status == QDOT_OK)
        status = QDOT_MAY_THREAD ? start_all_workers(&c) : qdot_fail(QDOT_EIO, "no process can be started: this program has one");
    if (status == QDOT_OK)
        status = carry_out_work(&c, polled);
    for (size_t i = 0; c.workers && i < job->workers; i++)
        end_worker(&c.workers[i], status != QDOT_OK || qdot_rank() > 0);
    signal(SIGPIPE, before);
    qdot_mates_free(&c);
    qdot_items_free(&c.items);
    qdot_free(c.workers);
    qdot_free(polled);
    return status;
}
