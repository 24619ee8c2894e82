/* sink.c -- writing a file and hearing of every failure. */
#include "show/sink.h"

#include <errno.h>
#include <string.h>

#include "base/ranks.h"

static qdot_status
lost(const qdot_sink *sink, int reason)
{
    if (strcmp(sink->path, "-") == 0)
        return qdot_fail(QDOT_EIO, "cannot write standard output: %s", strerror(reason));
    return qdot_fail(QDOT_EIO, "cannot write `%s`: %s", sink->path, strerror(reason));
}

qdot_status
qdot_sink_open(qdot_sink *sink, const char *path)
{
    *sink = (qdot_sink){.path = path};
    if (path[0] == '\0')
        return qdot_fail(QDOT_EINVAL, "a file needs a name");
    if (qdot_rank() > 0) /* rank 0 writes */
        sink->file = fopen("/dev/null", "wbe");
    else
        sink->file = strcmp(path, "-") == 0 ? stdout : fopen(path, "wbe");
    return sink->file != NULL ? QDOT_OK : lost(sink, errno);
}

qdot_status
qdot_sink_put(qdot_sink *sink, const char *bytes, size_t length)
{
    return fwrite(bytes, 1, length, sink->file) == length ? QDOT_OK : lost(sink, errno);
}

qdot_status
qdot_sink_close(qdot_sink *sink)
{
    FILE *file = sink->file;
    int reason = 0;

    sink->file = NULL;
    errno = 0;
    if (fflush(file) != 0 || ferror(file))
        reason = errno != 0 ? errno : EIO;
    if (file != stdout && fclose(file) != 0 && reason == 0)
        reason = errno;
    return reason == 0 ? QDOT_OK : lost(sink, reason);
}

void
qdot_sink_abandon(qdot_sink *sink)
{
    if (sink->file != NULL && sink->file != stdout)
        fclose(sink->file);
    sink->file = NULL;
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
