/* sink.c -- writes a file under a temporary name, reports every failure, and renames it at the end. */
#include "base/sink.h"

#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/memory.h"
#include "base/process.h"
#include "base/text.h"

static qdot_status
report_write_failure(const qdot_sink *sink, int reason)
{
    if (strcmp(sink->path, "-") == 0)
        return qdot_fail(QDOT_EIO, "cannot write standard output: %s", strerror(reason));
    return qdot_fail(QDOT_EIO, "cannot write `%s`: %s", sink->path, strerror(reason));
}

/* The file that the path names, behind links; *old: what it is now, .st_mode 0: nothing yet. *direct: it is
 * written itself. */
static qdot_status
find_target_file(qdot_sink *sink, struct stat *old, bool *direct)
{
    char *real;

    *old = (struct stat){0};
    *direct = strncmp(sink->path, "/dev/", 5) == 0 || strncmp(sink->path, "/proc/", 6) == 0;
    if (*direct)
        return QDOT_OK;
    if (stat(sink->path, old) != 0) {
        if (errno != ENOENT)
            return report_write_failure(sink, errno);
        *old = (struct stat){0};
        /* the path is a link to a file that does not exist yet: write directly */
        *direct = lstat(sink->path, &(struct stat){0}) == 0;
    } else if (S_ISDIR(old->st_mode)) {
        return report_write_failure(sink, EISDIR);
    } else if (!S_ISREG(old->st_mode)) {
        *direct = true;
    } else if (access(sink->path, W_OK) != 0) {
        return report_write_failure(sink, errno);
    }
    if (*direct)
        return QDOT_OK;
    real = old->st_mode != 0 ? realpath(sink->path, NULL) : NULL;
    if (old->st_mode != 0 && real == NULL)
        return report_write_failure(sink, errno);
    sink->place = qdot_strdup(real != NULL ? real : sink->path);
    free(real);
    return sink->place != NULL ? QDOT_OK : QDOT_ENOMEM;
}

/* Create a new file, of a unique name, in the folder of the target. */
static qdot_status
create_temporary_file(qdot_sink *sink, const struct stat *old)
{
    const char *slash = strrchr(sink->place, '/');
    const int folder = slash != NULL ? (int)(slash + 1 - sink->place) : 0;
    qdot_status status;
    int fd = -1;

    for (int k = 0; fd < 0; k++) {
        qdot_text name = {0};

        qdot_text_format(&name, "%.*s.qdot-%" PRId64 "-%d.part", folder, sink->place, (int64_t)getpid(), k);
        qdot_free(sink->beside);
        sink->beside = NULL;
        if (qdot_text_status(&name) != QDOT_OK) {
            qdot_text_clear(&name);
            return QDOT_ENOMEM;
        }
        sink->beside = name.at;
        fd = open(sink->beside, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (fd < 0 && errno != EEXIST)
            return report_write_failure(sink, errno);
    }
    if (old->st_mode != 0)
        (void)!fchmod(fd, old->st_mode & 07777);
    sink->file = fdopen(fd, "wb");
    if (sink->file != NULL)
        return QDOT_OK;
    status = report_write_failure(sink, errno);
    (void)close(fd);
    (void)unlink(sink->beside);
    return status;
}

static void
sink_free_names(qdot_sink *sink)
{
    qdot_free(sink->beside);
    qdot_free(sink->place);
    sink->beside = sink->place = NULL;
}

qdot_status
qdot_sink_open(qdot_sink *sink, const char *path)
{
    qdot_status status;
    struct stat old;
    bool direct;

    *sink = (qdot_sink){.path = path};
    if (path[0] == '\0')
        return qdot_fail(QDOT_EINVAL, "a file needs a name");
    if (qdot_rank() > 0 || strcmp(path, "-") == 0) { /* with MPI only the process of rank 0 writes files */
        sink->file = qdot_rank() > 0 ? fopen("/dev/null", "wbe") : stdout;
        return sink->file != NULL ? QDOT_OK : report_write_failure(sink, errno);
    }
    status = find_target_file(sink, &old, &direct);
    if (status == QDOT_OK && direct) {
        sink->file = fopen(path, "wbe");
        if (sink->file == NULL)
            status = report_write_failure(sink, errno);
    } else if (status == QDOT_OK) {
        status = create_temporary_file(sink, &old);
    }
    if (status != QDOT_OK)
        qdot_sink_abandon(sink);
    return status;
}

/* Not by stdio, which drops what remains of its buffer when a signal interrupts it. */
bool
qdot_sink_write_to(FILE *file, const char *bytes, size_t length)
{
    const int fd = fileno(file);

    if (fflush(file) != 0)
        return false;
    if (fd < 0) /* a stream in memory */
        return fwrite(bytes, 1, length, file) == length && fflush(file) == 0;
    while (length > 0) {
        const ssize_t n = write(fd, bytes, length);

        if (n < 0 && errno != EINTR)
            return false;
        bytes += n > 0 ? n : 0;
        length -= n > 0 ? (size_t)n : 0;
    }
    return true;
}

qdot_status
qdot_sink_put(qdot_sink *sink, const char *bytes, size_t length)
{
    return fwrite(bytes, 1, length, sink->file) == length ? QDOT_OK : report_write_failure(sink, errno);
}

qdot_status
qdot_sink_close(qdot_sink *sink)
{
    FILE *file = sink->file;
    qdot_status status;
    int reason = 0;

    sink->file = NULL;
    errno = 0;
    if (fflush(file) != 0 || ferror(file))
        reason = errno != 0 ? errno : EIO;
    if (file != stdout && fclose(file) != 0 && reason == 0)
        reason = errno;
    if (reason == 0 && sink->place != NULL && rename(sink->beside, sink->place) != 0)
        reason = errno;
    status = reason == 0 ? QDOT_OK : report_write_failure(sink, reason);
    if (reason != 0 && sink->beside != NULL)
        (void)unlink(sink->beside);
    sink_free_names(sink);
    return status;
}

void
qdot_sink_abandon(qdot_sink *sink)
{
    if (sink->file != NULL && sink->file != stdout)
        (void)fclose(sink->file);
    if (sink->file != NULL && sink->beside != NULL)
        (void)unlink(sink->beside);
    sink->file = NULL;
    sink_free_names(sink);
}

qdot_status
qdot_sink_write(const char *path, const char *bytes, size_t length)
{
    qdot_sink sink;
    qdot_status status;

    QDOT_TRY(qdot_sink_open(&sink, path));
    status = qdot_sink_put(&sink, bytes, length);
    if (status == QDOT_OK)
        return qdot_sink_close(&sink);
    qdot_sink_abandon(&sink);
    return status;
}

bool
qdot_sink_is_free(const char *path, const char *mark)
{
    const size_t length = strlen(mark);
    char head[64];
    struct stat info;
    FILE *file;
    bool ours;

    if (stat(path, &info) != 0)
        return errno == ENOENT;
    /* only a regular file is opened: opening a pipe would block */
    file = S_ISREG(info.st_mode) ? fopen(path, "rbe") : NULL;
    if (file == NULL)
        return false;
    ours = length <= sizeof head && fread(head, 1, length, file) == length
           && memcmp(head, mark, length) == 0;
    (void)fclose(file);
    return ours;
}
