/* Scripts in which an allocation and all after it fail, or one call that opens, writes or renames a file: a
 * statement reports it or answers as usual, the session can be used again, and every file is the old one or the
 * whole new one.
 *
 * The n-th call fails, for some n of each script, for all n of a kind of output where QDOT_RELIABILITY is `long`; of
 * calls that write, for all n.
 */
#ifndef _GNU_SOURCE
#define _GNU_SOURCE /* RTLD_NEXT */
#endif
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/memory.h"
#include "lang/talk.h"
#include "own-folder.h"
#include "sanitized.h"
#include "reliability/scripts.h"

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

enum { OUTPUTS = sizeof outputs / sizeof *outputs };

/* --- calls that fail ------------------------------------------------------------------ */

static int64_t calls_left = -1; /* until the one that fails; negative: none does */

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

static void
fail_call(int64_t n)
{
    calls_left = n;
}

/* The statement with the n-th call failing; whether none did. */
static bool
survives(size_t i, void (*fail_at)(int64_t n), int64_t n, const char *whole, size_t length)
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
        fail_msg("%s: call %" PRId64 " fails, and the file that was there is lost", path, n);
    if (!is_whole && ended == 0)
        fail_msg("%s: call %" PRId64 " fails, and nobody hears of it", path, n);
    (void)complaint(k);
    if (say(k, outputs[i].statement) != 0)
        fail_msg("%s: after call %" PRId64 ": %s", path, n, complaint(k));
    end(&data);
    if (own_folder_clean(path) > 0)
        fail_msg("%s: call %" PRId64 " fails, and other files are left", path, n);
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
        int64_t calls, n;

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
        for (n = 0; !survives(i, qdot_memory_fail_at, n, whole, length); n += is_form("long") ? 1 : 1 + n / 10)
            ;
        print_message("# %s: each of %" PRId64 " calls, allocations up to %" PRId64 "\n", outputs[i].file, calls, n);
        if (calls < 3)
            fail_msg("%s: only %" PRId64 " calls could fail", outputs[i].file, calls);
    }
}

/* A script with the n-th allocation failing; whether none did. */
static bool
goes_on(const char *path, int64_t n)
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
        fail_msg("%s: after allocation %" PRId64 ": %s", path, n, complaint(k));
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
        int64_t n = (int64_t)(i % 7), times = 0;

        snprintf(path, sizeof path, "%s/examples/%s.lag", root != NULL ? root : ".", scripts[i]);
        if (access(path, R_OK) != 0)
            continue;
        seen++;
        for (; !goes_on(path, n); times++)
            n += 1 + n / (i < 3 ? 20 : 4);
        (void)own_folder_clean(NULL);
        print_message("# %s: %" PRId64 " of %" PRId64 " allocations\n", scripts[i], times, n);
    }
    if (root != NULL)
        assert_int_equal(seen, SCRIPTS);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(files_are_old_or_whole),
        cmocka_unit_test(any_allocation_may_fail),
    };

    return cmocka_run_group_tests(tests, own_folder_enter, own_folder_leave);
}
