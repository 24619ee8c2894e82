/* system.c -- creates and frees a system, and begins and ends each call on it, with its messages and errors. */
#include "api/system.h"

#include <math.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "base/interrupt.h"
#include "base/memory.h"
#include "base/progress.h"
#include "lang/answer/answer.h"
#include "lang/language/read.h"
#include "lang/session/evaluation.h"
#include "lang/session/outcome.h"
#include "lang/session/output.h"
#include "lang/session/session.h"
#include "lang/source/source.h"

/* --- texts of results ----------------------------------------------------------------- */

/* The public results equal the statuses of base/status.h; check at compile time that the values agree. */
#define SAME(result, status)                                                             \
    _Static_assert((int)QDOT_RESULT_##result == (int)QDOT_##status, #result)
SAME(OK, OK);
SAME(INVALID, EINVAL);
SAME(SYNTAX, ESYNTAX);
SAME(NAME, ENAME);
SAME(TYPE, ETYPE);
SAME(DOMAIN, EDOMAIN);
SAME(UNSET, EUNSET);
SAME(SINGULAR, ESINGULAR);
SAME(LIMIT, ELIMIT);
SAME(FAILED, EFAILED);
SAME(NOT_BUILT, ENOTBUILT);
SAME(IO, EIO);
SAME(NO_MEMORY, ENOMEM);
SAME(INTERRUPTED, EINTR);

const char *
qdot_result_text(qdot_result result)
{
    static const char *const text[] = {
        [QDOT_RESULT_OK] = "success",
        [QDOT_RESULT_INVALID] = "an argument that makes no sense",
        [QDOT_RESULT_SYNTAX] = "syntax error",
        [QDOT_RESULT_NAME] = "unknown or taken name",
        [QDOT_RESULT_TYPE] = "wrong kind of value",
        [QDOT_RESULT_DOMAIN] = "undefined",
        [QDOT_RESULT_UNSET] = "a parameter without a value",
        [QDOT_RESULT_SINGULAR] = "singular matrix",
        [QDOT_RESULT_LIMIT] = "larger than a stated limit",
        [QDOT_RESULT_FAILED] = "a numerical method failed",
        [QDOT_RESULT_NOT_BUILT] = "not built yet",
        [QDOT_RESULT_IO] = "input or output failed",
        [QDOT_RESULT_NO_MEMORY] = "out of memory",
        [QDOT_RESULT_INTERRUPTED] = "interrupted",
    };
    const size_t i = (size_t)result;

    return i < sizeof text / sizeof *text ? text[i] : "unknown result";
}

const char *
qdot_version(void)
{
    return PACKAGE_VERSION;
}

void
qdot_string_free(char *text)
{
    qdot_free(text);
}

/* --- creating and freeing a system ---------------------------------------------------- */

qdot_result
qdot_system_new(qdot_system **system)
{
    qdot_system *s;

    if (system == NULL)
        return QDOT_RESULT_INVALID;
    *system = NULL;
    s = qdot_calloc(1, sizeof *s);
    if (s == NULL)
        return QDOT_RESULT_NO_MEMORY;
    s->uses = 1;
    s->session = qdot_session_new(NULL, NULL);
    if (s->session == NULL) {
        qdot_free(s);
        return QDOT_RESULT_NO_MEMORY;
    }
    *system = s;
    return QDOT_RESULT_OK;
}

void
qdot_api_release(qdot_system *system)
{
    if (atomic_fetch_sub(&system->uses, 1) > 1)
        return;
    qdot_session_free(system->session);
    for (int i = 0; i < QDOT_API_STREAMS; i++)
        free(system->stream[i].text);
    qdot_free(system->source);
    qdot_free(system);
}

void
qdot_system_free(qdot_system *system)
{
    if (system != NULL)
        qdot_api_release(system);
}

const char *
qdot_system_error(const qdot_system *system)
{
    if (system == NULL || system->error.status == QDOT_OK)
        return "";
    if (system->stream[QDOT_API_ERRORS].length > 0)
        return system->stream[QDOT_API_ERRORS].text;
    return system->error.message;
}

const char *
qdot_system_notices(const qdot_system *system)
{
    if (system == NULL || system->stream[QDOT_API_NOTICES].text == NULL)
        return "";
    return system->stream[QDOT_API_NOTICES].text;
}

/* --- interruption and progress --------------------------------------------------------- */

void
qdot_system_interrupt(qdot_system *system)
{
    if (system != NULL)
        qdot_interrupt_ask(&system->interrupt);
}

/* Tell the hook of the system to which the progress belongs. */
static void
tell_hook(const qdot_progress *p)
{
    const qdot_system *system = (const qdot_system *)(const void *)((const char *)p - offsetof(qdot_system, watcher));
    const double done = (p->t - p->t0) / (p->t1 - p->t0);

    system->watcher.hook(system->watcher.data, p->what, fmin(fmax(done, 0), 1), p->left);
}

static void
remove_nothing(void)
{
}

qdot_result
qdot_system_progress(qdot_system *system, qdot_progress_hook hook, void *data)
{
    if (system == NULL)
        return QDOT_RESULT_INVALID;
    system->watcher.hook = hook;
    system->watcher.data = data;
    return qdot_api_accept(system);
}

/* Make the flag and the progress of the system those of this thread, which computes for it from now on. */
static void
enter_thread(qdot_system *system)
{
    system->outer_interrupt = qdot_interrupt_own;
    system->outer_progress = qdot_progress_open;
    qdot_interrupt_begin(&system->interrupt);
    qdot_interrupt_own = &system->interrupt;
    system->watcher.progress = (qdot_progress){.show = tell_hook, .clear = remove_nothing};
    qdot_progress_open = system->watcher.hook != NULL ? &system->watcher.progress : NULL;
}

static void
leave_thread(qdot_system *system)
{
    qdot_progress_open = system->outer_progress;
    qdot_interrupt_own = system->outer_interrupt;
    qdot_interrupt_end(&system->interrupt);
}

/* --- beginning and ending calls ------------------------------------------------------- */

qdot_status
qdot_api_begin(qdot_system *system)
{
    qdot_session *session = system->session;

    system->error = (qdot_error){0};
    enter_thread(system);
    for (int i = 0; i < QDOT_API_STREAMS; i++) {
        free(system->stream[i].text);
        system->stream[i].text = NULL;
        system->stream[i].length = 0;
    }
    for (int i = 0; i < QDOT_API_STREAMS; i++) {
        system->stream[i].file =
            open_memstream(&system->stream[i].text, &system->stream[i].length);
        if (system->stream[i].file == NULL)
            return qdot_fail(QDOT_ENOMEM, "no memory for answers");
    }
    session->output->out = system->stream[QDOT_API_ANSWERS].file;
    session->output->err = system->stream[QDOT_API_ERRORS].file;
    session->output->console = system->stream[QDOT_API_NOTICES].file;
    memset(session->outcome->verdicts, 0, sizeof session->outcome->verdicts);
    return QDOT_OK;
}

void
qdot_api_delete_undo_records(qdot_session *session)
{
    if (session->undo != NULL)
        session->undo_free(session->undo);
    session->undo = NULL;
}

void
qdot_system_keep_undo(qdot_system *system, int kept)
{
    if (system != NULL)
        system->keeps_undo = kept != 0;
}

qdot_result
qdot_system_source(qdot_system *system, const char *name)
{
    char *copy = name != NULL ? qdot_strdup(name) : NULL;

    if (system == NULL || (name != NULL && copy == NULL)) {
        qdot_free(copy);
        return system == NULL ? QDOT_RESULT_INVALID : QDOT_RESULT_NO_MEMORY;
    }
    qdot_free(system->source);
    system->source = copy;
    return qdot_api_accept(system);
}

/* Take back what a call has set of the session: its streams and what became of its statements. */
static void
reset_after_call(qdot_session *session)
{
    session->output->out = session->output->err = session->output->console = NULL;
    session->outcome->quit = session->outcome->refuted = session->outcome->failed = false;
    qdot_text_list_clear(&session->evaluation->told); /* a call that is no statement gives its notices each time */
}

qdot_result
qdot_api_end(qdot_system *system, qdot_status status)
{
    if (status != QDOT_OK)
        system->error = *qdot_last_error();
    if (!system->keeps_undo)
        qdot_api_delete_undo_records(system->session);
    reset_after_call(system->session);
    for (int i = 0; i < QDOT_API_STREAMS; i++) {
        FILE *file = system->stream[i].file;

        system->stream[i].file = NULL;
        if (file != NULL && fclose(file) != 0 && status == QDOT_OK) {
            status = qdot_fail(QDOT_ENOMEM, "no memory for answers");
            system->error = *qdot_last_error();
        }
    }
    leave_thread(system);
    return (qdot_result)status;
}

qdot_result
qdot_api_end_with_text(qdot_system *system, qdot_status status, qdot_text *text, char **out)
{
    const qdot_result result = qdot_api_end(system, status);

    *out = NULL;
    if (result == QDOT_RESULT_OK)
        *out = text->at;
    else
        qdot_text_clear(text);
    return result;
}

qdot_result
qdot_api_accept(qdot_system *system)
{
    system->error = (qdot_error){0};
    return QDOT_RESULT_OK;
}

qdot_result
qdot_api_refuse(qdot_system *system, const char *format, ...)
{
    qdot_status status = qdot_api_begin(system);

    if (status == QDOT_OK) {
        char message[256];
        va_list ap;

        va_start(ap, format);
        vsnprintf(message, sizeof message, format, ap);
        va_end(ap);
        status = qdot_fail(QDOT_EINVAL, "%s", message);
    }
    return qdot_api_end(system, status);
}

/* Clear a failure of the pool, but report the statement's own failure if it had one. */
static void
clear_pool_failure(qdot_pool *pool)
{
    qdot_error error = *qdot_last_error();

    if (!qdot_pool_failed(pool))
        return;
    (void)!qdot_pool_check(pool);
    (void)qdot_fail_again(&error);
}

qdot_status
qdot_api_read_name(qdot_cursor *c, const char **name)
{
    QDOT_TRY(qdot_read_name(c, name));
    QDOT_TRY(qdot_cursor_expect_end(c));
    c->error_at = 0;
    return QDOT_OK;
}

qdot_status
qdot_api_read(qdot_system *system, const char *call, const char *text, qdot_api_reader reader,
              void *data)
{
    qdot_session *session = system->session;
    qdot_cursor c = {.session = session};
    qdot_source *source;
    qdot_status status = qdot_source_new(call, text, strlen(text), &source, &c.error_at);

    if (status == QDOT_OK) {
        c.source = source;
        c.at = source->tokens.at;
        c.error_at = c.at->start;
        status = qdot_interrupt_check();
    }
    if (status == QDOT_OK)
        status = reader(&c, data);
    if (status == QDOT_OK)
        status = qdot_pool_check(session->pool);
    if (status == QDOT_OK)
        status = qdot_cursor_expect_end(&c);
    if (status == QDOT_OK && c.at != &source->tokens.at[source->tokens.n - 1]) {
        c.error_at = c.at[1].start;
        status = qdot_fail(QDOT_ESYNTAX, "only one is read here");
    }
    if (status != QDOT_OK) {
        clear_pool_failure(session->pool);
        qdot_answer_error(session, source, c.error_at);
    }
    if (status == QDOT_EINTR)
        qdot_interrupt_clear();
    qdot_source_free(source);
    return status;
}
