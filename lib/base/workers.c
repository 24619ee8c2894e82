/* workers.c -- hands out items to processes and collects their answers. */
#define _GNU_SOURCE
#include "base/workers.h"

#include <errno.h>
#include <math.h>
#include <poll.h>
#include <sched.h>
#include <signal.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/interrupt.h"
#include "base/memory.h"
#include "base/progress.h"
#include "base/threads.h"

bool qdot_threads_are_taken;

static const double chunk_seconds = 0.02;
enum { MOST_CHUNK = 4096, READ = 65536 };

/* What a worker is asked for, and the head of each answer; the bytes follow. */
typedef struct {
    uint64_t first, count;
} request;
typedef struct {
    uint64_t item, n;
} head;

typedef struct {
    pid_t pid;
    int ask, answer;    /* pipes; -1: it has ended */
    size_t next, end;   /* items of its chunk not answered yet */
    qdot_text come;     /* bytes of answers not complete yet */
} worker;

typedef struct {
    const qdot_workers_job *job;
    worker *workers; /* [job->workers] */
    size_t next;     /* item not handed out yet */
    size_t left;     /* items without answer */
    qdot_vec(size_t) again; /* items whose worker died */
    bool *failed;    /* [items] of which a worker has died */
} crew;

size_t
qdot_workers_processors(void)
{
    long n;

#ifdef CPU_COUNT
    cpu_set_t set;

    if (sched_getaffinity(0, sizeof set, &set) == 0)
        return (size_t)CPU_COUNT(&set);
#endif
    n = sysconf(_SC_NPROCESSORS_ONLN);
    return n > 0 ? (size_t)n : 1;
}

/* --- a worker ------------------------------------------------------------------------- */

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
 * workers. */
static void
serve(const qdot_workers_job *job, int ask, int answer)
{
    qdot_text text = {0};
    request r;

    signal(SIGINT, SIG_IGN);
    qdot_progress_open = NULL;
    qdot_threads_are_taken = job->workers >= qdot_workers_processors();
    while (read_all(ask, &r, sizeof r)) {
        if (job->begin)
            job->begin((size_t)r.first, (size_t)r.count, job->user);
        for (uint64_t k = r.first; k < r.first + r.count; k++) {
            head h = {.item = k};

            qdot_text_truncate(&text, 0);
            job->work((size_t)k, &text, job->user);
            h.n = text.n;
            if (qdot_text_status(&text) != QDOT_OK || !write_all(answer, &h, sizeof h)
                || !write_all(answer, text.at, text.n))
                _exit(1);
        }
    }
    _exit(0);
}

static bool
start(crew *c, worker *w)
{
    int ask[2], answer[2];

    *w = (worker){.ask = -1, .answer = -1};
    if (pipe(ask) != 0)
        return false;
    if (pipe(answer) != 0) {
        close(ask[0]);
        close(ask[1]);
        return false;
    }
    w->pid = fork();
    if (w->pid == 0) {
        for (size_t i = 0; i < c->job->workers; i++) /* a pipe ends when all its writers have */
            if (&c->workers[i] != w && c->workers[i].pid > 0) {
                close(c->workers[i].ask);
                close(c->workers[i].answer);
            }
        close(ask[1]);
        close(answer[0]);
        serve(c->job, ask[0], answer[1]);
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
end(worker *w, bool at_once)
{
    if (w->answer < 0)
        return;
    if (at_once)
        kill(w->pid, SIGKILL);
    close(w->ask);
    close(w->answer);
    w->ask = w->answer = -1;
    while (waitpid(w->pid, NULL, 0) < 0 && errno == EINTR)
        ;
    w->pid = 0;
    qdot_text_clear(&w->come);
}

/* --- here ----------------------------------------------------------------------------- */

/* The next items that nobody has, at most so many in a row; count 0: there are none. */
static request
next_chunk(crew *c, double most)
{
    const qdot_workers_job *job = c->job;
    request r = {.count = 0};

    while (c->next < job->end && job->skip && job->skip[c->next])
        c->next++;
    r.first = c->next;
    while (c->next < job->end && !(job->skip && job->skip[c->next])
           && (r.count == 0 || (double)r.count + 1 <= most)) {
        c->next++;
        r.count++;
    }
    return r;
}

/* A chunk for an idle worker, if there is one: items of a dead one first, one by one. That a worker is
 * dead shows when it is read. */
static void
hand_out(crew *c, worker *w)
{
    const qdot_workers_job *job = c->job;
    request r = {.count = 1};

    if (c->again.n > 0) {
        r.first = c->again.at[--c->again.n];
    } else {
        const double share = (double)(job->end - c->next) / (2 * (double)job->workers);
        const double few = job->seconds > 0 ? chunk_seconds / job->seconds : 1;

        r = next_chunk(c, fmin(fmin(fmax(few, (double)job->least), share), MOST_CHUNK));
        if (r.count == 0)
            return;
    }
    w->next = (size_t)r.first;
    w->end = w->next + (size_t)r.count;
    (void)write_all(w->ask, &r, sizeof r);
}

/* The answers that have come whole. */
static qdot_status
take_answers(crew *c, worker *w)
{
    size_t at = 0;
    head h;

    while (w->come.n - at >= sizeof h) {
        memcpy(&h, w->come.at + at, sizeof h);
        if (w->come.n - at - sizeof h < h.n)
            break;
        QDOT_TRY(c->job->done((size_t)h.item, w->come.at + at + sizeof h, (size_t)h.n,
                              c->job->user));
        at += sizeof h + (size_t)h.n;
        w->next = (size_t)h.item + 1;
        c->left--;
    }
    if (at > 0) {
        memmove(w->come.at, w->come.at + at, w->come.n - at);
        qdot_text_truncate(&w->come, w->come.n - at);
    }
    return QDOT_OK;
}

/* A worker has died: what it had not answered is done again, by another in its place. */
static qdot_status
replace(crew *c, worker *w)
{
    const size_t last = w->end;
    size_t next = w->next;

    end(w, true);
    if (next < last && c->failed[next - c->job->first]) { /* two have died of this one */
        QDOT_TRY(c->job->done(next++, NULL, 0, c->job->user));
        c->left--;
    } else if (next < last) {
        c->failed[next - c->job->first] = true;
    }
    for (; next < last; next++)
        QDOT_TRY(qdot_vec_push(&c->again, next));
    if (c->left > 0 && !start(c, w))
        return qdot_fail(QDOT_EIO, "no process can be started: %s", strerror(errno));
    if (c->left > 0)
        hand_out(c, w);
    return QDOT_OK;
}

static qdot_status
listen_to(crew *c, worker *w)
{
    static char bytes[READ];
    const ssize_t n = read(w->answer, bytes, sizeof bytes);

    if (n < 0 && errno == EINTR)
        return QDOT_OK;
    if (n <= 0)
        return replace(c, w);
    qdot_text_add_n(&w->come, bytes, (size_t)n);
    QDOT_TRY(qdot_text_status(&w->come));
    QDOT_TRY(take_answers(c, w));
    qdot_progress_at((double)(c->job->end - c->job->first - c->left));
    if (w->next == w->end)
        hand_out(c, w);
    return QDOT_OK;
}

static qdot_status
carry_out(crew *c, struct pollfd *polled)
{
    while (c->left > 0) {
        for (size_t i = 0; i < c->job->workers; i++)
            polled[i] = (struct pollfd){.fd = c->workers[i].answer, .events = POLLIN};
        QDOT_TRY(qdot_interrupt_check());
        if (poll(polled, c->job->workers, 200) < 0 && errno != EINTR)
            return qdot_fail(QDOT_EIO, "workers cannot be heard: %s", strerror(errno));
        for (size_t i = 0; i < c->job->workers; i++)
            if (polled[i].fd >= 0 && (polled[i].revents & (POLLIN | POLLHUP | POLLERR)))
                QDOT_TRY(listen_to(c, &c->workers[i]));
    }
    return QDOT_OK;
}

qdot_status
qdot_workers_run(const qdot_workers_job *job)
{
    crew c = {.job = job, .next = job->first};
    struct pollfd *polled = qdot_calloc(job->workers, sizeof *polled);
    void (*before)(int) = signal(SIGPIPE, SIG_IGN);
    qdot_status status;

    for (size_t k = job->first; k < job->end; k++)
        c.left += !(job->skip && job->skip[k]);
    c.workers = qdot_calloc(job->workers, sizeof *c.workers);
    c.failed = qdot_calloc(job->end - job->first + 1, sizeof *c.failed);
    status = polled && c.workers && c.failed ? QDOT_OK : QDOT_ENOMEM;
    fflush(NULL); /* what waits to be written is written once */
    for (size_t i = 0; i < job->workers && status == QDOT_OK; i++)
        c.workers[i] = (worker){.ask = -1, .answer = -1};
    for (size_t i = 0; i < job->workers && status == QDOT_OK; i++) {
        if (!start(&c, &c.workers[i]))
            status = qdot_fail(QDOT_EIO, "no process can be started: %s", strerror(errno));
        else
            hand_out(&c, &c.workers[i]);
    }
    if (status == QDOT_OK)
        status = carry_out(&c, polled);
    for (size_t i = 0; c.workers && i < job->workers; i++)
        end(&c.workers[i], status != QDOT_OK);
    signal(SIGPIPE, before);
    qdot_free(c.again.at);
    qdot_free(c.failed);
    qdot_free(c.workers);
    qdot_free(polled);
    return status;
}
