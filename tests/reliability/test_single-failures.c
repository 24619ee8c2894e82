/* Scripts in which one allocation alone fails, statement by statement: the statement reports it or answers as usual,
 * and the session can be used again.
 *
 * The n-th allocation of each statement, for some n of ten scripts; by QDOT_RELIABILITY of all scripts, or of the
 * examples that are named behind the program:
 *
 *     long     every n
 *     share    every n, but of what the thread for exact computations allocates in one of them only every SHARE-th after
 *              the first SPAN: whichever it is, the computation is left as a whole
 *     places   the first EACH_PLACE of each chain of functions that come to an allocation
 *     97       every 97th
 */
#ifndef _GNU_SOURCE
#define _GNU_SOURCE /* MAP_ANONYMOUS */
#endif
#include <execinfo.h>
#include <inttypes.h>
#include <pthread.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/memory-failure.h"
#include "base/process.h"
#include "lang/talk.h"
#include "own-folder.h"
#include "reliability/scripts.h"

/* n where QDOT_RELIABILITY is a number n: every n-th allocation fails; else 0. */
static int64_t
stride(void)
{
    const char *form = getenv("QDOT_RELIABILITY");

    return form != NULL ? strtoll(form, NULL, 10) : 0;
}

/* What a copy of this process found: it carries out one statement with one failure and ends. Each costs no more than
 * the statement, for what the script did before is there. */
static struct found {
    int64_t left; /* allocations until the failure; negative: it came */
    int ended; /* the statement's status */
    size_t n;
    char text[1 << 20]; /* what it said */
} *found, *usual;

enum { GONE_WRONG = 3 };

/* The text [n] without lines that state times, which differ from run to run; its length. */
static size_t
without_times(char *text, size_t n)
{
    size_t kept = 0;

    for (size_t at = 0, length; at < n; at += length) {
        const char *end = memchr(text + at, '\n', n - at);
        bool timed = false;

        length = end != NULL ? (size_t)(end - text) - at + 1 : n - at;
        for (size_t i = at; i + 3 < at + length && !timed; i++)
            timed = strncmp(text + i, " s\n", 3) == 0 || strncmp(text + i, " s,", 3) == 0
                    || strncmp(text + i, "cpu", 3) == 0;
        if (!timed) {
            memmove(text + kept, text + at, length);
            kept += length;
        }
    }
    return kept;
}

static void
begin_to_fail(int64_t n)
{
    signal(SIGSEGV, SIG_DFL); /* cmocka's would go on with its tests */
    signal(SIGABRT, SIG_DFL);
    signal(SIGFPE, SIG_DFL);
    (void)qdot_memory_fail_once_at(n);
}

/* Write how the statement ended to `told`, try the session with further statements, and end this copy. */
static _Noreturn void
tell_and_exit(talk *k, int ended, struct found *told)
{
    void *data = k;
    const char *out, *err;

    told->ended = ended;
    told->left = qdot_memory_fail_once_at(-1);
    qdot_memory_visit_at(-1, NULL);
    fflush(k->out);
    fflush(k->err);
    out = k->out_text;
    err = k->err_text;
    told->n = (size_t)snprintf(told->text, sizeof told->text, "%.*s%.*s", (int)ftell(k->out), out,
                               (int)ftell(k->err), err);
    if (told->n >= sizeof told->text)
        told->n = sizeof told->text - 1;
    told->n = without_times(told->text, told->n);
    (void)complaint(k);
    if (say(k, "check 1 + 1 == 2\nreset\ncheck 1 + 1 == 2") != 0)
        _exit(GONE_WRONG);
    end(&data);
    _exit(0);
}

/* The session, the script and the statement at hand; of the script, how many failures were tried, how many went wrong,
 * and how many allocations there were. */
static struct {
    talk *k;
    const char *script, *statement;
} now;
static struct counts {
    int64_t times, bad, seen;
} *counts; /* shared with copies of this process */

/* Whether a copy of this process ended well. */
static bool
copy_ends_well(pid_t copy, int64_t n)
{
    int status;

    assert_int_equal(waitpid(copy, &status, 0), copy);
    if (status != 0)
        print_message("# %s: allocation %" PRId64 " fails, and the status is %#x:\n%s\n", now.script, n, status,
                      now.statement);
    return status == 0;
}

static bool
says_the_usual(void)
{
    return found->n == usual->n && memcmp(found->text, usual->text, usual->n) == 0;
}

/* Whether what was printed mentions memory, the reason why it is not the usual text. */
static bool
says_why(void)
{
    found->text[found->n < sizeof found->text ? found->n : sizeof found->text - 1] = '\0';
    return strstr(found->text, "memory") != NULL;
}

/* Wait for the copy in which the n-th allocation was to fail and count its result; false if it had fewer
 * allocations. */
static bool
count_copy(pid_t copy, int64_t n)
{
    const bool well = copy_ends_well(copy, n);

    if (well && found->left >= 0)
        return false;
    counts->times++;
    if (!well)
        counts->bad++;
    else if (found->ended == 0 && !says_the_usual() && !says_why()) {
        counts->bad++;
        print_message("# %s: allocation %" PRId64 " fails, and what is said is another:\n%s\n# usual\n%.*s# now\n%.*s",
                      now.script, n, now.statement, (int)usual->n, usual->text, (int)found->n, found->text);
    }
    return true;
}

/* The statement from its beginning in a copy of this process, with the n-th allocation failing (negative: none). */
static pid_t
carry_out_in_copy(int64_t n, struct found *told)
{
    const pid_t copy = fork();

    assert_true(copy >= 0);
    if (copy > 0)
        return copy;
    (void)heard(now.k);
    (void)complaint(now.k);
    begin_to_fail(n);
    tell_and_exit(now.k, say(now.k, now.statement), told);
}

/* --- each allocation, from copies made on the way ------------------------------------------- */

/* A copy of this process carries out the statement, and at every SPAN-th allocation stops to make copies of itself: in
 * each of them another of the next SPAN allocations fails. So a failure costs what comes after it, and not what came
 * before. Only the main thread makes copies, and while no other works (a copy has no thread but its own): SPAN is the
 * least. Runs begin no threads for it (qdot_threads_are_taken). */
enum { SPAN = 400, SLACK = 16, SHARE = 16 }; /* a copy begins a thread for FLINT, which costs some allocations */

/* Where allocations come from: the functions that are at work, as one number. QDOT_RELIABILITY=places fails EACH_PLACE
 * allocations of each of them in a statement, where `long` fails all. */
enum { FRAMES = 64, EACH_PLACE = 2, PLACES = 1 << 16, MOST_OF_SPAN = 1 << 22 };

static struct places {
    struct place {
        uint64_t frames;
        int times;
    } at[PLACES];
    int64_t n;
    bool is_new[MOST_OF_SPAN]; /* of the allocations of a span */
} *places; /* NULL: all fail */

static uint64_t
place_of_call(void)
{
    void *frame[FRAMES];
    const int n = backtrace(frame, FRAMES);
    uint64_t all = 1469598103934665603u;

    for (int i = 0; i < n; i++)
        all = (all ^ (uint64_t)(uintptr_t)frame[i]) * 1099511628211u;
    return all + (all == 0);
}

/* Whether few allocations of this place have failed; it counts as one of them. */
static bool
is_new_place(uint64_t frames)
{
    for (size_t i = frames % PLACES;; i = (i + 1) % PLACES) {
        struct place *p = places->at + i;

        if (p->frames == 0 && places->n < PLACES / 2) {
            p->frames = frames;
            places->n++;
        }
        if (p->frames == frames)
            return p->times++ < EACH_PLACE;
        if (p->frames == 0)
            return true; /* no room to remember it */
    }
}

static pid_t walker; /* the copy that carries out the statement with nothing failing */
static pthread_t main_thread;
static int64_t passed, *span; /* allocations since copies were made; how many until the next are, or the statement ends */

/* In a copy: count the allocations up to the next at which copies can be made, in *span, and end there. */
static void
measure_span(void)
{
    if (places != NULL && *span < MOST_OF_SPAN)
        places->is_new[*span] = is_new_place(place_of_call());
    if (++*span > SPAN && pthread_equal(pthread_self(), main_thread))
        _exit(0);
    qdot_memory_visit_at(0, measure_span);
}

/* Make a copy for each allocation of the next span, which fails in it; in the copy it returns, and the statement
 * goes on towards the failure. */
static void
fail_each_of_span(void)
{
    pid_t copy;

    *span = 0;
    copy = fork();
    assert_true(copy >= 0);
    if (copy == 0) {
        measure_span();
        return;
    }
    if (!copy_ends_well(copy, -1))
        counts->bad++;
    for (int64_t n = 0; n < *span + SLACK; n += is_form("share") && n >= SPAN ? SHARE : 1) {
        if (places != NULL && (n >= *span || (n < MOST_OF_SPAN && !places->is_new[n])))
            continue;
        found->left = -1;
        copy = fork();
        assert_true(copy >= 0);
        if (copy == 0) {
            begin_to_fail(n);
            return;
        }
        if (!count_copy(copy, n))
            break;
    }
    counts->seen += *span - 1;
}

static void
walk(void)
{
    if (getpid() != walker)
        return;
    if (++passed >= SPAN && pthread_equal(pthread_self(), main_thread)) {
        passed = 0;
        fail_each_of_span();
    }
    if (getpid() == walker)
        qdot_memory_visit_at(0, walk);
}

static void
fail_each_on_the_way(void)
{
    const pid_t copy = fork();
    int ended;

    assert_true(copy >= 0);
    if (copy > 0) {
        if (!copy_ends_well(copy, -1))
            counts->bad++;
        return;
    }
    (void)heard(now.k);
    (void)complaint(now.k);
    walker = getpid();
    main_thread = pthread_self();
    passed = SPAN;
    qdot_memory_visit_at(0, walk);
    ended = say(now.k, now.statement); /* in the walker, and in each copy made on the way */
    tell_and_exit(now.k, ended, getpid() == walker ? usual : found);
}

/* Let the n-th allocation fail, each time from the beginning of the statement: every stride()-th n, or growing n. */
static void
fail_some(void)
{
    for (int64_t n = 0; count_copy(carry_out_in_copy(n, found), n); n += stride() > 0 ? stride() : 3 + n)
        found->left = -1;
}

/* The next statement of a script, which is read on until nothing is open; NULL at its end. To be freed. */
static char *
next_statement(FILE *file)
{
    char *all = NULL, *line = NULL;
    size_t n = 0, room = 0;
    ssize_t got;

    while ((got = getline(&line, &room, file)) > 0) {
        all = realloc(all, n + (size_t)got + 1);
        assert_non_null(all);
        memcpy(all + n, line, (size_t)got + 1);
        n += (size_t)got;
        if (!qdot_script_is_incomplete(all, n))
            break;
    }
    free(line);
    return all;
}

/* Links in this folder to the tables (*.csv) beside the script. */
static void
link_data(const char *path)
{
    char folder[4096], from[8192];
    DIR *all;

    snprintf(folder, sizeof folder, "%.*s", (int)(strrchr(path, '/') - path), path);
    all = opendir(folder);
    assert_non_null(all);
    for (struct dirent *e = readdir(all); e != NULL; e = readdir(all))
        if (strstr(e->d_name, ".csv") != NULL) {
            snprintf(from, sizeof from, "%s/%s", folder, e->d_name);
            assert_int_equal(symlink(from, e->d_name), 0);
        }
    closedir(all);
}

static void
fail_each_of(const char *script, const char *path)
{
    FILE *file = fopen(path, "r");
    void *data;
    char *statement;

    assert_non_null(file);
    assert_int_equal(begin(&data), 0);
    now.k = data;
    now.script = script;
    *counts = (struct counts){0};
    link_data(path);
    while ((statement = next_statement(file)) != NULL) {
        if (statement[strspn(statement, " \n")] != '#' && statement[strspn(statement, " \n")] != '\0') {
            now.statement = statement;
            assert_true(copy_ends_well(carry_out_in_copy(-1, usual), -1));
            found->left = -1;
            if (places != NULL)
                memset(places->at, 0, sizeof places->at), places->n = 0;
            if (is_form("long") || is_form("share") || places != NULL)
                fail_each_on_the_way();
            else
                fail_some();
            (void)say(now.k, statement);
        }
        free(statement);
    }
    fclose(file);
    end(&data);
    (void)own_folder_clean(NULL);
    print_message("# %s: each alone of %" PRId64 " allocations, %" PRId64 " of them not survived or without a word\n", script,
                  counts->times, counts->bad);
    if (counts->seen > 0)
        print_message("# %s: %" PRId64 " allocations in all\n", script, counts->seen);
    assert_int_equal(counts->bad, 0);
}

static char **chosen; /* examples by name; none: the scripts */

static void
fail_each_of_example(const char *name)
{
    const char *root = getenv("top_srcdir");
    char path[4096];

    snprintf(path, sizeof path, "%s/examples/%s.lag", root != NULL ? root : ".", name);
    if (access(path, R_OK) == 0)
        fail_each_of(name, path);
    else if (root != NULL || *chosen != NULL)
        fail_msg("%s cannot be read", path);
}

static void
one_allocation_alone_may_fail(void **state)
{
    const bool every = is_form("long") || is_form("share"), all = every || is_form("places") || stride() > 0;
    struct {
        struct found found, usual;
        struct counts counts;
        struct places places;
        int64_t span;
    } *shared;

    (void)state;
    shared = mmap(NULL, sizeof *shared, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    assert_true(shared != MAP_FAILED);
    found = &shared->found;
    usual = &shared->usual;
    counts = &shared->counts;
    span = &shared->span;
    places = is_form("places") ? &shared->places : NULL;
    qdot_threads_are_taken = every || places != NULL;
    for (size_t i = 0; i < SCRIPTS && *chosen == NULL; i++)
        if (all || i % 4 == 0)
            fail_each_of_example(scripts[i]);
    for (char **one = chosen; *one != NULL; one++)
        fail_each_of_example(*one);
    qdot_threads_are_taken = false;
    (void)munmap(shared, sizeof *shared);
}

int
main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_allocation_alone_may_fail),
    };

    chosen = argv + (argc > 0);
    return cmocka_run_group_tests(tests, own_folder_enter, own_folder_leave);
}
