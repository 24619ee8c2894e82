/* Scripts in which one allocation, or one call that opens, writes or renames a file, fails: they say so or are
 * none the worse, the session can be used again, and every file is the old one or the whole new one.
 *
 * The n-th call fails, for some n of each script, for all n where QDOT_RELIABILITY is `long`; of calls that write,
 * for all n. `QDOT_RELIABILITY=long test_failures [SCRIPT...]` is the whole of these scripts, of all if there is none;
 * `QDOT_RELIABILITY=97` every 97th.
 */
#ifndef _GNU_SOURCE
#define _GNU_SOURCE /* RTLD_NEXT */
#endif
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/memory.h"
#include "base/memory-failure.h"
#include "lang/talk.h"
#include "own-folder.h"
#include "sanitized.h"

static const char *const scripts[] = {
    "virtual-work", "holonomic-in-disguise", "bowling-ball", "peaucellier", "polar", "over-the-edge", "geometry",
    "consistent-start", "generalized-momenta", "static-equilibrium", "velocity", "rolling-disk", "cylindrical",
    "sensitivity", "pendulum-period", "rolling-wheel", "half-pipe", "degrees-of-freedom", "spherical",
    "knife-edge", "bead-on-wire", "line-element", "slider-crank", "boundary-value", "metrics", "hamiltonian",
    "vector-operators", "acceleration-constraint", "curvature", "modes", "four-bar", "tautochrone", "routh",
    "kepler", "kinetic-energy", "car-axis", "fit", "rotating-hoop", "collision", "dry-friction",
};

/* What writes a file of each kind. */
static const char scene[] = "coord x\nparticle p mass 1 at x\npotential x^2/2\nstart x = 1\nrun 0..2 as a\n";
static const struct {
    const char *file, *statement;
} outputs[] = {
    {"a.csv", "table x, x' every 1/2 to \"a.csv\""},
    {"a.json", "table x, x' every 1/2 to \"a.json\""},
    {"a.html", "table x, x' every 1/2 to \"a.html\""},
    {"a.h5", "save a to \"a.h5\""},
    {"a.lag", "save session to \"a.lag\""},
    {"a.tex", "eom to \"a.tex\""},
    {"a.py", "export python eom to \"a.py\""},
};

enum { OUTPUTS = sizeof outputs / sizeof *outputs, SCRIPTS = sizeof scripts / sizeof *scripts };

/* --- calls that fail ------------------------------------------------------------------ */

static long calls_left = -1; /* until the one that fails; negative: none does */

static bool
must_fail(void)
{
    if (calls_left < 0 || calls_left-- > 0)
        return false;
    errno = ENOSPC;
    return true;
}

/* Not one of the session's, whose answers are kept in memory. */
static bool
is_on_disk(FILE *file)
{
    return fileno(file) > STDERR_FILENO;
}

/* In place of those of the C library, for all of this program. */
#define REAL(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))

size_t
fwrite(const void *bytes, size_t size, size_t n, FILE *file)
{
    return is_on_disk(file) && must_fail() ? 0 : REAL(fwrite)(bytes, size, n, file);
}

int
rename(const char *from, const char *to)
{
    return must_fail() ? -1 : REAL(rename)(from, to);
}

FILE *
fdopen(int fd, const char *mode)
{
    return must_fail() ? NULL : REAL(fdopen)(fd, mode);
}

#ifndef SANITIZED /* AddressSanitizer keeps a list of open memory streams by its own fclose */
int
fclose(FILE *file)
{
    const bool fails = is_on_disk(file) && must_fail();
    const int closed = REAL(fclose)(file);

    return fails ? EOF : closed;
}
#endif

/* --- files ------------------------------------------------------------------------------ */

static char *
contents(const char *path, size_t *n)
{
    static char both[2][1 << 16];
    static int next;
    char *bytes = both[next ^= 1];
    const int fd = open(path, O_RDONLY);
    ssize_t got = fd < 0 ? -1 : read(fd, bytes, sizeof both[0]);

    *n = got > 0 ? (size_t)got : 0;
    if (fd >= 0)
        close(fd);
    return fd < 0 ? NULL : bytes;
}

static void
put_old(const char *path)
{
    const char *old = strcmp(path, "a.lag") == 0 ? "# a scene written by qdot\n" : "old\n";
    const int fd = open(path, O_WRONLY | O_CREAT | O_TRUNC, 0666);

    assert_true(fd >= 0);
    assert_int_equal(write(fd, old, strlen(old)), strlen(old));
    close(fd);
}

/* --- both ------------------------------------------------------------------------------- */

static bool
is_long(void)
{
    const char *form = getenv("QDOT_RELIABILITY");

    return form != NULL && strcmp(form, "long") == 0;
}

/* QDOT_RELIABILITY as a number: every so many-th allocation; else 0. */
static long
stride(void)
{
    const char *form = getenv("QDOT_RELIABILITY");

    return form != NULL ? strtol(form, NULL, 10) : 0;
}

static void
fail_call(long n)
{
    calls_left = n;
}

/* The statement with the n-th call failing; whether none did. */
static bool
survives(size_t i, void (*fail_at)(long n), long n, const char *whole, size_t length)
{
    const char *path = outputs[i].file;
    struct stat st;
    size_t before, after;
    void *data;
    talk *k;
    bool is_whole, done;
    char *bytes;
    int ended;

    put_old(path);
    assert_int_equal(stat(path, &st), 0);
    before = (size_t)st.st_size;
    assert_int_equal(begin(&data), 0);
    k = data;
    if (say(k, scene) != 0)
        fail_msg("%s", complaint(k));
    fail_at(n);
    ended = say(k, outputs[i].statement);
    done = fail_at == fail_call ? calls_left >= 0 : ended == 0;
    fail_at(-1);
    bytes = contents(path, &after);
    assert_non_null(bytes);
    is_whole = after == length && memcmp(bytes, whole, length) == 0;
    if (!is_whole && after != before)
        fail_msg("%s: call %ld fails, and the file that was there is lost", path, n);
    if (!is_whole && ended == 0)
        fail_msg("%s: call %ld fails, and nobody hears of it", path, n);
    (void)complaint(k);
    if (say(k, outputs[i].statement) != 0)
        fail_msg("%s: after call %ld: %s", path, n, complaint(k));
    end(&data);
    if (own_folder_clean(path) > 0)
        fail_msg("%s: call %ld fails, and other files are left", path, n);
    return done;
}

static void
files_are_old_or_whole(void **state)
{
    static char whole[1 << 16];
    size_t length;

    (void)state;
    for (size_t i = 0; i < OUTPUTS; i++) {
        void *data;
        talk *k;
        char *bytes;
        long calls, n;

        assert_int_equal(begin(&data), 0);
        k = data;
        put_old(outputs[i].file);
        if (say(k, scene) != 0 || say(k, outputs[i].statement) != 0)
            fail_msg("%s: %s", outputs[i].file, complaint(k));
        bytes = contents(outputs[i].file, &length);
        assert_non_null(bytes);
        memcpy(whole, bytes, length);
        end(&data);
        (void)own_folder_clean(NULL);
        for (calls = 0; !survives(i, fail_call, calls, whole, length); calls++)
            ;
        for (n = 0; !survives(i, qdot_memory_fail_at, n, whole, length); n += is_long() ? 1 : 1 + n / 10)
            ;
        print_message("# %s: each of %ld calls, allocations up to %ld\n", outputs[i].file, calls, n);
        if (calls < 3)
            fail_msg("%s: only %ld calls could fail", outputs[i].file, calls);
    }
}

/* A script with the n-th allocation failing; whether none did. */
static bool
goes_on(const char *path, long n)
{
    void *data;
    talk *k;
    int ended;

    assert_int_equal(begin(&data), 0);
    k = data;
    qdot_memory_fail_at(n);
    ended = qdot_script_run_file(k->session, path);
    qdot_memory_fail_at(-1);
    (void)complaint(k);
    if (say(k, "reset\ncheck 1 + 1 == 2") != 0)
        fail_msg("%s: after allocation %ld: %s", path, n, complaint(k));
    end(&data);
    return ended == 0;
}

static void
any_allocation_may_fail(void **state)
{
    const char *root = getenv("top_srcdir");
    size_t seen = 0;

    (void)state;
    for (size_t i = 0; i < SCRIPTS; i++) {
        char path[4096];
        long n = (long)(i % 7), times = 0;

        snprintf(path, sizeof path, "%s/examples/%s.lag", root != NULL ? root : ".", scripts[i]);
        if (access(path, R_OK) != 0)
            continue;
        seen++;
        for (; !goes_on(path, n); times++)
            n += 1 + n / (i < 3 ? 20 : 4);
        (void)own_folder_clean(NULL);
        print_message("# %s: %ld of %ld allocations\n", scripts[i], times, n);
    }
    if (root != NULL)
        assert_int_equal(seen, SCRIPTS);
}

/* --- one allocation alone, statement by statement ----------------------------------------- */

/* What a copy of this process found: it carries out one statement with one failure and ends. Each costs no more than
 * the statement, for what the script did before is there. */
static struct found {
    long left; /* allocations until the failure; negative: it came */
    int ended; /* the statement's status */
    size_t n;
    char text[1 << 20]; /* what it said */
} *found, *usual;

enum { GONE_WRONG = 3 };

/* A line that tells how long it took says so each time in other words. */
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
carry_out_in_copy(talk *k, const char *statement, long n, struct found *told)
{
    void *data = k;
    const char *out, *err;

    (void)heard(k);
    (void)complaint(k);
    signal(SIGSEGV, SIG_DFL); /* cmocka's would go on with its tests */
    signal(SIGABRT, SIG_DFL);
    signal(SIGFPE, SIG_DFL);
    (void)qdot_memory_fail_once_at(n);
    told->ended = say(k, statement);
    told->left = qdot_memory_fail_once_at(-1);
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

/* The statement in a copy of this process, with the n-th allocation failing (negative: none). Whether it ended well. */
static bool
in_copy(talk *k, const char *script, const char *statement, long n, struct found *told)
{
    const pid_t copy = fork();
    int status;

    assert_true(copy >= 0);
    if (copy == 0)
        carry_out_in_copy(k, statement, n, told);
    assert_int_equal(waitpid(copy, &status, 0), copy);
    if (status != 0)
        print_message("# %s: allocation %ld fails, and the status is %#x:\n%s\n", script, n, status, statement);
    return status == 0;
}

static bool
says_the_usual(void)
{
    return found->n == usual->n && memcmp(found->text, usual->text, usual->n) == 0;
}

/* Whether a notice or an answer says that something could not be had. */
static bool
says_why(void)
{
    found->text[found->n < sizeof found->text ? found->n : sizeof found->text - 1] = '\0';
    return strstr(found->text, "memory") != NULL;
}

/* Each n of a statement, or some; how many there were. */
static long
fail_each(talk *k, const char *script, const char *statement, long *bad)
{
    long times = 0;

    assert_true(in_copy(k, script, statement, -1, usual));
    for (long n = 0;; n += is_long() ? 1 : stride() > 0 ? stride() : 3 + n) {
        found->left = -1;
        if (!in_copy(k, script, statement, n, found)) {
            times++;
            ++*bad;
            continue;
        }
        if (found->left >= 0)
            return times;
        times++;
        if (found->ended == 0 && !says_the_usual() && !says_why()) {
            ++*bad;
            print_message("# %s: allocation %ld fails, and what is said is another:\n%s\n# usual\n%.*s# now\n%.*s",
                          script, n, statement, (int)usual->n, usual->text, (int)found->n, found->text);
        }
    }
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

/* The files beside the script, by their names in this folder. */
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
    long times = 0, bad = 0;
    void *data;
    char *statement;
    talk *k;

    assert_non_null(file);
    assert_int_equal(begin(&data), 0);
    k = data;
    link_data(path);
    while ((statement = next_statement(file)) != NULL) {
        if (statement[strspn(statement, " \n")] != '#' && statement[strspn(statement, " \n")] != '\0') {
            times += fail_each(k, script, statement, &bad);
            (void)say(k, statement);
        }
        free(statement);
    }
    fclose(file);
    end(&data);
    (void)own_folder_clean(NULL);
    print_message("# %s: each alone of %ld allocations, %ld of them not survived or without a word\n", script, times,
                  bad);
    assert_int_equal(bad, 0);
}

static char **chosen; /* scripts, if not all */

static bool
is_chosen(size_t i)
{
    if (*chosen == NULL)
        return is_long() || stride() > 0 || i % 4 == 0;
    for (char **one = chosen; *one != NULL; one++)
        if (strcmp(*one, scripts[i]) == 0)
            return true;
    return false;
}

static void
one_allocation_alone_may_fail(void **state)
{
    const char *root = getenv("top_srcdir");

    (void)state;
    found = mmap(NULL, 2 * sizeof *found, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    assert_true(found != MAP_FAILED);
    usual = found + 1;
    for (size_t i = 0; i < SCRIPTS; i++) {
        char path[4096];

        snprintf(path, sizeof path, "%s/examples/%s.lag", root != NULL ? root : ".", scripts[i]);
        if (is_chosen(i) && access(path, R_OK) == 0)
            fail_each_of(scripts[i], path);
    }
    (void)munmap(found, 2 * sizeof *found);
}

int
main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(files_are_old_or_whole),
        cmocka_unit_test(any_allocation_may_fail),
        cmocka_unit_test(one_allocation_alone_may_fail),
    };
    const struct CMUnitTest chosen_tests[] = {
        cmocka_unit_test(one_allocation_alone_may_fail),
    };

    chosen = argv + (argc > 0);
    if (*chosen != NULL)
        return cmocka_run_group_tests(chosen_tests, own_folder_enter, own_folder_leave);
    return cmocka_run_group_tests(tests, own_folder_enter, own_folder_leave);
}
