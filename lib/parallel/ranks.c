/* ranks.c -- starts the ranks (MPI processes), shares data of rank 0, notices lost ranks, and ends them all. */
#define _GNU_SOURCE
#include "parallel/ranks.h"

#include <errno.h>
#include <math.h>
#include <signal.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "base/clock.h"
#include "base/memory.h"
#include "parallel/mpi.h"

static const double beat = 1; /* seconds between two messages by which a rank shows that it is alive */
static const double patience = 5; /* seconds of silence after which a waiting or working rank counts as lost */
static const double longest = 30; /* seconds that a rank may be silent at the end, while it computes alone */
enum { GATHERING = 120 };         /* seconds until all ranks must have begun */
enum { PIECE = 1 << 26 };         /* largest number of bytes in one message */

/* Identifies a process on its machine. */
typedef struct {
    uint64_t machine, digits;
    int64_t pid;
} place;

static struct {
    place *places;   /* [ranks] the process of each rank */
    double *heard;   /* [ranks] time of the last message from each rank */
    double beaten;   /* time of the last message by which this rank showed rank 0 that it is alive */
    uint64_t shared; /* number of texts that have been shared with all ranks */
    size_t stuck;    /* number of messages that their receivers have not taken */
    int sentinel;    /* a pipe to the process that watches this rank; -1: there is none */
} ranks = {.sentinel = -1};

/* How a rank ends: together with the other ranks, or alone. */
enum { GO_TOGETHER, GO_ALONE };

static void
sleep_shortly(void)
{
    const struct timespec moment = {.tv_nsec = 1000000};

    nanosleep(&moment, NULL);
}

/* --- identity and start of the ranks ----------------------------------------------------- */

static uint64_t
hash_bytes(uint64_t from, const void *bytes, size_t n)
{
    for (const unsigned char *at = bytes; n > 0; n--)
        from = (from ^ *at++) * 0x100000001b3;
    return from;
}

/* Where a process can be asked for by its number: this start of a machine, and this space of numbers.
 * Where that cannot be known no two are the same. */
static uint64_t
hash_of_this_machine(void)
{
    char bytes[256] = "";
    FILE *file = fopen("/proc/sys/kernel/random/boot_id", "re");
    size_t n = file != NULL ? fread(bytes, 1, 64, file) : 0;
    const ssize_t m = readlink("/proc/self/ns/pid", bytes + n, sizeof bytes - n);
    const pid_t self = getpid();

    if (file != NULL)
        fclose(file);
    if (n == 0 || m <= 0)
        return hash_bytes(hash_bytes(0xcbf29ce484222325, &self, sizeof self), bytes, sizeof bytes);
    return hash_bytes(0xcbf29ce484222325, bytes, n + (size_t)m);
}

/* A hash of results of this C library's functions on this processor, by which machines are compared. */
static uint64_t
hash_of_numerical_results(void)
{
    double (*const functions[])(double) = {sin, cos, tan,  asin, atan,
                                           exp, log, sinh, tanh, cbrt};
    uint64_t all = 0xcbf29ce484222325;

    for (size_t i = 0; i < sizeof functions / sizeof *functions; i++)
        for (int k = 1; k < 64; k++) {
            volatile double x = k / 64.0;
            const double y[] = {functions[i](x), pow(x, 1.3), atan2(x, 0.7)};

            all = hash_bytes(all, y, sizeof y);
        }
    return all;
}

/* A copy of rank 0 that does nothing but wait for its death: mpirun, if it is to recover from deaths,
 * would then leave the others waiting for ever. Before MPI begins, whose connections it must not hold. */
static void
start_watching_process(void)
{
    const pid_t parent = getppid();
    int ends[2];
    char c;

    if (getenv("OMPI_COMM_WORLD_RANK") == NULL || qdot_ranks_are_others() || pipe(ends) != 0)
        return;
    if (fork() == 0) {
        ssize_t n;

        signal(SIGINT, SIG_IGN);
        signal(SIGTERM, SIG_IGN);
        for (int i = 0; i < 256; i++)
            if (i != ends[0])
                close(i);
        do
            n = read(ends[0], &c, 1);
        while (n < 0 && errno == EINTR);
        if (n == 0) {
            sleep(3); /* wait, because without recovery the process has ended by then */
            kill(parent, SIGTERM);
        }
        _exit(0);
    }
    close(ends[0]);
    ranks.sentinel = ends[1];
}

/* End all ranks if MPI_Init, which waits for every rank, does not return because a rank has died. */
static void
end_all_ranks_on_signal(int signal_number)
{
    static const char text[] =
        "qdot: the other ranks have not begun within two minutes\n";

    (void)signal_number;
    _exit(write(STDERR_FILENO, text, sizeof text - 1) < 0 ? 2 : 1);
}

static qdot_status
gather_process_addresses(size_t *kind)
{
    const place here = {hash_of_this_machine(), hash_of_numerical_results(), getpid()};
    int least = (int)*kind;

    ranks.places = qdot_calloc(qdot_ranks_count(), sizeof *ranks.places);
    ranks.heard = qdot_calloc(qdot_ranks_count(), sizeof *ranks.heard);
    if (ranks.places == NULL || ranks.heard == NULL)
        return QDOT_ENOMEM;
    qdot_mpi_least(&least);
    *kind = (size_t)least;
    qdot_mpi_gather(&here, sizeof here, ranks.places);
    for (size_t i = 0; i < qdot_ranks_count(); i++)
        ranks.heard[i] = qdot_wall_now();
    return QDOT_OK;
}

qdot_status
qdot_ranks_begin(size_t *kind)
{
    const char *ours = getenv("OMPI_COMM_WORLD_SIZE"), *others = getenv("PMI_SIZE");
    size_t count = 1, mine = 0;

    if (!qdot_ranks_are_there()) {
        if (others == NULL || atol(others) <= 1)
            return QDOT_OK;
        (void)qdot_fail(QDOT_ENOTBUILT,
                        "%s processes were started by an MPI that is not OpenMPI",
                        others);
        return qdot_hint("mpirun of OpenMPI, or srun --mpi=pmix");
    }
    if (ours != NULL && atol(ours) == 1)
        return QDOT_OK;
    start_watching_process();
    if (ranks.sentinel >= 0 && signal(SIGALRM, end_all_ranks_on_signal) != SIG_ERR)
        alarm(GATHERING);
    QDOT_TRY(qdot_mpi_begin(&count, &mine));
    qdot_rank_set(mine, count);
    QDOT_TRY(gather_process_addresses(kind));
    alarm(0);
    if (ranks.places[qdot_rank()].digits == ranks.places[0].digits)
        return QDOT_OK;
    fprintf(
        stderr,
        "qdot: rank %zu takes no part: its C library has other digits than rank 0's\n",
        qdot_rank());
    (void)qdot_ranks_end(0);
    return QDOT_OK; /* never reached: qdot_ranks_end(0) exits */
}

/* --- messages between ranks ------------------------------------------------------------- */

void
qdot_ranks_send(size_t to, qdot_rank_what what, const void *bytes, size_t n)
{
    if (to == 0)
        ranks.beaten = qdot_wall_now();
    qdot_mpi_send(to, to + 1, what, bytes, n);
}

/* End a rank other than rank 0 in the way that rank 0 commands. */
static void __attribute__((noreturn)) leave(void)
{
    qdot_text word = {0};
    double until;
    size_t from;
    int what;

    qdot_mpi_take(0, QDOT_RANK_END, &word);
    qdot_ranks_send(0, QDOT_RANK_GOODBYE, "", 0);
    until = qdot_wall_now() + 2 * longest; /* rank 0 may have died at the last moment: do not wait longer than this */
    do {
        while (!qdot_mpi_look(&from, &what)) {
            if (qdot_wall_now() > until)
                _exit(0);
            sleep_shortly();
        }
        qdot_mpi_take(from, what, &word);
    } while (what != QDOT_RANK_END);
    if (word.n == 1 && word.at[0] == GO_TOGETHER)
        qdot_mpi_finalize();
    _exit(0);
}

/* Whether a message has arrived; also continues the sending of messages. */
static bool
poll_messages(size_t *from, int *what)
{
    bool come = qdot_mpi_look(from, what);

    (void)qdot_mpi_sending();
    if (come && qdot_rank() > 0 && *what == QDOT_RANK_END)
        leave();
    if (come && qdot_rank() == 0)
        ranks.heard[*from] = qdot_wall_now();
    return come;
}

void
qdot_ranks_beat(void)
{
    if (qdot_wall_now() - ranks.beaten >= beat)
        qdot_ranks_send(0, QDOT_RANK_ALIVE, "", 0);
}

void
qdot_ranks_expect(size_t rank)
{
    ranks.heard[rank] = qdot_wall_now();
}

bool
qdot_ranks_next(qdot_rank_message *m)
{
    int what;

    if (!poll_messages(&m->from, &what))
        return false;
    qdot_mpi_take(m->from, what, &m->bytes);
    m->what = (qdot_rank_what)what;
    return true;
}

bool
qdot_ranks_has_shared(void)
{
    size_t from;
    int what;

    return poll_messages(&from, &what) && what == QDOT_RANK_SHARED;
}

/* Whether the given rank runs on this machine and its process is known to be dead. */
static bool
is_dead(size_t rank)
{
    const place *p = &ranks.places[rank];

    return p->machine == ranks.places[0].machine && kill((pid_t)p->pid, 0) != 0 &&
           errno == ESRCH;
}

bool
qdot_ranks_is_lost(size_t rank)
{
    return is_dead(rank) || qdot_wall_now() - ranks.heard[rank] > patience;
}

/* --- data that rank 0 shares ------------------------------------------------------------- */

/* The header of a text that rank 0 sends in pieces. */
typedef struct {
    uint64_t number, n;
    qdot_error error; /* the error whose status all ranks are to return */
} share_head;

/* Wait while ranks receive what was sent to them; a rank that received nothing is not waited for again. */
static void
wait_until_sent(double seconds)
{
    double last = qdot_wall_now();
    size_t left, before = SIZE_MAX;

    while ((left = qdot_mpi_sending()) > ranks.stuck &&
           qdot_wall_now() - last < seconds) {
        if (left < before)
            last = qdot_wall_now();
        before = left;
        sleep_shortly();
    }
    ranks.stuck = left;
}

static void
send_shared_text(qdot_status status, const qdot_text *text)
{
    share_head h = {.number = ranks.shared, .n = text->n};

    if (status != QDOT_OK)
        h.error = *qdot_last_error();
    h.error.status = status;
    qdot_mpi_send(1, qdot_ranks_count(), QDOT_RANK_SHARED, &h, sizeof h);
    for (size_t i = 0; i < text->n; i += PIECE)
        qdot_mpi_send(1, qdot_ranks_count(), QDOT_RANK_SHARED, text->at + i,
                      text->n - i < PIECE ? text->n - i : PIECE);
    wait_until_sent(patience);
}

static void
receive_piece(qdot_text *piece)
{
    size_t from;
    int what;

    for (;;) {
        if (!poll_messages(&from, &what)) {
            sleep_shortly();
            continue;
        }
        qdot_mpi_take(from, what, piece);
        if (what == QDOT_RANK_SHARED)
            return;
    }
}

static qdot_status
receive_shared_text(qdot_text *text)
{
    qdot_text piece = {0};
    share_head h;

    qdot_text_truncate(text, 0);
    receive_piece(&piece);
    if (piece.n != sizeof h)
        return qdot_fail(QDOT_EFAILED, "rank %zu has lost its place", qdot_rank());
    memcpy(&h, piece.at, sizeof h);
    while (text->n < h.n) {
        receive_piece(&piece);
        qdot_text_add_n(text, qdot_text_str(&piece), piece.n);
        if (qdot_text_status(text) != QDOT_OK || piece.failed)
            break;
    }
    qdot_text_clear(&piece);
    if (h.number != ranks.shared)
        return qdot_fail(QDOT_EFAILED, "rank %zu has lost its place", qdot_rank());
    QDOT_TRY(qdot_text_status(text));
    return h.error.status == QDOT_OK ? QDOT_OK : qdot_fail_again(&h.error);
}

qdot_status
qdot_ranks_share(qdot_status status, qdot_text *text)
{
    if (qdot_ranks_count() == 1)
        return status;
    ranks.shared++;
    if (qdot_rank() > 0)
        return receive_shared_text(text);
    send_shared_text(status, text);
    return status;
}

qdot_status
qdot_ranks_read(qdot_text *text, FILE *from, const char *path, size_t most)
{
    qdot_status status = QDOT_OK;

    if (qdot_rank() == 0 && from == NULL)
        status = qdot_fail(QDOT_EIO, "`%s` cannot be opened: %s", path, strerror(errno));
    else if (qdot_rank() == 0)
        status = qdot_text_read(text, from, path, most);
    return qdot_ranks_share(status, text);
}

/* --- ending all ranks -------------------------------------------------------------------- */

/* Wait for the last messages of ranks that may still answer. Returns how many are missing; *asleep: one may be alive. */
static size_t
wait_for_last_messages(bool *asleep)
{
    bool *gone = qdot_calloc(qdot_ranks_count(), sizeof *gone);
    const double begun = qdot_wall_now();
    qdot_rank_message m = {0};
    size_t waiting = 0;

    *asleep = gone == NULL;
    while (gone != NULL) {
        waiting = 0;
        while (qdot_ranks_next(&m))
            if (m.what == QDOT_RANK_GOODBYE)
                gone[m.from] = true;
        *asleep = false;
        for (size_t i = 1; i < qdot_ranks_count(); i++) {
            waiting += !gone[i];
            *asleep = *asleep || (!gone[i] && !is_dead(i));
        }
        if (!*asleep || qdot_wall_now() - begun > longest)
            break;
        sleep_shortly();
    }
    qdot_text_clear(&m.bytes);
    qdot_free(gone);
    return waiting;
}

static int
end_all_ranks(int status)
{
    bool asleep;
    size_t lost;
    char word;

    fflush(NULL);
    qdot_mpi_send(1, qdot_ranks_count(), QDOT_RANK_END, "", 0);
    lost = wait_for_last_messages(&asleep);
    if (lost > 0)
        fprintf(stderr, "qdot: %zu of %zu ranks were lost\n", lost, qdot_ranks_count());
    if (ranks.sentinel >= 0 && write(ranks.sentinel, "", 1) != 1)
        lost += 0; /* the watching process has already ended: nothing to do */
    if (asleep)
        qdot_mpi_abort(status);
    word = lost > 0 ? GO_ALONE : GO_TOGETHER;
    qdot_mpi_send(1, qdot_ranks_count(), QDOT_RANK_END, &word, 1);
    if (lost > 0) { /* do not call MPI_Finalize, which would wait for the lost ranks */
        wait_until_sent(1);
        _exit(status);
    }
    qdot_mpi_finalize();
    return status;
}

int
qdot_ranks_end(int status)
{
    qdot_rank_message m = {0};

    if (qdot_ranks_count() == 1)
        return status;
    if (qdot_rank() == 0)
        return end_all_ranks(status);
    for (;;) /* wait until a message ends this process */
        if (!qdot_ranks_next(&m))
            sleep_shortly();
}
