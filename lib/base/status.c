/* status.c -- records the last failure of each thread. */
#include "base/status.h"

#include <stdarg.h>
#include <stdio.h>

#include "base/utf8.h"

static _Thread_local qdot_error last;

qdot_status
qdot_fail(qdot_status status, const char *format, ...)
{
    va_list ap;

    va_start(ap, format);
    vsnprintf(last.message, sizeof last.message, format, ap);
    va_end(ap);
    qdot_utf8_mend(last.message); /* `%.100s` may have cut a character */
    last.status = status;
    last.hint[0] = '\0';
    return status;
}

qdot_status
qdot_hint(const char *format, ...)
{
    va_list ap;

    va_start(ap, format);
    vsnprintf(last.hint, sizeof last.hint, format, ap);
    va_end(ap);
    qdot_utf8_mend(last.hint);
    return last.status;
}

const qdot_error *
qdot_last_error(void)
{
    return &last;
}

qdot_status
qdot_fail_again(const qdot_error *saved)
{
    last = *saved;
    return last.status;
}
